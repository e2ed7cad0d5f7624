//! The read master with four clients and a memory of random latency: every client gets the words that it asked for.

use super::*;
use std::collections::VecDeque;

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
}

struct Burst {
    due: usize,
    address: u64,
    words: u64,
    sent: u64,
    fault: Option<Fault>,
}

/// So many lines for each client, gaps or none; the burst of a number has a fault.
fn run(entity: &mut Entity, rng: &mut ChaCha8Rng, lines: usize, gaps: bool, fault: Option<(usize, Fault)>) -> Outcome {
    entity.reset();
    let mut wanted: Vec<VecDeque<u64>> =
        (0..4).map(|client| (0..lines as u64).map(|i| 1000 * client + 7 * i).collect()).collect();
    let mut due: Vec<VecDeque<u64>> = vec![VecDeque::new(); 4];
    let mut bursts: VecDeque<Burst> = VecDeque::new();
    let (mut held, mut number, mut broken) = (None, 0, false);
    let mut waits = [0; 4];
    for clock in 0..20_000 {
        let asks: u64 = (0..4).map(|i| u64::from(!wanted[i].is_empty() && (!gaps || !seldom(rng, 3))) << i).sum();
        // Who asks goes on until it is served.
        let asks = asks | (0..4).map(|i| u64::from(waits[i] > 0) << i).sum::<u64>();
        entity.set("ask_valid", asks);
        for (client, lines) in wanted.iter().enumerate() {
            entity.set(&format!("ask_address_{client}"), lines.front().copied().unwrap_or(0));
        }
        let ready = !gaps || seldom(rng, 2);
        let burst = bursts.front_mut().filter(|burst| burst.due <= clock && (!gaps || seldom(rng, 2)));
        entity.set("m_axi_rvalid", burst.is_some().into());
        let mut last = false;
        if let Some(burst) = burst {
            let end = match burst.fault {
                Some(Fault::TooEarly) => burst.words - 1,
                Some(Fault::TooLate) => burst.words + 1,
                _ => burst.words,
            };
            entity.set("m_axi_rdata", word(burst.address, burst.sent));
            burst.sent += 1;
            last = burst.sent == end;
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
            expect(broken || fault.is_some() || waits[client] < 400, clock, "a client waits for ever")?;
        }
        let address = [entity.get("m_axi_araddr"), entity.get("m_axi_arlen")];
        expect(held.is_none_or(|held| offered && held == address), clock, "an address changed before it was taken")?;
        held = (offered && !ready).then_some(address);
        if offered && ready {
            let (line, client) = (address[0] / 64, (address[0] / 64 / 1000) as usize);
            expect(address[0].is_multiple_of(64) && client < 4 && address[1] + 1 == WORDS[client], clock, "the burst")?;
            let kind = [entity.get("m_axi_arsize"), entity.get("m_axi_arburst")];
            expect(kind == [3, 1], clock, "size and kind of the burst")?;
            let fault = fault.filter(|(at, _)| *at == number).map(|(_, fault)| fault);
            let latency = if gaps { rng.random_range(1..40) } else { 30 };
            bursts.push_back(Burst { due: clock + latency, address: line, words: address[1] + 1, sent: 0, fault });
            number += 1;
        }
        if last {
            bursts.pop_front();
        }
        expect(!(entity.is("quiet") && held.is_some()), clock, "quiet with an address offered")?;
        let failed = entity.is("failed");
        expect(!failed || fault.is_some(), clock, "failed without a fault")?;
        // One clock after the fault the last good word may come.
        expect(!(broken && fills > 0), clock, "a word after the fault")?;
        expect(!(failed && accepted > 0), clock, "a request after the fault")?;
        broken = failed;
        let idle = bursts.is_empty() && held.is_none();
        entity.clock();
        if failed && idle && entity.is("quiet") {
            return Ok(());
        }
        if wanted.iter().all(VecDeque::is_empty) && due.iter().all(VecDeque::is_empty) && idle && entity.is("quiet") {
            return expect(fault.is_none(), clock, "a fault that is not noticed");
        }
    }
    Err("words do not come".to_owned())
}

fn read_master(entity: &mut Entity) -> Outcome {
    let mut rng = random(6);
    for gaps in [false, true] {
        run(entity, &mut rng, 60, gaps, None)?;
        for fault in [Fault::Response, Fault::TooEarly, Fault::TooLate] {
            run(entity, &mut rng, 20, gaps, Some((9, fault)))?;
            run(entity, &mut rng, 5, gaps, None)?;
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
        ("and not failed_now;", ";"),
    ];
    tried(&small(Memory::Axi), "engine_read_master", &changes, read_master);
}
