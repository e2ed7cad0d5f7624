//! Netlists: scheduled blocks as clocked modules, control logic written as such, and their simulation.

mod control;
pub mod lower;
mod module;
pub mod simulate;

pub use control::{Control, Wire};
pub use module::{DelayLine, Driver, Instance, LEAST_DELAY_LINE, LINE_CLOCKS, Module, Signal, SignalId};
