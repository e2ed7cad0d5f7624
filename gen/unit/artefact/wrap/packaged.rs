//! A core as its projects see it: names, device, clock, files, and ports.

use crate::artefact::files::core::Core;
use crate::artefact::files::file_lists::{BenchFiles, FileLists};
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
    pub(super) direction: String,
    pub(super) ty: String,
    /// What it is if it is left open; nothing if it must not be.
    open: Option<String>,
    /// The comment behind it.
    note: String,
}

/// Ports that follow each other and differ in their names alone.
struct PortRow<'a> {
    port: &'a Port,
    /// The name of the last one, if they are several.
    last: Option<&'a str>,
}

impl<'a> PortRow<'a> {
    fn new(ports: &'a [Port]) -> Self {
        Self { port: &ports[0], last: ports[1..].last().map(|last| &last.name[..]) }
    }

    fn bits(&self) -> u32 {
        let range =
            self.port.ty.split_once('(').and_then(|(_, range)| range.split(" downto ").next()?.parse::<u32>().ok());
        range.map_or(1, |high| high + 1)
    }

    fn open(&self) -> &str {
        match self.port.open.as_deref().unwrap_or_default() {
            "(others => '0')" => "0",
            "(others => '1')" => "ones",
            value => value.trim_matches(['"', '\'']),
        }
    }
}

/// An entity and its ports.
struct PortTable<'a> {
    entity: &'a str,
    rows: Vec<PortRow<'a>>,
}

impl<'a> PortTable<'a> {
    fn new(entity: &'a str, ports: &'a [Port]) -> Self {
        let alike = |a: &Port, b: &Port| {
            // A format is the same in neighbours; any other note is about one port.
            let format = a.note.is_empty() || a.note.starts_with(['s', 'u']) && !a.note.contains(' ');
            let stems = [a, b].map(|port| port.name.split('_').next());
            let same = (&a.direction, &a.ty, &a.open, &a.note) == (&b.direction, &b.ty, &b.open, &b.note);
            same && format && a.ty != "std_logic" && stems[0] == stems[1]
        };
        Self { entity, rows: ports.chunk_by(alike).map(PortRow::new).collect() }
    }
}

#[derive(Template)]
#[template(path = "drop-in/ports.md", escape = "none")]
struct PortTables<'a> {
    tables: Vec<PortTable<'a>>,
}

#[derive(Template)]
#[template(path = "drop-in/simulate.md", escape = "none")]
struct Simulation<'a> {
    name: &'a str,
    stem: String,
    first: &'a BenchFiles,
    benches: &'a [BenchFiles],
}

/// The ports of an entity, from its text. What stands above a port is said of it, too.
pub(super) fn ports(text: &str) -> Vec<Port> {
    let lines = text.lines().skip_while(|line| line.trim() != "port (").skip(1).take_while(|line| line.trim() != ");");
    let mut above = String::new();
    let port = |line: &str| {
        if let Some(comment) = line.trim().strip_prefix("--") {
            above += comment;
            return None;
        }
        let (code, behind) = line.split_once("--").unwrap_or((line, ""));
        let note = std::mem::take(&mut above) + behind;
        let (name, rest) = code.split_once(" : ")?;
        let (direction, rest) = rest.trim().split_once(' ')?;
        let rest = rest.trim().trim_end_matches(';');
        let (ty, open) = rest.split_once(" := ").map_or((rest, None), |(ty, open)| (ty, Some(open.to_owned())));
        let [name, direction, ty, note] = [name, direction, ty, &note].map(|text| text.trim().to_owned());
        Some(Port { name, direction, ty, open, note })
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

    /// The ports of all entities that one may instantiate, as tables in Markdown.
    pub fn port_tables(&self, set: &FileSet) -> String {
        let all: Vec<_> = self.instances.iter().map(|entity| (entity, self.ports(set, entity))).collect();
        let tables = all.iter().map(|(entity, ports)| PortTable::new(entity, ports)).collect();
        PortTables { tables }.render().expect("the template renders")
    }

    /// How to run the testbenches, in Markdown.
    pub fn simulation(&self) -> String {
        let benches = &self.lists.benches;
        Simulation { name: self.name, stem: self.file(""), first: &benches[0], benches }
            .render()
            .expect("the template renders")
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
        let port = |name: &str, direction: &str, ty: &str| Port {
            name: name.to_owned(),
            direction: direction.to_owned(),
            ty: ty.to_owned(),
            open: None,
            note: String::new(),
        };
        let x = port("x", "in", "std_logic_vector(7 downto 0)");
        let x = Port { open: Some("(others => '1')".to_owned()), note: "why : not bytes : eight".to_owned(), ..x };
        assert_eq!(ports(text), [port("clk", "in", "std_logic"), x, port("y", "out", "std_logic")]);
    }
}
