//! The files of a volume unit: VHDL sources, a testbench, and what it reads.

mod stimulus;

pub use stimulus::{Expansion, VolumeStimulus};

use crate::design::volume_unit::{VolumeDesign, WordPort};
use askama::Template;
use efsat_hardware::vhdl::{self, Clash};
use efsat_unit::artefact::{Prefix, origin};

/// Name of the entity, without a prefix.
pub const NAME: &str = "volume_unit";

/// Name of its testbench, without a prefix.
pub const BENCH: &str = "volume_unit_tb";

/// Name of its package of types, without a prefix.
pub const PACKAGE: &str = "volume_types";

/// A port and the numbers in it.
struct Word {
    name: &'static str,
    high: u32,
    query: bool,
    numbers: Vec<Number>,
}

/// A port of the stage, and its bits in the word.
struct Number {
    port: String,
    high: u32,
    low: u32,
    flag: bool,
}

impl Word {
    fn new(word: WordPort) -> Self {
        let query = word.of_query();
        let number =
            |(port, low, bits): (String, u32, u32)| Number { flag: bits == 1, high: low + bits - 1, low, port };
        let numbers = word.numbers.into_iter().map(number).collect();
        Self { name: word.name, high: word.bits - 1, query, numbers }
    }
}

#[derive(Template)]
#[template(path = "engine/volume_unit.vhd", escape = "none")]
struct VolumeUnit<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    interval: usize,
    latency: usize,
    words: Vec<Word>,
}

#[derive(Template)]
#[template(path = "engine/volume_unit_tb.vhd", escape = "none")]
struct Bench<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    latency: usize,
    words: Vec<Word>,
}

fn words(design: &VolumeDesign) -> Vec<Word> {
    design.words().into_iter().map(Word::new).collect()
}

/// Name and text of each source file, in dependency order: the package, the entities of the data path, the unit. All names
/// begin with the prefix.
///
/// # Errors
/// A name that some tool would refuse.
pub fn volume_files(design: &VolumeDesign, prefix: &Prefix) -> Result<Vec<(String, String)>, Clash> {
    let mut files = vhdl::print(&design.stage, &prefix.of(""), PACKAGE, &origin())?;
    let VolumeDesign { interval, latency, .. } = *design;
    let unit = VolumeUnit { header: origin(), prefix, interval, latency, words: words(design) };
    files.push((prefix.of(NAME), unit.render().expect("the template renders")));
    Ok(files.into_iter().map(|(name, text)| (format!("{name}.vhd"), text)).collect())
}

/// The text of the testbench, which reads the lines of a [`VolumeStimulus`] from a file `volume_unit_tb.vec`.
pub fn volume_bench(design: &VolumeDesign, prefix: &Prefix) -> String {
    let bench = Bench { header: origin(), prefix, latency: design.latency, words: words(design) };
    bench.render().expect("the template renders")
}
