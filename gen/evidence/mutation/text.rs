//! Reads the printed VHDL: the types of names, and of which tokens each statement is made.

use std::collections::HashMap;
use std::ops::Range;

/// A word, number, literal or sign, and where it begins.
#[derive(Clone, Copy, Debug)]
pub struct Token<'a> {
    /// What is written.
    pub text: &'a str,
    /// Where.
    pub at: usize,
}

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
    /// What it does.
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

/// A port, signal, constant, variable or parameter.
#[derive(Clone, Copy, Debug)]
pub struct Name<'a> {
    /// Its type as it is written.
    pub ty: &'a str,
    /// Place in the order of declarations.
    pub order: usize,
    /// An output, which cannot be read.
    pub out: bool,
}

/// A file, read.
#[derive(Debug)]
pub struct Source<'a> {
    /// The whole text.
    pub text: &'a str,
    /// All of it but comments.
    pub tokens: Vec<Token<'a>>,
    /// Names of the entity at 0, then those of each function of a package.
    pub scopes: Vec<HashMap<&'a str, Name<'a>>>,
    /// All that may be changed.
    pub statements: Vec<Statement<'a>>,
}

/// Splits a text.
fn tokens(text: &str) -> Vec<Token<'_>> {
    let (mut found, mut at) = (vec![], 0);
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let comment = rest.starts_with("--");
        let length = match first {
            _ if comment => rest.find('\n').unwrap_or(rest.len()),
            c if word(c) => rest.find(|c| !word(c)).unwrap_or(rest.len()),
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            '\'' if rest.get(2..).is_some_and(|rest| rest.starts_with('\'')) => 3,
            _ if ["<=", ":=", "=>", "/="].iter().any(|sign| rest.starts_with(sign)) => 2,
            c => c.len_utf8(),
        };
        if !comment && !first.is_whitespace() {
            found.push(Token { text: &rest[..length], at });
        }
        at += length;
    }
    found
}

impl<'a> Source<'a> {
    /// Reads a file.
    pub fn new(text: &'a str) -> Self {
        let (tokens, scopes) = (tokens(text), vec![HashMap::new()]);
        let mut source = Self { text, tokens, scopes, statements: vec![] };
        source.read();
        source
    }

