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
    strobe                          : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_1               : in  std_logic;
    row_m_select_at_0               : in  std_logic;
    coordinate_v1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2                   : in  signed_18_vector_t;  -- |.| <= 131071
    level                           : in  unsigned(2 downto 0);
    places                          : in  std_logic;
    coordinate_v2_h1                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_h1                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_h3                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0_h3                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_h3                : in  signed_18_vector_t;  -- |.| <= 131071
    length_measure_h4               : out unsigned_21_x4_t;
    length_measure5_h4              : out unsigned(20 downto 0);
    length_measure_7_to_8_h4        : out unsigned_21_7_to_8_t;
    length_measure4_h2              : out unsigned(20 downto 0);
    length_measure6_h2              : out unsigned(20 downto 0);
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
  signal norm_x0_resized_third_h2 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 131071
  signal norm_x : signed_19_vector_x4_t;  -- |.| <= 262142
  signal norm_x_d1 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 262142
  signal norm_x2_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal norm_x3_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal norm_lane : unsigned_21_x5_t;
  signal length_measure : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal norm_x_resized_h2 : signed_19_vector_3_to_4_t := zero_signed_19_vector_3_to_4;  -- |.| <= 131071
  signal norm_x4_resized_h2_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 131071
  signal rest_of_level : unsigned(14 downto 0);
  signal rest_of_level_aligned : unsigned(15 downto 0);
  signal rest_aligned_second_h2 : unsigned(16 downto 0) := (others => '0');
  signal rest_of_level_aligned_h2 : unsigned(15 downto 0) := (others => '0');
  signal rest : unsigned(16 downto 0);  -- c(3); four times that is c(5)
  signal length_measure_h2 : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal length_measure_h4_i : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal length_measure_held : unsigned_21_x6_t := zero_unsigned_21_x6;  -- from clock 26 on
  signal length_measure_7_to_8_held : unsigned_21_7_to_8_t := zero_unsigned_21_7_to_8;  -- from clock 26 on
  signal rest_held : unsigned_17_x2_t := zero_unsigned_17_x2;  -- from clocks 24, 26 on
  signal norm_lane_unit_x : signed_19_vector_x5_t;
  signal length_measure0_plane_a0_unit_v : unsigned_21_x2_t;
  signal length_measure0_plane_a0_unit_w : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_b : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_plane_a : unsigned_24_x3_t;
  signal length_measure0_plane_a0_unit_plane_b : unsigned_27_x2_t;
  signal length_measure0_plane_a0_unit_ends : unsigned_24_x2_t;
  signal length_measure0_plane_a0_unit_middle : unsigned_25_x3_t;
