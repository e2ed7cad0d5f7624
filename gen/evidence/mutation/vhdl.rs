//! Mutants of the generated VHDL: every change that the forms of its lines allow, in the order of the lines.

use super::text::{Role, Source, Statement};
use super::{Kind, Mutant};
use std::collections::HashMap;

/// All mutants of the file of an entity. `late` is one and a half periods of the clock, in picoseconds.
pub fn mutants(unit: &str, text: &str, late: u32) -> Vec<Mutant> {
    let source = Source::new(text);
    let mut all: Vec<Mutant> = vec![];
    let mut places = HashMap::<String, usize>::new();
    for (i, statement) in source.statements.iter().enumerate() {
        let next = source.statements.get(i + 1).filter(|next| next.target == statement.target);
        let mut editor = Editor { unit, source: &source, statement, found: vec![] };
        editor.names();
        editor.rounding();
        editor.conditions();
        editor.arms(next);
        editor.logic();
        editor.arithmetic();
        editor.literals();
        editor.indices();
        editor.register(late);
        editor.found.sort_by_key(|mutant| mutant.kind);
        for mut mutant in editor.found {
            // The same change at another place of the same target: the place is counted.
            let count = places.entry(mutant.name()).or_default();
            *count += 1;
            if *count > 1 {
                mutant.change = format!("{} #{count}", mutant.change);
            }
            all.push(mutant);
        }
    }
    all
}

/// Finds the changes of one statement.
struct Editor<'a> {
    unit: &'a str,
    source: &'a Source<'a>,
    statement: &'a Statement,
    found: Vec<Mutant>,
}

