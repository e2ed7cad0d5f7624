//! A lint for what strict analysers let through and XST does not take: the rules of the target, on the printed text.
//!
//! The text is read anew, without the modules it was printed from, so that a mistake of the printer is seen too.

mod across;
mod outline;
mod rules;
mod token;

#[cfg(test)]
mod tests;

use outline::Outline;

/// A breach of a rule.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {rule}: {message}")]
pub struct Finding {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Name of the rule.
    pub rule: &'static str,
    /// What was found.
    pub message: String,
}

/// All rules: name, and what is demanded.
pub fn rules() -> Vec<(&'static str, &'static str)> {
    rules::RULES.iter().map(|rule| (rule.name, rule.demands)).chain(across::RULES).collect()
}

/// Checks synthesizable files (name and text), instantiated entities before those that use them. Findings come by file
/// and line.
pub fn lint(files: &[(&str, &str)]) -> Vec<Finding> {
    let outlines: Vec<Outline> = files.iter().map(|(_, text)| Outline::new(text)).collect();
    let mut found = across::check(&outlines);
    for (file, outline) in outlines.iter().enumerate() {
        for rule in &rules::RULES {
            (rule.check)(outline, &mut |line, message| found.push((file, rule.name, line, message)));
        }
    }
    found.sort_by_key(|(file, _, line, _)| (*file, *line));
    let finding =
        |(file, rule, line, message): across::Found| Finding { file: files[file].0.to_owned(), line, rule, message };
    found.into_iter().map(finding).collect()
}
