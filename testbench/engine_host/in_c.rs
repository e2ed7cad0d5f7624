//! What a host in C computes without Rust, against the host here: images are read, poses become words, and pairs are retested.

use super::*;
use crate::extent::{full, share};
use efsat::Points;
use efsat::engine::artefact::samples::{cuboid, hills, turn};
use efsat::engine::host::{Image, ImageError, Numbers, Refusal};
use efsat::engine::model::ByNumber;
use efsat::exact::{Exact, posed_pair};
use efsat::mesh::Mesh;
use efsat::software::retest::{retest, retest_posed};
use std::path::Path;
use std::process::{Command, Stdio};

const READY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/rtl-out/engine/host");

type Numbers30 = [f64; 30];
type Matrix = [[f64; 3]; 3];

/// Compiles a program beside a folder of headers, with every check of accesses; what runs is quick all the same.
fn compiled(host: &Path, name: &str, text: &str) {
    fs::write(host.join(format!("{name}.c")), text).unwrap();
    run(host, "cc", &[CHECKED, &["-O1", "-o", name, &format!("{name}.c")]].concat());
}

/// What a program says to bytes.
fn said(host: &Path, command: &[&str], bytes: &[u8]) -> Vec<u8> {
    fs::write(host.join("asked"), bytes).unwrap();
    let program = host.join(command[0]);
    let mut run = Command::new(program);
    run.args(&command[1..])
        .current_dir(host)
        .stdin(fs::File::open(host.join("asked")).unwrap())
        .stderr(Stdio::inherit());
    let output = run.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", output.status);
    output.stdout
}

/// Headers of the ready engine in a folder of their own.
fn ready() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    for file in fs::read_dir(READY).unwrap().map(|file| file.unwrap().path()) {
        fs::copy(&file, home.path().join(file.file_name().unwrap())).unwrap();
    }
    home
}

/// Numbers of a kind: few, so that much is equal, touches and degenerates; of all sizes; any bits.
fn any(rng: &mut ChaCha8Rng, kind: u32) -> f64 {
    let power = |rng: &mut ChaCha8Rng| 2f64.powi([-1000, -500, -60, 0, 30, 500, 900][rng.random_range(0..7)]);
    match kind {
        0 => f64::from(rng.random_range(-2..=2)),
        1 => rng.random_range(-1.0..1.0),
        2 => [0.0, -0.0, 1.0, 5e-324, -5e-324, f64::MAX, f64::MIN, f64::MIN_POSITIVE][rng.random_range(0..8)],
        3 => f64::from(rng.random_range(-3..=3)) * power(rng),
        4 => f64::from(rng.random_range(-2..=2)) * 0.1,
        5 => f64::from_bits(rng.random::<u64>() & !(1 << 62)),
        _ => f64::from(rng.random_range(0..2)),
    }
}

/// A pair with its pose, often in one plane or on one line, or with common corners.
fn random_pair(rng: &mut ChaCha8Rng) -> Numbers30 {
    let (kind, of_pose) = (rng.random_range(0..7), rng.random_range(0..7));
    let mut x: Numbers30 = [0.0; 30];
    x[..18].iter_mut().for_each(|x| *x = any(rng, kind));
    x[18..].iter_mut().for_each(|x| *x = any(rng, of_pose));
    for _ in 0..rng.random_range(0..3) {
        let axis = rng.random_range(0..3);
        (0..6).for_each(|corner| x[3 * corner + axis] = x[axis]);
    }
    for _ in 0..rng.random_range(0..3) {
        let [from, to] = [(); 2].map(|()| 3 * rng.random_range(0..6));
        x.copy_within(from..from + 3, to);
    }
    match rng.random_range(0..4) {
        0 => x[18..].copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        1 => x[18..27].copy_from_slice(turn(2).as_flattened()),
        _ => {}
    }
    x
}

/// Three numbers after the other.
fn threes<const N: usize>(x: &[f64]) -> [[f64; 3]; N] {
    std::array::from_fn(|i| [x[3 * i], x[3 * i + 1], x[3 * i + 2]])
}

