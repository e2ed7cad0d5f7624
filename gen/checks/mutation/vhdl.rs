//! Mutants of the generated VHDL: every change that the forms of its statements allow, in the order of the text.

use super::text::{Name, Role, Source, Statement};
use super::{Kind, Mutant};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// All mutants of the files of a design. `late` is one and a half periods of the clock, in picoseconds.
pub fn mutants(files: &[(String, String)], late: u32) -> Vec<Mutant> {
    let unit = |name: &str| name.trim_end_matches(".vhd").to_owned();
    let sources: Vec<(String, Source)> = files.iter().map(|(name, text)| (unit(name), Source::new(text))).collect();
    let mut all = vec![];
    for (unit, source) in &sources {
        let (mut places, mut seen) = (HashMap::<String, usize>::new(), HashSet::from([source.text.to_owned()]));
        for (number, statement) in source.statements.iter().enumerate() {
            let mut editor = Editor { sources: &sources, unit, source, statement, found: vec![] };
            editor.statement(number, late);
            editor.expression();
            editor.found.sort_by_key(|mutant| mutant.kind);
            editor.found.retain(|mutant| seen.insert(mutant.apply(source.text)));
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
    }
    all
}

/// What an operand ends at; at the last two only one of a sign that binds closer.
const ENDS: [&str; 8] = [",", "when", "else", "&", "=", ";", "and", "or"];

/// Finds the changes of one statement.
struct Editor<'a> {
    sources: &'a [(String, Source<'a>)],
    unit: &'a str,
    source: &'a Source<'a>,
    statement: &'a Statement<'a>,
    found: Vec<Mutant>,
}

impl<'a> Editor<'a> {
    /// A mutant with some tokens replaced.
    fn replace(&mut self, kind: Kind, tokens: Range<usize>, new: impl Into<String>, change: impl AsRef<str>) {
        let place = self.source.span(&tokens);
        self.found.push(Mutant {
            unit: self.unit.to_owned(),
            line: self.source.text[..place.start].matches('\n').count() + 1,
            target: self.statement.target.clone(),
            kind,
            change: change.as_ref().split_whitespace().collect::<Vec<_>>().join(" "),
            place,
            new: new.into(),
        });
    }

    /// The same, described by what is replaced and what it is replaced with.
    fn exchange(&mut self, kind: Kind, tokens: Range<usize>, new: &str) {
        let old = self.source.part(&tokens);
        self.replace(kind, tokens, new, format!("{old} -> {new}"));
    }

