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
    strobe                          : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_1               : in  std_logic;
    row_m_select_at_0               : in  std_logic;
    places                          : in  std_logic;
    moment_m0                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n                        : in  signed_18_vector_t;  -- |.| <= 131072
    length_measure_h4               : in  unsigned_21_x4_t;
    length_measure5_h4              : in  unsigned(20 downto 0);
    length_measure_7_to_8_h4        : in  unsigned_21_7_to_8_t;
    length_measure4_h2              : in  unsigned(20 downto 0);
    length_measure6_h2              : in  unsigned(20 downto 0);
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
    level_h4_d1                     : in  unsigned(2 downto 0);
    level_h4_d3                     : in  unsigned(2 downto 0);
    compared_bound                  : out signed_31_x15_t  -- |.| <= 67665506
  );
end entity pair_bounds;

architecture rtl of pair_bounds is
  signal length_x : unsigned_21_x4_t;
  signal places_d1 : std_logic := '0';
  signal places_d2 : std_logic := '0';
  signal length_times_g : unsigned_22_x5_t;
  signal length_times_g_d1 : unsigned_22_x5_t := zero_unsigned_22_x5;
  signal length_first : unsigned_29_x5_t;
  signal length_bound : unsigned_29_x9_t := zero_unsigned_29_x9;
  signal moment_norm_x : signed_18_vector_x2_t;  -- |.| <= 131072
  signal moment_norm_x_d1 : signed_18_vector_x2_t := zero_signed_18_vector_x2;  -- |.| <= 131072
  signal moment_norm_lane : unsigned_20_x2_t;
  signal norm_of_moment : unsigned_20_x4_t := zero_unsigned_20_x4;
  signal moment_measure : unsigned_21_x4_t;
  signal moment_x : unsigned_21_x2_t;
  signal moment_x_d1 : unsigned_21_x2_t := zero_unsigned_21_x2;
  signal moment_first : unsigned_28_x2_t;
  signal moment_bound : unsigned_28_x4_t := zero_unsigned_28_x4;
  signal face_of_vertex_negative_difference : signed_30_x3_x2_t;  -- |.| <= 53476968
  signal face_of_vertex : unsigned_29_x3_x2_t;
  signal bound_all_m : unsigned(29 downto 0);
  signal length_measure0_plane_a0_h2 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex_h1 : unsigned_29_x3_x2_t := zero_unsigned_29_x3_x2;
  signal bound_plane_a0_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a0 : unsigned(30 downto 0);
  signal bound_plane_a1_sum_first_result_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a1_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a1 : unsigned(30 downto 0);
  signal bound_plane_a2_sum_first_result_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a2_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a2 : unsigned(30 downto 0);
  signal bound_corner_aligned_h1 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h2 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h3 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner : unsigned(31 downto 0);
  signal bound_all_m_h1 : unsigned(29 downto 0) := (others => '0');
  signal length_measure0_plane_a0_h3 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_b0 : unsigned(30 downto 0);
  signal bound_plane_b1_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1 : unsigned(32 downto 0);
  signal bound_plane_b2_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2 : unsigned(32 downto 0);
  signal bound_of_a_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a : unsigned(30 downto 0);
  signal length_measure0_ends0_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_side00_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side00 : unsigned(30 downto 0);
  signal bound_side01_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side01 : unsigned(30 downto 0);
  signal bound_side02_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side02 : unsigned(30 downto 0);
  signal bound_side10_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side10_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10 : unsigned(32 downto 0);
  signal bound_side11_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side11_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11 : unsigned(32 downto 0);
  signal bound_side12_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side12_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12 : unsigned(32 downto 0);
  signal length_measure0_ends1_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_side20_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side20 : unsigned(30 downto 0);
  signal bound_side21_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side21 : unsigned(30 downto 0);
  signal bound_side22_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side22 : unsigned(30 downto 0);
