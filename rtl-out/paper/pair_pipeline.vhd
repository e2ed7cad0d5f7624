-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: frame transform, re-normalisation, axes, verdict. Units are shared over the phases of
-- the slot; a bound at a port covers all uses of the unit. A value captured for the pair is named after what it is;
-- later copies end in _h<clocks>, or are elements of x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 55 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    phase       : in  unsigned(3 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(5 downto 0);  -- whether the slot k slots ago holds a pair
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic := '0';
    separated   : out std_logic_vector(10 downto 0);
    overlapping : out std_logic_vector(10 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  constant outside_found_word_and_first_select_at_2_table : std_logic_vector(0 to 15) := "01111111110" & "00000";
  constant outside_found_word_and_second_select_at_1_table : std_logic_vector(0 to 15) := "11110000000" & "00000";
  signal row0_t_outside : std_logic;
  signal row0_m_outside : std_logic_vector(2 downto 0);
  signal row0_x_outside : std_logic_vector(2 downto 0);
  signal row : interval_32_t;  -- s4.28; |.| <= 1879048192
  signal in_phase_10 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(10 downto 0) := (others => '0');  -- one flag per phase
  signal in_v0_outside : std_logic_vector(2 downto 0);
  signal lane_input_outside : std_logic_vector(2 downto 0);
  signal v : interval_18_vector_x3_t;  -- s2.16; |.| <= 65536
  signal v_case : unsigned_2_vector_x3_t;
  signal w : interval_18_vector_x3_t;  -- s2.16; |.| <= 65536
  signal w_case : unsigned_2_vector_x3_t;
  signal lane_edge : interval_18_vector_t;  -- |.| <= 65537
  signal lane_edge_case : unsigned_2_vector_t;
  signal outside_found_word_and_first_select_at_2 : std_logic := '0';
  signal outside_found_word_and_second_select_at_1 : std_logic := '0';
  signal outside_found_word_and_first_line : std_logic_vector(1 to 10) := (others => '0');
  signal outside_found : std_logic;
  signal magnitude_so_far_select_at_0 : std_logic;
  signal outside_so_far_before : std_logic := '0';
  signal outside_so_far : std_logic;
  signal outside_in_phases : std_logic := '0';
  signal in_v0_outside_held : flag_x3_x2_t := zero_flag_x3_x2;  -- from clocks 12, 23 on
  signal outside_flags : unsigned(3 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal outside_held : std_logic_vector(1 downto 0) := (others => '0');  -- from clocks 34, 45 on
  signal outside_h21 : std_logic := '0';
  signal separated_i : std_logic_vector(10 downto 0);
  signal overlapping_i : std_logic_vector(10 downto 0);
  signal separate : std_logic;
  signal surely : std_logic;
  signal not_separate : std_logic;
  signal in_phase_8 : std_logic;
  signal busy_12 : std_logic := '0';  -- set in clocks 11 to 21 of a pair
  signal in_phase_0 : std_logic;
  signal busy_2 : std_logic := '0';  -- set in clocks 1 to 11 of a pair
  signal in_phase_9 : std_logic;
begin
  -- Sections, in the order of the data
  pair_transform_section : entity work.pair_transform
    port map (clk => clk, phase => phase, holds => holds, in_w => in_w, pose_m => pose_m, pose_t => pose_t,
              pose_bypass => pose_bypass, in_phase_10 => in_phase_10, row0_t_outside => row0_t_outside,
              row0_m_outside => row0_m_outside, row0_x_outside => row0_x_outside, row => row);
  pair_points_section : entity work.pair_points
    port map (clk => clk, phase => phase, holds => holds, in_v => in_v, row => row, strobe => strobe,
              in_phase_8 => in_phase_8, busy_12 => busy_12, in_phase_0 => in_phase_0, in_phase_9 => in_phase_9,
              in_v0_outside => in_v0_outside, lane_input_outside => lane_input_outside, v => v, v_case => v_case,
              w => w, w_case => w_case, lane_edge => lane_edge, lane_edge_case => lane_edge_case,
              magnitude_so_far_select_at_0 => magnitude_so_far_select_at_0);
  pair_axes_section : entity work.pair_axes
    port map (clk => clk, phase => phase, holds => holds, strobe => strobe, v => v, v_case => v_case, w => w,
              w_case => w_case, lane_edge => lane_edge, lane_edge_case => lane_edge_case, outside_h21 => outside_h21,
              in_phase_8 => in_phase_8, in_phase_9 => in_phase_9, separated => separated_i,
              overlapping => overlapping_i);

  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 10 loop
        strobe(k) <= flag(known(phase) = (k + 10) mod 11) and in_flight;
      end loop;
    end if;
  end process strobes;
  in_phase_10 <= flag(known(phase) = 10);
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or holds(5) or in_phase_10;
  in_phase_8 <= flag(known(phase) = 8);
  in_phase_0 <= flag(known(phase) = 0);
  in_phase_9 <= flag(known(phase) = 9);

  -- Clock 12
  outside_found <= or_reduce((or_reduce(unsigned(lane_input_outside)) and outside_found_word_and_second_select_at_1) &
      outside_found_word_and_first_line(10));
  outside_so_far <= outside_found or outside_so_far_before;

  -- Clock 23
  outside_flags <= outside_in_phases & unsigned(in_v0_outside_held(1));
  outside_i <= or_reduce(outside_flags);

  -- Clock 55
  separate <= or_reduce(unsigned(separated_i));
  surely <= not or_reduce(not unsigned(overlapping_i));
  not_separate <= not separate;
  verdict <= (not_separate and not surely) & (not_separate and surely);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_2 = '1' then
        outside_found_word_and_first_select_at_2 <=
            outside_found_word_and_first_select_at_2_table(to_integer(known(phase)));
      end if;
      if busy_12 = '1' then
        outside_found_word_and_second_select_at_1 <=
            outside_found_word_and_second_select_at_1_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        outside_in_phases <= outside_so_far;
        in_v0_outside_held(0) <= in_v0_outside;
        in_v0_outside_held(1) <= in_v0_outside_held(0);
        outside_held(0) <= outside_i;
        outside_held(1) <= outside_held(0);
      end if;
      if strobe(10) = '1' then
        outside_h21 <= outside_held(0);
        outside <= outside_held(1);
      end if;
      if in_phase_10 = '1' then
        busy_12 <= holds(0);
      end if;
      if in_phase_0 = '1' then
        busy_2 <= holds(0);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      outside_found_word_and_first_line <= (or_reduce(unsigned(row0_x_outside) & unsigned(row0_m_outside) &
          row0_t_outside) and outside_found_word_and_first_select_at_2) & outside_found_word_and_first_line(1 to 9);
    end if;
  end process delays;

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if magnitude_so_far_select_at_0 = '1' then
        outside_so_far_before <= '0';
      else
        outside_so_far_before <= outside_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  separated <= separated_i;
  overlapping <= overlapping_i;
end architecture rtl;
