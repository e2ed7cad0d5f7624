//! Bundles of graph signals: what is done with a bundle as a whole.

use super::block::Block;
use super::build::{Library, Sig, Top};
use super::bundle::Bundle;
use super::place::Step;
use crate::op::Select;
use std::rc::Rc;

/// A signal is the least bundle.
impl<'l> Bundle<Sig<'l>> for Sig<'l> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], Self) -> Self) -> Self {
        f(path, *self)
    }
}

impl Library {
    /// The block at the top, made by a function from the library to its outputs.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("sum", &["z = x + y"], 1, |top| {
    ///     let [x, y] = ["x", "y"].map(|name| top.input(NUMBER, (0, 9)).named(name));
    ///     (x + y).named("z")
    /// });
    /// assert_eq!(block.inputs.len(), 2);
    /// ```
    pub fn block<'l, R: Signals<'l>>(
        &'l self,
        name: &str,
        doc: &[&str],
        interval: usize,
        body: impl FnOnce(Top<'l>) -> R,
    ) -> Rc<Block> {
        let block = self.begin(name, doc, interval, interval);
        let outputs = body(Top::of(self, block)).signals();
        self.finish(block, &outputs)
    }
}

impl<'l> Sig<'l> {
    /// With this flag set the one, else the other.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[3, 4], |x| x[0].less(x[1]).choose([x[1], x[0]], [x[0], x[1]])[0]), 4);
    /// ```
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
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[3, 4], |x| { let twice = [x[0], x[1]].each(|_, x| x + x); twice[0] + twice[1] }), 14);
    /// ```
    fn each(&self, mut f: impl FnMut(&[Step], Sig<'l>) -> Sig<'l>) -> Self {
        self.map(&mut vec![], &mut f)
    }

    /// All signals, in order.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[3, 4], |x| {
    ///     assert_eq!([[x[0]; 2], [x[1]; 2]].signals(), [x[0], x[0], x[1], x[1]]);
    ///     x[0]
    /// });
    /// ```
    fn signals(&self) -> Vec<Sig<'l>> {
        let mut all = vec![];
        self.each(|_, signal| {
            all.push(signal);
            signal
        });
        all
    }

    /// The bundle with its signals taken from elsewhere, in order.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(value(&[3, 4], |x| { let [first, _] = [x[0]; 2].with([x[1], x[0]]); first + x[0].like(0) }), 4);
    /// ```
    fn with(&self, signals: impl IntoIterator<Item = Sig<'l>>) -> Self {
        let mut signals = signals.into_iter();
        self.each(|_, _| signals.next().expect("as many signals as before"))
    }

    /// Names all signals after the bundle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[3], |x| {
    ///     let both = [x[0] + x[0], x[0] * x[0]].named("both");
    ///     assert_eq!(format!("{both:?}"), "[both0, both1]");
    ///     both[0]
    /// });
    /// ```
    fn named(self, base: &str) -> Self {
        self.each(|path, signal| signal.set_name(base, path))
    }

    /// Names all signals after one of several bundles.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[3], |x| {
    ///     assert_eq!(format!("{:?}", (x[0] + x[0]).named_at("sum", 7)), "sum7");
    ///     x[0]
    /// });
    /// ```
    fn named_at(self, base: &str, index: usize) -> Self {
        self.map(&mut vec![Step::Index(index)], &mut |path, signal| signal.set_name(base, path))
    }

    /// Says what it is: the equation, with its source.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("copy", &[], 1, |top| top.input(NUMBER, (0, 9)).named("x").comment("equation 2"));
    /// assert_eq!(block.nodes[0].comment, "equation 2");
    /// ```
    fn comment(self, text: &str) -> Self {
        self.each(|_, signal| signal.set_comment(text))
    }

    /// Brings the bundle out of a probed design; per-phase values in the phases given, late ones marked.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let library = Library::default();
    /// let block = library.block("copy", &[], 1, |top| top.input(NUMBER, (0, 9)).named("x").probe(&[(0, false)]));
    /// assert_eq!(block.probes.len(), 1);
    /// ```
    fn probe(self, phases: &[(usize, bool)]) -> Self {
        self.each(|_, signal| signal.set_probe(phases))
    }

    /// A bound that interval ranges cannot see, on every signal.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// value(&[3], |x| {
    ///     assert_eq!(x[0].assume(7, "x is small").range(), (-7, 7));
    ///     x[0]
    /// });
    /// ```
    fn assume(self, bound: i128, lemma: &'static str) -> Self {
        self.assume_in(&[], bound, lemma)
    }

    /// The same in the phases marked.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// evaluated(2, &[3, 900], |x| {
    ///     let shared = Phases::new(2, |s| Some(x[s])).mux().assume_in(&[true, false], 7, "the first is small");
    ///     assert_eq!(shared.capture(0, false).range(), (-7, 7));
    ///     shared
    /// });
    /// ```
    fn assume_in(self, phases: &[bool], bound: i128, lemma: &'static str) -> Self {
        self.each(|_, signal| signal.assume_range((-bound, bound), lemma, phases))
    }

    /// The value of the bundle some phases before.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let before = evaluated(3, &[3, 4, 5], |x| Phases::new(3, |s| Some(x[s])).mux().earlier(1));
    /// assert_eq!(before[1..], [3, 4]);
    /// ```
    fn earlier(&self, phases: usize) -> Self {
        self.each(|_, signal| signal.earlier_signal(phases))
    }

    /// The value of a phase, held for the pair.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(evaluated(2, &[3, 4], |x| Phases::new(2, |s| Some(x[s])).mux().capture(1, false))[0], 4);
    /// ```
    fn capture(&self, phase: usize, late: bool) -> Self {
        self.each(|_, signal| signal.capture_signal(phase, late))
    }
}

impl<'l, B: Bundle<Sig<'l>>> Signals<'l> for B {}
