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
    strobe                          : in  std_logic_vector(2 downto 0);  -- one flag per phase
    row_m_select_at_0               : in  unsigned(1 downto 0);
    coordinate_v1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1                   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2                   : in  signed_18_vector_t;  -- |.| <= 131071
    level                           : in  unsigned(2 downto 0);
    places                          : in  std_logic;
    coordinate_v2_h1                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_h1                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_h4                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0_h4                : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_h4                : in  signed_18_vector_t;  -- |.| <= 131071
    length_measure                  : out unsigned_21_x8_t;
    length_measure8_h3              : out unsigned(20 downto 0);
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
  signal norm_x_resized_third_h3 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 131071
  signal norm_x : signed_19_vector_x3_t;  -- |.| <= 262142
  signal norm_x_d1 : signed_19_vector_x3_t := zero_signed_19_vector_x3;  -- |.| <= 262142
  signal norm_lane : unsigned_21_x3_t;
  signal length_measure_i : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal norm_x2_resized_h3 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 131071
  signal rest_of_level : unsigned(14 downto 0);
  signal rest_of_level_aligned : unsigned(15 downto 0);
  signal rest_aligned_second_h3 : unsigned(16 downto 0) := (others => '0');
  signal rest_of_level_aligned_h3 : unsigned(15 downto 0) := (others => '0');
  signal rest : unsigned(16 downto 0);  -- c(3); four times that is c(5)
  signal length_measure_held : unsigned_21_x9_t := zero_unsigned_21_x9;  -- from clock 27 on
  signal rest_h1 : unsigned(16 downto 0) := (others => '0');
  signal length_measure0_plane_a0_unit_v : unsigned_21_x2_t;
  signal length_measure0_plane_a0_unit_w : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_b : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_plane_a : unsigned_24_x3_t;
  signal length_measure0_plane_a0_unit_plane_b : unsigned_27_x2_t;
  signal length_measure0_plane_a0_unit_ends : unsigned_24_x2_t;
  signal length_measure0_plane_a0_unit_middle : unsigned_25_x3_t;
begin
  -- Clock 20
  e_a1_each : for i in 0 to 2 generate
    e_a1(i) <= resize(coordinate_v2_h1(i), 19) - resize(coordinate_v1_h1(i), 19);
  end generate e_a1_each;

  -- Clock 21
  e_b_0_each : for i in 0 to 2 generate
    e_b(0)(i) <= resize(coordinate_w1_h4(i), 19) - resize(coordinate_w0_h4(i), 19);
    e_b(1)(i) <= resize(coordinate_w2_h4(i), 19) - resize(coordinate_w1_h4(i), 19);
    e_b(2)(i) <= resize(coordinate_w0_h4(i), 19) - resize(coordinate_w2_h4(i), 19);
    norm_x(0)(i) <=
      resize(coordinate_v1(i), 19) when known(row_m_select_at_0) = 0 else
      norm_x_resized_third_h3(0)(i) when known(row_m_select_at_0) = 1 else
      e_b(0)(i);
    norm_x(1)(i) <=
      resize(coordinate_v2(i), 19) when known(row_m_select_at_0) = 0 else
      norm_x_resized_third_h3(1)(i) when known(row_m_select_at_0) = 1 else
      e_b(1)(i);
  end generate e_b_0_each;
  norm_x(2) <=
    e_a1 when known(row_m_select_at_0) = 0 else
    norm_x2_resized_h3 when known(row_m_select_at_0) = 1 else
    e_b(2);

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      norm_x_d1 <= norm_x;
    end if;
  end process clock_22;
  norm_lane_unit : for k in 0 to 2 generate
    unit : entity work.vector_norm
      port map (clk => clk, x => norm_x_d1(k), norm => norm_lane(k));
  end generate norm_lane_unit;

  -- Clock 23
  rest_of_level <=
    to_unsigned(64, 15) when known(level) = 0 else
    to_unsigned(64, 15) when known(level) = 1 else
    to_unsigned(64, 15) when known(level) = 2 else
    to_unsigned(256, 15) when known(level) = 3 else
    to_unsigned(1024, 15) when known(level) = 4 else
    to_unsigned(4096, 15) when known(level) = 5 else
    to_unsigned(16384, 15);
  rest_of_level_aligned <= append(rest_of_level, 1);

  -- Clock 26
  rest <= resize(rest_of_level_aligned_h3, 17) when places = '1' else rest_aligned_second_h3;

  -- Clock 27
  length_measure0_plane_a0_unit_v_each : for k in 0 to 1 generate
    length_measure0_plane_a0_unit_v(k) <= length_measure_held(k);
  end generate length_measure0_plane_a0_unit_v_each;
  length_measure0_plane_a0_unit_w_each : for k in 0 to 2 generate
    length_measure0_plane_a0_unit_w(k) <= length_measure_held(k + 2);
    length_measure0_plane_a0_unit_b(k) <= length_measure_held(k + 5);
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
    port map (clk => clk, v => length_measure0_plane_a0_unit_v, a => length_measure_held(8),
              w => length_measure0_plane_a0_unit_w, b => length_measure0_plane_a0_unit_b, rest => rest_h1,
              plane_a => length_measure0_plane_a0_unit_plane_a, plane_b => length_measure0_plane_a0_unit_plane_b,
              ends => length_measure0_plane_a0_unit_ends, middle => length_measure0_plane_a0_unit_middle);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        for i in 0 to 2 loop
          norm_x_resized_third_h3(0)(i) <= resize(coordinate_w0(i), 19);
          norm_x_resized_third_h3(1)(i) <= resize(coordinate_w1(i), 19);
        end loop;
        length_measure_i(5) <= norm_lane(0);
        length_measure_i(6) <= norm_lane(1);
        length_measure_i(7) <= norm_lane(2);
        for i in 0 to 2 loop
          norm_x2_resized_h3(i) <= resize(coordinate_w2(i), 19);
        end loop;
        rest_aligned_second_h3 <= append(rest_of_level_aligned, 1);
        rest_of_level_aligned_h3 <= rest_of_level_aligned;
      end if;
      if strobe(2) = '1' then
        length_measure_i(0) <= norm_lane(0);
        length_measure_i(1) <= norm_lane(1);
        length_measure_i(8) <= norm_lane(2);
        length_measure_held <= length_measure_i;
        rest_h1 <= rest;
      end if;
      if strobe(0) = '1' then
        length_measure_i(2) <= norm_lane(0);
        length_measure_i(3) <= norm_lane(1);
        length_measure_i(4) <= norm_lane(2);
      end if;
    end if;
  end process captures;

  -- Outputs
  length_measure_each : for k in 0 to 7 generate
    length_measure(k) <= length_measure_i(k);
  end generate length_measure_each;
  length_measure8_h3 <= length_measure_held(8);
end architecture rtl;
