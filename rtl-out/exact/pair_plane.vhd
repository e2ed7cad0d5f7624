-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 5: the rule for pairs in one plane.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_plane is
  port (
    clk           : in  std_logic;
    moment_m0     : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_m1     : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_m2     : in  signed_36_vector_t;  -- |.| <= 34359214082
    moment_n      : in  signed_36_vector_t;  -- |.| <= 34359214082
    fitted_d2     : in  signed_18_vector_x5_t;  -- |.| <= 131071
    fitted_d4     : in  signed_18_vector_x5_t;  -- |.| <= 131071
    lines_apart   : out std_logic;
    lines_crosses : out std_logic;
    lines_agree   : out std_logic
  );
end entity pair_plane;

architecture rtl of pair_plane is
  signal box_lane_apart : std_logic_vector(2 downto 0);
  signal box_lane_nearly_apart : std_logic_vector(2 downto 0);
  signal box_lane_with_0 : std_logic_vector(2 downto 0);
  signal box_lane_sides_a : std_logic_vector(2 downto 0);
  signal box_lane_sides_b : std_logic_vector(2 downto 0);
  signal box_apart : std_logic_vector(2 downto 0) := (others => '0');
  signal box_nearly_apart : std_logic_vector(2 downto 0) := (others => '0');
  signal box_with_0 : std_logic_vector(2 downto 0) := (others => '0');
  signal box_sides_a : std_logic_vector(2 downto 0) := (others => '0');
  signal box_sides_b : std_logic_vector(2 downto 0) := (others => '0');
  signal boxes_apart : std_logic;
  signal boxes_nearly_apart : std_logic;
  signal boxes_with_0 : std_logic;
  signal boxes_sides_a : std_logic;
  signal boxes_sides_b : std_logic;
  signal left_out : unsigned(1 downto 0);
  signal left_out_h1 : unsigned(1 downto 0) := (others => '0');
  signal lines : std_logic;
  signal moment_m0_h1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_c : signed_36_x4_t;  -- |.| <= 34359214082
  signal moment_m1_h1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_m2_h1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_n_h1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal v_in_plane : signed_18_x2_x2_t;  -- |.| <= 131071
  signal w_in_plane : signed_18_x2_x3_t;  -- |.| <= 131071
  signal first : signed_18_vector_x2_t;  -- |.| <= 131071
  signal first_h1 : signed_18_vector_x2_t := zero_signed_18_vector_x2;  -- |.| <= 131071
  signal cross_in_plane_plus_choice_d1 : signed_18_x2_x3_t := zero_signed_18_x2_x3;  -- |.| <= 131071
  signal cross_in_plane_minus_choice_d1 : signed_18_x2_x3_t := zero_signed_18_x2_x3;  -- |.| <= 131071
  signal cross_in_plane_lane : signed_36_x6_t;  -- |.| <= 34359214082
  signal component_c : signed_36_x6_t := zero_signed_36_x6;  -- |.| <= 34359214082
  signal v_in_plane1_d1 : signed_18_x2_t := zero_signed_18_x2;  -- |.| <= 131071
  signal w_in_plane_d1 : signed_18_x2_x3_t := zero_signed_18_x2_x3;  -- |.| <= 131071
  signal no_u : std_logic;
  type moment_c_line_t is array (1 to 3) of signed_36_x4_t;
  signal moment_c_line : moment_c_line_t := (others => zero_signed_36_x4);  -- |.| <= 34359214082
  signal by_edge : signed_38_x3_x6_t;  -- |.| <= 103077642246
  signal area : flag_x2_x2_t;
  signal by_edge_h1 : signed_38_x3_x6_t := zero_signed_38_x3_x6;  -- |.| <= 103077642246
  signal area_h1 : flag_x2_x2_t := zero_flag_x2_x2;
  signal parts : std_logic_vector(5 downto 0);
  signal nearly_parts : std_logic_vector(5 downto 0);
  signal lines_line : std_logic_vector(1 to 8) := (others => '0');
  signal no_u_line : std_logic_vector(1 to 5) := (others => '0');
  signal parts_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal nearly_parts_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal boxes_apart_line : std_logic_vector(1 to 6) := (others => '0');
  signal boxes_nearly_apart_line : std_logic_vector(1 to 6) := (others => '0');
  signal boxes_with_0_line : std_logic_vector(1 to 6) := (others => '0');
  signal boxes_sides_a_line : std_logic_vector(1 to 6) := (others => '0');
  signal boxes_sides_b_line : std_logic_vector(1 to 6) := (others => '0');
  signal area_h2 : flag_x2_x2_t := zero_flag_x2_x2;
  signal area_h3 : flag_x2_x2_t := zero_flag_x2_x2;
  signal box_lane_apart_unit_v : signed_18_x2_x3_t;
  signal box_lane_apart_unit_w : signed_18_x3_x3_t;
  signal left_out_unit_moments : signed_36_vector_x4_t;
  signal first_unit_x : signed_18_vector_x2_t;
  signal first_unit_y : signed_18_vector_x2_t;
  signal first_unit_z : signed_18_vector_x2_t;
  signal cross_in_plane_lane_unit_plus : signed_18_x2_x6_t;
  signal cross_in_plane_lane_unit_minus : signed_18_x2_x6_t;
  signal by_edge_unit_moment : signed_36_x3_t;
  signal by_edge_unit_x : signed_36_x3_x2_t;
  signal parts_unit_area : flag_x2_x6_t;
