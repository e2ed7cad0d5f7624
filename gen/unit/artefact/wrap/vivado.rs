//! Project and IP packaging for Vivado, for devices that it knows.

use super::packaged::Packaged;
use crate::artefact::files::project::Project;
use crate::artefact::{FileSet, origin};
use askama::Template;
use efsat_hardware::device::Family;

#[derive(Template)]
#[template(path = "vivado/project.tcl", escape = "none")]
struct Script<'a> {
    header: &'a [String],
    stem: &'a str,
    top: &'a str,
    part: &'a str,
    sources: &'a [String],
}

#[derive(Template)]
#[template(path = "vivado/package_ip.tcl", escape = "none")]
struct PackageIp<'a> {
    header: &'a [String],
    stem: &'a str,
    top: &'a str,
    interfaces: Vec<Interface<'a>>,
    has_irq: bool,
    part: &'a str,
    family: String,
    name: String,
    ip_version: String,
    what: &'a str,
    pace: &'a str,
    command_line: &'a str,
    sources: &'a [String],
}

/// A bus of the top, which Vivado recognises by the names of its ports.
struct Interface<'a> {
    name: &'a str,
    what: &'static str,
}

/// What a bus is that has a port with such an end of its name.
const INTERFACES: [(&str, &str); 3] = [("_awaddr", "AXI4-Lite"), ("_tdata", "AXI4-Stream"), ("_araddr", "AXI4")];

/// Adds the project if Vivado knows the device.
pub(super) fn add(packaged: &Packaged<'_>, set: &mut FileSet) -> Option<Project> {
    match packaged.device.family {
        Family::Series7 | Family::UltraScalePlus => {}
        Family::Virtex2 | Family::Spartan6 | Family::Ecp5 | Family::Nexus => return None,
    }
    let Packaged { lists, pace, command_line, core, .. } = *packaged;
    let (sources, top, stem) = (&lists.synthesised[..], &lists.top[..], &packaged.file("")[..]);
    let device = packaged.device.part;
    let header = &origin()[..];
    let part = &format!("{}{}{}", device.device, device.package, device.speed)[..];
    // An IP has a name as VHDL has them, and a version of two numbers.
    let name = packaged.name.rsplit(':').next().unwrap_or_default().replace('-', "_");
    let ip_version = env!("CARGO_PKG_VERSION").split('.').take(2).collect::<Vec<_>>().join(".");
    let ports = packaged.ports(set, top);
    let has = |name: &str| ports.iter().any(|port| port.name == name);
    // Of the registers the one that writes comes first, and names the bus.
    let mut interfaces: Vec<Interface<'_>> = vec![];
    for port in &ports {
        let bus = INTERFACES.iter().find_map(|(end, what)| Some((port.name.strip_suffix(end)?, what)));
        if let Some((name, what)) = bus.filter(|(name, _)| interfaces.iter().all(|one| one.name != *name)) {
            interfaces.push(Interface { name, what });
        }
    }
    let ip = PackageIp {
        header,
        stem,
        top,
        interfaces,
        has_irq: has("irq"),
        part,
        family: device.family.to_lowercase(),
        name,
        ip_version,
        what: core.what,
        pace,
        command_line,
        sources,
    };
    let texts = [
        ("project.tcl".to_owned(), Script { header, stem, top, part, sources }.render()),
        ("package_ip.tcl".to_owned(), ip.render()),
        (format!("{stem}_ooc.xdc"), Ok(packaged.clock())),
    ];
    for (name, text) in texts {
        set.insert(format!("vivado/{name}"), text.expect("the template renders"));
    }
    let how = "`vivado -mode batch -source project.tcl` synthesises, `-source package_ip.tcl` makes an IP".to_owned();
    Some(Project { folder: "vivado".to_owned(), tool: "Vivado", part: part.to_owned(), how })
}
