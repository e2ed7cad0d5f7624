//! The rules, each a function from a file to its breaches.

use super::file::{Breach, File};
use crate::vhdl::names;

/// A rule: its name, what it expects, and all its breaches in a file.
type Rule = (&'static str, &'static str, fn(&File) -> Vec<Breach>);

/// All rules.
pub(super) const RULES: [Rule; 13] = [
    ("characters", "printable ASCII alone, no tabs, no blank at the end of a line", characters),
    ("line-length", "at most 200 characters before a comment", line_length),
    ("names", "a name that is legal in VHDL and Verilog", legal_names),
    ("libraries", "std_logic_1164, numeric_std and packages of work alone", libraries),
    ("constructs", "VHDL-93 that every release of XST takes", constructs),
    ("direct-entity", "label : entity work.name", direct_entity),
    ("named-association", "port => actual", named_association),
    ("clocked-process", "process (clk) begin if rising_edge(clk) then ... end if; end process", clocked_process),
    (
        "product",
        "p <= a * b alone in a clocked process, with nothing else in its entity but registers of its factors, or a chain of such products",
        product,
    ),
    ("reset", "a synchronous reset of flags and counters alone, not of data", reset),
    ("dimensions", "at most two array dimensions, three within an architecture", dimensions),
    ("record-fields", "a range", record_fields),
    ("case-others", "when others", case_others),
];

/// Most characters of a line before its comment. A comment may be longer: the user's command line stands in one.
const LONGEST: usize = 200;

/// Patterns of what XST refuses or ignores, and of what VHDL-93 does not have.
const CONSTRUCTS: &str = "\\,access,after,assert,block,buffer,bus,component,configuration,disconnect,event,falling_edge,\
    file,guarded,inertial,inout,linkage,postponed,procedure,real,register,reject,report,shared,textio,time,transport,wait,\
    ( all ),/*,<<,?,@,context,else generate,force,protected,release,<= and,<= nand,<= nor,<= or,<= xnor,<= xor";

fn characters(file: &File) -> Vec<Breach> {
    let odd = |line: &str| line.strip_suffix(' ').map(|_| ' ').or(line.chars().find(|c| !matches!(c, ' '..='~')));
    file.lines(|line| Some(format!("character {:?}", odd(line)?)))
}

fn line_length(file: &File) -> Vec<Breach> {
    let length = |line: &str| line.split("--").next().map_or(0, |code| code.trim_end().len());
    file.lines(|line| (length(line) > LONGEST).then(|| format!("{} characters", length(line))))
}

/// Names that are declared stand before a colon or after `type`; those of entities and packages are names of files.
fn legal_names(file: &File) -> Vec<Breach> {
    let declared = file.find("NAME :").chain(file.find("type NAME").map(|at| at + 1));
    let wrong = |at| Some(file.breach(at, format!("{} {}", file.word(at, 0), names::fault(file.word(at, 0))?)));
    declared.filter_map(wrong).collect()
}

fn libraries(file: &File) -> Vec<Breach> {
    let legal = ["ieee . std_logic_1164 . all ;", "ieee . numeric_std . all ;", "work . NAME . all ;"];
    let mut all = file.breaches("library NAME", |at| file.reads(at, 1, "ieee ;"));
    all.extend(file.breaches("use NAME . NAME", |at| legal.iter().any(|clause| file.reads(at, 1, clause))));
    all
}

fn constructs(file: &File) -> Vec<Breach> {
    CONSTRUCTS.split(',').flat_map(|pattern| file.breaches(pattern, |_| false)).collect()
}

fn direct_entity(file: &File) -> Vec<Breach> {
    file.breaches("NAME map", |at| file.reads(at, -5, ": entity work . NAME") || file.word(at, -1) == ")")
}

fn named_association(file: &File) -> Vec<Breach> {
    let entries = file.find("map (").flat_map(|at| file.list(at + 1).0);
    entries.filter(|at| !file.reads(*at, 0, "NAME =>")).map(|at| file.breach(at, file.word(at, 0))).collect()
}

fn clocked_process(file: &File) -> Vec<Breach> {
    let mut all = file.breaches("rising_edge", |at| file.reads(at, -2, "begin if"));
    let others = file.regions("process").filter(|(at, end)| !is_clocked(file, *at, *end));
    all.extend(others.map(|(at, _)| file.breach(at, "process")));
    all
}

/// Whether a process is sensitive to its clock alone, and does all at its edge.
fn is_clocked(file: &File, at: usize, end: usize) -> bool {
    let clock = file.word(at, 2);
    let port = file.find(&format!("{clock} : in std_logic")).next().is_some();
    let begin = (at..end).find(|at| file.word(*at, 0) == "begin").unwrap_or(end);
    let edge = format!("begin if rising_edge ( {clock} ) then");
    let opens = file.reads(at, 1, "( NAME )") && file.reads(begin, 0, &edge);
    let mut depth = 0;
    for at in begin + 1..end {
        match (file.word(at, 0), file.word(at, -1)) {
            ("if", "end") if depth == 1 => return port && opens && file.reads(at, 1, "; end process"),
            ("if", "end") => depth -= 1,
            ("if", _) => depth += 1,
            ("else" | "elsif", _) if depth == 1 => return false,
            _ => {}
        }
    }
    false
}

