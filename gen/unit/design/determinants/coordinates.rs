//! The differences brought to the working width, each coordinate axis by its own shift (section 3 of
//! docs/determinants.md).

use super::super::axis_shift::steps;
use super::super::guard::any;
use super::{Points, constant, shared, table, traced, word};
use crate::params::{ErrorLevels, Params};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top, Vec3};
use efsat_hardware::op::{Range, Select, Type};

/// The five points in the working width.
pub(super) struct Coordinates<'l> {
    pub points: Points<'l>,
    pub level: Level<'l>,
}

/// The error level: a coordinate is wrong by at most 1/2 + 2^(level-3).
#[derive(Clone, Copy)]
pub(super) struct Level<'l> {
    /// None where it is always 0.
    pub signal: Option<Sig<'l>>,
    /// The greatest there is.
    pub most: u32,
}

impl<'l> Level<'l> {
    /// x 2^level.
    pub fn shifted(self, x: Sig<'l>) -> Sig<'l> {
        by_number(self.signal, |level| x.floor(-(level as i32)), self.most)
    }
}

/// One of some signals, by a number from 0 to `most`; the first where there is no number.
pub(in super::super) fn by_number<'l>(number: Option<Sig<'l>>, of: impl Fn(u32) -> Sig<'l>, most: u32) -> Sig<'l> {
    let Some(number) = number else { return of(0) };
    number.apply(Select::default(), &(0..=most).map(of).collect::<Vec<_>>())
}

/// How far differences are shifted.
#[derive(Clone, Copy)]
pub struct Scale {
    width: u32,
    /// Bits of the magnitude of a difference.
    reach: u32,
    /// The bits dropped at least, d.
    least: u32,
    /// The bits dropped without a shift.
    most: u32,
    /// The error level of differences of which nothing is dropped, and the greatest there is.
    fine: u32,
    greatest: u32,
}

impl Scale {
    /// For differences within a range.
    pub fn new(p: &Params, range: Range) -> Self {
        let ErrorLevels { least, fine, greatest } = p.error_levels();
        let reach = 128 - range.1.max(-1 - range.0).leading_zeros();
        let most = (reach + 1).saturating_sub(p.width).max(least);
        Self { width: p.width, reach, least, most, fine, greatest: greatest.min(fine - least) }
    }

    /// The steps of the barrel shifter, a flag for each.
    fn steps(&self) -> Vec<u32> {
        steps(self.most - self.least)
    }

    /// Before the last bit is rounded off there is one more.
    fn before_rounding(&self) -> Type {
        Type { signed: true, bits: self.width + 1, fraction: None }
    }
}

/// The coordinates.
pub(super) fn coordinates<'l>(u: Top<'l>, p: &Params, differences: &Points<'l>) -> Coordinates<'l> {
    let all = differences.all().signals();
    let least = all.iter().map(|x| x.range().0).min().unwrap_or(0);
    let most = all.iter().map(|x| x.range().1).max().unwrap_or(0);
    let scale = Scale::new(p, (least, most));
    let shift = Vec3::each(|j| axis_shift(&scale, differences.along(j))).named("shift");
    let cut = shared(u, "coordinate_cut", &differences.all(), |k, x| {
        shifted(&scale, x.named_at("lane", k), shift.clone()).named_at("lane_shifted", k)
    });
    let cut: [Vec3<Sig<'l>>; 5] = std::array::from_fn(|i| cut[i]);
    let carried = Vec3::each(|j| carries(&scale, cut.map(|x| x[j]))).named("carried");
    let points = Points::of(cut.map(|x| rounded(&scale, x, carried))).traced("coordinate");
    let level = (scale.greatest > 0).then(|| {
        let taken =
            |j: usize| word(&[shift[j].as_slice(), &[carried[j]]].concat(), &format!("taken_{}", ["x", "y", "z"][j]));
        let [x, y, z] = [0, 1, 2].map(|j| level(&scale, taken(j))).named("axis_level");
        traced(greater(greater(x, y), z).resize(Type::index(scale.greatest as usize + 1)), "level")
    });
    Coordinates { points, level: Level { signal: level, most: scale.greatest } }
}

fn greater<'l>(x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    let signed = |x: Sig<'l>| x.resize(Type { signed: true, bits: x.ty().bits + 1, fraction: None });
    signed(x).less(signed(y)).choose(y, x)
}

/// How far the five differences along an axis go left, a flag for each step.
pub fn axis_shift<'l>(scale: &Scale, x: [Sig<'l>; 5]) -> Vec<Sig<'l>> {
    let doc = [
        "How far the five differences along a coordinate axis go left: by the leading zeros that they have in common, but by",
        "no more than leaves the least number of bits to drop. A flag for each step of the shift.",
    ];
    if scale.steps().is_empty() {
        return vec![];
    }
    entity!("coordinate_shift", &doc, (x) => {
        // The complement of a negative number is one short of its magnitude. Only for powers of two that is another
        // length, and they are seen when rounding carries.
        let magnitude = |x: Sig<'l>| {
            let low = x.low(scale.reach);
            x.negative().choose(!low, low)
        };
        let mut word = x.map(magnitude).named("magnitude").into_iter().reduce(|a, b| a | b).expect("five points");
        let mut flags = vec![];
        for (i, step) in scale.steps().into_iter().enumerate() {
            let zero = (!word.floor((scale.reach - step) as i32).any()).named(&format!("zero_{i}"));
            flags.push(zero.comment(&format!("the top {step} bits are zero")));
            word = zero.choose(word.shift_left(step), word).named(&format!("word_{i}"));
        }
        flags.named("shift")
    })
}