impl<'a> Editor<'a> {
    fn line(&self) -> &'a str {
        self.source.lines[self.statement.line - 1]
    }

    /// The part that may be changed.
    fn part(&self) -> &'a str {
        &self.line()[self.statement.span.0..self.statement.span.1]
    }

    /// A mutant with `from..to` of the part replaced.
    fn replace(&mut self, kind: Kind, (from, to): (usize, usize), new: &str, change: impl Into<String>) {
        let (line, start) = (self.line(), self.statement.span.0);
        self.found.push(Mutant {
            unit: self.unit.to_owned(),
            line: self.statement.line,
            target: self.statement.target.clone(),
            kind,
            change: change.into(),
            text: format!("{}{new}{}", &line[..start + from], &line[start + to..]),
        });
    }

    /// A mutant with the whole part replaced.
    fn rewrite(&mut self, kind: Kind, new: &str, change: impl Into<String>) {
        self.replace(kind, (0, self.part().len()), new, change);
    }

    fn target_type(&self) -> &'a str {
        self.source.type_of(&self.statement.target).unwrap_or_default()
    }

    /// The declared names in the part, with their places.
    fn used(&self) -> Vec<(usize, &'a str)> {
        let part = self.part();
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut at = 0;
        let mut used = vec![];
        while at < part.len() {
            let rest = &part[at..];
            let length = rest.find(|c| !word(c)).unwrap_or(rest.len());
            if length > 0 && self.source.types.contains_key(&rest[..length]) {
                used.push((at, &rest[..length]));
            }
            at += length.max(1);
        }
        used
    }

    /// Other names in place of those that are used: the other bound, a neighbour, a register earlier.
    fn names(&mut self) {
        for (at, name) in self.used() {
            let place = (at, at + name.len());
            let bound = self.other_bound(name);
            if let Some(other) = &bound {
                self.replace(Kind::Bound, place, other, format!("{name} -> {other}"));
            }
            if let Some(other) = self.neighbour(name, bound.as_deref()) {
                self.replace(Kind::Operand, place, other, format!("{name} -> {other}"));
            }
            if let Some(earlier) = self.earlier(name, self.part()[place.1..].starts_with('(')) {
                // A port takes words as they are, and no conversion of a conversion.
                let word = earlier.split_once('(').map(|(_, word)| word.trim_end_matches(')'));
                match word.filter(|_| self.part() == format!("std_logic_vector({name})")) {
                    Some(word) => self.rewrite(Kind::Delay, word, format!("{name} -> {word}")),
                    None => self.replace(Kind::Delay, place, &earlier, format!("{name} -> {earlier}")),
                }
            }
        }
    }

    /// The upper bound that belongs to a lower one, or the reverse.
    fn other_bound(&self, name: &str) -> Option<String> {
        let mut words: Vec<&str> = name.split('_').collect();
        let last = words.iter().rposition(|word| matches!(*word, "lo" | "hi"))?;
        words[last] = if words[last] == "lo" { "hi" } else { "lo" };
        let other = words.join("_");
        let fits = self.source.type_of(&other) == self.source.type_of(name) && other != self.statement.target;
        fits.then_some(other)
    }

    /// The name of the same type that is declared last before this one, or else first after it.
    fn neighbour(&self, name: &str, bound: Option<&str>) -> Option<&'a str> {
        let (ty, order) = self.source.types[name];
        let fits = |(other, (t, _)): &(&&'a str, &(&str, usize))| {
            let known = [Some(name), bound, Some(self.statement.target.as_str())].contains(&Some(**other));
            *t == ty && !known && undelayed(other) != undelayed(name) && **other != "clk"
        };
        let others = || self.source.types.iter().filter(fits);
        let before = others().filter(|(_, (_, o))| *o < order).max_by_key(|(_, (_, o))| *o);
        before.or_else(|| others().min_by_key(|(_, (_, o))| *o)).map(|(other, _)| *other)
    }

    /// What a register takes its value from, if it is one of a chain.
    fn earlier(&self, name: &str, sliced: bool) -> Option<String> {
        let (base, steps) = delay(name)?;
        let before = match steps {
            1 => base.to_owned(),
            _ => format!("{}{}", &name[..name.len() - steps.to_string().len()], steps - 1),
        };
        let (own, of_before) = (self.source.type_of(name)?, self.source.type_of(&before)?);
        if own == of_before {
            return Some(before);
        }
        let (kind, range) = own.split_once('(')?;
        let raw = of_before.strip_prefix("std_logic_vector(") == Some(range);
        (raw && !sliced).then(|| format!("{kind}({before})"))
    }

    /// Ulps and sticky bits.
    fn rounding(&mut self) {
        let (target, part) = (self.statement.target.clone(), self.part());
        if self.statement.role == Role::Constant && target.ends_with("_ulp") {
            self.rewrite(Kind::Rounding, "'0'", "ulp dropped");
        }
        if self.statement.role != Role::Concurrent {
            return;
        }
        if let Some(at) = part.find(" + resize(signed'('0' & ") {
            let ulp = &part[at..].trim_start_matches(" + resize(signed'('0' & ").split(')').next();
            if !ulp.is_some_and(|ulp| ulp.ends_with("_ulp")) {
                // A magnitude is converted as a whole.
                let rest = if part.starts_with("unsigned(") { ")" } else { "" };
                self.replace(Kind::Rounding, (at, part.len()), rest, "ulp dropped");
            }
            self.replace(Kind::Rounding, (part.len(), part.len()), " + 1", "an ulp too many");
        }
        if target.ends_with("_floor_lo") && self.target_type().starts_with("signed") {
            self.rewrite(Kind::Rounding, &format!("{part} + 1"), "lower bound rounded up");
        }
        if self.target_type() == "std_logic" && (target.ends_with("_sticky") || target.ends_with("_inexact")) {
            self.rewrite(Kind::Rounding, "'0'", "sticky bit dropped");
            self.rewrite(Kind::Rounding, "'1'", "sticky bit forced");
        }
    }

    /// Where the condition of the statement begins and ends.
    fn condition(&self) -> Option<(usize, usize)> {
        let part = self.part();
        if self.statement.role == Role::Condition {
            return Some((0, part.len()));
        }
        let from = part.find(" when ")? + " when ".len();
        Some((from, from + part[from..].find(" else ").unwrap_or(part.len() - from)))
    }

    fn conditions(&mut self) {
        let Some((from, to)) = self.condition() else { return };
        let part = self.part();
        for (sign, others) in [(" < ", [" <= ", " > "]), (" > ", [" >= ", " < "])] {
            for (at, _) in part[from..to].match_indices(sign) {
                for other in others {
                    let change = format!("{} -> {}", sign.trim(), other.trim());
                    self.replace(Kind::Comparison, (from + at, from + at + sign.len()), other, change);
                }
            }
        }
        for (at, sign) in part[from..to].match_indices(" = ") {
            let place = (from + at, from + at + sign.len());
            let rest = &part[place.1..];
            let flag = rest.starts_with('\'');
            let kind = if flag { Kind::Case } else { Kind::Comparison };
            self.replace(kind, place, " /= ", "= -> /=");
            let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            if let Ok(number) = rest[..digits].parse::<u32>() {
                let change = format!("{number} -> {}", number + 1);
                self.replace(Kind::Constant, (place.1, place.1 + digits), &(number + 1).to_string(), change);
            }
        }
    }

    /// The values of a choice: swapped, or the next one in place of this one.
    fn arms(&mut self, next: Option<&Statement>) {
        let part = self.part();
        let Some((value, rest)) = part.split_once(" when ") else { return };
        if let Some((condition, other)) = rest.split_once(" else ") {
            self.rewrite(Kind::Case, &format!("{other} when {condition} else {value}"), "arms swapped");
        } else if let Some(next) = next {
            let line = self.source.lines[next.line - 1];
            let next = &line[next.span.0..next.span.1];
            let other = next.split_once(" when ").map_or(next, |(value, _)| value);
            self.replace(Kind::Case, (0, value.len()), other, format!("{value} -> {other}, the next arm"));
        }
    }

    fn logic(&mut self) {
        let part = self.part();
        if part.contains(" when ") || self.statement.role == Role::Condition {
            return;
        }
        if let Some(positive) = part.strip_prefix("not ") {
            self.rewrite(Kind::Case, positive, "not dropped");
        }
        for (sign, other) in [(" and ", " or "), (" or ", " and ")] {
            if let Some((left, right)) = part.split_once(sign) {
                let change = format!("{} -> {}", sign.trim(), other.trim());
                self.rewrite(Kind::Case, &format!("{left}{other}{right}"), change);
                if self.target_type() == "std_logic" {
                    self.rewrite(Kind::Case, &format!("(not {left}){sign}{right}"), format!("not {left}"));
                    self.rewrite(Kind::Case, &format!("{left}{sign}(not {right})"), format!("not {right}"));
                }
            }
        }
    }

    fn arithmetic(&mut self) {
        let part = self.part();
        if part.contains(" when ") {
            return;
        }
        if let Some((left, right)) = part.split_once(" - ") {
            self.rewrite(Kind::Operand, &format!("{right} - {left}"), "operands exchanged");
            self.rewrite(Kind::Operand, &format!("{left} + {right}"), "- -> +");
            if self.statement.target.ends_with("_difference") {
                self.rewrite(Kind::Comparison, &format!("{part} - 1"), "< -> <=");
            }
        }
        if let Some((left, right)) = part.split_once(" + ") {
            self.rewrite(Kind::Operand, &format!("{left} - {right}"), "+ -> -");
        }
        if let Some(positive) = part.strip_prefix('-') {
            self.rewrite(Kind::Operand, positive, "sign dropped");
        }
        let pieces: Vec<&str> = part.split(" & ").collect();
        if pieces.len() > 1 && !part.contains(['"', '\'']) {
            let mut swapped = pieces.clone();
            swapped.swap(0, 1);
            self.rewrite(Kind::Operand, &swapped.join(" & "), "first two exchanged");
        }
    }

    fn literals(&mut self) {
        let part = self.part();
        let bare = self.statement.role != Role::Condition && !part.contains(" when ");
        if bare && matches!(part, "'0'" | "'1'") && !self.statement.target.ends_with("_ulp") {
            let other = if part == "'0'" { "'1'" } else { "'0'" };
            self.rewrite(Kind::Constant, other, format!("{part} -> {other}"));
        }
        let quotes: Vec<usize> = part.match_indices('"').map(|(at, _)| at).collect();
        for pair in quotes.chunks_exact(2) {
            let last = pair[1] - 1;
            let other = if &part[last..=last] == "0" { "1" } else { "0" };
            self.replace(Kind::Constant, (last, last + 1), other, format!("last bit of a literal -> {other}"));
        }
    }

    /// Slices and single bits, off by one.
    fn indices(&mut self) {
        let part = self.part();
        for (at, name) in self.used() {
            let open = at + name.len();
            let Some(inside) = part[open..].strip_prefix('(').and_then(|rest| rest.split(')').next()) else { continue };
            let place = (open + 1, open + 1 + inside.len());
            let range = self.source.type_of(name).and_then(|ty| ty.split_once('(')).map_or("", |(_, range)| range);
            let high: Option<u32> = range.split(' ').next().and_then(|high| high.parse().ok());
            let moved = match inside.split_once(" downto ") {
                Some((h, l)) => match (h.parse::<u32>(), l.parse::<u32>()) {
                    (Ok(h), Ok(l)) if l > 0 => format!("{} downto {}", h - 1, l - 1),
                    (Ok(h), Ok(l)) if high.is_some_and(|high| h < high) => format!("{} downto {}", h + 1, l + 1),
                    _ => continue,
                },
                None => match inside.parse::<u32>() {
                    Ok(0) if high.is_some_and(|high| high > 0) => "1".to_owned(),
                    Ok(bit) if bit > 0 => (bit - 1).to_string(),
                    _ => continue,
                },
            };
            let kind = if name.ends_with("_line") { Kind::Delay } else { Kind::Constant };
            self.replace(kind, place, &moved, format!("({inside}) -> ({moved})"));
        }
    }

    /// A register more: the value arrives one clock edge later.
    fn register(&mut self, late: u32) {
        if self.statement.role == Role::Register {
            let late = format!("transport {} after {late} ps", self.part());
            self.rewrite(Kind::Delay, &late, "a register too many");
        }
    }
}

