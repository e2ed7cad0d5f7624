//! What a comparison counts, and how it prints.

use efsat_geometry::exact::Exact;
use efsat_geometry::software::Test;
use efsat_unit::host::Truths;
use efsat_unit::pair::Verdict;
use serde::Serialize;

/// The number of software tests.
pub(super) const TESTS: usize = Test::ALL.len();
/// The tests of the paper's table: double precision, Moeller as published.
const MOELLER: Test = Test::MoellerEpsilon;
const SAT: Test = Test::SeparatingAxes11F64;
/// The paper's order.
const VERDICTS: [Verdict; 3] = [Verdict::Separate, Verdict::PossiblyIncorrect, Verdict::Intersect];

/// Everything that is known of one pair.
pub(super) struct Answer {
    pub verdict: Verdict,
    pub host_decided: bool,
    /// The exact answer for the numbers given.
    pub truth: Exact,
    /// The exact answer for the vertices that the software tests read, where these had to be rounded.
    pub rounded: Option<Exact>,
    /// Whether each of `Test::ALL` sees a common point.
    pub software: [bool; TESTS],
    /// Whether another program does.
    pub other: Option<bool>,
}

/// Wrong answers as counts.
#[derive(Clone, Copy, Default, Serialize)]
struct Errors {
    /// Pairs with a common point that were called separate.
    missed: u64,
    /// Pairs without one that were not.
    #[serde(rename = "false")]
    seen: u64,
}

impl Errors {
    fn add(&mut self, exact: Exact, contact: bool) {
        let is_contact = exact != Exact::Separate;
        self.missed += u64::from(is_contact && !contact);
        self.seen += u64::from(!is_contact && contact);
    }

    fn merge(&mut self, other: &Self) {
        self.missed += other.missed;
        self.seen += other.seen;
    }
}

/// All counts. Tallies of disjoint sets of pairs add up in any order.
#[derive(Clone, Default)]
pub(super) struct Tally {
    rows: [Truths; 12],
    host_decided: u64,
    /// Definite verdicts that contradict the exact answer.
    wrong: u64,
    /// The first such pair, counted from 0.
    pub first_wrong: Option<u64>,
    software: [Errors; TESTS],
    software_on_rounded: [Errors; TESTS],
    /// Of another program.
    other: Errors,
    /// Exact answers that change when the vertices are rounded; none where nothing is rounded.
    rounding: Option<Errors>,
}

impl Tally {
    /// Counts pair number `number`.
    pub fn add(mut self, number: u64, answer: &Answer) -> Self {
        let verdict = VERDICTS.iter().position(|v| *v == answer.verdict).expect("there are three");
        let column = |test: Test| usize::from(answer.software[test as usize]);
        let row = &mut self.rows[4 * verdict + 2 * column(MOELLER) + column(SAT)];
        row.count(answer.truth);
        self.host_decided += u64::from(answer.host_decided);
        if answer.verdict.is_wrong(answer.truth) {
            self.wrong += 1;
            self.first_wrong = Some(self.first_wrong.map_or(number, |first| first.min(number)));
        }
        for (errors, &seen) in self.software.iter_mut().zip(&answer.software) {
            errors.add(answer.truth, seen);
        }
        if let Some(other) = answer.other {
            self.other.add(answer.truth, other);
        }
        if let Some(rounded) = answer.rounded {
            self.rounding.get_or_insert_default().add(answer.truth, rounded != Exact::Separate);
            for (errors, &seen) in self.software_on_rounded.iter_mut().zip(&answer.software) {
                errors.add(rounded, seen);
            }
        }
        self
    }

    /// The sum of two tallies.
    pub fn merge(mut self, other: &Self) -> Self {
        for (row, more) in self.rows.iter_mut().zip(&other.rows) {
            *row += *more;
        }
        self.host_decided += other.host_decided;
        self.wrong += other.wrong;
        self.first_wrong = self.first_wrong.into_iter().chain(other.first_wrong).min();
        self.other.merge(&other.other);
        let errors = self.software.iter_mut().chain(&mut self.software_on_rounded);
        for (errors, more) in errors.zip(other.software.iter().chain(&other.software_on_rounded)) {
            errors.merge(more);
        }
        if let Some(more) = &other.rounding {
            self.rounding.get_or_insert_default().merge(more);
        }
        self
    }

    /// The counts as they are printed.
    pub fn report(
        &self,
        source: String,
        poses: Option<u64>,
        units: Option<&'static str>,
        given: Option<&str>,
    ) -> Report {
        let word = |index: usize| ["separate", "intersect"][index % 2];
        let row = |(index, truth): (usize, &Truths)| Row {
            efsat: VERDICTS[index / 4].to_string(),
            moeller: word(index / 2),
            sat: word(index),
            pairs: truth.total(),
            truth: *truth,
        };
        let rows: Vec<Row> = self.rows.iter().enumerate().map(row).collect();
        let software = |(&test, (errors, on_rounded)): (&Test, (&Errors, &Errors))| SoftwareErrors {
            test: test.name().to_owned(),
            source: test.source(),
            errors: *errors,
            on_rounded_vertices: self.rounding.map(|_| *on_rounded),
        };
        let of_others = given.map(|file| SoftwareErrors {
            test: file.to_owned(),
            source: "answers of another program",
            errors: self.other,
            on_rounded_vertices: None,
        });
        let [moeller, sat] = [MOELLER, SAT].map(|test| self.software[test as usize]);
        Report {
            source,
            poses,
            units,
            pairs: rows.iter().map(|row| row.pairs).sum(),
            host_decided: self.host_decided,
            rows,
            wrong: Wrong { efsat: self.wrong, moeller, sat },
            rounding: self.rounding,
            software: (Test::ALL.iter().zip(self.software.iter().zip(&self.software_on_rounded)).map(software))
                .chain(of_others)
                .collect(),
        }
    }
}

