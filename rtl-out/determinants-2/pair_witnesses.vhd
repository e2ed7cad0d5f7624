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
    clk                   : in  std_logic;
    strobe                : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_0     : in  std_logic;
    outside               : in  std_logic;  -- a number of the pair or its pose is outside its declared range
    level                 : in  unsigned(2 downto 0);
    coordinate_w0_x_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w0_z_h6    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v1_x_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v1_z_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v2_x_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v2_z_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w1_x_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w2_x_h4    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w1_z_h6    : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w2_z_h6    : in  signed(17 downto 0);  -- |.| <= 131071
    compared              : in  signed_41_x15_t;  -- |.| <= 206156857344
    compared_bound        : in  signed_31_x15_t;  -- |.| <= 67665506
    coordinate_v1_y_h4_d1 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_v2_y_h4_d1 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w0_y_h4_d1 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w1_y_h4_d1 : in  signed(17 downto 0);  -- |.| <= 131071
    coordinate_w2_y_h4_d1 : in  signed(17 downto 0);  -- |.| <= 131071
    separated             : out std_logic_vector(8 downto 0);
    overlapping           : out std_logic_vector(8 downto 0);
    verdict               : out unsigned(1 downto 0)  -- 00 separate, 01 intersect, 10 possibly incorrect
  );
end entity pair_witnesses;

architecture rtl of pair_witnesses is
  constant boxes_wrong_table : numbers_t(0 to 7) := (1, 1, 2, 3, 5, 9, 17, others => 0);
  signal compared_held : signed_41_x15_t := zero_signed_41_x15;  -- |.| <= 206156857344; from clocks 30, 31, 32 on
  signal compared_bound_held : signed_31_x15_t := zero_signed_31_x15;  -- |.| <= 67665506; from clocks 30, 31, 32 on
  signal sign : flag_x2_x15_t;
  signal compared_bound_h3 : signed_31_6_to_8_t := zero_signed_31_6_to_8;  -- |.| <= 16916376
  signal boxes_v : signed_18_x2_t;  -- |.| <= 131071
  signal boxes_w : signed_18_x3_t;  -- |.| <= 131071
  signal boxes_v_d1 : signed_18_x2_t := zero_signed_18_x2;  -- |.| <= 131071
  signal boxes_w_d1 : signed_18_x3_t := zero_signed_18_x3;  -- |.| <= 131071
  signal boxes_wrong_d1 : unsigned(4 downto 0) := (others => '0');
  signal boxes_lane : std_logic_vector(1 downto 0);
  signal boxes_apart_along : std_logic_vector(2 downto 0) := (others => '0');
  signal boxes_apart : std_logic;
  signal sign_held : flag_x2_x15_t := zero_flag_x2_x15;  -- from clocks 32, 33 on
  signal separated_result : std_logic_vector(8 downto 3);
  signal overlapping_result : std_logic_vector(8 downto 3);
  signal sign_h3 : flag_x2_x3_t := zero_flag_x2_x3;
  signal sign_12_to_14_h3 : flag_x2_12_to_14_t := zero_flag_x2_12_to_14;
  signal overlapping_constant : std_logic_vector(2 downto 0);
  signal separated0_not_held : std_logic_vector(11 downto 0) := (others => '0');  -- from clocks 3, 5, ... 25 on
  signal separated_i : std_logic_vector(8 downto 0);
  signal separated_or_h1 : std_logic_vector(2 downto 1) := (others => '0');
  signal separated1_not_held : std_logic_vector(14 downto 0) := (others => '0');  -- from clocks 3, 5, ... 31 on
  signal separated_not_held : flag_2_to_8_x16_t := zero_flag_2_to_8_x16;  -- from clocks 3, 5, ... 33 on
  signal overlapping_i : std_logic_vector(8 downto 0);
  signal overlapping_not_held : flag_3_to_8_x16_t := zero_flag_3_to_8_x16;  -- from clocks 3, 5, ... 33 on
  signal separated0_held : std_logic_vector(4 downto 0) := (others => '0');  -- from clocks 26, 28, ... 34 on
  signal separated_held : std_logic_vector(8 downto 1) := (others => '0');  -- from clocks 33, 34 on
  signal separated1_h3 : std_logic := '0';
  signal overlapping_held : flag_x3_x16_t := zero_flag_x3_x16;  -- from clocks 3, 5, ... 33 on
  signal overlapping_h32 : std_logic_vector(2 downto 0) := (others => '0');
  signal overlapping_h1 : std_logic_vector(8 downto 3) := (others => '0');
  signal sign_unit_bound : signed_31_x15_t;
  signal boxes_lane_unit_v : signed_18_x2_x2_t;
  signal boxes_lane_unit_w : signed_18_x3_x2_t;
  signal separated_result_unit_ends : flag_x2_x2_3_to_8_t;
  signal separated_result_unit_sides : flag_x2_x3_3_to_8_t;
  signal verdict_unit_separated : std_logic_vector(8 downto 0);
  signal verdict_unit_overlapping : std_logic_vector(8 downto 0);
