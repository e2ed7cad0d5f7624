-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 4: the fifteen determinants, from ten dot products.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_determinants is
  port (
    clk              : in  std_logic;
    moment_m0        : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1        : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2        : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n         : in  signed_18_vector_t;  -- |.| <= 131072
    coordinate_w0_d6 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_d6 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_d6 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_d6 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_d6 : in  signed_18_vector_t;  -- |.| <= 131071
    compared         : out signed_41_x15_t  -- |.| <= 206156857344
  );
end entity pair_determinants;

architecture rtl of pair_determinants is
  signal dot_lane : signed_38_x10_t;  -- |.| <= 51539214336
  signal determinant_plane_a0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal determinant_plane_a1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_b0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side20 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side21 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side22 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_a2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side00 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side01 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side02 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side10 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side11 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side12 : signed(39 downto 0);  -- |.| <= 206156857344
  signal dot_lane_unit_x : signed_18_vector_x10_t;
  signal dot_lane_unit_m : signed_18_vector_x10_t;
  signal compared_unit_a : signed_38_x3_t;
  signal compared_unit_d : signed_38_x3_x2_t;
  signal compared_unit_plane_b : signed_41_x2_t;
  signal compared_unit_side0 : signed_39_x3_t;
  signal compared_unit_side1 : signed_40_x3_t;
begin
  -- Clock 19
  dot_lane_unit_x(0) <= coordinate_w0_d6;
  dot_lane_unit_x(1) <= coordinate_v1_d6;
  dot_lane_unit_x(2) <= coordinate_v1_d6;
  dot_lane_unit_x(3) <= coordinate_v1_d6;
  dot_lane_unit_x(4) <= coordinate_w1_d6;
  dot_lane_unit_x(5) <= coordinate_w0_d6;
  dot_lane_unit_x(6) <= coordinate_v2_d6;
  dot_lane_unit_x(7) <= coordinate_v2_d6;
  dot_lane_unit_x(8) <= coordinate_v2_d6;
  dot_lane_unit_x(9) <= coordinate_w2_d6;
  dot_lane_unit_m(0) <= moment_n;
  dot_lane_unit_m(1) <= moment_m0;
  dot_lane_unit_m(2) <= moment_m1;
  dot_lane_unit_m(3) <= moment_m2;
  dot_lane_unit_m(4) <= moment_n;
  dot_lane_unit_m(5) <= moment_m1;
  dot_lane_unit_m(6) <= moment_m0;
  dot_lane_unit_m(7) <= moment_m1;
  dot_lane_unit_m(8) <= moment_m2;
  dot_lane_unit_m(9) <= moment_n;
  dot_lane_unit : for k in 0 to 9 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      determinant_plane_a0 <= dot_lane(0);
      for k in 0 to 2 loop
        dot_d1(k) <= dot_lane(k + 1);
      end loop;
      determinant_plane_a1 <= dot_lane(4);
      determinant_plane_b0 <= dot_lane(5);
      determinant_side20 <= dot_lane(6);
      determinant_side21 <= dot_lane(7);
      determinant_side22 <= dot_lane(8);
      determinant_plane_a2 <= dot_lane(9);
    end if;
  end process clock_22;
  compared(0) <= resize(determinant_plane_a0, 41);
  compared(1) <= resize(determinant_plane_a1, 41);
  compared(2) <= resize(determinant_plane_a2, 41);
  compared(3) <= resize(determinant_plane_b0, 41);
  compared(12) <= resize(determinant_side20, 41);
  compared(13) <= resize(determinant_side21, 41);
  compared(14) <= resize(determinant_side22, 41);
  compared_unit_a(0) <= determinant_plane_a0;
  compared_unit_a(1) <= determinant_plane_a1;
  compared_unit_a(2) <= determinant_plane_a2;
  compared_unit_d(0) <= dot_d1;
  compared_unit_d(1)(0) <= determinant_side20;
  compared_unit_d(1)(1) <= determinant_side21;
  compared_unit_d(1)(2) <= determinant_side22;
  compared_from_4_each : for k in 0 to 1 generate
    compared(k + 4) <= compared_unit_plane_b(k);
  end generate compared_from_4_each;
  determinant_side00 <= compared_unit_side0(0);
  determinant_side01 <= compared_unit_side0(1);
  determinant_side02 <= compared_unit_side0(2);
  determinant_side10 <= compared_unit_side1(0);
  determinant_side11 <= compared_unit_side1(1);
  determinant_side12 <= compared_unit_side1(2);
  compared_unit : entity work.determinant_sums
    port map (clk => clk, a => compared_unit_a, d => compared_unit_d, v => determinant_plane_b0,
              plane_b => compared_unit_plane_b, side0 => compared_unit_side0, side1 => compared_unit_side1);

  -- Clock 24
  compared(6) <= resize(determinant_side00, 41);
  compared(7) <= resize(determinant_side01, 41);
  compared(8) <= resize(determinant_side02, 41);
  compared(9) <= resize(determinant_side10, 41);
  compared(10) <= resize(determinant_side11, 41);
  compared(11) <= resize(determinant_side12, 41);
end architecture rtl;
