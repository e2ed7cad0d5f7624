//! Tests of images and queries, and of the reference model over them: volumes against rational arithmetic, no pair lost, the
//! bound of the stack, and what happens on bad data.

mod snapped;
mod tiny;

use super::*;
use crate::format::EngineFormat;
use crate::model::{Block, EngineOutcome, Link, Model, Query, Side, bounds, distance};
use crate::params::EngineParams;
use crate::words::Reason;
use efsat_geometry::directions::Directions;
use efsat_geometry::exact::{Exact, posed_pair};
use efsat_geometry::mesh::{Mesh, headlight};
use efsat_hardware::number::Upper;
use efsat_hardware::testing::full;
use efsat_unit::dyadic::Dyadic;
use efsat_unit::params::{Method, Params};
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

type Matrix = [[f64; 3]; 3];

const IDENTITY: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The default, the extremes that are worth keeping, and formats in between.
fn engines() -> Vec<EngineParams> {
    let make = |directions, origin_bits, offset_bits, factor_bits| EngineParams {
        directions,
        origin_bits,
        offset_bits,
        factor_bits,
        ..EngineParams::default()
    };
    vec![
        make(Directions::Eighteen, 18, 10, 12),
        make(Directions::Six, 12, 6, 6),
        make(Directions::Fourteen, 15, 9, 11),
        make(Directions::TwentySix, 22, 14, 11),
        make(Directions::Eighteen, 10, 4, 4),
    ]
}

/// Units with inputs of other widths.
fn units() -> [Params; 3] {
    [
        Params::default(),
        Params { transform_width: 48, upper: Upper::Sticky, ..Params::default() },
        Params { transform_width: 20, method: Method::Determinants, ..Params::of(Method::Determinants) },
    ]
}

fn dot(n: [i8; 3], x: &[Dyadic; 3]) -> Dyadic {
    n.iter().zip(x).fold(Dyadic::zero(), |sum, (&n, x)| sum + Dyadic::from(i64::from(n)) * x.clone())
}

/// A mesh of `count` triangles with corners on a coarse grid around a point, so that they often touch exactly.
fn random_mesh(rng: &mut ChaCha8Rng, count: u32, scale: f64, centre: f64) -> Mesh {
    let mut corner = || Point3::from([0; 3].map(|_| (centre + f64::from(rng.random_range(-8..=8))) * scale));
    let vertices: Vec<_> = (0..3 * count).map(|_| corner()).collect();
    Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap()
}

/// Turns, quarter turns, shears and singular matrices, all with entries from -1 to 1.
fn random_matrix(rng: &mut ChaCha8Rng, round: usize) -> Matrix {
    let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
    match round % 5 {
        0 => IDENTITY,
        1 => [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        2 => match round / 5 % 4 {
            0 => [0; 3].map(|_| [0; 3].map(|_| f64::from(rng.random_range(-2..=2)) * 0.25)),
            // A shear, and matrices of rank 1 and 2.
            1 => [[1.0, axis.x, 0.0], [0.0, 1.0, axis.y], [0.0, 0.0, 1.0]],
            2 => [axis.x, axis.y, axis.z].map(|x| [0.5 * x, 0.25 * x, -0.5 * x]),
            _ => [[1.0, 0.0, axis.x], [0.0, 1.0, axis.y], [0.0; 3]],
        },
        3 => [0; 3].map(|_| [0; 3].map(|_| rng.random_range(-0.5..0.5) * [1e-3, 1.0][rng.random_range(0..2)])),
        _ => {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(axis), rng.random_range(-3.1..3.1));
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| turn[(i, j)]))
        }
    }
}

/// The triangles below a link, by their numbers in the image.
fn below(image: &Image, link: Link) -> Vec<u32> {
    match link {
        Link::None => vec![],
        Link::Leaf(number) => vec![number],
        Link::Inner(number) => {
            image.block(number).unwrap().links.into_iter().flat_map(|link| below(image, link)).collect()
        }
    }
}

/// The corners of the triangles below a child, in the cube, exactly.
fn corners(image: &Image, mesh: &Mesh, link: Link) -> Vec<[Dyadic; 3]> {
    let header = image.header();
    let corner = |v: Point3<f64>| {
        [0, 1, 2].map(|i| (Dyadic::from(v[i]) - Dyadic::from(header.centre[i])).scaled(header.power.into()))
    };
    let faces = below(image, link).into_iter().map(|number| image.triangle(number).unwrap().number);
    faces.flat_map(|face| mesh.triangle(face as usize)).map(corner).collect()
}

