//! The read master with four clients and a memory of random latency: every client gets the words that it asked for.

use super::*;
use std::collections::VecDeque;

/// Clocks of the watchdog of [`small`].
const WATCHDOG: usize = 300;

/// Words of 64 bits of a line of clients 0 to 3: blocks and triangles.
const WORDS: [u64; 4] = [8, 8, 5, 5];

/// Word `i` of the line at an address.
fn word(address: u64, i: u64) -> u64 {
    (8 * address + i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// What a memory does wrong with a burst.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fault {
    Response,
    TooEarly,
    TooLate,
    /// No word is the last one, and nothing comes behind.
    NoLast,
    /// Nothing comes any more.
    Silence,
}

impl Fault {
    /// The entity says so itself, and memory goes on.
    fn is_told(self) -> bool {
        matches!(self, Self::Response | Self::TooEarly | Self::TooLate)
    }
}

struct Burst {
    due: usize,
    address: u64,
    words: u64,
    sent: u64,
    fault: Option<Fault>,
}

/// What is asked for and answered.
#[derive(Clone, Copy, Default)]
struct Run {
    /// So many lines for each client.
    lines: usize,
    /// Gaps or none.
    gaps: bool,
    /// The burst of a number has a fault. A restart follows once it is told.
    fault: Option<(usize, Fault)>,
    /// Once in so many clocks all clients forget what they have asked for, and ask for other lines.
    restarts: Option<u32>,
    /// The burst with the fault is an old one when the fault comes.
    forgotten: bool,
    /// The longest latency.
    latency: usize,
}

fn run(entity: &mut Entity, rng: &mut ChaCha8Rng, run: Run) -> Outcome {
    let Run { lines, gaps, fault, restarts, forgotten, latency: most } = run;
    entity.reset();
    let mut round = 0;
    let asked_for = |round: u64| -> Vec<VecDeque<u64>> {
        (0..4).map(|client| (0..lines as u64).map(|i| 1000 * client + 7 * i + round % 7).collect()).collect()
    };
    let mut wanted = asked_for(round);
    // Bursts that were asked for, that have ended, and those of them before the last restart; clocks without a word.
    let (mut accepted_bursts, mut ended_bursts, mut old_bursts, mut silence) = (0, 0, 0, 0);
    let mut told = 0;
    let mut due: Vec<VecDeque<u64>> = vec![VecDeque::new(); 4];
    let mut bursts: VecDeque<Burst> = VecDeque::new();
    let (mut held, mut number, mut broken) = (None, 0, false);
    let mut waits = [0; 4];
    for clock in 0..40_000 {
        let asked_for_fault = fault.is_some_and(|(at, _)| number > at);
        let restart = told == 3
            || (forgotten && round == 0 && asked_for_fault)
            || restarts.is_some_and(|times| round < 40 && seldom(rng, times));
        entity.set("restart", restart.into());
        let under_way = !bursts.is_empty();
        let asks: u64 = (0..4).map(|i| u64::from(!wanted[i].is_empty() && (!gaps || !seldom(rng, 3))) << i).sum();
        // Who asks goes on until it is served.
        let asks = asks | (0..4).map(|i| u64::from(waits[i] > 0) << i).sum::<u64>();
        entity.set("ask_valid", asks);
        for (client, lines) in wanted.iter().enumerate() {
            entity.set(&format!("ask_address_{client}"), lines.front().copied().unwrap_or(0));
        }
        let ready = !gaps || seldom(rng, 2);
        let burst = bursts.front_mut().filter(|burst| burst.due <= clock && (!gaps || seldom(rng, 2)));
        let entity_word = burst.is_some();
        entity.set("m_axi_rvalid", entity_word.into());
        let mut last = false;
        if let Some(burst) = burst {
            let end = match burst.fault {
                Some(Fault::TooEarly) => burst.words - 1,
                Some(Fault::TooLate) => burst.words + 1,
                _ => burst.words,
            };
            let stuck = burst.fault == Some(Fault::NoLast);
            entity.set("m_axi_rdata", word(burst.address, burst.sent));
            burst.sent += 1;
            last = burst.sent == end && !stuck;
            if burst.sent == end && stuck {
                burst.due = usize::MAX;
            }
            entity.set("m_axi_rlast", last.into());
            let response = burst.fault == Some(Fault::Response) && burst.sent == 1;
            entity.set("m_axi_rresp", if response { 2 } else { 0 });
        }
        // The memory is ready only when an address is offered.
        entity.set("m_axi_arready", 0);
        entity.settle();
        let offered = entity.is("m_axi_arvalid");
        entity.set("m_axi_arready", (ready && offered).into());
        entity.settle();
        expect(entity.is("m_axi_arvalid") == offered, clock, "ARVALID waits for ARREADY")?;
        expect(entity.is("m_axi_rready"), clock, "RREADY")?;
        let fills = entity.get("fill_valid");
        expect(fills & fills.wrapping_sub(1) == 0, clock, "a word for two")?;
        if fills > 0 {
            let client = fills.trailing_zeros() as usize;
            let expected = due[client].pop_front().ok_or(format!("clock {clock}: a word that nobody asked for"))?;
            expect(entity.get("fill_data") == expected, clock, "another word is due")?;
        }
        let accepted = entity.get("ask_ready") & asks;
        expect(accepted & accepted.wrapping_sub(1) == 0, clock, "two are served at once")?;
        for client in 0..4 {
            waits[client] += usize::from(asks >> client & 1 == 1);
            if accepted >> client & 1 == 1 {
                let address = wanted[client].pop_front().unwrap();
                due[client].extend((0..WORDS[client]).map(|i| word(address, i)));
                waits[client] = 0;
            }
            expect(broken || fault.is_some() || waits[client] < 400 + 2 * most, clock, "a client waits for ever")?;
        }
        let drains = ended_bursts < old_bursts;
        expect(!drains || entity.is("draining"), clock, "old bursts are under way")?;
        expect(!drains || accepted == 0, clock, "a request before old bursts have ended")?;
        expect(entity.is("silent") == (silence >= WATCHDOG), clock, "silent")?;
        accepted_bursts += usize::from(accepted > 0);
        silence = if entity_word || !(under_way || offered) { 0 } else { silence + 1 };
        let address = [entity.get("m_axi_araddr"), entity.get("m_axi_arlen")];
        expect(held.is_none_or(|held| offered && held == address), clock, "an address changed before it was taken")?;
        held = (offered && !ready).then_some(address);
        if offered && ready {
            let (line, client) = (address[0] / 64, (address[0] / 64 / 1000) as usize);
            expect(address[0].is_multiple_of(64) && client < 4 && address[1] + 1 == WORDS[client], clock, "the burst")?;
            let kind = [entity.get("m_axi_arsize"), entity.get("m_axi_arburst")];
            expect(kind == [3, 1], clock, "size and kind of the burst")?;
            let fault = fault.filter(|(at, _)| *at == number).map(|(_, fault)| fault);
            let latency = if gaps { rng.random_range(1..most.max(2)) } else { most };
            let due = if fault == Some(Fault::Silence) { usize::MAX } else { clock + latency };
            bursts.push_back(Burst { due, address: line, words: address[1] + 1, sent: 0, fault });
            number += 1;
        }
        if last {
            bursts.pop_front();
            ended_bursts += 1;
        }
        let failed = entity.is("failed");
        expect(!failed || (fault.is_some() && !forgotten), clock, "failed without a fault")?;
        // One clock after the fault the last good word may come.
        expect(!(broken && fills > 0), clock, "a word after the fault")?;
        expect(!(failed && accepted > 0), clock, "a request after the fault")?;
        broken = failed && !restart;
        told += usize::from(told > 0 || failed || entity.is("silent"));
        let idle = bursts.is_empty() && held.is_none();
        entity.clock();
        if restart {
            round += 1;
            wanted = asked_for(round);
            due.iter_mut().for_each(VecDeque::clear);
            waits = [0; 4];
            old_bursts = accepted_bursts;
            told = told.max(4);
        }
        // Bursts that never end are waited for without end.
        let (silent, endless) = (entity.is("silent"), fault.is_some_and(|(_, fault)| !fault.is_told()));
        if endless && silent && told > 100 {
            return expect(round > 0 && entity.is("draining"), clock, "what memory owes is forgotten");
        }
        if wanted.iter().all(VecDeque::is_empty) && due.iter().all(VecDeque::is_empty) && idle {
            return expect(fault.is_none() || told > 4, clock, "a fault that is not noticed");
        }
    }
    Err("words do not come".to_owned())
}

fn read_master(entity: &mut Entity) -> Outcome {
    let mut rng = random(6);
    for gaps in [false, true] {
        let usual = Run { lines: 60, gaps, latency: 30, ..Run::default() };
        run(entity, &mut rng, usual)?;
        for latency in [1, 30, 500] {
            run(entity, &mut rng, Run { lines: 20, latency, restarts: Some(60 + latency as u32), ..usual })?;
        }
        // They forget what was asked for before it has come.
        run(entity, &mut rng, Run { lines: 20, latency: 200, restarts: Some(20), ..usual })?;
        for fault in [Fault::Response, Fault::TooEarly, Fault::TooLate, Fault::NoLast, Fault::Silence] {
            run(entity, &mut rng, Run { lines: 20, fault: Some((9, fault)), ..usual })?;
            run(entity, &mut rng, Run { lines: 5, ..usual })?;
            if fault.is_told() {
                run(entity, &mut rng, Run { lines: 20, fault: Some((9, fault)), forgotten: true, ..usual })?;
            }
        }
    }
    Ok(())
}

#[test]
fn every_client_gets_its_words() {
    let changes = [
        ("m_axi_arvalid <= offered;", "m_axi_arvalid <= offered and m_axi_arready;"),
        ("owner <= owner_memory(to_integer(answered));", "owner <= owner_memory(to_integer(asked));"),
        ("(m_axi_rlast xor due) or", "(due and not m_axi_rlast) or"),
        ("(m_axi_rresp(1) or", "("),
        ("asks <= ahead when ahead /= nobody else others_ask;", "asks <= others_ask;"),
        ("and not failed_now and", "and"),
        // Bursts are forgotten: at once, by the first that ends, as soon as none is offered; new ones come between.
        ("draining_now <= '1';", "draining_now <= '0';"),
        ("        elsif nothing_under_way = '1' then", "        elsif finished = '1' then"),
        ("and not draining_now;", ";"),
        ("elsif failed_now = '0' and draining_now = '0' then", "elsif failed_now = '0' then"),
        // An address is taken back; what is under way is not counted on.
        (
            "          picked <= '0';\n        end if;\n      end if;",
            "          picked <= '0';\n          offered <= '0';\n        end if;\n      end if;",
        ),
        (
            "          fill_valid <= nobody;\n          draining_now",
            "          under_way <= \"000000\";\n          draining_now",
        ),
        // Old bursts fail for new requests; memory is silent too late, or for ever.
        ("if restart = '1' or draining_now = '1' then", "if restart = '1' then"),
        ("elsif silence = watchdog - 1 then", "elsif silence = watchdog then"),
        ("reset = '1' or m_axi_rvalid = '1' or nothing", "reset = '1' or nothing"),
    ];
    let design = small(Memory::Axi);
    assert_eq!(design.params.watchdog as usize, WATCHDOG);
    tried(&design, "engine_read_master", &changes, read_master);
}
