-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Sides of edges from components c (section 5 of docs/exact.md), and the signs of the areas n and m_0 + m_1 + m_2:
--   W_l by the edges of A: x_1l, n + x_2l - x_1l, -x_2l
--   V_k by edge l of B: m_l, m_l + x_1l - x_1(l+1), m_l + x_2l - x_2(l+1)
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity plane_sums is
  port (
    clk       : in  std_logic;
    moment    : in  signed_36_x3_t;  -- |.| <= 34359214082
    n         : in  signed(35 downto 0);  -- |.| <= 34359214082
    x         : in  signed_36_x3_x2_t;  -- |.| <= 34359214082
    sides     : out signed_38_x3_x6_t;  -- |.| <= 103077642246
    area_sign : out flag_x2_x2_t
  );
end entity plane_sums;

architecture rtl of plane_sums is
  signal x_d1 : signed_36_x3_x2_t := zero_signed_36_x3_x2;  -- |.| <= 34359214082
  signal x0_d2 : signed_36_x3_t := zero_signed_36_x3;  -- |.| <= 34359214082
  signal sides_i : signed_38_x3_x6_t;  -- |.| <= 103077642246
  signal n_d1 : signed(35 downto 0) := (others => '0');  -- |.| <= 34359214082
  signal sides1_difference_d1 : signed_37_x3_t := zero_signed_37_x3;  -- |.| <= 68718428164
  signal sides_difference_d1 : signed_37_1_to_2_3_to_5_t := zero_signed_37_1_to_2_3_to_5;  -- |.| <= 68718428164
  signal sides2_negative_d1 : signed_37_x3_t := zero_signed_37_x3;  -- |.| <= 34359214082
  signal moment_d1 : signed_36_x3_t := zero_signed_36_x3;  -- |.| <= 34359214082
  signal moment_d2 : signed_36_x3_t := zero_signed_36_x3;  -- |.| <= 34359214082
  signal area : signed_38_x2_t;  -- |.| <= 103077642246
  signal area1_sum_d1 : signed(36 downto 0) := (others => '0');  -- |.| <= 68718428164
  signal area_sign_i : flag_x2_x2_t;
  signal area_sign0_d1 : std_logic_vector(1 downto 0) := (others => '0');
  signal area_sign1_1_d1 : std_logic := '0';
  signal area_sign1_0_not_second_equal_d1 : std_logic := '0';
  signal sides1_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 103077642246
  signal sides_d1 : signed_38_1_to_2_3_to_5_t := zero_signed_38_1_to_2_3_to_5;  -- |.| <= 103077642246
begin
  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      x_d1 <= x;
      n_d1 <= n;
      for k in 0 to 2 loop
        sides1_difference_d1(k) <= resize(x(1)(k), 37) - resize(x(0)(k), 37);
        for m in 0 to 1 loop
          sides_difference_d1(k + 3)(m + 1) <= resize(x(m)(k), 37) - resize(x(m)((k + 1) mod 3), 37);
        end loop;
      end loop;
      moment_d1 <= moment;
      area1_sum_d1 <= resize(moment(0), 37) + resize(moment(1), 37);
    end if;
  end process clock_1;
  sides_i_1_each : for m in 0 to 2 generate
    sides_i(1)(m) <= resize(n_d1, 38) + resize(sides1_difference_d1(m), 38);
  end generate sides_i_1_each;
  sides_i_from_3_1_each : for k in 0 to 2 generate
    sides_i(k + 3)(1) <= resize(moment_d1(k), 38) + resize(sides_difference_d1(k + 3)(1), 38);
    sides_i(k + 3)(2) <= resize(moment_d1(k), 38) + resize(sides_difference_d1(k + 3)(2), 38);
  end generate sides_i_from_3_1_each;
  area(0) <= resize(n_d1, 38);
  area(1) <= resize(area1_sum_d1, 38) + resize(moment_d1(2), 38);
  area_sign_i(0)(0) <= not area_sign_i(0)(1) and not flag(known(area(0)) = 0);
  area_sign_i(0)(1) <= area(0)(37);
  area_sign_i(1)(1) <= area(1)(37);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      x0_d2 <= x_d1(0);
      for k in 0 to 2 loop
        sides2_negative_d1(k) <= -resize(x_d1(1)(k), 37);
      end loop;
      moment_d2 <= moment_d1;
      area_sign0_d1 <= area_sign_i(0);
      area_sign1_1_d1 <= area_sign_i(1)(1);
      area_sign1_0_not_second_equal_d1 <= flag(known(area(1)) = 0);
      sides1_d1 <= sides_i(1);
      for k in 3 to 5 loop
        for m in 1 to 2 loop
          sides_d1(k)(m) <= sides_i(k)(m);
        end loop;
      end loop;
    end if;
  end process clock_2;
  sides_i_0_each : for m in 0 to 2 generate
    sides_i(0)(m) <= resize(x0_d2(m), 38);
    sides_i(2)(m) <= resize(sides2_negative_d1(m), 38);
  end generate sides_i_0_each;
  sides_i(3)(0) <= resize(moment_d2(0), 38);
  sides_i(4)(0) <= resize(moment_d2(1), 38);
  sides_i(5)(0) <= resize(moment_d2(2), 38);
  area_sign_i(1)(0) <= not area_sign1_1_d1 and not area_sign1_0_not_second_equal_d1;

  -- Outputs
  sides(0) <= sides_i(0);
  sides(1) <= sides1_d1;
  sides(2) <= sides_i(2);
  sides_0_each : for k in 3 to 5 generate
    sides(k)(0) <= sides_i(k)(0);
    sides(k)(1) <= sides_d1(k)(1);
    sides(k)(2) <= sides_d1(k)(2);
  end generate sides_0_each;
  area_sign(0) <= area_sign0_d1;
  area_sign(1)(0) <= area_sign_i(1)(0);
  area_sign(1)(1) <= area_sign1_1_d1;
end architecture rtl;
