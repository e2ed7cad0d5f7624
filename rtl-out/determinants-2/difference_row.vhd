-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One row of M times one vertex: the sum of (2 m + 1) (2 w + 1), the middles of both, rounded to the input format
-- (section 2 of docs/determinants.md):
-- three products of two factors, cut at bit 13; low times low is left out, its middle added
-- Latency: 4 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity difference_row is
  port (
    clk    : in  std_logic;
    m      : in  signed_32_vector_t;  -- |.| <= 268435456
    w      : in  signed_32_vector_t;  -- |.| <= 268435456
    turned : out signed(31 downto 0)  -- |.| <= 805306372
  );
end entity difference_row;

architecture rtl of difference_row is
  signal m_middle : signed_31_vector_t;  -- |.| <= 536870913
  signal w_middle : signed_31_vector_t;  -- |.| <= 536870913
  signal high_high_x : signed_18_vector_t;  -- |.| <= 65536
  signal high_high_y : signed_18_vector_t;  -- |.| <= 65536
  signal high_high : signed_36_vector_t;  -- |.| <= 4294967296
  signal high_low_result_first_x : signed_18_vector_t;  -- |.| <= 65536
  signal high_low_result_first_y : signed_18_vector_t;  -- |.| <= 8191
  signal high_low_result_first : signed_36_vector_t;  -- |.| <= 536805376
  signal high_low_result_second_x : signed_18_vector_t;  -- |.| <= 8191
  signal high_low_result_second_y : signed_18_vector_t;  -- |.| <= 65536
  signal high_low_result_second : signed_36_vector_t;  -- |.| <= 536805376
  signal high_low : signed_37_vector_t;  -- |.| <= 1073610752
  signal high_low_d1 : signed_37_vector_t := zero_signed_37_vector;  -- |.| <= 1073610752
  signal mixed_sum_first_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 2147221504
  signal mixed_sum_second_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 1073688576
  signal mixed : signed(38 downto 0);  -- |.| <= 3220910080
  signal high_sum_d1 : signed(36 downto 0) := (others => '0');  -- |.| <= 8589934592
  signal high_high_z_d1 : signed(35 downto 0) := (others => '0');  -- |.| <= 4294967296
  signal high : signed(37 downto 0);  -- |.| <= 12884901888
  signal high_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 12884901888
  signal high_d2 : signed(37 downto 0) := (others => '0');  -- |.| <= 12884901888
  signal sum_floor_13_d1 : signed(25 downto 0) := (others => '0');  -- |.| <= 393177
  signal sum : signed(38 downto 0);  -- |.| <= 12885295065
begin
  -- Clock 0
  m_middle_each : for i in 0 to 2 generate
    m_middle(i) <= m(i)(29 downto 0) & '1';
    w_middle(i) <= w(i)(29 downto 0) & '1';
    high_high_x(i) <= m_middle(i)(30 downto 13);
    high_high_y(i) <= w_middle(i)(30 downto 13);
    high_low_result_first_x(i) <= m_middle(i)(30 downto 13);
    high_low_result_first_y(i) <= signed(resize(unsigned(w_middle(i)(12 downto 0)), 18));
    high_low_result_second_x(i) <= signed(resize(unsigned(m_middle(i)(12 downto 0)), 18));
    high_low_result_second_y(i) <= w_middle(i)(30 downto 13);
  end generate m_middle_each;
  high_high_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => high_high_x(i), y => high_high_y(i), p => high_high(i));
  end generate high_high_unit;
  high_low_result_first_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => high_low_result_first_x(i), y => high_low_result_first_y(i),
                p => high_low_result_first(i));
  end generate high_low_result_first_unit;
  high_low_result_second_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => high_low_result_second_x(i), y => high_low_result_second_y(i),
                p => high_low_result_second(i));
  end generate high_low_result_second_unit;

  -- Clock 1
  high_low_each : for i in 0 to 2 generate
    high_low(i) <= resize(high_low_result_first(i), 37) + resize(high_low_result_second(i), 37);
  end generate high_low_each;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      high_low_d1 <= high_low;
      high_sum_d1 <= resize(high_high(0), 37) + resize(high_high(1), 37);
      high_high_z_d1 <= high_high(2);
    end if;
  end process clock_2;
  high <= resize(high_sum_d1, 38) + resize(high_high_z_d1, 38);

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      mixed_sum_first_d1 <= resize(high_low_d1(0), 38) + resize(high_low_d1(1), 38);
      mixed_sum_second_d1 <= resize(high_low_d1(2), 38) + 77824;
      high_d1 <= high;
    end if;
  end process clock_3;
  mixed <= resize(mixed_sum_first_d1, 39) + resize(mixed_sum_second_d1, 39);

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      high_d2 <= high_d1;
      sum_floor_13_d1 <= mixed(38 downto 13);
    end if;
  end process clock_4;
  sum <= resize(high_d2, 39) + resize(sum_floor_13_d1, 39);
  turned <= sum(35 downto 4);
end architecture rtl;
