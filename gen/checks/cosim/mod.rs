//! Co-simulation: the generated design against the reference model, on a simulator of choice.
//!
//! All simulators do the same thing clock for clock: the vectors at full speed, then some again with gaps and
//! back-pressure. GHDL and nvc run the printed VHDL under the printed testbench; the built-in simulator runs the
//! modules it is printed from; Verilator runs a netlist synthesised from the printed text.

mod builtin;
// For the command line.
#[doc(hidden)]
pub mod engine;
mod external;
mod probe;
mod trial;
mod verilator;
mod wave;

pub use builtin::Builtin;
// For the testbench.
#[doc(hidden)]
pub use probe::inputs;
pub use trial::{Bench, Trial};

use efsat_engine::driver::EngineError;
use efsat_unit::artefact::Stimulus;
use efsat_unit::design::{Design, top::DesignError};
use efsat_unit::params::{Params, options::Choice};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What runs the design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulator {
    /// GHDL, the fastest back end installed.
    Ghdl,
    /// nvc.
    Nvc,
    /// The simulator of this program.
    Builtin,
    /// Verilator, on a netlist synthesised from the printed VHDL.
    Verilator(Netlist),
}

impl Choice for Simulator {
    const ALL: &'static [Self] = &[Self::Ghdl, Self::Nvc, Self::Builtin, Self::Verilator(Netlist::Rtl)];

    fn name(self) -> &'static str {
        match self {
            Self::Ghdl => "ghdl",
            Self::Nvc => "nvc",
            Self::Builtin => "builtin",
            Self::Verilator(_) => "verilator",
        }
    }
}

/// What is simulated where it is not the VHDL itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Netlist {
    /// What GHDL infers from the VHDL.
    Rtl,
    /// That mapped by Yosys to cells of the device's family.
    Mapped,
}

impl Choice for Netlist {
    const ALL: &'static [Self] = &[Self::Rtl, Self::Mapped];

    fn name(self) -> &'static str {
        match self {
            Self::Rtl => "rtl",
            Self::Mapped => "mapped",
        }
    }
}

/// How to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// What runs the design.
    pub simulator: Simulator,
    /// Where to leave design, vectors and logs; a temporary folder if none.
    pub keep: Option<PathBuf>,
    /// Waveform to write (`.ghw` or `.vcd`), with a GTKWave layout beside it.
    pub wave: Option<PathBuf>,
    /// Compare inner nodes too.
    pub probe: bool,
}

