//! Answers, report and counters against what went in.

use super::*;
use efsat::engine::words::EngineReport;
use std::collections::VecDeque;

/// A pair with its verdict.
#[derive(Clone, Copy)]
struct Decided {
    verdict: u64,
    numbers: u64,
    last: bool,
    lane: u64,
}

/// How pairs are treated.
#[derive(Clone, Copy, Default)]
struct Options {
    dropping: bool,
    separate_too: bool,
    stop_at_contact: bool,
}

#[derive(Default)]
struct Around {
    /// Accepted, and not yet answered or dropped.
    held: VecDeque<Decided>,
    /// Words that are due, each with TLAST.
    due: VecDeque<(u64, bool)>,
    /// The options of the two clocks before, the older ones first: they hold a clock later, and an answer is told another one later.
    before: [Options; 2],
    /// Of the clock before: whether a contact has ended the query, and a word that was not taken.
    contact: bool,
    forgets_contact: bool,
    offered: Option<(u64, bool)>,
    certain: u64,
    unsure: u64,
    /// No word is taken.
    stands: bool,
    oldest: u64,
    /// No query runs.
    of_packets: bool,
}

impl Around {
    /// A clock, with a pair or none; whether the last word of a report is on its way.
    fn clock(
        &mut self,
        entity: &mut Entity,
        rng: &mut ChaCha8Rng,
        clock: usize,
        pair: Option<Decided>,
        options: Options,
    ) -> Result<bool, String> {
        let ready = !self.stands && !seldom(rng, 3);
        let Decided { verdict, numbers, last, lane } =
            pair.unwrap_or(Decided { verdict: 1, numbers: 0, last: true, lane: 0 });
        for (port, value) in [
            ("decided_valid", pair.is_some().into()),
            ("verdict", verdict),
            ("numbers", numbers),
            ("last", last.into()),
            ("decided_lane", lane),
            ("dropping", options.dropping.into()),
            ("separate_too", options.separate_too.into()),
            ("stop_at_contact", options.stop_at_contact.into()),
            ("m_axis_tready", ready.into()),
        ] {
            entity.set(port, value);
        }
        entity.settle();
        let mut contact = self.contact;
        if entity.is("pair_answered") {
            let Decided { verdict, numbers, last, lane } =
                self.held.pop_front().ok_or(format!("clock {clock}: a pair from nowhere is answered"))?;
            expect(lane == self.oldest || self.of_packets, clock, "a pair is answered before its query is the oldest")?;
            let Options { dropping, separate_too, stop_at_contact } = self.before[0];
            if !dropping && !self.contact {
                self.certain += u64::from(verdict == 1);
                self.unsure += u64::from(verdict == 2);
                contact |= stop_at_contact && verdict == 1;
                if verdict > 0 || separate_too {
                    self.due.push_back((numbers << 8 | verdict, last));
                }
            }
        }
        self.contact = contact && !self.forgets_contact;
        expect(entity.is("contact") == self.contact, clock, "contact")?;
        self.forgets_contact = entity.input("report_due") || entity.input("restart");
        self.before = [self.before[1], options];
        let word = (entity.get("m_axis_tdata"), entity.is("m_axis_tlast"));
        let valid = entity.is("m_axis_tvalid");
        expect(self.offered.is_none_or(|before| valid && before == word), clock, "a word changes before it is taken")?;
        self.offered = (valid && !ready).then_some(word);
        if valid && ready {
            expect(self.due.pop_front() == Some(word), clock, "another word is due")?;
        }
        if let Some(pair) = pair.filter(|_| entity.is("decided_ready")) {
            self.held.push_back(pair);
        }
        let done = entity.is("report_done");
        entity.clock();
        Ok(done)
    }

    /// Until everything that is held is answered and taken.
    fn drain(&mut self, entity: &mut Entity, rng: &mut ChaCha8Rng, clock: &mut usize, options: Options) -> Outcome {
        for _ in 0..40 {
            *clock += 1;
            self.clock(entity, rng, *clock, None, options)?;
        }
        let waits = self.held.iter().all(|pair| pair.lane != self.oldest && !self.of_packets);
        expect(waits && self.due.is_empty(), *clock, "a pair without an answer")
    }
}

/// Counters of lanes with a step in each clock, of one lane: the port, and the greatest step.
const LANE_EVENTS: [(&str, u64); 4] = [("expanded", 1), ("tested", 4), ("survived", 4), ("paired", 1)];
/// Counters of all lanes together. Two bits are two sides.
const EVENTS: [(&str, u64); 5] =
    [("block_reads", 3), ("triangles_asked", 1), ("triangle_reads", 3), ("words_read", 1), ("starved", 1)];

