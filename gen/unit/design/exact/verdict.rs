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

/// Whether the part of A in the plane of B is not all beyond edge l of B, for each l.
fn inside<'l>(plane_b: [Sign<'l>; 3], side: [[Sign<'l>; 3]; 3]) -> [Sig<'l>; 3] {
    let doc = [
        "A meets the plane of B in a segment, which ends on the edges of A whose ends are on different sides of the plane, or",
        "one end on it. Whether some end is on the inner side of edge l of B: edge k passes the plane upward and side(k, l) is",
        "positive, or downward and it is negative.",
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
        let inner = |k: usize, l: usize| up[k] & side[k][l][0] | down[k] & side[k][l][1];
        [0, 1, 2].map(|l| any(&[inner(0, l), inner(1, l), inner(2, l)])).named("inner")
    })
}

/// The verdict of the pair and whether it is outside, then what each of the nine witnesses says: separated, overlapping.
pub(super) type Outcome<'l> = ((Sig<'l>, Option<Sig<'l>>), (Vec<Sig<'l>>, Vec<Sig<'l>>));

/// The verdict of the pair, which may be outside; else it is one bit.
pub(super) fn verdict<'l>(signs: &Fifteen<Sign<'l>>, plane: &Plane<Sig<'l>>, outside: Option<Sig<'l>>) -> Outcome<'l> {
    let Fifteen { plane_a, plane_b, side } = *signs;
    let ends = |plane: &[Sign<'l>; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
    let of_a = [0, 1, 2].map(|k| edge(ends(&plane_b, k), side[k]));
    let of_b = [0, 1, 2].map(|l| edge(ends(&plane_a, l), [0, 1, 2].map(|k| side[k][l])));
    let edges = [of_a, of_b].concat().named("edge");
    let inner = inside(plane_b, side).named("inner");
    let skew = any(&side.concat().concat()).named("skew").comment("some side sign is not 0");
    let (planes, plane) = ([plane_a, plane_b], *plane);
    let missed: Vec<Sig<'l>> = edges.iter().map(|edge| edge.missed).collect();
    let hits: Vec<Sig<'l>> = edges.iter().map(|edge| edge.hits).collect();
    let doc = [
        "The verdict (sections 4 and 6 of docs/exact.md): of a pair in one plane by the rule for those, else intersect if an",
        "edge hits. crosses: the relative interiors meet, as an edge pierces, or as each triangle has corners on both sides of",
        "the other's plane and A has a part on the inner side of every edge of B. alike: a pair in one plane crosses, and the",
        "normals agree. Of a pair that does not fit no flag is set.",
    ];
    let (verdict, (separated, overlapping)) = entity!("pair_verdict", &doc, (planes, edges, inner, skew, plane, outside) => {
        let of = |plane: [Sign<'l>; 3], way: usize| plane.map(|sign| sign[way]);
        let all = |flags: [Sig<'l>; 3]| flags[0] & flags[1] & flags[2];
        let one_side = planes.map(|plane| all(of(plane, 0)) | all(of(plane, 1))).named("one_side");
        let both_sides = planes.map(|plane| any(&of(plane, 0)) & any(&of(plane, 1))).named("both_sides");
        let in_plane = (!any(&planes.concat().concat())).named("in_plane").comment("all six plane signs are 0");
        let some = |of: fn(&Edge<Sig<'l>>) -> Sig<'l>| any(&edges.iter().map(of).collect::<Vec<_>>());
        let (hit, pierced) = (some(|edge| edge.hits).named("hit"), some(|edge| edge.pierces).named("pierced"));
        let apart = (in_plane & (skew | plane.apart)).named("apart");
        let proper = (pierced | both_sides[0] & both_sides[1] & all(inner)).named("proper");
        let crosses = in_plane.choose(!apart & plane.crosses, proper).named("crosses");
        let alike = (in_plane & crosses & plane.agree).named("alike");
        let flags = |first: [Sig<'l>; 3], of: fn(&Edge<Sig<'l>>) -> Sig<'l>| -> Vec<Sig<'l>> {
            match outside {
                Some(outside) => first.into_iter().chain(edges.iter().map(of)).map(|flag| flag & !outside).collect(),
                None => first.to_vec(),
            }
        };
        let separated = flags([apart, one_side[0], one_side[1]], |edge| edge.missed);
        let overlapping = flags([crosses, in_plane & !skew, pierced | alike], |edge| edge.hits);
        let intersects = in_plane.choose(!apart, hit);
        let verdict = match outside {
            Some(outside) => (!outside & intersects).named("intersects").below(&[outside]),
            None => intersects,
        };
        (verdict.named("verdict"), (separated.named("separated"), overlapping.named("overlapping")))
    });
    let [separated, overlapping] = match outside {
        Some(_) => [separated, overlapping],
        None => [[separated, missed].concat(), [overlapping, hits].concat()],
    };
    let comment =
        if outside.is_some() { "00 separate, 01 intersect, 10 possibly incorrect" } else { "1: they intersect" };
    let verdict = verdict.named("verdict").comment(comment);
    ((verdict, outside), (separated.named("separated"), overlapping.named("overlapping")))
}
