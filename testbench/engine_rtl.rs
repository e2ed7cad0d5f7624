//! The collision engine in GHDL against its reference model: answers as sets, reports, every end of a query, memory with
//! latencies and gaps.

mod ends;
mod overlap;
mod several;

use crate::extent::{full, in_full, share};
use crate::tools::{Ghdl, ghdl, ghdl_of_long_runs};
use efsat::artefact::{FileSet, Prefix};
use efsat::directions::Directions;
use efsat::engine::artefact::samples::{cuboid, hills, turn};
use efsat::engine::artefact::vectors::EngineVectors;
use efsat::engine::artefact::{EngineDesign, engine_design_files, samples};
use efsat::engine::host::{Image, Numbers, memory};
use efsat::engine::model::{Model, Query};
use efsat::engine::params::{EngineParams, Memory};
use efsat::engine::words::{EngineReport, Reason};
use efsat::mesh::Mesh;
use efsat::pair::{Pair, Pose};
use efsat::params::{Guard, Method, Params, Upper};
use efsat_hardware::tools::Tool;
use nalgebra::Point3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::rc::Rc;

/// A unit that simulates fast: it has few registers.
pub(crate) fn small() -> Params {
    let method = Method::Determinants;
    Params { method, clocks_per_pair: 11, frequency: 20, width: 10, transform_width: 26, ..Params::default() }
}

fn block_ram() -> EngineParams {
    EngineParams { memory: Memory::BlockRam, block_lines: 256, triangle_lines: 256, ..EngineParams::default() }
}

/// Caches that are too small for the meshes.
pub(crate) fn axi() -> EngineParams {
    EngineParams { block_lines: 32, triangle_lines: 16, ..EngineParams::default() }
}

/// The files of a core in a folder of their own, those of a list analysed. Entities below a unit are the same in many cores; the
/// unit itself is not: its header has the command line.
pub(crate) fn analysed(ghdl: &'static Tool, files: &FileSet, list: &[&str]) -> Ghdl {
    let above = |name: &str| {
        ["engine", "efsat", "example"].iter().any(|start| name.starts_with(start)) && name != "efsat_types.vhd"
    };
    let text = |name: &&'_ str| files.get(name).unwrap();
    let stage = |is_above| list.iter().filter(|name| above(name) == is_above).map(|name| (*name, text(name))).collect();
    let ghdl = Ghdl::analysed(ghdl, &[stage(false), stage(true)]);
    let others = files.iter().filter(|(name, _)| !list.contains(name));
    others.for_each(|(name, text)| ghdl.write(name, text));
    ghdl
}

/// A generated engine in a folder of its own.
pub(crate) struct Bench {
    ghdl: Ghdl,
    pub design: Rc<EngineDesign>,
    pub files: FileSet,
}

impl Bench {
    fn new(ghdl: &'static Tool, engine: &EngineParams, unit: &Params) -> Self {
        Self::of(ghdl, EngineDesign::new(engine, unit).unwrap())
    }

    pub fn of(ghdl: &'static Tool, design: EngineDesign) -> Self {
        let vectors = samples::text(&design).unwrap();
        let files = engine_design_files(&design, &Prefix::default(), &design.command_line(), &vectors).unwrap();
        let ghdl = analysed(ghdl, &files, &files.get("files.txt").unwrap().lines().collect::<Vec<_>>());
        Self { ghdl, design: Rc::new(design), files }
    }

    /// The same with a change of a file, from one text to another.
    pub fn with(&self, change: (&str, &str, &str)) -> Self {
        let list: Vec<&str> = self.files.get("files.txt").unwrap().lines().collect();
        let (ghdl, files) = self.ghdl.changed(&self.files, &list, change);
        Self { ghdl, design: self.design.clone(), files }
    }

    /// Runs the testbench; what it says.
    pub fn run(&self, options: &[&str]) -> String {
        self.ghdl.run("efsat_engine_tb", &[&["--ieee-asserts=disable-at-0"], options].concat()).1
    }

    /// Runs it on other vectors.
    pub fn run_vectors(&self, vectors: &str, options: &[&str]) -> String {
        self.ghdl.write("other.vec", vectors);
        self.run(&[&["-gvectors=other.vec"], options].concat())
    }

    /// Nothing is wrong with other vectors; what the testbench says.
    pub fn passes(&self, vectors: &str, options: &[&str]) -> String {
        let report = self.run_vectors(vectors, options);
        assert!(fine(&report), "{options:?}: {report}");
        report
    }

