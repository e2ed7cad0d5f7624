//! The first level of products: the moments of the edges of B, and the normal of A, rounded to the working width by one
//! shift for all (section 4 of docs/determinants.md).

use super::super::product::product;
use super::coordinates::by_number;
use super::{Points, any_phase, constant, shared, table, traced, word};
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top, Vec3};
use std::cell::RefCell;

/// Rounded moments, in units of 2^s.
pub(super) struct Moments<'l> {
    /// Of the edges of B.
    pub m: [Vec3<Sig<'l>>; 3],
    /// The normal of A.
    pub n: Vec3<Sig<'l>>,
    pub shift: Shift<'l>,
}

/// By how much moments are rounded: s is N - span + k.
#[derive(Clone, Copy)]
pub(super) struct Shift<'l> {
    /// k; none where it is always 0.
    pub places: Option<Sig<'l>>,
    pub span: u32,
}

impl<'l> Shift<'l> {
    /// h at k places: N + 1 - s.
    pub fn h(self, places: u32) -> u32 {
        self.span + 1 - places
    }

    /// x 2^(h-1).
    pub fn times_g(self, x: Sig<'l>) -> Sig<'l> {
        by_number(self.places, |places| x.floor(1 - self.h(places) as i32), self.span)
    }
}

/// The twelve components by moment and axis, and what they are made of.
pub(super) fn moments<'l>(u: Top<'l>, p: &Params, points: &Points<'l>) -> Moments<'l> {
    let Points { v: [v1, v2], w: [w0, w1, w2] } = *points;
    let factors = [[w0, w1], [w1, w2], [w2, w0], [v1, v2]];
    let job = |[x, y]: &[Vec3<Sig<'l>>; 2], i: usize| ([x[i + 1], y[i + 2]], [x[i + 2], y[i + 1]]);
    let jobs: Vec<_> = factors.iter().flat_map(|pair| (0..3).map(move |i| job(pair, i))).collect();
    // What the units say in each phase of each lesser shift.
    let too_great = RefCell::new(vec![vec![]; p.span as usize]);
    let cut = shared(u, "moment_cut", &jobs, |k, (plus, minus)| {
        let (cut, flags) = component(p, plus.named_at("moment_plus", k), minus.named_at("moment_minus", k));
        let flags = flags.named_at("moment_too_great", k);
        too_great.borrow_mut().iter_mut().zip(flags).for_each(|(of_shift, flag)| of_shift.push(flag));
        cut.named_at("moment_lane_cut", k)
    });
    let any = |(k, flags): (usize, &Vec<Sig<'l>>)| any_phase(u, flags, jobs.len(), &format!("too_great_{k}"));
    let too_great: Vec<Sig<'l>> = too_great.borrow().iter().enumerate().map(any).collect();
    let places = (p.span > 0).then(|| {
        // Whatever is too great for a shift is too great for all lesser ones.
        let entry = |word: u32| i128::from(word.trailing_ones());
        traced(table(word(&too_great, "all_too_great"), (0..1 << p.span).map(entry).collect()), "places")
    });
    let shift = Shift { places, span: p.span };
    let moments: Vec<_> = cut.chunks(3).map(|x| Vec3([x[0], x[1], x[2]])).collect();
    let moments = shared(u, "moment", &moments, |k, cut| {
        rounded(p, cut.named_at("moment_exact", k), shift).named_at("moment_lane", k)
    });
    let m = [0, 1, 2].map(|l| traced(moments[l], &format!("moment_m{l}")));
    Moments { m, n: traced(moments[3], "moment_n"), shift }
}

/// One component of a moment, c = x y - x' y', and for each lesser shift whether it is too great for it.
pub fn component<'l>(p: &Params, plus: [Sig<'l>; 2], minus: [Sig<'l>; 2]) -> (Sig<'l>, Vec<Sig<'l>>) {
    let (n, span) = (p.width, p.span);
    let doc = [
        "One component of a moment, c = x y - x' y', without the bits that no shift keeps; one is left to round by.",
        match span {
            1 => "too_great: round(c, N - 1) is not in [-R, R - 1].",
            _ => "too_great(k): round(c, N - span + k) is not in [-R, R - 1].",
        },
    ];
    entity!("moment_component", &doc, (plus, minus) => {
        let exact = (product(plus[0], plus[1]) - product(minus[0], minus[1])).bits(2 * n).named("exact");
        let too_great = |k: u32| {
            let cut = exact.floor((n - span + k) as i32 - 1);
            // Rounding adds 1 to this, and it carries into the bits above N where all below are set.
            let carries = !(!cut.low(n)).any();
            let high = (cut.floor(n as i32) + carries).named(&format!("high_{k}"));
            !(high.equals(high.like(0)) | high.equals(high.like(-1)))
        };
        let flags: Vec<Sig<'l>> = (0..span).map(too_great).collect();
        (exact.floor((n - span) as i32 - 1).named("cut"), flags.named("too_great"))
    })
}

/// A moment rounded to the working width.
fn rounded<'l>(p: &Params, cut: Vec3<Sig<'l>>, shift: Shift<'l>) -> Vec3<Sig<'l>> {
    let n = p.width;
    let doc = ["A moment rounded to the working width: places bits are dropped, and one by rounding."];
    let places = shift.places;
    entity!("moment_round", &doc, (cut, places) => {
        let chosen = cut.map(|x| by_number(places, |k| x.floor(k as i32), shift.span));
        let chosen = if places.is_some() { chosen.named("chosen") } else { chosen };
        let range = (-(1 << (n - 1)), (1 << (n - 1)) - 1);
        let round = |x: Sig<'l>| (x + constant(x.block(), 1)).floor(1).within(range, "moment").bits(n);
        chosen.map(round).named("moment")
    })
}
