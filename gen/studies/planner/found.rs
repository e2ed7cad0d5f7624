//! What is found in a frame, before it is added up.

use super::Place;
use super::outcome::{Contact, Sums};

/// A frame, or a part of it.
#[derive(Default)]
pub(super) struct Found {
    pub sums: Sums,
    pub contacts: Vec<Contact>,
    /// By verdict: pairs by the lots drawn for them.
    pub strata: [Vec<(u64, Place)>; 3],
    /// Possibly incorrect pairs before close ones, by the lots drawn for them.
    pub near: Vec<((bool, u64), Place)>,
    pub all: Vec<Place>,
}

impl Found {
    /// Adds a later part.
    pub fn append(&mut self, mut other: Self) {
        self.sums.add(&other.sums);
        self.contacts.append(&mut other.contacts);
        self.strata.iter_mut().zip(&mut other.strata).for_each(|(mine, theirs)| mine.append(theirs));
        self.near.append(&mut other.near);
        self.all.append(&mut other.all);
    }

    /// Pairs that nothing shrinks.
    pub fn kept(&self) -> usize {
        self.contacts.len().max(self.all.len())
    }

    /// Keeps no more than can matter in the end.
    pub fn shrink(&mut self, stratified: usize, close: usize) {
        for stratum in &mut self.strata {
            stratum.sort_unstable();
            stratum.truncate(stratified);
        }
        self.near.sort_unstable();
        self.near.truncate(close);
    }
}
