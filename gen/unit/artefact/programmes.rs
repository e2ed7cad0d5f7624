//! The schedules of a design as linear programs, for any solver.

use super::FileSet;
use super::files::manifest;
use crate::design::Design;
use std::fmt::Write;

/// The table of units.
pub const UNITS: &str = "units.csv";

/// One file in CPLEX LP format per unit, and a table of units with their instances and the register bits that the
/// scheduler's own solution takes by the programme.
pub fn programme_files(design: &Design, command_line: &str) -> FileSet {
    let mut set = FileSet::default();
    let mut units = "unit,instances,register_bits\n".to_owned();
    for (schedule, instances) in design.schedules() {
        let name = &schedule.block.name;
        let doc = format!("The schedule of {name} in {} clocks; {command_line}", schedule.latency);
        set.insert(format!("{name}.lp"), schedule.program.text(&doc));
        let _ = writeln!(units, "{name},{instances},{}", schedule.register_bits);
    }
    set.insert(UNITS, units);
    let manifest = manifest::text(design, None, command_line, &set);
    set.insert(manifest::NAME, manifest);
    set
}