#[test]
fn images_are_read_as_they_were_built() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let point = Mesh::new(vec![Point3::new(3.0, 0.1, -7.0)], vec![[0; 3]]).unwrap();
    let line = Mesh::new(point.vertices().to_vec(), vec![[0; 3]; 40]).unwrap();
    let far = random_mesh(&mut rng, 30, 1e-300, 1e9);
    let wide = random_mesh(&mut rng, 30, 1e150, 0.0);
    for mesh in [&Mesh::default(), &point, &line, &far, &wide, &headlight()] {
        for unit in units() {
            for engine in engines() {
                let Ok(format) = engine.format(&unit) else { continue };
                let image = Image::build(&[mesh], &format).unwrap().remove(0);
                let read = Image::read(&image.bytes()).unwrap();
                assert!(read == image, "{} triangles", mesh.faces().len());
                image.verify(mesh).unwrap();
                assert_eq!(image.header().triangles as usize, mesh.faces().len());
            }
        }
    }
    // One scale for all that meet.
    let format = EngineParams::default().format(&Params::default()).unwrap();
    let images = Image::build(&[&far, &wide], &format).unwrap();
    assert_eq!(images[0].header().power, images[1].header().power);
    assert!(images[0].header().power < -500);
}

/// A bit of an image is changed: reading it or comparing it with its mesh notices, or else nothing is lost by it. The engine
/// ends whatever it reads.
#[test]
fn images_with_a_changed_bit_are_noticed() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mesh = random_mesh(&mut rng, 24, 1.0, 0.0);
    let (engine, unit) = (EngineParams::default(), Params::default());
    let numbers = Numbers::new(&engine, &unit).unwrap();
    let model = Model::new(&engine, &unit).unwrap();
    let image = Image::build(&[&mesh], numbers.format()).unwrap().remove(0);
    let (fair, sides) = memory(&[&image]);
    let query = numbers.query([(&image, sides[0]); 2], &IDENTITY, &[0.0; 3]).unwrap();
    let query = Query { leaf_pairs: true, ..query }.words(numbers.format());
    let expected = pairs(&model.run(&fair, &query));
    let (mut read, mut verified, mut looser, mut ended) = (0, 0, 0, 0);
    let bytes = image.bytes();
    let sparse = if full() { 6 } else { 30 };
    for bit in (0..8 * bytes.len()).filter(|bit| *bit < 512 || bit % sparse == 0) {
        let mut changed = bytes.clone();
        changed[bit / 8] ^= 1 << (bit % 8);
        let words: Vec<u64> = changed.chunks(8).map(|chunk| u64::from_le_bytes(chunk.try_into().unwrap())).collect();
        let outcome = model.run(&words, &query);
        ended += u32::from(outcome.report.reason == Reason::BadTree);
        match Image::read(&changed) {
            Err(e) => {
                assert!(e.to_string().contains("; expected "), "{e}");
                read += 1;
            }
            Ok(image) => match image.verify(&mesh) {
                Err(_) => verified += 1,
                Ok(()) => {
                    looser += 1;
                    let found = pairs(&outcome);
                    assert!(expected.iter().all(|pair| found.binary_search(pair).is_ok()), "bit {bit}");
                }
            },
        }
    }
    // Numbers of triangles are noticed without the mesh, so that most bits are refused as the image is read.
    let least = [2500, 500, 100, 100].map(|count| if full() { count } else { count / 5 });
    let all = [read, verified, looser, ended].into_iter().zip(least).all(|(count, least)| count > least);
    assert!(all, "{read} {verified} {looser} {ended}");
}

/// The triangles of the answers, sorted.
fn pairs(outcome: &EngineOutcome) -> Vec<[u32; 2]> {
    let mut pairs: Vec<_> = outcome.answers.iter().map(|answer| answer.triangles).collect();
    pairs.sort_unstable();
    pairs
}

