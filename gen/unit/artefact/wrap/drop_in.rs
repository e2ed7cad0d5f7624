//! Files that every core has for tools of others: FuseSoC, VUnit, cocotb, and instances to copy.

use super::packaged::{Packaged, Port};
use crate::artefact::files::core::{Core, FileRow};
use crate::artefact::files::file_lists::BenchFiles;
use crate::artefact::{FileSet, Packaging, Prefix, origin};
use crate::params::options::Choice;
use crate::params::{Method, Params};
use crate::words::StreamWidth;
use askama::Template;
use efsat_hardware::device::{Device, Family, OWN, Part};

#[derive(Template)]
#[template(path = "drop-in/efsat.core", escape = "none")]
struct FuseSoc<'a> {
    header: &'a [String],
    name: &'a str,
    what: &'a str,
    top: &'a str,
    version: &'static str,
    device: &'static str,
    synthesis: Synthesis,
    sources: &'a [String],
    example: &'a [String],
    benches: &'a [BenchFiles],
}

/// The tool that synthesises for a device, as FuseSoC calls it, and what it must know.
struct Synthesis {
    tool: &'static str,
    options: Vec<(&'static str, String)>,
}

impl Synthesis {
    fn new(device: &Device) -> Self {
        let Part { family, device: die, package, speed } = device.part;
        let (tool, options): (_, Vec<(_, String)>) = match device.family {
            Family::Virtex2 | Family::Spartan6 => {
                let options = [("family", family), ("device", die), ("package", package), ("speed", speed)];
                ("ise", options.map(|(name, value)| (name, value.to_owned())).into())
            }
            Family::Series7 | Family::UltraScalePlus => {
                ("vivado", vec![("part", format!("{die}{package}{speed}")), ("pnr", "none".to_owned())])
            }
            // In the name of a part Lattice writes the package without its first letters and a C for commercial.
            Family::Ecp5 | Family::Nexus => {
                let tool = if device.family == Family::Ecp5 { "diamond" } else { "radiant" };
                (tool, vec![("part", format!("{die}{speed}{}C", package.replace("CABGA", "BG")))])
            }
        };
        Self { tool, options }
    }
}

/// The name of a core in FuseSoC: by what it differs from the default one of its kind, so that cores of all options can lie in one
/// library; or by the prefix. `differences` are options with their values, or words. Tools take letters, digits, `-` and `_`.
pub fn named(stem: &str, differences: impl Iterator<Item = String>, prefix: &Prefix) -> String {
    let mut name = prefix.of(stem);
    if prefix.name().is_none() {
        let word = |difference: String| difference.trim_end_matches(OWN).replace('+', "plus-").replace(['/', '.'], "-");
        differences.for_each(|difference| name.extend(["-", &word(difference)]));
    }
    format!("efsat:core:{name}")
}

/// The name of a unit.
pub(in crate::artefact) fn core_name(params: &Params, packaging: &Packaging) -> String {
    let method = (params.method != Method::Axes).then(|| params.method.name().to_owned());
    let differences = params.differences(&Params::of(params.method)).into_iter();
    let stream = (packaging.stream_width != StreamWidth::default())
        .then(|| ("stream-width", packaging.stream_width.name().to_owned()));
    let options = differences.chain(stream).map(|(option, value)| format!("{option}-{value}"));
    let registers = packaging.registers.then(|| "registers".to_owned());
    named(Core::UNIT.stem, method.into_iter().chain(options).chain(registers), &packaging.prefix)
}

#[derive(Template)]
#[template(path = "drop-in/run.py", escape = "none")]
struct VUnit<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    benches: &'a [BenchFiles],
}

#[derive(Template)]
#[template(path = "drop-in/efsat_instance.vhd.txt", escape = "none")]
struct Instances<'a> {
    header: &'a [String],
    instances: Vec<Instance<'a>>,
}

struct Instance<'a> {
    entity: &'a str,
    ports: Vec<Port>,
}

#[derive(Template)]
#[template(path = "drop-in/test_efsat.py", escape = "none")]
struct Cocotb<'a> {
    header: &'a [String],
    core: &'a Core,
    entity: String,
    vectors: &'a str,
    report_words: usize,
    /// Its read ports of memory, by what their names begin with.
    memories: Vec<String>,
}

/// Adds all files; what each is.
pub(super) fn add(packaged: &Packaged<'_>, set: &mut FileSet) -> Vec<FileRow> {
    let Packaged { core, prefix, name, device, lists, .. } = *packaged;
    let (header, benches) = (&origin()[..], &lists.benches[..]);
    let fuse_soc = FuseSoc {
        header,
        name,
        what: core.what,
        top: &lists.top,
        version: env!("CARGO_PKG_VERSION"),
        device: device.name,
        synthesis: Synthesis::new(device),
        sources: &lists.synthesised,
        example: &lists.example,
        benches,
    };
    let instance = |entity: &'_ String| packaged.ports(set, entity);
    let instances = packaged.instances.iter().map(|entity| Instance { entity, ports: instance(entity) }).collect();
    let entity = prefix.of(core.entity);
    let ports = packaged.ports(set, &entity);
    let memories = ports.iter().filter_map(|port| port.name.strip_suffix("_araddr")).map(str::to_owned).collect();
    let played = benches.iter().find(|bench| bench.target == core.played).expect("a core has vectors of its streams");
    let cocotb = Cocotb { header, core, entity, vectors: &played.vectors, report_words: core.report_words, memories };
    let test = format!("test_{}", packaged.file(".py"));
    let texts = [
        (packaged.file("_instance.vhd.txt"), Instances { header, instances }.render()),
        (packaged.file(".core"), fuse_soc.render()),
        ("vunit/run.py".to_owned(), VUnit { header, prefix, benches }.render()),
        (format!("cocotb/{test}"), cocotb.render()),
    ];
    let row = |name: &str, what: &str| FileRow::new(name, what);
    let rows = vec![
        row(&texts[0].0, &format!("Instances of the {}, to copy into a design.", core.name)),
        row(&texts[1].0, "Core for FuseSoC: one target per testbench, lint, and synthesis for the device."),
        row("vunit", "VUnit run script for all testbenches."),
        row("cocotb", "A test in cocotb that plays the vectors of the streams."),
    ];
    for (name, text) in texts {
        set.insert(name, text.expect("the template renders"));
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artefact::ready_designs;
    use std::collections::BTreeSet;

    #[test]
    fn every_design_is_a_core_of_its_own() {
        let name =
            |params: &Params, stream_width| core_name(params, &Packaging { stream_width, ..Packaging::default() });
        let names: BTreeSet<String> = ready_designs().iter().map(|r| name(&r.params, r.stream_width)).collect();
        assert_eq!(names.len(), ready_designs().len());
        assert!(names.contains("efsat:core:efsat") && names.contains("efsat:core:efsat-exact-stream-width-1024"));
        let wide = Params { projection_width: crate::params::ProjectionWidth::Plus(6), ..Params::default() };
        assert_eq!(name(&wide, StreamWidth::default()), "efsat:core:efsat-projection-width-plus-6");
        let named = Packaging { prefix: Prefix::new("near").unwrap(), ..Packaging::default() };
        assert_eq!(core_name(&wide, &named), "efsat:core:near_efsat");
    }
}
