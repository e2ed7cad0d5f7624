//! A claim about a unit, as a Verilog module: the unit, free true numbers, what is given and what is shown.

use super::certificate::{Formula, Tools};
use super::tools::{self, Answer};
use super::unit::{AROUND, Mistake, Mutant, Subject, Wire};
use crate::extent::{full, share};
use crate::recorded::Outcome;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What is claimed of a unit.
///
/// Expressions are Verilog over the names of the unit's ports, of `free` numbers and of `seen` and `cut` signals, all of
/// them signed and so wide that no sum of theirs overflows.
pub struct Claim {
    /// The unit.
    pub subject: Subject,
    /// What stands in the table: widths and options.
    pub widths: String,
    /// What stands in the table: the property.
    pub property: &'static str,
    /// Bits that numbers have beyond the widest: room for sums of a few, and for their alignment.
    slack: u32,
    /// Numbers that may have any value: name and bits, sign included.
    free: Vec<(String, u32)>,
    /// Exact products of raw operands: name, operands.
    products: Vec<(String, String, String)>,
    /// Named expressions.
    values: Vec<(String, String)>,
    given: Vec<String>,
    shown: Vec<String>,
    seen: Vec<Wire>,
    cut: Vec<Wire>,
    mutants: Vec<Mutant>,
}

/// A line of the table.
pub struct Row {
    /// Unit, widths and property.
    pub claim: [String; 3],
    /// Seconds of Yosys' processor time for the proof, mutants apart; none if it was proved before.
    pub seconds: Option<f64>,
    /// `proved`, or what went wrong.
    pub verdict: &'static str,
    /// Size and times of the certificate, if one was asked for.
    pub certificate: String,
    /// Mutants refuted and tried.
    pub refuted: [usize; 2],
    /// What must not be: the counterexample, or the mutants that were not refuted.
    pub failures: Vec<String>,
}

impl Claim {
    /// A claim that has only what holds by declaration: inputs within their ranges, and lower bounds not above upper
    /// ones.
    pub fn new(subject: Subject, widths: impl Into<String>, property: &'static str) -> Self {
        let widths = widths.into();
        Self {
            subject,
            widths,
            property,
            slack: 16,
            free: vec![],
            products: vec![],
            values: vec![],
            given: vec![],
            shown: vec![],
            seen: vec![],
            cut: vec![],
            mutants: vec![],
        }
    }

    /// A true number with its name and bits, sign included.
    pub fn free(&mut self, name: &str, bits: u32) -> &mut Self {
        self.free.push((name.to_owned(), bits));
        self
    }

    /// A true number in the interval `of`: `{of}_lo <= name <= {of}_hi`.
    pub fn within(&mut self, name: &str, of: &str) -> &mut Self {
        let lower = format!("{of}_lo");
        let bits = self.bits(&lower);
        self.between(name, &lower, &format!("{of}_hi"), bits)
    }

    /// A true number between two expressions.
    pub fn between(&mut self, name: &str, lo: &str, hi: &str, bits: u32) -> &mut Self {
        self.free(name, bits).given(format!("{lo} <= {name} && {name} <= {hi}"))
    }

    /// The exact product of two ports, free numbers or signals, under a name.
    pub fn product(&mut self, name: &str, x: &str, y: &str) -> &mut Self {
        self.products.push((name.to_owned(), x.to_owned(), y.to_owned()));
        self
    }

    /// A named expression.
    pub fn value(&mut self, name: &str, expression: impl Into<String>) -> &mut Self {
        self.values.push((name.to_owned(), expression.into()));
        self
    }

    /// Assumes.
    pub fn given(&mut self, condition: impl Into<String>) -> &mut Self {
        self.given.push(condition.into());
        self
    }

    /// Claims.
    pub fn shown(&mut self, condition: impl Into<String>) -> &mut Self {
        self.shown.push(condition.into());
        self
    }

    /// Looks at a signal inside the unit, or at a port of an instance, `{instance}_{port}`.
    pub fn seen(&mut self, name: &str) -> &mut Self {
        self.seen.push(self.subject.inner(name).clone());
        self
    }

    /// Looks at several ports of an instance.
    pub fn seen_ports(&mut self, instance: &str, ports: &[&str]) -> &mut Self {
        ports.iter().for_each(|port| _ = self.seen(&format!("{instance}_{port}")));
        self
    }

    /// Replaces a signal inside the unit, or an output of an instance, by any value of its declared range; what drives it
    /// is not looked at.
    pub fn cut(&mut self, name: &str) -> &mut Self {
        self.cut.push(self.subject.inner(name).clone());
        self
    }

