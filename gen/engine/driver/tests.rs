//! The driver of the engine against brute force with the exact oracle, with the stand-in as the engine: every way in which a
//! query can end.

use super::*;
use crate::artefact::samples::{cuboid, hills, turn};
use crate::host::Refusal;
use crate::model::Query;
use crate::params::{EngineParams, Memory};
use crate::words::{Command, EngineAnswer as Answered, EngineReport, Reason};
use efsat_geometry::exact::{Exact, posed_pair};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::Pose;
use efsat_unit::artefact::Stimulus;
use efsat_unit::golden::Golden;
use efsat_unit::host::driver::UnitAnswer;
use efsat_unit::pair::Verdict;
use efsat_unit::params::{Method, Params, Upper};
use efsat_unit::words::StreamReport;
use nalgebra::Matrix3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

fn pose(axis: usize, translation: [f64; 3]) -> Pose {
    let m = turn(axis);
    Pose::new(Matrix3::from_fn(|i, j| m[i][j]), translation.into()).unwrap()
}

/// All pairs that touch, by brute force.
fn touching(a: &Mesh, b: &Mesh, pose: &Pose) -> Vec<([u32; 2], Exact)> {
    let corners = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
    let all = (0..a.faces().len() as u32).flat_map(|p| (0..b.faces().len() as u32).map(move |q| [p, q]));
    let exact = |[p, q]: [u32; 2]| {
        posed_pair(&corners(a, p), &corners(b, q), &pose.rows(), &pose.translation().into()).unwrap()
    };
    all.map(|pair| (pair, exact(pair))).filter(|(_, exact)| *exact != Exact::Separate).collect()
}

fn block_ram() -> EngineParams {
    EngineParams { memory: Memory::BlockRam, block_lines: 128, triangle_lines: 128, ..EngineParams::default() }
}

/// Two meshes and the poses in which they cross, touch with a face and are apart.
struct Case {
    meshes: [Mesh; 2],
    poses: Vec<Pose>,
}

impl Case {
    fn new() -> Self {
        let resting = Pose::new(Matrix3::identity(), [1.0, 1.0, 0.0].into()).unwrap();
        let crossing = pose(2, [2.5, 1.0, -1.0]);
        let poses = vec![crossing, pose(0, [-1.0, 2.0, 0.5]), resting, pose(1, [0.0, 0.0, 9.0])];
        Self { meshes: [hills(6), cuboid(3, 4, 2)], poses }
    }

    fn objects(&self, engine: &EngineParams, unit: &Params) -> Objects<'_> {
        Objects::new(engine, unit, &[&self.meshes[0], &self.meshes[1]]).unwrap()
    }

    /// The default engine, and the answer to the crossing pose by brute force.
    fn crossing(&self) -> (Objects<'_>, Pose, Vec<([u32; 2], Exact)>) {
        let objects = self.objects(&EngineParams::default(), &Params::default());
        (objects, self.poses[0], touching(&self.meshes[0], &self.meshes[1], &self.poses[0]))
    }
}

/// The pairs that touch, each with its exact answer.
fn exact(contacts: &Contacts) -> Vec<([u32; 2], Exact)> {
    let all = contacts.pairs.iter().map(|pair| (pair.triangles, pair.exact));
    all.filter(|(_, exact)| *exact != Exact::Separate).collect()
}

/// Answers in another order, as several engines give them.
struct Reversed(StandIn);

impl Engine for Reversed {
    type Error = EngineError;

    fn answer(&mut self, packets: &[&[u64]]) -> Result<Vec<Vec<u64>>, EngineError> {
        Ok(packets.iter().rev().map(|packet| self.0.packet(packet)).collect())
    }
}

