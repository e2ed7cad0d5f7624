//! Files of triangle pairs: `.csv` (18 numbers a row) and `.f64` (raw little-endian binary64, 144 bytes a pair), in
//! both a0 a1 a2 b0 b1 b2, each x y z.
//!
//! ```
//! use efsat_geometry::pair_file::read_csv;
//!
//! let text = "0,0,0, 4,0,0, 0,4,0, 1,1,0, 1,1,1, 2,1,1\n";
//! let pairs = read_csv(text.as_bytes(), "pairs.csv")?;
//! assert_eq!(pairs[0][3], [1.0, 1.0, 0.0]);
//! let error = read_csv("1,2,3\n".as_bytes(), "pairs.csv").unwrap_err();
//! assert!(error.to_string().starts_with("pairs.csv: "));
//! # Ok::<(), efsat_geometry::pair_file::PairFileError>(())
//! ```

use crate::Points;
use rayon::prelude::*;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::Path;

/// Bytes of one pair in a `.f64` file.
const RECORD: usize = 18 * 8;

/// Bytes of the longest line. Eighteen numbers with all decimals of a binary64 take a quarter of it; what has no line feed at
/// all does not fill the memory.
const LINE: u64 = 1 << 16;

/// Pairs that are read at a time where all are wanted.
const MANY: usize = 1 << 14;

/// Why a file of pairs cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum PairFileError {
    /// The operating system says no.
    #[error("{file}: cannot be read ({source}); expected a file of pairs")]
    Io {
        /// The file as named by the user, `standard input` for `-`.
        file: String,
        /// What it says.
        source: std::io::Error,
    },
    /// Neither `.csv` nor `.f64` nor `-`.
    #[error("{file}: found a name ending in \"{found}\"; expected .csv, .f64, or - for CSV on standard input{hint}")]
    Kind {
        /// The file as named by the user.
        file: String,
        /// The extension found.
        found: String,
        /// What reads such a file.
        hint: &'static str,
    },
    /// No pair in the file.
    #[error("{file}: found no pair; expected at least one")]
    Empty {
        /// The file as named by the user.
        file: String,
    },
    /// A `.f64` file that ends inside a pair.
    #[error("{file}: found {found} bytes; expected a multiple of {RECORD} (18 binary64 numbers per pair)")]
    Length {
        /// The file as named by the user.
        file: String,
        /// Its length in bytes.
        found: usize,
    },
    /// A number in a `.f64` file that is NaN or infinite.
    #[error("{file}: byte {offset} (pair {pair}, number {number}): found {found}; expected a finite number")]
    Value {
        /// The file as named by the user.
        file: String,
        /// Where the number starts, counted from 0.
        offset: usize,
        /// Which pair, counted from 0.
        pair: usize,
        /// Which of its 18 numbers, counted from 1.
        number: usize,
        /// The number found.
        found: f64,
    },
    /// A row with too few or too many fields.
    #[error(
        "{file}: line {line}: found {found} field{}; expected 18 (a0 a1 a2 b0 b1 b2, each x y z)",
        if *found == 1 { "" } else { "s" }
    )]
    Fields {
        /// The file as named by the user.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// The number of fields.
        found: usize,
    },
    /// A line that no pair needs.
    #[error("{file}: line {line}: found more than {LINE} bytes; expected 18 numbers")]
    Long {
        /// The file as named by the user.
        file: String,
        /// Line, counted from 1.
        line: usize,
    },
    /// Fields between which something else than commas stands.
    #[error(
        "{file}: line {line}: found {found} between the numbers; expected commas, and a point in each decimal number"
    )]
    Separator {
        /// The file as named by the user.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// What stands between them.
        found: &'static str,
    },
    /// A field that is no finite number.
    #[error(
        "{file}: line {line}, column {column}: found \"{found}\"; expected a finite number that binary64 does not round to 0"
    )]
    Field {
        /// The file as named by the user.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// Field of the line, counted from 1.
        column: usize,
        /// The text found, shortened.
        found: String,
    },
}

/// Reads the file `name`, by its extension; `-` is CSV on standard input.
///
/// # Errors
/// A file that cannot be read, is of no known kind, holds no pair, or holds anything but finite numbers, 18 a pair.
pub fn read(name: &str) -> Result<Vec<Points>, PairFileError> {
    Reader::open(name)?.all()
}

