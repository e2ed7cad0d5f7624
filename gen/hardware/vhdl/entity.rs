//! An entity as text: declarations, then what happens clock by clock.

mod statements;

use super::fold::{Statement, merged};
use super::shape::{Object, Shape, Types};
use super::view::View;
use crate::expression::{Expression, Name, loop_variable};
use crate::graph::{Place, Step};
use crate::netlist::{Driver, LINE_CLOCKS, Signal, SignalId};
use crate::op::{Comb, Range};
use askama::Template;
use statements::{condition, is, loop_label, note, sequential, wrapped};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashSet};

/// A port or declaration: its text, and what there is to say of it.
struct Declaration {
    text: String,
    comment: String,
}

/// Statements under a heading.
struct Block {
    heading: String,
    lines: Vec<String>,
}

/// An entity, ready to print.
#[derive(Template)]
#[template(path = "entity.vhd", escape = "none")]
pub struct Entity {
    name: String,
    header: Vec<String>,
    /// The package of the design, if the entity uses it.
    package: Option<String>,
    ports: Vec<Declaration>,
    declarations: Vec<Declaration>,
    blocks: Vec<Block>,
    /// Functions of the package that it calls.
    functions: BTreeSet<&'static str>,
}

impl Entity {
    /// The text.
    ///
    /// # Panics
    /// Never: the template has no part that can fail.
    pub fn text(&self) -> String {
        self.render().expect("the template renders")
    }

    /// Functions of the package that it calls.
    pub fn functions(&self) -> &BTreeSet<&'static str> {
        &self.functions
    }

    pub(super) fn new(view: &View, types: &Types, [prefix, package]: [&str; 2], origin: &[String]) -> Self {
        let module = view.module;
        let mut header = origin.to_vec();
        header.extend(module.doc.iter().cloned());
        match module.latency {
            None => {}
            Some(0) => header.push("Combinational.".to_owned()),
            Some(1) => header.push("Latency: 1 clock.".to_owned()),
            Some(n) => header.push(format!("Latency: {n} clocks.")),
        }
        let printer = Printer { view, types, prefix, labels: RefCell::default() };
        let (blocks, functions) = printer.blocks();
        let mut entity = Self {
            name: format!("{prefix}{}", module.name),
            header,
            package: None,
            ports: printer.ports(),
            declarations: printer.declarations(),
            blocks,
            functions,
        };
        let uses_types = |d: &Declaration| d.text.contains("_t;") || d.text.ends_with("_t") || d.text.contains("_t :=");
        let all = entity.ports.iter().chain(&entity.declarations);
        if !entity.functions.is_empty() || all.into_iter().any(uses_types) || !view.tables().is_empty() {
            entity.package = Some(package.to_owned());
        }
        entity
    }
}

struct Printer<'a, 'b> {
    view: &'a View<'b>,
    types: &'a Types,
    /// Stands before the names of entities.
    prefix: &'a str,
    /// The labels of loops so far.
    labels: RefCell<HashSet<String>>,
}

impl Printer<'_, '_> {
    fn ports(&self) -> Vec<Declaration> {
        let mut ports: Vec<(String, &str, String, String)> = vec![];
        if self.view.module.clocked() {
            ports.push(("clk".to_owned(), "in", "std_logic".to_owned(), String::new()));
        }
        let port_type = |shape: &Shape| match shape {
            Shape::Number(_, bits) if self.view.raw => format!("std_logic_vector({} downto 0)", bits - 1),
            _ => self.types.name(shape),
        };
        for object in &self.view.objects {
            if self.is_port(object) {
                let optional = self.view.module.optional.get(&object.name);
                let bit = optional.map(|bit| format!("'{}'", u8::from(*bit)));
                let value = bit.map(|bit| match object.shape {
                    Shape::Flag => format!(" := {bit}"),
                    _ => format!(" := (others => {bit})"),
                });
                let ty = port_type(&object.shape) + &value.unwrap_or_default();
                ports.push((object.name.clone(), "in", ty, self.describe(object)));
            }
        }
        for object in &self.view.outputs {
            // A register that is the port itself.
            let initial = self.initial(object).filter(|_| self.view.is_direct(object));
            let ty = port_type(&object.shape) + &initial.map_or(String::new(), |value| format!(" := {value}"));
            ports.push((object.name.clone(), "out", ty, self.describe(object)));
        }
        let widest = ports.iter().map(|p| p.0.len()).max().unwrap_or(0);
        let last = ports.len() - 1;
        let each = ports.into_iter().enumerate().map(|(i, (name, direction, ty, comment))| Declaration {
            text: format!("{name:widest$} : {direction:3} {ty}{}", if i == last { "" } else { ";" }),
            comment,
        });
        each.collect()
    }

