-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 5: bounds on the errors of the fifteen determinants.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_bounds is
  port (
    clk                             : in  std_logic;
    places                          : in  std_logic;
    moment_m0                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n                        : in  signed_18_vector_t;  -- |.| <= 131072
    length_measure                  : in  unsigned_21_5_to_8_t;
    length_measure_h2               : in  unsigned_21_x5_t;
    length_measure0_plane_a0        : in  unsigned(23 downto 0);
    bound_plane_a1_sum_first_result : in  unsigned(23 downto 0);
    bound_plane_a2_sum_first_result : in  unsigned(23 downto 0);
    bound_plane_b1_result           : in  unsigned(26 downto 0);
    bound_plane_b2_result           : in  unsigned(26 downto 0);
    length_measure0_ends0           : in  unsigned(23 downto 0);
    length_measure0_ends1           : in  unsigned(23 downto 0);
    bound_side10_result             : in  unsigned(24 downto 0);
    bound_side11_result             : in  unsigned(24 downto 0);
    bound_side12_result             : in  unsigned(24 downto 0);
    level_d5                        : in  unsigned(2 downto 0);
    level_d7                        : in  unsigned(2 downto 0);
    compared_bound                  : out signed_31_x15_t  -- |.| <= 67665506
  );
end entity pair_bounds;

architecture rtl of pair_bounds is
  signal length_times_g : unsigned_22_x9_t;
  signal length_times_g_d1 : unsigned_22_x9_t := zero_unsigned_22_x9;
  signal length_first : unsigned_29_x9_t;
  signal length_bound : unsigned_29_x9_t := zero_unsigned_29_x9;
  signal moment_norm_lane : unsigned_20_x4_t;
  signal norm_of_moment : unsigned_20_x4_t := zero_unsigned_20_x4;
  signal moment_measure : unsigned_21_x4_t;
  signal moment_first : unsigned_28_x4_t;
  signal moment_bound : unsigned_28_x4_t := zero_unsigned_28_x4;
  signal face_of_vertex_negative_difference : signed_30_x3_x2_t;  -- |.| <= 53476968
  signal face_of_vertex : unsigned_29_x3_x2_t;
  signal bound_all_m : unsigned(29 downto 0);
  signal length_measure0_plane_a0_h1 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex_h1 : unsigned_29_x3_x2_t := zero_unsigned_29_x3_x2;
  signal bound_plane_a0_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a0 : unsigned(30 downto 0);
  signal bound_plane_a1_sum_first_result_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a1_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a1 : unsigned(30 downto 0);
  signal bound_plane_a2_sum_first_result_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a2_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a2 : unsigned(30 downto 0);
  signal bound_corner_aligned_h1 : unsigned(30 downto 0) := (others => '0');
  type bound_corner_sum_line_t is array (1 to 3) of unsigned(30 downto 0);
  signal bound_corner_sum_line : bound_corner_sum_line_t := (others => (others => '0'));
  signal bound_corner : unsigned(31 downto 0);
  signal bound_all_m_h1 : unsigned(29 downto 0) := (others => '0');
  signal length_measure0_plane_a0_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_b0 : unsigned(30 downto 0);
  signal bound_plane_b1_result_h1 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1 : unsigned(32 downto 0);
  signal bound_plane_b2_result_h1 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2 : unsigned(32 downto 0);
  signal bound_of_a_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a : unsigned(30 downto 0);
  signal length_measure0_ends0_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_side00_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side00 : unsigned(30 downto 0);
  signal bound_side01_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side01 : unsigned(30 downto 0);
  signal bound_side02_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side02 : unsigned(30 downto 0);
  signal bound_side10_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side10_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10 : unsigned(32 downto 0);
  signal bound_side11_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side11_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11 : unsigned(32 downto 0);
  signal bound_side12_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side12_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12 : unsigned(32 downto 0);
  signal length_measure0_ends1_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_side20_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side20 : unsigned(30 downto 0);
  signal bound_side21_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side21 : unsigned(30 downto 0);
  signal bound_side22_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side22 : unsigned(30 downto 0);
  signal moment_norm_lane_unit_x : signed_18_vector_x4_t;
