//! Progress on standard error, where that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// A bar for a phase of so many steps, which are called `steps`; invisible without a terminal, without a step, and with
/// `busy` (rows go to the same terminal).
pub(super) fn bar(phase: &'static str, count: u64, steps: &'static str, busy: bool) -> ProgressBar {
    let target = if count > 0 { target(busy) } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(count), target).with_message(phase).with_prefix(steps);
    bar.with_style(style(BAR))
}

/// A spinner for a phase of unknown length.
pub(super) fn spinner(phase: &'static str) -> ProgressBar {
    let spinner = ProgressBar::with_draw_target(None, target(false)).with_message(phase).with_style(style(SPINNER));
    if !spinner.is_hidden() {
        spinner.enable_steady_tick(Duration::from_millis(200));
    }
    spinner
}

const BAR: &str = "{msg} {wide_bar} {human_pos} of {human_len} {prefix}, {eta} left";
const SPINNER: &str = "{msg} {spinner} {elapsed}";

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn target(busy: bool) -> ProgressDrawTarget {
    if std::io::stderr().is_terminal() && !(busy && std::io::stdout().is_terminal()) {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    }
}
