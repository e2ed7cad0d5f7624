//! What accuracy costs in time: a sweep of the design space over a scene, as a page, plots and data.
//!
//! A [`Request`] says what is asked for, a [`Plan`] lists the points, a [`Campaign`] asks every pair at every point and
//! keeps what it finds in a [`Store`], and [`Results`] joins that to what the page shows. Definitions, and how everything
//! is measured, are in docs/accuracy.md.

mod answers;
// For the command line.
#[doc(hidden)]
pub mod break_even;
// For the command line.
#[doc(hidden)]
pub mod budget;
// For the command line.
#[doc(hidden)]
pub mod campaign;
// For the command line.
#[doc(hidden)]
pub mod causes;
mod figures;
// For the command line.
#[doc(hidden)]
pub mod floor;
mod hardware;
mod headline;
mod join;
// For the command line.
#[doc(hidden)]
pub mod ladder;
mod page;
mod pairs;
mod plan;
mod point;
mod read;
mod results;
mod row;
// For the command line.
#[doc(hidden)]
pub mod store;
// For the command line.
#[doc(hidden)]
pub mod sweep;
mod table;
mod timing;
mod wilson;

// For the command line.
#[doc(hidden)]
pub use answers::{Answers, Share};
pub use campaign::{Campaign, Progress, Shard};
// For the command line.
#[doc(hidden)]
pub use hardware::{Cells, Hardware};
// For the command line.
#[doc(hidden)]
pub use join::Missing;
// For the command line.
#[doc(hidden)]
pub use page::{files, page};
// For the command line.
#[doc(hidden)]
pub use pairs::{Amount, MOST, Pairs, digest};
pub use plan::{Plan, Request};
// For the command line.
#[doc(hidden)]
pub use point::{Options, Point, options};
pub use results::Results;
// For the command line.
#[doc(hidden)]
pub use store::Store;
// For the command line.
#[doc(hidden)]
pub use timing::Timing;
// For the command line.
#[doc(hidden)]
pub use wilson::wilson;
