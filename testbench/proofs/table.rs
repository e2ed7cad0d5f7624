//! The table of proofs.

use super::claim::Row;
use std::io::Write;

/// Prints on standard error past the capture of the test harness: what was proved is seen where tests pass.
pub fn print(text: &str) {
    // A closed standard error is no reason to fail.
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// Rows as aligned text.
pub fn text(title: &str, rows: &[Row]) -> String {
    let head = ["unit", "widths", "property"].map(str::to_owned);
    let columns = [0, 1, 2].map(|i: usize| {
        rows.iter().map(|row| row.claim[i].len()).chain([head[i].len()]).max().expect("the head at least")
    });
    let line = |cells: &[String; 3], rest: &str| {
        let [a, b, c] = cells;
        format!("{a:0$}  {b:1$}  {c:2$}  {rest}\n", columns[0], columns[1], columns[2])
    };
    let mut text = format!("\n{title}\n{}", line(&head, "seconds  claim   mutants; certificate"));
    for row in rows {
        let mutants = match row.refuted {
            [_, 0] => "none".to_owned(),
            [refuted, tried] => format!("{refuted} of {tried} refuted"),
        };
        let certificate = if row.certificate.is_empty() { String::new() } else { format!("; {}", row.certificate) };
        let seconds = row.seconds.map_or("before".to_owned(), |seconds| format!("{seconds:.1}"));
        let rest = format!("{seconds:>7}  {}  {mutants}{certificate}", row.verdict);
        text += &line(&row.claim, &rest);
    }
    text
}

/// What is wrong about a row, with its unit.
pub fn failures(row: &Row) -> Vec<String> {
    row.failures.iter().map(|failure| format!("{}: {failure}", row.claim.join(", "))).collect()
}