    /// Nothing is wrong with these vectors, and each change of a file, from one text to another, is noticed with some of them. Where a text
    /// that is right fails, every change would seem noticed. Nothing is run where there are no changes.
    pub fn notices<'a>(
        &self,
        changes: impl IntoIterator<Item = (&'a str, &'a str, &'a str)>,
        vectors: &[&str],
        options: &[&str],
    ) {
        let passes = |change| {
            let changed = self.with(change);
            vectors.iter().all(|text| fine(&changed.run_vectors(text, options)))
        };
        let mut changes = changes.into_iter().peekable();
        if changes.peek().is_some() {
            vectors.iter().for_each(|text| drop(self.passes(text, options)));
        }
        let unnoticed: Vec<&str> = changes.filter(|change| passes(*change)).map(|(_, from, _)| from).collect();
        assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
    }
}

/// The number that follows a word of the last line.
pub(crate) fn number(report: &str, name: &str) -> Option<usize> {
    let last = report.lines().find(|line| line.contains("efsat_engine_tb: packets ") && line.contains(" total "))?;
    last.split_whitespace().skip_while(|word| *word != name).nth(1)?.parse().ok()
}

/// No difference, and nothing is made of a word that is not there.
pub(crate) fn fine(report: &str) -> bool {
    !report.contains("metavalue")
        && number(report, "mismatches") == Some(0)
        && number(report, "packets").is_some_and(|packets| packets > 0)
}

/// Two meshes that cross each other, and a query.
fn crossing(design: &EngineDesign) -> (Vec<Image>, impl Fn(&EngineVectors<'_>, &[Image]) -> Query) {
    let numbers = Numbers::new(&design.params, &design.unit.params).unwrap();
    let meshes = if full() { [hills(6), cuboid(3, 4, 2)] } else { [hills(4), cuboid(2, 3, 2)] };
    let images = Image::build(&[&meshes[0], &meshes[1]], &design.format).unwrap();
    let query = move |vectors: &EngineVectors<'_>, images: &[Image]| {
        let side = |i: usize| (&images[i], vectors.side(i));
        numbers.query([side(0), side(1)], &turn(2), &[2.5, 1.0, -1.0]).unwrap()
    };
    (images, query)
}

