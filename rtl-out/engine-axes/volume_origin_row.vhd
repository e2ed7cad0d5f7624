-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One component of D, where the origin of B's block is from the origin of A's, in A's frame:
--   d = floor(m . o_b) + t - o_a
-- m is a row of the matrix, the products are exact, and their sum is rounded down to the common grid.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_origin_row is
  port (
    clk : in  std_logic;
    m   : in  signed_18_vector_t;  -- |.| <= 131071
    t   : in  signed(25 downto 0);  -- s4.22; |.| <= 16777216
    o_b : in  signed_18_vector_t;  -- |.| <= 131072
    o_a : in  signed(17 downto 0);  -- s1.17; |.| <= 131072
    d   : out signed(25 downto 0)  -- s4.22; |.| <= 33554336
  );
end entity volume_origin_row;

architecture rtl of volume_origin_row is
  signal product : signed_36_vector_t;  -- s2.34; |.| <= 17179738112
  signal sum_sum_d1 : signed(36 downto 0) := (others => '0');  -- s3.34; |.| <= 34359476224
  signal product_z_d1 : signed(35 downto 0) := (others => '0');  -- s2.34; |.| <= 17179738112
  signal sum : signed(37 downto 0);  -- s4.34; |.| <= 51539214336
  signal from_a : signed(26 downto 0);  -- s5.22; |.| <= 20971520; t - o_a
  signal from_a_d1 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 20971520
  signal from_a_d2 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 20971520
begin
  -- Clock 0
  from_a <= resize(t, 27) - resize(append(o_a, 5), 27);
  product_result_unit : for i in 0 to 2 generate
    unit : entity work.volume_multiply_18_18
      port map (clk => clk, x => m(i), y => o_b(i), p => product(i));
  end generate product_result_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      from_a_d1 <= from_a;
    end if;
  end process clock_1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      sum_sum_d1 <= resize(product(0), 37) + resize(product(1), 37);
      product_z_d1 <= product(2);
      from_a_d2 <= from_a_d1;
    end if;
  end process clock_2;
  sum <= resize(sum_sum_d1, 38) + resize(product_z_d1, 38);
  d <= sum(37 downto 12) + from_a_d2(25 downto 0);
end architecture rtl;
