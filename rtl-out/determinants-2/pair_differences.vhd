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
    phase               : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
    holds               : in  std_logic_vector(17 downto 0);  -- whether the slot k slots ago holds a pair
    in_v                : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w                : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m              : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t              : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass         : in  std_logic;
    in_phase_1          : in  std_logic;
    strobe              : in  std_logic_vector(1 downto 0);  -- one flag per phase
    in_v_outside        : out flag_x3_x3_t;
    in_w_outside        : out flag_x3_x3_t;
    difference_v1       : out signed_33_vector_t;  -- |.| <= 536870912
    difference_v2       : out signed_33_vector_t;  -- |.| <= 536870912
    pose_t_outside      : out std_logic_vector(2 downto 0);
    pose_m_used_outside : out std_logic_vector(2 downto 0);
    row_m_select_at_1   : out std_logic;
    row_m_select_at_0   : out std_logic;
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
  signal row_m0_select_at_1 : std_logic := '0';
  signal moved_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 1342177272; from clocks 3, 5, 7 on
  signal row_moved : signed_33_x4_t;  -- |.| <= 1342177272
  signal row_m0_select_at_0 : std_logic := '0';
  signal in_w_inside0_held : signed_32_x3_x2_t := zero_signed_32_x3_x2;  -- |.| <= 268435456; from clocks 3, 5 on
  signal in_w_inside1_held : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456; from clocks 3, 5, 7 on
  signal row_same : signed_32_x4_t;  -- |.| <= 268435456
  signal pose_m_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal row_w_d1 : signed_32_vector_x3_t := zero_signed_32_vector_x3;  -- |.| <= 268435456
  signal row_turned : signed_32_x5_t;  -- |.| <= 805306372
  signal pose_bypass_held : std_logic_vector(2 downto 0) := (others => '0');  -- from clocks 2, 4, 6 on
  signal row_choice_d1 : signed_32_x5_t := zero_signed_32_x5;  -- |.| <= 805306372
  signal row_moved_d1 : signed_33_x4_t := zero_signed_33_x4;  -- |.| <= 1342177272
  signal row : signed_34_x5_t;  -- |.| <= 2147483644
  signal difference : signed_34_x9_t := zero_signed_34_x9;  -- |.| <= 2147483644
  signal row_m3 : signed_32_vector_t;  -- |.| <= 268435456
  signal in_w_inside2_held : signed_32_x3_x2_t := zero_signed_32_x3_x2;  -- |.| <= 268435456; from clocks 3, 5 on
  signal in_w_inside2_2_1_held : signed(31 downto 0) := (others => '0');  -- |.| <= 268435456; from clock 7 on
  signal row_m3_d1 : signed_32_vector_t := zero_signed_32_vector;  -- |.| <= 268435456
  signal in_w_inside2_d1 : signed_32_x3_t := zero_signed_32_x3;  -- |.| <= 268435456
  signal moved_z_h3_d1 : signed(32 downto 0) := (others => '0');  -- |.| <= 1342177272
  signal busy_11 : std_logic := '0';  -- set in clocks 10 to 11 of a pair
  signal busy_15 : std_logic := '0';  -- set in clocks 14 to 15 of a pair
  signal busy_17 : std_logic := '0';  -- set in clocks 16 to 17 of a pair
  signal busy_21 : std_logic := '0';  -- set in clocks 20 to 21 of a pair
  signal busy_23 : std_logic := '0';  -- set in clocks 22 to 23 of a pair
  signal busy_1_to_23 : std_logic;  -- a pair comes to clock 1, 11, 15, 17, 21, 23 or is in it
  signal in_phase_0 : std_logic;
  signal busy_6 : std_logic := '0';  -- set in clocks 5 to 6 of a pair
  signal busy_18 : std_logic := '0';  -- set in clocks 17 to 18 of a pair
  signal busy_20 : std_logic := '0';  -- set in clocks 19 to 20 of a pair
  signal busy_24 : std_logic := '0';  -- set in clocks 23 to 24 of a pair
  signal busy_26 : std_logic := '0';  -- set in clocks 25 to 26 of a pair
  signal busy_6_to_26 : std_logic;  -- a pair comes to clock 6, 18, 20, 24, 26 or is in it
  signal row_turned_unit_m : signed_32_vector_x5_t;
  signal row_turned_unit_w : signed_32_vector_x5_t;
