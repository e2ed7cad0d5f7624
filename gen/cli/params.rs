//! The options that every command shares: the parameters of the design.

use super::error::Failure;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, Id};
use efsat_engine::artefact::EngineDesign;
use efsat_engine::params::{EngineParams, Memory};
use efsat_unit::design::top::DesignError;
use efsat_unit::params::options::{Choice, OptionRow};
pub(super) use efsat_unit::params::options::{choice, whole};
use efsat_unit::params::{Method, Params};

/// Parameters of the design, and which of them were typed.
#[derive(Debug)]
pub(super) struct ParamArguments {
    typed: Params,
    given: Vec<&'static str>,
    like_paper: bool,
}

impl ParamArguments {
    /// The parameters, if they fit together.
    pub fn params(&self) -> Result<Params, Failure> {
        self.fitting(self.typed.clone())
    }

    /// The parameters of the unit in an engine, which is `usual` where neither method nor pace was typed.
    fn in_engine(&self, usual: &Params) -> Result<Params, Failure> {
        let mut params = self.typed.clone();
        if !self.has("method") && !self.like_paper {
            params.method = usual.method;
        }
        if !self.has("clocks-per-pair") && params.method != Method::Axes {
            params.clocks_per_pair = usual.clocks_per_pair;
        }
        self.fitting(params)
    }

    /// Parameters with what was typed in them, if all fit together.
    fn fitting(&self, params: Params) -> Result<Params, Failure> {
        if self.like_paper && params.method != Method::Axes {
            let found = params.method.name();
            return Err(Failure::Usage(format!("--like-paper with --method {found}: expected --method axes")));
        }
        // The choice of the method itself is no option of the method.
        let typed = |option: &str| option != "method" && self.has(option);
        let given = params.every_option().into_iter().filter(|(option, _)| typed(option));
        params.has(given).and_then(|()| params.validate()).map_err(DesignError::from)?;
        Ok(params)
    }

    /// Whether an option was typed.
    pub fn has(&self, option: &str) -> bool {
        self.given.contains(&option)
    }
}

/// Parameters of the engine, and which of them were typed.
#[derive(Debug)]
pub(super) struct EngineArguments {
    typed: EngineParams,
    given: Vec<(&'static str, String)>,
}

impl EngineArguments {
    /// The parameters as they were typed.
    pub fn params(&self) -> &EngineParams {
        &self.typed
    }

    /// Refuses options of the engine where there is none.
    pub fn refuse(&self) -> Result<(), Failure> {
        self.given.first().map_or(Ok(()), |(option, value)| Err(without_engine(option, value)))
    }

    /// Refuses options that change nothing but clocks, where there are none.
    pub fn refuse_timing(&self) -> Result<(), Failure> {
        let caches = if self.typed.memory == Memory::Axi { &["block-lines", "triangle-lines"][..] } else { &[] };
        let timing = ["expansion-clocks", "memory-width", "queries", "in-flight", "pair-queue", "engines"];
        let given = self.given.iter().find(|(option, _)| timing.contains(option) || caches.contains(option));
        given.map_or(Ok(()), |(option, value)| {
            let why = "expected --engine verilator: the option changes the clocks alone, and the model has none";
            Err(Failure::Usage(format!("--{option} {value}: {why}")))
        })
    }

    /// The engine around a unit.
    pub fn design(&self, unit: &ParamArguments) -> Result<EngineDesign, Failure> {
        Ok(EngineDesign::new(&self.typed, &self.unit(unit, false)?)?)
    }

    /// The engine that takes pairs by number.
    pub fn design_by_number(&self, unit: &ParamArguments) -> Result<EngineDesign, Failure> {
        let has = EngineDesign::OPTIONS_BY_NUMBER;
        if let Some((option, value)) = self.given.iter().find(|(option, _)| !has.contains(option)) {
            let why = format!("expected none of the engine's options but --{}", has.join(", --"));
            return Err(Failure::Usage(format!("--{option} {value} with --pairs-by-number: {why}")));
        }
        Ok(EngineDesign::by_number(&self.typed, &self.unit(unit, true)?)?)
    }

