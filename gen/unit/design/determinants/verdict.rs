//! From certain signs to the verdict of the pair (section 6 of docs/determinants.md).

use super::super::guard::any;
use super::coordinates::Coordinates;
use super::fifteen::Fifteen;
use super::{constant, shared, table, traced, word};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top};
use efsat_hardware::op::Type;

/// Whether the sign of a determinant certainly is +1, and whether it certainly is -1.
pub(super) type Sign<'l> = [Sig<'l>; 2];

/// The signs that are certain, of what is compared.
pub(super) fn signs<'l>(u: Top<'l>, determinants: Vec<Sig<'l>>, bounds: Vec<Sig<'l>>) -> Fifteen<Sign<'l>> {
    let jobs: Vec<_> = determinants.into_iter().zip(bounds).collect();
    if u.interval() < 3 {
        // Multiplexers of the operands would be larger than the comparators that they save.
        let signs: Vec<Sign<'l>> = jobs.into_iter().map(|(x, bound)| certain_sign(x, bound)).collect();
        return Fifteen::of(&signs.named("sign"));
    }
    Fifteen::of(&shared(u, "sign", &jobs, |k, (x, bound)| {
        certain_sign(x.named_at("sign_x", k), bound.named_at("sign_bound", k)).named_at("sign_lane", k)
    }))
}

fn certain_sign<'l>(x: Sig<'l>, bound: Sig<'l>) -> Sign<'l> {
    let doc = ["Whether a number is certainly positive, and whether it is certainly negative: x > bound, x < -bound."];
    entity!("certain_sign", &doc, (x, bound) => {
        [bound.less(x).named("positive"), (x + bound).negative().named("negative")].named("sign")
    })
}

/// Whether the boxes of the triangles are apart, for certain.
pub(super) fn boxes_apart<'l>(u: Top<'l>, coordinates: &Coordinates<'l>) -> Sig<'l> {
    // One less than the gap that is asked for; two coordinates are wrong by at most 1 + 2^(level-2) together.
    let wrong = |level: u32| 1 + (1 << level >> 2);
    let level = coordinates.level;
    let wrong = match level.signal {
        None => constant(u, wrong(0)),
        Some(signal) => table(signal, (0..=level.most).map(wrong).collect()),
    };
    let wrong = wrong.named("boxes_wrong").comment("how wrong the distance of two coordinates can be");
    let jobs = [0, 1, 2].map(|j| coordinates.points.along(j));
    let apart = shared(u, "boxes_apart_along", &jobs, |k, [v1, v2, w0, w1, w2]| {
        let (v, w) = ([v1, v2].named_at("boxes_v", k), [w0, w1, w2].named_at("boxes_w", k));
        apart_along(v, w, wrong).named_at("boxes_lane", k)
    });
    traced(any(&apart), "boxes_apart")
}

/// Whether the boxes are apart along one axis.
fn apart_along<'l>(v: [Sig<'l>; 2], w: [Sig<'l>; 3], wrong: Sig<'l>) -> Sig<'l> {
    let doc = [
        "Whether along an axis all of A is above all of B, or all of B above all of A, and by more than coordinates can be",
        "wrong. V_0 is 0.",
    ];
    entity!("boxes_axis", &doc, (v, w, wrong) => {
        let zero = v[0].like(0);
        let a = [zero, v[0], v[1]];
        let above = |high: &[Sig<'l>], low: &[Sig<'l>]| {
            let low: Vec<Sig<'l>> = low.iter().map(|x| *x + wrong).collect();
            let pairs = low.iter().flat_map(|low| high.iter().map(|high| low.less(*high)));
            pairs.reduce(|a, b| a & b).expect("triangles have vertices")
        };
        (above(&a, &w).named("a_above") | above(&w, &a).named("b_above")).named("apart")
    })
}

/// What the signs say of an edge and the other triangle: that they certainly have no common point, and that they have one.
#[derive(Clone, Copy)]
struct Edge<'l> {
    missed: Sig<'l>,
    pierces: Sig<'l>,
}

