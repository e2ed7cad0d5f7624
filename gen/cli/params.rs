//! The options that every command shares: the parameters of the design.

use super::error::Failure;
use crate::params::options::{self, AXIS_SHIFT, Choice, FREQUENCY, INT_BITS, TAG_WIDTH, TRANSFORM_WIDTH, WIDTH};
use crate::params::{Axes, Guard, Params, ProjectionWidth, Projections, Transform, Upper};
use crate::{design::top::DesignError, device};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::ops::RangeInclusive;

/// Parameters of the design. The defaults are the paper's.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Parameters of the design")]
pub(super) struct ParamArguments {
    /// Working width of the axis test in bits, 6 to 32
    #[arg(long, value_name = "N", default_value_t = Params::default().width)]
    #[arg(value_parser = whole(WIDTH), allow_negative_numbers = true)]
    width: u32,
    /// Integral digits of the input format with the sign, 4 to 8 and at most width - 2
    #[arg(long, value_name = "K", default_value_t = Params::default().int_bits)]
    #[arg(value_parser = whole(INT_BITS), allow_negative_numbers = true)]
    int_bits: u32,
    /// Width of inputs and frame transform in bits, at least width, up to 48
    #[arg(long, value_name = "N", default_value_t = Params::default().transform_width)]
    #[arg(value_parser = whole(*WIDTH.start()..=TRANSFORM_WIDTH), allow_negative_numbers = true)]
    transform_width: u32,
    /// Axis set: the paper's 11, or 17 with the six in-plane edge normals
    #[arg(long, value_name = "SET", default_value = Params::default().axes.name(), value_parser = choice::<Axes>())]
    #[arg(allow_negative_numbers = true)]
    axes: Axes,
    /// Axis units side by side, 1 to the number of axes; one pair every ceil(axes / N) clocks
    #[arg(long, value_name = "N", default_value_t = Params::default().axes_per_clock as u32)]
    #[arg(value_parser = whole(1..=Axes::Seventeen.count() as u32), allow_negative_numbers = true)]
    axes_per_clock: u32,
    /// What is done with duplicate projections
    #[arg(long, value_name = "POLICY", default_value = Params::default().projections.name())]
    #[arg(value_parser = choice::<Projections>())]
    projections: Projections,
    /// Width of the projections that are compared: the full product, or rounded to the working width as in the paper
    #[arg(long, value_name = "WIDTH", default_value = Params::default().projection_width.name())]
    #[arg(value_parser = choice::<ProjectionWidth>())]
    projection_width: ProjectionWidth,
    /// Positions by which an axis is shifted left at most before it is rounded, 0 to 30; 0 as in the paper
    #[arg(long, value_name = "N", default_value_t = Params::default().axis_shift)]
    #[arg(value_parser = whole(AXIS_SHIFT), allow_negative_numbers = true)]
    axis_shift: u32,
    /// Upper bound of an input: the next grid point, or the exact ceiling with a sticky bit
    #[arg(long, value_name = "RULE", default_value = Params::default().upper.name(), value_parser = choice::<Upper>())]
    upper: Upper,
    /// Whether pairs are re-normalised one by one (the paper's 2.5)
    #[arg(long, value_name = "SWITCH", default_value = Params::default().renormalise.name())]
    #[arg(action = clap::ArgAction::Set, value_parser = choice::<bool>())]
    renormalise: bool,
    /// Frame transform: B = M B~ + t, translation only, or none
    #[arg(long, value_name = "KIND", default_value = Params::default().transform.name())]
    #[arg(value_parser = choice::<Transform>())]
    transform: Transform,
    /// Guard: units generated without a stage, or all, answer a pair outside the declared ranges possibly-incorrect
    #[arg(long, value_name = "UNITS", default_value = Params::default().guard.name())]
    #[arg(value_parser = choice::<Guard>())]
    guard: Guard,
    /// Device model that pipelining and estimates use
    #[arg(long, value_name = "NAME", default_value_t = Params::default().device)]
    #[arg(value_parser = PossibleValuesParser::new(device::names()))]
    device: String,
    /// Target clock in MHz, 20 to 250
    #[arg(long, value_name = "MHZ", default_value_t = Params::default().frequency)]
    #[arg(value_parser = whole(FREQUENCY), allow_negative_numbers = true)]
    frequency: u32,
    /// Bits of the pair tag, 0 to 64
    #[arg(long, value_name = "N", default_value_t = Params::default().tag_width)]
    #[arg(value_parser = whole(TAG_WIDTH), allow_negative_numbers = true)]
    tag_width: u32,
}

impl ParamArguments {
    /// The parameters, if they fit together.
    pub fn params(&self) -> Result<Params, Failure> {
        let params = Params {
            width: self.width,
            int_bits: self.int_bits,
            transform_width: self.transform_width,
            axes: self.axes,
            axes_per_clock: self.axes_per_clock as usize,
            projections: self.projections,
            projection_width: self.projection_width,
            axis_shift: self.axis_shift,
            upper: self.upper,
            renormalise: self.renormalise,
            transform: self.transform,
            guard: self.guard,
            device: self.device.clone(),
            frequency: self.frequency,
            tag_width: self.tag_width,
        };
        params.validate().map_err(DesignError::from)?;
        Ok(params)
    }
}

/// Whole numbers of a range.
pub(super) fn whole(legal: RangeInclusive<u32>) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |text| match text.parse() {
        Ok(number) if legal.contains(&number) => Ok(number),
        _ => Err(format!("legal is a whole number from {} to {}", legal.start(), legal.end())),
    }
}

/// The names of a choice.
pub(super) fn choice<T: options::Choice>() -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(T::ALL.iter().map(|value| value.name()))
        .map(|name| *T::ALL.iter().find(|value| value.name() == name).expect("clap lets names of the list through"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Args, FromArgMatches};

    fn parse(options: &[&str]) -> Params {
        let command = ParamArguments::augment_args(clap::Command::new("efsat").no_binary_name(true));
        let matches = command.try_get_matches_from(options).unwrap();
        ParamArguments::from_arg_matches(&matches).unwrap().params().unwrap()
    }

    #[test]
    fn the_defaults_are_the_papers() {
        assert_eq!(parse(&[]), Params::default());
    }

    #[test]
    fn the_canonical_command_line_means_the_same() {
        let options = ["--width=12", "--int-bits=5", "--axes=17", "--axes-per-clock=17", "--projections=skip"];
        let more =
            ["--upper=sticky", "--renormalise=off", "--transform=translate", "--guard=always", "--device=xc6slx150-3"];
        let params = parse(&[&options[..], &more, &["--frequency=20", "--tag-width=0"]].concat());
        assert_eq!((params.width, params.renormalise, params.transform), (12, false, Transform::Translate));
        let canonical = params.command_line();
        let words: Vec<&str> = canonical.split_whitespace().skip(2).collect();
        assert_eq!(parse(&words), params);
    }
}
