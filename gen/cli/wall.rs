//! `efsat wall`.

use super::error::Failure;
use super::output::{print, print_json};
use super::params::ParamArguments;
use super::progress;
use crate::artefact::Scratch;
use crate::exact;
use crate::golden::host::{loose_pair, Host};
use crate::golden::{Golden, Pose};
use crate::params::Params;
use crate::wall::{picture, Answer, Contact, Map, Report, Step, CONTACTS, SIZE};
use clap::builder::PossibleValuesParser;
use serde::Serialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Draws the verdicts around a contact: one vertex moved over 256 x 256 cells
///
/// Beside each map of verdicts stands the exact one. separate is blue, possibly-incorrect yellow, touch black, intersect
/// orange; upwards is away from the other triangle. The maps are checked: definite cells are right, nothing but
/// possibly-incorrect cells lie between separate and intersect, and no group of cells is cut off from its like.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Which contacts; all of them if none is named
    #[arg(value_name = "CONTACT", value_parser = PossibleValuesParser::new(CONTACTS.map(|contact| contact.name)))]
    contacts: Vec<String>,
    /// Print names and descriptions of the contacts and nothing else
    #[arg(long, conflicts_with_all = ["contacts", "step", "out", "json", "ParamArguments"])]
    list: bool,
    /// Distance of two cells: one ulp of the axis test (working), of the input format (input) or of the moved vertex
    /// (binary64), or a power of two such as 2^-12
    #[arg(long, value_name = "STEP", default_value_t = Step::Working)]
    step: Step,
    /// Write a picture of each contact, DIR/CONTACT.png
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

/// The maps of a contact.
struct Drawn {
    contact: &'static Contact,
    exponent: i32,
    report: Report,
    picture: Vec<u8>,
}

impl Drawn {
    fn new(contact: &'static Contact, step: Step, params: &Params, golden: &Golden) -> Result<Self, Failure> {
        let grid = contact.grid(step, params).map_err(|e| Failure::Usage(e.to_string()))?;
        let identity = Pose::identity(params);
        let verdicts = Map::of(&grid, |points| match loose_pair(points, params) {
            Host::Unit(pair) => golden.verdict(&identity, &pair).into(),
            Host::Decided(verdict) => verdict.into(),
        });
        let exact = Map::of(&grid, |points| Answer::from(exact::pair(points)));
        let report = Report::new(&verdicts, &exact);
        Ok(Self { contact, exponent: grid.exponent(), report, picture: picture::png(&[&verdicts, &exact]) })
    }
}

/// The JSON object.
#[derive(Serialize)]
struct Summary {
    step: String,
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
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.list {
        let line = |contact: &Contact| format!("{:<18}{}\n", contact.name, contact.about);
        return print(&CONTACTS.iter().map(line).collect::<String>());
    }
    let params = arguments.params.params()?;
    if let Some(dir) = &arguments.out {
        fs::create_dir_all(dir).map_err(|e| file_failure(dir, &e))?;
    }
    let golden = Golden::new(&params);
    let chosen = |contact: &&Contact| {
        arguments.contacts.is_empty() || arguments.contacts.iter().any(|name| name == contact.name)
    };
    let chosen: Vec<&'static Contact> = CONTACTS.iter().filter(chosen).collect();
    let bar = progress::bar(chosen.len() as u64, "contacts", false);
    let mut maps = vec![];
    for contact in chosen {
        maps.push(Drawn::new(contact, arguments.step, &params, &golden)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    if let Some(dir) = &arguments.out {
        write(dir, &maps)?;
    }
    let wrong = maps.iter().map(|map| map.report.wrong).sum();
    if arguments.json {
        let row =
            |map: &Drawn| Row { contact: map.contact.name, step_exponent: map.exponent, report: map.report.clone() };
        let step = arguments.step.to_string();
        print_json(&Summary {
            step,
            cells: SIZE * SIZE * maps.len(),
            wrong,
            contacts: maps.iter().map(row).collect(),
        })?;
    } else {
        print(&table(&maps))?;
    }
    let failed: Vec<String> = maps.iter().filter_map(fault).collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(failed.join("; ")))
    }
}

/// What is wrong about a map, if anything is.
fn fault(map: &Drawn) -> Option<String> {
    (map.report.wrong > 0).then(|| format!("{}: {} wrong", map.contact.name, map.report.wrong))
}

fn table(maps: &[Drawn]) -> String {
    let mut text = format!(
        "{:<18}{:>6}{:>10}{:>8}{:>11}{:>16}{:>7}{:>11}{:>11}{:>8}{:>10}{:>7}{:>5}\n",
        "contact",
        "step",
        "separate",
        "p.i.",
        "intersect",
        "band",
        "wrong",
        "unguarded",
        "disordered",
        "ragged",
        "speckles",
        "cells",
        "far"
    );
    for map in maps {
        let r = &map.report;
        let band = r.band.map_or_else(|| "-".to_owned(), |b| format!("{} {} {}", b.min, b.median, b.max));
        text.push_str(&format!(
            "{:<18}{:>6}{:>10}{:>8}{:>11}{band:>16}{:>7}{:>11}{:>11}{:>8}{:>10}{:>7}{:>5}\n",
            map.contact.name,
            format!("2^{}", map.exponent),
            r.separate,
            r.possibly_incorrect,
            r.intersect,
            r.wrong,
            r.unguarded,
            format!("{}/{}", r.disordered, r.lines),
            r.ragged,
            r.speckles,
            r.speckle_cells,
            r.speckle_distance
        ));
    }
    text
}

/// Puts the pictures into a folder, each as a whole.
fn write(dir: &Path, maps: &[Drawn]) -> Result<(), Failure> {
    let scratch = Scratch::inside(dir).map_err(|e| file_failure(dir, &e))?;
    let names = || maps.iter().map(|map| format!("{}.png", map.contact.name));
    for (name, map) in names().zip(maps) {
        let path = scratch.path().join(name);
        fs::write(&path, &map.picture).map_err(|e| file_failure(&path, &e))?;
    }
    for name in names() {
        let path = dir.join(&name);
        fs::rename(scratch.path().join(name), &path).map_err(|e| file_failure(&path, &e))?;
    }
    Ok(())
}

fn file_failure(path: &Path, e: &io::Error) -> Failure {
    Failure::Usage(format!("{}: {e}", path.display()))
}
