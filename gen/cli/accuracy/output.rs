//! The folder of a campaign, and what is printed about it.

use crate::error::Failure;
use crate::file;
use efsat_studies::accuracy::campaign::CampaignError;
use efsat_studies::accuracy::store::FILE;
use efsat_studies::accuracy::{Progress, Request, Results, Store};
use serde::Serialize;
use std::fs;
use std::io;
use std::path::Path;

/// What was asked for, beside the results.
const REQUEST: &str = "campaign.json";
/// The page.
pub(super) const PAGE: &str = "index.html";

pub(super) fn ended(e: CampaignError) -> Failure {
    match e {
        CampaignError::Synth(e) => e.into(),
        e => Failure::Usage(e.to_string()),
    }
}

fn file_failure(path: &Path, e: &io::Error) -> Failure {
    Failure::Usage(format!("{}: {e}", path.display()))
}

/// Whether a folder may be written: it is absent, empty, or from an earlier campaign.
pub(super) fn claimable(dir: &Path) -> Result<(), Failure> {
    let mut entries = match fs::read_dir(dir) {
        Ok(entries) => entries,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(file_failure(dir, &e)),
    };
    // Of a run that ended before it said what was asked for.
    let begun = |entry: fs::DirEntry| entry.file_name() == FILE && entry.metadata().is_ok_and(|found| found.len() == 0);
    if dir.join(REQUEST).is_file() || entries.all(|entry| entry.is_ok_and(begun)) {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "{}: found files and no {REQUEST}; expected a new or empty folder, or one of an earlier campaign",
        dir.display()
    )))
}

/// Makes a folder ours, unless another run is at work there, and says in it what was asked for; its results.
pub(super) fn claim(dir: &Path, request: &Request) -> Result<Store, Failure> {
    file::folder(dir)?;
    let store = Store::open(dir)?;
    let text = serde_json::to_string_pretty(request).expect("keys are strings and numbers are finite");
    write(dir, &[(REQUEST.to_owned(), text + "\n")])?;
    Ok(store)
}

/// What was asked for in a folder.
pub(super) fn request(dir: &Path) -> Result<Request, Failure> {
    let wrong = |found: String| wrong_request(dir, &format!("{found}; expected a folder that efsat accuracy wrote"));
    let text = fs::read_to_string(dir.join(REQUEST)).map_err(|e| wrong(e.to_string()))?;
    serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))
}

/// What is wrong with what was asked for in a folder.
pub(super) fn wrong_request(dir: &Path, message: &str) -> Failure {
    Failure::Usage(format!("{}: {message}", dir.join(REQUEST).display()))
}

/// Whether a folder has results.
pub(super) fn has_results(dir: &Path) -> bool {
    dir.join(FILE).is_file()
}

/// Puts files into a folder, each as a whole.
pub(super) fn write(dir: &Path, files: &[(String, String)]) -> Result<(), Failure> {
    file::write_all(files.iter().map(|(name, text)| (dir.join(name), text)))
}

/// The JSON object.
#[derive(Serialize)]
pub(super) struct Printed<'a> {
    found: usize,
    made: usize,
    wrong: u64,
    #[serde(flatten)]
    results: &'a Results,
}

impl<'a> Printed<'a> {
    pub fn new(results: &'a Results, progress: Progress) -> Self {
        Self { found: progress.found, made: progress.made, wrong: results.wrong(), results }
    }
}

/// What is printed for people.
pub(super) fn summary(results: &Results, dir: &Path, progress: Progress) -> String {
    let mut text = format!(
        "{}: {} points, {} results made, {} found finished\n\n",
        dir.display(),
        results.rows.len(),
        progress.made,
        progress.found
    );
    results.headline.iter().for_each(|sentence| text.push_str(&format!("* {sentence}\n")));
    text.push_str(&format!(
        "\n{:<8}{:>14}{:>8}{:>14}{:>12}{:>14}{:>14}\n",
        "width", "p.i.", "wrong", "multipliers", "clock", "hardware", "effective"
    ));
    for row in results.by_width(&[]) {
        text.push_str(&format!(
            "{:<8}{:>12.4} %{:>8}{:>14}{:>8.1} MHz{:>11.2} ns{:>11.2} ns\n",
            row.point.width(),
            100.0 * row.possibly_incorrect.share,
            row.point.answers.wrong,
            row.point.hardware.cells.multipliers,
            row.point.hardware.clock,
            row.hardware_ns,
            row.effective_ns
        ));
    }
    text.push_str(&format!("\n{:<16}{:>12}{:>10}{:>10}{:>10}\n", "software", "time", "missed", "invented", "open"));
    for step in &results.ladder {
        let rung = &step.rung;
        let (missed, invented, open) = (rung.missed, rung.invented, rung.undecided);
        text.push_str(&format!("{:<16}{:>9.1} ns{missed:>10}{invented:>10}{open:>10}\n", rung.name, step.ns));
    }
    text + &format!("\nThe page: {}\n", dir.join(PAGE).display())
}
