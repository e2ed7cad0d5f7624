//! The options that every command shares: the parameters of the design.

use super::error::Failure;
use crate::design::top::DesignError;
use crate::params::Params;
pub(super) use crate::params::options::{choice, whole};

/// Parameters of the design. The defaults are the paper's.
#[derive(Debug, clap::Args)]
pub(super) struct ParamArguments {
    #[command(flatten)]
    typed: Params,
}

impl ParamArguments {
    /// The parameters, if they fit together.
    pub fn params(&self) -> Result<Params, Failure> {
        self.typed.validate().map_err(DesignError::from)?;
        Ok(self.typed.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Transform;
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
