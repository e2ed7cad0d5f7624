//! Queries that end early: by a soft reset, a stop, or a memory that fails; and what follows them.

use super::*;

/// The smallest caches, and one pair in flight: nothing takes time behind a reset but what memory still owes.
fn smallest() -> EngineParams {
    EngineParams { block_lines: 16, triangle_lines: 16, in_flight: 1, stack: 3 * 10 + 2, tree_height: 10, ..axi() }
}

/// Soft resets by the stream and by the port while memory goes on answering: one report for each, and the next query is right. The
/// memory of the testbench is not reset with the engine.
#[test]
fn a_query_after_a_soft_reset_is_right() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &smallest(), &small());
    let images = Image::build(&[&cuboid(3, 4, 2)], &bench.design.format).unwrap();
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &[&images[0]]);
    let itself = (&images[0], vectors.side(0));
    let query = numbers.query([itself; 2], &turn(1), &[0.5, 1.0, 1.0]).unwrap();
    for (i, clocks) in (0..).zip(share(2, [1, 70, 150, 290, 700, 1300])) {
        vectors.query(&Query { number: 1, ..query.clone() });
        vectors.query(&Query { number: 2, ..query.clone() });
        vectors.reset(clocks, (i % 2 == 0).then_some(i));
        vectors.query(&Query { number: 3, ..query.clone() });
        vectors.wait();
    }
    let latencies = share(4, [[160, 200], [1, 1], [60, 100], [1200, 1200]]);
    let options = |[least, most]: [u32; 2]| {
        ["-gpasses=1".to_owned(), format!("-glatency_least={least}"), format!("-glatency_most={most}")]
    };
    for latency in latencies {
        let options = options(latency);
        bench.passes(vectors.text(), &options.each_ref().map(String::as_str));
    }
    let changes = [
        // It forgets bursts; it does not say so; the caches alone hear of it.
        ("engine_read_master.vhd", "draining_now <= '1';", "draining_now <= '0';"),
        ("engine_control.vhd", "now_reasons(lane) := reason_reset;", "now_occupied(lane) := '0';"),
        ("engine_lines.vhd", "restart => restart,\n      ask_valid", "restart => reset,\n      ask_valid"),
    ];
    let options = options([160, 200]);
    bench.notices(in_full(changes), &[vectors.text()], &options.each_ref().map(String::as_str));
}

/// A memory that does not answer in time: the query ends with a reason of its own, and so do those behind it, until memory has
/// answered; a burst without a last word is never answered.
#[test]
#[ignore = "compiles an engine; one with faults of memory runs on every change: scripts/test full"]
fn a_memory_that_does_not_answer_ends_queries() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &EngineParams { watchdog: 500, ..axi() }, &small());
    let (images, query) = crossing(&bench.design);
    let images_of: Vec<&Image> = images.iter().collect();
    let options = ["-gpasses=1", "-glatency_least=5", "-glatency_most=40", "-ghang=2500"];
    let query = query(&EngineVectors::new(&bench.design, &images_of), &images);
    // The root's block of A, which every query reads; then a block of B in the midst of the query.
    let late = [query.sides[0].blocks_at, query.sides[1].blocks_at + 3].map(|at| {
        let mut vectors = EngineVectors::new(&bench.design, &images_of);
        vectors.fault(at, 4);
        vectors.query_that_ends(&Query { number: 1, ..query.clone() }, Reason::Silent);
        vectors.query_that_ends(&Query { number: 2, keep_caches: true, ..query.clone() }, Reason::Silent);
        vectors.wait();
        vectors.reset(3, Some(3));
        vectors.query_that_ends(&Query { number: 4, ..query.clone() }, Reason::Silent);
        vectors.wait();
        vectors.pause(3000);
        vectors.query(&Query { number: 5, keep_caches: true, ..query.clone() });
        vectors.text().to_owned()
    });
    for text in &late {
        bench.passes(text, &options);
    }

    let mut vectors = EngineVectors::new(&bench.design, &images_of);
    vectors.fault(query.sides[0].blocks_at, 5);
    // The word that should have been the last one tells; from then on a burst is missing.
    vectors.query_that_ends(&Query { number: 1, ..query.clone() }, Reason::Memory);
    vectors.query_that_ends(&Query { number: 2, ..query.clone() }, Reason::Silent);
    vectors.reset(900, None);
    vectors.query_that_ends(&Query { number: 3, ..query.clone() }, Reason::Silent);
    bench.passes(vectors.text(), &options);

    let changes = [
        ("engine_admission.vhd", "          if memory_silent = '1' then\n", "          if memory_silent = '0' then\n"),
        ("engine_control.vhd", "and (error_before or silent_before) and", "and error_before and"),
        (
            "engine_read_master.vhd",
            "elsif silence = watchdog - 1 then",
            "elsif silence = watchdog and reset = '1' then",
        ),
    ];
    let options = [&options[..], &["-gpatience=4500"]].concat();
    bench.notices(in_full(changes), &late.each_ref().map(String::as_str), &options);
}

