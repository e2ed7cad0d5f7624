-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Sections 3 and 4: the fifteen determinants and their signs.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_determinants is
  port (
    clk       : in  std_logic;
    moment_m0 : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_m1 : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_m2 : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_n  : in  signed_36_vector_t;  -- |.| <= 34359214082
    fitted_d4 : in  signed_18_vector_x5_t;  -- |.| <= 131071
    sign      : out flag_x2_x15_t
  );
end entity pair_determinants;

architecture rtl of pair_determinants is
  signal offset_m0 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_m1 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_m2 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_n : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_n_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal dot_lane : signed_57_x10_t;  -- |.| <= 13510541185384448
  signal determinant_plane_a0 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal offset_m0_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal dot_d1 : signed_57_x3_t := zero_signed_57_x3;  -- |.| <= 13510541185384448
  signal offset_m1_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal offset_m2_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal determinant_plane_a1 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_plane_b0 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side20 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side21 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side22 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_plane_a2 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal of_sign : signed_60_x15_t;  -- |.| <= 54042164741537791
  signal determinant_side00 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side01 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side02 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side10 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal determinant_side11 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal determinant_side12 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal of_sign_h1 : signed_60_4_to_11_t := zero_signed_60_4_to_11;  -- |.| <= 54042164741537791
  signal dot_lane_unit_x : signed_18_vector_x10_t;
  signal dot_lane_unit_m : signed_36_vector_x10_t;
  signal of_sign_unit_a : signed_57_x3_t;
  signal of_sign_unit_d : signed_57_x3_x2_t;
  signal of_sign_unit_plane_b : signed_60_x2_t;
  signal of_sign_unit_side0 : signed_58_x3_t;
  signal of_sign_unit_side1 : signed_59_x3_t;
  signal sign_unit_x : signed_60_x15_t;
begin
  -- Clock 4
  offset_m0_each : for i in 0 to 2 generate
    offset_m0(i) <= moment_m0(i) + 131072;
    offset_m1(i) <= moment_m1(i) + 131072;
    offset_m2(i) <= moment_m2(i) + 131072;
    offset_n(i) <= moment_n(i) + 131072;
  end generate offset_m0_each;

  -- Clock 5
  clock_5 : process (clk)
  begin
    if rising_edge(clk) then
      offset_n_d1 <= offset_n;
      offset_m0_d1 <= offset_m0;
      offset_m1_d1 <= offset_m1;
      offset_m2_d1 <= offset_m2;
    end if;
  end process clock_5;
  dot_lane_unit_x(0) <= fitted_d4(2);
  dot_lane_unit_x(1) <= fitted_d4(0);
  dot_lane_unit_x(2) <= fitted_d4(0);
  dot_lane_unit_x(3) <= fitted_d4(0);
  dot_lane_unit_x(4) <= fitted_d4(3);
  dot_lane_unit_x(5) <= fitted_d4(2);
  dot_lane_unit_x(6) <= fitted_d4(1);
  dot_lane_unit_x(7) <= fitted_d4(1);
  dot_lane_unit_x(8) <= fitted_d4(1);
  dot_lane_unit_x(9) <= fitted_d4(4);
  dot_lane_unit_m(0) <= offset_n_d1;
  dot_lane_unit_m(1) <= offset_m0_d1;
  dot_lane_unit_m(2) <= offset_m1_d1;
  dot_lane_unit_m(3) <= offset_m2_d1;
  dot_lane_unit_m(4) <= offset_n_d1;
  dot_lane_unit_m(5) <= offset_m1_d1;
  dot_lane_unit_m(6) <= offset_m0_d1;
  dot_lane_unit_m(7) <= offset_m1_d1;
  dot_lane_unit_m(8) <= offset_m2_d1;
  dot_lane_unit_m(9) <= offset_n_d1;
  dot_lane_unit : for k in 0 to 9 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;

  -- Clock 10
  clock_10 : process (clk)
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
  end process clock_10;
  of_sign(0) <= resize(determinant_plane_a0, 60);
  of_sign(1) <= resize(determinant_plane_a1, 60);
  of_sign(2) <= resize(determinant_plane_a2, 60);
  of_sign(3) <= resize(determinant_plane_b0, 60);
  of_sign(12) <= resize(determinant_side20, 60);
  of_sign(13) <= resize(determinant_side21, 60);
  of_sign(14) <= resize(determinant_side22, 60);
  of_sign_unit_a(0) <= determinant_plane_a0;
  of_sign_unit_a(1) <= determinant_plane_a1;
  of_sign_unit_a(2) <= determinant_plane_a2;
  of_sign_unit_d(0) <= dot_d1;
  of_sign_unit_d(1)(0) <= determinant_side20;
  of_sign_unit_d(1)(1) <= determinant_side21;
  of_sign_unit_d(1)(2) <= determinant_side22;
  of_sign_from_4_each : for k in 0 to 1 generate
    of_sign(k + 4) <= of_sign_unit_plane_b(k);
  end generate of_sign_from_4_each;
  determinant_side00 <= of_sign_unit_side0(0);
  determinant_side01 <= of_sign_unit_side0(1);
  determinant_side02 <= of_sign_unit_side0(2);
  determinant_side10 <= of_sign_unit_side1(0);
  determinant_side11 <= of_sign_unit_side1(1);
  determinant_side12 <= of_sign_unit_side1(2);
  sign_unit_x_each : for k in 0 to 3 generate
    sign_unit_x(k) <= of_sign(k);
  end generate sign_unit_x_each;
  sign_unit_x_each_2 : for k in 4 to 11 generate
    sign_unit_x(k) <= of_sign_h1(k);
  end generate sign_unit_x_each_2;
  sign_unit_x(12) <= of_sign(12);
  sign_unit_x(13) <= of_sign(13);
  sign_unit_x(14) <= of_sign(14);
  of_sign_unit : entity work.determinant_sums
    port map (clk => clk, a => of_sign_unit_a, d => of_sign_unit_d, v => determinant_plane_b0,
              plane_b => of_sign_unit_plane_b, side0 => of_sign_unit_side0, side1 => of_sign_unit_side1);
  sign_unit : for k in 0 to 14 generate
    unit : entity work.exact_sign
      port map (x => sign_unit_x(k), sign => sign(k));
  end generate sign_unit;

  -- Clock 12
  of_sign(6) <= resize(determinant_side00, 60);
  of_sign(7) <= resize(determinant_side01, 60);
  of_sign(8) <= resize(determinant_side02, 60);
  of_sign(9) <= resize(determinant_side10, 60);
  of_sign(10) <= resize(determinant_side11, 60);
  of_sign(11) <= resize(determinant_side12, 60);

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 4 to 11 loop
        of_sign_h1(k) <= of_sign(k);
      end loop;
    end if;
  end process clock_13;
end architecture rtl;
