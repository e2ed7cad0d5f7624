//! The top: input and pose registers, sequencer, data path, result queue; and the whole design as one value.

use super::{cross_product::COORDINATES, pipeline, sequencer, transform_row::input_type};
use crate::params::{ParamError, Params, Transform};
use efsat_hardware::device::{self, Device, UnknownDevice};
use efsat_hardware::graph::lower::{Lowering, Probe};
use efsat_hardware::graph::netlist::{Module, ModuleBuilder, SignalId};
use efsat_hardware::graph::range::{self, Overflow, Ranges};
use efsat_hardware::graph::schedule::{Schedule, Scheduler};
use efsat_hardware::graph::{Op, Type, Unit};
use efsat_hardware::number::Upper;
use std::rc::Rc;

/// Why a design cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// A parameter outside its range.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// No such device.
    #[error(transparent)]
    Device(#[from] UnknownDevice),
    /// A format of the table is too narrow: a defect of the table, never of the parameters.
    #[error("range analysis: {0}")]
    Range(#[from] Overflow),
}

/// Where a port's value comes from or goes to, for whoever drives the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Control.
    Control,
    /// The pair, taken with `in_valid` and `in_ready`.
    Pair,
    /// The pose, taken with `pose_valid` and `pose_ready`.
    Pose,
    /// The verdict, given with `out_valid` and `out_ready`.
    Verdict,
    /// A probe.
    Probe,
}

/// A design: parameters, proven graph, schedule and modules.
pub struct Design {
    /// Parameters.
    pub params: Params,
    /// Target part.
    pub device: &'static Device,
    /// Data path.
    pub pipeline: Rc<Unit>,
    /// Proven ranges of all nodes.
    pub ranges: Ranges,
    /// Schedule of the data path.
    pub schedule: Rc<Schedule>,
    /// Top module.
    pub top: Rc<Module>,
    /// Nodes brought out, empty unless probed.
    pub probes: Vec<Probe>,
    /// Clocks from the acceptance of a pair to the offer of its verdict, the queue being empty.
    pub latency: usize,
    /// Clocks between pairs.
    pub interval: usize,
    /// Places in the result queue.
    pub places: usize,
}

impl Design {
    /// Builds, proves, schedules and lowers the design; `probed` adds ports for the inner nodes.
    ///
    /// # Errors
    /// Parameters out of range, or an unknown device.
    pub fn new(params: &Params, probed: bool) -> Result<Self, DesignError> {
        params.validate()?;
        let device = device::find(&params.device)?;
        let pipeline = pipeline::unit(params);
        let ranges = range::analyse(&pipeline)?;
        let mut scheduler = Scheduler::new(device, params.frequency);
        let schedule = scheduler.schedule(&pipeline);
        let (path, probes) = Lowering::new(&mut scheduler, device, &ranges).lower(&pipeline, probed);
        let top = top(params, &path, schedule.latency);
        let interval = params.interval();
        Ok(Self {
            params: params.clone(),
            device,
            pipeline,
            ranges,
            top,
            probes,
            latency: schedule.latency as usize + 4,
            interval,
            places: sequencer::places(schedule.latency, interval),
            schedule,
        })
    }

    /// The channel of a top port.
    pub fn channel(name: &str) -> Channel {
        match name {
            "reset" | "in_valid" | "in_ready" | "pose_valid" | "pose_ready" | "out_valid" | "out_ready" => {
                Channel::Control
            }
            name if name.starts_with("in_") => Channel::Pair,
            name if name.starts_with("pose_") => Channel::Pose,
            name if name.starts_with("probe_") => Channel::Probe,
            _ => Channel::Verdict,
        }
    }
}

/// Name and type of an input number's ports: the lower bound and, with [`Upper::Sticky`], the sticky bit.
fn number_ports(p: &Params, name: &str) -> Vec<(String, Type)> {
    let mut ports = vec![(name.to_owned(), input_type(p))];
    if p.upper == Upper::Sticky {
        ports.push((format!("{name}_sticky"), Type::FLAG));
    }
    ports
}

/// The pose's numbers in port order: name and value in the identity pose.
pub fn pose_numbers(p: &Params) -> Vec<(String, i128)> {
    let mut numbers = vec![];
    if p.transform == Transform::On {
        for i in 0..3 {
            numbers.extend((0..3).map(|j| (format!("pose_m{i}{j}"), if i == j { p.one() } else { 0 })));
        }
    }
    if p.transform != Transform::Off {
        numbers.extend(COORDINATES.iter().map(|c| (format!("pose_t_{c}"), 0)));
    }
    numbers
}

