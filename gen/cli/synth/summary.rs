//! The JSON object of `efsat synth`.

use efsat_checks::synth::{Cells, CriticalPath, Report, Routed, Timing, Unit};
use efsat_hardware::device::{self, Resources};
use efsat_unit::params::{Params, options::Choice};
use serde::Serialize;
use std::collections::BTreeMap;

/// The object.
#[derive(Serialize)]
pub(super) struct Summary<'a> {
    flow: &'a str,
    tools: &'a [String],
    device: &'a str,
    counted_for: &'a str,
    initiation_interval: usize,
    latency: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    clocks_per_expansion: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    block_rams: Option<BlockRams>,
    units: Branch<'a>,
    capacity: Prediction,
    #[serde(skip_serializing_if = "Option::is_none")]
    slices: Option<Slices>,
    clock: Clock<'a>,
    faults: &'a [String],
}

/// Block RAMs of 18 kbit of an engine.
#[derive(Serialize)]
struct BlockRams {
    predicted: u64,
    capacity: u32,
}

/// Cells as predicted, or as there are on the part.
#[derive(Serialize)]
struct Prediction {
    multipliers: u64,
    luts: u64,
    memory_luts: u64,
    flip_flops: u64,
    carry: u64,
}

/// Cells as mapped.
#[derive(Serialize)]
struct Mapped {
    #[serde(flatten)]
    cells: Prediction,
    registered_multipliers: u64,
    absorbed_flip_flops: u64,
    block_rams: u64,
}

/// A unit; counts are of one instance with everything in it.
#[derive(Serialize)]
struct Branch<'a> {
    entity: &'a str,
    instances: u64,
    predicted: Prediction,
    #[serde(skip_serializing_if = "Option::is_none")]
    actual: Option<Mapped>,
    parts: Vec<Branch<'a>>,
}

/// Slices of a Virtex-II by the fitted rule and by the two limits of packing.
#[derive(Serialize)]
struct Slices {
    estimate: u64,
    dense: u64,
    related_only: u64,
}

/// Frequencies in MHz.
#[derive(Serialize)]
struct Clock<'a> {
    target: u32,
    scheduled: f64,
    scheduled_end: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    estimated: Option<Estimate<'a>>,
    #[serde(flatten)]
    routed: Option<After<'a>>,
}

/// Static timing of a Virtex-II netlist, before placement; delays in ns.
#[derive(Serialize)]
struct Estimate<'a> {
    megahertz: f64,
    derated_megahertz: f64,
    into_multiplier: Option<f64>,
    out_of_multiplier: Option<f64>,
    path: &'a [String],
}

/// After routing; no clock, path and cells where that did not end in time.
#[derive(Serialize)]
struct After<'a> {
    asked: u32,
    median: Option<f64>,
    met: bool,
    placer: &'static str,
    rerouted: bool,
    loads: Loads,
    seeds: BTreeMap<u32, Option<f64>>,
    critical_path: Option<Path<'a>>,
    used: Option<&'a BTreeMap<String, u64>>,
}

/// The most inputs that one output drives.
#[derive(Serialize)]
struct Loads {
    logic: usize,
    flip_flop: usize,
}

/// Delays in ns.
#[derive(Serialize)]
struct Path<'a> {
    logic: f64,
    routing: f64,
    steps: Vec<Step<'a>>,
}

#[derive(Serialize)]
struct Step<'a> {
    signal: &'a str,
    logic: f64,
    routing: f64,
}

impl From<Resources> for Prediction {
    fn from(r: Resources) -> Self {
        let Resources { multipliers, luts, memory_luts, flip_flops, carry } = r;
        Self { multipliers, luts, memory_luts, flip_flops, carry }
    }
}

impl From<Cells> for Mapped {
    fn from(c: Cells) -> Self {
        let Cells { resources, registered_multipliers, absorbed_flip_flops, block_rams } = c;
        Self { cells: resources.into(), registered_multipliers, absorbed_flip_flops, block_rams }
    }
}

impl<'a> From<&'a Unit> for Branch<'a> {
    fn from(unit: &'a Unit) -> Self {
        Self {
            entity: &unit.entity,
            instances: unit.instances,
            predicted: unit.predicted.into(),
            actual: unit.actual.map(Mapped::from),
            parts: unit.parts.iter().map(Branch::from).collect(),
        }
    }
}

impl<'a> From<&'a CriticalPath> for Path<'a> {
    fn from(path: &'a CriticalPath) -> Self {
        let step = |s: &'a efsat_checks::synth::Step| Step { signal: &s.signal, logic: s.logic, routing: s.routing };
        Self { logic: path.logic(), routing: path.routing(), steps: path.steps.iter().map(step).collect() }
    }
}

impl<'a> From<&'a Timing> for Estimate<'a> {
    fn from(timing: &'a Timing) -> Self {
        Self {
            megahertz: timing.megahertz,
            derated_megahertz: timing.derated_megahertz,
            into_multiplier: timing.beside_multipliers.into,
            out_of_multiplier: timing.beside_multipliers.out_of,
            path: &timing.path,
        }
    }
}

impl<'a> Summary<'a> {
    /// The object of a report.
    pub fn new(report: &'a Report, params: &'a Params, faults: &'a [String]) -> Self {
        let after = |routed: &'a Routed| After {
            asked: routed.asked,
            median: routed.median(),
            met: routed.is_met(),
            placer: routed.placer.name(),
            rerouted: routed.reroute,
            loads: Loads { logic: routed.loads.logic, flip_flop: routed.loads.flip_flop },
            seeds: (1..).zip(routed.seeds.iter().map(|seed| seed.as_ref().map(|seed| seed.megahertz))).collect(),
            critical_path: routed.middle().map(|middle| (&middle.critical).into()),
            used: routed.middle().map(|middle| &middle.used),
        };
        let (scheduled, scheduled_end) = &report.scheduled;
        Self {
            flow: report.flow.name(),
            tools: &report.tools,
            device: device::find(&params.device).map_or(&params.device, |device| device.name),
            counted_for: report.counted_for.name,
            initiation_interval: report.interval,
            latency: report.latency,
            clocks_per_expansion: report.expansion_clocks,
            block_rams: report
                .expansion_clocks
                .map(|_| BlockRams { predicted: report.predicted_block_rams, capacity: report.counted_for.block_rams }),
            units: (&report.top).into(),
            capacity: report.counted_for.capacity.into(),
            slices: report.slices().map(|s| Slices {
                estimate: s.fitted,
                dense: s.dense,
                related_only: s.related_only,
            }),
            clock: Clock {
                target: params.frequency,
                scheduled: *scheduled,
                scheduled_end,
                estimated: report.timing.as_ref().map(Estimate::from),
                routed: report.routed.as_ref().map(after),
            },
            faults,
        }
    }
}