/// Lanes of the engine that is tested.
const LANES: u64 = 8;

fn answer(entity: &mut Entity) -> Outcome {
    let mut rng = random(11);
    let (mut around, mut clock) = (Around::default(), 0);
    entity.reset();
    for round in 0..48u64 {
        let oldest = round / 3 % LANES;
        entity.set("oldest", oldest);
        entity.set("oldest_flags", 1 << oldest);
        (around.oldest, around.of_packets) = (oldest, round % 5 == 4);
        entity.set("running", (!around.of_packets).into());
        entity.set("clear", 1 << oldest);
        entity.set("renew", 1);
        around.drain(entity, &mut rng, &mut clock, Options::default())?;
        (around.certain, around.unsure) = (0, 0);
        let mut options = Options { separate_too: round % 3 == 0, stop_at_contact: round % 4 == 0, dropping: false };
        let (mut of_lane, mut counts, mut stalled) = ([0; LANE_EVENTS.len()], [0; EVENTS.len()], 0);
        // What happens in the clock before the one in which counters begin again counts.
        for words in [1, 0] {
            entity.set("words_read", words);
            clock += 1;
            around.clock(entity, &mut rng, clock, None, options)?;
        }
        counts[3] += 1;
        entity.set("clear", 0);
        entity.set("renew", 0);
        let running = 60 + 10 * (round % 24);
        for step in 0..running {
            clock += 1;
            // The query has a reason to end.
            options.dropping = round % 4 == 2 && step > running / 2;
            // Clocks of other queries are counted, too.
            entity.set("counting", 1 << oldest | rng.random_range(0..1 << LANES));
            for ((port, most), count) in LANE_EVENTS.into_iter().zip(&mut of_lane) {
                let (value, lane) = (rng.random_range(0..=most), rng.random_range(0..LANES));
                entity.set(port, value);
                entity.set(&format!("{port}_lane"), lane);
                *count += if lane == oldest { value } else { 0 };
            }
            for ((port, most), count) in EVENTS.into_iter().zip(&mut counts) {
                let value = rng.random_range(0..=most);
                entity.set(port, value);
                *count += if most == 3 { u64::from(value.count_ones()) } else { value };
            }
            let stalls = rng.random::<bool>();
            entity.set("stalled", stalls.into());
            stalled += u64::from(stalls);
            // As the sides come and go while no pair waits there, too.
            let pair = (!seldom(&mut rng, 3) && step + 20 < running).then(|| Decided {
                verdict: rng.random_range(0..3),
                numbers: rng.random_range(0..1 << 56),
                last: seldom(&mut rng, 8),
                lane: if around.of_packets { rng.random_range(0..LANES) } else { oldest },
            });
            around.clock(entity, &mut rng, clock, pair, options)?;
        }
        entity.set("counting", rng.random_range(0..1 << LANES) & !(1 << oldest));
        LANE_EVENTS.iter().chain(&EVENTS).for_each(|(port, _)| entity.set(port, 0));
        entity.set("stalled", 0);
        let behind = round % 3 == 2 && !around.of_packets;
        if behind {
            // Pairs of the next query come right behind those of this one, and are held until theirs is the oldest.
            for (numbers, lane) in (0..).zip([0, 0, 1, 1].map(|age| (oldest + age) % LANES)) {
                let mut pair = Some(Decided { verdict: 2, numbers, last: false, lane });
                let begun = clock;
                while pair.is_some() {
                    expect(clock < begun + 100, clock, "a pair that is never taken")?;
                    around.stands = round % 2 == 0 && clock < begun + 3;
                    entity.settle();
                    let taken = entity.is("decided_ready");
                    clock += 1;
                    around.clock(entity, &mut rng, clock, pair, options)?;
                    pair = pair.filter(|_| !taken);
                }
            }
            around.stands = false;
        }
        around.drain(entity, &mut rng, &mut clock, options)?;
        expect(around.held.len() == if behind { 2 } else { 0 }, clock, "a pair that is not held")?;

        let (reason, number) = (round % 11, rng.random_range(0..1 << 24));
        let (short, stack) = (round % 2 == 1, rng.random_range(0..1 << 10));
        for (port, value) in
            [("reason", reason), ("number", number), ("short", short.into()), ("greatest_stack", stack)]
        {
            entity.set(port, value);
        }
        let incomplete = u64::from(reason > 1 || (reason == 1 && short));
        let ([expanded, tested, survived, paired], [blocks, asked, triangles, words, starved]) = (of_lane, counts);
        let report = [
            running << 32 | number << 8 | incomplete << 7 | reason << 2 | 3,
            tested << 32 | expanded,
            paired << 32 | survived,
            around.unsure << 32 | around.certain,
            (blocks << 32) | (2 * expanded),
            (triangles << 32) | (2 * asked),
            starved << 32 | words,
            stack << 32 | stalled,
        ];
        let words = if short { 1 } else { EngineReport::WORDS };
        around.due.extend(report[..words].iter().enumerate().map(|(i, &word)| (word, i + 1 == words)));
        entity.set("report_due", 1);
        if round % 3 == 1 {
            // It begins again after a restart; what is offered stays until it is taken.
            let whole = around.due.len();
            for _ in 0..round % 7 {
                clock += 1;
                around.clock(entity, &mut rng, clock, None, options)?;
            }
            // In the clock before, no other word is offered any more.
            entity.set("forgets", 1);
            clock += 1;
            around.clock(entity, &mut rng, clock, None, options)?;
            entity.set("forgets", 0);
            entity.set("restart", 1);
            entity.settle();
            expect(entity.is("m_axis_tvalid") == around.offered.is_some(), clock, "another word behind a soft reset")?;
            around.stands = true;
            for _ in 0..1 + round % 2 {
                clock += 1;
                around.clock(entity, &mut rng, clock, None, options)?;
            }
            entity.set("restart", 0);
            around.stands = false;
            let taken = whole - around.due.len();
            let offered = around.offered.into_iter();
            let words = if short { 1 } else { EngineReport::WORDS };
            let again = (0..words).map(|i| (report[i], i + 1 == words));
            expect(taken <= words, clock, "more than a report")?;
            around.due = offered.chain(again).collect();
        }
        let mut done = false;
        for _ in 0..100 {
            clock += 1;
            done = around.clock(entity, &mut rng, clock, None, options)?;
            if done {
                break;
            }
        }
        expect(done, clock, "the report has no end")?;
        entity.set("report_due", 0);
        around.drain(entity, &mut rng, &mut clock, options)?;
    }
    Ok(())
}

