//! Legal names: the rules of VHDL-93 and the keywords of every language a design may meet.

use crate::graph::netlist::{DelayLine, Module};
use std::collections::HashSet;

/// Keywords of VHDL-87 to VHDL-2019 and PSL.
const VHDL: &str = "abs access after alias all and architecture array assert assume assume_guarantee attribute begin \
    block body buffer bus case component configuration constant context cover default disconnect downto else elsif end \
    entity exit fairness file for force function generate generic group guarded if impure in inertial inout is label \
    library linkage literal loop map mod nand new next nor not null of on open or others out package parameter port \
    postponed private procedure process property protected pure range record register reject release rem report \
    restrict restrict_guarantee return rol ror select sequence severity shared signal sla sll sra srl strong subtype \
    then to transport type unaffected units until use variable view vmode vpkg vprop vunit wait when while with xnor xor";

/// Keywords of Verilog-2005 that are none of VHDL.
const VERILOG: &str = "always assign automatic buf bufif0 bufif1 casex casez cell cmos config deassign defparam design \
    disable edge endcase endconfig endfunction endgenerate endmodule endprimitive endspecify endtable endtask event \
    forever fork genvar highz0 highz1 ifnone incdir include initial input instance integer join large liblist \
    localparam macromodule medium module negedge nmos noshowcancelled notif0 notif1 output pmos posedge primitive pull0 \
    pull1 pulldown pullup pulsestyle_ondetect pulsestyle_onevent rcmos real realtime reg repeat rnmos rpmos rtran \
    rtranif0 rtranif1 scalared showcancelled signed small specify specparam strong0 strong1 supply0 supply1 table task \
    time tran tranif0 tranif1 tri tri0 tri1 triand trior trireg unsigned uwire vectored wand weak0 weak1 wire wor";

/// Names of the packages in use that a signal must not hide.
const PACKAGES: &str = "ieee std work std_logic std_logic_vector std_logic_1164 numeric_std resize shift_left \
    shift_right to_integer to_signed to_unsigned rising_edge falling_edge boolean bit natural positive string character";

/// A name that some tool would refuse.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{module}: {name}: {why}")]
pub struct Clash {
    /// Module.
    pub module: String,
    /// Name.
    pub name: String,
    /// What is wrong with it.
    pub why: &'static str,
}

/// What is wrong with a name, if anything.
fn fault(name: &str) -> Option<&'static str> {
    let first_is_letter = name.chars().next().is_some_and(|c| c.is_ascii_lowercase());
    if !first_is_letter {
        return Some("does not begin with a lower-case letter");
    }
    if !name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_') {
        return Some("has a character that is no lower-case letter, digit or underscore");
    }
    if name.ends_with('_') || name.contains("__") {
        return Some("has a trailing or double underscore");
    }
    let reserved = [VHDL, VERILOG, PACKAGES].into_iter().flat_map(str::split_ascii_whitespace);
    reserved.into_iter().any(|k| k == name).then_some("is a keyword or a library name")
}

/// Names of the signal and of the type of a delay line, after its last register.
pub fn delay_line(module: &Module, line: &DelayLine) -> [String; 2] {
    let last = line.registers.last().map_or("", |id| &module.signal(*id).name);
    [format!("{last}_line"), format!("{last}_words")]
}

/// Checks every name of a module: legal, no keyword, unique (all names are lower case).
///
/// # Errors
/// The first name that is not.
pub fn check(module: &Module) -> Result<(), Clash> {
    let clash = |name: &str, why| Clash { module: module.name.clone(), name: name.to_owned(), why };
    let signals = module.signals.iter().map(|s| s.name.as_str());
    let outputs = module.outputs.iter().map(|o| o.0.as_str());
    let labels = module.instances.iter().map(|i| i.label.as_str());
    let entities = module.instances.iter().map(|i| i.module.name.as_str()).collect::<HashSet<_>>();
    let mut seen = HashSet::from(["clk", "rtl", module.name.as_str()]);
    if let Some(why) = fault(&module.name) {
        return Err(clash(&module.name, why));
    }
    let lines: Vec<[String; 2]> = module.delay_lines().iter().map(|line| delay_line(module, line)).collect();
    for name in signals.chain(outputs).chain(labels).chain(lines.iter().flatten().map(String::as_str)) {
        if let Some(why) = fault(name) {
            return Err(clash(name, why));
        }
        if !seen.insert(name) || entities.contains(name) {
            return Err(clash(name, "is used twice"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn illegal_names_are_refused() {
        for name in ["", "_a", "a_", "a__b", "1a", "A", "a-b", "open", "sequence", "signed", "wire", "resize", "view"] {
            assert!(fault(name).is_some(), "{name}");
        }
        assert_eq!(fault("axis_0_p1_x_lo"), None);
    }
}
