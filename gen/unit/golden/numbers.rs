//! What the model computes with: enclosures of what the unit reads.

use super::interval::{Triple, Vector};

/// A pair and its pose as enclosures, in units of the last place of [`Params::input`](crate::params::Params::input).
#[derive(Clone, Debug)]
pub struct Numbers<M> {
    /// V0, V1, V2.
    pub a: Triple<M>,
    /// The vertices of B~.
    pub b: Triple<M>,
    /// M and t; none where B = B~.
    pub pose: Option<(Triple<M>, Vector<M>)>,
}
