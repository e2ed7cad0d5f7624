//! A scene through its planned unit: every surviving pair is answered, and what the unit leaves open is retested.

use super::measure::{Met, Units};
use super::sample::{Least, Place};
use super::{Front, Plan};
use crate::exact::Exact;
use crate::golden::Verdict;
use crate::params::Params;
use crate::scene::hierarchy::{Scratch, Statistics};
use crate::scene::{Frame, Meeting, Posed};
use rayon::prelude::*;
use serde::Serialize;

/// Pairs that a thread takes at a time.
const SHARE: usize = 1024;
/// Bits by which the unit is narrower that tells which pairs are close.
const COARSER: u32 = 2;

/// Which pairs are remembered to be simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// None.
    None,
    /// An even share of every verdict in every frame, so many in all; and of the possibly incorrect and close pairs so
    /// many at most.
    Some {
        /// Pairs of the stratified sample.
        stratified: usize,
        /// Possibly incorrect and close pairs.
        close: usize,
    },
    /// All; they are handed on with each frame.
    All,
}

/// How to run.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Which pairs are remembered.
    pub sampling: Sampling,
    /// Whether pairs that the unit calls an intersection get the exact answer too.
    pub exact: bool,
    /// Names the sample.
    pub seed: u64,
}

/// What a frame came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Pairs of objects that meet.
    pub meetings: u64,
    /// What it took to find the pairs, and how many there are.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Pairs that the unit separates.
    pub separate: u64,
    /// Pairs that intersect for certain.
    pub intersect: u64,
    /// Pairs that the unit leaves open.
    pub possibly_incorrect: u64,
    /// Pairs answered before the unit, because a triangle is degenerate.
    pub in_software: u64,
    /// Pairs that have a common point, in the end.
    pub touching: u64,
}

impl Counts {
    /// Adds other counts.
    pub fn add(&mut self, other: &Self) {
        self.meetings += other.meetings;
        self.statistics = self.statistics + other.statistics;
        self.separate += other.separate;
        self.intersect += other.intersect;
        self.possibly_incorrect += other.possibly_incorrect;
        self.in_software += other.in_software;
        self.touching += other.touching;
    }
}

/// A frame, counted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The number of the frame.
    pub frame: usize,
    /// What it is called.
    pub label: String,
    /// The distance of a tumbling turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// What it came to.
    #[serde(flatten)]
    pub counts: Counts,
}

/// A pair that touches, or that the unit leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact {
    /// Where.
    pub place: Place,
    /// What the unit said; none if the pair did not come to it.
    pub verdict: Option<Verdict>,
    /// The exact answer, where it was asked for: for pairs that are an intersection for certain only on request.
    pub exact: Option<Exact>,
}

impl Contact {
    /// Whether the pair has a common point.
    pub fn touches(&self) -> bool {
        self.exact.map_or(self.verdict == Some(Verdict::Intersect), |exact| exact != Exact::Separate)
    }
}

/// What all frames came to.
#[derive(Clone, Debug, Default)]
pub struct Total {
    /// The sum of all frames.
    pub counts: Counts,
    /// Pairs that the planned unit leaves open and the full one does not.
    pub less_definite: u64,
    /// Pairs that the two decide differently.
    pub contradictions: u64,
    /// Definite verdicts that the exact answer refutes, as far as it was asked for.
    pub wrong: u64,
    /// Possibly incorrect and close pairs.
    pub close: u64,
    /// The pairs to simulate, in order.
    pub places: Vec<Place>,
    /// How many of the possibly incorrect and close pairs are among them.
    pub close_places: usize,
    /// The frame in which most pairs touch, the first of several.
    pub fullest: usize,
    most: u64,
}

/// A frame before it is added up.
#[derive(Default)]
struct Found {
    counts: Counts,
    less_definite: u64,
    contradictions: u64,
    wrong: u64,
    close: u64,
    contacts: Vec<Contact>,
    /// By verdict: pairs by the lots drawn for them.
    strata: [Vec<(u64, Place)>; 3],
    /// Possibly incorrect pairs before close ones, by the lots drawn for them.
    near: Vec<((bool, u64), Place)>,
    all: Vec<Place>,
}

