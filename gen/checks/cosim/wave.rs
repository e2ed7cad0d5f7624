//! A GTKWave layout to go with a waveform.

use efsat_unit::design::Design;
use std::path::Path;

/// First line of a layout that is ours to overwrite.
pub(super) const MARK: &str = "[*] Layout by efsat";

/// The layout file (`.gtkw`) for a waveform of the testbench: handshakes first, then data, phases and verdicts.
pub(super) fn layout(design: &Design, wave: &Path) -> String {
    let vcd = wave.extension().is_some_and(|e| e == "vcd");
    let (scope, mark) = if vcd { ("efsat_tb.", "") } else { ("top.efsat_tb.", "") };
    let mut lines =
        vec![MARK.to_owned(), format!("[dumpfile] \"{}\"", wave.file_name().unwrap_or_default().to_string_lossy())];
    let mut group = |title: &str, names: Vec<(String, u32)>| {
        lines.push("@200".to_owned());
        lines.push(format!("-{title}"));
        for (name, bits) in names {
            lines.push(if bits == 1 { "@28".to_owned() } else { "@22".to_owned() });
            let range = if bits == 1 { String::new() } else { format!("[{}:0]", bits - 1) };
            lines.push(format!("{mark}{scope}{name}{range}"));
        }
    };
    let own = |names: &[&str]| names.iter().map(|n| ((*n).to_owned(), 1)).collect::<Vec<_>>();
    group("Handshakes", own(&["clk", "reset", "in_valid", "in_ready", "out_valid", "out_ready"]));
    if design.top.inputs.iter().any(|id| design.top.signal(*id).name() == "pose_valid") {
        group("Pose", own(&["pose_valid", "pose_ready"]));
    }
    let tag = design.params.tag_width;
    if tag > 0 {
        group("Tags", vec![("in_tag".to_owned(), tag), ("out_tag".to_owned(), tag)]);
    }
    let ports = design.top.outputs.iter().map(|(name, id)| (format!("unit.{name}"), design.top.signal(*id).ty.bits));
    group("Answers", ports.filter(|(name, _)| name.starts_with("unit.out_")).collect());
    let phases = design.top.signals.iter().filter(|s| s.name() == "control_phase");
    group("Phase", phases.map(|s| (format!("unit.{}", s.name()), s.ty.bits)).collect());
    lines.push(String::new());
    lines.join("\n")
}
