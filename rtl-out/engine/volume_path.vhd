-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of an expansion: D, then in each direction h of A the bound of D, B's codes through the row of h, A's
-- code of the opposite direction, and the test. Units are shared over the phases of the slot. A value captured for the
-- expansion is named after what it is; later copies end in _h<clocks>, or are elements of x_held.
-- Latency: 13 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_path is
  port (
    clk         : in  std_logic;
    phase       : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(3 downto 0);  -- whether the slot k slots ago holds a pair
    query_pose  : in  signed_18_vector_x3_t;  -- s1.17; |.| <= 131071
    query_shift : in  signed_26_vector_t;  -- s4.22; |.| <= 16777216
    query_error : in  unsigned_16_vector_t;
    query_row   : in  row_u13_x9_t;
    a_origin    : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    a_exponent  : in  unsigned(3 downto 0);
    a_code      : in  signed_10_x18_x2_t;  -- |.| <= 511
    a_take      : in  std_logic_vector(1 downto 0);
    b_origin    : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    b_exponent  : in  unsigned(3 downto 0);
    b_code      : in  signed_10_x18_x2_t;  -- |.| <= 511
    b_take      : in  std_logic_vector(1 downto 0);
    survive     : out std_logic_vector(3 downto 0)
  );
end entity volume_path;

architecture rtl of volume_path is
  constant d_lane_m_select_at_0_table : numbers_t(0 to 3) := (1, 2, 0, 0);
  constant b_chosen0_select_at_1_table : numbers_t(0 to 3) := (0, 1, 2, 3);
  constant axis_bound_operand_select_at_2_table : std_logic_vector(0 to 3) := "1001";
  constant ceiling_table : numbers_t(0 to 15) := (2047, 1023, 511, 255, 127, 63, 31, 15, 7, 3, 1, 0, 0, 0, 0, 0);
  signal d_lane_m : signed_18_vector_t;  -- s1.17; |.| <= 131071
  signal d_lane_m_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal d_lane_t : signed(25 downto 0);  -- s4.22; |.| <= 16777216
  signal d_lane_o_a : signed(17 downto 0);  -- s1.17; |.| <= 131072
  signal in_phase_3 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(3 downto 0) := (others => '0');  -- one flag per phase
  signal b_origin_h1 : signed_18_vector_t := zero_signed_18_vector;  -- s1.17; |.| <= 131072
  signal d_lane_m_d1 : signed_18_vector_t := zero_signed_18_vector;  -- s1.17; |.| <= 131071
  signal d_lane_t_d1 : signed(25 downto 0) := (others => '0');  -- s4.22; |.| <= 16777216
  signal d_lane_o_a_d1 : signed(17 downto 0) := (others => '0');  -- s1.17; |.| <= 131072
  signal d_lane : signed(25 downto 0);  -- s4.22; |.| <= 33554336
  signal d : signed_26_x3_t := zero_signed_26_x3;  -- s4.22; |.| <= 33554336
  signal query_error_resized_h4 : signed_26_vector_t := zero_signed_26_vector;  -- s4.22; |.| <= 65535
  signal query_error_resized_h6 : signed_26_vector_t := zero_signed_26_vector;  -- s4.22; |.| <= 65535
  signal axis_bound : signed_27_x2_vector_t;  -- s5.22; |.| <= 33619871
  signal b_code1_h4 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal b_chosen : signed_10_x18_t;  -- |.| <= 511
  signal b_chosen0_select_at_1 : unsigned(1 downto 0) := (others => '0');
  signal axis_bound_x1_h2 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619839
  signal axis_bound_y_h2 : signed_27_x2_t := zero_signed_27_x2;  -- s5.22; |.| <= 33619871
  signal axis_bound_operand_select_at_2 : std_logic := '0';
  signal axis_bound0_operand_d1 : signed_27_vector_t := zero_signed_27_vector;  -- s5.22; |.| <= 33619871
  signal axis_bound1_z_operand_d1 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619871
  signal axis_bound0_operand_d2 : signed_27_vector_t := zero_signed_27_vector;  -- s5.22; |.| <= 33619871
  signal bound : signed_28_x9_t;  -- s6.22; |.| <= 67239742
  signal bound4_operand_second_d1 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619871
  signal query_row_held : row_u13_x9_t := zero_row_u13_x9;  -- from clocks 3, 4 on
  signal b_chosen_d1 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal b_chosen_d2 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal term0 : signed_10_x9_t;  -- |.| <= 511
  signal term1 : signed_10_x9_t;  -- |.| <= 511
  signal term2 : signed_10_x9_t;  -- |.| <= 511
  signal ceiling_h3 : unsigned(10 downto 0) := (others => '0');
  signal term0_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal term1_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal term2_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal ceiling_h3_d1 : unsigned(10 downto 0) := (others => '0');
  signal s : signed_24_x9_t;  -- |.| <= 6287873
  signal b_exponent_h4 : unsigned(3 downto 0) := (others => '0');
  signal b_exponent_h7 : unsigned(3 downto 0) := (others => '0');
  signal s_d1 : signed_24_x9_t := zero_signed_24_x9;  -- |.| <= 6287873
  signal u : signed_28_x9_t;  -- s6.22; |.| <= 100605968
  signal a_code_h4 : signed_10_x18_x2_t := zero_signed_10_x18_x2;  -- |.| <= 511
  signal a_code0_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code2_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code4_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code6_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code8_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code10_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code12_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code14_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code16_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_exponent_h4 : unsigned(3 downto 0) := (others => '0');
  signal a_exponent_h7 : unsigned(3 downto 0) := (others => '0');
  signal v_x_d1 : signed_10_x2_x9_t := zero_signed_10_x2_x9;  -- |.| <= 511
  signal v : signed_25_x2_x9_t;  -- s3.22; |.| <= 16744448
  signal u_d1 : signed_28_x9_t := zero_signed_28_x9;  -- s6.22; |.| <= 100605968
  signal v_d1 : signed_25_x2_x9_t := zero_signed_25_x2_x9;  -- s3.22; |.| <= 16744448
  signal apart : flag_x2_x9_t;
  signal bound_d1 : signed_28_3_to_8_t := zero_signed_28_3_to_8;  -- s6.22; |.| <= 67239742
  signal apart_in_phase_word_d1 : unsigned_9_x2_t := zero_unsigned_9_x2;
  signal apart_in_phase : std_logic_vector(1 downto 0);
  signal apart_found_word_captured_first : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_second : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found : flag_x2_x2_t;
  signal survive_and_held : flag_x4_x3_t := zero_flag_x4_x3;  -- from clocks 4, 8, 12 on
  signal survive1_and_h13 : std_logic := '0';
  signal survive3_and_h13 : std_logic := '0';
  signal busy_0 : std_logic;  -- set in the clock before a pair, and in clock 0 of one
  signal in_phase_0 : std_logic;
  signal busy_6 : std_logic := '0';  -- set in clocks 5 to 8 of a pair
  signal term0_unit_codes : signed_10_x6_x9_t;
  signal term1_unit_codes : signed_10_x6_x9_t;
  signal term2_unit_codes : signed_10_x6_x9_t;
  signal s_unit_codes : signed_10_x3_x9_t;
  signal apart_unit_bound : signed_28_x9_t;
