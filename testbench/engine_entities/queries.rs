//! The words of the queries in flight: what each reader gets from its lane.

use super::*;
use efsat::engine::format::EngineFormat;
use efsat::engine::words::QueryFlags;

const LANES: usize = 4;

/// Both halves of a word.
fn halves(word: u64) -> [u64; 2] {
    [word & 0xffff_ffff, word >> 32]
}

/// So many bits of a row of words.
fn bits(words: &[u64], low: usize, count: usize) -> u64 {
    (0..count).fold(0, |value, i| value | (words[(low + i) / 64] >> ((low + i) % 64) & 1) << i)
}

/// Words of a job.
fn job(rng: &mut ChaCha8Rng, length: usize) -> Vec<u64> {
    let mut words: Vec<u64> = (0..length).map(|_| rng.random()).collect();
    // Entries of the matrix that fit, and some that do not.
    for word in &mut words[6..12] {
        if seldom(rng, 2) {
            *word = (*word & 0x1fff_ffff_1fff_ffff) ^ if seldom(rng, 2) { 0xf000_0000_f000_0000 } else { 0 };
        }
    }
    // One below the least, with digits that are cut off.
    if seldom(rng, 3) {
        words[8] = 0xf000_0000_f000_07ff;
    }
    words
}

/// What the volume unit knows of a query.
fn volume(entity: &Entity, words: &[u64], format: &EngineFormat, clock: usize) -> Outcome {
    let number = |i: usize| i64::from(halves(words[7 + i / 2])[i % 2] as u32 as i32);
    let (pose, shift, rows) = (entity.words("query_pose"), entity.words("query_shift"), entity.words("query_rows"));
    let most = (1 << (format.origin_bits - 1)) - 1;
    let width = format.origin_bits as usize;
    for i in 0..9 {
        let entry = (number(i) >> format.matrix_shift()).clamp(-most, most);
        expect(bits(&pose, width * i, width) == entry as u64 & ((1 << width) - 1), clock, "query_pose")?;
    }
    let width = 32 - format.translation_shift() as usize;
    for i in 0..3 {
        let due = number(9 + i) >> format.translation_shift();
        expect(bits(&shift, width * i, width) == due as u64 & ((1 << width) - 1), clock, "query_shift")?;
    }
    let width = (format.rest_at() + format.rest_bits()) as usize;
    for i in 0..format.rows() as usize {
        let row = words[13 + i] & ((1 << width) - 1);
        expect(bits(&rows, width * i, width) == row, clock, "query_rows")?;
    }
    expect(entity.get("query_errors") == words[5] & 0xffff_ffff_ffff, clock, "query_errors")
}

