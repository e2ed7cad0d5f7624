//! Project files for ISE, for devices that it knows: the last release with Virtex-II is 10.1, Spartan-6 ends with 14.7.

use super::packaged::Packaged;
use crate::artefact::files::project::Project;
use crate::artefact::{FileSet, origin};
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
    stem: &'a str,
    top: &'a str,
    part: &'a str,
    options: &'a [Setting],
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
    stem: &'a str,
    top: &'a str,
    project: String,
    releases: &'static str,
    family: &'static str,
    device: &'static str,
    package: &'static str,
    speed: &'static str,
    options: &'a [Setting],
    files: &'a [String],
}

/// An option of XST: its name and value on the command line, and the same as a property of a project.
struct Setting {
    option: &'static str,
    value: &'static str,
    property: &'static str,
    property_value: &'static str,
}

/// Options for every family. Registers stay where the schedule has put them: a register that moved out of an entity of a product
/// would not become part of the multiplier.
const OPTIONS: [[&str; 4]; 7] = [
    ["opt_mode", "Speed", "Optimization Goal", "Speed"],
    ["opt_level", "1", "Optimization Effort", "Normal"],
    ["keep_hierarchy", "NO", "Keep Hierarchy", "No"],
    ["glob_opt", "AllClockNets", "Global Optimization Goal", "AllClockNets"],
    ["register_balancing", "No", "Register Balancing", "No"],
    ["shreg_extract", "YES", "Shift Register Extraction", "true"],
    ["iobuf", "NO", "Add I/O Buffers", "false"],
];

/// Adds the project if ISE knows the device.
pub(super) fn add(packaged: &Packaged<'_>, set: &mut FileSet) -> Option<Project> {
    let (releases, ending, own): (_, _, &[[&str; 4]]) = match packaged.device.family {
        Family::Virtex2 => (
            "ISE 8.1 to 10.1",
            "ise",
            &[
                ["mult_style", "auto", "Multiplier Style", "Auto"],
                ["max_fanout", "500", "Max Fanout", "500"],
                ["slice_utilization_ratio", "100", "Slice Utilization Ratio", "100"],
            ],
        ),
        Family::Spartan6 => (
            "ISE 14.7",
            "xise",
            &[
                ["use_dsp48", "Auto", "Use DSP Block", "Auto"],
                ["max_fanout", "100000", "Max Fanout", "100000"],
                ["shreg_min_size", "2", "Shift Register Minimum Size", "2"],
            ],
        ),
        Family::Series7 | Family::UltraScalePlus | Family::Ecp5 | Family::Nexus => return None,
    };
    let setting = |&[option, value, property, property_value]: &[&'static str; 4]| Setting {
        option,
        value,
        property,
        property_value,
    };
    let options = &OPTIONS.iter().chain(own).map(setting).collect::<Vec<_>>()[..];
    let header = &origin()[..];
    let Part { family, device, package, speed } = packaged.device.part;
    let part = format!("{device}{speed}-{package}");
    let (top, files, stem) = (&packaged.lists.top[..], &packaged.lists.synthesised[..], &packaged.file("")[..]);
    let project = packaged.file(&format!(".{ending}"));
    let script = ProjectScript { header, stem, top, project, releases, family, device, package, speed, options, files };
    let texts = [
        (".prj", SourceList { files }.render()),
        (".xst", Script { stem, top, part: &part, options }.render()),
        (".ucf", Constraints { header, frequency: packaged.frequency }.render()),
    ];
    for (ending, text) in texts {
        set.insert(format!("ise/{stem}{ending}"), text.expect("the template renders"));
    }
    set.insert("ise/project.tcl", script.render().expect("the template renders"));
    let how = format!("`xtclsh project.tcl`, or `xst -ifn {stem}.xst`");
    Some(Project { folder: "ise".to_owned(), tool: releases, part, how })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What an option means on the command line and in the project.
    #[test]
    fn option_and_property_say_the_same() {
        for [option, value, property, of_property] in OPTIONS {
            let same = value.eq_ignore_ascii_case(of_property);
            let other = [("YES", "true"), ("NO", "false"), ("1", "Normal")].contains(&(value, of_property));
            assert!(same || other, "{option} {value}, {property} {of_property}");
        }
    }
}
