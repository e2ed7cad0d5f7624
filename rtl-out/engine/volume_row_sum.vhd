-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The sum of a row: l0 b[j0] + l1 b[j1] + l2 b[j2] + rest, exact. Added to it is what makes a ceiling of the floor
-- that follows.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_row_sum is
  port (
    clk     : in  std_logic;
    codes   : in  signed_10_x3_t;  -- |.| <= 511
    factors : in  unsigned_12_x3_t;
    rest    : in  unsigned(12 downto 0);
    ceiling : in  unsigned(10 downto 0);
    s       : out signed(23 downto 0)  -- |.| <= 6287873
  );
end entity volume_row_sum;

architecture rtl of volume_row_sum is
  signal product_y : signed_13_x3_t;  -- |.| <= 4095
  signal product : signed_23_x3_t;  -- |.| <= 2092545
  signal more : unsigned(13 downto 0);
  signal more_d1 : unsigned(13 downto 0) := (others => '0');
  signal s_sum_first_d1 : signed(23 downto 0) := (others => '0');  -- |.| <= 4185090
  signal s_sum_second_d1 : signed(23 downto 0) := (others => '0');  -- |.| <= 2102783
begin
  -- Clock 0
  product_y_each : for k in 0 to 2 generate
    product_y(k) <= signed(resize(factors(k), 13));
  end generate product_y_each;
  more <= resize(rest, 14) + resize(ceiling, 14);
  product_unit : for k in 0 to 2 generate
    unit : entity work.volume_multiply_10_13
      port map (clk => clk, x => codes(k), y => product_y(k), p => product(k));
  end generate product_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      more_d1 <= more;
    end if;
  end process clock_1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      s_sum_first_d1 <= resize(product(0), 24) + resize(product(1), 24);
      s_sum_second_d1 <= resize(product(2), 24) + signed(resize(more_d1, 24));
    end if;
  end process clock_2;
  s <= s_sum_first_d1 + s_sum_second_d1;
end architecture rtl;
