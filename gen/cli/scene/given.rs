//! Parameters and effects from the scene file and from the command line, which wins.

use super::directions;
use crate::error::{Failure, from_clap};
use crate::params::{EngineArguments, ParamArguments};
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use efsat_engine::artefact::EngineDesign;
use efsat_geometry::collide::hierarchy::Directions;
use efsat_studies::planner::{Request, Stages, Wish};
use efsat_unit::host::settings::{Effect, Parameter, Settings, Switch};
use efsat_unit::params::options::{Choice, OptionRow};
use efsat_unit::params::{Method, Params};

/// The options that say what a stage of the unit is.
const STAGES: [(&str, Effect); 4] = [
    ("transform", Effect::Transform),
    ("renormalise", Effect::Renormalise),
    ("axes", Effect::InPlaneAxes),
    ("upper", Effect::ExactCeiling),
];

/// Options that say which stages there are, and the parameters of the design.
#[derive(Debug, clap::Args)]
pub(super) struct GivenArguments {
    /// Switches a stage: broad_phase, hierarchy, degenerate, transform, renormalise, in_plane_axes or exact_ceiling, to
    /// auto, on or off; may be repeated
    #[arg(long, value_name = "EFFECT=SWITCH", value_parser = effect)]
    effect: Vec<(Effect, Switch)>,
    /// Share of the surviving pairs that may become possibly incorrect by leaving out stages, 0 to 1 [default: 0]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_negative_numbers = true)]
    allowed: Option<f64>,
    /// Directions of the bounding volumes
    #[arg(long, value_name = "K", default_value = "18", value_parser = directions, allow_negative_numbers = true)]
    k: Directions,
    #[command(flatten)]
    options: Options,
}

impl GivenArguments {
    /// An engine around a unit that is not planned.
    pub fn engine(&self, file: &str, settings: &Settings, engine: &EngineArguments) -> Result<EngineDesign, Failure> {
        Ok(self.options.fitting(file, &settings.parameters, false, |unit| engine.design(unit))?.0)
    }

    /// What is asked for in all.
    pub fn request(&self, file: &str, settings: &Settings) -> Result<Request, Failure> {
        let (params, given) = self.options.fitting(file, &settings.parameters, true, ParamArguments::params)?;
        if params.method == Method::Exact {
            let why =
                "--method exact: expected axes or determinants, which have stages to plan; the exact unit has none";
            return Err(Failure::Usage(why.to_owned()));
        }
        let mut request = Request::new(settings, params, self.k);
        for (i, (effect, switch)) in self.effect.iter().enumerate() {
            if self.effect[..i].iter().any(|(before, _)| before == effect) {
                return Err(Failure::Usage(format!("--effect {effect}: found twice; expected once")));
            }
            request.wishes[*effect as usize] = (*switch).into();
        }
        for (option, effect) in STAGES.iter().filter(|(option, _)| given.iter().any(|name| name == option)) {
            if let Some((_, switch)) = self.effect.iter().rev().find(|(other, _)| other == effect) {
                let message = format!("--effect {effect}={} beside --{option}: expected one of the two", switch.name());
                return Err(Failure::Usage(message));
            }
            request.wishes[*effect as usize] = Wish::Option;
        }
        let has = |effect: &Effect| !effect.is_hardware() || Stages::optional(request.params.method).contains(effect);
        if let Some(effect) = Effect::ALL.iter().find(|effect| request.wish(**effect) == Wish::On && !has(effect)) {
            let message = format!("effect {effect}: expected --method axes, which has this stage");
            return Err(Failure::Usage(message));
        }
        request.allowed = self.allowed.unwrap_or(settings.allowed);
        Ok(request)
    }
}

fn effect(text: &str) -> Result<(Effect, Switch), String> {
    let parts = text.split_once('=').and_then(|(effect, switch)| {
        let effect = Effect::ALL.into_iter().find(|e| e.name() == effect)?;
        Some((effect, Switch::ALL.into_iter().find(|s| s.name() == switch)?))
    });
    let legal = || format!("expected one of {}, with =auto, =on or =off", Effect::ALL.map(Effect::name).join(", "));
    parts.ok_or_else(legal)
}

fn share(text: &str) -> Result<f64, String> {
    let legal = |share: &f64| (0.0..=1.0).contains(share);
    text.parse().ok().filter(legal).ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// The parameters of the design as far as they are typed.
#[derive(Clone, Debug)]
struct Options {
    /// Name and value.
    typed: Vec<(String, String)>,
    /// What is not typed is as in the paper.
    like_paper: bool,
}

impl Args for Options {
    fn augment_args(command: Command) -> Command {
        ParamArguments::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        ParamArguments::augment_args_for_update(command)
    }
}

impl FromArgMatches for Options {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let typed = |option: &OptionRow| {
            let name = option.name;
            let id = name.replace('-', "_");
            let is_typed = matches.value_source(&id) == Some(ValueSource::CommandLine);
            let value = matches.get_raw(&id).into_iter().flatten().last().filter(|_| is_typed)?;
            Some((name.to_owned(), value.to_string_lossy().into_owned()))
        };
        let typed = Params::OPTIONS.iter().filter_map(typed).collect();
        Ok(Self { typed, like_paper: matches.get_flag("like_paper") })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Options {
    /// What fits the parameters, and the names of those that were given in the file or typed. The full unit has all stages where
    /// nothing else is given.
    fn fitting<T>(
        &self,
        file: &str,
        of_file: &[Parameter],
        full: bool,
        fits: impl Fn(&ParamArguments) -> Result<T, Failure>,
    ) -> Result<(T, Vec<String>), Failure> {
        let is_typed = |name: &str| self.typed.iter().any(|(typed, _)| typed == name);
        let kept: Vec<&Parameter> = of_file.iter().filter(|parameter| !is_typed(&parameter.name)).collect();
        // One by one first, so that the line of the file can be named.
        for Parameter { name, value, line } in &kept {
            parse(&[format!("--{name}={value}")]).map_err(|e| at(file, *line, e))?;
        }
        let of_file = kept.iter().map(|parameter| (parameter.name.clone(), parameter.value.clone()));
        let given: Vec<(String, String)> = of_file.chain(self.typed.iter().cloned()).collect();
        let mut words: Vec<String> = given.iter().map(|(name, value)| format!("--{name}={value}")).collect();
        if self.like_paper {
            words.push("--like-paper".to_owned());
        }
        let has_axes = !given.iter().any(|(name, value)| name == "method" && value != Method::Axes.name());
        if full && has_axes && !given.iter().any(|(name, _)| name == "axes") {
            // The unit with all stages has 17, and as many axis units are legal.
            words.push("--axes=17".to_owned());
        }
        let found = parse(&words).and_then(|arguments| fits(&arguments)).map_err(|e| match &kept[..] {
            [] => e,
            _ => within(file, e),
        })?;
        Ok((found, given.into_iter().map(|(name, _)| name).collect()))
    }
}

fn parse(words: &[String]) -> Result<ParamArguments, Failure> {
    let command = ParamArguments::augment_args(Command::new("efsat").no_binary_name(true));
    let matches = command.try_get_matches_from(words);
    matches.and_then(|matches| ParamArguments::from_arg_matches(&matches)).map_err(|e| from_clap(&e, &[]))
}

/// A fault of a line of the scene file.
fn at(file: &str, line: usize, e: Failure) -> Failure {
    within(&format!("{file}:{line}"), e)
}

fn within(place: &str, e: Failure) -> Failure {
    match e {
        Failure::Usage(message) => Failure::Usage(format!("{place}: {message}")),
        other => other,
    }
}
