//! What `efsat scene run` prints.

use super::{Failure, failure, output, quoted};
use crate::cli::output::Verdicts;
use crate::cli::scene::summary::Summary;
use crate::effects::{Cosimulation, Counts, Finding, Plan, Row, Total, Wish};
use serde::Serialize;
use std::io::{self, BufWriter, StdoutLock, Write};

/// What is counted, in the order of [`list`].
const COLUMNS: [&str; 10] = [
    "meetings",
    "overlap_tests",
    "transforms",
    "nodes_visited",
    "pairs_tested",
    "separate",
    "intersect",
    "possibly_incorrect",
    "in_software",
    "touching",
];

fn list(counts: &Counts) -> [u64; 10] {
    let Counts { meetings, statistics: s, separate, intersect, possibly_incorrect, in_software, touching } = *counts;
    [
        meetings,
        s.overlap_tests,
        s.transforms,
        s.nodes_visited,
        s.pairs_tested,
        separate,
        intersect,
        possibly_incorrect,
        in_software,
        touching,
    ]
}

/// The first line of the CSV.
pub(super) fn heads() -> String {
    format!("frame,label,{}\n", COLUMNS.join(","))
}

/// A row of the CSV.
pub(super) fn line(row: &Row) -> String {
    let numbers = list(&row.counts).map(|count| count.to_string()).join(",");
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
    pub fn new(json: bool, summary: bool, plan: &Plan) -> Result<Self, Failure> {
        if summary {
            return Ok(Self::Summary(Summary::new(COLUMNS)));
        }
        let mut out = BufWriter::new(io::stdout().lock());
        if json {
            write!(out, r#"{{"plan":{},"frames":["#, text(plan)).map_err(failure)?;
            return Ok(Self::Json(out, false));
        }
        write!(out, "{}", heads()).map_err(failure)?;
        Ok(Self::Csv(out))
    }

    pub fn take(&mut self, row: &Row) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => summary.add(row.distance, list(&row.counts)),
            Self::Json(out, later) => {
                let comma = if std::mem::replace(later, true) { "," } else { "" };
                write!(out, "{comma}{}", text(row)).map_err(failure)?;
            }
            Self::Csv(out) => write!(out, "{}", line(row)).map_err(failure)?,
        }
        Ok(())
    }

    pub fn finish(
        self,
        plan: &Plan,
        total: &Total,
        cosimulation: Option<&Cosimulation<'_, '_>>,
        every: Option<&Cosimulation<'_, '_>>,
    ) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => {
                output::print(&format!("{}\n{}", summary.table(), words(plan, total, cosimulation, every)))
            }
            Self::Json(mut out, _) => {
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
                let (counts, less, contradictions) =
                    (&total.sums.counts, total.sums.less_definite, total.sums.contradictions);
                let wrong = total.sums.wrong;
                write!(
                    out,
                    r#"],"total":{},"less_definite":{less},"contradictions":{contradictions},"wrong":{wrong},"cosim":{}}}"#,
                    text(counts),
                    text(&simulated)
                )
                .and_then(|()| writeln!(out))
                .and_then(|()| out.flush())
                .map_err(failure)
            }
            Self::Csv(mut out) => out.flush().map_err(failure),
        }
    }
}

fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("keys are strings and numbers are finite")
}

/// What came out, in words.
fn words(
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
    text.push_str(&Verdicts { separate, intersect, possibly_incorrect }.table());
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
