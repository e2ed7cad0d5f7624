//! Open synthesis tools on the generated VHDL: Yosys' counts and nextpnr's clock beside what the device model predicts.
