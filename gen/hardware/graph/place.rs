//! Names with structure: a base and the steps into a bundle.

use std::fmt::{self, Display, Formatter};

/// A step into a bundle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Step {
    /// An element of an array.
    Index(usize),
    /// A component of a vector: 0 is x.
    Component(usize),
    /// A field of a record: the kind of record, the place of the field in it, and its name.
    Field(&'static str, usize, &'static str),
    /// A companion of the bundle that is an object of its own, `{bundle}_{companion}`.
    Beside(&'static str),
}

/// A name: what a bundle is called, and which of its elements this is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Name of the bundle.
    pub base: String,
    /// Steps into it.
    pub path: Vec<Step>,
    /// What was made of it: `_floor`, `_d2`; may be empty.
    pub suffix: String,
}

impl Place {
    /// A name of its own.
    pub fn new(base: impl Into<String>) -> Self {
        Self { base: base.into(), ..Self::default() }
    }

    /// An element of a bundle.
    pub fn at(base: impl Into<String>, path: &[Step]) -> Self {
        let mut place = Self::new(base);
        for step in path {
            match step {
                Step::Beside(companion) => place.suffix.push_str(&format!("_{companion}")),
                other => place.path.push(*other),
            }
        }
        place
    }

    /// What was made of it.
    pub fn suffixed(&self, suffix: &str) -> Self {
        let separator = if suffix.is_empty() { "" } else { "_" };
        Self { suffix: format!("{}{separator}{suffix}", self.suffix), ..self.clone() }
    }

    /// Whether both are elements of one bundle.
    pub fn shares_bundle(&self, other: &Self) -> bool {
        (&self.base, &self.suffix) == (&other.base, &other.suffix) && !self.path.is_empty()
    }

    /// Of a copy of a held value: the suffix of that value, and by how many clocks the copy is loaded later.
    #[doc(hidden)]
    pub fn held(&self) -> Option<(&str, i32)> {
        let (suffix, clocks) = self.suffix.rsplit_once("_h")?;
        Some((suffix, clocks.parse().ok()?))
    }

    /// Whether there is no name yet.
    pub fn is_empty(&self) -> bool {
        self.base.is_empty()
    }
}

/// A step in a name of one word.
pub fn append_step(name: &mut String, step: Step) {
    match step {
        Step::Index(i) if name.ends_with(|c: char| c.is_ascii_digit()) => name.push_str(&format!("_{i}")),
        Step::Index(i) => name.push_str(&i.to_string()),
        Step::Component(c) => name.push_str(["_x", "_y", "_z"][c]),
        Step::Field(_, _, field) | Step::Beside(field) => {
            name.push('_');
            name.push_str(field);
        }
    }
}

/// All in one word: `e_a0_x_lo_d2`.
impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut name = self.base.clone();
        self.path.iter().for_each(|step| append_step(&mut name, *step));
        write!(f, "{name}{}", self.suffix)
    }
}
