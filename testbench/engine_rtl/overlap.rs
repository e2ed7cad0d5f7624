//! Queries in flight together: each is answered as if it were alone, whatever happens to the others.

use super::*;

/// Queries of every kind one behind the other, in a random order, so that each kind is beside each other one.
fn mixed(vectors: &mut EngineVectors<'_>, queries: &[Query], count: usize, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for number in 0..count as u32 {
        let query = &queries[rng.random_range(0..queries.len())];
        let mut query = Query { number: 16 + number, keep_caches: number > 0, ..query.clone() };
        match rng.random_range(0..10) {
            0 => query.first_contact = true,
            1 => query.limit = rng.random_range(1..40),
            2 => query.leaf_pairs = true,
            3 => query.all_pairs = true,
            // Trees that are none, found before the start and on the way.
            4 => query.sides[1].blocks = 0,
            5 => query.sides[0].blocks -= 8,
            6 => query.sides[1].triangles = 3,
            // A stop of the query behind this one, which has not come, ends none.
            7 => vectors.stop(0, query.number + 1),
            _ => {}
        }
        vectors.query(&query);
    }
}

/// Clocks of all reports over clocks of the run, in hundredths: how many queries are in flight on average.
fn together(report: &str) -> usize {
    100 * number(report, "clocks").unwrap() / number(report, "total").unwrap()
}

#[test]
fn queries_in_flight_together_are_answered_as_alone() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let determinants = Params { method: Method::Determinants, ..small() };
    let least: &[&str] = &["-glatency_least=1", "-glatency_most=1"];
    let cases: [(EngineParams, Params, &[&str]); 4] = [
        (EngineParams { queries: 2, ..axi() }, small(), &[]),
        (
            EngineParams { queries: 8, pair_queue: 16, in_flight: 5, ..axi() },
            determinants.clone(),
            &["-glatency_most=90"],
        ),
        (EngineParams { queries: 4, expansion_clocks: 1, ..block_ram() }, determinants, &[]),
        (EngineParams { queries: 2, expansion_clocks: 2, memory_width: 512, ..axi() }, small(), least),
    ];
    let wrong: Vec<String> = share(4, (0..).zip(cases))
        .par_iter()
        .filter_map(|(seed, (engine, unit, options))| {
            let bench = Bench::new(ghdl, engine, unit);
            let meshes = [hills(3), cuboid(3, 4, 2)];
            let images = Image::build(&meshes.each_ref(), &bench.design.format).unwrap();
            let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
            let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
            let sides = [0, 1].map(|i| (&images[i], vectors.side(i)));
            let poses = [(2, [1.5, 0.5, -1.0]), (0, [0.0, 1.0, 0.0]), (1, [2.0, -1.0, 0.5]), (0, [0.0, 0.0, 4.0])];
            let query = |(axis, t): (usize, [f64; 3])| numbers.query(sides, &turn(axis), &t).unwrap();
            let queries: Vec<Query> = poses.map(query).into();
            mixed(&mut vectors, &queries, if full() { 120 } else { 40 }, *seed);
            let report = bench.run_vectors(vectors.text(), &[&["-gpasses=1"], *options].concat());
            let mut beside = fine(&report) && together(&report) > if engine.queries == 8 { 500 } else { 110 };
            // With random stalls on all sides.
            let stalls = || bench.run_vectors(vectors.text(), &[&["-gfirst_pass=2"], *options].concat());
            beside &= !full() || fine(&stalls());
            (!beside).then(|| format!("{}:\n{report}", bench.design.command_line()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A memory that fails ends the oldest query alone; those behind it begin again.
#[test]
#[ignore = "compiles an engine; one with faults of memory runs on every change: scripts/test full"]
fn a_fault_of_memory_ends_no_younger_query() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &EngineParams { queries: 4, ..axi() }, &small());
    let image = Image::build(&[&cuboid(3, 4, 2)], &bench.design.format).unwrap().remove(0);
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let options = ["-glatency_least=40", "-glatency_most=60", "-gpasses=1", "-gpatience=2000"];
    for kind in share(3, 1..=3) {
        let mut vectors = EngineVectors::new(&bench.design, &[&image]);
        let itself = (&image, vectors.side(0));
        let query = numbers.query([itself; 2], &turn(1), &[0.5, 1.0, 1.0]).unwrap();
        vectors.fault(query.sides[0].blocks_at, kind);
        vectors.query_that_ends(&Query { number: 1, ..query.clone() }, Reason::Memory);
        for number in 2..5 {
            vectors.query(&Query { number, keep_caches: true, ..query.clone() });
        }
        bench.passes(vectors.text(), &options);
        // A younger query that read goes on without its words.
        let change = (
            "engine_control.vhd",
            "            now_started(lane) := '0';\n            now_reasons(lane) := fine;",
            "            now_reasons(lane) := fine;",
        );
        bench.notices(in_full([change]).into_iter().filter(|_| kind == 1), &[vectors.text()], &options);
    }
}