/// The name without `_d1`, `_r2` and the like, and the number.
fn delay(name: &str) -> Option<(&str, usize)> {
    let (base, last) = name.rsplit_once('_')?;
    let steps = last.strip_prefix(['d', 'r'])?.parse().ok()?;
    (steps > 0).then_some((base, steps))
}

fn undelayed(name: &str) -> &str {
    delay(name).map_or(name, |(base, _)| base)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "entity u is
  port (
    clk : in std_logic;
    x_lo : in std_logic_vector(4 downto 0);  -- s5.0
    x_hi : in std_logic_vector(4 downto 0)
  );
end entity u;

architecture rtl of u is
  constant up_ulp : std_logic := '1';
  signal low : signed(3 downto 0);
  signal high : signed(3 downto 0);
  signal low_d1 : signed(3 downto 0) := (others => '0');
  signal high_d1 : signed(3 downto 0) := (others => '0');
  signal below : std_logic;
  signal least : signed(3 downto 0);
begin
  low <= signed(x_lo(4 downto 1));
  below <= '1' when low < high else '0';
  least <=
    low_d1 when below = '1' else
    -high_d1;

  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      low_d1 <= low;
    end if;
  end process clock_1;
end architecture rtl;
";

    fn changes(target: &str) -> Vec<String> {
        let all = mutants("u", TEXT, 15_000);
        all.iter().filter(|m| m.target == target).map(|m| format!("{} {}: {}", m.line, m.kind, m.change)).collect()
    }

    #[test]
    fn lines_yield_the_mutants_that_their_forms_allow() {
        assert_eq!(changes("up_ulp"), ["10 rounding: ulp dropped"]);
        assert_eq!(changes("low"), ["18 bound: x_lo -> x_hi", "18 constant: (4 downto 1) -> (3 downto 0)"]);
        let below = changes("below");
        for change in ["19 comparison: < -> <=", "19 comparison: < -> >", "19 case: arms swapped"] {
            assert!(below.iter().any(|b| b == change), "{below:?}");
        }
        let least = changes("least");
        for change in [
            "21 case: low_d1 -> -high_d1, the next arm",
            "21 case: = -> /=",
            "21 delay: low_d1 -> low",
            "22 operand: sign dropped",
        ] {
            assert!(least.iter().any(|l| l == change), "{least:?}");
        }
        assert!(changes("low_d1").contains(&"27 delay: a register too many".to_owned()));
    }

    #[test]
    fn a_mutant_differs_in_exactly_one_line() {
        let all = mutants("u", TEXT, 15_000);
        assert!(all.len() > 12);
        for mutant in &all {
            let changed = mutant.apply(TEXT);
            let differ: Vec<usize> = TEXT
                .lines()
                .zip(changed.lines())
                .enumerate()
                .filter(|(_, (a, b))| a != b)
                .map(|(i, _)| i + 1)
                .collect();
            assert_eq!((differ, changed.lines().count()), (vec![mutant.line], TEXT.lines().count()), "{mutant:?}");
        }
        let mut names: Vec<String> = all.iter().map(Mutant::name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all.len(), "names are unique");
    }

    #[test]
    fn a_register_too_many_arrives_one_edge_later() {
        let late = mutants("u", TEXT, 15_000).into_iter().find(|m| m.change == "a register too many").unwrap();
        assert_eq!(late.text.trim(), "low_d1 <= transport low after 15000 ps;");
    }
}
