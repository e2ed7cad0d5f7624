//! The guard of a unit (section 10 of the contract): every number is checked where few of them pass, and one outside its
//! declared range is replaced, so that nothing behind sees a number for which its formats are not proven.
//!
//! Units that are shared over phases (lanes, transform rows) have one guard for each number that enters them, behind the
//! choice of the phase; numbers that enter all at once have one each.

use super::axes::Axis;
use super::axis_stage::lagged;
use super::cross_product::COORDINATES;
use super::interval::{Bounds, symmetric};
use super::pipeline::{Pipeline, Source};
use super::transform_row::{Quantised, input_type};
use crate::params::Params;
use efsat_hardware::graph::{Builder, NodeId, Op, Rate, Type, Unit};
use efsat_hardware::number::Upper;
use std::rc::Rc;

/// The guard of numbers within `bound`: what the unit goes on with, and whether the number is outside.
///
/// With `2^d` the greatest power of two that divides the bound, the number is `h 2^d + low`: it is outside where `h` is
/// beyond `bound / 2^d`, or equal to it with something below.
pub fn unit(name: &str, p: &Params, bound: i128) -> Rc<Unit> {
    let ty = input_type(p);
    let mut b = Builder::new(
        name,
        1,
        &[
            "The guard of an input number (section 10 of the contract): outside its declared range it is flagged, and its",
            "low bits alone go on, a number inside. Whatever the word is, all formats behind hold what is computed from it.",
        ],
    );
    let x = b.input("word", ty, ty.limits(), Rate::Any);
    let sticky = (p.upper == Upper::Sticky).then(|| b.input("word_sticky", Type::FLAG, (0, 1), Rate::Any));
    let cut = bound.trailing_zeros();
    let most = bound >> cut;
    let high = b.op("high", Op::Floor(cut), &[x]);
    let low = b.op("low", Op::LowBits(cut), &[x]);
    let some = b.op("low_some", Op::AnyBit, &[low]);
    let more = match sticky {
        Some(sticky) => b.op("more", Op::Or, &[some, sticky]),
        None => some,
    };
    let mut equals = |name: &str, of: NodeId, value: i128| {
        let ty = b.ty(of);
        let end = b.constant(&format!("{name}_value"), value, ty);
        b.op(name, Op::Equal, &[of, end])
    };
    let (at_most, below) = (equals("at_most", high, most), equals("just_below", high, -most - 1));
    let above = b.and("just_above", at_most, more);
    b.comment(above, format!("word > {bound}, by less than {}", 1i128 << cut));
    b.comment(below, format!("word < -{bound}, by at most {}", 1i128 << cut));
    let mut reasons = vec![above, below];
    // `most` is q 2^k - 1, so what is left is a matter of the bits above k.
    let again = (most + 1).trailing_zeros();
    let reach = (most + 1) >> again;
    let top_bits = b.ty(high).bits - again;
    if reach < 1 << (top_bits - 1) {
        let top = b.op("top", Op::Floor(again), &[high]);
        let beyond = beyond(&mut b, top, reach);
        reasons.push(b.comment(beyond, "farther outside than that"));
    }
    let outside = b.or_all("is_outside", &reasons);
    let kept = b.op("kept_bits", Op::LowBits(bound.ilog2()), &[x]);
    let kept = b.resize("kept", kept, true, ty.bits);
    let held = b.either("held", outside, kept, x);
    let passed = b.op("passed", Op::Assert(symmetric(bound), "guard"), &[held]);
    b.comment(passed, format!("within +-{bound} whatever the word is: lemma guard"));
    b.output("passed", passed);
    b.output("outside", outside);
    b.finish()
}

