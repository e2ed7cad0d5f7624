//! `efsat tree inspect`.

use super::read;
use crate::error::Failure;
use crate::output::{counted, print, print_json, readable};
use efsat_engine::host::{Header, Image};
use efsat_engine::model::Link;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Prints the header of an image and statistics of its tree
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// An image made by efsat tree build
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What is printed.
#[derive(Serialize)]
struct Report {
    bytes: u64,
    directions: u32,
    offset_bits: u32,
    origin_fraction: u32,
    grid_fraction: u32,
    transform_width: u32,
    int_bits: u32,
    sticky: bool,
    blocks: u32,
    bytes_per_block: u32,
    triangles: u32,
    bytes_per_triangle: u32,
    power: i32,
    centre: [f64; 3],
    height: u32,
    /// The mean number of links from the root's block to a triangle.
    mean_depth: f64,
    /// How many blocks have each exponent.
    exponents: [u32; 16],
}

impl Report {
    fn new(image: &Image) -> Self {
        let Header { format, blocks, triangles, power, height, centre } = *image.header();
        let mut levels = vec![1u64; blocks as usize];
        let (mut depths, mut exponents) = (0, [0; 16]);
        for number in 0..blocks {
            let block = image.block(number).expect("the image was read");
            exponents[block.exponent as usize] += 1;
            let level = levels[number as usize];
            for link in block.links {
                match link {
                    Link::None => {}
                    Link::Leaf(_) => depths += level,
                    Link::Inner(other) => levels[other as usize] = level + 1,
                }
            }
        }
        Self {
            bytes: image.header().size(),
            directions: format.k(),
            offset_bits: format.offset_bits,
            origin_fraction: format.origin_fraction(),
            grid_fraction: format.grid_fraction(),
            transform_width: format.transform_width,
            int_bits: format.int_bits,
            sticky: format.sticky,
            blocks,
            bytes_per_block: format.block().stride,
            triangles,
            bytes_per_triangle: format.triangle().stride,
            power,
            centre,
            height,
            mean_depth: if triangles == 0 { 0.0 } else { depths as f64 / f64::from(triangles) },
            exponents,
        }
    }

    fn table(&self) -> String {
        let mut text = String::new();
        let [x, y, z] = self.centre.map(readable);
        let sticky = if self.sticky { ", sticky bits" } else { "" };
        let rows = [
            ("size", format!("{} bytes", self.bytes)),
            ("directions", self.directions.to_string()),
            ("code", format!("{} bits, steps of 2^exponent 2^-{}", self.offset_bits, self.grid_fraction)),
            ("origin", format!("steps of 2^-{}", self.origin_fraction)),
            ("number of a triangle", format!("s{0}.{1}{sticky}", self.int_bits, self.transform_width - self.int_bits)),
            ("blocks", format!("{} of {} bytes", self.blocks, self.bytes_per_block)),
            ("triangles", format!("{} of {} bytes", self.triangles, self.bytes_per_triangle)),
            ("scale", format!("2^{}", self.power)),
            ("centre", format!("{x} {y} {z}")),
            ("height", format!("{}, mean depth of a triangle {:.2}", self.height, self.mean_depth)),
        ];
        for (name, value) in rows {
            let _ = writeln!(text, "{name:<24}{value}");
        }
        for (exponent, count) in self.exponents.iter().enumerate().filter(|(_, count)| **count > 0) {
            let _ = writeln!(text, "{:<24}{}", format!("exponent {exponent}"), counted(*count, "blocks"));
        }
        text
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let report = Report::new(&read(&arguments.file, Failure::Usage)?);
    if arguments.json { print_json(&report) } else { print(&report.table()) }
}
