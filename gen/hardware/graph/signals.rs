//! Bundles of graph signals: what is done with a bundle as a whole.

use super::build::{Library, Sig, Top};
use super::bundle::Bundle;
use super::place::Step;
use super::unit::Unit;
use crate::op::Select;
use std::rc::Rc;

/// A signal is the least bundle.
impl<'l> Bundle<Sig<'l>> for Sig<'l> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], Self) -> Self) -> Self {
        f(path, *self)
    }
}

impl Library {
    /// The unit at the top, made by a function from the library to its outputs.
    pub fn unit<'l, R: Signals<'l>>(
        &'l self,
        name: &str,
        doc: &[&str],
        interval: usize,
        body: impl FnOnce(Top<'l>) -> R,
    ) -> Rc<Unit> {
        let unit = self.begin(name, doc, interval, interval);
        let outputs = body(Top::of(self, unit)).signals();
        self.finish(unit, &outputs)
    }
}

impl<'l> Sig<'l> {
    /// With this flag set the one, else the other.
    pub fn choose<B: Signals<'l>>(self, set: B, clear: B) -> B {
        let clear = clear.signals();
        let mut i = 0;
        set.each(|_, set| {
            i += 1;
            self.apply(Select::default(), &[clear[i - 1], set])
        })
    }
}

/// What can be done with any bundle of graph signals.
pub trait Signals<'l>: Bundle<Sig<'l>> {
    /// The bundle with every signal replaced, each with the steps to it.
    fn each(&self, mut f: impl FnMut(&[Step], Sig<'l>) -> Sig<'l>) -> Self {
        self.map(&mut vec![], &mut f)
    }

    /// All signals, in order.
    fn signals(&self) -> Vec<Sig<'l>> {
        let mut all = vec![];
        self.each(|_, signal| {
            all.push(signal);
            signal
        });
        all
    }

    /// The bundle with its signals taken from elsewhere, in order.
    fn with(&self, signals: impl IntoIterator<Item = Sig<'l>>) -> Self {
        let mut signals = signals.into_iter();
        self.each(|_, _| signals.next().expect("as many signals as before"))
    }

    /// Names all signals after the bundle.
    fn named(self, base: &str) -> Self {
        self.each(|path, signal| signal.set_name(base, path))
    }

    /// Names all signals after one of several bundles.
    fn named_at(self, base: &str, index: usize) -> Self {
        self.map(&mut vec![Step::Index(index)], &mut |path, signal| signal.set_name(base, path))
    }

    /// Says what it is: the equation, with its source.
    fn comment(self, text: &str) -> Self {
        self.each(|_, signal| signal.set_comment(text))
    }

    /// Brings the bundle out of a probed design; per-phase values in the phases given, late ones marked.
    fn probe(self, phases: &[(usize, bool)]) -> Self {
        self.each(|_, signal| signal.set_probe(phases))
    }

    /// A bound that interval ranges cannot see, on every signal.
    fn assume(self, bound: i128, lemma: &'static str) -> Self {
        self.assume_in(&[], bound, lemma)
    }

    /// The same in the phases marked.
    fn assume_in(self, phases: &[bool], bound: i128, lemma: &'static str) -> Self {
        self.each(|_, signal| signal.assume_range((-bound, bound), lemma, phases))
    }

    /// The value of the bundle some phases before.
    fn earlier(&self, phases: usize) -> Self {
        self.each(|_, signal| signal.earlier_signal(phases))
    }

    /// The value of a phase, held for the pair.
    fn capture(&self, phase: usize, late: bool) -> Self {
        self.each(|_, signal| signal.capture_signal(phase, late))
    }
}

impl<'l, B: Bundle<Sig<'l>>> Signals<'l> for B {}