/// What came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Pairs of the stimulus, all sent to the unit.
    pub vectors: u64,
    /// Pairs outside the declared ranges (and some inside, next to them) that were sent after these: only to a unit
    /// with a guard, and of no user's. Verdicts do not count them.
    pub guard_vectors: u64,
    /// Answers (of both passes) that differ from the reference model's, and differing inner nodes.
    pub mismatches: u64,
    /// Expected verdicts: separate, intersect, possibly incorrect.
    pub verdicts: [u64; 3],
    /// Clocks between pairs, measured (the schedule's where there is but one pair).
    pub initiation_interval: u64,
    /// Clocks from a pair to its verdict, measured.
    pub latency: u64,
    /// Clocks from the first accepted input to the last verdict at full speed.
    pub cycles: u64,
    /// Clocks of the whole run, both passes.
    pub total_clocks: u64,
    /// Name of the simulator that ran.
    pub simulator: String,
    /// Duration of everything: reference model, vectors, compilation, simulation.
    pub seconds: f64,
    /// Duration of the simulation itself.
    pub simulation_seconds: f64,
    /// The first difference, in words.
    pub first_mismatch: Option<String>,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum CosimError {
    /// The design cannot be made.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The simulator is not installed.
    #[error("{0} is not installed: {1}")]
    Missing(&'static str, &'static str),
    /// An option that this simulator does not have.
    #[error("{0}")]
    Option(String),
    /// A name of the design is no legal VHDL.
    #[error("names: {0}")]
    Names(#[from] efsat_hardware::vhdl::Clash),
    /// A file cannot be written or read.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// A tool on the way to the simulator failed.
    #[error(transparent)]
    Tool(#[from] crate::synth::ToolError),
    /// The simulator failed.
    #[error("{tool}: {message}")]
    Failed {
        /// Which.
        tool: String,
        /// What it said.
        message: String,
    },
}

impl From<EngineError> for CosimError {
    fn from(e: EngineError) -> Self {
        Self::Failed { tool: "engine".to_owned(), message: e.to_string() }
    }
}

impl CosimError {
    /// Whether the user can mend it on the command line or by installing something (exit status 2).
    pub fn is_usage(&self) -> bool {
        match self {
            CosimError::Failed { .. } | CosimError::Names(_) => false,
            CosimError::Tool(e) => e.is_usage(),
            _ => true,
        }
    }
}

/// What a simulator reports of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Run {
    mismatches: u64,
    clocks: u64,
    latency: u64,
    interval: u64,
    total: u64,
    simulator: String,
    simulation: Duration,
    first: Option<String>,
    /// One line per clock of the first pass: whether a pair was accepted, and the probe ports.
    probes: Vec<(bool, Vec<i128>)>,
}

/// Generates the design and compares it with the reference model.
///
/// # Errors
/// See [`CosimError`]; a mismatch is no error but part of the report.
pub fn run(params: &Params, command_line: &str, stimulus: &Stimulus, options: &Options) -> Result<Report, CosimError> {
    let design = Design::new(params, options.probe)?;
    run_design(&design, command_line, stimulus, options)
}

/// As [`run`], for a design that exists.
///
/// # Errors
/// As [`run`].
pub fn run_design(
    design: &Design,
    command_line: &str,
    stimulus: &Stimulus,
    options: &Options,
) -> Result<Report, CosimError> {
    let start = Instant::now();
    if let Some(dir) = &options.keep {
        external::check_keep(dir)?;
    }
    let golden = efsat_unit::golden::Golden::new(&design.params);
    let mut verdicts = [0; 3];
    for (pose, pairs) in &stimulus.segments {
        for pair in pairs {
            verdicts[golden.verdict(pose, pair) as usize] += 1;
        }
    }
    let vhdl = matches!(options.simulator, Simulator::Ghdl | Simulator::Nvc);
    if !vhdl && options.wave.is_some() {
        let message = "--wave needs --simulator ghdl or nvc: no other writes a waveform".to_owned();
        return Err(CosimError::Option(message));
    }
    if options.probe && matches!(options.simulator, Simulator::Verilator(_)) {
        let message = "--probe needs --simulator ghdl, nvc or builtin".to_owned();
        return Err(CosimError::Option(message));
    }
    let outside = Stimulus::outside(&design.params);
    let guard_vectors = outside.pairs() as u64;
    let vectors = stimulus.pairs() as u64;
    let extended;
    let stimulus = match guard_vectors {
        0 => stimulus,
        _ => {
            extended = stimulus.clone().followed_by(outside);
            &extended
        }
    };
    let mut run = match options.simulator {
        Simulator::Builtin => {
            let start = Instant::now();
            let mut run = Builtin::new(design).run(stimulus, options.probe);
            run.simulation = start.elapsed();
            external::keep(design, command_line, stimulus, options)?;
            run
        }
        Simulator::Ghdl | Simulator::Nvc => external::run(design, command_line, stimulus, options)?,
        Simulator::Verilator(netlist) => verilator::run(design, command_line, stimulus, netlist, options)?,
    };
    if options.probe {
        let (count, first) = probe::compare(design, stimulus, &run.probes);
        run.mismatches += count;
        run.first = first.or(run.first);
    }
    Ok(Report {
        vectors,
        guard_vectors,
        mismatches: run.mismatches,
        verdicts,
        initiation_interval: if run.interval == 0 { design.interval as u64 } else { run.interval },
        latency: run.latency,
        cycles: run.clocks,
        total_clocks: run.total,
        simulator: run.simulator,
        seconds: start.elapsed().as_secs_f64(),
        simulation_seconds: run.simulation.as_secs_f64(),
        first_mismatch: run.first,
    })
}
