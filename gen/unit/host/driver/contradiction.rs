//! Answers that contradict themselves: a verdict and the flags that it does not follow from, or flags that exclude each other.

use crate::pair::{Outcome, Verdict};
use crate::params::{Method, Params};

/// The axes of which all have to overlap.
const ELEVEN: u32 = (1 << 11) - 1;
/// The edges of A and of B among the nine witnesses.
const EDGES_OF_A: u32 = 0b111 << 3;
const EDGES_OF_B: u32 = 0b111 << 6;
const EDGES: u32 = EDGES_OF_A | EDGES_OF_B;
/// Of the exact unit, in `overlapping`: the pair crosses, it is in one plane, an edge pierces or the normals agree.
const CROSSES: u32 = 1;
const COPLANAR: u32 = 2;
const INSIDE: u32 = 4;

/// Whether no unit of this design gives these flags together, or not with this verdict.
pub(super) fn contradicts(params: &Params, outcome: &Outcome) -> bool {
    let Outcome { verdict, separated: s, overlapping: o, outside } = *outcome;
    let (separate, intersect) = (verdict == Verdict::Separate, verdict == Verdict::Intersect);
    if outside {
        return separate || intersect || s | o != 0;
    }
    if s & o != 0 {
        return true;
    }
    if params.method == Method::Axes {
        // An axis that separates decides; else all of the eleven have to overlap, or an edge passes through, of which no flag
        // tells.
        return match (separate != (s != 0), o & ELEVEN == ELEVEN) {
            (true, _) => true,
            (false, true) => !intersect,
            (false, false) => intersect && !params.edge_test,
        };
    }
    // All of a triangle on one side of the other's plane: its three edges miss the other.
    let one_side = |plane: u32, edges: u32| s & plane != 0 && s & edges != edges;
    if one_side(2, EDGES_OF_B) || one_side(4, EDGES_OF_A) {
        return true;
    }
    match params.method {
        // Boxes, a plane, or five of the six edges separate; else one edge that pierces is enough.
        Method::Axes | Method::Determinants => {
            let apart = s & !EDGES != 0 || (s & EDGES).count_ones() >= 5;
            separate != apart || o & !EDGES != 0 || if apart { o != 0 } else { intersect != (o != 0) }
        }
        // Triangles in one plane, or of which no edge hits the other, are separate if the first flag or no edge says otherwise.
        Method::Exact => {
            let apart = s & 1 != 0 || o & (COPLANAR | EDGES) == 0;
            let in_plane = o & COPLANAR != 0 && (s & !1 != 0 || o & EDGES != 0);
            let inside = o & INSIDE != 0 && (o & CROSSES == 0 || o & (COPLANAR | EDGES) == 0);
            separate != apart || separate == intersect || separate && o & !COPLANAR != 0 || in_plane || inside
        }
    }
}
