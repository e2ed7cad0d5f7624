//! Time sharing: a value for each phase of the slot.

use super::block::Rate;
use super::build::{Sig, Top};
use super::signals::Signals;
use crate::op::Type;

/// What a shared block works on in each phase; nothing in idle ones. *Late* phases belong to the pair whose slot began a
/// whole number of intervals earlier: they read results of early phases.
#[derive(Clone, Debug, PartialEq)]
pub struct Phases<T> {
    of: Vec<Option<(T, bool)>>,
}

impl<T> Phases<T> {
    /// What is worked on in each of `interval` phases.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let phases = Phases::new(3, |s| (s > 0).then_some(10 * s));
    /// assert_eq!(phases.get(2), Some(&20));
    /// ```
    pub fn new(interval: usize, f: impl FnMut(usize) -> Option<T>) -> Self {
        Self { of: (0..interval).map(f).map(|x| x.map(|x| (x, false))).collect() }
    }

    /// Marks late phases.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let phases = Phases::new(2, |s| Some(s)).late(|s| *s == 1);
    /// assert_eq!(phases.meaning(), [(0, false), (1, true)]);
    /// ```
    pub fn late(mut self, f: impl Fn(&T) -> bool) -> Self {
        self.of.iter_mut().flatten().for_each(|(x, late)| *late = f(x));
        self
    }

    /// A function of what is worked on in each phase.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(2, Some).map(|s| s + 5).get(1), Some(&6));
    /// ```
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> Phases<U> {
        self.filter_map(|x| Some(f(x)))
    }

    /// The same, with phases that fall idle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(2, Some).filter_map(|s| (*s > 0).then_some(s + 5)).marks(), [false, true]);
    /// ```
    pub fn filter_map<U>(&self, mut f: impl FnMut(&T) -> Option<U>) -> Phases<U> {
        let each = |x: &Option<(T, bool)>| x.as_ref().and_then(|(x, late)| Some((f(x)?, *late)));
        Phases { of: self.of.iter().map(each).collect() }
    }

    /// The phases that are not idle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(3, |s| (s > 1).then_some("c")).busy().collect::<Vec<_>>(), [(2, &"c")]);
    /// ```
    pub fn busy(&self) -> impl Iterator<Item = (usize, &T)> {
        self.of.iter().enumerate().filter_map(|(s, x)| x.as_ref().map(|(x, _)| (s, x)))
    }

    /// Whether all phases are idle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert!(Phases::<i128>::new(3, |_| None).idle());
    /// ```
    pub fn idle(&self) -> bool {
        self.of.iter().all(Option::is_none)
    }

    /// The phases that are not idle, with which of them are late ones: where a value has a meaning.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(3, |s| (s != 1).then_some(s)).meaning(), [(0, false), (2, false)]);
    /// ```
    pub fn meaning(&self) -> Vec<(usize, bool)> {
        self.of.iter().enumerate().filter_map(|(s, x)| x.as_ref().map(|(_, late)| (s, *late))).collect()
    }

    /// Which phases are not idle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(3, |s| (s != 1).then_some(s)).marks(), [true, false, true]);
    /// ```
    pub fn marks(&self) -> Vec<bool> {
        self.of.iter().map(Option::is_some).collect()
    }

    /// What is in a phase.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Phases::new(3, |s| (s != 1).then_some(s)).get(1), None);
    /// ```
    pub fn get(&self, phase: usize) -> Option<&T> {
        self.of[phase].as_ref().map(|(x, _)| x)
    }

    /// A value captured in every phase that is not idle, with what was worked on.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// evaluated(2, &[3, 4], |x| {
    ///     let phases = Phases::new(2, |s| Some(x[s]));
    ///     let twice = phases.mux().shift_left(1);
    ///     let held: Vec<_> = phases.capture(&twice).map(|(_, value)| value).collect();
    ///     held[0] + held[1]
    /// });
    /// ```
    pub fn capture<'l, 'a, B: Signals<'l>>(&'a self, value: &'a B) -> impl Iterator<Item = (&'a T, B)> {
        let busy = self.of.iter().enumerate().filter_map(|(s, x)| x.as_ref().map(|x| (s, x)));
        busy.map(move |(s, (x, late))| (x, value.capture(s, *late)))
    }
}

impl Phases<i128> {
    /// A constant of each phase. Idle phases repeat the first busy one, as the operands of idle phases do, so that what a
    /// block computes there is in range too.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let weights = Phases::new(3, |s| (s != 1).then_some(2 + s as i128));
    /// assert_eq!(evaluated(3, &[5], |x| weights.constant(x[0].block(), NUMBER)), [2, 2, 4]);
    /// ```
    pub fn constant<'l>(&self, block: Top<'l>, ty: Type) -> Sig<'l> {
        let first = self.busy().next().map(|(_, x)| *x);
        block.pattern((0..self.of.len()).map(|s| self.get(s).copied().or(first)).collect(), ty)
    }
}

impl<'l, B: Signals<'l>> Phases<B> {
    /// One operand for each phase: a multiplexer for each signal of the bundle, operands that are equal shared.
    ///
    /// # Panics
    /// If all phases are idle.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(evaluated(3, &[5, 6], |x| Phases::new(3, |s| Some(x[s % 2])).mux()), [5, 6, 5]);
    /// ```
    pub fn mux(&self) -> B {
        // The different operands, and which of them each phase takes.
        let mut operands: Vec<(Vec<Sig<'l>>, bool)> = vec![];
        let take = |x: &Option<(B, bool)>| {
            x.as_ref().map(|(bundle, late)| {
                let operand = (bundle.signals(), *late);
                operands.iter().position(|known| *known == operand).unwrap_or_else(|| {
                    operands.push(operand);
                    operands.len() - 1
                })
            })
        };
        let taken: Vec<Option<usize>> = self.of.iter().map(take).collect();
        let any = self.busy().next().expect("expected a phase that is not idle").1;
        let Some(first) = any.signals().first().copied() else { return any.clone() };
        // What never changes and is the same in all phases stays what it is.
        if operands.len() == 1 && operands[0].0.iter().all(|signal| signal.rate() == Rate::Any) {
            return any.clone();
        }
        let block = first.block();
        let select = block.pattern(taken.iter().map(|t| t.map(|t| t as i128)).collect(), Type::index(operands.len()));
        let mut signals = 0..;
        any.each(|_, signal| {
            let i = signals.next().unwrap_or(0);
            let each: Vec<(Sig<'l>, bool)> = operands.iter().map(|(all, late)| (all[i], *late)).collect();
            let range = |(s, t): (usize, &Option<usize>)| {
                let ranges = each[t.unwrap_or(0)].0.ranges();
                ranges[s % ranges.len()]
            };
            signal.mux(select, &each, taken.iter().enumerate().map(range).collect())
        })
    }
}