begin
  -- Clock 18
  length_times_g_each : for k in 0 to 4 generate
    length_times_g(k) <= resize(length_measure_h2(k), 22) when places = '1' else append(length_measure_h2(k), 1);
  end generate length_times_g_each;
  length_times_g_each_2 : for k in 5 to 8 generate
    length_times_g(k) <= resize(length_measure(k), 22) when places = '1' else append(length_measure(k), 1);
  end generate length_times_g_each_2;

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      length_times_g_d1 <= length_times_g;
    end if;
  end process clock_19;
  moment_norm_lane_unit_x(0) <= moment_m0;
  moment_norm_lane_unit_x(1) <= moment_m1;
  moment_norm_lane_unit_x(2) <= moment_m2;
  moment_norm_lane_unit_x(3) <= moment_n;
  length_first_unit : for k in 0 to 8 generate
    unit : entity work.length_first_order
      port map (x => length_times_g_d1(k), by => level_d5, first_order => length_first(k));
  end generate length_first_unit;
  moment_norm_lane_unit : for k in 0 to 3 generate
    unit : entity work.moment_norm
      port map (clk => clk, x => moment_norm_lane_unit_x(k), norm => moment_norm_lane(k));
  end generate moment_norm_lane_unit;

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      length_bound <= length_first;
    end if;
  end process clock_20;
  face_of_vertex_negative_difference_each_of : for k in 0 to 1 generate
    face_of_vertex_negative_difference_each : for m in 0 to 2 generate
      face_of_vertex_negative_difference(k)(m) <= signed(resize(length_bound(k), 30)) -
          signed(resize(length_bound(m + 2), 30));
      face_of_vertex(k)(m) <= length_bound(k) when face_of_vertex_negative_difference(k)(m)(29) = '1' else
          length_bound(m + 2);
    end generate face_of_vertex_negative_difference_each;
  end generate face_of_vertex_negative_difference_each_of;

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      norm_of_moment <= moment_norm_lane;
      face_of_vertex_h1 <= face_of_vertex;
      bound_of_a_aligned_second_h1 <= append(length_bound(8), 1);
      bound_side10_sum_sum_aligned_second_h1 <= append(length_bound(5), 1);
      bound_side11_sum_sum_aligned_second_h1 <= append(length_bound(6), 1);
      bound_side12_sum_sum_aligned_second_h1 <= append(length_bound(7), 1);
    end if;
  end process clock_21;
  moment_measure_each : for k in 0 to 3 generate
    moment_measure(k) <= resize(norm_of_moment(k), 21);
  end generate moment_measure_each;
  moment_first_unit : for k in 0 to 3 generate
    unit : entity work.moment_first_order
      port map (x => moment_measure(k), by => level_d7, first_order => moment_first(k));
  end generate moment_first_unit;

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      moment_bound <= moment_first;
      length_measure0_plane_a0_h1 <= length_measure0_plane_a0;
      bound_plane_a0_sum_second_h1 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(1)(0), 30);
      bound_plane_a1_sum_first_result_h1 <= bound_plane_a1_sum_first_result;
      bound_plane_a1_sum_second_h1 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(1)(1), 30);
      bound_plane_a2_sum_first_result_h1 <= bound_plane_a2_sum_first_result;
      bound_plane_a2_sum_second_h1 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(1)(2), 30);
      bound_plane_b1_result_h1 <= bound_plane_b1_result;
      bound_plane_b2_result_h1 <= bound_plane_b2_result;
      bound_of_a_aligned_second_h2 <= bound_of_a_aligned_second_h1;
      length_measure0_ends0_h1 <= length_measure0_ends0;
      bound_side00_sum_second_h1 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(0)(1), 30);
      bound_side01_sum_second_h1 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(0)(2), 30);
      bound_side02_sum_second_h1 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(0)(0), 30);
      bound_side10_sum_sum_aligned_second_h2 <= bound_side10_sum_sum_aligned_second_h1;
      bound_side10_result_h1 <= bound_side10_result;
      bound_side11_sum_sum_aligned_second_h2 <= bound_side11_sum_sum_aligned_second_h1;
      bound_side11_result_h1 <= bound_side11_result;
      bound_side12_sum_sum_aligned_second_h2 <= bound_side12_sum_sum_aligned_second_h1;
      bound_side12_result_h1 <= bound_side12_result;
      length_measure0_ends1_h1 <= length_measure0_ends1;
      bound_side20_sum_second_h1 <= resize(face_of_vertex_h1(1)(0), 30) + resize(face_of_vertex_h1(1)(1), 30);
      bound_side21_sum_second_h1 <= resize(face_of_vertex_h1(1)(1), 30) + resize(face_of_vertex_h1(1)(2), 30);
      bound_side22_sum_second_h1 <= resize(face_of_vertex_h1(1)(2), 30) + resize(face_of_vertex_h1(1)(0), 30);
    end if;
  end process clock_22;
  bound_all_m <= resize(resize(moment_bound(0), 29) + resize(moment_bound(1), 29), 30) + resize(moment_bound(2), 30);
  bound_plane_a0 <= resize(resize(moment_bound(3), 29) + resize(length_measure0_plane_a0_h1, 29), 31) +
      resize(bound_plane_a0_sum_second_h1, 31);
  bound_plane_a1 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a1_sum_first_result_h1, 29), 31) +
      resize(bound_plane_a1_sum_second_h1, 31);
  bound_plane_a2 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a2_sum_first_result_h1, 29), 31) +
      resize(bound_plane_a2_sum_second_h1, 31);
  bound_of_a <= resize(append(moment_bound(3), 1), 31) + resize(bound_of_a_aligned_second_h2, 31);
  bound_side00 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side00_sum_second_h1, 31);
  bound_side01 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side01_sum_second_h1, 31);
  bound_side02 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side02_sum_second_h1, 31);
  bound_side20 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side20_sum_second_h1, 31);
  bound_side21 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side21_sum_second_h1, 31);
  bound_side22 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side22_sum_second_h1, 31);
  compared_bound(0) <= signed(resize(bound_plane_a0(30 downto 3), 31));
  compared_bound(1) <= signed(resize(bound_plane_a1(30 downto 3), 31));
  compared_bound(2) <= signed(resize(bound_plane_a2(30 downto 3), 31));
  compared_bound(6) <= signed(resize(bound_side00(30 downto 3), 31));
  compared_bound(7) <= signed(resize(bound_side01(30 downto 3), 31));
  compared_bound(8) <= signed(resize(bound_side02(30 downto 3), 31));
  compared_bound(12) <= signed(resize(bound_side20(30 downto 3), 31));
  compared_bound(13) <= signed(resize(bound_side21(30 downto 3), 31));
  compared_bound(14) <= signed(resize(bound_side22(30 downto 3), 31));

  -- Clock 23
  clock_23 : process (clk)
  begin
    if rising_edge(clk) then
      bound_corner_aligned_h1 <= append(bound_all_m, 1);
      bound_all_m_h1 <= bound_all_m;
      length_measure0_plane_a0_h2 <= length_measure0_plane_a0_h1;
      bound_plane_b1_result_h2 <= bound_plane_b1_result_h1;
      bound_plane_b2_result_h2 <= bound_plane_b2_result_h1;
      bound_side10_sum_h1 <= resize(resize(append(moment_bound(0), 1), 31) +
          resize(bound_side10_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side10_result_h2 <= bound_side10_result_h1;
      bound_side11_sum_h1 <= resize(resize(append(moment_bound(1), 1), 31) +
          resize(bound_side11_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side11_result_h2 <= bound_side11_result_h1;
      bound_side12_sum_h1 <= resize(resize(append(moment_bound(2), 1), 31) +
          resize(bound_side12_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side12_result_h2 <= bound_side12_result_h1;
    end if;
  end process clock_23;
  bound_corner <= resize(bound_corner_aligned_h1, 32) + resize(bound_corner_sum_line(3), 32);
  bound_plane_b0 <= resize(bound_all_m_h1, 31) + resize(length_measure0_plane_a0_h2, 31);
  bound_plane_b1 <= resize(bound_corner, 33) + resize(bound_plane_b1_result_h2, 33);
  bound_plane_b2 <= resize(bound_corner, 33) + resize(bound_plane_b2_result_h2, 33);
  bound_side10 <= resize(bound_side10_sum_h1, 33) + resize(bound_side10_result_h2, 33);
  bound_side11 <= resize(bound_side11_sum_h1, 33) + resize(bound_side11_result_h2, 33);
  bound_side12 <= resize(bound_side12_sum_h1, 33) + resize(bound_side12_result_h2, 33);
  compared_bound(3) <= signed(resize(bound_plane_b0(30 downto 3), 31));
  compared_bound(4) <= signed(resize(bound_plane_b1(32 downto 3), 31));
  compared_bound(5) <= signed(resize(bound_plane_b2(32 downto 3), 31));
  compared_bound(9) <= signed(resize(bound_side10(32 downto 3), 31));
  compared_bound(10) <= signed(resize(bound_side11(32 downto 3), 31));
  compared_bound(11) <= signed(resize(bound_side12(32 downto 3), 31));

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      bound_corner_sum_line <= (resize(resize(length_bound(5), 30) + resize(length_bound(6), 30), 31) +
          resize(length_bound(7), 31)) & bound_corner_sum_line(1 to 2);
    end if;
  end process delays;
end architecture rtl;
