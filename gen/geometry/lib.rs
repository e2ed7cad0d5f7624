//! Triangles in binary64, taken as exact reals: the exact answer, published tests in software, files and seeded samples of
//! pairs; with the feature `scenes` also meshes and what moves.

pub mod directions;
pub mod exact;
pub mod finite;
#[doc(hidden)]
pub mod input;
#[cfg(feature = "scenes")]
pub mod mesh;
pub mod pair_file;
mod power;
pub mod sample;
#[cfg(feature = "scenes")]
pub mod scene;
#[cfg(feature = "scenes")]
pub mod self_intersections;
pub mod software;

pub use finite::NotFinite;

/// A pair of triangles: a0 a1 a2 b0 b1 b2, each x y z. What takes one refuses numbers that are not finite.
pub type Points = [[f64; 3]; 6];
