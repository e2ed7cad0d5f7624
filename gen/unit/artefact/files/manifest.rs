//! `manifest.json`: what a design is, for programs that read it.

use super::FileSet;
use crate::design::Design;
use crate::params::Params;
use crate::words::{PacketKind, StreamFormat};
use efsat_hardware::netlist::{Driver, Module, Signal};
use efsat_hardware::op::{Range, Type};
use efsat_hardware::vhdl;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};

/// The manifest's file name.
pub const NAME: &str = "manifest.json";

/// The manifest of a core: what made it, what it is, and the digests of its files. It has no date: equal parameters give equal
/// bytes.
#[derive(Serialize)]
struct Manifest<'a, T> {
    generator: String,
    #[serde(rename = "SPDX-License-Identifier")]
    license: &'static str,
    command_line: &'a str,
    #[serde(flatten)]
    what: T,
    files: BTreeMap<&'a str, String>,
}

/// What made a set of files.
pub fn generator() -> String {
    format!("efsat {}", env!("CARGO_PKG_VERSION"))
}

/// The digests of files by their names.
pub fn digests(files: &FileSet) -> BTreeMap<&str, String> {
    files.iter().map(|(name, text)| (name, digest(text))).collect()
}

/// The manifest of a set of files.
pub fn of(command_line: &str, what: impl Serialize, files: &FileSet) -> String {
    let manifest = Manifest {
        generator: generator(),
        license: env!("CARGO_PKG_LICENSE"),
        command_line,
        what,
        files: digests(files),
    };
    serde_json::to_string_pretty(&manifest).expect("keys are strings and numbers are finite")
}

/// What a design is.
#[derive(Serialize)]
struct About {
    parameters: serde_json::Map<String, serde_json::Value>,
    device: Device,
    initiation_interval: usize,
    latency: usize,
    multipliers: usize,
    register_bits: u64,
    result_places: usize,
    input_format: String,
    guard: bool,
    assumptions: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stream: Option<Stream>,
    ports: Vec<Port>,
    formats: Vec<Row>,
}

#[derive(Serialize)]
struct Device {
    name: &'static str,
    family: &'static str,
    device: &'static str,
    package: &'static str,
    speed: &'static str,
    delays_from: &'static str,
}

/// The stream wrapper, for hosts that are not this crate's driver.
#[derive(Serialize)]
struct Stream {
    word_bits: u32,
    answer_word_bits: u32,
    pairs_header: u32,
    pose_header: Option<u32>,
    pair_words: u32,
    pose_words: Option<u32>,
    clocks_per_pair: usize,
}

impl Stream {
    fn new(params: &Params, format: &StreamFormat) -> Self {
        let pose = format.has_pose().then_some(PacketKind::Pose);
        Self {
            word_bits: format.width.bits(),
            answer_word_bits: format.answer_width(),
            pairs_header: format.header(PacketKind::Pairs),
            pose_header: pose.map(|kind| format.header(kind)),
            pair_words: format.record_words(PacketKind::Pairs),
            pose_words: pose.map(|kind| format.record_words(kind)),
            clocks_per_pair: format.pair_period(params.interval()),
        }
    }
}

#[derive(Serialize)]
struct Port {
    name: String,
    direction: &'static str,
    bits: u32,
    format: String,
}

/// A signal of a data path, which may be an array or a record: numbers of one format, and the greatest magnitude of them in
/// units of its last place.
#[derive(Serialize)]
struct Row {
    entity: String,
    signal: String,
    format: String,
    bound: i128,
}

/// The signals of the data paths that the reference model knows too: those that a probed design brings out.
fn formats(design: &Design) -> Vec<Row> {
    let modules = design.top.hierarchy();
    let mut rows = vec![];
    for path in std::iter::once(&design.pipeline).chain(design.second.as_ref().map(|second| &second.pipeline)) {
        let Some(block) = modules.iter().find(|module| module.name == path.name) else { continue };
        let known: BTreeSet<&str> = path.probes.iter().map(|probe| path.node(probe.node).place.base.as_str()).collect();
        // Each where it is made.
        let elsewhere = |module: &Module, signal: &Signal| match signal.driver {
            Driver::Port => module.section,
            Driver::Instance { instance, .. } => module.instances[instance].module.section,
            _ => false,
        };
        for (module, (name, signals)) in
            block.parts().flat_map(|m| vhdl::declared(&design.top, m).into_iter().map(move |d| (m, d)))
        {
            let numbers: Vec<_> = signals.iter().map(|id| module.signal(*id)).filter(|s| !s.ty.is_flag()).collect();
            // What stands later in the data path is a copy.
            let made =
                |s: &&Signal| known.contains(&*s.place.base) && s.place.suffix.is_empty() && !elsewhere(module, s);
            if !numbers.iter().any(made) {
                continue;
            }
            let bound = |(least, most): Range| most.max(-least);
            let types: BTreeSet<String> = numbers.iter().map(|signal| signal.ty.to_string()).collect();
            rows.extend(types.into_iter().map(|format| {
                let ranges =
                    numbers.iter().filter(|s| s.ty.to_string() == format).map(|s| s.range.unwrap_or(s.ty.limits()));
                let bound = ranges.map(bound).max().unwrap_or(0);
                Row { entity: module.name.clone(), signal: name.clone(), format, bound }
            }));
        }
    }
    rows
}

