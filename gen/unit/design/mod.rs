//! The design: the paper's units as functions of bundles, from the interval operators to the top.
//!
//! One file per unit; the entity that is printed has the file's name. Reading order: [`interval`], [`product`] and
//! [`rounding`] (operators), [`cross_product`], [`axis_shift`], [`projection`], [`comparator`] (one axis), [`transform_row`],
//! [`edge_test`], [`renormalise`] (before the axes), [`guard`] (before those), [`pipeline`] (what is shared, and when; its axes in
//! `tested_axes`), [`sequencer`] and [`top`] (handshakes). [`determinants`] is the other data path, in place of `pipeline`.

pub mod axes;
pub mod axis_shift;
pub mod comparator;
pub mod cross_product;
pub mod determinants;
pub mod edge_test;
pub mod exact;
pub mod guard;
pub mod interval;
pub mod number;
pub mod pipeline;
pub mod product;
pub mod projection;
pub mod renormalise;
pub mod rounding;
pub mod sequencer;
pub(crate) mod slots;
mod tested_axes;
pub mod top;
pub mod transform_row;

pub use top::{Design, Probes};
