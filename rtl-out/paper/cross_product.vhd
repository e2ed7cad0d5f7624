-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One separating axis, l = e x f in interval arithmetic (equation 1).
-- Component i is e_j f_k - e_k f_j, rounded outward once.
--
--   axis         e       f       l       |l| <=     rounding
--   n_a          s2.16   s2.16   s3.15   65539      17 bits dropped
--   n_b          s3.15   s3.15   s4.14   65536      16 bits dropped, within +-65536: lemma triangle-area
--   c_00 to c_02 s2.16   s3.15   s4.14   65539      17 bits dropped
--   c_10 to c_12 s3.15   s3.15   s5.13   65539      17 bits dropped
--   c_20 to c_22 s2.16   s3.15   s4.14   65539      17 bits dropped
-- Latency: 4 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity cross_product is
  port (
    clk      : in  std_logic;
    e        : in  interval_18_vector_t;  -- |.| <= 65537
    e_case   : in  unsigned_2_vector_t;
    f        : in  interval_18_vector_t;  -- |.| <= 65537
    f_case   : in  unsigned_2_vector_t;
    rounding : in  std_logic;
    l        : out interval_18_vector_t  -- |.| <= 65539
  );
end entity cross_product;

architecture rtl of cross_product is
  signal e_j_f_k : interval_36_vector_t;  -- |.| <= 4295098369
  signal e_k_f_j : interval_36_vector_t;  -- |.| <= 4295098369
  signal exact : interval_37_vector_t;  -- |.| <= 8590196738
  signal exact_d1 : interval_37_vector_t := zero_interval_37_vector;  -- |.| <= 8590196738
  signal l_hi_up_floor_17_d1 : signed_20_vector_t := zero_signed_20_vector;  -- |.| <= 65539
  signal l_hi_up : signed_21_vector_t;  -- |.| <= 65539
  signal exact_lo_floor_16 : signed_21_vector_t;  -- |.| <= 131077
  signal exact_hi_floor_16_up : signed_22_vector_t;  -- |.| <= 131077
  signal l_lo_saturated_raised_too_low_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal l_hi_saturated_raised_too_low_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal exact_lo_floor_16_d1 : signed_21_vector_t := zero_signed_21_vector;  -- |.| <= 131077
  signal l_lo_saturated_too_high_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal l_hi_saturated_too_high_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal l_saturated : interval_21_vector_t;  -- |.| <= 65536
  signal exact_hi_floor_16_up_d1 : signed_22_vector_t := zero_signed_22_vector;  -- |.| <= 131077
  signal rounding_line : std_logic_vector(1 to 4) := (others => '0');
  signal l_lo_floor_17_d1 : signed_20_vector_t := zero_signed_20_vector;  -- |.| <= 65539
begin
  -- Clock 0
  e_j_f_k_unit : for i in 0 to 2 generate
    unit : entity work.interval_multiply
      port map (clk => clk, x => e((i + 1) mod 3), x_case => e_case((i + 1) mod 3), y => f((i + 2) mod 3),
                y_case => f_case((i + 2) mod 3), p => e_j_f_k(i));
  end generate e_j_f_k_unit;
  e_k_f_j_unit : for i in 0 to 2 generate
    unit : entity work.interval_multiply
      port map (clk => clk, x => e((i + 2) mod 3), x_case => e_case((i + 2) mod 3), y => f((i + 1) mod 3),
                y_case => f_case((i + 1) mod 3), p => e_k_f_j(i));
  end generate e_k_f_j_unit;

  -- Clock 2
  exact_lo_each : for i in 0 to 2 generate
    exact(i).lo <= resize(e_j_f_k(i).lo, 37) - resize(e_k_f_j(i).hi, 37);
    exact(i).hi <= resize(e_j_f_k(i).hi, 37) - resize(e_k_f_j(i).lo, 37);
  end generate exact_lo_each;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      exact_d1 <= exact;
    end if;
  end process clock_3;
  exact_lo_floor_16_each : for i in 0 to 2 generate
    exact_lo_floor_16(i) <= exact_d1(i).lo(36 downto 16);
    exact_hi_floor_16_up(i) <= resize(exact_d1(i).hi(36 downto 16), 22) + 1;
  end generate exact_lo_floor_16_each;

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        l_hi_up_floor_17_d1(i) <= exact_d1(i).hi(36 downto 17);
        l_lo_saturated_raised_too_low_d1(i) <= less(exact_lo_floor_16(i), to_signed(-65536, 21));
        l_hi_saturated_raised_too_low_d1(i) <= less(exact_hi_floor_16_up(i), to_signed(-65536, 22));
      end loop;
      exact_lo_floor_16_d1 <= exact_lo_floor_16;
      for i in 0 to 2 loop
        l_lo_saturated_too_high_d1(i) <= less(to_signed(65536, 21), exact_lo_floor_16(i));
        l_hi_saturated_too_high_d1(i) <= less(to_signed(65536, 22), exact_hi_floor_16_up(i));
      end loop;
      exact_hi_floor_16_up_d1 <= exact_hi_floor_16_up;
      for i in 0 to 2 loop
        l_lo_floor_17_d1(i) <= exact_d1(i).lo(36 downto 17);
      end loop;
    end if;
  end process clock_4;
  l_hi_up_each : for i in 0 to 2 generate
    l_hi_up(i) <= resize(l_hi_up_floor_17_d1(i), 21) + 1;
    l_saturated(i).lo <= to_signed(65536, 21) when l_lo_saturated_too_high_d1(i) = '1' else to_signed(-65536, 21) when
        l_lo_saturated_raised_too_low_d1(i) = '1' else exact_lo_floor_16_d1(i);
    l_saturated(i).hi <= to_signed(65536, 22) when l_hi_saturated_too_high_d1(i) = '1' else to_signed(-65536, 22) when
        l_hi_saturated_raised_too_low_d1(i) = '1' else exact_hi_floor_16_up_d1(i);
    l(i).lo <= l_saturated(i).lo(17 downto 0) when rounding_line(4) = '1' else l_lo_floor_17_d1(i)(17 downto 0);
    l(i).hi <= l_saturated(i).hi(17 downto 0) when rounding_line(4) = '1' else l_hi_up(i)(17 downto 0);
  end generate l_hi_up_each;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      rounding_line <= rounding & rounding_line(1 to 3);
    end if;
  end process delays;
end architecture rtl;
