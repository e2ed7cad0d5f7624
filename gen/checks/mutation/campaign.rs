//! Runs mutants of the generated VHDL: few vectors first, more for those that survive.

use super::{Fate, Mutant, vectors, vhdl};
use crate::cosim::{Bench, CosimError, Simulator, Trial};
use efsat_unit::artefact::{self, Prefix, testbench};
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use rayon::prelude::*;
use std::collections::HashMap;

/// Pairs that most mutants do not survive.
const FEW: usize = 16;
/// Pairs whose inner nodes are compared.
const PROBED: usize = 48;

/// How to run.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// What runs the mutants: GHDL or nvc.
    pub simulator: Simulator,
    /// Pairs for the last runs of a mutant that nothing has killed.
    pub vectors: usize,
    /// Names the vectors.
    pub seed: u64,
}

/// All mutants of all files of a design, in the order of files and lines.
///
/// # Errors
/// As [`Bench::new`].
pub fn mutants(params: &Params) -> Result<Vec<Mutant>, CosimError> {
    let files = artefact::vhdl_files(&Design::new(params, Probes::None)?, &Prefix::default(), &params.command_line())?;
    Ok(enumerate(&files, params))
}

fn enumerate(files: &[(String, String)], params: &Params) -> Vec<Mutant> {
    vhdl::mutants(files, 3 * testbench::half_period(params))
}

/// The file of a bench that a mutant changes, name and text.
fn file<'a>(bench: &'a Bench, mutant: &Mutant) -> (&'a str, &'a str) {
    let file = format!("{}.vhd", mutant.unit);
    let (name, text) =
        bench.files().iter().find(|(name, _)| *name == file).expect("mutants are made from the files of the bench");
    (name, text)
}

/// The line that a mutant changes, and what it has there instead.
fn change<'a>(bench: &'a Bench, mutant: &'a Mutant) -> (&'a str, &'a str) {
    let line = file(bench, mutant).1.lines().nth(mutant.line - 1).unwrap_or_default();
    (line.trim(), &mutant.new)
}

/// The unchanged design and the runs that a mutant has to survive.
pub struct Campaign {
    few: Bench,
    /// With probes, whose inner nodes are compared: few pairs, then many.
    probed: Vec<Bench>,
    /// The mutants of the design with probes, by name: of the same change in the same statement, at another place.
    twins: HashMap<String, Mutant>,
    /// The many pairs without probes, for mutants of statements that the design with probes has in another form.
    plain: Vec<Bench>,
}

impl Campaign {
    /// Prints the design, chooses the vectors and runs the unchanged design on each set.
    ///
    /// # Errors
    /// As [`Bench::new`].
    pub fn new(params: &Params, options: &Options) -> Result<Self, CosimError> {
        let bench =
            |count, seed, probed| Bench::new(params, vectors::stimulus(params, count, seed), options.simulator, probed);
        let few = bench(FEW, options.seed, false)?;
        let mut probed = vec![bench(PROBED, options.seed.wrapping_add(1), true)?];
        // A testbench runs no more pairs than these with gaps and back-pressure, and needs them to fill the unit.
        let most = testbench::paced(&Design::new(params, Probes::None)?);
        let runs: Vec<usize> = (0..options.vectors).step_by(most).collect();
        let many = |probed| {
            let run = |from: &usize| {
                let seed = options.seed.wrapping_add(2 + *from as u64);
                bench((options.vectors - from).min(most), seed, probed)
            };
            runs.par_iter().map(run).collect::<Result<Vec<_>, _>>()
        };
        let own = enumerate(few.files(), params);
        let changes: HashMap<String, (&str, &str)> =
            own.iter().map(|mutant| (mutant.name(), change(&few, mutant))).collect();
        let mut twins = HashMap::new();
        for mutant in enumerate(probed[0].files(), params) {
            if changes.get(&mutant.name()) == Some(&change(&probed[0], &mutant)) {
                twins.insert(mutant.name(), mutant);
            }
        }
        let plain = if twins.len() < own.len() { many(false)? } else { vec![] };
        probed.extend(many(true)?);
        Ok(Self { few, probed, twins, plain })
    }

    /// Runs a mutant until something kills it.
    ///
    /// # Errors
    /// As [`Bench::run`].
    pub fn fate(&self, mutant: &Mutant) -> Result<Fate, CosimError> {
        let twin = self.twins.get(&mutant.name()).map(|twin| (&self.probed, twin));
        let (more, twin) = twin.unwrap_or((&self.plain, mutant));
        let more = more.iter().map(|bench| (bench, twin));
        for (bench, mutant) in [(&self.few, mutant)].into_iter().chain(more) {
            let (name, text) = file(bench, mutant);
            match bench.run(name, &mutant.apply(text))? {
                Trial::Agrees => {}
                Trial::Invalid(why) => return Ok(Fate::Invalid(why)),
                Trial::Answer(at) => return Ok(Fate::Killed(format!("answer: {at}"))),
                Trial::Timing(what) => return Ok(Fate::Killed(format!("timing: {what}"))),
                Trial::Node(node) => return Ok(Fate::Killed(format!("node: {node}"))),
                Trial::Silent(what) => return Ok(Fate::Killed(format!("silence: {what}"))),
                Trial::Broken(what) => return Ok(Fate::Killed(format!("simulator: {what}"))),
            }
        }
        Ok(Fate::Survived)
    }
}