/// Ports of the top, in order; the clock is the one that no module lists.
fn ports(design: &Design) -> Vec<Port> {
    let top = &design.top;
    let port = |name: &str, direction, ty: Type| Port {
        name: name.to_owned(),
        direction,
        bits: ty.bits,
        format: ty.to_string(),
    };
    let clock = top.clocked().then(|| Port { format: "clock".to_owned(), ..port("clk", "in", Type::FLAG) });
    let inputs = top.inputs.iter().map(|id| port(&top.signal(*id).name(), "in", top.signal(*id).ty));
    let outputs = top.outputs.iter().map(|(name, id)| port(&name.to_string(), "out", top.signal(*id).ty));
    clock.into_iter().chain(inputs).chain(outputs).collect()
}

/// A value of an option: a number where it is one.
fn value(text: &str) -> serde_json::Value {
    text.parse::<u64>().map_or_else(|_| text.into(), Into::into)
}

/// The manifest of a design, the format of its stream where there is a wrapper, and of all other files of the set.
pub(in crate::artefact) fn text(
    design: &Design,
    format: Option<&StreamFormat>,
    command_line: &str,
    files: &FileSet,
) -> String {
    let part = design.device.part;
    let about = About {
        parameters: design.params.options().iter().map(|(k, v)| (k.replace('-', "_"), value(v))).collect(),
        device: Device {
            name: design.device.name,
            family: part.family,
            device: part.device,
            package: part.package,
            speed: part.speed,
            delays_from: design.device.source,
        },
        initiation_interval: design.interval,
        latency: design.latency,
        multipliers: design.top.multipliers(),
        register_bits: design.top.register_bits(),
        result_places: design.places,
        input_format: design.params.input().to_string(),
        guard: design.params.guarded(),
        assumptions: design.params.assumptions(),
        stream: format.map(|format| Stream::new(&design.params, format)),
        ports: ports(design),
        formats: formats(design),
    };
    of(command_line, about, files)
}

/// The SHA-256 of a text in hexadecimal.
fn digest(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The files that a manifest of ours names; none if the text is no manifest of ours.
pub fn files(text: &str) -> Option<BTreeSet<String>> {
    let manifest: serde_json::Value = serde_json::from_str(text).ok()?;
    manifest.get("generator")?.as_str()?.strip_prefix("efsat ")?;
    Some(manifest.get("files")?.as_object()?.keys().cloned().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Method;
    use crate::params::options::Choice;
    use crate::words::StreamWidth;

    #[test]
    fn the_default_manifest() {
        let params = Params::default();
        let design = Design::new(&params, false).unwrap();
        let mut set = FileSet::default();
        set.insert("a.txt", "abc");
        let text = text(&design, Some(&StreamFormat::new(&params, StreamWidth::Bits64)), &params.command_line(), &set);
        let manifest: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(manifest["multipliers"], 48);
        assert_eq!(manifest["initiation_interval"], 11);
        assert_eq!(manifest["latency"], design.latency);
        assert_eq!(manifest["parameters"]["transform_width"], 32);
        assert_eq!(manifest["parameters"]["upper"], "implied");
        assert_eq!(
            (&manifest["stream"]["pair_words"], &manifest["stream"]["clocks_per_pair"]),
            (&10.into(), &11.into())
        );
        assert_eq!(manifest["ports"][0]["name"], "clk");
        assert_eq!(manifest["guard"], true);
        assert_eq!(manifest["assumptions"][0], "input: |coordinate| <= 268435456 ulp");
        let sum = "edeaaff3f1774ad2888673770c6d64097e391bc362d7d6fb34982ddf0efd18cb";
        assert_eq!(manifest["files"]["a.txt"], sum, "SHA-256 of abc and a line feed");
        assert_eq!(files(&text).unwrap().into_iter().collect::<Vec<_>>(), ["a.txt"]);
    }

    /// Every method lists signals of its own, and each is declared in the text of its entity.
    #[test]
    fn formats_are_those_of_signals_in_the_text() {
        let cascade = Params { exact_clocks: Some(16), ..Params::of(Method::Exact) };
        let sets = Method::ALL.iter().map(|method| Params::of(*method)).chain([Params::snapped(), cascade]);
        for (params, expected) in sets.zip(["v0_lo", "moment_m0", "moment_m0", "moment_m0", "moment_m0"]) {
            let design = Design::new(&params, false).unwrap();
            let texts = vhdl::print(&design.top, "", "efsat_types", &[]).unwrap();
            let rows = formats(&design);
            assert!(rows.iter().any(|row| row.signal == expected), "{params:?}");
            for Row { entity, signal, format, bound } in rows {
                let (_, text) = texts.iter().find(|(name, _)| *name == entity).unwrap();
                let declared = |line: &str| {
                    let name = line.trim_start().trim_start_matches("signal ").split([' ', ':']).next();
                    name == Some(&signal) && line.contains(" : ")
                };
                assert!(text.lines().any(declared), "{entity}: {signal}");
                assert!(bound >= 0 && !format.is_empty(), "{entity}: {signal}: {format}, {bound}");
            }
        }
    }
}