#[test]
fn answers_and_reports_equal_the_reference_models() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let axes = Params { width: 10, transform_width: 26, ..Params::default() };
    let determinants = Params { method: Method::Determinants, ..axes.clone() };
    let guarded = Params { guard: Guard::Always, ..small() };
    let narrow = EngineParams { stack: 3 * 10 + 2, tree_height: 10, ..block_ram() };
    let memory = |memory_width| EngineParams { memory_width, ..axi() };
    let least = "-glatency_least=1";
    let cases: [(EngineParams, Params, &[&str]); 10] = [
        (
            // In the second pass words come late, and a guard compares all numbers: no bit of a pair may come from a word that is none.
            axi(),
            guarded.clone(),
            if full() {
                &["-glatency_least=5", "-glatency_most=200", "-gseed=7"]
            } else {
                &[least, "-gfirst_pass=2", "-gpasses=2"]
            },
        ),
        (axi(), axes.clone(), &[least, "-glatency_most=1"]),
        (block_ram(), block_ram().unit(), &[]),
        (narrow, small(), &["-gpasses=1"]),
        (EngineParams { expansion_clocks: 1, ..block_ram() }, determinants.clone(), &["-gseed=3"]),
        (
            EngineParams { expansion_clocks: 2, in_flight: 5, ..memory(128) },
            Params { upper: Upper::Sticky, ..axes },
            &[],
        ),
        (EngineParams { in_flight: 1, ..memory(32) }, small(), &["-glatency_least=3", "-glatency_most=9"]),
        (EngineParams { expansion_clocks: 1, in_flight: 64, pair_queue: 16, ..memory(512) }, determinants, &[least]),
        (EngineParams { directions: Directions::Fourteen, offset_bits: 9, ..axi() }, small(), &["-gpasses=3"]),
        (EngineParams { directions: Directions::Six, factor_bits: 10, ..block_ram() }, small(), &[]),
    ];
    let wrong: Vec<String> = share(10, cases)
        .par_iter()
        .filter_map(|(engine, unit, options)| {
            let bench = Bench::new(ghdl, engine, unit);
            let report = bench.run(options);
            (!fine(&report)).then(|| format!("{} {options:?}:\n{report}", bench.design.command_line()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    if full() {
        let bench = Bench::new(ghdl, &axi(), &guarded);
        let text = bench.files.get("efsat_engine_tb.vec").unwrap().to_owned();
        let change = ("engine_command.vhd", "std_logic_vector(to_01(unsigned(head))) &", "head &");
        bench.notices([change], &[&text], &["-gfirst_pass=2", "-gpasses=2"]);
    }
}

/// A mesh is written over at its old address: the same query with the options of every host is about what is there now.
#[test]
#[ignore = "compiles an engine; triangles of one by number are written over on every change: scripts/test full"]
fn a_mesh_that_was_written_over_is_read_again() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &axi(), &small());
    let (images, query) = crossing(&bench.design);
    let other = Image::build(&[&cuboid(4, 1, 1)], &bench.design.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
    let query = query(&vectors, &images);
    vectors.query(&Query { number: 1, ..query.clone() });
    let (words, side) = memory(&[&other[0]]);
    assert_eq!((side[0].blocks, side[0].triangles), (query.sides[1].blocks, query.sides[1].triangles));
    let at = 8 * (query.sides[1].blocks_at - side[0].blocks_at) as usize;
    for (i, word) in words.iter().enumerate() {
        vectors.rewrite(at + i, *word);
    }
    vectors.query(&Query { number: 2, ..query.clone() });
    vectors.query(&Query { number: 3, keep_caches: true, ..query.clone() });
    let options = ["-gpasses=1", "-glatency_least=5", "-glatency_most=20"];
    bench.passes(vectors.text(), &options);
    // Caches that are kept hold what is not there any more.
    let change = ("engine_check.vhd", "not known or not checked(job_keep);", "not known or checked(job_keep);");
    bench.notices(in_full([change]), &[vectors.text()], &options);
}

/// Packets of pairs and poses are answered word by word as the stream wrapper does, in turn with queries, and mistakes in the text
/// are noticed.
#[test]
fn pairs_and_poses_come_in_turn_with_queries() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let bench = Bench::new(ghdl, &axi(), &Params { guard: Guard::Always, ..small() });
    let images = Image::build(&[&cuboid(2, 2, 2)], &bench.design.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &[&images[0]]);
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let itself = (&images[0], vectors.side(0));
    let query = numbers.query([itself; 2], &turn(2), &[1.5, 1.0, 0.5]).unwrap();
    let segments = vectors.random_pairs(32, 3);
    let pairs: Vec<Pair> = segments.iter().flat_map(|(_, pairs)| pairs).copied().collect();
    // As after reset; a pose between; a query's own; after one that tests no triangles.
    vectors.pairs(&pairs[..2]);
    vectors.pose(&segments[0].0);
    vectors.pairs(&pairs[..6]);
    vectors.query(&query);
    vectors.pairs(&pairs[6..9]);
    vectors.pose(&segments[1].0);
    vectors.query(&Query { leaf_pairs: true, ..query.clone() });
    vectors.pairs(&pairs[16..19]);
    vectors.unusual_pairs(&pairs[20], &segments[1].0);
    vectors.pairs(&pairs[20..23]);
    // In every lane a query has ended at a contact.
    for _ in 0..bench.design.params.queries {
        vectors.query(&Query { first_contact: true, ..query.clone() });
    }
    let unmoved = vectors.random_pairs(120, 3);
    let unmoved: Vec<Pair> = unmoved.iter().flat_map(|(_, pairs)| pairs).copied().collect();
    vectors.pose(&Pose::identity(&bench.design.unit.params));
    vectors.pairs(&unmoved);
    vectors.query(&query);
    let passes = if full() { "-gpasses=2" } else { "-gpasses=1" };
    bench.passes(vectors.text(), &["-glatency_least=2", "-glatency_most=20", passes]);
    let changes = [
        // Pairs do not wait for the query before them; a query does not wait for pairs.
        ("engine_command.vhd", " or (busy and (header.pairs));", ";"),
        ("engine_control.vhd", "job_due <= job_valid and all_idle when", "job_due <= job_valid when"),
        // The last pair of a packet is that which arrives, not that which is answered.
        ("engine_triangles.vhd", "decided_last <= tested_numbers(tag_last) and", "decided_last <= packet_last and"),
        // The options of a query stay.
        (
            "efsat_engine.vhd",
            "separate_too <= option_separate_too or not running;",
            "separate_too <= option_separate_too;",
        ),
        ("efsat_engine.vhd", "ends_at_contact <= stop_at_contact and running;", "ends_at_contact <= stop_at_contact;"),
        // A pose is taken before it is in its place; one that goes on is taken.
        ("engine_command.vhd", "if place = query_words - 2 then", "if place = query_words - 3 then"),
        (
            "engine_command.vhd",
            "occupied <= head_last;\n              moving <= head_last;",
            "occupied <= '1';\n              moving <= '1';",
        ),
        // A number that does not fit is taken.
        ("engine_command.vhd", "record_unfit <= record_unfit or word_unfit;", "record_unfit <= word_unfit;"),
    ];
    bench.notices(in_full(changes), &[vectors.text()], &["-gpasses=1"]);
}

/// Mistakes in the text, each with options that show it.
#[test]
#[ignore = "compiles an engine thirteen times: scripts/test full"]
fn a_wrong_engine_is_noticed() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let quick: &[&str] = &["-gpasses=1"];
    let slow: &[&str] = &["-gpasses=2", "-glatency_least=5", "-glatency_most=60"];
    let changes: [(&str, &str, &str, &[&str]); 12] = [
        // Flying pairs are not counted; the last survivor is not; the push order loses one.
        ("engine_survivors.vhd", "nodes_finished <= candidate and is_last;", "nodes_finished <= candidate;", quick),
        (
            "engine_survivors.vhd",
            "\"0100\" when left_over(2) = '1' else",
            "\"0110\" when left_over(2) = '1' else",
            quick,
        ),
        // A leaf beside an inner node becomes an inner node; its side is the other.
        ("engine_survivors.vhd", "side_a & not side_a;", "not side_a & side_a;", quick),
        // Inner nodes are joined as if they were leaves.
        (
            "engine_survivors.vhd",
            "next_joins_a := joins(next_leaf(3 downto 2),",
            "next_joins_a := joins(\"11\",",
            quick,
        ),
        // Links that go back are taken.
        (
            "engine_children.vhd",
            "target >= unsigned(block_count) or target <= unsigned(number)",
            "target <= unsigned(number)",
            quick,
        ),
        ("engine_children.vhd", "beyond <= '1' when target >=", "beyond <= '0' when target >=", quick),
        // Contact does not end the query; separate pairs are answered; a query's options stay from the last.
        ("engine_answer.vhd", "meets <= counts and one_contact", "meets <= '0' and one_contact", quick),
        (
            "engine_answer.vhd",
            "head_verdict /= separate or all_speak = '1' else",
            "head_verdict = head_verdict else",
            quick,
        ),
        ("engine_answer.vhd", "free <= m_axis_tready or not offered;", "free <= '1';", slow),
        // A line is given before it has come; an address waits for ready.
        (
            "engine_triangle_cache.vhd",
            "reads_line <= order_valid and not order(place_bits)",
            "reads_line <= order_valid",
            slow,
        ),
        ("engine_read_master.vhd", "m_axi_arvalid <= offered;", "m_axi_arvalid <= offered and m_axi_arready;", slow),
        // A pair that is offered goes before the unit takes it.
        (
            "engine_triangles.vhd",
            "triangles_go <= unit_ready when offered = '1' else",
            "triangles_go <= '1' when offered = '1' else",
            quick,
        ),
    ];
    // Caches of eight lines for each tree.
    let bench = Bench::new(ghdl, &EngineParams { block_lines: 16, ..axi() }, &small());
    // One of two triangles alone is near the others, so that a leaf meets an inner node without the leaf beside it.
    let apart = |x: f64| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.25]].map(Point3::from);
    let two = Mesh::new([apart(0.0), apart(6.0)].concat(), vec![[0, 1, 2], [3, 4, 5]]).unwrap();
    let images = Image::build(&[&hills(3), &cuboid(3, 4, 2), &two], &bench.design.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &images.iter().collect::<Vec<_>>());
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let sides = [0, 1, 2].map(|i| (&images[i], vectors.side(i)));
    let query = numbers.query([sides[0], sides[1]], &turn(2), &[1.5, 0.5, -1.0]).unwrap();
    let (mut cut, mut few) = (query.clone(), query.clone());
    cut.sides[0].blocks -= 8;
    few.sides[1].triangles = 3;
    let shallow = [-1.0, 5.0].map(|x| numbers.query([sides[2], sides[1]], &turn(0), &[x, -1.0, -1.0]).unwrap());
    for query in [&query, &Query { first_contact: true, ..query.clone() }, &cut, &few, &query] {
        vectors.query(query);
    }
    shallow.iter().for_each(|query| vectors.query(query));
    assert_eq!(vectors.text().matches("8f 0 ").count(), 2, "two queries end for reason 3");
    for options in [quick, slow] {
        let some = changes.iter().filter(|change| change.3 == options).map(|&(file, from, to, _)| (file, from, to));
        bench.notices(some, &[vectors.text()], options);
    }
}

