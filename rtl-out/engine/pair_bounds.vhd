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
    strobe                          : in  std_logic_vector(2 downto 0);  -- one flag per phase
    row_m_select_at_1               : in  unsigned(1 downto 0);
    places                          : in  std_logic;
    moment_m0                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1                       : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n                        : in  signed_18_vector_t;  -- |.| <= 131072
    lane1_select_at_1               : in  std_logic;
    length_measure                  : in  unsigned_21_x8_t;
    length_measure8_h3              : in  unsigned(20 downto 0);
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
    level_h2_d1                     : in  unsigned(2 downto 0);
    level_h2_d4                     : in  unsigned(2 downto 0);
    compared_bound                  : out signed_31_x15_t  -- |.| <= 67665506
  );
end entity pair_bounds;

architecture rtl of pair_bounds is
  signal length_x : unsigned_21_x3_t;
  signal places_d1 : std_logic := '0';
  signal length_times_g : unsigned_22_x3_t;
  signal length_times_g_d1 : unsigned_22_x3_t := zero_unsigned_22_x3;
  signal length_first : unsigned_29_x3_t;
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
  signal length_measure0_plane_a0_h3 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex_h1 : unsigned_29_x3_x2_t := zero_unsigned_29_x3_x2;
  signal bound_plane_a0_sum_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a0 : unsigned(30 downto 0);
  signal bound_plane_a1_sum_first_result_h3 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a1_sum_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a1 : unsigned(30 downto 0);
  signal bound_plane_a2_sum_first_result_h3 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a2_sum_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a2 : unsigned(30 downto 0);
  signal bound_corner_aligned_h1 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h2 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h3 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner : unsigned(31 downto 0);
  signal bound_all_m_h1 : unsigned(29 downto 0) := (others => '0');
  signal length_measure0_plane_a0_h4 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_b0 : unsigned(30 downto 0);
  signal bound_plane_b1_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1_result_h4 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1 : unsigned(32 downto 0);
  signal bound_plane_b2_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2_result_h4 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2 : unsigned(32 downto 0);
  signal bound_of_a_aligned_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a : unsigned(30 downto 0);
  signal length_measure0_ends0_h3 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex0_0_h2 : unsigned(28 downto 0) := (others => '0');
  signal face_of_vertex1_h2 : unsigned_29_x3_t := zero_unsigned_29_x3;
  signal bound_side00 : unsigned(30 downto 0);
  signal bound_side01 : unsigned(30 downto 0);
  signal bound_side02_sum_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_side02 : unsigned(30 downto 0);
  signal bound_side10_sum_sum_aligned_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side10_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10_result_h5 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10 : unsigned(32 downto 0);
  signal bound_side11_sum_sum_h2 : unsigned(30 downto 0) := (others => '0');
  signal bound_side11_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side11_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11_result_h5 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11 : unsigned(32 downto 0);
  signal bound_side12_sum_sum_aligned_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side12_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12_result_h5 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12 : unsigned(32 downto 0);
  signal length_measure0_ends1_h3 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex1_0_h3 : unsigned(28 downto 0) := (others => '0');
  signal bound_side20 : unsigned(30 downto 0);
  signal bound_side21 : unsigned(30 downto 0);
  signal bound_side22_sum_second_h3 : unsigned(29 downto 0) := (others => '0');
  signal bound_side22 : unsigned(30 downto 0);
