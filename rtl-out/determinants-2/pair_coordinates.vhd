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
    difference_v1     : in  signed_33_vector_t;  -- |.| <= 536870912
    difference_v2     : in  signed_33_vector_t;  -- |.| <= 536870912
    strobe            : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_1 : in  std_logic;
    difference_w0     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1     : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2     : in  signed_33_vector_t;  -- |.| <= 2147483644
    coordinate_v1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1     : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2     : out signed_18_vector_t;  -- |.| <= 131071
    level             : out unsigned(2 downto 0);
    level_h4_d1       : out unsigned(2 downto 0);
    level_h4_d3       : out unsigned(2 downto 0) := (others => '0')
  );
end entity pair_coordinates;

architecture rtl of pair_coordinates is
  constant axis_level_0_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_1_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_2_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  signal difference_v1_held : signed_33_vector_x5_t := zero_signed_33_vector_x5;  -- |.| <= 536870912; from clocks 3, 5, ... 11 on
  signal difference_v2_held : signed_33_vector_x5_t := zero_signed_33_vector_x5;  -- |.| <= 536870912; from clocks 3, 5, ... 11 on
  signal shift : flag_x4_vector_t;
  signal difference_w1_h2 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane : signed_33_vector_x2_t;  -- |.| <= 2147483644
  signal shift_held : flag_x4_vector_x2_t := zero_flag_x4_vector_x2;  -- from clocks 12, 14 on
  signal lane_d1 : signed_33_vector_x2_t := zero_signed_33_vector_x2;  -- |.| <= 2147483644
  signal lane_shifted : signed_19_vector_x3_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal difference_w2_x_held : signed_33_x2_t := zero_signed_33_x2;  -- |.| <= 2147483644; from clocks 10, 12 on
  signal difference_w2_z_held : signed_33_x2_t := zero_signed_33_x2;  -- |.| <= 2147483644; from clocks 10, 12 on
  signal difference_w2_y_h2 : signed(32 downto 0) := (others => '0');  -- |.| <= 2147483644
  signal difference_w0_h2 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal difference_w0_h2_d1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_held : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144; from clock 15 on
  signal coordinate_cut_h3 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 262144
  signal carried_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal carried_h2 : std_logic_vector(2 downto 0) := (others => '0');
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
  signal level_less_held : std_logic_vector(1 downto 0) := (others => '0');  -- from clocks 18, 20 on
  signal axis_level0_resized_less_choice_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 17, 19 on
  signal axis_level0_resized_less_choice_h5 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 17, 19 on
  signal axis_level2_h5 : unsigned(2 downto 0) := (others => '0');
  signal level_i : unsigned(2 downto 0);
  signal level_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 22, 24 on
  signal level_h4_d1_i : unsigned(2 downto 0) := (others => '0');
  signal level_h4_d2 : unsigned(2 downto 0) := (others => '0');
  signal shift_unit_x : signed_33_x5_vector_t;
  signal lane_shifted_unit_x : signed_33_vector_x3_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
begin
  -- Clock 9
  shift_unit_x_0_each : for i in 0 to 2 generate
    shift_unit_x(i)(0) <= difference_v1_held(3)(i);
    shift_unit_x(i)(1) <= difference_v2_held(3)(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate shift_unit_x_0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 11
  lane(0) <= difference_w1_h2 when row_m_select_at_1 = '1' else difference_v1_held(4);
  lane(1)(0) <= difference_w2_x_held(1) when row_m_select_at_1 = '1' else difference_v2_held(4)(0);
  lane(1)(1) <= difference_w2_y_h2 when row_m_select_at_1 = '1' else difference_v2_held(4)(1);
  lane(1)(2) <= difference_w2_z_held(1) when row_m_select_at_1 = '1' else difference_v2_held(4)(2);

  -- Clock 12
  clock_12 : process (clk)
  begin
    if rising_edge(clk) then
      lane_d1 <= lane;
      difference_w0_h2_d1 <= difference_w0_h2;
    end if;
  end process clock_12;
  lane_shifted_unit_x(0) <= lane_d1(0);
  lane_shifted_unit_x(1) <= lane_d1(1);
  lane_shifted_unit_x(2) <= difference_w0_h2_d1;
  lane_shifted_unit : for k in 0 to 2 generate
    unit : entity work.coordinate_scale
      port map (x => lane_shifted_unit_x(k), shift => shift_held(0), cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 14
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

  -- Clock 15
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

  -- Clock 16
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h3(0), carried => carried_h2, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h3(1), carried => carried_h2, y => coordinate_v2);

  -- Clock 20
  level_i <= axis_level2_h5 when level_less_held(1) = '1' else axis_level0_resized_less_choice_h5;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d1_i <= level_held(1);
    end if;
  end process clock_25;

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d2 <= level_h4_d1_i;
    end if;
  end process clock_26;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d3 <= level_h4_d2;
    end if;
  end process clock_27;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        difference_v1_held <= difference_v1 & difference_v1_held(0 to 3);
        difference_v2_held <= difference_v2 & difference_v2_held(0 to 3);
        difference_w1_h2 <= difference_w1;
        coordinate_cut(0) <= lane_shifted(0);
        coordinate_cut(1) <= lane_shifted(1);
        coordinate_cut(2) <= lane_shifted(2);
        difference_w2_y_h2 <= difference_w2(1);
        coordinate_cut_held <= coordinate_cut;
        carried_h1 <= carried;
        taken_x_h1 <= taken_x;
        taken_y_h1 <= taken_y;
        taken_z_h1 <= taken_z;
        axis_level0_resized_less_choice_held(0) <= axis_level0_resized_less_choice;
        axis_level0_resized_less_choice_held(1) <= axis_level0_resized_less_choice_held(0);
        axis_level2_held(0) <= axis_level(2);
        axis_level2_held(1) <= axis_level2_held(0);
      end if;
      if strobe(1) = '1' then
        shift_held(0) <= shift;
        shift_held(1) <= shift_held(0);
        coordinate_cut(3) <= lane_shifted(0);
        coordinate_cut(4) <= lane_shifted(1);
        difference_w2_x_held(0) <= difference_w2(0);
        difference_w2_x_held(1) <= difference_w2_x_held(0);
        difference_w2_z_held(0) <= difference_w2(2);
        difference_w2_z_held(1) <= difference_w2_z_held(0);
        difference_w0_h2 <= difference_w0;
        for k in 0 to 1 loop
          coordinate_cut_h3(k) <= coordinate_cut_held(k);
        end loop;
        carried_h2 <= carried_h1;
        level_less_resized_first_h1 <= signed(resize(axis_level0_resized_less_choice, 4));
        level_less_resized_second_h1 <= signed(resize(axis_level(2), 4));
        level_less_held(0) <= less(level_less_resized_first_h1, level_less_resized_second_h1);
        level_less_held(1) <= level_less_held(0);
        axis_level0_resized_less_choice_h5 <= axis_level0_resized_less_choice_held(1);
        axis_level2_h5 <= axis_level2_held(1);
        level_held(0) <= level_i;
        level_held(1) <= level_held(0);
      end if;
    end if;
  end process captures;

  -- Outputs
  level <= level_i;
  level_h4_d1 <= level_h4_d1_i;
end architecture rtl;
