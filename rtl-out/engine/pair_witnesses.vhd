-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 6: signs that are certain, boxes that are apart, witnesses, verdict.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_witnesses is
  port (
    clk                : in  std_logic;
    strobe             : in  std_logic_vector(2 downto 0);  -- one flag per phase
    row_m_select_at_1  : in  unsigned(1 downto 0);
    row_m_select_at_0  : in  unsigned(1 downto 0);
    level              : in  unsigned(2 downto 0);
    row_m_select_at_2  : in  unsigned(1 downto 0);
    coordinate_w0_h6   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_h6   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_x_h3 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v2_y_h3 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v2_z_h6 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v1_x_h3 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v1_y_h3 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w2_h6   : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_z_h6 : in  signed(17 downto 0);  -- |.| <= 131071
    compared           : in  signed_41_x15_t;  -- |.| <= 206156857344
    compared_bound     : in  signed_31_x15_t;  -- |.| <= 67665506
    outside_h24        : in  std_logic;
    outside_h32        : in  std_logic;
    separated          : out std_logic_vector(8 downto 0);
    overlapping        : out std_logic_vector(8 downto 0);
    verdict            : out unsigned(1 downto 0)  -- 00 separate, 01 intersect, 10 possibly incorrect
  );
end entity pair_witnesses;

architecture rtl of pair_witnesses is
  constant boxes_wrong_table : numbers_t(0 to 7) := (1, 1, 2, 3, 5, 9, 17, others => 0);
  signal compared0_held : signed(40 downto 0) := (others => '0');  -- |.| <= 51539214336; from clock 33 on
  signal compared_held : signed_41_9_to_14_t := zero_signed_41_9_to_14;  -- |.| <= 206156857344; from clocks 33, 34, 35 on
  signal sign_x : signed_41_x5_t;  -- |.| <= 206156857344
  signal compared_bound_0_to_2_held : signed_31_x3_t := zero_signed_31_x3;  -- |.| <= 16916376; from clock 33 on
  signal compared_bound_held : signed_31_4_to_8_t := zero_signed_31_4_to_8;  -- |.| <= 60980936; from clocks 32, 34 on
  signal sign_bound : signed_31_x5_t;  -- |.| <= 67665506
  signal sign_x_d1 : signed_41_x4_t := zero_signed_41_x4;  -- |.| <= 206156857344
  signal sign_x4_d1 : signed(40 downto 0) := (others => '0');  -- |.| <= 206156857344
  signal sign_bound_d1 : signed_31_x4_t := zero_signed_31_x4;  -- |.| <= 67665506
  signal sign_bound4_d1 : signed(30 downto 0) := (others => '0');  -- |.| <= 67665506
  signal sign_lane : flag_x2_x5_t;
  signal sign : flag_x2_x15_t := zero_flag_x2_x15;
  signal compared_bound_12_to_14_held : signed_31_12_to_14_t := zero_signed_31_12_to_14;  -- |.| <= 16916376; from clocks 33, 34 on
  signal compared3_held : signed(40 downto 0) := (others => '0');  -- |.| <= 51539214336; from clock 33 on
  signal boxes_v : signed_18_x2_t;  -- |.| <= 131071
  signal boxes_w : signed_18_x3_t;  -- |.| <= 131071
  signal boxes_v_d1 : signed_18_x2_t := zero_signed_18_x2;  -- |.| <= 131071
  signal boxes_w_d1 : signed_18_x3_t := zero_signed_18_x3;  -- |.| <= 131071
  signal boxes_wrong_d1 : unsigned(4 downto 0) := (others => '0');
  signal boxes_lane : std_logic;
  signal boxes_apart_along : std_logic_vector(2 downto 0) := (others => '0');
  signal boxes_apart : std_logic;
  signal separated_result : std_logic_vector(8 downto 3);
  signal overlapping_result : std_logic_vector(8 downto 3);
  signal sign0_h3 : std_logic_vector(1 downto 0) := (others => '0');
  signal sign_h3 : flag_x2_2_to_3_t := zero_flag_x2_2_to_3;
  signal overlapping_constant : std_logic_vector(2 downto 0);
  signal separated_not_h3 : std_logic_vector(8 downto 0) := (others => '0');
  signal separated_i : std_logic_vector(8 downto 0);
  signal separated_not_h6 : std_logic_vector(8 downto 1) := (others => '0');
  signal separated_not_h9 : std_logic_vector(8 downto 1) := (others => '0');
  signal separated_not_held : std_logic_vector(8 downto 2) := (others => '0');  -- from clocks 36, 37, 38 on
  signal overlapping_i : std_logic_vector(8 downto 0);
  signal overlapping_not_h3 : std_logic_vector(8 downto 3) := (others => '0');
  signal overlapping5_not_h4 : std_logic := '0';
  signal overlapping8_not_h4 : std_logic := '0';
  signal separated0_held : std_logic_vector(3 downto 0) := (others => '0');  -- from clocks 30, 33, ... 39 on
  signal separated_held : std_logic_vector(8 downto 1) := (others => '0');  -- from clocks 38, 39 on
  signal separated_held_2 : std_logic_vector(3 downto 1) := (others => '0');  -- from clock 39 on
  signal separated_6_to_7_held_2 : std_logic_vector(7 downto 6) := (others => '0');  -- from clock 39 on
  signal overlapping_held : std_logic_vector(8 downto 0) := (others => '0');  -- from clocks 37, 38, 39 on
  signal overlapping_held_2 : std_logic_vector(3 downto 0) := (others => '0');  -- from clock 39 on
  signal overlapping_6_to_7_held_2 : std_logic_vector(7 downto 6) := (others => '0');  -- from clock 39 on
  signal sign_lane_unit_x : signed_41_x5_t;
  signal sign_lane_unit_bound : signed_31_x5_t;
  signal separated_result_unit_ends : flag_x2_x2_3_to_8_t;
  signal separated_result_unit_sides : flag_x2_x3_3_to_8_t;
  signal verdict_unit_separated : std_logic_vector(8 downto 0);
  signal verdict_unit_overlapping : std_logic_vector(8 downto 0);
