//! Which stages a scene needs.

use super::bench::{Bench, Step};
use super::measure::measure;
use super::{Census, Cost, Front, Request, Saving, Software, Stages, Tally, Wish, reason};
use efsat_checks::cosim::CosimError;
use efsat_geometry::scene::Scene;
use efsat_unit::host::settings::Effect;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, Params, Transform};
use serde::Serialize;
use std::collections::HashMap;

/// What was found out about a stage.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// The stage.
    pub effect: &'static str,
    /// Whether the scene needs it.
    pub needed: bool,
    /// Whether it is there: `on`, `off`, or `translate` of the transform.
    pub state: &'static str,
    /// Who decided.
    pub decided_by: Wish,
    /// Why it is needed or not, with what was measured.
    pub reason: String,
    /// What leaving it out saves, or would save, in hardware, if that was wanted: the planned unit with the whole stage
    /// against the same without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub saving: Option<Saving>,
}

/// A unit of the plan.
#[derive(Clone, Debug, Serialize)]
pub struct Answers {
    /// What it answers on all pairs that come to it.
    #[serde(flatten)]
    pub tally: Tally,
    /// What it takes, if that was wanted.
    #[serde(flatten)]
    pub cost: Option<Cost>,
}

/// The unit of the other method on the same pairs, for comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Other {
    /// Its method.
    pub method: &'static str,
    /// What it answers, beside the planned unit, and what it takes.
    #[serde(flatten)]
    pub answers: Answers,
    /// The command line that generates it.
    pub command_line: String,
    /// Its parameters.
    #[serde(skip)]
    pub params: Params,
}

/// Which stages a scene needs, and the unit that has them.
#[derive(Clone, Debug, Serialize)]
pub struct Plan {
    /// The scene.
    pub scene: String,
    /// What there is in it, behind the stages before the unit.
    pub census: Census,
    /// Pairs that come to the unit.
    pub unit_pairs: u64,
    /// The share of them that may become possibly incorrect.
    pub allowed: f64,
    /// The stages, in the order in which they were tried, each without those left out before it.
    pub effects: Vec<Finding>,
    /// The unit with every stage that is not switched off: the measure of the planned one.
    pub full: Answers,
    /// The planned unit.
    pub planned: Answers,
    /// The unit of the other method, in its defaults, if costs were wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other: Option<Other>,
    /// What the planned unit saves in all against the full one, if that was wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub saving: Option<Saving>,
    /// The stages before it.
    pub software: Software,
    /// The command line that generates it.
    pub command_line: String,
    /// The parameters of the full unit.
    #[serde(skip)]
    pub full_params: Params,
    /// The parameters of the planned unit.
    #[serde(skip)]
    pub params: Params,
}

/// Finds out which stages a scene needs.
///
/// A stage before the unit is needed if it saves work. A stage of the unit is left out if no surviving pair becomes less
/// definite than in the full unit, short of the share that is allowed; the transform besides only as far as the poses
/// do not call for it. Stages are tried in the order of [`Effect::ALL`], each without those that were left out before.
///
/// # Errors
/// Parameters out of range.
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, CosimError> {
    let (front, census, mut effects) = software(scene, request);
    let mut bench = Bench::new(&front, request);
    let planned = bench.decide(&census);
    let params = planned.params(&request.params);
    let full_params = bench.full.params(&request.params);
    let mut prices = Prices { front: &front, request, census: &census, known: HashMap::new() };
    for Step { effect, needed, reason } in std::mem::take(&mut bench.steps) {
        let with = planned.set(effect, true);
        let without = if planned == with { planned.set(effect, false) } else { planned };
        effects.push(Finding {
            effect: effect.name(),
            needed,
            state: state(planned, effect),
            decided_by: request.wish(effect),
            reason,
            saving: prices.of(with)?.zip(prices.of(without)?).map(|(with, without)| Saving::new(&with, &without)),
        });
    }
    let other = if request.costs { other(&front, &params, &census)? } else { None };
    let full = Answers { tally: bench.tally(bench.full), cost: prices.of(bench.full)? };
    let planned = Answers { tally: bench.tally(planned), cost: prices.of(planned)? };
    Ok(Plan {
        scene: scene.name.clone(),
        unit_pairs: full.tally.verdicts.total(),
        census,
        allowed: request.allowed,
        effects,
        other,
        saving: full.cost.zip(planned.cost).map(|(full, planned)| Saving::new(&full, &planned)),
        full,
        planned,
        software: front.software(),
        command_line: params.command_line(),
        full_params,
        params,
    })
}

