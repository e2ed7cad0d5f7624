-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 3: coordinates of working width, scaled along each axis by itself.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_coordinates is
  port (
    clk               : in  std_logic;
    phase             : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds             : in  std_logic_vector(13 downto 0);  -- whether the slot k slots ago holds a pair
    difference_v1     : in  signed_33_vector_t;  -- |.| <= 536870912
    difference_v2     : in  signed_33_vector_t;  -- |.| <= 536870912
    in_phase_2        : in  std_logic;
    strobe            : in  std_logic_vector(2 downto 0);  -- one flag per phase
    difference_w0     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2     : in  signed_33_vector_t;  -- |.| <= 2147483644
    row_m_select_at_1 : in  unsigned(1 downto 0);
    in_phase_0        : in  std_logic;
    busy_26           : in  std_logic;  -- set in clocks 25 to 27 of a pair
    busy_27           : in  std_logic;  -- set in clocks 26 to 28 of a pair
    busy_13           : in  std_logic;  -- set in clocks 12 to 14 of a pair
    lane1_select_at_1 : out std_logic;
    coordinate_v1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2     : out signed_18_vector_t;  -- |.| <= 131071
    level             : out unsigned(2 downto 0);
    lane1_select_at_2 : out std_logic := '0';
    lane1_select_at_0 : out std_logic := '0';
    level_h4_d1       : out unsigned(2 downto 0);
    level_h4_d4       : out unsigned(2 downto 0)
  );
end entity pair_coordinates;

architecture rtl of pair_coordinates is
  constant lane1_select_at_1_i_table : std_logic_vector(0 to 3) := "010" & "0";
  constant axis_level_0_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_1_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_2_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant lane1_select_at_2_table : std_logic_vector(0 to 3) := "001" & "0";
  constant lane1_select_at_0_table : std_logic_vector(0 to 3) := "100" & "0";
  signal difference_v1_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 536870912; from clocks 4, 7, 10 on
  signal difference_v1_h10 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 536870912
  signal difference_v2_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 536870912; from clocks 4, 7, 10 on
  signal difference_v2_h10 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 536870912
  signal shift : flag_x4_vector_t;
  signal difference_w0_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal difference_w2_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane : signed_33_vector_x2_t;  -- |.| <= 2147483644
  signal shift_held : flag_x4_vector_x2_t := zero_flag_x4_vector_x2;  -- from clocks 14, 17 on
  signal lane_d1 : signed_33_vector_x2_t := zero_signed_33_vector_x2;  -- |.| <= 2147483644
  signal lane_shifted : signed_19_vector_x2_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal difference_w1_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane1_select_at_1_i : std_logic := '0';
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_held : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144; from clock 18 on
  signal coordinate_cut_h5 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 262144
  signal carried_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal carried_h3 : std_logic_vector(2 downto 0) := (others => '0');
  signal taken_x : unsigned(4 downto 0);
  signal taken_x_h1 : unsigned(4 downto 0) := (others => '0');
  signal axis_level : unsigned_3_x3_t;
  signal taken_y : unsigned(4 downto 0);
  signal taken_y_h1 : unsigned(4 downto 0) := (others => '0');
  signal taken_z : unsigned(4 downto 0);
  signal taken_z_h1 : unsigned(4 downto 0) := (others => '0');
  signal axis_level0_resized_less_choice : unsigned(2 downto 0);
  signal level_less_resized_first_h1 : signed(3 downto 0) := (others => '0');  -- |.| <= 6
  signal level_less_resized_second_h1 : signed(3 downto 0) := (others => '0');  -- |.| <= 6
  signal level_less_h3 : std_logic := '0';
  signal axis_level0_resized_less_choice_h3 : unsigned(2 downto 0) := (others => '0');
  signal axis_level0_resized_less_choice_h4 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_h3 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_h4 : unsigned(2 downto 0) := (others => '0');
  signal level_i : unsigned(2 downto 0);
  signal level_h3 : unsigned(2 downto 0) := (others => '0');
  signal level_h4 : unsigned(2 downto 0) := (others => '0');
  signal level_h4_d1_i : unsigned(2 downto 0) := (others => '0');
  type level_h4_d4_line_t is array (1 to 3) of unsigned(2 downto 0);
  signal level_h4_d4_line : level_h4_d4_line_t := (others => (others => '0'));
  signal busy_25 : std_logic := '0';  -- set in clocks 24 to 26 of a pair
  signal busy_13_to_25 : std_logic;  -- a pair comes to clock 13, 25 or is in it
  signal busy_29 : std_logic := '0';  -- set in clocks 28 to 30 of a pair
  signal busy_26_to_29 : std_logic;  -- a pair comes to clock 26, 29 or is in it
  signal shift_unit_x : signed_33_x5_vector_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
