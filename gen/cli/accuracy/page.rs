//! `efsat accuracy page`.

use super::output;
use crate::error::Failure;
use crate::file;
use crate::output::print;
use efsat_studies::accuracy::{self, Results};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes the page of finished campaigns again, of several with a choice of scene, from their accuracy.json
///
/// Nothing is measured. The plots and tables beside each accuracy.json are written again, too.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Folders with an accuracy.json, in the order of the choice
    #[arg(value_name = "DIR", required = true)]
    campaigns: Vec<PathBuf>,
    /// Folder of the page
    #[arg(long, value_name = "DIR", required = true)]
    out: PathBuf,
}

fn read(dir: &Path) -> Result<Results, Failure> {
    let path = dir.join("accuracy.json");
    let wrong = |found: String| {
        Failure::Usage(format!("{}: {found}; expected results that efsat accuracy wrote", path.display()))
    };
    let text = fs::read_to_string(&path).map_err(|e| wrong(e.to_string()))?;
    Results::read(&text).map_err(|e| wrong(e.to_string()))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let campaigns: Vec<Results> = arguments.campaigns.iter().map(|dir| read(dir)).collect::<Result<_, _>>()?;
    let page = arguments.out.join(output::PAGE);
    let beside = arguments
        .campaigns
        .iter()
        .zip(&campaigns)
        .flat_map(|(dir, results)| accuracy::files(results).into_iter().map(|(name, text)| (dir.join(name), text)));
    file::write_all(beside.chain([(page.clone(), accuracy::page(&campaigns))]))?;
    print(&format!("The page: {}\n", page.display()))
}
