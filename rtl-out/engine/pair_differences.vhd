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
    strobe              : in  std_logic_vector(2 downto 0);  -- one flag per phase
    row_m_select_at_1   : in  unsigned(1 downto 0);
    row_m_select_at_0   : in  unsigned(1 downto 0);
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
  signal moved : signed_33_vector_t;  -- |.| <= 1342177272; t - V0, or - V0 with the bypass
  signal pose_m_used : std_logic;
  signal pose_m_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_m_outside : flag_x3_x3_t;
  signal row_w : signed_32_vector_x3_t;  -- |.| <= 268435456
  signal moved_held : signed_33_vector_x2_t := zero_signed_33_vector_x2;  -- |.| <= 1342177272; from clocks 4, 7 on
  signal in_w_inside_h3 : signed_32_x3_1_to_2_t := zero_signed_32_x3_1_to_2;  -- |.| <= 268435456
  signal row_same : signed_32_x3_t;  -- |.| <= 268435456
  signal pose_m_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal row_w_d1 : signed_32_vector_x3_t := zero_signed_32_vector_x3;  -- |.| <= 268435456
  signal row_turned : signed_32_x3_t;  -- |.| <= 805306372
  signal pose_bypass_held : std_logic_vector(1 downto 0) := (others => '0');  -- from clocks 3, 6 on
  type row_same_line_t is array (1 to 3) of signed_32_x3_t;
  signal row_same_line : row_same_line_t := (others => zero_signed_32_x3);  -- |.| <= 268435456
  signal row_choice_d1 : signed_32_x3_t := zero_signed_32_x3;  -- |.| <= 805306372
  signal row : signed_34_x3_t;  -- |.| <= 2147483644
  signal difference : signed_34_x9_t := zero_signed_34_x9;  -- |.| <= 2147483644
  signal row_turned_unit_m : signed_32_vector_x3_t;
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
  row_w_each_of : for k in 0 to 2 generate
    row_w_each : for i in 0 to 2 generate
      row_w(k)(i) <=
        in_w_inside(0)(i) when known(row_m_select_at_1) = 0 else
        in_w_inside(1)(i) when known(row_m_select_at_1) = 1 else
        in_w_inside(2)(i);
    end generate row_w_each;
  end generate row_w_each_of;
  difference_v1_each : for i in 0 to 2 generate
    difference_v1(i) <= resize(in_v_inside(1)(i), 33) - resize(in_v_inside(0)(i), 33);
    difference_v2(i) <= resize(in_v_inside(2)(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate difference_v1_each;
  pose_m_used_outside_each : for k in 0 to 2 generate
    pose_m_used_outside(k) <= or_reduce(unsigned(pose_m_outside(k))) and pose_m_used;
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
      pose_m_inside_d1 <= pose_m_inside;
      row_w_d1 <= row_w;
    end if;
  end process clock_2;
  moved_each : for i in 0 to 2 generate
    moved(i) <= resize(pose_t_inside(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate moved_each;
  row_turned_unit_m_each_of : for k in 0 to 2 generate
    row_turned_unit_m_each : for i in 0 to 2 generate
      row_turned_unit_m(k)(i) <= pose_m_inside_d1(k)(i);
    end generate row_turned_unit_m_each;
  end generate row_turned_unit_m_each_of;
  row_turned_unit : for k in 0 to 2 generate
    unit : entity work.difference_row
      port map (clk => clk, m => row_turned_unit_m(k), w => row_w_d1(k), turned => row_turned(k));
  end generate row_turned_unit;

  -- Clock 3
  row_same <=
    in_w_inside(0) when known(row_m_select_at_0) = 0 else
    in_w_inside_h3(1) when known(row_m_select_at_0) = 1 else
    in_w_inside_h3(2);

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      if pose_bypass_held(1) = '1' then
        row_choice_d1 <= row_same_line(3);
      else
        row_choice_d1 <= row_turned;
      end if;
    end if;
  end process clock_7;
  row_each : for k in 0 to 2 generate
    row(k) <= resize(row_choice_d1(k), 34) + resize(moved_held(1)(k), 34);
  end generate row_each;

  -- Clock 8
  difference_w0_each : for i in 0 to 2 generate
    difference_w0(i) <= difference(i)(32 downto 0);
  end generate difference_w0_each;

  -- Clock 9
  difference_w1_each : for i in 0 to 2 generate
    difference_w1(i) <= difference(i + 3)(32 downto 0);
  end generate difference_w1_each;

  -- Clock 10
  difference_w2_each : for i in 0 to 2 generate
    difference_w2(i) <= difference(i + 6)(32 downto 0);
  end generate difference_w2_each;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        for k in 0 to 2 loop
          pose_t_inside_number_h1(k) <= choose(pose_bypass, to_signed(0, 32), pose_t(k));
        end loop;
        moved_held(0) <= moved;
        moved_held(1) <= moved_held(0);
        for k in 1 to 2 loop
          in_w_inside_h3(k) <= in_w_inside(k);
        end loop;
        difference(6) <= row(0);
        difference(7) <= row(1);
        difference(8) <= row(2);
      end if;
      if strobe(2) = '1' then
        pose_bypass_held(0) <= pose_bypass;
        pose_bypass_held(1) <= pose_bypass_held(0);
        difference(3) <= row(0);
        difference(4) <= row(1);
        difference(5) <= row(2);
      end if;
      if strobe(1) = '1' then
        difference(0) <= row(0);
        difference(1) <= row(1);
        difference(2) <= row(2);
      end if;
    end if;
  end process captures;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      row_same_line <= row_same & row_same_line(1 to 2);
    end if;
  end process delays;
end architecture rtl;
