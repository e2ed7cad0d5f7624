//! Stages of the unit left out one after the other, as long as it stays definite.

use super::measure::{Measured, Tally, measure};
use super::{Census, Front, Request, Stages, Wish, reason};
use efsat_unit::host::settings::Effect;
use efsat_unit::params::{Params, Transform};
use std::collections::HashMap;

/// A decision.
pub(super) struct Step {
    pub effect: Effect,
    pub needed: bool,
    pub reason: String,
}

/// Asks units and remembers what they said.
pub(super) struct Bench<'a, 'b> {
    front: &'b Front<'a>,
    request: &'b Request,
    /// Every stage that is not switched off.
    pub full: Stages,
    known: HashMap<Stages, Tally>,
    /// What was decided, in this order.
    pub steps: Vec<Step>,
}

impl<'a, 'b> Bench<'a, 'b> {
    pub fn new(front: &'b Front<'a>, request: &'b Request) -> Self {
        let given = Stages::of(&request.params);
        let full = Effect::ALL.into_iter().fold(Stages::ALL, |full, effect| match request.wish(effect) {
            Wish::Auto | Wish::On => full,
            Wish::Off => full.set(effect, false),
            Wish::Option => full.with(effect, given),
        });
        Self { front, request, full, known: HashMap::new(), steps: vec![] }
    }

    /// What a unit that was asked has said.
    pub fn tally(&self, stages: Stages) -> Tally {
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
    pub fn decide(&mut self, census: &Census) -> Stages {
        let mut current = self.transform(census);
        let method = self.request.params.method;
        let optional = Stages::optional(method).iter().copied();
        let rest: Vec<Effect> = optional.filter(|effect| *effect != Effect::Transform).collect();
        // All that is likely to be asked, at once.
        let toggled = |effect: &Effect| current.set(*effect, !current.has(*effect));
        let pair = [true, false].map(|there| current.set(Effect::InPlaneAxes, there));
        let all: Vec<Stages> = rest.iter().map(toggled).chain([current]).collect();
        let mut planes = (pair, self.ask(&all, rest.contains(&Effect::InPlaneAxes).then_some(pair)));
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
        tally.contradictions == 0 && tally.less_definite as f64 <= self.request.allowed * tally.verdicts.total() as f64
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
