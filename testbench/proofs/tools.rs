//! The tools of a machine proof: GHDL turns the generated VHDL into Verilog, Yosys joins it with a claim and asks its
//! SAT solver.

use super::certificate::Formula;
use crate::recorded::{Outcome, Question};
use crate::tools::{has, made, run};
use efsat::evidence::synth::verilog;
use std::fs;
use tempfile::TempDir;

/// Most seconds for one question to the solver.
const PATIENCE: u32 = 3600;

/// A pipeline without feedback, seen after its latency: every register hands on what it reads.
const WIRES: &str = "module \\$dff (CLK, D, Q);
  parameter WIDTH = 1; parameter CLK_POLARITY = 1;
  input CLK; input [WIDTH-1:0] D; output [WIDTH-1:0] Q;
  assign Q = D;
endmodule
";

/// The answer to a claim.
pub struct Answer {
    pub outcome: Outcome,
    /// Seconds of Yosys' processor time, which other load does not change much; none if it was proved before.
    pub seconds: Option<f64>,
    /// What was asked; none of an induction, for which Yosys writes another formula than it solves, and of what was proved before.
    pub formula: Option<Formula>,
}

/// Whether both tools are installed.
pub fn there() -> bool {
    has("Yosys", "yosys", "-V") && made(verilog::ghdl()).is_some()
}

/// VHDL files (name and text, in dependency order) as Verilog.
pub fn verilog(files: &[(String, String)], top: &str) -> String {
    let dir = TempDir::new().expect("a folder for GHDL");
    verilog::from_vhdl(files, top, dir.path()).unwrap_or_else(|e| panic!("{top}: {e}"))
}

/// The answer to a claim about VHDL, as it was before or as it is given now.
pub fn answer(files: &[(String, String)], claim: &[&str], ask: impl FnOnce() -> Answer) -> Answer {
    let (mut seconds, mut formula) = (None, None);
    let outcome = Question::of(files, claim).answer(|| {
        let answer = ask();
        (seconds, formula) = (answer.seconds, answer.formula);
        answer.outcome
    });
    Answer { outcome, seconds, formula }
}

/// Runs Yosys on sources and a script, which may write a formula.
fn yosys(sources: &[(&str, &str)], script: &str, outcome: impl Fn(&str) -> Outcome) -> Answer {
    let dir = TempDir::new().expect("a folder for Yosys");
    for (name, text) in sources.iter().chain(&[("script.ys", script)]) {
        fs::write(dir.path().join(name), text).expect("a source for Yosys");
    }
    let text = run(dir.path(), "yosys", &["-s", "script.ys"]);
    let seconds = text.rsplit_once("CPU: user ").and_then(|(_, rest)| rest.split_once('s')?.0.parse().ok());
    Answer { outcome: outcome(&text), seconds: Some(seconds.unwrap_or(f64::NAN)), formula: Formula::found(dir) }
}

/// Asks whether the module `claim`, a claim about the clocked entity `top`, holds at the start, and after a clock if it held
/// before it. `seen` are signals that the claim looks at, `words` those of memories.
///
/// Refuted is a claim of which either is not so: a step may begin where the unit never is.
pub fn induce(unit: &str, top: &str, claim: &str, seen: &[String], words: &[String]) -> Answer {
    let wires = |names: &[String]| names.iter().map(|name| format!(" {top}/w:{name}")).collect::<String>();
    let script = format!(
        "read_verilog unit.v
hierarchy -top {top}
proc
flatten
expose{}
memory -nomap
opt_clean -purge
memory_map
expose{}
opt_clean -purge
read_verilog -sv -formal claim.v
hierarchy -top claim
proc
flatten
opt_expr
opt_clean
select -assert-none t:$mem*
select -assert-min 1 t:$assert
sat -tempinduct -prove-asserts -set-assumes -show-inputs -maxsteps 1 -timeout {PATIENCE}
",
        wires(seen),
        wires(words),
    );
    yosys(&[("unit.v", unit), ("claim.v", claim)], &script, |text| {
        if text.contains("Induction step proven: SUCCESS!") {
            Outcome::Proved
        } else if text.contains("proof failed.") || text.contains("FAIL!") {
            Outcome::Refuted("no induction".to_owned())
        } else {
            assert!(text.contains("TIMEOUT"), "yosys: {text}");
            Outcome::Undecided
        }
    })
}

/// Asks whether the module `claim` holds of the unit `top`; `seen` are wires of the unit that the claim looks at, `cut`
/// wires whose value it sets.
pub fn solve(unit: &str, top: &str, claim: &str, seen: &[String], cut: &[String]) -> Answer {
    let wires = |names: &[String]| names.iter().map(|name| format!(" {top}/w:{name}")).collect::<String>();
    let expose = |option: &str, names: &[String]| {
        if names.is_empty() { String::new() } else { format!("expose {option}{}\n", wires(names)) }
    };
    let script = format!(
        "read_verilog unit.v
hierarchy -top {top}
proc
flatten
techmap -map wires.v
setattr -unset init w:*
memory -nomap
memory_map -rom-only
select -assert-none t:$*dff* t:$*latch* t:$mem*
{}{}read_verilog -sv -formal claim.v
prep -flatten -top claim
opt -full
opt_merge
alumacc t:$mul
maccmap
opt -full
select -assert-min 1 t:$assert
sat -prove-asserts -set-assumes -show-inputs -timeout {PATIENCE} -dump_cnf {}
",
        expose("", seen),
        expose("-cut -sep __", cut),
        Formula::NAME,
    );
    yosys(&[("unit.v", unit), ("claim.v", claim), ("wires.v", WIRES)], &script, |text| {
        if text.contains("no model found: SUCCESS!") {
            Outcome::Proved
        } else if let Some((_, found)) = text.split_once("model found: FAIL!") {
            Outcome::Refuted(found.lines().filter(|l| l.starts_with("  \\")).collect::<Vec<_>>().join("\n"))
        } else {
            assert!(text.contains("TIMEOUT"), "yosys: {text}");
            Outcome::Undecided
        }
    })
}
