-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Determinants from dot products (section 4 of docs/determinants.md):
--   plane_b(i) = v - (d_i0 + d_i1 + d_i2)
--   side_0(l) = -d_1l, side_1(l) = d_1l - d_2l + a_l - a_(l+1)
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity determinant_sums is
  port (
    clk     : in  std_logic;
    a       : in  signed_38_x3_t;  -- |.| <= 51539214336
    d       : in  signed_38_x3_x2_t;  -- |.| <= 51539214336
    v       : in  signed(37 downto 0);  -- |.| <= 51539214336
    plane_b : out signed_41_x2_t;  -- |.| <= 206156857344
    side0   : out signed_39_x3_t;  -- |.| <= 51539214336
    side1   : out signed_40_x3_t := zero_signed_40_x3  -- |.| <= 206156857344
  );
end entity determinant_sums;

architecture rtl of determinant_sums is
  signal plane_b_sum_sum_d1 : signed_39_x2_t := zero_signed_39_x2;  -- |.| <= 103078428672
  signal d0_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal d1_2_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal v_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal v_d2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal plane_b_sum_d1 : signed_40_x2_t := zero_signed_40_x2;  -- |.| <= 154617643008
  signal d0_d2 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal side1_difference_first_d1 : signed_39_x3_t := zero_signed_39_x3;  -- |.| <= 103078428672
  signal side1_difference_second_d1 : signed_39_x3_t := zero_signed_39_x3;  -- |.| <= 103078428672
  signal side1_i : signed_40_x3_t;  -- |.| <= 206156857344
begin
  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 1 loop
        plane_b_sum_sum_d1(k) <= resize(d(k)(0), 39) + resize(d(k)(1), 39);
      end loop;
      d0_d1 <= d(0);
      d1_2_d1 <= d(1)(2);
      v_d1 <= v;
      for k in 0 to 2 loop
        side1_difference_first_d1(k) <= resize(d(0)(k), 39) - resize(d(1)(k), 39);
        side1_difference_second_d1(k) <= resize(a(k), 39) - resize(a((k + 1) mod 3), 39);
      end loop;
    end if;
  end process clock_1;
  side1_i_each : for k in 0 to 2 generate
    side1_i(k) <= resize(side1_difference_first_d1(k), 40) + resize(side1_difference_second_d1(k), 40);
  end generate side1_i_each;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      v_d2 <= v_d1;
      plane_b_sum_d1(0) <= resize(plane_b_sum_sum_d1(0), 40) + resize(d0_d1(2), 40);
      plane_b_sum_d1(1) <= resize(plane_b_sum_sum_d1(1), 40) + resize(d1_2_d1, 40);
      d0_d2 <= d0_d1;
      side1 <= side1_i;
    end if;
  end process clock_2;
  plane_b_each : for k in 0 to 1 generate
    plane_b(k) <= resize(v_d2, 41) - resize(plane_b_sum_d1(k), 41);
  end generate plane_b_each;
  side0_each : for k in 0 to 2 generate
    side0(k) <= -resize(d0_d2(k), 39);
  end generate side0_each;
end architecture rtl;