/// Flag: `top` is not in [-reach, reach - 1], by the shorter list of values.
fn beyond(b: &mut Builder, top: NodeId, reach: i128) -> NodeId {
    let ty = b.ty(top);
    let (least, greatest) = ty.limits();
    let (inner, outer): (Vec<i128>, Vec<i128>) = (least..=greatest).partition(|v| (-reach..reach).contains(v));
    let listed = if outer.len() <= inner.len() { &outer } else { &inner };
    let flags: Vec<NodeId> = (0..)
        .zip(listed)
        .map(|(i, value)| {
            let end = b.constant(&format!("top_value_{i}"), *value, ty);
            b.op(&format!("top_equals_{i}"), Op::Equal, &[top, end])
        })
        .collect();
    if outer.len() <= inner.len() {
        return b.or_all("far_outside", &flags);
    }
    let near = b.or_all("near", &flags);
    b.op("far_outside", Op::Not, &[near])
}

/// The guards of a data path in the making.
#[derive(Default)]
pub(super) struct Guards {
    /// By bound.
    units: Vec<(i128, Rc<Unit>)>,
    /// What they say in each phase, with the phases that count: in idle ones a shared unit sees what it likes.
    of_phases: Vec<(Vec<bool>, NodeId)>,
    /// What they say, once a pair.
    of_pair: Vec<NodeId>,
}