    fn is_port(&self, object: &Object) -> bool {
        object.members.iter().any(|(id, _)| matches!(self.view.module.signal(*id).driver, Driver::Port))
    }

    /// Format, bound and equation of an object.
    fn describe(&self, object: &Object) -> String {
        let signals: Vec<&Signal> = object.members.iter().map(|(id, _)| self.view.module.signal(*id)).collect();
        let numbers: Vec<&&Signal> = signals.iter().filter(|s| s.ty.signed).collect();
        let mut parts = vec![];
        if let Some(first) = numbers.first() {
            let format = |s: &Signal| s.ty.fraction.map(|_| s.ty.to_string());
            if let Some(text) = format(first).filter(|_| numbers.iter().all(|s| s.ty.fraction == first.ty.fraction)) {
                parts.push(text);
            }
            let bound = |r: Range| r.0.unsigned_abs().max(r.1.unsigned_abs());
            let bounds: Option<Vec<u128>> = numbers.iter().map(|s| s.range.map(bound)).collect();
            if let Some(bound) = bounds.and_then(|b| b.into_iter().max()) {
                parts.push(format!("|.| <= {bound}"));
            }
        }
        let comment = &signals.first().map_or("", |s| &s.comment);
        if !comment.is_empty() && signals.iter().all(|s| s.comment == **comment || s.comment.is_empty()) {
            parts.push((*comment).to_owned());
        }
        parts.join("; ")
    }

    fn declarations(&self) -> Vec<Declaration> {
        let mut all = vec![];
        for table in self.view.tables() {
            let last = table.entries.len() + table.unread - 1;
            let text = if table.flags {
                let bits: String = table.entries.iter().map(ToString::to_string).collect();
                let more =
                    if table.unread > 0 { format!(" & \"{}\"", "0".repeat(table.unread)) } else { String::new() };
                format!("constant {} : std_logic_vector(0 to {last}) := \"{bits}\"{more};", table.name)
            } else {
                let entries: Vec<String> = table.entries.iter().map(ToString::to_string).collect();
                // A long one in rows.
                let rows: Vec<String> = entries.chunks(32).map(|row| row.join(", ")).collect();
                let more = if table.unread > 0 { ", others => 0" } else { "" };
                format!("constant {} : numbers_t(0 to {last}) := ({}{more});", table.name, rows.join(",\n    "))
            };
            all.push(Declaration { text, comment: String::new() });
        }
        for (i, object) in self.view.objects.iter().enumerate() {
            if self.is_port(object) {
                continue;
            }
            let (name, ty) = (&object.name, self.types.name(&object.shape));
            let clocks = clocks_of(&self.view.held_from(object));
            let comment = [self.describe(object), clocks].into_iter().filter(|part| !part.is_empty());
            let comment = comment.collect::<Vec<_>>().join("; ");
            if let Some(line) = self.view.lines.iter().find(|l| l.object == i) {
                let (length, zero) = (line.length, self.types.zero(&object.shape));
                let words = if object.shape == Shape::Flag {
                    format!("std_logic_vector(1 to {length})")
                } else {
                    let text = format!("type {name}_t is array (1 to {length}) of {ty};");
                    all.push(Declaration { text, comment: String::new() });
                    format!("{name}_t")
                };
                all.push(Declaration { text: format!("signal {name} : {words} := (others => {zero});"), comment });
                continue;
            }
            let text = match self.initial(object) {
                Some(value) => format!("signal {name} : {ty} := {value};"),
                None => format!("signal {name} : {ty};"),
            };
            self.memory(object, &ty, &mut all);
            all.push(Declaration { text, comment });
        }
        for object in &self.view.between {
            let text = format!("signal {} : {};", object.name, self.types.name(&object.shape));
            all.push(Declaration { text, comment: String::new() });
        }
        all
    }

