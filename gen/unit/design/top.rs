//! The top: input and pose registers, sequencer, data path, result queue; and the whole design as one value.

use super::exact::cascade;
use super::sequencer::{self, Sequencer};
use super::{determinants, exact, number::input_type, pipeline};
use crate::params::{Method, ParamError, Params, Transform};
use efsat_hardware::device::{self, Device, DeviceError};
use efsat_hardware::graph::{Block, Place, Step};
use efsat_hardware::netlist::lower::{Lowering, PROBE, Probe};
use efsat_hardware::netlist::{Control, Module, Wire};
use efsat_hardware::number::Upper;
use efsat_hardware::op::{Concatenate, Floor, LowBits, Type};
use efsat_hardware::schedule::{Schedule, Scheduler};
use std::collections::HashMap;
use std::rc::Rc;

/// Why a design cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// A parameter outside its range.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// No such device, or one in a file that cannot be taken.
    #[error(transparent)]
    Device(#[from] DeviceError),
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

/// Whether inner nodes are brought out for comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Probes {
    /// No: the design as it is used.
    None,
    /// All that the reference model computes too, as ports of the top.
    All,
}

impl From<bool> for Probes {
    fn from(all: bool) -> Self {
        if all { Self::All } else { Self::None }
    }
}

/// A design: parameters, proven graph, schedule and modules.
pub struct Design {
    /// Parameters.
    pub params: Params,
    /// Target part.
    pub device: &'static Device,
    /// Data path, with the proven ranges of all nodes.
    pub pipeline: Rc<Block>,
    /// Schedule of the data path.
    pub schedule: Rc<Schedule>,
    /// Top module.
    pub top: Rc<Module>,
    /// Nodes brought out, empty unless probed.
    pub probes: Vec<Probe>,
    /// Clocks from the acceptance of a pair to the offer of its verdict, the queue being empty; of a cascade, of a pair that
    /// the first stage decides.
    pub latency: usize,
    /// Clocks between pairs.
    pub interval: usize,
    /// Places in the result queue.
    pub places: usize,
    /// Of a cascade.
    pub second: Option<SecondStage>,
}

/// The second data path of a cascade.
pub struct SecondStage {
    /// It, with the proven ranges of all nodes.
    pub pipeline: Rc<Block>,
    /// Its schedule.
    pub schedule: Rc<Schedule>,
    /// Clocks from the acceptance of a pair that the first stage leaves open to the offer of its verdict, at most, all queues
    /// being empty.
    pub latency: usize,
}

/// How often pairs come, in words.
pub fn pace(interval: usize) -> String {
    if interval == 1 { "one pair per clock".to_owned() } else { format!("one pair every {interval} clocks") }
}

impl Design {
    /// The units at the top of the data paths.
    pub fn pipelines(&self) -> impl Iterator<Item = &Rc<Block>> {
        [&self.pipeline].into_iter().chain(self.second.as_ref().map(|second| &second.pipeline))
    }

    /// The schedules of all units, each with the number of its instances.
    pub fn schedules(&self) -> Vec<(Rc<Schedule>, usize)> {
        let second = self.second.as_ref().map(|second| second.schedule.hierarchy());
        [self.schedule.hierarchy(), second.unwrap_or_default()].concat()
    }

    /// The clock in MHz that the schedule reaches, and the node that ends its longest path.
    pub fn clock(&self) -> (f64, &str) {
        let second = self.second.as_ref().map(|second| &second.schedule.critical);
        let (ns, end) = second.filter(|second| second.0 > self.schedule.critical.0).unwrap_or(&self.schedule.critical);
        (self.device.megahertz(*ns), end)
    }

