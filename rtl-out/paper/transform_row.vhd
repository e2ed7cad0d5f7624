-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One row of the frame transform, b = m . x + t (section 3 of the contract), exact, then rounded outward once.
-- With bypass m and t are exact and nothing is rounded.
--
-- A bound is a lower bound plus none or one unit in the last place (m_ulp, x_ulp), so one product serves both ends:
--   lo = sum of m x + (m if m < 0 and x_ulp) + (x if x < 0 and m_ulp) + (1 if both)
--   hi = sum of m x + (m if m >= 0 and x_ulp) + (x if x >= 0 and m_ulp) + (1 if both), and what t is above its bound
-- Latency: 6 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity transform_row is
  port (
    clk    : in  std_logic;
    m      : in  signed_32_vector_t;  -- |.| <= 268435456
    x      : in  signed_32_vector_t;  -- |.| <= 268435456
    t      : in  signed(31 downto 0);  -- s4.28; |.| <= 1073741816
    bypass : in  std_logic;
    b      : out interval_32_t  -- s4.28; |.| <= 1879048192
  );
end entity transform_row;

architecture rtl of transform_row is
  signal product : signed_64_vector_t;  -- s8.56; |.| <= 72057594037927936
  signal product_d1 : signed_64_vector_t := zero_signed_64_vector;  -- s8.56; |.| <= 72057594037927936
  signal sum_xy : signed(64 downto 0);  -- s9.56; |.| <= 144115188075855872
  type t_line_t is array (1 to 3) of signed(31 downto 0);
  signal t_line : t_line_t := (others => (others => '0'));  -- s4.28; |.| <= 1073741816
  signal sum_zt : signed(64 downto 0);  -- s9.56; |.| <= 360287968042156032
  signal sum_xy_d1 : signed(64 downto 0) := (others => '0');  -- s9.56; |.| <= 144115188075855872
  signal sum_zt_d1 : signed(64 downto 0) := (others => '0');  -- s9.56; |.| <= 360287968042156032
  signal sum : signed(65 downto 0);  -- s10.56; |.| <= 504403156118011904
  signal lo_takes_m : std_logic_vector(2 downto 0);
  signal lo_takes_x : std_logic_vector(2 downto 0);
  signal lo_term_floor_1_sum : signed_34_vector_t;  -- |.| <= 1073741826
  signal lo_term : signed_33_vector_t;  -- s5.28; |.| <= 536870913
  signal lo_term_d1 : signed_33_vector_t := zero_signed_33_vector;  -- s5.28; |.| <= 536870913
  signal lo_terms_sum_sum_d1 : signed(33 downto 0) := (others => '0');  -- s6.28; |.| <= 1073741826
  signal lo_term_z_d2 : signed(32 downto 0) := (others => '0');  -- s5.28; |.| <= 536870913
  signal lo_terms : signed(34 downto 0);  -- s-21.56; |.| <= 1610612739
  signal sum_d1 : signed(65 downto 0) := (others => '0');  -- s10.56; |.| <= 504403156118011904
  type lo_terms_line_t is array (1 to 3) of signed(34 downto 0);
  signal lo_terms_line : lo_terms_line_t := (others => (others => '0'));  -- s-21.56; |.| <= 1610612739
  signal lo_exact : signed(66 downto 0);  -- s11.56; |.| <= 504403157728624643
  signal hi_takes_m : std_logic_vector(2 downto 0);
  signal hi_takes_x : std_logic_vector(2 downto 0);
  signal hi_term_floor_1_sum : signed_34_vector_t;  -- |.| <= 1073741826
  signal hi_term : signed_33_vector_t;  -- s5.28; |.| <= 536870913
  signal hi_term_d1 : signed_33_vector_t := zero_signed_33_vector;  -- s5.28; |.| <= 536870913
  signal hi_terms_sum_sum_d1 : signed(33 downto 0) := (others => '0');  -- s6.28; |.| <= 1073741826
  signal hi_term_z_d2 : signed(32 downto 0) := (others => '0');  -- s5.28; |.| <= 536870913
  signal hi_terms : signed(34 downto 0);  -- s-21.56; |.| <= 1610612739
  type hi_terms_line_t is array (1 to 3) of signed(34 downto 0);
  signal hi_terms_line : hi_terms_line_t := (others => (others => '0'));  -- s-21.56; |.| <= 1610612739
  signal hi_exact : signed(66 downto 0);  -- s11.56; |.| <= 504403157728624643
  signal b_hi_aligned_not_line : std_logic_vector(1 to 6) := (others => '0');
  signal b_floor_28_d1 : interval_39_t := zero_interval_39;  -- s11.28; |.| <= 1879048190
