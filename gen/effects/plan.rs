//! Which stages a scene needs.

use super::measure::{measure, Measured, Tally};
use super::{reason, Census, Cost, Front, Saving, Software, Stages};
use crate::cosim::CosimError;
use crate::params::{Params, Transform};
use crate::scene::hierarchy::Directions;
use crate::scene::{Effect, Scene, Switch};
use serde::Serialize;
use std::collections::HashMap;

/// Who decides on a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Wish {
    /// The scene: the stage is there if it is needed.
    Auto,
    /// The user wants it.
    On,
    /// The user does not want it.
    Off,
    /// The user gave the option that says it; it stands in the parameters.
    Option,
}

impl From<Switch> for Wish {
    fn from(switch: Switch) -> Self {
        match switch {
            Switch::Auto => Self::Auto,
            Switch::On => Self::On,
            Switch::Off => Self::Off,
        }
    }
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The parameters of the unit; what they say of stages counts only where the wish is [`Wish::Option`].
    pub params: Params,
    /// One wish for each of [`Effect::ALL`].
    pub wishes: [Wish; Effect::ALL.len()],
    /// The share of the surviving pairs that may become possibly incorrect.
    pub allowed: f64,
    /// Directions of the bounding volumes.
    pub directions: Directions,
    /// Whether units are built to see what they take.
    pub costs: bool,
}

impl Request {
    /// Parameters, and the settings of the scene; costs are wanted.
    pub fn new(scene: &Scene, params: Params, directions: Directions) -> Self {
        let wishes = Effect::ALL.map(|effect| scene.settings.switches.get(effect).into());
        Self { params, wishes, allowed: scene.settings.allowed, directions, costs: true }
    }

    fn wish(&self, effect: Effect) -> Wish {
        self.wishes[effect as usize]
    }
}

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
    /// What it saves in all against the full one, if that was wanted.
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
    let full = Answers { tally: bench.tally(bench.full), cost: prices.of(bench.full)? };
    let planned = Answers { tally: bench.tally(planned), cost: prices.of(planned)? };
    Ok(Plan {
        scene: scene.name.clone(),
        unit_pairs: full.tally.pairs(),
        census,
        allowed: request.allowed,
        effects,
        saving: full.cost.zip(planned.cost).map(|(full, planned)| Saving::new(&full, &planned)),
        full,
        planned,
        software: front.software(),
        command_line: params.command_line(),
        full_params,
        params,
    })
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

/// Decides on the stages before the unit, with what is left behind them.
fn software<'a>(scene: &'a Scene, request: &Request) -> (Front<'a>, Census, Vec<Finding>) {
    let all = Stages::ALL.params(&request.params);
    let every = Software { broad_phase: true, hierarchy: true, degenerate: true };
    let mut front = Front::new(scene, every, request.directions);
    let mut census = Census::new(&front, &all);
    let needed = [
        scene.objects.len() > 2 && census.meetings < census.object_pairs,
        census.statistics.overlap_tests + census.statistics.pairs_tested < census.all_pairs,
        census.degenerate_pairs > 0,
    ];
    let reasons = [
        reason::broad_phase(scene.objects.len(), &census),
        reason::hierarchy(&census),
        reason::degenerate(front.triangles(), &census),
    ];
    let chosen = |effect: Effect| match request.wish(effect) {
        Wish::Auto | Wish::Option => needed[effect as usize],
        Wish::On => true,
        Wish::Off => false,
    };
    let software = Software {
        broad_phase: chosen(Effect::BroadPhase),
        hierarchy: chosen(Effect::Hierarchy),
        degenerate: chosen(Effect::Degenerate),
    };
    if software != every {
        front = Front::new(scene, software, request.directions);
        census = Census::new(&front, &all);
    }
    let effects = [Effect::BroadPhase, Effect::Hierarchy, Effect::Degenerate].into_iter().zip(reasons);
    let finding = |(effect, reason): (Effect, String)| Finding {
        effect: effect.name(),
        needed: needed[effect as usize],
        state: if chosen(effect) { "on" } else { "off" },
        decided_by: request.wish(effect),
        reason,
        saving: None,
    };
    (front, census, effects.map(finding).collect())
}

/// A decision.
struct Step {
    effect: Effect,
    needed: bool,
    reason: String,
}