#[test]
fn final_answers_are_exact() {
    let case = Case::new();
    let units = [
        Params::default(),
        Params { upper: Upper::Sticky, ..Params::default() },
        Params { width: 10, ..Params::default() },
        Params::of(Method::Determinants),
    ];
    let (mut retested, mut touches, mut named) = (0, 0, 0);
    for (unit, engine) in units.iter().flat_map(|unit| [(unit, EngineParams::default()), (unit, block_ram())]) {
        let objects = case.objects(&engine, unit);
        let mut stand_in = StandIn::new(&objects).unwrap();
        let pairs = [[0, 1], [1, 0], [0, 0], [1, 1]];
        let asked: Vec<_> = pairs.iter().flat_map(|pair| case.poses.iter().map(move |pose| (*pair, pose))).collect();
        let jobs = asked.iter().map(|(pair, pose)| objects.query(*pair, pose, QueryOptions::default()));
        let jobs: Vec<_> = jobs.collect();
        let answers = objects.contacts(jobs.clone(), &mut stand_in).unwrap();
        assert_eq!(objects.contacts(jobs, &mut Reversed(stand_in)).unwrap(), answers);
        for (([a, b], pose), contacts) in asked.iter().zip(&answers) {
            assert_eq!(exact(contacts), touching(&case.meshes[*a], &case.meshes[*b], pose), "{pose:?}");
            assert_eq!(contacts.software, None);
            let count = |of: Verdict| contacts.pairs.iter().filter(|pair| pair.verdict == Some(of)).count();
            assert_eq!(count(Verdict::Intersect) + count(Verdict::PossiblyIncorrect), contacts.pairs.len());
            let report = contacts.report.unwrap();
            assert_eq!(count(Verdict::Intersect), report.intersect as usize);
            retested += count(Verdict::PossiblyIncorrect);
            touches += contacts.touching().count();
            named += contacts.pairs.len();
        }
    }
    assert!(touches > 1_000 && retested > 500 && named > touches, "{touches} of {named} touch, {retested} retested");
}

/// A query that ends with one of the reasons for which pairs may be missing, by what causes it where the model knows it, is
/// answered in software.
#[test]
fn incomplete_queries_are_answered_in_software() {
    let case = Case::new();
    let (objects, pose, expected) = case.crossing();
    let format = *objects.numbers().format();
    let job = |limit, first_contact| {
        objects.query([0, 1], &pose, QueryOptions { limit, first_contact, ..QueryOptions::default() })
    };
    let fair = StandIn::new(&objects).unwrap();
    let mut damaged = fair.clone();
    // The tag of the root's block.
    damaged.memory_mut()[8 + 1] ^= 1 << 60;
    for (i, first_contact) in Reason::ALL[2..].iter().enumerate().flat_map(|(i, _)| [(i, false), (i, true)]) {
        let reason = Reason::ALL[2 + i];
        let job = job(if reason == Reason::Limit { 5 } else { 0 }, first_contact);
        let mut packet = job.packet().unwrap().to_vec();
        assert_eq!(format.header(Command::Query), packet[0]);
        let mut stand_in = if reason == Reason::BadTree { damaged.clone() } else { fair.clone() };
        match reason {
            Reason::Memory => packet[1] |= 1 << 25,
            Reason::UnknownHeader => packet[0] ^= 1 << 40,
            Reason::TooShort => _ = packet.pop(),
            Reason::TooLong => packet.push(0),
            _ => {}
        }
        // What ends by time or by the host has no words of its own in the stand-in.
        let ended = EngineReport { reason, number: job.number(), expansions: 1, ..EngineReport::default() };
        let words = match reason {
            Reason::Stopped | Reason::Silent | Reason::Reset => ended.words().to_vec(),
            _ => stand_in.packet(&packet),
        };
        let contacts = job.finish(&words).unwrap();
        assert_eq!(contacts.software, Some(Cause::Incomplete(reason)));
        assert!(contacts.pairs.iter().all(|pair| pair.verdict.is_none()));
        match first_contact {
            false => assert_eq!(exact(&contacts), expected, "{reason:?}"),
            true => assert!(contacts.pairs.len() == 1 && expected.contains(&exact(&contacts)[0]), "{reason:?}"),
        }
    }
}

