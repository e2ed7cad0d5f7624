//! `efsat tree count`.

use super::VolumeArguments;
use crate::error::Failure;
use crate::output::{print, print_json};
use crate::params::whole;
use crate::progress;
use crate::source::load_scene;
use efsat_engine::host::{Images, Numbers, memory};
use efsat_engine::model::{Model, Query, Side};
use efsat_engine::params::{EngineParams, FACTOR_BITS};
use efsat_engine::words::Sums;
use efsat_geometry::scene::{Meeting, Near};
use efsat_unit::design::top::DesignError;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;
use std::ops::Add;

/// Counts what the engine would do in all frames of a scene, by its reference model: one query for each two objects whose boxes
/// overlap
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    #[command(flatten)]
    volumes: VolumeArguments,
    /// Bits of a factor of the realignment, 4 to 16
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = whole(FACTOR_BITS), allow_negative_numbers = true)]
    factor_bits: u32,
    /// Stop each query at the first certain contact
    #[arg(long)]
    first_contact: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Sums over queries.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Counts {
    #[serde(flatten)]
    sums: Sums,
    /// Queries that the engine cannot answer.
    answered_in_software: u64,
}

impl Counts {
    fn table(&self) -> String {
        let rows = [
            ("queries", self.sums.queries),
            ("answered in software", self.answered_in_software),
            ("expansions", self.sums.expansions),
            ("tests", self.sums.tests),
            ("survivors", self.sums.survivors),
            ("leaf pairs", self.sums.leaf_pairs),
            ("intersect", self.sums.intersect),
            ("possibly incorrect", self.sums.possibly_incorrect),
            ("greatest stack", self.sums.greatest_stack),
        ];
        let mut text = String::new();
        for (name, count) in rows {
            let _ = writeln!(text, "{name:<24}{count:>16}");
        }
        text
    }
}

impl Add for Counts {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.sums += other.sums;
        self.answered_in_software += other.answered_in_software;
        self
    }
}

/// A scene in the memory of an engine.
struct Search<'a> {
    near: Near<'a>,
    model: Model,
    images: Images,
    sides: Vec<Side>,
    memory: Vec<u64>,
    first_contact: bool,
}

impl Search<'_> {
    fn meeting(&self, meeting: &Meeting) -> Counts {
        match self.images.query(meeting.meshes, &meeting.pose, &self.sides) {
            Err(_) => Counts { sums: Sums { queries: 1, ..Sums::default() }, answered_in_software: 1 },
            Ok(query) => {
                let query = Query { first_contact: self.first_contact, ..query };
                {
                    let report = self.model.run(&self.memory, &query.words(self.model.format())).report;
                    Counts { sums: (&report).into(), answered_in_software: 0 }
                }
            }
        }
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.file)?;
    let engine = EngineParams { factor_bits: arguments.factor_bits, ..arguments.volumes.engine() };
    let unit = engine.unit();
    let numbers = Numbers::new(&engine, &unit).map_err(DesignError::from)?;
    let model = Model::new(&engine, &unit).map_err(DesignError::from)?;
    let images =
        Images::new(&scene.meshes().0, numbers).map_err(|e| Failure::Usage(format!("{}: {e}", arguments.file)))?;
    let (memory, sides) = memory(&images.all());
    let first_contact = arguments.first_contact;
    let search = Search { near: scene.near(), model, images, sides, memory, first_contact };
    let frames = scene.frames();
    let bar = progress::bar("counting", frames as u64, "poses", false);
    let counted = (0..frames).into_par_iter().map(|frame| {
        let meetings = search.near.meetings(frame);
        let counts = meetings.iter().map(|meeting| search.meeting(meeting)).fold(Counts::default(), Add::add);
        bar.inc(1);
        counts
    });
    let counts = counted.reduce(Counts::default, Add::add);
    bar.finish_and_clear();
    if arguments.json { print_json(&counts) } else { print(&counts.table()) }
}
