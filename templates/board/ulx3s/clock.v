{% for line in header -%}
// {{ line }}
{% endfor -%}
//
// {{ megahertz }} MHz from the oscillator of 25 MHz, times {{ pll.feedback }}, divided by {{ pll.input }}. The PLL's own oscillator makes
// {{ pll.output }} times as much; it has a range of 400 to 800 MHz.
module {{ prefix }}efsat_ulx3s_clock (
  input oscillator,
  output clk,
  output locked
);
  (* FREQUENCY_PIN_CLKI = "25", FREQUENCY_PIN_CLKOP = "{{ megahertz }}" *)
  (* ICP_CURRENT = "12", LPF_RESISTOR = "8", MFG_ENABLE_FILTEROPAMP = "1", MFG_GMCREF_SEL = "2" *)
  EHXPLLL #(
    .PLLRST_ENA("DISABLED"),
    .INTFB_WAKE("DISABLED"),
    .STDBY_ENABLE("DISABLED"),
    .DPHASE_SOURCE("DISABLED"),
    .OUTDIVIDER_MUXA("DIVA"),
    .OUTDIVIDER_MUXB("DIVB"),
    .OUTDIVIDER_MUXC("DIVC"),
    .OUTDIVIDER_MUXD("DIVD"),
    .CLKI_DIV({{ pll.input }}),
    .CLKFB_DIV({{ pll.feedback }}),
    .CLKOP_ENABLE("ENABLED"),
    .CLKOP_DIV({{ pll.output }}),
    .CLKOP_CPHASE({{ pll.phase }}),
    .CLKOP_FPHASE(0),
    .FEEDBK_PATH("CLKOP")
  ) pll (
    .RST(1'b0),
    .STDBY(1'b0),
    .CLKI(oscillator),
    .CLKFB(clk),
    .CLKOP(clk),
    .PHASESEL0(1'b0),
    .PHASESEL1(1'b0),
    .PHASEDIR(1'b1),
    .PHASESTEP(1'b1),
    .PHASELOADREG(1'b1),
    .PLLWAKESYNC(1'b0),
    .ENCLKOP(1'b0),
    .LOCK(locked)
  );
endmodule
