//! The built-in simulator under the same stimulus as the printed testbench, clock for clock.
//!
//! Handshakes depend on data in a cascade alone. So the control logic is run first, clock by clock, to learn what the unit
//! is given in each clock; then the whole design runs on these inputs a block of clocks at a time.

use super::Run;
use efsat_hardware::netlist::simulate::Simulation;
use efsat_unit::artefact::Stimulus;
use efsat_unit::artefact::testbench::{self, RESET_CLOCKS};
use efsat_unit::artefact::vectors::{Word, answer_word, pair_word, pose_word};
use efsat_unit::design::top::{Channel, Design};
use efsat_unit::golden::Golden;

/// Clocks simulated at a time.
const BLOCK: usize = 256;

/// What the unit is given in one clock.
#[derive(Clone, Copy, Debug, Default)]
struct Given {
    reset: bool,
    in_valid: bool,
    pose_valid: bool,
    out_ready: bool,
    /// Record on the pair ports, from 1; 0 is none yet.
    pair: usize,
    /// Tag on the tag port.
    tag: u64,
    /// Record on the pose ports, from 1.
    pose: usize,
    /// Whether the pair is accepted in this clock.
    accepted: bool,
    /// Number of the answer taken in this clock, and its pass.
    taken: Option<(usize, u8)>,
}

/// A record of the vector file.
enum Record {
    Pose(Word),
    Pair(Word, Vec<i128>),
}

/// The ports of the top at which it is given something.
struct Ports {
    /// Reset, valid, valid of a pose, ready, tag.
    control: [Option<usize>; 5],
    pair: Vec<usize>,
    pose: Vec<usize>,
}

impl Ports {
    /// Sets what is given in clock `t` of a block.
    fn drive(&self, unit: &mut Simulation, t: usize, given: &Given, records: &[Record]) {
        let flags = [given.reset, given.in_valid, given.pose_valid, given.out_ready].map(i128::from);
        let values = flags.into_iter().chain([i128::from(given.tag)]);
        for (port, value) in self.control.iter().zip(values) {
            if let Some(port) = port {
                unit.set(*port, t, value);
            }
        }
        for (ports, record) in [(&self.pair, given.pair), (&self.pose, given.pose)] {
            let (Record::Pair(word, _) | Record::Pose(word)) = match record.checked_sub(1) {
                Some(record) => &records[record],
                None => continue,
            };
            for (port, field) in ports.iter().zip(&word.fields) {
                unit.set(*port, t, field.1);
            }
        }
    }
}

/// The built-in simulator for one design.
pub struct Builtin<'a> {
    design: &'a Design,
}

/// Numbers of the run that the control logic alone decides.
#[derive(Default)]
struct Timing {
    clocks: u64,
    latency: u64,
    interval: u64,
    total: u64,
    first_pass: usize,
}

impl<'a> Builtin<'a> {
    /// Prepares a run.
    pub fn new(design: &'a Design) -> Self {
        Self { design }
    }

    fn port(&self, name: &str) -> Option<usize> {
        let top = &self.design.top;
        top.inputs.iter().position(|id| top.signal(*id).name() == name)
    }

    /// Runs all vectors and compares the answers.
    pub(super) fn run(&self, stimulus: &Stimulus, probe: bool) -> Run {
        let records = self.records(stimulus);
        let (given, timing) = self.control(&records);
        let mut run = self.data(&records, &given, &timing, probe);
        run.clocks = timing.clocks;
        run.latency = timing.latency;
        run.interval = timing.interval;
        run.total = timing.total;
        run.simulator = "builtin".to_owned();
        run
    }

    fn ports(&self, records: &[Record]) -> Ports {
        let ports = |word: &Word| -> Vec<usize> {
            word.fields.iter().map(|f| self.port(&f.0).expect("a port of the top")).collect()
        };
        let shape = |pick: fn(&Record) -> Option<&Word>| records.iter().find_map(pick).map(ports).unwrap_or_default();
        Ports {
            control: ["reset", "in_valid", "pose_valid", "out_ready", "in_tag"].map(|n| self.port(n)),
            pair: shape(|r| if let Record::Pair(word, _) = r { Some(word) } else { None }),
            pose: shape(|r| if let Record::Pose(word) = r { Some(word) } else { None }),
        }
    }

    fn records(&self, stimulus: &Stimulus) -> Vec<Record> {
        let p = &self.design.params;
        let golden = Golden::new(p);
        let mut records = vec![];
        for (pose, pairs) in &stimulus.segments {
            let word = pose_word(p, pose);
            if !word.fields.is_empty() {
                records.push(Record::Pose(word));
            }
            for pair in pairs {
                let answer = answer_word(p, &golden.outcome(pose, pair));
                let values = answer.fields.iter().map(|field| field.1).collect();
                records.push(Record::Pair(pair_word(p, pair), values));
            }
        }
        records
    }

