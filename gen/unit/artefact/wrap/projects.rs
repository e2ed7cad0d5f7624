//! What is around a core for tools of others: projects, constraints, an instance to copy, a test in cocotb.

use super::packaged::Packaged;
use super::{drop_in, ise, vivado};
use crate::artefact::FileSet;
use crate::artefact::files::core::FileRow;
use crate::artefact::files::project::Project;

/// Adds all files; what each is, and the projects of tools that know the device.
pub fn add(packaged: &Packaged<'_>, set: &mut FileSet) -> (Vec<FileRow>, Vec<Project>) {
    let mut rows = drop_in::add(packaged, set);
    let clock = packaged.file(".sdc");
    set.insert(&clock, packaged.clock());
    rows.push(FileRow::new(&clock, "The clock of the core as SDC, to read out of context."));
    let projects = [ise::add(packaged, set), vivado::add(packaged, set)];
    (rows, projects.into_iter().flatten().collect())
}
