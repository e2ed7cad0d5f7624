//! The rules that need one file alone.

use super::outline::{Outline, Part};
use super::token::{Kind, Token};
use crate::vhdl::names;
use std::collections::{HashMap, HashSet};

/// Takes the line and what is wrong in it.
pub(super) type Report<'r> = &'r mut dyn FnMut(usize, String);

/// A rule on one file.
pub(super) struct Rule {
    /// Its name.
    pub name: &'static str,
    /// What it demands.
    pub demands: &'static str,
    /// Reports every breach.
    pub check: fn(&Outline, Report),
}

/// The rules, in the order of the standard's chapters.
pub(super) const RULES: [Rule; 17] = [
    Rule { name: "ascii", demands: "every character is ASCII", check: ascii },
    Rule {
        name: "names",
        demands: "names are legal, no keyword of any language, and unique whatever the case",
        check: legal_names,
    },
    Rule { name: "libraries", demands: "std_logic_1164 and numeric_std alone", check: libraries },
    Rule {
        name: "constructs",
        demands: "nothing that XST refuses or ignores: wait, after, shared variables, components, ...",
        check: constructs,
    },
    Rule {
        name: "vhdl-2008",
        demands: "no operator, literal or generate form of VHDL-2008 or later",
        check: later_vhdl,
    },
    Rule {
        name: "choice-in-process",
        demands: "no conditional or selected assignment in a process",
        check: choice_in_process,
    },
    Rule { name: "ports", demands: "ports are in or out, std_logic or std_logic_vector", check: ports },
    Rule { name: "out-port-read", demands: "an out port is not read", check: out_port_read },
    Rule { name: "direct-entity", demands: "instances name their entity: label : entity work.x", check: direct_entity },
    Rule { name: "named-association", demands: "every entry of a port map names its port", check: named_association },
    Rule {
        name: "clocked-process",
        demands: "a process is `if rising_edge(clk)` and nothing beside it",
        check: clocked_process,
    },
    Rule {
        name: "asynchronous-reset",
        demands: "a process is sensitive to its clock alone, which is a port",
        check: asynchronous_reset,
    },
    Rule {
        name: "initial-value",
        demands: "registers have an initial value and nothing else has",
        check: initial_value,
    },
    Rule { name: "reset-value", demands: "a register is reset to its initial value", check: reset_value },
    Rule { name: "product", demands: "p <= a * b of two names, in a clocked process, without reset", check: product },
    Rule {
        name: "aggregate",
        demands: "(others => ...) is a whole value, so that its range is known",
        check: aggregate,
    },
    Rule { name: "case-others", demands: "every case has others", check: case_others },
];

fn ascii(o: &Outline, report: Report) {
    for (i, line) in o.source.lines().enumerate() {
        if let Some(c) = line.chars().find(|c| !c.is_ascii() || (c.is_control() && *c != '\r')) {
            report(i + 1, format!("character {c:?}"));
        }
    }
}

fn legal_names(o: &Outline, report: Report) {
    let entity = o.part(&(0..o.architecture)).iter().find(|t| t.is("entity")).map_or(1, |t| t.line);
    let ports = o.ports.iter().map(|p| (p.name, p.line));
    let declared = o.declarations.iter().map(|d| (d.name, d.line));
    let processes = o.processes.iter().filter_map(|p| p.label.map(|l| (l, p.line)));
    let instances = o.instances.iter().filter_map(|i| i.label.map(|l| (l, i.line)));
    let mut seen = HashSet::new();
    for (name, line) in [(o.entity, entity)].into_iter().chain(ports).chain(declared).chain(processes).chain(instances)
    {
        if let Some(why) = names::fault(name) {
            report(line, format!("{name} {why}"));
        }
        if !seen.insert(name.to_ascii_lowercase()) {
            report(line, format!("{name} is declared twice"));
        }
    }
    for token in o.tokens.iter().filter(|t| t.kind == Kind::Extended) {
        report(token.line, format!("extended identifier {}", token.text));
    }
}