#[test]
fn pairs_are_retested_in_c() {
    let home = ready();
    compiled(home.path(), "retest", include_str!("retest.c"));
    let (mut rng, mut counts) = (ChaCha8Rng::seed_from_u64(3), [[0; 3]; 2]);
    for round in 0..if full() { 200 } else { 1 } {
        let mut cases: Vec<Numbers30> = (0..5_000).map(|_| random_pair(&mut rng)).collect();
        // The greatest numbers that any pair takes: products from one end of binary64 to the other.
        cases.push(std::array::from_fn(|i| [f64::MAX, 5e-324, f64::MIN][(i + i / 3) % 3]));
        let bytes: Vec<u8> = cases.iter().flatten().flat_map(|x| x.to_ne_bytes()).collect();
        let found = String::from_utf8(said(home.path(), &["retest"], &bytes)).unwrap();
        assert_eq!(found.lines().count(), cases.len());
        for (x, found) in cases.iter().zip(found.lines()) {
            let ([a, b, m], t): ([Matrix; 3], [f64; 3]) =
                ([0, 9, 18].map(|at| threes(&x[at..])), threes::<1>(&x[27..])[0]);
            let points: Points = threes(&x[..18]);
            let due = [retest_posed(&a, &b, &m, &t).unwrap(), retest(&points).unwrap()];
            if round == 0 {
                assert_eq!(posed_pair(&a, &b, &m, &t).unwrap(), due[0]);
            }
            assert_eq!(found, due.map(|exact| (exact as u8).to_string()).join(" "), "{x:?}");
            due.iter().zip(&mut counts).for_each(|(exact, counts)| counts[*exact as usize] += 1);
        }
    }
    assert!(counts.as_flattened().iter().all(|&count| count > 200), "{counts:?}");
    assert_eq!([Exact::Separate, Exact::Touch, Exact::Intersect].map(|exact| exact as u8), [0, 1, 2]);
    // What is not finite is refused with its place, and what the words do not hold.
    let refused = |place: usize, value: f64| {
        let mut x: Numbers30 = [1.0; 30];
        x[place] = value;
        let bytes: Vec<u8> = x.iter().flat_map(|x| x.to_ne_bytes()).collect();
        String::from_utf8(said(home.path(), &["retest"], &bytes)).unwrap()
    };
    assert_eq!([refused(17, f64::NAN), refused(29, f64::NEG_INFINITY)], ["refused 1 17\n", "refused 1 29\n"]);
    compiled(home.path(), "retest", &format!("#define EFSAT_RETEST_WORDS 16\n{}", include_str!("retest.c")));
    assert_eq!(refused(0, 2f64.powi(-140)), "0 1\n");
    assert_eq!(refused(0, 2f64.powi(-150)), format!("refused 2 {}\n", u32::MAX));
}

/// No number of binary64 is ever in a register for such numbers, let alone computed with.
#[test]
fn c_computes_in_whole_numbers_alone() {
    let whole = ["-mgeneral-regs-only", "-fsyntax-only"];
    let home = ready();
    fs::write(home.path().join("none.c"), "int x;\n").unwrap();
    let works = Command::new("cc")
        .args(whole)
        .arg("none.c")
        .current_dir(home.path())
        .output()
        .is_ok_and(|o| o.status.success());
    if !works {
        efsat_hardware::testing::skip("a compiler with -mgeneral-regs-only is not installed");
        return;
    }
    let text = "#include \"efsat_engine_pose.h\"\nint x(int *answer, struct efsat_retest_room *room, struct efsat_engine_query *query,\n\
                const struct efsat_engine_image *const images[2], const double *p)\n{\n\
                return efsat_retest_pair(answer, room, p, p + 9, 0) + efsat_engine_put_pose(query, room, images, p, p + 9, 0);\n}\n";
    fs::write(home.path().join("whole.c"), text).unwrap();
    run(home.path(), "cc", &["-std=c99", "-O2", "-mgeneral-regs-only", "-c", "whole.c"]);
}

/// The images of a field and a box.
fn images(format: &EngineFormat, scale: f64, centre: [f64; 3]) -> Vec<Image> {
    let moved = |mesh: &Mesh| {
        let at = |axis: usize, x: f64| x * scale + centre[axis];
        let vertices = mesh.vertices().iter().map(|p| [at(0, p.x), at(1, p.y), at(2, p.z)]);
        Mesh::new(vertices, mesh.faces().iter().copied()).unwrap()
    };
    let meshes = [moved(&hills(4)), moved(&cuboid(3, 4, 2))];
    Image::build(&meshes.each_ref(), format).unwrap()
}

