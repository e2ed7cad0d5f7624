//! What a unit takes: cells, clocks and time to simulate.

use super::Front;
use super::sample::{self, Place};
use efsat_checks::cosim::{self, CosimError, Options, Simulator};
use efsat_hardware::estimate;
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use serde::Serialize;

/// Runs of which the fastest counts.
const RUNS: usize = 9;

/// What a unit takes of its device, by the estimate; and its clocks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Hardware multipliers.
    pub multipliers: u64,
    /// Look-up tables, those used as memory and shift registers included.
    pub luts: u64,
    /// Flip-flops outside multipliers.
    pub flip_flops: u64,
    /// Whether the device has that many.
    pub fits: bool,
    /// Clocks from a pair to its verdict.
    pub latency: u64,
    /// Clocks between pairs.
    pub interval: u64,
    /// Seconds that the built-in simulator takes for a pair at full speed, measured on some pairs of the scene: the fastest
    /// run of several; none without a pair.
    #[serde(skip)]
    pub simulation: Option<f64>,
}

impl Cost {
    /// The cost of a unit, with the time to simulate the pairs at `places`.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn new(front: &Front<'_>, params: &Params, places: &[Place]) -> Result<Self, CosimError> {
        let design = Design::new(params, Probes::None)?;
        let cells = estimate::whole(&design.top, design.device);
        let (stimulus, _) = sample::stimulus(front, params, places);
        let options = Options { simulator: Simulator::Builtin, keep: None, wave: None, probe: false };
        let mut simulation = None;
        if stimulus.pairs() > 0 {
            for _ in 0..RUNS {
                let report = cosim::run_design(&design, "", &stimulus, &options)?;
                // By the clock, so that what the run has beside these pairs does not count.
                let seconds = report.simulation_seconds / report.total_clocks as f64 * design.interval as f64;
                simulation = Some(simulation.map_or(seconds, |least: f64| least.min(seconds)));
            }
        }
        Ok(Self {
            multipliers: cells.multipliers,
            luts: cells.luts + cells.memory_luts,
            flip_flops: cells.flip_flops,
            fits: cells.shortages(&design.device.capacity).is_empty(),
            latency: design.latency as u64,
            interval: design.interval as u64,
            simulation,
        })
    }
}

/// What a unit with a stage takes more than one without; a negative number where it takes less.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Saving {
    /// Hardware multipliers.
    pub multipliers: i64,
    /// Look-up tables.
    pub luts: i64,
    /// Flip-flops.
    pub flip_flops: i64,
    /// Clocks from a pair to its verdict.
    pub latency: i64,
    /// Clocks between pairs.
    pub interval: i64,
    /// Time to simulate with the stage by that without, measured; none without a pair.
    pub simulation: Option<f64>,
}

impl Saving {
    /// What leaving out a stage saves.
    pub fn new(with: &Cost, without: &Cost) -> Self {
        let less = |x: u64, y: u64| x as i64 - y as i64;
        Self {
            multipliers: less(with.multipliers, without.multipliers),
            luts: less(with.luts, without.luts),
            flip_flops: less(with.flip_flops, without.flip_flops),
            latency: less(with.latency, without.latency),
            interval: less(with.interval, without.interval),
            simulation: with.simulation.zip(without.simulation).map(|(with, without)| with / without),
        }
    }
}
