//! Edges that certainly pass through the other triangle (contract section 7).

use super::axes::Axis;
use super::interval::{Mantissa, three};
use super::projection::Images;
use efsat_hardware::number::Interval;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// On which side of each other the triangles' vertices and edges certainly are; [`Equal`] where that is not certain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    /// W_l against A's plane, and V_k against B's, in the order of the triangles.
    plane: [[Ordering; 3]; 2],
    /// Edge l of B against edge k of A, by k and l: on which side of V_k is W_l, on the axis C_kl.
    edges: [[Ordering; 3]; 3],
}

impl Sides {
    pub const UNKNOWN: Self = Self { plane: [[Equal; 3]; 2], edges: [[Equal; 3]; 3] };

    /// Adds what an axis shows.
    #[inline(always)]
    pub fn see<M: Mantissa>(&mut self, axis: Axis, [a, b]: &Images<M>) {
        match axis {
            Axis::NormalA => self.plane[0] = three(|l| order(&a[0], &b[l])),
            Axis::NormalB => self.plane[1] = three(|k| order(&a[k], &b[0])),
            Axis::Cross(k, l) => self.edges[k][l] = order(&a[k], &b[l]),
            Axis::InPlaneA(_) | Axis::InPlaneB(_) => {}
        }
    }

    /// Some edge certainly passes through the other triangle.
    pub fn pierced(&self) -> bool {
        self.all_edges().any(|(ends, sides)| ends[0] == ends[1].reverse() && ends[0] != Equal && same(&sides))
    }

    /// Of each edge, where its ends are, and where the edges of the other triangle are.
    fn all_edges(&self) -> impl Iterator<Item = ([Ordering; 2], [Ordering; 3])> + '_ {
        let ends = |plane: &[Ordering; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
        let of_a = (0..3).map(move |k| (ends(&self.plane[1], k), self.edges[k]));
        of_a.chain((0..3).map(move |l| (ends(&self.plane[0], l), three(|k| self.edges[k][l]))))
    }
}

/// Whether all are certain and one.
fn same(sides: &[Ordering]) -> bool {
    sides[0] != Equal && sides.iter().all(|side| *side == sides[0])
}

/// Which of two true numbers is certainly greater: `Greater` if it is the second.
fn order<M: Mantissa>(a: &Interval<M>, b: &Interval<M>) -> Ordering {
    if b.lo > a.hi {
        Greater
    } else if b.hi < a.lo {
        Less
    } else {
        Equal
    }
}
