--------------------------------------------------------------------------------
-- One row of the frame transform, b = m . x + t (section 3 of the contract), exact, then rounded outward once.
-- With bypass m and t are exact and nothing is rounded.
--
-- A bound is a lower bound plus none or one unit in the last place (m_ulp, x_ulp), so one product serves both ends:
--   lo = sum of m x + (m if m < 0 and x_ulp) + (x if x < 0 and m_ulp) + (1 if both)
--   hi = sum of m x + (m if m >= 0 and x_ulp) + (x if x >= 0 and m_ulp) + (1 if both)
-- Latency: 7 clocks.
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
  signal lo_term_sum_d1 : signed_33_vector_t := zero_signed_33_vector;  -- s5.28; |.| <= 536870912
  signal lo_term_and_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal lo_term : signed_34_vector_t;  -- s6.28; |.| <= 536870913
  signal lo_term_d1 : signed_34_vector_t := zero_signed_34_vector;  -- s6.28; |.| <= 536870913
  signal lo_terms_sum_sum_d1 : signed(34 downto 0) := (others => '0');  -- s7.28; |.| <= 1073741826
  signal lo_term_z_d2 : signed(33 downto 0) := (others => '0');  -- s6.28; |.| <= 536870913
  signal lo_terms : signed(35 downto 0);  -- s-20.56; |.| <= 1610612739
  signal sum_d1 : signed(65 downto 0) := (others => '0');  -- s10.56; |.| <= 504403156118011904
  signal lo_terms_d1 : signed(35 downto 0) := (others => '0');  -- s-20.56; |.| <= 1610612739
  signal lo_terms_d2 : signed(35 downto 0) := (others => '0');  -- s-20.56; |.| <= 1610612739
  signal lo_exact : signed(66 downto 0);  -- s11.56; |.| <= 504403157728624643
  signal bypass_line : std_logic_vector(1 to 5) := (others => '0');
  signal hi_takes_m : std_logic_vector(2 downto 0);
  signal hi_takes_x : std_logic_vector(2 downto 0);
  signal hi_term_sum_d1 : signed_33_vector_t := zero_signed_33_vector;  -- s5.28; |.| <= 536870912
  signal hi_term_and_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal hi_term : signed_34_vector_t;  -- s6.28; |.| <= 536870913
  signal hi_term_d1 : signed_34_vector_t := zero_signed_34_vector;  -- s6.28; |.| <= 536870913
  signal hi_terms_sum_sum_d1 : signed(34 downto 0) := (others => '0');  -- s7.28; |.| <= 1073741826
  signal hi_term_z_d2 : signed(33 downto 0) := (others => '0');  -- s6.28; |.| <= 536870913
  signal hi_terms : signed(35 downto 0);  -- s-20.56; |.| <= 1610612739
  signal hi_exact_sum_d1 : signed(66 downto 0) := (others => '0');  -- s11.56; |.| <= 504403156386447360
  type hi_terms_line_t is array (1 to 3) of signed(35 downto 0);
  signal hi_terms_line : hi_terms_line_t := (others => (others => '0'));  -- s-20.56; |.| <= 1610612739
  signal hi_exact : signed(67 downto 0);  -- s12.56; |.| <= 504403157997060099
  signal lo_exact_d1 : signed(66 downto 0) := (others => '0');  -- s11.56; |.| <= 504403157728624643
  signal b_floor_28_d1 : interval_39_t := zero_interval_39;  -- s11.28; |.| <= 1879048191
  signal b_hi_not_d1 : std_logic := '0';
  signal b_hi_not_d2 : std_logic := '0';