    /// Whether there can be a design; its target part.
    ///
    /// # Errors
    /// Parameters out of range, or an unknown device.
    pub fn check(params: &Params) -> Result<&'static Device, DesignError> {
        params.validate()?;
        Ok(device::find(&params.device)?)
    }

    /// Builds, proves, schedules and lowers the design.
    ///
    /// # Errors
    /// Parameters out of range, or an unknown device.
    pub fn new(params: &Params, probes: impl Into<Probes>) -> Result<Self, DesignError> {
        let device = Self::check(params)?;
        let pipeline = match params.method {
            Method::Axes => pipeline::unit(params),
            Method::Determinants => determinants::unit(params),
            Method::Exact => match params.first_stage() {
                Some(first) => cascade::first(params, &first),
                None => exact::unit(params),
            },
        };
        let mut scheduler = Scheduler::new(device, params.frequency);
        let schedule = scheduler.schedule(&pipeline);
        let (path, probes) = Lowering::new(&mut scheduler, device).lower(&pipeline, probes.into() == Probes::All);
        let interval = params.interval();
        let second = params.exact_clocks.map(|clocks| {
            let pipeline = cascade::second(params, clocks);
            let second = scheduler.schedule(&pipeline);
            // Two clocks from a queue to the data path, and as many to the next queue, in each stage; in the last clock of a slot
            // it may be too late for the next one.
            let latency = (schedule.latency + second.latency) as usize + 8 + clocks as usize;
            (clocks, SecondStage { pipeline, schedule: second, latency })
        });
        // So that an open pair can go through the second stage while the first goes on.
        let more = second.as_ref().map_or(0, |(clocks, second)| second.schedule.latency + 2 * *clocks as i32);
        let places = sequencer::places(schedule.latency + more, interval);
        let stage = second.as_ref().map(|(clocks, second)| {
            let (path, _) = Lowering::new(&mut scheduler, device).lower(&second.pipeline, false);
            cascade::stage(&path, second.schedule.latency, *clocks, places)
        });
        Ok(Self {
            params: params.clone(),
            device,
            top: top(params, &path, schedule.latency, places, stage.as_ref()),
            pipeline,
            probes,
            latency: schedule.latency as usize + 4,
            interval,
            places,
            schedule,
            second: second.map(|(_, second)| second),
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
            name if name.starts_with(PROBE) => Channel::Probe,
            _ => Channel::Verdict,
        }
    }
}

/// A number of the input: the name of its port, and where it is in the pipeline's.
struct Number {
    port: String,
    place: Place,
}

/// The pair's numbers in port order: `in_v0_x` to `in_w2_z`.
fn pair_numbers() -> Vec<Number> {
    let number = |triangle: &str, k: usize, c: usize| {
        let place = Place::at(format!("in_{triangle}"), &[Step::Index(k), Step::Component(c)]);
        Number { port: place.to_string(), place }
    };
    let points = ["v", "w"].into_iter().flat_map(|t| (0..3).map(move |k| (t, k)));
    points.flat_map(|(t, k)| (0..3).map(move |c| number(t, k, c))).collect()
}

/// The pose's numbers in port order: `pose_m00` to `pose_t_z`.
fn pose_numbers(p: &Params) -> Vec<Number> {
    let mut numbers = vec![];
    if p.transform == Transform::On {
        let entries = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        numbers.extend(entries.map(|(i, j)| Number {
            port: format!("pose_m{i}{j}"),
            place: Place::at("pose_m", &[Step::Index(i), Step::Component(j)]),
        }));
    }
    if p.transform != Transform::Off {
        let entry = |c: usize| Place::at("pose_t", &[Step::Component(c)]);
        numbers.extend((0..3).map(|c| Number { port: entry(c).to_string(), place: entry(c) }));
    }
    numbers
}

/// The input ports of a pair's numbers (their lower bounds), in order.
pub fn pair_ports() -> Vec<String> {
    pair_numbers().into_iter().map(|number| number.port).collect()
}

/// The input ports of a pose's numbers (their lower bounds), in order.
pub fn pose_ports(p: &Params) -> Vec<String> {
    pose_numbers(p).into_iter().map(|number| number.port).collect()
}

/// The words of a number: the lower bound and, with [`Upper::Sticky`], the sticky bit; port, place and type of each.
fn words(p: &Params, numbers: Vec<Number>) -> Vec<(String, Place, Type)> {
    let part = |place: &Place, k: usize| {
        let mut place = place.clone();
        place.path.push(Step::Field("number", k, ["lo", "sticky"][k]));
        place
    };
    let each = numbers.into_iter().flat_map(|n| {
        let sticky = (p.upper == Upper::Sticky).then(|| (format!("{}_sticky", n.port), part(&n.place, 1), Type::FLAG));
        [(n.port, part(&n.place, 0), input_type(p))].into_iter().chain(sticky)
    });
    each.collect()
}

/// What a tag is.
const TAG: &str = "the host's; comes back with the verdict";

