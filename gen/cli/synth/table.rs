//! The text of `efsat synth`.

use crate::generate::misses;
use efsat_checks::synth::{CriticalPath, Placed, Report, Routed, Timing, Unit};
use efsat_engine::artefact::cells::WITHIN;
use efsat_hardware::device::{self, Device, Resources};
use efsat_unit::design::top::pace;
use efsat_unit::params::{Params, options::Choice};
use std::fmt::Write;

/// Slices of the part that estimates are for, an XC2V6000.
const SLICES: u64 = 33_792;

/// What is counted.
const COLUMNS: [&str; 5] = ["multipliers", "LUTs", "memory LUTs", "flip-flops", "carry bits"];

/// Width of the name column.
const NAME: usize = 36;

/// The tree of units, totals, shares of the part, clock and critical path.
pub(super) fn text(report: &Report, params: &Params) -> String {
    let Device { name: counted, family, .. } = report.counted_for;
    let by = match report.tools.join(", ") {
        tools if tools.is_empty() => "as the device model predicts them".to_owned(),
        tools => format!("by {tools}"),
    };
    let mut text = format!("Scheduled for {} at {} MHz; cells of {counted} {by}\n", params.device, params.frequency);
    if device::find(&params.device).is_ok_and(|device| device.family != *family) {
        text.push_str("The device is of another family than the flow: registers stand where that one needs them\n");
    }
    text.push('\n');
    head(&mut text, report.top.actual.is_some());
    row(&mut text, &report.top, 0);
    text.push('\n');
    shares(&mut text, report);
    let _ = writeln!(text, "{}, verdict after {} clocks", pace(report.interval), report.latency);
    if let Some(clocks) = report.expansion_clocks {
        let _ = writeln!(
            text,
            "{}; LUTs of what is around the units are expected within {WITHIN} %",
            pace(clocks).replacen("pair", "expansion", 1)
        );
    }
    let (scheduled, end) = &report.scheduled;
    let below = if misses(*scheduled, params.frequency) { ", below the target" } else { "" };
    let device = &params.device;
    let _ =
        writeln!(text, "clock: {scheduled:.1} MHz by the schedule for {device}{below} (longest path ends at {end})");
    if let Some(timing) = &report.timing {
        estimate(&mut text, timing);
    }
    if let Some(routed) = &report.routed {
        clock(&mut text, routed);
    }
    text
}

/// The columns, each predicted, and if a tool ran also actual and difference.
fn head(text: &mut String, counted: bool) {
    let (name, width) = if counted { ("unit, predicted | actual", 22) } else { ("unit", 13) };
    let _ = write!(text, "{name:NAME$}");
    for column in COLUMNS {
        let _ = write!(text, "{column:>width$}");
    }
    text.push('\n');
}

/// A unit and those in it, counts of all its instances in the unit around it.
fn row(text: &mut String, unit: &Unit, depth: usize) {
    let times = if unit.instances > 1 { format!(" x {}", unit.instances) } else { String::new() };
    let name = format!("{:1$}{2}{times}", "", 2 * depth, unit.entity);
    let _ = write!(text, "{name:NAME$}");
    let predicted = columns(unit.predicted * unit.instances);
    let actual = unit.actual.map(|cells| columns(cells.resources * unit.instances));
    for column in 0..COLUMNS.len() {
        let p = predicted[column];
        let _ = match actual.map(|a| a[column]) {
            Some(a) => write!(text, "{p:>7} |{a:>6}{:>7}", difference(p, a)),
            None => write!(text, "{p:>13}"),
        };
    }
    text.push('\n');
    for part in &unit.parts {
        row(text, part, depth + 1);
    }
}

fn columns(cells: Resources) -> [u64; COLUMNS.len()] {
    [cells.multipliers, cells.luts, cells.memory_luts, cells.flip_flops, cells.carry]
}

/// By how much the prediction is above what there is, in per cent of the latter.
fn difference(predicted: u64, actual: u64) -> String {
    match (predicted, actual) {
        (p, a) if p == a => String::new(),
        (_, 0) => "new".to_owned(),
        (p, a) => format!("{:+.0} %", 100.0 * (p as f64 - a as f64) / a as f64),
    }
}

