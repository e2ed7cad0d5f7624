-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with
-- bounds on their errors, verdict. Units are shared over the phases of the slot; a bound at a port covers all uses of
-- the unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements
-- of x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 34 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    phase       : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(17 downto 0);  -- whether the slot k slots ago holds a pair
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic := '0';
    separated   : out std_logic_vector(8 downto 0);
    overlapping : out std_logic_vector(8 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  signal in_v_outside : flag_x3_x3_t;
  signal in_w_outside : flag_x3_x3_t;
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 536870912
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 536870912
  signal in_phase_1 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(1 downto 0) := (others => '0');  -- one flag per phase
  signal pose_t_outside : std_logic_vector(2 downto 0);
  signal pose_m_used_outside : std_logic_vector(2 downto 0);
  signal row_m_select_at_1 : std_logic;
  signal row_m_select_at_0 : std_logic;
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 2147483644
  signal pose_m_used_outside_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal outside_flags : unsigned(23 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal coordinate_v1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_v2 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w0 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w2 : signed_18_vector_t;  -- |.| <= 131071
  signal level : unsigned(2 downto 0);
  signal places : std_logic;
  signal moment_m0 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m2 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m1 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_n : signed_18_vector_t;  -- |.| <= 131072
  signal coordinate_w0_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 17, 19, ... 23 on
  signal coordinate_w0_h8_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w0_h8_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_held : signed_18_vector_x3_t := zero_signed_18_vector_x3;  -- |.| <= 131071; from clocks 18, 20, 22 on
  signal coordinate_v2_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 18, 20, ... 24 on
  signal coordinate_w1_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 17, 19, ... 23 on
  signal coordinate_w2_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 17, 19, ... 23 on
  signal compared : signed_41_x15_t;  -- |.| <= 206156857344
  signal coordinate_v2_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w1_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w0_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w2_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal length_measure_h4 : unsigned_21_x4_t;
  signal length_measure5_h4 : unsigned(20 downto 0);
  signal length_measure_7_to_8_h4 : unsigned_21_7_to_8_t;
  signal length_measure4_h2 : unsigned(20 downto 0);
  signal length_measure6_h2 : unsigned(20 downto 0);
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
  signal level_h4_d1 : unsigned(2 downto 0);
  signal level_h4_d3 : unsigned(2 downto 0);
  signal compared_bound : signed_31_x15_t;  -- |.| <= 67665506
  signal coordinate_v1_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_v2_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w0_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w1_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w2_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal outside_held : std_logic_vector(15 downto 0) := (others => '0');  -- from clocks 3, 5, ... 33 on
begin
  -- Sections, in the order of the data
  pair_differences_section : entity work.pair_differences
    port map (clk => clk, phase => phase, holds => holds, in_v => in_v, in_w => in_w, pose_m => pose_m,
              pose_t => pose_t, pose_bypass => pose_bypass, in_phase_1 => in_phase_1, strobe => strobe,
              in_v_outside => in_v_outside, in_w_outside => in_w_outside, difference_v1 => difference_v1,
              difference_v2 => difference_v2, pose_t_outside => pose_t_outside,
              pose_m_used_outside => pose_m_used_outside, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_0 => row_m_select_at_0, difference_w0 => difference_w0, difference_w1 => difference_w1,
              difference_w2 => difference_w2);
  pair_coordinates_section : entity work.pair_coordinates
    port map (clk => clk, difference_v1 => difference_v1, difference_v2 => difference_v2, strobe => strobe,
              row_m_select_at_1 => row_m_select_at_1, difference_w0 => difference_w0, difference_w1 => difference_w1,
              difference_w2 => difference_w2, coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2,
              coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2,
              level => level, level_h4_d1 => level_h4_d1, level_h4_d3 => level_h4_d3);
  pair_moments_section : entity work.pair_moments
    port map (clk => clk, phase => phase, holds => holds, in_phase_1 => in_phase_1, strobe => strobe,
              row_m_select_at_1 => row_m_select_at_1, coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2,
              coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2,
              places => places, moment_m0 => moment_m0, moment_m2 => moment_m2, moment_m1 => moment_m1,
              moment_n => moment_n);
  pair_determinants_section : entity work.pair_determinants
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_0 => row_m_select_at_0, moment_m0 => moment_m0, moment_m2 => moment_m2,
              moment_m1 => moment_m1, moment_n => moment_n, coordinate_w0_h8_d2 => coordinate_w0_h8_d2,
              coordinate_v1_h6 => coordinate_v1_held(2), coordinate_v2_h8 => coordinate_v2_held(3),
              coordinate_w1_h8 => coordinate_w1_held(3), coordinate_w2_h8 => coordinate_w2_held(3),
              compared => compared);
  pair_norms_section : entity work.pair_norms
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_0 => row_m_select_at_0, coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2,
              coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2,
              level => level, places => places, coordinate_v2_h1 => coordinate_v2_h1,
              coordinate_v1_h1 => coordinate_v1_h1, coordinate_w1_h3 => coordinate_w1_h3,
              coordinate_w0_h3 => coordinate_w0_h3, coordinate_w2_h3 => coordinate_w2_h3,
              length_measure_h4 => length_measure_h4, length_measure5_h4 => length_measure5_h4,
              length_measure_7_to_8_h4 => length_measure_7_to_8_h4, length_measure4_h2 => length_measure4_h2,
              length_measure6_h2 => length_measure6_h2, length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result);
  pair_bounds_section : entity work.pair_bounds
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_0 => row_m_select_at_0, places => places, moment_m0 => moment_m0, moment_m2 => moment_m2,
              moment_m1 => moment_m1, moment_n => moment_n, length_measure_h4 => length_measure_h4,
              length_measure5_h4 => length_measure5_h4, length_measure_7_to_8_h4 => length_measure_7_to_8_h4,
              length_measure4_h2 => length_measure4_h2, length_measure6_h2 => length_measure6_h2,
              length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result, level_h4_d1 => level_h4_d1, level_h4_d3 => level_h4_d3,
              compared_bound => compared_bound);
  pair_witnesses_section : entity work.pair_witnesses
    port map (clk => clk, strobe => strobe, row_m_select_at_0 => row_m_select_at_0, outside => outside_i,
              level => level, coordinate_w0_x_h4 => coordinate_w0_held(1)(0),
              coordinate_w0_z_h6 => coordinate_w0_held(2)(2), coordinate_v1_x_h4 => coordinate_v1_held(1)(0),
              coordinate_v1_z_h4 => coordinate_v1_held(1)(2), coordinate_v2_x_h4 => coordinate_v2_held(1)(0),
              coordinate_v2_z_h4 => coordinate_v2_held(1)(2), coordinate_w1_x_h4 => coordinate_w1_held(1)(0),
              coordinate_w2_x_h4 => coordinate_w2_held(1)(0), coordinate_w1_z_h6 => coordinate_w1_held(2)(2),
              coordinate_w2_z_h6 => coordinate_w2_held(2)(2), compared => compared, compared_bound => compared_bound,
              coordinate_v1_y_h4_d1 => coordinate_v1_y_h4_d1, coordinate_v2_y_h4_d1 => coordinate_v2_y_h4_d1,
              coordinate_w0_y_h4_d1 => coordinate_w0_y_h4_d1, coordinate_w1_y_h4_d1 => coordinate_w1_y_h4_d1,
              coordinate_w2_y_h4_d1 => coordinate_w2_y_h4_d1, separated => separated, overlapping => overlapping,
              verdict => verdict);

  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      strobe(0) <= flag(phase = '1') and in_flight;
      strobe(1) <= flag(phase = '0') and in_flight;
    end if;
  end process strobes;
  in_phase_1 <= flag(phase = '1');
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or holds(5) or holds(6) or holds(7) or holds(8)
      or holds(9) or holds(10) or holds(11) or holds(12) or holds(13) or holds(14) or holds(15) or holds(16) or
      holds(17) or in_phase_1;

  -- Clock 2
  outside_flags <= unsigned(pose_m_used_outside_h1) & unsigned(pose_t_outside) & unsigned(in_w_outside(2)) &
      unsigned(in_w_outside(1)) & unsigned(in_w_outside(0)) & unsigned(in_v_outside(2)) & unsigned(in_v_outside(1)) &
      unsigned(in_v_outside(0));
  outside_i <= or_reduce(outside_flags);

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_v1_y_h4_d1 <= coordinate_v1_held(1)(1);
      coordinate_v2_y_h4_d1 <= coordinate_v2_held(1)(1);
      coordinate_w0_y_h4_d1 <= coordinate_w0_held(1)(1);
      coordinate_w1_y_h4_d1 <= coordinate_w1_held(1)(1);
      coordinate_w2_y_h4_d1 <= coordinate_w2_held(1)(1);
    end if;
  end process clock_21;

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_h8_d1 <= coordinate_w0_held(3);
    end if;
  end process clock_24;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_h8_d2 <= coordinate_w0_h8_d1;
    end if;
  end process clock_25;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        pose_m_used_outside_h1 <= pose_m_used_outside;
        coordinate_v1_held <= coordinate_v1 & coordinate_v1_held(0 to 1);
        coordinate_v2_held <= coordinate_v2 & coordinate_v2_held(0 to 2);
        coordinate_w1_h3 <= coordinate_w1_held(0);
        coordinate_w0_h3 <= coordinate_w0_held(0);
        coordinate_w2_h3 <= coordinate_w2_held(0);
        outside <= outside_held(15);
      end if;
      if strobe(0) = '1' then
        coordinate_w0_held <= coordinate_w0 & coordinate_w0_held(0 to 2);
        coordinate_w1_held <= coordinate_w1 & coordinate_w1_held(0 to 2);
        coordinate_w2_held <= coordinate_w2 & coordinate_w2_held(0 to 2);
        coordinate_v2_h1 <= coordinate_v2;
        coordinate_v1_h1 <= coordinate_v1;
        outside_held <= outside_held(14 downto 0) & outside_i;
      end if;
    end if;
  end process captures;
end architecture rtl;
