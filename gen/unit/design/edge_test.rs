//! Edges that certainly pass through the other triangle (section 7 of the contract).

use super::axes::{Axis, Factor};
use super::guard::any;
use crate::params::AxisKind;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};

/// Where a number certainly is: above another, or below it.
pub type Side<'l> = [Sig<'l>; 2];

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
    let vertices = |t: usize, way: usize| [0, 1, 2].map(|i| of(Seen::Vertex(t, i))[way]);
    let edges = |way: usize| [0, 1, 2].map(|k| [0, 1, 2].map(|l| of(Seen::Edge(k, l))[way]));
    let (v_above, v_below, w_above, w_below) = (vertices(1, 0), vertices(1, 1), vertices(0, 0), vertices(0, 1));
    let (edges_above, edges_below) = (edges(0), edges(1));
    let doc = [
        "Whether an edge passes through the other triangle: its ends are on different sides of that triangle's plane, and",
        "the edges of that triangle are all on one side of it (contract, section 7).",
        "v_above(k): V_k is above B's plane; w_above(l): W_l is above A's; edges_above(k)(l): edge l of B is above edge k",
        "of A, seen along both. Below likewise; neither where it is not certain.",
    ];
    entity!("edge_test", &doc, (v_above, v_below, w_above, w_below, edges_above, edges_below) => {
        let passes = |above: [Sig<'l>; 3], below: [Sig<'l>; 3], k: usize, all_above: [Sig<'l>; 3], all_below: [Sig<'l>; 3]| {
            let next = (k + 1) % 3;
            let crosses = (above[k] & below[next]) | (below[k] & above[next]);
            let all = |sides: [Sig<'l>; 3]| sides[0] & sides[1] & sides[2];
            crosses & (all(all_above) | all(all_below))
        };
        let of_b = |edges: [[Sig<'l>; 3]; 3], l: usize| [0, 1, 2].map(|k| edges[k][l]);
        let a_passes = |k| passes(v_above, v_below, k, edges_above[k], edges_below[k]);
        let b_passes = |l| passes(w_above, w_below, l, of_b(edges_above, l), of_b(edges_below, l));
        let (a, b) = ([0, 1, 2].map(a_passes).named("a_passes"), [0, 1, 2].map(b_passes).named("b_passes"));
        any(&[a, b].concat()).named("pierced")
    })
}
