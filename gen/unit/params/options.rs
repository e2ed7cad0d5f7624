//! The options of a design, each in one place: name, help, value, default, permitted values, and what it affects.
//!
//! The command line reads them by [clap](https://docs.rs/clap), which whoever only generates VHDL does not compile: the
//! feature `clap` makes [`Params`] a group of its arguments.

use super::{Axes, Bound, ExactClocks, Guard, Method, ProjectionWidth, Projections, Transform, Truth, Upper};
#[cfg(feature = "clap")]
use super::{CLOCKS_PER_PAIR, EXACT_CLOCKS, LEVELS, SPAN};
#[cfg(feature = "clap")]
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
#[cfg(feature = "clap")]
use std::ffi::OsStr;
use std::ops::RangeInclusive;

/// Permitted widths of the axis test.
pub const WIDTH: RangeInclusive<u32> = 6..=32;
/// Permitted integral digits, the bound by the width aside.
pub const INT_BITS: RangeInclusive<u32> = 4..=8;
/// Greatest width of the frame transform; the least is the width of the axis test.
pub const TRANSFORM_WIDTH: u32 = 48;
/// Bits that projections may have more than the working width.
pub const PROJECTION_PLUS: RangeInclusive<u32> = 0..=31;
/// Permitted shifts of an axis; the width of the axis test bounds them too.
pub const AXIS_SHIFT: RangeInclusive<u32> = 0..=30;
/// Permitted target clocks in MHz.
pub const FREQUENCY: RangeInclusive<u32> = 20..=400;
/// Permitted widths of the tag.
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

/// A value as the command line spells it.
pub trait Spelled {
    /// The text.
    fn spelled(&self) -> String;
}

impl<T: Choice> Spelled for T {
    fn spelled(&self) -> String {
        self.name().to_owned()
    }
}

impl Spelled for ProjectionWidth {
    fn spelled(&self) -> String {
        match self {
            Self::Rounded => "rounded".to_owned(),
            Self::Plus(bits) => format!("+{bits}"),
            Self::Full => "full".to_owned(),
        }
    }
}

macro_rules! spelled_as_displayed {
    ($($type:ty)+) => {$(
        impl Spelled for $type {
            fn spelled(&self) -> String {
                self.to_string()
            }
        }
    )+};
}

spelled_as_displayed!(u32 usize String);

impl Spelled for ExactClocks {
    fn spelled(&self) -> String {
        self.map_or("off".to_owned(), |number| number.to_string())
    }
}

/// What an option has an effect on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affects {
    /// Verdicts of any pair, and the hardware.
    Verdicts,
    /// Verdicts of pairs outside the declared ranges alone, and the hardware.
    Outside,
    /// The hardware alone.
    Hardware,
}

/// What is known of an option without its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OptionRow {
    /// Its name without dashes.
    pub name: &'static str,
    /// What it has an effect on.
    pub affects: Affects,
    /// The methods that have it. The choice of the method counts as one of those that are not the default: a design of the
    /// default method does not spell it out.
    pub of: &'static [Method],
}

