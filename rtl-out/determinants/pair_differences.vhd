-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 2: the points relative to V0, B's in A's frame.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_differences is
  port (
    clk                 : in  std_logic;
    in_v                : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w                : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m              : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t              : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass         : in  std_logic;
    in_v_outside        : out flag_x3_x3_t;
    in_w_outside        : out flag_x3_x3_t;
    difference_v1       : out signed_33_vector_t;  -- |.| <= 536870912
    difference_v2       : out signed_33_vector_t;  -- |.| <= 536870912
    pose_t_outside      : out std_logic_vector(2 downto 0);
    pose_m_used_outside : out std_logic_vector(2 downto 0);
    difference_w0       : out signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1       : out signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2       : out signed_33_vector_t  -- |.| <= 2147483644
  );
end entity pair_differences;

architecture rtl of pair_differences is
  signal in_v_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal in_w_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_t_inside_number_h1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 2147483648
  signal pose_t_inside : signed_32_x3_t;  -- |.| <= 1073741816
  signal in_v_inside0_h1 : signed_32_x3_t := zero_signed_32_x3;  -- |.| <= 268435456
  signal moved : signed_33_vector_t;  -- |.| <= 1342177272; t - V0, or - V0 with the bypass
  signal pose_m_used : std_logic;
  signal pose_m_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_m_outside : flag_x3_x3_t;
  signal pose_m_used_h1 : std_logic := '0';
  signal pose_m_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal in_w_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal row_turned : signed_32_x9_t;  -- |.| <= 805306372
  signal pose_bypass_line : std_logic_vector(1 to 6) := (others => '0');
  type in_w_inside_line_t is array (1 to 4) of signed_32_x3_x3_t;
  signal in_w_inside_line : in_w_inside_line_t := (others => zero_signed_32_x3_x3);  -- |.| <= 268435456
  signal row_choice_d1 : signed_32_x9_t := zero_signed_32_x9;  -- |.| <= 805306372
  type moved_line_t is array (1 to 5) of signed_33_vector_t;
  signal moved_line : moved_line_t := (others => zero_signed_33_vector);  -- |.| <= 1342177272
  signal row : signed_34_x9_t;  -- |.| <= 2147483644
  signal difference : signed_34_x9_t := zero_signed_34_x9;  -- |.| <= 2147483644
  signal row_turned_unit_m : signed_32_vector_x9_t;
  signal row_turned_unit_w : signed_32_vector_x9_t;
