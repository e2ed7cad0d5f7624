//! The score of a campaign: killed mutants among those that are not equivalent.

use super::explained::{Claim, Explanation, Table};
use super::{Fate, Kind, Mutant};
use std::collections::BTreeMap;

/// A mutant, what became of it and what is known of it.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Which.
    pub mutant: Mutant,
    /// What became of it.
    pub fate: Fate,
    /// Why it survives, if somebody has said so.
    pub explanation: Option<&'static Explanation>,
}

/// How a mutant counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Noticed.
    Killed,
    /// Survived, and it is explained why nothing can notice it.
    Equivalent,
    /// Survived, and it is explained why hardly anything notices it.
    Hidden,
    /// Survived, and nobody knows why: a hole in the checks.
    Unexplained,
    /// Killed although it is called equivalent: a wrong explanation.
    Stale,
    /// No mutant: the compiler refuses it.
    Invalid,
}

impl Entry {
    /// Looks the mutant up in a table of explanations.
    pub fn new(mutant: Mutant, fate: Fate, table: &Table) -> Self {
        let explanation = table.find(&mutant.name());
        Self { mutant, fate, explanation }
    }

    /// How it counts.
    pub fn standing(&self) -> Standing {
        match (&self.fate, self.explanation.map(|explanation| explanation.claim)) {
            (Fate::Invalid(_), _) => Standing::Invalid,
            (Fate::Killed(_), None | Some(Claim::Hidden)) => Standing::Killed,
            (Fate::Killed(_), Some(Claim::Equivalent)) => Standing::Stale,
            (Fate::Survived, Some(Claim::Equivalent)) => Standing::Equivalent,
            (Fate::Survived, Some(Claim::Hidden)) => Standing::Hidden,
            (Fate::Survived, None) => Standing::Unexplained,
        }
    }
}

/// Counts of some mutants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Tally {
    /// All that were run.
    pub mutants: usize,
    /// Noticed, whatever was said of them.
    pub killed: usize,
    /// Survived, and equivalent.
    pub equivalent: usize,
    /// Survived, and shown by hardly any input.
    pub hidden: usize,
    /// Survived and not explained.
    pub unexplained: usize,
    /// Killed although explained; among `killed`.
    pub stale: usize,
    /// Refused by the compiler.
    pub invalid: usize,
}

impl Tally {
    /// Counts one more.
    pub fn add(&mut self, standing: Standing) {
        self.mutants += 1;
        match standing {
            Standing::Killed => self.killed += 1,
            Standing::Equivalent => self.equivalent += 1,
            Standing::Hidden => self.hidden += 1,
            Standing::Unexplained => self.unexplained += 1,
            Standing::Stale => {
                self.killed += 1;
                self.stale += 1;
            }
            Standing::Invalid => self.invalid += 1,
        }
    }

    /// Killed among all that are neither equivalent nor invalid, in percent; all of none.
    pub fn score(&self) -> f64 {
        match self.killed + self.hidden + self.unexplained {
            0 => 100.0,
            all => 100.0 * self.killed as f64 / all as f64,
        }
    }
}

/// The tally of all, by kind, and by unit in their order.
#[derive(Clone, Debug, Default)]
pub struct Score {
    /// All.
    pub all: Tally,
    /// By kind of change.
    pub kinds: BTreeMap<Kind, Tally>,
    /// By entity or source file.
    pub units: Vec<(String, Tally)>,
}

impl Score {
    /// Counts one more.
    pub fn add(&mut self, entry: &Entry) {
        let standing = entry.standing();
        self.all.add(standing);
        self.kinds.entry(entry.mutant.kind).or_default().add(standing);
        if self.units.last().is_none_or(|(unit, _)| *unit != entry.mutant.unit) {
            self.units.push((entry.mutant.unit.clone(), Tally::default()));
        }
        if let Some((_, tally)) = self.units.last_mut() {
            tally.add(standing);
        }
    }

    /// The tables by kind and by unit.
    pub fn table(&self) -> String {
        let head = |what: &str| {
            format!(
                "{what:<24}{:>9}{:>9}{:>12}{:>8}{:>13}{:>9}{:>9}\n",
                "mutants", "killed", "equivalent", "hidden", "unexplained", "invalid", "score"
            )
        };
        let row = |name: &str, t: &Tally| {
            let score = format!("{:.1} %", t.score());
            format!(
                "{name:<24}{:>9}{:>9}{:>12}{:>8}{:>13}{:>9}{score:>9}\n",
                t.mutants, t.killed, t.equivalent, t.hidden, t.unexplained, t.invalid
            )
        };
        let kinds: String = self.kinds.iter().map(|(kind, tally)| row(&kind.to_string(), tally)).collect();
        let units: String = self.units.iter().map(|(unit, tally)| row(unit, tally)).collect();
        format!("{}{kinds}\n{}{units}{}", head("kind"), head("unit"), row("all", &self.all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mutation::explained::Rate;

    #[test]
    fn equivalent_and_invalid_mutants_do_not_count_and_wrong_explanations_are_seen() {
        let mutant = Mutant {
            unit: "u".to_owned(),
            line: 1,
            target: "x".to_owned(),
            kind: Kind::Case,
            change: "c".to_owned(),
            place: 0..0,
            new: String::new(),
        };
        const fn said(claim: Claim) -> Explanation {
            Explanation { pattern: "u:x:case:c", claim, reason: "because", rate: Rate::Any }
        }
        const SAME: &[&Explanation] = &[&said(Claim::Equivalent)];
        const HIDDEN: &[&Explanation] = &[&said(Claim::Hidden)];
        let killed = || Fate::Killed("answer".to_owned());
        let invalid = Fate::Invalid("refused".to_owned());
        let cases = [
            (killed(), &[][..]),
            (Fate::Survived, SAME),
            (Fate::Survived, HIDDEN),
            (Fate::Survived, &[]),
            (killed(), SAME),
            (killed(), HIDDEN),
            (invalid, SAME),
        ];
        let mut score = Score::default();
        let standings = cases.map(|(fate, table)| {
            let table = Table { all: table.to_vec(), second: vec![] };
            let entry = Entry::new(mutant.clone(), fate, &table);
            score.add(&entry);
            entry.standing()
        });
        use Standing::*;
        assert_eq!(standings, [Killed, Equivalent, Hidden, Unexplained, Stale, Killed, Invalid]);
        assert_eq!((score.all.mutants, score.all.killed, score.all.hidden, score.all.stale), (7, 3, 1, 1));
        assert!((score.all.score() - 60.0).abs() < 1e-9);
        assert!((Tally::default().score() - 100.0).abs() < 1e-9);
        assert!(score.table().contains("60.0 %"));
    }
}