    /// The words of a memory, or the clocks of a delay line with a tap.
    fn memory(&self, object: &Object, ty: &str, all: &mut Vec<Declaration>) {
        let [(id, _)] = object.members[..] else { return };
        let name = &object.name;
        let depth = match &self.view.module.signal(id).driver {
            Driver::Memory { depth, .. } => depth,
            Driver::Line { .. } => {
                let text = format!("type {name}_line_t is array (0 to {}) of {ty};", LINE_CLOCKS - 1);
                all.push(Declaration { text, comment: String::new() });
                let zero = self.types.zero(&object.shape);
                let text = format!("signal {name}_line : {name}_line_t := (others => {zero});");
                all.push(Declaration { text, comment: "element i: i + 1 clocks ago".to_owned() });
                return;
            }
            _ => return,
        };
        let text = format!("type {name}_words_t is array (0 to {}) of {ty};", depth - 1);
        all.push(Declaration { text, comment: String::new() });
        let zero = self.types.zero(&object.shape);
        let text = format!("signal {name}_words : {name}_words_t := (others => {zero});");
        all.push(Declaration { text, comment: String::new() });
    }

    /// The value that registers begin with.
    fn initial(&self, object: &Object) -> Option<String> {
        let begins = |id: &SignalId| match &self.view.module.signal(*id).driver {
            Driver::Register { reset, .. } => Some(reset.map_or(0, |r| r.1)),
            _ => None,
        };
        let values: Vec<i128> = object.members.iter().filter_map(|m| begins(&m.0)).collect();
        let first = *values.first()?;
        if values.iter().all(|v| *v == 0) {
            return Some(self.types.zero(&object.shape));
        }
        let [(id, _)] = object.members[..] else { return None };
        Some(Expression::Number(first, self.view.module.signal(id).ty).to_string())
    }

