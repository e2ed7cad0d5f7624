//! The triangle-triangle intersection unit of EFSAT: from parameters to a design and its files, the reference model of its
//! answers, and the host's side of it.

pub mod artefact;
pub mod design;
pub mod dyadic;
pub mod golden;
pub mod host;
pub mod pair;
pub mod params;
pub mod parts;
pub mod words;
