--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- {{ megahertz }} MHz from the oscillator of 100 MHz: 1000 MHz in the MMCM, divided by {{ divisor }}.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
library unisim;
use unisim.vcomponents.all;

entity {{ prefix }}efsat_arty_a7_clock is
  port (
    oscillator : in std_logic;
    clk : out std_logic;
    locked : out std_logic
  );
end entity {{ prefix }}efsat_arty_a7_clock;

architecture rtl of {{ prefix }}efsat_arty_a7_clock is
  signal feedback : std_logic;
  signal made : std_logic;
begin
  mmcm : MMCME2_BASE
    generic map (
      CLKIN1_PERIOD => 10.0,
      CLKFBOUT_MULT_F => 10.0,
      CLKOUT0_DIVIDE_F => {{ divisor }}
    )
    port map (
      CLKIN1 => oscillator,
      CLKFBIN => feedback,
      CLKFBOUT => feedback,
      CLKOUT0 => made,
      LOCKED => locked,
      PWRDWN => '0',
      RST => '0'
    );

  buffer_of_clock : BUFG
    port map (
      I => made,
      O => clk
    );
end architecture rtl;
