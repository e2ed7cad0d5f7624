//! The guard: which pairs are outside the declared ranges, and what the unit goes on with then (contract section 10).

use crate::pair::{Input, Pair, Pose};
use crate::params::{Params, Transform};
use efsat_hardware::number::Upper;

/// The guard of one parameter set; units without one take every number as it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guard {
    there: bool,
    upper: Upper,
    transform: Transform,
    /// Bounds on the magnitudes of coordinates, entries of M, and entries of t.
    coordinate: i64,
    entry: i64,
    translation: i64,
}

impl Guard {
    pub fn new(p: &Params) -> Self {
        Self {
            there: p.has_guards(),
            upper: p.upper,
            transform: p.transform,
            coordinate: p.coordinate_bound() as i64,
            entry: p.one() as i64,
            translation: p.translation_bound() as i64,
        }
    }

    /// Whether every number that the unit reads keeps to its bound; true without a guard.
    pub fn inside(&self, pose: &Pose, pair: &Pair) -> bool {
        if !self.there {
            return true;
        }
        let keep = |numbers: &[[Input; 3]; 3], bound| numbers.iter().flatten().all(|x| self.keeps(*x, bound));
        let (reads_m, reads_t) = self.reads(pose);
        keep(&pair.a, self.coordinate)
            && keep(&pair.b, self.coordinate)
            && (!reads_m || keep(&pose.m, self.entry))
            && (!reads_t || pose.t.iter().all(|x| self.keeps(*x, self.translation)))
    }

    /// The numbers that the data path goes on with: those outside are replaced.
    pub fn held(&self, pose: &Pose, pair: &Pair) -> (Pose, Pair) {
        let (mut pose, mut pair) = (*pose, *pair);
        if !self.there {
            return (pose, pair);
        }
        let (reads_m, reads_t) = self.reads(&pose);
        let hold = |x: &mut Input, bound| {
            if !self.keeps(*x, bound) {
                *x = replaced(*x, bound);
            }
        };
        pair.a.iter_mut().chain(&mut pair.b).flatten().for_each(|x| hold(x, self.coordinate));
        pose.m.iter_mut().flatten().filter(|_| reads_m).for_each(|x| hold(x, self.entry));
        pose.t.iter_mut().filter(|_| reads_t).for_each(|x| hold(x, self.translation));
        (pose, pair)
    }

    /// Whether M and t are read.
    fn reads(&self, pose: &Pose) -> (bool, bool) {
        let t = self.transform != Transform::Off && !pose.bypass;
        (t && self.transform == Transform::On, t)
    }

    /// A number keeps to a bound as the host quantises it: the lower bound is not below, the exact upper one not above;
    /// with implied upper bounds there is no sticky bit to read.
    fn keeps(&self, x: Input, bound: i64) -> bool {
        let above = i64::from(self.upper == Upper::Sticky && x.sticky);
        -bound <= x.lo && x.lo + above <= bound
    }
}

/// The low bits of the word, as many as there are in a number below the greatest power of two within the bound.
fn replaced(x: Input, bound: i64) -> Input {
    Input { lo: x.lo & ((1 << bound.ilog2()) - 1), ..x }
}