/// A set of options, each in one place: a struct with attributes, its defaults, and the method that lists all options (without
/// their dashes) with their values, in a fixed order. A row is name, field and type, default, and further arguments for clap;
/// its comment is its help, and attributes after that are kept.
#[macro_export]
macro_rules! option_set {
    (
        $(#[$of_set:meta])* $set:ident,
        $(#[$of_default:meta])* default,
        $(#[$of_list:meta])* $list:ident;
        $(
            #[doc = $help:literal]
            $(#[$more:meta])*
            $name:literal $field:ident: $type:ty = $default:expr, [$($argument:tt)*];
        )+
    ) => {
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "clap", derive(clap::Args))]
        $(#[$of_set])*
        pub struct $set {
            $(
                #[doc = $help]
                #[cfg_attr(feature = "clap", arg(long = $name, default_value = <$type>::spelled(&$default), $($argument)*))]
                $(#[$more])*
                pub $field: $type,
            )+
        }

        impl Default for $set {
            $(#[$of_default])*
            fn default() -> Self {
                Self { $($field: $default,)+ }
            }
        }

        impl $set {
            $(#[$of_list])*
            pub fn $list(&self) -> Vec<(&'static str, String)> {
                vec![$(($name, self.$field.spelled()),)+]
            }
        }
    };
}

/// The table of options. To a row of [`option_set`] come the paper's value where that is another, what the option affects, and
/// which method has it.
macro_rules! options {
    ($(
        #[doc = $help:literal]
        $name:literal $field:ident: $type:ty = $default:expr $(; paper $paper:expr)?, $affects:ident, [$($of:ident)+],
            [$($argument:tt)*];
    )+) => {
        option_set! {
            /// A complete parameter set. Build one with [`Params::default`] and change fields, then
            /// [`validate`](Params::validate).
            #[cfg_attr(feature = "clap", command(next_help_heading = "Parameters of the design", arg = like_paper()))]
            Params,
            /// The design that decides most pairs on the fewest multipliers at the paper's rate.
            default,
            /// Every option of all methods (without its dashes) with its value, in a fixed order. Those that the method does
            /// not have are at their defaults if the parameters are valid.
            every_option;
            $(
                #[doc = $help]
                $(#[cfg_attr(feature = "clap", arg(default_value_if("like_paper", "true", <$type>::spelled(&$paper))))])?
                $name $field: $type = $default, [$($argument)*];
            )+
        }

        impl Params {
            /// All options of all methods.
            pub const OPTIONS: &[OptionRow] = &[$(OptionRow { name: $name, affects: Affects::$affects, of: &[$(Method::$of),+] },)+];

            /// The default design of a method.
            pub fn of(method: Method) -> Self {
                let transform = if method == Method::Exact { Transform::Off } else { Transform::On };
                Self { method, transform, ..Self::default() }
            }

            /// The default design of the exact unit for geometry that is snapped to the grid of the frame transform.
            pub fn snapped() -> Self {
                let exact = Self::of(Method::Exact);
                Self { truth: Truth::Snapped, transform: Transform::On, transform_width: SNAPPED_WIDTH, ..exact }
            }

            /// The paper's design.
            pub fn paper() -> Self {
                let mut paper = Self::default();
                $($(paper.$field = $paper;)?)+
                paper
            }
        }
    };
}

/// Bits of the inputs where the exact unit has the frame transform: the greatest with which a factor of a row fits a
/// multiplier.
const SNAPPED_WIDTH: u32 = 19;

options! {
    /// How pairs are decided: by separating axes as in the paper, by determinants, which need fewer multipliers, or exactly on a grid
    "method" method: Method = Method::Axes, Verdicts, [Determinants Exact],
        [value_name = "METHOD", value_parser = choice::<Method>()];
    /// Working width in bits, 6 to 32; each bit more up to 20 halves the undecided pairs of meshes, and above 18 bits a product takes up to four multipliers
    "width" width: u32 = 18, Verdicts, [Axes Determinants Exact],
        [value_name = "N", value_parser = whole(WIDTH), allow_negative_numbers = true];
    /// Integral digits of the input format, sign included: 4 to 8, and at most width - 2
    "int-bits" int_bits: u32 = 4, Verdicts, [Axes Determinants Exact],
        [value_name = "K", value_parser = whole(INT_BITS), allow_negative_numbers = true];
    /// Width of inputs and frame transform in bits, at least width, up to 48
    "transform-width" transform_width: u32 = 32, Verdicts, [Axes Determinants Exact],
        [value_name = "N", value_parser = whole(*WIDTH.start()..=TRANSFORM_WIDTH), allow_negative_numbers = true,
            default_value_if("truth", "snapped", SNAPPED_WIDTH.spelled())];
    /// Axis set: the paper's 11, or 17 with the six in-plane edge normals, which separate coplanar triangles
    "axes" axes: Axes = Axes::Eleven, Verdicts, [Axes],
        [value_name = "SET", value_parser = choice::<Axes>(), allow_negative_numbers = true];
    /// Axis units in parallel, 1 to the number of axes; one pair every ceil(axes / N) clocks
    "axes-per-clock" axes_per_clock: usize = 1, Hardware, [Axes],
        [value_name = "N", value_parser = whole(1..=Axes::Seventeen.count() as u32).map(|n| n as usize),
            allow_negative_numbers = true];
    /// Projections that are equal in exact arithmetic: all are computed (60 multipliers), one of them is (skip, 48), or all are and their enclosures intersected (60)
    "projections" projections: Projections = Projections::Skip; paper Projections::All, Verdicts, [Axes],
        [value_name = "POLICY", value_parser = choice::<Projections>()];
    /// Bits of the projections that are compared: +N (N more than width, up to 31), full (all), or rounded (to width, as in the paper)
    "projection-width" projection_width: ProjectionWidth = ProjectionWidth::Plus(4); paper ProjectionWidth::Rounded, Verdicts, [Axes],
        [value_name = "+N|full|rounded", value_parser = projection_width];
    /// Greatest left shift of an axis before it is rounded, 0 to 30 bits; 0 as in the paper
    "axis-shift" axis_shift: u32 = 7; paper 0, Verdicts, [Axes],
        [value_name = "N", value_parser = whole(AXIS_SHIFT), allow_negative_numbers = true];
    /// Whether intersect is also answered where an edge certainly passes through the other triangle
    "edge-test" edge_test: bool = true; paper false, Verdicts, [Axes],
        [value_name = "SWITCH", action = clap::ArgAction::Set, value_parser = choice::<bool>()];
    /// Upper bound of an input: the next grid point, or the exact ceiling with a sticky bit
    "upper" upper: Upper = Upper::Implied, Verdicts, [Axes],
        [value_name = "RULE", value_parser = choice::<Upper>()];
    /// Whether pairs are re-normalised one by one (the paper's 2.5)
    "renormalise" renormalise: bool = true, Verdicts, [Axes],
        [value_name = "SWITCH", action = clap::ArgAction::Set, value_parser = choice::<bool>()];
    /// Determinants, exact: clocks between pairs, the initiation interval
    "clocks-per-pair" clocks_per_pair: u32 = 1, Hardware, [Determinants Exact],
        [value_name = "N", value_parser = one_of(CLOCKS_PER_PAIR), allow_negative_numbers = true];
    /// Exact: off, or a cascade: rounded determinants first, then the exact unit for what they leave open, with 11 to 32 clocks per pair
    "exact-clocks" exact_clocks: ExactClocks = None, Verdicts, [Exact],
        [value_name = "N", value_parser = off_or(EXACT_CLOCKS), allow_negative_numbers = true];
    /// Exact: the geometry that the answer is for: as given, or snapped to the grid of the frame transform
    "truth" truth: Truth = Truth::Given, Verdicts, [Exact],
        [value_name = "GEOMETRY", value_parser = choice::<Truth>()];
    /// Determinants: how far the rounding of the first products follows the pair, in bits
    "span" span: u32 = 1, Verdicts, [Determinants],
        [value_name = "BITS", value_parser = one_of(SPAN), allow_negative_numbers = true];
    /// Determinants: how many levels of input error are distinguished, for triangles that are small in the input format
    "levels" levels: u32 = 6, Verdicts, [Determinants],
        [value_name = "N", value_parser = one_of(LEVELS), allow_negative_numbers = true];
    /// Determinants: what the error bounds are computed from, from coarse to fine
    "bound" bound: Bound = Bound::Moments, Verdicts, [Determinants],
        [value_name = "KIND", value_parser = choice::<Bound>()];
    /// Determinants: whether the boxes of the triangles are compared as well
    "boxes" boxes: bool = true, Verdicts, [Determinants],
        [value_name = "SWITCH", action = clap::ArgAction::Set, value_parser = choice::<bool>()];
    /// How triangle B reaches the frame of A: B = M B~ + t, translation only, or as it is; off with --method exact without --truth snapped
    "transform" transform: Transform = Transform::On, Verdicts, [Axes Determinants Exact],
        [value_name = "KIND", value_parser = choice::<Transform>(),
            default_value_ifs([("truth", "snapped", "on"), ("method", "exact", "off")])];
    /// Which units answer a pair outside the declared ranges possibly-incorrect: all, or left-out: only those generated without a stage; the others then may answer it wrongly
    "guard" guard: Guard = Guard::Always, Outside, [Axes Determinants],
        [value_name = "UNITS", value_parser = choice::<Guard>()];
    /// Part whose delays decide the pipelining, and for which cells are predicted; or a file NAME.toml of a part of your own
    "device" device: String = "xc2v6000-4".to_owned(), Hardware, [Axes Determinants Exact],
        [value_name = "NAME", value_parser = device()];
    /// Target clock in MHz, 20 to 400; generate refuses one that the longest operation between registers does not hold
    "frequency" frequency: u32 = 100, Hardware, [Axes Determinants Exact],
        [value_name = "MHZ", value_parser = whole(FREQUENCY), allow_negative_numbers = true];
    /// Bits of the pair tag, 0 to 64
    "tag-width" tag_width: u32 = 16, Hardware, [Axes Determinants Exact],
        [value_name = "N", value_parser = whole(TAG_WIDTH), allow_negative_numbers = true];
}

impl Params {
    /// Every option that the method has (without its dashes) with its value, in a fixed order: equal parameters have equal
    /// lists, however they were typed.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let rows = Self::OPTIONS.iter().zip(self.every_option());
        rows.filter(|(row, _)| row.of.contains(&self.method)).map(|(_, option)| option).collect()
    }

    /// The options in which the parameters differ from others, with their values.
    pub fn differences(&self, other: &Self) -> Vec<(&'static str, String)> {
        let both = self.every_option().into_iter().zip(other.every_option());
        both.filter(|(x, y)| x != y).map(|(x, _)| x).collect()
    }

    /// The command line that generates the design, all options spelled out.
    pub fn command_line(&self) -> String {
        let options = self.options().into_iter().map(|(name, value)| format!(" --{name} {value}"));
        format!("efsat generate{}", options.collect::<String>())
    }
}

/// The flag that changes the defaults of other options.
#[cfg(feature = "clap")]
fn like_paper() -> clap::Arg {
    let values = Params::paper().differences(&Params::default()).into_iter();
    let values: String = values.map(|(name, value)| format!(" --{name} {value}")).collect();
    let help = format!("As in the paper:{values}, where these are not given");
    clap::Arg::new("like_paper").long("like-paper").action(clap::ArgAction::SetTrue).help(help)
}

/// Reads whole numbers of a range.
#[cfg(feature = "clap")]
pub fn whole(legal: RangeInclusive<u32>) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse() {
        Ok(number) if legal.contains(&number) => Ok(number),
        _ => Err(format!("expected a whole number from {} to {}", legal.start(), legal.end())),
    }
}

/// Reads whole numbers of a range, or off.
#[cfg(feature = "clap")]
fn off_or(legal: RangeInclusive<u32>) -> impl Fn(&str) -> Result<ExactClocks, String> + Clone + Send + Sync + 'static {
    let number = whole(legal);
    move |text| match text {
        "off" => Ok(None),
        text => number(text).map(Some).map_err(|expected| format!("{expected}, or off")),
    }
}

/// Reads the numbers of a list.
#[cfg(feature = "clap")]
pub fn one_of(legal: &'static [u32]) -> impl TypedValueParser<Value = u32> {
    PossibleValuesParser::new(legal.iter().map(u32::to_string))
        .map(|number| number.parse().expect("clap lets numbers of the list through"))
}

/// Reads a width of projections.
#[cfg(feature = "clap")]
fn projection_width(text: &str) -> Result<ProjectionWidth, String> {
    match text {
        "rounded" => Ok(ProjectionWidth::Rounded),
        "full" => Ok(ProjectionWidth::Full),
        _ => text
            .strip_prefix('+')
            .and_then(|bits| whole(PROJECTION_PLUS)(bits).ok())
            .map(ProjectionWidth::Plus)
            .ok_or_else(|| "expected +0 to +31, full or rounded".to_owned()),
    }
}

/// Reads the name of a device, or of a file of one's own.
#[cfg(feature = "clap")]
pub fn device() -> impl TypedValueParser<Value = String> {
    DeviceParser(PossibleValuesParser::new(efsat_hardware::device::names()))
}

#[cfg(feature = "clap")]
#[derive(Clone)]
struct DeviceParser(PossibleValuesParser);

#[cfg(feature = "clap")]
impl TypedValueParser for DeviceParser {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        match value.to_str() {
            Some(file) if file.ends_with(efsat_hardware::device::OWN) => Ok(file.to_owned()),
            _ => self.0.parse_ref(command, argument, value),
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

/// Reads the names of a choice.
#[cfg(feature = "clap")]
pub fn choice<T: Choice>() -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(T::ALL.iter().map(|value| value.name()))
        .map(|name| *T::ALL.iter().find(|value| value.name() == name).expect("clap lets names of the list through"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_command_line() {
        assert_eq!(
            Params::default().command_line(),
            "efsat generate --width 18 --int-bits 4 --transform-width 32 --axes 11 --axes-per-clock 1 --projections skip \
             --projection-width +4 --axis-shift 7 --edge-test on --upper implied --renormalise on --transform on --guard always --device xc2v6000-4 --frequency 100 --tag-width 16"
        );
    }

    #[test]
    fn each_method_spells_out_its_own_options() {
        let params = Params { method: Method::Determinants, span: 3, ..Params::default() };
        assert_eq!(
            params.command_line(),
            "efsat generate --method determinants --width 18 --int-bits 4 --transform-width 32 --clocks-per-pair 1 --span 3 \
             --levels 6 --bound moments --boxes on --transform on --guard always --device xc2v6000-4 --frequency 100 \
             --tag-width 16"
        );
        let differences = params.differences(&Params::default());
        assert_eq!(differences, [("method", "determinants".to_owned()), ("span", "3".to_owned())]);
    }
}
