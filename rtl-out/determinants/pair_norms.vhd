-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 5: edges, norms of vertices and edges, and what the bounds have beside F.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_norms is
  port (
    clk                             : in  std_logic;
    coordinate_v1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2                   : in  signed_18_vector_t;  -- |.| <= 131071
    places                          : in  std_logic;
    coordinate_w0_d2                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_d2                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_d2                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_d2                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_d2                : in  signed_18_vector_t;  -- |.| <= 131071
    level_h3                        : in  unsigned(2 downto 0);
    length_measure                  : out unsigned_21_5_to_8_t;
    length_measure_h2               : out unsigned_21_x5_t;
    length_measure0_plane_a0        : out unsigned(23 downto 0);
    bound_plane_a1_sum_first_result : out unsigned(23 downto 0);
    bound_plane_a2_sum_first_result : out unsigned(23 downto 0);
    bound_plane_b1_result           : out unsigned(26 downto 0);
    bound_plane_b2_result           : out unsigned(26 downto 0);
    length_measure0_ends0           : out unsigned(23 downto 0);
    length_measure0_ends1           : out unsigned(23 downto 0);
    bound_side10_result             : out unsigned(24 downto 0);
    bound_side11_result             : out unsigned(24 downto 0);
    bound_side12_result             : out unsigned(24 downto 0)
  );
end entity pair_norms;

architecture rtl of pair_norms is
  signal e_a1 : signed_19_vector_t;  -- |.| <= 262142
  signal e_b : signed_19_vector_x3_t;  -- |.| <= 262142
  signal norm_x_0_to_1_resized_d1 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 131071
  signal norm_x_resized_d1 : signed_19_vector_3_to_5_t := zero_signed_19_vector_3_to_5;  -- |.| <= 131071
  signal norm_lane : unsigned_21_x9_t;
  signal e_a1_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal length_measure_i : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal e_b_d1 : signed_19_vector_x3_t := zero_signed_19_vector_x3;  -- |.| <= 262142
  signal rest_of_level : unsigned(14 downto 0);
  signal rest_of_level_aligned : unsigned(15 downto 0);
  signal rest_aligned_second_h1 : unsigned(16 downto 0) := (others => '0');
  signal rest_of_level_aligned_h1 : unsigned(15 downto 0) := (others => '0');
  signal rest : unsigned(16 downto 0);  -- c(3); four times that is c(5)
  type length_measure_h2_line_t is array (1 to 3) of unsigned_21_x5_t;
  signal length_measure_h2_line : length_measure_h2_line_t := (others => zero_unsigned_21_x5);
  signal length_measure_5_to_8_h2 : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal length_measure_h3 : unsigned_21_x5_t := zero_unsigned_21_x5;
  signal length_measure_h4 : unsigned_21_x5_t := zero_unsigned_21_x5;
  signal length_measure_h1 : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal rest_h1 : unsigned(16 downto 0) := (others => '0');
  signal rest_h2 : unsigned(16 downto 0) := (others => '0');
  signal norm_lane_unit_x : signed_19_vector_x9_t;
  signal length_measure0_plane_a0_unit_v : unsigned_21_x2_t;
  signal length_measure0_plane_a0_unit_w : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_b : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_plane_a : unsigned_24_x3_t;
  signal length_measure0_plane_a0_unit_plane_b : unsigned_27_x2_t;
  signal length_measure0_plane_a0_unit_ends : unsigned_24_x2_t;
  signal length_measure0_plane_a0_unit_middle : unsigned_25_x3_t;