begin
  -- Clock 0
  lo_takes_m_each : for i in 0 to 2 generate
    lo_takes_m(i) <= m(i)(31);
    lo_takes_x(i) <= x(i)(31) and not bypass;
    lo_term_floor_1_sum(i) <= resize(choose(lo_takes_m(i), m(i), to_signed(0, 32)) & '1', 34) +
        resize(choose(lo_takes_x(i), x(i), to_signed(0, 32)) & (lo_takes_m(i) and lo_takes_x(i)), 34);
    lo_term(i) <= lo_term_floor_1_sum(i)(33 downto 1);
    hi_takes_m(i) <= not m(i)(31);
    hi_takes_x(i) <= not x(i)(31) and not bypass;
    hi_term_floor_1_sum(i) <= resize(choose(hi_takes_m(i), m(i), to_signed(0, 32)) & '1', 34) +
        resize(choose(hi_takes_x(i), x(i), to_signed(0, 32)) & (hi_takes_m(i) and hi_takes_x(i)), 34);
    hi_term(i) <= hi_term_floor_1_sum(i)(33 downto 1);
  end generate lo_takes_m_each;
  product_result_unit : for i in 0 to 2 generate
    unit : entity work.multiply_32_32
      port map (clk => clk, x => m(i), y => x(i), p => product(i));
  end generate product_result_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      lo_term_d1 <= lo_term;
      hi_term_d1 <= hi_term;
    end if;
  end process clock_1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      lo_terms_sum_sum_d1 <= resize(lo_term_d1(0), 34) + resize(lo_term_d1(1), 34);
      lo_term_z_d2 <= lo_term_d1(2);
      hi_terms_sum_sum_d1 <= resize(hi_term_d1(0), 34) + resize(hi_term_d1(1), 34);
      hi_term_z_d2 <= hi_term_d1(2);
    end if;
  end process clock_2;
  lo_terms <= resize(lo_terms_sum_sum_d1, 35) + resize(lo_term_z_d2, 35);
  hi_terms <= resize(hi_terms_sum_sum_d1, 35) + resize(hi_term_z_d2, 35);

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      product_d1 <= product;
    end if;
  end process clock_3;
  sum_xy <= resize(product_d1(0), 65) + resize(product_d1(1), 65);
  sum_zt <= resize(product_d1(2), 65) + resize(append(t_line(3), 28), 65);

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      sum_xy_d1 <= sum_xy;
      sum_zt_d1 <= sum_zt;
    end if;
  end process clock_4;
  sum <= resize(sum_xy_d1, 66) + resize(sum_zt_d1, 66);

  -- Clock 5
  clock_5 : process (clk)
  begin
    if rising_edge(clk) then
      sum_d1 <= sum;
    end if;
  end process clock_5;
  lo_exact <= resize(sum_d1, 67) + resize(lo_terms_line(3), 67);
  hi_exact <= resize(sum_d1, 67) + resize(hi_terms_line(3), 67);

  -- Clock 6
  clock_6 : process (clk)
  begin
    if rising_edge(clk) then
      b_floor_28_d1.lo <= lo_exact(66 downto 28);
      b_floor_28_d1.hi <= hi_exact(66 downto 28);
    end if;
  end process clock_6;
  b.lo <= b_floor_28_d1.lo(31 downto 0);
  b.hi <= b_floor_28_d1.hi(31 downto 0) + signed(resize(shift_left(to_unsigned(b_hi_aligned_not_line(6), 2), 1), 32));

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      t_line <= t & t_line(1 to 2);
      lo_terms_line <= lo_terms & lo_terms_line(1 to 2);
      hi_terms_line <= hi_terms & hi_terms_line(1 to 2);
      b_hi_aligned_not_line <= not bypass & b_hi_aligned_not_line(1 to 5);
    end if;
  end process delays;
end architecture rtl;
