-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 4: the points at working width, and the edges.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_points is
  port (
    clk                : in  std_logic;
    phase              : in  unsigned(3 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds              : in  std_logic_vector(5 downto 0);  -- whether the slot k slots ago holds a pair
    in_v               : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    row                : in  interval_32_t;  -- s4.28; |.| <= 1879048192
    strobe             : in  std_logic_vector(10 downto 0);  -- one flag per phase
    axis0_has_b2_at_2  : in  std_logic;
    in_phase_8         : in  std_logic;
    busy_12            : in  std_logic;  -- set in clocks 11 to 21 of a pair
    in_v0_outside      : out std_logic_vector(2 downto 0);
    lane_input_outside : out std_logic_vector(2 downto 0);
    v                  : out interval_18_vector_x2_t;  -- s2.16; |.| <= 65536
    v_case             : out unsigned_2_vector_x2_t;
    w                  : out interval_18_vector_x2_t := zero_interval_18_vector_x2;  -- s2.16; |.| <= 65536
    w_case             : out unsigned_2_vector_x2_t := zero_unsigned_2_vector_x2;
    lane_edge          : out interval_18_vector_t;  -- |.| <= 65537
    lane_edge_case     : out unsigned_2_vector_t;
    scaled_d8          : out interval_18_vector_t;  -- |.| <= 65536
    scaled_case_d6     : out unsigned_2_vector_t;
    scaled_d9          : out interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65536
    scaled_case_d7     : out unsigned_2_vector_t := zero_unsigned_2_vector
  );
end entity pair_points;

architecture rtl of pair_points is
  constant lane_input_select_at_10_table : numbers_t(0 to 15) := (2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, others => 0);
  constant lane_operand_select_tap_at_1_2_table : numbers_t(0 to 15) := (11, 12, 13, 14, 4, 2, 0, 7, 8, 9, 10, others => 0);
  constant lane_operand_select_tap_at_1_1_table : numbers_t(0 to 15) := (12, 13, 14, 15, 5, 3, 1, 8, 9, 10, 11, others => 0);
  constant lane_from_input_at_1_table : std_logic_vector(0 to 15) := "11110000111" & "00000";
  constant lane_edge_rounding_at_5_table : std_logic_vector(0 to 15) := "00000101000" & "00000";
  signal in_v0_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal in_v0_inside_h9 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal in_v_h11 : signed_32_vector_1_to_2_t := zero_signed_32_vector_1_to_2;  -- s4.28; |.| <= 2147483648
  signal lane_input : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal lane_input_select_at_10 : unsigned(1 downto 0) := (others => '0');
  signal lane_input_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal lane_input_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
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
  signal lane_difference : interval_19_19_vector_t;  -- |.| <= 131072
  signal lane_difference_d1 : interval_19_19_vector_t := zero_interval_19_19_vector;  -- |.| <= 131072
  signal lane_edge_rounding_at_5 : std_logic := '0';
  signal lane_edge_i : interval_18_vector_t;  -- |.| <= 65537
  signal lane_edge_hi_second_up_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 65537
  type scaled_d8_line_t is array (1 to 6) of interval_18_vector_t;
  signal scaled_d8_line : scaled_d8_line_t := (others => zero_interval_18_vector);  -- |.| <= 65536
  type scaled_case_d6_line_t is array (1 to 6) of unsigned_2_vector_t;
  signal scaled_case_d6_line : scaled_case_d6_line_t := (others => zero_unsigned_2_vector);
  signal busy_10 : std_logic := '0';  -- set in clocks 9 to 19 of a pair
  signal in_phase_3 : std_logic;
  signal busy_27 : std_logic := '0';  -- set in clocks 26 to 36 of a pair
  signal lane_lo_operand_line_x : signed_32_vector_t;
  signal lane_lo_operand_line_tap : unsigned_4_vector_t;
  signal lane_hi_operand_line_x : signed_32_vector_t;
  signal lane_hi_operand_line_tap : unsigned_4_vector_t;
  signal offset_unit_origin : signed_32_vector_t;
begin
  -- Flags of phases and pairs
  v0_lo_each : for i in 0 to 2 generate
    v0_lo(i) <= to_signed(0, 18);
    v0_case(i) <= to_unsigned(0, 2);
  end generate v0_lo_each;
  in_phase_3 <= flag(known(phase) = 3);

  -- Clock 0
  in_v0_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => in_v(0)(k), passed => in_v0_inside(k), outside => in_v0_outside(k));
  end generate in_v0_inside_unit;

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
  lane_edge_i_lo_each : for i in 0 to 2 generate
    lane_edge_i(i).lo <= lane_difference_d1(i).lo(17 downto 0) when lane_edge_rounding_at_5 = '1' else
        lane_difference_d1(i).lo(18 downto 1);
    lane_edge_i(i).hi <= lane_difference_d1(i).hi(17 downto 0) when lane_edge_rounding_at_5 = '1' else
        lane_edge_hi_second_up_d1(i)(17 downto 0);
  end generate lane_edge_i_lo_each;
  scaled_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => scaled_d2(i), number => scaled_case(i));
  end generate scaled_case_unit;
  lane_edge_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => lane_edge_i(i), number => lane_edge_case(i));
  end generate lane_edge_case_unit;

  -- Clock 34
  clock_34 : process (clk)
  begin
    if rising_edge(clk) then
      scaled_d9 <= scaled_d8_line(6);
      scaled_case_d7 <= scaled_case_d6_line(6);
    end if;
  end process clock_34;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_10 = '1' then
        lane_input_select_at_10 <= to_unsigned(lane_input_select_at_10_table(to_integer(known(phase))), 2);
      end if;
      if busy_12 = '1' then
        lane_operand_select_tap_at_1(1) <= to_unsigned(lane_operand_select_tap_at_1_1_table(to_integer(known(phase))),
            4);
        lane_operand_select_tap_at_1(2) <= to_unsigned(lane_operand_select_tap_at_1_2_table(to_integer(known(phase))),
            4);
        lane_from_input_at_1 <= lane_from_input_at_1_table(to_integer(known(phase)));
      end if;
      if busy_27 = '1' then
        lane_edge_rounding_at_5 <= lane_edge_rounding_at_5_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(9) = '1' then
        in_v0_inside_h9 <= in_v0_inside;
        magnitudes <= magnitude_so_far;
      end if;
      if strobe(10) = '1' then
        for k in 1 to 2 loop
          in_v_h11(k) <= in_v(k);
        end loop;
      end if;
      if strobe(0) = '1' then
        in_v0_inside_h11 <= in_v0_inside;
      end if;
      if strobe(1) = '1' then
        in_v0_inside_h12 <= in_v0_inside_h11;
      end if;
      if strobe(3) = '1' then
        for i in 0 to 2 loop
          v0_hi(i) <= scaled(i).hi;
        end loop;
      end if;
      if strobe(4) = '1' then
        v1 <= scaled;
      end if;
      if strobe(6) = '1' then
        v1_case <= scaled_case;
      end if;
      if in_phase_8 = '1' then
        busy_10 <= holds(0);
      end if;
      if in_phase_3 = '1' then
        busy_27 <= holds(2);
      end if;
      for k in 0 to 1 loop
        if strobe(k + 7) = '1' then
          w(k) <= scaled;
        end if;
        if strobe(k + 9) = '1' then
          w_case(k) <= scaled_case;
        end if;
      end loop;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      offset_line <= offset_d1 & offset_line(1 to 9);
      scaled_d8_line <= scaled_d2 & scaled_d8_line(1 to 5);
      scaled_case_d6_line <= scaled_case & scaled_case_d6_line(1 to 5);
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
    end if;
  end process state;

  -- Outputs
  v_0_lo_each : for i in 0 to 2 generate
    v(0)(i).lo <= v0_lo(i);
    v(0)(i).hi <= v0_hi(i);
  end generate v_0_lo_each;
  v(1) <= v1;
  v_case(0) <= v0_case;
  v_case(1) <= v1_case;
  lane_edge <= lane_edge_i;
  scaled_d8 <= scaled_d8_line(6);
  scaled_case_d6 <= scaled_case_d6_line(6);
end architecture rtl;
