//! Certificates: CaDiCaL decides the formula that Yosys asked its own solver, and writes down why it has no solution; `rate`
//! checks every step of that. Of small formulas Coq's kernel does, by `certified` of `proofs/Certificate.v`.

use crate::tools::{program, skip};
use efsat_hardware::tools::{Tool, find};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use tempfile::TempDir;

/// Most seconds for one certificate.
const PATIENCE: &str = "600";

/// The folder of a formula that has no solution if a claim holds, in the format DIMACS, and of what is made of it.
#[derive(Debug)]
pub struct Formula(TempDir);

impl Formula {
    pub const NAME: &str = "claim.cnf";

    /// That in a folder, if there is one.
    pub fn found(dir: TempDir) -> Option<Self> {
        dir.path().join(Self::NAME).exists().then_some(Self(dir))
    }

    pub fn path(&self) -> PathBuf {
        self.0.path().join(Self::NAME)
    }

    /// Where its certificate is, and the same with hints.
    pub fn certificates(&self) -> [PathBuf; 2] {
        ["drat", "lrat"].map(|extension| self.path().with_extension(extension))
    }
}

/// What was checked: clauses of the formula, bytes of the certificate, seconds of CaDiCaL and of the checker.
pub struct Certificate {
    clauses: u64,
    bytes: u64,
    seconds: [f64; 2],
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [solver, checker] = self.seconds;
        let kilobytes = self.bytes.div_ceil(1000);
        write!(f, "{} clauses, {kilobytes} kB, {solver:.1} s, checked in {checker:.1} s", self.clauses)
    }
}

/// The solver and the checker.
pub struct Tools {
    solver: Tool,
    checker: Tool,
}

impl Tools {
    /// None where one is not installed, which is said.
    pub fn new() -> Option<Self> {
        let tool = |name: &str, command: &str| {
            let tool = find(&[command], "--version");
            if tool.is_none() {
                skip(format!("{name} is not installed"));
            }
            tool
        };
        Some(Self { solver: tool("CaDiCaL", "cadical")?, checker: tool("rate", "rate")? })
    }

    /// Writes and checks the certificate of a formula; none if the solver does not end in time.
    pub fn certify(&self, formula: &Formula) -> Result<Option<Certificate>, String> {
        let (path, [proof, hints]) = (formula.path(), formula.certificates());
        let start = Instant::now();
        if !self.decide(&path, &proof)? {
            return Ok(None);
        }
        let decided = start.elapsed();
        self.check(&path, &proof, &hints)?;
        let seconds = [decided, start.elapsed() - decided].map(|time| time.as_secs_f64());
        let bytes = fs::metadata(&proof).expect("a certificate").len();
        Ok(Some(Certificate { clauses: clauses(&path), bytes, seconds }))
    }

    /// Writes why a formula has no solution; whether that ends in time.
    pub fn decide(&self, formula: &Path, proof: &Path) -> Result<bool, String> {
        match program::ran(Command::new(&self.solver.path).args(["-q", "-t", PATIENCE]).args([formula, proof])) {
            (Some(20), ..) => Ok(true),
            (Some(10), ..) => Err("there is a solution".to_owned()),
            (Some(0), ..) => Ok(false),
            (_, output, errors) => Err(output + &errors),
        }
    }

    /// Checks it, and adds to each step the clauses from which it follows.
    pub fn check(&self, formula: &Path, proof: &Path, hints: &Path) -> Result<(), String> {
        let mut command = Command::new(&self.checker.path);
        command.arg("--skip-unit-deletions").args([formula, proof]).arg("--lrat").arg(hints);
        match program::ran(&mut command) {
            (Some(0), output, _) if output.contains("s VERIFIED") => Ok(()),
            (_, output, errors) => Err(format!("not verified: {output}{errors}")),
        }
    }
}

/// The number of clauses in the head of a formula.
fn clauses(formula: &Path) -> u64 {
    let text = fs::read_to_string(formula).expect("a formula");
    let head = text.lines().find(|line| line.starts_with("p cnf")).expect("the head of a formula");
    head.split_whitespace().last().and_then(|number| number.parse().ok()).expect("the number of clauses")
}

/// The numbers of a text up to each 0.
fn groups<'a>(words: impl Iterator<Item = &'a str>) -> Vec<Vec<&'a str>> {
    let words: Vec<&str> = words.collect();
    words.split(|word| *word == "0").filter(|group| !group.is_empty()).map(<[_]>::to_vec).collect()
}

/// A theorem for Coq's kernel: a formula has no solution, by a certificate with hints.
pub fn theorem(formula: &str, hints: &str) -> String {
    let list = |scope: &str, numbers: &[&str]| format!("[{}]%{scope}", numbers.join(";"));
    let lines = formula.lines().filter(|line| !line.starts_with(['c', 'p']));
    let clauses = groups(lines.flat_map(str::split_whitespace)).iter().map(|clause| list("Z", clause)).collect();
    let steps = hints.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let parts: Vec<&[&str]> = words[1..].split(|word| *word == "0").collect();
        match parts[0].split_first() {
            Some((&"d", numbers)) => format!("Forget {}", list("positive", numbers)),
            _ => format!("Learn {} {} {}", words[0], list("Z", parts[0]), list("positive", parts[1])),
        }
    });
    format!(
        "From Coq Require Import ZArith List.\nRequire Import Efsat.Certificate.\nImport ListNotations.\n{}{}\
         Theorem proved : unsatisfiable formula.\nProof. apply (certified _ steps). vm_compute. reflexivity. Qed.\n",
        definition("formula", "clause", clauses),
        definition("steps", "step", steps.collect()),
    )
}

/// A long list, in parts that a parser can take.
fn definition(name: &str, of: &str, items: Vec<String>) -> String {
    let parts: Vec<String> = items.chunks(500).map(|part| part.join(";\n")).collect();
    let each = parts.iter().enumerate().map(|(i, part)| format!("Definition {name}{i} : list {of} := [{part}].\n"));
    let names: Vec<String> = (0..parts.len()).map(|i| format!("{name}{i}")).collect();
    format!("{}Definition {name} := ({})%list.\n", each.collect::<String>(), names.join(" ++ "))
}
