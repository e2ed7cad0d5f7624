//! Reads the generated VHDL: which line assigns what, and the types of all names. The text has few and regular forms,
//! one statement or one arm of a choice a line.

use std::collections::HashMap;

/// What a line does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// `constant c : t := v;`.
    Constant,
    /// A concurrent assignment, or an arm of one.
    Concurrent,
    /// An assignment at a clock edge.
    Register,
    /// The value of a register in reset.
    Reset,
    /// `if c then`, `elsif c then`.
    Condition,
    /// An actual of a port map.
    Actual,
}

/// A line that does something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Line of the file, from 1.
    pub line: usize,
    /// What it does.
    pub role: Role,
    /// What is assigned; of a condition the first signal assigned under it; of an actual `instance.port`.
    pub target: String,
    /// Where in the line the part that may be changed begins and ends.
    pub span: (usize, usize),
}

/// The text of an entity, read.
#[derive(Debug)]
pub struct Source<'a> {
    /// All lines.
    pub lines: Vec<&'a str>,
    /// Types of ports, signals and constants, and the order in which they are declared.
    pub types: HashMap<&'a str, (&'a str, usize)>,
    /// The lines of the architecture that do something.
    pub statements: Vec<Statement>,
}

/// The text before a comment.
fn code(line: &str) -> &str {
    line.split("--").next().unwrap_or_default().trim_end()
}

impl<'a> Source<'a> {
    /// Reads the file of an entity.
    pub fn new(text: &'a str) -> Self {
        let mut source = Self { lines: text.lines().collect(), types: HashMap::new(), statements: vec![] };
        let body = source.lines.iter().position(|line| line.starts_with("architecture ")).unwrap_or(source.lines.len());
        for i in 0..source.lines.len() {
            source.declaration(i, i > body);
        }
        source.body(body);
        source
    }

    /// The type of a name.
    pub fn type_of(&self, name: &str) -> Option<&'a str> {
        self.types.get(name).map(|t| t.0)
    }

    /// A port, signal or constant.
    fn declaration(&mut self, i: usize, inside: bool) {
        let text = code(self.lines[i]).trim_start();
        let Some((head, rest)) = text.split_once(" : ") else { return };
        let words: Vec<&str> = head.split(' ').collect();
        let name = match (inside, words.as_slice()) {
            (false, [name]) => name,
            (true, ["signal" | "constant", name]) => name,
            _ => return,
        };
        let ty = rest.trim_end_matches(';').trim_start_matches("in ").trim_start_matches("out ");
        let (ty, value) = ty.split_once(" := ").unwrap_or((ty, ""));
        let order = self.types.len();
        self.types.insert(name, (ty, order));
        if words[0] == "constant" && !value.is_empty() {
            let start = self.lines[i].find(" := ").unwrap_or_default() + 4;
            let target = (*name).to_owned();
            let span = (start, start + value.len());
            self.statements.push(Statement { line: i + 1, role: Role::Constant, target, span });
        }
    }

    /// Assignments, conditions and port maps below line `start`.
    fn body(&mut self, start: usize) {
        let (mut open, mut label, mut clocked, mut reset) = (None::<String>, "", false, false);
        for i in start..self.lines.len() {
            let line = code(self.lines[i]);
            let text = line.trim_start();
            let indent = line.len() - text.len();
            let mut add = |role, target: String, from: usize, to: usize| {
                self.statements.push(Statement { line: i + 1, role, target, span: (from, to) });
            };
            let end = line.trim_end_matches([';', ',']).len();
            if let Some(target) = &open {
                let arm = text.strip_suffix(" else").map_or(end, |_| line.len() - " else".len());
                add(Role::Concurrent, target.clone(), indent, arm);
                if text.ends_with(';') {
                    open = None;
                }
            } else if let Some((target, _)) = text.split_once(" <=") {
                let target = target.split('(').next().unwrap_or(target).to_owned();
                let from = indent + text.find(" <=").unwrap_or_default() + " <= ".len();
                if from >= line.len() {
                    open = Some(target);
                } else {
                    let role = match (clocked, reset) {
                        (false, _) => Role::Concurrent,
                        (true, false) => Role::Register,
                        (true, true) => Role::Reset,
                    };
                    add(role, target, from, end);
                }
            } else if let Some((instance, _)) = text.split_once(" : entity work.") {
                label = instance;
            } else if let Some((formal, _)) = text.split_once(" => ") {
                if formal != "clk" {
                    add(Role::Actual, format!("{label}.{formal}"), indent + formal.len() + 4, end);
                }
            } else if text.contains(" : process") {
                (clocked, reset) = (true, false);
            } else if text.starts_with("end process") {
                clocked = false;
            } else if let Some(condition) = text.strip_suffix(" then") {
                if !condition.contains("rising_edge") {
                    reset = condition == "if reset = '1'";
                    let next = self.lines[i + 1..].iter().find_map(|l| l.split_once(" <=")).map(|(t, _)| t.trim());
                    let from = indent + condition.find(' ').unwrap_or_default() + 1;
                    let target = next.unwrap_or_default().split('(').next().unwrap_or_default().to_owned();
                    add(Role::Condition, target, from, indent + condition.len());
                }
            } else if text == "else" {
                reset = false;
            }
        }
    }
}
