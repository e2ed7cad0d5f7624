//! Project and IP packaging for Vivado, for devices that it knows.

use super::drop_in::core_name;
use crate::artefact::files::file_lists::FileLists;
use crate::artefact::files::project::Project;
use crate::artefact::{FileSet, Packaging, Prefix, origin};
use crate::design::Design;
use askama::Template;
use efsat_hardware::device::Family;

#[derive(Template)]
#[template(path = "vivado/project.tcl", escape = "none")]
struct Script<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    top: &'a str,
    part: &'a str,
    sources: &'a [String],
}

#[derive(Template)]
#[template(path = "vivado/efsat.xdc", escape = "none")]
struct Constraints<'a> {
    header: &'a [String],
    period: String,
}

#[derive(Template)]
#[template(path = "vivado/package_ip.tcl", escape = "none")]
struct PackageIp<'a> {
    header: &'a [String],
    top: &'a str,
    has_registers: bool,
    part: &'a str,
    family: String,
    name: String,
    ip_version: String,
    interval: usize,
    command_line: &'a str,
    sources: &'a [String],
}

/// Adds the project if Vivado knows the device.
pub(in crate::artefact) fn add(
    set: &mut FileSet,
    design: &Design,
    packaging: &Packaging,
    command_line: &str,
    lists: &FileLists,
) -> Option<Project> {
    let (sources, top) = (&lists.synthesised()[..], &lists.top[..]);
    let device = design.device.part;
    match design.device.family {
        Family::Series7 | Family::UltraScalePlus => {}
        Family::Virtex2 | Family::Spartan6 | Family::Ecp5 => return None,
    }
    let (header, prefix) = (&origin()[..], &packaging.prefix);
    let part = &format!("{}{}{}", device.device, device.package, device.speed)[..];
    let picoseconds = 1_000_000 / design.params.frequency;
    let period = format!("{}.{:03}", picoseconds / 1000, picoseconds % 1000);
    // An IP has a name as VHDL has them, and a version of two numbers.
    let name = core_name(&design.params, packaging).rsplit(':').next().unwrap_or_default().replace('-', "_");
    let ip_version = env!("CARGO_PKG_VERSION").split('.').take(2).collect::<Vec<_>>().join(".");
    let (family, interval) = (device.family.to_lowercase(), design.interval);
    let ip = PackageIp {
        header,
        top,
        has_registers: packaging.registers,
        part,
        family,
        name,
        ip_version,
        interval,
        command_line,
        sources,
    };
    let texts = [
        ("project.tcl".to_owned(), Script { header, prefix, top, part, sources }.render()),
        (prefix.of("efsat.xdc"), Constraints { header, period }.render()),
        ("package_ip.tcl".to_owned(), ip.render()),
    ];
    for (name, text) in texts {
        set.insert(format!("vivado/{name}"), text.expect("the template renders"));
    }
    let how = "`vivado -mode batch -source project.tcl` synthesises, `-source package_ip.tcl` makes an IP".to_owned();
    Some(Project { folder: "vivado".to_owned(), tool: "Vivado", part: part.to_owned(), how })
}
