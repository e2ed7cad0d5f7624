-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- How far the five differences along a coordinate axis go left: by the leading zeros that they have in common, but by
-- no more than leaves the least number of bits to drop. A flag for each step of the shift.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity coordinate_shift is
  port (
    clk   : in  std_logic;
    x     : in  signed_33_x5_t;  -- |.| <= 2147483644
    shift : out std_logic_vector(3 downto 0)
  );
end entity coordinate_shift;

architecture rtl of coordinate_shift is
  signal x_low : unsigned_31_x5_t;
  signal magnitude : unsigned_31_x5_t;
  signal magnitude0_or_or_or_or_d1 : unsigned(30 downto 0) := (others => '0');
  signal shift_i : std_logic_vector(3 downto 0);
  signal word_0 : unsigned(30 downto 0);
  signal word_0_d1 : unsigned(30 downto 0) := (others => '0');
  signal shift_d1 : std_logic_vector(1 downto 0) := (others => '0');
  signal word_1 : unsigned(30 downto 0);
  signal word_2 : unsigned(30 downto 0);
begin
  -- Clock 0
  x_low_each : for k in 0 to 4 generate
    x_low(k) <= unsigned(x(k)(30 downto 0));
    magnitude(k) <= not x_low(k) when x(k)(32) = '1' else x_low(k);
  end generate x_low_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      magnitude0_or_or_or_or_d1 <= magnitude(0) or magnitude(1) or magnitude(2) or magnitude(3) or magnitude(4);
    end if;
  end process clock_1;
  shift_i(0) <= not or_reduce(magnitude0_or_or_or_or_d1(30 downto 24));
  shift_i(1) <= not or_reduce(word_0(30 downto 27));
  word_0 <= shift_left(magnitude0_or_or_or_or_d1, 7) when shift_i(0) = '1' else magnitude0_or_or_or_or_d1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      word_0_d1 <= word_0;
      for k in 0 to 1 loop
        shift_d1(k) <= shift_i(k);
      end loop;
    end if;
  end process clock_2;
  shift_i(2) <= not or_reduce(word_1(30 downto 29));
  shift_i(3) <= not word_2(30);
  word_1 <= shift_left(word_0_d1, 4) when shift_d1(1) = '1' else word_0_d1;
  word_2 <= shift_left(word_1, 2) when shift_i(2) = '1' else word_1;

  -- Outputs
  shift(0) <= shift_d1(0);
  shift(1) <= shift_d1(1);
  shift(2) <= shift_i(2);
  shift(3) <= shift_i(3);
end architecture rtl;