begin
  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      places_d1 <= places;
    end if;
  end process clock_25;
  length_x(0) <=
    length_measure(0) when known(row_m_select_at_1) = 0 else
    length_measure(3) when known(row_m_select_at_1) = 1 else
    length_measure(6);
  length_x(1) <=
    length_measure(1) when known(row_m_select_at_1) = 0 else
    length_measure(4) when known(row_m_select_at_1) = 1 else
    length_measure(7);
  length_x(2) <=
    length_measure(2) when known(row_m_select_at_1) = 0 else
    length_measure(5) when known(row_m_select_at_1) = 1 else
    length_measure8_h3;
  length_times_g_each : for k in 0 to 2 generate
    length_times_g(k) <= resize(length_x(k), 22) when places_d1 = '1' else append(length_x(k), 1);
  end generate length_times_g_each;
  moment_norm_x(0) <= moment_m2 when lane1_select_at_1 = '1' else moment_m0;
  moment_norm_x(1) <= moment_n when lane1_select_at_1 = '1' else moment_m1;

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      length_times_g_d1 <= length_times_g;
      moment_norm_x_d1 <= moment_norm_x;
    end if;
  end process clock_26;
  length_first_unit : for k in 0 to 2 generate
    unit : entity work.length_first_order
      port map (x => length_times_g_d1(k), by => level_h2_d1, first_order => length_first(k));
  end generate length_first_unit;
  moment_norm_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_norm
      port map (clk => clk, x => moment_norm_x_d1(k), norm => moment_norm_lane(k));
  end generate moment_norm_lane_unit;

  -- Clock 27
  face_of_vertex_negative_difference_0_each : for k in 0 to 1 generate
    face_of_vertex_negative_difference(k)(0) <= signed(resize(length_bound(k), 30)) -
        signed(resize(length_bound(2), 30));
    face_of_vertex(k)(0) <= length_bound(k) when face_of_vertex_negative_difference(k)(0)(29) = '1' else
        length_bound(2);
  end generate face_of_vertex_negative_difference_0_each;

  -- Clock 28
  moment_measure(0) <= resize(norm_of_moment(0), 21);
  moment_measure(1) <= resize(norm_of_moment(1), 21);
  moment_x_each : for k in 0 to 1 generate
    moment_x(k) <= moment_measure(k + 2) when lane1_select_at_1 = '1' else moment_measure(k);
    face_of_vertex_negative_difference(k)(1) <= signed(resize(length_bound(k), 30)) -
        signed(resize(length_bound(3), 30));
    face_of_vertex_negative_difference(k)(2) <= signed(resize(length_bound(k), 30)) -
        signed(resize(length_bound(4), 30));
    face_of_vertex(k)(1) <= length_bound(k) when face_of_vertex_negative_difference(k)(1)(29) = '1' else
        length_bound(3);
    face_of_vertex(k)(2) <= length_bound(k) when face_of_vertex_negative_difference(k)(2)(29) = '1' else
        length_bound(4);
  end generate moment_x_each;

  -- Clock 29
  clock_29 : process (clk)
  begin
    if rising_edge(clk) then
      moment_x_d1 <= moment_x;
    end if;
  end process clock_29;
  moment_measure(2) <= resize(norm_of_moment(2), 21);
  moment_measure(3) <= resize(norm_of_moment(3), 21);
  moment_first_unit : for k in 0 to 1 generate
    unit : entity work.moment_first_order
      port map (x => moment_x_d1(k), by => level_h2_d4, first_order => moment_first(k));
  end generate moment_first_unit;

  -- Clock 31
  bound_all_m <= resize(resize(moment_bound(0), 29) + resize(moment_bound(1), 29), 30) + resize(moment_bound(2), 30);
  bound_plane_a0 <= resize(resize(moment_bound(3), 29) + resize(length_measure0_plane_a0_h3, 29), 31) +
      resize(bound_plane_a0_sum_second_h3, 31);
  bound_side00 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends0_h3, 29), 31) +
      resize(resize(face_of_vertex0_0_h2, 30) + resize(face_of_vertex_h1(0)(1), 30), 31);
  bound_side01 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends0_h3, 29), 31) +
      resize(resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(0)(2), 30), 31);
  bound_side20 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends1_h3, 29), 31) +
      resize(resize(face_of_vertex1_0_h3, 30) + resize(face_of_vertex1_h2(1), 30), 31);
  bound_side21 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends1_h3, 29), 31) +
      resize(resize(face_of_vertex1_h2(1), 30) + resize(face_of_vertex1_h2(2), 30), 31);
  compared_bound(0) <= signed(resize(bound_plane_a0(30 downto 3), 31));
  compared_bound(6) <= signed(resize(bound_side00(30 downto 3), 31));
  compared_bound(7) <= signed(resize(bound_side01(30 downto 3), 31));
  compared_bound(12) <= signed(resize(bound_side20(30 downto 3), 31));
  compared_bound(13) <= signed(resize(bound_side21(30 downto 3), 31));

  -- Clock 32
  bound_plane_a1 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a1_sum_first_result_h3, 29), 31) +
      resize(bound_plane_a1_sum_second_h3, 31);
  bound_plane_a2 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a2_sum_first_result_h3, 29), 31) +
      resize(bound_plane_a2_sum_second_h3, 31);
  bound_corner <= resize(bound_corner_aligned_h1, 32) + resize(bound_corner_sum_h3, 32);
  bound_plane_b0 <= resize(bound_all_m_h1, 31) + resize(length_measure0_plane_a0_h4, 31);
  bound_plane_b1 <= resize(bound_corner, 33) + resize(bound_plane_b1_result_h4, 33);
  bound_plane_b2 <= resize(bound_corner, 33) + resize(bound_plane_b2_result_h4, 33);
  bound_of_a <= resize(append(moment_bound(3), 1), 31) + resize(bound_of_a_aligned_second_h3, 31);
  bound_side02 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends0_h3, 29), 31) +
      resize(bound_side02_sum_second_h3, 31);
  bound_side22 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends1_h3, 29), 31) +
      resize(bound_side22_sum_second_h3, 31);
  compared_bound(1) <= signed(resize(bound_plane_a1(30 downto 3), 31));
  compared_bound(2) <= signed(resize(bound_plane_a2(30 downto 3), 31));
  compared_bound(3) <= signed(resize(bound_plane_b0(30 downto 3), 31));
  compared_bound(4) <= signed(resize(bound_plane_b1(32 downto 3), 31));
  compared_bound(5) <= signed(resize(bound_plane_b2(32 downto 3), 31));
  compared_bound(8) <= signed(resize(bound_side02(30 downto 3), 31));
  compared_bound(14) <= signed(resize(bound_side22(30 downto 3), 31));

  -- Clock 33
  bound_side10 <= resize(bound_side10_sum_h1, 33) + resize(bound_side10_result_h5, 33);
  bound_side11 <= resize(bound_side11_sum_h1, 33) + resize(bound_side11_result_h5, 33);
  bound_side12 <= resize(bound_side12_sum_h1, 33) + resize(bound_side12_result_h5, 33);
  compared_bound(9) <= signed(resize(bound_side10(32 downto 3), 31));
  compared_bound(10) <= signed(resize(bound_side11(32 downto 3), 31));
  compared_bound(11) <= signed(resize(bound_side12(32 downto 3), 31));

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(2) = '1' then
        length_bound(0) <= length_first(0);
        length_bound(1) <= length_first(1);
        length_bound(2) <= length_first(2);
        moment_bound(0) <= moment_first(0);
        moment_bound(1) <= moment_first(1);
        face_of_vertex1_h2(1) <= face_of_vertex(1)(1);
        face_of_vertex1_h2(2) <= face_of_vertex(1)(2);
        bound_side10_sum_h1 <= resize(resize(append(moment_bound(0), 1), 31) +
            resize(bound_side10_sum_sum_aligned_second_h3, 31), 32) + resize(bound_of_a, 32);
        bound_side10_result_h5 <= bound_side10_result_h3;
        bound_side11_sum_h1 <= resize(bound_side11_sum_sum_h2, 32) + resize(bound_of_a, 32);
        bound_side11_result_h5 <= bound_side11_result_h3;
        bound_side12_sum_h1 <= resize(resize(append(moment_bound(2), 1), 31) +
            resize(bound_side12_sum_sum_aligned_second_h3, 31), 32) + resize(bound_of_a, 32);
        bound_side12_result_h5 <= bound_side12_result_h3;
        face_of_vertex1_0_h3 <= face_of_vertex(1)(0);
      end if;
      if strobe(0) = '1' then
        length_bound(3) <= length_first(0);
        length_bound(4) <= length_first(1);
        length_bound(5) <= length_first(2);
        norm_of_moment(0) <= moment_norm_lane(0);
        norm_of_moment(1) <= moment_norm_lane(1);
        moment_bound(2) <= moment_first(0);
        moment_bound(3) <= moment_first(1);
        length_measure0_plane_a0_h3 <= length_measure0_plane_a0;
        bound_plane_a0_sum_second_h3 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(1)(0), 30);
        bound_plane_a1_sum_first_result_h3 <= bound_plane_a1_sum_first_result;
        bound_plane_a2_sum_first_result_h3 <= bound_plane_a2_sum_first_result;
        bound_corner_sum_h2 <= resize(resize(length_bound(5), 30) + resize(length_bound(6), 30), 31) +
            resize(length_bound(7), 31);
        bound_plane_b1_result_h3 <= bound_plane_b1_result;
        bound_plane_b2_result_h3 <= bound_plane_b2_result;
        length_measure0_ends0_h3 <= length_measure0_ends0;
        bound_side10_sum_sum_aligned_second_h3 <= append(length_bound(5), 1);
        bound_side10_result_h3 <= bound_side10_result;
        bound_side11_result_h3 <= bound_side11_result;
        bound_side12_result_h3 <= bound_side12_result;
        length_measure0_ends1_h3 <= length_measure0_ends1;
      end if;
      if strobe(1) = '1' then
        length_bound(6) <= length_first(0);
        length_bound(7) <= length_first(1);
        length_bound(8) <= length_first(2);
        norm_of_moment(2) <= moment_norm_lane(0);
        norm_of_moment(3) <= moment_norm_lane(1);
        bound_plane_a1_sum_second_h3 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(1)(1), 30);
        bound_plane_a2_sum_second_h3 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(1)(2), 30);
        bound_corner_aligned_h1 <= append(bound_all_m, 1);
        bound_corner_sum_h3 <= bound_corner_sum_h2;
        bound_all_m_h1 <= bound_all_m;
        length_measure0_plane_a0_h4 <= length_measure0_plane_a0_h3;
        bound_plane_b1_result_h4 <= bound_plane_b1_result_h3;
        bound_plane_b2_result_h4 <= bound_plane_b2_result_h3;
        bound_of_a_aligned_second_h3 <= append(length_bound(8), 1);
        face_of_vertex0_0_h2 <= face_of_vertex(0)(0);
        face_of_vertex1_h2(0) <= face_of_vertex(1)(0);
        bound_side02_sum_second_h3 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex0_0_h2, 30);
        bound_side11_sum_sum_h2 <= resize(append(moment_bound(1), 1), 31) + resize(append(length_bound(6), 1), 31);
        bound_side12_sum_sum_aligned_second_h3 <= append(length_bound(7), 1);
        bound_side22_sum_second_h3 <= resize(face_of_vertex_h1(1)(2), 30) + resize(face_of_vertex1_h2(0), 30);
      end if;
      for k in 0 to 1 loop
        if strobe(0) = '1' then
          face_of_vertex_h1(k)(0) <= face_of_vertex(k)(0);
        end if;
        if strobe(1) = '1' then
          face_of_vertex_h1(k)(1) <= face_of_vertex(k)(1);
          face_of_vertex_h1(k)(2) <= face_of_vertex(k)(2);
        end if;
      end loop;
    end if;
  end process captures;
end architecture rtl;
