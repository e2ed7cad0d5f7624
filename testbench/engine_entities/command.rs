//! Packets in: what becomes of each, good or bad, and what waits for what.

use super::*;
use efsat::params::engine::{Command, EngineFormat, QueryFlags, Reason};
use efsat::params::stream::{Kind, Report};
use std::collections::VecDeque;

/// What comes of a packet.
enum Work {
    Job {
        query: bool,
        posed: bool,
        short: bool,
        reason: u64,
        number: u64,
        /// Words of the job from a place on.
        words: (usize, Vec<u64>),
        /// Stops that come before it is taken: those right behind its packet do not wait for it.
        stops: usize,
    },
    Pair {
        words: Vec<u64>,
        last: bool,
    },
    Write {
        triangles: bool,
        line: u64,
        place: u64,
        word: u64,
    },
}

/// A word of the stream: data, whether all its bytes are there, whether it is the last.
type Word = (u64, bool, bool);

struct Packets {
    rng: ChaCha8Rng,
    format: EngineFormat,
    /// Lines of each memory.
    lines: u64,
    words: VecDeque<Word>,
    due: VecDeque<Work>,
    stops: usize,
}

/// The report of one word that a packet of pairs or a pose has.
fn short(reason: Reason) -> u64 {
    match reason {
        Reason::UnknownHeader => Report::UnknownHeader as u64,
        Reason::TooShort => Report::TooShort as u64,
        _ => Report::TooLong as u64,
    }
}

impl Packets {
    fn random(&mut self, count: u32) -> Vec<u64> {
        (0..count).map(|_| self.rng.random()).collect()
    }

    /// Sends a packet; the word at one place may lack bytes.
    fn send(&mut self, words: &[u64], holed: Option<usize>) {
        let end = words.len() - 1;
        self.words.extend(words.iter().enumerate().map(|(i, &word)| (word, holed != Some(i), i == end)));
    }

    /// The report of a packet, of one word or of eight.
    fn report(&mut self, reason: u64, short: bool) {
        let words = (0, vec![]);
        self.due.push_back(Work::Job { query: false, posed: false, short, reason, number: 0, words, stops: 0 });
    }

    fn refused(&mut self, reason: Reason) {
        self.report(reason as u64, false);
    }

    /// The words of a good query.
    fn query_words(&mut self) -> Vec<u64> {
        let format = self.format;
        let mut words = self.random(format.query_words());
        words[0] = format.header(Command::Query);
        words[5] &= !(0xf << 36);
        words[EngineFormat::POSE_AT as usize] &= !(1 << 31);
        let choice = (1u64 << format.choice_bits()) - 1;
        for row in &mut words[format.row_at(0) as usize..] {
            *row &= (1 << (format.rest_at() + format.rest_bits())) - 1;
            for (slot, directions) in (0..).zip(format.directions.slots()) {
                let at = format.choice_at(slot);
                let chosen = self.rng.random_range(0..directions.len()) as u64;
                *row = *row & !(choice << at) | chosen << at;
            }
        }
        words
    }

    /// Headers with nothing behind them.
    fn headers(&mut self) {
        for command in [Command::Query, Command::Load] {
            self.send(&[self.format.header(command)], None);
            self.refused(Reason::TooShort);
        }
        for kind in [Kind::Pairs, Kind::Pose] {
            self.send(&[self.format.stream.header(kind).into()], None);
            self.report(short(Reason::TooShort), true);
        }
    }

    fn query(&mut self) {
        let format = self.format;
        let mut words = self.query_words();
        let last = words.len() - 1;
        let row = self.rng.random_range(format.row_at(0) as usize..=last);
        let (mut reason, mut holed) = (Reason::Complete, None);
        match self.rng.random_range(0..14) {
            0 => {
                words.truncate(self.rng.random_range(1..=last));
                reason = Reason::TooShort;
            }
            1 => {
                words.extend([0; 2]);
                reason = Reason::TooLong;
            }
            2 => {
                words[0] ^= 1 << self.rng.random_range(32..64);
                reason = Reason::UnknownHeader;
            }
            3 => {
                words[5] |= 1 << self.rng.random_range(36..40);
                reason = Reason::UnknownHeader;
            }
            4 => {
                words[EngineFormat::POSE_AT as usize] |= 1 << 31;
                reason = Reason::UnknownHeader;
            }
            5 => {
                // A choice that there is not.
                words[row] |= 7 << format.choice_at(self.rng.random_range(0..3));
                reason = Reason::UnknownHeader;
            }
            6 => {
                words[row] |= 1 << self.rng.random_range(format.rest_at() + format.rest_bits()..64);
                reason = Reason::UnknownHeader;
            }
            7 => {
                let at = self.rng.random_range(0..=last);
                holed = Some(at);
                reason = if at == 0 { Reason::UnknownHeader } else { Reason::TooShort };
            }
            _ => {}
        }
        self.send(&words, holed);
        if reason != Reason::Complete {
            return self.refused(reason);
        }
        let (number, words) = (words[5] >> QueryFlags::NUMBER_AT, (0, words[1..].to_vec()));
        self.due.push_back(Work::Job { query: true, posed: true, short: false, reason: 0, number, words, stops: 0 });
    }