    /// All statements, clock by clock.
    fn blocks(&self) -> (Vec<Block>, BTreeSet<&'static str>) {
        let module = self.view.module;
        let lowered = module.latency.is_some() || module.section;
        let mut functions = BTreeSet::new();
        let mut blocks = vec![];
        // What drives ports, with other statements, then the instances.
        let placed = |driving: Vec<Statement>, instances: Vec<&Statement>, functions: &mut _, lines: &mut _| {
            merged(driving).iter().chain(instances).for_each(|s| self.concurrent(s, 0, functions, lines));
        };
        let (sections, driving): (Vec<_>, Vec<_>) = self.view.sections.iter().map(|s| (&s.0, s.1.clone())).unzip();
        let mut lines = vec![];
        placed(driving.concat(), sections.into_iter().flatten().collect(), &mut functions, &mut lines);
        if !lines.is_empty() {
            blocks.push(Block { heading: "Sections, in the order of the data".to_owned(), lines });
        }
        let mut clocks: BTreeSet<Option<i32>> = module.signals.iter().map(|s| s.clock).collect();
        clocks.extend(self.view.instances.iter().map(|i| i.0));
        let assign = |id| move |name: &Name| Statement::Assign(name.clone(), self.view.driven(id));
        for clock in clocks {
            let mut lines = vec![];
            let free = self.view.statements(|id, s| {
                let free = matches!(&s.driver, Driver::Register { enable: None, reset: None, .. });
                (free && s.clock == clock).then_some(assign(id))
            });
            let has_strobes = !free.is_empty();
            if has_strobes {
                let label = match clock {
                    Some(c) => format!("clock_{c}"),
                    None if lowered => "strobes".to_owned(),
                    None => "registers".to_owned(),
                };
                self.process(&label, merged(free), &mut functions, &mut lines);
            }
            let combinational = self.view.statements(|id, s| {
                let own = matches!(&s.driver, Driver::Combinational { .. }) && s.clock == clock;
                own.then_some(assign(id))
            });
            let mut concurrent = combinational;
            let instances = || self.view.instances.iter().filter(|i| i.0 == clock);
            concurrent.extend(instances().flat_map(|i| i.2.clone()));
            placed(concurrent, instances().flat_map(|i| &i.1).collect(), &mut functions, &mut lines);
            if lines.is_empty() {
                continue;
            }
            let constant = self.view.are_constants(clock);
            let heading = match clock {
                Some(c) => format!("Clock {c}"),
                None if lowered && has_strobes => "Strobes, one per phase, and flags of pairs".to_owned(),
                None if lowered && constant => "Constants".to_owned(),
                None if lowered => "Flags of phases and pairs".to_owned(),
                None => String::new(),
            };
            blocks.push(Block { heading, lines });
        }
        // With an enable: a value of each phase, or one of each pair.
        let enabled = |selects: bool| {
            self.view.statements(|id, s| match &s.driver {
                Driver::Register { op, enable: Some(enable), reset: None, .. }
                    if matches!(op, Some(Comb::Lookup(..))) == selects =>
                {
                    Some(move |name: &Name| Statement::If(self.view.value(*enable), vec![assign(id)(name)], vec![]))
                }
                _ => None,
            })
        };
        for (selects, label, heading) in [
            (true, "selectors", "Selectors, set in the clock before their phase"),
            (false, "captures", "Registers that load under an enable"),
        ] {
            let registers = enabled(selects);
            if !registers.is_empty() {
                let mut lines = vec![];
                self.process(label, merged(registers), &mut functions, &mut lines);
                blocks.push(Block { heading: heading.to_owned(), lines });
            }
        }
        let mut rest = vec![];
        self.delay_lines(&mut functions, &mut rest);
        self.tapped_lines(&mut functions, &mut rest);
        if !rest.is_empty() {
            blocks.push(Block { heading: "Delay lines".to_owned(), lines: rest });
        }
        let mut state = vec![];
        self.state(&mut functions, &mut state);
        self.memories(&mut functions, &mut state);
        if !state.is_empty() {
            blocks.push(Block { heading: "State".to_owned(), lines: state });
        }
        let mut outputs = vec![];
        for statement in merged(self.view.port_assignments()) {
            self.concurrent(&statement, 0, &mut functions, &mut outputs);
        }
        if !outputs.is_empty() {
            blocks.push(Block { heading: "Outputs".to_owned(), lines: outputs });
        }
        (blocks, functions)
    }

    fn delay_lines(&self, functions: &mut BTreeSet<&'static str>, lines: &mut Vec<String>) {
        if self.view.lines.is_empty() {
            return;
        }
        lines.push("delays : process (clk)".to_owned());
        lines.push("begin".to_owned());
        lines.push("  if rising_edge(clk) then".to_owned());
        for line in &self.view.lines {
            let Object { name, shape, .. } = &self.view.objects[line.object];
            let (length, before) = (line.length, line.length - 1);
            let text = match &line.source {
                // What is concatenated could be a word or, but for this, a line of words.
                Some(source @ Expression::Binary(_, "&", _)) => {
                    let ty = self.types.name(shape);
                    let mark = ty.split_once('(').map_or(&*ty, |(mark, _)| mark);
                    format!("{name} <= {mark}'({source}) & {name}(1 to {before});")
                }
                Some(source @ Expression::Binary(..)) => format!("{name} <= ({source}) & {name}(1 to {before});"),
                Some(source) => format!("{name} <= {source} & {name}(1 to {before});"),
                None => format!("{name}(2 to {length}) <= {name}(1 to {before});"),
            };
            line.source.iter().for_each(|source| note(source, functions));
            line.parts.iter().for_each(|part| sequential(self.view, part, 2, functions, lines));
            lines.extend(wrapped(&text, 4));
        }
        lines.push("  end if;".to_owned());
        lines.push("end process delays;".to_owned());
    }

