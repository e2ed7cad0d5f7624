//! `efsat wall`.

use super::error::Failure;
use super::file;
use super::output::{print, print_json};
use super::params::ParamArguments;
use super::progress;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use efsat_geometry::software::Test;
use efsat_studies::wall::{CONTACTS, Contact, Grid, Map, Report, SIZE, Step, picture};
use efsat_unit::params::Params;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Draws the verdicts around a contact, one vertex moved over 256 x 256 cells, beside the exact answers
///
/// separate is blue, possibly-incorrect yellow, touch black, intersect orange; upwards is away from the other triangle.
/// Columns of the table: cells by verdict; least, median and greatest length of the possibly-incorrect runs at the wall,
/// column by column; wrong cells; definite cells beside the other definite verdict; columns with possibly-incorrect cells
/// apart from those at the wall, of all that cross it, and how far such cells reach; cut-off groups of cells, and how far
/// they are from their like. A wrong cell fails, and so does one that strays farther than the band is wide.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Which contacts; all of them if none is named
    #[arg(value_name = "CONTACT", value_parser = PossibleValuesParser::new(CONTACTS.map(|contact| contact.name)))]
    contacts: Vec<String>,
    /// Print names and descriptions of the contacts and nothing else
    #[arg(long, conflicts_with_all = ["contacts", "step", "out", "software", "json", "Params"])]
    list: bool,
    /// Distance of two cells: one ulp of the axis test (working), of the input format (input) or of the moved vertex
    /// (binary64), or a power of two such as 2^-12
    #[arg(long, value_name = "STEP", default_value_t = Step::Working, allow_negative_numbers = true)]
    step: Step,
    /// Write a picture of each contact, DIR/CONTACT.png
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw what a test in software answers as a third map, and count its wrong cells; meant for --step binary64
    #[arg(long, value_name = "TEST", value_parser = software())]
    software: Option<Test>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

/// The names of the tests in software.
fn software() -> impl TypedValueParser<Value = Test> {
    PossibleValuesParser::new(Test::ALL.iter().map(|test| test.name()))
        .map(|name| *Test::ALL.iter().find(|test| test.name() == name).expect("clap lets names of the list through"))
}

/// The maps of a contact.
struct Drawn {
    contact: &'static Contact,
    exponent: i32,
    report: Report,
    software_wrong: Option<usize>,
    picture: Vec<u8>,
}

impl Drawn {
    fn new(contact: &'static Contact, arguments: &Arguments, params: &Params) -> Result<Self, Failure> {
        let grid = Grid::new(contact, arguments.step, params).map_err(|e| Failure::Usage(e.to_string()))?;
        let (verdicts, exact) = (Map::verdicts(&grid, params), Map::exact(&grid));
        let software = arguments.software.map(|test| Map::software(&grid, test));
        let maps: Vec<&Map> = [&verdicts, &exact].into_iter().chain(&software).collect();
        Ok(Self {
            contact,
            exponent: grid.exponent(),
            report: Report::new(&verdicts, &exact),
            software_wrong: software.as_ref().map(|map| map.wrong(&exact)),
            picture: picture::png(&maps),
        })
    }
}

/// The JSON object.
#[derive(Serialize)]
struct Summary {
    step: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    software: Option<&'static str>,
    cells: usize,
    wrong: usize,
    contacts: Vec<Row>,
}

/// A contact in the JSON object.
#[derive(Serialize)]
struct Row {
    contact: &'static str,
    step_exponent: i32,
    #[serde(flatten)]
    report: Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    software_wrong: Option<usize>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        let line = |contact: &Contact| format!("{:<18}{}\n", contact.name, contact.about);
        return print(&CONTACTS.iter().map(line).collect::<String>());
    }
    let params = arguments.params.params()?;
    let chosen = |contact: &&Contact| {
        arguments.contacts.is_empty() || arguments.contacts.iter().any(|name| name == contact.name)
    };
    let chosen: Vec<&'static Contact> = CONTACTS.iter().filter(chosen).collect();
    let bar = progress::bar("mapping", chosen.len() as u64, "contacts", false);
    let mut maps = vec![];
    for contact in chosen {
        maps.push(Drawn::new(contact, arguments, &params)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    if let Some(dir) = &arguments.out {
        write(dir, &maps)?;
    }
    let wrong = maps.iter().map(|map| map.report.wrong).sum();
    if arguments.json {
        let row = |map: &Drawn| Row {
            contact: map.contact.name,
            step_exponent: map.exponent,
            report: map.report.clone(),
            software_wrong: map.software_wrong,
        };
        print_json(&Summary {
            step: arguments.step.to_string(),
            software: arguments.software.map(Test::name),
            cells: SIZE * SIZE * maps.len(),
            wrong,
            contacts: maps.iter().map(row).collect(),
        })?;
    } else {
        print(&table(&maps))?;
    }
    let failed: Vec<String> = maps
        .iter()
        .filter_map(|map| map.report.fault().map(|fault| format!("{}: {fault}", map.contact.name)))
        .collect();
    if failed.is_empty() { Ok(()) } else { Err(Failure::Check(failed.join("; "))) }
}

fn table(maps: &[Drawn]) -> String {
    let heads =
        ["step", "separate", "p.i.", "intersect", "band", "wrong", "adjacent", "disorder", "fringe", "speckles"];
    let software = maps.iter().any(|map| map.software_wrong.is_some()).then_some("software wrong");
    let mut text = line("contact", &heads.into_iter().chain(software).map(str::to_owned).collect::<Vec<_>>());
    for map in maps {
        let r = &map.report;
        let cells = [
            format!("2^{}", map.exponent),
            r.separate.to_string(),
            r.possibly_incorrect.to_string(),
            r.intersect.to_string(),
            r.band.map_or_else(|| "-".to_owned(), |b| format!("{} {} {}", b.min, b.median, b.max)),
            r.wrong.to_string(),
            r.adjacent.to_string(),
            format!("{}/{}", r.disordered, r.lines),
            r.fringe.to_string(),
            format!("{} ({})", r.speckles, r.speckle_distance),
        ];
        let software = map.software_wrong.map(|wrong| wrong.to_string());
        text.push_str(&line(map.contact.name, &cells.into_iter().chain(software).collect::<Vec<_>>()));
    }
    text
}

/// A row of the table.
fn line(name: &str, cells: &[String]) -> String {
    let widths = [7, 10, 7, 11, 13, 7, 10, 10, 8, 10, 16];
    let cells = cells.iter().zip(widths).map(|(cell, width)| format!("{cell:>width$}"));
    format!("{name:<17}{}\n", cells.collect::<String>())
}

/// Puts the pictures into a folder, each as a whole.
fn write(dir: &Path, maps: &[Drawn]) -> Result<(), Failure> {
    file::folder(dir)?;
    file::write_all(maps.iter().map(|map| (dir.join(format!("{}.png", map.contact.name)), &map.picture)))
}