/// Asks units and remembers what they said.
struct Bench<'a, 'b> {
    front: &'b Front<'a>,
    request: &'b Request,
    full: Stages,
    known: HashMap<Stages, Tally>,
    steps: Vec<Step>,
}

impl<'a, 'b> Bench<'a, 'b> {
    fn new(front: &'b Front<'a>, request: &'b Request) -> Self {
        let given = Stages::of(&request.params);
        let full = Effect::ALL.into_iter().fold(Stages::ALL, |full, effect| match request.wish(effect) {
            Wish::Auto | Wish::On => full,
            Wish::Off => full.set(effect, false),
            Wish::Option => full.with(effect, given),
        });
        Self { front, request, full, known: HashMap::new(), steps: vec![] }
    }

    fn tally(&self, stages: Stages) -> Tally {
        self.known[&stages]
    }

    /// Asks the units that have not been asked.
    fn ask(&mut self, stages: &[Stages], in_plane: Option<[Stages; 2]>) -> Measured {
        let mut asked = vec![self.full];
        for unit in stages.iter().chain(in_plane.iter().flatten()) {
            let new = !self.known.contains_key(unit) || in_plane.is_some_and(|pair| pair.contains(unit));
            if new && !asked.contains(unit) {
                asked.push(*unit);
            }
        }
        if asked.len() == 1 && self.known.contains_key(&self.full) {
            return Measured::default();
        }
        let params: Vec<Params> = asked.iter().map(|unit| unit.params(&self.request.params)).collect();
        let place = |unit: Stages| asked.iter().position(|other| *other == unit).unwrap_or_default();
        let measured = measure(self.front, &params, in_plane.map(|pair| pair.map(place)));
        self.known.extend(asked.iter().copied().zip(measured.tallies.iter().copied()));
        measured
    }

    /// The unit without what is not needed.
    fn decide(&mut self, census: &Census) -> Stages {
        let mut current = self.transform(census);
        // All that is likely to be asked, at once.
        let rest = [Effect::Renormalise, Effect::InPlaneAxes, Effect::ExactCeiling];
        let toggled = |effect: Effect| current.set(effect, !current.has(effect));
        let pair = [true, false].map(|there| current.set(Effect::InPlaneAxes, there));
        let mut planes = (pair, self.ask(&rest.map(toggled), Some(pair)));
        for effect in rest {
            let (with, without) = (current.set(effect, true), current.set(effect, false));
            if effect == Effect::InPlaneAxes && planes.0 != [with, without] {
                planes = ([with, without], self.ask(&[], Some([with, without])));
            }
            self.ask(&[with, without], None);
            let needed = !self.suffices(without);
            let [more, less] = [with, without].map(|unit| self.tally(unit));
            let reason = match effect {
                Effect::Renormalise => reason::renormalise(census, &more, &less),
                Effect::InPlaneAxes => reason::in_plane_axes(&planes.1, &more, &less),
                _ => reason::exact_ceiling(&more, &less),
            };
            self.steps.push(Step { effect, needed, reason });
            if self.request.wish(effect) == Wish::Auto && !needed {
                current = without;
            }
        }
        current
    }

    /// Whether a unit is as definite as the full one, as far as asked for.
    fn suffices(&self, stages: Stages) -> bool {
        let tally = self.tally(stages);
        tally.contradictions == 0 && tally.less_definite as f64 <= self.request.allowed * tally.pairs() as f64
    }

    /// Leaves out what no pose calls for.
    fn transform(&mut self, census: &Census) -> Stages {
        let least = match (census.rotations, census.translations) {
            (0, 0) => Transform::Off,
            (0, _) => Transform::Translate,
            _ => Transform::On,
        };
        let candidate = self.full.with(Effect::Transform, Stages { transform: least, ..Stages::NONE });
        let mut needed = least;
        if least != Transform::On && self.request.wish(Effect::Transform) == Wish::Auto {
            self.ask(&[candidate], None);
            if !self.suffices(candidate) {
                needed = Transform::On;
            }
        }
        let reason = reason::transform(census, needed != least);
        self.steps.push(Step { effect: Effect::Transform, needed: needed != Transform::Off, reason });
        match self.request.wish(Effect::Transform) {
            Wish::Auto => self.full.with(Effect::Transform, Stages { transform: needed, ..Stages::NONE }),
            _ => self.full,
        }
    }
}
