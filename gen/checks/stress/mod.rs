//! The stress campaign: named families of hard pairs, each pair written in every way that must not change its answer,
//! and every definite answer compared with the exact one.
//!
//! A [`Family`] makes its cases from a seed and an index alone, so that any case can be replayed on its own. A
//! [`Campaign`] asks an [`Answerer`], normally the reference model, for every way to write a case (`variants`), on
//! other widths and options (`ladder`) and under a pose (`posed`). All these are the same pair of triangles, or a pair
//! with an exact answer of its own, so that one exact answer (`truth`) judges many verdicts. Since `separate` and
//! `intersect` are each compared with it, no two definite answers can contradict each other unnoticed.
//!
//! [`once`] asks very many cases, each as its family makes it, of many designs.

mod answerer;
mod campaign;
mod families;
mod fault;
mod hash;
mod ladder;
#[doc(hidden)]
pub mod once;
mod posed;
mod report;
mod truth;
mod variants;

pub use campaign::{Campaign, Plan};
pub use report::{Counts, Report};
// For the command line and the testbench.
#[doc(hidden)]
pub use self::{
    answerer::{Answerer, VertexOrder},
    families::{FAMILIES, Family},
    fault::{Asked, Fault, Kind},
    posed::{Motion, Posed},
    truth::Answers,
};
