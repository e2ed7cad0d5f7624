//! What one parameter set takes of its device, and how fast it is.

use efsat_checks::synth::{self, Flow, Options, Placer, Subject, SynthError};
use efsat_hardware::device;
use efsat_unit::design::top::DesignError;
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cells {
    /// Hardware multipliers.
    pub multipliers: u64,
    /// Look-up tables, for logic and as shift registers and memory.
    pub luts: u64,
    /// Flip-flops outside multipliers.
    pub flip_flops: u64,
}

impl From<device::Resources> for Cells {
    fn from(r: device::Resources) -> Self {
        Self { multipliers: r.multipliers, luts: r.luts + r.memory_luts, flip_flops: r.flip_flops }
    }
}

/// A design: cells by the device model, clocks by the schedule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hardware {
    /// Predicted cells.
    pub cells: Cells,
    /// Whether there are that many on the device.
    pub fits: bool,
    /// The clock that the schedule's delays allow, MHz.
    pub clock: f64,
    /// Clocks between pairs.
    pub interval: usize,
    /// Clocks from the acceptance of a pair to its verdict.
    pub latency: usize,
}

impl Hardware {
    /// Schedules the design and predicts its cells.
    ///
    /// # Errors
    /// That the design cannot be made.
    pub fn predict(params: &Params) -> Result<Self, SynthError> {
        let device = device::find(&params.device).map_err(DesignError::from)?;
        let design = Design::new(params, Probes::None)?;
        let report = Subject::Unit(&design).predict(Flow::of(device));
        let cells = Cells::from(report.cells());
        let fits = report.shortages().is_empty();
        let (interval, latency) = (report.interval, report.latency);
        Ok(Self { cells, fits, clock: report.scheduled.0, interval, latency })
    }

    /// Nanoseconds per pair at full speed.
    pub fn ns(&self) -> f64 {
        1000.0 * self.interval as f64 / self.clock
    }
}

/// Cells as Yosys maps them.
///
/// # Errors
/// That a tool is missing or fails.
pub fn synthesise(params: &Params) -> Result<Cells, SynthError> {
    let device = device::find(&params.device).map_err(DesignError::from)?;
    let (limit, placer) = (Duration::ZERO, Placer::Static);
    let options =
        Options { flow: Flow::of(device), seeds: 0, limit, route_for: None, placer, reroute: false, keep: None };
    let design = Design::new(params, Probes::None)?;
    let report = synth::run(&Subject::Unit(&design), &params.command_line(), &options, &|_| {})?;
    Ok(report.cells().into())
}
