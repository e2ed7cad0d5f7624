//! Doing what a plan says, or a shard of it, and going on where an earlier run stopped.

use super::causes::Causes;
use super::floor::Floor;
use super::hardware::synthesise;
use super::ladder::Ladder;
use super::pairs::{Amount, Pairs, TooMany};
use super::plan::{Plan, Request};
use super::point::{Options, Point, model_options, options};
use super::store::{Drawn, Record, Store, key};
use super::timing::Yardstick;
use super::{Answers, Hardware};
use efsat_checks::journal::JournalError;
use efsat_checks::synth::SynthError;
use efsat_geometry::scene::Scene;
use efsat_unit::host::Relations;
use efsat_unit::params::Params;
use rayon::prelude::*;

/// Why a campaign ends early.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// Too many pairs.
    #[error(transparent)]
    Pairs(#[from] TooMany),
    /// A scene without pairs.
    #[error("{0}: found no pair of triangles whose boxes overlap; expected a scene with some")]
    Empty(String),
    /// Results that cannot be read or written.
    #[error(transparent)]
    Store(#[from] JournalError),
    /// A design that cannot be made, or a tool that fails.
    #[error(transparent)]
    Synth(#[from] SynthError),
}

/// A part of a campaign: number `index` of `count`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which.
    pub index: usize,
    /// Of how many.
    pub count: usize,
}

impl Shard {
    /// The whole campaign.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Whether item number `item` belongs to it.
    pub fn has(self, item: usize) -> bool {
        item % self.count == self.index - 1
    }
}

/// How much there was to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Results found finished.
    pub found: usize,
    /// Results made now.
    pub made: usize,
}

/// What is done in one go.
enum Item<'a> {
    /// Points that give the same answers.
    Model(Vec<&'a Params>),
    Ladder,
    Causes,
    Floor,
    Synthesis(&'a Params),
}

/// A campaign.
pub struct Campaign<'a> {
    /// What was asked for.
    pub request: &'a Request,
    /// What there is to do.
    pub plan: &'a Plan,
    /// The scene.
    pub scene: &'a Scene,
    /// How many of its pairs.
    pub amount: Amount,
    /// Which part.
    pub shard: Shard,
}

/// What the results of a campaign are found by.
pub struct Keys {
    of: String,
    base: Options,
}

impl Keys {
    /// Those of a request.
    pub fn new(request: &Request) -> Self {
        let Request { digest, pairs, seed, base, .. } = request;
        Self { of: format!("{digest} {pairs} {seed}"), base: base.clone() }
    }

    /// The pairs.
    pub fn drawn(&self) -> String {
        key("drawn", &self.of, &Options::new())
    }

    /// A point.
    pub fn point(&self, params: &Params) -> String {
        key("point", &self.of, &options(params))
    }

    /// The software ladder.
    pub fn ladder(&self) -> String {
        key("ladder", &self.of, &Options::new())
    }

    /// The causes.
    pub fn causes(&self) -> String {
        key("causes", &self.of, &model_options(&self.base))
    }

    /// The floor.
    pub fn floor(&self) -> String {
        key("floor", &self.of, &model_options(&self.base))
    }

    /// Cells as mapped; they depend on no scene.
    pub fn synthesis(&self, params: &Params) -> String {
        key("synthesis", "", &options(params))
    }
}

