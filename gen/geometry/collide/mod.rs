//! Two meshes and a pose: all contacts of their triangles, exactly.
//!
//! A [`Collider`] is made once of two meshes and asked for any number of poses. A pose takes a point x of B to M x + t in the frame of
//! A; its twelve numbers are taken as they are, so that nothing is rounded before it is decided.
//!
//! ```
//! use efsat_geometry::{Collider, ContactKind, Mesh, Pose};
//!
//! let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let tetrahedron = Mesh::new(corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
//! let collider = Collider::new(&tetrahedron, &tetrahedron);
//!
//! // On top of it: the upper corner touches three faces below; one step of binary64 higher it does not.
//! let on_top = Pose::moved([0.0, 0.0, 1.0])?;
//! assert!(collider.contacts(&on_top).iter().all(|contact| contact.kind == ContactKind::Touching));
//! assert!(collider.first_contact(&on_top).is_some());
//! assert_eq!(collider.first_contact(&Pose::moved([0.0, 0.0, 1.0 + f64::EPSILON])?), None);
//!
//! // Many poses, by all cores.
//! let poses: Vec<Pose> = (0..100).map(|step| Pose::moved([0.01 * f64::from(step), 0.25, 0.25])).collect::<Result<_, _>>()?;
//! assert_eq!(collider.contacts_at(&poses).len(), 100);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod collider;
mod containment;
pub(crate) mod enclosure;
// For the engine, the command line and benchmarks.
#[doc(hidden)]
pub mod hierarchy;
pub(crate) mod pieces;
mod pose;
mod split;
mod tree;

pub use collider::{Body, Collider, Contact};
pub use containment::{Components, Nesting, Nestings, OpenEdge};
pub use pose::Pose;
// For the command line.
#[doc(hidden)]
pub use containment::nestings;
// For measurements of broad phases.
#[doc(hidden)]
pub use tree::{Candidates, Overlaps, Tree};