begin
  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        strobe(k) <= flag(known(phase) = (k + 3) mod 4) and in_flight;
      end loop;
    end if;
  end process strobes;
  in_phase_3 <= flag(known(phase) = 3);
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or in_phase_3;
  busy_0 <= holds(0) or in_phase_3;
  in_phase_0 <= flag(known(phase) = 0);

  -- Clock 0
  d_lane_m <=
    query_pose(0) when known(d_lane_m_select_at_0) = 0 else
    query_pose(1) when known(d_lane_m_select_at_0) = 1 else
    query_pose(2);
  d_lane_t <=
    query_shift(0) when known(d_lane_m_select_at_0) = 0 else
    query_shift(1) when known(d_lane_m_select_at_0) = 1 else
    query_shift(2);
  d_lane_o_a <=
    a_origin(0) when known(d_lane_m_select_at_0) = 0 else
    a_origin(1) when known(d_lane_m_select_at_0) = 1 else
    a_origin(2);

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      d_lane_m_d1 <= d_lane_m;
      d_lane_t_d1 <= d_lane_t;
      d_lane_o_a_d1 <= d_lane_o_a;
    end if;
  end process clock_1;
  b_chosen(0) <=
    b_code(0)(0) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(0) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(1) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(1);
  b_chosen(1) <=
    b_code(0)(1) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(1) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(0) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(0);
  b_chosen(2) <=
    b_code(0)(2) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(2) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(3) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(3);
  b_chosen(3) <=
    b_code(0)(3) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(3) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(2) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(2);
  b_chosen(4) <=
    b_code(0)(4) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(4) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(5) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(5);
  b_chosen(5) <=
    b_code(0)(5) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(5) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(4) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(4);
  b_chosen(6) <=
    b_code(0)(6) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(6) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(7) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(7);
  b_chosen(7) <=
    b_code(0)(7) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(7) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(6) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(6);
  b_chosen(8) <=
    b_code(0)(8) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(8) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(9) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(9);
  b_chosen(9) <=
    b_code(0)(9) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(9) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(8) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(8);
  b_chosen(10) <=
    b_code(0)(10) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(10) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(11) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(11);
  b_chosen(11) <=
    b_code(0)(11) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(11) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(10) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(10);
  b_chosen(12) <=
    b_code(0)(12) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(12) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(13) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(13);
  b_chosen(13) <=
    b_code(0)(13) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(13) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(12) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(12);
  b_chosen(14) <=
    b_code(0)(14) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(14) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(15) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(15);
  b_chosen(15) <=
    b_code(0)(15) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(15) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(14) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(14);
  b_chosen(16) <=
    b_code(0)(16) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(16) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(17) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(17);
  b_chosen(17) <=
    b_code(0)(17) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(17) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(16) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(16);
  d_lane_unit : entity work.volume_origin_row
    port map (clk => clk, m => d_lane_m_d1, t => d_lane_t_d1, o_b => b_origin_h1, o_a => d_lane_o_a_d1, d => d_lane);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      b_chosen_d1 <= b_chosen;
    end if;
  end process clock_2;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      b_chosen_d2 <= b_chosen_d1;
    end if;
  end process clock_3;
  term0_unit_codes_0_each : for k in 0 to 8 generate
    term0_unit_codes(k)(0) <= b_chosen_d2(0);
    term0_unit_codes(k)(1) <= b_chosen_d2(1);
    term0_unit_codes_each : for m in 2 to 5 generate
      term0_unit_codes(k)(m) <= b_chosen_d2(m + 12);
    end generate term0_unit_codes_each;
    term1_unit_codes(k)(0) <= b_chosen_d2(2);
    term1_unit_codes(k)(1) <= b_chosen_d2(3);
    term1_unit_codes_each : for m in 2 to 5 generate
      term1_unit_codes(k)(m) <= b_chosen_d2(m + 8);
    end generate term1_unit_codes_each;
    term2_unit_codes_each : for m in 0 to 5 generate
      term2_unit_codes(k)(m) <= b_chosen_d2(m + 4);
    end generate term2_unit_codes_each;
  end generate term0_unit_codes_0_each;
  term0_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term0_unit_codes(k), choice => query_row_held(k).choice(0), code => term0(k));
  end generate term0_unit;
  term1_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term1_unit_codes(k), choice => query_row_held(k).choice(1), code => term1(k));
  end generate term1_unit;
  term2_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term2_unit_codes(k), choice => query_row_held(k).choice(2), code => term2(k));
  end generate term2_unit;

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      term0_d1 <= term0;
      term1_d1 <= term1;
      term2_d1 <= term2;
      ceiling_h3_d1 <= ceiling_h3;
    end if;
  end process clock_4;
  s_unit_codes_0_each : for k in 0 to 8 generate
    s_unit_codes(k)(0) <= term0_d1(k);
    s_unit_codes(k)(1) <= term1_d1(k);
    s_unit_codes(k)(2) <= term2_d1(k);
  end generate s_unit_codes_0_each;
  s_unit : for k in 0 to 8 generate
    unit : entity work.volume_row_sum
      port map (clk => clk, codes => s_unit_codes(k), factors => query_row_held(k).factor,
                rest => query_row_held(k).rest, ceiling => ceiling_h3_d1, s => s(k));
  end generate s_unit;

  -- Clock 6
  axis_bound_0_each : for i in 0 to 2 generate
    axis_bound(i)(0) <= resize(query_error_resized_h6(i), 27) + resize(d(i), 27);
    axis_bound(i)(1) <= resize(query_error_resized_h6(i), 27) - resize(d(i), 27);
  end generate axis_bound_0_each;

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      axis_bound0_operand_d1(0) <= choose(axis_bound_operand_select_at_2, axis_bound_x1_h2, axis_bound(0)(0));
      axis_bound0_operand_d1(1) <= choose(axis_bound_operand_select_at_2, axis_bound_y_h2(1), axis_bound(1)(0));
      axis_bound0_operand_d1(2) <= choose(axis_bound_operand_select_at_2, axis_bound(2)(1), axis_bound(2)(0));
      if axis_bound_operand_select_at_2 = '1' then
        axis_bound1_z_operand_d1 <= axis_bound(2)(0);
      else
        axis_bound1_z_operand_d1 <= axis_bound(2)(1);
      end if;
      if axis_bound_operand_select_at_2 = '1' then
        bound4_operand_second_d1 <= axis_bound_y_h2(0);
      else
        bound4_operand_second_d1 <= axis_bound(1)(1);
      end if;
      s_d1 <= s;
      for m in 0 to 1 loop
        v_x_d1(0)(m) <= choose(axis_bound_operand_select_at_2, a_code0_h8(m), a_code_h4(m)(1));
        v_x_d1(1)(m) <= choose(axis_bound_operand_select_at_2, a_code2_h8(m), a_code_h4(m)(3));
        v_x_d1(2)(m) <= choose(axis_bound_operand_select_at_2, a_code4_h8(m), a_code_h4(m)(5));
        v_x_d1(3)(m) <= choose(axis_bound_operand_select_at_2, a_code6_h8(m), a_code_h4(m)(7));
        v_x_d1(4)(m) <= choose(axis_bound_operand_select_at_2, a_code8_h8(m), a_code_h4(m)(9));
        v_x_d1(5)(m) <= choose(axis_bound_operand_select_at_2, a_code10_h8(m), a_code_h4(m)(11));
        v_x_d1(6)(m) <= choose(axis_bound_operand_select_at_2, a_code12_h8(m), a_code_h4(m)(13));
        v_x_d1(7)(m) <= choose(axis_bound_operand_select_at_2, a_code14_h8(m), a_code_h4(m)(15));
        v_x_d1(8)(m) <= choose(axis_bound_operand_select_at_2, a_code16_h8(m), a_code_h4(m)(17));
      end loop;
    end if;
  end process clock_7;
  bound(3) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound0_operand_d1(1), 28);
  bound(4) <= resize(axis_bound0_operand_d1(0), 28) + resize(bound4_operand_second_d1, 28);
  bound(5) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound0_operand_d1(2), 28);
  bound(6) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound1_z_operand_d1, 28);
  bound(7) <= resize(axis_bound0_operand_d1(1), 28) + resize(axis_bound0_operand_d1(2), 28);
  bound(8) <= resize(axis_bound0_operand_d1(1), 28) + resize(axis_bound1_z_operand_d1, 28);
  u_unit : for k in 0 to 8 generate
    unit : entity work.volume_align_sum
      port map (x => s_d1(k), exponent => b_exponent_h7, aligned => u(k));
  end generate u_unit;
  v_unit_of : for k in 0 to 8 generate
    v_unit : for m in 0 to 1 generate
      unit : entity work.volume_align_code
        port map (x => v_x_d1(k)(m), exponent => a_exponent_h7, aligned => v(k)(m));
    end generate v_unit;
  end generate v_unit_of;

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      axis_bound0_operand_d2 <= axis_bound0_operand_d1;
      u_d1 <= u;
      v_d1 <= v;
      for k in 3 to 8 loop
        bound_d1(k) <= bound(k);
      end loop;
    end if;
  end process clock_8;
  bound(0) <= resize(axis_bound0_operand_d2(0), 28);
  bound(1) <= resize(axis_bound0_operand_d2(1), 28);
  bound(2) <= resize(axis_bound0_operand_d2(2), 28);
  apart_unit_bound(0) <= bound(0);
  apart_unit_bound(1) <= bound(1);
  apart_unit_bound(2) <= bound(2);
  apart_unit_bound_each : for k in 3 to 8 generate
    apart_unit_bound(k) <= bound_d1(k);
  end generate apart_unit_bound_each;
  apart_unit : for k in 0 to 8 generate
    unit : entity work.volume_direction_test
      port map (bound => apart_unit_bound(k), u => u_d1(k), v => v_d1(k), apart => apart(k));
  end generate apart_unit;

  -- Clock 9
  clock_9 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 1 loop
        apart_in_phase_word_d1(k) <= apart(8)(k) & apart(7)(k) & apart(6)(k) & apart(5)(k) & apart(4)(k) & apart(3)(k)
            & apart(2)(k) & apart(1)(k) & apart(0)(k);
      end loop;
    end if;
  end process clock_9;
  apart_in_phase_each : for k in 0 to 1 generate
    apart_in_phase(k) <= or_reduce(apart_in_phase_word_d1(k));
  end generate apart_in_phase_each;

  -- Clock 12
  apart_found_0_each : for k in 0 to 1 generate
    apart_found(k)(0) <= or_reduce(apart_found_word_captured_second(k)(0) & apart_found_word_captured_first(k)(0));
  end generate apart_found_0_each;
  survive(0) <= survive_and_held(2)(0) and not apart_found(0)(0);
  survive(2) <= survive_and_held(2)(2) and not apart_found(1)(0);

  -- Clock 13
  apart_found_1_each : for k in 0 to 1 generate
    apart_found(k)(1) <= or_reduce(apart_found_word_captured_second(k)(1) & apart_found_word_captured_first(k)(1));
  end generate apart_found_1_each;
  survive(1) <= survive1_and_h13 and not apart_found(0)(1);
  survive(3) <= survive3_and_h13 and not apart_found(1)(1);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_0 = '1' then
        d_lane_m_select_at_0 <= to_unsigned(d_lane_m_select_at_0_table(to_integer(known(phase))), 2);
      end if;
      if holds(0) = '1' then
        b_chosen0_select_at_1 <= to_unsigned(b_chosen0_select_at_1_table(to_integer(known(phase))), 2);
      end if;
      if busy_6 = '1' then
        axis_bound_operand_select_at_2 <= axis_bound_operand_select_at_2_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that are loaded once per pair
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        b_origin_h1 <= b_origin;
        survive1_and_h13 <= survive_and_held(2)(1);
        survive3_and_h13 <= survive_and_held(2)(3);
      end if;
      for k in 0 to 2 loop
        if strobe((k + 3) mod 4) = '1' then
          d(k) <= d_lane;
        end if;
      end loop;
      if strobe(3) = '1' then
        for i in 0 to 2 loop
          query_error_resized_h4(i) <= signed(resize(query_error(i), 26));
        end loop;
        b_code1_h4 <= b_code(1);
        axis_bound_x1_h2 <= axis_bound(0)(1);
        axis_bound_y_h2 <= axis_bound(1);
        b_exponent_h4 <= b_exponent;
        a_code_h4 <= a_code;
        for k in 0 to 1 loop
          a_code0_h8(k) <= a_code_h4(k)(0);
          a_code2_h8(k) <= a_code_h4(k)(2);
          a_code4_h8(k) <= a_code_h4(k)(4);
          a_code6_h8(k) <= a_code_h4(k)(6);
          a_code8_h8(k) <= a_code_h4(k)(8);
          a_code10_h8(k) <= a_code_h4(k)(10);
          a_code12_h8(k) <= a_code_h4(k)(12);
          a_code14_h8(k) <= a_code_h4(k)(14);
          a_code16_h8(k) <= a_code_h4(k)(16);
        end loop;
        a_exponent_h4 <= a_exponent;
        survive_and_held(0)(0) <= a_take(0) and b_take(0);
        survive_and_held(0)(1) <= a_take(0) and b_take(1);
        survive_and_held(0)(2) <= a_take(1) and b_take(0);
        survive_and_held(0)(3) <= a_take(1) and b_take(1);
        survive_and_held(1 to 2) <= survive_and_held(0 to 1);
      end if;
      if strobe(1) = '1' then
        query_error_resized_h6 <= query_error_resized_h4;
      end if;
      for k in 0 to 8 loop
        if strobe(2) = '1' then
          query_row_held(k).choice <= query_row(k).choice;
        end if;
        if strobe(3) = '1' then
          query_row_held(k).factor <= query_row(k).factor;
          query_row_held(k).rest <= query_row(k).rest;
        end if;
      end loop;
      if strobe(2) = '1' then
        ceiling_h3 <= to_unsigned(ceiling_table(to_integer(known(b_exponent))), 11);
        b_exponent_h7 <= b_exponent_h4;
        a_exponent_h7 <= a_exponent_h4;
      end if;
      for k in 0 to 1 loop
        for m in 0 to 1 loop
          if strobe(m + 1) = '1' then
            apart_found_word_captured_first(k)(m) <= apart_in_phase(k);
          end if;
          if strobe((m + 3) mod 4) = '1' then
            apart_found_word_captured_second(k)(m) <= apart_in_phase(k);
          end if;
        end loop;
      end loop;
      if in_phase_0 = '1' then
        busy_6 <= holds(1);
      end if;
    end if;
  end process captures;
end architecture rtl;
