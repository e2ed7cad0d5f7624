//! Block RAM against an array.

use super::*;
use std::collections::VecDeque;

const LINES: u64 = 32;

/// Writes all lines, asks for random ones of both trees, writes some again, and so on. Lines come in every clock if the memory is not
/// paced.
fn memory(entity: &mut Entity, words: usize, paced: bool) -> Outcome {
    let mut rng = random(3);
    let mut lines = vec![vec![0u64; 8]; LINES as usize];
    let mut clock = 0;
    entity.reset();
    for round in 0..3 {
        for (line, content) in lines.iter_mut().enumerate() {
            for (place, word) in content.iter_mut().enumerate() {
                if round > 0 && !seldom(&mut rng, 5) {
                    continue;
                }
                *word = rng.random();
                let write = [
                    ("write_valid", 1),
                    ("write_line", line as u64),
                    ("write_place", place as u64),
                    ("write_data", *word),
                ];
                write.into_iter().for_each(|(port, value)| entity.set(port, value));
                entity.settle();
                entity.clock();
            }
        }
        entity.set("write_valid", 0);
        let bases = [rng.random_range(0..8), rng.random_range(0..8)];
        entity.set("base_a", bases[0]);
        entity.set("base_b", bases[1]);
        let mut due: VecDeque<[usize; 2]> = VecDeque::new();
        let mut to_ask = 200;
        let eager = round == 0;
        while to_ask > 0 || !due.is_empty() {
            clock += 1;
            let request = to_ask > 0 && (eager || !seldom(&mut rng, 3));
            let asked = [rng.random_range(0..LINES - 8), rng.random_range(0..LINES - 8)];
            entity.set("request_valid", request.into());
            entity.set("request_a", asked[0]);
            entity.set("request_b", asked[1]);
            entity.set("lines_taken", 0);
            entity.settle();
            if entity.is("lines_valid") {
                let expected = *due.front().ok_or(format!("clock {clock}: lines that nobody asked for"))?;
                for (port, line) in ["line_a", "line_b"].into_iter().zip(expected) {
                    expect(entity.words(port)[..words] == lines[line][..words], clock, port)?;
                }
                if eager || seldom(&mut rng, 2) {
                    entity.set("lines_taken", 1);
                    due.pop_front();
                }
            }
            entity.settle();
            if request && entity.is("request_ready") {
                due.push_back([0, 1].map(|side| (bases[side] + asked[side]) as usize));
                to_ask -= 1;
            }
            expect(due.len() <= 2 && clock < 5000, clock, "lines do not come")?;
            // A pair of lines in every clock.
            expect(
                !eager || paced || to_ask == 200 || !request || entity.is("request_ready"),
                clock,
                "a request that waits",
            )?;
            entity.clock();
        }
    }
    Ok(())
}

#[test]
fn block_ram_gives_what_was_written() {
    let design = small(Memory::BlockRam);
    let changes = [
        ("moves <= asked and not found;", "moves <= asked;"),
        ("asked_b <= unsigned(base_b)", "asked_b <= unsigned(base_a)"),
        ("place_a <= unsigned(write_line) when write_valid = '1' else asked_a;", "place_a <= asked_a;"),
    ];
    tried(&design, "engine_block_memory", &changes, |entity| memory(entity, 8, true));
    let changes = [("moves <= asked and (lines_taken or not found);", "moves <= asked and not found;")];
    tried(&design, "engine_triangle_memory", &changes, |entity| memory(entity, 5, false));
    let fast = EngineParams { expansion_clocks: 1, ..design.params.clone() };
    let fast = EngineDesign::new(&fast, &Params::default()).unwrap();
    let changes = [("moves <= asked and (lines_taken or not found);", "moves <= asked;")];
    tried(&fast, "engine_block_memory", &changes, |entity| memory(entity, 8, false));
}
