//! The collision engine of EFSAT (docs/engine.md): two trees of bounding volumes and a pose in, the pairs of triangles that touch out,
//! each tested by the unit in it.
//!
//! * [`params`] and [`words`]: its options, and its words;
//! * [`model`]: the reference model of its answers;
//! * [`artefact`]: the generated files; [`ready`] has those that lie in the repository;
//! * [`host`] and [`driver`]: images of meshes and words of queries, and the exact answer to a query.

pub mod artefact;
// For the tests of units alone.
#[doc(hidden)]
pub mod design;
pub mod driver;
// For the command line and the testbench: what follows from the options.
#[doc(hidden)]
pub mod format;
pub mod host;
pub mod model;
pub mod params;
pub mod ready;
pub mod words;