    fn word(&self, i: usize) -> &'a str {
        self.source.word(i)
    }

    fn known(&self, name: &str) -> Option<Name<'a>> {
        self.source.scopes[self.statement.scope].get(name).copied()
    }

    /// Changes of the statement as a whole.
    fn statement(&mut self, number: usize, late: u32) {
        let (source, whole) = (self.source, self.statement.tokens.clone());
        let part = source.part(&whole);
        match self.statement.role {
            Role::Register => {
                self.replace(Kind::Delay, whole, format!("transport {part} after {late} ps"), "a register too many");
            }
            Role::Condition if self.statement.scope == 0 => {
                self.replace(Kind::Case, whole, "true", format!("without the condition {part}"));
            }
            Role::Actual => {
                let port = self.port(self.statement);
                let mut others = source.statements[number + 1..].iter().take_while(|s| s.role == Role::Actual);
                let same = |other: &&Statement| {
                    let port_is_same = other.name == self.statement.name && self.port(other) == port;
                    port_is_same && source.part(&other.tokens) != part
                };
                if let Some(other) = others.find(same).filter(|_| port.is_some()) {
                    let second = source.part(&other.tokens);
                    let between = &source.text[source.span(&whole).end..source.span(&other.tokens).start];
                    let new = format!("{second}{between}{part}");
                    self.replace(Kind::Operand, whole.start..other.tokens.end, new, format!("{part} and {second}"));
                }
            }
            _ => {}
        }
        if self.statement.target.contains("inexact") || self.statement.target.ends_with("sticky") {
            self.replace(Kind::Rounding, self.statement.tokens.clone(), "'0'", "sticky bit dropped");
            self.replace(Kind::Rounding, self.statement.tokens.clone(), "'1'", "sticky bit forced");
        }
    }

    /// Type and direction of the port that an actual belongs to.
    fn port(&self, actual: &Statement) -> Option<(&'a str, bool)> {
        let (_, unit) = self.sources.iter().find(|(unit, _)| unit == actual.name)?;
        let formal = actual.target.rsplit('.').next()?;
        unit.scopes[0].get(formal).filter(|_| formal != "clk").map(|name| (name.ty, name.out))
    }

    /// Changes of single words and of what belongs to them.
    fn expression(&mut self) {
        let Range { start, end } = self.statement.tokens;
        let reads = self.statement.role != Role::Actual || self.port(self.statement).is_some_and(|(_, out)| !out);
        let mut i = start;
        while i < end {
            let (word, before) = (self.word(i), if i > start { self.word(i - 1) } else { "" });
            match word {
                "not" => self.replace(Kind::Case, i..i + 1, "", format!("not {} -> without not", self.word(i + 1))),
                "and" | "or" => {
                    // In brackets: `a and b or c` is no VHDL.
                    let (left, right) = self.operands(i, &ENDS[..6]);
                    let [a, b] = [&left, &right].map(|side| self.source.part(side));
                    let other = if word == "and" { "or" } else { "and" };
                    let change = format!("{word} -> {other}");
                    self.replace(Kind::Case, left.start..right.end, format!("(({a}) {other} ({b}))"), change);
                }
                "xor" => self.exchange(Kind::Operand, i..i + 1, "or"),
                "-" if matches!(before, "" | "(" | ",") => self.replace(Kind::Operand, i..i + 1, "", "sign dropped"),
                "+" | "-" => self.sum(i),
                "&" if !is_delayed(&self.statement.target) => self.swap(i),
                "=" if !self.word(i + 1).starts_with('\'') => self.exchange(Kind::Comparison, i..i + 1, "/="),
                "'0'" | "'1'" => {
                    let kind = if before == "=" { Kind::Case } else { Kind::Constant };
                    self.exchange(kind, i..i + 1, if word == "'0'" { "'1'" } else { "'0'" });
                }
                "when" => self.arm(i),
                _ if self.word(i + 1) == "(" && self.known(word).is_none() => self.call(i),
                _ if word.starts_with('"') || self.statement.role == Role::Table => self.entry(i),
                _ if word.parse::<u64>().is_ok() => {
                    if before == "=" || (matches!(before, "+" | "-") && word != "1") {
                        self.next(i);
                    }
                }
                _ if !reads || before == "." || self.word(i + 1) == "'" || self.known(word).is_none() => {}
                _ => {
                    self.name(i);
                    i = self.selectors(i);
                    continue;
                }
            }
            i += 1;
        }
    }

    /// The operands of a sign: what stands on either side of it.
    fn operands(&self, sign: usize, ends: &[&str]) -> (Range<usize>, Range<usize>) {
        let (mut from, mut depth) = (sign, 0);
        while from > self.statement.tokens.start {
            let word = self.word(from - 1);
            depth += i32::from(word == ")") - i32::from(word == "(");
            if depth < 0 || (depth == 0 && ends.contains(&word)) {
                break;
            }
            from -= 1;
        }
        let to = self.source.seek(sign + 1, ends).min(self.statement.tokens.end);
        (from..sign, sign + 1..to)
    }

    /// The operands of a sign in the other order.
    fn swap(&mut self, sign: usize) {
        let (left, right) = self.operands(sign, &ENDS);
        let [a, b] = [&left, &right].map(|side| self.source.part(side));
        let new = format!("{b} {} {a}", self.word(sign));
        self.replace(Kind::Operand, left.start..right.end, new, format!("{a} and {b} exchanged"));
    }

    /// A sum or difference; an addend of one unit or of a flag rounds up.
    fn sum(&mut self, sign: usize) {
        let (left, right) = self.operands(sign, &ENDS);
        let addend = self.source.part(&right);
        // A counter goes on by one; what rounds is added to something else.
        let counts = !self.statement.name.is_empty() && self.source.part(&left).contains(self.statement.name);
        let flag = addend.starts_with("to_signed(") && self.word(right.start + 2).parse::<u64>().is_err();
        if addend == "1" && !counts {
            self.replace(Kind::Rounding, sign..right.end, "", "ulp dropped");
            self.replace(Kind::Rounding, right, "2", "an ulp too many");
        } else if flag {
            self.replace(Kind::Rounding, sign..right.end, "", "ulp dropped");
            let (arguments, _) = self.source.list(right.start + 1, ",");
            self.replace(Kind::Rounding, arguments[0].clone(), "'1'", "ulp forced");
        } else {
            self.exchange(Kind::Operand, sign..sign + 1, if self.word(sign) == "+" { "-" } else { "+" });
            if self.word(sign) == "-" {
                self.swap(sign);
            }
        }
    }

    /// The value of an arm never taken.
    fn arm(&mut self, when: usize) {
        let (value, _) = self.operands(when, &ENDS);
        let next = self.source.seek(when, &["else"]) + 1;
        let next = next..self.source.seek(next, &["when", ";"]).min(self.statement.tokens.end);
        let [old, new] = [&value, &next].map(|arm| self.source.part(arm));
        self.replace(Kind::Case, value, new, format!("{old} -> {new}, the next arm"));
    }

    /// The functions of the package.
    fn call(&mut self, name: usize) {
        let (arguments, end) = self.source.list(name + 1, ",");
        let parts: Vec<&str> = arguments.iter().map(|argument| self.source.part(argument)).collect();
        match (self.word(name), parts.as_slice()) {
            ("less", [a, b]) => {
                self.replace(Kind::Comparison, name..end, format!("less({b}, {a})"), format!("{a} < {b} -> >"));
                self.replace(Kind::Comparison, name..end, format!("(not less({b}, {a}))"), format!("{a} < {b} -> <="));
            }
            ("choose", [flag, a, b]) => {
                let new = format!("choose({flag}, {b}, {a})");
                self.replace(Kind::Case, name..end, new, format!("{a} and {b} exchanged"));
                self.replace(Kind::Case, arguments[1].clone(), *b, format!("{a} -> {b}, always"));
            }
            ("negated_if", [flag, x]) => self.replace(Kind::Case, name..end, *x, format!("{flag} never negates")),
            ("abs_of", [x]) => {
                self.replace(Kind::Operand, name..end, format!("unsigned({x})"), "magnitude without abs")
            }
            ("to_signed" | "to_unsigned", [_, _]) => self.next(arguments[0].end - 1),
            ("shift_left", [_, _]) => self.next(arguments[1].start),
            _ => {}
        }
    }

    /// One more than a number, if it is one.
    fn next(&mut self, i: usize) {
        if let Ok(number) = self.word(i).parse::<u64>() {
            self.exchange(Kind::Constant, i..i + 1, &(number + 1).to_string());
        }
    }

    /// Bits of a table one by one; a number becomes the next greater of the table, the greatest the least.
    fn entry(&mut self, i: usize) {
        let (word, inside) = (self.word(i), self.statement.tokens.start + 1..self.statement.tokens.end - 1);
        // What stands behind the entries is never read.
        if matches!(self.word(i - 1), "&" | "=>") {
            return;
        }
        if let Some(bits) = word.strip_prefix('"') {
            for (place, bit) in bits.trim_end_matches('"').char_indices() {
                let other = if bit == '0' { '1' } else { '0' };
                let new = format!("{}{other}{}", &word[..=place], &word[place + 2..]);
                self.replace(Kind::Constant, i..i + 1, new, format!("entry {place}: {bit} -> {other}"));
            }
        } else if let Ok(number) = word.parse::<u64>() {
            let entries = || inside.clone().step_by(2).filter_map(|k| self.word(k).parse::<u64>().ok());
            let next = entries().filter(|entry| *entry > number).min().or(entries().min()).unwrap_or_default();
            let place = (i - inside.start) / 2;
            self.replace(Kind::Constant, i..i + 1, next.to_string(), format!("entry {place}: {number} -> {next}"));
        }
    }

    /// Other names in place of one: the other bound, a neighbour, what its register takes its value from.
    fn name(&mut self, i: usize) {
        let name = self.word(i);
        let bound = self.other_bound(name);
        if let Some(other) = bound {
            self.exchange(Kind::Bound, i..i + 1, other);
        }
        if let Some(other) = self.neighbour(name, bound) {
            self.exchange(Kind::Operand, i..i + 1, other);
        }
        let taken = |s: &&Statement| s.role == Role::Register && s.name == name && s.scope == self.statement.scope;
        if let Some(register) = self.source.statements.iter().find(taken) {
            let from = register.tokens.clone();
            if self.known(self.word(from.start)).is_some() && self.source.selected(from.start) == from.end {
                self.exchange(Kind::Delay, i..i + 1, self.source.part(&from));
            }
        }
    }

    /// The upper bound that belongs to a lower one, or the reverse.
    fn other_bound(&self, name: &str) -> Option<&'a str> {
        let flip = |word| {
            if word == "lo" {
                "hi"
            } else if word == "hi" {
                "lo"
            } else {
                word
            }
        };
        let other = name.split('_').map(flip).collect::<Vec<_>>().join("_");
        let scope = &self.source.scopes[self.statement.scope];
        let (other, known) = scope.get_key_value(other.as_str())?;
        let fits = *other != name && known.ty == self.known(name)?.ty && *other != self.statement.name;
        fits.then_some(other)
    }

    /// The name of the same type that is declared last before this one, or else first after it.
    fn neighbour(&self, name: &str, bound: Option<&str>) -> Option<&'a str> {
        let Name { ty, order, .. } = self.known(name)?;
        let assigned = self.statement.target.split('.').next();
        let fits = |(other, n): &(&&'a str, &Name)| {
            let near = [Some(name), bound, assigned].contains(&Some(**other));
            n.ty == ty && !n.out && !near && undelayed(other) != undelayed(name) && **other != "clk"
        };
        let others = || self.source.scopes[self.statement.scope].iter().filter(fits);
        let before = others().filter(|(_, n)| n.order < order).max_by_key(|(_, n)| n.order);
        before.or_else(|| others().min_by_key(|(_, n)| n.order)).map(|(other, _)| *other)
    }

    /// Fields and indices of a name: the other bound, another component, bits one off. The next word to look at.
    fn selectors(&mut self, name: usize) -> usize {
        let mut i = name + 1;
        loop {
            match self.word(i) {
                "." => {
                    let other = if self.word(i + 1) == "lo" { "hi" } else { "lo" };
                    if matches!(self.word(i + 1), "lo" | "hi") {
                        let old = self.source.part(&(name..i + 2));
                        self.replace(Kind::Bound, i + 1..i + 2, other, format!("{old} -> .{other}"));
                    }
                    i += 2;
                }
                "(" => {
                    let (inside, end) = self.source.list(i, ",");
                    if inside[0].clone().any(|k| self.known(self.word(k)).is_some()) {
                        // The index is a signal: it has names of its own.
                        return i;
                    }
                    let words: Vec<&str> = inside[0].clone().map(|k| self.word(k)).collect();
                    if let Some(new) = moved(&words) {
                        let kind = if is_delayed(self.word(name)) { Kind::Delay } else { Kind::Constant };
                        let old = self.source.part(&(name..end));
                        self.replace(kind, inside[0].clone(), &new, format!("{old} -> ({new})"));
                    }
                    i = end;
                }
                _ => return i,
            }
        }
    }
}

