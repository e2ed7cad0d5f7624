//! The collision engine in Verilator: answers of queries of the default scene against the reference model, with and without
//! gaps, and the clocks that they take, so that a change that makes the engine slower is noticed.

use crate::extent::in_full;
use crate::tools::made;
use efsat::artefact::Stimulus;
use efsat::engine::artefact::EngineDesign;
use efsat::engine::artefact::samples::{cuboid, hills, turn};
use efsat::engine::driver::{Objects, QueryOptions, StandIn, UnitPackets};
use efsat::engine::format::EngineFormat;
use efsat::engine::host::{Image, Images, Numbers, memory};
use efsat::engine::model::Query;
use efsat::engine::params::{EngineParams, Memory};
use efsat::engine::words::EngineReport;
use efsat::evidence::cosim::engine::{Channel, Machine, Measure, Reply, check};
use efsat::scene::{Meeting, Pose, Scene};
use nalgebra::Matrix3;

/// So many queries of the default scene, evenly spread over its 1,282.
const QUERIES: usize = 22;

/// Clocks per query of these, as `efsat cosim --engine --limit 22` says, with block RAM of 8192 lines, and with an expansion and a pair
/// per clock, when the engine was last changed on purpose.
const WITH_CACHES: f64 = 686.9;
const WITH_BLOCK_RAM: f64 = 475.4;
const PER_CLOCK: f64 = 451.8;

/// The most that they may grow, as a factor.
const SLOWER: f64 = 1.02;

fn queries(design: &EngineDesign) -> (Images, Vec<Query>) {
    let scene = Scene::default_scene();
    let numbers = Numbers::new(&design.params, &design.unit.params).unwrap();
    let images = Images::new(&scene.meshes().0, numbers).unwrap();
    let (_, sides) = memory(&images.all());
    let near = scene.near();
    let found: Vec<_> = (0..scene.frames()).flat_map(|frame| near.meetings(frame)).collect();
    let chosen = (0..QUERIES).map(|i| &found[i * found.len() / QUERIES]);
    // As `efsat cosim --engine` asks.
    let query = |meeting: &Meeting| images.query(meeting.meshes, &meeting.pose, &sides).unwrap();
    let queries = chosen.map(|meeting| Query { keep_caches: true, ..query(meeting) }).collect();
    (images, queries)
}

/// None, where a tool is missing.
fn machine(engine: &EngineParams) -> Option<Machine> {
    made(Machine::build(EngineDesign::new(engine, &engine.unit()).unwrap(), None))
}

/// Runs the queries; all have to agree with the reference model.
fn replies(machine: &Machine, queries: &[Query], images: &[&Image], channel: &Channel) -> Vec<Reply> {
    let replies = machine.run(images, queries, channel).unwrap();
    assert_eq!(replies.len(), queries.len());
    let wrong = check(machine.design(), images, queries, &replies, || ());
    assert!(wrong.is_empty(), "{channel:?}: {}", wrong.join("\n"));
    replies
}