/// The fields of the result word as ports, from the lowest bit on.
fn output_fields(p: &Params, word: Wire) {
    let flags = if p.method == Method::Axes { "bit i: of axis i" } else { "bit i: of witness i" };
    let outside = ("outside", 1, "a number is outside its declared range");
    let fields = [
        ("verdict", 2, "00 separate, 01 intersect, 10 possibly incorrect"),
        ("separated", p.flags(), flags),
        ("overlapping", p.flags(), flags),
    ];
    let mut below = 0;
    for (name, bits, what) in fields.into_iter().chain(p.guarded().then_some(outside)) {
        let above = if below == 0 { word } else { word.apply(Floor(below), &[]) };
        let value = if above.ty().bits > bits { above.apply(LowBits(bits), &[]) } else { above };
        value.named(format!("offered_{name}").as_str()).comment(what).output(format!("out_{name}").as_str());
        below += bits;
    }
}

/// A place under a base that begins otherwise.
fn prefixed(place: &Place, old: &str, new: &str) -> Place {
    Place { base: place.base.replace(old, new), ..place.clone() }
}

/// The top around the data path, of a cascade with what is behind the first.
fn top(p: &Params, path: &Rc<Module>, latency: i32, places: usize, second: Option<&Rc<Module>>) -> Rc<Module> {
    let interval = p.interval();
    let has_pose = p.transform != Transform::Off;
    let waits = second.is_some();
    let control = sequencer::module(&Sequencer {
        name: "sequencer",
        interval,
        latency,
        places,
        pose: has_pose,
        stays: false,
        waits,
    });
    let m = Control::new("efsat", header(p, latency as usize + 4, places));
    let reset = m.input("reset", Type::FLAG).comment("synchronous, active high");
    let in_valid = m.input("in_valid", Type::FLAG).comment("a pair is offered");
    let tag = (p.tag_width > 0).then(|| m.input("in_tag", Type::unsigned(p.tag_width)).or(false).comment(TAG));
    let ports = |words: Vec<(String, Place, Type)>| -> Vec<(Place, Wire)> {
        words.into_iter().map(|(port, place, ty)| (place, m.input(port.as_str(), ty))).collect()
    };
    let pair = ports(words(p, pair_numbers()));
    // Without poses B = B~ stays as it is after reset.
    let pose_valid = has_pose.then(|| m.input("pose_valid", Type::FLAG).or(false).comment("a pose is offered"));
    let pose: Vec<(Place, Wire)> =
        ports(words(p, pose_numbers(p))).into_iter().map(|(place, x)| (place, x.or(false))).collect();
    let bypass = has_pose.then(|| m.input("pose_bypass", Type::FLAG).or(false).comment("the pose is B = B~"));
    // Without it every answer is taken in the clock in which it is offered.
    let out_ready = m.input("out_ready", Type::FLAG).or(true).comment("a verdict can be taken");
    let head_ready = waits.then(|| m.later(Type::FLAG));
    let control_inputs: Vec<Wire> =
        [reset, in_valid].into_iter().chain(pose_valid).chain([out_ready]).chain(head_ready).collect();
    let signals = m.instance("control", &control, &control_inputs);
    let of = |name: &str| sequencer::output(&control, &signals, name);

    // The pair of the running slot.
    let load = of("load_pair");
    let held = |place: &Place, port: Wire| {
        let register = m.register(prefixed(place, "in_", "pair_"), port.ty());
        register.loads(port, Some(load), None);
        register
    };
    let mut inputs: HashMap<Place, Wire> = pair
        .into_iter()
        .map(|(place, port)| {
            let register = held(&place, port);
            (place, register)
        })
        .collect();
    if let Some(bypass) = bypass {
        // A pose waits in registers of its own until the running slot is over. Where that is one clock, they are not enabled.
        let waits = (interval > 1).then(|| of("pose_ready"));
        let words = pose.into_iter().chain([(Place::new("pose_bypass"), bypass)]);
        inputs.extend(words.map(|(place, port)| {
            let [next, active] = ["next_", "active_"].map(|new| m.register(prefixed(&place, "pose_", new), port.ty()));
            next.loads(port, waits, None);
            active.loads(next, Some(of("pose_load")), (place.base == "pose_bypass").then_some((reset, 1)));
            (place, active)
        }));
    }
    let given: Vec<Wire> = path
        .inputs
        .iter()
        .map(|id| {
            let place = &path.signal(*id).place;
            inputs.get(place).copied().unwrap_or_else(|| of(&place.to_string()))
        })
        .collect();
    let results = m.instance("path", path, &given);
    let parts = ["verdict", "separated", "overlapping", "outside"];
    let word = sequencer::result_word(path, &results, &[&parts[..], &["left_open"][..usize::from(waits)]].concat());
    let queue = m.memory("result_queue", of("decide"), of("decide_address"), word, of("take_address"));
    queue.comment("verdict and flags of the pairs decided and not yet taken");
    let taken = match (second, head_ready) {
        (Some(second), Some(head_ready)) => {
            // The oldest verdict: the second stage's if the first has left the pair open, as soon as it is there.
            let flag = queue.ty().bits - 1;
            let waits = queue.apply(Floor(flag), &[]).named("head_open");
            let open = sequencer::output(path, &results, "left_open");
            let push = (of("decide") & open).named("push_open");
            let pop = (of("take") & waits).named("take_exact");
            let points = second.inputs.iter().map(|id| match &second.signal(*id).place {
                place if place.base == cascade::HANDED_OVER => sequencer::output(path, &results, &place.to_string()),
                place => match place.base.as_str() {
                    "reset" => reset,
                    "push" => push,
                    _ => pop,
                },
            });
            let exact = m.instance("exact", second, &points.collect::<Vec<_>>());
            let exact = |name: &str| sequencer::output(second, &exact, name);
            head_ready.stands_for((!waits | exact("out_valid")).named("head_ready"));
            // Its verdict has one bit, and no pair of it is outside.
            let (word, zero) = (exact("out_word"), m.constant(0, Type::FLAG));
            let word = word.low(1).apply(Concatenate, &[zero, word.apply(Floor(1), &[]), zero]);
            waits.choose(word.named("exact_word"), queue.low(flag)).named("head_word")
        }
        _ => queue,
    };
    let offered = m.register("offered_word", taken.ty());
    offered.loads(taken, Some(of("take")), None);
    of("in_ready").comment("a pair can be accepted").output("in_ready");
    if has_pose {
        of("pose_ready").comment("a pose can be accepted").output("pose_ready");
    }
    of("out_valid").comment("a verdict is offered").output("out_valid");
    output_fields(p, offered);
    if let Some(tag) = tag {
        // A tag may come late in its clock, and its queue is far from most: it is written a clock later.
        let given = held(&Place::new("in_tag"), tag);
        let accepted = m.register("tag_accepted", Type::FLAG);
        accepted.loads(of("accept"), None, Some((reset, 0)));
        let address = m.register("tag_address", of("accept_address").ty());
        address.loads(of("accept_address"), None, None);
        let tags = m.memory("tag_queue", accepted, address, given, of("take_address"));
        tags.comment("tags of the pairs accepted and not yet taken");
        let offered_tag = m.register("offered_tag", tags.ty());
        offered_tag.loads(tags, Some(of("take")), None);
        offered_tag.comment(TAG).output("out_tag");
    }
    for ((place, _), wire) in path.outputs.iter().zip(&results) {
        if place.base.starts_with(PROBE) {
            wire.output(place.clone());
        }
    }
    m.finish()
}