    /// Registers with a reset, by reset and enable.
    fn state(&self, functions: &mut BTreeSet<&'static str>, lines: &mut Vec<String>) {
        let mut groups: Vec<(SignalId, Option<SignalId>)> = vec![];
        for signal in &self.view.module.signals {
            if let Driver::Register { reset: Some((reset, _)), enable, .. } = &signal.driver
                && !groups.contains(&(*reset, *enable))
            {
                groups.push((*reset, *enable));
            }
        }
        let mut statements = vec![];
        for (flag, when) in groups {
            let group = |value: &dyn Fn(SignalId, &Signal, i128) -> Expression| {
                merged(self.view.statements(|id, s| match &s.driver {
                    Driver::Register { reset: Some((reset, start)), enable, .. }
                        if (*reset, *enable) == (flag, when) =>
                    {
                        Some(move |name: &Name| Statement::Assign(name.clone(), value(id, s, *start)))
                    }
                    _ => None,
                }))
            };
            let resets = group(&|_, s, start| Expression::Number(start, s.ty));
            let loads = group(&|id, _, _| self.view.driven(id));
            let loads = match when {
                Some(enable) => vec![Statement::If(self.view.value(enable), loads, vec![])],
                None => loads,
            };
            statements.push(Statement::If(self.view.value(flag), resets, loads));
        }
        if !statements.is_empty() {
            self.process("state", statements, functions, lines);
        }
    }

    fn memories(&self, functions: &mut BTreeSet<&'static str>, lines: &mut Vec<String>) {
        for object in &self.view.objects {
            let [(id, _)] = object.members[..] else { continue };
            let Driver::Memory { write, address, data, read, .. } = &self.view.module.signal(id).driver else {
                continue;
            };
            let (name, value) = (&object.name, |id: &SignalId| self.view.value(*id));
            functions.insert("known");
            lines.extend([
                format!("write_{name} : process (clk)"),
                "begin".to_owned(),
                "  if rising_edge(clk) then".to_owned(),
                format!("    if {} then", condition(&value(write))),
                format!("      {name}_words(to_integer(known({}))) <= {};", value(address), value(data)),
                "    end if;".to_owned(),
                "  end if;".to_owned(),
                format!("end process write_{name};"),
                format!("{name} <= {name}_words(to_integer(known({})));", value(read)),
            ]);
        }
    }

    /// Delay lines with a tap.
    fn tapped_lines(&self, functions: &mut BTreeSet<&'static str>, lines: &mut Vec<String>) {
        for object in &self.view.objects {
            let [(id, _)] = object.members[..] else { continue };
            let Driver::Line { data, tap } = &self.view.module.signal(id).driver else { continue };
            let (name, value) = (&object.name, |id: &SignalId| self.view.value(*id));
            functions.insert("known");
            lines.extend([
                format!("shift_{name} : process (clk)"),
                "begin".to_owned(),
                "  if rising_edge(clk) then".to_owned(),
                format!("    {name}_line <= {} & {name}_line(0 to {});", value(data), LINE_CLOCKS - 2),
                "  end if;".to_owned(),
                format!("end process shift_{name};"),
                format!("{name} <= {name}_line(to_integer(known({})));", value(tap)),
            ]);
        }
    }

    /// A label of its own: two rows of one array are two loops.
    fn label(&self, name: String) -> String {
        let mut labels = self.labels.borrow_mut();
        let numbered = (2..).map(|n| format!("{name}_{n}"));
        let label = std::iter::once(name.clone()).chain(numbered).find(|label| !labels.contains(label));
        let label = label.expect("one of endlessly many");
        labels.insert(label.clone());
        label
    }

