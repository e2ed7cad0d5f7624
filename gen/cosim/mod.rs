//! Room `cosim`.
