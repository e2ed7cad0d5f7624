//! Progress on standard error, where that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// A bar for `steps` steps; invisible without a terminal, and with `busy` (rows go to the same terminal).
pub(super) fn bar(steps: u64, what: &'static str, busy: bool) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(steps), target(busy)).with_message(what);
    match ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// A spinner for a step of unknown length.
pub(super) fn spinner(what: &'static str) -> ProgressBar {
    let spinner = ProgressBar::with_draw_target(None, target(false)).with_message(what);
    if !spinner.is_hidden() {
        spinner.enable_steady_tick(Duration::from_millis(200));
    }
    spinner
}

fn target(busy: bool) -> ProgressDrawTarget {
    if std::io::stderr().is_terminal() && !(busy && std::io::stdout().is_terminal()) {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    }
}