/// With C = 3 H + 11, W is 10, one too few for a second pair in flight: the engine has the entries that the model has on its stack,
/// strictly depth first, and so has one that has one pair in flight, which also waits for its leaf pairs. With a place more it is
/// faster. So a rule that lets a pair go too early, or another order of pushes, is noticed.
#[test]
#[ignore = "compiles an engine; an entity test counts places on every change: scripts/test full"]
fn the_rule_of_the_stack_is_exact() {
    let Some(ghdl) = ghdl() else { return };
    let (height, unit) = (10, small());
    let bench = |over: u32, in_flight: u32| {
        let stack = 3 * height + over;
        Bench::new(ghdl, &EngineParams { tree_height: height, stack, in_flight, ..block_ram() }, &unit)
    };
    let narrow = bench(11, 16);
    let images = Image::build(&[&cuboid(3, 4, 2)], &narrow.design.format).unwrap();
    let mut vectors = EngineVectors::new(&narrow.design, &[&images[0]]);
    let numbers = Numbers::new(&narrow.design.params, &unit).unwrap();
    let itself = (&images[0], vectors.side(0));
    let queries = [numbers.query([itself; 2], &turn(1), &[0.5, 1.0, 1.0]).unwrap()];
    queries.iter().for_each(|query| vectors.query(query));
    let model = Model::new(&narrow.design.params, &unit).unwrap();
    let (memory, _) = memory(&images.iter().collect::<Vec<_>>());
    let stack = |query: &Query| usize::from(model.run(&memory, &query.words(model.format())).report.stack);
    let greatest = queries.iter().map(stack).max().unwrap();

    let options = ["-gpasses=1"];
    let counts = |report: &str| fine(report).then(|| [number(report, "clocks"), number(report, "stack")]);
    let due = counts(&narrow.run_vectors(vectors.text(), &options)).expect("no mismatch");
    assert_eq!(due[1], Some(greatest));
    let one = counts(&bench(11, 1).run_vectors(vectors.text(), &options)).expect("no mismatch");
    assert!(one[1] == due[1] && one[0] >= due[0], "{one:?}; expected {due:?} and no fewer clocks");
    let [wider, _] = counts(&bench(12, 16).run_vectors(vectors.text(), &options)).expect("no mismatch");
    assert!(wider < due[0], "{wider:?} clocks; expected fewer than {due:?}");

    let (lane, survivors) = ("engine_lane.vhd", "engine_survivors.vhd");
    let order = "\"1000\" when left_over(3) = '1' else\n    \"0100\" when left_over(2) = '1' else\n    \"0010\" when \
                 left_over(1) = '1' else";
    let changes = [
        // W too large by one.
        (lane, "to_signed(wide - 6, ", "to_signed(wide - 5, "),
        // Pairs in flight are not counted.
        (lane, "(freed - 3)", "(freed + 1)"),
        // Both left children are pushed first, and popped last.
        (
            survivors,
            order,
            "\"0001\" when left_over(0) = '1' else\n    \"0010\" when left_over(1) = '1' else\n    \"0100\" when \
             left_over(2) = '1' else",
        ),
        // Of an inner node one child alone is meant.
        (survivors, "downto 0) & \"11\" when child_a(29)", "downto 0) & \"01\" when child_a(29)"),
    ];
    let unnoticed: Vec<&str> = share(4, changes)
        .into_iter()
        .filter(|change| counts(&narrow.with(*change).run_vectors(vectors.text(), &options)) == Some(due))
        .map(|(_, _, to)| to)
        .collect();
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
}

