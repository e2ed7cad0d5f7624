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
    clk              : in  std_logic;
    outside          : in  std_logic;  -- a number of the pair or its pose is outside its declared range
    level            : in  unsigned(2 downto 0);
    coordinate_w0_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    compared         : in  signed_41_x15_t;  -- |.| <= 206156857344
    compared_bound   : in  signed_31_x15_t;  -- |.| <= 67665506
    separated        : out std_logic_vector(8 downto 0);
    overlapping      : out std_logic_vector(8 downto 0);
    verdict          : out unsigned(1 downto 0)  -- 00 separate, 01 intersect, 10 possibly incorrect
  );
end entity pair_witnesses;

architecture rtl of pair_witnesses is
  constant boxes_wrong_table : numbers_t(0 to 7) := (1, 1, 2, 3, 5, 9, 17, others => 0);
  signal compared_0_to_3_h1 : signed_41_x4_t := zero_signed_41_x4;  -- |.| <= 51539214336
  signal compared_h1 : signed_41_4_to_11_t := zero_signed_41_4_to_11;  -- |.| <= 206156857344
  signal compared_12_to_14_h1 : signed_41_12_to_14_t := zero_signed_41_12_to_14;  -- |.| <= 51539214336
  signal compared_bound_h1 : signed_31_x3_t := zero_signed_31_x3;  -- |.| <= 16916376
  signal compared_bound_3_to_5_h1 : signed_31_3_to_5_t := zero_signed_31_3_to_5;  -- |.| <= 60980936
  signal compared_bound_9_to_11_h1 : signed_31_9_to_11_t := zero_signed_31_9_to_11;  -- |.| <= 67665506
  signal compared_bound_12_to_14_h1 : signed_31_12_to_14_t := zero_signed_31_12_to_14;  -- |.| <= 16916376
  signal sign : flag_x2_x15_t;
  signal compared3_h2 : signed(40 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal compared_bound_4_to_5_h2 : signed_31_4_to_5_t := zero_signed_31_4_to_5;  -- |.| <= 60980936
  signal compared_bound_h2 : signed_31_9_to_11_t := zero_signed_31_9_to_11;  -- |.| <= 67665506
  type compared_bound_line_t is array (1 to 3) of signed_31_6_to_8_t;
  signal compared_bound_line : compared_bound_line_t := (others => zero_signed_31_6_to_8);  -- |.| <= 16916376
  signal boxes_wrong_d1 : unsigned(4 downto 0) := (others => '0');
  signal boxes_lane : std_logic_vector(2 downto 0);
  signal boxes_apart_along : std_logic_vector(2 downto 0) := (others => '0');
  signal boxes_apart : std_logic;
  signal sign3_h1 : std_logic_vector(1 downto 0) := (others => '0');
  signal sign_h1 : flag_x2_4_to_11_t := zero_flag_x2_4_to_11;
  signal sign3_h2 : std_logic_vector(1 downto 0) := (others => '0');
  signal separated_result : std_logic_vector(8 downto 3);
  signal overlapping_result : std_logic_vector(8 downto 3);
  type sign_line_t is array (1 to 3) of flag_x2_x3_t;
  signal sign_line : sign_line_t := (others => zero_flag_x2_x3);
  type sign_12_to_14_line_t is array (1 to 3) of flag_x2_12_to_14_t;
  signal sign_12_to_14_line : sign_12_to_14_line_t := (others => zero_flag_x2_12_to_14);
  signal overlapping_constant : std_logic_vector(2 downto 0);
  signal separated0_not_line : std_logic_vector(1 to 16) := (others => '0');
  signal separated_i : std_logic_vector(8 downto 0);
  signal separated1_or_h1 : std_logic := '0';
  signal separated2_or_h1 : std_logic := '0';
  signal separated1_not_line : std_logic_vector(1 to 22) := (others => '0');
  type separated_not_line_t is array (1 to 24) of std_logic_vector(8 downto 2);
  signal separated_not_line : separated_not_line_t := (others => (others => '0'));
  signal overlapping_i : std_logic_vector(8 downto 0);
  type overlapping_not_line_t is array (1 to 24) of std_logic_vector(8 downto 3);
  signal overlapping_not_line : overlapping_not_line_t := (others => (others => '0'));
  signal separated0_line : std_logic_vector(1 to 9) := (others => '0');
  signal separated1_line : std_logic_vector(1 to 3) := (others => '0');
  signal separated_h1 : std_logic_vector(8 downto 2) := (others => '0');
  type overlapping_line_t is array (1 to 25) of std_logic_vector(2 downto 0);
  signal overlapping_line : overlapping_line_t := (others => (others => '0'));
  signal overlapping_h1 : std_logic_vector(8 downto 3) := (others => '0');
  signal sign_unit_x : signed_41_x15_t;
  signal sign_unit_bound : signed_31_x15_t;
  signal boxes_lane_unit_v : signed_18_x2_x3_t;
  signal boxes_lane_unit_w : signed_18_x3_x3_t;
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

  -- Clock 15
  clock_15 : process (clk)
  begin
    if rising_edge(clk) then
      boxes_wrong_d1 <= to_unsigned(boxes_wrong_table(to_integer(known(level))), 5);
    end if;
  end process clock_15;
  boxes_lane_unit_v_0_each : for k in 0 to 2 generate
    boxes_lane_unit_v(k)(0) <= coordinate_v1_d2(k);
    boxes_lane_unit_v(k)(1) <= coordinate_v2_d2(k);
    boxes_lane_unit_w(k)(0) <= coordinate_w0_d2(k);
    boxes_lane_unit_w(k)(1) <= coordinate_w1_d2(k);
    boxes_lane_unit_w(k)(2) <= coordinate_w2_d2(k);
  end generate boxes_lane_unit_v_0_each;
  boxes_lane_unit : for k in 0 to 2 generate
    unit : entity work.boxes_axis
      port map (clk => clk, v => boxes_lane_unit_v(k), w => boxes_lane_unit_w(k), wrong => boxes_wrong_d1,
                apart => boxes_lane(k));
  end generate boxes_lane_unit;

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      boxes_apart_along <= boxes_lane;
    end if;
  end process clock_18;
  boxes_apart <= or_reduce(unsigned(boxes_apart_along));
  separated_i(0) <= boxes_apart and separated0_not_line(16);

  -- Clock 23
  clock_23 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        compared_0_to_3_h1(k) <= compared(k);
      end loop;
      for k in 12 to 14 loop
        compared_12_to_14_h1(k) <= compared(k);
      end loop;
      for k in 0 to 2 loop
        compared_bound_h1(k) <= compared_bound(k);
      end loop;
      for k in 12 to 14 loop
        compared_bound_12_to_14_h1(k) <= compared_bound(k);
      end loop;
    end if;
  end process clock_23;
  sign_unit_x(0) <= compared_0_to_3_h1(0);
  sign_unit_x(1) <= compared_0_to_3_h1(1);
  sign_unit_x(2) <= compared_0_to_3_h1(2);
  sign_unit_x(3) <= compared3_h2;
  sign_unit_x_each : for k in 4 to 11 generate
    sign_unit_x(k) <= compared_h1(k);
  end generate sign_unit_x_each;
  sign_unit_x(12) <= compared_12_to_14_h1(12);
  sign_unit_x(13) <= compared_12_to_14_h1(13);
  sign_unit_x(14) <= compared_12_to_14_h1(14);
  sign_unit_bound(0) <= compared_bound_h1(0);
  sign_unit_bound(1) <= compared_bound_h1(1);
  sign_unit_bound(2) <= compared_bound_h1(2);
  sign_unit_bound(3) <= compared_bound_3_to_5_h1(3);
  sign_unit_bound(4) <= compared_bound_4_to_5_h2(4);
  sign_unit_bound(5) <= compared_bound_4_to_5_h2(5);
  sign_unit_bound(6) <= compared_bound_line(3)(6);
  sign_unit_bound(7) <= compared_bound_line(3)(7);
  sign_unit_bound(8) <= compared_bound_line(3)(8);
  sign_unit_bound(9) <= compared_bound_h2(9);
  sign_unit_bound(10) <= compared_bound_h2(10);
  sign_unit_bound(11) <= compared_bound_h2(11);
  sign_unit_bound(12) <= compared_bound_12_to_14_h1(12);
  sign_unit_bound(13) <= compared_bound_12_to_14_h1(13);
  sign_unit_bound(14) <= compared_bound_12_to_14_h1(14);
  sign_unit : for k in 0 to 14 generate
    unit : entity work.certain_sign
      port map (x => sign_unit_x(k), bound => sign_unit_bound(k), sign => sign(k));
  end generate sign_unit;

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 3 to 5 loop
        compared_bound_3_to_5_h1(k) <= compared_bound(k);
      end loop;
      for k in 9 to 11 loop
        compared_bound_9_to_11_h1(k) <= compared_bound(k);
      end loop;
      compared3_h2 <= compared_0_to_3_h1(3);
      separated1_or_h1 <= (sign(0)(0) and sign(1)(0) and sign(2)(0)) or (sign(0)(1) and sign(1)(1) and sign(2)(1));
    end if;
  end process clock_24;
  separated_i(1) <= separated1_or_h1 and separated1_not_line(22);

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 4 to 11 loop
        compared_h1(k) <= compared(k);
      end loop;
      for k in 4 to 5 loop
        compared_bound_4_to_5_h2(k) <= compared_bound_3_to_5_h1(k);
      end loop;
      compared_bound_h2 <= compared_bound_9_to_11_h1;
      sign3_h1 <= sign(3);
    end if;
  end process clock_25;

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 4 to 11 loop
        sign_h1(k) <= sign(k);
      end loop;
      sign3_h2 <= sign3_h1;
      separated2_or_h1 <= (sign3_h1(0) and sign(4)(0) and sign(5)(0)) or (sign3_h1(1) and sign(4)(1) and sign(5)(1));
    end if;
  end process clock_26;
  separated_i(2) <= separated2_or_h1 and separated_not_line(24)(2);
  separated_i_each : for k in 3 to 8 generate
    separated_i(k) <= separated_result(k) and separated_not_line(24)(k);
    overlapping_i(k) <= overlapping_result(k) and overlapping_not_line(24)(k);
  end generate separated_i_each;
  separated_result_unit_ends(3)(0) <= sign3_h2;
  separated_result_unit_ends(3)(1) <= sign_h1(4);
  separated_result_unit_ends_4_each : for m in 0 to 1 generate
    separated_result_unit_ends(4)(m) <= sign_h1(m + 4);
  end generate separated_result_unit_ends_4_each;
  separated_result_unit_ends(5)(0) <= sign_h1(5);
  separated_result_unit_ends(5)(1) <= sign3_h2;
  separated_result_unit_ends_6_each : for m in 0 to 1 generate
    separated_result_unit_ends(6)(m) <= sign_line(3)(m);
    separated_result_unit_ends(7)(m) <= sign_line(3)(m + 1);
    separated_result_unit_ends(8)(m) <= sign_line(3)((m + 2) mod 3);
  end generate separated_result_unit_ends_6_each;
  separated_result_unit_sides_3_each : for m in 0 to 2 generate
    separated_result_unit_sides(3)(m) <= sign_h1(m + 6);
    separated_result_unit_sides(4)(m) <= sign_h1(m + 9);
    separated_result_unit_sides(5)(m) <= sign_12_to_14_line(3)(m + 12);
  end generate separated_result_unit_sides_3_each;
  separated_result_unit_sides_0_each : for k in 6 to 8 generate
    separated_result_unit_sides(k)(0) <= sign_h1(k);
    separated_result_unit_sides(k)(1) <= sign_h1(k + 3);
    separated_result_unit_sides(k)(2) <= sign_12_to_14_line(3)(k + 6);
  end generate separated_result_unit_sides_0_each;
  separated_result_unit : for k in 3 to 8 generate
    unit : entity work.edge_verdict
      port map (ends => separated_result_unit_ends(k), sides => separated_result_unit_sides(k),
                missed => separated_result(k), pierces => overlapping_result(k));
  end generate separated_result_unit;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 2 to 8 loop
        separated_h1(k) <= separated_i(k);
      end loop;
      for k in 3 to 8 loop
        overlapping_h1(k) <= overlapping_i(k);
      end loop;
    end if;
  end process clock_27;
  verdict_unit_separated(0) <= separated0_line(9);
  verdict_unit_separated(1) <= separated1_line(3);
  verdict_unit_separated_each : for k in 2 to 8 generate
    verdict_unit_separated(k) <= separated_h1(k);
  end generate verdict_unit_separated_each;
  verdict_unit_overlapping(0) <= overlapping_line(25)(0);
  verdict_unit_overlapping(1) <= overlapping_line(25)(1);
  verdict_unit_overlapping(2) <= overlapping_line(25)(2);
  verdict_unit_overlapping_each : for k in 3 to 8 generate
    verdict_unit_overlapping(k) <= overlapping_h1(k);
  end generate verdict_unit_overlapping_each;
  verdict_unit : entity work.pair_verdict
    port map (separated => verdict_unit_separated, overlapping => verdict_unit_overlapping, verdict => verdict);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      for k in 6 to 8 loop
        compared_bound_line(1)(k) <= compared_bound(k);
      end loop;
      compared_bound_line(2 to 3) <= compared_bound_line(1 to 2);
      for k in 0 to 2 loop
        sign_line(1)(k) <= sign(k);
      end loop;
      sign_line(2 to 3) <= sign_line(1 to 2);
      for k in 12 to 14 loop
        sign_12_to_14_line(1)(k) <= sign(k);
      end loop;
      sign_12_to_14_line(2 to 3) <= sign_12_to_14_line(1 to 2);
      separated0_not_line <= not outside & separated0_not_line(1 to 15);
      separated1_not_line <= not outside & separated1_not_line(1 to 21);
      for k in 2 to 8 loop
        separated_not_line(1)(k) <= not outside;
      end loop;
      separated_not_line(2 to 24) <= separated_not_line(1 to 23);
      for k in 3 to 8 loop
        overlapping_not_line(1)(k) <= not outside;
      end loop;
      overlapping_not_line(2 to 24) <= overlapping_not_line(1 to 23);
      separated0_line <= separated_i(0) & separated0_line(1 to 8);
      separated1_line <= separated_i(1) & separated1_line(1 to 2);
      for k in 0 to 2 loop
        overlapping_line(1)(k) <= overlapping_i(k);
      end loop;
      overlapping_line(2 to 25) <= overlapping_line(1 to 24);
    end if;
  end process delays;

  -- Outputs
  separated(0) <= separated0_line(9);
  separated(1) <= separated1_line(3);
  separated_each : for k in 2 to 8 generate
    separated(k) <= separated_h1(k);
  end generate separated_each;
  overlapping(0) <= overlapping_line(25)(0);
  overlapping(1) <= overlapping_line(25)(1);
  overlapping(2) <= overlapping_line(25)(2);
  overlapping_each : for k in 3 to 8 generate
    overlapping(k) <= overlapping_h1(k);
  end generate overlapping_each;
end architecture rtl;
