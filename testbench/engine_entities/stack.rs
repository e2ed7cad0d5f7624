//! The stack against a vector.

use super::*;

/// Pushes, pops, both in one clock and clears, in runs that fill and empty it; what is on top, whether anything is, whether
/// three are, and the greatest number of entries.
fn stack(entity: &mut Entity) -> Outcome {
    let mut rng = random(1);
    let mut entries: Vec<u64> = vec![];
    let (mut most, mut fills) = (0, true);
    entity.set("clear", 1);
    entity.settle();
    entity.clock();
    for clock in 0..3000 {
        if seldom(&mut rng, 30) {
            fills = !fills;
        }
        let clear = seldom(&mut rng, 300);
        let often = |rng: &mut ChaCha8Rng, much: bool| seldom(rng, 4) != much;
        let pop = !entries.is_empty() && often(&mut rng, !fills);
        let push = (entries.len() < 40 || pop) && often(&mut rng, fills);
        let entry = rng.random::<u64>() >> 8;
        for (port, value) in
            [("clear", clear.into()), ("pop", pop.into()), ("push", push.into()), ("push_entry", entry)]
        {
            entity.set(port, value);
        }
        entity.settle();
        expect(entity.is("filled") != entries.is_empty(), clock, "filled")?;
        expect(entity.is("many") == (entries.len() >= 3), clock, "many")?;
        let top = entity.get("top_entry");
        expect(entries.last().is_none_or(|&last| last == top), clock, "top_entry")?;
        expect(entity.get("greatest") == most, clock, "greatest")?;
        // The greatest is a clock behind.
        most = most.max(entries.len() as u64);
        if pop {
            entries.pop();
        }
        if push {
            entries.push(entry);
        }
        if clear {
            entries.clear();
            most = 0;
        }
        entity.clock();
    }
    Ok(())
}

#[test]
fn the_stack_is_a_stack() {
    let changes = [
        ("third <= pushed_over when last_was_push = '1' else remembered;", "third <= remembered;"),
        ("second_pushed when last_was_push = '1' else second_popped;", "second_popped;"),
        ("second_pushed when last_was_push = '1' else second_popped;", "second_pushed;"),
        ("push_place <= push_place - 1;", "push_place <= push_place;"),
        ("filled_now <= several;", "filled_now <= many_now;"),
        ("many_now <= four;", "many_now <= '0';"),
        ("if used = 4 then", "if used = 5 then"),
        ("four <= many_now;", "four <= several;"),
        ("elsif pop = '1' then\n        top", "elsif shrinks = '0' then\n        top"),
    ];
    tried(&small(Memory::Axi), "engine_stack", &changes, stack);
}