begin
  -- Clock 23
  clock_23 : process (clk)
  begin
    if rising_edge(clk) then
      places_d1 <= places;
    end if;
  end process clock_23;
  moment_norm_x(0) <= moment_m2 when row_m_select_at_1 = '1' else moment_m0;
  moment_norm_x(1) <= moment_n when row_m_select_at_1 = '1' else moment_m1;

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      places_d2 <= places_d1;
      moment_norm_x_d1 <= moment_norm_x;
    end if;
  end process clock_24;
  length_x(0) <= length_measure5_h4 when row_m_select_at_0 = '1' else length_measure_h4(0);
  length_x(1) <= length_measure6_h2 when row_m_select_at_0 = '1' else length_measure_h4(1);
  length_x(2) <= length_measure_7_to_8_h4(7) when row_m_select_at_0 = '1' else length_measure_h4(2);
  length_x(3) <= length_measure_7_to_8_h4(8) when row_m_select_at_0 = '1' else length_measure_h4(3);
  length_times_g_each : for k in 0 to 3 generate
    length_times_g(k) <= resize(length_x(k), 22) when places_d2 = '1' else append(length_x(k), 1);
  end generate length_times_g_each;
  length_times_g(4) <= resize(length_measure4_h2, 22) when places_d2 = '1' else append(length_measure4_h2, 1);
  moment_norm_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_norm
      port map (clk => clk, x => moment_norm_x_d1(k), norm => moment_norm_lane(k));
  end generate moment_norm_lane_unit;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      length_times_g_d1 <= length_times_g;
    end if;
  end process clock_25;
  length_first_unit : for k in 0 to 4 generate
    unit : entity work.length_first_order
      port map (x => length_times_g_d1(k), by => level_h4_d1, first_order => length_first(k));
  end generate length_first_unit;

  -- Clock 26
  moment_measure(0) <= resize(norm_of_moment(0), 21);
  moment_measure(1) <= resize(norm_of_moment(1), 21);
  moment_x_each : for k in 0 to 1 generate
    moment_x(k) <= moment_measure(k + 2) when row_m_select_at_0 = '1' else moment_measure(k);
    face_of_vertex_negative_difference_each : for m in 0 to 2 generate
      face_of_vertex_negative_difference(k)(m) <= signed(resize(length_bound(k), 30)) -
          signed(resize(length_bound(m + 2), 30));
      face_of_vertex(k)(m) <= length_bound(k) when face_of_vertex_negative_difference(k)(m)(29) = '1' else
          length_bound(m + 2);
    end generate face_of_vertex_negative_difference_each;
  end generate moment_x_each;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      moment_x_d1 <= moment_x;
    end if;
  end process clock_27;
  moment_measure(2) <= resize(norm_of_moment(2), 21);
  moment_measure(3) <= resize(norm_of_moment(3), 21);
  moment_first_unit : for k in 0 to 1 generate
    unit : entity work.moment_first_order
      port map (x => moment_x_d1(k), by => level_h4_d3, first_order => moment_first(k));
  end generate moment_first_unit;

  -- Clock 29
  bound_all_m <= resize(resize(moment_bound(0), 29) + resize(moment_bound(1), 29), 30) + resize(moment_bound(2), 30);
  bound_plane_a0 <= resize(resize(moment_bound(3), 29) + resize(length_measure0_plane_a0_h2, 29), 31) +
      resize(bound_plane_a0_sum_second_h2, 31);
  bound_plane_a1 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a1_sum_first_result_h2, 29), 31) +
      resize(bound_plane_a1_sum_second_h2, 31);
  bound_plane_a2 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a2_sum_first_result_h2, 29), 31) +
      resize(bound_plane_a2_sum_second_h2, 31);
  bound_of_a <= resize(append(moment_bound(3), 1), 31) + resize(bound_of_a_aligned_second_h2, 31);
  bound_side00 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side00_sum_second_h2, 31);
  bound_side01 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side01_sum_second_h2, 31);
  bound_side02 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side02_sum_second_h2, 31);
  bound_side20 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side20_sum_second_h2, 31);
  bound_side21 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side21_sum_second_h2, 31);
  bound_side22 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side22_sum_second_h2, 31);
  compared_bound(0) <= signed(resize(bound_plane_a0(30 downto 3), 31));
  compared_bound(1) <= signed(resize(bound_plane_a1(30 downto 3), 31));
  compared_bound(2) <= signed(resize(bound_plane_a2(30 downto 3), 31));
  compared_bound(6) <= signed(resize(bound_side00(30 downto 3), 31));
  compared_bound(7) <= signed(resize(bound_side01(30 downto 3), 31));
  compared_bound(8) <= signed(resize(bound_side02(30 downto 3), 31));
  compared_bound(12) <= signed(resize(bound_side20(30 downto 3), 31));
  compared_bound(13) <= signed(resize(bound_side21(30 downto 3), 31));
  compared_bound(14) <= signed(resize(bound_side22(30 downto 3), 31));

  -- Clock 30
  bound_corner <= resize(bound_corner_aligned_h1, 32) + resize(bound_corner_sum_h3, 32);
  bound_plane_b0 <= resize(bound_all_m_h1, 31) + resize(length_measure0_plane_a0_h3, 31);
  bound_plane_b1 <= resize(bound_corner, 33) + resize(bound_plane_b1_result_h3, 33);
  bound_plane_b2 <= resize(bound_corner, 33) + resize(bound_plane_b2_result_h3, 33);
  bound_side10 <= resize(bound_side10_sum_h1, 33) + resize(bound_side10_result_h3, 33);
  bound_side11 <= resize(bound_side11_sum_h1, 33) + resize(bound_side11_result_h3, 33);
  bound_side12 <= resize(bound_side12_sum_h1, 33) + resize(bound_side12_result_h3, 33);
  compared_bound(3) <= signed(resize(bound_plane_b0(30 downto 3), 31));
  compared_bound(4) <= signed(resize(bound_plane_b1(32 downto 3), 31));
  compared_bound(5) <= signed(resize(bound_plane_b2(32 downto 3), 31));
  compared_bound(9) <= signed(resize(bound_side10(32 downto 3), 31));
  compared_bound(10) <= signed(resize(bound_side11(32 downto 3), 31));
  compared_bound(11) <= signed(resize(bound_side12(32 downto 3), 31));

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        for k in 0 to 4 loop
          length_bound(k) <= length_first(k);
        end loop;
        norm_of_moment(0) <= moment_norm_lane(0);
        norm_of_moment(1) <= moment_norm_lane(1);
        moment_bound(0) <= moment_first(0);
        moment_bound(1) <= moment_first(1);
        bound_corner_aligned_h1 <= append(bound_all_m, 1);
        bound_corner_sum_h3 <= bound_corner_sum_h2;
        bound_all_m_h1 <= bound_all_m;
        length_measure0_plane_a0_h3 <= length_measure0_plane_a0_h2;
        bound_plane_b1_result_h3 <= bound_plane_b1_result_h2;
        bound_plane_b2_result_h3 <= bound_plane_b2_result_h2;
        bound_side10_sum_h1 <= resize(resize(append(moment_bound(0), 1), 31) +
            resize(bound_side10_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side10_result_h3 <= bound_side10_result_h2;
        bound_side11_sum_h1 <= resize(resize(append(moment_bound(1), 1), 31) +
            resize(bound_side11_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side11_result_h3 <= bound_side11_result_h2;
        bound_side12_sum_h1 <= resize(resize(append(moment_bound(2), 1), 31) +
            resize(bound_side12_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side12_result_h3 <= bound_side12_result_h2;
      end if;
      if strobe(0) = '1' then
        for k in 0 to 3 loop
          length_bound(k + 5) <= length_first(k);
        end loop;
        norm_of_moment(2) <= moment_norm_lane(0);
        norm_of_moment(3) <= moment_norm_lane(1);
        moment_bound(2) <= moment_first(0);
        moment_bound(3) <= moment_first(1);
        length_measure0_plane_a0_h2 <= length_measure0_plane_a0;
        face_of_vertex_h1 <= face_of_vertex;
        bound_plane_a0_sum_second_h2 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(1)(0), 30);
        bound_plane_a1_sum_first_result_h2 <= bound_plane_a1_sum_first_result;
        bound_plane_a1_sum_second_h2 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(1)(1), 30);
        bound_plane_a2_sum_first_result_h2 <= bound_plane_a2_sum_first_result;
        bound_plane_a2_sum_second_h2 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(1)(2), 30);
        bound_corner_sum_h2 <= resize(resize(length_bound(5), 30) + resize(length_bound(6), 30), 31) +
            resize(length_bound(7), 31);
        bound_plane_b1_result_h2 <= bound_plane_b1_result;
        bound_plane_b2_result_h2 <= bound_plane_b2_result;
        bound_of_a_aligned_second_h2 <= append(length_bound(8), 1);
        length_measure0_ends0_h2 <= length_measure0_ends0;
        bound_side00_sum_second_h2 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(0)(1), 30);
        bound_side01_sum_second_h2 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(0)(2), 30);
        bound_side02_sum_second_h2 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(0)(0), 30);
        bound_side10_sum_sum_aligned_second_h2 <= append(length_bound(5), 1);
        bound_side10_result_h2 <= bound_side10_result;
        bound_side11_sum_sum_aligned_second_h2 <= append(length_bound(6), 1);
        bound_side11_result_h2 <= bound_side11_result;
        bound_side12_sum_sum_aligned_second_h2 <= append(length_bound(7), 1);
        bound_side12_result_h2 <= bound_side12_result;
        length_measure0_ends1_h2 <= length_measure0_ends1;
        bound_side20_sum_second_h2 <= resize(face_of_vertex_h1(1)(0), 30) + resize(face_of_vertex_h1(1)(1), 30);
        bound_side21_sum_second_h2 <= resize(face_of_vertex_h1(1)(1), 30) + resize(face_of_vertex_h1(1)(2), 30);
        bound_side22_sum_second_h2 <= resize(face_of_vertex_h1(1)(2), 30) + resize(face_of_vertex_h1(1)(0), 30);
      end if;
    end if;
  end process captures;
end architecture rtl;
