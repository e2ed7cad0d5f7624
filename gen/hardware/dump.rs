//! Graphs, schedules and modules as text, for people and for tests: a line for each node, each slot and each signal.
//!
//! Names that nobody gave, but that were derived, stand in parentheses. Where several have one name, as constants may, their
//! numbers stand behind it.

use crate::graph::{Block, Op, Rate};
use crate::netlist::{Driver, Module, SignalId};
use crate::op::{Comb, Range};
use crate::schedule::Schedule;
use std::collections::HashMap;
use std::fmt::Write;

/// A graph: its nodes in order, each with type, range, rate and what it is made of; its outputs and probes.
///
/// ```
/// # use efsat_hardware::testing::examples::*;
/// # let library = Library::default();
/// # let block = library.block("square", &[], 1, |top| {
/// #     let x = top.input(NUMBER, (-9, 9)).named("x");
/// #     (x * x).named("y")
/// # });
/// assert_eq!(dump::block(&block).lines().last(), Some("  output y: y"));
/// ```
pub fn block(block: &Block) -> String {
    let labels = labels(block.nodes.iter().map(|node| node.name()));
    let mut text = format!("block {}, {}\n", block.name, counted(block.interval, "phase"));
    header(&mut text, &block.doc);
    let row = |(i, node): (usize, &crate::graph::Node)| {
        let rate = match node.rate {
            Rate::Any => "any",
            Rate::Pair => "pair",
            Rate::Phase => "phase",
        };
        let columns = [
            shown(&labels[i], node.named),
            node.ty.to_string(),
            interval(block.range(i)),
            rate.to_owned(),
            operation(block, i, &labels),
            remark(&node.comment),
        ];
        columns.to_vec()
    };
    table(&mut text, &block.nodes.iter().enumerate().map(row).collect::<Vec<_>>());
    for (place, node) in &block.outputs {
        let _ = writeln!(text, "  output {place}: {}", labels[node.0]);
    }
    for probe in &block.probes {
        let phases: Vec<String> = probe.phases.iter().map(|(s, late)| format!("{s}{}", lateness(*late))).collect();
        let _ = writeln!(text, "  probe {} in phases {}", labels[probe.node.0], phases.join(", "));
    }
    text
}

/// What a node is, with its operands.
fn operation(block: &Block, i: usize, labels: &[String]) -> String {
    let node = &block.nodes[i];
    let mut args: Vec<String> = node.args.iter().map(|a| labels[a.0].clone()).collect();
    let what = match &node.op {
        Op::Input => "Input".to_owned(),
        Op::Comb(op) => combinational(op),
        Op::Phase(values) => {
            let each = values.iter().map(|v| v.map_or("-".to_owned(), |v| v.to_string()));
            format!("Phase {}", each.collect::<Vec<_>>().join(" "))
        }
        Op::Capture { phase, late } => format!("Capture of phase {phase}{}", lateness(*late)),
        Op::Mux { late } => {
            args.iter_mut().skip(1).zip(late).for_each(|(arg, late)| arg.push_str(lateness(*late)));
            "Mux".to_owned()
        }
        Op::Assume(range, lemma, phases) => {
            let marked: Vec<String> = (0..phases.len()).filter(|s| phases[*s]).map(|s| s.to_string()).collect();
            let within = if phases.is_empty() { String::new() } else { format!(" in phases {}", marked.join(" ")) };
            format!("Assume {} by {lemma:?}{within}", interval(*range))
        }
        Op::Instance(child) => format!("Instance of {}", child.name),
        Op::Output(port) => {
            let Op::Instance(child) = &block.node(node.args[0]).op else { unreachable!("outputs are of instances") };
            format!("Output {}", child.outputs[*port].0)
        }
        other @ (Op::Steady | Op::ScanOr | Op::Earlier(_) | Op::Known(_) | Op::Point) => format!("{other:?}"),
    };
    called(&what, &args)
}