fn header(p: &Params, latency: usize, places: usize) -> Vec<String> {
    let interval = p.interval();
    let format = p.input();
    let text = |lines: &[&str]| -> Vec<String> { lines.iter().map(|line| (*line).to_owned()).collect() };
    let mut lines = match p.method {
        Method::Axes => text(&[
            "EFSAT: exact triangle-triangle intersection test in fixed-point interval arithmetic.",
            "After Raabe, Tietjen, Anlauf: separating axes; a definite answer is never wrong.",
        ]),
        Method::Determinants => text(&[
            "EFSAT: exact triangle-triangle intersection test in fixed-point arithmetic.",
            "The signs of fifteen determinants with bounds on their errors; a definite answer is never wrong.",
        ]),
        Method::Exact if p.exact_clocks.is_some() => text(&[
            "EFSAT: exact triangle-triangle intersection test for points on a grid, in two stages.",
            "Fifteen determinants with bounds on their errors decide most pairs, an exact unit those that they leave open.",
        ]),
        Method::Exact => text(&[
            "EFSAT: exact triangle-triangle intersection test for points on a grid.",
            "The signs of fifteen determinants, nothing rounded: every pair that fits is answered, and rightly.",
        ]),
    };
    lines.push(String::new());
    lines.push(format!("{}, verdict {latency} clocks after acceptance.", pace(interval).replacen('o', "O", 1)));
    if let Some(clocks) = p.exact_clocks {
        lines.push(format!(
            "Of pairs that the first stage leaves open one every {clocks} clocks, and later; no pair passes another."
        ));
    }
    lines.extend(text(&[
        "",
        if p.transform == Transform::Off {
            "Pairs: V0 V1 V2 is triangle A, W0 W1 W2 triangle B in the frame of A, tag is opaque. A pair is accepted in a clock"
        } else {
            "Pairs: V0 V1 V2 is triangle A, W0 W1 W2 triangle B~ in its own frame, tag is opaque. A pair is accepted in a clock"
        },
        if interval == 1 {
            "in which in_valid and in_ready are both set; keep valid and data until then. in_ready is set in every clock"
        } else {
            "in which in_valid and in_ready are both set; keep valid and data until then. in_ready comes once per slot"
        },
    ]));
    let slot = if interval == 1 { String::new() } else { format!("({interval} clocks) ") };
    lines.push(format!("{slot}while one of the {places} places of the result queue is free."));
    lines.extend(text(&[
        "Verdicts come in input order, each with its tag: taken in a clock in which out_valid and out_ready are both set.",
        "  out_verdict 00 separate, 01 intersect, 10 possibly incorrect (treat as intersecting, retest if it matters).",
    ]));
    lines.extend(match p.method {
        Method::Axes => text(&[
            "  out_separated, out_overlapping: what each axis said, bit i for axis i (n_A n_B C_00 C_01 ... C_22, in-plane).",
        ]),
        Method::Determinants => text(&[
            "  out_separated, out_overlapping: what each witness said, bit i for witness i: boxes, plane of A, plane of B, edges",
            "  0 to 2 of A, edges 0 to 2 of B. An edge that misses the other triangle is separated, one that pierces it overlaps.",
        ]),
        Method::Exact => text(&[
            "  out_separated, out_overlapping: what each witness said, bit i for witness i: the pair as a whole, plane of A, plane",
            "  of B, edges 0 to 2 of A, edges 0 to 2 of B (docs/exact.md). Bit 0 of out_overlapping: the triangles cross, rather",
            "  than touch; bit 1: all six points are in one plane; bit 2: an edge pierces, or the normals of triangles that cross",
            "  in one plane agree.",
        ]),
    });
    lines.extend(match p.exact_clocks {
        None => vec![],
        Some(_) => text(&[
            "  Of a pair that the first stage decides, bit 0 of out_separated says that the boxes are apart, and a flag that is",
            "  clear says nothing, but for bit 0 of out_overlapping, which is that of the exact unit (docs/cascade.md).",
        ]),
    });
    lines.push(String::new());
    lines.push(match p.method {
        Method::Axes => format!("Numbers are lower bounds, {format} (ulp 2^-{}); {}.", format.fraction, upper_rule(p)),
        Method::Determinants => format!("Numbers are rounded down to {format} (ulp 2^-{}).", format.fraction),
        Method::Exact => format!("Numbers are on the grid of {format} (ulp 2^-{}).", format.fraction),
    });
    if p.transform != Transform::Off {
        let law = if p.transform == Transform::On { "B = M B~ + t" } else { "B = B~ + t" };
        lines.push(String::new());
        lines.push(format!(
            "Pose: {law}. Accepted in a clock in which pose_valid and pose_ready are both set; it holds for every"
        ));
        lines.extend(text(&[
            "pair accepted in a later clock, pairs accepted before (or in the same clock) keep the old one. With pose_bypass",
            "set B = B~ bit for bit and the other pose ports are ignored. After reset: bypass.",
        ]));
    }
    lines.extend(text(&["", "Assumed of the input:"]));
    lines.extend(p.assumptions().into_iter().map(|line| format!("  {line}")));
    lines.extend(text(if p.method == Method::Exact {
        &["A pair that does not fit is answered possibly incorrect, with out_outside set and all other flags clear."]
    } else if p.guarded() {
        &[
            "The unit has a guard: a pair with a number outside, or under a pose with one, is answered possibly incorrect",
            "with out_outside set and all other flags clear.",
        ]
    } else {
        &["The unit has no guard: what it answers outside these ranges can be wrong, so the host has to keep to them."]
    }));
    lines.extend(text(&["", "reset is synchronous; it empties the unit."]));
    lines
}

fn upper_rule(p: &Params) -> &'static str {
    match p.upper {
        Upper::Implied => "the upper bound is one ulp above, and every rounding up is floor + ulp",
        Upper::Sticky => {
            "the upper bound is one ulp above where the sticky bit is set, rounding up is the exact ceiling"
        }
    }
}
