//! The design: builders of the paper's units, from the interval operators to the top.
//!
//! One file a unit, each a function from formats to a [`Unit`](efsat_hardware::graph::Unit); the entity that is printed has the
//! file's name. Reading order: [`interval`] and [`multiply`] (operators), [`cross_product`], [`projection`], [`comparator`] (one axis),
//! [`transform_row`], [`renormalise`] (before the axes), [`guard`] (before those), [`pipeline`] (what is shared, and when; its axes in
//! `axis_stage`), [`sequencer`] and [`top`] (handshakes).

pub mod axes;
mod axis_stage;
pub mod comparator;
pub mod cross_product;
pub mod guard;
pub mod interval;
pub mod multiply;
pub mod pipeline;
pub mod projection;
pub mod renormalise;
pub mod sequencer;
pub mod top;
pub mod transform_row;

pub use top::Design;
