//! What the entity template prints: ready text, in order.

use super::expression::{Expression, Printer, literal, port_type, type_name};
use super::names::{self, Clash};
use crate::graph::netlist::{DelayLine, Driver, Module, Signal, SignalId};
use crate::graph::{Op, Type};
use askama::Template;
use std::collections::{BTreeMap, HashMap, HashSet};

/// One port.
struct Port {
    name: String,
    direction: &'static str,
    ty: String,
    comment: String,
    last: bool,
}

/// A declaration: one line.
struct Declaration {
    text: String,
    comment: String,
}

/// A concurrent assignment: its lines.
struct Assignment {
    comment: String,
    lines: Vec<String>,
}

/// Assignments of one clock of the slot.
struct Stage {
    title: String,
    assignments: Vec<Assignment>,
}

/// A clocked process.
struct Process {
    label: String,
    title: String,
    /// Statements inside `if rising_edge(clk)`.
    lines: Vec<String>,
}

/// A port map entry.
struct Connection {
    formal: String,
    actual: String,
    last: bool,
}

/// An instance.
struct Instance {
    label: String,
    entity: String,
    connections: Vec<Connection>,
}

/// An entity, ready to print.
#[derive(Template)]
#[template(path = "entity.vhd", escape = "none")]
pub struct Entity {
    name: String,
    header: Vec<String>,
    ports: Vec<Port>,
    declarations: Vec<Declaration>,
    stages: Vec<Stage>,
    instances: Vec<Instance>,
    processes: Vec<Process>,
    outputs: Vec<String>,
}

impl Entity {
    /// The text.
    ///
    /// # Panics
    /// Never: the template has no part that can fail.
    pub fn text(&self) -> String {
        self.render().expect("the template renders")
    }
}

/// The view of a module; `origin` is printed above the module's own header.
///
/// # Errors
/// A name that is not legal.
pub fn entity(module: &Module, origin: &[String]) -> Result<Entity, Clash> {
    names::check(module)?;
    let printer = Printer(module);
    let lines = Lines::of(module);
    let mut header = origin.to_vec();
    header.push(String::new());
    header.extend(module.doc.iter().cloned());
    if let Some(latency) = module.latency {
        header.push(String::new());
        header.push(match latency {
            0 => "Combinational.".to_owned(),
            1 => "Latency: 1 clock.".to_owned(),
            n => format!("Latency: {n} clocks."),
        });
    }
    Ok(Entity {
        name: module.name.clone(),
        header,
        ports: ports(module),
        declarations: declarations(module, &lines),
        stages: stages(&printer, &lines),
        instances: instances(&printer),
        processes: processes(&printer, &lines),
        outputs: module.outputs.iter().map(|(name, id)| format!("{name} <= {};", printer.port_value(*id))).collect(),
    })
}

/// The delay lines of a module, and which signals are in them.
struct Lines {
    all: Vec<DelayLine>,
    /// Registers inside a line: they have no name of their own.
    inner: HashSet<SignalId>,
    /// The last register of each line, as index into `all`.
    last: HashMap<SignalId, usize>,
}

impl Lines {
    fn of(module: &Module) -> Self {
        let all = module.delay_lines();
        let (mut inner, mut last) = (HashSet::new(), HashMap::new());
        for (i, line) in all.iter().enumerate() {
            if let Some((end, before)) = line.registers.split_last() {
                inner.extend(before);
                last.insert(*end, i);
            }
        }
        Self { all, inner, last }
    }

    fn contains(&self, id: SignalId) -> bool {
        self.inner.contains(&id) || self.last.contains_key(&id)
    }
}

fn ports(module: &Module) -> Vec<Port> {
    let port = |name: &str, direction, t: Type, comment: String| Port {
        name: name.to_owned(),
        direction,
        ty: port_type(t),
        comment,
        last: false,
    };
    let mut ports = vec![];
    if module.clocked() {
        ports.push(port("clk", "in", Type::FLAG, String::new()));
    }
    for id in &module.inputs {
        let s = module.signal(*id);
        ports.push(port(&s.name, "in", s.ty, describe(s)));
    }
    for (name, id) in &module.outputs {
        let s = module.signal(*id);
        ports.push(port(name, "out", s.ty, describe(s)));
    }
    if let Some(last) = ports.last_mut() {
        last.last = true;
    }
    ports
}

/// Format, range and equation of a signal.
fn describe(s: &Signal) -> String {
    let mut parts = vec![];
    if s.ty.bits > 1 {
        parts.push(s.ty.to_string());
        if let Some((lo, hi)) = s.range {
            parts.push(format!("[{lo}, {hi}]"));
        }
    }
    if !s.comment.is_empty() {
        parts.push(s.comment.clone());
    }
    parts.join("  ")
}

fn zeros(t: Type) -> &'static str {
    if super::expression::is_flag(t) { "'0'" } else { "(others => '0')" }
}