/// B_h + U_h and V_h are upper bounds, in rational arithmetic, of all that is in the volumes.
#[test]
fn bounds_of_volumes_hold_what_is_in_them() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let scales = [1.0, 0.1, 1e-3, 1e-160, 1e150, 1e-300, 1e5];
    let (mut compared, mut tight, mut refused) = (0, 0, 0);
    for round in 0..30 {
        let scale = scales[round % 7];
        let far = [0.0, 1e3, 1e9][round % 3];
        let meshes = [random_mesh(&mut rng, 4, scale, far), random_mesh(&mut rng, 5, scale, far)];
        let m = random_matrix(&mut rng, round);
        // Near each other: B's middle is moved to A's.
        let t = [0, 1, 2].map(|i| {
            let middle: f64 = m[i].iter().sum::<f64>() * far * scale;
            far * scale - middle + f64::from(rng.random_range(-9..=9)) * scale
        });
        for engine in engines() {
            let unit = &units()[round % 3];
            let Ok(numbers) = Numbers::new(&engine, unit) else { continue };
            let format = numbers.format();
            let images = Image::build(&[&meshes[0], &meshes[1]], format).unwrap();
            let query = match numbers.query([(&images[0], Side::default()), (&images[1], Side::default())], &m, &t) {
                Ok(query) => query,
                Err(_) => {
                    refused += 1;
                    continue;
                }
            };
            let frame = query.frame(format);
            let grid = i64::from(format.grid_fraction());
            let headers = [0, 1].map(|side| images[side].header());
            let matrix = m.map(|row| row.map(Dyadic::from));
            let times = |y: &[Dyadic; 3], start: [Dyadic; 3]| {
                let row = |(row, start): (&[Dyadic; 3], Dyadic)| {
                    row.iter().zip(y).fold(start, |sum, (m, y)| sum + m.clone() * y.clone())
                };
                matrix.iter().zip(start).map(row).collect::<Vec<_>>()
            };
            let moved = [0, 1, 2].map(|i| Dyadic::from(t[i]) - Dyadic::from(headers[0].centre[i]));
            let shift = times(&headers[1].centre.map(Dyadic::from), moved);
            let shift = [0, 1, 2].map(|i| shift[i].clone().scaled(headers[0].power.into()));
            for (x, y) in (0..headers[0].blocks).flat_map(|x| (0..headers[1].blocks).map(move |y| (x, y))) {
                let blocks: [Block; 2] = [images[0].block(x).unwrap(), images[1].block(y).unwrap()];
                let distance = distance(&frame, &blocks[0], &blocks[1], format);
                let origin =
                    blocks[0].origin.map(|o| Dyadic::from(i64::from(o)).scaled(-i64::from(format.origin_fraction())));
                for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let relative = |x: &[Dyadic]| [0, 1, 2].map(|i| x[i].clone() - origin[i].clone());
                    let of_a = corners(&images[0], &meshes[0], blocks[0].links[p]);
                    let of_a: Vec<_> = of_a.iter().map(|x| relative(x)).collect();
                    let of_b = corners(&images[1], &meshes[1], blocks[1].links[q]);
                    let of_b: Vec<_> = of_b.iter().map(|y| relative(&times(y, shift.clone()))).collect();
                    for h in 0..format.directions.count() {
                        let (a, b) = (blocks[0].volume(p), blocks[1].volume(q));
                        let [base, upper, code] = bounds(h, &distance, &frame, &a, &b, format);
                        let n = format.directions.vector(h);
                        let excess = |bound: i64, points: &[[Dyadic; 3]], n: [i8; 3]| {
                            Dyadic::from(bound) - points.iter().map(|x| dot(n, x)).max().unwrap().scaled(grid)
                        };
                        let above = excess(base + upper, &of_b, n);
                        let below = excess(code, &of_a, n.map(|x| -x));
                        let least = above.clone().min(below);
                        assert!(least >= Dyadic::zero(), "round {round}, direction {h}");
                        compared += 1;
                        tight += u32::from(above < Dyadic::from(1 << 18) && engine.offset_bits == 10);
                    }
                }
            }
        }
    }
    assert!(
        compared > 30_000 && tight > 2_000 && refused < 75,
        "{compared} compared, {tight} tight, {refused} refused"
    );
}

