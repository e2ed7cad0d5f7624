//! The generated VHDL read back by GHDL and written as Verilog, for tools that read no VHDL.