    /// The text of a token, or nothing beyond the end.
    pub fn word(&self, i: usize) -> &'a str {
        self.tokens.get(i).map_or("", |token| token.text)
    }

    /// Where some tokens stand in the text.
    pub fn span(&self, tokens: &Range<usize>) -> Range<usize> {
        let last = self.tokens[tokens.end - 1];
        self.tokens[tokens.start].at..last.at + last.text.len()
    }

    /// Some tokens as they are written.
    pub fn part(&self, tokens: &Range<usize>) -> &'a str {
        if tokens.is_empty() { "" } else { &self.text[self.span(tokens)] }
    }

    /// The first of the given words from a token on that is not in brackets opened there, or the bracket that closes.
    pub fn seek(&self, from: usize, words: &[&str]) -> usize {
        let mut depth = 0;
        for i in from..self.tokens.len() {
            let word = self.word(i);
            if depth == 0 && (words.contains(&word) || word == ")") {
                return i;
            }
            depth += i32::from(word == "(") - i32::from(word == ")");
        }
        self.tokens.len()
    }

    /// What stands between the bracket at `open` and the one that closes it, split at `sign`; and the place after it.
    pub fn list(&self, open: usize, sign: &str) -> (Vec<Range<usize>>, usize) {
        let (mut items, mut from) = (vec![], open + 1);
        loop {
            let to = self.seek(from, &[sign]);
            items.push(from..to);
            if self.word(to) != sign {
                return (items, to + 1);
            }
            from = to + 1;
        }
    }

    /// The place after the indices and fields of a name.
    pub fn selected(&self, name: usize) -> usize {
        let mut i = name + 1;
        loop {
            i = match self.word(i) {
                "(" => self.list(i, ",").1,
                "." => i + 2,
                _ => return i,
            };
        }
    }

    /// `a, b : [in|out] type [:= value]`; the place after the type.
    fn declare(&mut self, from: usize) -> usize {
        let colon = self.seek(from, &[":"]);
        let out = self.word(colon + 1) == "out";
        let start = colon + 1 + usize::from(out || self.word(colon + 1) == "in");
        let end = self.seek(start, &[";", ":="]);
        let ty = self.part(&(start..end));
        for i in (from..colon).step_by(2) {
            let scope = self.scopes.last_mut().expect("the entity's is the first");
            let order = scope.len();
            scope.insert(self.tokens[i].text, Name { ty, order, out });
        }
        end
    }

    /// All declarations and statements.
    fn read(&mut self) {
        let (mut i, mut label, mut unit, mut function) = (0, "", "", "");
        let (mut clocked, mut reset) = (false, false);
        while i < self.tokens.len() {
            let add = |source: &mut Self, role, target: String, name, tokens| {
                let scope = source.scopes.len() - 1;
                source.statements.push(Statement { role, target, name, scope, tokens });
            };
            i = match (self.word(i), self.word(i + 1)) {
                ("end", what) => {
                    clocked &= what != "process";
                    reset &= what != "if";
                    self.seek(i, &[";"])
                }
                ("signal" | "variable" | "constant", name) => {
                    let from = self.declare(i + 1);
                    let end = self.seek(from, &[";"]);
                    if name.ends_with("_table") {
                        add(self, Role::Table, name.to_owned(), "", from + 1..end);
                    }
                    end
                }
                ("function", name) => {
                    function = name;
                    self.scopes.push(HashMap::new());
                    let (parameters, end) = self.list(i + 2, ";");
                    parameters.iter().for_each(|parameter| {
                        self.declare(parameter.start);
                    });
                    // `return type is`
                    end + 2
                }
                ("port", "(") => {
                    let (ports, end) = self.list(i + 1, ";");
                    ports.iter().for_each(|port| {
                        self.declare(port.start);
                    });
                    end
                }
                ("entity", "work") => {
                    unit = self.word(i + 3);
                    i + 4
                }
                ("port", "map") => {
                    let (actuals, end) = self.list(i + 2, ",");
                    for actual in actuals {
                        let target = format!("{label}.{}", self.word(actual.start));
                        add(self, Role::Actual, target, unit, actual.start + 2..actual.end);
                    }
                    end
                }
                ("for", _) => self.seek(i, &["generate", "loop"]) + 1,
                ("process", _) => {
                    clocked = true;
                    i + 1
                }
                ("if" | "elsif", first) => {
                    let end = self.seek(i, &["then"]);
                    if first != "rising_edge" {
                        reset = first == "reset";
                        let mut next = end + 1;
                        if self.word(next) == "for" {
                            next = self.seek(next, &["loop"]) + 1;
                        }
                        let target = if function.is_empty() { self.word(next) } else { function };
                        add(self, Role::Condition, target.to_owned(), "", i + 1..end);
                    }
                    end
                }
                ("else", _) => {
                    reset = false;
                    i + 1
                }
                ("return", _) => {
                    let end = self.seek(i, &[";"]);
                    add(self, Role::Value, function.to_owned(), "", i + 1..end);
                    end
                }
                (name, ":") => {
                    if name != "unit" {
                        label = name;
                    }
                    i + 2
                }
                (name, _) => match self.scopes.last().and_then(|scope| scope.get(name)).copied() {
                    Some(_) if matches!(self.word(self.selected(i)), "<=" | ":=") => {
                        let sign = self.selected(i);
                        let end = self.seek(sign, &[";"]);
                        let role = match (clocked, reset) {
                            (false, _) => Role::Value,
                            (true, false) => Role::Register,
                            (true, true) => Role::Reset,
                        };
                        let dot = (i + 1..sign).find(|k| self.word(*k) == ".");
                        let field = dot.map_or(String::new(), |dot| format!(".{}", self.word(dot + 1)));
                        let target = if function.is_empty() { format!("{name}{field}") } else { function.to_owned() };
                        add(self, role, target, if sign == i + 1 { name } else { "" }, sign + 1..end);
                        end
                    }
                    _ => i + 1,
                },
            };
        }
    }
}
