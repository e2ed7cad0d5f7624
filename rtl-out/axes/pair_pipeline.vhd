--------------------------------------------------------------------------------
-- The data path of one pair: frame transform, re-normalisation, axes, verdict. Units are shared over the phases of
-- the slot. A value captured for the pair is named after what it is; later copies end in _h<clocks>.
-- Latency: 56 clocks.
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
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 268435456
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 268435456
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 268435456
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 1073741816
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
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
  constant lane_select_at_10_table : numbers_t(0 to 15) := (2, 0, 3, 4, 5, 3, 0, 0, 0, 0, 1, others => 0);
  constant lane2_choice_operand_select_tap_at_10_table : numbers_t(0 to 15) := (13, 14, 4, 2, 0, 7, 8, 9, 10, 11, 12, others => 0);
  constant lane1_choice_operand_select_tap_at_10_table : numbers_t(0 to 15) := (14, 15, 5, 3, 1, 8, 9, 10, 11, 12, 13, others => 0);
  constant lane_from_input_at_10_table : std_logic_vector(0 to 15) := "11000011111" & "00000";
  constant lane_from_input_at_0_table : std_logic_vector(0 to 15) := "11100001111" & "00000";
  constant axis0_has_b2_at_0_table : std_logic_vector(0 to 15) := "00000000001" & "00000";
  constant lane_edge_rounding_at_3_table : std_logic_vector(0 to 15) := "00010100000" & "00000";
  constant axis_e_select_tap_at_8_table : numbers_t(0 to 15) := (7, 7, 7, 4, 11, 11, 11, 1, 4, 4, 4, others => 0);
  constant axis_f_select_tap_at_8_table : numbers_t(0 to 15) := (2, 3, 4, 6, 5, 6, 7, 3, 0, 1, 2, others => 0);
  constant axis0_v0_select_at_5_table : std_logic_vector(0 to 15) := "00010001001" & "00000";
  constant axis0_v1_1_select_tap_at_5_table : numbers_t(0 to 15) := (12, 12, 14, 14, 0, 5, 7, 7, 8, 10, 10, others => 0);
  constant axis0_v2_1_select_tap_at_5_table : numbers_t(0 to 15) := (10, 7, 8, 9, 0, 0, 1, 2, 4, 5, 6, others => 0);
  constant axis0_v3_select_at_5_table : std_logic_vector(0 to 15) := "01110000000" & "00000";
  constant axis0_has_a1_at_10_table : std_logic_vector(0 to 15) := "11111111101" & "00000";
  constant axis0_has_a2_at_10_table : std_logic_vector(0 to 15) := "00000100000" & "00000";
  constant axis0_has_b1_at_10_table : std_logic_vector(0 to 15) := "11111011111" & "00000";
  constant axis0_has_b2_at_10_table : std_logic_vector(0 to 15) := "00000000010" & "00000";
  signal row_t_pose : signed(31 downto 0);  -- s4.28; |.| <= 1073741816
  signal row_t_pose_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_t : signed(31 downto 0);  -- s4.28; |.| <= 1073741816
  signal row_m_pose : signed_32_vector_t;  -- s4.28; |.| <= 268435456
  signal row_diagonal_at_0 : std_logic_vector(2 downto 0) := (others => '0');
  signal row_m : signed_32_vector_t;  -- s4.28; |.| <= 268435456
  signal row_x : signed_32_vector_t;  -- s4.28; |.| <= 268435456
  signal row_x_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_m_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 268435456
  signal row_x_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 268435456
  signal row_t_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 1073741816
  signal pose_bypass_d1 : std_logic := '0';
  signal row : interval_32_t;  -- s4.28; |.| <= 1879048192
  signal in_phase_10 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(10 downto 0) := (others => '0');  -- one flag per phase
  signal b_lo : signed_32_vector_x3_t := zero_signed_32_vector_x3;  -- s4.28; |.| <= 1879048190; B's vertices in A's frame
  signal in_v0_h10 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 268435456
  signal in_v_h11 : signed_32_vector_x3_t := zero_signed_32_vector_x3;  -- s4.28; |.| <= 268435456
  signal lane : interval_32_vector_t;  -- s4.28; |.| <= 1879048192
  signal lane_select_at_10 : unsigned(2 downto 0) := (others => '0');
  signal row_hi_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 1879048192
  signal row_hi_d2 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 1879048192
  signal lane2_choice_operand_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal lane1_choice_operand_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal lane_hi_choice_operand : signed_32_vector_t;  -- s4.28; |.| <= 1879048192
  signal lane_from_input_at_10 : std_logic := '0';
  signal lane_hi_choice_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 1879048192
  signal lane_from_input_at_0 : std_logic := '0';
  signal lane_lo_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 1879048190
  signal offset : interval_33_vector_t;  -- s5.28; |.| <= 2147483648
  signal offset_d1 : interval_33_vector_t := zero_interval_33_vector;  -- s5.28; |.| <= 2147483648
  signal magnitude_magnitude : unsigned_33_vector_t;
  signal magnitude : unsigned_32_vector_t;
  signal axis0_has_b2_at_0 : std_logic := '0';
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
  signal v1_case : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal v0_case : unsigned_2_vector_t;
  signal w : interval_18_vector_x2_t := zero_interval_18_vector_x2;  -- s2.16; |.| <= 65536
  signal w_case : unsigned_2_vector_x2_t := zero_unsigned_2_vector_x2;
  signal lane_difference : interval_19_19_vector_t;  -- |.| <= 131072
  signal lane_difference_d1 : interval_19_19_vector_t := zero_interval_19_19_vector;  -- |.| <= 131072
  signal lane_edge_rounding_at_3 : std_logic := '0';
  signal lane_edge : interval_18_vector_t;  -- |.| <= 65537
  signal lane_edge_hi_second_up_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 65537
  signal lane_edge_case : unsigned_2_vector_t;
  signal axis_e_select_tap_at_8 : unsigned(3 downto 0) := (others => '0');
  signal axis_e : interval_18_vector_t;  -- |.| <= 65537
  signal axis_e_case : unsigned_2_vector_t;
  signal axis_f_select_tap_at_8 : unsigned(3 downto 0) := (others => '0');
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
  signal v1_h11 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal v0_hi_h11 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v1_h16 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal axis0_v : interval_18_vector_x4_t;  -- s2.16; |.| <= 65536
  signal axis0_v0_select_at_5 : std_logic := '0';
  signal axis0_v3_select_at_5 : std_logic := '0';
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
  signal axis0_v1_1_select_tap_at_5 : unsigned(3 downto 0) := (others => '0');
  signal axis0_v2_1_select_tap_at_5 : unsigned(3 downto 0) := (others => '0');
  type scaled_case_line_t is array (1 to 6) of unsigned_2_vector_t;
  signal scaled_case_line : scaled_case_line_t := (others => zero_unsigned_2_vector);
  signal scaled_d9 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65536
  signal scaled_case_d7 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal w0_h10 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal w1_h11 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal w0_case_h8 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal w1_case_h11 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal p_d1 : interval_22_x4_t := zero_interval_22_x4;  -- |.| <= 1572852
  signal axis0_has_a1_at_10 : std_logic := '0';
  signal axis0_has_a2_at_10 : std_logic := '0';
  signal axis0_has_b1_at_10 : std_logic := '0';
  signal axis0_has_b2_at_10 : std_logic := '0';
  signal axis_separated : std_logic;
  signal axis_overlapping : std_logic;
  signal axis0_above : std_logic_vector(5 downto 0);
  signal axis0_below : std_logic_vector(5 downto 0);
  signal pierced_w_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_w_below : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_edges_above : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_edges_below : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_v_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_v_below : std_logic_vector(2 downto 0) := (others => '0');
  signal separated_i : std_logic_vector(10 downto 0) := (others => '0');
  signal overlapping_i : std_logic_vector(10 downto 0) := (others => '0');
  signal pierced : std_logic;
  signal separate : std_logic;
  signal all_overlap : std_logic;
  signal surely : std_logic;
  signal verdict_and_first_not_h1 : std_logic := '0';
  signal surely_h1 : std_logic := '0';
  signal verdict_and_second_not_first_h1 : std_logic := '0';
  signal separated0_h11 : std_logic := '0';
  signal overlapping0_h11 : std_logic := '0';
  signal holds0_or_in_phase_10 : std_logic;
  signal in_phase_8 : std_logic;
  signal busy_10 : std_logic := '0';  -- set in clocks 9 to 19 of a pair
  signal in_phase_9 : std_logic;
  signal busy_11 : std_logic := '0';  -- set in clocks 10 to 20 of a pair
  signal in_phase_1 : std_logic;
  signal busy_25 : std_logic := '0';  -- set in clocks 24 to 34 of a pair
  signal in_phase_6 : std_logic;
  signal busy_30 : std_logic := '0';  -- set in clocks 29 to 39 of a pair
  signal in_phase_3 : std_logic;
  signal busy_38 : std_logic := '0';  -- set in clocks 37 to 47 of a pair
  signal busy_43 : std_logic := '0';  -- set in clocks 42 to 52 of a pair
  signal lane_hi_choice_operand_line_x : signed_32_vector_t;
  signal lane_hi_choice_operand_line_tap : unsigned_4_vector_t;
  signal offset_unit_point : interval_32_vector_t;
  signal axis_separated_unit_has : flag_x2_x2_t;