fn libraries(o: &Outline, report: Report) {
    for at in 0..o.tokens.len() {
        let end = || o.find(at..o.tokens.len(), &[";"]);
        let clause = |part: Part| o.part(&part).iter().map(|t| t.text.to_ascii_lowercase()).collect::<String>();
        let line = o.tokens[at].line;
        if o.tokens[at].is("library") && clause(at + 1..end()) != "ieee" {
            report(line, format!("library {}", o.words(&(at + 1..end()))));
        }
        let legal = ["ieee.std_logic_1164.all", "ieee.numeric_std.all"];
        if o.tokens[at].is("use") && !legal.contains(&clause(at + 1..end()).as_str()) {
            report(line, format!("use {}", o.words(&(at + 1..end()))));
        }
    }
}

/// Words that no synthesizable file of ours holds.
const CONSTRUCTS: [&str; 23] = [
    "access",
    "after",
    "block",
    "bus",
    "component",
    "configuration",
    "context",
    "disconnect",
    "file",
    "force",
    "function",
    "guarded",
    "inertial",
    "postponed",
    "procedure",
    "real",
    "register",
    "reject",
    "release",
    "shared",
    "textio",
    "transport",
    "wait",
];

fn constructs(o: &Outline, report: Report) {
    for token in o.tokens.iter().filter(|t| t.any(&CONSTRUCTS)) {
        report(token.line, token.text.to_ascii_lowercase());
    }
}

fn later_vhdl(o: &Outline, report: Report) {
    let all = o.tokens.len();
    let operand = |t: &Token| (t.kind != Kind::Symbol && !reserved(t)) || t.is(")") || t.is("all");
    for (at, token) in o.tokens.iter().enumerate() {
        let before = at.checked_sub(1).map(|i| &o.tokens[i]);
        let after = |word: &str| o.tokens.get(at + 1).is_some_and(|t| t.is(word));
        let symbols = ["??", "?=", "?/=", "?<", "?<=", "?>", "?>=", "<<", ">>", "/*", "@", "^"];
        let bits = || token.text[..token.text.find('"').unwrap_or(0)].to_ascii_lowercase();
        let wrong = if token.any(&symbols) {
            Some(format!("operator {}", token.text))
        } else if token.kind == Kind::Bits && !["b", "o", "x"].contains(&bits().as_str()) {
            Some(format!("bit string {}", token.text))
        } else if token.kind == Kind::Bits && token.adjacent && before.is_some_and(|b| b.kind == Kind::Number) {
            Some(format!("sized bit string {}", token.text))
        } else if token.any(&["and", "or", "xor", "nand", "nor", "xnor"]) && !before.is_some_and(operand) {
            Some(format!("{} of one operand", token.text))
        } else if token.any(&["else", "elsif"])
            && o.tokens.get(o.find(at..all, &["generate", ";", "then"])).is_some_and(|t| t.is("generate"))
        {
            Some(format!("{} generate", token.text))
        } else if (token.is("process") && after("(") && o.tokens.get(at + 2).is_some_and(|t| t.is("all")))
            || (token.is("case") && after("?"))
        {
            Some(format!("{} ( {}", token.text, if token.is("process") { "all )" } else { "?" }))
        } else if token.any(&["to_hstring", "to_ostring", "to_string", "to_bstring", "std.env"]) {
            Some(token.text.to_owned())
        } else {
            None
        };
        if let Some(wrong) = wrong {
            report(token.line, wrong);
        }
    }
}

/// Whether a word is a keyword that ends no operand.
fn reserved(t: &Token) -> bool {
    let words = [
        "and", "or", "xor", "nand", "nor", "xnor", "not", "when", "if", "elsif", "else", "return", "until", "select",
        "is",
    ];
    t.any(&words)
}

fn choice_in_process(o: &Outline, report: Report) {
    for assignment in o.assignments.iter().filter(|a| a.process.is_some()) {
        if o.part(&assignment.value).iter().any(|t| t.is("when")) {
            report(assignment.line, format!("{} is assigned with when", assignment.target));
        }
    }
    for process in &o.processes {
        for token in o.part(&process.body).iter().filter(|t| t.is("select")) {
            report(token.line, "a selected assignment".to_owned());
        }
    }
}

