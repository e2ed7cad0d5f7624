//! Effects: which optional stages a scene calls for, and what the unit without the others answers.
//!
//! An effect is an optional stage of the unit or of the software before it ([`Effect`](efsat_unit::host::settings::Effect)). Whether a
//! scene needs one is measured with the reference model on all pairs that survive ([`plan`](fn@plan)); then the unit
//! without the others is run on the same pairs ([`run`](fn@run)). The rules are on a page of their own,
//! `docs/planner.md`.

mod bench;
mod census;
mod cosimulation;
mod cost;
#[doc(hidden)]
pub mod engine;
mod found;
mod front;
mod mark;
mod measure;
mod outcome;
#[doc(hidden)]
pub mod picture;
mod plan;
mod reason;
mod request;
mod run;
mod sample;
mod segment;
mod stages;
mod undecided;
mod viewer;
mod words;

pub use outcome::{Contact, Counted, Counts, Options, Row, Sampling, Sums, Total};
pub use plan::{Answers, Finding, Other, Plan, plan};
pub use request::{Request, Wish};
pub use run::{TooMany, frame_contacts, run};
// For the command line and the testbench.
#[doc(hidden)]
pub use self::{
    census::Census,
    cosimulation::Cosimulation,
    cost::{Cost, Saving},
    front::{Front, Software},
    measure::Tally,
    sample::Place,
    stages::Stages,
    undecided::Undecided,
    viewer::Viewer,
};
