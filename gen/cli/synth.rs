//! `efsat synth`.

mod summary;
mod table;

use super::error::Failure;
use super::generate::misses;
use super::output::{print, print_json, warn, warn_of};
use super::params::{EngineArguments, ParamArguments, choice, whole};
use super::{file, progress};
use efsat_checks::synth::{self, Flow, Options, Placer, Report, Subject};
use efsat_engine::artefact::EngineDesign;
use efsat_hardware::device;
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use efsat_unit::params::options::Choice;
use std::path::PathBuf;
use std::time::Duration;
use summary::Summary;

/// Placements where nothing else is asked for.
const SEEDS: u32 = 3;

/// Minutes that one may take where nothing else is asked for: several times what one takes.
const MINUTES: u32 = 30;

/// Synthesises the design with open tools and compares with what the device model predicts
///
/// GHDL and Yosys map the VHDL entity by entity to a family's cells; flow ecp5 also maps the whole, moves registers
/// into multipliers and memories, and places and routes it with nextpnr for an LFE5U-85 of speed grade 6. Tools are
/// looked for in the folder that EFSAT_TOOLS names, on PATH, and in target/tools/bin, where scripts/setup --synth
/// installs them. Fails if the multipliers are not those predicted, or if the clock is missed after routing.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Family and tools [default: those for --device]
    #[arg(long, value_name = "NAME", value_parser = choice::<Flow>())]
    flow: Option<Flow>,
    /// Placements, two at a time, each with its own seed; the median counts [default: 3]
    #[arg(long, value_name = "N", value_parser = whole(1..=32), allow_negative_numbers = true)]
    seeds: Option<u32>,
    /// Minutes after which a placement is given up, which then counts as the slowest [default: 30]
    #[arg(long, value_name = "N", value_parser = whole(1..=1440), allow_negative_numbers = true)]
    minutes: Option<u32>,
    /// Clock, in MHz, that placement and routing are asked for, and that counts: below the clock of the schedule it leaves
    /// nets more time [default: that of --frequency]
    #[arg(long, value_name = "MHZ", value_parser = whole(20..=400), allow_negative_numbers = true)]
    route_for: Option<u32>,
    /// What places the cells: heap routes what static makes too dense, such as exact at a pair per clock [default: static]
    #[arg(long, value_name = "NAME", value_parser = choice::<Placer>())]
    placer: Option<Placer>,
    /// Route nets of the longest paths again: a faster clock where that ends (nextpnr's --tmg-ripup)
    #[arg(long)]
    reroute: bool,
    /// Stop after Yosys: no placement, no clock
    #[arg(long, conflicts_with_all = ["seeds", "minutes", "route_for", "placer", "reroute"])]
    no_route: bool,
    /// The device model's counts and clock alone: no tool runs
    #[arg(long, conflicts_with_all = ["seeds", "minutes", "route_for", "placer", "reroute", "no_route", "keep"])]
    predict: bool,
    /// Leave sources, netlists, logs and reports in DIR
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Synthesise the collision engine with the unit in it
    #[arg(long)]
    engine: bool,
    #[command(flatten)]
    params: ParamArguments,
    #[command(flatten)]
    engine_params: EngineArguments,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let engine = engine(arguments)?;
    let params = match &engine {
        Some(engine) => engine.unit.params.clone(),
        None => arguments.params.params()?,
    };
    let device = device::find(&params.device).map_err(|e| Failure::Usage(e.to_string()))?;
    let flow = arguments.flow.unwrap_or(Flow::of(device));
    let of_placement = [
        ("--no-route", arguments.no_route),
        ("--seeds", arguments.seeds.is_some()),
        ("--minutes", arguments.minutes.is_some()),
        ("--route-for", arguments.route_for.is_some()),
        ("--placer", arguments.placer.is_some()),
        ("--reroute", arguments.reroute),
    ];
    if let Some((option, _)) = of_placement.into_iter().find(|(_, given)| *given && !flow.routes()) {
        return Err(Failure::Usage(format!("{option}: flow {} ends after Yosys; expected --flow ecp5", flow.name())));
    }
    let unit;
    let (subject, command_line) = match &engine {
        Some(engine) => (Subject::Engine(engine), engine.command_line()),
        None => {
            unit = Design::new(&params, Probes::None)?;
            (Subject::Unit(&unit), params.command_line())
        }
    };
    if arguments.predict {
        let report = subject.predict(flow);
        warn_of(report.counted_for, &report.shortages());
        let (megahertz, end) = &report.scheduled;
        if misses(*megahertz, params.frequency) {
            let ns = 1000.0 / megahertz;
            warn(&format!(
                "{end} takes {ns:.1} ns between registers; efsat generate refuses --frequency {}",
                params.frequency
            ));
        }
        return show(&report, &params, arguments.json);
    }
    let seeds = if arguments.no_route { 0 } else { arguments.seeds.unwrap_or(SEEDS) };
    let limit = Duration::from_secs(60 * u64::from(arguments.minutes.unwrap_or(MINUTES)));
    let placer = arguments.placer.unwrap_or(Placer::Static);
    arguments.keep.iter().try_for_each(|dir| file::named(dir, "directory"))?;
    let (route_for, reroute) = (arguments.route_for, arguments.reroute);
    let options = Options { flow, seeds, limit, route_for, placer, reroute, keep: arguments.keep.clone() };
    let spinner = progress::spinner("synthesising");
    let step = |what: &str| spinner.set_message(what.to_owned());
    let report = synth::run(&subject, &command_line, &options, &step)?;
    spinner.finish_and_clear();
    show(&report, &params, arguments.json)
}

/// The engine, if it is asked for.
fn engine(arguments: &Arguments) -> Result<Option<EngineDesign>, Failure> {
    if arguments.engine {
        return arguments.engine_params.design(&arguments.params).map(Some);
    }
    arguments.engine_params.refuse()?;
    Ok(None)
}

/// Prints a report; what is wrong with it is a failed check.
fn show(report: &Report, params: &Params, json: bool) -> Result<(), Failure> {
    let faults = report.faults();
    if json {
        print_json(&Summary::new(report, params, &faults))?;
    } else {
        print(&table::text(report, params))?;
    }
    if faults.is_empty() { Ok(()) } else { Err(Failure::Check(faults.join("; "))) }
}