/// A rotation, sometimes about an axis of the coordinates or by quarter turns, sometimes none, with numbers that are not finite, or
/// with an entry or a shift out of range.
fn random_pose(rng: &mut ChaCha8Rng, scale: f64) -> (Matrix, [f64; 3]) {
    let angle = |rng: &mut ChaCha8Rng| match rng.random_range(0..4) {
        0 => f64::from(rng.random_range(-2..=2)) * std::f64::consts::FRAC_PI_4,
        1 => 0.0,
        _ => rng.random_range(-4.0..4.0),
    };
    let turned = nalgebra::Rotation3::from_euler_angles(angle(rng), angle(rng), angle(rng));
    let mut m: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| turned[(i, j)].clamp(-1.0, 1.0)));
    let mut t = [(); 3].map(|()| rng.random_range(-6.0..6.0) * scale);
    if rng.random_range(0..4) == 0 {
        m.as_flattened_mut().iter_mut().for_each(|x| *x = (*x * 8.0).round() / 8.0);
    }
    match rng.random_range(0..24) {
        0 => m[rng.random_range(0..3)][rng.random_range(0..3)] = any(rng, 5),
        1 => m[rng.random_range(0..3)][rng.random_range(0..3)] = any(rng, 2),
        2 => t[rng.random_range(0..3)] = any(rng, 2),
        3 => t[rng.random_range(0..3)] *= 1e3,
        4 => {
            m[rng.random_range(0..3)][rng.random_range(0..3)] =
                [1.0 + f64::EPSILON, f64::NAN, -1.0][rng.random_range(0..3)]
        }
        5 => t[rng.random_range(0..3)] = f64::INFINITY,
        6 => m.as_flattened_mut().iter_mut().for_each(|x| *x = rng.random_range(-1.0..1.0)),
        // Factors half way between two that their field holds, and shifts half way between two numbers.
        7 | 8 => {
            let halves = |x: &mut f64, bits: i32| *x = (*x * f64::from(bits).exp2()).round() / f64::from(bits).exp2();
            m.as_flattened_mut().iter_mut().for_each(|x| halves(x, 12));
            t.iter_mut().for_each(|x| halves(x, 29));
        }
        _ => {}
    }
    (m, t)
}

/// How the program calls a refusal, and the index of what it is about.
fn refusal(of: &Refusal) -> [u32; 2] {
    use efsat::finite::Place;
    match of {
        Refusal::NotFinite(number) => match number.place {
            Place::Matrix { row, column } => [1, (3 * row + column) as u32],
            Place::Translation { axis } => [1, 9 + axis as u32],
            place => panic!("{place:?}"),
        },
        Refusal::Scale(_) => [2, 1],
        Refusal::Entry { row, column, .. } => [3, (3 * row + column) as u32],
        Refusal::Translation { axis } => [4, 9 + *axis as u32],
        Refusal::Rest { direction, .. } => [5, *direction as u32 / 2],
        other => panic!("{other}"),
    }
}