begin
  -- Constants
  overlapping_constant_each : for k in 0 to 2 generate
    overlapping_constant(k) <= '0';
  end generate overlapping_constant_each;

  -- Clock 23
  boxes_v(0) <=
    coordinate_v1_x_h3 when known(row_m_select_at_2) = 0 else
    coordinate_v1_y_h3 when known(row_m_select_at_2) = 1 else
    coordinate_v1_z_h6;
  boxes_v(1) <=
    coordinate_v2_x_h3 when known(row_m_select_at_2) = 0 else
    coordinate_v2_y_h3 when known(row_m_select_at_2) = 1 else
    coordinate_v2_z_h6;
  boxes_w(0) <=
    coordinate_w0_h6(0) when known(row_m_select_at_2) = 0 else
    coordinate_w0_h6(1) when known(row_m_select_at_2) = 1 else
    coordinate_w0_h6(2);
  boxes_w(1) <=
    coordinate_w1_h6(0) when known(row_m_select_at_2) = 0 else
    coordinate_w1_h6(1) when known(row_m_select_at_2) = 1 else
    coordinate_w1_h6(2);
  boxes_w(2) <=
    coordinate_w2_h6(0) when known(row_m_select_at_2) = 0 else
    coordinate_w2_h6(1) when known(row_m_select_at_2) = 1 else
    coordinate_w2_h6(2);

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      boxes_v_d1 <= boxes_v;
      boxes_w_d1 <= boxes_w;
      boxes_wrong_d1 <= to_unsigned(boxes_wrong_table(to_integer(known(level))), 5);
    end if;
  end process clock_24;
  boxes_lane_unit : entity work.boxes_axis
    port map (clk => clk, v => boxes_v_d1, w => boxes_w_d1, wrong => boxes_wrong_d1, apart => boxes_lane);

  -- Clock 29
  boxes_apart <= or_reduce(unsigned(boxes_apart_along));
  separated_i(0) <= boxes_apart and separated_not_h3(0);

  -- Clock 33
  sign_x(0) <=
    compared0_held when known(row_m_select_at_0) = 0 else
    compared(5) when known(row_m_select_at_0) = 1 else
    compared_held(10);
  sign_x(1) <=
    compared(1) when known(row_m_select_at_0) = 0 else
    compared(6) when known(row_m_select_at_0) = 1 else
    compared_held(11);
  sign_x(2) <=
    compared(2) when known(row_m_select_at_0) = 0 else
    compared(7) when known(row_m_select_at_0) = 1 else
    compared_held(12);
  sign_x(3) <=
    compared3_held when known(row_m_select_at_0) = 0 else
    compared(8) when known(row_m_select_at_0) = 1 else
    compared_held(13);
  sign_bound(0) <=
    compared_bound_0_to_2_held(0) when known(row_m_select_at_0) = 0 else
    compared_bound_held(5) when known(row_m_select_at_0) = 1 else
    compared_bound(10);
  sign_bound(1) <=
    compared_bound_0_to_2_held(1) when known(row_m_select_at_0) = 0 else
    compared_bound_held(6) when known(row_m_select_at_0) = 1 else
    compared_bound(11);
  sign_bound(2) <=
    compared_bound_0_to_2_held(2) when known(row_m_select_at_0) = 0 else
    compared_bound_held(7) when known(row_m_select_at_0) = 1 else
    compared_bound_12_to_14_held(12);
  sign_bound(3) <=
    compared_bound(3) when known(row_m_select_at_0) = 0 else
    compared_bound_held(8) when known(row_m_select_at_0) = 1 else
    compared_bound_12_to_14_held(13);

  -- Clock 34
  clock_34 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        sign_x_d1(k) <= sign_x(k);
        sign_bound_d1(k) <= sign_bound(k);
      end loop;
    end if;
  end process clock_34;
  sign_x(4) <=
    compared(4) when known(row_m_select_at_1) = 0 else
    compared_held(9) when known(row_m_select_at_1) = 1 else
    compared_held(14);
  sign_bound(4) <=
    compared_bound_held(4) when known(row_m_select_at_1) = 0 else
    compared_bound(9) when known(row_m_select_at_1) = 1 else
    compared_bound_12_to_14_held(14);
  overlapping_i(0) <= overlapping_constant(0) and not outside_h32;
  overlapping_i(1) <= overlapping_constant(1) and not outside_h32;
  overlapping_i(2) <= overlapping_constant(2) and not outside_h32;
  sign_lane_unit_x_each : for k in 0 to 3 generate
    sign_lane_unit_x(k) <= sign_x_d1(k);
  end generate sign_lane_unit_x_each;
  sign_lane_unit_x(4) <= sign_x4_d1;
  sign_lane_unit_bound_each : for k in 0 to 3 generate
    sign_lane_unit_bound(k) <= sign_bound_d1(k);
  end generate sign_lane_unit_bound_each;
  sign_lane_unit_bound(4) <= sign_bound4_d1;
  sign_lane_unit : for k in 0 to 4 generate
    unit : entity work.certain_sign
      port map (x => sign_lane_unit_x(k), bound => sign_lane_unit_bound(k), sign => sign_lane(k));
  end generate sign_lane_unit;

  -- Clock 35
  clock_35 : process (clk)
  begin
    if rising_edge(clk) then
      sign_x4_d1 <= sign_x(4);
      sign_bound4_d1 <= sign_bound(4);
    end if;
  end process clock_35;
  separated_i(1) <= ((sign(0)(0) and sign(1)(0) and sign(2)(0)) or (sign(0)(1) and sign(1)(1) and sign(2)(1))) and
      separated_not_h9(1);

  -- Clock 36
  separated_i(2) <= ((sign(3)(0) and sign(4)(0) and sign(5)(0)) or (sign(3)(1) and sign(4)(1) and sign(5)(1))) and
      separated_not_held(2);
  separated_i(3) <= separated_result(3) and separated_not_held(3);
  separated_result_unit_ends_3_each : for m in 0 to 1 generate
    separated_result_unit_ends(3)(m) <= sign(m + 3);
    separated_result_unit_ends(4)(m) <= sign(m + 4);
  end generate separated_result_unit_ends_3_each;
  separated_result_unit_ends(5)(0) <= sign(5);
  separated_result_unit_ends(5)(1) <= sign_h3(3);
  separated_result_unit_ends_6_each : for m in 0 to 1 generate
    separated_result_unit_ends(6)(m) <= sign(m);
    separated_result_unit_ends(7)(m) <= sign(m + 1);
  end generate separated_result_unit_ends_6_each;
  separated_result_unit_ends(8)(0) <= sign_h3(2);
  separated_result_unit_ends(8)(1) <= sign0_h3;
  separated_result_unit_sides_3_each : for m in 0 to 2 generate
    separated_result_unit_sides(3)(m) <= sign(m + 6);
    separated_result_unit_sides(4)(m) <= sign(m + 9);
    separated_result_unit_sides(5)(m) <= sign(m + 12);
  end generate separated_result_unit_sides_3_each;
  separated_result_unit_sides_0_each : for k in 6 to 8 generate
    separated_result_unit_sides(k)(0) <= sign(k);
    separated_result_unit_sides(k)(1) <= sign(k + 3);
    separated_result_unit_sides(k)(2) <= sign(k + 6);
  end generate separated_result_unit_sides_0_each;
  separated_result_unit : for k in 3 to 8 generate
    unit : entity work.edge_verdict
      port map (ends => separated_result_unit_ends(k), sides => separated_result_unit_sides(k),
                missed => separated_result(k), pierces => overlapping_result(k));
  end generate separated_result_unit;

  -- Clock 37
  separated_i(4) <= separated_result(4) and separated_not_held(4);
  separated_i(6) <= separated_result(6) and separated_not_held(6);
  separated_i(7) <= separated_result(7) and separated_not_held(7);
  overlapping_i(3) <= overlapping_result(3) and overlapping_not_h3(3);
  overlapping_i(4) <= overlapping_result(4) and overlapping_not_h3(4);
  overlapping_i(6) <= overlapping_result(6) and overlapping_not_h3(6);
  overlapping_i(7) <= overlapping_result(7) and overlapping_not_h3(7);

  -- Clock 38
  separated_i(5) <= separated_result(5) and separated_not_held(5);
  separated_i(8) <= separated_result(8) and separated_not_held(8);
  overlapping_i(5) <= overlapping_result(5) and overlapping5_not_h4;
  overlapping_i(8) <= overlapping_result(8) and overlapping8_not_h4;

  -- Clock 39
  verdict_unit_separated(0) <= separated0_held(3);
  verdict_unit_separated(1) <= separated_held_2(1);
  verdict_unit_separated(2) <= separated_held_2(2);
  verdict_unit_separated(3) <= separated_held_2(3);
  verdict_unit_separated(4) <= separated_held(4);
  verdict_unit_separated(5) <= separated_held(5);
  verdict_unit_separated(6) <= separated_6_to_7_held_2(6);
  verdict_unit_separated(7) <= separated_6_to_7_held_2(7);
  verdict_unit_separated(8) <= separated_held(8);
  verdict_unit_overlapping_each : for k in 0 to 3 generate
    verdict_unit_overlapping(k) <= overlapping_held_2(k);
  end generate verdict_unit_overlapping_each;
  verdict_unit_overlapping(4) <= overlapping_held(4);
  verdict_unit_overlapping(5) <= overlapping_held(5);
  verdict_unit_overlapping(6) <= overlapping_6_to_7_held_2(6);
  verdict_unit_overlapping(7) <= overlapping_6_to_7_held_2(7);
  verdict_unit_overlapping(8) <= overlapping_held(8);
  verdict_unit : entity work.pair_verdict
    port map (separated => verdict_unit_separated, overlapping => verdict_unit_overlapping, verdict => verdict);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(2) = '1' then
        compared0_held <= compared(0);
        compared_held(12) <= compared(12);
        for k in 0 to 2 loop
          compared_bound_0_to_2_held(k) <= compared_bound(k);
        end loop;
        for k in 0 to 4 loop
          sign(k + 4) <= sign_lane((k + 4) mod 5);
        end loop;
        compared_bound_12_to_14_held(12) <= compared_bound(12);
        compared_bound_12_to_14_held(13) <= compared_bound(13);
        compared3_held <= compared(3);
        separated_not_held(2) <= separated_not_h9(2);
        separated_not_held(3) <= separated_not_h9(3);
        separated0_held <= separated0_held(2 downto 0) & separated_i(0);
        separated_held(4) <= separated_i(4);
        separated_held(5) <= separated_i(5);
        separated_held(8) <= separated_i(8);
        for k in 1 to 3 loop
          separated_held_2(k) <= separated_held(k);
        end loop;
        for k in 6 to 7 loop
          separated_6_to_7_held_2(k) <= separated_held(k);
        end loop;
        overlapping_held(4) <= overlapping_i(4);
        overlapping_held(5) <= overlapping_i(5);
        overlapping_held(8) <= overlapping_i(8);
        for k in 0 to 3 loop
          overlapping_held_2(k) <= overlapping_held(k);
        end loop;
        for k in 6 to 7 loop
          overlapping_6_to_7_held_2(k) <= overlapping_held(k);
        end loop;
      end if;
      if strobe(1) = '1' then
        compared_held(9) <= compared(9);
        compared_held(10) <= compared(10);
        compared_held(11) <= compared(11);
        compared_held(14) <= compared(14);
        compared_bound_held(6) <= compared_bound(6);
        compared_bound_held(7) <= compared_bound(7);
        for k in 0 to 3 loop
          sign(k) <= sign_lane(k);
        end loop;
        sign(14) <= sign_lane(4);
        sign0_h3 <= sign(0);
        for k in 2 to 3 loop
          sign_h3(k) <= sign(k);
        end loop;
        for k in 0 to 8 loop
          separated_not_h3(k) <= not outside_h24;
        end loop;
        for k in 1 to 8 loop
          separated_not_h6(k) <= separated_not_h3(k);
        end loop;
        separated_not_h9 <= separated_not_h6;
        separated_not_held(5) <= separated_not_h9(5);
        separated_not_held(8) <= separated_not_h9(8);
        overlapping5_not_h4 <= overlapping_not_h3(5);
        overlapping8_not_h4 <= overlapping_not_h3(8);
        separated_held(1) <= separated_i(1);
        separated_held(2) <= separated_i(2);
        separated_held(3) <= separated_i(3);
        separated_held(6) <= separated_i(6);
        separated_held(7) <= separated_i(7);
        overlapping_held(3) <= overlapping_i(3);
        overlapping_held(6) <= overlapping_i(6);
        overlapping_held(7) <= overlapping_i(7);
      end if;
      if strobe(0) = '1' then
        compared_held(13) <= compared(13);
        compared_bound_held(4) <= compared_bound(4);
        compared_bound_held(5) <= compared_bound(5);
        compared_bound_held(8) <= compared_bound(8);
        for k in 0 to 4 loop
          sign(k + 9) <= sign_lane((k + 4) mod 5);
        end loop;
        compared_bound_12_to_14_held(14) <= compared_bound(14);
        separated_not_held(4) <= separated_not_h9(4);
        separated_not_held(6) <= separated_not_h9(6);
        separated_not_held(7) <= separated_not_h9(7);
        for k in 3 to 8 loop
          overlapping_not_h3(k) <= not outside_h32;
        end loop;
        overlapping_held(0) <= overlapping_i(0);
        overlapping_held(1) <= overlapping_i(1);
        overlapping_held(2) <= overlapping_i(2);
      end if;
      for k in 0 to 2 loop
        if strobe((k + 2) mod 3) = '1' then
          boxes_apart_along(k) <= boxes_lane;
        end if;
      end loop;
    end if;
  end process captures;

  -- Outputs
  separated(0) <= separated0_held(3);
  separated(1) <= separated_held_2(1);
  separated(2) <= separated_held_2(2);
  separated(3) <= separated_held_2(3);
  separated(4) <= separated_held(4);
  separated(5) <= separated_held(5);
  separated(6) <= separated_6_to_7_held_2(6);
  separated(7) <= separated_6_to_7_held_2(7);
  separated(8) <= separated_held(8);
  overlapping_each : for k in 0 to 3 generate
    overlapping(k) <= overlapping_held_2(k);
  end generate overlapping_each;
  overlapping(4) <= overlapping_held(4);
  overlapping(5) <= overlapping_held(5);
  overlapping(6) <= overlapping_6_to_7_held_2(6);
  overlapping(7) <= overlapping_6_to_7_held_2(7);
  overlapping(8) <= overlapping_held(8);
end architecture rtl;
