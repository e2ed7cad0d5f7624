//! What stands before the names of a design, so that two designs can live in one library.

use efsat_hardware::vhdl;
use std::fmt;

/// The most characters of a name: file names stay short.
const LONGEST: usize = 40;

/// A name of the user's that stands with an underscore before the name of every entity, package and file; or nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Prefix(Option<String>);

/// A name that cannot stand before others.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("'{found}' {why}; expected a VHDL identifier of at most {LONGEST} lower-case letters, digits and underscores")]
pub struct PrefixError {
    found: String,
    why: &'static str,
}

impl Prefix {
    /// The prefix of a name.
    ///
    /// # Errors
    /// A name that is no identifier, or a keyword of a language that the design may meet.
    pub fn new(name: &str) -> Result<Self, PrefixError> {
        let long = (name.len() > LONGEST).then_some("is too long");
        match long.or_else(|| vhdl::fault(name)) {
            None => Ok(Self(Some(name.to_owned()))),
            Some(why) => Err(PrefixError { found: name.to_owned(), why }),
        }
    }

    /// A name with the prefix before it.
    pub fn of(&self, name: &str) -> String {
        format!("{self}{name}")
    }

    /// The name as it was typed, if there is one.
    pub fn name(&self) -> Option<&str> {
        self.0.as_deref()
    }
}

impl fmt::Display for Prefix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|name| write!(f, "{name}_"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stands_before_others() {
        assert_eq!(Prefix::default().of("efsat"), "efsat");
        assert_eq!(Prefix::new("left_arm").unwrap().of("efsat"), "left_arm_efsat");
    }

    #[test]
    fn names_that_vhdl_does_not_take_are_refused_with_the_reason() {
        let message = |name: &str| Prefix::new(name).unwrap_err().to_string();
        let expected = "expected a VHDL identifier of at most 40 lower-case letters, digits and underscores";
        assert_eq!(message("signal"), format!("'signal' is a keyword of VHDL-87; {expected}"));
        for name in ["", "1st", "Left", "a-b", "a_", "a__b", "work", "module", &"a".repeat(41)] {
            assert!(message(name).starts_with(&format!("'{name}' ")), "{name}");
        }
    }
}
