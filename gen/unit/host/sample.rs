//! Seeded inputs: ordinary, near contact, and at the corners of the declared ranges.
//!
//! Quantised inputs stay inside the declared ranges as mantissas: the real number that an [`Input`] stands for lies in
//! [-bound, bound]. Those that shall not are made from them one by one ([`Outside`]). Numbers depend on the generator's
//! state only, so a seed names its inputs on every machine.

use efsat_geometry::Points;
use efsat_geometry::sample::{shape, signed};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::pair::{Input, Pair, Pose};
use crate::params::{Method, Params, Transform, Truth, Upper};

/// A pair of random triangles of mixed sizes, many of them near contact, in one frame (for a bypassed pose).
pub fn random_pair(rng: &mut ChaCha8Rng, params: &Params) -> Pair {
    let points = shape(rng);
    let bound = params.coordinate_bound();
    quantised_pair(rng, &points, bound)
}

/// As [`random_pair`], with the relation between the triangles (near contact and so on) holding after the pose, as far
/// as B~ then fits the declared range.
pub fn random_pair_under(rng: &mut ChaCha8Rng, params: &Params, pose: &Pose) -> Pair {
    if params.method == Method::Exact && (params.truth == Truth::Given || pose.bypass) {
        return grid_pair(rng, params, pose);
    }
    if pose.bypass {
        return random_pair(rng, params);
    }
    let (bound, one) = (params.coordinate_bound() as f64, params.one() as f64);
    let real = |x: Input| x.lo as f64 / one;
    let m = Matrix3::from_fn(|i, j| real(pose.m[i][j]));
    let t = Vector3::from(pose.t.map(real));
    let inverse = m.try_inverse().unwrap_or_else(Matrix3::identity);
    let mut points = shape(rng);
    for point in &mut points[3..] {
        let x = Vector3::from(*point) * (bound / one) - t;
        *point = (inverse * x * (one / bound)).into();
    }
    quantised_pair(rng, &points, params.coordinate_bound())
}

/// A pair of the exact unit, almost always one that fits, of any size and anywhere: small multiples of two or three
/// directions, so that vertices are on edges and planes of the other triangle and many pairs are in one plane or on two
/// lines; some points are off by one.
fn grid_pair(rng: &mut ChaCha8Rng, params: &Params, pose: &Pose) -> Pair {
    let size = 1 << rng.random_range(0..=params.grid_bits() - 5);
    let directions = rng.random_range(1..=3);
    let [x, y, z] = [(); 3].map(|()| [(); 3].map(|()| rng.random_range(-size..=size)));
    let lines = rng.random_range(0..8) == 0;
    let mut point = |i: usize| {
        let mut times = [(); 3].map(|()| rng.random_range(-2..=2));
        times[directions..].fill(0);
        if lines {
            // A on one line, B on another that meets it.
            times = [if i < 3 { times[0] } else { 0 }, if i < 3 { 0 } else { times[0] }, 0];
        }
        let off = if rng.random_range(0..16) == 0 { rng.random_range(-1..=1) } else { 0 };
        std::array::from_fn(|j| times[0] * x[j] + times[1] * y[j] + times[2] * z[j] + off)
    };
    let points: [[i64; 3]; 6] = std::array::from_fn(&mut point);
    placed(rng, params, pose, points)
}

/// Points of a grid moved to anywhere where all words hold them, B~ so that it comes there.
pub fn placed(rng: &mut ChaCha8Rng, params: &Params, pose: &Pose, points: [[i64; 3]; 6]) -> Pair {
    let bound = params.coordinate_bound() as i64;
    let t = if pose.bypass || params.transform == Transform::Off { [0; 3] } else { pose.t.map(|x| x.lo) };
    let place: [i64; 3] = std::array::from_fn(|j| {
        let a = points[..3].iter().map(|x| x[j]);
        let all = a.chain(points[3..].iter().map(|x| x[j] - t[j]));
        let (least, most) = all.fold((i64::MAX, i64::MIN), |(least, most), x| (least.min(x), most.max(x)));
        if most - least > 2 * bound { 0 } else { rng.random_range(-bound - least..=bound - most) }
    });
    let at = |i: usize, t: [i64; 3]| {
        std::array::from_fn(|j| Input::exact((points[i][j] - t[j] + place[j]).clamp(-bound, bound)))
    };
    Pair { a: [0, 1, 2].map(|i| at(i, [0; 3])), b: [3, 4, 5].map(|i| at(i, t)) }
}

/// A proper rotation with a translation in the declared range; sometimes axis-parallel, sometimes bypassed.
pub fn random_pose(rng: &mut ChaCha8Rng, params: &Params) -> Pose {
    let mut pose = Pose::identity(params);
    if rng.random_range(0..8) == 0 {
        return pose;
    }
    pose.bypass = false;
    let q = match rng.random_range(0..6) {
        0 => Quaternion::identity(),
        // A half or quarter turn: exact entries 0 and +-1.
        1 => [Quaternion::new(0.0, 1.0, 0.0, 0.0), Quaternion::new(1.0, 0.0, 0.0, 1.0)][rng.random_range(0..2)],
        _ => Quaternion::new(signed(rng), signed(rng), signed(rng), signed(rng)),
    };
    let turn = if q.norm() > 0.0 { UnitQuaternion::from_quaternion(q) } else { UnitQuaternion::identity() };
    let matrix = turn.to_rotation_matrix();
    let scale = (-f64::from(rng.random_range(0..12u32))).exp2();
    for i in 0..3 {
        for j in 0..3 {
            let entry = matrix[(i, j)];
            let nearest = entry.round();
            let exact = (entry - nearest).abs() < 1e-12;
            pose.m[i][j] = if exact {
                Input::exact(nearest as i64 * params.one() as i64)
            } else {
                quantised(rng, entry, params.one(), params.one())
            };
        }
        let (entry, bound) = (signed(rng) * scale, params.translation_bound());
        pose.t[i] = quantised(rng, entry, bound, bound);
    }
    pose
}