begin
  -- Flags of phases and pairs
  busy_13_to_25 <= busy_13 or busy_25;
  busy_26_to_29 <= busy_26 or busy_29;

  -- Clock 11
  shift_unit_x_0_each : for i in 0 to 2 generate
    shift_unit_x(i)(0) <= difference_v1_h10(i);
    shift_unit_x(i)(1) <= difference_v2_h10(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate shift_unit_x_0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 13
  lane(0) <=
    difference_v1_h10 when known(row_m_select_at_1) = 0 else
    difference_w0_h3 when known(row_m_select_at_1) = 1 else
    difference_w2_h3;
  lane(1) <= difference_w1_h3 when lane1_select_at_1_i = '1' else difference_v2_h10;

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      lane_d1 <= lane;
    end if;
  end process clock_14;
  lane_shifted_unit : for k in 0 to 1 generate
    unit : entity work.coordinate_scale
      port map (x => lane_d1(k), shift => shift_held(0), cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 17
  taken_x <= carried(0) & unsigned(shift_held(1)(0));
  taken_y <= carried(1) & unsigned(shift_held(1)(1));
  taken_z <= carried(2) & unsigned(shift_held(1)(2));
  carried_unit_cut_each_of : for i in 0 to 2 generate
    carried_unit_cut_each : for k in 0 to 4 generate
      carried_unit_cut(i)(k) <= coordinate_cut(k)(i);
    end generate carried_unit_cut_each;
  end generate carried_unit_cut_each_of;
  carried_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_carry
      port map (cut => carried_unit_cut(i), carried => carried(i));
  end generate carried_unit;

  -- Clock 18
  axis_level(0) <= to_unsigned(axis_level_0_table(to_integer(known(taken_x_h1))), 3);
  axis_level(1) <= to_unsigned(axis_level_1_table(to_integer(known(taken_y_h1))), 3);
  axis_level(2) <= to_unsigned(axis_level_2_table(to_integer(known(taken_z_h1))), 3);
  axis_level0_resized_less_choice <= axis_level(1) when
      less(signed(resize(axis_level(0), 4)), signed(resize(axis_level(1), 4))) = '1' else axis_level(0);
  coordinate_w0_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(2), carried => carried_h1, y => coordinate_w0);
  coordinate_w1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(3), carried => carried_h1, y => coordinate_w1);
  coordinate_w2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(4), carried => carried_h1, y => coordinate_w2);

  -- Clock 20
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h5(0), carried => carried_h3, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h5(1), carried => carried_h3, y => coordinate_v2);

  -- Clock 22
  level_i <= axis_level2_h4 when level_less_h3 = '1' else axis_level0_resized_less_choice_h4;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d1_i <= level_h4;
    end if;
  end process clock_27;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_13_to_25 = '1' then
        lane1_select_at_1_i <= lane1_select_at_1_i_table(to_integer(known(phase)));
      end if;
      if busy_26_to_29 = '1' then
        lane1_select_at_2 <= lane1_select_at_2_table(to_integer(known(phase)));
      end if;
      if busy_27 = '1' then
        lane1_select_at_0 <= lane1_select_at_0_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that are loaded once per pair
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        difference_v1_held <= difference_v1 & difference_v1_held(0 to 1);
        difference_v2_held <= difference_v2 & difference_v2_held(0 to 1);
        coordinate_cut(2) <= lane_shifted(0);
        coordinate_cut(3) <= lane_shifted(1);
        difference_w1_h3 <= difference_w1;
        level_less_resized_first_h1 <= signed(resize(axis_level0_resized_less_choice, 4));
        level_less_resized_second_h1 <= signed(resize(axis_level(2), 4));
        level_less_h3 <= less(level_less_resized_first_h1, level_less_resized_second_h1);
        axis_level0_resized_less_choice_h4 <= axis_level0_resized_less_choice_h3;
        axis_level2_h4 <= axis_level2_h3;
        level_h3 <= level_i;
      end if;
      if strobe(1) = '1' then
        difference_v1_h10 <= difference_v1_held(2);
        difference_v2_h10 <= difference_v2_held(2);
        difference_w2_h3 <= difference_w2;
        shift_held(0) <= shift;
        shift_held(1) <= shift_held(0);
        coordinate_cut(4) <= lane_shifted(0);
        for k in 0 to 1 loop
          coordinate_cut_h5(k) <= coordinate_cut_held(k);
        end loop;
        carried_h3 <= carried_h1;
        level_h4 <= level_h3;
      end if;
      if strobe(2) = '1' then
        difference_w0_h3 <= difference_w0;
        coordinate_cut(0) <= lane_shifted(0);
        coordinate_cut(1) <= lane_shifted(1);
        coordinate_cut_held <= coordinate_cut;
        carried_h1 <= carried;
        taken_x_h1 <= taken_x;
        taken_y_h1 <= taken_y;
        taken_z_h1 <= taken_z;
        axis_level0_resized_less_choice_h3 <= axis_level0_resized_less_choice;
        axis_level2_h3 <= axis_level(2);
      end if;
      if in_phase_2 = '1' then
        busy_25 <= holds(7);
      end if;
      if in_phase_0 = '1' then
        busy_29 <= holds(9);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d4_line <= level_h4_d1_i & level_h4_d4_line(1 to 2);
    end if;
  end process delays;

  -- Outputs
  lane1_select_at_1 <= lane1_select_at_1_i;
  level <= level_i;
  level_h4_d1 <= level_h4_d1_i;
  level_h4_d4 <= level_h4_d4_line(3);
end architecture rtl;