/// From the signs of the edge's ends against the plane of the other triangle, and of its line against the other's edges.
fn edge<'l>(ends: [Sign<'l>; 2], sides: [Sign<'l>; 3]) -> Edge<'l> {
    let doc = [
        "An edge and the other triangle. It is missed if both ends are on one side of the triangle's plane, or if the sides",
        "on which it passes the other edges differ. It pierces if the ends are on different sides and the sides are alike.",
        "Of each sign (0) says that it is positive, (1) that it is negative, for certain.",
    ];
    let [missed, pierces] = entity!("edge_verdict", &doc, (ends, sides) => {
        let [p, q] = ends;
        let of = |way: usize| sides.map(|side| side[way]);
        let all = |flags: [Sig<'l>; 3]| flags[0] & flags[1] & flags[2];
        let missed = (p[0] & q[0]) | (p[1] & q[1]) | (any(&of(0)) & any(&of(1)));
        let pierces = ((p[0] & q[1]) | (p[1] & q[0])) & (all(of(0)) | all(of(1)));
        [missed.named("missed"), pierces.named("pierces")]
    });
    Edge { missed, pierces }
}

/// The verdict and whether the pair is outside, then what each of the nine witnesses says: separated, overlapping.
pub(in super::super) type Outcome<'l> = ((Sig<'l>, Option<Sig<'l>>), (Vec<Sig<'l>>, Vec<Sig<'l>>));

/// The verdict of the pair; `crosses` says that flags 0 and 2 of `overlapping` are set as well where an edge pierces, as they
/// are in the exact unit.
pub(super) fn verdict<'l>(
    u: Top<'l>,
    apart: Option<Sig<'l>>,
    signs: &Fifteen<Sign<'l>>,
    outside: Option<Sig<'l>>,
    crosses: bool,
) -> Outcome<'l> {
    let Fifteen { plane_a, plane_b, side } = signs;
    let ends = |plane: &[Sign<'l>; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
    let of_a = [0, 1, 2].map(|k| edge(ends(plane_b, k), side[k]));
    let of_b = [0, 1, 2].map(|l| edge(ends(plane_a, l), [0, 1, 2].map(|k| side[k][l])));
    let one_side = |plane: &[Sign<'l>; 3]| {
        let all = |way: usize| plane[0][way] & plane[1][way] & plane[2][way];
        all(0) | all(1)
    };
    let edges = [of_a, of_b].concat();
    let never = || u.element(0, Type::FLAG);
    let witnesses = [apart.unwrap_or_else(never), one_side(plane_a), one_side(plane_b)];
    let separated: Vec<Sig<'l>> = witnesses.into_iter().chain(edges.iter().map(|edge| edge.missed)).collect();
    let pierces: Vec<Sig<'l>> = edges.iter().map(|edge| edge.pierces).collect();
    let pierces = if crosses { pierces.named("pierced") } else { pierces };
    let first = |i| if crosses && i != 1 { any(&pierces) } else { never() };
    let overlapping: Vec<Sig<'l>> = (0..3).map(first).chain(pierces.iter().copied()).collect();
    // Of a pair outside the declared ranges all flags are clear.
    let counts = |flags: Vec<Sig<'l>>| match outside {
        Some(outside) => flags.into_iter().map(|flag| flag & !outside).collect(),
        None => flags,
    };
    let (separated, overlapping) = (counts(separated), counts(overlapping));
    let (separated, overlapping) = (separated.named("separated"), overlapping.named("overlapping"));
    let doc = [
        "The verdict: separate if the boxes are apart, if a plane has the other triangle on one side, or if at least five of",
        "the six edges are missed; else intersect if an edge pierces; else possibly incorrect.",
    ];
    let flags = (separated.clone(), overlapping.clone());
    let verdict = entity!("pair_verdict", &doc, (separated, overlapping) => {
        let five_missed = table(word(&separated[3..], "edges_missed"), (0..64u32).map(|x| i128::from(x.count_ones() >= 5)).collect());
        let separate = (any(&separated[..3]) | five_missed.named("five_missed")).named("separate");
        let intersect = !separate & any(&overlapping[3..]);
        intersect.named("intersects").below(&[!separate & !intersect]).named("verdict")
    });
    let verdict = verdict.named("verdict").comment("00 separate, 01 intersect, 10 possibly incorrect");
    ((verdict, outside), flags)
}
