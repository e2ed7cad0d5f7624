//! Formats of 4-bit codes, factors and origins, for which every case can be tried.

use crate::host::Numbers;
use crate::host::numbers::Fine;
use crate::model::{Block, Frame, Link, bounds, distance};
use crate::params::EngineParams;
use efsat_geometry::directions::Directions;
use efsat_unit::pair::{Input, Pose};
use efsat_unit::params::Params;

fn tiny(directions: Directions) -> Numbers {
    let engine = EngineParams { directions, origin_bits: 4, offset_bits: 4, factor_bits: 4, ..EngineParams::default() };
    Numbers::new(&engine, &Params::default()).unwrap()
}

/// All vectors of whole numbers within +-most.
fn cube(most: i32) -> impl Iterator<Item = [i32; 3]> {
    let range = move || -most..=most;
    range().flat_map(move |x| range().flat_map(move |y| range().map(move |z| [x, y, z])))
}

/// A matrix in steps of 2^-ENTRY.
type Matrix = [[i32; 3]; 3];
const ENTRY: u32 = 10;
/// Fraction bits of a shift.
const SHIFT: u32 = 40;

/// What a query says of a pose, if no row misses too much.
fn frame(numbers: &Numbers, m: &Matrix, t: [i64; 3]) -> Option<Frame> {
    let format = numbers.format();
    let real = m.map(|row| row.map(|x| f64::from(x) / f64::from(1 << ENTRY)));
    let fine = real.map(|row| row.map(Fine::of));
    let pose = Pose {
        m: m.map(|row| row.map(|x| Input::exact(i64::from(x) << (format.word_fraction() - ENTRY)))),
        t: t.map(|x| Input::exact(x >> (SHIFT - format.word_fraction()))),
        bypass: false,
    };
    let matrix = Frame::matrix(&pose, format);
    let errors = [0, 1, 2].map(|axis| numbers.shift_error(&fine[axis], &matrix[axis]));
    let rows = numbers.rows(&real, &fine).ok()?;
    Some(Frame::new(&pose, errors, rows, format))
}

/// A block whose children both have these codes.
fn block(origin: [i32; 3], exponent: u32, codes: Vec<i32>) -> Block {
    Block { links: [Link::Leaf(0); 2], origin, exponent, codes: [codes.clone(), codes] }
}

/// Every origin of 4 bits, under matrices with entries on the steps of 4 bits, beside them, between them and at the ends: D is
/// not further from the real number than the error says.
#[test]
fn distances_are_within_their_errors_at_tiny_widths() {
    let numbers = tiny(Directions::Six);
    let format = numbers.format();
    let entries = [-1024, -1023, -717, -129, 0, 1, 333, 895, 1024];
    let shifts = [0, -0x1234_5678_9abc, (1 << SHIFT) - 1];
    let (here, grid) = (block([0; 3], 0, vec![]), SHIFT - format.grid_fraction());
    let (mut worst, mut compared) = (0.0f64, 0);
    for (x, y) in entries.into_iter().flat_map(|x| entries.into_iter().map(move |y| (x, y))) {
        for (number, z) in entries.into_iter().enumerate() {
            let (row, shift) = ([x, y, z], shifts[number % shifts.len()]);
            let Some(frame) = frame(&numbers, &[row, [0; 3], [0; 3]], [shift, 0, 0]) else { continue };
            let error = f64::from(frame.errors[0]);
            for origin in cube(format.most_origin()) {
                let [found, ..] = distance(&frame, &here, &block(origin, 0, vec![]), format);
                let turned: i64 = row.iter().zip(origin).map(|(&m, o)| i64::from(m) * i64::from(o)).sum();
                let real = (turned << (SHIFT - ENTRY - format.origin_fraction())) + shift;
                let missed = (real - (found << grid)).abs() as f64 / f64::from(1 << grid);
                assert!(missed <= error, "row {row:?}, origin {origin:?}: {missed} of {error}");
                worst = worst.max(missed / error);
                compared += 1;
            }
        }
    }
    assert!(worst > 0.7 && compared > 500_000, "{worst}, {compared} compared");
}

