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
    clk               : in  std_logic;
    phase             : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
    holds             : in  std_logic_vector(17 downto 0);  -- whether the slot k slots ago holds a pair
    in_v              : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w              : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m            : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t            : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass       : in  std_logic;
    in_phase_1        : in  std_logic;
    strobe            : in  std_logic_vector(1 downto 0);  -- one flag per phase
    in_phase_0        : in  std_logic;
    in_v_outside      : out flag_x3_x3_t;
    in_w_outside      : out flag_x3_x3_t;
    difference_v1     : out signed_33_vector_t;  -- |.| <= 536870912
    difference_v2     : out signed_33_vector_t;  -- |.| <= 536870912
    pose_t_outside    : out std_logic_vector(2 downto 0);
    pose_m_outside    : out flag_x3_x3_t;
    row_m_select_at_0 : out std_logic;
    row_m_select_at_1 : out std_logic;
    difference_w0     : out signed_33_vector_t;  -- |.| <= 2147483644
    difference_w1     : out signed_33_vector_t;  -- |.| <= 2147483644
    difference_w2     : out signed_33_vector_t  -- |.| <= 2147483644
  );
end entity pair_differences;

architecture rtl of pair_differences is
  signal in_v_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal in_w_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_t_inside_number_h1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 2147483648
  signal pose_t_inside : signed_32_x3_t;  -- |.| <= 1073741816
  signal moved : signed_33_vector_t;  -- |.| <= 1342177272; t - V0, or - V0 with the bypass
  signal pose_m_inside_number_h1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- s4.28; |.| <= 2147483648
  signal pose_m_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal in_w_inside1_held : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456; from clocks 3, 5, 7 on
  signal row_w : signed_32_vector_x4_t;  -- |.| <= 268435456
  signal row_m0_select_at_0 : std_logic := '0';
  signal moved_held : signed_33_vector_x3_t := zero_signed_33_vector_x3;  -- |.| <= 1342177272; from clocks 3, 5, 7 on
  signal in_w_inside0_held : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456; from clocks 3, 5, 7 on
  signal row_same : signed_32_x4_t;  -- |.| <= 268435456
  signal row_m0_select_at_1 : std_logic := '0';
  signal pose_m_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal row_w_d1 : signed_32_vector_x4_t := zero_signed_32_vector_x4;  -- |.| <= 268435456
  signal row_turned : signed_32_x5_t;  -- |.| <= 805306372
  signal pose_bypass_held : std_logic_vector(2 downto 0) := (others => '0');  -- from clocks 2, 4, 6 on
  signal pose_bypass_h7 : std_logic := '0';
  signal row_choice_d1 : signed_32_x5_t := zero_signed_32_x5;  -- |.| <= 805306372
  signal moved_h5_d1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 1342177272
  signal row : signed_34_x5_t;  -- |.| <= 2147483644
  signal difference : signed_34_x9_t := zero_signed_34_x9;  -- |.| <= 2147483644
  signal row_m3 : signed_32_vector_t;  -- |.| <= 268435456
  signal in_w_inside2_held : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456; from clocks 3, 5, 7 on
  signal row_moved3 : signed(32 downto 0);  -- |.| <= 1342177272
  signal row_m3_d1 : signed_32_vector_t := zero_signed_32_vector;  -- |.| <= 268435456
  signal row_moved3_d1 : signed(32 downto 0) := (others => '0');  -- |.| <= 1342177272
  signal in_w_inside2_d1 : signed_32_x3_t := zero_signed_32_x3;  -- |.| <= 268435456
  signal busy_2 : std_logic := '0';  -- set in clocks 1 to 2 of a pair
  signal busy_12 : std_logic := '0';  -- set in clocks 11 to 12 of a pair
  signal busy_16 : std_logic := '0';  -- set in clocks 15 to 16 of a pair
  signal busy_18 : std_logic := '0';  -- set in clocks 17 to 18 of a pair
  signal busy_22 : std_logic := '0';  -- set in clocks 21 to 22 of a pair
  signal busy_24 : std_logic := '0';  -- set in clocks 23 to 24 of a pair
  signal busy_2_to_24 : std_logic;  -- a pair comes to clock 2, 12, 16, 18, 22, 24 or is in it
  signal busy_7 : std_logic := '0';  -- set in clocks 6 to 7 of a pair
  signal busy_19 : std_logic := '0';  -- set in clocks 18 to 19 of a pair
  signal busy_21 : std_logic := '0';  -- set in clocks 20 to 21 of a pair
  signal busy_25 : std_logic := '0';  -- set in clocks 24 to 25 of a pair
  signal busy_27 : std_logic := '0';  -- set in clocks 26 to 27 of a pair
  signal busy_7_to_27 : std_logic;  -- a pair comes to clock 7, 19, 21, 25, 27 or is in it
  signal row_turned_unit_m : signed_32_vector_x5_t;
  signal row_turned_unit_w : signed_32_vector_x5_t;