/// What the words of a query do not hold is not sent.
#[test]
fn queries_that_the_engine_cannot_answer_are_answered_in_software() {
    let case = Case::new();
    let low = EngineParams { tree_height: 3, ..EngineParams::default() };
    let objects = case.objects(&low, &Params::default());
    let job = objects.query([0, 1], &case.poses[0], QueryOptions::default());
    assert_eq!(job.packet(), None);
    assert_eq!(job.clone().finish(&[0; 8]), Err(EngineError::NotSent));
    let contacts = job.finish(&[]).unwrap();
    assert!(matches!(contacts.software, Some(Cause::Refused(Refusal::Height { side: 'A', most: 3, .. }))));
    assert_eq!(exact(&contacts), touching(&case.meshes[0], &case.meshes[1], &case.poses[0]));

    // Twice as large, and far away.
    let objects = case.objects(&EngineParams::default(), &Params::default());
    let double = Pose::new(Matrix3::identity() * 2.0, case.poses[0].translation()).unwrap();
    let far = Pose::new(case.poses[0].rotation(), [1e9, 0.0, 0.0].into()).unwrap();
    for (pose, meet) in [(double, true), (far, false)] {
        let contacts = objects.query([0, 1], &pose, QueryOptions::default()).finish(&[]).unwrap();
        assert!(matches!(contacts.software, Some(Cause::Refused(Refusal::Entry { .. } | Refusal::Translation { .. }))));
        assert_eq!(exact(&contacts), touching(&case.meshes[0], &case.meshes[1], &pose));
        assert_eq!(!contacts.pairs.is_empty(), meet);
    }
}

#[test]
fn the_first_contact_is_one_pair_or_none() {
    let case = Case::new();
    let objects = case.objects(&EngineParams::default(), &Params::default());
    let mut stand_in = StandIn::new(&objects).unwrap();
    let options = QueryOptions { first_contact: true, ..QueryOptions::default() };
    let mut ends = vec![];
    for (pair, pose) in [[0, 1], [1, 1]].into_iter().flat_map(|pair| case.poses.iter().map(move |pose| (pair, pose))) {
        let job = objects.query(pair, pose, options);
        let contacts = objects.contacts(vec![job], &mut stand_in).unwrap().remove(0);
        let expected = touching(&case.meshes[pair[0]], &case.meshes[pair[1]], pose);
        assert_eq!(contacts.pairs.len(), usize::from(!expected.is_empty()));
        assert!(exact(&contacts).iter().all(|contact| expected.contains(contact)));
        ends.push((contacts.report.unwrap().reason, expected.is_empty()));
    }
    // A contact that is certain, one that only the retest finds, and none.
    for end in [(Reason::Contact, false), (Reason::Complete, false), (Reason::Complete, true)] {
        assert!(ends.contains(&end), "{end:?} in {ends:?}");
    }
}

/// An engine that stops at a contact though all are asked for has not answered.
#[test]
fn a_contact_is_no_list() {
    let case = Case::new();
    let (objects, pose, expected) = case.crossing();
    let first = objects.query([0, 1], &pose, QueryOptions { first_contact: true, ..QueryOptions::default() });
    let mut words = StandIn::new(&objects).unwrap().packet(first.packet().unwrap());
    let all = objects.query([0, 1], &pose, QueryOptions::default());
    let head = words.len() - EngineReport::WORDS;
    words[head] ^= u64::from(first.number() ^ all.number()) << EngineReport::NUMBER_AT;
    let contacts = all.finish(&words).unwrap();
    assert_eq!(contacts.software, Some(Cause::Incomplete(Reason::Contact)));
    assert_eq!(exact(&contacts), expected);
}

#[test]
fn answers_that_do_not_fit_are_refused() {
    let case = Case::new();
    let (objects, pose, expected) = case.crossing();
    let asked = objects.query([0, 1], &pose, QueryOptions::default());
    let (number, job) = (asked.number(), || asked.clone());
    let good = StandIn::new(&objects).unwrap().packet(job().packet().unwrap());
    assert_eq!(job().finish(&good).map(|contacts| exact(&contacts)), Ok(expected));
    let pairs = good.len() - EngineReport::WORDS;
    let finish = |change: &dyn Fn(&mut Vec<u64>)| {
        let mut words = good.clone();
        change(&mut words);
        job().finish(&words).unwrap_err()
    };
    assert_eq!(finish(&|words| words.truncate(7)), EngineError::NoReport { words: 7 });
    assert_eq!(finish(&|words| _ = words.pop()), EngineError::NoReport { words: pairs + 7 });
    assert_eq!(finish(&|words| words[pairs] ^= 1 << 8), EngineError::Number { found: number ^ 1, expected: number });
    // No mesh has this triangle; a verdict that was not asked for.
    let word = good[1] | 0xfff << 8;
    assert_eq!(finish(&|words| words[1] = word), EngineError::Word { at: 1, word });
    let word = good[1] & !3;
    assert_eq!(finish(&|words| words[1] = word), EngineError::Word { at: 1, word });
    // A pair twice, in place of another one of the same verdict.
    let certain: Vec<usize> = (0..pairs).filter(|&at| good[at] & 3 == 1).take(2).collect();
    let Answered { triangles, .. } = Answered::of(good[certain[0]]).unwrap();
    assert_eq!(finish(&|words| words[certain[1]] = words[certain[0]]), EngineError::Twice { triangles });
    // A pair is lost; a pair is called certain on the way.
    assert!(matches!(finish(&|words| _ = words.remove(0)), EngineError::Count { .. }));
    let open = good[..pairs].iter().position(|word| word & 3 == 2).unwrap();
    let Err(EngineError::Count { found, expected }) = Err::<(), _>(finish(&|words| words[open] ^= 3)) else {
        panic!("another error");
    };
    assert_eq!(found, expected + 1);

    struct Mute;
    impl Engine for Mute {
        type Error = EngineError;

        fn answer(&mut self, _: &[&[u64]]) -> Result<Vec<Vec<u64>>, EngineError> {
            Ok(vec![])
        }
    }
    let error = objects.contacts(vec![job()], &mut Mute).unwrap_err();
    assert_eq!(error.to_string(), "found 0 answers; expected 1, one for each packet");
}

