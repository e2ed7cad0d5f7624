//! Edges that certainly pass through the other triangle (section 7 of the contract).

use super::axes::{Axis, Factor};
use super::guard::any;
use super::interval::Interval;
use crate::params::AxisKind;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};

/// Where a number certainly is: above another, or below it.
pub type Side<'l> = [Sig<'l>; 2];

/// Where the projection `b` certainly is relative to `a`.
pub fn side<'l>(a: Interval<Sig<'l>>, b: Interval<Sig<'l>>) -> Side<'l> {
    [a.hi.less(b.lo), b.hi.less(a.lo)]
}

/// What an axis tells of vertices and edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Seen {
    /// On which side of A's plane W_l is, or on which side of B's plane V_k is.
    Vertex(usize, usize),
    /// On which side of edge k of A edge l of B is, seen along both.
    Edge(usize, usize),
}

/// What an axis tells, each with the vertices of A and of B whose projections tell it.
pub fn seen(axis: &Axis) -> Vec<(Seen, [usize; 2])> {
    match (axis.kind, axis.right) {
        (AxisKind::NormalA, _) => (0..3).map(|l| (Seen::Vertex(0, l), [0, l])).collect(),
        (AxisKind::NormalB, _) => (0..3).map(|k| (Seen::Vertex(1, k), [k, 0])).collect(),
        (AxisKind::Cross(k), Factor::EdgeB(l)) => vec![(Seen::Edge(k, l), [k, l])],
        _ => vec![],
    }
}

/// Whether some edge passes through the other triangle: its ends are on different sides of the other's plane, and the
/// edges of the other triangle are all on one side of it.
pub fn pierced<'l>(of: impl Fn(Seen) -> Side<'l>) -> Sig<'l> {
    let plane = [0, 1].map(|t| [0, 1, 2].map(|i| of(Seen::Vertex(t, i))));
    let edges = [0, 1, 2].map(|k| [0, 1, 2].map(|l| of(Seen::Edge(k, l))));
    let doc = [
        "Whether an edge passes through the other triangle: its ends are on different sides of that triangle's plane, and",
        "the edges of that triangle are all on one side of it (contract, section 7). Of each: above, below.",
    ];
    entity!("edge_test", &doc, (plane, edges) => {
        let passes = |ends: [Side<'l>; 2], sides: [Side<'l>; 3]| {
            let [[p_above, p_below], [q_above, q_below]] = ends;
            let all = |i: usize| sides[0][i] & sides[1][i] & sides[2][i];
            ((p_above & q_below) | (p_below & q_above)) & (all(0) | all(1))
        };
        let ends = |t: usize, k: usize| [plane[t][k], plane[t][(k + 1) % 3]];
        let of_a = [0, 1, 2].map(|k| passes(ends(1, k), edges[k])).named("a_passes");
        let of_b = [0, 1, 2].map(|l| passes(ends(0, l), [0, 1, 2].map(|k| edges[k][l]))).named("b_passes");
        any(&[of_a, of_b].concat()).named("pierced")
    })
}