/// The comparison; also the JSON object.
#[derive(Serialize)]
pub(super) struct Report {
    source: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    poses: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    units: Option<&'static str>,
    pub pairs: u64,
    host_decided: u64,
    rows: Vec<Row>,
    pub wrong: Wrong,
    #[serde(skip_serializing_if = "Option::is_none")]
    rounding: Option<Errors>,
    software: Vec<SoftwareErrors>,
}

/// A row of the paper's Table 1 beside the exact answers.
#[derive(Serialize)]
struct Row {
    efsat: String,
    moeller: &'static str,
    sat: &'static str,
    pairs: u64,
    truth: Truths,
}

/// How often each column of the table was wrong.
#[derive(Serialize)]
pub(super) struct Wrong {
    pub efsat: u64,
    moeller: Errors,
    sat: Errors,
}

/// How often a software test was wrong.
#[derive(Serialize)]
struct SoftwareErrors {
    test: String,
    source: &'static str,
    #[serde(flatten)]
    errors: Errors,
    #[serde(skip_serializing_if = "Option::is_none")]
    on_rounded_vertices: Option<Errors>,
}

impl Report {
    /// Both tables as text.
    pub fn table(&self) -> String {
        let mut text = format!("{}: {} pairs", self.source, self.pairs);
        if let Some(poses) = self.poses {
            text.push_str(&format!(" in {poses} poses"));
        }
        match self.units {
            Some("cube") => text.push_str(", scaled to the cube [-1, 1]^3 for software"),
            Some(_) => text.push_str(", in units of the mesh files for software"),
            None => {}
        }
        if self.host_decided > 0 {
            text.push_str(&format!("; {} decided on the host", self.host_decided));
        }
        format!("{text}\n\n{}\n{}", self.answers(), self.errors())
    }

    fn share(&self, count: u64) -> f64 {
        100.0 * count as f64 / self.pairs.max(1) as f64
    }

    /// The paper's Table 1 beside the exact answers.
    fn answers(&self) -> String {
        let head = format!("{:<20}{:<11}{:<11}{:>10}{:>11}", "EFSAT", "Moeller", "SAT", "pairs", "share");
        let exact = format!("{:>17}{:>9}{:>11}", "exact: separate", "touch", "intersect");
        let row = |Row { efsat, moeller, sat, pairs, truth }: &Row| {
            let share = self.share(*pairs);
            let exact = format!("{:>17}{:>9}{:>11}", truth.separate, truth.touch, truth.intersect);
            format!("{efsat:<20}{moeller:<11}{sat:<11}{pairs:>10}{share:>9.3} %{exact}\n")
        };
        format!("{head}{exact}\n{}", self.rows.iter().map(row).collect::<String>())
    }

    /// How often everything was wrong.
    fn errors(&self) -> String {
        let line = |name: &str, errors: &Errors, more: Option<Errors>| {
            let Errors { missed, seen } = errors;
            let share = self.share(missed + seen);
            let more = more.map_or_else(String::new, |more| format!("{:>20}{:>10}", more.missed, more.seen));
            format!("{name:<31}{missed:>10}{seen:>10}{share:>10.4} %{more}\n")
        };
        let mut text = format!("{:<31}{:>10}{:>10}{:>12}", "wrong", "missed", "false", "share");
        if self.rounding.is_some() {
            text.push_str(&format!("{:>20}{:>10}", "if rounded: missed", "false"));
        }
        let efsat = self.wrong.efsat;
        text.push_str(&format!("\n{:<31}{efsat:>20}{:>10.4} %\n", "EFSAT, definite", self.share(efsat)));
        if let Some(rounding) = &self.rounding {
            text.push_str(&line("exact, on rounded vertices", rounding, Some(Errors::default())));
        }
        let software = self.software.iter().map(|s| line(&s.test, &s.errors, s.on_rounded_vertices));
        text.extend(software);
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(verdict: Verdict, truth: Exact) -> Answer {
        Answer {
            verdict,
            host_decided: false,
            truth,
            rounded: None,
            software: [truth != Exact::Separate; TESTS],
            other: None,
        }
    }

    #[test]
    fn wrong_definite_verdicts_are_counted_and_the_first_is_named() {
        let one = Tally::default()
            .add(7, &answer(Verdict::Separate, Exact::Touch))
            .add(8, &answer(Verdict::Intersect, Exact::Separate))
            .add(9, &answer(Verdict::PossiblyIncorrect, Exact::Separate));
        let other = Tally::default()
            .add(4, &answer(Verdict::Separate, Exact::Separate))
            .add(5, &answer(Verdict::Separate, Exact::Intersect))
            .add(6, &answer(Verdict::Intersect, Exact::Touch));
        for sum in [one.clone().merge(&other), other.clone().merge(&one)] {
            assert_eq!(sum.first_wrong, Some(5));
            let report = sum.report("x".to_owned(), None, None, None);
            assert_eq!((report.wrong.efsat, report.pairs), (3, 6));
            assert!(report.table().contains("EFSAT, definite                                   3   50.0000 %"));
        }
        assert_eq!(Tally::default().merge(&Tally::default()).first_wrong, None);
    }
}
