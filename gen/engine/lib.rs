//! The collision engine of EFSAT (docs/engine.md): two trees of bounding volumes and a pose in, the pairs of triangles that touch out,
//! each tested by the unit in it.
//!
//! * [`params`], [`format`](mod@format) and [`words`]: its options, the formats that follow from them, and its words;
//! * [`model`]: the reference model of its answers;
//! * [`design`] and [`artefact`]: the volume unit, and the generated files; [`ready`] has those that lie in the repository;
//! * [`host`] and [`driver`]: images of meshes and words of queries, and the exact answer to a query.

pub mod artefact;
pub mod design;
pub mod driver;
pub mod format;
pub mod host;
pub mod model;
pub mod params;
pub mod ready;
pub mod words;
