//! Parameter sets and widths that are proved, and how the table names them.

use efsat::number::Upper;
use efsat::params::{Params, Projections};

/// Environment variable: `full` proves at greater widths than the tests take time for.
pub const EFFORT: &str = "EFSAT_PROOFS";

/// A parameter set whose units are proved.
pub struct Setting {
    /// Parameters.
    pub params: Params,
}

/// Whether the greater widths are asked for.
///
/// # Panics
/// If the environment variable has another value than `quick` or `full`.
pub fn full() -> bool {
    match std::env::var(EFFORT).as_deref() {
        Err(_) | Ok("quick") => false,
        Ok("full") => true,
        Ok(other) => panic!("{EFFORT}={other}: legal are quick and full"),
    }
}

/// The rule for upper bounds, as the command line names it.
pub fn rule(upper: Upper) -> &'static str {
    match upper {
        Upper::Implied => "implied",
        Upper::Sticky => "sticky",
    }
}

/// Widths and rule of a parameter set.
pub fn label(params: &Params) -> String {
    format!("{}/{} {}", params.width, params.transform_width, rule(params.upper))
}
