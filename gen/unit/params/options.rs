//! Parameters as the command line spells them: names of values, ranges, and the canonical list of options.

use super::{Axes, Params, ProjectionWidth, Projections, Transform, Upper};
use std::ops::RangeInclusive;

/// Legal widths of the axis test.
pub const WIDTH: RangeInclusive<u32> = 6..=32;
/// Legal integral digits, the bound by the width aside.
pub const INT_BITS: RangeInclusive<u32> = 4..=8;
/// Greatest width of the frame transform; the least is the width of the axis test.
pub const TRANSFORM_WIDTH: u32 = 48;
/// Legal shifts of an axis; the width of the axis test bounds them too.
pub const AXIS_SHIFT: RangeInclusive<u32> = 0..=30;
/// Legal target clocks in MHz.
pub const FREQUENCY: RangeInclusive<u32> = 20..=250;
/// Legal widths of the tag.
pub const TAG_WIDTH: RangeInclusive<u32> = 0..=64;

/// A parameter with few values, each with a name on the command line.
pub trait Choice: Copy + Send + Sync + 'static {
    /// All values, in the order in which they are listed.
    const ALL: &'static [Self];

    /// The value's name.
    fn name(self) -> &'static str;
}

impl Choice for Axes {
    const ALL: &'static [Self] = &[Self::Eleven, Self::Seventeen];

    fn name(self) -> &'static str {
        match self {
            Self::Eleven => "11",
            Self::Seventeen => "17",
        }
    }
}

impl Choice for Projections {
    const ALL: &'static [Self] = &[Self::All, Self::Skip, Self::Intersect];

    fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Skip => "skip",
            Self::Intersect => "intersect",
        }
    }
}

impl Choice for ProjectionWidth {
    const ALL: &'static [Self] = &[Self::Full, Self::Rounded];

    fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Rounded => "rounded",
        }
    }
}

impl Choice for Upper {
    const ALL: &'static [Self] = &[Self::Implied, Self::Sticky];

    fn name(self) -> &'static str {
        match self {
            Self::Implied => "implied",
            Self::Sticky => "sticky",
        }
    }
}

impl Choice for Transform {
    const ALL: &'static [Self] = &[Self::On, Self::Translate, Self::Off];

    fn name(self) -> &'static str {
        match self {
            Self::On => "on",
            Self::Translate => "translate",
            Self::Off => "off",
        }
    }
}

impl Choice for bool {
    const ALL: &'static [Self] = &[true, false];

    fn name(self) -> &'static str {
        if self { "on" } else { "off" }
    }
}

impl Params {
    /// Every option (without its dashes) with its value, in a fixed order: equal parameters have equal lists, however
    /// they were typed.
    pub fn options(&self) -> [(&'static str, String); 15] {
        [
            ("width", self.width.to_string()),
            ("int-bits", self.int_bits.to_string()),
            ("transform-width", self.transform_width.to_string()),
            ("axes", self.axes.name().to_owned()),
            ("axes-per-clock", self.axes_per_clock.to_string()),
            ("projections", self.projections.name().to_owned()),
            ("projection-width", self.projection_width.name().to_owned()),
            ("axis-shift", self.axis_shift.to_string()),
            ("upper", self.upper.name().to_owned()),
            ("renormalise", self.renormalise.name().to_owned()),
            ("transform", self.transform.name().to_owned()),
            ("guard", self.guard.name().to_owned()),
            ("device", self.device.clone()),
            ("frequency", self.frequency.to_string()),
            ("tag-width", self.tag_width.to_string()),
        ]
    }

    /// The command line that generates the design, all options spelled out.
    pub fn command_line(&self) -> String {
        let options = self.options().map(|(name, value)| format!(" --{name} {value}"));
        format!("efsat generate{}", options.concat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_command_line() {
        assert_eq!(
            Params::default().command_line(),
            "efsat generate --width 18 --int-bits 4 --transform-width 32 --axes 11 --axes-per-clock 1 --projections all \
             --projection-width rounded --axis-shift 0 --upper implied --renormalise on --transform on --guard left-out --device xc2v6000-4 --frequency 100 --tag-width 16"
        );
    }
}
