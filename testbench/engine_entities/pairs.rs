//! The queue of leaf pairs: order, capacity, and the count of those that are not answered.

use super::*;
use std::collections::VecDeque;

/// Everything around the queue: who sends pairs, the memory of triangles, and the unit.
#[derive(Default)]
struct Around {
    /// Accepted and not asked for.
    queue: VecDeque<[u64; 2]>,
    /// Asked for and not taken, each with the clock in which its triangles come.
    asked: VecDeque<usize>,
    /// Taken and not answered.
    tested: u32,
}

impl Around {
    fn open(&self) -> bool {
        !self.queue.is_empty() || !self.asked.is_empty() || self.tested > 0
    }

    /// A clock. `rates` are of pairs, requests taken, triangles taken, and answers: once in so many clocks, 0 never.
    fn clock(
        &mut self,
        entity: &mut Entity,
        rng: &mut ChaCha8Rng,
        clock: usize,
        rates: [u32; 4],
        ending: bool,
        sent: bool,
    ) -> Outcome {
        let open = self.open();
        let [offers, takes, tests, answers] = rates.map(|rate| rate > 0 && seldom(rng, rate));
        let pair = [rng.random_range(0..1 << 28), rng.random_range(0..1 << 28)];
        let come = self.asked.front().is_some_and(|&due| due <= clock);
        let answered = answers && self.tested > 0;
        for (port, value) in [
            ("ending", ending),
            ("pair_valid", offers),
            ("request_ready", takes),
            ("triangles_valid", come),
            ("triangles_ready", tests),
            ("answered", answered),
            ("sent", sent),
        ] {
            entity.set(port, value.into());
        }
        entity.set("pair_a", pair[0]);
        entity.set("pair_b", pair[1]);
        entity.settle();
        self.tested -= u32::from(answered);
        expect(entity.is("triangles_taken") == (come && (ending || tests)), clock, "triangles_taken")?;
        if entity.is("triangles_taken") {
            self.asked.pop_front();
            self.tested += u32::from(!ending);
        }
        if entity.is("request_valid") && takes {
            expect(!ending, clock, "a request at the end")?;
            let due = self.queue.pop_front().ok_or(format!("clock {clock}: a pair from nowhere"))?;
            expect([entity.get("request_a"), entity.get("request_b")] == due, clock, "another pair is due")?;
            self.asked.push_back(clock + rng.random_range(2..20));
        }
        if offers && entity.is("pair_ready") {
            self.queue.push_back(pair);
        }
        self.tested += u32::from(sent);
        // What is dropped at the end is not seen.
        let busy = if ending { !self.asked.is_empty() || self.tested > 0 } else { open && self.open() };
        expect(!(busy && entity.is("idle") && open), clock, "idle with open pairs")?;
        entity.clock();
        Ok(())
    }
}

fn pairs(entity: &mut Entity) -> Outcome {
    let mut rng = random(4);
    let mut around = Around::default();
    let mut clock = 0;
    entity.reset();
    // Until all is done and idle says so.
    let drain = |around: &mut Around, entity: &mut Entity, rng: &mut ChaCha8Rng, clock: &mut usize, ending: bool| {
        for _ in 0..2000 {
            *clock += 1;
            // At the end nobody takes requests.
            around.clock(entity, rng, *clock, [0, if ending { 0 } else { 2 }, 2, 2], ending, false)?;
            if entity.is("idle") {
                if ending {
                    around.queue.clear();
                }
                return expect(!around.open(), *clock, "idle with open pairs");
            }
        }
        Err("never idle".to_owned())
    };
    for round in 0..12 {
        // Nothing is taken: the queue and the place in front of it fill.
        for _ in 0..40 {
            clock += 1;
            around.clock(entity, &mut rng, clock, [1, 0, 0, 0], false, false)?;
        }
        expect(around.queue.len() == 17, clock, "the queue has 16 places, and one pair is in front of it")?;
        let rates = [[1, 1, 1, 1], [2, 1, 3, 3], [1, 3, 2, 2]][round % 3];
        for _ in 0..200 {
            clock += 1;
            around.clock(entity, &mut rng, clock, rates, false, false)?;
        }
        drain(&mut around, entity, &mut rng, &mut clock, round % 2 == 1)?;
        // Pairs of packets, which are counted alone.
        for _ in 0..10 {
            clock += 1;
            around.clock(entity, &mut rng, clock, [0, 1, 1, 4], true, true)?;
        }
        drain(&mut around, entity, &mut rng, &mut clock, true)?;
    }
    Ok(())
}

#[test]
fn pairs_are_asked_for_in_order_and_counted() {
    let changes = [
        ("waiting = places - 1 then", "waiting = places - 2 then"),
        ("head_leaves <= head_valid and (ending or request_ready);", "head_leaves <= head_valid and request_ready;"),
        ("opens <= accepts or sent;", "opens <= accepts;"),
        ("request_b <= head(27 downto 0);", "request_b <= head(55 downto 28);"),
    ];
    tried(&small(Memory::Axi), "engine_pairs", &changes, pairs);
}
