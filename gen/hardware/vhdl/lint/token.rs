//! VHDL text as words: comments dropped, each token with its line.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// An identifier or keyword.
    Word,
    /// `\an extended identifier\`.
    Extended,
    /// An abstract literal.
    Number,
    /// A character literal.
    Character,
    /// A string literal.
    Text,
    /// A bit string literal with its base: `x"1F"`.
    Bits,
    /// An operator or delimiter, the longest that VHDL-2008 knows.
    Symbol,
}

/// A token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub kind: Kind,
    pub text: &'a str,
    /// Line of the file, from 1.
    pub line: usize,
    /// Whether nothing stands between it and the token before.
    pub adjacent: bool,
}

impl Token<'_> {
    /// Whether it is this keyword, name or symbol; case does not count.
    pub fn is(&self, text: &str) -> bool {
        matches!(self.kind, Kind::Word | Kind::Symbol) && self.text.eq_ignore_ascii_case(text)
    }

    /// Whether it is one of these keywords, names or symbols.
    pub fn any(&self, texts: &[&str]) -> bool {
        texts.iter().any(|text| self.is(text))
    }
}

/// Symbols of more than one character, longer ones first.
const SYMBOLS: [&str; 18] =
    ["?/=", "?<=", "?>=", "<=", ">=", "=>", ":=", "/=", "**", "<>", "<<", ">>", "??", "?=", "?<", "?>", "--", "/*"];

/// Splits a text. A word that is no VHDL comes out as symbols; nothing is refused here.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens: Vec<Token> = vec![];
    let (mut at, mut line, mut end) = (0, 1, usize::MAX);
    while let Some(c) = text[at..].chars().next() {
        if c.is_whitespace() {
            line += usize::from(c == '\n');
            at += c.len_utf8();
            continue;
        }
        let rest = &text[at..];
        if rest.starts_with("--") {
            at += rest.find('\n').unwrap_or(rest.len());
            continue;
        }
        let adjacent = at == end;
        let (kind, length) = next(rest, tokens.last().filter(|_| adjacent));
        tokens.push(Token { kind, text: &rest[..length], line, adjacent });
        line += rest[..length].matches('\n').count();
        at += length;
        end = at;
    }
    tokens
}

/// Kind and length of the first token of a text; `before` is a token with nothing between.
fn next(rest: &str, before: Option<&Token>) -> (Kind, usize) {
    let first = rest.chars().next().unwrap_or(' ');
    let span = |legal: &dyn Fn(char) -> bool| rest.find(|c: char| !legal(c)).unwrap_or(rest.len());
    // Up to the closing mark, or all there is.
    let closed = |from: usize, mark: char| rest[from..].find(mark).map_or(rest.len(), |i| from + i + 1);
    if first.is_alphabetic() || first == '_' {
        let word = span(&|c| c.is_alphanumeric() || c == '_');
        return if rest[word..].starts_with('"') { (Kind::Bits, closed(word + 1, '"')) } else { (Kind::Word, word) };
    }
    if first.is_ascii_digit() {
        return (Kind::Number, span(&|c| c.is_ascii_digit() || c == '_' || c == '#' || c == '.'));
    }
    match first {
        '"' => (Kind::Text, closed(1, '"')),
        '\\' => (Kind::Extended, closed(1, '\\')),
        // Right after a name or a parenthesis a tick is an attribute or a qualified expression.
        '\'' if !before.is_some_and(|b| b.kind == Kind::Word || b.is(")")) => (Kind::Character, closed(1, '\'')),
        _ => {
            let symbol = SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol));
            (Kind::Symbol, symbol.map_or(first.len_utf8(), |symbol| symbol.len()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_literals_and_symbols() {
        let found: Vec<(Kind, &str, usize)> = tokens("a <= signed'('0' & x\"1F\"); -- b\n\\c\\ 16#f# \"(\"\n")
            .iter()
            .map(|t| (t.kind, t.text, t.line))
            .collect();
        let expected = [
            (Kind::Word, "a", 1),
            (Kind::Symbol, "<=", 1),
            (Kind::Word, "signed", 1),
            (Kind::Symbol, "'", 1),
            (Kind::Symbol, "(", 1),
            (Kind::Character, "'0'", 1),
            (Kind::Symbol, "&", 1),
            (Kind::Bits, "x\"1F\"", 1),
            (Kind::Symbol, ")", 1),
            (Kind::Symbol, ";", 1),
            (Kind::Extended, "\\c\\", 2),
        ];
        assert_eq!(found[..expected.len()], expected);
        assert_eq!(found[expected.len()..].iter().map(|t| t.0).collect::<Vec<_>>()[1..].last(), Some(&Kind::Text));
    }

    #[test]
    fn any_text_has_an_end() {
        for text in ["", "\"open", "'", "\\", "é'", "x\"", "1_", "--", "a'"] {
            assert!(tokens(text).len() <= 2, "{text}");
        }
    }
}