/// The pair's numbers in port order: `in_v0_x` to `in_w2_z`.
pub fn pair_numbers() -> Vec<String> {
    let corners = ["v0", "v1", "v2", "w0", "w1", "w2"];
    corners.iter().flat_map(|k| COORDINATES.iter().map(move |c| format!("in_{k}_{c}"))).collect()
}

fn header(p: &Params, latency: usize, places: usize) -> Vec<String> {
    let interval = p.interval();
    let format = p.input();
    let mut lines = vec![
        "EFSAT: exact triangle-triangle intersection test in fixed-point interval arithmetic.".to_owned(),
        "After Raabe, Tietjen, Anlauf: separating axes; a definite answer is never wrong.".to_owned(),
        String::new(),
        format!("One pair every {interval} clocks, verdict {latency} clocks after acceptance."),
        String::new(),
        "Pairs: V0 V1 V2 is triangle A, W0 W1 W2 triangle B~ in its own frame, tag is opaque. A pair is accepted in a"
            .to_owned(),
        "clock in which in_valid and in_ready are both set; keep valid and data until then. in_ready comes once a slot"
            .to_owned(),
        format!("({interval} clocks) while one of the {places} places of the result queue is free."),
        "Verdicts come in input order, each with its tag: taken in a clock in which out_valid and out_ready are both set."
            .to_owned(),
        "  out_verdict 00 separate, 01 intersect, 10 possibly incorrect (treat as intersecting, retest if it matters)."
            .to_owned(),
        "  out_separated, out_overlapping: what each axis said, bit i for axis i (n_A n_B C_00 C_01 ... C_22, in-plane)."
            .to_owned(),
        String::new(),
        format!("Numbers are lower bounds, {format} (ulp 2^-{}); {}.", format.fraction, upper_rule(p)),
    ];
    if p.transform != Transform::Off {
        let law = if p.transform == Transform::On { "B = M B~ + t" } else { "B = B~ + t" };
        lines.extend([
            String::new(),
            format!("Pose: {law}. Accepted in a clock in which pose_valid and pose_ready are both set; it holds for every"),
            "pair accepted in a later clock, pairs accepted before (or in the same clock) keep the old one. With pose_bypass"
                .to_owned(),
            "set B = B~ bit for bit and the other pose ports are ignored. After reset: bypass.".to_owned(),
        ]);
    }
    lines.extend([String::new(), "Assumed of the input:".to_owned()]);
    lines.extend(p.assumptions().into_iter().map(|line| format!("  {line}")));
    lines.extend(assumption_rule(p).iter().map(|line| (*line).to_owned()));
    lines.extend([String::new(), "reset is synchronous; it empties the unit.".to_owned()]);
    lines
}

fn assumption_rule(p: &Params) -> &'static [&'static str] {
    if p.guarded() {
        &[
            "The unit has a guard: a pair with a number outside, or under a pose with one, is answered possibly incorrect",
            "with out_outside set and the flags of all axes clear.",
        ]
    } else {
        &["The host keeps to it: the unit has no guard."]
    }
}

fn upper_rule(p: &Params) -> &'static str {
    match p.upper {
        Upper::Implied => "the upper bound is one ulp above, and every rounding up is floor + ulp",
        Upper::Sticky => {
            "the upper bound is one ulp above where the sticky bit is set, rounding up is the exact ceiling"
        }
    }
}

