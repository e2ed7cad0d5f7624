//! The rules that need all files of a design: what is bound to what, who drives what, and what feeds a multiplier.

use super::outline::{Assignment, Declaration, Instance, Outline, Part, Port};
use super::rules::factors;
use super::token::Kind;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// File, rule, line and what is wrong.
pub(super) type Found = (usize, &'static str, usize, String);

/// The rules that need all files: name and demand.
pub(super) const RULES: [(&str, &str); 4] = [
    ("bound", "every instance is of an entity printed before, with every port connected once"),
    ("one-driver", "every signal and out port has one driver: one process, concurrent assignment or instance"),
    ("declared", "what is assigned is a signal or an out port"),
    ("product-operand", "the operands of a product come straight from registers, through wires alone"),
];

/// Where a value comes from, through wires.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    Register,
    Port(String),
    Logic(String),
}

/// What other files need to know of an entity.
struct Known<'o, 'a> {
    outline: &'o Outline<'a>,
    /// In ports that reach a multiplier through wires alone.
    multiplied: BTreeSet<String>,
    /// Out ports that come from registers through wires alone.
    registered: BTreeSet<String>,
}

/// Checks all files, instantiated ones before those that use them.
pub(super) fn check(outlines: &[Outline]) -> Vec<Found> {
    let mut known: HashMap<String, Known> = HashMap::new();
    let mut found = vec![];
    for (file, outline) in outlines.iter().enumerate() {
        let mut wrong = |rule, line, message| found.push((file, rule, line, message));
        bound(outline, &known, &mut wrong);
        drivers(outline, &known, &mut wrong);
        let multiplied = operands(outline, &known, &mut wrong);
        let registered = registered(outline, &known);
        known.insert(outline.entity.to_ascii_lowercase(), Known { outline, multiplied, registered });
    }
    found
}

type Wrong<'w> = &'w mut dyn FnMut(&'static str, usize, String);

/// The instances of a file: each with the entity it is of, if that is known.
fn instances<'o, 'a, 'k>(
    o: &'o Outline<'a>,
    known: &'k HashMap<String, Known<'k, 'a>>,
) -> impl Iterator<Item = (&'o Instance<'a>, Option<&'k Known<'k, 'a>>)> {
    o.instances.iter().map(|instance| {
        let name = o.part(&instance.unit).last().map_or("", |t| t.text);
        (instance, known.get(&name.to_ascii_lowercase()))
    })
}

fn bound<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>, wrong: Wrong) {
    for (instance, entity) in instances(o, known) {
        let label = instance.label.unwrap_or("an instance");
        let Some(entity) = entity else {
            wrong("bound", instance.line, format!("{label} is of {}, not printed before", o.words(&instance.unit)));
            continue;
        };
        let mut formals: Vec<String> = instance.map.iter().filter_map(|m| m.0.map(str::to_ascii_lowercase)).collect();
        for port in &entity.outline.ports {
            let before = formals.len();
            formals.retain(|formal| !formal.eq_ignore_ascii_case(port.name));
            if before - formals.len() != 1 {
                wrong(
                    "bound",
                    instance.line,
                    format!("{label}: port {} is connected {} times", port.name, before - formals.len()),
                );
            }
        }
        for formal in formals {
            wrong("bound", instance.line, format!("{label}: there is no port {formal}"));
        }
    }
}

fn is_out(o: &Outline, formal: &str) -> bool {
    o.ports.iter().any(|p| p.name.eq_ignore_ascii_case(formal) && p.mode.eq_ignore_ascii_case("out"))
}

fn drivers<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>, wrong: Wrong) {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    let mut processes: BTreeSet<(String, usize)> = BTreeSet::new();
    for assignment in &o.assignments {
        let target = assignment.target.to_ascii_lowercase();
        let more = assignment.process.is_none_or(|process| processes.insert((target.clone(), process)));
        *count.entry(target).or_default() += usize::from(more);
    }
    for (instance, entity) in instances(o, known) {
        for (formal, actual) in &instance.map {
            let out = formal.is_some_and(|formal| entity.is_some_and(|e| is_out(e.outline, formal)));
            let target = o.part(actual).first().map_or("", |t| t.text).to_ascii_lowercase();
            if out && target != "open" {
                *count.entry(target).or_default() += 1;
            }
        }
    }
    let signals = o.declarations.iter().filter(|d| d.class.eq_ignore_ascii_case("signal")).map(|d| (d.name, d.line));
    let outs = o.ports.iter().filter(|p| p.mode.eq_ignore_ascii_case("out")).map(|p| (p.name, p.line));
    for (name, line) in signals.chain(outs) {
        let n = count.remove(&name.to_ascii_lowercase()).unwrap_or(0);
        if n != 1 {
            wrong("one-driver", line, format!("{name} has {n} drivers"));
        }
    }
    for (name, _) in count {
        let line = o.assignments.iter().find(|a| a.target.eq_ignore_ascii_case(&name)).map_or(0, |a| a.line);
        wrong("declared", line, format!("{name} is assigned"));
    }
}