/// Packets of pairs and poses in turn with queries, and packets that are none: words as from the reference model.
fn pairs_and_poses(machine: &Machine, channels: &[Channel]) {
    let design = machine.design();
    let unit = UnitPackets::new(&design.unit.params).unwrap();
    let meshes = [hills(6), cuboid(3, 4, 2)];
    let objects = Objects::new(&design.params, &design.unit.params, &[&meshes[0], &meshes[1]]).unwrap();
    let segments = Stimulus::random(&EngineFormat::packets(&design.unit.params), 208, 1).segments;
    let m = turn(2);
    let near = Pose::new(Matrix3::from_fn(|i, j| m[i][j]), [2.5, 1.0, -1.0].into()).unwrap();
    let query = objects.query([0, 1], &near, QueryOptions::default()).packet().unwrap().to_vec();
    let mut packets: Vec<Vec<u64>> = objects.loads().to_vec();
    for (i, (pose, pairs)) in segments.iter().enumerate() {
        let pairs = unit.pairs((0..).zip(&pairs[..1 + i % 16])).unwrap();
        let pose = unit.pose(pose).unwrap();
        packets.extend([pairs.clone(), query.clone(), pose.clone(), pairs.clone()]);
        packets.push(match i % 4 {
            0 => pairs[..pairs.len() - 1].to_vec(),
            1 => [pose.clone(), vec![0]].concat(),
            2 => pose[..2].to_vec(),
            _ => vec![pairs[0] ^ 1 << 8, 0],
        });
        packets.extend([query.clone(), query.clone(), pairs]);
    }
    let mut stand_in = StandIn::new(&objects).unwrap();
    let due: Vec<Vec<u64>> = packets.iter().map(|packet| stand_in.packet(packet)).collect();
    for channel in channels {
        let found = machine.exchange(objects.memory(), &packets, channel).unwrap();
        for (i, (due, found)) in due.iter().zip(&found).enumerate() {
            let mut words = found.words.clone();
            if packets[i][0] == query[0] {
                // Pairs in any order; of the report what does not depend on time.
                let pairs = words.len() - EngineReport::WORDS;
                words[..pairs].sort_unstable();
                words.truncate(pairs + 4);
                words[pairs] &= 0xffff_ffff;
                let mut due = due[..due.len() - 4].to_vec();
                let pairs = due.len() - 4;
                due[..pairs].sort_unstable();
                assert_eq!(words, due, "packet {i}, {channel:?}");
            } else {
                assert_eq!(&words, due, "packet {i}, {channel:?}");
            }
        }
    }
}

fn clocks_per_query(engine: &EngineParams, expected: f64, others: &[Channel]) {
    let Some(machine) = machine(engine) else { return };
    pairs_and_poses(&machine, &[&[Channel::default()][..], &in_full(others.iter().cloned())].concat());
    let (images, queries) = queries(machine.design());
    let images = images.all();
    let first = replies(&machine, &queries, &images, &Channel::default());
    for channel in in_full(others) {
        replies(&machine, &queries, &images, channel);
    }
    // The comparison notices what is wrong.
    let noticed = |change: fn(&mut Reply)| {
        let mut changed = first.clone();
        let last = changed.iter_mut().rfind(|reply| reply.answers.len() > 1).unwrap();
        change(last);
        check(machine.design(), &images, &queries, &changed, || ()).len() == 1
    };
    assert!(noticed(|reply| reply.answers.truncate(1)));
    assert!(noticed(|reply| reply.answers[0].triangles[1] ^= 1));
    assert!(noticed(|reply| reply.answers[0].verdict ^= 3));
    assert!(noticed(|reply| reply.report.tests += 1));
    assert!(noticed(|reply| reply.report.leaf_pairs += 1));
    assert!(noticed(|reply| reply.report.stack = 513));

    let found = Measure::of(machine.design(), &first).clocks_per_query();
    assert!(found <= SLOWER * expected, "{found:.1} clocks per query; expected at most {SLOWER} x {expected}");
    assert!(found >= expected / SLOWER, "{found:.1} clocks per query: better than {expected}, which is to be changed");
}

#[test]
#[ignore = "compiles an engine; the clocks of the query of a page are counted on every change: scripts/test full"]
fn queries_behind_caches_take_as_many_clocks_as_ever() {
    let gaps = |latency, seed| Channel { latency, gaps: true, seed, ..Channel::default() };
    clocks_per_query(&EngineParams::default(), WITH_CACHES, &[gaps(1..=1, 1), gaps(5..=200, 2)]);
}

#[test]
#[ignore = "the same with other memories: scripts/test full"]
fn queries_in_block_ram_take_as_many_clocks_as_ever() {
    let lines = 8192;
    let engine =
        EngineParams { memory: Memory::BlockRam, block_lines: lines, triangle_lines: lines, ..EngineParams::default() };
    clocks_per_query(&engine, WITH_BLOCK_RAM, &[Channel { gaps: true, ..Channel::default() }]);
}

#[test]
#[ignore = "the same with another engine: scripts/test full"]
fn queries_of_an_engine_with_an_expansion_per_clock_take_as_many_clocks_as_ever() {
    let engine = EngineParams {
        expansion_clocks: 1,
        memory_width: 512,
        in_flight: 64,
        pair_queue: 1024,
        block_lines: 4096,
        triangle_lines: 4096,
        ..EngineParams::default()
    };
    clocks_per_query(&engine, PER_CLOCK, &[]);
}
