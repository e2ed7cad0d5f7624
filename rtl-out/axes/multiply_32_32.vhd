-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- p = x * y, exact, from partial products. The operands are cut into parts of 17 unsigned bits and a signed top part;
-- each two parts have a multiplier, except two short top parts, which are multiplied in look-up tables. Partial
-- products that do not overlap are concatenated instead of added.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity multiply_32_32 is
  port (
    clk : in  std_logic;
    x   : in  signed(31 downto 0);  -- |.| <= 268435456
    y   : in  signed(31 downto 0);  -- |.| <= 268435456
    p   : out signed(63 downto 0)  -- |.| <= 72057594037927936
  );
end entity multiply_32_32;

architecture rtl of multiply_32_32 is
  signal x_low_resized : signed(17 downto 0);  -- |.| <= 131071
  signal x_floor_17 : signed(14 downto 0);  -- |.| <= 2048
  signal y_low_resized : signed(17 downto 0);  -- |.| <= 131071
  signal y_floor_17 : signed(14 downto 0);  -- |.| <= 2048
  signal part_01_y : signed(17 downto 0);  -- |.| <= 2048
  signal part_01 : signed(35 downto 0);  -- |.| <= 268433408
  signal part_00 : signed(35 downto 0);  -- |.| <= 17179607041
  signal part_11_x : signed(17 downto 0);  -- |.| <= 2048
  signal part_11_y : signed(17 downto 0);  -- |.| <= 2048
  signal part_11 : signed(35 downto 0);  -- |.| <= 4194304
  signal diagonal_0 : signed(63 downto 0);  -- |.| <= 72057611217534977
  signal part_10_x : signed(17 downto 0);  -- |.| <= 2048
  signal part_10 : signed(35 downto 0);  -- |.| <= 268433408
  signal above_0_floor_17_d1 : signed(46 downto 0) := (others => '0');  -- |.| <= 549755944958
  signal above_0_sum_d1 : signed(32 downto 0) := (others => '0');  -- |.| <= 536866816
  signal above_0 : signed(47 downto 0);  -- |.| <= 550292811774
  signal p_word_low_d1 : unsigned(16 downto 0) := (others => '0');
  signal p_word : signed(64 downto 0);  -- |.| <= 72057594037927936
begin
  -- Clock 0
  x_low_resized <= signed(resize(unsigned(x(16 downto 0)), 18));
  x_floor_17 <= x(31 downto 17);
  y_low_resized <= signed(resize(unsigned(y(16 downto 0)), 18));
  y_floor_17 <= y(31 downto 17);
  part_01_y <= resize(y_floor_17, 18);
  part_11_x <= resize(x_floor_17, 18);
  part_11_y <= resize(y_floor_17, 18);
  part_10_x <= resize(x_floor_17, 18);
  part_01_unit : entity work.multiply_18_18
    port map (clk => clk, x => x_low_resized, y => part_01_y, p => part_01);
  part_00_unit : entity work.multiply_18_18
    port map (clk => clk, x => x_low_resized, y => y_low_resized, p => part_00);
  part_11_unit : entity work.multiply_18_18
    port map (clk => clk, x => part_11_x, y => part_11_y, p => part_11);
  part_10_unit : entity work.multiply_18_18
    port map (clk => clk, x => part_10_x, y => y_low_resized, p => part_10);

  -- Clock 1
  diagonal_0 <= part_11(29 downto 0) & signed(unsigned(part_00(33 downto 0)));

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      above_0_floor_17_d1 <= diagonal_0(63 downto 17);
      above_0_sum_d1 <= resize(part_10(31 downto 0), 33) + resize(part_01(31 downto 0), 33);
      p_word_low_d1 <= unsigned(diagonal_0(16 downto 0));
    end if;
  end process clock_2;
  above_0 <= resize(above_0_floor_17_d1, 48) + resize(above_0_sum_d1, 48);
  p_word <= above_0 & signed(p_word_low_d1);
  p <= p_word(63 downto 0);
end architecture rtl;