/// A point shifted and cut to one bit more than the working width.
pub fn shifted<'l>(scale: &Scale, x: Vec3<Sig<'l>>, shift: Vec3<Vec<Sig<'l>>>) -> Vec3<Sig<'l>> {
    let doc = [
        "The differences of a point go left, each axis by its own shift; what is cut off below leaves one bit to round by:",
        "floor(2 x / 2^d).",
    ];
    entity!("coordinate_scale", &doc, (x, shift) => {
        let positions = scale.most - scale.least;
        let bits = scale.width + 1 + positions;
        let mut x = x.map(|x| x.floor(scale.least as i32 - 1).bits(bits));
        for (i, step) in scale.steps().into_iter().enumerate() {
            let one = |j: usize| shift[j][i].choose(x[j].shift_left(step), x[j]);
            x = Vec3::each(one).named(&format!("shifted_{i}")).map(|x| x.floor(step as i32));
        }
        x.map(|x| x.resize(scale.before_rounding())).named("cut")
    })
}

/// Whether rounding carries one of five coordinates to R or -R, which is a bit too far.
pub fn carries<'l>(scale: &Scale, cut: [Sig<'l>; 5]) -> Sig<'l> {
    let doc = ["Whether rounding makes R or -R of a coordinate along an axis: then a bit more is dropped."];
    entity!("coordinate_carry", &doc, (cut) => {
        let (least, most) = scale.before_rounding().limits();
        let carries = |x: Sig<'l>| x.equals(x.like(least)) | x.equals(x.like(most));
        any(&cut.map(carries)).named("carried")
    })
}

/// The coordinates of a point, rounded.
pub fn rounded<'l>(scale: &Scale, cut: Vec3<Sig<'l>>, carried: Vec3<Sig<'l>>) -> Vec3<Sig<'l>> {
    let doc = ["The coordinates of a point: the last bit rounded off, or the last two where an axis carries."];
    let most = (1 << (scale.width - 1)) - 1;
    entity!("coordinate_round", &doc, (cut, carried) => {
        let chosen = cut.zip(carried, |x, carried| carried.choose(x.floor(1), x)).named("chosen");
        let round = |x: Sig<'l>| (x + constant(x.block(), 1)).floor(1).assume(most, "coordinate").bits(scale.width);
        chosen.map(round).named("y")
    })
}

/// The error level of an axis, from the flags of its shift and whether it carries, side by side.
fn level<'l>(scale: &Scale, taken: Sig<'l>) -> Sig<'l> {
    let steps = scale.steps();
    let entry = |word: u32| {
        let taken = steps.iter().enumerate().filter(|(i, _)| word >> i & 1 == 1);
        let carried = word >> steps.len() & 1;
        let dropped = scale.most + carried - taken.map(|(_, step)| step).sum::<u32>();
        i128::from(scale.fine.saturating_sub(dropped).min(scale.greatest))
    };
    table(taken, (0..2 << steps.len()).map(entry).collect())
}
