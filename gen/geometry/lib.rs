//! Exact answers for triangles and meshes in binary64, which is taken as it is given: nothing is rounded, no tolerance.
//!
//! * A pair of triangles: [`Pair`]; many at once: [`software::retest`].
//! * Two meshes and a pose: [`Collider`]. As solids: [`Solid`](solids::Solid). One mesh against itself: [`self_intersections`].
//!   Files: [`mesh::read`].
//! * What checks these: [`exact`], the oracle, and [`software`], published tests.
//!
//! Numbers that are infinite or no number are refused where a [`Pair`], a [`Mesh`] or a [`Pose`] is made.
//!
//! ```
//! use efsat_geometry::{Collider, ContactKind, Mesh, Pair, Pose};
//!
//! let square = Mesh::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2], [0, 2, 3]])?;
//! let quarter_turn = Pose::from_rows([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]], [0.0, 0.25, -0.5])?;
//! let contacts = Collider::new(&square, &square).contacts(&quarter_turn);
//! assert_eq!(contacts.iter().filter(|contact| contact.kind == ContactKind::Crossing).count(), 3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "meshes")]
pub mod collide;
pub mod directions;
pub mod exact;
pub mod finite;
// For the readers of the engine and the command line.
#[doc(hidden)]
pub mod input;
#[cfg(feature = "meshes")]
pub mod mesh;
mod pair;
pub mod pair_file;
mod power;
#[cfg(feature = "samples")]
pub mod sample;
#[cfg(feature = "scenes")]
pub mod scene;
#[cfg(feature = "meshes")]
pub mod self_intersections;
pub mod software;
#[cfg(feature = "meshes")]
pub mod solids;

#[cfg(feature = "meshes")]
pub use collide::{Body, Collider, Contact, Pose};
pub use exact::ContactKind;
pub use finite::NotFinite;
#[cfg(feature = "meshes")]
pub use mesh::Mesh;
pub use pair::Pair;
// What meshes and poses are made of.
pub use nalgebra;

/// A pair of triangles: a0 a1 a2 b0 b1 b2, each x y z. What takes one refuses numbers that are not finite.
pub type Points = [[f64; 3]; 6];

/// The examples of the page.
#[cfg(doctest)]
#[doc = include_str!("../../docs/exact-software.md")]
struct Page;

/// How often a test tries something: a share on every change, `all` with `EFSAT_TESTS=full`, which `scripts/test full` sets.
#[cfg(test)]
fn rounds(all: usize) -> usize {
    if std::env::var_os("EFSAT_TESTS").is_some() { all } else { all / 4 }
}
