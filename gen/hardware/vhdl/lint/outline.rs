//! The outline of a VHDL file: ports, declarations, and who assigns what where.

use super::token::{Kind, Token, tokens};

/// Tokens in a row.
pub(super) type Part = std::ops::Range<usize>;

/// A port.
#[derive(Debug)]
pub(super) struct Port<'a> {
    pub name: &'a str,
    pub mode: &'a str,
    pub ty: Part,
    pub line: usize,
}

/// A declaration of the architecture.
#[derive(Debug)]
pub(super) struct Declaration<'a> {
    /// `signal`, `constant`, `type`, ...
    pub class: &'a str,
    pub name: &'a str,
    pub initial: Option<Part>,
    pub line: usize,
}

/// A signal assignment.
#[derive(Debug)]
pub(super) struct Assignment<'a> {
    pub target: &'a str,
    /// The whole target, with its index.
    pub whole: Part,
    pub value: Part,
    pub line: usize,
    /// The process it stands in; none for a concurrent one.
    pub process: Option<usize>,
    /// Whether it stands under a condition that names a reset.
    pub reset: bool,
}

/// A process.
#[derive(Debug)]
pub(super) struct Process<'a> {
    pub label: Option<&'a str>,
    pub sensitivity: Part,
    /// Statements between `begin` and `end process`.
    pub body: Part,
    pub line: usize,
}

/// An instance.
#[derive(Debug)]
pub(super) struct Instance<'a> {
    pub label: Option<&'a str>,
    /// What is instantiated, as it is written.
    pub unit: Part,
    /// Formal, where it is named, and actual.
    pub map: Vec<(Option<&'a str>, Part)>,
    pub line: usize,
}

/// The outline of a file with one entity and one architecture.
#[derive(Debug, Default)]
pub(super) struct Outline<'a> {
    pub source: &'a str,
    pub tokens: Vec<Token<'a>>,
    pub entity: &'a str,
    pub ports: Vec<Port<'a>>,
    pub declarations: Vec<Declaration<'a>>,
    pub assignments: Vec<Assignment<'a>>,
    pub processes: Vec<Process<'a>>,
    pub instances: Vec<Instance<'a>>,
    /// Where the architecture begins.
    pub architecture: usize,
}

impl<'a> Outline<'a> {
    /// Reads a file. What is no VHDL is read as well as may be; an analyser will say so.
    pub fn new(text: &'a str) -> Self {
        let mut outline = Self { source: text, tokens: tokens(text), ..Self::default() };
        let all = outline.tokens.len();
        let entity = outline.find(0..all, &["entity"]);
        outline.entity = outline.text(entity + 1);
        outline.architecture = outline.find(entity..all, &["architecture"]);
        outline.read_ports(entity..outline.architecture);
        let begin = outline.read_declarations(outline.architecture);
        outline.read_statements(begin + 1..all);
        outline
    }

    /// The tokens of a part.
    pub fn part(&self, part: &Part) -> &[Token<'a>] {
        let end = part.end.min(self.tokens.len());
        &self.tokens[part.start.min(end)..end]
    }

