//! Several engines behind one stream and one read port.

use super::*;
use efsat::engine::params::MemoryPorts;

fn engines(engines: u32) -> EngineParams {
    EngineParams { engines, ..axi() }
}

/// Everything that one engine answers, in any order; in full, mistakes in what is around the engines are noticed.
#[test]
fn several_engines_answer_as_one() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let latency = ["-glatency_least=5", "-glatency_most=60"];
    let bench = Bench::new(ghdl, &engines(2), &small());
    let others = [
        engines(2),
        EngineParams { memory_ports: MemoryPorts::Each, axi_id_bits: 2, ..engines(4) },
        EngineParams { memory_width: 512, queries: 2, axi_id_bits: 4, ..engines(3) },
        EngineParams { memory_width: 32, ..engines(5) },
    ];
    for other in in_full(others) {
        let report = Bench::new(ghdl, &other, &small()).run(&latency);
        assert!(fine(&report), "{report}");
    }
    let changes = [
        // Words of memory go to another engine.
        ("engines_memory.vhd", "<= served & request(", "<= served(0) & served(engines - 1 downto 1) & request("),
        // Words of two answers are mixed.
        ("engines_gather.vhd", "elsif gives = '1' and ends = '1' then", "elsif gives = '1' then"),
        // The report of each engine after a soft reset is answered.
        ("engines_gather.vhd", "owes <= not nobody;", "owes <= nobody;"),
    ];
    let (images, query) = crossing(&bench.design);
    let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
    let query = query(&vectors, &images);
    let segments = vectors.random_pairs(32, 3);
    // The first engine gets the third query, too.
    for number in 0..3 {
        vectors.query(&Query { number, all_pairs: true, ..query.clone() });
    }
    let itself = (&images[0], vectors.side(0));
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    // Longer answers.
    let long = numbers.query([itself; 2], &turn(2), &[0.0, 0.0, 0.0]).unwrap();
    for number in in_full(3..5) {
        vectors.query(&Query { number, all_pairs: true, ..long.clone() });
    }
    vectors.pose(&segments[0].0);
    vectors.pairs(&segments[0].1);
    for number in share(2, 5..9) {
        vectors.query(&Query { number, ..query.clone() });
    }
    vectors.reset(300, Some(9));
    vectors.query(&Query { number: 10, ..query });
    let quick = &["-gpasses=1"];
    bench.passes(vectors.text(), quick);
    bench.notices(in_full(changes), &[vectors.text()], quick);
    for own_ports in in_full([EngineParams { memory_ports: MemoryPorts::Each, ..engines(2) }]) {
        Bench::new(ghdl, &own_ports, &small()).passes(vectors.text(), quick);
    }
}

/// A mesh is written over: the one query that does not keep the caches empties those of both engines.
#[test]
#[ignore = "compiles two engines: scripts/test full"]
fn no_engine_keeps_what_was_written_over() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &engines(2), &small());
    let (images, query) = crossing(&bench.design);
    let other = Image::build(&[&cuboid(4, 1, 1)], &bench.design.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
    let query = query(&vectors, &images);
    let kept = |number| Query { number, keep_caches: true, ..query.clone() };
    // Of two at once each engine gets one.
    vectors.query(&kept(1));
    vectors.query(&kept(2));
    let (words, side) = memory(&[&other[0]]);
    let at = 8 * (query.sides[1].blocks_at - side[0].blocks_at) as usize;
    for (i, word) in words.iter().enumerate() {
        vectors.rewrite(at + i, *word);
    }
    vectors.query(&Query { number: 3, ..query.clone() });
    vectors.query(&kept(4));
    let options = ["-gpasses=1"];
    bench.passes(vectors.text(), &options);
    let change = ("engines_dispatch.vhd", "renew <= not target;", "renew <= nobody;");
    bench.notices(in_full([change]), &[vectors.text()], &options);
}

/// A fault of memory ends the query whose burst it was; after a last word that came too late, or never, no wrong word is taken.
#[test]
#[ignore = "compiles two engines: scripts/test full"]
fn a_fault_of_memory_is_for_the_engine_that_has_asked() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &EngineParams { watchdog: 1000, ..engines(2) }, &small());
    let (images, query) = crossing(&bench.design);
    let images_of: Vec<&Image> = images.iter().collect();
    let options = ["-gpasses=1", "-glatency_least=5", "-glatency_most=40", "-ghang=4000"];
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let query = query(&EngineVectors::new(&bench.design, &images_of), &images);
    for kind in share(5, 1..=5) {
        let mut vectors = EngineVectors::new(&bench.design, &images_of);
        // The other engine waits for blocks of B when this one of A, which is not the first, comes.
        let itself = (&images[1], vectors.side(1));
        let other = numbers.query([itself; 2], &turn(0), &[0.1, 0.0, 0.0]).unwrap();
        vectors.fault(query.sides[0].blocks_at + 1, kind);
        let of_all = match kind {
            1 | 2 => None,
            4 => Some(Reason::Silent),
            _ => Some(Reason::Memory),
        };
        match of_all {
            None => vectors.query(&Query { number: 1, ..other.clone() }),
            Some(reason) => vectors.query_that_ends(&Query { number: 1, ..other.clone() }, reason),
        }
        vectors.query_that_ends(
            &Query { number: 2, ..query.clone() },
            if kind == 4 { Reason::Silent } else { Reason::Memory },
        );
        vectors.wait();
        if kind == 5 {
            vectors.query_that_ends(&Query { number: 3, ..other.clone() }, Reason::Silent);
            vectors.query_that_ends(&Query { number: 4, ..query.clone() }, Reason::Silent);
        } else {
            vectors.pause(4000);
            vectors.query(&Query { number: 3, ..other.clone() });
            vectors.query(&Query { number: 4, ..query.clone() });
        }
        let report = bench.run_vectors(vectors.text(), &options);
        assert!(fine(&report), "kind {kind}: {report}");
    }
}
