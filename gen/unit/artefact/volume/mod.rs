//! The VHDL sources of a volume unit.

use super::{Prefix, origin};
use crate::design::engine::volume_unit::VolumeDesign;
use askama::Template;
use efsat_hardware::vhdl::{self, Clash};

/// Name of the entity, without a prefix.
pub const NAME: &str = "volume_unit";

/// Name of its package of types.
pub const PACKAGE: &str = "volume_types";

/// A port and what is in it.
struct Word {
    name: &'static str,
    bits: u32,
    /// Of each number: the port of the stage, the lowest and the highest bit, and whether that is one.
    numbers: Vec<(String, u32, u32, bool)>,
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

/// Name and text of each source file, in dependency order: the package, the entities of the data path, the unit. All names
/// begin with the prefix.
///
/// # Errors
/// A name that some tool would refuse.
pub fn volume_files(design: &VolumeDesign, prefix: &Prefix) -> Result<Vec<(String, String)>, Clash> {
    let mut files = vhdl::print(&design.stage, &prefix.of(""), PACKAGE, &origin())?;
    let flag = |port: &str| port.contains("_take");
    let numbers = |(port, low, bits): (String, u32, u32)| {
        let single = flag(&port);
        (port, low, low + bits - 1, single)
    };
    let words = design.words().into_iter().map(|word| Word {
        name: word.name,
        bits: word.bits,
        numbers: word.numbers.into_iter().map(numbers).collect(),
    });
    let unit = VolumeUnit {
        header: origin(),
        prefix,
        interval: design.interval,
        latency: design.latency,
        words: words.collect(),
    };
    files.push((prefix.of(NAME), unit.render().expect("the template renders")));
    Ok(files.into_iter().map(|(name, text)| (format!("{name}.vhd"), text)).collect())
}