fn ports(o: &Outline, report: Report) {
    for port in &o.ports {
        let ty = o.part(&port.ty).first().map_or("", |t| t.text);
        if !["in", "out"].iter().any(|mode| port.mode.eq_ignore_ascii_case(mode)) {
            report(port.line, format!("{} : {}", port.name, port.mode));
        } else if !["std_logic", "std_logic_vector"].iter().any(|legal| ty.eq_ignore_ascii_case(legal)) {
            report(port.line, format!("{} : {} {ty}", port.name, port.mode));
        } else if o.part(&port.ty).iter().any(|t| t.is(":=")) {
            report(port.line, format!("{} has a default", port.name));
        }
    }
}

fn out_port_read(o: &Outline, report: Report) {
    let outs: HashSet<String> =
        o.ports.iter().filter(|p| p.mode.eq_ignore_ascii_case("out")).map(|p| p.name.to_ascii_lowercase()).collect();
    // Legal places: where it is assigned, and as a formal of another entity's port of the same name.
    let targets: HashSet<usize> = o.assignments.iter().map(|a| a.whole.start).collect();
    for at in o.architecture..o.tokens.len() {
        let token = &o.tokens[at];
        let formal = o.tokens.get(at + 1).is_some_and(|t| t.is("=>")) && at > 0 && o.tokens[at - 1].any(&["(", ","]);
        let name = token.kind == Kind::Word && outs.contains(&token.text.to_ascii_lowercase());
        if name && !targets.contains(&at) && !formal {
            report(token.line, format!("{} is read", token.text));
        }
    }
}

fn direct_entity(o: &Outline, report: Report) {
    for instance in &o.instances {
        let unit = o.part(&instance.unit);
        let direct = unit.len() == 4 && unit[0].is("entity") && unit[1].is("work") && unit[2].is(".");
        if !direct {
            report(instance.line, format!("instance of {}", o.words(&instance.unit)));
        }
    }
}

fn named_association(o: &Outline, report: Report) {
    for instance in &o.instances {
        for (formal, actual) in &instance.map {
            if formal.is_none() {
                report(instance.line, format!("{} stands by its place", o.words(actual)));
            }
        }
    }
}

fn clocked_process(o: &Outline, report: Report) {
    for process in &o.processes {
        let body = o.part(&process.body);
        let head = ["if", "rising_edge", "("];
        let tail = [")", "then"];
        let opens = body.len() > 9
            && head.iter().enumerate().all(|(i, w)| body[i].is(w))
            && tail.iter().enumerate().all(|(i, w)| body[4 + i].is(w));
        // The `if` of the edge is closed by the very last statement, so nothing stands beside it.
        let mut depth = 0i32;
        let mut closed = None;
        for (i, token) in body.iter().enumerate() {
            if token.is("if") {
                depth += if i > 0 && body[i - 1].is("end") { -1 } else { 1 };
            }
            if depth == 0 && closed.is_none() {
                closed = Some(i);
            }
        }
        let alone = closed.is_some_and(|i| i + 2 == body.len());
        if !(opens && alone) {
            report(process.line, format!("process {}", process.label.unwrap_or("without a label")));
        }
    }
}

fn asynchronous_reset(o: &Outline, report: Report) {
    for process in &o.processes {
        // In `if rising_edge(clk)`, whatever the clock is called: it comes from outside, and nothing makes or gates it.
        let clock = o.part(&process.body).get(3).map_or("", |t| t.text);
        let port = o.ports.iter().any(|p| p.name.eq_ignore_ascii_case(clock));
        let alone = process.sensitivity.len() == 1 && o.part(&process.sensitivity)[0].text.eq_ignore_ascii_case(clock);
        if !(port && alone) {
            report(process.line, format!("process ({})", o.words(&process.sensitivity)));
        }
    }
}

fn initial_value(o: &Outline, report: Report) {
    let clocked: HashSet<String> =
        o.assignments.iter().filter(|a| a.process.is_some()).map(|a| a.target.to_ascii_lowercase()).collect();
    for signal in o.declarations.iter().filter(|d| d.class.eq_ignore_ascii_case("signal")) {
        match (clocked.contains(&signal.name.to_ascii_lowercase()), signal.initial.is_some()) {
            (true, false) => report(signal.line, format!("register {} has none", signal.name)),
            (false, true) => report(signal.line, format!("{} is no register", signal.name)),
            _ => {}
        }
    }
}

