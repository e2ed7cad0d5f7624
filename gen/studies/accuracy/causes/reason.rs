//! Why no width decides a pair.

use efsat_geometry::exact::{Exact, Relation};
use efsat_unit::golden::AxisAnswer;
use efsat_unit::params::AxisKind;
use serde::{Deserialize, Serialize};

/// Why no width decides a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// All in one plane, and not separated by the axes in it.
    Coplanar,
    /// They touch.
    Touch,
    /// A triangle without a normal: a segment or a point.
    Degenerate,
    /// They intersect, and an edge of A is parallel to one of B: C_kl is zero and can show no overlap.
    ParallelEdges,
}

impl Reason {
    /// The reason, from the exact answer and the exact axes; none if exact axes decide the pair.
    pub(in crate::accuracy) fn of(relation: Relation, axes: &[AxisAnswer]) -> Option<Self> {
        if axes.iter().any(|axis| axis.separated) || axes[..11].iter().all(|axis| axis.overlapping) {
            return None;
        }
        let normals = axes.iter().filter(|axis| matches!(axis.kind, AxisKind::NormalA | AxisKind::NormalB));
        Some(if relation.coplanar {
            Self::Coplanar
        } else if relation.class == Exact::Touch {
            Self::Touch
        } else if normals.clone().any(|axis| axis.zero) {
            Self::Degenerate
        } else {
            Self::ParallelEdges
        })
    }
}

/// Reasons as counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Reasons {
    /// In one plane.
    pub coplanar: u64,
    /// Touching.
    pub touch: u64,
    /// With a segment or a point.
    pub degenerate: u64,
    /// Intersecting, with parallel edges.
    pub parallel_edges: u64,
}

impl Reasons {
    /// Counts one more.
    pub fn add(&mut self, reason: Reason) {
        match reason {
            Reason::Coplanar => self.coplanar += 1,
            Reason::Touch => self.touch += 1,
            Reason::Degenerate => self.degenerate += 1,
            Reason::ParallelEdges => self.parallel_edges += 1,
        }
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.coplanar + self.touch + self.degenerate + self.parallel_edges
    }
}
