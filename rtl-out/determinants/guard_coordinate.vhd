-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The guard of an input number (section 10 of the contract): outside its declared range it is flagged, and its low
-- bits alone go on, a number inside. Whatever the word is, all formats behind hold what is computed from it.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity guard_coordinate is
  port (
    clk     : in  std_logic;
    number  : in  signed(31 downto 0);  -- s4.28; |.| <= 2147483648
    passed  : out signed(31 downto 0);  -- s4.28; |.| <= 268435456; within +-268435456 whatever the word is: lemma guard
    outside : out std_logic
  );
end entity guard_coordinate;

architecture rtl of guard_coordinate is
  signal high : signed(3 downto 0);  -- s4.0; |.| <= 8
  signal above : std_logic;  -- word > 268435456, by less than 268435456
  signal below : std_logic;  -- word < -268435456, by at most 268435456
  signal top : signed(2 downto 0);  -- s4.-1; |.| <= 4
  signal far : std_logic;  -- farther outside than that
  signal outside_i : std_logic;
  signal number_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 2147483648
  signal outside_d1 : std_logic := '0';
begin
  -- Clock 0
  high <= number(31 downto 28);
  above <= flag(known(high) = 1) and or_reduce(unsigned(number(27 downto 0)));
  below <= flag(known(high) = to_signed(-2, 4));
  top <= high(3 downto 1);
  far <= not (flag(known(top) = to_signed(-1, 3)) or flag(known(top) = 0));
  outside_i <= above or below or far;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      number_d1 <= number;
      outside_d1 <= outside_i;
    end if;
  end process clock_1;
  passed <= signed(resize(unsigned(number_d1(27 downto 0)), 32)) when outside_d1 = '1' else number_d1;

  -- Outputs
  outside <= outside_d1;
end architecture rtl;