/// Against brute force with the exact test: every pair that touches is a leaf pair, in every format.
#[test]
fn no_pair_of_touching_triangles_is_lost() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let (mut touching, mut found_in_all, mut queries) = (0, 0, 0);
    for round in 0..60 {
        let scale = [1.0, 0.1, 1e-3, 1e-160, 1e100][round % 5];
        let [a, b] = [0, 1].map(|_| random_mesh(&mut rng, 12, scale, [0.0, 64.0][round % 2]));
        let m = random_matrix(&mut rng, round);
        let t = [0; 3].map(|_| f64::from(rng.random_range(-9..=9)) * scale);
        let triangle = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
        let all = (0..12).flat_map(|p| (0..12).map(move |q| [p, q]));
        let touch =
            |&[p, q]: &[u32; 2]| posed_pair(&triangle(&a, p), &triangle(&b, q), &m, &t).unwrap() != Exact::Separate;
        let expected: Vec<[u32; 2]> = all.filter(touch).collect();
        touching += expected.len();
        for engine in engines() {
            let unit = &units()[round % 3];
            let (Ok(numbers), Ok(model)) = (Numbers::new(&engine, unit), Model::new(&engine, unit)) else { continue };
            let images = Image::build(&[&a, &b], numbers.format()).unwrap();
            let (memory, sides) = memory(&[&images[0], &images[1]]);
            let Ok(query) = numbers.query([(&images[0], sides[0]), (&images[1], sides[1])], &m, &t) else { continue };
            queries += 1;
            let leaves = Query { leaf_pairs: true, ..query.clone() };
            let outcome = model.run(&memory, &leaves.words(numbers.format()));
            assert_eq!(outcome.report.reason, Reason::Complete);
            let found = pairs(&outcome);
            assert_eq!(found.len(), outcome.report.leaf_pairs as usize);
            for pair in &expected {
                assert!(found.binary_search(pair).is_ok(), "round {round}, {engine:?}: {pair:?}");
            }
            found_in_all += found.len();
            // And the unit calls none of them separate.
            let outcome = model.run(&memory, &query.words(numbers.format()));
            let found = pairs(&outcome);
            assert!(expected.iter().all(|pair| found.binary_search(pair).is_ok()), "round {round}, {engine:?}");
        }
    }
    assert!(touching > 300 && queries > 150, "{touching} pairs touch, {queries} queries");
    assert!(found_in_all < queries * 144 * 2 / 3, "and not simply all pairs are found: {found_in_all} in {queries}");
}

/// A scene of two meshes in memory.
struct Setting {
    model: Model,
    numbers: Numbers,
    memory: Vec<u64>,
    query: Query,
}

impl Setting {
    /// A mesh against itself.
    fn new(mesh: &Mesh, engine: &EngineParams) -> Self {
        let unit = Params::default();
        let numbers = Numbers::new(engine, &unit).unwrap();
        let image = Image::build(&[mesh], numbers.format()).unwrap().remove(0);
        let (memory, sides) = memory(&[&image]);
        let query = numbers.query([(&image, sides[0]); 2], &IDENTITY, &[0.0; 3]).unwrap();
        Self { model: Model::new(engine, &unit).unwrap(), numbers, memory, query }
    }

    fn run(&self, query: &Query) -> EngineOutcome {
        self.model.run(&self.memory, &query.words(self.numbers.format()))
    }
}

/// Copies of one triangle: everything overlaps, so that every expansion pushes as much as it can.
fn copies(count: usize) -> Mesh {
    let vertices = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 1.0]].map(Point3::from).to_vec();
    Mesh::new(vertices, vec![[0, 1, 2]; count]).unwrap()
}

#[test]
fn the_stack_keeps_to_its_bound() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for (mesh, tree_height) in [(copies(64), 6), (random_mesh(&mut rng, 60, 1.0, 0.0), 16)] {
        // As narrow as may be, nearly so, and wide.
        for stack in [3 * tree_height + 2, 3 * tree_height + 5, 3 * tree_height + 40, 512] {
            for in_flight in [1, 4, 16] {
                let engine = EngineParams { tree_height, stack, in_flight, ..EngineParams::default() };
                let setting = Setting::new(&mesh, &engine);
                let query = Query { leaf_pairs: true, ..setting.query.clone() };
                let expected = setting.run(&query);
                assert_eq!(expected.report.reason, Reason::Complete);
                for _ in 0..12 {
                    let often = rng.random_range(0.1..1.0);
                    let words = query.words(setting.numbers.format());
                    // The model asserts the bound.
                    let outcome = setting.model.run_paced(&setting.memory, &words, || rng.random_bool(often));
                    assert_eq!(pairs(&outcome), pairs(&expected));
                    let report = crate::words::EngineReport { stack: expected.report.stack, ..outcome.report };
                    assert_eq!(report, expected.report);
                    let narrow = engine.wide_limit() < 40;
                    assert!(!narrow || u32::from(outcome.report.stack) <= stack);
                }
            }
        }
    }
}