begin
  -- Flags of phases and pairs
  busy_2_to_24 <= busy_2 or busy_12 or busy_16 or busy_18 or busy_22 or busy_24;
  busy_7_to_27 <= busy_7 or busy_19 or busy_21 or busy_25 or busy_27;

  -- Clock 0
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

  -- Clock 1
  difference_v1_each : for i in 0 to 2 generate
    difference_v1(i) <= resize(in_v_inside(1)(i), 33) - resize(in_v_inside(0)(i), 33);
    difference_v2(i) <= resize(in_v_inside(2)(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate difference_v1_each;
  pose_t_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_translation
      port map (clk => clk, number => pose_t_inside_number_h1(k), passed => pose_t_inside(k),
                outside => pose_t_outside(k));
  end generate pose_t_inside_unit;
  pose_m_inside_unit_of : for k in 0 to 2 generate
    pose_m_inside_unit : for m in 0 to 2 generate
      unit : entity work.guard_coordinate
        port map (clk => clk, number => pose_m_inside_number_h1(k)(m), passed => pose_m_inside(k)(m),
                  outside => pose_m_outside(k)(m));
    end generate pose_m_inside_unit;
  end generate pose_m_inside_unit_of;

  -- Clock 2
  moved_each : for i in 0 to 2 generate
    moved(i) <= resize(pose_t_inside(i), 33) - resize(in_v_inside(0)(i), 33);
  end generate moved_each;
  row_w_each_of : for k in 0 to 2 generate
    row_w_each : for i in 0 to 2 generate
      row_w(k)(i) <= in_w_inside1_held(0)(i) when row_m0_select_at_0 = '1' else in_w_inside(0)(i);
    end generate row_w_each;
  end generate row_w_each_of;
  row_w_3_each : for i in 0 to 2 generate
    row_w(3)(i) <= in_w_inside2_held(0)(i) when row_m0_select_at_0 = '1' else in_w_inside(2)(i);
    row_m3(i) <= pose_m_inside(1)(i) when row_m0_select_at_0 = '1' else pose_m_inside(0)(i);
  end generate row_w_3_each;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      pose_m_inside_d1 <= pose_m_inside;
      row_w_d1 <= row_w;
      row_m3_d1 <= row_m3;
      in_w_inside2_d1 <= in_w_inside(2);
    end if;
  end process clock_3;
  row_turned_unit_m_each_of : for k in 0 to 2 generate
    row_turned_unit_m_each : for i in 0 to 2 generate
      row_turned_unit_m(k)(i) <= pose_m_inside_d1(k)(i);
    end generate row_turned_unit_m_each;
  end generate row_turned_unit_m_each_of;
  row_turned_unit_m(3) <= row_m3_d1;
  row_turned_unit_m_4_each : for i in 0 to 2 generate
    row_turned_unit_m(4)(i) <= pose_m_inside_d1(2)(i);
  end generate row_turned_unit_m_4_each;
  row_turned_unit_w_each : for k in 0 to 3 generate
    row_turned_unit_w(k) <= row_w_d1(k);
  end generate row_turned_unit_w_each;
  row_turned_unit_w_4_each : for i in 0 to 2 generate
    row_turned_unit_w(4)(i) <= in_w_inside2_d1(i);
  end generate row_turned_unit_w_4_each;
  row_turned_unit : for k in 0 to 4 generate
    unit : entity work.difference_row
      port map (clk => clk, m => row_turned_unit_m(k), w => row_turned_unit_w(k), turned => row_turned(k));
  end generate row_turned_unit;

  -- Clock 7
  row_same(0) <= in_w_inside1_held(2)(0) when row_m0_select_at_1 = '1' else in_w_inside0_held(2)(0);
  row_same(1) <= in_w_inside1_held(2)(1) when row_m0_select_at_1 = '1' else in_w_inside0_held(2)(1);
  row_same(2) <= in_w_inside1_held(2)(2) when row_m0_select_at_1 = '1' else in_w_inside0_held(2)(2);
  row_same(3) <= in_w_inside2_held(2)(1) when row_m0_select_at_1 = '1' else in_w_inside2_held(2)(0);
  row_moved3 <= moved_held(2)(1) when row_m0_select_at_1 = '1' else moved_held(2)(0);

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        row_choice_d1(k) <= choose(pose_bypass_h7, row_same(k), row_turned(k));
      end loop;
      row_choice_d1(4) <= choose(pose_bypass_h7, in_w_inside2_held(2)(2), row_turned(4));
      moved_h5_d1 <= moved_held(2);
      row_moved3_d1 <= row_moved3;
    end if;
  end process clock_8;
  row(0) <= resize(row_choice_d1(0), 34) + resize(moved_h5_d1(0), 34);
  row(1) <= resize(row_choice_d1(1), 34) + resize(moved_h5_d1(1), 34);
  row(2) <= resize(row_choice_d1(2), 34) + resize(moved_h5_d1(2), 34);
  row(3) <= resize(row_choice_d1(3), 34) + resize(row_moved3_d1, 34);
  row(4) <= resize(row_choice_d1(4), 34) + resize(moved_h5_d1(2), 34);

  -- Clock 9
  difference_w0_each : for i in 0 to 2 generate
    difference_w0(i) <= difference(i)(32 downto 0);
  end generate difference_w0_each;
  difference_w2(0) <= difference(3)(32 downto 0);
  difference_w2(2) <= difference(4)(32 downto 0);

  -- Clock 10
  difference_w1_each : for i in 0 to 2 generate
    difference_w1(i) <= difference(i + 5)(32 downto 0);
  end generate difference_w1_each;
  difference_w2(1) <= difference(8)(32 downto 0);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_2_to_24 = '1' then
        if phase = '1' then
          row_m0_select_at_0 <= '0';
        else
          row_m0_select_at_0 <= '1';
        end if;
      end if;
      if busy_7_to_27 = '1' then
        if phase = '1' then
          row_m0_select_at_1 <= '1';
        else
          row_m0_select_at_1 <= '0';
        end if;
      end if;
    end if;
  end process selectors;

  -- Registers that are loaded once per pair
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        for k in 0 to 2 loop
          pose_t_inside_number_h1(k) <= choose(pose_bypass, to_signed(0, 32), pose_t(k));
          for m in 0 to 2 loop
            pose_m_inside_number_h1(k)(m) <= choose(pose_bypass, to_signed(0, 32), pose_m(k)(m));
          end loop;
        end loop;
        in_w_inside1_held <= in_w_inside(1) & in_w_inside1_held(0 to 1);
        moved_held <= moved & moved_held(0 to 1);
        in_w_inside0_held <= in_w_inside(0) & in_w_inside0_held(0 to 1);
        pose_bypass_h7 <= pose_bypass_held(2);
        for k in 0 to 4 loop
          difference(k) <= row(k);
        end loop;
        in_w_inside2_held <= in_w_inside(2) & in_w_inside2_held(0 to 1);
      end if;
      if strobe(1) = '1' then
        pose_bypass_held <= pose_bypass_held(1 downto 0) & pose_bypass;
        for k in 0 to 3 loop
          difference(k + 5) <= row(k);
        end loop;
      end if;
      if in_phase_0 = '1' then
        busy_2 <= holds(0);
        busy_12 <= holds(5);
        busy_16 <= holds(7);
        busy_18 <= holds(8);
        busy_22 <= holds(10);
        busy_24 <= holds(11);
      end if;
      if in_phase_1 = '1' then
        busy_7 <= holds(2);
        busy_19 <= holds(8);
        busy_21 <= holds(9);
        busy_25 <= holds(11);
        busy_27 <= holds(12);
      end if;
    end if;
  end process captures;

  -- Outputs
  row_m_select_at_0 <= row_m0_select_at_0;
  row_m_select_at_1 <= row_m0_select_at_1;
end architecture rtl;