/// A mesh against itself, so that the query is long when the stop comes.
#[test]
#[ignore = "compiles an engine; entities are stopped on every change: scripts/test full"]
fn a_stop_ends_the_query_that_runs() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    for engine in share(2, [axi(), block_ram()]) {
        let bench = Bench::new(ghdl, &engine, &small());
        let numbers = Numbers::new(&engine, &small()).unwrap();
        let mesh = hills(if full() { 8 } else { 4 });
        let images = Image::build(&[&mesh], &bench.design.format).unwrap();
        let mut vectors = EngineVectors::new(&bench.design, &[&images[0]]);
        let pair = (&images[0], vectors.side(0));
        let query = numbers.query([pair; 2], &turn(2), &[0.0, 0.0, 0.0]).unwrap();
        vectors.wait();
        vectors.query_that_ends(&Query { number: 5, ..query.clone() }, Reason::Stopped);
        vectors.stop(300, 5);
        vectors.wait();
        vectors.query(&Query { number: 6, ..query.clone() });
        // A stop for the query that waits leaves the one that runs; one for neither is for none.
        vectors.wait();
        vectors.query(&Query { number: 7, ..query.clone() });
        vectors.query_that_ends(&Query { number: 8, ..query.clone() }, Reason::Stopped);
        vectors.stop(300, 9);
        vectors.stop(5, 8);
        vectors.query(&Query { number: 9, ..query });
        bench.passes(vectors.text(), &["-gpasses=1"]);
        // A pair that is offered to the unit when its query ends is not dropped as well.
        let change = ("engine_triangles.vhd", "triangles_there <= there and not offered;", "triangles_there <= there;");
        let fast = in_full([change]).into_iter().filter(|_| engine.memory == Memory::BlockRam);
        bench.notices(fast, &[vectors.text()], &["-gpasses=1"]);
    }
}

#[test]
fn a_fault_of_memory_ends_the_query_and_the_next_is_right() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &axi(), &small());
    let (images, query) = crossing(&bench.design);
    for kind in share(3, 1..=3) {
        let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
        let query = query(&vectors, &images);
        // The root's block of A, which every query reads, and a triangle of B.
        vectors.fault(query.sides[0].blocks_at, kind);
        vectors.query_that_ends(&Query { number: 1, ..query.clone() }, Reason::Memory);
        vectors.query(&Query { number: 2, ..query.clone() });
        vectors.query(&Query { number: 3, keep_caches: true, ..query.clone() });
        let report = bench.run_vectors(vectors.text(), &["-glatency_least=2", "-glatency_most=40"]);
        assert!(fine(&report), "kind {kind}: {report}");
    }
}

/// Blocks damaged bit by bit: the report comes with the model's reason, nothing outside is read, the next query is right.
#[test]
#[ignore = "compiles an engine; an entity test has wrong blocks and links on every change: scripts/test full"]
fn damaged_trees_do_no_harm() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &axi(), &small());
    let (images, query) = crossing(&bench.design);
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for _ in share(8, 0..16) {
        let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
        let query = query(&vectors, &images);
        let first = 8 * query.sides[0].blocks_at as usize;
        // Links, origins, tags: the low three words of some of the blocks; others are codes, which may be anything.
        for _ in 0..3 {
            let (number, place, bit) = (rng.random_range(0..16), rng.random_range(0..3), rng.random_range(0..64));
            vectors.change(first + 8 * number + place, |word| *word ^= 1u64 << bit);
        }
        vectors.query(&Query { number: 1, ..query.clone() });
        // B against itself is whole.
        let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
        let whole = numbers.query([(&images[1], query.sides[1]); 2], &turn(0), &[0.5, 0.0, 0.0]).unwrap();
        vectors.query(&Query { number: 2, ..whole });
        bench.passes(vectors.text(), &["-gpasses=1", "-glatency_least=5", "-glatency_most=20"]);
    }
}
