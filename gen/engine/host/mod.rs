//! The host's side of the collision engine (docs/engine.md): images of trees, and the words of a query.
//!
//! ```
//! use efsat_geometry::mesh::headlight;
//! use efsat_engine::host::{Image, Numbers, memory};
//! use efsat_engine::model::Model;
//! use efsat_engine::params::EngineParams;
//!
//! let engine = EngineParams::default();
//! let unit = engine.unit();
//! let numbers = Numbers::new(&engine, &unit)?;
//! let image = Image::build(&[&headlight()], numbers.format())?.remove(0);
//!
//! // The mesh against itself, 60 units higher.
//! let (memory, sides) = memory(&[&image]);
//! let turned = [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]];
//! let query = numbers.query([(&image, sides[0]); 2], &turned, &[0.0, 0.0, 60.0])?;
//! let outcome = Model::new(&engine, &unit)?.run(&memory, &query.words(numbers.format()));
//! assert!(outcome.report.intersect > 0 && !outcome.report.reason.is_incomplete());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod check;
mod image;
mod layout;
mod numbers;
#[cfg(test)]
mod tests;

mod build;
mod images;
pub use build::BuildError;
pub use image::{Header, Image, ImageError, memory};
pub use images::Images;
// For the memory model of the testbench.
pub(crate) use image::LINE;
#[doc(hidden)]
pub use layout::{Layout, TRIANGLES_AT};
pub(crate) use numbers::FINE;
pub use numbers::{Numbers, Refusal};
