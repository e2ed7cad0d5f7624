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

entity guard_translation is
  port (
    clk     : in  std_logic;
    number  : in  signed(31 downto 0);  -- s4.28; |.| <= 2147483648
    passed  : out signed(31 downto 0);  -- s4.28; |.| <= 1073741816; within +-1073741816 whatever the word is: lemma guard
    outside : out std_logic
  );
end entity guard_translation;

architecture rtl of guard_translation is
  signal high : signed(28 downto 0);  -- s4.25; |.| <= 268435456
  signal above : std_logic;  -- word > 1073741816, by less than 8
  signal below : std_logic;  -- word < -1073741816, by at most 8
  signal top : signed(1 downto 0);  -- s4.-2; |.| <= 2
  signal far : std_logic;  -- farther outside than that
  signal outside_i : std_logic;
  signal number_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 2147483648
  signal outside_d1 : std_logic := '0';
begin
  -- Clock 0
  high <= number(31 downto 3);
  above <= flag(known(high) = 134217727) and or_reduce(unsigned(number(2 downto 0)));
  below <= flag(known(high) = to_signed(-134217728, 29));
  top <= high(28 downto 27);
  far <= flag(known(top) = to_signed(-2, 2)) or flag(known(top) = 1);
  outside_i <= above or below or far;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      number_d1 <= number;
      outside_d1 <= outside_i;
    end if;
  end process clock_1;
  passed <= signed(resize(unsigned(number_d1(28 downto 0)), 32)) when outside_d1 = '1' else number_d1;

  -- Outputs
  outside <= outside_d1;
end architecture rtl;
