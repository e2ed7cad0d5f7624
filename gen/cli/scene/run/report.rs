//! What `efsat scene run` prints.

use super::{Failure, failure, output};
use crate::output::{quoted, table};
use crate::scene::summary::Summary;
use efsat_studies::planner::{Cosimulation, Counted, Counts, Finding, Plan, Row, Total, Wish};
use efsat_unit::host::Verdicts;
use serde::Serialize;
use std::io::{self, BufWriter, StdoutLock, Write};

/// The first line of the CSV.
pub(super) fn heads<C: Counted>() -> String {
    format!("frame,label,{}\n", C::COLUMNS.join(","))
}

/// A row of the CSV.
pub(super) fn line<C: Counted>(row: &Row<C>) -> String {
    let numbers = row.counts.list().map(|count| count.to_string()).join(",");
    format!("{},{},{numbers}\n", row.frame, quoted(&row.label))
}

/// Takes rows in the order of the frames.
pub(super) enum Report {
    Csv(BufWriter<StdoutLock<'static>>),
    Json(BufWriter<StdoutLock<'static>>, bool),
    Summary(Summary<10>),
}

/// Result of the co-simulation, in the JSON object.
#[derive(Serialize)]
struct Simulated<'a> {
    simulator: Option<&'a str>,
    vectors: u64,
    guard_vectors: u64,
    host_decided: u64,
    mismatches: u64,
    close: u64,
    close_simulated: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    every_close: Option<Every<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_mismatch: Option<&'a str>,
}

/// The built-in simulator on every possibly incorrect and every close pair.
#[derive(Serialize)]
struct Every<'a> {
    vectors: u64,
    host_decided: u64,
    mismatches: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_mismatch: Option<&'a str>,
}

impl Report {
    /// Begins the output; `plan` is the value of `key` in the JSON object.
    pub fn new<C: Counted>(json: bool, summary: bool, key: &str, plan: &impl Serialize) -> Result<Self, Failure> {
        if summary {
            return Ok(Self::Summary(Summary::new(C::COLUMNS)));
        }
        let mut out = BufWriter::new(io::stdout().lock());
        if json {
            write!(out, r#"{{"{key}":{},"frames":["#, text(plan)).map_err(failure)?;
            return Ok(Self::Json(out, false));
        }
        write!(out, "{}", heads::<C>()).map_err(failure)?;
        Ok(Self::Csv(out))
    }

    pub fn take<C: Counted>(&mut self, row: &Row<C>) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => summary.add(row.distance, row.counts.list()),
            Self::Json(out, later) => {
                let comma = if std::mem::replace(later, true) { "," } else { "" };
                write!(out, "{comma}{}", text(row)).map_err(failure)?;
            }
            Self::Csv(out) => write!(out, "{}", line(row)).map_err(failure)?,
        }
        Ok(())
    }

    /// Ends the output: with the other keys of the JSON object, or with words below the summary.
    pub fn finish(self, end: &impl Serialize, words: impl FnOnce() -> String) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => output::print(&format!("{}\n{}", summary.table(), words())),
            Self::Json(mut out, _) => {
                let end = text(end);
                let keys = end.strip_prefix('{').unwrap_or(&end);
                writeln!(out, "],{keys}").and_then(|()| out.flush()).map_err(failure)
            }
            Self::Csv(mut out) => out.flush().map_err(failure),
        }
    }
}

/// What the JSON object says behind the frames.
#[derive(Serialize)]
pub(super) struct End<'a> {
    total: &'a Counts,
    less_definite: u64,
    contradictions: u64,
    wrong: u64,
    cosim: Option<Simulated<'a>>,
}

impl<'a> End<'a> {
    pub fn new(
        total: &'a Total,
        cosimulation: Option<&'a Cosimulation<'_, '_>>,
        every: Option<&'a Cosimulation<'_, '_>>,
    ) -> Self {
        let simulated = cosimulation.map(|cosimulation| Simulated {
            simulator: cosimulation.simulator.as_deref(),
            vectors: cosimulation.vectors,
            guard_vectors: cosimulation.guard_vectors,
            host_decided: cosimulation.host_decided,
            mismatches: cosimulation.mismatches,
            close: total.sums.close,
            close_simulated: total.close_places,
            every_close: every.map(|every| Every {
                vectors: every.vectors,
                host_decided: every.host_decided,
                mismatches: every.mismatches,
                first_mismatch: every.first_mismatch.as_deref(),
            }),
            first_mismatch: cosimulation.first_mismatch.as_deref(),
        });
        Self {
            total: &total.sums.counts,
            less_definite: total.sums.less_definite,
            contradictions: total.sums.contradictions,
            wrong: total.sums.wrong,
            cosim: simulated,
        }
    }
}

fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("keys are strings and numbers are finite")
}

/// What came out, in words.
pub(super) fn words(
    plan: &Plan,
    total: &Total,
    cosimulation: Option<&Cosimulation<'_, '_>>,
    every: Option<&Cosimulation<'_, '_>>,
) -> String {
    let counts = &total.sums.counts;
    let Counts { separate, intersect, possibly_incorrect, in_software, touching, .. } = *counts;
    let stage = |finding: &Finding| {
        let by = if finding.decided_by == Wish::Auto { "" } else { " (asked for)" };
        format!("{} {}{by}", finding.effect, finding.state)
    };
    let stages: Vec<String> = plan.effects.iter().map(stage).collect();
    let mut text = format!("stages: {}\n{}\n\n", stages.join(", "), plan.command_line);
    text.push_str(&table(&Verdicts { separate, intersect, possibly_incorrect }));
    if in_software > 0 {
        text.push_str(&format!("{in_software} pairs with a degenerate triangle were answered in software\n"));
    }
    text.push_str(&format!("{touching} pairs touch, by the final answers\n"));
    text.push_str(&format!(
        "compared with the full unit: {} pairs less definite, {} contradictions\n",
        total.sums.less_definite, total.sums.contradictions
    ));
    if let Some(cosimulation) = cosimulation {
        let name = cosimulation.simulator.as_deref().unwrap_or("no simulator: no pair");
        text.push_str(&format!(
            "{} pairs simulated ({name}), {} of {} possibly incorrect and close ones among them: {} mismatches\n",
            cosimulation.vectors, total.close_places, total.sums.close, cosimulation.mismatches
        ));
    }
    if let Some(every) = every {
        text.push_str(&format!(
            "{} pairs simulated (built-in), all that are possibly incorrect or close: {} mismatches\n",
            every.vectors, every.mismatches
        ));
    }
    text
}