fn declarations(module: &Module, lines: &Lines) -> Vec<Declaration> {
    let mut all = vec![];
    for (i, s) in module.signals.iter().enumerate() {
        if lines.inner.contains(&SignalId(i)) {
            continue;
        }
        let (name, ty) = (&s.name, type_name(s.ty));
        let op = match &s.driver {
            Driver::Combinational { op, .. } => Some(op),
            Driver::Register { op, .. } => op.as_ref(),
            _ => None,
        };
        if let Some(Op::Clamp(bound, _)) = op {
            for (end, value) in bounds(name).into_iter().zip([-bound, *bound]) {
                let text = format!("constant {end} : {ty} := {};", literal(value, s.ty));
                all.push(Declaration { text, comment: String::new() });
            }
        }
        let text = match &s.driver {
            _ if lines.last.contains_key(&SignalId(i)) => {
                let line = &lines.all[lines.last[&SignalId(i)]];
                let [signal, words] = names::delay_line(module, line);
                let text = format!("type {words} is array (1 to {}) of {ty};", line.registers.len());
                all.push(Declaration { text, comment: String::new() });
                let text = format!("signal {signal} : {words} := (others => {});", zeros(s.ty));
                let comment = format!("delay line of {}", module.signal(line.source).name);
                all.push(Declaration { text, comment });
                format!("signal {name} : {ty};")
            }
            Driver::Port => continue,
            Driver::Combinational { op: Op::Constant(value), .. } => {
                format!("constant {name} : {ty} := {};", literal(*value, s.ty))
            }
            Driver::Combinational { .. } => format!("signal {name} : {ty};"),
            Driver::Instance { .. } => format!("signal {name} : {};", port_type(s.ty)),
            Driver::Register { reset: Some((_, value)), .. } => {
                format!("signal {name} : {ty} := {};", literal(*value, s.ty))
            }
            Driver::Register { .. } => format!("signal {name} : {ty} := {};", zeros(s.ty)),
            Driver::Memory { depth, .. } => {
                let text = format!("type {name}_words is array (0 to {}) of {ty};", depth - 1);
                all.push(Declaration { text, comment: String::new() });
                let text = format!("signal {name}_memory : {name}_words := (others => {});", zeros(s.ty));
                all.push(Declaration { text, comment: String::new() });
                format!("signal {name} : {ty};")
            }
        };
        all.push(Declaration { text, comment: describe(s) });
    }
    all
}

/// Names of the constants of a clamp.
fn bounds(name: &str) -> [String; 2] {
    [format!("{name}_least"), format!("{name}_most")]
}

fn concurrent(name: &str, expression: Expression) -> Vec<String> {
    match expression {
        Expression::Simple(text) => vec![format!("{name} <= {text};")],
        Expression::Choice(cases, rest) if cases.is_empty() => vec![format!("{name} <= {rest};")],
        Expression::Choice(cases, rest) => {
            let one_line = cases.len() == 1 && cases[0].0.len() + cases[0].1.len() + rest.len() + name.len() < 90;
            if one_line {
                return vec![format!("{name} <= {} when {} else {rest};", cases[0].0, cases[0].1)];
            }
            let mut lines = vec![format!("{name} <=")];
            lines.extend(cases.iter().map(|(value, condition)| format!("  {value} when {condition} else")));
            lines.push(format!("  {rest};"));
            lines
        }
    }
}

fn sequential(name: &str, expression: Expression) -> Vec<String> {
    match expression {
        Expression::Simple(text) => vec![format!("{name} <= {text};")],
        Expression::Choice(cases, rest) if cases.is_empty() => vec![format!("{name} <= {rest};")],
        Expression::Choice(cases, rest) => {
            let mut lines = vec![];
            for (i, (value, condition)) in cases.iter().enumerate() {
                lines.push(format!("{} {condition} then", if i == 0 { "if" } else { "elsif" }));
                lines.push(format!("  {name} <= {value};"));
            }
            lines.push("else".to_owned());
            lines.push(format!("  {name} <= {rest};"));
            lines.push("end if;".to_owned());
            lines
        }
    }
}

fn stages(printer: &Printer, delays: &Lines) -> Vec<Stage> {
    let mut by_clock: BTreeMap<Option<i32>, Vec<Assignment>> = BTreeMap::new();
    for (i, s) in printer.0.signals.iter().enumerate() {
        let lines = match &s.driver {
            _ if delays.last.contains_key(&SignalId(i)) => {
                let line = &delays.all[delays.last[&SignalId(i)]];
                let [signal, _] = names::delay_line(printer.0, line);
                vec![format!("{} <= {signal}({});", s.name, line.registers.len())]
            }
            Driver::Combinational { op: Op::Constant(_), .. } => continue,
            Driver::Combinational { op, args } => {
                concurrent(&s.name, printer.expression(op, args, s.ty, &bounds(&s.name)))
            }
            Driver::Memory { read, .. } => {
                vec![format!("{0} <= {0}_memory(to_integer({1}));", s.name, printer.value(*read))]
            }
            Driver::Port | Driver::Register { .. } | Driver::Instance { .. } => continue,
        };
        by_clock.entry(s.clock).or_default().push(Assignment { comment: s.comment.clone(), lines });
    }
    by_clock
        .into_iter()
        .map(|(clock, assignments)| Stage {
            title: clock.map_or("State and choice".to_owned(), |c| format!("Clock {c}")),
            assignments,
        })
        .collect()
}