    /// A part as text, for messages.
    pub fn words(&self, part: &Part) -> String {
        self.part(part).iter().map(|t| t.text).collect::<Vec<_>>().join(" ")
    }

    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |t| t.text)
    }

    fn line(&self, at: usize) -> usize {
        self.tokens.get(at).map_or(0, |t| t.line)
    }

    fn is(&self, at: usize, text: &str) -> bool {
        self.tokens.get(at).is_some_and(|t| t.is(text))
    }

    /// The first of some words in a part, outside parentheses opened in it; the part's end if there is none.
    pub fn find(&self, part: Part, words: &[&str]) -> usize {
        let mut depth = 0i32;
        for at in part.start..part.end.min(self.tokens.len()) {
            let token = &self.tokens[at];
            if depth <= 0 && token.any(words) {
                return at;
            }
            depth += i32::from(token.is("(")) - i32::from(token.is(")"));
        }
        part.end
    }

    /// The parenthesis that closes the one at `open`.
    fn closing(&self, open: usize, end: usize) -> usize {
        self.find(open + 1..end, &[")"])
    }

    /// The parts between separators.
    fn split(&self, part: Part, separator: &str) -> Vec<Part> {
        let mut parts = vec![];
        let mut from = part.start;
        while from < part.end {
            let to = self.find(from..part.end, &[separator]);
            parts.push(from..to);
            from = to + 1;
        }
        parts
    }

    fn read_ports(&mut self, part: Part) {
        let port = self.find(part.clone(), &["port"]);
        if port + 1 >= part.end {
            return;
        }
        let end = self.closing(port + 1, part.end);
        for one in self.split(port + 2..end, ";") {
            let colon = self.find(one.clone(), &[":"]);
            let mode = self.text(colon + 1);
            let line = self.line(one.start);
            for name in one.start..colon {
                if self.tokens[name].kind != Kind::Symbol && !self.tokens[name].is("signal") {
                    self.ports.push(Port { name: self.tokens[name].text, mode, ty: colon + 2..one.end, line });
                }
            }
        }
    }

    /// Reads the declarations of the architecture at `from`; where its `begin` stands.
    fn read_declarations(&mut self, from: usize) -> usize {
        let all = self.tokens.len();
        let mut at = self.find(from..all, &["is"]) + 1;
        while at < all && !self.is(at, "begin") {
            let end = self.find(at..all, &[";"]);
            let value = self.find(at..end, &[":="]);
            let initial = (value < end).then_some(value + 1..end);
            let (class, line) = (self.text(at), self.line(at));
            let mut names = self.find(at + 1..end, &[":", "is"]);
            // `attribute keep of x : signal is ...` declares nothing.
            if self.is(at, "attribute") && self.is(at + 2, "of") {
                names = at;
            }
            for name in (at + 1).min(names)..names {
                if self.tokens[name].kind != Kind::Symbol && !self.is(name, "variable") {
                    let name = self.tokens[name].text;
                    self.declarations.push(Declaration { class, name, initial: initial.clone(), line });
                }
            }
            at = end + 1;
        }
        at
    }

    fn read_statements(&mut self, part: Part) {
        let mut at = part.start;
        while at < part.end {
            let label = self.is(at + 1, ":").then(|| self.text(at));
            let start = if label.is_some() { at + 2 } else { at };
            let end = self.find(start..part.end, &[";"]);
            if self.is(start, "process") || (self.is(start, "postponed") && self.is(start + 1, "process")) {
                let close = self.closing_process(start, part.end);
                self.read_process(label, start..close);
                at = self.find(close..part.end, &[";"]) + 1;
            } else if self.find(start..end, &["generate"]) < end {
                // What is generated is read as if it stood there once.
                at = if self.is(start, "end") { end } else { self.find(start..end, &["generate"]) } + 1;
            } else {
                self.read_concurrent(label, start..end);
                at = end + 1;
            }
        }
    }

    fn closing_process(&self, from: usize, end: usize) -> usize {
        (from..end).find(|at| self.is(*at, "end") && (*at + 1..*at + 3).any(|i| self.is(i, "process"))).unwrap_or(end)
    }

    fn read_concurrent(&mut self, label: Option<&'a str>, part: Part) {
        let map = self.find(part.clone(), &["port", "generic"]);
        if map < part.end {
            self.read_instance(label, part, map);
            return;
        }
        let start = if self.is(part.start, "with") { self.find(part.clone(), &["select"]) + 1 } else { part.start };
        let arrow = self.find(start..part.end, &["<="]);
        if arrow < part.end {
            self.assign(start..arrow, arrow + 1..part.end, None, false);
        }
    }

    fn assign(&mut self, whole: Part, value: Part, process: Option<usize>, reset: bool) {
        let (target, line) = (self.text(whole.start), self.line(whole.start));
        self.assignments.push(Assignment { target, whole, value, line, process, reset });
    }

    fn read_instance(&mut self, label: Option<&'a str>, part: Part, map: usize) {
        let mut entries = vec![];
        let port = self.find(part.clone(), &["port"]);
        if port + 2 < part.end {
            let end = self.closing(port + 2, part.end);
            for entry in self.split(port + 3..end, ",") {
                let arrow = self.find(entry.clone(), &["=>"]);
                entries.push(if arrow < entry.end {
                    (Some(self.text(entry.start)), arrow + 1..entry.end)
                } else {
                    (None, entry)
                });
            }
        }
        let line = self.line(part.start);
        self.instances.push(Instance { label, unit: part.start..map, map: entries, line });
    }

    fn read_process(&mut self, label: Option<&'a str>, part: Part) {
        let begin = self.find(part.clone(), &["begin"]);
        let list = self.find(part.start..begin, &["("]);
        let sensitivity = if list < begin { list + 1..self.closing(list, begin) } else { list..list };
        let body = (begin + 1).min(part.end)..part.end;
        let line = self.line(part.start);
        self.processes.push(Process { label, sensitivity, body: body.clone(), line });
        self.read_sequence(body, self.processes.len() - 1);
    }

    /// The assignments of a process, with the conditions they stand under.
    fn read_sequence(&mut self, body: Part, process: usize) {
        let mut conditions: Vec<bool> = vec![];
        let mut at = body.start;
        while at < body.end {
            let token = self.tokens[at];
            let to = |words: &[&str]| self.find(at..body.end, words) + 1;
            if token.is("end") {
                if self.is(at + 1, "if") {
                    conditions.pop();
                }
                at = to(&[";"]);
            } else if token.any(&["if", "elsif"]) {
                let then = to(&["then"]);
                if token.is("elsif") {
                    conditions.pop();
                }
                let names_reset = |t: &Token| t.kind == Kind::Word && t.text.to_ascii_lowercase().contains("reset");
                conditions.push(self.part(&(at..then)).iter().any(names_reset));
                at = then;
            } else if token.is("else") {
                conditions.pop();
                conditions.push(false);
                at += 1;
            } else if token.is("case") {
                at = to(&["is"]);
            } else if token.is("when") {
                at = to(&["=>"]);
            } else if token.any(&["for", "while", "loop"]) {
                at = to(&["loop"]);
            } else {
                let end = to(&[";"]);
                let arrow = self.find(at..end, &["<="]);
                if arrow < end {
                    self.assign(at..arrow, arrow + 1..end - 1, Some(process), conditions.contains(&true));
                }
                at = end;
            }
        }
    }
}