    /// The unit in an engine. For pairs by number it is by default as fast as their words come.
    pub fn unit(&self, unit: &ParamArguments, by_number: bool) -> Result<Params, Failure> {
        let usual = if by_number { Params::of(Method::Determinants) } else { self.typed.unit() };
        let params = unit.in_engine(&usual)?;
        if unit.has("tag-width") {
            let why = "expected no width of the tag with --engine, whose unit carries the numbers of both triangles";
            return Err(Failure::Usage(format!("--tag-width {}: {why}", params.tag_width)));
        }
        self.typed.refuse_of_port(self.given.iter()).map_err(DesignError::from)?;
        Ok(params)
    }
}

/// That an option of the engine was typed, with a value if it has one, where there is no engine.
pub(super) fn without_engine(option: &str, value: &str) -> Failure {
    let given = format!("--{option} {value}");
    Failure::Usage(format!("{}: expected --engine, which has this option", given.trim_end()))
}

impl FromArgMatches for EngineArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let typed = EngineParams::from_arg_matches(matches)?;
        let is_given = |option: &(&str, String)| {
            matches.value_source(&option.0.replace('-', "_")) == Some(ValueSource::CommandLine)
        };
        let given = typed.options().into_iter().filter(is_given).collect();
        Ok(Self { typed, given })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for EngineArguments {
    fn group_id() -> Option<Id> {
        EngineParams::group_id()
    }

    fn augment_args(command: Command) -> Command {
        let ids = EngineParams::default().options().into_iter().map(|(option, _)| option.replace('-', "_"));
        ids.fold(EngineParams::augment_args(command), |command, id| {
            command.mut_arg(id, |arg| arg.hide_short_help(true))
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for ParamArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let typed = |option: &&str| matches.value_source(&option.replace('-', "_")) == Some(ValueSource::CommandLine);
        let given = Params::OPTIONS.iter().map(|row| row.name).filter(typed).collect();
        let like_paper = matches.get_flag("like_paper");
        Ok(Self { typed: Params::from_arg_matches(matches)?, given, like_paper })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for ParamArguments {
    fn group_id() -> Option<Id> {
        Params::group_id()
    }

    fn augment_args(command: Command) -> Command {
        grouped(Params::augment_args(command))
    }

    fn augment_args_for_update(command: Command) -> Command {
        grouped(Params::augment_args_for_update(command))
    }
}

/// What stands in short help for all options of a design, and prints them.
const HELP: &str = "help-design";

/// Options that not all methods have stand apart in the help, and short help has one line for all.
fn grouped(command: Command) -> Command {
    let rows = Params::OPTIONS.iter().map(|row| (row.name.replace('-', "_"), heading(row)));
    let all = rows.chain([("like_paper".to_owned(), Some(AXES))]);
    let command = all.fold(command, |command, (id, heading)| {
        command.mut_arg(id, |arg| {
            match heading {
                Some(heading) => arg.help_heading(heading),
                None => arg,
            }
            .hide_short_help(true)
        })
    });
    let help = format!("Print the {} options of the design, such as --method and --width", Params::OPTIONS.len() + 1);
    command.arg(Arg::new("help_design").long(HELP).action(ArgAction::SetTrue).help(help).display_order(998))
}

/// The help of the options of a design, if it is asked for and the command has such.
pub(super) fn design_help(command: impl FnOnce() -> Command) -> Option<String> {
    let asked = format!("--{HELP}");
    std::env::args_os().take_while(|word| word != "--").find(|word| *word == *asked)?;
    let command = command();
    command.get_arguments().find(|arg| arg.get_long() == Some(HELP))?;
    let of_design = |arg: Arg| {
        let others = !arg.is_hide_short_help_set();
        arg.hide(others)
    };
    let mut command = command.disable_help_flag(true).help_template("{all-args}\n").mut_args(of_design);
    Some(command.render_long_help().to_string())
}

const AXES: &str = "Parameters of --method axes";

fn heading(row: &OptionRow) -> Option<&'static str> {
    match row.of {
        [Method::Axes] => Some(AXES),
        [Method::Determinants] => Some("Parameters of --method determinants"),
        [Method::Exact] => Some("Parameters of --method exact"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_unit::params::Transform;

    fn parse(options: &[&str]) -> Params {
        let command = ParamArguments::augment_args(clap::Command::new("efsat").no_binary_name(true));
        let matches = command.try_get_matches_from(options).unwrap();
        ParamArguments::from_arg_matches(&matches).unwrap().params().unwrap()
    }

    /// The unit of an engine: its method and clocks per pair.
    fn in_engine(options: &str, by_number: bool) -> Result<(Method, usize), Failure> {
        let command = clap::Command::new("efsat").no_binary_name(true);
        let command = EngineArguments::augment_args(ParamArguments::augment_args(command));
        let matches = command.try_get_matches_from(options.split_whitespace()).unwrap();
        let unit = ParamArguments::from_arg_matches(&matches).unwrap();
        let params = EngineArguments::from_arg_matches(&matches).unwrap().unit(&unit, by_number)?;
        Ok((params.method, params.interval()))
    }

    #[test]
    fn the_unit_of_an_engine_keeps_up_with_it() {
        for (options, by_number, method, interval) in [
            ("", false, Method::Determinants, 3),
            ("--expansion-clocks 2", false, Method::Determinants, 2),
            ("--expansion-clocks 1 --span 3", false, Method::Determinants, 1),
            ("--clocks-per-pair 6", false, Method::Determinants, 6),
            ("--method determinants", false, Method::Determinants, 3),
            ("", true, Method::Determinants, 1),
            ("--method axes", false, Method::Axes, 11),
            ("--like-paper", false, Method::Axes, 11),
        ] {
            assert_eq!(in_engine(options, by_number).unwrap(), (method, interval), "{options}");
        }
        let message = in_engine("--axes 17", false).unwrap_err().message();
        assert_eq!(message, "--axes 17: expected --method axes, which has this option");
    }

    #[test]
    fn no_option_means_the_defaults() {
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
