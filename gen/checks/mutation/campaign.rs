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

/// The unchanged design and the runs that a mutant has to survive.
pub struct Campaign {
    few: Bench,
    probed: Bench,
    many: Vec<Bench>,
    /// The mutants of the design with probes, by name: their lines are at other places.
    twins: HashMap<String, Mutant>,
    /// As many pairs without probes, for mutants of statements that the design with probes has in another form.
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
        let probed = bench(PROBED, options.seed.wrapping_add(1), true)?;
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
        let twins: HashMap<String, Mutant> =
            enumerate(probed.files(), params).into_iter().map(|mutant| (mutant.name(), mutant)).collect();
        let alone = enumerate(few.files(), params).iter().any(|mutant| !twins.contains_key(&mutant.name()));
        let plain = if alone { many(false)? } else { vec![] };
        Ok(Self { many: many(true)?, few, probed, twins, plain })
    }

    /// Runs a mutant until something kills it.
    ///
    /// # Errors
    /// As [`Bench::run`].
    pub fn fate(&self, mutant: &Mutant) -> Result<Fate, CosimError> {
        let (more, twin): (Vec<&Bench>, &Mutant) = match self.twins.get(&mutant.name()) {
            Some(twin) => ([&self.probed].into_iter().chain(&self.many).collect(), twin),
            None => (self.plain.iter().collect(), mutant),
        };
        let more = more.into_iter().map(|bench| (bench, twin));
        for (bench, mutant) in [(&self.few, mutant)].into_iter().chain(more) {
            let file = format!("{}.vhd", mutant.unit);
            let original = bench.files().iter().find(|(name, _)| *name == file);
            let (name, text) = original.expect("mutants are made from the files of the bench");
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
