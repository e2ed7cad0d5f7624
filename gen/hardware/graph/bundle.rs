//! Bundles: anything made of signals, named, multiplexed, captured, probed and output as a whole.

use super::place::Step;

/// Values made of signals `S`, each at a place of its own.
pub trait Bundle<S>: Clone {
    /// The same bundle with every signal replaced. `path` leads to the bundle and is handed on with the steps to each
    /// signal.
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self;
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
