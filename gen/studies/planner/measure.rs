//! What units answer on all pairs that survive.

use super::Front;
use efsat_geometry::scene::Meeting;
use efsat_unit::golden::Golden;
use efsat_unit::host::{Answer, Host, ReadyMeeting, ReadyScene, ScenePose, Verdicts};
use efsat_unit::pair::Verdict;
use efsat_unit::params::{Params, Transform};
use rayon::prelude::*;
use serde::Serialize;
use std::convert::Infallible;

/// Pairs that a thread takes at a time.
const SHARE: usize = 1024;
/// The flags of the 11 axes.
const ELEVEN: u32 = (1 << 11) - 1;

/// What a unit answers, and how that compares with another unit, the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// By verdict.
    #[serde(flatten)]
    pub verdicts: Verdicts,
    /// Those of all that the host decides.
    pub host_decided: u64,
    /// Undecided pairs that the reference decides.
    pub less_definite: u64,
    /// Pairs that both decide, differently: always 0, or one of them is wrong.
    pub contradictions: u64,
}

impl Tally {
    /// Counts a verdict beside that of the reference.
    pub fn add(&mut self, verdict: Verdict, reference: Verdict) {
        self.verdicts.count(verdict);
        let [less_definite, contradicts] = beside(verdict, reference);
        self.less_definite += u64::from(less_definite);
        self.contradictions += u64::from(contradicts);
    }

    /// Adds other counts.
    pub fn merge(&mut self, other: &Self) {
        self.verdicts += other.verdicts;
        self.host_decided += other.host_decided;
        self.less_definite += other.less_definite;
        self.contradictions += other.contradictions;
    }
}

/// Whether a verdict leaves open what the reference decides, and whether both decide, differently.
pub(super) fn beside(verdict: Verdict, reference: Verdict) -> [bool; 2] {
    let differs = verdict != reference && reference != Verdict::PossiblyIncorrect;
    let open = verdict == Verdict::PossiblyIncorrect;
    [differs && open, differs && !open]
}

/// Units with the hosts in front of them.
pub(super) struct Units<'a> {
    stages: Vec<ReadyScene<'a>>,
    list: Vec<Member>,
}

struct Member {
    golden: Golden,
    /// Its host; units that read the same numbers share one.
    stage: usize,
}

/// Units at a meeting.
pub(super) struct Met<'a, 'b> {
    units: &'b Units<'a>,
    posed: &'b [ReadyMeeting<'b>],
    hosts: Vec<ScenePose<'b>>,
}

impl<'a> Units<'a> {
    pub fn new(front: &Front<'a>, params: &[Params]) -> Self {
        let mut keys: Vec<(Params, bool)> = vec![];
        let (mut stages, mut list) = (vec![], vec![]);
        for params in params {
            // What the host makes of a pair depends on the widths and on the transform; on re-normalisation only in the
            // range of vertices that it moves itself.
            let plain = Params {
                width: params.width,
                int_bits: params.int_bits,
                transform_width: params.transform_width,
                transform: params.transform,
                ..Params::default()
            };
            let key = (plain, params.transform != Transform::On && params.renormalise);
            let known = keys.iter().position(|other| *other == key);
            list.push(Member { golden: Golden::new(params), stage: known.unwrap_or(keys.len()) });
            if known.is_none() {
                keys.push(key);
                stages.push(ReadyScene::new(front.scene(), params));
            }
        }
        Self { stages, list }
    }

    /// The objects of a meeting for each host.
    pub fn posed(&self, meeting: &Meeting) -> Vec<ReadyMeeting<'_>> {
        self.stages.iter().map(|stage| stage.posed(meeting)).collect()
    }

    /// The units at a meeting; `posed` is from [`posed`](Self::posed).
    pub fn at<'b>(&'b self, posed: &'b [ReadyMeeting<'b>]) -> Met<'a, 'b> {
        Met { units: self, posed, hosts: posed.iter().map(ReadyMeeting::host).collect() }
    }
}

