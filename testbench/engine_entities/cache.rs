//! A cache against a direct-mapped one without time: which lines are read, and what every request gets.

use super::*;
use std::collections::VecDeque;

/// Lines of a cache of one tree.
const LINES: u64 = 16;

/// Word `i` of the line at an address.
fn word(address: u64, i: u64) -> u64 {
    (8 * address + i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

fn cache(entity: &mut Entity, words: u64) -> Outcome {
    let mut rng = random(5);
    let (mut clock, mut base) = (0, 0);
    entity.reset();
    for round in 0..8u64 {
        // Forgotten: the reset at first, then a flush.
        entity.set("flush", u64::from(round > 0));
        entity.settle();
        entity.clock();
        entity.set("flush", 0);
        // What was forgotten is asked for again.
        if round % 2 == 0 {
            base = rng.random_range(0..1000);
        }
        entity.set("base", base);
        let mut there: Vec<Option<u64>> = vec![None; LINES as usize];
        let (mut asks, mut misses, mut seen) = (VecDeque::new(), 0, 0);
        let mut due: VecDeque<u64> = VecDeque::new();
        let mut fills: VecDeque<(usize, u64, u64)> = VecDeque::new();
        let (latency, eager) = ([1, 60, 5, 20][round as usize % 4], round < 4);
        let mut to_ask = 300;
        while to_ask > 0 || !due.is_empty() || !fills.is_empty() {
            clock += 1;
            expect(clock < 60_000, clock, "lines do not come")?;
            // Near one another, so that some are there and some share a place.
            let among = if seldom(&mut rng, 3) { 40 } else { 8 };
            let request = rng.random_range(0..among);
            let offers = to_ask > 0 && (eager || !seldom(&mut rng, 3));
            let takes_address = eager || seldom(&mut rng, 2);
            let fill = fills.front().copied().filter(|(at, ..)| *at <= clock && (eager || seldom(&mut rng, 2)));
            entity.set("request_valid", offers.into());
            entity.set("request", request);
            entity.set("ask_ready", takes_address.into());
            entity.set("fill_valid", fill.is_some().into());
            entity.set("fill_data", fill.map_or(0, |(_, address, i)| word(address, i)));
            entity.set("line_taken", 0);
            entity.settle();
            if entity.is("line_valid") && (eager || seldom(&mut rng, 2)) {
                let address = due.pop_front().ok_or(format!("clock {clock}: a line that nobody asked for"))?;
                let line: Vec<u64> = (0..words).map(|i| word(address, i)).collect();
                expect(entity.words("data") == line, clock, "another line is due")?;
                entity.set("line_taken", 1);
                entity.settle();
            }
            if fill.is_some() {
                fills.pop_front();
            }
            seen += u32::from(entity.is("missed"));
            if entity.is("ask_valid") && takes_address {
                let address = asks.pop_front().ok_or(format!("clock {clock}: a line too many is read"))?;
                expect(entity.get("ask_address") == address, clock, "another line is to be read")?;
                fills.extend((0..words).map(|i| (clock + latency, address, i)));
            }
            if offers && entity.is("request_ready") {
                let address = base + request;
                let place = &mut there[(address % LINES) as usize];
                if *place != Some(address) {
                    *place = Some(address);
                    asks.push_back(address);
                    misses += 1;
                }
                due.push_back(address);
                to_ask -= 1;
            }
            entity.clock();
        }
        expect(asks.is_empty() && seen == misses, clock, "misses are counted otherwise")?;
        expect((50..280).contains(&misses), clock, "hits and misses")?;
    }
    Ok(())
}

#[test]
fn caches_give_and_replace_lines() {
    let design = small(Memory::Axi);
    let changes = [
        ("reads_line <= order_valid and not order(place_bits)", "reads_line <= order_valid"),
        ("order(place_bits) <= '0';", "null;"),
        // Words of a line in one place, or a line that ends too soon.
        ("at_word((i + 1) mod words_per_line) <= at_word(i);", "null;"),
        ("writes and at_word(words_per_line - 1);", "writes and at_word(words_per_line - 2);"),
        ("if judged = '1' and judged_at(", "if judged = '0' and judged_at("),
        // A tag is read in the clock in which it is written.
        ("not (sweeping or missed_before) and", "not sweeping and"),
        ("may_pass <= order_free and not (asking or", "may_pass <= order_free and not ("),
        ("if looked = '1' and looked_at(", "if looked = '0' and looked_at("),
        ("same = all_same or same_as_before = '1' else", "same = all_same else"),
        ("same(tag_parts) <= tag_found(tag_bits) and not follows;", "same(tag_parts) <= tag_found(tag_bits);"),
        ("sweeps <= '1' when flush = '1' or (", "sweeps <= '1' when ("),
        ("order_leaves <= reads_line or not order_valid;", "order_leaves <= reads_line;"),
    ];
    tried(&design, "engine_block_cache", &changes, |entity| cache(entity, 8));
    tried(&design, "engine_triangle_cache", &[], |entity| cache(entity, 5));
}