/// Reads CSV: 18 numbers a row, a first row none of whose fields begins as a number does is a header, empty lines are
/// skipped. A decimal stands for the nearest binary64 number.
///
/// `name` is used in messages.
///
/// # Errors
/// As [`read`].
pub fn read_csv(source: impl Read, name: &str) -> Result<Vec<Points>, PairFileError> {
    Reader::new(source, name, Format::CSV).all()
}

/// Reads raw little-endian binary64 numbers, 18 a pair.
///
/// `name` is used in messages.
///
/// # Errors
/// As [`read`].
pub fn read_f64(source: impl Read, name: &str) -> Result<Vec<Points>, PairFileError> {
    Reader::new(source, name, Format::Raw).all()
}

/// How pairs are written.
enum Format {
    /// Text: how many lines have been read, and whether a row has.
    Csv {
        lines: usize,
        begun: bool,
    },
    Raw,
}

impl Format {
    const CSV: Self = Self::Csv { lines: 0, begun: false };
}

/// Reads pairs some at a time, so that no more are in memory; numbers are read by all threads of the current pool.
// For the command line.
#[doc(hidden)]
pub struct Reader<'a> {
    file: String,
    source: Box<dyn BufRead + 'a>,
    format: Format,
    length: u64,
    position: u64,
    pairs: usize,
}

impl Reader<'_> {
    /// Opens the file `name`, as [`read`] does.
    ///
    /// # Errors
    /// A file that cannot be opened, or is of no known kind, or ends inside a pair.
    pub fn open(name: &str) -> Result<Self, PairFileError> {
        if name == "-" {
            return Ok(Self::new(std::io::stdin().lock(), "standard input", Format::CSV));
        }
        let extension = Path::new(name).extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let format = match extension.as_str() {
            "csv" => Format::CSV,
            "f64" => Format::Raw,
            _ => {
                let hint = match extension.as_str() {
                    "stl" | "obj" | "ply" => " (a mesh: a scene file names it, or efsat compare --mesh reads it)",
                    _ => "",
                };
                return Err(PairFileError::Kind { file: name.to_owned(), found: extension, hint });
            }
        };
        let no = |source| PairFileError::Io { file: name.to_owned(), source };
        let file = std::fs::File::open(name).map_err(no)?;
        // Of what is no file, a pipe perhaps, the length is 0.
        let length = file.metadata().map_err(no)?.len();
        if matches!(format, Format::Raw) && length % RECORD as u64 != 0 {
            return Err(PairFileError::Length { file: name.to_owned(), found: length as usize });
        }
        Ok(Self { length, ..Self::new(file, name, format) })
    }
}

impl<'a> Reader<'a> {
    fn new(source: impl Read + 'a, name: &str, format: Format) -> Self {
        let source = Box::new(BufReader::new(source));
        Self { file: name.to_owned(), source, format, length: 0, position: 0, pairs: 0 }
    }

    /// The bytes of the file, or 0 if that is not known.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The bytes that have been read.
    pub fn position(&self) -> u64 {
        self.position
    }

    /// The next pairs, so many at most; none at the end.
    ///
    /// # Errors
    /// As [`read`], for what has been read so far.
    pub fn next(&mut self, most: usize) -> Result<Vec<Points>, PairFileError> {
        let found = match self.format {
            Format::Csv { .. } => self.rows(most)?,
            Format::Raw => self.records(most)?,
        };
        self.pairs += found.len();
        if self.pairs == 0 {
            return Err(PairFileError::Empty { file: self.file.clone() });
        }
        Ok(found)
    }

    /// All that are left.
    ///
    /// # Errors
    /// As [`read`].
    pub fn all(mut self) -> Result<Vec<Points>, PairFileError> {
        let mut all = vec![];
        loop {
            let found = self.next(MANY)?;
            if found.is_empty() {
                return Ok(all);
            }
            all.extend(found);
        }
    }

