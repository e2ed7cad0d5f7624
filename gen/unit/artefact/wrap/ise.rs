//! Project files for ISE, for devices that it knows: the last release with Virtex-II is 10.1, Spartan-6 ends with 14.7.

use crate::artefact::files::project::Project;
use crate::artefact::{FileSet, Prefix, origin};
use crate::design::Design;
use askama::Template;
use efsat_hardware::device::{Family, Part};

#[derive(Template)]
#[template(path = "ise/efsat.prj", escape = "none")]
struct SourceList<'a> {
    files: &'a [String],
}

#[derive(Template)]
#[template(path = "ise/efsat.xst", escape = "none")]
struct Script<'a> {
    prefix: &'a Prefix,
    part: &'a str,
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

/// Adds the project if ISE knows the device; `sources` are the synthesizable files in dependency order.
pub(in crate::artefact) fn add(
    set: &mut FileSet,
    design: &Design,
    prefix: &Prefix,
    sources: &[String],
) -> Option<Project> {
    let (releases, ending, options): (_, _, &[&str]) = match design.device.family {
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
        Family::Series7 | Family::UltraScalePlus | Family::Ecp5 => return None,
    };
    let header = &origin()[..];
    let Part { family, device, package, speed } = design.device.part;
    let part = format!("{device}{speed}-{package}");
    let project = format!("{prefix}efsat.{ending}");
    let script = ProjectScript { header, prefix, project, releases, family, device, package, speed, files: sources };
    let constraints = Constraints { header, frequency: design.params.frequency };
    let texts = [
        (prefix.of("efsat.prj"), SourceList { files: sources }.render()),
        (prefix.of("efsat.xst"), Script { prefix, part: &part, options }.render()),
        (prefix.of("efsat.ucf"), constraints.render()),
        ("project.tcl".to_owned(), script.render()),
    ];
    for (name, text) in texts {
        set.insert(format!("ise/{name}"), text.expect("the template renders"));
    }
    let how = format!("`xtclsh project.tcl`, or `xst -ifn {prefix}efsat.xst`");
    Some(Project { folder: "ise".to_owned(), tool: releases, part, how })
}
