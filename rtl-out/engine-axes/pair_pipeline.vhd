-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: frame transform, re-normalisation, axes, verdict. Units are shared over the phases of
-- the slot. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or
-- are elements of x_held.
-- Latency: 58 clocks.
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
  constant row_t_pose_select_at_0_table : numbers_t(0 to 15) := (1, 2, 0, 1, 2, 0, 1, 2, 0, 0, 0, others => 0);
  constant row_diagonal_at_0_0_table : std_logic_vector(0 to 15) := "00100100111" & "00000";
  constant row_diagonal_at_0_1_table : std_logic_vector(0 to 15) := "10010010000" & "00000";
  constant row_diagonal_at_0_2_table : std_logic_vector(0 to 15) := "01001001000" & "00000";
  constant row_x_select_at_0_table : numbers_t(0 to 15) := (0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, others => 0);
  constant lane_input_select_at_10_table : numbers_t(0 to 15) := (2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, others => 0);
  constant lane_operand_select_tap_at_1_2_table : numbers_t(0 to 15) := (11, 12, 13, 14, 4, 2, 0, 7, 8, 9, 10, others => 0);
  constant lane_operand_select_tap_at_1_1_table : numbers_t(0 to 15) := (12, 13, 14, 15, 5, 3, 1, 8, 9, 10, 11, others => 0);
  constant lane_from_input_at_1_table : std_logic_vector(0 to 15) := "11110000111" & "00000";
  constant axis0_has_b2_at_2_table : std_logic_vector(0 to 15) := "01000000000" & "00000";
  constant lane_edge_rounding_at_5_table : std_logic_vector(0 to 15) := "00000101000" & "00000";
  constant outside_found_word_and_first_select_at_2_table : std_logic_vector(0 to 15) := "01111111110" & "00000";
  constant outside_found_word_and_second_select_at_1_table : std_logic_vector(0 to 15) := "11110000000" & "00000";
  constant axis0_has_b2_at_0_table : std_logic_vector(0 to 15) := "00000000001" & "00000";
  constant axis_e_select_tap_at_10_table : numbers_t(0 to 15) := (4, 4, 7, 7, 7, 4, 11, 11, 11, 1, 4, others => 0);
  constant axis_f_select_tap_at_10_table : numbers_t(0 to 15) := (1, 2, 2, 3, 4, 6, 5, 6, 7, 3, 0, others => 0);
  constant axis0_v0_select_at_7_table : std_logic_vector(0 to 15) := "01000100010" & "00000";
  constant axis0_v1_select_tap_at_7_1_table : numbers_t(0 to 15) := (10, 10, 12, 12, 14, 14, 0, 5, 7, 7, 8, others => 0);
  constant axis0_v1_select_tap_at_7_2_table : numbers_t(0 to 15) := (5, 6, 10, 7, 8, 9, 0, 0, 1, 2, 4, others => 0);
  constant axis0_v3_select_at_7_table : std_logic_vector(0 to 15) := "00011100000" & "00000";
  constant axis0_has_a1_at_1_table : std_logic_vector(0 to 15) := "01111111111" & "00000";
  constant axis0_has_a2_at_1_table : std_logic_vector(0 to 15) := "00000001000" & "00000";
  constant axis0_has_b1_at_1_table : std_logic_vector(0 to 15) := "11111110111" & "00000";
  constant axis0_has_b2_at_1_table : std_logic_vector(0 to 15) := "10000000000" & "00000";
  signal row_t_pose : signed(31 downto 0);  -- s4.28; |.| <= 2147483648
  signal row_t_pose_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_t : signed(31 downto 0);  -- s4.28; |.| <= 2147483648
  signal row_t_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 2147483648
  signal row0_t_inside : signed(31 downto 0);  -- s4.28; |.| <= 1073741816
  signal row0_t_outside : std_logic;
  signal row_m_pose : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_diagonal_at_0 : std_logic_vector(2 downto 0) := (others => '0');
  signal row_m : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_m_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal row0_m_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal row0_m_outside : std_logic_vector(2 downto 0);
  signal row_x : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_x_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_x_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal row0_x_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal row0_x_outside : std_logic_vector(2 downto 0);
  signal row0_m_inside_d1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal row0_x_inside_d1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal row0_t_inside_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 1073741816
  signal pose_bypass_line : std_logic_vector(1 to 3) := (others => '0');
  signal row : interval_32_t;  -- s4.28; |.| <= 1879048192
  signal in_phase_10 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(10 downto 0) := (others => '0');  -- one flag per phase
  signal in_v0_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal in_v0_outside : std_logic_vector(2 downto 0);
  signal in_v0_inside_h9 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal in_v_h11 : signed_32_vector_1_to_2_t := zero_signed_32_vector_1_to_2;  -- s4.28; |.| <= 2147483648
  signal lane_input : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal lane_input_select_at_10 : unsigned(1 downto 0) := (others => '0');
  signal lane_input_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal lane_input_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal lane_input_outside : std_logic_vector(2 downto 0);
  signal row_d1 : interval_32_t := zero_interval_32;  -- s4.28; |.| <= 1879048192
  signal row_d2 : interval_32_t := zero_interval_32;  -- s4.28; |.| <= 1879048192
  signal lane_operand_select_tap_at_1 : unsigned_4_1_to_2_t := zero_unsigned_4_1_to_2;
  signal lane_operand : interval_32_vector_t;  -- s4.28; |.| <= 1879048192
  signal lane_from_input_at_1 : std_logic := '0';
  signal lane : interval_32_vector_t;  -- s4.28; |.| <= 1879048192
  signal in_v0_inside_h11 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal in_v0_inside_h12 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal lane_d1 : interval_32_vector_t := zero_interval_32_vector;  -- s4.28; |.| <= 1879048192
  signal offset : interval_33_vector_t;  -- s5.28; |.| <= 2147483648
  signal offset_d1 : interval_33_vector_t := zero_interval_33_vector;  -- s5.28; |.| <= 2147483648
  signal magnitude_magnitude : unsigned_33_vector_t;
  signal magnitude : unsigned_32_vector_t;
  signal axis0_has_b2_at_2 : std_logic := '0';
  signal magnitude_so_far_before : unsigned_32_vector_t := zero_unsigned_32_vector;
  signal magnitude_so_far : unsigned_32_vector_t;
  signal magnitudes : unsigned_32_vector_t := zero_unsigned_32_vector;  -- OR of the magnitudes of the twelve bounds
  signal shift : flag_x5_vector_t;
  type offset_line_t is array (1 to 10) of interval_33_vector_t;
  signal offset_line : offset_line_t := (others => zero_interval_33_vector);  -- s5.28; |.| <= 2147483648
  signal shift_d1 : flag_x5_vector_t := zero_flag_x5_vector;
  signal scaled : interval_18_vector_t;  -- |.| <= 65536
  signal scaled_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65536
  signal scaled_d2 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65536
  signal scaled_case : unsigned_2_vector_t;
  signal v0_hi : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v0_lo : signed_18_vector_t;  -- s2.16; |.| <= 0
  signal v1 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal v0_case : unsigned_2_vector_t;
  signal v1_case : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal w : interval_18_vector_x2_t := zero_interval_18_vector_x2;  -- s2.16; |.| <= 65536
  signal w_case : unsigned_2_vector_x2_t := zero_unsigned_2_vector_x2;
  signal lane_difference : interval_19_19_vector_t;  -- |.| <= 131072
  signal lane_difference_d1 : interval_19_19_vector_t := zero_interval_19_19_vector;  -- |.| <= 131072
  signal lane_edge_rounding_at_5 : std_logic := '0';
  signal lane_edge : interval_18_vector_t;  -- |.| <= 65537
  signal lane_edge_hi_second_up_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 65537
  signal lane_edge_case : unsigned_2_vector_t;
  signal outside_found_word_and_first_select_at_2 : std_logic := '0';
  signal outside_found_word_and_second_select_at_1 : std_logic := '0';
  signal outside_found_word_and_first_line : std_logic_vector(1 to 10) := (others => '0');
  signal outside_found : std_logic;
  signal axis0_has_b2_at_0 : std_logic := '0';
  signal outside_so_far_before : std_logic := '0';
  signal outside_so_far : std_logic;
  signal outside_in_phases : std_logic := '0';
  signal in_v0_outside_held : flag_x3_x2_t := zero_flag_x3_x2;  -- from clocks 12, 23 on
  signal outside_flags : unsigned(3 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal axis_e_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal axis_e : interval_18_vector_t;  -- |.| <= 65537
  signal axis_e_case : unsigned_2_vector_t;
  signal axis_f_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal axis_f : interval_18_vector_t;  -- |.| <= 65537
  signal axis_f_case : unsigned_2_vector_t;
  signal axis_e_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65537
  signal axis_e_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis_f_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65537
  signal axis_f_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis_exact : interval_37_vector_t;  -- |.| <= 8590196738
  signal axis_exact_d1 : interval_37_vector_t := zero_interval_37_vector;  -- |.| <= 8590196738
  signal axis_l : interval_18_vector_t;  -- |.| <= 131071
  signal axis_l_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 131071
  signal axis_l_case : unsigned_2_vector_t;
  signal v0_hi_h11 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v1_h11 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal v1_h16 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal axis0_v : interval_18_vector_x4_t;  -- s2.16; |.| <= 65536
  signal axis0_v0_select_at_7 : std_logic := '0';
  signal axis0_v3_select_at_7 : std_logic := '0';
  signal v0_hi_h14 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v1_case_h11 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis0_v_case : unsigned_2_vector_x4_t;
  signal axis0_v_d1 : interval_18_vector_x4_t := zero_interval_18_vector_x4;  -- s2.16; |.| <= 65536
  signal axis0_v_case_d1 : unsigned_2_vector_x4_t := zero_unsigned_2_vector_x4;
  signal axis_l_d2 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 131071
  signal axis_l_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal p : interval_22_x4_t;  -- |.| <= 1572852
  type scaled_line_t is array (1 to 6) of interval_18_vector_t;
  signal scaled_line : scaled_line_t := (others => zero_interval_18_vector);  -- |.| <= 65536
  signal axis0_v1_select_tap_at_7 : unsigned_4_1_to_2_t := zero_unsigned_4_1_to_2;
  type scaled_case_line_t is array (1 to 6) of unsigned_2_vector_t;
  signal scaled_case_line : scaled_case_line_t := (others => zero_unsigned_2_vector);
  signal scaled_d9 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65536
  signal scaled_case_d7 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal w_held : interval_18_vector_x2_t := zero_interval_18_vector_x2;  -- s2.16; |.| <= 65536; from clocks 40, 42 on
  signal w_case_held : unsigned_2_vector_x2_t := zero_unsigned_2_vector_x2;  -- from clocks 40, 44 on
  signal p_d1 : interval_22_x4_t := zero_interval_22_x4;  -- |.| <= 1572852
  signal axis0_has_a1_at_1 : std_logic := '0';
  signal axis0_has_a2_at_1 : std_logic := '0';
  signal axis0_has_b1_at_1 : std_logic := '0';
  signal axis0_has_b2_at_1 : std_logic := '0';
  signal axis_separated : std_logic;
  signal axis_overlapping : std_logic;
  signal axis0_above : std_logic_vector(5 downto 0);
  signal axis0_below : std_logic_vector(5 downto 0);
  signal pierced_result_w_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_w_below : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_edges_above : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_result_edges_below : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_result_v_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_v_below : std_logic_vector(2 downto 0) := (others => '0');
  signal outside_held : std_logic_vector(2 downto 0) := (others => '0');  -- from clocks 34, 45, 56 on
  signal outside_h23 : std_logic := '0';
  signal axis_outside_not : std_logic;
  signal axis_counts_separated : std_logic;
  signal axis_counts_overlapping : std_logic;
  signal separated_i : std_logic_vector(10 downto 0) := (others => '0');
  signal overlapping_i : std_logic_vector(10 downto 0) := (others => '0');
  signal pierced_result : std_logic;
  signal pierced_not_held : std_logic_vector(2 downto 0) := (others => '0');  -- from clocks 34, 45, 56 on
  signal pierced_not_h34 : std_logic := '0';
  signal pierced : std_logic;
  signal separate : std_logic;
  signal all_overlap : std_logic;
  signal all_overlap_h1 : std_logic := '0';
  signal pierced_h1 : std_logic := '0';
  signal surely : std_logic;
  signal verdict_and_first_not_h1 : std_logic := '0';
  signal verdict_and_second_not_first_h1 : std_logic := '0';
  signal separated0_h11 : std_logic := '0';
  signal overlapping0_h11 : std_logic := '0';
  signal busy_0 : std_logic;  -- set in the clock before a pair, and in clock 0 of one
  signal in_phase_8 : std_logic;
  signal busy_10 : std_logic := '0';  -- set in clocks 9 to 19 of a pair
  signal busy_12 : std_logic := '0';  -- set in clocks 11 to 21 of a pair
  signal in_phase_0 : std_logic;
  signal busy_13 : std_logic := '0';  -- set in clocks 12 to 22 of a pair
  signal in_phase_3 : std_logic;
  signal busy_27 : std_logic := '0';  -- set in clocks 26 to 36 of a pair
  signal busy_2 : std_logic := '0';  -- set in clocks 1 to 11 of a pair
  signal in_phase_9 : std_logic;
  signal busy_11 : std_logic := '0';  -- set in clocks 10 to 20 of a pair
  signal busy_32 : std_logic := '0';  -- set in clocks 31 to 41 of a pair
  signal in_phase_5 : std_logic;
  signal busy_40 : std_logic := '0';  -- set in clocks 39 to 49 of a pair
  signal busy_45 : std_logic := '0';  -- set in clocks 44 to 54 of a pair
  signal row_unit_m : signed_32_vector_t;
  signal row_unit_x : signed_32_vector_t;
  signal lane_lo_operand_line_x : signed_32_vector_t;
  signal lane_lo_operand_line_tap : unsigned_4_vector_t;
  signal lane_hi_operand_line_x : signed_32_vector_t;
  signal lane_hi_operand_line_tap : unsigned_4_vector_t;
  signal offset_unit_origin : signed_32_vector_t;
  signal axis0_v_lo_line_x : signed_18_vector_1_to_2_t;
  signal axis0_v_hi_line_x : signed_18_vector_1_to_2_t;
  signal axis0_v_case_line_x : unsigned_2_vector_1_to_2_t;
  signal axis_separated_unit_has : flag_x2_x2_t;
begin
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
  v0_lo_each : for i in 0 to 2 generate
    v0_lo(i) <= to_signed(0, 18);
    v0_case(i) <= to_unsigned(0, 2);
  end generate v0_lo_each;
  busy_0 <= holds(0) or in_phase_10;
  in_phase_8 <= flag(known(phase) = 8);
  in_phase_0 <= flag(known(phase) = 0);
  in_phase_3 <= flag(known(phase) = 3);
  in_phase_9 <= flag(known(phase) = 9);
  in_phase_5 <= flag(known(phase) = 5);

  -- Clock 0
  row_t_pose <=
    pose_t(0) when known(row_t_pose_select_at_0) = 0 else
    pose_t(1) when known(row_t_pose_select_at_0) = 1 else
    pose_t(2);
  row_t <= to_signed(0, 32) when pose_bypass = '1' else row_t_pose;
  row_m_pose <=
    pose_m(0) when known(row_t_pose_select_at_0) = 0 else
    pose_m(1) when known(row_t_pose_select_at_0) = 1 else
    pose_m(2);
  row_m_each : for i in 0 to 2 generate
    row_m(i) <= choose(row_diagonal_at_0(i), to_signed(268435456, 32), to_signed(0, 32)) when pose_bypass = '1' else
        row_m_pose(i);
  end generate row_m_each;
  row_x <=
    in_w(0) when known(row_x_select_at_0) = 0 else
    in_w(1) when known(row_x_select_at_0) = 1 else
    in_w(2);
  in_v0_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => in_v(0)(k), passed => in_v0_inside(k), outside => in_v0_outside(k));
  end generate in_v0_inside_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      row_t_d1 <= row_t;
      row_m_d1 <= row_m;
      row_x_d1 <= row_x;
    end if;
  end process clock_1;
  row0_t_inside_unit : entity work.guard_translation
    port map (clk => clk, number => row_t_d1, passed => row0_t_inside, outside => row0_t_outside);
  row0_m_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => row_m_d1(k), passed => row0_m_inside(k), outside => row0_m_outside(k));
  end generate row0_m_inside_unit;
  row0_x_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => row_x_d1(k), passed => row0_x_inside(k), outside => row0_x_outside(k));
  end generate row0_x_inside_unit;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      row0_m_inside_d1 <= row0_m_inside;
      row0_x_inside_d1 <= row0_x_inside;
      row0_t_inside_d1 <= row0_t_inside;
    end if;
  end process clock_3;
  row_unit_m_each : for i in 0 to 2 generate
    row_unit_m(i) <= row0_m_inside_d1(i);
    row_unit_x(i) <= row0_x_inside_d1(i);
  end generate row_unit_m_each;
  row_unit : entity work.transform_row
    port map (clk => clk, m => row_unit_m, x => row_unit_x, t => row0_t_inside_d1, bypass => pose_bypass_line(3),
              b => row);

  -- Clock 10
  clock_10 : process (clk)
  begin
    if rising_edge(clk) then
      row_d1 <= row;
    end if;
  end process clock_10;
  lane_input_each : for i in 0 to 2 generate
    lane_input(i) <=
      in_v0_inside_h9(i) when known(lane_input_select_at_10) = 0 else
      in_v_h11(1)(i) when known(lane_input_select_at_10) = 1 else
      in_v_h11(2)(i);
  end generate lane_input_each;

  -- Clock 11
  clock_11 : process (clk)
  begin
    if rising_edge(clk) then
      lane_input_d1 <= lane_input;
      row_d2 <= row_d1;
    end if;
  end process clock_11;
  lane_lo_operand_line_x(0) <= row_d2.lo;
  lane_lo_operand_line_x(1) <= row.lo;
  lane_lo_operand_line_x(2) <= row.lo;
  lane_lo_operand_line_tap(0) <= lane_operand_select_tap_at_1(2);
  lane_lo_operand_line_tap(1) <= lane_operand_select_tap_at_1(1);
  lane_lo_operand_line_tap(2) <= lane_operand_select_tap_at_1(2);
  lane_hi_operand_line_x(0) <= row_d2.hi;
  lane_hi_operand_line_x(1) <= row.hi;
  lane_hi_operand_line_x(2) <= row.hi;
  lane_hi_operand_line_tap(0) <= lane_operand_select_tap_at_1(2);
  lane_hi_operand_line_tap(1) <= lane_operand_select_tap_at_1(1);
  lane_hi_operand_line_tap(2) <= lane_operand_select_tap_at_1(2);
  lane_input_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => lane_input_d1(k), passed => lane_input_inside(k),
                outside => lane_input_outside(k));
  end generate lane_input_inside_unit;
  lane_lo_operand_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_32
      port map (clk => clk, x => lane_lo_operand_line_x(i), tap => lane_lo_operand_line_tap(i),
                y => lane_operand(i).lo);
  end generate lane_lo_operand_line;
  lane_hi_operand_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_32
      port map (clk => clk, x => lane_hi_operand_line_x(i), tap => lane_hi_operand_line_tap(i),
                y => lane_operand(i).hi);
  end generate lane_hi_operand_line;

  -- Clock 12
  lane_lo_each : for i in 0 to 2 generate
    lane(i).lo <= lane_input_inside(i) when lane_from_input_at_1 = '1' else lane_operand(i).lo;
    lane(i).hi <= lane_input_inside(i) + 1 when lane_from_input_at_1 = '1' else lane_operand(i).hi;
  end generate lane_lo_each;
  outside_found <= or_reduce((or_reduce(unsigned(lane_input_outside)) and outside_found_word_and_second_select_at_1) &
      outside_found_word_and_first_line(10));
  outside_so_far <= outside_found or outside_so_far_before;

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      lane_d1 <= lane;
    end if;
  end process clock_13;
  offset_unit_origin_each : for i in 0 to 2 generate
    offset_unit_origin(i) <= in_v0_inside_h12(i);
  end generate offset_unit_origin_each;
  offset_unit : entity work.renormalise_offset
    port map (point => lane_d1, origin => offset_unit_origin, offset => offset);

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      offset_d1 <= offset;
    end if;
  end process clock_14;
  magnitude_magnitude_each : for i in 0 to 2 generate
    magnitude_magnitude(i) <= abs_of(offset_d1(i).lo);
    magnitude(i) <= magnitude_magnitude(i)(31 downto 0) or
        choose(offset_d1(i).hi(32), to_unsigned(0, 32), unsigned(offset_d1(i).hi(31 downto 0)));
    magnitude_so_far(i) <= magnitude(i) or magnitude_so_far_before(i);
  end generate magnitude_magnitude_each;

  -- Clock 21
  shift_unit : for i in 0 to 2 generate
    unit : entity work.renormalise_shift
      port map (clk => clk, magnitudes => magnitudes(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 23
  outside_flags <= outside_in_phases & unsigned(in_v0_outside_held(1));
  outside_i <= or_reduce(outside_flags);

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      shift_d1 <= shift;
    end if;
  end process clock_24;
  scaled_unit : entity work.renormalise_scale
    port map (clk => clk, offset => offset_line(10), shift => shift_d1, scaled => scaled);

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d1 <= scaled;
    end if;
  end process clock_26;
  lane_difference_lo_each : for i in 0 to 2 generate
    lane_difference(i).lo <= resize(scaled_d1(i).lo, 19) - resize(scaled_d2(i).hi, 19);
    lane_difference(i).hi <= resize(scaled_d1(i).hi, 19) - resize(scaled_d2(i).lo, 19);
  end generate lane_difference_lo_each;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d2 <= scaled_d1;
      lane_difference_d1 <= lane_difference;
      for i in 0 to 2 loop
        lane_edge_hi_second_up_d1(i) <= resize(lane_difference(i).hi(18 downto 1), 19) + 1;
      end loop;
    end if;
  end process clock_27;
  lane_edge_lo_each : for i in 0 to 2 generate
    lane_edge(i).lo <= lane_difference_d1(i).lo(17 downto 0) when lane_edge_rounding_at_5 = '1' else
        lane_difference_d1(i).lo(18 downto 1);
    lane_edge(i).hi <= lane_difference_d1(i).hi(17 downto 0) when lane_edge_rounding_at_5 = '1' else
        lane_edge_hi_second_up_d1(i)(17 downto 0);
  end generate lane_edge_lo_each;
  scaled_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => scaled_d2(i), number => scaled_case(i));
  end generate scaled_case_unit;
  lane_edge_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => lane_edge(i), number => lane_edge_case(i));
  end generate lane_edge_case_unit;
  axis_e_lo_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_e_select_tap_at_10, y => axis_e(i).lo);
  end generate axis_e_lo_line;
  axis_e_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_e_select_tap_at_10, y => axis_e(i).hi);
  end generate axis_e_hi_line;
  axis_e_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_e_select_tap_at_10, y => axis_e_case(i));
  end generate axis_e_case_line;
  axis_f_lo_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_f_select_tap_at_10, y => axis_f(i).lo);
  end generate axis_f_lo_line;
  axis_f_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_f_select_tap_at_10, y => axis_f(i).hi);
  end generate axis_f_hi_line;
  axis_f_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_f_select_tap_at_10, y => axis_f_case(i));
  end generate axis_f_case_line;

  -- Clock 33
  clock_33 : process (clk)
  begin
    if rising_edge(clk) then
      axis_e_d1 <= axis_e;
      axis_e_case_d1 <= axis_e_case;
      axis_f_d1 <= axis_f;
      axis_f_case_d1 <= axis_f_case;
    end if;
  end process clock_33;
  axis0_v_lo_line_x_1_each : for i in 0 to 2 generate
    axis0_v_lo_line_x(1)(i) <= scaled_line(6)(i).lo;
    axis0_v_lo_line_x(2)(i) <= scaled_d9(i).lo;
    axis0_v_hi_line_x(1)(i) <= scaled_line(6)(i).hi;
    axis0_v_hi_line_x(2)(i) <= scaled_d9(i).hi;
  end generate axis0_v_lo_line_x_1_each;
  axis0_v_case_line_x(1) <= scaled_case_line(6);
  axis0_v_case_line_x(2) <= scaled_case_d7;
  axis_exact_unit : entity work.cross_product
    port map (clk => clk, e => axis_e_d1, e_case => axis_e_case_d1, f => axis_f_d1, f_case => axis_f_case_d1,
              l => axis_exact);
  axis0_v_lo_line_of : for k in 1 to 2 generate
    axis0_v_lo_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_18
        port map (clk => clk, x => axis0_v_lo_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k), y => axis0_v(k)(i).lo);
    end generate axis0_v_lo_line;
  end generate axis0_v_lo_line_of;
  axis0_v_hi_line_of : for k in 1 to 2 generate
    axis0_v_hi_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_18
        port map (clk => clk, x => axis0_v_hi_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k), y => axis0_v(k)(i).hi);
    end generate axis0_v_hi_line;
  end generate axis0_v_hi_line_of;
  axis0_v_case_line_of : for k in 1 to 2 generate
    axis0_v_case_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_u2
        port map (clk => clk, x => axis0_v_case_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k),
                  y => axis0_v_case(k)(i));
    end generate axis0_v_case_line;
  end generate axis0_v_case_line_of;

  -- Clock 34
  clock_34 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d9 <= scaled_line(6);
      scaled_case_d7 <= scaled_case_line(6);
    end if;
  end process clock_34;

  -- Clock 36
  clock_36 : process (clk)
  begin
    if rising_edge(clk) then
      axis_exact_d1 <= axis_exact;
    end if;
  end process clock_36;
  axis_l_unit : entity work.axis_shift
    port map (clk => clk, exact => axis_exact_d1, l => axis_l);

  -- Clock 40
  clock_40 : process (clk)
  begin
    if rising_edge(clk) then
      axis_l_d1 <= axis_l;
    end if;
  end process clock_40;
  axis0_v_0_lo_each : for i in 0 to 2 generate
    axis0_v(0)(i).lo <= v1_h16(i).lo when axis0_v0_select_at_7 = '1' else v0_lo(i);
    axis0_v(0)(i).hi <= v1_h16(i).hi when axis0_v0_select_at_7 = '1' else v0_hi_h14(i);
  end generate axis0_v_0_lo_each;
  axis0_v(3) <= w_held(1) when axis0_v3_select_at_7 = '1' else w_held(0);
  axis0_v_case(0) <= v1_case_h11 when axis0_v0_select_at_7 = '1' else v0_case;
  axis0_v_case(3) <= w_case_held(1) when axis0_v3_select_at_7 = '1' else w_case_held(0);
  axis_l_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => axis_l_d1(i), number => axis_l_case(i));
  end generate axis_l_case_unit;

  -- Clock 41
  clock_41 : process (clk)
  begin
    if rising_edge(clk) then
      axis0_v_d1 <= axis0_v;
      axis0_v_case_d1 <= axis0_v_case;
      axis_l_d2 <= axis_l_d1;
      axis_l_case_d1 <= axis_l_case;
    end if;
  end process clock_41;
  p_unit : for k in 0 to 3 generate
    unit : entity work.projection
      port map (clk => clk, v => axis0_v_d1(k), v_case => axis0_v_case_d1(k), l => axis_l_d2, l_case => axis_l_case_d1,
                p => p(k));
  end generate p_unit;

  -- Clock 45
  clock_45 : process (clk)
  begin
    if rising_edge(clk) then
      p_d1 <= p;
    end if;
  end process clock_45;
  axis_separated_unit_has(0)(0) <= axis0_has_a1_at_1;
  axis_separated_unit_has(0)(1) <= axis0_has_a2_at_1;
  axis_separated_unit_has(1)(0) <= axis0_has_b1_at_1;
  axis_separated_unit_has(1)(1) <= axis0_has_b2_at_1;
  axis_separated_unit : entity work.comparator_network
    port map (clk => clk, p => p_d1, has => axis_separated_unit_has, separated => axis_separated,
              overlapping => axis_overlapping, above => axis0_above, below => axis0_below);

  -- Clock 46
  axis_outside_not <= not outside_h23;
  axis_counts_separated <= axis_separated and axis_outside_not;
  axis_counts_overlapping <= axis_overlapping and axis_outside_not;

  -- Clock 57
  pierced <= pierced_result and pierced_not_h34;
  separate <= or_reduce(unsigned(separated_i));
  all_overlap <= not or_reduce(not unsigned(overlapping_i));
  pierced_result_unit : entity work.edge_test
    port map (v_above => pierced_result_v_above, v_below => pierced_result_v_below, w_above => pierced_result_w_above,
              w_below => pierced_result_w_below, edges_above => pierced_result_edges_above,
              edges_below => pierced_result_edges_below, pierced => pierced_result);

  -- Clock 58
  surely <= all_overlap_h1 or pierced_h1;
  verdict <= (verdict_and_second_not_first_h1 and not surely) & (verdict_and_first_not_h1 and surely);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_0 = '1' then
        row_t_pose_select_at_0 <= to_unsigned(row_t_pose_select_at_0_table(to_integer(known(phase))), 2);
        row_diagonal_at_0(0) <= row_diagonal_at_0_0_table(to_integer(known(phase)));
        row_diagonal_at_0(1) <= row_diagonal_at_0_1_table(to_integer(known(phase)));
        row_diagonal_at_0(2) <= row_diagonal_at_0_2_table(to_integer(known(phase)));
        row_x_select_at_0 <= to_unsigned(row_x_select_at_0_table(to_integer(known(phase))), 2);
      end if;
      if busy_10 = '1' then
        lane_input_select_at_10 <= to_unsigned(lane_input_select_at_10_table(to_integer(known(phase))), 2);
      end if;
      if busy_12 = '1' then
        lane_operand_select_tap_at_1(1) <= to_unsigned(lane_operand_select_tap_at_1_1_table(to_integer(known(phase))),
            4);
        lane_operand_select_tap_at_1(2) <= to_unsigned(lane_operand_select_tap_at_1_2_table(to_integer(known(phase))),
            4);
        lane_from_input_at_1 <= lane_from_input_at_1_table(to_integer(known(phase)));
        outside_found_word_and_second_select_at_1 <=
            outside_found_word_and_second_select_at_1_table(to_integer(known(phase)));
      end if;
      if busy_13 = '1' then
        axis0_has_b2_at_2 <= axis0_has_b2_at_2_table(to_integer(known(phase)));
      end if;
      if busy_27 = '1' then
        lane_edge_rounding_at_5 <= lane_edge_rounding_at_5_table(to_integer(known(phase)));
      end if;
      if busy_2 = '1' then
        outside_found_word_and_first_select_at_2 <=
            outside_found_word_and_first_select_at_2_table(to_integer(known(phase)));
      end if;
      if busy_11 = '1' then
        axis0_has_b2_at_0 <= axis0_has_b2_at_0_table(to_integer(known(phase)));
      end if;
      if busy_32 = '1' then
        axis_e_select_tap_at_10 <= to_unsigned(axis_e_select_tap_at_10_table(to_integer(known(phase))), 4);
        axis_f_select_tap_at_10 <= to_unsigned(axis_f_select_tap_at_10_table(to_integer(known(phase))), 4);
      end if;
      if busy_40 = '1' then
        axis0_v0_select_at_7 <= axis0_v0_select_at_7_table(to_integer(known(phase)));
        axis0_v3_select_at_7 <= axis0_v3_select_at_7_table(to_integer(known(phase)));
        axis0_v1_select_tap_at_7(1) <= to_unsigned(axis0_v1_select_tap_at_7_1_table(to_integer(known(phase))), 4);
        axis0_v1_select_tap_at_7(2) <= to_unsigned(axis0_v1_select_tap_at_7_2_table(to_integer(known(phase))), 4);
      end if;
      if busy_45 = '1' then
        axis0_has_a1_at_1 <= axis0_has_a1_at_1_table(to_integer(known(phase)));
        axis0_has_a2_at_1 <= axis0_has_a2_at_1_table(to_integer(known(phase)));
        axis0_has_b1_at_1 <= axis0_has_b1_at_1_table(to_integer(known(phase)));
        axis0_has_b2_at_1 <= axis0_has_b2_at_1_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that are loaded once per pair
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(9) = '1' then
        in_v0_inside_h9 <= in_v0_inside;
        magnitudes <= magnitude_so_far;
        v1_h16 <= v1_h11;
        pierced_result_v_above(0) <= axis0_above(0);
        pierced_result_v_above(1) <= axis0_above(3);
        pierced_result_v_above(2) <= axis0_above(5);
        pierced_result_v_below(0) <= axis0_below(0);
        pierced_result_v_below(1) <= axis0_below(3);
        pierced_result_v_below(2) <= axis0_below(5);
        separated_i(1) <= axis_counts_separated;
        overlapping_i(1) <= axis_counts_overlapping;
      end if;
      if strobe(10) = '1' then
        for k in 1 to 2 loop
          in_v_h11(k) <= in_v(k);
        end loop;
        w_case_held(1) <= w_case(1);
        pierced_result_edges_above(0)(2) <= axis0_above(1);
        pierced_result_edges_below(0)(2) <= axis0_below(1);
        separated_i(4) <= axis_counts_separated;
        overlapping_i(4) <= axis_counts_overlapping;
      end if;
      if strobe(0) = '1' then
        in_v0_inside_h11 <= in_v0_inside;
        outside_in_phases <= outside_so_far;
        in_v0_outside_held(0) <= in_v0_outside;
        in_v0_outside_held(1) <= in_v0_outside_held(0);
        pierced_result_edges_above(1)(2) <= axis0_above(4);
        pierced_result_edges_below(1)(2) <= axis0_below(4);
        outside_held <= outside_held(1 downto 0) & outside_i;
        separated_i(7) <= axis_counts_separated;
        overlapping_i(7) <= axis_counts_overlapping;
        pierced_not_held <= pierced_not_held(1 downto 0) & not outside_i;
      end if;
      if strobe(1) = '1' then
        in_v0_inside_h12 <= in_v0_inside_h11;
        pierced_result_edges_above(2)(2) <= axis0_above(4);
        pierced_result_edges_below(2)(2) <= axis0_below(4);
        outside_h23 <= outside_held(1);
        separated_i(10) <= axis_counts_separated;
        overlapping_i(10) <= axis_counts_overlapping;
        pierced_not_h34 <= pierced_not_held(2);
      end if;
      if strobe(3) = '1' then
        for i in 0 to 2 loop
          v0_hi(i) <= scaled(i).hi;
        end loop;
        v0_hi_h11 <= v0_hi;
        pierced_result_edges_above(0)(0) <= axis0_above(0);
        pierced_result_edges_below(0)(0) <= axis0_below(0);
        separated_i(2) <= axis_counts_separated;
        overlapping_i(2) <= axis_counts_overlapping;
      end if;
      if strobe(4) = '1' then
        v1 <= scaled;
        v1_h11 <= v1;
        pierced_result_edges_above(1)(0) <= axis0_above(3);
        pierced_result_edges_below(1)(0) <= axis0_below(3);
        separated_i(5) <= axis_counts_separated;
        overlapping_i(5) <= axis_counts_overlapping;
      end if;
      if strobe(6) = '1' then
        v1_case <= scaled_case;
        v0_hi_h14 <= v0_hi_h11;
        v1_case_h11 <= v1_case;
        w_held(0) <= w(0);
        w_case_held(0) <= w_case(0);
        pierced_result_edges_above(0)(1) <= axis0_above(1);
        pierced_result_edges_below(0)(1) <= axis0_below(1);
        separated_i(3) <= axis_counts_separated;
        overlapping_i(3) <= axis_counts_overlapping;
      end if;
      for k in 0 to 1 loop
        if strobe(k + 7) = '1' then
          w(k) <= scaled;
        end if;
        if strobe(k + 9) = '1' then
          w_case(k) <= scaled_case;
        end if;
      end loop;
      if strobe(8) = '1' then
        w_held(1) <= w(1);
        pierced_result_edges_above(2)(1) <= axis0_above(4);
        pierced_result_edges_below(2)(1) <= axis0_below(4);
        separated_i(9) <= axis_counts_separated;
        overlapping_i(9) <= axis_counts_overlapping;
      end if;
      if strobe(2) = '1' then
        for k in 0 to 2 loop
          pierced_result_w_above(k) <= axis0_above(k);
          pierced_result_w_below(k) <= axis0_below(k);
        end loop;
        separated_i(0) <= axis_counts_separated;
        overlapping_i(0) <= axis_counts_overlapping;
        all_overlap_h1 <= all_overlap;
        pierced_h1 <= pierced;
        verdict_and_first_not_h1 <= not separate;
        verdict_and_second_not_first_h1 <= not separate;
        separated0_h11 <= separated_i(0);
        overlapping0_h11 <= overlapping_i(0);
        outside <= outside_held(2);
      end if;
      if strobe(7) = '1' then
        pierced_result_edges_above(1)(1) <= axis0_above(4);
        pierced_result_edges_below(1)(1) <= axis0_below(4);
        separated_i(6) <= axis_counts_separated;
        overlapping_i(6) <= axis_counts_overlapping;
      end if;
      if strobe(5) = '1' then
        pierced_result_edges_above(2)(0) <= axis0_above(3);
        pierced_result_edges_below(2)(0) <= axis0_below(3);
        separated_i(8) <= axis_counts_separated;
        overlapping_i(8) <= axis_counts_overlapping;
      end if;
      if in_phase_8 = '1' then
        busy_10 <= holds(0);
        busy_32 <= holds(2);
      end if;
      if in_phase_10 = '1' then
        busy_12 <= holds(0);
        busy_45 <= holds(3);
      end if;
      if in_phase_0 = '1' then
        busy_13 <= holds(1);
        busy_2 <= holds(0);
      end if;
      if in_phase_3 = '1' then
        busy_27 <= holds(2);
      end if;
      if in_phase_9 = '1' then
        busy_11 <= holds(0);
      end if;
      if in_phase_5 = '1' then
        busy_40 <= holds(3);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      pose_bypass_line <= pose_bypass & pose_bypass_line(1 to 2);
      offset_line <= offset_d1 & offset_line(1 to 9);
      outside_found_word_and_first_line <= (or_reduce(unsigned(row0_x_outside) & unsigned(row0_m_outside) &
          row0_t_outside) and outside_found_word_and_first_select_at_2) & outside_found_word_and_first_line(1 to 9);
      scaled_line <= scaled_d2 & scaled_line(1 to 5);
      scaled_case_line <= scaled_case & scaled_case_line(1 to 5);
    end if;
  end process delays;

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if axis0_has_b2_at_2 = '1' then
        for i in 0 to 2 loop
          magnitude_so_far_before(i) <= to_unsigned(0, 32);
        end loop;
      else
        magnitude_so_far_before <= magnitude_so_far;
      end if;
      if axis0_has_b2_at_0 = '1' then
        outside_so_far_before <= '0';
      else
        outside_so_far_before <= outside_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  separated(0) <= separated0_h11;
  separated_each : for k in 1 to 10 generate
    separated(k) <= separated_i(k);
  end generate separated_each;
  overlapping(0) <= overlapping0_h11;
  overlapping_each : for k in 1 to 10 generate
    overlapping(k) <= overlapping_i(k);
  end generate overlapping_each;
end architecture rtl;
