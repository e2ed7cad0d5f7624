//! How much the tests do: a share on every change, everything with `EFSAT_TESTS=full`, which `scripts/test full` sets.

/// Whether everything is asked for.
///
/// # Panics
/// If the environment variable has another value than `full`.
pub fn full() -> bool {
    match std::env::var("EFSAT_TESTS").as_deref() {
        Err(_) => false,
        Ok("full") => true,
        Ok(other) => panic!("EFSAT_TESTS={other}: expected full"),
    }
}

/// All cases if everything is asked for, else the first of every `n`.
pub fn share<T>(n: usize, cases: impl IntoIterator<Item = T>) -> Vec<T> {
    cases.into_iter().step_by(if full() { 1 } else { n }).collect()
}