impl Pipeline<'_> {
    /// The number with a guard in front, in a unit that has them; else as it is. Of a number that is another one in every
    /// phase, those in `busy` phases count.
    pub(super) fn guarded(&mut self, name: &str, x: Quantised, bound: i128, busy: &[bool]) -> Quantised {
        if !self.p.guarded() {
            return x;
        }
        let known = self.guards.units.iter().find(|(of, _)| *of == bound).map(|(_, unit)| Rc::clone(unit));
        let guard = known.unwrap_or_else(|| {
            let name = if bound == self.p.coordinate_bound() { "guard_coordinate" } else { "guard_translation" };
            let guard = unit(name, self.p, bound);
            self.guards.units.push((bound, Rc::clone(&guard)));
            guard
        });
        let args: Vec<NodeId> = x.nodes().collect();
        let out = self.b.instance(&format!("{name}_guard"), &guard, &args);
        match self.b.rate(out[1]) {
            Rate::Phase => self.guards.of_phases.push((busy.to_vec(), out[1])),
            Rate::Pair | Rate::Any => self.guards.of_pair.push(out[1]),
        }
        Quantised { lo: out[0], sticky: x.sticky, bound: Some(bound) }
    }

    /// The operand of one re-normalising lane in each phase: inputs pass a guard, B after the transform needs none.
    pub(super) fn guarded_lane(
        &mut self,
        j: usize,
        jobs: &[Option<usize>],
        points: &[Source],
        is_input: &[bool],
    ) -> Vec<Bounds> {
        let (p, name) = (self.p, format!("lane_{j}"));
        let busy: Vec<bool> = jobs.iter().map(|job| job.is_some_and(|i| is_input[i])).collect();
        let mut side = |want: bool, what: &str| {
            let jobs: Vec<Option<usize>> = jobs.iter().map(|job| job.filter(|i| is_input[*i] == want)).collect();
            jobs.iter().any(Option::is_some).then(|| self.pattern(&format!("{name}_{what}"), &jobs))
        };
        let (own, other) = (side(true, "input"), side(false, "transformed"));
        let which: Vec<Option<usize>> = jobs.iter().map(|job| job.map(|i| usize::from(is_input[i]))).collect();
        let from_input = self.control(&format!("{name}_from_input"), &which, 1);
        let mut point = vec![];
        for (c, coordinate) in COORDINATES.iter().enumerate() {
            let name = format!("{name}_{coordinate}");
            let input = own.as_ref().map(|(select, legs)| {
                let numbers: Vec<Quantised> = legs.iter().filter_map(|i| points[*i].input(c)).collect();
                let chosen = self.chosen(&format!("{name}_input"), *select, &numbers);
                // V0 comes from a guard of its own, because all others are taken relative to it.
                let alone = *legs == [0];
                let x = if alone { chosen } else { self.guarded(&name, chosen, p.coordinate_bound(), &busy) };
                let hi = x.bounds(&mut self.b, &format!("{name}_input"), p, None).hi;
                Bounds { lo: x.lo, hi }
            });
            let transformed = other.as_ref().map(|(select, legs)| {
                let bounds: Vec<Bounds> = legs.iter().filter_map(|i| points[*i].transformed(c)).collect();
                let mut end = |end: &str, of: fn(&Bounds) -> NodeId| {
                    let legs: Vec<(Option<NodeId>, bool)> = bounds.iter().map(|x| (Some(of(x)), false)).collect();
                    self.b.choose(&format!("{name}_transformed_{end}"), *select, &legs)
                };
                Bounds { lo: end("lo", |x| x.lo), hi: end("hi", |x| x.hi) }
            });
            point.extend(match (input, transformed) {
                (Some(x), Some(y)) => {
                    let lo = self.b.either(&format!("{name}_lo"), from_input, x.lo, y.lo);
                    Some(Bounds { lo, hi: self.b.either(&format!("{name}_hi"), from_input, x.hi, y.hi) })
                }
                (one, other) => one.or(other),
            });
        }
        point
    }

    /// Whether some number of the pair or its pose is outside, held for the pair; none in a unit without guards.
    pub(super) fn outside(&mut self) -> Option<NodeId> {
        if !self.p.guarded() {
            return None;
        }
        let mut all = std::mem::take(&mut self.guards.of_pair);
        let of_phases = std::mem::take(&mut self.guards.of_phases);
        if !of_phases.is_empty() {
            let found = self.counted(&of_phases);
            let mut found = self.b.or_all("outside_found", &found);
            if self.interval > 1 {
                let first: Vec<Option<usize>> = (0..self.interval).map(|s| Some(usize::from(s == 0))).collect();
                let first = self.control("outside_first", &first, 1);
                found = self.b.scan_or("outside_so_far", found, first);
            }
            all.push(self.b.hold("outside_in_phases", found, self.interval - 1, false));
        }
        let outside = self.b.or_all("outside_of_pair", &all);
        Some(self.b.comment(outside, "a number of the pair or its pose is outside its declared range"))
    }

    /// The disjunction of the flags that count in the same phases, clear in all others.
    fn counted(&mut self, flags: &[(Vec<bool>, NodeId)]) -> Vec<NodeId> {
        let mut groups: Vec<(&Vec<bool>, Vec<NodeId>)> = vec![];
        for (busy, flag) in flags {
            match groups.iter_mut().find(|(of, _)| *of == busy) {
                Some((_, group)) => group.push(*flag),
                None => groups.push((busy, vec![*flag])),
            }
        }
        let mut found = vec![];
        for (i, (busy, flags)) in groups.into_iter().enumerate() {
            let name = format!("outside_by_{i}");
            let any = self.b.or_all(&name, &flags);
            found.push(if busy.contains(&false) {
                let counts: Vec<Option<usize>> = busy.iter().map(|busy| Some(usize::from(*busy))).collect();
                let counts = self.control(&format!("{name}_counts"), &counts, 1);
                self.b.and(&format!("{name}_counted"), any, counts)
            } else {
                any
            });
        }
        found
    }

    /// The flags of axis unit `u` in every phase, clear for a pair outside: section 7 then makes it possibly-incorrect.
    pub(super) fn silenced(
        &mut self,
        u: usize,
        jobs: &[Option<Axis>],
        outside: Option<NodeId>,
        (separated, overlapping): (NodeId, NodeId),
    ) -> (NodeId, NodeId) {
        let Some(outside) = outside else { return (separated, overlapping) };
        let phases: Vec<Option<bool>> = jobs.iter().map(|job| job.map(|axis| lagged(jobs, &axis))).collect();
        let (select, legs) = self.pattern(&format!("axis_{u}_pair"), &phases);
        let legs: Vec<(Option<NodeId>, bool)> = legs.into_iter().map(|lagged| (Some(outside), lagged)).collect();
        let outside = self.b.choose(&format!("axis_{u}_outside"), select, &legs);
        let inside = self.b.op(&format!("axis_{u}_inside"), Op::Not, &[outside]);
        let separated = self.b.and(&format!("axis_{u}_separated"), separated, inside);
        (separated, self.b.and(&format!("axis_{u}_overlapping"), overlapping, inside))
    }
}
