//! Parameter sets and widths that are proved, and how the table names them.

use efsat::params::{Method, Params, Upper};

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

    /// Widths, and the rule for upper bounds where there are any.
    pub fn label(&self) -> String {
        let widths = format!("{}/{} bits", self.params.width, self.params.transform_width);
        match self.params.method {
            Method::Axes => format!("{widths}, {}", rule(self.params.upper)),
            Method::Determinants | Method::Exact => widths,
        }
    }
}

/// The rule for upper bounds, as the command line names it.
pub fn rule(upper: Upper) -> &'static str {
    match upper {
        Upper::Implied => "implied",
        Upper::Sticky => "sticky",
    }
}
