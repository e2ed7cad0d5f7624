//! A scene through its planned unit: every surviving pair is answered, and what the unit leaves open is retested.

use super::found::Found;
use super::measure::{Met, Units, beside};
use super::outcome::{Contact, Options, Row, Sampling, Total};
use super::sample::{Least, Place};
use super::{Front, Plan};
use efsat_geometry::collide::hierarchy::Scratch;
use efsat_geometry::exact::Exact;
use efsat_geometry::scene::{Frame, Meeting};
use efsat_unit::host::ReadyMeeting;
use efsat_unit::pair::Verdict;
use efsat_unit::params::Params;
use rayon::prelude::*;

/// Pairs that a thread takes at a time.
const SHARE: usize = 1024;
/// Bits by which the unit is narrower that tells which pairs are close.
const COARSER: u32 = 2;

/// Pairs of one frame that are kept, each with what is known of it.
const MOST: usize = 1 << 18;

/// A frame with too many pairs that touch, or are open, or are all to be simulated.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{label}: more than {MOST} pairs that touch, are undecided or are to be simulated; expected fewer in one pose \
     (classify and scene pairs take any number)"
)]
pub struct TooMany {
    label: String,
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
/// with those of the full one. `visit` gets each frame with its contacts, and with those of its pairs that are simulated
/// whatever their number: all of them, or with a sample every one that is possibly incorrect or close; in order, until it
/// fails.
///
/// # Errors
/// The first error of `visit`, and a frame with [`TooMany`] pairs.
pub fn run<E: From<TooMany>>(
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
    front.near.frames_in_order(
        |frame, scratch| answering.frame(frame, scratch),
        |frame, found: Found| {
            let Frame { label, distance, .. } = front.scene().frame(frame);
            if found.kept() > MOST {
                return Err(TooMany { label }.into());
            }
            // The best of every frame come before the second best of any.
            for (least, stratum) in strata.iter_mut().zip(&found.strata) {
                stratum.iter().enumerate().for_each(|(rank, (lot, place))| least.add((rank, *lot), *place));
            }
            found.near.iter().for_each(|(key, place)| near.add(*key, *place));
            total.add(frame, &found.sums);
            visit(Row { frame, label, distance, counts: found.sums.counts }, &found.contacts, &found.all)
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
        for meeting in self.front.near.meetings(frame) {
            let mut at = None;
            let statistics = self.front.near.pieces(&meeting, scratch, |pairs| {
                if pairs.is_empty() || found.kept() > MOST {
                    return;
                }
                let posed = at.get_or_insert_with(|| self.units.posed(&meeting));
                let met = self.units.at(posed);
                let shares = pairs.par_chunks(SHARE).map(|pairs| self.share(&meeting, &met, &posed[0], pairs));
                let shares: Vec<Found> = shares.collect();
                shares.into_iter().for_each(|share| found.append(share));
                self.shrink(&mut found);
            });
            found.sums.counts.meetings += 1;
            found.sums.counts.statistics = found.sums.counts.statistics + statistics;
        }
        found
    }

    /// Keeps no more of what is sampled than can matter in the end.
    fn shrink(&self, found: &mut Found) {
        if let Sampling::Some { stratified, close } = self.options.sampling {
            found.shrink(stratified, close);
        }
    }

    fn share(&self, meeting: &Meeting, met: &Met<'_, '_>, posed: &ReadyMeeting<'_>, pairs: &[(u32, u32)]) -> Found {
        let mut found = Found::default();
        for &pair in pairs {
            let place = Place::new(meeting, pair);
            if self.front.answers(meeting, pair) {
                let exact = posed.class(pair);
                found.sums.counts.in_software += 1;
                if exact != Exact::Separate {
                    found.sums.counts.touching += 1;
                    found.contacts.push(Contact { place, verdict: None, exact: Some(exact) });
                }
                continue;
            }
            let verdict = met.answer(0, pair).verdict;
            self.compare(met, pair, verdict, &mut found);
            match verdict {
                Verdict::Separate => found.sums.counts.separate += 1,
                Verdict::Intersect => {
                    found.sums.counts.intersect += 1;
                    let exact = self.options.exact.then(|| posed.class(pair));
                    found.sums.wrong += u64::from(exact == Some(Exact::Separate));
                    found.contacts.push(Contact { place, verdict: Some(verdict), exact });
                }
                Verdict::PossiblyIncorrect => {
                    found.sums.counts.possibly_incorrect += 1;
                    let exact = posed.class(pair);
                    found.contacts.push(Contact { place, verdict: Some(verdict), exact: Some(exact) });
                }
            }
            if verdict != Verdict::Separate {
                found.sums.counts.touching += u64::from(found.contacts.last().is_some_and(Contact::touches));
            }
            self.remember(met, place, verdict, &mut found);
        }
        self.shrink(&mut found);
        found
    }

    /// Compares with the full unit.
    fn compare(&self, met: &Met<'_, '_>, pair: (u32, u32), verdict: Verdict, found: &mut Found) {
        if !self.differs {
            return;
        }
        let [less_definite, contradicts] = beside(verdict, met.answer(1, pair).verdict);
        found.sums.less_definite += u64::from(less_definite);
        found.sums.contradictions += u64::from(contradicts);
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
                if open || (self.narrower && met.answer(2, place.pair).verdict == Verdict::PossiblyIncorrect) {
                    found.sums.close += 1;
                    found.near.push(((!open, lot), place));
                    found.all.push(place);
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
