//! Co-simulation of the planned unit on pairs of a scene.

use super::Front;
use super::sample::{Place, stimulus};
use efsat_checks::cosim::{self, CosimError, Options, Simulator};
use efsat_unit::design::Design;

/// The planned unit in a simulator, and what came out so far.
pub struct Cosimulation<'a, 'b> {
    front: &'b Front<'a>,
    design: Design,
    options: Options,
    /// Pairs that were sent to the unit.
    pub vectors: u64,
    /// Words for the guard that came on top, in a unit that has one.
    pub guard_vectors: u64,
    /// Pairs that the host decided.
    pub host_decided: u64,
    /// Answers that differ from the reference model's.
    pub mismatches: u64,
    /// The first of them, in words.
    pub first_mismatch: Option<String>,
    /// The simulator that ran; none yet.
    pub simulator: Option<String>,
}

impl<'a, 'b> Cosimulation<'a, 'b> {
    /// Vectors of one run.
    pub const BATCH: usize = 8192;

    /// Prepares a unit behind the stages before it.
    pub fn new(front: &'b Front<'a>, design: Design, simulator: Simulator) -> Self {
        let options = Options { simulator, keep: None, wave: None, probe: false };
        Self {
            front,
            design,
            options,
            vectors: 0,
            guard_vectors: 0,
            host_decided: 0,
            mismatches: 0,
            first_mismatch: None,
            simulator: None,
        }
    }

    /// Simulates the pairs at `places`, in their order, a batch at a time.
    ///
    /// # Errors
    /// As [`cosim::run`]; a mismatch is none.
    pub fn simulate(&mut self, places: &[Place]) -> Result<(), CosimError> {
        for batch in places.chunks(Self::BATCH) {
            let (stimulus, decided) = stimulus(self.front, &self.design.params, batch);
            self.host_decided += decided.len() as u64;
            if stimulus.pairs() == 0 {
                continue;
            }
            let report = cosim::run_design(&self.design, &self.design.params.command_line(), &stimulus, &self.options)?;
            self.vectors += report.vectors;
            self.guard_vectors += report.guard_vectors;
            self.mismatches += report.mismatches;
            self.first_mismatch = self.first_mismatch.take().or(report.first_mismatch);
            self.simulator = Some(report.simulator);
        }
        Ok(())
    }
}
