//! A VHDL file as tokens, and how patterns are found among them.

use std::collections::HashMap;

/// What is wrong, and in which line.
pub(super) type Breach = (usize, String);

/// A file in lower case.
pub(super) struct File<'a> {
    text: &'a str,
    /// Words, numbers, literals and symbols, each with its line, from 1.
    tokens: Vec<(&'a str, usize)>,
    /// Where each array type is declared, and its dimensions, those of its elements included.
    pub arrays: Vec<(usize, usize)>,
}

impl<'a> File<'a> {
    /// Reads a text in lower case; `dimensions` are those of the array types known so far. What is no VHDL is read as well
    /// as may be: an analyser will say so.
    pub fn new(text: &'a str, dimensions: &mut HashMap<String, usize>) -> Self {
        let mut file = Self { text, tokens: tokens(text), arrays: vec![] };
        for at in file.find("type NAME is array (").collect::<Vec<_>>() {
            let (indices, close) = file.list(at + 4);
            let count = indices.len() + dimensions.get(file.word(close, 2)).unwrap_or(&0);
            dimensions.insert(file.word(at, 1).to_owned(), count);
            file.arrays.push((at, count));
        }
        file
    }

    /// The token at a distance from another, empty where there is none.
    pub fn word(&self, at: usize, distance: isize) -> &'a str {
        at.checked_add_signed(distance).and_then(|at| self.tokens.get(at)).map_or("", |token| token.0)
    }

    /// Whether the tokens from a distance on are these, with blanks between; `NAME` is any word.
    pub fn reads(&self, at: usize, distance: isize, pattern: &str) -> bool {
        let fits = |(expected, word): (&str, &str)| if expected == "NAME" { is_name(word) } else { expected == word };
        pattern.split(' ').zip((distance..).map(|distance| self.word(at, distance))).all(fits)
    }

    /// Everywhere that a pattern is.
    pub fn find<'f>(&'f self, pattern: &'f str) -> impl Iterator<Item = usize> + 'f {
        // Most tokens differ from the first word already, and rules ask for many patterns.
        let first = pattern.split(' ').next().unwrap_or_default();
        let begins = move |at: &usize| first == "NAME" || self.tokens[*at].0 == first;
        (0..self.tokens.len()).filter(begins).filter(move |at| self.reads(*at, 0, pattern))
    }

    /// Where something begins with a word, and where its `end` with that word is.
    pub fn regions<'f>(&'f self, word: &'f str) -> impl Iterator<Item = (usize, usize)> + 'f {
        let all = self.tokens.len();
        let is_end = move |at: &usize| self.word(*at, 0) == "end" && self.word(*at, 1) == word;
        let begins = self.find(word).filter(|at| self.word(*at, -1) != "end");
        begins.map(move |at| (at, (at..all).find(is_end).unwrap_or(all)))
    }

    /// Where the entries of a list in parentheses begin, and where it closes.
    pub fn list(&self, open: usize) -> (Vec<usize>, usize) {
        let (mut entries, mut depth) = (vec![open + 1], 0);
        for at in open..self.tokens.len() {
            match self.word(at, 0) {
                "(" => depth += 1,
                ")" if depth == 1 => return (entries, at),
                ")" => depth -= 1,
                "," if depth == 1 => entries.push(at + 1),
                _ => {}
            }
        }
        (entries, self.tokens.len())
    }

    /// A breach at a token.
    pub fn breach(&self, at: usize, what: impl Into<String>) -> Breach {
        (self.tokens.get(at).map_or(0, |token| token.1), what.into())
    }

    /// A breach wherever a pattern is and not allowed.
    pub fn breaches(&self, pattern: &str, allowed: impl Fn(usize) -> bool) -> Vec<Breach> {
        let words = |at| (0..).zip(pattern.split(' ')).map(|(i, _)| self.word(at, i)).collect::<Vec<_>>().join(" ");
        self.find(pattern).filter(|at| !allowed(*at)).map(|at| self.breach(at, words(at))).collect()
    }

    /// The breaches in single lines.
    pub fn lines(&self, wrong: impl Fn(&str) -> Option<String>) -> Vec<Breach> {
        (1..).zip(self.text.split('\n')).filter_map(|(number, line)| Some((number, wrong(line)?))).collect()
    }
}

/// Whether a token is a word.
fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// Splits a text; comments are dropped, and what synthesis tools are told to skip.
fn tokens(text: &str) -> Vec<(&str, usize)> {
    let (mut tokens, mut at, mut line) = (vec![], 0, 1);
    while at < text.len() {
        let (before, rest) = text.split_at(at);
        let token = &rest[..length(before, rest)];
        if !token.starts_with("--") && !token.trim().is_empty() {
            tokens.push((token, line));
        }
        line += token.matches('\n').count();
        at += token.len();
    }
    tokens
}

/// Length of the token, comment or white space that a text begins with.
fn length(before: &str, rest: &str) -> usize {
    let in_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let until = |stops: &dyn Fn(char) -> bool| rest.find(stops).unwrap_or(rest.len());
    let mut chars = rest.chars();
    match chars.next() {
        Some(c) if in_word(c) => until(&|c| !in_word(c)),
        Some(c) if c.is_whitespace() => until(&|c| !c.is_whitespace()),
        Some('-') if rest.starts_with("-- synthesis translate_off\n") => {
            rest.find("-- synthesis translate_on\n").unwrap_or_else(|| until(&|c| c == '\n'))
        }
        Some('-') if rest.starts_with("--") => until(&|c| c == '\n'),
        Some('"') => rest[1..].find(['"', '\n']).map_or(rest.len(), |i| i + 2),
        // Right after a name or a parenthesis a tick is an attribute or a qualified expression.
        Some('\'') if chars.nth(1) == Some('\'') && !before.ends_with(|c| in_word(c) || c == ')') => {
            rest.len() - chars.as_str().len()
        }
        first => {
            let long = ["<=", "=>", ":=", "/=", ">=", "**", "<<", ">>", "/*"].iter().any(|long| rest.starts_with(long));
            if long { 2 } else { first.map_or(1, char::len_utf8) }
        }
    }
}
