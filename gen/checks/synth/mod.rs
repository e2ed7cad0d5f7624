//! Open synthesis tools on the generated VHDL: Yosys' counts and nextpnr's clock beside what the device model predicts.
//!
//! VHDL, then GHDL, then Verilog ([`verilog`]), then Yosys ([`yosys`]) with one synthesis an entity, so that every count
//! belongs to a unit of ours. Netlists of cells are read and written in [`netlist`] and [`product_registers`]. For the ECP5
//! there is a second synthesis of the whole, whose registers move into multipliers and memories (`memory_registers`), placed and
//! routed with several seeds.

mod cells;
#[cfg(test)]
mod control;
mod critical_path;
mod error;
mod flow;
mod harness;
mod loads;
mod memory_registers;
#[doc(hidden)]
pub mod netlist;
#[doc(hidden)]
pub mod product_registers;
mod route;
#[doc(hidden)]
pub mod slices;
#[doc(hidden)]
pub mod static_timing;
mod subject;
#[doc(hidden)]
pub mod tools;
mod units;
#[doc(hidden)]
pub mod verilog;
#[doc(hidden)]
pub mod yosys;

pub use flow::Flow;
pub use subject::Subject;
pub use units::Unit;
// For the command line and the testbench.
#[doc(hidden)]
pub use self::{
    cells::Cells,
    critical_path::{CriticalPath, Step},
    error::{SynthError, ToolError},
    loads::Loads,
    route::{Placed, Placer, Routed},
    slices::Slices,
    static_timing::Timing,
};

use efsat_hardware::device::{Device, Family, Resources};
use efsat_hardware::netlist::Module;
use efsat_unit::artefact::Scratch;
use efsat_unit::params::options::Choice;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The Verilog of the whole design; also the mark of a folder that is ours to overwrite.
pub const VERILOG: &str = "efsat.v";

/// How to synthesise.
#[derive(Clone, Debug)]
pub struct Options {
    /// Tools and family.
    pub flow: Flow,
    /// Placements to try, each with its own seed from 1 up; 0 stops after Yosys.
    pub seeds: u32,
    /// The time that one placement may take with its routing.
    pub limit: Duration,
    /// The clock that placement and routing are asked for, in MHz; that which the schedule is for if none.
    pub route_for: Option<u32>,
    /// What places the cells.
    pub placer: Placer,
    /// Whether nets of the longest paths are routed again, for a faster clock, where that ends.
    pub reroute: bool,
    /// Where to leave sources, netlists, logs and reports; a temporary folder if none.
    pub keep: Option<PathBuf>,
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Report {
    /// Tools and family.
    pub flow: Flow,
    /// The device that cells are predicted for; the scheduled one if it is of the flow's family.
    pub counted_for: &'static Device,
    /// The tools that ran, with their versions.
    pub tools: Vec<String>,
    /// The design's units with predicted and, if tools ran, actual cells, the top first.
    pub top: Unit,
    /// Clocks between pairs.
    pub interval: usize,
    /// Clocks from the acceptance of a pair to the offer of its verdict.
    pub latency: usize,
    /// Clocks between expansions of an engine.
    pub expansion_clocks: Option<usize>,
    /// Block RAMs of 18 kbit that are expected of an engine; a unit has none.
    pub predicted_block_rams: u64,
    /// Clock that the schedule expects to reach, in MHz, and the signal its longest path ends at.
    pub scheduled: (f64, String),
    /// Static timing of the mapped units, estimated; of a unit alone on Virtex-II.
    pub timing: Option<Timing>,
    /// What placement and routing reached, where the flow has them.
    pub routed: Option<Routed>,
}

impl Report {
    /// The cells of the whole: as mapped if a tool ran, else as predicted.
    pub fn cells(&self) -> Resources {
        self.top.actual.map_or(self.top.predicted, |cells| cells.resources)
    }

    /// What the part has less of than the whole takes: kinds of cells, each with how many are used and there; for
    /// the command line and the studies.
    #[doc(hidden)]
    pub fn shortages(&self) -> Vec<(&'static str, u64, u64)> {
        self.cells().shortages(&self.counted_for.capacity)
    }

    /// Whether the cells are there on the part, which a placer finds out late.
    fn fits(&self) -> Result<(), SynthError> {
        match self.shortages().first() {
            Some(&(kind, used, there)) => Err(SynthError::Part { part: self.counted_for.name, kind, used, there }),
            None => Ok(()),
        }
    }

    /// Slices of a Virtex-II, estimated; none for the other families.
    pub fn slices(&self) -> Option<Slices> {
        let cells = self.cells();
        let estimate = || slices::estimate(cells.luts + cells.memory_luts, cells.flip_flops, None);
        (self.flow.family() == Family::Virtex2).then(estimate)
    }

    /// What the prediction and the tools disagree about beyond what is tolerated, in words: any difference in
    /// multipliers, and a clock that is missed after routing.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = vec![];
        let (predicted, actual) = (self.top.predicted.multipliers, self.cells().multipliers);
        if predicted != actual {
            faults.push(format!("{actual} multipliers instead of {predicted}"));
        }
        if let Some(routed) = &self.routed {
            match routed.median() {
                Some(_) if routed.is_met() => {}
                Some(median) => {
                    faults.push(format!("{median:.1} MHz instead of {} (median of the seeds)", routed.asked))
                }
                None => {
                    let minutes = routed.limit.as_secs() / 60;
                    let other = match routed.reroute {
                        true => "no --reroute".to_owned(),
                        false => format!("--placer {}", routed.placer.other().name()),
                    };
                    let advice = format!("try {other}, more --seeds or more --minutes");
                    faults.push(format!("not routed in {minutes} minutes a seed; {advice}"));
                }
            }
        }
        faults
    }
}

