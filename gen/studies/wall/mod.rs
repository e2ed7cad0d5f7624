//! Wall maps: verdicts around a contact, one vertex moved over a grid of single units in the last place.
//!
//! A [`Contact`] is two triangles that just touch, with the vertex to move and two directions; a [`Grid`] holds the
//! pairs of its cells, exactly; a [`Map`] is what some test answers on them. [`Report`] compares the map of the verdicts
//! with the exact one, and [`picture::png`] draws maps side by side.
//!
//! The idea is that of Kettner, Mehlhorn, Pion, Schirra and Yap, *Classroom examples of robustness problems in
//! geometric computations* (2008), who draw the signs that binary64 arithmetic gives to orientation determinants.

mod contact;
mod grid;
mod groups;
mod map;
#[doc(hidden)]
pub mod picture;
mod report;
mod step;

pub use map::{Answer, Map};
pub use report::{Band, Report};
// For the command line and the testbench.
#[doc(hidden)]
pub use self::{
    contact::{CONTACTS, Contact},
    grid::{Grid, SIZE},
    step::Step,
};

/// Why a map cannot be drawn. Each prints as one line.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum WallError {
    /// A step that is no word and no power of two.
    #[error("expected working, input, binary64 or a power of two from 2^-53 to 2^-7")]
    UnknownStep,
    /// Cells that leave the surroundings of the contact.
    #[error("contact {contact}: found a step of 2^{exponent} ({step}); expected 2^-7 at most")]
    Coarse {
        /// Name of the contact.
        contact: &'static str,
        /// What was asked for.
        step: Step,
        /// Binary exponent of the step.
        exponent: i32,
    },
}
