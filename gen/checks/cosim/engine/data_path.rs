//! The two units of an engine in the built-in simulator: whatever queries give them, one behind the other at full speed, against the
//! reference model.

use super::super::Builtin;
use efsat_engine::artefact::EngineDesign;
use efsat_engine::artefact::volume::VolumeStimulus;
use efsat_engine::design::volume_unit::VolumeDesign;
use efsat_engine::host::{Image, memory};
use efsat_engine::model::{Model, Query};
use efsat_hardware::netlist::simulate::Simulation;
use efsat_unit::artefact::Stimulus;
use efsat_unit::artefact::testbench::RESET_CLOCKS;
use serde::Serialize;

/// Clocks simulated at a time.
const BLOCK: usize = 256;

/// What was simulated.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct DataPath {
    /// How many queries there were.
    pub queries: u64,
    /// Pairs of blocks that the volume unit was given.
    pub expansions: u64,
    /// Pairs of triangles that the triangle unit was given.
    pub leaf_pairs: u64,
    /// Answers of both that differ from the reference model's.
    pub mismatches: u64,
    /// The first difference, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_mismatch: Option<String>,
}

/// Runs everything that the reference model gives to the units in some queries. `done` is called after each query.
pub fn run(design: &EngineDesign, images: &[&Image], queries: &[Query], done: impl Fn()) -> DataPath {
    let model = Model::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let (words, _) = memory(images);
    let mut found = DataPath::default();
    let mut volumes = Volumes::new(&design.volume);
    let mut pairs = Stimulus::default();
    for (number, query) in queries.iter().enumerate() {
        let (_, visits) = model.visits(&words, &query.words(model.format()));
        found.queries += 1;
        found.expansions += visits.opened.len() as u64;
        found.leaf_pairs += visits.pairs.len() as u64;
        let stimulus = VolumeStimulus::of(model.format(), query.frame(model.format()), visits.opened);
        for (expansion, answer) in volumes.answers(&stimulus).into_iter().enumerate() {
            let due = stimulus.expansions.get(expansion).map(|expansion| stimulus.answer(expansion));
            if answer != due {
                found.mismatches += 1;
                let show = |answer: Option<u32>| answer.map_or("none".to_owned(), |bits| format!("{bits:04b}"));
                let (answer, due) = (show(answer), show(due));
                found.first_mismatch.get_or_insert_with(|| {
                    format!("query {number}: expansion {expansion}: survivors {answer}; expected {due}")
                });
            }
        }
        if !visits.pairs.is_empty() {
            pairs.segments.push((query.pose, visits.pairs));
        }
        done();
    }
    if found.leaf_pairs > 0 {
        let run = Builtin::new(&design.unit).run(&pairs, false);
        found.mismatches += run.mismatches;
        found.first_mismatch = found.first_mismatch.or(run.first.map(|first| format!("triangle unit: {first}")));
    }
    found
}

/// The volume unit at full speed.
struct Volumes<'a> {
    design: &'a VolumeDesign,
    unit: Simulation,
    names: Vec<String>,
    valid: usize,
    out_valid: usize,
    survive: usize,
}

impl<'a> Volumes<'a> {
    fn new(design: &'a VolumeDesign) -> Self {
        let stage = &design.stage;
        let names: Vec<String> = stage.inputs.iter().map(|id| stage.signal(*id).name()).collect();
        let input = |name: &str| names.iter().position(|n| n == name).expect("a port of the stage");
        let output = |name: &str| {
            stage.outputs.iter().position(|(place, _)| place.to_string() == name).expect("a port of the stage")
        };
        let (valid, reset) = (input("in_valid"), input("reset"));
        let [out_valid, survive] = ["out_valid", "out_survive"].map(output);
        let mut unit = Simulation::new(stage, BLOCK);
        for t in 0..BLOCK {
            unit.set(reset, t, i128::from(t < RESET_CLOCKS));
            unit.set(valid, t, 0);
        }
        unit.run();
        (0..BLOCK).for_each(|t| unit.set(reset, t, 0));
        Self { design, unit, names, valid, out_valid, survive }
    }

    /// The answers to the expansions of one query, and none for each that is missing. An expansion is offered for as many clocks as
    /// the unit takes to be ready once; so each is taken once, wherever in its clocks that is.
    fn answers(&mut self, stimulus: &VolumeStimulus) -> Vec<Option<u32>> {
        let (interval, count) = (self.design.interval, stimulus.expansions.len());
        let clocks = (count * interval + self.design.latency + 1).next_multiple_of(BLOCK);
        let mut answers = vec![];
        let mut offered = None;
        let mut values: Vec<Option<i128>> = vec![];
        for start in (0..clocks).step_by(BLOCK) {
            for t in 0..BLOCK {
                let number = (start + t) / interval;
                self.unit.set(self.valid, t, i128::from(number < count));
                if let Some(expansion) = stimulus.expansions.get(number)
                    && offered.replace(number) != Some(number)
                {
                    let numbers = stimulus.numbers(expansion);
                    values = self.names.iter().map(|name| numbers.get(name).copied()).collect();
                }
                for (port, value) in values.iter().enumerate() {
                    if let Some(value) = value {
                        self.unit.set(port, t, *value);
                    }
                }
            }
            self.unit.run();
            for t in 0..BLOCK {
                if self.unit.output(self.out_valid, t) == 1 {
                    answers.push(Some(self.unit.output(self.survive, t) as u32));
                }
            }
        }
        answers.resize(answers.len().max(count), None);
        answers
    }
}