begin
  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        norm_x_0_to_1_resized_d1(0)(i) <= resize(coordinate_v1(i), 19);
        norm_x_0_to_1_resized_d1(1)(i) <= resize(coordinate_v2(i), 19);
        norm_x_resized_d1(3)(i) <= resize(coordinate_w0(i), 19);
        norm_x_resized_d1(4)(i) <= resize(coordinate_w1(i), 19);
        norm_x_resized_d1(5)(i) <= resize(coordinate_w2(i), 19);
      end loop;
    end if;
  end process clock_14;
  norm_lane_unit_x(0) <= norm_x_0_to_1_resized_d1(0);
  norm_lane_unit_x(1) <= norm_x_0_to_1_resized_d1(1);
  norm_lane_unit_x(2) <= e_a1_d1;
  norm_lane_unit_x(3) <= norm_x_resized_d1(3);
  norm_lane_unit_x(4) <= norm_x_resized_d1(4);
  norm_lane_unit_x(5) <= norm_x_resized_d1(5);
  norm_lane_unit_x(6) <= e_b_d1(0);
  norm_lane_unit_x(7) <= e_b_d1(1);
  norm_lane_unit_x(8) <= e_b_d1(2);
  norm_lane_unit : for k in 0 to 8 generate
    unit : entity work.vector_norm
      port map (clk => clk, x => norm_lane_unit_x(k), norm => norm_lane(k));
  end generate norm_lane_unit;

  -- Clock 15
  e_a1_each : for i in 0 to 2 generate
    e_a1(i) <= resize(coordinate_v2_d2(i), 19) - resize(coordinate_v1_d2(i), 19);
    e_b(0)(i) <= resize(coordinate_w1_d2(i), 19) - resize(coordinate_w0_d2(i), 19);
    e_b(1)(i) <= resize(coordinate_w2_d2(i), 19) - resize(coordinate_w1_d2(i), 19);
    e_b(2)(i) <= resize(coordinate_w0_d2(i), 19) - resize(coordinate_w2_d2(i), 19);
  end generate e_a1_each;

  -- Clock 16
  clock_16 : process (clk)
  begin
    if rising_edge(clk) then
      e_a1_d1 <= e_a1;
      e_b_d1 <= e_b;
    end if;
  end process clock_16;

  -- Clock 17
  rest_of_level <=
    to_unsigned(64, 15) when known(level_h3) = 0 else
    to_unsigned(64, 15) when known(level_h3) = 1 else
    to_unsigned(64, 15) when known(level_h3) = 2 else
    to_unsigned(256, 15) when known(level_h3) = 3 else
    to_unsigned(1024, 15) when known(level_h3) = 4 else
    to_unsigned(4096, 15) when known(level_h3) = 5 else
    to_unsigned(16384, 15);
  rest_of_level_aligned <= append(rest_of_level, 1);

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      length_measure_i(5) <= norm_lane(6);
      length_measure_i(6) <= norm_lane(7);
      length_measure_i(7) <= norm_lane(8);
      length_measure_i(8) <= norm_lane(2);
      rest_aligned_second_h1 <= append(rest_of_level_aligned, 1);
      rest_of_level_aligned_h1 <= rest_of_level_aligned;
    end if;
  end process clock_18;
  rest <= resize(rest_of_level_aligned_h1, 17) when places = '1' else rest_aligned_second_h1;

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      length_measure_h3 <= length_measure_h2_line(3);
      length_measure_h1 <= length_measure_i;
      rest_h1 <= rest;
    end if;
  end process clock_19;

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      length_measure_5_to_8_h2 <= length_measure_h1;
      length_measure_h4 <= length_measure_h3;
      rest_h2 <= rest_h1;
    end if;
  end process clock_20;
  length_measure0_plane_a0_unit_v_each : for k in 0 to 1 generate
    length_measure0_plane_a0_unit_v(k) <= length_measure_h4(k);
  end generate length_measure0_plane_a0_unit_v_each;
  length_measure0_plane_a0_unit_w_each : for k in 0 to 2 generate
    length_measure0_plane_a0_unit_w(k) <= length_measure_h4(k + 2);
    length_measure0_plane_a0_unit_b(k) <= length_measure_5_to_8_h2(k + 5);
  end generate length_measure0_plane_a0_unit_w_each;
  length_measure0_plane_a0 <= length_measure0_plane_a0_unit_plane_a(0);
  bound_plane_a1_sum_first_result <= length_measure0_plane_a0_unit_plane_a(1);
  bound_plane_a2_sum_first_result <= length_measure0_plane_a0_unit_plane_a(2);
  bound_plane_b1_result <= length_measure0_plane_a0_unit_plane_b(0);
  bound_plane_b2_result <= length_measure0_plane_a0_unit_plane_b(1);
  length_measure0_ends0 <= length_measure0_plane_a0_unit_ends(0);
  length_measure0_ends1 <= length_measure0_plane_a0_unit_ends(1);
  bound_side10_result <= length_measure0_plane_a0_unit_middle(0);
  bound_side11_result <= length_measure0_plane_a0_unit_middle(1);
  bound_side12_result <= length_measure0_plane_a0_unit_middle(2);
  length_measure0_plane_a0_unit : entity work.bound_tails
    port map (clk => clk, v => length_measure0_plane_a0_unit_v, a => length_measure_5_to_8_h2(8),
              w => length_measure0_plane_a0_unit_w, b => length_measure0_plane_a0_unit_b, rest => rest_h2,
              plane_a => length_measure0_plane_a0_unit_plane_a, plane_b => length_measure0_plane_a0_unit_plane_b,
              ends => length_measure0_plane_a0_unit_ends, middle => length_measure0_plane_a0_unit_middle);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      length_measure_h2_line(1)(0) <= norm_lane(0);
      length_measure_h2_line(1)(1) <= norm_lane(1);
      length_measure_h2_line(1)(2) <= norm_lane(3);
      length_measure_h2_line(1)(3) <= norm_lane(4);
      length_measure_h2_line(1)(4) <= norm_lane(5);
      length_measure_h2_line(2 to 3) <= length_measure_h2_line(1 to 2);
    end if;
  end process delays;

  -- Outputs
  length_measure <= length_measure_i;
  length_measure_h2 <= length_measure_h2_line(3);
end architecture rtl;