fn reset_value(o: &Outline, report: Report) {
    let initial: HashMap<String, String> = o
        .declarations
        .iter()
        .filter_map(|d| d.initial.as_ref().map(|value| (d.name.to_ascii_lowercase(), o.words(value))))
        .collect();
    for assignment in o.assignments.iter().filter(|a| a.reset && a.whole.len() == 1) {
        let value = o.words(&assignment.value);
        match initial.get(&assignment.target.to_ascii_lowercase()) {
            Some(first) if *first != zeros(&value) && *first != value => {
                report(assignment.line, format!("{} begins as {first} and is reset to {value}", assignment.target));
            }
            _ => {}
        }
    }
}

/// A literal of zeros as the aggregate that means the same.
fn zeros(value: &str) -> String {
    let digits = value.strip_prefix('"').and_then(|v| v.strip_suffix('"'));
    match digits {
        Some(digits) if digits.bytes().all(|d| d == b'0') => "( others => '0' )".to_owned(),
        _ => value.to_owned(),
    }
}

fn product(o: &Outline, report: Report) {
    let reset: HashSet<String> =
        o.assignments.iter().filter(|a| a.reset).map(|a| a.target.to_ascii_lowercase()).collect();
    let stars: Vec<usize> = (o.architecture..o.tokens.len()).filter(|at| o.tokens[*at].is("*")).collect();
    for at in stars {
        let line = o.tokens[at].line;
        let Some(assignment) = o.assignments.iter().find(|a| a.value.contains(&at)) else {
            report(line, "a product outside an assignment".to_owned());
            continue;
        };
        if assignment.process.is_none() {
            report(line, format!("{} is a product without a register", assignment.target));
        } else if factors(o, &assignment.value).is_none() {
            report(line, format!("{} <= {}", assignment.target, o.words(&assignment.value)));
        } else if reset.contains(&assignment.target.to_ascii_lowercase()) {
            report(line, format!("product register {} is reset", assignment.target));
        }
    }
}

/// The names multiplied, if a value is a product of two names, each as it is or read as signed, and nothing else.
pub(super) fn factors<'a>(o: &Outline<'a>, value: &Part) -> Option<[&'a str; 2]> {
    let factor = |part: &[Token<'a>]| match part {
        [name] if name.kind == Kind::Word => Some(name.text),
        [cast, open, name, close]
            if cast.any(&["signed", "unsigned"]) && open.is("(") && name.kind == Kind::Word && close.is(")") =>
        {
            Some(name.text)
        }
        _ => None,
    };
    let star = o.find(value.clone(), &["*"]);
    let second = if star < value.end { o.part(&(star + 1..value.end)) } else { return None };
    Some([factor(o.part(&(value.start..star)))?, factor(second)?])
}

fn aggregate(o: &Outline, report: Report) {
    let nested = |at: usize| {
        // Outwards through aggregates to what stands before the outermost one.
        let mut open = at;
        while open >= 3 && o.tokens[open - 1].is("=>") && o.tokens[open - 2].is("others") && o.tokens[open - 3].is("(")
        {
            open -= 3;
        }
        open
    };
    for at in 1..o.tokens.len() {
        let others = o.tokens[at].is("others") && o.tokens[at - 1].is("(");
        let whole = || {
            let open = nested(at - 1);
            let close = o.find(open + 1..o.tokens.len(), &[")"]);
            open > 0
                && o.tokens[open - 1].any(&["<=", ":="])
                && o.tokens.get(close + 1).is_some_and(|t| t.any(&[";", ")"]) || t.any(&["when", "else"]))
        };
        if others && !whole() {
            report(o.tokens[at].line, "others within an expression".to_owned());
        }
    }
}

fn case_others(o: &Outline, report: Report) {
    for at in 0..o.tokens.len() {
        let opens = o.tokens[at].is("case") && !(at > 0 && o.tokens[at - 1].is("end"));
        if !opens {
            continue;
        }
        let mut depth = 0;
        let mut others = false;
        for i in at..o.tokens.len() {
            if o.tokens[i].is("case") {
                depth += if i > at && o.tokens[i - 1].is("end") { -1 } else { 1 };
            }
            let arm = o.tokens[i].is("others") && o.tokens[i - 1].any(&["when", "|"]);
            others |= depth == 1 && arm;
            if depth == 0 {
                break;
            }
        }
        if !others {
            report(o.tokens[at].line, "no others".to_owned());
        }
    }
}
