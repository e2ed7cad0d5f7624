//! What is said of a triangle in pictures and in the viewer.

use super::Contact;
use efsat_unit::pair::Verdict;

/// What is said of a triangle, the most important first. Colours after Okabe and Ito: told apart with any kind of colour
/// vision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Mark {
    /// In a pair that intersects for certain.
    Intersect,
    /// In a pair that the unit leaves open and that touches.
    OpenTouching,
    /// In a pair with a degenerate triangle that touches.
    Degenerate,
    /// In a pair that the unit leaves open and that is separate.
    OpenSeparate,
}

impl Mark {
    pub const ALL: [Self; 4] = [Self::Intersect, Self::OpenTouching, Self::Degenerate, Self::OpenSeparate];

    pub fn of(contact: &Contact) -> Self {
        match (contact.verdict, contact.touches()) {
            (None, _) => Self::Degenerate,
            (Some(Verdict::PossiblyIncorrect), true) => Self::OpenTouching,
            (Some(Verdict::PossiblyIncorrect), false) => Self::OpenSeparate,
            (Some(_), _) => Self::Intersect,
        }
    }

    pub fn colour(self) -> [u8; 3] {
        match self {
            Self::Intersect => [213, 94, 0],
            Self::OpenTouching => [0, 114, 178],
            Self::Degenerate => [0, 158, 115],
            Self::OpenSeparate => [240, 228, 66],
        }
    }

    /// The verdict of the unit.
    pub fn verdict(self) -> &'static str {
        match self {
            Self::Intersect => "intersect",
            Self::OpenTouching | Self::OpenSeparate => "possibly incorrect",
            Self::Degenerate => "not asked",
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Intersect => "intersect",
            Self::OpenTouching => "possibly incorrect, touching",
            Self::Degenerate => "degenerate, touching",
            Self::OpenSeparate => "possibly incorrect, separate",
        }
    }
}
