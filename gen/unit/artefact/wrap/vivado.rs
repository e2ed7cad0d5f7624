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
    interfaces: Vec<Interface>,
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
struct Interface {
    name: &'static str,
    what: &'static str,
}

/// A bus, what it is, and a port that it has.
const INTERFACES: [(&str, &str, &str); 4] = [
    ("s_axi", "AXI4-Lite", "s_axi_awaddr"),
    ("s_axis", "AXI4-Stream", "s_axis_tdata"),
    ("m_axis", "AXI4-Stream", "m_axis_tdata"),
    ("m_axi", "AXI4", "m_axi_araddr"),
];

/// Adds the project if Vivado knows the device.
pub(super) fn add(packaged: &Packaged<'_>, set: &mut FileSet) -> Option<Project> {
    match packaged.device.family {
        Family::Series7 | Family::UltraScalePlus => {}
        Family::Virtex2 | Family::Spartan6 | Family::Ecp5 => return None,
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
    let buses = INTERFACES.iter().filter(|(_, _, port)| has(port));
    let interfaces = buses.map(|&(name, what, _)| Interface { name, what }).collect();
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