/// Each row of the table of bad data: a reason, no answer beyond what is right, and never a hang.
#[test]
fn bad_data_ends_a_query_with_a_reason() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let engine = EngineParams { tree_height: 12, ..EngineParams::default() };
    let setting = Setting::new(&random_mesh(&mut rng, 40, 1.0, 0.0), &engine);
    let query = &setting.query;
    let whole = setting.run(query);
    assert_eq!(whole.report.reason, Reason::Complete);
    assert!(whole.report.expansions > 100 && whole.report.intersect > 20);
    let reason = |query: Query| setting.run(&query).report.reason;
    let changed = |change: fn(&mut [Side; 2])| {
        let mut query = query.clone();
        change(&mut query.sides);
        query
    };
    // Queries.
    assert_eq!(reason(changed(|sides| sides[1].blocks = 0)), Reason::BadTree);
    assert_eq!(reason(changed(|sides| sides[0].blocks = 7)), Reason::BadTree);
    assert_eq!(reason(changed(|sides| sides[1].triangles = 20)), Reason::BadTree);
    assert_eq!(reason(changed(|sides| sides[0].triangles_at = 1 << 20)), Reason::Memory);
    assert_eq!(reason(changed(|sides| sides[0].blocks = u32::MAX)), Reason::Memory);
    let limit = |limit| setting.run(&Query { limit, ..query.clone() }).report;
    assert_eq!((limit(50).reason, limit(50).expansions), (Reason::Limit, 50));
    assert_eq!(limit(whole.report.expansions).reason, Reason::Complete);
    assert_eq!(limit(whole.report.expansions - 1).reason, Reason::Limit);
    let first = setting.run(&Query { first_contact: true, ..query.clone() });
    assert_eq!((first.report.reason, first.report.intersect), (Reason::Contact, 1));
    assert!(first.report.expansions < whole.report.expansions);
    let everything = setting.run(&Query { all_pairs: true, ..query.clone() });
    assert_eq!(everything.answers.len() as u32, whole.report.leaf_pairs);
    // Packets.
    let words = query.words(setting.numbers.format());
    let packet = |words: &[u64]| setting.model.run(&setting.memory, words).report.reason;
    assert_eq!(packet(&[]), Reason::UnknownHeader);
    assert_eq!(packet(&words[..words.len() - 1]), Reason::TooShort);
    assert_eq!(packet(&[&words[..], &[0]].concat()), Reason::TooLong);
    // The kind, every field of the format, spare flags, a bypassed pose, spare bits of rows, and a choice of slot 0 that there
    // is not.
    let bits = [(0, 0), (0, 9), (0, 33), (0, 41), (0, 46), (0, 50), (0, 63), (5, 37), (7, 31), (14, 58), (22, 63)];
    for (word, bit) in bits {
        let mut words = words.clone();
        words[word] ^= 1 << bit;
        assert_eq!(packet(&words), Reason::UnknownHeader, "bit {bit} of word {word}");
    }
    let mut absent = words.clone();
    absent[14] |= 7;
    assert_eq!(packet(&absent), Reason::UnknownHeader);
    // Blocks: tag, zeros, a code without opposite, a link to itself, and one beyond the count.
    let block = |word: usize, clear: u64, set: u64| {
        let mut memory = setting.memory.clone();
        memory[8 + word] = memory[8 + word] & !clear | set;
        setting.model.run(&memory, &words).report.reason
    };
    assert_eq!(block(0, 0, 0), Reason::Complete);
    assert_eq!(block(1, 0, 1 << 58), Reason::BadTree);
    assert_eq!(block(2, 0, 1 << 10), Reason::BadTree);
    assert_eq!(block(2, 0x3ff << 24, 0x200 << 24), Reason::BadTree);
    assert_eq!(block(0, 0xffff_ffff, 0), Reason::BadTree);
    assert_eq!(block(0, 0xffff_ffff, 1 << 20), Reason::BadTree);
    assert_eq!(block(0, 0xffff_ffff, 1 << 31 | 40), Reason::BadTree);
    // A tree of more levels than the engine has.
    let low = EngineParams { tree_height: 3, ..EngineParams::default() };
    let low = Model::new(&low, &Params::default()).unwrap();
    assert_eq!(low.run(&setting.memory, &words).report.reason, Reason::BadTree);
    assert!(Reason::ALL.into_iter().skip(2).all(Reason::is_incomplete));
}

