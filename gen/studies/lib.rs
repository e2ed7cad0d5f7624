//! What accuracy costs in time: sweeps over units and software, the planner of scenes, maps of verdicts, and their
//! pictures. Nothing here is needed to build a unit or to trust it.

pub mod accuracy;
// For the command line.
#[doc(hidden)]
pub mod engine_plan;
pub mod planner;
mod plot;
// For the command line and the accuracy campaign.
#[doc(hidden)]
pub mod times;
pub mod wall;