impl Found {
    fn append(&mut self, mut other: Self) {
        self.counts.add(&other.counts);
        self.less_definite += other.less_definite;
        self.contradictions += other.contradictions;
        self.wrong += other.wrong;
        self.close += other.close;
        self.contacts.append(&mut other.contacts);
        self.strata.iter_mut().zip(&mut other.strata).for_each(|(mine, theirs)| mine.append(theirs));
        self.near.append(&mut other.near);
        self.all.append(&mut other.all);
    }

    /// Keeps no more than can matter in the end.
    fn shrink(&mut self, stratified: usize, close: usize) {
        for stratum in &mut self.strata {
            stratum.sort_unstable();
            stratum.truncate(stratified);
        }
        self.near.sort_unstable();
        self.near.truncate(close);
    }
}

/// Units that answer.
struct Answering<'a, 'b> {
    front: &'b Front<'a>,
    units: Units<'a>,
    /// Whether the full unit is another one.
    differs: bool,
    /// Whether there is a narrower unit.
    narrower: bool,
    options: Options,
}

/// Answers every surviving pair of a scene by the planned unit, retests what it leaves open, and compares its verdicts
/// with those of the full one. `visit` gets each frame with its contacts, and with all its pairs if they are asked for,
/// in order, until it fails.
///
/// # Errors
/// The first error of `visit`.
pub fn run<E>(
    front: &Front<'_>,
    plan: &Plan,
    options: Options,
    mut visit: impl FnMut(Row, &[Contact], &[Place]) -> Result<(), E>,
) -> Result<Total, E> {
    let answering = Answering::new(front, plan, options);
    let (stratified, close) = match options.sampling {
        Sampling::Some { stratified, close } => (stratified, close),
        Sampling::None | Sampling::All => (0, 0),
    };
    let mut strata = [0, 1, 2].map(|_| Least::new(stratified));
    let mut near = Least::new(close);
    let mut total = Total::default();
    front.survivors.in_order(
        |frame, scratch| answering.frame(frame, scratch),
        |frame, found: Found| {
            // The best of every frame come before the second best of any.
            for (least, stratum) in strata.iter_mut().zip(&found.strata) {
                stratum.iter().enumerate().for_each(|(rank, (lot, place))| least.add((rank, *lot), *place));
            }
            found.near.iter().for_each(|(key, place)| near.add(*key, *place));
            total.add(frame, &found);
            let Frame { label, distance, .. } = front.scene().frame(frame);
            visit(Row { frame, label, distance, counts: found.counts }, &found.contacts, &found.all)
        },
    )?;
    let strata = strata.map(|least| least.list().into_iter().map(|(_, place)| place).collect());
    let near: Vec<Place> = near.list().into_iter().map(|(_, place)| place).collect();
    total.close_places = near.len();
    total.places = even(&strata, stratified);
    total.places.extend(near);
    total.places.sort_unstable();
    total.places.dedup();
    Ok(total)
}

/// An even share of lists, so many in all: what one lacks the others make up for.
fn even(lists: &[Vec<Place>; 3], count: usize) -> Vec<Place> {
    let longest = lists.iter().map(Vec::len).max().unwrap_or_default();
    let in_turn = (0..longest).flat_map(|rank| lists.iter().filter_map(move |list| list.get(rank)));
    in_turn.take(count).copied().collect()
}

/// The pairs of one frame that touch or are left open, each with its exact answer.
pub fn frame_contacts(front: &Front<'_>, plan: &Plan, frame: usize) -> Vec<Contact> {
    let options = Options { sampling: Sampling::None, exact: true, seed: 0 };
    Answering::new(front, plan, options).frame(frame, &mut Scratch::default()).contacts
}

impl Total {
    fn add(&mut self, frame: usize, found: &Found) {
        self.counts.add(&found.counts);
        self.less_definite += found.less_definite;
        self.contradictions += found.contradictions;
        self.wrong += found.wrong;
        self.close += found.close;
        if found.counts.touching > self.most {
            (self.fullest, self.most) = (frame, found.counts.touching);
        }
    }
}

impl<'a, 'b> Answering<'a, 'b> {
    fn new(front: &'b Front<'a>, plan: &Plan, options: Options) -> Self {
        let mut params = vec![plan.params.clone(), plan.full_params.clone()];
        let coarser = Params { width: plan.params.width.saturating_sub(COARSER), ..plan.params.clone() };
        let narrower = matches!(options.sampling, Sampling::Some { .. }) && coarser.validate().is_ok();
        params.extend(narrower.then_some(coarser));
        let differs = plan.params != plan.full_params;
        Self { front, units: Units::new(front, &params), differs, narrower, options }
    }

