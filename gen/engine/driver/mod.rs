//! The host's side of the collision engine: which triangles of two meshes touch, exactly.
//!
//! [`Objects`] holds meshes as one engine needs them: their images, which are copied to its memory once, and what the software
//! needs to answer without it. [`Objects::query`] makes a [`Job`] from two of them and a pose: the words of a packet.
//! [`Job::finish`] takes the words that came back and gives [`Contacts`]. The answer is exact whatever the engine says of
//! itself: pairs that it calls possibly incorrect are retested, and a query that it refuses or reports as *incomplete* is
//! answered in software. [`Objects::pairs`] and [`Objects::pairs_of_one`] make a [`PairsJob`] of pairs that the host names, for an engine
//! that takes pairs by number. [`UnitPackets`] has the packets of pairs and poses, which the engine takes between queries. How words
//! get to the engine and back is the user's; [`Engine`] is a short way to say it, and [`StandIn`] answers as the reference
//! model does.
//!
//! ```
//! use efsat_geometry::mesh::headlight;
//! use efsat_geometry::scene::{Pose, Scene};
//! use efsat_engine::driver::{Objects, QueryOptions, StandIn};
//! use efsat_engine::params::EngineParams;
//!
//! let engine = EngineParams::default();
//! let unit = engine.unit();
//! let mesh = headlight();
//! let objects = Objects::new(&engine, &unit, &[&mesh])?;
//! let mut stand_in = StandIn::new(&objects)?;
//!
//! // The mesh against itself, in a pose in which few of its triangles touch, and in one in which none do.
//! let near = Scene::default_scene().frame(823).poses[1];
//! let far = Pose::new(near.rotation(), 100.0 * near.translation())?;
//! let jobs = [near, far].map(|pose| objects.query([0, 0], &pose, QueryOptions::default()));
//! let contacts = objects.contacts(jobs.to_vec(), &mut stand_in)?;
//! assert!(contacts[0].touching().count() == 22 && contacts[0].software.is_none());
//! // So far away that the words of a query do not hold it: the software has answered.
//! assert!(contacts[1].touching().count() == 0 && contacts[1].software.is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod by_number;
mod job;
mod objects;
mod packets;
mod stand_in;
#[cfg(test)]
mod tests;

pub use by_number::PairsJob;
pub use job::{Cause, Contact, Contacts, Job};
pub use objects::{Objects, ObjectsError, QueryOptions};
pub use packets::UnitPackets;
pub use stand_in::StandIn;

/// What answers packets: an engine behind its stream, a simulation of one, or the reference model.
pub trait Engine {
    /// Why it does not.
    type Error: From<EngineError>;

    /// The words of the answers to some packets, in their order; those to queries in any order, as several engines give them.
    ///
    /// # Errors
    /// If words cannot be sent or received.
    fn answer(&mut self, packets: &[&[u64]]) -> Result<Vec<Vec<u64>>, Self::Error>;
}

/// What came back is no answer to what was sent.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EngineError {
    /// More or fewer answers than packets.
    #[error("found {found} answers; expected {expected}, one for each packet")]
    Answers {
        /// Answers found.
        found: usize,
        /// Packets sent.
        expected: usize,
    },
    /// An answer to a query that was not sent.
    #[error("found an answer; expected none, because no packet was sent")]
    NotSent,
    /// An answer that does not end with a report.
    #[error("found {words} words without a report; expected a report in the last 8")]
    NoReport {
        /// Words found.
        words: usize,
    },
    /// A report for another query.
    #[error("found the report of query {found}; expected that of query {expected}")]
    Number {
        /// The number in the report.
        found: u32,
        /// The number that was sent.
        expected: u32,
    },
    /// A word that is no pair of triangles of the two objects that touch or may touch.
    #[error("word {at}: found {word:#018x}; expected a pair of triangles")]
    Word {
        /// Its place in the answer.
        at: usize,
        /// The word.
        word: u64,
    },
    /// A pair of triangles that is answered twice.
    #[error("found triangles {} and {} twice; expected each pair once", triangles[0], triangles[1])]
    Twice {
        /// The faces of the two meshes.
        triangles: [u32; 2],
    },
    /// The report counts other pairs than those that came.
    #[error("found {found} pairs; expected {expected}, as the report says")]
    Count {
        /// Pairs found.
        found: u64,
        /// Pairs that the report counts.
        expected: u64,
    },
}