    /// The handshakes of the whole run; see the testbench template, which does the same.
    fn control(&self, records: &[Record]) -> (Vec<Given>, Timing) {
        let names = ["in_ready", "out_valid", "pose_ready"];
        let has_pose = self.port("pose_valid").is_some();
        let mut unit = Simulation::restricted(&self.design.top, if has_pose { &names } else { &names[..2] });
        let ports = self.ports(records);
        for (i, id) in self.design.top.inputs.iter().enumerate() {
            let name = &self.design.top.signal(*id).name();
            let control = Design::channel(name) == Channel::Control || self.design.second.is_some();
            assert!(control || !unit.reaches(i), "a handshake depends on {name}");
        }
        let tags = 1u64 << self.design.params.tag_width.min(30);
        let mut timing = Timing::default();
        let mut history = vec![];
        let mut now = Given { reset: true, ..Given::default() };
        let step = |unit: &mut Simulation, now: &Given| {
            ports.drive(unit, 0, now, records);
            unit.run();
            [unit.output(0, 0) != 0, unit.output(1, 0) != 0, has_pose && unit.output(2, 0) != 0]
        };
        for _ in 0..RESET_CLOCKS {
            step(&mut unit, &now);
            history.push(now);
        }
        now.reset = false;
        let mut random: u16 = 0xace1;
        let full_after = testbench::full_after(self.design);
        let paced = testbench::paced(self.design);
        let (mut waited, mut filled) = (0, false);
        let (mut clock, mut first, mut previous) = (0u64, None, None);
        for pass in 1..=2u8 {
            let (mut next, mut offered, mut taken) = (0, 0usize, 0usize);
            loop {
                let [in_ready, out_valid, pose_ready] = step(&mut unit, &now);
                let accepted = now.in_valid && in_ready;
                let posed = now.pose_valid && pose_ready;
                let takes = out_valid && now.out_ready;
                let mut seen = now;
                seen.accepted = accepted && pass == 1;
                seen.taken = takes.then_some((taken, pass));
                history.push(seen);
                if seen.accepted {
                    if let Some(gap) = previous.map(|previous| clock - previous) {
                        timing.interval = if timing.interval == 0 { gap } else { timing.interval.min(gap) };
                    }
                    first = first.or(Some(clock));
                    previous = Some(clock);
                }
                if takes && pass == 1 {
                    timing.clocks = clock - first.unwrap_or(clock);
                    if taken == 0 {
                        timing.latency = timing.clocks;
                    }
                }
                taken += usize::from(takes);
                now.in_valid &= !accepted;
                now.pose_valid &= !posed;
                let bit = |i: u16| (random >> i) & 1;
                random = (random << 1) | (bit(15) ^ bit(13) ^ bit(12) ^ bit(10));
                let bit = |i: u16| (random >> i) & 1 == 1;
                waited = if seen.in_valid && !accepted { waited + 1 } else { 0 };
                let left = next < records.len() && (pass == 1 || offered < paced);
                let mut go = true;
                now.out_ready = pass == 1;
                if pass == 2 && !filled {
                    filled = waited > full_after || (!seen.in_valid && !left);
                } else if pass == 2 {
                    go = random & 15 == 0 || (bit(0) && (clock / 256) % 2 == 1);
                    now.out_ready = bit(4);
                }
                let done = taken == offered && (next == records.len() || (pass == 2 && offered == paced));
                if go && !now.in_valid && !now.pose_valid && left {
                    match &records[next] {
                        Record::Pose(_) => {
                            now.pose_valid = true;
                            now.pose = next + 1;
                        }
                        Record::Pair(..) => {
                            now.in_valid = true;
                            now.pair = next + 1;
                            now.tag = offered as u64 % tags;
                            offered += 1;
                        }
                    }
                    next += 1;
                } else if done {
                    break;
                }
                clock += 1;
            }
            clock += 1;
            if pass == 1 {
                timing.first_pass = history.len();
            }
        }
        timing.total = clock;
        (history, timing)
    }

    /// The whole design on the inputs of each clock.
    fn data(&self, records: &[Record], given: &[Given], timing: &Timing, probe: bool) -> Run {
        let top = &self.design.top;
        let mut unit = Simulation::new(top, BLOCK);
        let ports = self.ports(records);
        let output = |name: &str| top.outputs.iter().position(|(n, _)| n.to_string() == name);
        let [_, _, answer] = testbench::blank(&self.design.params);
        let answers: Vec<usize> = answer.fields.iter().map(|f| output(&f.0).expect("an output")).collect();
        let tag = output("out_tag");
        let probes: Vec<usize> =
            testbench::probe_word(self.design).fields.iter().filter_map(|f| output(&f.0)).collect();
        let pairs: Vec<usize> = (0..records.len()).filter(|i| matches!(records[*i], Record::Pair(..))).collect();
        let tags = 1u64 << self.design.params.tag_width.min(30);
        let mut run = Run::default();
        for (start, block) in given.chunks(BLOCK).enumerate().map(|(i, b)| (i * BLOCK, b)) {
            for (t, g) in block.iter().enumerate() {
                ports.drive(&mut unit, t, g, records);
            }
            unit.run();
            for (t, g) in block.iter().enumerate() {
                if probe && start + t < timing.first_pass && !g.reset {
                    run.probes.push((g.accepted, probes.iter().map(|p| unit.output(*p, t)).collect()));
                }
                let Some((number, pass)) = g.taken else { continue };
                let Record::Pair(word, expected) = &records[pairs[number]] else { continue };
                let actual: Vec<i128> = answers.iter().map(|port| unit.output(*port, t)).collect();
                let tag_fits = tag.is_none_or(|tag| unit.output(tag, t) == i128::from(number as u64 % tags));
                if actual != *expected || !tag_fits {
                    run.mismatches += 1;
                    run.first.get_or_insert_with(|| {
                        let show = |values: &[i128]| {
                            let fields = answer.fields.iter().zip(values);
                            let field = |((name, _, bits), value): (&(String, i128, u32), &i128)| {
                                format!("{} {value:0bits$b}", &name[4..], bits = *bits as usize)
                            };
                            fields.map(field).collect::<Vec<_>>().join(" ")
                        };
                        let tag = if tag_fits { "" } else { " with a wrong tag" };
                        let (hex, expected, actual) = (word.hex(), show(expected), show(&actual));
                        format!("vector {number} pass {pass} pair {hex} expected {expected} actual {actual}{tag}")
                    });
                }
            }
        }
        run
    }
}
