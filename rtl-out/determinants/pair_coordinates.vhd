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
    clk           : in  std_logic;
    difference_v1 : in  signed_33_vector_t;  -- |.| <= 536870912
    difference_v2 : in  signed_33_vector_t;  -- |.| <= 536870912
    difference_w0 : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1 : in  signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2 : in  signed_33_vector_t;  -- |.| <= 2147483644
    coordinate_v1 : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2 : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0 : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1 : out signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2 : out signed_18_vector_t;  -- |.| <= 131071
    level         : out unsigned(2 downto 0);
    level_h3      : out unsigned(2 downto 0);
    level_d5      : out unsigned(2 downto 0);
    level_d7      : out unsigned(2 downto 0) := (others => '0')
  );
end entity pair_coordinates;

architecture rtl of pair_coordinates is
  constant axis_level_0_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_1_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_2_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  type difference_v1_line_t is array (1 to 7) of signed_33_vector_t;
  signal difference_v1_line : difference_v1_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  type difference_v2_line_t is array (1 to 7) of signed_33_vector_t;
  signal difference_v2_line : difference_v2_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  signal shift : flag_x4_vector_t;
  type difference_v1_d10_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_v1_d10_line : difference_v1_d10_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  signal shift_d1 : flag_x4_vector_t := zero_flag_x4_vector;
  signal lane_shifted : signed_19_vector_x5_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  type difference_v2_d10_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_v2_d10_line : difference_v2_d10_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  type difference_w0_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w0_line : difference_w0_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  type difference_w1_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w1_line : difference_w1_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  type difference_w2_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w2_line : difference_w2_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_h1 : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal carried_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal shift_h2 : flag_x4_vector_t := zero_flag_x4_vector;
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
  signal axis_level0_resized_less_choice_h1 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_h1 : unsigned(2 downto 0) := (others => '0');
  signal level_i : unsigned(2 downto 0);
  type level_h3_line_t is array (1 to 3) of unsigned(2 downto 0);
  signal level_h3_line : level_h3_line_t := (others => (others => '0'));
  signal level_d4 : unsigned(2 downto 0) := (others => '0');
  signal level_d5_i : unsigned(2 downto 0) := (others => '0');
  signal level_d6 : unsigned(2 downto 0) := (others => '0');
  signal shift_unit_x : signed_33_x5_vector_t;
  signal lane_shifted_unit_x : signed_33_vector_x5_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
begin
  -- Clock 8
  shift_unit_x_0_each : for i in 0 to 2 generate
    shift_unit_x(i)(0) <= difference_v1_line(7)(i);
    shift_unit_x(i)(1) <= difference_v2_line(7)(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate shift_unit_x_0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 11
  clock_11 : process (clk)
  begin
    if rising_edge(clk) then
      shift_d1 <= shift;
    end if;
  end process clock_11;
  lane_shifted_unit_x(0) <= difference_v1_d10_line(3);
  lane_shifted_unit_x(1) <= difference_v2_d10_line(3);
  lane_shifted_unit_x(2) <= difference_w0_line(3);
  lane_shifted_unit_x(3) <= difference_w1_line(3);
  lane_shifted_unit_x(4) <= difference_w2_line(3);
  lane_shifted_unit : for k in 0 to 4 generate
    unit : entity work.coordinate_scale
      port map (x => lane_shifted_unit_x(k), shift => shift_d1, cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 12
  clock_12 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_cut <= lane_shifted;
      shift_h2 <= shift_d1;
    end if;
  end process clock_12;
  taken_x <= carried(0) & unsigned(shift_h2(0));
  taken_y <= carried(1) & unsigned(shift_h2(1));
  taken_z <= carried(2) & unsigned(shift_h2(2));
  carried_unit_cut_each_of : for i in 0 to 2 generate
    carried_unit_cut_each : for k in 0 to 4 generate
      carried_unit_cut(i)(k) <= coordinate_cut(k)(i);
    end generate carried_unit_cut_each;
  end generate carried_unit_cut_each_of;
  carried_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_carry
      port map (cut => carried_unit_cut(i), carried => carried(i));
  end generate carried_unit;

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_cut_h1 <= coordinate_cut;
      carried_h1 <= carried;
      taken_x_h1 <= taken_x;
      taken_y_h1 <= taken_y;
      taken_z_h1 <= taken_z;
    end if;
  end process clock_13;
  axis_level(0) <= to_unsigned(axis_level_0_table(to_integer(known(taken_x_h1))), 3);
  axis_level(1) <= to_unsigned(axis_level_1_table(to_integer(known(taken_y_h1))), 3);
  axis_level(2) <= to_unsigned(axis_level_2_table(to_integer(known(taken_z_h1))), 3);
  axis_level0_resized_less_choice <= axis_level(1) when
      less(signed(resize(axis_level(0), 4)), signed(resize(axis_level(1), 4))) = '1' else axis_level(0);
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(0), carried => carried_h1, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(1), carried => carried_h1, y => coordinate_v2);
  coordinate_w0_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(2), carried => carried_h1, y => coordinate_w0);
  coordinate_w1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(3), carried => carried_h1, y => coordinate_w1);
  coordinate_w2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(4), carried => carried_h1, y => coordinate_w2);

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      level_less_resized_first_h1 <= signed(resize(axis_level0_resized_less_choice, 4));
      level_less_resized_second_h1 <= signed(resize(axis_level(2), 4));
      axis_level0_resized_less_choice_h1 <= axis_level0_resized_less_choice;
      axis_level2_h1 <= axis_level(2);
    end if;
  end process clock_14;
  level_i <= axis_level2_h1 when less(level_less_resized_first_h1, level_less_resized_second_h1) = '1' else
      axis_level0_resized_less_choice_h1;

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      level_d4 <= level_h3_line(3);
    end if;
  end process clock_18;

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      level_d5_i <= level_d4;
    end if;
  end process clock_19;

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      level_d6 <= level_d5_i;
    end if;
  end process clock_20;

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      level_d7 <= level_d6;
    end if;
  end process clock_21;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      difference_v1_line <= difference_v1 & difference_v1_line(1 to 6);
      difference_v2_line <= difference_v2 & difference_v2_line(1 to 6);
      difference_v1_d10_line <= difference_v1_line(7) & difference_v1_d10_line(1 to 2);
      difference_v2_d10_line <= difference_v2_line(7) & difference_v2_d10_line(1 to 2);
      difference_w0_line <= difference_w0 & difference_w0_line(1 to 2);
      difference_w1_line <= difference_w1 & difference_w1_line(1 to 2);
      difference_w2_line <= difference_w2 & difference_w2_line(1 to 2);
      level_h3_line <= level_i & level_h3_line(1 to 2);
    end if;
  end process delays;

  -- Outputs
  level <= level_i;
  level_h3 <= level_h3_line(3);
  level_d5 <= level_d5_i;
end architecture rtl;