begin
  -- Flags of phases and pairs
  busy_1_to_23 <= holds(0) or busy_11 or busy_15 or busy_17 or busy_21 or busy_23;
  in_phase_0 <= flag(phase = '0');
  busy_6_to_26 <= busy_6 or busy_18 or busy_20 or busy_24 or busy_26;

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
      row_w(k)(i) <= in_w_inside(1)(i) when row_m0_select_at_1 = '1' else in_w_inside(0)(i);
    end generate row_w_each;
  end generate row_w_each_of;
  row_m3_each : for i in 0 to 2 generate
    row_m3(i) <= pose_m_inside(1)(i) when row_m0_select_at_1 = '1' else pose_m_inside(0)(i);
    difference_v1(i) <= resize(in_v_inside(1)(i), 33) - resize(in_v_inside(0)(i), 33);
    difference_v2(i) <= resize(in_v_inside(2)(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate row_m3_each;
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
      row_m3_d1 <= row_m3;
      in_w_inside2_d1 <= in_w_inside(2);
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
  row_turned_unit_m(3) <= row_m3_d1;
  row_turned_unit_m_4_each : for i in 0 to 2 generate
    row_turned_unit_m(4)(i) <= pose_m_inside_d1(2)(i);
  end generate row_turned_unit_m_4_each;
  row_turned_unit_w(0) <= row_w_d1(0);
  row_turned_unit_w(1) <= row_w_d1(1);
  row_turned_unit_w(2) <= row_w_d1(2);
  row_turned_unit_w_each_of : for k in 3 to 4 generate
    row_turned_unit_w_each : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside2_d1(i);
    end generate row_turned_unit_w_each;
  end generate row_turned_unit_w_each_of;
  row_turned_unit : for k in 0 to 4 generate
    unit : entity work.difference_row
      port map (clk => clk, m => row_turned_unit_m(k), w => row_turned_unit_w(k), turned => row_turned(k));
  end generate row_turned_unit;

  -- Clock 6
  row_moved(0) <= moved_held(2)(0) when row_m0_select_at_0 = '1' else moved_held(1)(0);
  row_moved(1) <= moved_held(2)(1) when row_m0_select_at_0 = '1' else moved_held(1)(1);
  row_moved(2) <= moved_held(2)(2) when row_m0_select_at_0 = '1' else moved_held(1)(2);
  row_moved(3) <= moved_held(2)(1) when row_m0_select_at_0 = '1' else moved_held(1)(0);
  row_same(0) <= in_w_inside1_held(2)(0) when row_m0_select_at_0 = '1' else in_w_inside0_held(1)(0);
  row_same(1) <= in_w_inside1_held(2)(1) when row_m0_select_at_0 = '1' else in_w_inside0_held(1)(1);
  row_same(2) <= in_w_inside1_held(2)(2) when row_m0_select_at_0 = '1' else in_w_inside0_held(1)(2);
  row_same(3) <= in_w_inside2_2_1_held when row_m0_select_at_0 = '1' else in_w_inside2_held(1)(0);

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        row_choice_d1(k) <= choose(pose_bypass_held(2), row_same(k), row_turned(k));
      end loop;
      row_choice_d1(4) <= choose(pose_bypass_held(2), in_w_inside2_held(1)(2), row_turned(4));
      row_moved_d1 <= row_moved;
      moved_z_h3_d1 <= moved_held(1)(2);
    end if;
  end process clock_7;
  row_each : for k in 0 to 3 generate
    row(k) <= resize(row_choice_d1(k), 34) + resize(row_moved_d1(k), 34);
  end generate row_each;
  row(4) <= resize(row_choice_d1(4), 34) + resize(moved_z_h3_d1, 34);

  -- Clock 8
  difference_w0_each : for i in 0 to 2 generate
    difference_w0(i) <= difference(i)(32 downto 0);
  end generate difference_w0_each;
  difference_w2(0) <= difference(3)(32 downto 0);
  difference_w2(2) <= difference(4)(32 downto 0);

  -- Clock 9
  difference_w1_each : for i in 0 to 2 generate
    difference_w1(i) <= difference(i + 5)(32 downto 0);
  end generate difference_w1_each;
  difference_w2(1) <= difference(8)(32 downto 0);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_1_to_23 = '1' then
        if phase = '1' then
          row_m0_select_at_1 <= '1';
        else
          row_m0_select_at_1 <= '0';
        end if;
      end if;
      if busy_6_to_26 = '1' then
        if phase = '1' then
          row_m0_select_at_0 <= '0';
        else
          row_m0_select_at_0 <= '1';
        end if;
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        for k in 0 to 2 loop
          pose_t_inside_number_h1(k) <= choose(pose_bypass, to_signed(0, 32), pose_t(k));
        end loop;
        moved_held <= moved & moved_held(0 to 1);
        in_w_inside0_held(0) <= in_w_inside(0);
        in_w_inside0_held(1) <= in_w_inside0_held(0);
        in_w_inside1_held <= in_w_inside(1) & in_w_inside1_held(0 to 1);
        for k in 0 to 3 loop
          difference(k + 5) <= row(k);
        end loop;
        in_w_inside2_held(0) <= in_w_inside(2);
        in_w_inside2_held(1) <= in_w_inside2_held(0);
        in_w_inside2_2_1_held <= in_w_inside2_held(1)(1);
      end if;
      if strobe(1) = '1' then
        pose_bypass_held <= pose_bypass_held(1 downto 0) & pose_bypass;
        for k in 0 to 4 loop
          difference(k) <= row(k);
        end loop;
      end if;
      if in_phase_1 = '1' then
        busy_11 <= holds(4);
        busy_15 <= holds(6);
        busy_17 <= holds(7);
        busy_21 <= holds(9);
        busy_23 <= holds(10);
      end if;
      if in_phase_0 = '1' then
        busy_6 <= holds(2);
        busy_18 <= holds(8);
        busy_20 <= holds(9);
        busy_24 <= holds(11);
        busy_26 <= holds(12);
      end if;
    end if;
  end process captures;

  -- Outputs
  row_m_select_at_1 <= row_m0_select_at_1;
  row_m_select_at_0 <= row_m0_select_at_0;
end architecture rtl;
