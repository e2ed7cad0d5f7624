//! Samples of pairs that depend on a seed and on nothing else: not on threads, nor on the order of the pairs.

use super::Front;
use efsat_geometry::scene::Meeting;
use efsat_unit::artefact::Stimulus;
use efsat_unit::host::{Host, ReadyScene};
use efsat_unit::pair::{Pair, Verdict};
use efsat_unit::params::Params;

/// A pair of triangles of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The frame.
    pub frame: usize,
    /// The two objects.
    pub objects: (usize, usize),
    /// Their triangles.
    pub pair: (u32, u32),
}

impl Place {
    pub(super) fn new(meeting: &Meeting, pair: (u32, u32)) -> Self {
        Self { frame: meeting.frame, objects: (meeting.a, meeting.b), pair }
    }

    /// A number that looks random and is the same wherever the place comes up.
    pub(super) fn lot(&self, seed: u64) -> u64 {
        let (a, b) = self.objects;
        let parts = [self.frame as u64, a as u64, b as u64, u64::from(self.pair.0), u64::from(self.pair.1)];
        parts.into_iter().fold(mixed(seed), |state, part| mixed(state ^ part))
    }
}

/// Scatters the bits of a number, one to one (the finaliser of SplitMix64 behind its increment).
pub(super) fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Keeps the `limit` entries with the least keys.
#[derive(Clone, Debug)]
pub(super) struct Least<K, T> {
    limit: usize,
    entries: Vec<(K, T)>,
}

impl<K: Ord + Copy, T> Least<K, T> {
    pub fn new(limit: usize) -> Self {
        Self { limit, entries: vec![] }
    }

    /// Takes an entry; twice the limit is the most that is ever kept.
    pub fn add(&mut self, key: K, value: T) {
        self.entries.push((key, value));
        if self.entries.len() > 2 * self.limit {
            self.shrink();
        }
    }

    fn shrink(&mut self) {
        self.entries.sort_by_key(|(key, _)| *key);
        self.entries.truncate(self.limit);
    }

    /// What was kept, the least key first.
    pub fn list(mut self) -> Vec<(K, T)> {
        self.shrink();
        self.entries
    }
}

/// What a unit is driven with for some places, in their order, and what the host decides of them.
pub(super) fn stimulus(front: &Front<'_>, params: &Params, places: &[Place]) -> (Stimulus, Vec<Verdict>) {
    let stage = ReadyScene::new(front.scene(), params);
    let (mut stimulus, mut decided) = (Stimulus::default(), vec![]);
    for of_frame in places.chunk_by(|x, y| x.frame == y.frame) {
        let meetings = front.near.meetings(of_frame[0].frame);
        for group in of_frame.chunk_by(|x, y| x.objects == y.objects) {
            let Some(meeting) = meetings.iter().find(|m| (m.a, m.b) == group[0].objects) else { continue };
            let posed = stage.posed(meeting);
            let host = posed.host();
            let mut pairs: Vec<Pair> = vec![];
            for place in group {
                let [a, b] = posed.faces(place.pair);
                match host.pair(a, b) {
                    Host::Unit(pair) => pairs.push(pair),
                    Host::Decided(verdict) => decided.push(verdict),
                }
            }
            if !pairs.is_empty() {
                stimulus.segments.push((host.pose, pairs));
            }
        }
    }
    (stimulus, decided)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_are_kept_in_whatever_order_they_come() {
        let keys = (0..1000u64).map(mixed);
        let [mut forth, mut back] = [Least::new(10), Least::new(10)];
        keys.clone().for_each(|key| forth.add(key, ()));
        keys.clone().rev().for_each(|key| back.add(key, ()));
        let list = forth.list();
        assert_eq!(list, back.list());
        let mut sorted: Vec<u64> = keys.collect();
        sorted.sort_unstable();
        assert_eq!(list.iter().map(|(key, ())| *key).collect::<Vec<_>>(), sorted[..10]);
    }

    #[test]
    fn lots_depend_on_every_part_of_a_place() {
        let place = Place { frame: 1, objects: (0, 1), pair: (2, 3) };
        let others = [
            Place { frame: 2, ..place },
            Place { objects: (0, 2), ..place },
            Place { objects: (1, 1), ..place },
            Place { pair: (3, 2), ..place },
            Place { pair: (2, 2), ..place },
        ];
        assert!(others.iter().all(|other| other.lot(1) != place.lot(1)));
        assert_ne!(place.lot(1), place.lot(2));
    }
}
