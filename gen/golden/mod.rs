//! Room `golden`.
