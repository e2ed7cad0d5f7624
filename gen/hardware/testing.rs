//! What the tests of all crates share: how much they do, and what they say where a tool is missing.

use std::io::Write;

/// Whether everything is asked for, by `EFSAT_TESTS=full`, which `scripts/test full` sets.
///
/// # Panics
/// If the environment variable has another value than `full`.
#[must_use]
pub fn full() -> bool {
    match std::env::var("EFSAT_TESTS").as_deref() {
        Err(_) => false,
        Ok("full") => true,
        Ok(other) => panic!("EFSAT_TESTS={other}: expected full"),
    }
}

/// Says that a test leaves something out, because `missing`, such as `GHDL is not installed`.
///
/// The line goes to standard error past the capture of the test harness, so that it is seen where tests pass; `scripts/test`
/// counts these lines by their tests.
///
/// # Panics
/// If everything is asked for: then a missing tool is a failure.
pub fn skip(missing: impl std::fmt::Display) {
    assert!(!full(), "{missing}; expected every tool with EFSAT_TESTS=full");
    let thread = std::thread::current();
    let line = format!("skipped: {}: {missing}\n", thread.name().unwrap_or("unnamed"));
    // A closed standard error is no reason to fail.
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}
