//! Legal names: the rules of VHDL-93, and the keywords of every language a design may meet.

mod keywords;

use keywords::LANGUAGES;
use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

/// Names of the packages in use that a signal must not hide.
const PACKAGES: &str = "ieee std work std_logic std_ulogic std_logic_vector std_ulogic_vector std_logic_1164 numeric_std \
    resize shift_left shift_right rotate_left rotate_right to_integer to_signed to_unsigned to_01 std_match rising_edge \
    falling_edge is_x to_bit to_x01 boolean bit bit_vector integer natural positive real time string character severity_level \
    true false note warning error failure now textio line";

/// All words that are taken, in lower case, and by what: of a keyword the first language that has it.
static TAKEN: LazyLock<HashMap<String, &str>> = LazyLock::new(|| {
    let mut taken = HashMap::new();
    for (why, words) in LANGUAGES.iter().chain(&[("is a name of the packages in use", PACKAGES)]) {
        words.split_ascii_whitespace().for_each(|word| _ = taken.entry(word.to_ascii_lowercase()).or_insert(*why));
    }
    taken
});

/// A name that some tool would refuse.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{module}: {name}: {why}")]
pub struct Clash {
    /// Module.
    pub module: String,
    /// Name.
    pub name: String,
    /// What is wrong with it.
    pub why: &'static str,
}

/// What is wrong with a name, if anything. Languages differ in whether case counts; here it never does.
pub fn fault(name: &str) -> Option<&'static str> {
    if let Some(why) = TAKEN.get(&name.to_ascii_lowercase()) {
        return Some(why);
    }
    if !name.chars().next().is_some_and(|c| c.is_ascii_lowercase()) {
        return Some("does not begin with a lower-case letter");
    }
    if !name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_') {
        return Some("has a character that is no lower-case letter, digit or underscore");
    }
    (name.ends_with('_') || name.contains("__")).then_some("has a trailing or double underscore")
}

/// Checks the names that an entity declares: expected form, no keyword, unique, and hiding nothing in use (all names are
/// lower case).
///
/// # Errors
/// The first name that is wrong.
pub(super) fn check<'a>(
    entity: &'a str,
    declared: impl Iterator<Item = &'a str>,
    in_use: &'a HashSet<String>,
) -> Result<(), Clash> {
    let clash = |name: &str, why| Clash { module: entity.to_owned(), name: name.to_owned(), why };
    let mut seen = HashSet::from(["clk", "rtl", entity]);
    for name in std::iter::once(entity).chain(declared) {
        if let Some(why) = fault(name) {
            return Err(clash(name, why));
        }
        if name != entity && (!seen.insert(name) || in_use.contains(name)) {
            return Err(clash(name, "is used twice"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn illegal_names_are_refused() {
        for name in ["", "_a", "a_", "a__b", "1a", "Axis", "a-b", "open", "signed", "wire", "resize", "view"] {
            assert!(fault(name).is_some(), "{name}");
        }
        assert_eq!(fault("axis_0_p1_x_lo"), None);
    }

    #[test]
    fn every_language_is_named_whatever_the_case() {
        let examples = [
            ("Signal", "is a keyword of VHDL-87"),
            ("GROUP", "is a keyword of VHDL-93"),
            ("protected", "is a keyword of VHDL-2000"),
            ("Context", "is a keyword of VHDL-2008"),
            ("View", "is a keyword of VHDL-2019"),
            ("Reg", "is a keyword of Verilog-2005"),
            ("Logic", "is a keyword of SystemVerilog"),
            ("Numeric_Std", "is a name of the packages in use"),
        ];
        for (name, why) in examples {
            assert_eq!(fault(name), Some(why), "{name}");
        }
    }

    #[test]
    fn a_clash_in_an_entity_is_told_by_entity_and_name() {
        let names = |name: &'static str| {
            let in_use = HashSet::from(["choose".to_owned()]);
            check("unit", [name].into_iter(), &in_use).map_err(|clash| clash.to_string())
        };
        assert_eq!(names("good"), Ok(()));
        assert_eq!(names("priority"), Err("unit: priority: is a keyword of SystemVerilog".to_owned()));
        assert_eq!(names("clk"), Err("unit: clk: is used twice".to_owned()));
        assert_eq!(names("choose"), Err("unit: choose: is used twice".to_owned()));
    }
}
