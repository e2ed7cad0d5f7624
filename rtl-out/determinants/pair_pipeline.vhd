-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with
-- bounds on their errors, verdict. Units are shared over the phases of the slot; a bound at a port covers all uses of
-- the unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements
-- of x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 27 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic;
    separated   : out std_logic_vector(8 downto 0);
    overlapping : out std_logic_vector(8 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  signal in_v_outside : flag_x3_x3_t;
  signal in_w_outside : flag_x3_x3_t;
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 536870912
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 536870912
  signal pose_t_outside : std_logic_vector(2 downto 0);
  signal pose_m_used_outside : std_logic_vector(2 downto 0);
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 2147483644
  signal in_v_outside_h1 : flag_x3_x3_t := zero_flag_x3_x3;
  signal in_w_outside_h1 : flag_x3_x3_t := zero_flag_x3_x3;
  signal pose_m_used_outside_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal outside_flags : unsigned(23 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal coordinate_v1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_v2 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w0 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w2 : signed_18_vector_t;  -- |.| <= 131071
  signal level : unsigned(2 downto 0);
  signal coordinate_w0_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w2_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v2_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal places : std_logic;
  signal moment_m0 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m1 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m2 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_n : signed_18_vector_t;  -- |.| <= 131072
  signal coordinate_w0_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w0_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w0_line : coordinate_w0_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal coordinate_v1_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_v1_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_v1_line : coordinate_v1_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal coordinate_w1_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w1_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w1_line : coordinate_w1_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal coordinate_v2_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_v2_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_v2_line : coordinate_v2_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal coordinate_w2_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w2_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w2_line : coordinate_w2_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal compared : signed_41_x15_t;  -- |.| <= 206156857344
  signal length_measure : unsigned_21_5_to_8_t;
  signal level_h3 : unsigned(2 downto 0);
  signal length_measure_h2 : unsigned_21_x5_t;
  signal length_measure0_plane_a0 : unsigned(23 downto 0);
  signal bound_plane_a1_sum_first_result : unsigned(23 downto 0);
  signal bound_plane_a2_sum_first_result : unsigned(23 downto 0);
  signal bound_plane_b1_result : unsigned(26 downto 0);
  signal bound_plane_b2_result : unsigned(26 downto 0);
  signal length_measure0_ends0 : unsigned(23 downto 0);
  signal length_measure0_ends1 : unsigned(23 downto 0);
  signal bound_side10_result : unsigned(24 downto 0);
  signal bound_side11_result : unsigned(24 downto 0);
  signal bound_side12_result : unsigned(24 downto 0);
  signal level_d5 : unsigned(2 downto 0);
  signal level_d7 : unsigned(2 downto 0);
  signal compared_bound : signed_31_x15_t;  -- |.| <= 67665506
  signal outside_line : std_logic_vector(1 to 25) := (others => '0');
begin
  -- Sections, in the order of the data
  pair_differences_section : entity work.pair_differences
    port map (clk => clk, in_v => in_v, in_w => in_w, pose_m => pose_m, pose_t => pose_t, pose_bypass => pose_bypass,
              in_v_outside => in_v_outside, in_w_outside => in_w_outside, difference_v1 => difference_v1,
              difference_v2 => difference_v2, pose_t_outside => pose_t_outside,
              pose_m_used_outside => pose_m_used_outside, difference_w0 => difference_w0,
              difference_w1 => difference_w1, difference_w2 => difference_w2);
  pair_coordinates_section : entity work.pair_coordinates
    port map (clk => clk, difference_v1 => difference_v1, difference_v2 => difference_v2,
              difference_w0 => difference_w0, difference_w1 => difference_w1, difference_w2 => difference_w2,
              coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2, coordinate_w0 => coordinate_w0,
              coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2, level => level, level_h3 => level_h3,
              level_d5 => level_d5, level_d7 => level_d7);
  pair_moments_section : entity work.pair_moments
    port map (clk => clk, coordinate_w0_d1 => coordinate_w0_d1, coordinate_w1_d1 => coordinate_w1_d1,
              coordinate_w2_d1 => coordinate_w2_d1, coordinate_v1_d1 => coordinate_v1_d1,
              coordinate_v2_d1 => coordinate_v2_d1, places => places, moment_m0 => moment_m0, moment_m1 => moment_m1,
              moment_m2 => moment_m2, moment_n => moment_n);
  pair_determinants_section : entity work.pair_determinants
    port map (clk => clk, moment_m0 => moment_m0, moment_m1 => moment_m1, moment_m2 => moment_m2, moment_n => moment_n,
              coordinate_w0_d6 => coordinate_w0_line(4), coordinate_v1_d6 => coordinate_v1_line(4),
              coordinate_w1_d6 => coordinate_w1_line(4), coordinate_v2_d6 => coordinate_v2_line(4),
              coordinate_w2_d6 => coordinate_w2_line(4), compared => compared);
  pair_norms_section : entity work.pair_norms
    port map (clk => clk, coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2,
              coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2,
              places => places, coordinate_w0_d2 => coordinate_w0_d2, coordinate_v1_d2 => coordinate_v1_d2,
              coordinate_w1_d2 => coordinate_w1_d2, coordinate_v2_d2 => coordinate_v2_d2,
              coordinate_w2_d2 => coordinate_w2_d2, level_h3 => level_h3, length_measure => length_measure,
              length_measure_h2 => length_measure_h2, length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result);
  pair_bounds_section : entity work.pair_bounds
    port map (clk => clk, places => places, moment_m0 => moment_m0, moment_m1 => moment_m1, moment_m2 => moment_m2,
              moment_n => moment_n, length_measure => length_measure, length_measure_h2 => length_measure_h2,
              length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result, level_d5 => level_d5, level_d7 => level_d7,
              compared_bound => compared_bound);
  pair_witnesses_section : entity work.pair_witnesses
    port map (clk => clk, outside => outside_i, level => level, coordinate_w0_d2 => coordinate_w0_d2,
              coordinate_v1_d2 => coordinate_v1_d2, coordinate_w1_d2 => coordinate_w1_d2,
              coordinate_v2_d2 => coordinate_v2_d2, coordinate_w2_d2 => coordinate_w2_d2, compared => compared,
              compared_bound => compared_bound, separated => separated, overlapping => overlapping, verdict => verdict);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      in_v_outside_h1 <= in_v_outside;
      in_w_outside_h1 <= in_w_outside;
      pose_m_used_outside_h1 <= pose_m_used_outside;
    end if;
  end process clock_2;
  outside_flags <= unsigned(pose_m_used_outside_h1) & unsigned(pose_t_outside) & unsigned(in_w_outside_h1(2)) &
      unsigned(in_w_outside_h1(1)) & unsigned(in_w_outside_h1(0)) & unsigned(in_v_outside_h1(2)) &
      unsigned(in_v_outside_h1(1)) & unsigned(in_v_outside_h1(0));
  outside_i <= or_reduce(outside_flags);

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_d1 <= coordinate_w0;
      coordinate_w1_d1 <= coordinate_w1;
      coordinate_w2_d1 <= coordinate_w2;
      coordinate_v1_d1 <= coordinate_v1;
      coordinate_v2_d1 <= coordinate_v2;
    end if;
  end process clock_14;

  -- Clock 15
  clock_15 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_d2 <= coordinate_w0_d1;
      coordinate_v1_d2 <= coordinate_v1_d1;
      coordinate_w1_d2 <= coordinate_w1_d1;
      coordinate_v2_d2 <= coordinate_v2_d1;
      coordinate_w2_d2 <= coordinate_w2_d1;
    end if;
  end process clock_15;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_line <= coordinate_w0_d2 & coordinate_w0_line(1 to 3);
      coordinate_v1_line <= coordinate_v1_d2 & coordinate_v1_line(1 to 3);
      coordinate_w1_line <= coordinate_w1_d2 & coordinate_w1_line(1 to 3);
      coordinate_v2_line <= coordinate_v2_d2 & coordinate_v2_line(1 to 3);
      coordinate_w2_line <= coordinate_w2_d2 & coordinate_w2_line(1 to 3);
      outside_line <= outside_i & outside_line(1 to 24);
    end if;
  end process delays;

  -- Outputs
  outside <= outside_line(25);
end architecture rtl;
