//! The design: the paper's units as functions of bundles, from the interval operators to the top.
//!
//! One file per unit; the entity that is printed has the file's name. Reading order: [`interval`], [`product`] and
//! [`rounding`] (operators), [`cross_product`], [`axis_shift`], [`projection`], [`comparator`] (one axis), [`transform_row`],
//! [`edge_test`], [`renormalise`] (before the axes), [`guard`] (before those), [`pipeline`] (what is shared, and when; its axes in
//! `tested_axes`), [`sequencer`] and [`top`] (handshakes). [`determinants`] is the other data path, in place of `pipeline`.

// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod axes;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod axis_shift;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod comparator;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod cross_product;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod determinants;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod edge_test;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod exact;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod guard;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod interval;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod number;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod pipeline;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod product;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod projection;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod renormalise;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod rounding;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod sequencer;
pub(crate) mod slots;
mod tested_axes;
pub mod top;
// For the tests of units alone, and for the engine.
#[doc(hidden)]
pub mod transform_row;

pub use top::{Design, Probes};