/// Poses as words of queries, or of packets of pairs by number, in C and here. Returns how many were taken, and refused for each
/// reason.
fn poses_agree(
    engine: &EngineParams,
    unit: &Params,
    by_number: bool,
    host: &Path,
    poses: usize,
    seed: u64,
) -> [u32; 6] {
    let numbers = Numbers::new(engine, unit).unwrap();
    let (mut rng, mut counts) = (ChaCha8Rng::seed_from_u64(seed), [0; 6]);
    let words = if by_number { numbers.format().pairs_at() } else { numbers.format().query_words() } as usize;
    let block_ram = engine.memory == Memory::BlockRam;
    let program = include_str!("pose.c")
        .replace("REST}", if by_number { "-1}" } else { "EFSAT_ENGINE_REFUSED_REST}" })
        .replace("ASKED", if by_number { "efsat_engine_head" } else { "efsat_engine_query" })
        .replace("WORDS", &words.to_string())
        .replace("PUT", if by_number { "efsat_engine_put_head" } else { "efsat_engine_put_query" });
    let side = match (block_ram, by_number) {
        (false, _) => "efsat_engine_image_side(both[i], 0)",
        (true, false) => "efsat_engine_image_side(both[i], 64, efsat_engine_image_triangle(both[i], 0))",
        (true, true) => "efsat_engine_image_side(both[i], efsat_engine_image_triangle(both[i], 0))",
    };
    compiled(host, "pose", &program.replace("SIDE", side));
    // Meshes near the origin and far from it, of all sizes; then of two scales.
    let places = [
        (1.0, [0.0; 3]),
        (1e-300, [0.0; 3]),
        (0.01, [1e6, -3.0, 0.1]),
        (1e150, [1e160, 0.0, -7.0]),
        (1.0, [0.1, 1e-9, 2.0]),
    ];
    for (scale, centre) in places {
        let images = images(numbers.format(), scale, centre);
        for (name, image) in ["a", "b"].iter().zip(&images) {
            fs::write(host.join(name), image.bytes()).unwrap();
        }
        let all: Vec<(Matrix, [f64; 3])> = (0..poses / places.len()).map(|_| random_pose(&mut rng, scale)).collect();
        let asked = all.iter().flat_map(|(m, t)| m.as_flattened().iter().chain(t).copied().collect::<Vec<f64>>());
        let found = said(host, &["pose", "a", "b"], &asked.flat_map(f64::to_ne_bytes).collect::<Vec<u8>>());
        let mut found = found.as_slice();
        let mut next = |bytes: usize| found.split_off(..bytes).unwrap();
        for (m, t) in &all {
            let side = |image: &Image| image.side(0);
            let due = numbers.query([(&images[0], side(&images[0])), (&images[1], side(&images[1]))], m, t);
            let head = next(8);
            let head = [0, 4].map(|at| u32::from_ne_bytes(head[at..at + 4].try_into().unwrap()));
            counts[head[0] as usize] += 1;
            match due {
                // Pairs by number need no rows.
                Err(Refusal::Rest { .. }) if by_number => _ = (head[0] == 0).then(|| next(8 * words)),
                Err(due) => assert_eq!(head, refusal(&due), "{due}: {m:?} {t:?}"),
                Ok(query) => {
                    assert_eq!(head, [0, 0], "{m:?} {t:?}");
                    let found: Vec<u64> =
                        next(8 * words).chunks(8).map(|word| u64::from_ne_bytes(word.try_into().unwrap())).collect();
                    let due = match by_number {
                        true => ByNumber { number: 5, ..ByNumber::of_query(&query, vec![]) }.words(numbers.format()),
                        false => Query { number: 5, ..query }.words(numbers.format()),
                    };
                    assert_eq!(found, due, "{m:?} {t:?}");
                }
            }
        }
        assert!(found.is_empty());
    }
    counts
}

#[test]
fn poses_become_the_same_words_in_c() {
    let poses = if full() { 1_000_000 } else { 4_000 };
    let home = ready();
    let engine = EngineParams::default();
    let counts = poses_agree(&engine, &engine.unit(), false, home.path(), poses, 1);
    // All but two scales, which are below, and rests of rows, which fit where entries do; those of axes need not.
    assert!([0, 1, 3, 4].iter().all(|&code| counts[code] > 20), "{counts:?}");
    let scales = ready();
    let numbers = Numbers::new(&engine, &engine.unit()).unwrap();
    let of = |scale: f64| images(numbers.format(), scale, [0.0; 3]).remove(0);
    fs::write(scales.path().join("a"), of(1.0).bytes()).unwrap();
    fs::write(scales.path().join("b"), of(2.0).bytes()).unwrap();
    fs::copy(home.path().join("pose"), scales.path().join("pose")).unwrap();
    let pose: Vec<u8> = [0.0f64; 12].iter().flat_map(|x| x.to_ne_bytes()).collect();
    let found = said(scales.path(), &["pose", "a", "b"], &pose);
    assert_eq!(found, [2u32, 1].map(u32::to_ne_bytes).concat());
}

