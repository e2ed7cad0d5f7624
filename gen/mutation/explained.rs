//! Equivalent mutants: what survives, and why no input whatever can tell it from the original.

/// A survivor and its explanation.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Name of the mutant; `*` stands for any text.
    pub pattern: &'static str,
    /// Why it is equivalent.
    pub reason: &'static str,
}

/// Mutants of the generated VHDL.
pub const VHDL: &[Explanation] = &[];

/// Mutants of the reference model.
pub const MODEL: &[Explanation] = &[];

/// The explanation of a mutant.
pub fn find(table: &'static [Explanation], name: &str) -> Option<&'static Explanation> {
    table.iter().find(|explanation| matches(explanation.pattern, name))
}

/// Whether a name has the form of a pattern in which `*` stands for any text.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((head, tail)) => {
            let Some(rest) = name.strip_prefix(head) else { return false };
            (0..=rest.len()).any(|i| rest.is_char_boundary(i) && matches(tail, &rest[i..]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_any_text() {
        assert!(matches("a:*_lo:case", "a:x_lo:case") && matches("*", "") && matches("a*b*c", "a-b-c"));
        assert!(!matches("a:*_lo", "a:x_lo:case") && !matches("a", "b") && !matches("a*b", "a"));
    }
}