    fn pose(&mut self) {
        let header = u64::from(self.format.stream.header(Kind::Pose));
        let record = self.random(self.format.pose_words);
        let mut words = [vec![header], record.clone()].concat();
        let last = words.len() - 1;
        let (mut reason, mut holed) = (Reason::Complete, None);
        match self.rng.random_range(0..8) {
            0 => {
                // The header alone, too.
                words.truncate(if seldom(&mut self.rng, 2) { 1 } else { self.rng.random_range(1..=last) });
                reason = Reason::TooShort;
            }
            1 => {
                words.extend([0; 3]);
                reason = Reason::TooLong;
            }
            2 => {
                words[0] ^= 1 << self.rng.random_range(8..32);
                reason = Reason::UnknownHeader;
            }
            3 => {
                holed = Some(self.rng.random_range(1..=last));
                reason = Reason::TooShort;
            }
            _ => {}
        }
        self.send(&words, holed);
        if reason != Reason::Complete {
            return self.report(short(reason), true);
        }
        let words = (EngineFormat::POSE_AT as usize - 1, record);
        self.due.push_back(Work::Job { query: false, posed: true, short: true, reason: 0, number: 0, words, stops: 0 });
    }

    fn pairs(&mut self) {
        let length = self.format.stream.record_words(Kind::Pairs) as usize;
        let count = self.rng.random_range(1..4);
        let records = self.random((count * length) as u32);
        let mut words = [vec![u64::from(self.format.stream.header(Kind::Pairs))], records.clone()].concat();
        let (mut whole, mut holed) = (count, None);
        match self.rng.random_range(0..5) {
            0 => {
                // Anywhere but behind a pair, which would be the last one.
                whole = self.rng.random_range(0..count);
                words.truncate(1 + whole * length + self.rng.random_range(usize::from(whole > 0)..length));
            }
            1 => {
                whole = self.rng.random_range(0..count);
                holed = Some(1 + whole * length + self.rng.random_range(0..length));
            }
            _ => {}
        }
        self.send(&words, holed);
        for (i, pair) in records.chunks(length).enumerate().take(whole) {
            self.due.push_back(Work::Pair { words: pair.to_vec(), last: i + 1 == count });
        }
        if whole < count {
            self.report(short(Reason::TooShort), true);
        }
    }

    fn load(&mut self) {
        let triangles: bool = self.rng.random();
        let line = self.rng.random_range(0..self.lines);
        let mut address = line << 6 | u64::from(triangles) << 31;
        let count = 8 * self.rng.random_range(1..4u32);
        let mut data = self.random(count);
        let (mut reason, mut holed, mut written) = (Reason::Complete, None, data.len());
        let room = 8 * (self.lines - line) as usize;
        match self.rng.random_range(0..9) {
            0 => {
                address ^= 1 << [0, 3, 5, 32, 63][self.rng.random_range(0..5)];
                (reason, written) = (Reason::UnknownHeader, 0);
            }
            1 => {
                // The first line behind the memory, and any other that an address can name.
                address |= self.lines << 6 << self.rng.random_range(0..20);
                (reason, written) = (Reason::TooLong, 0);
            }
            2 => {
                data.truncate(self.rng.random_range(0..data.len()));
                (reason, written) = (Reason::TooShort, data.len());
            }
            3 => {
                written = self.rng.random_range(0..data.len());
                (reason, holed) = (Reason::TooShort, Some(2 + written));
            }
            _ => {}
        }
        if written > room {
            (reason, written) = (Reason::TooLong, room);
        }
        self.send(&[vec![self.format.header(Command::Load), address], data.clone()].concat(), holed);
        for (i, &word) in (0..).zip(&data[..written]) {
            self.due.push_back(Work::Write { triangles, line: line + i / 8, place: i % 8, word });
        }
        self.refused(reason);
    }

    fn stop(&mut self) {
        let header = self.format.header(Command::Stop);
        if seldom(&mut self.rng, 4) {
            self.send(&[header, 0], None);
            return self.refused(Reason::TooLong);
        }
        self.send(&[header], None);
        self.stops += 1;
        if let Some(Work::Job { stops, .. }) = self.due.back_mut() {
            *stops = self.stops;
        }
    }

    fn next(&mut self) {
        match self.rng.random_range(0..12) {
            0..4 => self.query(),
            4 | 5 => self.pose(),
            6 | 7 => self.pairs(),
            8 => self.load(),
            9 | 10 => self.stop(),
            _ => {
                let words = self.random(3);
                // Of no kind that there is.
                self.send(&[vec![words[0] | 0x40], words].concat(), None);
                self.refused(Reason::UnknownHeader);
            }
        }
    }