    fn rows(&mut self, most: usize) -> Result<Vec<Points>, PairFileError> {
        let Self { file, source, format: Format::Csv { lines, begun }, position, .. } = self else { return Ok(vec![]) };
        let (mut text, mut rows, mut stopped) = (vec![], vec![], None);
        while rows.len() < most {
            let mut start = text.len();
            let length = match source.by_ref().take(LINE).read_until(b'\n', &mut text) {
                Ok(0) => break,
                Ok(length) => length as u64,
                Err(source) => {
                    stopped = Some(PairFileError::Io { file: file.clone(), source });
                    break;
                }
            };
            (*lines, *position) = (*lines + 1, *position + length);
            if length == LINE {
                stopped = Some(PairFileError::Long { file: file.clone(), line: *lines });
                break;
            }
            // A byte order mark would make a header of the first row.
            if *lines == 1 && text.starts_with(b"\xef\xbb\xbf") {
                start = 3;
            }
            let row = &text[start..];
            if !row.trim_ascii().is_empty() && (std::mem::replace(begun, true) || !is_header(row)) {
                rows.push((*lines, start..text.len()));
            }
        }
        let numbers = |(line, place): &(usize, Range<usize>)| row(&text[place.clone()], file, *line);
        let found = in_order(rows.par_iter().map(numbers).collect())?;
        stopped.map_or(Ok(found), Err)
    }

    fn records(&mut self, most: usize) -> Result<Vec<Points>, PairFileError> {
        let Self { file, source, position, pairs, .. } = self;
        let mut bytes = vec![];
        source
            .by_ref()
            .take((most * RECORD) as u64)
            .read_to_end(&mut bytes)
            .map_err(|source| PairFileError::Io { file: file.clone(), source })?;
        *position += bytes.len() as u64;
        if bytes.len() % RECORD != 0 {
            return Err(PairFileError::Length { file: file.clone(), found: *position as usize });
        }
        let numbers = |(pair, bytes): (usize, &[u8])| record(bytes, file, *pairs + pair);
        in_order(bytes.par_chunks_exact(RECORD).enumerate().map(numbers).collect())
    }
}

/// All pairs, or the first error.
fn in_order(found: Vec<Result<Points, PairFileError>>) -> Result<Vec<Points>, PairFileError> {
    found.into_iter().collect()
}

/// Whether a row is text none of whose fields begins as a number does, though commas separate them: damaged numbers are no
/// header.
fn is_header(row: &[u8]) -> bool {
    let begins_a_number = |field: &[u8]| field.first().is_some_and(|b| b.is_ascii_digit() || b"+-.".contains(b));
    let is_text = !row.contains(&0) && std::str::from_utf8(row).is_ok();
    is_text && separator(row).is_none() && fields(row).all(|field| number(field).is_none() && !begins_a_number(field))
}

/// The pair of a row.
fn row(row: &[u8], file: &str, line: usize) -> Result<Points, PairFileError> {
    let file = || file.to_owned();
    if let Some(found) = separator(row) {
        return Err(PairFileError::Separator { file: file(), line, found });
    }
    let found = fields(row).count();
    if found != 18 {
        return Err(PairFileError::Fields { file: file(), line, found });
    }
    let mut points = Points::default();
    for (i, field) in fields(row).enumerate() {
        match number(field) {
            Some(x) if x.is_finite() && !(x == 0.0 && has_digits(field)) => points[i / 3][i % 3] = x,
            _ => return Err(PairFileError::Field { file: file(), line, column: i + 1, found: shown(field) }),
        }
    }
    Ok(points)
}

/// The pair of 144 bytes.
fn record(bytes: &[u8], file: &str, pair: usize) -> Result<Points, PairFileError> {
    let mut points = Points::default();
    for (i, word) in bytes.chunks_exact(8).enumerate() {
        let mut raw = [0; 8];
        raw.copy_from_slice(word);
        let x = f64::from_le_bytes(raw);
        if !x.is_finite() {
            let offset = pair * RECORD + i * 8;
            return Err(PairFileError::Value { file: file.to_owned(), offset, pair, number: i + 1, found: x });
        }
        points[i / 3][i % 3] = x;
    }
    Ok(points)
}

fn fields(row: &[u8]) -> impl Iterator<Item = &[u8]> {
    row.split(|&byte| byte == b',').map(unquoted)
}

/// What separates the numbers of a row if it is not commas. A header may have blanks, but no 18 numbers between them.
fn separator(row: &[u8]) -> Option<&'static str> {
    let words = row.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    match row.contains(&b',') {
        _ if row.iter().filter(|&&byte| byte == b';').count() >= 17 => Some("semicolons"),
        false if words.filter(|word| number(word).is_some()).count() >= 18 => Some("blanks"),
        _ => None,
    }
}

