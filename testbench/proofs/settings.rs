//! Parameter sets and widths that are proved, and how the table names them.

use efsat::params::{Params, Upper};

/// Environment variable: `full` proves at greater widths than the tests take time for.
pub const EFFORT: &str = "EFSAT_PROOFS";

/// A parameter set whose units are proved.
pub struct Setting {
    /// Parameters.
    pub params: Params,
    /// Whether the widths are so small that true operands may be free beside the bounds. Else what is free is the true
    /// result, anywhere between the exact bounds.
    pub small: bool,
}

impl Setting {
    /// The default design, or another that is generated at full width.
    pub fn full(params: Params) -> Self {
        Self { params, small: false }
    }

    /// The same options at the least widths with fraction bits.
    pub fn small(params: Params) -> Self {
        Self { params: Params { width: 6, transform_width: 8, ..params }, small: true }
    }

    /// Widths and rule for upper bounds.
    pub fn label(&self) -> String {
        format!("{}/{} bits, {}", self.params.width, self.params.transform_width, rule(self.params.upper))
    }
}

/// Whether the greater widths are asked for.
///
/// # Panics
/// If the environment variable has another value than `quick` or `full`.
pub fn full() -> bool {
    match std::env::var(EFFORT).as_deref() {
        Err(_) | Ok("quick") => false,
        Ok("full") => true,
        Ok(other) => panic!("{EFFORT}={other}: expected quick and full"),
    }
}

/// The rule for upper bounds, as the command line names it.
pub fn rule(upper: Upper) -> &'static str {
    match upper {
        Upper::Implied => "implied",
        Upper::Sticky => "sticky",
    }
}
