//! `efsat tree answer`.

use super::{hexadecimal, read};
use crate::error::Failure;
use crate::output::print_json;
use crate::params::{EngineArguments, ParamArguments, whole};
use efsat_engine::host::{Image, Layout, Numbers, memory};
use efsat_engine::model::{Model, Query};
use efsat_engine::words::{EngineAnswer, QueryFlags};
use efsat_unit::design::top::DesignError;
use serde::Serialize;
use std::path::PathBuf;

/// Prints what the engine is sent to find the triangles of two images that touch, and what it answers by its reference model, as one
/// JSON object
///
/// Words are 16 hexadecimal digits. Behind an AXI4 read master the images lie in memory one after the other from address 0 on. The
/// options are those that the engine was generated with.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// An image made by efsat tree build
    #[arg(value_name = "A")]
    a: PathBuf,
    /// Another one, built --beside the mesh of the first; or the same
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Where B is from A: twelve numbers m00,m01,m02,m10,...,m22,tx,ty,tz, so that the point y of B is at M y + t
    #[arg(
        long,
        value_name = "NUMBERS",
        required = true,
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true
    )]
    pose: Vec<f64>,
    /// Stop at the first certain contact, which need not be that of the reference model
    #[arg(long)]
    first_contact: bool,
    /// A number that the report returns
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole(0..=QueryFlags::NUMBERS - 1), allow_negative_numbers = true)]
    number: u32,
    #[command(flatten)]
    params: ParamArguments,
    #[command(flatten)]
    engine_params: EngineArguments,
}

/// What is printed. Words are 16 hexadecimal digits.
#[derive(Serialize)]
struct Written {
    /// The packets that fill block RAM.
    loads: Vec<Vec<String>>,
    query: Vec<String>,
    expected: Expected,
}

/// What the reference model answers, but for what depends on time and memory.
#[derive(Serialize)]
struct Expected {
    reason: u8,
    /// The words of pairs, in ascending order.
    answers: Vec<String>,
    expansions: u32,
    tests: u32,
    survivors: u32,
    leaf_pairs: u32,
    intersect: u32,
    possibly_incorrect: u32,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let &[m00, m01, m02, m10, m11, m12, m20, m21, m22, x, y, z] = &arguments.pose[..] else {
        let count = arguments.pose.len();
        return Err(Failure::Usage(format!("--pose: found {count} numbers; expected 12, nine of M and three of t")));
    };
    if let Some(number) = arguments.pose.iter().find(|number| !number.is_finite()) {
        return Err(Failure::Usage(format!("--pose: found {number}; expected finite numbers")));
    }
    let design = arguments.engine_params.design(&arguments.params)?;
    let (params, unit) = (&design.params, &design.unit.params);
    let mut images = vec![read(&arguments.a, Failure::Usage)?];
    if arguments.b != arguments.a {
        images.push(read(&arguments.b, Failure::Usage)?);
    }
    let images: Vec<&Image> = images.iter().collect();
    let numbers = Numbers::new(params, unit).map_err(DesignError::from)?;
    let layout = Layout::new(params, numbers.format(), &images).map_err(DesignError::from)?;
    let (memory, sides) = memory(&images);
    let ends = [0, images.len() - 1];
    let query = numbers
        .query(ends.map(|i| (images[i], sides[i])), &[[m00, m01, m02], [m10, m11, m12], [m20, m21, m22]], &[x, y, z])
        .map_err(|refusal| Failure::Usage(format!("the engine does not take this query: {refusal}")))?;
    let Arguments { first_contact, number, .. } = *arguments;
    let query = Query { first_contact, number, ..query };
    let model = Model::new(params, unit).map_err(DesignError::from)?;
    let outcome = model.run(&memory, &query.words(numbers.format()));
    let mut answers: Vec<u64> = outcome.answers.iter().map(EngineAnswer::word).collect();
    answers.sort_unstable();
    let report = outcome.report;
    print_json(&Written {
        loads: layout.loads.iter().map(|load| hexadecimal(load)).collect(),
        query: hexadecimal(&layout.moved(&query, &sides).words(numbers.format())),
        expected: Expected {
            reason: report.reason as u8,
            answers: hexadecimal(&answers),
            expansions: report.expansions,
            tests: report.tests,
            survivors: report.survivors,
            leaf_pairs: report.leaf_pairs,
            intersect: report.intersect,
            possibly_incorrect: report.possibly_incorrect,
        },
    })
}
