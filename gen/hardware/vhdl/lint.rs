//! A check of printed VHDL for what strict analysers let through and XST does not take, or maps badly.
//!
//! The text is read anew, as tokens, without the modules it was printed from, so that a mistake of the printer is seen too.

mod file;
mod rules;
#[cfg(test)]
mod tests;

use file::File;
use rules::RULES;
use std::collections::HashMap;

/// A breach of a rule.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {message}")]
pub struct Finding {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Name of the rule.
    pub rule: &'static str,
    /// What was found, and what the rule expects.
    pub message: String,
}

/// All rules: name, and what is expected.
pub fn rules() -> Vec<(&'static str, &'static str)> {
    RULES.iter().map(|rule| (rule.0, rule.1)).collect()
}

/// Checks synthesizable files, given by name and text, a package before those that use it. Findings come by file and line.
pub fn lint(texts: &[(&str, &str)]) -> Vec<Finding> {
    let (mut findings, mut dimensions) = (vec![], HashMap::new());
    for (at, (name, text)) in texts.iter().enumerate() {
        let lower = text.to_ascii_lowercase();
        let file = File::new(&lower, &mut dimensions);
        for (rule, expected, breaches) in RULES {
            findings.extend(breaches(&file).into_iter().map(|(line, what)| {
                let message = format!("{what}; expected {expected}");
                (at, Finding { file: (*name).to_owned(), line, rule, message })
            }));
        }
    }
    findings.sort_by_key(|(at, finding)| (*at, finding.line));
    findings.into_iter().map(|(_, finding)| finding).collect()
}
