-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- What x was tap + 1 clocks before, up to 16: a shift register for each bit, which is one look-up
-- table (SRL16). Takes the place of registers for several values and of the multiplexer behind them.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity tapped_line_18 is
  port (
    clk : in  std_logic;
    x   : in  signed(17 downto 0);
    tap : in  unsigned(3 downto 0);
    y   : out signed(17 downto 0)
  );
end entity tapped_line_18;

architecture rtl of tapped_line_18 is
  type tapped_line_t is array (0 to 15) of signed(17 downto 0);
  signal tapped_line : tapped_line_t := (others => (others => '0'));  -- element i: i + 1 clocks ago
  signal tapped : signed(17 downto 0);
begin
  -- Delay lines
  shift_tapped : process (clk)
  begin
    if rising_edge(clk) then
      tapped_line <= x & tapped_line(0 to 14);
    end if;
  end process shift_tapped;
  tapped <= tapped_line(to_integer(known(tap)));

  -- Outputs
  y <= tapped;
end architecture rtl;
