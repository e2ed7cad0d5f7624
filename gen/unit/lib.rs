//! The triangle-triangle intersection unit of EFSAT: from parameters to a design and its files, the reference model of its
//! answers, and the host's side of it.

pub mod artefact;
pub mod design;
// For the engine and the studies: exact binary fractions.
#[doc(hidden)]
pub mod dyadic;
pub mod golden;
pub mod host;
pub mod pair;
pub mod params;
// For the engine alone.
#[doc(hidden)]
pub mod parts;
pub mod words;
