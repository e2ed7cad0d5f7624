-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with
-- bounds on their errors, verdict. Units are shared over the phases of the slot; a bound at a port covers all uses of
-- the unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements
-- of x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 39 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    phase       : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(13 downto 0);  -- whether the slot k slots ago holds a pair
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
  constant row_m_select_at_1_table : numbers_t(0 to 3) := (0, 1, 2, others => 0);
  constant row_m_select_at_0_table : numbers_t(0 to 3) := (1, 2, 0, others => 0);
  constant row_m_select_at_2_table : numbers_t(0 to 3) := (2, 0, 1, others => 0);
  signal in_v_outside : flag_x3_x3_t;
  signal in_w_outside : flag_x3_x3_t;
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 536870912
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 536870912
  signal in_phase_2 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(2 downto 0) := (others => '0');  -- one flag per phase
  signal pose_t_outside : std_logic_vector(2 downto 0);
  signal pose_m_used_outside : std_logic_vector(2 downto 0);
  signal row_m_select_at_1 : unsigned(1 downto 0) := (others => '0');
  signal row_m_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 2147483644
  signal outside_flags : unsigned(23 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal lane1_select_at_0 : std_logic;
  signal coordinate_v1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_v2 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w0 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w2 : signed_18_vector_t;  -- |.| <= 131071
  signal level : unsigned(2 downto 0);
  signal row_m_select_at_2 : unsigned(1 downto 0) := (others => '0');
  signal places : std_logic;
  signal moment_m0 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m2 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_m1 : signed_18_vector_t;  -- |.| <= 131072
  signal moment_n : signed_18_vector_t;  -- |.| <= 131072
  signal coordinate_w0_held : signed_18_vector_x3_t := zero_signed_18_vector_x3;  -- |.| <= 131071; from clocks 20, 23, 26 on
  signal coordinate_w1_held : signed_18_vector_x3_t := zero_signed_18_vector_x3;  -- |.| <= 131071; from clocks 20, 23, 26 on
  signal coordinate_v2_held : signed_18_vector_x2_t := zero_signed_18_vector_x2;  -- |.| <= 131071; from clocks 22, 25 on
  signal coordinate_v1_held : signed_18_vector_x2_t := zero_signed_18_vector_x2;  -- |.| <= 131071; from clocks 22, 25 on
  signal coordinate_w2_held : signed_18_vector_x3_t := zero_signed_18_vector_x3;  -- |.| <= 131071; from clocks 20, 23, 26 on
  signal lane1_select_at_1 : std_logic;
  signal lane1_select_at_2 : std_logic;
  signal compared : signed_41_x15_t;  -- |.| <= 206156857344
  signal coordinate_v2_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w1_h4 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w0_h4 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w2_h4 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal length_measure : unsigned_21_x8_t;
  signal length_measure8_h3 : unsigned(20 downto 0);
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
  signal level_h2_d1 : unsigned(2 downto 0);
  signal level_h2_d4 : unsigned(2 downto 0);
  signal compared_bound : signed_31_x15_t;  -- |.| <= 67665506
  signal outside_held : std_logic_vector(11 downto 0) := (others => '0');  -- from clocks 3, 6, ... 36 on
  signal outside_h24 : std_logic := '0';
  signal outside_h32 : std_logic := '0';
  signal busy_25 : std_logic := '0';  -- set in clocks 24 to 26 of a pair
  signal busy_34 : std_logic := '0';  -- set in clocks 33 to 35 of a pair
  signal busy_1_to_34 : std_logic;  -- a pair comes to clock 1, 25, 34 or is in it
  signal in_phase_1 : std_logic;
  signal busy_3 : std_logic := '0';  -- set in clocks 2 to 4 of a pair
  signal busy_12 : std_logic := '0';  -- set in clocks 11 to 13 of a pair
  signal busy_21 : std_logic := '0';  -- set in clocks 20 to 22 of a pair
  signal busy_33 : std_logic := '0';  -- set in clocks 32 to 34 of a pair
  signal busy_3_to_33 : std_logic;  -- a pair comes to clock 3, 12, 21, 33 or is in it
  signal in_phase_0 : std_logic;
  signal busy_17 : std_logic := '0';  -- set in clocks 16 to 18 of a pair
  signal busy_23 : std_logic := '0';  -- set in clocks 22 to 24 of a pair
  signal busy_26 : std_logic := '0';  -- set in clocks 25 to 27 of a pair
  signal busy_17_to_26 : std_logic;  -- a pair comes to clock 17, 23, 26 or is in it
begin
  -- Sections, in the order of the data
  pair_differences_section : entity work.pair_differences
    port map (clk => clk, in_v => in_v, in_w => in_w, pose_m => pose_m, pose_t => pose_t, pose_bypass => pose_bypass,
              strobe => strobe, row_m_select_at_1 => row_m_select_at_1, row_m_select_at_0 => row_m_select_at_0,
              in_v_outside => in_v_outside, in_w_outside => in_w_outside, difference_v1 => difference_v1,
              difference_v2 => difference_v2, pose_t_outside => pose_t_outside,
              pose_m_used_outside => pose_m_used_outside, difference_w0 => difference_w0,
              difference_w1 => difference_w1, difference_w2 => difference_w2);
  pair_coordinates_section : entity work.pair_coordinates
    port map (clk => clk, phase => phase, holds => holds, difference_v1 => difference_v1,
              difference_v2 => difference_v2, in_phase_2 => in_phase_2, strobe => strobe,
              row_m_select_at_0 => row_m_select_at_0, difference_w0 => difference_w0, difference_w1 => difference_w1,
              difference_w2 => difference_w2, busy_25 => busy_25, in_phase_1 => in_phase_1, busy_12 => busy_12,
              busy_26 => busy_26, lane1_select_at_0 => lane1_select_at_0, coordinate_v1 => coordinate_v1,
              coordinate_v2 => coordinate_v2, coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1,
              coordinate_w2 => coordinate_w2, level => level, lane1_select_at_1 => lane1_select_at_1,
              lane1_select_at_2 => lane1_select_at_2, level_h2_d1 => level_h2_d1, level_h2_d4 => level_h2_d4);
  pair_moments_section : entity work.pair_moments
    port map (clk => clk, phase => phase, holds => holds, strobe => strobe, lane1_select_at_0 => lane1_select_at_0,
              coordinate_v1 => coordinate_v1, coordinate_v2 => coordinate_v2, coordinate_w0 => coordinate_w0,
              coordinate_w1 => coordinate_w1, coordinate_w2 => coordinate_w2, row_m_select_at_2 => row_m_select_at_2,
              in_phase_0 => in_phase_0, places => places, moment_m0 => moment_m0, moment_m2 => moment_m2,
              moment_m1 => moment_m1, moment_n => moment_n);
  pair_determinants_section : entity work.pair_determinants
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_2 => row_m_select_at_2, moment_m0 => moment_m0, moment_m2 => moment_m2,
              moment_m1 => moment_m1, moment_n => moment_n, coordinate_w0_h6 => coordinate_w0_held(1),
              coordinate_w1_h9 => coordinate_w1_held(2), coordinate_v2_h6 => coordinate_v2_held(1),
              coordinate_v1_h6 => coordinate_v1_held(1), coordinate_w0_h9 => coordinate_w0_held(2),
              coordinate_w2_h9 => coordinate_w2_held(2), lane1_select_at_1 => lane1_select_at_1,
              lane1_select_at_2 => lane1_select_at_2, compared => compared);
  pair_norms_section : entity work.pair_norms
    port map (clk => clk, strobe => strobe, row_m_select_at_0 => row_m_select_at_0, coordinate_v1 => coordinate_v1,
              coordinate_v2 => coordinate_v2, coordinate_w0 => coordinate_w0, coordinate_w1 => coordinate_w1,
              coordinate_w2 => coordinate_w2, level => level, places => places, coordinate_v2_h1 => coordinate_v2_h1,
              coordinate_v1_h1 => coordinate_v1_h1, coordinate_w1_h4 => coordinate_w1_h4,
              coordinate_w0_h4 => coordinate_w0_h4, coordinate_w2_h4 => coordinate_w2_h4,
              length_measure => length_measure, length_measure8_h3 => length_measure8_h3,
              length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result);
  pair_bounds_section : entity work.pair_bounds
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1, places => places,
              moment_m0 => moment_m0, moment_m2 => moment_m2, moment_m1 => moment_m1, moment_n => moment_n,
              lane1_select_at_1 => lane1_select_at_1, length_measure => length_measure,
              length_measure8_h3 => length_measure8_h3, length_measure0_plane_a0 => length_measure0_plane_a0,
              bound_plane_a1_sum_first_result => bound_plane_a1_sum_first_result,
              bound_plane_a2_sum_first_result => bound_plane_a2_sum_first_result,
              bound_plane_b1_result => bound_plane_b1_result, bound_plane_b2_result => bound_plane_b2_result,
              length_measure0_ends0 => length_measure0_ends0, length_measure0_ends1 => length_measure0_ends1,
              bound_side10_result => bound_side10_result, bound_side11_result => bound_side11_result,
              bound_side12_result => bound_side12_result, level_h2_d1 => level_h2_d1, level_h2_d4 => level_h2_d4,
              compared_bound => compared_bound);
  pair_witnesses_section : entity work.pair_witnesses
    port map (clk => clk, strobe => strobe, row_m_select_at_1 => row_m_select_at_1,
              row_m_select_at_0 => row_m_select_at_0, level => level, row_m_select_at_2 => row_m_select_at_2,
              coordinate_w0_h6 => coordinate_w0_held(1), coordinate_w1_h6 => coordinate_w1_held(1),
              coordinate_v2_x_h3 => coordinate_v2_held(0)(0), coordinate_v2_y_h3 => coordinate_v2_held(0)(1),
              coordinate_v2_z_h6 => coordinate_v2_held(1)(2), coordinate_v1_x_h3 => coordinate_v1_held(0)(0),
              coordinate_v1_y_h3 => coordinate_v1_held(0)(1), coordinate_w2_h6 => coordinate_w2_held(1),
              coordinate_v1_z_h6 => coordinate_v1_held(1)(2), compared => compared, compared_bound => compared_bound,
              outside_h24 => outside_h24, outside_h32 => outside_h32, separated => separated,
              overlapping => overlapping, verdict => verdict);

  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 2 loop
        strobe(k) <= flag(known(phase) = (k + 2) mod 3) and in_flight;
      end loop;
    end if;
  end process strobes;
  in_phase_2 <= flag(known(phase) = 2);
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or holds(5) or holds(6) or holds(7) or holds(8)
      or holds(9) or holds(10) or holds(11) or holds(12) or holds(13) or in_phase_2;
  busy_1_to_34 <= holds(0) or busy_25 or busy_34;
  in_phase_1 <= flag(known(phase) = 1);
  busy_3_to_33 <= busy_3 or busy_12 or busy_21 or busy_33;
  in_phase_0 <= flag(known(phase) = 0);
  busy_17_to_26 <= busy_17 or busy_23 or busy_26;

  -- Clock 2
  outside_flags <= unsigned(pose_m_used_outside) & unsigned(pose_t_outside) & unsigned(in_w_outside(2)) &
      unsigned(in_w_outside(1)) & unsigned(in_w_outside(0)) & unsigned(in_v_outside(2)) & unsigned(in_v_outside(1)) &
      unsigned(in_v_outside(0));
  outside_i <= or_reduce(outside_flags);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_1_to_34 = '1' then
        row_m_select_at_1 <= to_unsigned(row_m_select_at_1_table(to_integer(known(phase))), 2);
      end if;
      if busy_3_to_33 = '1' then
        row_m_select_at_0 <= to_unsigned(row_m_select_at_0_table(to_integer(known(phase))), 2);
      end if;
      if busy_17_to_26 = '1' then
        row_m_select_at_2 <= to_unsigned(row_m_select_at_2_table(to_integer(known(phase))), 2);
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        coordinate_w0_held <= coordinate_w0 & coordinate_w0_held(0 to 1);
        coordinate_w1_held <= coordinate_w1 & coordinate_w1_held(0 to 1);
        coordinate_w2_held <= coordinate_w2 & coordinate_w2_held(0 to 1);
        coordinate_v2_h1 <= coordinate_v2;
        coordinate_v1_h1 <= coordinate_v1;
        outside_h24 <= outside_held(7);
      end if;
      if strobe(0) = '1' then
        coordinate_v2_held(0) <= coordinate_v2;
        coordinate_v2_held(1) <= coordinate_v2_held(0);
        coordinate_v1_held(0) <= coordinate_v1;
        coordinate_v1_held(1) <= coordinate_v1_held(0);
        outside_h32 <= outside_held(10);
      end if;
      if strobe(2) = '1' then
        coordinate_w1_h4 <= coordinate_w1_held(0);
        coordinate_w0_h4 <= coordinate_w0_held(0);
        coordinate_w2_h4 <= coordinate_w2_held(0);
        outside_held <= outside_held(10 downto 0) & outside_i;
        outside <= outside_held(11);
      end if;
      if in_phase_2 = '1' then
        busy_25 <= holds(7);
        busy_34 <= holds(10);
      end if;
      if in_phase_1 = '1' then
        busy_3 <= holds(0);
        busy_12 <= holds(3);
        busy_21 <= holds(6);
        busy_33 <= holds(10);
      end if;
      if in_phase_0 = '1' then
        busy_17 <= holds(5);
        busy_23 <= holds(7);
        busy_26 <= holds(8);
      end if;
    end if;
  end process captures;
end architecture rtl;