/// A field without the space and the quotes around it. Numbers need neither, so there is nothing to unescape.
fn unquoted(field: &[u8]) -> &[u8] {
    let field = field.trim_ascii();
    let inner = field.strip_prefix(b"\"").and_then(|rest| rest.strip_suffix(b"\""));
    inner.map_or(field, <[u8]>::trim_ascii)
}

/// The number a field spells, if any; not necessarily finite.
fn number(field: &[u8]) -> Option<f64> {
    std::str::from_utf8(field).ok()?.parse().ok()
}

/// Whether a number's decimals, its exponent left aside, are not all zero.
fn has_digits(field: &[u8]) -> bool {
    field.iter().take_while(|c| !matches!(c, b'e' | b'E')).any(|c| matches!(c, b'1'..=b'9'))
}

/// A field for a message: readable and short.
fn shown(field: &[u8]) -> String {
    String::from_utf8_lossy(field).chars().take(40).flat_map(char::escape_debug).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: &str = "0,0,0, 1,0,0, 0,1,0, 0,0,1, 1,0,1, 0,1,-1e-3";

    fn message(text: &[u8]) -> String {
        read_csv(text, "p.csv").unwrap_err().to_string()
    }

    #[test]
    fn csv_with_and_without_a_header() {
        let header: Vec<String> = (0..18).map(|i| format!("c{i}")).collect();
        let plain = read_csv(format!("{ROW}\n{ROW}\n").as_bytes(), "").unwrap();
        assert_eq!(plain.len(), 2);
        assert_eq!(plain[0][5], [0.0, 1.0, -1e-3]);
        for text in [
            format!("{}\r\n{ROW}\r\n\r\n{ROW}", header.join(",")),
            format!("\u{feff}{ROW}\n\n{}\n", ROW.replacen("0", "\" 0\"", 1)),
        ] {
            assert_eq!(read_csv(text.as_bytes(), "").unwrap(), plain);
        }
    }

    #[test]
    fn csv_errors_name_the_place() {
        assert_eq!(message(b""), "p.csv: found no pair; expected at least one");
        assert_eq!(message(b"a0x,a0y\n"), "p.csv: found no pair; expected at least one");
        assert_eq!(
            message(format!("{ROW}\n{ROW},7\n").as_bytes()),
            "p.csv: line 2: found 19 fields; expected 18 (a0 a1 a2 b0 b1 b2, each x y z)"
        );
        assert_eq!(message(b"1,2,3\n"), "p.csv: line 1: found 3 fields; expected 18 (a0 a1 a2 b0 b1 b2, each x y z)");
        let legal = "expected a finite number that binary64 does not round to 0";
        for bad in ["nan", "inf", "1e999", "1e-400", "-0.003E-330", "1.5x", ""] {
            let text = format!("{ROW}\n\n{}\n", ROW.replacen(" 1,", &format!("{bad},"), 1));
            assert_eq!(message(text.as_bytes()), format!("p.csv: line 3, column 4: found \"{bad}\"; {legal}"));
        }
        assert!(read_csv(ROW.replacen(" 1,", "-0.00E7,", 1).as_bytes(), "").is_ok());
        // Not a header: a row with a field mistyped, and NaN, which is a number, though not a finite one.
        assert!(
            message(format!("{}\n{ROW}", ROW.replacen('0', "O", 1)).as_bytes())
                .contains("line 1, column 1: found \"O\"")
        );
        assert!(message(ROW.replacen('0', "NaN", 1).as_bytes()).contains("line 1, column 1"));
        // Nor damaged numbers, nor UTF-16.
        assert!(message(format!("{}\n{ROW}", vec!["0.0.0"; 18].join(",")).as_bytes()).contains("line 1, column 1"));
        assert!(message(format!("1_0,1_0\n{ROW}").as_bytes()).contains("line 1: found 2 fields"));
        let wide: Vec<u8> = format!("\u{feff}{ROW}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(message(&wide).contains("line 1, column 1"));
        let mut garbage = format!("{ROW}\n").into_bytes();
        garbage.extend(ROW.replacen("1e", "\u{7}", 1).bytes().map(|b| if b == 7 { 0xff } else { b }));
        assert!(message(&garbage).contains("line 2, column 18"));
    }

    #[test]
    fn numbers_without_commas_are_no_header() {
        for (by, named) in [(" ", "blanks"), ("\t", "blanks"), (";", "semicolons")] {
            let row = ROW.replace(' ', "").replace(',', by);
            let place = format!("p.csv: line 1: found {named} between the numbers; expected commas");
            assert!(message(format!("{row}\n{ROW}\n").as_bytes()).starts_with(&place), "{by:?}");
        }
        assert_eq!(read_csv(format!("the pairs of part 1 2 3\n{ROW}").as_bytes(), "").unwrap().len(), 1);
    }

    #[test]
    fn a_line_without_an_end_is_not_read_to_its_end() {
        let message = read_csv(std::io::repeat(b'7'), "p.csv").unwrap_err().to_string();
        assert_eq!(message, "p.csv: line 1: found more than 65536 bytes; expected 18 numbers");
        let long = ROW.replacen("0,0,0", &format!("0.{},0,0", "0".repeat(4000)), 1);
        assert_eq!(read_csv(long.as_bytes(), "").unwrap().len(), 1);
    }

    #[test]
    fn raw_numbers() {
        let numbers: Vec<f64> = (0..36).map(f64::from).collect();
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        let pairs = read_f64(&bytes[..], "").unwrap();
        assert_eq!(pairs.len(), 2);
        assert_eq!(pairs[1][0], [18.0, 19.0, 20.0]);
        let message = |bytes: &[u8]| read_f64(bytes, "p.f64").unwrap_err().to_string();
        assert_eq!(message(&[]), "p.f64: found no pair; expected at least one");
        assert_eq!(
            message(&bytes[..145]),
            "p.f64: found 145 bytes; expected a multiple of 144 (18 binary64 numbers per pair)"
        );
        let mut infinite = bytes.clone();
        infinite[160..168].copy_from_slice(&f64::NEG_INFINITY.to_le_bytes());
        assert_eq!(message(&infinite), "p.f64: byte 160 (pair 1, number 3): found -inf; expected a finite number");
    }

    /// In batches of any size the pairs are the same, and so are errors, with all pairs before them.
    #[test]
    fn batches_are_the_whole() {
        let rows: String =
            (0..50).map(|i| format!("{}\n{}", ROW.replacen('0', &i.to_string(), 1), &"\n"[i % 2..])).collect();
        let text = format!("\u{feff}name\n{rows}");
        let whole = read_csv(text.as_bytes(), "").unwrap();
        let bytes: Vec<u8> = whole.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let drain = |mut reader: Reader<'_>, most: usize| {
            let mut all = vec![];
            loop {
                match reader.next(most) {
                    Ok(found) if found.is_empty() => return (all, None),
                    Ok(found) => all.extend(found),
                    Err(e) => return (all, Some(e.to_string())),
                }
            }
        };
        for most in [1, 7, 50, 51] {
            assert_eq!(drain(Reader::new(text.as_bytes(), "", Format::CSV), most), (whole.clone(), None));
            assert_eq!(drain(Reader::new(&bytes[..], "", Format::Raw), most), (whole.clone(), None));
            let cut = drain(Reader::new(&bytes[..bytes.len() - 1], "p", Format::Raw), most);
            assert_eq!(cut.0.len(), 49 / most * most);
            assert!(cut.1.unwrap().starts_with("p: found 7199 bytes"));
            let wrong = text.replacen("48,", "x,", 1);
            let (before, error) = drain(Reader::new(wrong.as_bytes(), "p", Format::CSV), most);
            assert_eq!((before.len(), error.unwrap().contains("column 1: found \"x\"")), (48 / most * most, true));
        }
    }

    #[test]
    fn files_are_told_apart_by_name() {
        assert!(read("pairs.txt").unwrap_err().to_string().contains("expected .csv, .f64, or -"));
        assert!(read("no-such-file.csv").unwrap_err().to_string().starts_with("no-such-file.csv: "));
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("p.CSV");
        std::fs::write(&path, ROW).unwrap();
        assert_eq!(read(path.to_str().unwrap()).unwrap().len(), 1);
    }
}