begin
  -- Strobes, one per phase
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 10 loop
        strobe(k) <= flag(phase = (k + 10) mod 11) and in_flight;
      end loop;
    end if;
  end process strobes;
  in_phase_10 <= flag(phase = 10);
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or holds(5) or in_phase_10;
  v0_lo_each : for i in 0 to 2 generate
    v0_lo(i) <= to_signed(0, 18);
    v0_case(i) <= to_unsigned(0, 2);
  end generate v0_lo_each;
  holds0_or_in_phase_10 <= holds(0) or in_phase_10;
  in_phase_8 <= flag(phase = 8);
  in_phase_9 <= flag(phase = 9);
  in_phase_1 <= flag(phase = 1);
  in_phase_6 <= flag(phase = 6);
  in_phase_3 <= flag(phase = 3);

  -- Clock 0
  row_t_pose <=
    pose_t(0) when row_t_pose_select_at_0 = 0 else
    pose_t(1) when row_t_pose_select_at_0 = 1 else
    pose_t(2);
  row_t <= to_signed(0, 32) when pose_bypass = '1' else row_t_pose;
  row_m_pose <=
    pose_m(0) when row_t_pose_select_at_0 = 0 else
    pose_m(1) when row_t_pose_select_at_0 = 1 else
    pose_m(2);
  row_m_each : for i in 0 to 2 generate
    row_m(i) <= choose(row_diagonal_at_0(i), to_signed(268435456, 32), to_signed(0, 32)) when pose_bypass = '1' else
        row_m_pose(i);
  end generate row_m_each;
  row_x <=
    in_w(0) when row_x_select_at_0 = 0 else
    in_w(1) when row_x_select_at_0 = 1 else
    in_w(2);

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      row_m_d1 <= row_m;
      row_x_d1 <= row_x;
      row_t_d1 <= row_t;
      pose_bypass_d1 <= pose_bypass;
    end if;
  end process clock_1;
  row_unit : entity work.transform_row
    port map (clk => clk, m => row_m_d1, x => row_x_d1, t => row_t_d1, bypass => pose_bypass_d1, b => row);

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      row_hi_d1 <= row.hi;
    end if;
  end process clock_8;

  -- Clock 9
  clock_9 : process (clk)
  begin
    if rising_edge(clk) then
      row_hi_d2 <= row_hi_d1;
    end if;
  end process clock_9;
  lane_hi_choice_operand_line_x(0) <= row_hi_d2;
  lane_hi_choice_operand_line_x(1) <= row.hi;
  lane_hi_choice_operand_line_x(2) <= row.hi;
  lane_hi_choice_operand_line_tap(0) <= lane2_choice_operand_select_tap_at_10;
  lane_hi_choice_operand_line_tap(1) <= lane1_choice_operand_select_tap_at_10;
  lane_hi_choice_operand_line_tap(2) <= lane2_choice_operand_select_tap_at_10;
  lane_hi_choice_operand_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_32
      port map (clk => clk, x => lane_hi_choice_operand_line_x(i), tap => lane_hi_choice_operand_line_tap(i),
                y => lane_hi_choice_operand(i));
  end generate lane_hi_choice_operand_line;

  -- Clock 10
  lane_lo_each : for i in 0 to 2 generate
    lane(i).lo <=
      in_v0_h10(i) when lane_select_at_10 = 0 else
      in_v_h11(1)(i) when lane_select_at_10 = 1 else
      in_v_h11(2)(i) when lane_select_at_10 = 2 else
      b_lo(0)(i) when lane_select_at_10 = 3 else
      b_lo(1)(i) when lane_select_at_10 = 4 else
      b_lo(2)(i);
  end generate lane_lo_each;

  -- Clock 11
  clock_11 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        lane_hi_choice_d1(i) <= choose(lane_from_input_at_10, lane(i).lo, lane_hi_choice_operand(i));
        lane_lo_d1(i) <= lane(i).lo;
      end loop;
    end if;
  end process clock_11;
  lane_hi_each : for i in 0 to 2 generate
    lane(i).hi <= lane_hi_choice_d1(i) + to_signed(lane_from_input_at_0, 32);
    offset_unit_point(i).lo <= lane_lo_d1(i);
    offset_unit_point(i).hi <= lane(i).hi;
  end generate lane_hi_each;
  offset_unit : entity work.renormalise_offset
    port map (point => offset_unit_point, origin => in_v_h11(0), offset => offset);

  -- Clock 12
  clock_12 : process (clk)
  begin
    if rising_edge(clk) then
      offset_d1 <= offset;
    end if;
  end process clock_12;
  magnitude_magnitude_each : for i in 0 to 2 generate
    magnitude_magnitude(i) <= abs_of(offset_d1(i).lo);
    magnitude(i) <= magnitude_magnitude(i)(31 downto 0) or
        choose(offset_d1(i).hi(32), to_unsigned(0, 32), unsigned(offset_d1(i).hi(31 downto 0)));
    magnitude_so_far(i) <= magnitude(i) or magnitude_so_far_before(i);
  end generate magnitude_magnitude_each;

  -- Clock 19
  shift_unit : for i in 0 to 2 generate
    unit : entity work.renormalise_shift
      port map (clk => clk, magnitudes => magnitudes(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      shift_d1 <= shift;
    end if;
  end process clock_22;
  scaled_unit : entity work.renormalise_scale
    port map (clk => clk, offset => offset_line(10), shift => shift_d1, scaled => scaled);

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d1 <= scaled;
    end if;
  end process clock_24;
  lane_difference_lo_each : for i in 0 to 2 generate
    lane_difference(i).lo <= resize(scaled_d1(i).lo, 19) - resize(scaled_d2(i).hi, 19);
    lane_difference(i).hi <= resize(scaled_d1(i).hi, 19) - resize(scaled_d2(i).lo, 19);
  end generate lane_difference_lo_each;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d2 <= scaled_d1;
      lane_difference_d1 <= lane_difference;
      for i in 0 to 2 loop
        lane_edge_hi_second_up_d1(i) <= resize(lane_difference(i).hi(18 downto 1), 19) + 1;
      end loop;
    end if;
  end process clock_25;
  lane_edge_lo_each : for i in 0 to 2 generate
    lane_edge(i).lo <= lane_difference_d1(i).lo(17 downto 0) when lane_edge_rounding_at_3 = '1' else
        lane_difference_d1(i).lo(18 downto 1);
    lane_edge(i).hi <= lane_difference_d1(i).hi(17 downto 0) when lane_edge_rounding_at_3 = '1' else
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
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_e_select_tap_at_8, y => axis_e(i).lo);
  end generate axis_e_lo_line;
  axis_e_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_e_select_tap_at_8, y => axis_e(i).hi);
  end generate axis_e_hi_line;
  axis_e_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_e_select_tap_at_8, y => axis_e_case(i));
  end generate axis_e_case_line;
  axis_f_lo_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_f_select_tap_at_8, y => axis_f(i).lo);
  end generate axis_f_lo_line;
  axis_f_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_f_select_tap_at_8, y => axis_f(i).hi);
  end generate axis_f_hi_line;
  axis_f_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_f_select_tap_at_8, y => axis_f_case(i));
  end generate axis_f_case_line;

  -- Clock 31
  clock_31 : process (clk)
  begin
    if rising_edge(clk) then
      axis_e_d1 <= axis_e;
      axis_e_case_d1 <= axis_e_case;
      axis_f_d1 <= axis_f;
      axis_f_case_d1 <= axis_f_case;
    end if;
  end process clock_31;
  axis_exact_unit : entity work.cross_product
    port map (clk => clk, e => axis_e_d1, e_case => axis_e_case_d1, f => axis_f_d1, f_case => axis_f_case_d1,
              l => axis_exact);
  axis0_v_lo1_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => scaled_line(6)(i).lo, tap => axis0_v1_1_select_tap_at_5, y => axis0_v(1)(i).lo);
  end generate axis0_v_lo1_line;
  axis0_v_lo2_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => scaled_d9(i).lo, tap => axis0_v2_1_select_tap_at_5, y => axis0_v(2)(i).lo);
  end generate axis0_v_lo2_line;
  axis0_v_hi1_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => scaled_line(6)(i).hi, tap => axis0_v1_1_select_tap_at_5, y => axis0_v(1)(i).hi);
  end generate axis0_v_hi1_line;
  axis0_v_hi2_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => scaled_d9(i).hi, tap => axis0_v2_1_select_tap_at_5, y => axis0_v(2)(i).hi);
  end generate axis0_v_hi2_line;
  axis0_v1_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => scaled_case_line(6)(i), tap => axis0_v1_1_select_tap_at_5, y => axis0_v_case(1)(i));
  end generate axis0_v1_case_line;
  axis0_v2_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => scaled_case_d7(i), tap => axis0_v2_1_select_tap_at_5, y => axis0_v_case(2)(i));
  end generate axis0_v2_case_line;

  -- Clock 32
  clock_32 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d9 <= scaled_line(6);
      scaled_case_d7 <= scaled_case_line(6);
    end if;
  end process clock_32;

  -- Clock 34
  clock_34 : process (clk)
  begin
    if rising_edge(clk) then
      axis_exact_d1 <= axis_exact;
    end if;
  end process clock_34;
  axis_l_unit : entity work.axis_shift
    port map (clk => clk, exact => axis_exact_d1, l => axis_l);

  -- Clock 38
  clock_38 : process (clk)
  begin
    if rising_edge(clk) then
      axis_l_d1 <= axis_l;
    end if;
  end process clock_38;
  axis0_v_0_lo_each : for i in 0 to 2 generate
    axis0_v(0)(i).lo <= v1_h16(i).lo when axis0_v0_select_at_5 = '1' else v0_lo(i);
    axis0_v(0)(i).hi <= v1_h16(i).hi when axis0_v0_select_at_5 = '1' else v0_hi_h14(i);
  end generate axis0_v_0_lo_each;
  axis0_v(3) <= w1_h11 when axis0_v3_select_at_5 = '1' else w0_h10;
  axis0_v_case(0) <= v1_case_h11 when axis0_v0_select_at_5 = '1' else v0_case;
  axis0_v_case(3) <= w1_case_h11 when axis0_v3_select_at_5 = '1' else w0_case_h8;
  axis_l_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => axis_l_d1(i), number => axis_l_case(i));
  end generate axis_l_case_unit;

  -- Clock 39
  clock_39 : process (clk)
  begin
    if rising_edge(clk) then
      axis0_v_d1 <= axis0_v;
      axis0_v_case_d1 <= axis0_v_case;
      axis_l_d2 <= axis_l_d1;
      axis_l_case_d1 <= axis_l_case;
    end if;
  end process clock_39;
  p_unit : for k in 0 to 3 generate
    unit : entity work.projection
      port map (clk => clk, v => axis0_v_d1(k), v_case => axis0_v_case_d1(k), l => axis_l_d2, l_case => axis_l_case_d1,
                p => p(k));
  end generate p_unit;

  -- Clock 43
  clock_43 : process (clk)
  begin
    if rising_edge(clk) then
      p_d1 <= p;
    end if;
  end process clock_43;
  axis_separated_unit_has(0)(0) <= axis0_has_a1_at_10;
  axis_separated_unit_has(0)(1) <= axis0_has_a2_at_10;
  axis_separated_unit_has(1)(0) <= axis0_has_b1_at_10;
  axis_separated_unit_has(1)(1) <= axis0_has_b2_at_10;
  axis_separated_unit : entity work.comparator_network
    port map (clk => clk, p => p_d1, has => axis_separated_unit_has, separated => axis_separated,
              overlapping => axis_overlapping, above => axis0_above, below => axis0_below);

  -- Clock 55
  separate <= or_reduce(unsigned(separated_i));
  all_overlap <= not or_reduce(not unsigned(overlapping_i));
  surely <= all_overlap or pierced;
  pierced_unit : entity work.edge_test
    port map (v_above => pierced_v_above, v_below => pierced_v_below, w_above => pierced_w_above,
              w_below => pierced_w_below, edges_above => pierced_edges_above, edges_below => pierced_edges_below,
              pierced => pierced);

  -- Clock 56
  verdict <= (verdict_and_second_not_first_h1 and not surely_h1) & (verdict_and_first_not_h1 and surely_h1);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if holds0_or_in_phase_10 = '1' then
        row_t_pose_select_at_0 <= to_unsigned(row_t_pose_select_at_0_table(to_integer(phase)), 2);
        row_diagonal_at_0(0) <= row_diagonal_at_0_0_table(to_integer(phase));
        row_diagonal_at_0(1) <= row_diagonal_at_0_1_table(to_integer(phase));
        row_diagonal_at_0(2) <= row_diagonal_at_0_2_table(to_integer(phase));
        row_x_select_at_0 <= to_unsigned(row_x_select_at_0_table(to_integer(phase)), 2);
      end if;
      if busy_10 = '1' then
        lane_select_at_10 <= to_unsigned(lane_select_at_10_table(to_integer(phase)), 3);
        lane2_choice_operand_select_tap_at_10 <=
            to_unsigned(lane2_choice_operand_select_tap_at_10_table(to_integer(phase)), 4);
        lane1_choice_operand_select_tap_at_10 <=
            to_unsigned(lane1_choice_operand_select_tap_at_10_table(to_integer(phase)), 4);
        lane_from_input_at_10 <= lane_from_input_at_10_table(to_integer(phase));
      end if;
      if busy_11 = '1' then
        lane_from_input_at_0 <= lane_from_input_at_0_table(to_integer(phase));
        axis0_has_b2_at_0 <= axis0_has_b2_at_0_table(to_integer(phase));
      end if;
      if busy_25 = '1' then
        lane_edge_rounding_at_3 <= lane_edge_rounding_at_3_table(to_integer(phase));
      end if;
      if busy_30 = '1' then
        axis_e_select_tap_at_8 <= to_unsigned(axis_e_select_tap_at_8_table(to_integer(phase)), 4);
        axis_f_select_tap_at_8 <= to_unsigned(axis_f_select_tap_at_8_table(to_integer(phase)), 4);
      end if;
      if busy_38 = '1' then
        axis0_v0_select_at_5 <= axis0_v0_select_at_5_table(to_integer(phase));
        axis0_v3_select_at_5 <= axis0_v3_select_at_5_table(to_integer(phase));
        axis0_v1_1_select_tap_at_5 <= to_unsigned(axis0_v1_1_select_tap_at_5_table(to_integer(phase)), 4);
        axis0_v2_1_select_tap_at_5 <= to_unsigned(axis0_v2_1_select_tap_at_5_table(to_integer(phase)), 4);
      end if;
      if busy_43 = '1' then
        axis0_has_a1_at_10 <= axis0_has_a1_at_10_table(to_integer(phase));
        axis0_has_a2_at_10 <= axis0_has_a2_at_10_table(to_integer(phase));
        axis0_has_b1_at_10 <= axis0_has_b1_at_10_table(to_integer(phase));
        axis0_has_b2_at_10 <= axis0_has_b2_at_10_table(to_integer(phase));
      end if;
    end if;
  end process selectors;

  -- Registers that are loaded once per pair
  captures : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        if strobe(i + 7) = '1' then
          b_lo(0)(i) <= row.lo;
        end if;
        if strobe((i + 10) mod 11) = '1' then
          b_lo(1)(i) <= row.lo;
        end if;
        if strobe(i + 2) = '1' then
          b_lo(2)(i) <= row.lo;
        end if;
      end loop;
      if strobe(9) = '1' then
        in_v0_h10 <= in_v(0);
        pierced_edges_above(1)(2) <= axis0_above(4);
        pierced_edges_below(1)(2) <= axis0_below(4);
        separated_i(7) <= axis_separated;
        overlapping_i(7) <= axis_overlapping;
      end if;
      if strobe(10) = '1' then
        in_v_h11 <= in_v;
        pierced_edges_above(2)(2) <= axis0_above(4);
        pierced_edges_below(2)(2) <= axis0_below(4);
        separated_i(10) <= axis_separated;
        overlapping_i(10) <= axis_overlapping;
      end if;
      if strobe(7) = '1' then
        magnitudes <= magnitude_so_far;
        v1_h16 <= v1_h11;
        pierced_v_above(0) <= axis0_above(0);
        pierced_v_above(1) <= axis0_above(3);
        pierced_v_above(2) <= axis0_above(5);
        pierced_v_below(0) <= axis0_below(0);
        pierced_v_below(1) <= axis0_below(3);
        pierced_v_below(2) <= axis0_below(5);
        separated_i(1) <= axis_separated;
        overlapping_i(1) <= axis_overlapping;
      end if;
      if strobe(1) = '1' then
        for i in 0 to 2 loop
          v0_hi(i) <= scaled(i).hi;
        end loop;
        v0_hi_h11 <= v0_hi;
        pierced_edges_above(0)(0) <= axis0_above(0);
        pierced_edges_below(0)(0) <= axis0_below(0);
        separated_i(2) <= axis_separated;
        overlapping_i(2) <= axis_overlapping;
      end if;
      if strobe(2) = '1' then
        v1 <= scaled;
        v1_h11 <= v1;
        pierced_edges_above(1)(0) <= axis0_above(3);
        pierced_edges_below(1)(0) <= axis0_below(3);
        separated_i(5) <= axis_separated;
        overlapping_i(5) <= axis_overlapping;
      end if;
      if strobe(4) = '1' then
        v1_case <= scaled_case;
        v0_hi_h14 <= v0_hi_h11;
        v1_case_h11 <= v1_case;
        w0_h10 <= w(0);
        w0_case_h8 <= w_case(0);
        pierced_edges_above(0)(1) <= axis0_above(1);
        pierced_edges_below(0)(1) <= axis0_below(1);
        separated_i(3) <= axis_separated;
        overlapping_i(3) <= axis_overlapping;
      end if;
      for k in 0 to 1 loop
        if strobe(k + 5) = '1' then
          w(k) <= scaled;
        end if;
        if strobe(k + 7) = '1' then
          w_case(k) <= scaled_case;
        end if;
      end loop;
      if strobe(6) = '1' then
        w1_h11 <= w(1);
        pierced_edges_above(2)(1) <= axis0_above(4);
        pierced_edges_below(2)(1) <= axis0_below(4);
        separated_i(9) <= axis_separated;
        overlapping_i(9) <= axis_overlapping;
      end if;
      if strobe(8) = '1' then
        w1_case_h11 <= w_case(1);
        pierced_edges_above(0)(2) <= axis0_above(1);
        pierced_edges_below(0)(2) <= axis0_below(1);
        separated_i(4) <= axis_separated;
        overlapping_i(4) <= axis_overlapping;
      end if;
      if strobe(0) = '1' then
        for k in 0 to 2 loop
          pierced_w_above(k) <= axis0_above(k);
          pierced_w_below(k) <= axis0_below(k);
        end loop;
        separated_i(0) <= axis_separated;
        overlapping_i(0) <= axis_overlapping;
        verdict_and_first_not_h1 <= not separate;
        surely_h1 <= surely;
        verdict_and_second_not_first_h1 <= not separate;
        separated0_h11 <= separated_i(0);
        overlapping0_h11 <= overlapping_i(0);
      end if;
      if strobe(5) = '1' then
        pierced_edges_above(1)(1) <= axis0_above(4);
        pierced_edges_below(1)(1) <= axis0_below(4);
        separated_i(6) <= axis_separated;
        overlapping_i(6) <= axis_overlapping;
      end if;
      if strobe(3) = '1' then
        pierced_edges_above(2)(0) <= axis0_above(3);
        pierced_edges_below(2)(0) <= axis0_below(3);
        separated_i(8) <= axis_separated;
        overlapping_i(8) <= axis_overlapping;
      end if;
      if in_phase_8 = '1' then
        busy_10 <= holds(0);
        busy_43 <= holds(3);
      end if;
      if in_phase_9 = '1' then
        busy_11 <= holds(0);
      end if;
      if in_phase_1 = '1' then
        busy_25 <= holds(2);
      end if;
      if in_phase_6 = '1' then
        busy_30 <= holds(2);
      end if;
      if in_phase_3 = '1' then
        busy_38 <= holds(3);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      offset_line <= offset_d1 & offset_line(1 to 9);
      scaled_line <= scaled_d2 & scaled_line(1 to 5);
      scaled_case_line <= scaled_case & scaled_case_line(1 to 5);
    end if;
  end process delays;

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if axis0_has_b2_at_0 = '1' then
        for i in 0 to 2 loop
          magnitude_so_far_before(i) <= to_unsigned(0, 32);
        end loop;
      else
        magnitude_so_far_before <= magnitude_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  separated(0) <= separated0_h11;
  separated(1) <= separated_i(1);
  separated(2) <= separated_i(2);
  separated(3) <= separated_i(3);
  separated(4) <= separated_i(4);
  separated(5) <= separated_i(5);
  separated(6) <= separated_i(6);
  separated(7) <= separated_i(7);
  separated(8) <= separated_i(8);
  separated(9) <= separated_i(9);
  separated(10) <= separated_i(10);
  overlapping(0) <= overlapping0_h11;
  overlapping(1) <= overlapping_i(1);
  overlapping(2) <= overlapping_i(2);
  overlapping(3) <= overlapping_i(3);
  overlapping(4) <= overlapping_i(4);
  overlapping(5) <= overlapping_i(5);
  overlapping(6) <= overlapping_i(6);
  overlapping(7) <= overlapping_i(7);
  overlapping(8) <= overlapping_i(8);
  overlapping(9) <= overlapping_i(9);
  overlapping(10) <= overlapping_i(10);
end architecture rtl;
