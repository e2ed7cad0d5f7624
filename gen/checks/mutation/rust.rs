//! Mutants of the reference model's sources: constants, operators and bounds of every line of code.

use super::{Kind, Mutant};
use std::collections::HashMap;

/// An operator and what takes its place.
const OPERATORS: [(&str, &str, Kind); 22] = [
    (" < ", " <= ", Kind::Comparison),
    (" <= ", " < ", Kind::Comparison),
    (" > ", " >= ", Kind::Comparison),
    (" >= ", " > ", Kind::Comparison),
    (" == ", " != ", Kind::Comparison),
    (" != ", " == ", Kind::Comparison),
    (" && ", " || ", Kind::Case),
    (" || ", " && ", Kind::Case),
    (" | ", " & ", Kind::Case),
    (" |= ", " &= ", Kind::Case),
    (" + ", " - ", Kind::Operand),
    (" - ", " + ", Kind::Operand),
    (" * ", " + ", Kind::Operand),
    ("(-", "(", Kind::Operand),
    (".min(", ".max(", Kind::Bound),
    (".max(", ".min(", Kind::Bound),
    (".lo", ".hi", Kind::Bound),
    (".hi", ".lo", Kind::Bound),
    (" << ", " >> ", Kind::Constant),
    (" >> ", " << ", Kind::Constant),
    ("[j]", "[k]", Kind::Operand),
    ("[k]", "[j]", Kind::Operand),
];

/// Functions of the sources that no answer of the model depends on: legal and default parameters, messages,
/// the design's timing.
const NOT_THE_MODEL: [(&str, &str); 10] = [
    ("number.rs", "integral"),
    ("number.rs", "min"),
    ("number.rs", "value"),
    ("number.rs", "fmt"),
    ("number.rs", "floor_shift"),
    ("params/mod.rs", "validate"),
    ("params/mod.rs", "interval"),
    ("params/mod.rs", "transform_rows"),
    ("params/guard.rs", "name"),
    ("params/guard.rs", "assumptions"),
];

/// All mutants of a source file, its tests aside.
pub fn mutants(file: &str, text: &str) -> Vec<Mutant> {
    let mut all = vec![];
    let mut places = HashMap::<String, usize>::new();
    let mut item = String::new();
    let lines = text.split_inclusive('\n').scan(0, |at, line| {
        *at += line.len();
        Some((*at - line.len(), line.trim_end()))
    });
    for (i, (start, line)) in lines.enumerate() {
        if line == "#[cfg(test)]" {
            break;
        }
        let code = line.trim_start();
        if let Some(name) = defined(code) {
            item = name;
        }
        if NOT_THE_MODEL.contains(&(file, item.as_str())) {
            continue;
        }
        if ["//", "#[", "+ ", "use ", "pub use ", "mod ", "pub mod "].iter().any(|start| code.starts_with(start)) {
            continue;
        }
        let mut found = vec![];
        for (sign, other, kind) in OPERATORS {
            // A function's head has bounds and arrows, no operators.
            if code.contains("fn ") && kind != Kind::Bound {
                continue;
            }
            // Both indices must be there, and a bar between patterns is no operator.
            let one_index = sign.starts_with('[') && !(line.contains("[j]") && line.contains("[k]"));
            if one_index || (sign == " | " && (code.contains("=>") || code.contains("matches!"))) {
                continue;
            }
            for (at, _) in line.match_indices(sign).filter(|(at, sign)| is_code(line, *at, at + sign.len())) {
                found.push((at, at + sign.len(), other.to_owned(), kind));
            }
        }
        for (from, to) in numbers(line) {
            let number: u64 = line[from..to].parse().unwrap_or_default();
            found.push((from, to, (number + 1).to_string(), Kind::Constant));
        }
        found.sort();
        for (from, to, new, kind) in found {
            // The addend of an upper bound and the digits dropped are what rounds.
            let rounds = ["lift", "drop", "Sticky", "Implied"].iter().any(|word| code.contains(word));
            let kind = if rounds && kind != Kind::Bound { Kind::Rounding } else { kind };
            let mut change = format!("{} -> {}", line[from..to].trim(), new.trim());
            let count = places.entry(format!("{item}:{kind}:{change}")).or_default();
            *count += 1;
            if *count > 1 {
                change = format!("{change} #{count}");
            }
            let (unit, target, place) = (file.to_owned(), item.clone(), start + from..start + to);
            all.push(Mutant { unit, line: i + 1, target, kind, change, place, new });
        }
    }
    all
}

/// The function or constant that a line begins.
fn defined(code: &str) -> Option<String> {
    let words: Vec<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty()).collect();
    let at = words.iter().position(|word| ["fn", "const", "static", "impl"].contains(word))?;
    let name = words[at + 1..].iter().find(|word| !["fn", "const", "mut"].contains(word))?;
    let head = ["fn ", "pub ", "const ", "static ", "impl"].iter().any(|start| code.starts_with(start));
    (head && !code.contains("= |")).then(|| (*name).to_owned())
}

/// Whether a place is outside texts, comments and the angle brackets of types.
fn is_code(line: &str, from: usize, to: usize) -> bool {
    let quotes = line[..from].matches('"').count();
    let comment = line.find("//").is_some_and(|at| at < from);
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '(';
    // `.lo` is a bound, `.lower` is not.
    let ends = !line[from..to].starts_with('.') || line[from..to].ends_with('(') || !line[to..].starts_with(word);
    quotes.is_multiple_of(2) && !comment && ends
}

/// Whole numbers of the code; lengths of arrays and parts of names and of other numbers are none.
fn numbers(line: &str) -> Vec<(usize, usize)> {
    let mut found = vec![];
    let bytes = line.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let length = line[at..].bytes().take_while(u8::is_ascii_digit).count();
        if length == 0 {
            at += 1;
            continue;
        }
        let (from, to) = (at, at + length);
        let word = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_' || *b == b'.';
        let before = from.checked_sub(1).map(|i| &bytes[i]);
        let alone =
            !before.is_some_and(word) && !bytes.get(to).is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
        let range = before == Some(&b'.') && from >= 2 && bytes[from - 2] == b'.';
        let array = line[..from].ends_with("; ") && line[to..].starts_with(']');
        if (alone || range) && !array && is_code(line, from, to) {
            found.push((from, to));
        }
        at = to;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "//! 1 < 2.\nuse x::{1};\n\n/// At 3.\npub fn next(x: [u8; 3]) -> bool {\n    let y = x.lo + 1; // 4\n    \
                        y >= x[0] && y < \"5 < 6\"\n}\n\n#[cfg(test)]\nmod tests {\n    const A: u8 = 1 + 1;\n}\n";

    #[test]
    fn code_yields_mutants_and_nothing_else_does() {
        let all = mutants("f.rs", TEXT);
        let found: Vec<String> = all.iter().map(|m| format!("{} {}", m.line, m.name())).collect();
        assert_eq!(
            found,
            [
                "6 f.rs:next:bound:.lo -> .hi",
                "6 f.rs:next:operand:+ -> -",
                "6 f.rs:next:constant:1 -> 2",
                "7 f.rs:next:comparison:>= -> >",
                "7 f.rs:next:constant:0 -> 1",
                "7 f.rs:next:case:&& -> ||",
                "7 f.rs:next:comparison:< -> <=",
            ]
        );
        for mutant in &all {
            let changed = mutant.apply(TEXT);
            assert_eq!(TEXT.lines().zip(changed.lines()).filter(|(a, b)| a != b).count(), 1, "{mutant:?}");
        }
    }
}