/// XST infers MULT18X18S from nothing else in every release (Xilinx AR 13182). In front of the factors may be registers, which
/// devices get whose multipliers are far away.
fn product(file: &File) -> Vec<Breach> {
    let others = || file.find("<=").filter(|at| !file.reads(*at, -1, "NAME <= NAME * NAME ;"));
    let clocked = |at| file.regions("process").any(|(from, to)| from < at && at < to);
    let alone = others().all(|at| clocked(at) && file.reads(at, -1, "NAME <= NAME ;"));
    let form = "rising_edge ( NAME ) then NAME <= NAME * NAME ; end if ; end process";
    let is_chain = file.find("*").count() > 1 && file.find("<=").all(|at| clocked(at) && is_link(file, at + 1));
    // A place of bits: a number times the index of a loop is no hardware.
    let is_index = |word: &str| file.find("for").any(|at| file.word(at, 1) == word);
    let is_place = |at| file.word(at, -1).bytes().all(|c| c.is_ascii_digit()) && is_index(file.word(at, 1));
    file.breaches("*", |at| is_place(at) || is_chain || alone && file.reads(at, -8, form))
}

/// Whether what is assigned is of a chain of multipliers: a register, a product, or a sum of two.
fn is_link(file: &File, at: usize) -> bool {
    let factor = |at: usize| match () {
        () if file.reads(at, 1, "(") && file.word(at, 3) == ")" => at + 4,
        () => at + 1,
    };
    let term = |at: usize| match file.word(at, 0) {
        "resize" => file.list(at + 1).1 + 1,
        "-" => at + 2,
        _ => at + 1,
    };
    let ends = |at: usize| file.word(at, 0) == ";";
    match file.word(factor(at), 0) {
        ";" => true,
        "*" => ends(factor(factor(at) + 1)),
        _ => matches!(file.word(term(at), 0), "+" | "-") && ends(term(term(at) + 1)),
    }
}

/// Data are signed numbers and the types of the package, which end in `_t`.
fn reset(file: &File) -> Vec<Breach> {
    let is_data = |name: &str| {
        let ty = file.find(&format!("{name} :")).next().map_or("", |at| match file.word(at, 2) {
            "out" => file.word(at, 3),
            ty => ty,
        });
        ty == "signed" || ty.ends_with("_t")
    };
    let (mut conditions, mut all) = (vec![], vec![]);
    for at in file.find("NAME") {
        let names_reset = || {
            let ahead = (1..).map(|i| file.word(at, i));
            ahead.take_while(|word| !matches!(*word, "then" | "generate" | "")).any(|word| word.contains("reset"))
        };
        match (file.word(at, -1), file.word(at, 0)) {
            ("end", "if") => _ = conditions.pop(),
            (_, "if") => conditions.push(names_reset()),
            (_, word @ ("elsif" | "else")) => {
                conditions.pop();
                conditions.push(word == "elsif" && names_reset());
            }
            (";" | "then" | "else" | "loop" | "=>", target) if conditions.contains(&true) && is_data(target) => {
                all.push(file.breach(at, format!("{target} under reset")));
            }
            _ => {}
        }
    }
    all
}

/// Within an architecture delay lines add the clocks, and memories the words, to what a bundle has.
fn dimensions(file: &File) -> Vec<Breach> {
    let most = 2 + file.find("architecture NAME of").count();
    let deep = file.arrays.iter().filter(|(_, count)| *count > most);
    deep.map(|(at, count)| file.breach(*at, format!("{} has {count}", file.word(*at, 1)))).collect()
}

fn record_fields(file: &File) -> Vec<Breach> {
    let vectors = ["signed ;", "unsigned ;", "std_logic_vector ;"];
    let open = |at: &usize| vectors.iter().any(|vector| file.reads(*at, -1, &format!(": {vector}")));
    let fields = file.regions("record").flat_map(|(at, end)| at..end).filter(open);
    fields.map(|at| file.breach(at, format!("{} without a range", file.word(at, 0)))).collect()
}

fn case_others(file: &File) -> Vec<Breach> {
    let (mut open, mut all) = (vec![], vec![]);
    for at in file.find("NAME") {
        match (file.word(at, 0), file.word(at, 1)) {
            ("end", "case") => all.extend(open.pop().filter(|(_, others)| !others)),
            ("case", _) if file.word(at, -1) != "end" => open.push((at, false)),
            ("when", "others") => {
                if let Some((_, others)) = open.last_mut() {
                    *others = true;
                }
            }
            _ => {}
        }
    }
    all.into_iter().map(|(at, _)| file.breach(at, "case")).collect()
}