/// A pair whose every coordinate is at an end, at the middle or next to one of them in its declared range.
pub fn corner_pair(rng: &mut ChaCha8Rng, params: &Params) -> Pair {
    if params.method == Method::Exact {
        // Differences at the ends of what fits, and one beyond.
        let half = 1 << (params.width - 2);
        let ends = [-half, 1 - half, -1, 0, 1, half - 1, half];
        let points = [(); 6].map(|()| [(); 3].map(|()| ends[rng.random_range(0..ends.len())]));
        return placed(rng, params, &Pose::identity(params), points);
    }
    let bound = params.coordinate_bound() as i64;
    let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| corner(rng, bound)));
    Pair { a: triangle(), b: triangle() }
}

/// A pose whose every entry is at an end, at the middle or next to one of them in its declared range.
pub fn corner_pose(rng: &mut ChaCha8Rng, params: &Params) -> Pose {
    let (one, reach) = (params.one() as i64, params.translation_bound() as i64);
    Pose {
        m: [(); 3].map(|()| [(); 3].map(|()| corner(rng, one))),
        t: [(); 3].map(|()| corner(rng, reach)),
        bypass: rng.random_range(0..16) == 0,
    }
}

/// How a number leaves its declared range; the host sends none that does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// One ulp below.
    JustBelow,
    /// One ulp above; with sticky bits the greatest number of the range with its bit set.
    JustAbove,
    /// The least number of the word.
    Least,
    /// The greatest number of the word.
    Greatest,
    /// Anywhere.
    Anywhere,
}

impl Outside {
    /// All ways.
    pub const ALL: [Self; 5] = [Self::JustBelow, Self::JustAbove, Self::Least, Self::Greatest, Self::Anywhere];

    /// A number outside [-bound, bound].
    fn number(self, rng: &mut ChaCha8Rng, params: &Params, bound: i128) -> Input {
        let (bound, end) = (bound as i64, 1 << (params.transform_width - 1));
        let sticky = params.upper == Upper::Sticky;
        let lo = match self {
            Self::JustBelow => -bound - 1,
            Self::JustAbove => (bound + i64::from(!sticky)).min(end - 1),
            Self::Least => -end,
            Self::Greatest => end - 1,
            // Of the exact unit no word is outside by itself.
            Self::Anywhere if bound + 1 == end => rng.random_range(-end..end),
            Self::Anywhere if rng.random() => rng.random_range(bound + 1..end),
            Self::Anywhere => rng.random_range(-end..-bound),
        };
        Input { lo, sticky: (sticky && self == Self::JustAbove) || rng.random() }
    }
}

/// The pair with coordinate `number` (0 to 17, V0 V1 V2 W0 W1 W2) outside its declared range.
pub fn pair_outside(rng: &mut ChaCha8Rng, params: &Params, mut pair: Pair, number: usize, how: Outside) -> Pair {
    let coordinate = pair.a.iter_mut().chain(&mut pair.b).flatten().nth(number).expect("18 coordinates");
    *coordinate = how.number(rng, params, params.coordinate_bound());
    pair
}

/// The numbers of a pose that the unit reads where it is not bypassed.
pub fn pose_size(params: &Params) -> usize {
    match params.transform {
        Transform::On => 12,
        Transform::Translate => 3,
        Transform::Off => 0,
    }
}

/// The pose with number `number` of those that the unit reads outside its declared range.
pub fn pose_outside(rng: &mut ChaCha8Rng, params: &Params, mut pose: Pose, number: usize, how: Outside) -> Pose {
    let entry = number + 12 - pose_size(params);
    let bound = if entry < 9 { params.one() } else { params.translation_bound() };
    *pose.m.iter_mut().flatten().chain(&mut pose.t).nth(entry).expect("12 numbers") = how.number(rng, params, bound);
    pose
}

/// One of the numbers where a range is most likely to be handled wrongly, with either sticky bit.
fn corner(rng: &mut ChaCha8Rng, bound: i64) -> Input {
    let lo = match rng.random_range(0..9) {
        0 => bound,
        1 => bound - 1,
        2 => -bound,
        3 => -bound + 1,
        4 => 0,
        5 => 1,
        6 => -1,
        7 => bound / 2,
        _ => rng.random_range(-bound..=bound),
    };
    Input { lo, sticky: lo < bound && rng.random() }
}

/// The floor of `x * unit`, held inside [-bound, bound], with a random sticky bit.
fn quantised(rng: &mut ChaCha8Rng, x: f64, unit: i128, bound: i128) -> Input {
    let bound = bound as i64;
    let lo = ((x * unit as f64).floor() as i64).clamp(-bound, bound);
    Input { lo, sticky: lo < bound && rng.random() }
}

/// Points in units of the bound; numbers on the grid are exact in half of the pairs.
fn quantised_pair(rng: &mut ChaCha8Rng, points: &Points, bound: i128) -> Pair {
    let sticky: bool = rng.random();
    let p = points.map(|point| {
        point.map(|x| {
            let mut input = quantised(rng, x, bound, bound);
            input.sticky &= sticky;
            input
        })
    });
    Pair { a: [p[0], p[1], p[2]], b: [p[3], p[4], p[5]] }
}