/// Synthesises a unit or an engine. `step` is told what is going on.
///
/// # Errors
/// See [`SynthError`]; counts or a clock that differ from the prediction are no error but part of the report.
pub fn run(
    subject: &Subject,
    command_line: &str,
    options: &Options,
    step: &(dyn Fn(&str) + Sync),
) -> Result<Report, SynthError> {
    let flow = options.flow;
    let yosys = yosys::find()?;
    let nextpnr = if flow.routes() && options.seeds > 0 { Some(route::find()?) } else { None };
    let temporary;
    let dir: &Path = match &options.keep {
        Some(dir) => {
            claim(dir)?;
            dir
        }
        None => {
            temporary = Scratch::new().map_err(ToolError::file(&std::env::temp_dir()))?;
            temporary.path()
        }
    };
    step("GHDL reads the VHDL");
    let text = verilog::from_vhdl(&subject.sources(command_line)?, subject.top(), dir)?;
    let path = dir.join(VERILOG);
    std::fs::write(&path, text).map_err(ToolError::file(&path))?;
    step("Yosys, unit by unit");
    let netlist = units::netlist(&yosys, flow, subject.top(), dir)?;
    let counts = subject.modelled(flow, Some(&netlist));
    let timing = match (subject, flow.family()) {
        (Subject::Unit(_), Family::Virtex2) => Some(units::timing(&netlist, subject.top())?),
        _ => None,
    };
    let mut tools = vec![yosys.version.clone()];
    let routed = match &nextpnr {
        Some(nextpnr) => {
            counts.fits()?;
            tools.push(nextpnr.version.clone());
            step("Yosys, the whole");
            let loads = route::whole(&yosys, &subject.harness(&netlist), dir)?;
            let frequency = subject.unit().params.frequency;
            Some(route::run(nextpnr, &subject.names(&netlist), frequency, loads, options, dir, step)?)
        }
        None => None,
    };
    Ok(Report { tools, timing, routed, ..counts })
}

/// Counts the cells of a hierarchy that is no design of its own, from its VHDL (name and text of each file, in dependency
/// order), beside what is predicted for a device. No placement.
///
/// # Errors
/// See [`SynthError`].
pub fn count(sources: &[(String, String)], top: &Module, device: &'static Device) -> Result<Unit, SynthError> {
    let (flow, yosys) = (Flow::of(device), yosys::find()?);
    let dir = Scratch::new().map_err(ToolError::file(&std::env::temp_dir()))?;
    let text = verilog::from_vhdl(sources, &top.name, dir.path())?;
    let path = dir.path().join(VERILOG);
    std::fs::write(&path, text).map_err(ToolError::file(&path))?;
    let netlist = units::netlist(&yosys, flow, &top.name, dir.path())?;
    Ok(units::tree(top, device, Some((&netlist, flow))))
}

/// Makes a folder ours, unless it holds files of somebody else.
fn claim(dir: &Path) -> Result<(), SynthError> {
    std::fs::create_dir_all(dir).map_err(ToolError::file(dir))?;
    let mut entries = std::fs::read_dir(dir).map_err(ToolError::file(dir))?;
    if entries.next().is_none() || dir.join(VERILOG).is_file() {
        return Ok(());
    }
    Err(SynthError::Keep(dir.display().to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_hardware::device;
    use efsat_unit::design::{Design, Probes};
    use efsat_unit::params::Params;

    fn predicted(params: &Params) -> Report {
        Subject::Unit(&Design::new(params, Probes::None).unwrap())
            .predict(Flow::of(device::find(&params.device).unwrap()))
    }

    #[test]
    fn what_does_not_fit_is_not_placed() {
        let params = Params { device: "lfe5u-85-6".to_owned(), ..Params::default() };
        assert!(predicted(&params).fits().is_ok());
        let wide = predicted(&Params { width: 19, projections: efsat_unit::params::Projections::All, ..params });
        let message = wide.fits().unwrap_err().to_string();
        assert!(message.starts_with("204 multipliers do not fit on lfe5u-85-6, which has 156"), "{message}");
    }

    #[test]
    fn another_placer_is_advised_where_one_does_not_end() {
        let limit = Duration::from_secs(60);
        let advice = |placer, reroute| {
            let routed =
                Some(Routed { asked: 100, seeds: vec![None], limit, placer, reroute, loads: Loads::default() });
            Report { routed, ..predicted(&Params::default()) }.faults().join("; ")
        };
        assert!(advice(Placer::Static, false).contains("not routed in 1 minutes a seed; try --placer heap,"));
        assert!(advice(Placer::Heap, false).contains("try --placer static,"));
        assert!(advice(Placer::Static, true).contains("try no --reroute,"));
    }

    #[test]
    fn the_schedules_clock_includes_set_up() {
        let report = predicted(&Params::default());
        let design = Design::new(&Params::default(), Probes::None).unwrap();
        let ns = 1000.0 / report.scheduled.0;
        assert!((ns - design.schedule.critical.0 - design.device.setup()).abs() < 1e-9 && ns <= 10.0 + 1e-9, "{ns}");
    }
}
