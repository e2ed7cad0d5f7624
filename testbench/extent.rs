//! How much the tests do: a share on every change, everything with `EFSAT_TESTS=full`, which `scripts/test full` sets.

pub use efsat_hardware::testing::full;

/// All cases if everything is asked for, else the first of every `n`.
pub fn share<T>(n: usize, cases: impl IntoIterator<Item = T>) -> Vec<T> {
    cases.into_iter().step_by(if full() { 1 } else { n }).collect()
}

/// Cases that are tried if everything is asked for alone.
pub fn in_full<T>(cases: impl IntoIterator<Item = T>) -> Vec<T> {
    cases.into_iter().take_while(|_| full()).collect()
}