#[test]
fn queries_are_read_as_they_were_written() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mesh = random_mesh(&mut rng, 6, 1.0, 0.0);
    for engine in engines() {
        for unit in units() {
            let Ok(numbers) = Numbers::new(&engine, &unit) else { continue };
            let image = Image::build(&[&mesh], numbers.format()).unwrap().remove(0);
            let m = random_matrix(&mut rng, 4);
            let query = numbers.query([(&image, image.side(77)), (&image, image.side(1 << 20))], &m, &[0.5, -1.0, 2.0]);
            let query = Query { limit: 5, first_contact: true, number: 0xabcdef, ..query.unwrap() };
            assert_eq!(Query::of(&query.words(numbers.format()), numbers.format()), Ok(query));
        }
    }
}

#[test]
fn what_the_engine_cannot_answer_is_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let (small, large) = (random_mesh(&mut rng, 6, 1.0, 0.0), random_mesh(&mut rng, 9, 100.0, 0.0));
    let unit = Params::default();
    let numbers = |engine: EngineParams| Numbers::new(&engine, &unit).unwrap();
    let default = numbers(EngineParams::default());
    let build = |meshes: &[&Mesh], format: &EngineFormat| Image::build(meshes, format).unwrap().remove(0);
    let (a, b) = (build(&[&small], default.format()), build(&[&large], default.format()));
    let ask = |numbers: &Numbers, images: [&Image; 2], m: Matrix, t: [f64; 3]| {
        numbers.query(images.map(|image| (image, Side::default())), &m, &t).unwrap_err().to_string()
    };
    let scales = ask(&default, [&a, &b], IDENTITY, [0.0; 3]);
    assert_eq!(scales, "images of scales 2^-3 and 2^-10: expected one scale");
    let other = EngineParams { offset_bits: 9, ..EngineParams::default() };
    let of_another = build(&[&small], numbers(other).format());
    let message = "image B: another format than the engine's; expected one that was built for it";
    assert_eq!(ask(&default, [&a, &of_another], IDENTITY, [0.0; 3]), message);
    let low = numbers(EngineParams { tree_height: 2, ..EngineParams::default() });
    assert!(ask(&low, [&a, &a], IDENTITY, [0.0; 3]).starts_with("image A: a tree of height "));
    let few = numbers(EngineParams { block_number_bits: 8, ..EngineParams::default() });
    let many = build(&[&copies(300)], default.format());
    assert_eq!(ask(&few, [&many, &many], IDENTITY, [0.0; 3]), "image A: 299 blocks; expected at most 256");
    let mut stretched = IDENTITY;
    stretched[1][2] = -1.5;
    assert_eq!(ask(&default, [&a, &a], stretched, [0.0; 3]), "entry 1, 2 of the matrix: -1.5; expected -1 to 1");
    let far = ask(&default, [&a, &a], IDENTITY, [0.0, 1e6, 0.0]);
    assert_eq!(far, "translation along axis 1, in the scale of the images: outside the declared range");
    let flat = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    assert!(default.query([(&a, Side::default()); 2], &flat, &[0.0; 3]).is_ok(), "4096 steps miss a factor by one");
    let corners =
        numbers(EngineParams { directions: Directions::TwentySix, offset_bits: 9, ..EngineParams::default() });
    let image = build(&[&small], corners.format());
    let ones = [[1.0; 3]; 3];
    let message = ask(&corners, [&image, &image], ones, [0.0; 3]);
    assert!(
        message.starts_with("row of direction 18: a rest of ") && message.ends_with("expected at most 4095"),
        "{message}"
    );
}
