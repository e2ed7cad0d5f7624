//! Progress on standard error, where that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// A bar for a phase of so many steps, which are called `steps`; invisible without a terminal, without a step, and with
/// `busy` (rows go to the same terminal).
pub(super) fn bar(phase: &'static str, count: u64, steps: &'static str, busy: bool) -> ProgressBar {
    let target = if count > 0 { target(busy) } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(count), target).with_message(phase).with_prefix(steps);
    match ProgressStyle::with_template(TEMPLATE) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

const TEMPLATE: &str = "{msg} {wide_bar} {human_pos} of {human_len} {prefix}, {eta} left";

/// A spinner for a phase of unknown length.
pub(super) fn spinner(phase: &'static str) -> ProgressBar {
    let spinner = ProgressBar::with_draw_target(None, target(false)).with_message(phase);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_has_a_phase_and_steps() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
        let shown = bar("answering", 7, "pairs", false);
        assert_eq!((shown.message(), shown.prefix(), shown.length()), ("answering".into(), "pairs".into(), Some(7)));
    }
}