begin
  -- Constants
  overlapping_constant_each : for k in 0 to 2 generate
    overlapping_constant(k) <= '0';
  end generate overlapping_constant_each;

  -- Clock 2
  overlapping_i(0) <= overlapping_constant(0) and not outside;
  overlapping_i(1) <= overlapping_constant(1) and not outside;
  overlapping_i(2) <= overlapping_constant(2) and not outside;

  -- Clock 20
  boxes_v(0) <= coordinate_v1_z_h4 when row_m_select_at_0 = '1' else coordinate_v1_x_h4;
  boxes_v(1) <= coordinate_v2_z_h4 when row_m_select_at_0 = '1' else coordinate_v2_x_h4;
  boxes_w(0) <= coordinate_w0_z_h6 when row_m_select_at_0 = '1' else coordinate_w0_x_h4;
  boxes_w(1) <= coordinate_w1_z_h6 when row_m_select_at_0 = '1' else coordinate_w1_x_h4;
  boxes_w(2) <= coordinate_w2_z_h6 when row_m_select_at_0 = '1' else coordinate_w2_x_h4;

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      boxes_v_d1 <= boxes_v;
      boxes_w_d1 <= boxes_w;
      boxes_wrong_d1 <= to_unsigned(boxes_wrong_table(to_integer(known(level))), 5);
    end if;
  end process clock_21;
  boxes_lane_unit_v(0) <= boxes_v_d1;
  boxes_lane_unit_v(1)(0) <= coordinate_v1_y_h4_d1;
  boxes_lane_unit_v(1)(1) <= coordinate_v2_y_h4_d1;
  boxes_lane_unit_w(0) <= boxes_w_d1;
  boxes_lane_unit_w(1)(0) <= coordinate_w0_y_h4_d1;
  boxes_lane_unit_w(1)(1) <= coordinate_w1_y_h4_d1;
  boxes_lane_unit_w(1)(2) <= coordinate_w2_y_h4_d1;
  boxes_lane_unit : for k in 0 to 1 generate
    unit : entity work.boxes_axis
      port map (clk => clk, v => boxes_lane_unit_v(k), w => boxes_lane_unit_w(k), wrong => boxes_wrong_d1,
                apart => boxes_lane(k));
  end generate boxes_lane_unit;

  -- Clock 25
  boxes_apart <= or_reduce(unsigned(boxes_apart_along));
  separated_i(0) <= boxes_apart and separated0_not_held(11);

  -- Clock 30
  sign_unit_bound_each : for k in 0 to 5 generate
    sign_unit_bound(k) <= compared_bound_held(k);
  end generate sign_unit_bound_each;
  sign_unit_bound(6) <= compared_bound_h3(6);
  sign_unit_bound(7) <= compared_bound_h3(7);
  sign_unit_bound(8) <= compared_bound_h3(8);
  sign_unit_bound_each_2 : for k in 9 to 14 generate
    sign_unit_bound(k) <= compared_bound_held(k);
  end generate sign_unit_bound_each_2;
  sign_unit : for k in 0 to 14 generate
    unit : entity work.certain_sign
      port map (x => compared_held(k), bound => sign_unit_bound(k), sign => sign(k));
  end generate sign_unit;

  -- Clock 31
  separated_i(1) <= separated_or_h1(1) and separated1_not_held(14);

  -- Clock 33
  separated_i(2) <= separated_or_h1(2) and separated_not_held(15)(2);
  separated_i_each : for k in 3 to 8 generate
    separated_i(k) <= separated_result(k) and separated_not_held(15)(k);
    overlapping_i(k) <= overlapping_result(k) and overlapping_not_held(15)(k);
  end generate separated_i_each;
  separated_result_unit_ends_3_each : for m in 0 to 1 generate
    separated_result_unit_ends(3)(m) <= sign_held(m + 3);
    separated_result_unit_ends(4)(m) <= sign_held(m + 4);
  end generate separated_result_unit_ends_3_each;
  separated_result_unit_ends(5)(0) <= sign_held(5);
  separated_result_unit_ends(5)(1) <= sign_held(3);
  separated_result_unit_ends_6_each : for m in 0 to 1 generate
    separated_result_unit_ends(6)(m) <= sign_h3(m);
    separated_result_unit_ends(7)(m) <= sign_h3(m + 1);
    separated_result_unit_ends(8)(m) <= sign_h3((m + 2) mod 3);
  end generate separated_result_unit_ends_6_each;
  separated_result_unit_sides_3_each : for m in 0 to 2 generate
    separated_result_unit_sides(3)(m) <= sign_held(m + 6);
    separated_result_unit_sides(4)(m) <= sign_held(m + 9);
    separated_result_unit_sides(5)(m) <= sign_12_to_14_h3(m + 12);
  end generate separated_result_unit_sides_3_each;
  separated_result_unit_sides_0_each : for k in 6 to 8 generate
    separated_result_unit_sides(k)(0) <= sign_held(k);
    separated_result_unit_sides(k)(1) <= sign_held(k + 3);
    separated_result_unit_sides(k)(2) <= sign_12_to_14_h3(k + 6);
  end generate separated_result_unit_sides_0_each;
  separated_result_unit : for k in 3 to 8 generate
    unit : entity work.edge_verdict
      port map (ends => separated_result_unit_ends(k), sides => separated_result_unit_sides(k),
                missed => separated_result(k), pierces => overlapping_result(k));
  end generate separated_result_unit;

  -- Clock 34
  verdict_unit_separated(0) <= separated0_held(4);
  verdict_unit_separated(1) <= separated1_h3;
  verdict_unit_separated_each : for k in 2 to 8 generate
    verdict_unit_separated(k) <= separated_held(k);
  end generate verdict_unit_separated_each;
  verdict_unit_overlapping(0) <= overlapping_h32(0);
  verdict_unit_overlapping(1) <= overlapping_h32(1);
  verdict_unit_overlapping(2) <= overlapping_h32(2);
  verdict_unit_overlapping_each : for k in 3 to 8 generate
    verdict_unit_overlapping(k) <= overlapping_h1(k);
  end generate verdict_unit_overlapping_each;
  verdict_unit : entity work.pair_verdict
    port map (separated => verdict_unit_separated, overlapping => verdict_unit_overlapping, verdict => verdict);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        compared_held(0) <= compared(0);
        compared_held(1) <= compared(1);
        compared_held(2) <= compared(2);
        for k in 4 to 14 loop
          compared_held(k) <= compared(k);
        end loop;
        compared_bound_held(0) <= compared_bound(0);
        compared_bound_held(1) <= compared_bound(1);
        compared_bound_held(2) <= compared_bound(2);
        for k in 4 to 7 loop
          compared_bound_held(k) <= compared_bound(k);
        end loop;
        for k in 9 to 14 loop
          compared_bound_held(k) <= compared_bound(k);
        end loop;
        for k in 6 to 8 loop
          compared_bound_h3(k) <= compared_bound_held(k);
        end loop;
        boxes_apart_along(0) <= boxes_lane(0);
        boxes_apart_along(1) <= boxes_lane(1);
        sign_held(0) <= sign(0);
        sign_held(1) <= sign(1);
        sign_held(2) <= sign(2);
        sign_held(12) <= sign(12);
        sign_held(13) <= sign(13);
        sign_held(14) <= sign(14);
        separated0_held <= separated0_held(3 downto 0) & separated_i(0);
        for k in 2 to 8 loop
          separated_held(k) <= separated_i(k);
        end loop;
        separated1_h3 <= separated_held(1);
        overlapping_h32 <= overlapping_held(15);
        for k in 3 to 8 loop
          overlapping_h1(k) <= overlapping_i(k);
        end loop;
      end if;
      if strobe(0) = '1' then
        compared_held(3) <= compared(3);
        compared_bound_held(3) <= compared_bound(3);
        compared_bound_held(8) <= compared_bound(8);
        boxes_apart_along(2) <= boxes_lane(0);
        for k in 3 to 11 loop
          sign_held(k) <= sign(k);
        end loop;
        for k in 0 to 2 loop
          sign_h3(k) <= sign_held(k);
        end loop;
        for k in 12 to 14 loop
          sign_12_to_14_h3(k) <= sign_held(k);
        end loop;
        separated0_not_held <= separated0_not_held(10 downto 0) & not outside;
        separated_or_h1(1) <= (sign(0)(0) and sign(1)(0) and sign(2)(0)) or (sign(0)(1) and sign(1)(1) and sign(2)(1));
        separated_or_h1(2) <= (sign(3)(0) and sign(4)(0) and sign(5)(0)) or (sign(3)(1) and sign(4)(1) and sign(5)(1));
        separated1_not_held <= separated1_not_held(13 downto 0) & not outside;
        for m in 2 to 8 loop
          separated_not_held(0)(m) <= not outside;
        end loop;
        separated_not_held(1 to 15) <= separated_not_held(0 to 14);
        for m in 3 to 8 loop
          overlapping_not_held(0)(m) <= not outside;
        end loop;
        overlapping_not_held(1 to 15) <= overlapping_not_held(0 to 14);
        separated_held(1) <= separated_i(1);
        for m in 0 to 2 loop
          overlapping_held(0)(m) <= overlapping_i(m);
        end loop;
        overlapping_held(1 to 15) <= overlapping_held(0 to 14);
      end if;
    end if;
  end process captures;

  -- Outputs
  separated(0) <= separated0_held(4);
  separated(1) <= separated1_h3;
  separated_each : for k in 2 to 8 generate
    separated(k) <= separated_i(k);
  end generate separated_each;
  overlapping(0) <= overlapping_h32(0);
  overlapping(1) <= overlapping_h32(1);
  overlapping(2) <= overlapping_h32(2);
  overlapping_each : for k in 3 to 8 generate
    overlapping(k) <= overlapping_i(k);
  end generate overlapping_each;
end architecture rtl;
