//! Projects for build tools, and instances to copy.

use super::registers::shell_ports;
use crate::artefact::files::file_lists::{BenchFiles, FileLists};
use crate::artefact::{FileSet, Packaging, Prefix, origin};
use crate::design::Design;
use crate::params::options::Choice;
use crate::params::{Method, Params};
use crate::words::{StreamFormat, StreamWidth};
use askama::Template;
use efsat_hardware::device::{Device, Family, Part};
use efsat_hardware::op::Type;

#[derive(Template)]
#[template(path = "drop-in/efsat.core", escape = "none")]
struct Core<'a> {
    header: &'a [String],
    core: &'a str,
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
            Family::Ecp5 => ("diamond", vec![("part", format!("{die}{speed}{}C", package.replace("CABGA", "BG")))]),
        };
        Self { tool, options }
    }
}

/// The name of the FuseSoC core: by what it differs from the default design of its method, so that cores of all parameters
/// can lie in one library; or by the prefix.
pub(in crate::artefact) fn core_name(params: &Params, packaging: &Packaging) -> String {
    let mut name = packaging.prefix.of("efsat");
    if packaging.prefix.name().is_none() {
        if params.method != Method::Axes {
            name.push_str(&format!("-{}", params.method.name()));
        }
        let differences = params.differences(&Params::of(params.method)).into_iter();
        let stream = (packaging.stream_width != StreamWidth::default())
            .then(|| ("stream-width", packaging.stream_width.name().to_owned()));
        for (option, value) in differences.chain(stream) {
            name.push_str(&format!("-{option}-{}", value.replace('+', "plus-")));
        }
        if packaging.registers {
            name.push_str("-registers");
        }
    }
    format!("efsat:core:{name}")
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
    prefix: &'a Prefix,
    instances: Vec<Instance>,
}

struct Instance {
    entity: String,
    ports: Vec<Port>,
}

struct Port {
    name: String,
    signal: String,
    ty: String,
}

fn vector(bits: u32) -> String {
    match bits {
        1 => "std_logic".to_owned(),
        _ => format!("std_logic_vector({} downto 0)", bits - 1),
    }
}

/// Ports with a signal of the same name for each.
fn instance(entity: String, ports: Vec<(String, u32)>) -> Instance {
    let port = |(name, bits): (String, u32)| Port { signal: name.clone(), ty: vector(bits), name };
    Instance { entity, ports: ports.into_iter().map(port).collect() }
}

fn instances(design: &Design, format: &StreamFormat, packaging: &Packaging) -> Vec<Instance> {
    let prefix = &packaging.prefix;
    let top = &design.top;
    let bits = |ty: Type| ty.bits;
    let inputs = top.inputs.iter().map(|id| (top.signal(*id).name(), bits(top.signal(*id).ty)));
    let outputs = top.outputs.iter().map(|(name, id)| (name.to_string(), bits(top.signal(*id).ty)));
    let unit = [("clk".to_owned(), 1)].into_iter().chain(inputs).chain(outputs).collect();
    let side = |side: &str, bits: u32| {
        [("tdata", bits), ("tkeep", bits / 8), ("tvalid", 1), ("tlast", 1), ("tready", 1)]
            .map(|(name, bits)| (format!("{side}_{name}"), bits))
    };
    let control = ["aclk", "aresetn"].map(|name| (name.to_owned(), 1));
    let wrapper =
        control.into_iter().chain(side("s_axis", format.width.bits())).chain(side("m_axis", format.answer_width()));
    let shell = packaging.registers.then(|| instance(prefix.of(FileLists::SHELL), shell_ports("")));
    let wrapper = instance(prefix.of("efsat_stream"), wrapper.collect());
    shell.into_iter().chain([wrapper, instance(prefix.of("efsat"), unit)]).collect()
}

/// Adds all projects; returns name (or folder) and description of each.
pub(in crate::artefact) fn add(
    set: &mut FileSet,
    design: &Design,
    format: &StreamFormat,
    packaging: &Packaging,
    lists: &FileLists,
) -> [(String, &'static str); 3] {
    let (header, prefix) = (&origin()[..], &packaging.prefix);
    let sources = &lists.synthesised()[..];
    let (benches, example) = (&lists.benches[..], &lists.example[..]);
    let version = env!("CARGO_PKG_VERSION");
    let (device, synthesis) = (design.device.name, Synthesis::new(design.device));
    let core = &core_name(&design.params, packaging)[..];
    let texts = [
        (
            prefix.of("efsat.core"),
            Core { header, core, top: &lists.top, version, device, synthesis, sources, example, benches }.render(),
        ),
        ("vunit/run.py".to_owned(), VUnit { header, prefix, benches }.render()),
        (
            prefix.of("efsat_instance.vhd.txt"),
            Instances { header, prefix, instances: instances(design, format, packaging) }.render(),
        ),
    ];
    for (name, text) in texts {
        set.insert(name, text.expect("the template renders"));
    }
    [
        (prefix.of("efsat_instance.vhd.txt"), "Instances of the unit and of the wrapper, to copy into a design."),
        (prefix.of("efsat.core"), "Core for FuseSoC: one target per testbench, lint, and synthesis for the device."),
        ("vunit".to_owned(), "VUnit run script for all testbenches."),
    ]
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
