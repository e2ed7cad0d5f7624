//! Room `vhdl`.
