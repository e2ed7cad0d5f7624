//! Bundles: anything made of signals, named, multiplexed, captured, probed and output as a whole.

use super::build::Sig;
use super::place::Step;

/// Values made of signals `S`, each at a place of its own.
pub trait Bundle<S>: Clone {
    /// The same bundle with every signal replaced. `path` leads to the bundle and is handed on with the steps to each
    /// signal.
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self;
}

/// A signal is the least bundle.
impl<'l> Bundle<Sig<'l>> for Sig<'l> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], Self) -> Self) -> Self {
        f(path, *self)
    }
}

impl<S, B: Bundle<S>> Bundle<S> for Option<B> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        self.as_ref().map(|bundle| bundle.map(path, f))
    }
}

/// Maps an element at a step further.
pub(super) fn element<S, B: Bundle<S>>(
    bundle: &B,
    step: Step,
    path: &mut Vec<Step>,
    f: &mut dyn FnMut(&[Step], S) -> S,
) -> B {
    path.push(step);
    let mapped = bundle.map(path, f);
    path.pop();
    mapped
}

impl<S, B: Bundle<S>> Bundle<S> for Vec<B> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        self.iter().enumerate().map(|(i, bundle)| element(bundle, Step::Index(i), path, f)).collect()
    }
}

impl<S, B: Bundle<S>, const N: usize> Bundle<S> for [B; N] {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        let mut each = self.iter().enumerate().map(|(i, bundle)| element(bundle, Step::Index(i), path, f));
        std::array::from_fn(|_| each.next().expect("as many as before"))
    }
}

/// Bundles beside each other, each at its own place: a tuple is no record.
impl<S, A: Bundle<S>, B: Bundle<S>> Bundle<S> for (A, B) {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        (self.0.map(path, f), self.1.map(path, f))
    }
}

/// Makes a struct of bundles, generic over the kind of signal, a [`Bundle`]: a record in VHDL.
#[macro_export]
macro_rules! record {
    ($(#[$doc:meta])* $name:ident $kind:literal { $($(#[$field_doc:meta])* $field:ident: $ty:ty),* $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name<S> { $($(#[$field_doc])* pub $field: $ty),* }

        impl<S: Copy> $crate::graph::Bundle<S> for $name<S>
        where
            $($ty: $crate::graph::Bundle<S>),*
        {
            fn map(
                &self,
                path: &mut Vec<$crate::graph::Step>,
                f: &mut dyn FnMut(&[$crate::graph::Step], S) -> S,
            ) -> Self {
                let mut places = 0..;
                let mut place = || places.next().unwrap_or(0);
                $(
                    path.push($crate::graph::Step::Field($kind, place(), stringify!($field)));
                    let $field = $crate::graph::Bundle::map(&self.$field, path, f);
                    path.pop();
                )*
                Self { $($field),* }
            }
        }
    };
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
