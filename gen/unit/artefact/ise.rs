//! Project files for ISE, one folder a device that ISE knows: the last release with Virtex-II is 10.1, Spartan-6 ends
//! with 14.7. Other families have other tools and no project here.

use super::{FileSet, Prefix, origin};
use crate::design::Design;
use askama::Template;
use efsat_hardware::device::{self, Device, Family};

#[derive(Template)]
#[template(path = "ise/efsat.prj", escape = "none")]
struct SourceList<'a> {
    files: &'a [String],
}

#[derive(Template)]
#[template(path = "ise/efsat.xst", escape = "none")]
struct Script<'a> {
    prefix: &'a Prefix,
    part: String,
    options: &'static [&'static str],
}

#[derive(Template)]
#[template(path = "ise/efsat.ucf", escape = "none")]
struct Constraints<'a> {
    header: &'a [String],
    frequency: u32,
}

#[derive(Template)]
#[template(path = "ise/project.tcl", escape = "none")]
struct ProjectScript<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    project: String,
    releases: &'static str,
    family: &'static str,
    device: &'static str,
    package: &'static str,
    speed: &'static str,
    files: &'a [String],
}

/// What differs between the releases of ISE that serve a device.
pub(super) struct Project {
    /// The part as XST writes it.
    pub part: String,
    /// Where the files are.
    pub folder: String,
    /// The releases.
    pub releases: &'static str,
    /// What the name of the project ends in.
    ending: &'static str,
    /// Options of XST that others do not know.
    options: &'static [&'static str],
    device: &'static Device,
}

impl Project {
    /// The project of a device, if ISE knows its family.
    fn new(device: &'static Device) -> Option<Self> {
        let part = device.part;
        let (releases, ending, options): (_, _, &[&str]) = match device.family {
            Family::Virtex2 => (
                "ISE 8.1 to 10.1",
                "ise",
                &["-glob_opt AllClockNets", "-mult_style auto", "-max_fanout 500", "-slice_utilization_ratio 100"],
            ),
            Family::Spartan6 => (
                "ISE 14.7",
                "xise",
                &["-glob_opt AllClockNets", "-use_dsp48 Auto", "-max_fanout 100000", "-shreg_min_size 2"],
            ),
            Family::Series7 | Family::Ecp5 => return None,
        };
        Some(Self {
            part: format!("{}{}-{}", part.device, part.speed, part.package),
            folder: format!("ise/{}", part.family.to_lowercase()),
            releases,
            ending,
            options,
            device,
        })
    }
}

/// One project a device of ISE.
pub(super) fn projects() -> Vec<Project> {
    device::all().iter().filter_map(Project::new).collect()
}

/// Adds all projects; `sources` are the synthesizable files in dependency order.
pub(super) fn add(set: &mut FileSet, design: &Design, prefix: &Prefix, sources: &[String]) {
    let header = origin();
    for project in projects() {
        let part = project.device.part;
        let script = ProjectScript {
            header: &header,
            prefix,
            project: format!("{prefix}efsat.{}", project.ending),
            releases: project.releases,
            family: part.family,
            device: part.device,
            package: part.package,
            speed: part.speed,
            files: sources,
        };
        let constraints = Constraints { header: &header, frequency: design.params.frequency };
        let options = Script { prefix, part: project.part, options: project.options };
        let texts =
            [("prj", SourceList { files: sources }.render()), ("xst", options.render()), ("ucf", constraints.render())];
        for (ending, text) in texts {
            let name = format!("{}/{prefix}efsat.{ending}", project.folder);
            set.insert(name, text.expect("the template renders"));
        }
        set.insert(format!("{}/project.tcl", project.folder), script.render().expect("the template renders"));
    }
}
