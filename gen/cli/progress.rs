//! Progress on standard error, where that is a terminal; and what an interruption leaves.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Where finished steps are kept, and the bar that counts them.
static KEPT: Mutex<Option<(PathBuf, ProgressBar)>> = Mutex::new(None);

/// From now on each step of a bar is kept in `place` as soon as it is finished.
pub(super) fn kept(place: &Path, bar: &ProgressBar) {
    *KEPT.lock().unwrap_or_else(PoisonError::into_inner) = Some((place.to_owned(), bar.clone()));
}

/// What an interruption leaves, and how to go on.
pub(super) fn left() -> String {
    match &*KEPT.lock().unwrap_or_else(PoisonError::into_inner) {
        None => "nothing is kept but what was printed; the same command begins again".to_owned(),
        Some((place, bar)) => {
            let (done, all) = (bar.position(), bar.length().unwrap_or_default());
            format!("{done} of {all} {} are kept in {}; the same command goes on", bar.prefix(), place.display())
        }
    }
}

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