begin
  -- Clock 0
  pose_m_used <= not pose_bypass;
  in_v_inside_unit_of : for k in 0 to 2 generate
    in_v_inside_unit : for m in 0 to 2 generate
      unit : entity work.guard_coordinate
        port map (clk => clk, number => in_v(k)(m), passed => in_v_inside(k)(m), outside => in_v_outside(k)(m));
    end generate in_v_inside_unit;
  end generate in_v_inside_unit_of;
  in_w_inside_unit_of : for k in 0 to 2 generate
    in_w_inside_unit : for m in 0 to 2 generate
      unit : entity work.guard_coordinate
        port map (clk => clk, number => in_w(k)(m), passed => in_w_inside(k)(m), outside => in_w_outside(k)(m));
    end generate in_w_inside_unit;
  end generate in_w_inside_unit_of;
  pose_m_inside_unit_of : for k in 0 to 2 generate
    pose_m_inside_unit : for m in 0 to 2 generate
      unit : entity work.guard_coordinate
        port map (clk => clk, number => pose_m(k)(m), passed => pose_m_inside(k)(m), outside => pose_m_outside(k)(m));
    end generate pose_m_inside_unit;
  end generate pose_m_inside_unit_of;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 2 loop
        pose_t_inside_number_h1(k) <= choose(pose_bypass, to_signed(0, 32), pose_t(k));
      end loop;
      pose_m_used_h1 <= pose_m_used;
    end if;
  end process clock_1;
  difference_v1_each : for i in 0 to 2 generate
    difference_v1(i) <= resize(in_v_inside(1)(i), 33) - resize(in_v_inside(0)(i), 33);
    difference_v2(i) <= resize(in_v_inside(2)(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate difference_v1_each;
  pose_m_used_outside_each : for k in 0 to 2 generate
    pose_m_used_outside(k) <= or_reduce(unsigned(pose_m_outside(k))) and pose_m_used_h1;
  end generate pose_m_used_outside_each;
  pose_t_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_translation
      port map (clk => clk, number => pose_t_inside_number_h1(k), passed => pose_t_inside(k),
                outside => pose_t_outside(k));
  end generate pose_t_inside_unit;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      in_v_inside0_h1 <= in_v_inside(0);
      pose_m_inside_d1 <= pose_m_inside;
      in_w_inside_d1 <= in_w_inside;
    end if;
  end process clock_2;
  moved_each : for i in 0 to 2 generate
    moved(i) <= resize(pose_t_inside(i), 33) - resize(in_v_inside0_h1(i), 33);
  end generate moved_each;
  row_turned_unit_m_each_of : for k in 0 to 8 generate
    row_turned_unit_m_each : for i in 0 to 2 generate
      row_turned_unit_m(k)(i) <= pose_m_inside_d1(k mod 3)(i);
    end generate row_turned_unit_m_each;
  end generate row_turned_unit_m_each_of;
  row_turned_unit_w_each_of : for k in 0 to 2 generate
    row_turned_unit_w_each : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d1(0)(i);
    end generate row_turned_unit_w_each;
  end generate row_turned_unit_w_each_of;
  row_turned_unit_w_each_of_2 : for k in 3 to 5 generate
    row_turned_unit_w_each_2 : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d1(1)(i);
    end generate row_turned_unit_w_each_2;
  end generate row_turned_unit_w_each_of_2;
  row_turned_unit_w_each_of_3 : for k in 6 to 8 generate
    row_turned_unit_w_each_3 : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d1(2)(i);
    end generate row_turned_unit_w_each_3;
  end generate row_turned_unit_w_each_of_3;
  row_turned_unit : for k in 0 to 8 generate
    unit : entity work.difference_row
      port map (clk => clk, m => row_turned_unit_m(k), w => row_turned_unit_w(k), turned => row_turned(k));
  end generate row_turned_unit;

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      row_choice_d1(0) <= choose(pose_bypass_line(6), in_w_inside_line(4)(0)(0), row_turned(0));
      row_choice_d1(1) <= choose(pose_bypass_line(6), in_w_inside_line(4)(0)(1), row_turned(1));
      row_choice_d1(2) <= choose(pose_bypass_line(6), in_w_inside_line(4)(0)(2), row_turned(2));
      row_choice_d1(3) <= choose(pose_bypass_line(6), in_w_inside_line(4)(1)(0), row_turned(3));
      row_choice_d1(4) <= choose(pose_bypass_line(6), in_w_inside_line(4)(1)(1), row_turned(4));
      row_choice_d1(5) <= choose(pose_bypass_line(6), in_w_inside_line(4)(1)(2), row_turned(5));
      row_choice_d1(6) <= choose(pose_bypass_line(6), in_w_inside_line(4)(2)(0), row_turned(6));
      row_choice_d1(7) <= choose(pose_bypass_line(6), in_w_inside_line(4)(2)(1), row_turned(7));
      row_choice_d1(8) <= choose(pose_bypass_line(6), in_w_inside_line(4)(2)(2), row_turned(8));
    end if;
  end process clock_7;
  row_each : for k in 0 to 8 generate
    row(k) <= resize(row_choice_d1(k), 34) + resize(moved_line(5)(k mod 3), 34);
  end generate row_each;

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      difference <= row;
    end if;
  end process clock_8;
  difference_w0_each : for i in 0 to 2 generate
    difference_w0(i) <= difference(i)(32 downto 0);
    difference_w1(i) <= difference(i + 3)(32 downto 0);
    difference_w2(i) <= difference(i + 6)(32 downto 0);
  end generate difference_w0_each;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      pose_bypass_line <= pose_bypass & pose_bypass_line(1 to 5);
      in_w_inside_line <= in_w_inside_d1 & in_w_inside_line(1 to 3);
      moved_line <= moved & moved_line(1 to 4);
    end if;
  end process delays;
end architecture rtl;
