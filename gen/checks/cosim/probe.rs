//! Inner nodes: what the simulated design shows on its probe ports against the evaluated graph.

use efsat_hardware::graph::evaluate::Evaluator;
use efsat_hardware::netlist::lower::Probe;
use efsat_unit::artefact::Stimulus;
use efsat_unit::artefact::vectors::{pair_word, pose_word};
use efsat_unit::design::Design;

/// Counts differing values and describes the first difference in data-flow order of the first pair that has one.
pub(super) fn compare(design: &Design, stimulus: &Stimulus, log: &[(bool, Vec<i128>)]) -> (u64, Option<String>) {
    let mut evaluator = Evaluator::new(&design.pipeline);
    let accepted: Vec<usize> = (0..log.len()).filter(|t| log[*t].0).collect();
    let pairs = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
    let (mut count, mut first) = (0, None);
    for (number, ((pose, pair), t)) in pairs.zip(&accepted).enumerate() {
        evaluator.run(&inputs(design, pose, pair));
        for (port, probe) in design.probes.iter().enumerate() {
            let node = evaluator.flat().top_node(&probe.name).expect("probes are nodes of the data path");
            for (phase, clock) in &probe.clocks {
                // Phase 0 of the data path is the clock after acceptance.
                let Some((_, values)) = log.get(t + 1 + *clock as usize) else { continue };
                let (expected, actual) = (evaluator.at(node, *phase), interpret(values[port], probe));
                if expected != actual {
                    count += 1;
                    first.get_or_insert_with(|| {
                        let bits = probe.ty.bits as usize;
                        let mask = (1i128 << bits) - 1;
                        format!(
                            "vector {number}: node {} in phase {phase} is {actual} ({:0bits$b}), expected {expected} ({:0bits$b})",
                            probe.name,
                            actual & mask,
                            expected & mask
                        )
                    });
                }
            }
        }
    }
    if accepted.len() < stimulus.pairs() {
        count += 1;
        first.get_or_insert_with(|| format!("only {} pairs were accepted", accepted.len()));
    }
    (count, first)
}

/// A port's bits as a number of the probe's type.
fn interpret(bits: i128, probe: &Probe) -> i128 {
    let mask = (1i128 << probe.ty.bits) - 1;
    let bits_only = bits & mask;
    if probe.ty.signed && bits_only >> (probe.ty.bits - 1) == 1 { bits_only - (1 << probe.ty.bits) } else { bits_only }
}

/// The inputs of the data path for a pair: the pose as its registers hold it.
pub fn inputs(design: &Design, pose: &efsat_unit::pair::Pose, pair: &efsat_unit::pair::Pair) -> Vec<i128> {
    let p = &design.params;
    // With the bypass the registers hold the exact identity.
    let held = if pose.bypass { efsat_unit::pair::Pose::identity(p) } else { *pose };
    let words = [pair_word(p, pair), pose_word(p, &held)];
    words.iter().flat_map(|w| w.fields.iter().map(|f| f.1)).collect()
}
