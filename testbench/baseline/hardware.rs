//! What a design shows in the built-in simulator, clock by clock: answers at the ports of the unit, inner signals at its
//! probes. Nothing else of the baseline knows how a design is made; ports and probes are found by their names.

use super::vectors::Segment;
use super::{Seen, Signals};
use crate::tools::clocked::Clocked;
use efsat::artefact::vectors::{Word, pair_word, pose_word};
use efsat::design::{Design, Probes};
use efsat::golden::Golden;
use efsat::params::{Params, Projections, Transform};

/// What is answered.
const ANSWER: [&str; 4] = ["out_verdict", "out_separated", "out_overlapping", "out_outside"];

/// Clocks without an answer after which there will be none.
const PATIENCE: usize = 10_000;

/// What there is to be taken by the unit.
struct Offer {
    valid: &'static str,
    ready: &'static str,
    word: Word,
}

fn offers(p: &Params, segments: &[Segment]) -> Vec<Offer> {
    let mut offers = vec![];
    for (pose, pairs) in segments {
        if p.transform != Transform::Off {
            offers.push(Offer { valid: "pose_valid", ready: "pose_ready", word: pose_word(p, pose) });
        }
        let pair = |pair| Offer { valid: "in_valid", ready: "in_ready", word: pair_word(p, pair) };
        offers.extend(pairs.iter().map(pair));
    }
    offers
}

/// Runs all vectors at full speed through a design with probes.
pub fn seen(p: &Params, segments: &[Segment]) -> Vec<Seen> {
    let design = Design::new(p, Probes::All).unwrap_or_else(|e| panic!("{e}"));
    let probes: Vec<String> = design.probes.iter().map(|probe| format!("probe_{}", probe.name)).collect();
    let mut ports = Clocked::new(&design.top);
    ports.set("out_ready", 1);
    let offers = offers(p, segments);
    let pairs = segments.iter().map(|segment| segment.1.len()).sum();
    let (mut next, mut accepted, mut answers, mut log, mut silent) = (0, vec![], vec![], vec![], 0);
    while answers.len() < pairs {
        let offer = offers.get(next);
        // Not every unit has every port.
        for valid in ["in_valid", "pose_valid"] {
            if ports.has(valid) {
                ports.set(valid, i128::from(offer.is_some_and(|offer| offer.valid == valid)));
            }
        }
        for (name, value, _) in offer.iter().flat_map(|offer| &offer.word.fields) {
            ports.set(name, *value);
        }
        ports.clock();
        if let Some(offer) = offer.filter(|offer| ports.get(offer.ready) == 1) {
            if offer.valid == "in_valid" {
                accepted.push(log.len());
            }
            next += 1;
        }
        silent += 1;
        if ports.get("out_valid") == 1 {
            answers.push(ANSWER.map(|name| if ports.has(name) { ports.get(name) } else { 0 }));
            silent = 0;
        }
        assert!(silent < PATIENCE, "{} of {pairs} pairs are answered", answers.len());
        log.push(probes.iter().map(|name| ports.get(name)).collect::<Vec<i128>>());
    }
    let names = Names::new(p, segments);
    let signals = accepted.iter().map(|clock| {
        let mut signals = Signals::new();
        for (i, probe) in design.probes.iter().enumerate() {
            for (phase, later) in &probe.clocks {
                let Some((signal, part)) = names.signal(&probe.name, *phase) else { continue };
                // Phase 0 of the data path is the clock after acceptance.
                signals.entry(signal).or_default()[part] = log[clock + 1 + *later as usize][i];
            }
        }
        signals
    });
    answers.into_iter().zip(signals).map(|(answer, signals)| Seen { answer, signals }).collect()
}

/// An axis: its name, and the points of A and of B that are projected on it.
#[derive(Default)]
struct Axis {
    name: String,
    points: [Vec<String>; 2],
}

/// What the reference model calls the nodes of a design.
pub struct Names {
    axes: Vec<Axis>,
    per_clock: usize,
    skip: bool,
}

impl Names {
    /// Axes, in the order in which they are tested, and their points in the order of the reference model's trace, of whatever
    /// pair.
    pub fn new(p: &Params, segments: &[Segment]) -> Self {
        let (pose, pairs) = &segments[0];
        let mut axes: Vec<Axis> = vec![];
        for (signal, _) in Golden::new(p).trace(pose, &pairs[0]) {
            let Some((name, point)) = signal.strip_prefix("projection.").and_then(|rest| rest.split_once('.')) else {
                continue;
            };
            if axes.last().is_none_or(|axis| axis.name != name) {
                axes.push(Axis { name: name.to_owned(), ..Axis::default() });
            }
            let axis = axes.last_mut().expect("an axis");
            axis.points[usize::from(point.starts_with('w'))].push(point.to_owned());
        }
        // Where a lane makes the edges one after the other, axes come in the order of the edges of B.
        if p.renormalise && axes.len() == 11 && p.axes_per_clock == 1 {
            axes.sort_by_key(|axis| match axis.name.strip_prefix("c_") {
                Some(edges) => 1 + edges[1..].parse::<usize>().expect("the number of an edge"),
                None if axis.name == "n_a" => 0,
                None => 3,
            });
        }
        Self { axes, per_clock: p.axes_per_clock, skip: p.projections == Projections::Skip }
    }

    /// The signal behind a node in a phase, and which of its two values the node is; none for a sign case, which follows
    /// from its interval.
    pub fn signal(&self, node: &str, phase: usize) -> Option<(String, usize)> {
        let axis = |unit: &str| &self.axes[phase * self.per_clock + unit.parse::<usize>().expect("a number")];
        if let Some(unit) = node.strip_prefix("axis_separated") {
            return Some((format!("flags.{}", axis(unit).name), 0));
        }
        if let Some(unit) = node.strip_prefix("axis_overlapping") {
            return Some((format!("flags.{}", axis(unit).name), 1));
        }
        let (stem, end) = node.rsplit_once('_').expect("a name of several parts");
        let part = match end {
            "lo" => 0,
            "hi" => 1,
            "case" => return None,
            _ => panic!("unknown probe {node}"),
        };
        let image = |unit: &str, slot: &str| {
            let axis = axis(unit);
            let point = self.projected(axis, slot.parse().expect("a number"));
            format!("projection.{}.{point}", axis.name)
        };
        let name = match *stem.split('_').collect::<Vec<_>>() {
            [point, c] if point.starts_with('b') => format!("transform.w{}_{c}", &point[1..]),
            [slot] if slot.starts_with('p') => image("0", &slot[1..]),
            [unit, slot] if unit.starts_with("axis") => image(&unit[4..], &slot[1..]),
            [point, c] => format!("renormalise.{point}_{c}"),
            ["e", edge, c] => format!("edge.{edge}_{c}"),
            ["axis", unit, c] => format!("axis.{}_{c}", axis(&unit[1..]).name),
            _ => panic!("unknown probe {node}"),
        };
        Some((name, part))
    }

    /// The point that a projection unit projects on an axis: A's from the first unit on, B's behind them, or, where
    /// duplicates are skipped, from the last unit down.
    fn projected<'a>(&self, axis: &'a Axis, slot: usize) -> &'a str {
        let [a, b] = &axis.points;
        let units = self.axes.iter().map(|axis| axis.points.concat().len()).max().expect("axes");
        let of_b = || if self.skip { units - 1 - slot } else { slot - a.len() };
        a.get(slot).unwrap_or_else(|| &b[of_b()])
    }
}