    /// A mistake that the claim must refute.
    pub fn mutant(&mut self, mistake: Mistake, signal: impl AsRef<str>) -> &mut Self {
        self.mutants.push(Mutant { mistake, signal: signal.as_ref().to_owned() });
        self
    }

    /// Says that the claim only compares numbers: with the one bit that a difference needs, and no more, the solver sees
    /// that it compares as the unit does.
    pub fn compares_only(&mut self) -> &mut Self {
        self.room_for(1)
    }

    /// Gives numbers so many bits more than the widest has.
    pub fn room_for(&mut self, bits: u32) -> &mut Self {
        self.slack = bits;
        self
    }

    /// Width of all numbers of the claim.
    fn room(&self) -> u32 {
        let wires = self.subject.inputs.iter().chain(&self.subject.outputs).chain(&self.seen).chain(&self.cut);
        let widest = wires.map(|w| w.bits).chain(self.free.iter().map(|f| f.1)).max().unwrap_or(1);
        let products = self.products.iter().map(|(_, x, y)| self.bits(x) + self.bits(y)).max().unwrap_or(0);
        widest.max(products) + self.slack
    }

    fn bits(&self, name: &str) -> u32 {
        let all = self.subject.inputs.iter().chain(&self.seen).chain(&self.cut);
        let of_wire = all.filter(|w| w.name == name).map(|w| w.bits).next();
        let of_free = self.free.iter().find(|f| f.0 == name).map(|f| f.1);
        of_wire.or(of_free).unwrap_or_else(|| panic!("{}: nothing of the name {name}", self.subject.name))
    }

    /// The Verilog module `claim`. Names with `raw_` in front have their own width, the others have room.
    fn verilog(&self) -> String {
        let unit = &self.subject;
        let room = self.room();
        let (mut ports, mut connections, mut body) = (vec![], vec![], String::new());
        let mut signal = |raw: &str, name: &str, bits: u32, signed: bool| {
            let value = if signed { format!("$signed({raw})") } else { format!("$signed({{1'b0, {raw}}})") };
            let _ = writeln!(body, "  wire signed [{}:0] {name} = {value};", room - 1);
            format!("[{}:0] {raw}", bits - 1)
        };
        for wire in unit.inputs.iter().chain(&self.cut) {
            let raw = format!("raw_{}", wire.name);
            ports.push(format!("input {}", signal(&raw, &wire.name, wire.bits, wire.signed)));
        }
        for (name, bits) in &self.free {
            ports.push(format!("input {}", signal(&format!("raw_{name}"), name, *bits, true)));
        }
        let mut outputs = vec![];
        for wire in unit.outputs.iter().chain(&self.seen) {
            let raw = format!("raw_{}", wire.name);
            let value =
                wire.element.map_or(String::new(), |(_, below)| format!(" = {}[{below} +: {}]", word(wire), wire.bits));
            outputs.push(format!("  wire {}{value};\n", signal(&raw, &wire.name, wire.bits, wire.signed)));
        }
        let words: BTreeMap<String, &Wire> =
            self.seen.iter().filter(|wire| wire.element.is_some()).map(|wire| (word(wire), wire)).collect();
        for (name, wire) in &words {
            outputs.insert(0, format!("  wire [{}:0] {name};\n", wire.element.expect("a word's element").0 - 1));
            connections.push(format!(".\\{} ({name})", wire.path));
        }
        if unit.clocked {
            connections.push(".clk(1'b0)".to_owned());
        }
        let all = unit.inputs.iter().chain(&unit.outputs).chain(&self.seen);
        connections.extend(all.filter(|w| w.element.is_none()).map(|w| format!(".\\{} (raw_{})", w.path, w.name)));
        connections.extend(self.cut.iter().map(|w| format!(".\\{}__i (raw_{})", w.path, w.name)));
        for (name, x, y) in &self.products {
            let bits = self.bits(x) + self.bits(y);
            let _ = writeln!(body, "  wire signed [{}:0] raw_{name} = $signed(raw_{x}) * $signed(raw_{y});", bits - 1);
            let _ = writeln!(body, "  wire signed [{}:0] {name} = raw_{name};", room - 1);
        }
        for (name, expression) in &self.values {
            let _ = writeln!(body, "  wire signed [{}:0] {name} = {expression};", room - 1);
        }
        let given = [declared(&unit.inputs), declared(&self.cut), self.given.clone()].concat();
        let lines = |word: &str, all: &[String]| all.iter().map(|c| format!("    {word}({c});\n")).collect::<String>();
        format!(
            // A name that nothing has must not become a wire of any value.
            "`default_nettype none\nmodule claim({});\n{}  {AROUND} unit({});\n{body}  always @* begin\n{}{}  end\nendmodule\n",
            ports.join(", "),
            outputs.concat(),
            connections.join(", "),
            lines("assume", &given),
            lines("assert", &self.shown),
        )
    }

