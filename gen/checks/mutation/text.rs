//! Reads the printed VHDL: the types of names, and of which tokens each statement is made.

use std::collections::HashMap;
use std::ops::Range;

/// What a statement does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// `constant x_table : t := v;`.
    Table,
    /// An assignment outside clocked processes, or what a function returns.
    Value,
    /// An assignment at a clock edge.
    Register,
    /// The value of a register in reset.
    Reset,
    /// `if c then`, `elsif c then`.
    Condition,
    /// An actual of a port map.
    Actual,
}

/// What may be changed.
#[derive(Clone, Debug)]
pub struct Statement<'a> {
    pub role: Role,
    /// What is assigned, with fields and without indices; of a condition the first name assigned under it; of a function
    /// its name; of an actual `instance.port`.
    pub target: String,
    /// The name assigned, if it is assigned as a whole; of an actual the unit.
    pub name: &'a str,
    /// Which of the scopes its names are in.
    pub scope: usize,
    /// The tokens of the expression.
    pub tokens: Range<usize>,
}

/// The type of a port, signal, constant, variable or parameter, its place in the order of declarations, and whether it
/// is an output, which cannot be read.
#[derive(Clone, Copy, Debug)]
pub struct Name<'a> {
    pub ty: &'a str,
    pub order: usize,
    pub out: bool,
}

/// A file, read.
#[derive(Debug)]
pub struct Source<'a> {
    pub text: &'a str,
    /// Where words, numbers, literals and signs are; comments are left out, and what no synthesis tool reads.
    tokens: Vec<Range<usize>>,
    /// Names of the entity at 0, then those of each function of a package.
    pub scopes: Vec<HashMap<&'a str, Name<'a>>>,
    pub statements: Vec<Statement<'a>>,
}

/// Splits a text.
fn tokens(text: &str) -> Vec<Range<usize>> {
    let (mut found, mut at) = (vec![], 0);
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let comment = rest.starts_with("--");
        let length = match first {
            _ if rest.starts_with("-- synthesis translate_off") => {
                rest.find("-- synthesis translate_on").unwrap_or(rest.len())
            }
            _ if comment => rest.find('\n').unwrap_or(rest.len()),
            c if word(c) => rest.find(|c| !word(c)).unwrap_or(rest.len()),
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            '\'' if rest.get(2..).is_some_and(|rest| rest.starts_with('\'')) => 3,
            _ if ["<=", ":=", "=>", "/="].iter().any(|sign| rest.starts_with(sign)) => 2,
            c => c.len_utf8(),
        };
        if !comment && !first.is_whitespace() {
            found.push(at..at + length);
        }
        at += length;
    }
    found
}

impl<'a> Source<'a> {
    /// Reads a file.
    pub fn new(text: &'a str) -> Self {
        let mut source = Self { text, tokens: tokens(text), scopes: vec![HashMap::new()], statements: vec![] };
        source.read();
        source
    }

