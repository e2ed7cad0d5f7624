//! Edges and separating axes (contract section 5, the paper's equation 1).

use std::fmt;

use super::interval::{Rounding, Triple, Vector, Wide, cross_component, difference, negated, three};
use crate::params::{Axes, AxisKind, Params};

/// One separating axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// n_A = (V1 - V0) x (V2 - V0).
    NormalA,
    /// n_B = (W1 - W0) x (W2 - W0).
    NormalB,
    /// C_kl = e_Ak x e_Bl.
    Cross(usize, usize),
    /// n_A x e_Ak.
    InPlaneA(usize),
    /// n_B x e_Bl.
    InPlaneB(usize),
}

/// All 17 axes in the order of the contract; the first 11 are the paper's.
pub(super) const ORDER: [Axis; 17] = [
    Axis::NormalA,
    Axis::NormalB,
    Axis::Cross(0, 0),
    Axis::Cross(0, 1),
    Axis::Cross(0, 2),
    Axis::Cross(1, 0),
    Axis::Cross(1, 1),
    Axis::Cross(1, 2),
    Axis::Cross(2, 0),
    Axis::Cross(2, 1),
    Axis::Cross(2, 2),
    Axis::InPlaneA(0),
    Axis::InPlaneA(1),
    Axis::InPlaneA(2),
    Axis::InPlaneB(0),
    Axis::InPlaneB(1),
    Axis::InPlaneB(2),
];

impl Axis {
    /// The axes of a parameter set.
    pub fn all(axes: Axes) -> &'static [Self] {
        &ORDER[..axes.count()]
    }

    /// The kind by which the format table knows it.
    pub fn kind(self) -> AxisKind {
        match self {
            Self::NormalA => AxisKind::NormalA,
            Self::NormalB => AxisKind::NormalB,
            Self::Cross(k, _) => AxisKind::Cross(k),
            Self::InPlaneA(k) => AxisKind::InPlaneA(k),
            Self::InPlaneB(_) => AxisKind::InPlaneB,
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NormalA => f.write_str("n_a"),
            Self::NormalB => f.write_str("n_b"),
            Self::Cross(k, l) => write!(f, "c_{k}{l}"),
            Self::InPlaneA(k) => write!(f, "n_a_a{k}"),
            Self::InPlaneB(l) => write!(f, "n_b_b{l}"),
        }
    }
}

/// The edges of both triangles, e_Xk = X_(k+1) - X_k.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edges {
    pub a: Triple,
    pub b: Triple,
}

/// Both normals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normals {
    pub a: Vector,
    pub b: Vector,
}

/// How every edge and axis component is rounded.
#[derive(Clone, Debug)]
pub(super) struct AxisUnit {
    edge_a: [Rounding; 3],
    edge_b: Rounding,
    normal_a: Rounding,
    normal_b: Rounding,
    cross: [Rounding; 3],
    in_plane_a: [Rounding; 3],
    in_plane_b: Rounding,
}

impl AxisUnit {
    pub fn new(p: &Params) -> Self {
        let f = p.formats();
        let grid = f.coordinate_a.format.fraction;
        let edge_a = three(|k| f.edge_a[k].format.fraction);
        let edge_b = f.edge_b.format.fraction;
        let normal = |kind| f.axis(kind).format.fraction;
        let to = |fraction, kind| Rounding::to_row(fraction, f.axis(kind), p.upper);
        Self {
            edge_a: three(|k| Rounding::to_row(grid, &f.edge_a[k], p.upper)),
            edge_b: Rounding::to_row(grid, &f.edge_b, p.upper),
            normal_a: to(edge_a[0] + edge_a[2], AxisKind::NormalA),
            normal_b: to(2 * edge_b, AxisKind::NormalB),
            cross: three(|k| to(edge_a[k] + edge_b, AxisKind::Cross(k))),
            in_plane_a: three(|k| to(normal(AxisKind::NormalA) + edge_a[k], AxisKind::InPlaneA(k))),
            in_plane_b: to(normal(AxisKind::NormalB) + edge_b, AxisKind::InPlaneB),
        }
    }

    /// Indices around.
    pub fn edges(&self, a: &Triple, b: &Triple) -> Edges {
        let edge = |x: &Triple, k: usize, rounding: Rounding| {
            three(|i| rounding.apply(difference(x[(k + 1) % 3][i], x[k][i])))
        };
        Edges { a: three(|k| edge(a, k, self.edge_a[k])), b: three(|l| edge(b, l, self.edge_b)) }
    }

    /// n_A and n_B; X2 - X0 is the negated edge e_X2.
    pub fn normals<W: Wide>(&self, edges: &Edges) -> Normals {
        Normals {
            a: cross::<W>(&edges.a[0], &three(|i| negated(edges.a[2][i])), self.normal_a),
            b: cross::<W>(&edges.b[0], &three(|i| negated(edges.b[2][i])), self.normal_b),
        }
    }

    /// The direction of one axis.
    pub fn axis<W: Wide>(&self, axis: Axis, edges: &Edges, normals: &Normals) -> Vector {
        match axis {
            Axis::NormalA => normals.a,
            Axis::NormalB => normals.b,
            Axis::Cross(k, l) => cross::<W>(&edges.a[k], &edges.b[l], self.cross[k]),
            Axis::InPlaneA(k) => cross::<W>(&normals.a, &edges.a[k], self.in_plane_a[k]),
            Axis::InPlaneB(l) => cross::<W>(&normals.b, &edges.b[l], self.in_plane_b),
        }
    }
}

/// e x f, every component accumulated exactly and rounded once.
#[inline(always)]
fn cross<W: Wide>(e: &Vector, f: &Vector, rounding: Rounding) -> Vector {
    three(|i| rounding.apply(cross_component::<W>(e, f, i)))
}