/// An index or slice beside the one that is written.
fn moved(index: &[&str]) -> Option<String> {
    let number = |word: &str| word.parse::<u32>().ok();
    Some(match index {
        [n] => number(n).map_or(0, |n| n.checked_sub(1).unwrap_or(1)).to_string(),
        [h, "downto", l] => match (number(h)?, number(l)?) {
            (h, 0) => format!("{} downto 1", h + 1),
            (h, l) => format!("{} downto {}", h - 1, l - 1),
        },
        [v, "+", n] => format!("{v} + {}", number(n)? - 1),
        ["(", v, "+", n, ")", "mod", m] => format!("({v} + {}) mod {m}", number(n)? - 1),
        _ => return None,
    })
}

/// Whether a name is that of a row of copies, each later than the one before.
fn is_delayed(name: &str) -> bool {
    name.ends_with("_line") || of_held(name).is_some()
}

/// The name without `_held` or `_held_2` and the like, if it has that.
fn of_held(name: &str) -> Option<&str> {
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name.strip_suffix("_held").or_else(|| digits.strip_suffix("_held_"))
}

/// The name without `_d1`, `_h11`, `_held` and the like.
fn undelayed(name: &str) -> &str {
    let digits = name.trim_end_matches(|c: char| c.is_ascii_digit());
    match digits.strip_suffix("_d").or_else(|| digits.strip_suffix("_h")) {
        Some(base) if digits != name => base,
        _ => of_held(name).unwrap_or(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PACKAGE: &str = "package body p_types is
  function less(x, y : signed) return std_logic is
  begin
    return flag(x < y);
  end function less;
end package body p_types;
";
    const TEXT: &str = "entity u is
  port (
    clk : in  std_logic;
    x   : in  interval_4_t;  -- s3.0; \"no\" literal
    y   : in  interval_4_t;
    z   : out interval_4_t
  );
end entity u;

architecture rtl of u is
  constant turn_table : numbers_t(0 to 2) := (0, 3, 5);
  signal low : signed(3 downto 0);
  signal low_d1 : signed(3 downto 0) := (others => '0');
  signal word_line : std_logic_vector(1 to 3) := (others => '0');
begin
  low <= x.lo(3 downto 0) - 1 when less(x.hi, y.lo) = '1' else
      choose(word_line(3), y.lo, to_signed(-7, 4));
  part : for i in 0 to 2 generate
    unit : entity work.u
      port map (clk => clk, x => x,
                y => y, z => z);
  end generate part;

  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      if word_line(2) = '1' then
        low_d1 <= low;
      end if;
    end if;
  end process clock_1;
  z.hi <= resize(low_d1, 5) + 1;
end architecture rtl;
";

    fn files() -> Vec<(String, String)> {
        [("p_types", PACKAGE), ("u", TEXT)].map(|(name, text)| (format!("{name}.vhd"), text.to_owned())).to_vec()
    }

    #[test]
    fn statements_yield_the_mutants_that_their_forms_allow() {
        let all: Vec<String> = mutants(&files(), 15_000).iter().map(|m| format!("{} {}", m.line, m.name())).collect();
        for expected in [
            "4 p_types:less:operand:x -> y",
            "11 u:turn_table:constant:entry 2: 5 -> 0",
            "16 u:low:bound:x.lo -> .hi",
            "16 u:low:rounding:ulp dropped",
            "16 u:low:comparison:x.hi < y.lo -> <=",
            "16 u:low:case:'1' -> '0'",
            "17 u:low:case:y.lo and to_signed(-7, 4) exchanged",
            "17 u:low:constant:7 -> 8",
            "17 u:low:delay:word_line(3) -> (2)",
            "20 u:part.x:operand:x and y",
            "27 u:low_d1:case:without the condition word_line(2) = '1'",
            "28 u:low_d1:delay:a register too many",
            "32 u:z.hi:delay:low_d1 -> low",
        ] {
            assert!(all.iter().any(|found| found == expected), "no {expected} in {all:#?}");
        }
    }

    #[test]
    fn mutants_change_what_they_say() {
        let changed = |change: &str| {
            let all = mutants(&files(), 15_000);
            all.iter().find(|mutant| mutant.change == change).unwrap().apply(TEXT)
        };
        let late = TEXT.replace("low_d1 <= low;", "low_d1 <= transport low after 15000 ps;");
        assert_eq!(changed("a register too many"), late);
        assert_eq!(changed("x.hi < y.lo -> <="), TEXT.replace("less(x.hi, y.lo)", "(not less(y.lo, x.hi))"));
        let swapped = "x => y,\n                y => x,";
        assert_eq!(changed("x and y"), TEXT.replace("x => x,\n                y => y,", swapped));
    }
}