fn instances(printer: &Printer) -> Vec<Instance> {
    let module = printer.0;
    let mut all: Vec<Instance> = vec![];
    for (index, instance) in module.instances.iter().enumerate() {
        let inner = &instance.module;
        let mut connections = vec![];
        let mut connect = |formal: &str, actual: String| {
            connections.push(Connection { formal: formal.to_owned(), actual, last: false });
        };
        if inner.clocked() {
            connect("clk", "clk".to_owned());
        }
        for (port, actual) in inner.inputs.iter().zip(&instance.inputs) {
            connect(&inner.signal(*port).name, printer.port_value(*actual));
        }
        for (port, (formal, _)) in inner.outputs.iter().enumerate() {
            let here = |s: &&Signal| matches!(&s.driver, Driver::Instance { instance, port: p } if *instance == index && *p == port);
            let actual = module.signals.iter().find(here).map_or("open".to_owned(), |s| s.name.clone());
            connect(formal, actual);
        }
        if let Some(last) = connections.last_mut() {
            last.last = true;
        }
        all.push(Instance { label: instance.label.clone(), entity: inner.name.clone(), connections });
    }
    all
}

/// Registers in one process each: by clock where they run free, by enable and reset where they do not.
fn processes(printer: &Printer, lines: &Lines) -> Vec<Process> {
    let module = printer.0;
    type Key = (Option<SignalId>, Option<SignalId>, Option<i32>);
    let mut groups: BTreeMap<Key, Vec<usize>> = BTreeMap::new();
    let mut memories = vec![];
    for (i, s) in module.signals.iter().enumerate() {
        match &s.driver {
            _ if lines.contains(SignalId(i)) => {}
            Driver::Register { enable, reset, .. } => {
                let clock = if enable.is_none() && reset.is_none() { s.clock } else { None };
                groups.entry((reset.map(|r| r.0), *enable, clock)).or_default().push(i);
            }
            Driver::Memory { write, address, data, .. } => memories.push(Process {
                label: format!("write_{}", s.name),
                title: describe(s),
                lines: vec![
                    format!("if {} = '1' then", module.signal(*write).name),
                    format!(
                        "  {}_memory(to_integer({})) <= {};",
                        s.name,
                        printer.value(*address),
                        printer.value(*data)
                    ),
                    "end if;".to_owned(),
                ],
            }),
            _ => {}
        }
    }
    let name = |id: SignalId| module.signal(id).name.clone();
    let mut all = vec![];
    for ((reset, enable, clock), members) in groups {
        let mut loads = vec![];
        let mut resets = vec![];
        for i in members {
            let s = &module.signals[i];
            let Driver::Register { op, args, reset, .. } = &s.driver else { continue };
            let expression = match op {
                Some(op) => printer.expression(op, args, s.ty, &bounds(&s.name)),
                None => Expression::Simple(printer.value(args[0])),
            };
            loads.extend(sequential(&s.name, expression));
            if let Some((_, value)) = reset {
                resets.push(format!("{} <= {};", s.name, literal(*value, s.ty)));
            }
        }
        let indent = |lines: Vec<String>| lines.into_iter().map(|l| format!("  {l}"));
        let (label, title, lines) = match (reset, enable) {
            (None, None) => match clock {
                Some(c) => (format!("clock_{c}"), format!("Registers valid in clock {c}."), loads),
                None => ("phases".to_owned(), "Strobes, phase patterns and running state.".to_owned(), loads),
            },
            (None, Some(enable)) => {
                let enable = name(enable);
                let mut lines = vec![format!("if {enable} = '1' then")];
                lines.extend(indent(loads));
                lines.push("end if;".to_owned());
                (format!("hold_{enable}"), format!("Held from {enable} to the next."), lines)
            }
            (Some(reset), enable) => {
                let mut lines = vec![format!("if {} = '1' then", name(reset))];
                lines.extend(indent(resets));
                let label = match enable {
                    Some(enable) => {
                        lines.push(format!("elsif {} = '1' then", name(enable)));
                        format!("state_{}", name(enable))
                    }
                    None => {
                        lines.push("else".to_owned());
                        "state".to_owned()
                    }
                };
                lines.extend(indent(loads));
                lines.push("end if;".to_owned());
                (label, "State, reset synchronously.".to_owned(), lines)
            }
        };
        all.push(Process { label, title, lines });
    }
    if !lines.all.is_empty() {
        let shift = |line: &DelayLine| {
            let [signal, _] = names::delay_line(module, line);
            let kept = line.registers.len() - 1;
            format!("{signal} <= {} & {signal}(1 to {kept});", printer.value(line.source))
        };
        all.push(Process {
            label: "delay_lines".to_owned(),
            title: "Delay lines: shift registers without reset, for SRL16.".to_owned(),
            lines: lines.all.iter().map(shift).collect(),
        });
    }
    all.extend(memories);
    all
}
