//! A core as its projects see it: names, device, clock, files, and ports.

use crate::artefact::files::core::Core;
use crate::artefact::files::file_lists::FileLists;
use crate::artefact::{FileSet, Prefix, origin};
use askama::Template;
use efsat_hardware::device::Device;

/// A core as its projects see it. What they need of its hardware they read from its VHDL, which is in the set.
pub struct Packaged<'a> {
    /// The core.
    pub core: &'a Core,
    /// What stands before all names.
    pub prefix: &'a Prefix,
    /// Its name in a library of FuseSoC.
    pub name: &'a str,
    /// Its pace, for a catalogue.
    pub pace: &'a str,
    /// The command line that made it.
    pub command_line: &'a str,
    /// The device.
    pub device: &'static Device,
    /// The clock in MHz.
    pub frequency: u32,
    /// Its files.
    pub lists: &'a FileLists,
    /// The entities that one may instantiate, the outermost first.
    pub instances: &'a [String],
}

/// A port of an entity, as VHDL has it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Port {
    pub(super) name: String,
    pub(super) ty: String,
}

/// The ports of an entity, from its text.
pub(super) fn ports(text: &str) -> Vec<Port> {
    let lines = text.lines().skip_while(|line| line.trim() != "port (").skip(1).take_while(|line| line.trim() != ");");
    let port = |line: &str| {
        let (name, rest) = line.split("--").next()?.split_once(" : ")?;
        let ty = rest.split(" := ").next()?.trim().trim_end_matches(';');
        let ty = ty.trim_start_matches("inout ").trim_start_matches("in ").trim_start_matches("out ").trim();
        Some(Port { name: name.trim().to_owned(), ty: ty.to_owned() })
    };
    lines.filter_map(port).collect()
}

#[derive(Template)]
#[template(path = "drop-in/clock.sdc", escape = "none")]
struct Clock<'a> {
    header: &'a [String],
    top: &'a str,
    period: String,
}

impl Packaged<'_> {
    /// The name of a file of the core.
    pub(super) fn file(&self, ending: &str) -> String {
        format!("{}{}{ending}", self.prefix, self.core.stem)
    }

    /// The ports of an entity whose file is in the set.
    pub(super) fn ports(&self, set: &FileSet, entity: &str) -> Vec<Port> {
        ports(set.get(&format!("{entity}.vhd")).expect("a core has its VHDL before its projects"))
    }

    /// The clock as SDC, which Vivado reads as XDC.
    pub(super) fn clock(&self) -> String {
        let picoseconds = 1_000_000 / self.frequency;
        let period = format!("{}.{:03}", picoseconds / 1000, picoseconds % 1000);
        Clock { header: &origin(), top: &self.lists.top, period }.render().expect("the template renders")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ports_are_read_as_they_are_written() {
        let text = "entity a is\n  generic (\n    n : natural\n  );\n  port (\n    clk  : in  std_logic;\n    -- why : not\n    \
                    x : in std_logic_vector(7 downto 0) := (others => '1');  -- bytes : eight\n    y : out std_logic\n  );\n\
                    end entity a;\n  signal z : std_logic;\n";
        let port = |name: &str, ty: &str| Port { name: name.to_owned(), ty: ty.to_owned() };
        let expected = [port("clk", "std_logic"), port("x", "std_logic_vector(7 downto 0)"), port("y", "std_logic")];
        assert_eq!(ports(text), expected);
    }
}