/// Words are changed on their way, in ways that can be recognised: no wrong answer is accepted.
#[test]
fn damage_that_can_be_recognised_is_never_accepted() {
    let case = Case::new();
    let objects = case.objects(&EngineParams::default(), &Params::default());
    let mut stand_in = StandIn::new(&objects).unwrap();
    let (mut rng, mut refused) = (ChaCha8Rng::seed_from_u64(9), 0);
    let pairs = [[0, 1], [1, 0], [0, 0], [1, 1]];
    let asked: Vec<_> = pairs.iter().flat_map(|pair| case.poses.iter().map(move |pose| (*pair, pose))).collect();
    let answered = asked.iter().map(|(pair, pose)| {
        let job = objects.query(*pair, pose, QueryOptions::default());
        let words = stand_in.packet(job.packet().unwrap());
        let expected = touching(&case.meshes[pair[0]], &case.meshes[pair[1]], pose);
        (job, words, expected)
    });
    let answered: Vec<_> = answered.collect();
    for round in 0..20_000 {
        let chosen = rng.random_range(0..answered.len());
        let (job, good, expected) = &answered[chosen];
        let (mut words, pairs) = (good.clone(), good.len() - EngineReport::WORDS);
        match round % 6 {
            // The answer to another query, which may be one with as many pairs.
            0 => words = answered[(chosen + rng.random_range(1..answered.len())) % answered.len()].1.clone(),
            1 if pairs > 1 => {
                let (from, to) = (rng.random_range(0..pairs), rng.random_range(0..pairs));
                words[to] = words[from];
            }
            2 if pairs > 0 => words[rng.random_range(0..pairs)] ^= 1 << rng.random_range(0..8),
            3 if pairs > 0 => _ = words.remove(rng.random_range(0..pairs)),
            4 => words.insert(0, rng.random_range(0..words.len() as u64) << 8 | 1),
            _ => words[pairs] ^= 1 << rng.random_range(0..32),
        }
        match job.clone().finish(&words) {
            Ok(contacts) => assert_eq!(exact(&contacts), *expected, "round {round}"),
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 15_000, "{refused} refused");
}

#[test]
fn objects_that_an_engine_cannot_hold_are_refused() {
    let mesh = hills(6);
    let refused = |engine: &EngineParams, unit: &Params| Objects::new(engine, unit, &[&mesh]).unwrap_err().to_string();
    let small = EngineParams { block_lines: 64, ..block_ram() };
    let message = "--block-lines 64: expected at least 71, which the meshes take in block RAM";
    assert_eq!(refused(&small, &Params::default()), message);
    let snapped: Params = Params { transform_width: 26, ..exact_unit() };
    assert!(refused(&EngineParams::default(), &snapped).starts_with("--method exact: expected axes or determinants"));
}

fn exact_unit() -> Params {
    use efsat_unit::params::{Transform, Truth};
    Params { transform: Transform::On, truth: Truth::Snapped, ..Params::of(Method::Exact) }
}

/// Load packets that are none.
#[test]
fn the_stand_in_refuses_what_the_engine_refuses() {
    let mesh = cuboid(1, 2, 3);
    let objects = Objects::new(&block_ram(), &Params::default(), &[&mesh]).unwrap();
    let mut stand_in = StandIn::new(&objects).unwrap();
    let format = *objects.numbers().format();
    let mut reason = |words: &[u64]| {
        let answer = stand_in.packet(&[&[format.header(Command::Load)], words].concat());
        EngineReport::of(answer.as_array().unwrap()).unwrap().reason
    };
    assert_eq!(reason(&[64, 0, 0, 0, 0, 0, 0, 0, 0]), Reason::Complete);
    assert_eq!(reason(&[(127 << 6) + (1 << 31), 0, 0, 0, 0, 0, 0, 0, 0]), Reason::Complete);
    assert_eq!(reason(&[128 << 6, 0, 0, 0, 0, 0, 0, 0, 0]), Reason::TooLong);
    // Beyond both memories, up to the last address of each.
    for line in [128, 1024, (1 << 25) - 1] {
        assert_eq!(reason(&[line << 6, 0, 0, 0, 0, 0, 0, 0, 0]), Reason::TooLong);
        assert_eq!(reason(&[(line << 6) + (1 << 31), 0, 0, 0, 0, 0, 0, 0, 0]), Reason::TooLong);
    }
    assert_eq!(reason(&[8, 0]), Reason::UnknownHeader);
    assert_eq!(reason(&[1 << 32, 0]), Reason::UnknownHeader);
    assert_eq!(reason(&[]), Reason::TooShort);
    assert_eq!(reason(&[64, 0, 0, 0, 0, 0, 0, 0]), Reason::TooShort);
    assert!(stand_in.packet(&[format.order(Command::Stop, 5)]).is_empty());
    let report = EngineReport { reason: Reason::Reset, number: 5, ..EngineReport::default() };
    assert_eq!(stand_in.packet(&[format.order(Command::Reset, 5)]), report.words());
    for command in [Command::Stop, Command::Reset] {
        let too_long = EngineReport { reason: Reason::TooLong, ..EngineReport::default() };
        assert_eq!(stand_in.packet(&[format.order(command, 5), 0]), too_long.words());
    }
}

/// Pairs keep the pose of the packet before them, and after a query that of the query.
#[test]
fn pairs_and_poses_go_between_queries() {
    let case = Case::new();
    let (objects, pose, _) = case.crossing();
    let unit = UnitPackets::new(&Params::default()).unwrap();
    let mut stand_in = StandIn::new(&objects).unwrap();
    let segments = Stimulus::random(&Params::default(), 32, 1).segments;
    let (golden, identity) = (Golden::new(&Params::default()), efsat_unit::pair::Pose::identity(&Params::default()));
    let query = objects.query([0, 1], &pose, QueryOptions::default()).packet().unwrap().to_vec();
    let own = Query::of(&query, objects.numbers().format()).unwrap().pose;
    let tagged = || (7..).zip(&segments[0].1);
    let expect = |pose: &efsat_unit::pair::Pose| {
        let answer = |(tag, pair)| Some(UnitAnswer::Pair { tag, outcome: golden.outcome(pose, pair) });
        tagged().map(answer).collect::<Vec<_>>()
    };
    let mut answers = |packet: &[u64]| -> Vec<Option<UnitAnswer>> {
        stand_in.packet(packet).into_iter().map(|word| unit.answer(word)).collect()
    };
    let pairs = unit.pairs(tagged()).unwrap();
    assert_eq!(answers(&pairs), expect(&identity));
    let taken = [Some(UnitAnswer::Report(StreamReport::PoseTaken))];
    assert_eq!(answers(&unit.pose(&segments[1].0).unwrap()), taken);
    assert_eq!(answers(&pairs), expect(&segments[1].0));
    answers(&query);
    assert_eq!(answers(&pairs), expect(&own));
    // A pose that ends early is not taken; the packet of another design is none.
    let cut = unit.pose(&segments[1].0).unwrap()[..4].to_vec();
    assert_eq!(answers(&cut), [Some(UnitAnswer::Report(StreamReport::TooShort))]);
    assert_eq!(answers(&[pairs[0] ^ 1 << 16]), [Some(UnitAnswer::Report(StreamReport::UnknownHeader))]);
    assert_eq!(answers(&pairs), expect(&own));
}

/// Pairs by number: the exact answer to each pair, in a pose and as one mesh lies, whichever memory, unit and end of the packet; a wrong
/// answer is refused.
#[test]
fn pairs_by_number_are_exact() {
    let case = Case::new();
    let units =
        [Params::default(), Params { upper: Upper::Sticky, ..Params::default() }, Params::of(Method::Determinants)];
    let corners = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
    for (unit, engine) in units.iter().zip([EngineParams::default(), block_ram(), block_ram()]) {
        let objects = case.objects(&engine, unit);
        let mut stand_in = StandIn::new(&objects).unwrap();
        let [a, b] = [0, 1].map(|i| case.meshes[i].faces().len() as u32);
        let all: Vec<[u32; 2]> = (0..a).flat_map(|p| (0..b).rev().map(move |q| [p, q])).collect();
        for pose in &case.poses {
            let job = objects.pairs([0, 1], pose, &all, false);
            let words = job.packet().map(|packet| stand_in.packet(packet)).unwrap_or_default();
            let found = job.finish(&words).unwrap();
            let due = touching(&case.meshes[0], &case.meshes[1], pose);
            for (pair, exact) in all.iter().zip(&found) {
                let touches = due.iter().find(|(known, _)| known == pair).map_or(Exact::Separate, |(_, exact)| *exact);
                assert_eq!(*exact, touches, "{pair:?}");
            }
        }
        // One mesh as it lies: neighbours, too, and a triangle and itself.
        let itself: Vec<[u32; 2]> = (0..b).flat_map(|p| (p..b).map(move |q| [p, q])).collect();
        let job = objects.pairs_of_one(1, &itself, true);
        let words = stand_in.packet(job.packet().unwrap());
        // No pair with a common vertex is called separate, or is left to be found by its verdict.
        let (answers, _) = words.split_last_chunk::<{ EngineReport::WORDS }>().unwrap();
        let answered: Vec<[u32; 2]> = answers.iter().map(|&word| Answered::of(word).unwrap().triangles).collect();
        for (pair, exact) in itself.iter().zip(job.finish(&words).unwrap()) {
            let [p, q] = pair.map(|face| corners(&case.meshes[1], face));
            assert_eq!(exact, efsat_geometry::exact::pair(&[p[0], p[1], p[2], q[0], q[1], q[2]]).unwrap(), "{pair:?}");
            let adjacent = p.iter().any(|corner| q.contains(corner));
            assert!(!adjacent || (answered.contains(pair) && exact != Exact::Separate), "{pair:?}");
        }
    }

    let objects = case.objects(&EngineParams::default(), &Params::default());
    let stand_in = StandIn::new(&objects).unwrap();
    let all: Vec<[u32; 2]> = (0..72).flat_map(|p| (0..12).map(move |q| [p, q])).collect();
    let job = || objects.pairs([0, 1], &case.poses[0], &all, false);
    let asked = job();
    let words = stand_in.clone().packet(asked.packet().unwrap());
    assert!(words.len() > EngineReport::WORDS + 4);
    let number = |job: PairsJob<'_, '_>, words: &[u64]| {
        let own = job.packet().unwrap()[0] >> 40;
        let report = words.len() - EngineReport::WORDS;
        let mut words = words.to_vec();
        words[report] = words[report] & !(0xff_ffff << 8) | own << 8;
        job.finish(&words)
    };
    let right = number(job(), &words).unwrap();
    let refused = |change: &dyn Fn(&mut Vec<u64>)| {
        let mut changed = words.clone();
        change(&mut changed);
        assert!(number(job(), &changed).is_err(), "{changed:x?}");
    };
    // Exchanged, lost, doubled, another verdict, another pair; counts of the report; none at all.
    refused(&|words| words.swap(1, 2));
    refused(&|words| {
        words.remove(3);
    });
    refused(&|words| words.insert(3, words[3]));
    refused(&|words| words[0] ^= 3);
    refused(&|words| words[0] &= !3);
    refused(&|words| words[2] ^= 1 << 40);
    refused(&|words| {
        let at = words.len() - 6;
        words[at] ^= 1 << 32;
    });
    assert!(matches!(job().finish(&[]), Err(EngineError::NoReport { .. })));
    assert!(matches!(job().finish(&words), Err(EngineError::Number { .. })));
    // A packet that was ended early is answered in software.
    let report = EngineReport { reason: Reason::Reset, ..EngineReport::default() };
    assert_eq!(job().finish(&report.words()).unwrap(), right);
}
