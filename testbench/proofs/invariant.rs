//! A claim about a clocked entity that is proved by induction with one step: it holds at the start and after a clock if it held before
//! it, so it holds for all time, whatever comes in.

use super::claim::Row;
use super::tools::{self, Answer};
use super::unit::{Mistake, Mutant};
use crate::extent::share;
use std::fmt::Write;

/// A claim about a clocked entity that is proved by induction, as a Verilog module.
pub struct Invariant {
    entity: &'static str,
    property: &'static str,
    sizes: String,
    /// VHDL, in dependency order.
    files: Vec<(String, String)>,
    /// How clock and reset are connected.
    pub clocking: &'static str,
    /// Inputs of the claim, which are free, each with its range.
    pub inputs: Vec<&'static str>,
    /// Signals of the entity, with their bits, and memories with theirs, that the claim looks at.
    seen: Vec<(String, u32)>,
    pub words: Vec<(&'static str, usize, u32)>,
    pub ports: Vec<String>,
    pub body: String,
    pub given: Vec<String>,
    shown: Vec<String>,
    mutants: Vec<Mutant>,
}

impl Invariant {
    pub fn new(entity: &'static str, property: &'static str, sizes: String, files: Vec<(String, String)>) -> Self {
        Self {
            entity,
            property,
            sizes,
            files,
            clocking: ".clk(clk), .reset(reset)",
            inputs: vec![],
            seen: vec![],
            words: vec![],
            ports: vec![],
            body: String::new(),
            given: vec![],
            shown: vec![],
            mutants: vec![],
        }
    }

    /// Signals of the entity that the claim looks at, with their bits.
    pub fn see(&mut self, signals: &[(&str, u32)]) {
        self.seen.extend(signals.iter().map(|(name, bits)| ((*name).to_owned(), *bits)));
    }

    pub fn shown<S: Into<String>>(&mut self, conditions: impl IntoIterator<Item = S>) {
        self.shown.extend(conditions.into_iter().map(Into::into));
    }

    pub fn mutants(&mut self, mutants: &[(Mistake, &str)]) {
        let mutant = |(mistake, signal): &(Mistake, &str)| Mutant { mistake: *mistake, signal: (*signal).to_owned() };
        self.mutants.extend(mutants.iter().map(mutant));
    }

    fn verilog(&self) -> String {
        let plain = |name: &str| name.replace('.', "_");
        let mut wires = String::new();
        let mut ports = self.ports.clone();
        for (name, bits) in &self.seen {
            let _ = writeln!(wires, "  wire [{}:0] {};", bits - 1, plain(name));
            ports.push(format!(".\\{name} ({})", plain(name)));
        }
        for (name, count, bits) in &self.words {
            for i in 0..*count {
                let _ = writeln!(wires, "  wire [{}:0] {name}{i};", bits - 1);
                ports.push(format!(".\\{name}[{i}] ({name}{i})"));
            }
        }
        let inputs: String = self.inputs.iter().map(|name| format!(", input {name}")).collect();
        let lines = |word: &str, all: &[String]| all.iter().map(|c| format!("    {word}({c});\n")).collect::<String>();
        format!(
            "`default_nettype none\nmodule claim(input clk, input reset{inputs});\n{wires}{}  {} unit({}, {});\n  always @* begin\n{}{}  end\nendmodule\n",
            self.body,
            self.entity,
            self.clocking,
            ports.join(", "),
            lines("assume", &self.given),
            lines("assert", &self.shown),
        )
    }

    fn ask(&self, files: &[(String, String)]) -> Answer {
        let seen: Vec<String> = self.seen.iter().map(|(name, _)| name.clone()).collect();
        let words: Vec<String> = self.words.iter().map(|(name, ..)| format!("{name}*")).collect();
        let claim = self.verilog();
        tools::answer(files, &[&claim, &seen.join(" "), &words.join(" ")], || {
            tools::induce(&tools::verilog(files, self.entity), self.entity, &claim, &seen, &words)
        })
    }

    /// Proves the claim, and sees that the proof of no wrong text goes through.
    pub fn run(&self) -> Row {
        let claim = [self.entity.to_owned(), self.sizes.clone(), self.property.to_owned()];
        let mutated = |mutant: &Mutant| mutant.applied(&self.files).map(|files| self.ask(&files).outcome);
        Row::new(claim, self.ask(&self.files), &share(14, &self.mutants), mutated)
    }
}