    /// What the entity gives in this clock is what is due.
    fn given(&mut self, entity: &Entity, clock: usize, takes: [bool; 2]) -> Outcome {
        let [takes_job, takes_pair] = takes;
        let writes = [entity.is("block_write"), entity.is("triangle_write")];
        let job_words = || entity.words("job_words");
        if writes != [false; 2] {
            let Some(Work::Write { triangles, line, place, word }) = self.due.pop_front() else {
                return Err(format!("clock {clock}: a word is written from nowhere"));
            };
            expect(writes == [!triangles, triangles], clock, "which memory")?;
            let found = ["write_line", "write_place", "write_data"].map(|port| entity.get(port));
            expect(found == [line, place, word], clock, "what is written")?;
        }
        if takes_pair {
            let Some(Work::Pair { words, last }) = self.due.pop_front() else {
                return Err(format!("clock {clock}: a pair from nowhere"));
            };
            expect(job_words().ends_with(&words), clock, "words of a pair")?;
            expect(entity.is("pair_last") == last, clock, "pair_last")?;
        }
        if takes_job {
            let Some(Work::Job { query, posed, short, reason, number, words: (at, words), .. }) = self.due.pop_front()
            else {
                return Err(format!("clock {clock}: a job from nowhere"));
            };
            let found = ["job_query", "job_posed", "job_short"].map(|port| entity.is(port));
            expect(found == [query, posed, short], clock, "kind of the job")?;
            expect(query || entity.get("job_reason") == reason, clock, "job_reason")?;
            expect(entity.get("job_number") == number, clock, "job_number")?;
            expect(job_words()[at..].starts_with(&words), clock, "job_words")?;
        }
        Ok(())
    }
}

fn command(entity: &mut Entity) -> Outcome {
    let design = small(Memory::BlockRam);
    let lines = design.params.block_lines.into();
    let mut packets = Packets {
        rng: random(13),
        format: design.format,
        lines,
        words: VecDeque::new(),
        due: VecDeque::new(),
        stops: 0,
    };
    entity.reset();
    packets.headers();
    (0..160).for_each(|_| packets.next());
    let (mut working, mut stops, mut quiet) = (0, 0, 0);
    // A word that was offered stays until it is taken.
    let mut offered = false;
    for clock in 0.. {
        offered |= !packets.words.is_empty() && !seldom(&mut packets.rng, 4);
        let word = packets.words.front().filter(|_| offered).copied();
        let (data, whole, last) = word.unwrap_or((u64::MAX, true, true));
        entity.set("s_axis_tvalid", word.is_some().into());
        entity.set("s_axis_tdata", data);
        entity.set("s_axis_tkeep", if whole { 0xff } else { 0x7f });
        entity.set("s_axis_tlast", last.into());
        entity.settle();
        // Something runs from the job on; what is below depends on it.
        let (job, pair) = (entity.is("job_valid"), entity.is("pair_valid"));
        let held = matches!(packets.due.front(), Some(Work::Job { stops: first, .. }) if stops < *first);
        let takes_job = job && working == 0 && !held && seldom(&mut packets.rng, 3);
        let takes_pair = pair && seldom(&mut packets.rng, 3);
        for (port, value) in [("job_taken", takes_job), ("pair_taken", takes_pair), ("busy", job || working > 0)] {
            entity.set(port, value.into());
        }
        entity.settle();
        expect(working == 0 || !(pair || entity.is("block_write") || entity.is("triangle_write")), clock, "busy")?;
        stops += usize::from(entity.is("stop"));
        packets.given(entity, clock, [takes_job, takes_pair])?;
        working = if takes_job { packets.rng.random_range(0..120) } else { u32::saturating_sub(working, 1) };
        let arrives = word.is_some() && entity.is("s_axis_tready");
        if arrives {
            packets.words.pop_front();
            offered = false;
        }
        quiet = if arrives || takes_job || takes_pair || working > 0 { 0 } else { quiet + 1 };
        entity.clock();
        if quiet > 100 {
            let done = packets.words.is_empty() && packets.due.is_empty() && stops == packets.stops;
            return expect(done, clock, "a packet without its answer");
        }
    }
    Ok(())
}

#[test]
fn every_packet_becomes_what_it_is() {
    let changes = [
        ("busy and (head_kind(is_load) or head_kind(is_pairs))", "busy and head_kind(is_load)"),
        ("busy and (head_kind(is_load) or head_kind(is_pairs))", "busy and head_kind(is_pairs)"),
        ("(head_kind(is_stop) or not waits)", "not waits"),
        ("    (at_options = '1' and head(39 downto 36) /= \"0000\") or\n", ""),
        ("    (at_record = '1' and head(31) = '1') or\n", ""),
        ("answer_short := head_kind(is_short);", "answer_short := '0';"),
        (
            "if at_rows = '1' then\n                found := too_long;",
            "if at_rows = '0' and at_record = '1' then\n                found := too_long;",
        ),
        ("elsif behind = '1' then", "elsif behind = '1' and whole = '0' then"),
        ("load_line <= load_line + 1;", "load_line <= load_line;"),
        ("load_line(5) <= '1';", "load_line(5) <= '0';"),
        ("if head_last = '1' and load_place /= 7 then", "if head_last = '1' and load_place = 0 then"),
        ("if place = 12 then", "if place = 11 then"),
    ];
    tried(&small(Memory::BlockRam), "engine_command", &changes, command);
}
