--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Stand-in for the PLL of {{ board }}, for simulation: the clock of the oscillator passes through, so a simulation
-- drives that pin with the clock of the design.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

entity {{ prefix }}efsat_{{ board }}_clock is
  port (
    oscillator : in std_logic;
    clk : out std_logic;
    locked : out std_logic
  );
end entity {{ prefix }}efsat_{{ board }}_clock;

architecture stand_in of {{ prefix }}efsat_{{ board }}_clock is
begin
  clk <= oscillator;
  locked <= '1';
end architecture stand_in;