fn shares(text: &mut String, report: &Report) {
    let (cells, capacity) = (report.cells(), report.counted_for.capacity);
    let share = |used: u64, all: u64| format!("{used} of {all} ({:.1} %)", 100.0 * used as f64 / all as f64);
    let luts = cells.luts + cells.memory_luts;
    let _ = writeln!(
        text,
        "{}: {} multipliers, {} LUTs with shift registers and memory, {} flip-flops",
        report.counted_for.name,
        share(cells.multipliers, capacity.multipliers),
        share(luts, capacity.luts),
        share(cells.flip_flops, capacity.flip_flops),
    );
    if let Some(mapped) = report.top.actual.filter(|cells| cells.registered_multipliers > 0) {
        let _ = writeln!(
            text,
            "{} of the multipliers take in the register behind them: {} flip-flops, which are not counted above",
            mapped.registered_multipliers, mapped.absorbed_flip_flops
        );
    }
    let (predicted, mapped) = (report.predicted_block_rams, report.top.actual.map(|cells| cells.block_rams));
    if predicted > 0 || mapped.is_some_and(|mapped| mapped > 0) {
        let there = u64::from(report.counted_for.block_rams);
        let beside = mapped.map(|_| format!("; {predicted} predicted")).unwrap_or_default();
        let _ = writeln!(text, "{} block RAMs of 18 kbit{beside}", share(mapped.unwrap_or(predicted), there));
    }
    if let Some(slices) = report.slices() {
        let all = SLICES;
        let _ = writeln!(
            text,
            "slices, estimated: {}; {} packed densely, {} if only related logic shares a slice",
            share(slices.fitted, all),
            slices.dense,
            slices.related_only
        );
    }
}

fn estimate(text: &mut String, timing: &Timing) {
    let _ = writeln!(
        text,
        "clock, estimated as XST does: {:.1} MHz, {:.1} with the derating for placement; {:.2} ns along {}",
        timing.megahertz,
        timing.derated_megahertz,
        timing.ns,
        timing.path.join(" -> ")
    );
    let beside = timing.beside_multipliers;
    for (ns, what) in
        [(beside.into, "into a MULT18X18S, its set-up"), (beside.out_of, "out of one, its clock-to-output")]
    {
        if let Some(ns) = ns {
            let _ = writeln!(text, "  {ns:.2} ns {what} not included");
        }
    }
}

fn clock(text: &mut String, routed: &Routed) {
    let megahertz = |placed: &Option<Placed>| match placed {
        Some(placed) => format!("{:.1}", placed.megahertz),
        None => format!("none in {} minutes", routed.limit.as_secs() / 60),
    };
    let seeds: Vec<String> = routed.seeds.iter().map(megahertz).collect();
    let again = if routed.reroute { ", rerouted" } else { "" };
    let seeds = format!("{} (placer {}{again}, seeds 1 to {})", seeds.join(", "), routed.placer.name(), seeds.len());
    let loads = routed.loads;
    let _ = writeln!(text, "loads of one output: at most {} of logic, {} of a flip-flop", loads.logic, loads.flip_flop);
    let Some(middle) = routed.middle() else {
        let _ = writeln!(text, "clock: not routed in time, median of {seeds}");
        return;
    };
    let median = middle.megahertz;
    let (asked, met) = (routed.asked, if routed.is_met() { "met" } else { "missed" });
    let _ = writeln!(text, "clock: {median:.1} MHz after routing, median of {seeds}; {asked} MHz {met}");
    path(text, &middle.critical);
}

fn path(text: &mut String, path: &CriticalPath) {
    let _ = writeln!(text, "critical path: {:.2} ns in cells, {:.2} ns in nets", path.logic(), path.routing());
    for (i, step) in path.steps.iter().enumerate() {
        let arrow = if i == 0 { "  " } else { "->" };
        let _ = writeln!(text, "  {arrow} {:<60}{:>7.2}{:>7.2}", step.signal, step.logic, step.routing);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_of_what_there_is() {
        assert_eq!(difference(5, 5), "");
        assert_eq!(difference(5, 0), "new");
        assert_eq!(difference(110, 100), "+10 %");
        assert_eq!(difference(0, 100), "-100 %");
    }
}
