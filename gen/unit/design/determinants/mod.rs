//! The determinant unit: a pair decided by the signs of fifteen determinants (docs/determinants.md).
//!
//! One file per section of that page: [`differences`], [`coordinates`], [`moments`], `fifteen`, `bounds`, `verdict`.
//! Every stage is shared over the phases of the slot by itself: its units take their jobs one after the other, and what
//! they make is held for the pair.

mod bounds;
pub mod coordinates;
pub mod differences;
pub(super) mod fifteen;
pub mod moments;
mod verdict;

use super::guard::Guards;
use super::pipeline::Inputs;
use super::product::multiplier;
use crate::params::Params;
use efsat_hardware::graph::{Block, Library, Phases, Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;
use std::rc::Rc;
pub(super) use verdict::Outcome;

/// The data path for a parameter set. Its inputs are the pair and its pose, held for the slot; its outputs are
/// `verdict`, `separated` and `overlapping` (bit i: witness i), and `outside` where there is a guard.
pub fn unit(p: &Params) -> Rc<Block> {
    let doc = [
        "The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with",
        "bounds on their errors, verdict. Units are shared over the phases of the slot; a bound at a port covers all uses of",
        "the unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements",
        "of x_held.",
    ];
    Library::default().with_multiplier(multiplier(p)).block("pair_pipeline", &doc, p.interval(), |u| {
        let guards = Guards::new(u, p);
        let inputs = Inputs::new(u, p);
        let doc = ["Section 2: the points relative to V0, B's in A's frame."];
        let differences = u.section("pair_differences", &doc, || differences::points(u, p, &guards, &inputs));
        decided(u, p, &differences, guards.outside(), false)
    })
}

/// What the differences decide: sections 3 to 6. For `crosses` see [`verdict`](verdict::verdict).
pub(super) fn decided<'l>(
    u: Top<'l>,
    p: &Params,
    differences: &Points<'l>,
    outside: Option<Sig<'l>>,
    crosses: bool,
) -> Outcome<'l> {
    let doc = ["Section 3: coordinates of working width, scaled along each axis by itself."];
    let coordinates = u.section("pair_coordinates", &doc, || coordinates::coordinates(u, p, differences));
    let doc = ["Section 4: moments of the edges of B, and the normal of A."];
    let moments = u.section("pair_moments", &doc, || moments::moments(u, p, &coordinates.points));
    let factors = [moments.m[0], moments.m[1], moments.m[2], moments.n];
    let doc = ["Section 4: the fifteen determinants, from ten dot products."];
    let determinants = u.section("pair_determinants", &doc, || {
        let determinants = fifteen::determinants(&coordinates.points, &factors, |jobs| {
            shared(u, "dot", jobs, |k, (x, m)| {
                fifteen::dot_product(x.named_at("dot_x", k), m.named_at("dot_m", k)).named_at("dot_lane", k)
            })
        });
        fifteen::alike(determinants.all(), "compared")
    });
    let bounds = bounds::bounds(u, p, &coordinates, &moments);
    let doc = ["Section 6: signs that are certain, boxes that are apart, witnesses, verdict."];
    u.section("pair_witnesses", &doc, || {
        let signs = verdict::signs(u, determinants, bounds);
        let apart = p.boxes.then(|| verdict::boxes_apart(u, &coordinates));
        verdict::verdict(u, apart, &signs, outside, crosses)
    })
}

/// The points beside V0, which is the origin.
#[derive(Clone, Copy)]
pub struct Points<'l> {
    /// V1 and V2.
    pub v: [Vec3<Sig<'l>>; 2],
    /// W0, W1 and W2.
    pub w: [Vec3<Sig<'l>>; 3],
}

impl<'l> Points<'l> {
    /// All five.
    pub(super) fn all(&self) -> [Vec3<Sig<'l>>; 5] {
        let Self { v: [v1, v2], w: [w0, w1, w2] } = *self;
        [v1, v2, w0, w1, w2]
    }

    pub(super) fn of([v1, v2, w0, w1, w2]: [Vec3<Sig<'l>>; 5]) -> Self {
        Self { v: [v1, v2], w: [w0, w1, w2] }
    }

    /// The five coordinates along axis `j`.
    pub(super) fn along(&self, j: usize) -> [Sig<'l>; 5] {
        self.all().map(|point| point[j])
    }

    /// Names the points and brings them out of a probed design.
    pub(super) fn traced(self, stage: &str) -> Self {
        let v = [0, 1].map(|i| traced(self.v[i], &format!("{stage}_v{}", i + 1)));
        let w = [0, 1, 2].map(|l| traced(self.w[l], &format!("{stage}_w{l}")));
        Self { v, w }
    }
}

/// Names what is held for the pair and brings it out of a probed design.
pub(super) fn traced<'l, B: Signals<'l>>(bundle: B, name: &str) -> B {
    bundle.named(name).probe(&[(0, false)])
}

/// What a unit makes of each job, held for the pair. There are as few units as the phases of the slot allow: with n of
/// them, unit k takes the jobs k, k + n, k + 2 n and so on. The unit is told its number.
pub fn shared<'l, B, R>(u: Top<'l>, name: &str, jobs: &[B], unit: impl Fn(usize, B) -> R) -> Vec<R>
where
    B: Signals<'l>,
    R: Signals<'l>,
{
    let units = jobs.len().div_ceil(u.interval());
    let mut results: Vec<Option<R>> = vec![None; jobs.len()];
    for k in 0..units {
        let phases = Phases::new(u.interval(), |s| Some(s * units + k).filter(|job| *job < jobs.len()));
        let result = unit(k, phases.map(|job| jobs[*job].clone()).mux());
        phases.capture(&result).for_each(|(job, value)| results[*job] = Some(value));
    }
    let results: Vec<R> = results.into_iter().map(|result| result.expect("every job has a unit")).collect();
    results.named(name)
}

/// Whether a flag is set for some job of units that are [`shared`]: `flags` are what the units say in each phase.
fn any_phase<'l>(u: Top<'l>, flags: &[Sig<'l>], jobs: usize, name: &str) -> Sig<'l> {
    let found = super::guard::any(flags).named(&format!("{name}_found"));
    if u.interval() == 1 {
        return found.capture(0, false);
    }
    let last = jobs.div_ceil(jobs.div_ceil(u.interval())) - 1;
    let first = Phases::new(u.interval(), |s| Some(i128::from(s == 0))).constant(u, Type::FLAG);
    found.or_over_phases(first).named(&format!("{name}_so_far")).capture(last, false)
}

/// An unsigned constant in as few bits as it takes.
fn constant(u: Top<'_>, value: i128) -> Sig<'_> {
    u.constant(value, Type::unsigned((128 - value.leading_zeros()).max(1)))
}

/// A table indexed by a signal, an entry for each of its values, in as few bits as they take.
pub(super) fn table<'l>(index: Sig<'l>, entries: Vec<i128>) -> Sig<'l> {
    let most = entries.iter().copied().max().unwrap_or(0);
    index.lookup(entries, Type::unsigned((128 - most.leading_zeros()).max(1)))
}

/// Numbers side by side as one of that name, the first in the lowest bits: an index of a table.
pub(super) fn word<'l>(parts: &[Sig<'l>], name: &str) -> Sig<'l> {
    if let [one] = parts { *one } else { parts[0].below(&parts[1..]).named(name) }
}
