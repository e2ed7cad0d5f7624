//! From exact signs to the verdict of the pair (sections 4 and 6 of docs/exact.md).

use super::super::determinants::fifteen::Fifteen;
use super::super::guard::any;
use super::Sign;
use super::plane::Plane;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::record;

record! {
    /// What the signs say of an edge and the other triangle.
    Edge "edge" {
        /// They have no common point.
        missed: S,
        /// They have one, and the edge is not in the plane.
        hits: S,
        /// It goes through the inside.
        pierces: S,
    }
}

/// From the signs of the edge's ends against the plane of the other triangle, and of its line against the other's edges.
fn edge<'l>(ends: [Sign<'l>; 2], sides: [Sign<'l>; 3]) -> Edge<Sig<'l>> {
    let doc = [
        "An edge and the other triangle. It is missed if both ends are on one side of the triangle's plane, or if the sides",
        "on which it passes the other edges differ. Else it hits, unless it is in the plane. It pierces if the ends are on",
        "different sides and the other edges are all passed on one. Of each sign (0) says that it is positive, (1) negative.",
    ];
    entity!("edge_verdict", &doc, (ends, sides) => {
        let [p, q] = ends;
        let of = |way: usize| sides.map(|side| side[way]);
        let all = |flags: [Sig<'l>; 3]| flags[0] & flags[1] & flags[2];
        let missed = (p[0] & q[0] | p[1] & q[1] | any(&of(0)) & any(&of(1))).named("missed");
        Edge {
            missed,
            hits: (any(&[p[0], p[1], q[0], q[1]]) & !missed).named("hits"),
            pierces: ((p[0] & q[1] | p[1] & q[0]) & (all(of(0)) | all(of(1)))).named("pierces"),
        }
    })
}

/// Whether A, where it meets the plane of B, is not all beyond edge l of B, for each l.
fn inside<'l>(plane_b: [Sign<'l>; 3], side: [[Sign<'l>; 3]; 3]) -> [Sig<'l>; 3] {
    let doc = [
        "A meets the plane of B in a segment, which ends on the edges of A whose ends are on different sides of the plane, or",
        "one end on it. Whether some end is on the inner side of edge l of B: edge k passes the plane upward and side(k, l) is",
        "negative, or downward and it is positive.",
    ];
    entity!("inner_side", &doc, (plane_b, side) => {
        let [up, down] = [[1, 0], [0, 1]].map(|[from, to]: [usize; 2]| {
            // From below to above, from below to the plane, or from the plane to above; down alike.
            [0, 1, 2].map(|k| {
                let (p, q) = (plane_b[k], plane_b[(k + 1) % 3]);
                p[from] & !q[from] | !p[to] & q[to]
            })
        });
        let (up, down) = (up.named("up"), down.named("down"));
        let inner = |k: usize, l: usize| up[k] & side[k][l][1] | down[k] & side[k][l][0];
        [0, 1, 2].map(|l| any(&[inner(0, l), inner(1, l), inner(2, l)])).named("inner")
    })
}

/// The verdict of the pair and whether it is outside, then what each of the nine witnesses says: separated, overlapping.
type Outcome<'l> = ((Sig<'l>, Sig<'l>), (Vec<Sig<'l>>, Vec<Sig<'l>>));

/// The verdict of the pair.
pub(super) fn verdict<'l>(signs: &Fifteen<Sign<'l>>, plane: &Plane<'l>, outside: Sig<'l>) -> Outcome<'l> {
    let Fifteen { plane_a, plane_b, side } = *signs;
    let ends = |plane: &[Sign<'l>; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
    let of_a = [0, 1, 2].map(|k| edge(ends(&plane_b, k), side[k]));
    let of_b = [0, 1, 2].map(|l| edge(ends(&plane_a, l), [0, 1, 2].map(|k| side[k][l])));
    let edges = [of_a, of_b].concat().named("edge");
    let inner = inside(plane_b, side).named("inner");
    let of = |plane: &[Sign<'l>; 3], way: usize| plane.map(|sign| sign[way]);
    let all = |flags: [Sig<'l>; 3]| flags[0] & flags[1] & flags[2];
    let one_side = |plane: &[Sign<'l>; 3]| all(of(plane, 0)) | all(of(plane, 1));
    let both_sides = |plane: &[Sign<'l>; 3]| any(&of(plane, 0)) & any(&of(plane, 1));
    let in_plane = !any(&[plane_a, plane_b].concat().concat());
    let in_plane = in_plane.named("in_plane").comment("all six plane signs are 0");
    let skew = any(&side.concat().concat()).named("skew");
    let hit = any(&edges.iter().map(|edge| edge.hits).collect::<Vec<_>>()).named("hit");
    let pierced = any(&edges.iter().map(|edge| edge.pierces).collect::<Vec<_>>());
    let straddle = both_sides(&plane_a) & both_sides(&plane_b);
    let through = (pierced | straddle & all(inner)).named("through");
    let apart = (in_plane & (skew | plane.apart)).named("apart");
    let crosses = in_plane.choose(!apart & plane.crosses, through);
    let fits = (!outside).named("fits");
    let counts = |flags: Vec<Sig<'l>>| flags.into_iter().map(|flag| flag & fits).collect::<Vec<_>>();
    let missed = edges.iter().map(|edge| edge.missed);
    let separated = [apart, one_side(&plane_a), one_side(&plane_b)].into_iter().chain(missed);
    let none = outside.unit().element(0, efsat_hardware::op::Type::FLAG);
    let overlapping = [crosses, in_plane & !skew, none].into_iter().chain(edges.iter().map(|edge| edge.hits));
    let (separated, overlapping) = (counts(separated.collect()), counts(overlapping.collect()));
    let intersect = fits & in_plane.choose(!apart, hit);
    let verdict = intersect.named("intersects").below(&[outside]).named("verdict");
    let verdict = verdict.comment("00 separate, 01 intersect, 10 possibly incorrect");
    ((verdict, outside), (separated.named("separated"), overlapping.named("overlapping")))
}
