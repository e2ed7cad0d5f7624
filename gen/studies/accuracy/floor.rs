//! The floor: what stays possibly incorrect however wide the unit is, and why.

use super::Answers;
use super::causes::{Case, Model, Reason, Reasons};
use super::pairs::{Asked, Pairs};
use efsat_unit::golden::Lossless;
use efsat_unit::params::{Axes, AxisKind, Params, Projections, Upper};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Pairs that are looked at, at most.
const SAMPLE: usize = 20_000;

/// What keeps an axis from showing an overlap, as counts over pairs and axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Blocks {
    /// The axis is zero: parallel edges, or no normal.
    pub zero: u64,
    /// It is not, but projects all six points to one number.
    pub flat: u64,
    /// The exact images touch or are disjoint.
    pub apart: u64,
    /// They overlap by less than the widest unit resolves.
    pub rounding: u64,
}

/// The floor of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Floor {
    /// What the widest unit answers.
    pub answers: Answers,
    /// Its undecided pairs that were looked at, evenly spread.
    pub examined: u64,
    /// Those of them that no width decides, by reason.
    pub reasons: Reasons,
    /// The others: undecided for want of bits.
    pub rounding: u64,
    /// Of those examined the axes that show no overlap, by kind of axis: n_A, n_B, C_kl.
    pub axes: BTreeMap<String, Blocks>,
}

/// The most accurate unit there is: widest words, 17 axes, exact ceilings, intersected projections.
pub fn widest(base: &Params) -> Params {
    Params {
        width: *efsat_unit::params::options::WIDTH.end(),
        transform_width: efsat_unit::params::options::TRANSFORM_WIDTH,
        axes: Axes::Seventeen,
        projections: Projections::Intersect,
        upper: Upper::Sticky,
        renormalise: true,
        ..base.clone()
    }
}

/// The kind of an axis, as the report names it; none for the six that only separate.
fn kind(axis: AxisKind) -> Option<&'static str> {
    match axis {
        AxisKind::NormalA => Some("n_A"),
        AxisKind::NormalB => Some("n_B"),
        AxisKind::Cross(_) => Some("C_kl"),
        AxisKind::InPlaneA(_) | AxisKind::InPlaneB => None,
    }
}

impl Floor {
    /// Asks the widest unit, and looks at what it leaves undecided.
    pub fn measure(pairs: &Pairs, base: &Params) -> Self {
        let params = widest(base);
        let (answers, undecided) = Answers::ask(pairs, &params);
        let asked = Asked::new(pairs, &params);
        let places = Pairs::spread(&undecided, SAMPLE);
        let exact = Model::new(&params, Lossless::ALL);
        let one = |&place: &u32| {
            let (case, outcome) = (Case::new(&asked, place as usize)?, asked.outcome(place as usize)?);
            let axes = exact.axes(&case);
            Some((Reason::of(pairs.relation(place as usize), &axes), axes, outcome.overlapping))
        };
        let cases: Vec<_> = places.par_iter().filter_map(one).collect();
        let mut floor = Self {
            answers,
            examined: cases.len() as u64,
            reasons: Reasons::default(),
            rounding: 0,
            axes: ["n_A", "n_B", "C_kl"].map(|kind| (kind.to_owned(), Blocks::default())).into(),
        };
        for (reason, axes, overlapping) in cases {
            match reason {
                Some(reason) => floor.reasons.add(reason),
                None => floor.rounding += 1,
            }
            for (i, axis) in axes.iter().enumerate().filter(|(i, _)| overlapping >> i & 1 == 0) {
                let Some(blocks) = kind(axis.kind).and_then(|kind| floor.axes.get_mut(kind)) else { continue };
                let count = match (axis.zero, axis.flat, axis.overlapping) {
                    (true, ..) => &mut blocks.zero,
                    (_, true, _) => &mut blocks.flat,
                    (.., false) => &mut blocks.apart,
                    (.., true) => &mut blocks.rounding,
                };
                debug_assert!(i < 11);
                *count += 1;
            }
        }
        floor
    }

    /// The share of all pairs that no width decides.
    pub fn share(&self) -> f64 {
        let of_examined = self.reasons.total() as f64 / self.examined.max(1) as f64;
        of_examined * self.answers.share()
    }
}
