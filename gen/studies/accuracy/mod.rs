//! What accuracy costs in time: a sweep of the design space over a scene, as a page, plots and data.
//!
//! A [`Request`] says what is asked for, a [`Plan`] lists the points, a [`Campaign`] asks every pair at every point and
//! keeps what it finds in a [`Store`], and [`Results`] joins that to what the page shows. Definitions, and how everything
//! is measured, are in docs/accuracy.md.

mod answers;
#[doc(hidden)]
pub mod break_even;
#[doc(hidden)]
pub mod budget;
#[doc(hidden)]
pub mod campaign;
#[doc(hidden)]
pub mod causes;
mod figures;
#[doc(hidden)]
pub mod floor;
mod hardware;
mod headline;
mod join;
#[doc(hidden)]
pub mod ladder;
mod page;
mod pairs;
mod plan;
mod point;
mod read;
mod results;
mod row;
#[doc(hidden)]
pub mod store;
#[doc(hidden)]
pub mod sweep;
mod table;
mod timing;
mod wilson;

pub use campaign::{Campaign, Progress, Shard};
pub use plan::{Plan, Request};
pub use results::Results;
// For the command line and the testbench.
#[doc(hidden)]
pub use self::{
    answers::{Answers, Share},
    hardware::{Cells, Hardware},
    join::Missing,
    page::{files, page},
    pairs::{Amount, MOST, Pairs, digest},
    point::{Options, Point, options},
    store::Store,
    timing::Timing,
    wilson::wilson,
};