begin
  -- Clock 0
  lo_takes_m_each : for i in 0 to 2 generate
    lo_takes_m(i) <= m(i)(31);
    lo_takes_x(i) <= x(i)(31) and not bypass;
    hi_takes_m(i) <= not m(i)(31);
    hi_takes_x(i) <= not x(i)(31) and not bypass;
  end generate lo_takes_m_each;
  product_result_unit : for i in 0 to 2 generate
    unit : entity work.multiply_32_32
      port map (clk => clk, x => m(i), y => x(i), p => product(i));
  end generate product_result_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        lo_term_sum_d1(i) <= resize(choose(lo_takes_m(i), m(i), to_signed(0, 32)), 33) +
            resize(choose(lo_takes_x(i), x(i), to_signed(0, 32)), 33);
        lo_term_and_d1(i) <= lo_takes_m(i) and lo_takes_x(i);
        hi_term_sum_d1(i) <= resize(choose(hi_takes_m(i), m(i), to_signed(0, 32)), 33) +
            resize(choose(hi_takes_x(i), x(i), to_signed(0, 32)), 33);
        hi_term_and_d1(i) <= hi_takes_m(i) and hi_takes_x(i);
      end loop;
    end if;
  end process clock_1;
  lo_term_each : for i in 0 to 2 generate
    lo_term(i) <= resize(lo_term_sum_d1(i), 34) + to_signed(lo_term_and_d1(i), 34);
    hi_term(i) <= resize(hi_term_sum_d1(i), 34) + to_signed(hi_term_and_d1(i), 34);
  end generate lo_term_each;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      lo_term_d1 <= lo_term;
      hi_term_d1 <= hi_term;
    end if;
  end process clock_2;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      product_d1 <= product;
      lo_terms_sum_sum_d1 <= resize(lo_term_d1(0), 35) + resize(lo_term_d1(1), 35);
      lo_term_z_d2 <= lo_term_d1(2);
      hi_terms_sum_sum_d1 <= resize(hi_term_d1(0), 35) + resize(hi_term_d1(1), 35);
      hi_term_z_d2 <= hi_term_d1(2);
    end if;
  end process clock_3;
  sum_xy <= resize(product_d1(0), 65) + resize(product_d1(1), 65);
  sum_zt <= resize(product_d1(2), 65) + resize(append(t_line(3), 28), 65);
  lo_terms <= resize(lo_terms_sum_sum_d1, 36) + resize(lo_term_z_d2, 36);
  hi_terms <= resize(hi_terms_sum_sum_d1, 36) + resize(hi_term_z_d2, 36);

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      sum_xy_d1 <= sum_xy;
      sum_zt_d1 <= sum_zt;
      lo_terms_d1 <= lo_terms;
    end if;
  end process clock_4;
  sum <= resize(sum_xy_d1, 66) + resize(sum_zt_d1, 66);

  -- Clock 5
  clock_5 : process (clk)
  begin
    if rising_edge(clk) then
      sum_d1 <= sum;
      lo_terms_d2 <= lo_terms_d1;
    end if;
  end process clock_5;
  lo_exact <= resize(sum_d1, 67) + resize(lo_terms_d2, 67);

  -- Clock 6
  clock_6 : process (clk)
  begin
    if rising_edge(clk) then
      hi_exact_sum_d1 <= resize(sum_d1, 67) + signed(resize(shift_left(to_unsigned(not bypass_line(5), 29), 28), 67));
      lo_exact_d1 <= lo_exact;
      b_hi_not_d1 <= not bypass_line(5);
    end if;
  end process clock_6;
  hi_exact <= resize(hi_exact_sum_d1, 68) + resize(hi_terms_line(3), 68);

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      b_floor_28_d1.lo <= lo_exact_d1(66 downto 28);
      b_floor_28_d1.hi <= hi_exact(67 downto 28);
      b_hi_not_d2 <= b_hi_not_d1;
    end if;
  end process clock_7;
  b.lo <= b_floor_28_d1.lo(31 downto 0);
  b.hi <= b_floor_28_d1.hi(31 downto 0) + to_signed(b_hi_not_d2, 32);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      t_line <= t & t_line(1 to 2);
      bypass_line <= bypass & bypass_line(1 to 4);
      hi_terms_line <= hi_terms & hi_terms_line(1 to 2);
    end if;
  end process delays;
end architecture rtl;
