//! What the text formats have in common: lines, words and numbers.

use super::error::Fault;
use std::borrow::Cow;

/// The lines of a text, which end in a line feed, a carriage return or both; each with its number, counted from 1.
///
/// A byte order mark of UTF-8 before the first line is skipped. Bytes that are no UTF-8 are replaced: names may be in any
/// encoding, and numbers are ASCII.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

/// A line without its end.
pub(super) struct Line<'a> {
    /// Its number, counted from 1.
    pub number: usize,
    /// What stands in it.
    pub text: Cow<'a, str>,
}

impl<'a> Lines<'a> {
    /// All lines of a file.
    ///
    /// # Errors
    /// A file in UTF-16, which begins with a mark of its own.
    pub fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(Fault::new("text in UTF-16", "expected text in ASCII or UTF-8").at(1));
        }
        Ok(Self { rest: without_mark(bytes), number: 0 })
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let (text, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix(b"\r\n").unwrap_or(rest.get(1..).unwrap_or_default());
        self.number += 1;
        Some(Line { number: self.number, text: String::from_utf8_lossy(text) })
    }
}

/// The bytes of a file without the byte order mark of UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The words of a text one after the other, whatever lines they stand on.
pub(super) struct Words<'a> {
    lines: Lines<'a>,
    /// Whether lines end in comments.
    comments: bool,
    line: usize,
    /// Those that are left of the line, the last one first.
    words: Vec<String>,
}

impl<'a> Words<'a> {
    pub fn new(lines: Lines<'a>, comments: bool) -> Self {
        Self { line: lines.number, lines, comments, words: vec![] }
    }

    /// The line of the word last read, counted from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The next word of the line, none at its end.
    pub fn here(&mut self) -> Option<String> {
        self.words.pop()
    }

    /// The words that are left of the line, which is read with them.
    pub fn rest_of_line(&mut self) -> Vec<String> {
        std::mem::take(&mut self.words).into_iter().rev().collect()
    }

    /// Puts words back before those that are left of the line.
    pub fn back(&mut self, words: Vec<String>) {
        self.words.extend(words.into_iter().rev());
    }
}

impl Iterator for Words<'_> {
    type Item = String;

    fn next(&mut self) -> Option<String> {
        loop {
            if let Some(word) = self.words.pop() {
                return Some(word);
            }
            let Line { number, text } = self.lines.next()?;
            let text = if self.comments { uncommented(&text).0 } else { &text };
            self.line = number;
            self.words = text.split_whitespace().rev().map(str::to_owned).collect();
        }
    }
}

/// A line without its comment, which begins with a hash that is none of `1.#IND` and its like, and whether it has one.
pub(super) fn uncommented(line: &str) -> (&str, bool) {
    let is_number = |at: usize| line[..at].ends_with("1.") && line[at + 1..].starts_with(['I', 'Q', 'S', 'N']);
    match line.match_indices('#').find(|(at, _)| !is_number(*at)) {
        Some((at, _)) => (&line[..at], true),
        None => (line, false),
    }
}

/// What a decimal stands for: the nearest binary64 number, which may be infinite, or no number, in the spellings of C
/// libraries too.
///
/// # Errors
/// What is wrong with a word that is no number, or one that binary64 rounds to 0.
pub(super) fn number(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(0.0) if word.bytes().take_while(|c| !matches!(c, b'e' | b'E')).any(|c| matches!(c, b'1'..=b'9')) => {
            Err(format!("'{}', which binary64 rounds to 0", quoted(word)))
        }
        Ok(x) => Ok(x),
        Err(_) => {
            let bare = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
            match bare.as_str() {
                _ if bare.starts_with("nan(") || bare.starts_with("1.#ind") => Ok(f64::NAN),
                _ if bare.starts_with("1.#qnan") || bare.starts_with("1.#snan") || bare.starts_with("1.#nan") => {
                    Ok(f64::NAN)
                }
                _ if bare.starts_with("1.#inf") => {
                    Ok(if word.starts_with('-') { f64::NEG_INFINITY } else { f64::INFINITY })
                }
                _ if word.contains(',') => {
                    Err(format!("'{}': a decimal comma or a comma between numbers", quoted(word)))
                }
                _ => Err(format!("'{}'", quoted(word))),
            }
        }
    }
}

/// A word for a message, cut if it is long.
pub(super) fn quoted(word: &str) -> String {
    const MOST: usize = 40;
    let mut shown: String = word.chars().take(MOST).collect();
    if word.chars().nth(MOST).is_some() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_all_ways_and_are_counted() {
        let text = b"\xef\xbb\xbfa\nb\rc\r\n\r\r\n\nd";
        let lines: Vec<(usize, String)> =
            Lines::new(text).unwrap().map(|line| (line.number, line.text.into_owned())).collect();
        let expected = [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, ""), (6, ""), (7, "d")];
        assert_eq!(lines, expected.map(|(number, text)| (number, text.to_owned())));
        assert_eq!(Lines::new(b"").unwrap().count(), 0);
        assert!(Lines::new(b"\xff\xfev\0").is_err());
    }

    #[test]
    fn numbers_are_those_of_binary64_and_of_c() {
        for (word, value) in
            [("1", 1.0), ("-.5e1", -5.0), ("+3.", 3.0), ("1e-50", 1e-50), ("0e-9", 0.0), ("1e999", f64::INFINITY)]
        {
            assert_eq!(number(word), Ok(value), "{word}");
        }
        for word in ["nan", "-NaN", "-nan(ind)", "nan(snan)", "-1.#IND", "1.#QNAN", "1.#IND00"] {
            assert!(number(word).unwrap().is_nan(), "{word}");
        }
        assert_eq!(number("-1.#INF"), Ok(f64::NEG_INFINITY));
        assert_eq!(number("1,5"), Err("'1,5': a decimal comma or a comma between numbers".to_owned()));
        assert_eq!(number("-1e-400"), Err("'-1e-400', which binary64 rounds to 0".to_owned()));
        assert!(number("x").is_err() && number("").is_err() && number("1.#").is_err());
        assert_eq!(number(&"x".repeat(1000)).unwrap_err().len(), 45);
    }
}