/// Checks what products take; the in ports that they take through wires.
fn operands<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>, wrong: Wrong) -> BTreeSet<String> {
    let mut ports = BTreeSet::new();
    let mut judge = |what: String, line: usize, sources: BTreeSet<Source>| {
        for source in sources {
            match source {
                Source::Register => {}
                Source::Port(port) => {
                    ports.insert(port);
                }
                Source::Logic(name) => {
                    wrong("product-operand", line, format!("{what} takes {name}, which is computed in the same clock"))
                }
            }
        }
    };
    for assignment in o.assignments.iter().filter(|a| a.process.is_some()) {
        if factors(o, &assignment.value).is_some() {
            judge(format!("product {}", assignment.target), assignment.line, sources(o, known, &assignment.value));
        }
    }
    for (instance, entity) in instances(o, known) {
        let Some(entity) = entity else { continue };
        for (formal, actual) in &instance.map {
            if formal.is_some_and(|formal| entity.multiplied.contains(&formal.to_ascii_lowercase())) {
                let what = format!("{}.{}", instance.label.unwrap_or("instance"), formal.unwrap_or_default());
                let straight = is_wire(o, actual);
                let computed = || BTreeSet::from([Source::Logic(o.words(actual))]);
                judge(what, instance.line, if straight { sources(o, known, actual) } else { computed() });
            }
        }
    }
    ports
}

/// The out ports that come from registers through wires alone.
fn registered<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>) -> BTreeSet<String> {
    let straight = |a: &&Assignment| {
        let sources = if is_wire(o, &a.value) { sources(o, known, &a.value) } else { BTreeSet::new() };
        is_out(o, a.target) && (a.process.is_some() || sources == BTreeSet::from([Source::Register]))
    };
    o.assignments.iter().filter(straight).map(|a| a.target.to_ascii_lowercase()).collect()
}

/// Where the names of a value come from, through wires.
fn sources<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>, value: &Part) -> BTreeSet<Source> {
    let names = |value: &Part| -> Vec<&'a str> {
        let words = o.part(value).iter().filter(|t| t.kind == Kind::Word && !t.any(&WIRING));
        words.map(|t| t.text).collect()
    };
    let mut open = names(value);
    let mut seen = BTreeSet::new();
    let mut found = BTreeSet::new();
    while let Some(name) = open.pop() {
        if !seen.insert(name) {
            continue;
        }
        let driver = o.assignments.iter().find(|a| a.target.eq_ignore_ascii_case(name));
        let constant = |d: &Declaration| !d.class.eq_ignore_ascii_case("signal") && d.name.eq_ignore_ascii_case(name);
        let input = |p: &Port| p.name.eq_ignore_ascii_case(name) && p.mode.eq_ignore_ascii_case("in");
        match driver {
            Some(assignment) if assignment.process.is_none() && is_wire(o, &assignment.value) => {
                open.extend(names(&assignment.value));
                continue;
            }
            _ => {}
        }
        let registered = driver.is_some_and(|a| a.process.is_some());
        found.insert(if o.ports.iter().any(input) {
            Source::Port(name.to_ascii_lowercase())
        } else if registered || o.declarations.iter().any(constant) || leaves_a_register(o, known, name) {
            Source::Register
        } else {
            Source::Logic(name.to_owned())
        });
    }
    found
}

/// Whether a name is what comes out of registers of an instance.
fn leaves_a_register<'a>(o: &Outline<'a>, known: &HashMap<String, Known<'_, 'a>>, name: &str) -> bool {
    instances(o, known).any(|(instance, entity)| {
        instance.map.iter().any(|(formal, actual)| {
            let whole = matches!(o.part(actual), [t] if t.text.eq_ignore_ascii_case(name));
            let formal = formal.unwrap_or_default().to_ascii_lowercase();
            whole && entity.is_some_and(|entity| entity.registered.contains(&formal))
        })
    })
}

/// Words that cost no gate.
const WIRING: [&str; 6] = ["signed", "unsigned", "std_logic_vector", "resize", "downto", "to"];

/// Whether a value is made of names, slices, casts, extensions and concatenation alone.
fn is_wire(o: &Outline, value: &Part) -> bool {
    o.part(value).iter().enumerate().all(|(i, token)| match token.kind {
        Kind::Symbol => token.any(&["(", ")", "&", ",", "'"]),
        // An index that is a name is a multiplexer.
        Kind::Word => {
            token.any(&WIRING) || !(i > 1 && o.part(value)[i - 1].is("(") && !o.part(value)[i - 2].any(&WIRING))
        }
        _ => true,
    })
}