fn top(p: &Params, path: &Rc<Module>, latency: i32) -> Rc<Module> {
    let interval = p.interval();
    let places = sequencer::places(latency, interval);
    let sequencer = sequencer::module(interval, latency);
    let mut m = ModuleBuilder::new("efsat", header(p, latency as usize + 4, places));
    let reset = m.input("reset", Type::FLAG);
    let in_valid = m.input("in_valid", Type::FLAG);
    let tag = (p.tag_width > 0).then(|| m.input("in_tag", Type::unsigned(p.tag_width)));
    let pair: Vec<(String, SignalId)> = pair_numbers()
        .iter()
        .flat_map(|name| number_ports(p, name))
        .map(|(name, ty)| (name.clone(), m.input(&name, ty)))
        .collect();
    let has_pose = p.transform != Transform::Off;
    let zero = m.constant("clear", 0, Type::FLAG);
    let pose_valid = if has_pose { m.input("pose_valid", Type::FLAG) } else { zero };
    let pose: Vec<(String, Type, i128, SignalId)> = pose_numbers(p)
        .into_iter()
        .flat_map(|(name, identity)| {
            let ports = number_ports(p, &name).into_iter().enumerate();
            ports.map(move |(i, (name, ty))| (name, ty, if i == 0 { identity } else { 0 })).collect::<Vec<_>>()
        })
        .map(|(name, ty, identity)| {
            let id = m.input(&name, ty);
            (name, ty, identity, id)
        })
        .collect();
    let bypass = has_pose.then(|| m.input("pose_bypass", Type::FLAG));
    let out_ready = m.input("out_ready", Type::FLAG);
    let control = m.instance("control", &sequencer, &[reset, in_valid, pose_valid, out_ready]);
    let of = |name: &str| control[sequencer.outputs.iter().position(|(n, _)| n == name).expect("an output")];
    let begin_slot = (interval > 1).then(|| of("begin_slot"));

    // The pair of the running slot.
    let mut inputs = vec![];
    if path.inputs.first().is_some_and(|i| path.signal(*i).name == "phase") {
        inputs.push(of("phase"));
    }
    for (name, port) in &pair {
        let ty = m.ty(*port);
        let held = m.register(&format!("pair_{}", &name[3..]), ty);
        m.drive(held, *port, begin_slot, None);
        inputs.push(held);
    }
    if let Some(bypass) = bypass {
        let next_bypass = m.register("next_bypass", Type::FLAG);
        m.drive(next_bypass, bypass, Some(of("pose_accept")), None);
        for (name, ty, identity, port) in &pose {
            let short = &name[5..];
            let next = m.register(&format!("next_{short}"), *ty);
            m.drive(next, *port, Some(of("pose_accept")), None);
            let still = m.constant(&format!("identity_{short}"), *identity, *ty);
            let loaded = m.op(&format!("loaded_{short}"), Op::Select, &[next_bypass, next, still]);
            let active = m.register(&format!("active_{short}"), *ty);
            m.drive(active, loaded, Some(of("pose_load")), Some((reset, *identity)));
            inputs.push(active);
        }
        let active = m.register("active_bypass", Type::FLAG);
        m.drive(active, next_bypass, Some(of("pose_load")), Some((reset, 1)));
        inputs.push(active);
    }
    let results = m.instance("path", path, &inputs);
    let result = |name: &str| results[path.outputs.iter().position(|(n, _)| n == name).expect("an output")];
    let mut parts = ["verdict", "separated", "overlapping"].map(result).to_vec();
    if p.guarded() {
        parts.push(result("outside"));
    }
    let word = m.op("result_word", Op::Concatenate, &parts);
    let queue = m.memory("result_queue", of("decide"), of("decide_address"), word, of("take_address"));
    m.comment(queue, "verdict and flags of the pairs decided and not yet taken");
    let offered = m.register("offered_word", m.ty(queue));
    m.drive(offered, queue, Some(of("take")), None);
    let axes = p.axes.count() as u32;
    m.output("in_ready", of("in_ready"));
    if has_pose {
        m.output("pose_ready", of("pose_ready"));
    }
    m.output("out_valid", of("out_valid"));
    let verdict = m.op("offered_verdict", Op::LowBits(2), &[offered]);
    m.output("out_verdict", verdict);
    if let Some(tag) = tag {
        let tags = m.memory("tag_queue", of("accept"), of("accept_address"), tag, of("take_address"));
        m.comment(tags, "tags of the pairs accepted and not yet taken");
        let offered_tag = m.register("offered_tag", m.ty(tags));
        m.drive(offered_tag, tags, Some(of("take")), None);
        m.output("out_tag", offered_tag);
    }
    let flags = m.op("offered_flags", Op::Floor(2), &[offered]);
    let flags = m.op("offered_flags_word", Op::Reinterpret(0), &[flags]);
    let separated = m.op("offered_separated", Op::LowBits(axes), &[flags]);
    m.output("out_separated", separated);
    let rest = m.op("offered_overlapping_part", Op::Floor(axes), &[flags]);
    if p.guarded() {
        let rest = m.op("offered_overlapping_word", Op::Reinterpret(0), &[rest]);
        let overlapping = m.op("offered_overlapping", Op::LowBits(axes), &[rest]);
        m.output("out_overlapping", overlapping);
        let outside = m.op("offered_outside_part", Op::Floor(axes), &[rest]);
        let outside = m.op("offered_outside", Op::Reinterpret(0), &[outside]);
        m.output("out_outside", outside);
    } else {
        let overlapping = m.op("offered_overlapping", Op::Reinterpret(0), &[rest]);
        m.output("out_overlapping", overlapping);
    }
    for (i, (name, _)) in path.outputs.iter().enumerate() {
        if name.starts_with("probe_") {
            m.output(name, results[i]);
        }
    }
    m.finish()
}
