//! What accuracy costs in time: a sweep of the design space over a scene, as a page, plots and data.
//!
//! A [`Request`] says what is asked for, a [`Plan`] lists the points, a [`Campaign`] asks every pair at every point and
//! keeps what it finds in a [`Store`], and [`Results`] joins that to what the page shows. Definitions, and how everything
//! is measured, are in docs/accuracy.md.

mod answers;
pub mod break_even;
pub mod budget;
pub mod campaign;
pub mod causes;
mod figures;
pub mod floor;
mod hardware;
mod headline;
mod join;
pub mod ladder;
mod page;
mod pairs;
mod plan;
mod point;
mod read;
mod results;
mod row;
pub mod store;
pub mod sweep;
mod table;
mod timing;
mod wilson;

pub use answers::{Answers, Share};
pub use campaign::{Campaign, Progress, Shard};
pub use hardware::{Cells, Hardware};
pub use join::Missing;
pub use page::{files, page};
pub use pairs::{Amount, MOST, Pairs, digest};
pub use plan::{Plan, Request};
pub use point::{Options, Point, options};
pub use results::Results;
pub use store::Store;
pub use timing::Timing;
pub use wilson::wilson;