/// Other directions, formats, memories and units; pairs by number.
#[test]
fn poses_of_other_engines_become_the_same_words_in_c() {
    let make = |directions, offset_bits, memory, factor_bits| EngineParams {
        directions,
        offset_bits,
        memory,
        factor_bits,
        ..EngineParams::default()
    };
    let sticky = Params { upper: Upper::Sticky, ..Params::default() };
    let cases = [
        (make(Directions::TwentySix, 6, Memory::BlockRam, 12), Params::default(), false),
        (make(Directions::Six, 12, Memory::Axi, 9), sticky.clone(), false),
        (make(Directions::Fourteen, 10, Memory::Axi, 11), Params::default(), false),
        (EngineParams::default(), sticky, true),
    ];
    let mut rests = 0;
    for (seed, (engine, unit, by_number)) in share(3, (2..).zip(cases)) {
        let design = if by_number { EngineDesign::by_number } else { EngineDesign::new };
        let home = generated(&design(&engine, &unit).unwrap());
        let host = home.path().join("rtl/host");
        compiles_everywhere(&host.join("efsat_engine_pose.h"));
        let counts = poses_agree(&engine, &unit, by_number, &host, if full() { 100_000 } else { 1_000 }, seed);
        assert!(counts[0] > 300 && counts[3] > 4 && counts[4] > 4, "{counts:?}");
        rests += counts[5];
        images_agree(&engine, &unit, &host, 40);
    }
    assert!(rests > 0, "{rests}");
}

/// Images whole and damaged, one bit in each, of which every `step`th is taken.
fn images_agree(engine: &EngineParams, unit: &Params, host: &Path, step: usize) {
    let format = engine.format(unit).unwrap();
    compiled(host, "image", include_str!("image.c"));
    let mut files: Vec<Vec<u8>> = [0, 1, 2, 3].iter().map(|&count| few(&format, count)).collect();
    let whole = files.clone();
    files.extend([
        whole[3][..63].to_vec(),
        vec![],
        whole[3][..whole[3].len() - 1].to_vec(),
        [&whole[3][..], &[0]].concat(),
    ]);
    let large = images(&format, 1.0, [0.0; 3]).remove(1).bytes();
    // Words of a machine with another order of bytes.
    let swapped =
        |bytes: usize| -> Vec<u8> { large.chunks(bytes).flat_map(|word| word.iter().rev().copied()).collect() };
    files.extend([4, 8].map(swapped));
    let changed = |file: &[u8], bit: usize| {
        let mut file = file.to_vec();
        file[bit / 8] ^= 1 << (bit % 8);
        file
    };
    files.extend((0..8 * whole[3].len()).map(|bit| changed(&whole[3], bit)));
    files.extend((0..8 * large.len()).step_by(step).map(|bit| changed(&large, bit)));
    // Links exchanged, so that blocks and triangles are there twice or never.
    let blocks = Image::read(&large).unwrap().header().blocks as usize;
    for (from, to) in (0..2 * blocks).flat_map(|from| (0..2 * blocks).map(move |to| (from, to))) {
        let at = |link: usize| 64 + link / 2 * 64 + link % 2 * 4;
        let mut file = large.clone();
        file.copy_within(at(from)..at(from) + 4, at(to));
        files.push(file);
    }
    let asked: Vec<u8> =
        files.iter().flat_map(|file| [format!("{}\n", file.len()).as_bytes(), file].concat()).collect();
    let found = String::from_utf8(said(host, &["image"], &asked)).unwrap();
    assert_eq!(found.lines().count(), files.len());
    let (mut taken, mut refused) = (0, 0);
    for (file, found) in files.iter().zip(found.lines()) {
        let foreign = |file: &[u8]| file.len() >= 16 && file[..16] != large[..16];
        match (Image::read(file), found) {
            // Another format, of which this engine knows nothing.
            _ if foreign(file) => assert!(found.parse::<usize>().unwrap() < 16, "{found}"),
            (Ok(_), found) => {
                assert_eq!(found, "taken");
                taken += 1;
            }
            (Err(ImageError { at, what, .. }), found) => {
                let due = if what == "end of the file" { "size".to_owned() } else { at.to_string() };
                assert_eq!(found, due, "{what}");
                refused += 1;
            }
        }
    }
    assert!(taken > 20 && refused > 200, "{taken} {refused}");
}

/// The image of so many triangles.
fn few(format: &EngineFormat, count: u32) -> Vec<u8> {
    let mesh = Mesh::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.5], [0.0, 1.0, 0.0]], (0..count).map(|_| [0, 1, 2])).unwrap();
    Image::build(&[&mesh], format).unwrap().remove(0).bytes()
}

#[test]
fn images_are_refused_in_c_as_here() {
    let home = ready();
    let engine = EngineParams::default();
    images_agree(&engine, &engine.unit(), home.path(), if full() { 1 } else { 10 });
}