#[test]
fn answers_reports_and_counts_are_those_of_the_pairs() {
    let changes = [
        ("free <= m_axis_tready or not offered;", "free <= '1';"),
        ("due <= head_valid and head_due;", "due <= head_valid;"),
        ("coming_due <= stays_due when moves = '0' else", "coming_due <= stays_due when head_valid = '1' else"),
        ("stays_due <= '1' when head_lane = oldest", "stays_due <= '1' when next_lane = oldest"),
        ("next_due <= '1' when next_lane = oldest", "next_due <= '1' when head_lane = oldest"),
        ("decided_due <= '1' when decided_lane = oldest", "decided_due <= '1' when head_lane = oldest"),
        ("next_lane <= decided_lane;", "next_lane <= oldest;"),
        ("head_due <= coming_due or not running;", "head_due <= coming_due;"),
        ("decided_ready <= not next_valid;", "decided_ready <= '1';"),
        ("head_verdict /= separate or all_speak = '1' else", "head_verdict /= separate else"),
        ("speaks <= due and not drops and", "speaks <= due and"),
        ("counts <= taken and not drops and", "counts <= taken and"),
        // Pairs behind a contact, and a contact that the next query takes over.
        ("counts <= taken and not drops and not contact_now;", "counts <= taken and not drops;"),
        ("(contact_now or meets) and not report_due", "(contact_now or meets)"),
        ("reason = reason_contact and short = '0'", "reason = reason_contact"),
        ("offered_last <= ends;", "offered_last <= '0';"),
        // A restart takes back what is offered, or lets a report go on.
        ("offered <= offered and not free;", "offered <= '0';"),
        ("elsif (forgets or restart) = '1' then", "elsif restart = '1' then"),
        ("elsif (forgets or restart) = '1' then\n        turn <= first_word;", "elsif (forgets or restart) = '1' then"),
        ("survivors(lane) + unsigned(survived)", "survivors(lane) + unsigned(survived(0 downto 0))"),
        // Counts of another query, and what is lost where counters begin again.
        ("pairs_now <= pairs(lane);", "pairs_now <= pairs(0);"),
        ("if unsigned(tested_lane) = lane then", "if unsigned(survived_lane) = lane then"),
        ("counter(i)(0) <= steps(i);", "counter(i)(0) <= '0';"),
    ];
    let design =
        EngineDesign::new(&EngineParams { queries: LANES as u32, ..small(Memory::Axi).params }, &Params::default());
    tried(&design.unwrap(), "engine_answer", &changes, answer);
}