begin
  -- Clock 3
  first_unit_x(0) <= fitted_d2(0);
  first_unit_x(1) <= fitted_d2(2);
  first_unit_y(0) <= fitted_d2(1);
  first_unit_y(1) <= fitted_d2(3);
  first_unit_z(0) <= fitted_d2(1);
  first_unit_z(1) <= fitted_d2(4);
  first_unit : for k in 0 to 1 generate
    unit : entity work.first_point
      port map (clk => clk, x => first_unit_x(k), y => first_unit_y(k), z => first_unit_z(k), first => first(k));
  end generate first_unit;

  -- Clock 4
  left_out_unit_moments(0) <= moment_m0;
  left_out_unit_moments(1) <= moment_m1;
  left_out_unit_moments(2) <= moment_m2;
  left_out_unit_moments(3) <= moment_n;
  left_out_unit : entity work.left_out_coordinate
    port map (moments => left_out_unit_moments, left_out => left_out);

  -- Clock 5
  clock_5 : process (clk)
  begin
    if rising_edge(clk) then
      left_out_h1 <= left_out;
      moment_m0_h1 <= moment_m0;
      moment_m1_h1 <= moment_m1;
      moment_m2_h1 <= moment_m2;
      moment_n_h1 <= moment_n;
      first_h1 <= first;
    end if;
  end process clock_5;
  lines <= flag(known(left_out_h1) = 3);
  moment_c(0) <=
    moment_m0_h1(0) when known(left_out_h1) = 0 else
    moment_m0_h1(1) when known(left_out_h1) = 1 else
    moment_m0_h1(2) when known(left_out_h1) = 2 else
    moment_m0_h1(0);
  moment_c(1) <=
    moment_m1_h1(0) when known(left_out_h1) = 0 else
    moment_m1_h1(1) when known(left_out_h1) = 1 else
    moment_m1_h1(2) when known(left_out_h1) = 2 else
    moment_m1_h1(0);
  moment_c(2) <=
    moment_m2_h1(0) when known(left_out_h1) = 0 else
    moment_m2_h1(1) when known(left_out_h1) = 1 else
    moment_m2_h1(2) when known(left_out_h1) = 2 else
    moment_m2_h1(0);
  moment_c(3) <=
    moment_n_h1(0) when known(left_out_h1) = 0 else
    moment_n_h1(1) when known(left_out_h1) = 1 else
    moment_n_h1(2) when known(left_out_h1) = 2 else
    moment_n_h1(0);
  box_lane_apart_unit_v_each_of : for k in 0 to 2 generate
    box_lane_apart_unit_v_each : for m in 0 to 1 generate
      box_lane_apart_unit_v(k)(m) <= fitted_d4(m)(k);
    end generate box_lane_apart_unit_v_each;
    box_lane_apart_unit_w_each : for m in 0 to 2 generate
      box_lane_apart_unit_w(k)(m) <= fitted_d4(m + 2)(k);
    end generate box_lane_apart_unit_w_each;
  end generate box_lane_apart_unit_v_each_of;
  box_lane_apart_unit : for k in 0 to 2 generate
    unit : entity work.box_axis
      port map (clk => clk, v => box_lane_apart_unit_v(k), w => box_lane_apart_unit_w(k), apart => box_lane_apart(k),
                nearly_apart => box_lane_nearly_apart(k), with_0 => box_lane_with_0(k), sides_a => box_lane_sides_a(k),
                sides_b => box_lane_sides_b(k));
  end generate box_lane_apart_unit;
  v_in_plane_unit : for k in 0 to 1 generate
    unit : entity work.plane_coordinates
      port map (x => fitted_d4(k), left_out => left_out_h1, projected => v_in_plane(k));
  end generate v_in_plane_unit;
  w_in_plane_unit : for k in 0 to 2 generate
    unit : entity work.plane_coordinates
      port map (x => fitted_d4(k + 2), left_out => left_out_h1, projected => w_in_plane(k));
  end generate w_in_plane_unit;

  -- Clock 6
  clock_6 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 2 loop
        cross_in_plane_plus_choice_d1(k)(0) <= choose(lines, first_h1(0)((k + 1) mod 3), v_in_plane(0)(0));
        cross_in_plane_plus_choice_d1(k)(1) <= choose(lines, first_h1(1)((k + 2) mod 3), w_in_plane(k)(1));
        cross_in_plane_minus_choice_d1(k)(0) <= choose(lines, first_h1(0)((k + 2) mod 3), v_in_plane(0)(1));
        cross_in_plane_minus_choice_d1(k)(1) <= choose(lines, first_h1(1)((k + 1) mod 3), w_in_plane(k)(0));
      end loop;
      v_in_plane1_d1 <= v_in_plane(1);
      w_in_plane_d1 <= w_in_plane;
    end if;
  end process clock_6;
  cross_in_plane_lane_unit_plus(0) <= cross_in_plane_plus_choice_d1(0);
  cross_in_plane_lane_unit_plus(1) <= cross_in_plane_plus_choice_d1(1);
  cross_in_plane_lane_unit_plus(2) <= cross_in_plane_plus_choice_d1(2);
  cross_in_plane_lane_unit_plus_from_3_0_each : for k in 0 to 2 generate
    cross_in_plane_lane_unit_plus(k + 3)(0) <= v_in_plane1_d1(0);
    cross_in_plane_lane_unit_plus(k + 3)(1) <= w_in_plane_d1(k)(1);
  end generate cross_in_plane_lane_unit_plus_from_3_0_each;
  cross_in_plane_lane_unit_minus(0) <= cross_in_plane_minus_choice_d1(0);
  cross_in_plane_lane_unit_minus(1) <= cross_in_plane_minus_choice_d1(1);
  cross_in_plane_lane_unit_minus(2) <= cross_in_plane_minus_choice_d1(2);
  cross_in_plane_lane_unit_minus_from_3_0_each : for k in 0 to 2 generate
    cross_in_plane_lane_unit_minus(k + 3)(0) <= v_in_plane1_d1(1);
    cross_in_plane_lane_unit_minus(k + 3)(1) <= w_in_plane_d1(k)(0);
  end generate cross_in_plane_lane_unit_minus_from_3_0_each;
  cross_in_plane_lane_unit : for k in 0 to 5 generate
    unit : entity work.cross_component
      port map (clk => clk, plus => cross_in_plane_lane_unit_plus(k), minus => cross_in_plane_lane_unit_minus(k),
                c => cross_in_plane_lane(k));
  end generate cross_in_plane_lane_unit;

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      box_apart <= box_lane_apart;
      box_nearly_apart <= box_lane_nearly_apart;
      box_with_0 <= box_lane_with_0;
      box_sides_a <= box_lane_sides_a;
      box_sides_b <= box_lane_sides_b;
    end if;
  end process clock_7;
  boxes_apart <= or_reduce(unsigned(box_apart));
  boxes_nearly_apart <= or_reduce(unsigned(box_nearly_apart));
  boxes_with_0 <= box_with_0(0) and box_with_0(1) and box_with_0(2);
  boxes_sides_a <= or_reduce(unsigned(box_sides_a));
  boxes_sides_b <= or_reduce(unsigned(box_sides_b));

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      component_c <= cross_in_plane_lane;
    end if;
  end process clock_8;
  no_u <= not or_reduce(not flag(known(component_c(2)) = 0) & not flag(known(component_c(1)) = 0) & not
      flag(known(component_c(0)) = 0));
  by_edge_unit_moment_each : for k in 0 to 2 generate
    by_edge_unit_moment(k) <= moment_c_line(3)(k);
  end generate by_edge_unit_moment_each;
  by_edge_unit_x_0_each : for m in 0 to 2 generate
    by_edge_unit_x(0)(m) <= component_c(m);
    by_edge_unit_x(1)(m) <= component_c(m + 3);
  end generate by_edge_unit_x_0_each;
  by_edge_unit : entity work.plane_sums
    port map (clk => clk, moment => by_edge_unit_moment, n => moment_c_line(3)(3), x => by_edge_unit_x,
              sides => by_edge, area_sign => area);

  -- Clock 11
  clock_11 : process (clk)
  begin
    if rising_edge(clk) then
      by_edge_h1 <= by_edge;
      area_h1 <= area;
    end if;
  end process clock_11;
  parts_unit_area(0) <= area_h1(0);
  parts_unit_area(1) <= area_h1(0);
  parts_unit_area(2) <= area_h1(0);
  parts_unit_area(3) <= area_h1(1);
  parts_unit_area(4) <= area_h1(1);
  parts_unit_area(5) <= area_h1(1);
  parts_unit : for k in 0 to 5 generate
    unit : entity work.plane_edge
      port map (clk => clk, x => by_edge_h1(k), area => parts_unit_area(k), parts => parts(k),
                nearly => nearly_parts(k));
  end generate parts_unit;

  -- Clock 12
  clock_12 : process (clk)
  begin
    if rising_edge(clk) then
      area_h2 <= area_h1;
    end if;
  end process clock_12;

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      parts_h1 <= parts;
      nearly_parts_h1 <= nearly_parts;
      area_h3 <= area_h2;
    end if;
  end process clock_13;
  lines_apart_unit : entity work.plane_verdict
    port map (lines => lines_line(8), no_u => no_u_line(5), parts => parts_h1, nearly => nearly_parts_h1,
              boxes_apart => boxes_apart_line(6), boxes_nearly_apart => boxes_nearly_apart_line(6),
              boxes_with_0 => boxes_with_0_line(6), boxes_sides_a => boxes_sides_a_line(6),
              boxes_sides_b => boxes_sides_b_line(6), areas => area_h3, apart => lines_apart, crosses => lines_crosses,
              agree => lines_agree);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      moment_c_line <= moment_c & moment_c_line(1 to 2);
      lines_line <= lines & lines_line(1 to 7);
      no_u_line <= no_u & no_u_line(1 to 4);
      boxes_apart_line <= boxes_apart & boxes_apart_line(1 to 5);
      boxes_nearly_apart_line <= boxes_nearly_apart & boxes_nearly_apart_line(1 to 5);
      boxes_with_0_line <= boxes_with_0 & boxes_with_0_line(1 to 5);
      boxes_sides_a_line <= boxes_sides_a & boxes_sides_a_line(1 to 5);
      boxes_sides_b_line <= boxes_sides_b & boxes_sides_b_line(1 to 5);
    end if;
  end process delays;
end architecture rtl;
