//! k-DOP trees: discretely oriented polytopes as bounding volumes, and which of their nodes can meet in a pose.
//!
//! All numbers of a tree and of a test are integers of a fixed number of bits. No pair of triangles with a common point
//! is ever lost; the proof is in `docs/hierarchy.md`.
//!
//! ```
//! use efsat_geometry::collide::hierarchy::{Directions, DopTree, Scratch, pairs};
//! use efsat_geometry::mesh::builtin;
//! use efsat_geometry::Pose;
//!
//! let mesh = builtin("headlight").unwrap();
//! let tree = DopTree::new(&mesh, Directions::Eighteen);
//! let (near, statistics) = pairs(&tree, &tree, &Pose::moved([0.0, 0.0, 1.0])?, &mut Scratch::default());
//! assert_eq!(near.len() as u64, statistics.pairs_tested);
//! # Ok::<(), efsat_geometry::NotFinite>(())
//! ```

mod contacts;
mod family;
mod local;
mod placement;
mod realign;
mod statistics;
mod traverse;
mod tree;

pub use crate::directions::Directions;
pub use contacts::{Contacts, contacts, rounded_contacts};
// For images of the engine.
#[doc(hidden)]
pub use local::{LocalBlock, LocalChild, LocalFormat, LocalTree};
pub use placement::Placement;
pub use statistics::Statistics;
pub use traverse::{Scratch, batches, first_hit, pairs, pieces};
pub use tree::DopTree;

#[cfg(test)]
mod tests;
