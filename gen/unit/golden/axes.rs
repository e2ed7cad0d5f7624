//! Edges and separating axes (contract section 5, the paper's equation 1).

use std::fmt;

use super::interval::{
    Mantissa, Rounding, Triple, Vector, Wide, cross_component, difference, hull, negated, shifted, three,
};
use super::{Loss, Lossless};
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
#[derive(Clone, Debug)]
pub(super) struct Edges<M> {
    pub a: Triple<M>,
    pub b: Triple<M>,
}

/// Both normals.
#[derive(Clone, Debug)]
pub(super) struct Normals<M> {
    pub a: Vector<M>,
    pub b: Vector<M>,
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
    /// Positions by which an axis may be shifted, and the width of its components.
    shift: Option<(u32, u32)>,
}

impl AxisUnit {
    pub fn new(p: &Params, exact: Lossless) -> Self {
        let f = p.formats();
        let grid = f.coordinate_a.format.fraction;
        let edge_a = three(|k| f.edge_a[k].format.fraction);
        let edge_b = f.edge_b.format.fraction;
        let normal = |kind| f.axis(kind).format.fraction;
        let to_row = |fraction, row| Rounding::to_row(fraction, row, p.upper).left_out_if(exact.has(Loss::Axis));
        let to = |fraction, kind| to_row(fraction, f.axis(kind));
        Self {
            edge_a: three(|k| to_row(grid, &f.edge_a[k])),
            edge_b: to_row(grid, &f.edge_b),
            normal_a: to(edge_a[0] + edge_a[2], AxisKind::NormalA),
            normal_b: to(2 * edge_b, AxisKind::NormalB),
            cross: three(|k| to(edge_a[k] + edge_b, AxisKind::Cross(k))),
            in_plane_a: three(|k| to(normal(AxisKind::NormalA) + edge_a[k], AxisKind::InPlaneA(k))),
            in_plane_b: to(normal(AxisKind::NormalB) + edge_b, AxisKind::InPlaneB),
            shift: (p.axis_shift > 0).then(|| (p.axis_positions(), p.width)),
        }
    }

    /// Indices around.
    #[inline(always)]
    pub fn edges<M: Mantissa>(&self, [a, b]: &[Triple<M>; 2]) -> Edges<M> {
        let edge = |x: &Triple<M>, k: usize, rounding: Rounding| {
            three(|i| rounding.apply(difference(x[(k + 1) % 3][i].clone(), x[k][i].clone())))
        };
        Edges { a: three(|k| edge(a, k, self.edge_a[k])), b: three(|l| edge(b, l, self.edge_b)) }
    }

    /// n_A and n_B; X2 - X0 is the negated edge e_X2.
    #[inline(always)]
    pub fn normals<W: Wide>(&self, edges: &Edges<W::Mantissa>) -> Normals<W::Mantissa> {
        let normal = |e: &Triple<W::Mantissa>, rounding: Rounding| {
            self.cross::<W>(&e[0], &three(|i| negated(e[2][i].clone())), rounding)
        };
        Normals { a: normal(&edges.a, self.normal_a), b: normal(&edges.b, self.normal_b) }
    }

    /// The direction of one axis.
    #[inline(always)]
    pub fn axis<W: Wide>(
        &self,
        axis: Axis,
        edges: &Edges<W::Mantissa>,
        normals: &Normals<W::Mantissa>,
    ) -> Vector<W::Mantissa> {
        let (e, f, rounding) = match axis {
            Axis::NormalA => return normals.a.clone(),
            Axis::NormalB => return normals.b.clone(),
            Axis::Cross(k, l) => (&edges.a[k], &edges.b[l], self.cross[k]),
            Axis::InPlaneA(k) => (&normals.a, &edges.a[k], self.in_plane_a[k]),
            Axis::InPlaneB(l) => (&normals.b, &edges.b[l], self.in_plane_b),
        };
        self.cross::<W>(e, f, rounding)
    }

    /// e x f, every component accumulated exactly and rounded once. Where axes are shifted, all bounds go left by the
    /// leading zeros that they would have in common if rounded at once, those of the least and the greatest of them: no
    /// digit is lost, and nothing overflows.
    #[inline(always)]
    fn cross<W: Wide>(
        &self,
        e: &Vector<W::Mantissa>,
        f: &Vector<W::Mantissa>,
        rounding: Rounding,
    ) -> Vector<W::Mantissa> {
        let exact = three(|i| cross_component::<W>(e, f, i));
        let Some((most, width)) = self.shift else { return three(|i| rounding.apply(exact[i].clone())) };
        let all = hull(hull(exact[0].clone(), exact[1].clone()), exact[2].clone());
        let places = W::Mantissa::free_places(rounding.apply(all), width - 1, most);
        three(|i| rounding.apply(shifted(exact[i].clone(), places)))
    }
}
