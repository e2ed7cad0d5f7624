//! The axes in the order of the contract, with what they are made of and what they project.

use crate::params::{Axes, AxisKind, Projections};

/// A factor of a cross product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Factor {
    /// e_Ak.
    EdgeA(usize),
    /// e_Bl.
    EdgeB(usize),
    /// n_A.
    NormalA,
    /// n_B.
    NormalB,
}

/// A separating-axis candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Position in the contract's order, also its bit in the flags.
    pub index: usize,
    /// Kind, which decides the formats.
    pub kind: AxisKind,
    /// Left factor.
    pub left: Factor,
    /// Right factor.
    pub right: Factor,
}

impl Axis {
    /// All axes of a set, in order: n_A, n_B, C_00 ... C_22, then n_A x e_A0..2, n_B x e_B0..2.
    pub fn all(axes: Axes) -> Vec<Self> {
        let mut list = vec![
            // (V1 - V0) x (V2 - V0) = e_2 x e_0: the same products, so the same intervals.
            (AxisKind::NormalA, Factor::EdgeA(2), Factor::EdgeA(0)),
            (AxisKind::NormalB, Factor::EdgeB(2), Factor::EdgeB(0)),
        ];
        for k in 0..3 {
            list.extend((0..3).map(|l| (AxisKind::Cross(k), Factor::EdgeA(k), Factor::EdgeB(l))));
        }
        list.extend((0..3).map(|k| (AxisKind::InPlaneA(k), Factor::NormalA, Factor::EdgeA(k))));
        list.extend((0..3).map(|l| (AxisKind::InPlaneB, Factor::NormalB, Factor::EdgeB(l))));
        list.truncate(axes.count());
        let number = |(index, (kind, left, right))| Self { index, kind, left, right };
        list.into_iter().enumerate().map(number).collect()
    }

    /// The axes without in-plane ones in the order in which they can be tested where the edges of B come one after the
    /// other.
    pub fn as_edges_come(all: &[Self]) -> Vec<Self> {
        let mut sorted = all.to_vec();
        sorted.sort_by_key(|axis| match (axis.kind, axis.right) {
            (AxisKind::NormalA, _) => 0,
            (AxisKind::Cross(_), Factor::EdgeB(l)) => 1 + l,
            // The normal of B is made of its last edge and its first.
            _ => 3,
        });
        sorted
    }

    /// Name: `n_a`, `c_01`, `n_a_a2`, ...
    pub fn name(&self) -> String {
        match (self.kind, self.left, self.right) {
            (AxisKind::NormalA, ..) => "n_a".to_owned(),
            (AxisKind::NormalB, ..) => "n_b".to_owned(),
            (AxisKind::Cross(k), _, Factor::EdgeB(l)) => format!("c_{k}{l}"),
            (AxisKind::InPlaneA(k), ..) => format!("n_a_a{k}"),
            (AxisKind::InPlaneB, _, Factor::EdgeB(l)) => format!("n_b_b{l}"),
            (kind, _, right) => unreachable!("no axis {kind:?} with {right:?}"),
        }
    }

    /// Whether the axis is one of the six in-plane edge normals, which need a finished normal.
    pub fn in_plane(&self) -> bool {
        matches!(self.kind, AxisKind::InPlaneA(_) | AxisKind::InPlaneB)
    }

    /// The edge of A whose two ends project to one number, if any, and likewise of B. `None` in a normal's own
    /// triangle: there all three do.
    fn edges(&self) -> [Duplicates; 2] {
        match (self.kind, self.right) {
            (AxisKind::NormalA, _) => [Duplicates::All, Duplicates::None],
            (AxisKind::NormalB, _) => [Duplicates::None, Duplicates::All],
            (AxisKind::Cross(k), Factor::EdgeB(l)) => [Duplicates::Edge(k), Duplicates::Edge(l)],
            (AxisKind::InPlaneA(k), _) => [Duplicates::Edge(k), Duplicates::None],
            (AxisKind::InPlaneB, Factor::EdgeB(l)) => [Duplicates::None, Duplicates::Edge(l)],
            (kind, right) => unreachable!("no axis {kind:?} with {right:?}"),
        }
    }

    /// Duplicate projections of triangle A (0) or B (1).
    pub fn duplicates(&self, triangle: usize) -> Duplicates {
        self.edges()[triangle]
    }

    /// The vertices of triangle A (0) or B (1) that are projected under a policy, ascending.
    pub fn projected(&self, triangle: usize, policy: Projections) -> Vec<usize> {
        match (policy, self.duplicates(triangle)) {
            (Projections::All | Projections::Intersect, _) | (_, Duplicates::None) => vec![0, 1, 2],
            (Projections::Skip, Duplicates::All) => vec![0],
            (Projections::Skip, Duplicates::Edge(k)) => (0..3).filter(|v| *v != (k + 1) % 3).collect(),
        }
    }
}

/// Which projections of one triangle are equal in exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Duplicates {
    /// None.
    None,
    /// Vertices k and k + 1.
    Edge(usize),
    /// All three.
    All,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_projections() {
        let names: Vec<String> = Axis::all(Axes::Seventeen).iter().map(Axis::name).collect();
        assert_eq!(names[..4], ["n_a", "n_b", "c_00", "c_01"]);
        assert_eq!(names[10..13], ["c_22", "n_a_a0", "n_a_a1"]);
        let count = |policy| -> usize {
            let axes = Axis::all(Axes::Eleven);
            axes.iter().map(|a| a.projected(0, policy).len() + a.projected(1, policy).len()).sum()
        };
        assert_eq!((count(Projections::All), count(Projections::Skip)), (66, 44));
    }
}