    fn process(
        &self,
        label: &str,
        statements: Vec<Statement>,
        functions: &mut BTreeSet<&'static str>,
        lines: &mut Vec<String>,
    ) {
        lines.push(format!("{label} : process (clk)"));
        lines.push("begin".to_owned());
        lines.push("  if rising_edge(clk) then".to_owned());
        statements.iter().for_each(|s| sequential(self.view, s, 2, functions, lines));
        lines.push("  end if;".to_owned());
        lines.push(format!("end process {label};"));
    }

    fn concurrent(
        &self,
        statement: &Statement,
        depth: usize,
        functions: &mut BTreeSet<&'static str>,
        lines: &mut Vec<String>,
    ) {
        let pad = "  ".repeat(depth);
        match statement {
            Statement::Assign(target, value) => {
                note(value, functions);
                let text = match value {
                    Expression::Select(index, legs) => match &legs[..] {
                        [clear, set] if index.ty.is_flag() => {
                            let mut text = format!("{target} <= {set} when {} else", condition(&index.value));
                            // A choice among bundles, for which the package has no function, goes on in the same way.
                            let mut last = clear;
                            while let Expression::Select(index, legs) = last
                                && let ([clear, set], true) = (&legs[..], index.ty.is_flag())
                            {
                                text += &format!(" {set} when {} else", condition(&index.value));
                                last = clear;
                            }
                            vec![format!("{text} {last};")]
                        }
                        _ => {
                            let (last, others) = legs.split_last().expect("a choice has operands");
                            let mut text = vec![format!("{target} <=")];
                            for (i, leg) in others.iter().enumerate() {
                                text.push(format!("  {leg} when {} else", is(index, i)));
                            }
                            text.push(format!("  {last};"));
                            text
                        }
                    },
                    other => vec![format!("{target} <= {other};")],
                };
                text.iter().for_each(|t| lines.extend(wrapped(t, 2 * depth)));
            }
            Statement::Instance { label, entity, connections } => {
                let label = if depth > 0 { "unit" } else { label };
                lines.push(format!("{pad}{label} : entity work.{}{entity}", self.prefix));
                let ports: Vec<String> = connections.iter().map(|(f, a)| format!("{f} => {a}")).collect();
                lines.extend(wrapped(&format!("port map ({});", ports.join(", ")), 2 * depth + 2));
            }
            Statement::Loop { depth: variable, first, size, body } => {
                let label = self.label(loop_label(body));
                let variable = loop_variable(*variable);
                lines.push(format!("{pad}{label} : for {variable} in {first} to {} generate", first + size - 1));
                body.iter().for_each(|s| self.concurrent(s, depth + 1, functions, lines));
                lines.push(format!("{pad}end generate {label};"));
            }
            Statement::If(..) => panic!("a flag governs registers alone"),
        }
    }
}

/// From which clocks on something is there; nothing where there are none.
fn clocks_of(clocks: &BTreeSet<i32>) -> String {
    let all: Vec<i32> = clocks.iter().copied().collect();
    let text = |all: &[i32]| all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    match all[..] {
        [] => String::new(),
        [one] => format!("from clock {one} on"),
        [a, b, .., last] if all.len() > 3 && all.windows(2).all(|pair| pair[1] - pair[0] == b - a) => {
            format!("from clocks {a}, {b}, ... {last} on")
        }
        _ => format!("from clocks {} on", text(&all)),
    }
}

/// What GHDL calls an instance inside a generate statement over the last index of its name, and inside two of them over the
/// last two: it counts the iterations from one. Nothing for a name that does not end in an index.
pub fn generated_instance(place: &Place) -> Vec<String> {
    let (mut path, mut iterations, mut found) = (place.path.clone(), vec![], vec![]);
    while iterations.len() < 2
        && let Some(Step::Index(i) | Step::Component(i)) = path.pop()
    {
        iterations.insert(0, format!("n{}", i + 1));
        let label = Place { path: path.clone(), ..place.clone() };
        found.push(match &iterations[..] {
            [inner] => format!("{label}_{inner}_unit"),
            [outer, inner] => format!("{label}_of_{outer}_{label}_{inner}_unit"),
            _ => unreachable!("two loops at most"),
        });
    }
    found
}