/// Queries about objects that the caches hold read nothing; what is emptied, or another object, is read again.
#[test]
#[ignore = "compiles an engine; the cache alone is tried on every change: scripts/test full"]
fn caches_are_emptied() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    // Every block and triangle has a line of its own.
    let bench = Bench::new(ghdl, &EngineParams { triangle_lines: 32, ..axi() }, &small());
    let images = Image::build(&[&cuboid(3, 4, 2), &cuboid(2, 2, 2)], &bench.design.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &[&images[0], &images[1]]);
    let numbers = Numbers::new(&bench.design.params, &bench.design.unit.params).unwrap();
    let sides = [0, 1].map(|i| (&images[i], vectors.side(i)));
    let query = numbers.query(sides, &turn(2), &[2.5, 1.0, 1.0]).unwrap();
    let reversed = numbers.query([sides[1], sides[0]], &turn(0), &[1.0, -1.0, -1.0]).unwrap();
    let kept = Query { keep_caches: true, ..query.clone() };
    let reversed = Query { keep_caches: true, ..reversed };
    // The first one after reset has nothing to keep.
    for query in [&kept, &kept, &query, &reversed, &kept] {
        vectors.query(query);
    }
    let options = ["-gpasses=1", "-glatency_least=5", "-glatency_most=9", "-ganswers=answers.txt"];
    // Blocks and triangles read from memory, by query.
    let reads = |bench: &Bench| -> Option<Vec<[u32; 2]>> {
        let report = bench.run_vectors(vectors.text(), &options);
        let text = bench.ghdl.read("answers.txt");
        // A word and its TLAST in a line.
        let word = |line: &str| u64::from_str_radix(line.split_whitespace().next()?, 16).ok();
        let words: Vec<u64> = text.lines().filter_map(word).collect();
        let mut reads = vec![];
        let mut at = 0;
        while let Some(word) = words.get(at) {
            let report = words.get(at..at + EngineReport::WORDS)?;
            if word & 3 == 3 {
                reads.push([4, 5].map(|place| (report[place] >> 32) as u32));
                at += EngineReport::WORDS;
            } else {
                at += 1;
            }
        }
        fine(&report).then_some(reads)
    };
    let due = reads(&bench).expect("no mismatch");
    let [cold, warm, emptied, _, again] = due[..] else { panic!("{due:?}") };
    assert!(cold.iter().all(|&count| count > 5) && warm == [0, 0], "{due:?}");
    assert_eq!([emptied, again], [cold; 2], "{due:?}");

    let changes = [
        // No cache is told; a cache does not listen; other objects are not noticed.
        ("engine_admission.vhd", "flush_now <= '1';", "flush_now <= '0';"),
        ("engine_block_cache.vhd", "sweeps <= '1' when flush = '1' or (", "sweeps <= '1' when ("),
        ("engine_triangle_cache.vhd", "sweeps <= '1' when flush = '1' or (", "sweeps <= '1' when ("),
        // A request does not see that one before it asks for the same line.
        ("engine_block_cache.vhd", "if looked = '1' and looked_at(", "if looked = '0' and looked_at("),
        ("engine_block_cache.vhd", "if judged = '1' and judged_at(", "if judged = '0' and judged_at("),
    ];
    let unnoticed: Vec<&str> = in_full(changes)
        .into_iter()
        .filter(|change| reads(&bench.with(*change)) == Some(due.clone()))
        .map(|(file, _, _)| file)
        .collect();
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
}

/// Levels beyond the greatest are refused: a tree that is higher than the engine is made for.
#[test]
#[ignore = "compiles an engine; an entity test has trees that are too high on every change: scripts/test full"]
fn a_tree_that_is_too_high_is_refused() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let large = EngineParams { block_lines: 512, triangle_lines: 512, ..block_ram() };
    let tall = EngineDesign::new(&large, &small()).unwrap();
    // As high as the meshes of the generated testbench.
    let height = Image::build(&[&hills(6)], &tall.format).unwrap()[0].header().height;
    let bench = Bench::new(ghdl, &EngineParams { tree_height: height, ..large }, &small());
    let images = Image::build(&[&hills(12)], &tall.format).unwrap();
    let mut vectors = EngineVectors::new(&bench.design, &[&images[0]]);
    let numbers = Numbers::new(&tall.params, &tall.unit.params).unwrap();
    let pair = (&images[0], vectors.side(0));
    let query = numbers.query([pair; 2], &turn(2), &[0.0, 0.0, 0.0]).unwrap();
    vectors.query(&Query { number: 5, ..query });
    assert!(vectors.text().contains("R 0000058f 0 "), "reason 3");
    bench.passes(vectors.text(), &["-gpasses=1"]);
}
