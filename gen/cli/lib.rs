//! The command line: one file per command. The only module that prints.
//!
//! Results go to standard output, everything else to standard error. Exit status: 0 done and everything agreed, 1 a
//! check failed, 2 the command line or an input file is wrong, or an output cannot be written.

mod accuracy;
mod classify;
mod compare;
mod completions;
mod cosim;
mod diagram;
mod error;
mod file;
mod generate;
mod list;
mod manual;
mod mutate;
mod output;
mod params;
mod places;
mod plan_engine;
mod progress;
mod scene;
mod self_intersections;
mod source;
mod stress;
mod synth;
mod tree;
mod wall;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use error::Failure;
use params::{EngineArguments, ParamArguments};
use std::process::ExitCode;

/// Do triangles intersect? Answers exactly in software, and generates and checks VHDL for units whose definite answers are never wrong
#[derive(Debug, Parser)]
#[command(name = "efsat", version = VERSION, after_help = AFTER)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

/// The release and, in a clone, the commit.
const VERSION: &str = env!("EFSAT_VERSION");

const AFTER: &str = "Exit status: 0 done and everything agreed; 1 a check failed (a mismatch, a wrong definite answer); \
    2 the command line or an input file is wrong, or an output cannot be written.";

#[derive(Debug, Subcommand)]
enum Command {
    Generate(generate::Arguments),
    Cosim(cosim::Arguments),
    Classify(classify::Arguments),
    Compare(compare::Arguments),
    Stress(stress::Arguments),
    Wall(wall::Arguments),
    Mutate(mutate::Arguments),
    Synth(synth::Arguments),
    Scene(scene::Arguments),
    PlanEngine(plan_engine::Arguments),
    Tree(tree::Arguments),
    SelfIntersections(self_intersections::Arguments),
    Accuracy(accuracy::Arguments),
    List(list::Arguments),
    Completions(completions::Arguments),
    Manual(manual::Arguments),
}

/// Runs the command line of the process.
pub fn main() -> ExitCode {
    if let Some(help) = params::design_help(typed) {
        return ended(output::print(&help));
    }
    let result = match CommandLine::try_parse() {
        Ok(CommandLine { command }) => match command {
            Command::Generate(arguments) => generate::run(&arguments),
            Command::Cosim(arguments) => cosim::run(&arguments),
            Command::Classify(arguments) => classify::run(&arguments),
            Command::Compare(arguments) => compare::run(&arguments),
            Command::Stress(arguments) => stress::run(&arguments),
            Command::Wall(arguments) => wall::run(&arguments),
            Command::Mutate(arguments) => mutate::run(&arguments),
            Command::Synth(arguments) => synth::run(&arguments),
            Command::Scene(arguments) => scene::run(&arguments),
            Command::PlanEngine(arguments) => plan_engine::run(&arguments),
            Command::Tree(arguments) => tree::run(&arguments),
            Command::SelfIntersections(arguments) => self_intersections::run(&arguments),
            Command::Accuracy(arguments) => accuracy::run(&arguments),
            Command::List(arguments) => list::run(&arguments, &CommandLine::command()),
            Command::Completions(arguments) => completions::run(&arguments, &mut CommandLine::command()),
            Command::Manual(arguments) => manual::run(&arguments, CommandLine::command()),
        },
        Err(e) if !e.use_stderr() => output::print(&e.render().to_string()),
        Err(e) => Err(error::from_clap(&e, &commands())),
    };
    ended(result)
}

/// The exit status, after it is said why.
fn ended(result: Result<(), Failure>) -> ExitCode {
    match result {
        // Whoever reads has seen enough: `| head`.
        Ok(()) | Err(Failure::Closed) => ExitCode::SUCCESS,
        Err(Failure::Check(message)) => report(&message, 1),
        Err(Failure::Usage(message)) => report(&message, 2),
    }
}

/// The command line as the parser has it: commands, their options and values.
pub fn command() -> clap::Command {
    CommandLine::command()
}

/// Whether `efsat` takes these words, without its name, as a command line whose parameters fit together. Nothing is run, and no
/// file is read.
///
/// # Errors
/// What the parser or the parameters complain of; also what asks for help.
pub fn check<'w>(words: impl IntoIterator<Item = &'w str>) -> Result<(), clap::Error> {
    let matches = command().try_get_matches_from(std::iter::once("efsat").chain(words))?;
    CommandLine::from_arg_matches(&matches)?;
    let (mut matches, mut command) = (&matches, &command());
    while let Some((name, inner)) = matches.subcommand() {
        matches = inner;
        command = command.find_subcommand(name).expect("the parser knows its command");
    }
    if !command.get_arguments().any(|argument| argument.get_id() == "like_paper") {
        return Ok(());
    }
    let is_set = |flag| matches.try_get_one::<bool>(flag).ok().flatten().copied();
    let unit = ParamArguments::from_arg_matches(matches)?;
    let fits = match is_set("engine") {
        Some(true) => EngineArguments::from_arg_matches(matches)?.unit(&unit, is_set("pairs_by_number") == Some(true)),
        _ => unit.params(),
    };
    fits.map(|_| ()).map_err(|failure| clap::Error::raw(ErrorKind::ValueValidation, failure.message()))
}

/// The command on the command line, as far as it is one.
fn typed() -> clap::Command {
    let mut command = CommandLine::command();
    for argument in std::env::args_os().skip(1) {
        match command.find_subcommand(&argument) {
            Some(found) => command = found.clone(),
            None => break,
        }
    }
    command
}

/// The names of the commands that may follow those on the command line.
fn commands() -> Vec<String> {
    typed().get_subcommands().map(|c| c.get_name().to_owned()).collect()
}

/// Says on standard error what an interruption leaves.
pub fn interrupted() {
    output::tell("interrupted", &progress::left());
}

/// Says on standard error why the process ends with `status`.
pub fn report(message: &str, status: u8) -> ExitCode {
    output::tell("error", message);
    ExitCode::from(status)
}
