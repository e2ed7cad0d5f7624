//! What a design is on its way to VHDL, as text: graphs, schedules and modules.

use super::FileSet;
use super::files::manifest;
use crate::design::Design;
use efsat_hardware::dump;

/// For every unit its graph and its schedule, and for every entity its module, each a file.
pub fn dump_files(design: &Design, command_line: &str) -> FileSet {
    let mut set = FileSet::default();
    for (schedule, _) in design.schedules() {
        let unit = &schedule.block;
        set.insert(format!("{}.graph.txt", unit.name), dump::block(unit));
        set.insert(format!("{}.schedule.txt", unit.name), dump::schedule(&schedule));
    }
    for module in design.top.hierarchy() {
        set.insert(format!("{}.module.txt", module.name), dump::module(&module));
    }
    let manifest = manifest::text(design, None, command_line, &set);
    set.insert(manifest::NAME, manifest);
    set
}