/// The theorem itself: a point of B's volume that the pose puts into A's, for every point that B's codes can hold, under turns,
/// shears and singular matrices, from near and far origins: no direction says that the volumes are apart. Both volumes are as
/// small as their codes allow.
#[test]
fn no_common_point_is_lost_at_tiny_widths() {
    let matrices: [Matrix; 10] = [
        [[1024, 0, 0], [0, 1024, 0], [0, 0, 1024]],
        [[0, -1024, 0], [1024, 0, 0], [0, 0, 1024]],
        [[819, -614, 0], [614, 819, 0], [0, 0, 1024]],
        [[-341, 682, 682], [682, -341, 682], [682, 682, -341]],
        [[1024, 700, 0], [0, 1024, -3], [0, 0, 1024]],
        [[333, -71, 512], [9, 8, 7], [-1024, 1, 130]],
        [[0; 3]; 3],
        [[512, -256, 100], [-512, 256, -100], [256, -128, 50]],
        [[1024, 0, 77], [0, 1023, -500], [0; 3]],
        [[1, 1, 1], [-1, 1, -1], [1024, 1024, 1024]],
    ];
    let shifts = [[0; 3], [0x4321_8765_4321, -0x1111_1111, 77], [-0xf0f0_f0f0, (1 << 39) + 1, -1]];
    let origins = [[0; 3], [7, -7, 3], [-1, 5, -6]];
    let (mut met, mut near) = (0, 0);
    for directions in Directions::ALL {
        let numbers = tiny(directions);
        let format = numbers.format();
        let most = format.most();
        let codes = |point: [i128; 3], drop: u32| -> Vec<i32> {
            let along = |i| directions.vector(i).iter().zip(point).map(|(&n, x)| i128::from(n) * x).sum::<i128>();
            (0..directions.count()).map(|i| -(-along(i) >> drop) as i32).collect()
        };
        let held = |codes: &[i32]| codes.iter().all(|code| code.abs() <= most);
        // Points in steps of 2^-(SHIFT + ENTRY).
        let (step, grid) = (SHIFT + ENTRY - format.origin_fraction(), SHIFT + ENTRY - format.grid_fraction());
        for (number, m) in matrices.iter().enumerate() {
            for (t, origin) in shifts.into_iter().flat_map(|t| origins.into_iter().map(move |origin| (t, origin))) {
                let Some(frame) = frame(&numbers, m, t) else { continue };
                for exponent in [0, 9, 13] {
                    for z in cube(most) {
                        let of_b = codes(z.map(i128::from), 0);
                        if !held(&of_b) {
                            continue;
                        }
                        let y = [0, 1, 2].map(|j| {
                            (i128::from(origin[j]) << (step - ENTRY)) + (i128::from(z[j]) << (exponent + grid - ENTRY))
                        });
                        let x = [0, 1, 2].map(|i| {
                            let turned: i128 = m[i].iter().zip(y).map(|(&m, y)| i128::from(m) * y).sum();
                            turned + (i128::from(t[i]) << ENTRY)
                        });
                        let around = x.map(|x| (x >> step).clamp(-7, 7) as i32);
                        let off = [0, 1, 2].map(|i| x[i] - (i128::from(around[i]) << step));
                        let fits = (0..16).map(|e| (e, codes(off, e + grid))).find(|(_, codes)| held(codes));
                        let Some((e, of_a)) = fits else { continue };
                        let (a, b) = (block(around, e, of_a), block(origin, exponent, of_b));
                        let distance = distance(&frame, &a, &b, format);
                        let gap = |h| -> i64 {
                            bounds(h, &distance, &frame, &a.volume(0), &b.volume(0), format).iter().sum()
                        };
                        let least = (0..directions.count()).map(gap).min().unwrap();
                        assert!(
                            least >= 0,
                            "{directions:?}, matrix {number}, {t:?}, origin {origin:?}, z {z:?}: {least}"
                        );
                        met += 1;
                        near += u32::from(least < 2 << e.max(exponent));
                    }
                }
            }
        }
    }
    assert!(met > 200_000 && near > met / 20, "{met} met, {near} of them nearly apart");
}

/// With 4-bit factors and 4-bit codes: for every w on a grid finer than that of factors, and every point that codes can hold,
/// w . z <= 2^-3 S.
#[test]
fn rows_hold_every_point_at_tiny_widths() {
    let mut worst = 0.0f64;
    for directions in Directions::ALL {
        let numbers = tiny(directions);
        let format = numbers.format();
        let most = format.most();
        let range = || -most..=most;
        let points = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
        let codes = |z: [i32; 3]| -> Vec<i32> {
            let along = |i| directions.vector(i).iter().zip(z).map(|(&n, z)| i32::from(n) * z).sum();
            (0..directions.count()).map(along).collect()
        };
        let points: Vec<_> = points.map(|z| (z, codes(z))).filter(|(_, c)| c.iter().all(|c| c.abs() <= most)).collect();
        let steps = || -8..=8;
        for w in steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| [x, y, z]))) {
            // Sixteenths and a bit, so that some are between the steps of a factor.
            let w = w.map(|x| f64::from(x) / 8.0 * 0.96875);
            let m = [w, [0.0; 3], [0.0; 3]];
            let Ok(row) = numbers.row(0, &m, &m.map(|row| row.map(Fine::of))) else { continue };
            for (z, codes) in &points {
                let real: f64 = w.iter().zip(z).map(|(w, &z)| w * f64::from(z)).sum();
                // The direction of the row, and the opposite one.
                for (turned, real) in [(0, real), (1, -real)] {
                    let terms = row.terms.iter().zip(directions.slots());
                    let of = |(&(choice, factor), slot): (&(u32, u32), &[u8])| {
                        factor as i32 * codes[usize::from(slot[choice as usize]) ^ turned]
                    };
                    let sum = terms.map(of).sum::<i32>() + row.rest as i32;
                    let excess = f64::from(sum) - 8.0 * real;
                    assert!(excess >= 0.0, "{directions:?}, w {w:?}, z {z:?}, {turned}");
                    worst = worst.max(excess);
                }
            }
        }
    }
    // At most twice the rest, which is that of three factors, each wrong by half a step.
    assert!(worst > 7.0 && worst <= 2.0 * (7.0 * 3.5 + 1.0), "{worst}");
}
