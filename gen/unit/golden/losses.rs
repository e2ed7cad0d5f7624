//! Where accuracy is lost, and sets of such places that are made exact.

/// Where numbers are rounded, in the order of the data flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Loss {
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

impl Loss {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Input, Self::Transform, Self::Renormalise, Self::Axis, Self::Projection];

    /// What it is called.
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

/// The places that are exact, a bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lossless(u8);

impl Lossless {
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

    /// Whether one is exact.
    pub fn has(self, loss: Loss) -> bool {
        self.0 >> loss as u8 & 1 == 1
    }

    /// With one more.
    pub fn and(self, loss: Loss) -> Self {
        Self(self.0 | 1 << loss as u8)
    }

    /// How many.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}