/// Paced: what the volume unit knows is written and read a clock later.
fn queries(entity: &mut Entity, format: &EngineFormat, paced: bool) -> Outcome {
    let mut rng = random(13);
    let length = (format.query_words() - 1) as usize;
    let mut held = vec![vec![0; length]; LANES];
    let mut leaves = [false; LANES];
    // What control and the traversal have read in the clock before.
    let mut checked_before: Option<Vec<u64>> = None;
    let mut listed_before: Option<Vec<u64>> = None;
    // The volume unit's lane comes a clock before its words, and a query is written for it a clock after it is stored.
    let (mut row, mut written) = (0, false);
    let mut words = job(&mut rng, length);
    entity.reset();
    for clock in 0..2000 {
        let readers = ["checked_lane", "request_lane", "volume_lane", "front", "oldest"];
        let lanes = readers.map(|port| {
            let lane = rng.random_range(0..LANES);
            entity.set(port, lane as u64);
            lane
        });
        let [checked, requested, of_volume, front, oldest] = lanes;
        let (write, lane, query, retire) =
            (!written && seldom(&mut rng, 4), rng.random_range(0..LANES), !seldom(&mut rng, 3), seldom(&mut rng, 4));
        if !paced {
            (row, written) = (of_volume, write);
        }
        // They are there a clock before, and a clock longer.
        if !written && !write {
            words = job(&mut rng, length);
        }
        entity.set_words("job_words", &words);
        for (port, value) in [
            ("store", write.into()),
            ("store_lane", lane as u64),
            ("job_query", query.into()),
            ("retire", retire.into()),
        ] {
            entity.set(port, value);
        }
        entity.settle();
        let same = |port: &str, due: u64| expect(entity.get(port) == due, clock, port);
        // While a job is stored control reads nothing, and while it is written the volume unit does not.
        same("written", written.into())?;
        if let Some(checked) = &checked_before {
            expect(entity.words("checked") == checked[..5], clock, "checked")?;
        }
        if let Some(listed) = &listed_before {
            for (name, word) in [("block_count", 2), ("triangle_count", 3)] {
                let [a, b] = halves(listed[word]);
                same(&format!("{name}_a"), a)?;
                same(&format!("{name}_b"), b)?;
            }
        }
        if !written {
            volume(entity, &held[row], format, clock)?;
        }
        // Triangles in block RAM are behind bit 31 of a byte address.
        let triangles = if paced { 0 } else { 1 << 25 };
        for (name, lane, word, flipped) in [("block_base", requested, 0, 0), ("triangle_base", front, 1, triangles)] {
            let [a, b] = halves(held[lane][word]);
            same(&format!("{name}_a"), a ^ flipped)?;
            same(&format!("{name}_b"), b ^ flipped)?;
        }
        expect(entity.words("pose") == held[front][6..13], clock, "pose")?;
        let options = held[oldest][4];
        same("stop_at_contact", options >> QueryFlags::FIRST_CONTACT & 1)?;
        same("separate_too", options >> QueryFlags::ALL_PAIRS & 1)?;
        let due = (0..).zip(leaves).map(|(lane, leaves)| u64::from(leaves) << lane).sum();
        same("leaves_only", due)?;
        entity.clock();
        checked_before = (!write).then(|| held[checked].clone());
        listed_before = (!written).then(|| held[row].clone());
        if paced {
            (row, written) = (of_volume, write);
        }
        if retire {
            leaves[oldest] = false;
        }
        if write {
            leaves[lane] = query && words[4] >> QueryFlags::LEAF_PAIRS & 1 == 1;
            held[lane].clone_from(&words);
        }
    }
    Ok(())
}

#[test]
fn every_reader_gets_the_words_of_its_lane() {
    let changes = [
        ("above /= \"1111\" or cut = \"100000000000000000\"", "above /= \"1111\""),
        ("block_bases(to_integer(unsigned(request_lane)));", "block_bases(to_integer(unsigned(front)));"),
        (
            "listed <= object_counts(to_integer(unsigned(volume_row)));",
            "listed <= object_counts(to_integer(unsigned(front)));",
        ),
        (
            "& job_words(job_block_count_b) & job_words(job_block_count_a);",
            "& job_words(job_block_count_a) & job_words(job_block_count_b);",
        ),
        ("triangle_bases(to_integer(unsigned(front)));", "triangle_bases(to_integer(unsigned(oldest)));"),
        ("if writes = '1' then", "if store = '1' then"),
        ("        volume_row <= store_lane;", "          null;"),
        ("<= new_options(option_contact);", "<= new_options(option_separate);"),
        ("query_rows <= row(to_integer(unsigned(volume_row)));", "query_rows <= row(to_integer(unsigned(oldest)));"),
        ("<= new_options(option_leaves) and job_query;", "<= new_options(option_leaves);"),
        ("          leaves(lane) <= '0';", "          null;"),
    ];
    for (memory, changes) in [(Memory::Axi, &changes[..]), (Memory::BlockRam, &[])] {
        let engine = EngineParams { queries: LANES as u32, ..small(memory).params };
        let design = EngineDesign::new(&engine, &Params::default()).unwrap();
        tried(&design, "engine_queries", changes, |entity| queries(entity, &design.format, memory == Memory::Axi));
    }
}
