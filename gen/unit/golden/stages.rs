//! The stages in which accuracy is lost, and sets of those that are made exact.

/// Where numbers are rounded, in the order of the data flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Vertices and pose to the input format (contract section 2).
    Input,
    /// B = M B~ + t to the input format (section 3).
    Transform,
    /// Coordinates to the working width (section 4).
    Renormalise,
    /// Edges and axes to their formats (section 5).
    Axis,
    /// Projections to theirs (section 5).
    Projection,
}

impl Stage {
    /// All stages.
    pub const ALL: [Self; 5] = [Self::Input, Self::Transform, Self::Renormalise, Self::Axis, Self::Projection];

    /// What the stage is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Input => "input quantisation",
            Self::Transform => "transform",
            Self::Renormalise => "re-normalisation",
            Self::Axis => "axis rounding",
            Self::Projection => "projection rounding",
        }
    }
}

/// The stages that are exact, a bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact(u8);

impl Exact {
    /// As the unit computes.
    pub const NONE: Self = Self(0);
    /// No rounding at all.
    pub const ALL: Self = Self(31);

    /// Every set, [`NONE`](Self::NONE) first and [`ALL`](Self::ALL) last; set number i is at place i.
    pub fn sets() -> impl Iterator<Item = Self> {
        (0..32).map(Self)
    }

    /// Its place among all sets.
    pub fn index(self) -> usize {
        self.0.into()
    }

    /// Whether a stage is exact.
    pub fn has(self, stage: Stage) -> bool {
        self.0 >> stage as u8 & 1 == 1
    }

    /// With one more.
    pub fn and(self, stage: Stage) -> Self {
        Self(self.0 | 1 << stage as u8)
    }

    /// How many.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}
