//! Parameter sets and widths that are proved, and how the table names them.

use efsat::params::{Params, Upper};

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

/// The rule for upper bounds, as the command line names it.
pub fn rule(upper: Upper) -> &'static str {
    match upper {
        Upper::Implied => "implied",
        Upper::Sticky => "sticky",
    }
}