/// Asks the unit of the other method for the same pairs, with the widths, device and transform of the planned one. The exact
/// unit is for another kind of input and has no other.
fn other(front: &Front<'_>, planned: &Params, census: &Census) -> Result<Option<Other>, CosimError> {
    let method = match planned.method {
        Method::Axes => Method::Determinants,
        Method::Determinants => Method::Axes,
        Method::Exact => return Ok(None),
    };
    let params = Params {
        width: planned.width,
        int_bits: planned.int_bits,
        transform: planned.transform,
        transform_width: planned.transform_width,
        device: planned.device.clone(),
        frequency: planned.frequency,
        guard: planned.guard,
        tag_width: planned.tag_width,
        ..Params::of(method)
    };
    // Not every width has both methods.
    if params.validate().is_err() {
        return Ok(None);
    }
    let tally = measure(front, &[planned.clone(), params.clone()], None).tallies[1];
    let cost = Some(Cost::new(front, &params, &census.vectors)?);
    Ok(Some(Other {
        method: method.name(),
        answers: Answers { tally, cost },
        command_line: params.command_line(),
        params,
    }))
}

/// What units take, each built once.
struct Prices<'a, 'b> {
    front: &'b Front<'a>,
    request: &'b Request,
    census: &'b Census,
    known: HashMap<Stages, Cost>,
}

impl Prices<'_, '_> {
    /// The cost of a unit, if costs are wanted.
    fn of(&mut self, stages: Stages) -> Result<Option<Cost>, CosimError> {
        if !self.request.costs {
            return Ok(None);
        }
        if let Some(cost) = self.known.get(&stages) {
            return Ok(Some(*cost));
        }
        let cost = Cost::new(self.front, &stages.params(&self.request.params), &self.census.vectors)?;
        self.known.insert(stages, cost);
        Ok(Some(cost))
    }
}

fn state(stages: Stages, effect: Effect) -> &'static str {
    match (effect, stages.transform) {
        (Effect::Transform, Transform::Translate) => "translate",
        _ if stages.has(effect) => "on",
        _ => "off",
    }
}

/// Decides on the stages before the unit, one after the other, each with what those before it leave.
fn software<'a>(scene: &'a Scene, request: &Request) -> (Front<'a>, Census, Vec<Finding>) {
    let all = Stages::ALL.params(&request.params);
    let mut software = Software { broad_phase: true, hierarchy: true, degenerate: true };
    let mut front = Front::new(scene, software, request.directions);
    let mut census = Census::new(&front, &all);
    let mut effects = vec![];
    for effect in [Effect::BroadPhase, Effect::Hierarchy, Effect::Degenerate] {
        // Whether something changes without the stage, whether it is needed, and why.
        let fewer = census.meetings < census.object_pairs;
        let (matters, needed, reason) = match effect {
            Effect::BroadPhase => (fewer, fewer, reason::broad_phase(scene.objects.len(), &census)),
            Effect::Hierarchy => {
                let work = census.statistics.overlap_tests + census.statistics.pairs_tested;
                (true, work < census.all_pairs, reason::hierarchy(&census))
            }
            _ => {
                let some = census.degenerate_pairs > 0;
                (some, some, reason::degenerate(front.triangles(), &census))
            }
        };
        let there = match request.wish(effect) {
            Wish::Auto | Wish::Option => needed,
            Wish::On => true,
            Wish::Off => false,
        };
        if !there {
            match effect {
                Effect::BroadPhase => software.broad_phase = false,
                Effect::Hierarchy => software.hierarchy = false,
                _ => software.degenerate = false,
            }
            front = Front::new(scene, software, request.directions);
            if matters {
                census = Census::new(&front, &all);
            }
        }
        effects.push(Finding {
            effect: effect.name(),
            needed,
            state: if there { "on" } else { "off" },
            decided_by: request.wish(effect),
            reason,
            saving: None,
        });
    }
    (front, census, effects)
}