/// A schedule: the slot of every node in clocks after phase 0 of the inputs, and the registers that values wait in.
///
/// ```
/// # use efsat_hardware::testing::examples::*;
/// # let library = Library::default();
/// # let block = library.block("square", &[], 1, |top| {
/// #     let x = top.input(NUMBER, (-9, 9)).named("x");
/// #     (x * x).named("y")
/// # });
/// let schedule = Scheduler::new(device::find("xc2v6000-4")?, 100).schedule(&block);
/// assert!(dump::schedule(&schedule).starts_with("schedule of square: latency 1 clock, 1 phase\n"));
/// # Ok::<(), device::DeviceError>(())
/// ```
pub fn schedule(schedule: &Schedule) -> String {
    let block = &schedule.block;
    let labels = labels(block.nodes.iter().map(|node| node.name()));
    let (ns, end) = &schedule.critical;
    let mut text = format!(
        "schedule of {}: latency {}, {}\n  input path {:.2} ns, output {:.2} ns, longest path {ns:.2} ns to {end}\n  \
         {} register bits, {} of them in any schedule\n",
        block.name,
        counted(schedule.latency as usize, "clock"),
        counted(block.interval, "phase"),
        schedule.input_path,
        schedule.output_ns,
        schedule.register_bits,
        schedule.program.fixed,
    );
    if schedule.lag > 0 {
        let _ = writeln!(text, "  late phases follow by {}", counted(schedule.lag_clocks() as usize, "clock"));
    }
    let clock = |clock: i32| match clock {
        i32::MIN => "always".to_owned(),
        i32::MAX => "-".to_owned(),
        clock => clock.to_string(),
    };
    let mut rows = vec![["node", "start", "from", "until", "ns", ""].map(str::to_owned).to_vec()];
    for (label, slot) in labels.iter().zip(&schedule.slots) {
        let registered = if slot.registered { "from registers" } else { "" };
        let columns =
            [label, &clock(slot.start), &clock(slot.from), &clock(slot.until), &format!("{:.2}", slot.ns), registered];
        rows.push(columns.map(str::to_owned).to_vec());
    }
    table(&mut text, &rows);
    let (program, starts) = (&schedule.program, &schedule.starts);
    for stream in program.streams.iter().filter(|stream| stream.carried(starts) > 0) {
        let (from, clocks) = (stream.from.clock(starts), counted(stream.carried(starts) as usize, "clock"));
        let _ =
            writeln!(text, "  {} ({} bits) is there from clock {from}, delayed by {clocks}", stream.name, stream.bits);
    }
    for held in program.held.iter().filter(|held| program.most_captures(held, starts) > 0) {
        let times = counted(program.most_captures(held, starts) as usize, "time");
        let _ = writeln!(text, "  {} ({} bits) is captured again {times}", held.name, held.bits);
    }
    text
}