begin
  -- Clock 17
  e_a1_each : for i in 0 to 2 generate
    e_a1(i) <= resize(coordinate_v2_h1(i), 19) - resize(coordinate_v1_h1(i), 19);
    norm_x(0)(i) <= norm_x0_resized_third_h2(i) when row_m_select_at_1 = '1' else resize(coordinate_v1(i), 19);
    norm_x(1)(i) <= e_b(0)(i) when row_m_select_at_1 = '1' else resize(coordinate_v2(i), 19);
  end generate e_a1_each;
  norm_x(3) <= e_b(2) when row_m_select_at_1 = '1' else norm_x_resized_h2(3);

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 1 loop
        norm_x_d1(k) <= norm_x(k);
      end loop;
      norm_x3_d1 <= norm_x(3);
      norm_x4_resized_h2_d1 <= norm_x_resized_h2(4);
    end if;
  end process clock_18;
  e_b_0_each : for i in 0 to 2 generate
    e_b(0)(i) <= resize(coordinate_w1_h3(i), 19) - resize(coordinate_w0_h3(i), 19);
    e_b(1)(i) <= resize(coordinate_w2_h3(i), 19) - resize(coordinate_w1_h3(i), 19);
    e_b(2)(i) <= resize(coordinate_w0_h3(i), 19) - resize(coordinate_w2_h3(i), 19);
  end generate e_b_0_each;
  norm_x(2) <= e_b(1) when row_m_select_at_0 = '1' else e_a1;
  norm_lane_unit_x(0) <= norm_x_d1(0);
  norm_lane_unit_x(1) <= norm_x_d1(1);
  norm_lane_unit_x(2) <= norm_x2_d1;
  norm_lane_unit_x(3) <= norm_x3_d1;
  norm_lane_unit_x(4) <= norm_x4_resized_h2_d1;
  norm_lane_unit : for k in 0 to 4 generate
    unit : entity work.vector_norm
      port map (clk => clk, x => norm_lane_unit_x(k), norm => norm_lane(k));
  end generate norm_lane_unit;

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      norm_x2_d1 <= norm_x(2);
    end if;
  end process clock_19;

  -- Clock 20
  rest_of_level <=
    to_unsigned(64, 15) when known(level) = 0 else
    to_unsigned(64, 15) when known(level) = 1 else
    to_unsigned(64, 15) when known(level) = 2 else
    to_unsigned(256, 15) when known(level) = 3 else
    to_unsigned(1024, 15) when known(level) = 4 else
    to_unsigned(4096, 15) when known(level) = 5 else
    to_unsigned(16384, 15);
  rest_of_level_aligned <= append(rest_of_level, 1);

  -- Clock 22
  rest <= resize(rest_of_level_aligned_h2, 17) when places = '1' else rest_aligned_second_h2;

  -- Clock 26
  length_measure0_plane_a0_unit_v_each : for k in 0 to 1 generate
    length_measure0_plane_a0_unit_v(k) <= length_measure_held(k);
  end generate length_measure0_plane_a0_unit_v_each;
  length_measure0_plane_a0_unit_w_each : for k in 0 to 2 generate
    length_measure0_plane_a0_unit_w(k) <= length_measure_held(k + 2);
  end generate length_measure0_plane_a0_unit_w_each;
  length_measure0_plane_a0_unit_b(0) <= length_measure_held(5);
  length_measure0_plane_a0_unit_b(1) <= length_measure_h4_i(6);
  length_measure0_plane_a0_unit_b(2) <= length_measure_7_to_8_held(7);
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
    port map (clk => clk, v => length_measure0_plane_a0_unit_v, a => length_measure_7_to_8_held(8),
              w => length_measure0_plane_a0_unit_w, b => length_measure0_plane_a0_unit_b, rest => rest_held(1),
              plane_a => length_measure0_plane_a0_unit_plane_a, plane_b => length_measure0_plane_a0_unit_plane_b,
              ends => length_measure0_plane_a0_unit_ends, middle => length_measure0_plane_a0_unit_middle);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        for i in 0 to 2 loop
          norm_x0_resized_third_h2(i) <= resize(coordinate_w2(i), 19);
        end loop;
        length_measure(4) <= norm_lane(0);
        length_measure(5) <= norm_lane(1);
        length_measure(7) <= norm_lane(3);
        length_measure(8) <= norm_lane(2);
        for i in 0 to 2 loop
          norm_x_resized_h2(3)(i) <= resize(coordinate_w0(i), 19);
          norm_x_resized_h2(4)(i) <= resize(coordinate_w1(i), 19);
        end loop;
        length_measure_h2(4) <= length_measure(4);
        length_measure_h2(5) <= length_measure(5);
        length_measure_h2(7) <= length_measure(7);
        length_measure_h2(8) <= length_measure(8);
        length_measure_h4_i(4) <= length_measure_h2(4);
        length_measure_h4_i(5) <= length_measure_h2(5);
        length_measure_h4_i(7) <= length_measure_h2(7);
        length_measure_h4_i(8) <= length_measure_h2(8);
      end if;
      if strobe(1) = '1' then
        length_measure(0) <= norm_lane(0);
        length_measure(1) <= norm_lane(1);
        length_measure(2) <= norm_lane(3);
        length_measure(3) <= norm_lane(4);
        length_measure(6) <= norm_lane(2);
        rest_aligned_second_h2 <= append(rest_of_level_aligned, 1);
        rest_of_level_aligned_h2 <= rest_of_level_aligned;
        for k in 0 to 3 loop
          length_measure_h2(k) <= length_measure(k);
        end loop;
        length_measure_h2(6) <= length_measure(6);
        for k in 0 to 3 loop
          length_measure_h4_i(k) <= length_measure_h2(k);
        end loop;
        length_measure_h4_i(6) <= length_measure_h2(6);
        for k in 0 to 5 loop
          length_measure_held(k) <= length_measure_h4_i(k);
        end loop;
        for k in 7 to 8 loop
          length_measure_7_to_8_held(k) <= length_measure_h4_i(k);
        end loop;
        rest_held(0) <= rest;
        rest_held(1) <= rest_held(0);
      end if;
    end if;
  end process captures;

  -- Outputs
  length_measure_h4_each : for k in 0 to 3 generate
    length_measure_h4(k) <= length_measure_h4_i(k);
  end generate length_measure_h4_each;
  length_measure5_h4 <= length_measure_h4_i(5);
  length_measure_7_to_8_h4_each : for k in 7 to 8 generate
    length_measure_7_to_8_h4(k) <= length_measure_h4_i(k);
  end generate length_measure_7_to_8_h4_each;
  length_measure4_h2 <= length_measure_h2(4);
  length_measure6_h2 <= length_measure_h2(6);
end architecture rtl;
