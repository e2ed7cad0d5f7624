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
    row_m_select_at_0 : in  unsigned(1 downto 0);
    difference_w0     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2     : in  signed_33_vector_t;  -- |.| <= 2147483644
    busy_25           : in  std_logic;  -- set in clocks 24 to 26 of a pair
    in_phase_1        : in  std_logic;
    busy_12           : in  std_logic;  -- set in clocks 11 to 13 of a pair
    busy_26           : in  std_logic;  -- set in clocks 25 to 27 of a pair
    lane1_select_at_0 : out std_logic;
    coordinate_v1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2     : out signed_18_vector_t;  -- |.| <= 131071
    level             : out unsigned(2 downto 0);
    lane1_select_at_1 : out std_logic := '0';
    lane1_select_at_2 : out std_logic := '0';
    level_h2_d1       : out unsigned(2 downto 0);
    level_h2_d4       : out unsigned(2 downto 0)
  );
end entity pair_coordinates;

architecture rtl of pair_coordinates is
  constant lane1_select_at_0_i_table : std_logic_vector(0 to 3) := "100" & "0";
  constant axis_level_0_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_1_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_2_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant lane1_select_at_1_table : std_logic_vector(0 to 3) := "010" & "0";
  constant lane1_select_at_2_table : std_logic_vector(0 to 3) := "001" & "0";
  signal difference_v1_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 536870912; from clocks 4, 7, 10 on
  signal difference_v2_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 536870912; from clocks 4, 7, 10 on
  signal shift : flag_x4_vector_t;
  signal difference_w0_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal difference_w2_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane : signed_33_vector_x2_t;  -- |.| <= 2147483644
  signal shift_held : flag_x4_vector_x2_t := zero_flag_x4_vector_x2;  -- from clocks 13, 16 on
  signal lane_d1 : signed_33_vector_x2_t := zero_signed_33_vector_x2;  -- |.| <= 2147483644
  signal lane_shifted : signed_19_vector_x2_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal difference_w1_h3 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane1_select_at_0_i : std_logic := '0';
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_held : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144; from clock 17 on
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
  signal level_less_resized_first_h3 : signed(3 downto 0) := (others => '0');  -- |.| <= 6
  signal level_less_resized_second_h3 : signed(3 downto 0) := (others => '0');  -- |.| <= 6
  signal level_less_h3 : std_logic := '0';
  signal axis_level0_resized_less_choice_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 20, 23 on
  signal axis_level2_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 20, 23 on
  signal level_i : unsigned(2 downto 0);
  signal level_h2 : unsigned(2 downto 0) := (others => '0');
  signal level_h2_d1_i : unsigned(2 downto 0) := (others => '0');
  type level_h2_d4_line_t is array (1 to 3) of unsigned(2 downto 0);
  signal level_h2_d4_line : level_h2_d4_line_t := (others => (others => '0'));
  signal busy_24 : std_logic := '0';  -- set in clocks 23 to 25 of a pair
  signal busy_12_to_24 : std_logic;  -- a pair comes to clock 12, 24 or is in it
  signal busy_28 : std_logic := '0';  -- set in clocks 27 to 29 of a pair
  signal busy_25_to_28 : std_logic;  -- a pair comes to clock 25, 28 or is in it
  signal shift_unit_x : signed_33_x5_vector_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
begin
  -- Flags of phases and pairs
  busy_12_to_24 <= busy_12 or busy_24;
  busy_25_to_28 <= busy_25 or busy_28;

  -- Clock 10
  shift_unit_x_0_each : for i in 0 to 2 generate
    shift_unit_x(i)(0) <= difference_v1_held(2)(i);
    shift_unit_x(i)(1) <= difference_v2_held(2)(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate shift_unit_x_0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 12
  lane(0) <=
    difference_v1_held(2) when known(row_m_select_at_0) = 0 else
    difference_w0_h3 when known(row_m_select_at_0) = 1 else
    difference_w2_h3;
  lane(1) <= difference_w1_h3 when lane1_select_at_0_i = '1' else difference_v2_held(2);

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      lane_d1 <= lane;
    end if;
  end process clock_13;
  lane_shifted_unit : for k in 0 to 1 generate
    unit : entity work.coordinate_scale
      port map (x => lane_d1(k), shift => shift_held(0), cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 16
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

  -- Clock 17
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

  -- Clock 19
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h5(0), carried => carried_h3, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h5(1), carried => carried_h3, y => coordinate_v2);

  -- Clock 23
  level_i <= axis_level2_held(1) when level_less_h3 = '1' else axis_level0_resized_less_choice_held(1);

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      level_h2_d1_i <= level_h2;
    end if;
  end process clock_26;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_12_to_24 = '1' then
        lane1_select_at_0_i <= lane1_select_at_0_i_table(to_integer(known(phase)));
      end if;
      if busy_25_to_28 = '1' then
        lane1_select_at_1 <= lane1_select_at_1_table(to_integer(known(phase)));
      end if;
      if busy_26 = '1' then
        lane1_select_at_2 <= lane1_select_at_2_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        difference_v1_held <= difference_v1 & difference_v1_held(0 to 1);
        difference_v2_held <= difference_v2 & difference_v2_held(0 to 1);
        difference_w2_h3 <= difference_w2;
        shift_held(0) <= shift;
        shift_held(1) <= shift_held(0);
        coordinate_cut(4) <= lane_shifted(0);
        for k in 0 to 1 loop
          coordinate_cut_h5(k) <= coordinate_cut_held(k);
        end loop;
        carried_h3 <= carried_h1;
        level_h2 <= level_i;
      end if;
      if strobe(1) = '1' then
        difference_w0_h3 <= difference_w0;
        coordinate_cut(0) <= lane_shifted(0);
        coordinate_cut(1) <= lane_shifted(1);
        coordinate_cut_held <= coordinate_cut;
        carried_h1 <= carried;
        taken_x_h1 <= taken_x;
        taken_y_h1 <= taken_y;
        taken_z_h1 <= taken_z;
        level_less_resized_first_h3 <= signed(resize(axis_level0_resized_less_choice, 4));
        level_less_resized_second_h3 <= signed(resize(axis_level(2), 4));
        level_less_h3 <= less(level_less_resized_first_h3, level_less_resized_second_h3);
        axis_level0_resized_less_choice_held(0) <= axis_level0_resized_less_choice;
        axis_level0_resized_less_choice_held(1) <= axis_level0_resized_less_choice_held(0);
        axis_level2_held(0) <= axis_level(2);
        axis_level2_held(1) <= axis_level2_held(0);
      end if;
      if strobe(2) = '1' then
        coordinate_cut(2) <= lane_shifted(0);
        coordinate_cut(3) <= lane_shifted(1);
        difference_w1_h3 <= difference_w1;
      end if;
      if in_phase_1 = '1' then
        busy_24 <= holds(7);
      end if;
      if in_phase_2 = '1' then
        busy_28 <= holds(8);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      level_h2_d4_line <= level_h2_d1_i & level_h2_d4_line(1 to 2);
    end if;
  end process delays;

  -- Outputs
  lane1_select_at_0 <= lane1_select_at_0_i;
  level <= level_i;
  level_h2_d1 <= level_h2_d1_i;
  level_h2_d4 <= level_h2_d4_line(3);
end architecture rtl;
