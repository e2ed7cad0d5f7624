//! Standard output, whose reader may leave at any time; and the shapes that several commands print.

use super::error::Failure;
use efsat_hardware::device::Device;
use efsat_unit::golden::{Margin, Reason};
use efsat_unit::host::Verdicts;
use efsat_unit::pair::Verdict;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Write};

/// Verdicts as counts, shares and words, in the order of the codes.
pub(super) fn table(verdicts: &Verdicts) -> String {
    let total = verdicts.total();
    let rows = [
        (Verdict::Separate.to_string(), verdicts.separate),
        (Verdict::Intersect.to_string(), verdicts.intersect),
        (Verdict::PossiblyIncorrect.to_string(), verdicts.possibly_incorrect),
        ("all".to_owned(), total),
    ];
    let share = |count: u64| if total == 0 { 0.0 } else { 100.0 * count as f64 / total as f64 };
    let line = |(word, count): &(String, u64)| format!("{word:<20}{count:>12}{:>9.2} %\n", share(*count));
    format!("{:<20}{:>12}{:>11}\n{}", "verdict", "pairs", "share", rows.iter().map(line).collect::<String>())
}

/// A number of things, named in the plural, which has an s.
pub(super) fn counted(count: impl Into<u64>, things: &str) -> String {
    let count = count.into();
    let things = if count == 1 { things.strip_suffix('s').unwrap_or(things) } else { things };
    format!("{count} {things}")
}

/// A text as a field of a CSV file.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// Why a pair is undecided, the gap and its error, as three fields; empty ones of a pair that is not.
pub(super) fn reasoned(reason: Option<&Reason>) -> String {
    let words = reason.map_or(String::new(), |reason| quoted(&reason.words));
    let margin = reason.and_then(|reason| reason.margin).map(|Margin { gap, error }| [gap, error].map(readable));
    format!("{words},{}", margin.unwrap_or_default().join(","))
}

/// A number as it is read most easily.
pub(super) fn readable(x: f64) -> String {
    if x == 0.0 || (1e-12..1e12).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// What it means that standard output cannot be written.
pub(super) fn failure(e: io::Error) -> Failure {
    match e.kind() {
        io::ErrorKind::BrokenPipe => Failure::Closed,
        _ => Failure::Usage(format!("standard output: {e}; expected one that can be written")),
    }
}

/// Prints a text.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(failure)
}

/// Prints a warning on standard error.
pub(super) fn warn(message: &str) {
    tell("warning", message);
}

/// Says what does not fit on a device.
pub(super) fn warn_of(device: &Device, shortages: &[(&str, u64, u64)]) {
    for (kind, used, there) in shortages {
        warn(&format!("{} has {there} {kind}; the design is predicted to take {used}", device.name));
    }
}

/// Prints a message of some kind on standard error, where there is no one left to tell if that cannot be written.
pub(super) fn tell(kind: &str, message: &str) {
    // Names of files may hold anything; the message is one line.
    let line: String = message.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let line = line.split(' ').map(|word| cut(word, 512)).collect::<Vec<_>>().join(" ");
    let line = cut(&line, 8192);
    let _ = io::stderr().write_all(format!("{kind}: {line}\n").as_bytes());
}

/// A text that a file or a command line may have made long, without its middle if it has more than `most` characters.
fn cut(text: &str, most: usize) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= most {
        return text.into();
    }
    let (begin, end) = (most * 3 / 4, most / 4);
    let part = |skip: usize, take: usize| text.chars().skip(skip).take(take).collect::<String>();
    format!("{}...{}", part(0, begin), part(count - end, end)).into()
}

/// Prints a value as one line of JSON.
pub(super) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).expect("keys are strings and numbers are finite");
    print(&format!("{text}\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_verdicts() {
        let mut verdicts = Verdicts::default();
        for verdict in [Verdict::Separate, Verdict::Separate, Verdict::Separate, Verdict::PossiblyIncorrect] {
            verdicts.count(verdict);
        }
        assert_eq!(
            table(&verdicts),
            "verdict                    pairs      share\n\
             separate                       3    75.00 %\n\
             intersect                      0     0.00 %\n\
             possibly-incorrect             1    25.00 %\n\
             all                            4   100.00 %\n"
        );
        assert!(table(&Verdicts::default()).contains("0.00 %"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, -0.5, 1e300, -2.5e-300].map(readable), ["0", "-0.5", "1e300", "-2.5e-300"]);
    }

    #[test]
    fn one_thing_and_more() {
        assert_eq!([0u64, 1, 2].map(|count| counted(count, "blocks")), ["0 blocks", "1 block", "2 blocks"]);
    }
}
