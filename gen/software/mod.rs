//! Software triangle tests: those that the paper and its users compare with, and the exact retest.

pub mod interval_axes;
pub mod retest;
pub mod robbins_whitesides;