    fn solved(&self, files: &[(String, String)]) -> Answer {
        let paths = |wires: &[Wire]| wires.iter().map(|w| w.path.clone()).collect::<Vec<_>>();
        tools::solve(&tools::verilog(files, AROUND), AROUND, &self.verilog(), &paths(&self.seen), &paths(&self.cut))
    }

    fn ask(&self, files: &[(String, String)]) -> Answer {
        let looked_at: Vec<&str> = self.seen.iter().chain(&self.cut).map(|wire| wire.path.as_str()).collect();
        tools::answer(files, &[&self.verilog(), &looked_at.join(" ")], || self.solved(files))
    }

    /// Asks whether the claim holds of the unit, and whether it does of the first of its mutants.
    pub fn answers(&self) -> [Answer; 2] {
        let wrong = self.subject.mutated(&self.mutants[0]).expect("something to mutate");
        [self.solved(&self.subject.files), self.solved(&wrong)]
    }

    /// Proves the claim of the unit and refutes it of every mutant.
    pub fn run(&self) -> Row {
        let claim = [self.subject.name.clone(), self.widths.clone(), self.property.to_owned()];
        let mutated = |mutant: &Mutant| self.subject.mutated(mutant).map(|files| self.ask(&files).outcome);
        Row::new(claim, self.ask(&self.subject.files), &share(12, &self.mutants), mutated)
    }
}

impl Row {
    /// Of the answer to a claim, and to the same of its mutants; none where there is nothing to mutate.
    pub fn new(
        claim: [String; 3],
        answer: Answer,
        mutants: &[&Mutant],
        mutated: impl Fn(&Mutant) -> Option<Outcome>,
    ) -> Self {
        let (verdict, failure) = match answer.outcome {
            Outcome::Proved => ("proved", None),
            Outcome::Refuted(found) => ("REFUTED", Some(format!("counterexample:\n{found}"))),
            Outcome::Undecided => ("UNDECIDED", Some("no answer in the time allowed".to_owned())),
        };
        let alive = |mutant: &&Mutant| match mutated(mutant) {
            Some(Outcome::Refuted(_)) => None,
            Some(outcome) => Some(format!("not refuted: {mutant:?}: {outcome:?}")),
            None => Some(format!("nothing to mutate: {mutant:?}")),
        };
        let alive: Vec<String> = mutants.iter().filter_map(alive).collect();
        let refuted = [mutants.len() - alive.len(), mutants.len()];
        let certificate = if failure.is_none() { certified(answer.formula.as_ref()) } else { Ok(String::new()) };
        let refused = certificate.as_ref().err().map(|reason| format!("certificate: {reason}"));
        let failures = failure.into_iter().chain(refused).chain(alive).collect();
        let certificate = certificate.unwrap_or_default();
        Self { claim, seconds: answer.seconds, verdict, certificate, refuted, failures }
    }
}

/// The certificate of a claim, if everything is asked for. That a solver or a checker says something else is a failure.
fn certified(formula: Option<&Formula>) -> Result<String, String> {
    let Some(tools) = full().then(Tools::new).flatten() else { return Ok(String::new()) };
    let Some(formula) = formula else { return Ok("no certificate: there is no formula".to_owned()) };
    Ok(tools.certify(formula)?.map_or("no certificate in time".to_owned(), |found| found.to_string()))
}

/// The name of the word of which a wire is an element.
fn word(wire: &Wire) -> String {
    format!("word_{}", wire.path.replace(|c: char| !c.is_ascii_alphanumeric(), "_"))
}

/// That wires are in their declared ranges, and lower bounds not above upper ones.
fn declared(wires: &[Wire]) -> Vec<String> {
    let mut given = vec![];
    for wire in wires {
        let name = &wire.name;
        if let Some((min, max)) = wire.range {
            given.push(format!("{} <= {name} && {name} <= {}", number(min), number(max)));
        }
        let upper = name.strip_suffix("lo").map(|stem| format!("{stem}hi"));
        if let Some(upper) = upper.filter(|upper| wires.iter().any(|w| w.name == *upper)) {
            given.push(format!("{name} <= {upper}"));
        }
    }
    given
}

/// A signed literal of any size.
pub fn number(x: i128) -> String {
    let sign = if x < 0 { "-" } else { "" };
    let bits = 130 - x.unsigned_abs().leading_zeros();
    format!("({sign}{bits}'sd{})", x.unsigned_abs())
}