impl Met<'_, '_> {
    /// The verdict of a unit, and whether the host has made it.
    pub fn answer(&self, unit: usize, pair: (u32, u32)) -> Answer {
        let Member { golden, stage } = &self.units.list[unit];
        self.host(*stage, pair).answer(golden, &self.hosts[*stage].pose)
    }

    /// Whether none of the 11 axes says anything of a pair: it is coplanar within the tolerance of the unit.
    fn is_coplanar(&self, unit: usize, pair: (u32, u32)) -> bool {
        let Member { golden, stage } = &self.units.list[unit];
        match self.host(*stage, pair) {
            Host::Unit(inputs) => {
                let outcome = golden.outcome(&self.hosts[*stage].pose, &inputs);
                (outcome.separated | outcome.overlapping) & ELEVEN == 0
            }
            Host::Decided(_) => false,
        }
    }

    fn host(&self, stage: usize, pair: (u32, u32)) -> Host {
        let [a, b] = self.posed[stage].faces(pair);
        self.hosts[stage].pair(a, b)
    }
}

/// What units answer; the first is the reference.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    pub tallies: Vec<Tally>,
    /// Pairs that are coplanar within the tolerance of the unit with 11 axes.
    pub coplanar: u64,
    /// Pairs that the unit with 17 axes decides and that with 11 does not.
    pub in_plane: u64,
}

impl Measured {
    fn new(units: usize) -> Self {
        Self { tallies: vec![Tally::default(); units], ..Self::default() }
    }

    fn merged(mut self, other: &Self) -> Self {
        self.tallies.iter_mut().zip(&other.tallies).for_each(|(x, y)| x.merge(y));
        self.coplanar += other.coplanar;
        self.in_plane += other.in_plane;
        self
    }
}

/// Asks units about all pairs that come to them; `in_plane` are the two that tell what the in-plane axes do, that with 17
/// axes first.
pub(super) fn measure(front: &Front<'_>, params: &[Params], in_plane: Option<[usize; 2]>) -> Measured {
    let units = Units::new(front, params);
    let mut total = Measured::new(params.len());
    let Ok(()) = front.near.frames_in_order(
        |frame, scratch| {
            let mut measured = Measured::new(params.len());
            for meeting in front.near.meetings(frame) {
                let mut at = None;
                front.near.pieces(&meeting, scratch, |pairs| {
                    if pairs.is_empty() {
                        return;
                    }
                    let posed = at.get_or_insert_with(|| units.posed(&meeting));
                    let met = units.at(posed);
                    let shares = pairs.par_chunks(SHARE).map(|pairs| share(front, &meeting, &met, pairs, in_plane));
                    let empty = || Measured::new(params.len());
                    let here = shares.reduce(empty, |x, y| x.merged(&y));
                    measured = std::mem::take(&mut measured).merged(&here);
                });
            }
            measured
        },
        |_, measured| {
            total = std::mem::take(&mut total).merged(&measured);
            Ok::<(), Infallible>(())
        },
    );
    total
}

fn share(
    front: &Front<'_>,
    meeting: &Meeting,
    met: &Met<'_, '_>,
    pairs: &[(u32, u32)],
    in_plane: Option<[usize; 2]>,
) -> Measured {
    let units = met.units.list.len();
    let mut measured = Measured::new(units);
    let mut verdicts = vec![Verdict::Separate; units];
    for &pair in pairs.iter().filter(|pair| !front.answers(meeting, **pair)) {
        for (unit, tally) in measured.tallies.iter_mut().enumerate() {
            let Answer { verdict, host_decided } = met.answer(unit, pair);
            verdicts[unit] = verdict;
            tally.add(verdict, verdicts[0]);
            tally.host_decided += u64::from(host_decided);
        }
        if let Some([with, without]) = in_plane
            && verdicts[without] == Verdict::PossiblyIncorrect
        {
            measured.coplanar += u64::from(met.is_coplanar(without, pair));
            measured.in_plane += u64::from(verdicts[with] != Verdict::PossiblyIncorrect);
        }
    }
    measured
}
