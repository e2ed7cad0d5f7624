//! What a generated core is called, and the table of its files.

use super::project::Project;

/// A core with an AXI4-Stream in and one out.
#[derive(Debug, PartialEq, Eq)]
pub struct Core {
    /// What sentences call it.
    pub name: &'static str,
    /// What it is, in a line of a catalogue.
    pub what: &'static str,
    /// The entity with the streams, without a prefix.
    pub entity: &'static str,
    /// Its instance in the example.
    pub label: &'static str,
    /// Files that are named after it, without a prefix and an ending: of projects, and its copy in Verilog.
    pub stem: &'static str,
    /// The target of the testbench whose vectors are words of its streams.
    pub played: &'static str,
    /// Words of a report behind the pairs of a packet, which then are in any order; 0 if there is none.
    pub report_words: usize,
    /// Whether packets are answered in their order.
    pub in_order: bool,
    /// What the example says of its packets, in lines of a header.
    pub packets: &'static [&'static str],
}

impl Core {
    /// The unit in its stream wrapper.
    pub const UNIT: Self = Self {
        name: "unit",
        what: "EFSAT, an exact triangle-triangle intersection unit",
        entity: "efsat_stream",
        label: "wrapper",
        stem: "efsat",
        played: "sim_stream",
        report_words: 0,
        in_order: true,
        packets: &[
            "byte first. A packet that is no whole words is answered as malformed. A record takes far longer to arrive than its",
            "answer to leave, so nothing waits here and no handshake is needed.",
        ],
    };
}

/// A line of the table of files in the README of a core.
#[derive(Debug)]
pub struct FileRow {
    /// A file or a folder.
    pub name: String,
    /// What it is.
    pub what: String,
}

impl FileRow {
    /// The line of a file.
    pub fn new(name: &str, what: &str) -> Self {
        Self { name: name.to_owned(), what: what.to_owned() }
    }

    /// The line of a project.
    pub fn of_project(project: &Project) -> Self {
        Self { name: project.folder.clone(), what: format!("Project for {}, part {}.", project.tool, project.part) }
    }

    /// The line of a file in Verilog.
    pub fn of_verilog(name: &str) -> Self {
        Self::new(name, "A copy in Verilog, made by GHDL.")
    }
}
