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
// For the command line.
#[doc(hidden)]
pub mod once;
mod posed;
mod report;
mod truth;
mod variants;

// For the testbench.
#[doc(hidden)]
pub use answerer::{Answerer, VertexOrder};
pub use campaign::{Campaign, Plan};
// For the testbench.
#[doc(hidden)]
pub use families::{FAMILIES, Family};
// For the testbench.
#[doc(hidden)]
pub use fault::{Asked, Fault, Kind};
// For the testbench.
#[doc(hidden)]
pub use posed::{Motion, Posed};
pub use report::{Counts, Report};
// For the testbench.
#[doc(hidden)]
pub use truth::Answers;