    fn frame(&self, frame: usize, scratch: &mut Scratch) -> Found {
        let mut found = Found::default();
        for meeting in self.front.survivors.meetings(frame) {
            let mut at = None;
            let statistics = self.front.survivors.pairs(&meeting, scratch, |pairs| {
                if pairs.is_empty() {
                    return;
                }
                let posed = at.get_or_insert_with(|| self.units.posed(&meeting));
                let met = self.units.at(posed);
                let shares = pairs.par_chunks(SHARE).map(|pairs| self.share(&meeting, &met, &posed[0], pairs));
                let shares: Vec<Found> = shares.collect();
                shares.into_iter().for_each(|share| found.append(share));
            });
            found.counts.meetings += 1;
            found.counts.statistics = found.counts.statistics + statistics;
        }
        if let Sampling::Some { stratified, close } = self.options.sampling {
            found.shrink(stratified, close);
        }
        found
    }

    fn share(&self, meeting: &Meeting, met: &Met<'_, '_>, posed: &Posed<'_>, pairs: &[(u32, u32)]) -> Found {
        let mut found = Found::default();
        for &pair in pairs {
            let place = Place::new(meeting, pair);
            if self.front.answers(meeting, pair) {
                let exact = posed.class(pair);
                found.counts.in_software += 1;
                if exact != Exact::Separate {
                    found.counts.touching += 1;
                    found.contacts.push(Contact { place, verdict: None, exact: Some(exact) });
                }
                continue;
            }
            let verdict = met.verdict(0, pair).0;
            self.compare(met, pair, verdict, &mut found);
            match verdict {
                Verdict::Separate => found.counts.separate += 1,
                Verdict::Intersect => {
                    found.counts.intersect += 1;
                    let exact = self.options.exact.then(|| posed.class(pair));
                    found.wrong += u64::from(exact == Some(Exact::Separate));
                    found.contacts.push(Contact { place, verdict: Some(verdict), exact });
                }
                Verdict::PossiblyIncorrect => {
                    found.counts.possibly_incorrect += 1;
                    let exact = posed.class(pair);
                    found.contacts.push(Contact { place, verdict: Some(verdict), exact: Some(exact) });
                }
            }
            if verdict != Verdict::Separate {
                found.counts.touching += u64::from(found.contacts.last().is_some_and(Contact::touches));
            }
            self.remember(met, place, verdict, &mut found);
        }
        if let Sampling::Some { stratified, close } = self.options.sampling {
            found.shrink(stratified, close);
        }
        found
    }

    /// Compares with the full unit.
    fn compare(&self, met: &Met<'_, '_>, pair: (u32, u32), verdict: Verdict, found: &mut Found) {
        if !self.differs {
            return;
        }
        let full = met.verdict(1, pair).0;
        if full != verdict && full != Verdict::PossiblyIncorrect {
            match verdict {
                Verdict::PossiblyIncorrect => found.less_definite += 1,
                _ => found.contradictions += 1,
            }
        }
    }

    /// Remembers a pair of the unit to be simulated.
    fn remember(&self, met: &Met<'_, '_>, place: Place, verdict: Verdict, found: &mut Found) {
        match self.options.sampling {
            Sampling::None => {}
            Sampling::All => found.all.push(place),
            Sampling::Some { .. } => {
                let lot = place.lot(self.options.seed);
                found.strata[verdict as usize].push((lot, place));
                let open = verdict == Verdict::PossiblyIncorrect;
                if open || (self.narrower && met.verdict(2, place.pair).0 == Verdict::PossiblyIncorrect) {
                    found.close += 1;
                    found.near.push(((!open, lot), place));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_stratum_lacks_the_others_make_up_for() {
        let place = |pair: u32| Place { frame: 0, objects: (0, 1), pair: (pair, 0) };
        let lists = [vec![place(0)], (1..9).map(place).collect(), vec![]];
        let pairs = |count: usize| even(&lists, count).iter().map(|place| place.pair.0).collect::<Vec<_>>();
        assert_eq!(pairs(4), [0, 1, 2, 3]);
        assert_eq!(pairs(100).len(), 9);
        assert!(pairs(0).is_empty());
    }
}