/// A module: its signals in order, each with type, range, the clock of a pair in which it is first there, and its driver;
/// its instances, outputs and delay lines.
///
/// ```
/// # use efsat_hardware::testing::examples::*;
/// # let library = Library::default();
/// # let block = library.block("square", &[], 1, |top| {
/// #     let x = top.input(NUMBER, (-9, 9)).named("x");
/// #     (x * x).named("y")
/// # });
/// let device = device::find("xc2v6000-4")?;
/// let mut scheduler = Scheduler::new(device, 100);
/// let (module, _) = Lowering::new(&mut scheduler, device).lower(&block, false);
/// assert!(dump::module(&module).contains("Register of Multiply x, x"));
/// # Ok::<(), device::DeviceError>(())
/// ```
pub fn module(module: &Module) -> String {
    let labels = labels(module.signals.iter().map(|signal| signal.name()));
    let name = |id: SignalId| labels[id.0].clone();
    let names = |ids: &[SignalId]| ids.iter().map(|id| name(*id)).collect::<Vec<_>>();
    let latency = module.latency.map(|n| format!(", latency {}", counted(n as usize, "clock")));
    let mut text = format!("module {}{}\n", module.name, latency.unwrap_or_default());
    header(&mut text, &module.doc);
    let mut rows = vec![];
    for (signal, label) in module.signals.iter().zip(&labels) {
        let driver = match &signal.driver {
            Driver::Port => "Port".to_owned(),
            Driver::Combinational { op, args } => called(&combinational(op), &names(args)),
            Driver::Register { op, args, enable, reset } => {
                let loaded = op.as_ref().map_or(String::new(), |op| combinational(op) + " ");
                let when = enable.map_or(String::new(), |flag| format!(" when {}", name(flag)));
                let reset =
                    reset.map_or(String::new(), |(flag, value)| format!(", {value} at first and by {}", name(flag)));
                format!("Register of {loaded}{}{when}{reset}", names(args).join(", "))
            }
            Driver::Memory { write, address, data, read, depth } => {
                let [write, address, data, read] = [write, address, data, read].map(|id| name(*id));
                format!("Memory of {depth}, at {read}; {data} to {address} when {write}")
            }
            Driver::Line { data, tap } => format!("Line of {} by {} + 1", name(*data), name(*tap)),
            Driver::Instance { instance, port } => {
                let instance = &module.instances[*instance];
                format!("{} of {}", instance.module.outputs[*port].0, instance.place)
            }
        };
        let optional = module.optional.get(label).map(|bit| format!(" or bits {}", u8::from(*bit)));
        rows.push(vec![
            shown(label, signal.named),
            signal.ty.to_string(),
            signal.range.map_or(String::new(), interval),
            signal.clock.map_or(String::new(), |clock| format!("clock {clock}")),
            driver + &optional.unwrap_or_default(),
            remark(&signal.comment),
        ]);
    }
    table(&mut text, &rows);
    for instance in &module.instances {
        let inputs = names(&instance.inputs).join(", ");
        let _ = writeln!(text, "  instance {}: {} of {inputs}", instance.place, instance.module.name);
    }
    for (place, id) in &module.outputs {
        let _ = writeln!(text, "  output {place}: {}", name(*id));
    }
    for line in module.delay_lines() {
        let _ = writeln!(text, "  delay line {}: {}", name(line.source), names(&line.registers).join(", "));
    }
    text
}

/// A name for each: its own, with its number behind it where that is not the only one.
fn labels(names: impl Iterator<Item = String>) -> Vec<String> {
    let names: Vec<String> = names.collect();
    let mut count: HashMap<&str, usize> = HashMap::new();
    names.iter().for_each(|name| *count.entry(name).or_default() += 1);
    let label =
        |(i, name): (usize, &String)| if count[name.as_str()] == 1 { name.clone() } else { format!("{name}#{i}") };
    names.iter().enumerate().map(label).collect()
}

fn header(text: &mut String, doc: &[String]) {
    for line in doc {
        text.push_str(format!("  -- {line}").trim_end());
        text.push('\n');
    }
}

fn combinational(op: &Comb) -> String {
    format!("{:?}", &**op).replace("(None)", "")
}

fn called(what: &str, args: &[String]) -> String {
    if args.is_empty() { what.to_owned() } else { format!("{what} {}", args.join(", ")) }
}

fn shown(label: &str, named: bool) -> String {
    if named { label.to_owned() } else { format!("({label})") }
}

fn interval((least, most): Range) -> String {
    format!("{least}..{most}")
}

fn remark(comment: &str) -> String {
    if comment.is_empty() { String::new() } else { format!("-- {comment}") }
}

fn lateness(late: bool) -> &'static str {
    if late { " late" } else { "" }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Rows with their columns below each other.
fn table(text: &mut String, rows: &[Vec<String>]) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    for row in rows {
        let filled = row.iter().zip(&widths).filter(|(_, width)| **width > 0);
        let line: String = filled.map(|(cell, width)| format!("  {cell:width$}")).collect();
        text.push_str(line.trim_end());
        text.push('\n');
    }
}
