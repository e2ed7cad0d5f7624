//! Room `exact`.
