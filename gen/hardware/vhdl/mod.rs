//! Prints any module hierarchy as strict VHDL-93 with `std_logic_1164` and `numeric_std` alone, and reads the text back
//! with a lint of its own.
//!
//! Everything is computed here; the template only prints. Ports are `std_logic` or `std_logic_vector`, signals inside
//! are `signed` and `unsigned`.

mod expression;
pub mod lint;
mod names;
mod view;

pub use names::{Clash, check};
pub use view::{Entity, entity};
