//! Edges that certainly pass through the other triangle (contract section 7).

use super::axes::Axis;
use super::interval::{Flags, Mantissa, three};
use super::projection::Images;
use efsat_hardware::number::Interval;

/// On which side of one true number another certainly is: neither flag is set where that is not certain.
#[derive(Clone, Copy, Debug, Default)]
struct Side<F> {
    above: F,
    below: F,
}

impl<F: Flags> Side<F> {
    /// Of b, seen from a.
    #[inline(always)]
    fn new<M: Mantissa<Flags = F>>(a: &Interval<M>, b: &Interval<M>) -> Self {
        Self { above: a.hi.below(&b.lo), below: b.hi.below(&a.lo) }
    }
}

/// On which side of each other the triangles' vertices and edges certainly are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides<F> {
    /// W_l against A's plane, and V_k against B's, in the order of the triangles.
    plane: [[Side<F>; 3]; 2],
    /// Edge l of B against edge k of A, by k and l: on which side of V_k is W_l, on the axis C_kl.
    edges: [[Side<F>; 3]; 3],
}

impl<F: Flags> Sides<F> {
    /// Adds what an axis shows.
    #[inline(always)]
    pub fn see<M: Mantissa<Flags = F>>(&mut self, axis: Axis, [a, b]: &Images<M>) {
        match axis {
            Axis::NormalA => self.plane[0] = three(|l| Side::new(&a[0], &b[l])),
            Axis::NormalB => self.plane[1] = three(|k| Side::new(&a[k], &b[0])),
            Axis::Cross(k, l) => self.edges[k][l] = Side::new(&a[k], &b[l]),
            Axis::InPlaneA(_) | Axis::InPlaneB(_) => {}
        }
    }

    /// Whether some edge certainly passes through the other triangle.
    #[inline(always)]
    pub fn pierced(&self) -> F {
        let edge = |side: usize, i: usize| {
            let vertices = &self.plane[1 - side];
            let edges = three(|j| if side == 0 { self.edges[i][j] } else { self.edges[j][i] });
            opposite(vertices[i], vertices[(i + 1) % 3]) & same(edges)
        };
        let some = |side: usize| edge(side, 0) | edge(side, 1) | edge(side, 2);
        some(0) | some(1)
    }
}

/// One above and one below.
#[inline(always)]
fn opposite<F: Flags>(x: Side<F>, y: Side<F>) -> F {
    (x.above & y.below) | (x.below & y.above)
}

/// All above, or all below.
#[inline(always)]
fn same<F: Flags>([x, y, z]: [Side<F>; 3]) -> F {
    (x.above & y.above & z.above) | (x.below & y.below & z.below)
}