impl Campaign<'_> {
    fn items(&self) -> Vec<Item<'_>> {
        let fixed = [Item::Ladder, Item::Floor, Item::Causes];
        let models = self.plan.models().into_iter().map(Item::Model);
        let synthesis = self.plan.points.iter().filter(|_| self.request.synth).map(Item::Synthesis);
        let all = fixed.into_iter().chain(models).chain(synthesis).enumerate();
        all.filter(|(i, _)| self.shard.has(*i)).map(|(_, item)| item).collect()
    }

    /// The results that an item stands for.
    fn keys(&self, keys: &Keys, item: &Item) -> Vec<String> {
        match item {
            Item::Model(points) => points.iter().map(|params| keys.point(params)).collect(),
            Item::Ladder => vec![keys.ladder()],
            Item::Causes => vec![keys.causes()],
            Item::Floor => vec![keys.floor()],
            Item::Synthesis(params) => vec![keys.synthesis(params)],
        }
    }

    /// The number of results of this shard.
    pub fn len(&self) -> usize {
        let keys = Keys::new(self.request);
        self.items().iter().map(|item| self.keys(&keys, item).len()).sum()
    }

    /// Whether the shard has nothing to do.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Makes the results that the store does not have; `done` is told of every one, also of those found.
    ///
    /// # Errors
    /// See [`CampaignError`]. What was finished stays in the store.
    pub fn run(&self, store: &mut Store, done: &dyn Fn()) -> Result<Progress, CampaignError> {
        let keys = Keys::new(self.request);
        let mut progress = Progress::default();
        let mut open = vec![];
        for item in self.items() {
            let of_item = self.keys(&keys, &item);
            let missing = of_item.iter().filter(|key| store.get(key).is_none()).count();
            progress.found += of_item.len() - missing;
            (0..of_item.len() - missing).for_each(|_| done());
            if missing > 0 {
                open.push(item);
            }
        }
        if open.is_empty() && store.get(&keys.drawn()).is_some() {
            return Ok(progress);
        }
        let pairs = Pairs::draw(self.scene, self.amount, self.request.seed)?;
        if pairs.is_empty() {
            return Err(CampaignError::Empty(self.request.scene.clone()));
        }
        if store.get(&keys.drawn()).is_none() {
            let mut truths = Relations::default();
            pairs.relations().iter().for_each(|relation| truths.count(*relation));
            let drawn = Drawn { candidates: pairs.candidates, pairs: pairs.len() as u64, truths };
            store.add(&keys.drawn(), Record::Drawn(drawn))?;
        }
        let yardstick = Yardstick::new(&pairs);
        for item in open {
            let mut add = |key: &str, record: Record| {
                store.add(key, record)?;
                progress.made += 1;
                done();
                Ok::<(), JournalError>(())
            };
            match item {
                Item::Ladder => add(&keys.ladder(), Record::Ladder(Ladder::climb(&pairs, &yardstick)))?,
                Item::Floor => add(&keys.floor(), Record::Floor(Box::new(Floor::measure(&pairs, &self.plan.base))))?,
                Item::Causes => {
                    let (_, undecided) = Answers::ask(&pairs, &self.plan.base);
                    let causes = Causes::examine(&pairs, &self.plan.base, &undecided);
                    add(&keys.causes(), Record::Causes(causes))?;
                }
                Item::Synthesis(params) => add(&keys.synthesis(params), Record::Synthesis(synthesise(params)?))?,
                Item::Model(points) => {
                    let answers = known_answers(store, &keys, &points);
                    let missing: Vec<&Params> =
                        points.into_iter().filter(|params| store.get(&keys.point(params)).is_none()).collect();
                    let (answers, hardware) = model(&pairs, &yardstick, &missing, answers);
                    for (params, hardware) in missing.into_iter().zip(hardware?) {
                        let point = Point { options: options(params), answers, hardware, synthesised: None };
                        store.add(&keys.point(params), Record::Point(Box::new(point)))?;
                        progress.made += 1;
                        done();
                    }
                }
            }
        }
        Ok(progress)
    }
}

/// The answers of points that give the same ones, if one of them is finished.
fn known_answers(store: &Store, keys: &Keys, points: &[&Params]) -> Option<Answers> {
    points.iter().find_map(|params| match store.get(&keys.point(params)) {
        Some(Record::Point(point)) => Some(point.answers),
        _ => None,
    })
}

/// Asks and times points that give the same answers, and predicts their hardware.
fn model(
    pairs: &Pairs,
    yardstick: &Yardstick,
    points: &[&Params],
    known: Option<Answers>,
) -> (Answers, Result<Vec<Hardware>, SynthError>) {
    let predict = || points.par_iter().map(|params| Hardware::predict(params)).collect();
    match known {
        Some(answers) => (answers, predict()),
        None => {
            let ((mut answers, undecided), hardware) = rayon::join(|| Answers::ask(pairs, points[0]), predict);
            // Nothing else runs now.
            answers.time(pairs, &undecided, yardstick);
            (answers, hardware)
        }
    }
}