    /// The text of a token, or nothing beyond the end.
    pub fn word(&self, i: usize) -> &'a str {
        self.tokens.get(i).map_or("", |token| &self.text[token.clone()])
    }

    /// Where some tokens stand in the text.
    pub fn span(&self, tokens: &Range<usize>) -> Range<usize> {
        self.tokens[tokens.start].start..self.tokens[tokens.end - 1].end
    }

    /// Some tokens as they are written.
    pub fn part(&self, tokens: &Range<usize>) -> &'a str {
        if tokens.is_empty() { "" } else { &self.text[self.span(tokens)] }
    }

    /// The first of the given words from a token on that is not in brackets opened there, or the bracket that closes.
    pub fn seek(&self, from: usize, words: &[&str]) -> usize {
        let mut depth = 0;
        let ends = |i: &usize| {
            let (word, at) = (self.word(*i), depth);
            depth += i32::from(word == "(") - i32::from(word == ")");
            at == 0 && (words.contains(&word) || word == ")")
        };
        (from..self.tokens.len()).find(ends).unwrap_or(self.tokens.len())
    }

    /// What stands between the bracket at `open` and the one that closes it, split at `sign`; and the place after it.
    pub fn list(&self, open: usize, sign: &str) -> (Vec<Range<usize>>, usize) {
        let (mut items, mut from) = (vec![], open + 1);
        loop {
            let to = self.seek(from, &[sign]);
            items.push(from..to);
            from = to + 1;
            if self.word(to) != sign {
                return (items, from);
            }
        }
    }

    /// The place after the indices and fields of a name.
    pub fn selected(&self, name: usize) -> usize {
        match self.word(name + 1) {
            "(" => self.selected(self.list(name + 1, ",").1 - 1),
            "." => self.selected(name + 2),
            _ => name + 1,
        }
    }

    /// `a, b : [in|out] type`, the place after it.
    fn declare(&mut self, from: usize) -> usize {
        let colon = self.seek(from, &[":"]);
        let out = self.word(colon + 1) == "out";
        let start = colon + 1 + usize::from(out || self.word(colon + 1) == "in");
        let end = self.seek(start, &[";", ":="]);
        let (ty, scope) = (self.part(&(start..end)), self.scopes.len() - 1);
        for i in (from..colon).step_by(2) {
            let (name, order) = (self.word(i), self.scopes[scope].len());
            self.scopes[scope].insert(name, Name { ty, order, out });
        }
        end
    }

    /// The items of a list of ports or parameters; the place after it.
    fn declare_list(&mut self, open: usize) -> usize {
        let (items, end) = self.list(open, ";");
        for item in items {
            self.declare(item.start);
        }
        end
    }

    fn add(&mut self, role: Role, target: impl Into<String>, name: &'a str, tokens: Range<usize>) -> usize {
        let (end, scope) = (tokens.end, self.scopes.len() - 1);
        self.statements.push(Statement { role, target: target.into(), name, scope, tokens });
        end
    }

    /// All declarations and statements.
    fn read(&mut self) {
        let (mut i, mut label, mut function, mut clocked, mut reset) = (0, "", "", false, false);
        while i < self.tokens.len() {
            let (word, next) = (self.word(i), self.word(i + 1));
            let end = self.seek(i, &[";"]);
            i = match word {
                "end" => {
                    (clocked, reset) = (clocked && next != "process", reset && next != "if");
                    end
                }
                "signal" | "variable" | "constant" => {
                    let value = self.declare(i + 1) + 1;
                    if next.ends_with("_table") { self.add(Role::Table, next, "", value..end) } else { end }
                }
                "function" => {
                    function = next;
                    self.scopes.push(HashMap::new());
                    // A type follows the word `return`, no value.
                    self.declare_list(i + 2) + 2
                }
                "port" if next == "(" => self.declare_list(i + 1),
                "port" => {
                    let unit = self.word(i - 1);
                    let (actuals, end) = self.list(i + 2, ",");
                    for actual in actuals {
                        let target = format!("{label}.{}", self.word(actual.start));
                        self.add(Role::Actual, target, unit, actual.start + 2..actual.end);
                    }
                    end
                }
                "for" => self.seek(i, &["generate", "loop"]) + 1,
                "if" | "elsif" if next != "rising_edge" => {
                    reset = next == "reset";
                    let then = self.seek(i, &["then"]);
                    let inner = if self.word(then + 1) == "for" { self.seek(then, &["loop"]) } else { then };
                    let target = if function.is_empty() { self.word(inner + 1) } else { function };
                    self.add(Role::Condition, target, "", i + 1..then)
                }
                "return" => self.add(Role::Value, function, "", i + 1..end),
                "process" | "else" => {
                    (clocked, reset) = (clocked || word == "process", false);
                    i + 1
                }
                _ if next == ":" => {
                    label = if word == "unit" { label } else { word };
                    i + 2
                }
                _ if self.scopes[self.scopes.len() - 1].contains_key(word) => {
                    let sign = self.selected(i);
                    if !matches!(self.word(sign), "<=" | ":=") {
                        i += 1;
                        continue;
                    }
                    let role = [[Role::Value, Role::Register], [Role::Value, Role::Reset]][usize::from(reset)];
                    let dot = (i..sign).find(|k| self.word(*k) == ".");
                    let field = dot.map_or(String::new(), |dot| format!(".{}", self.word(dot + 1)));
                    let target = if function.is_empty() { format!("{word}{field}") } else { function.to_owned() };
                    let whole = if sign == i + 1 { word } else { "" };
                    self.add(role[usize::from(clocked)], target, whole, sign + 1..end)
                }
                _ => i + 1,
            };
        }
    }
}
