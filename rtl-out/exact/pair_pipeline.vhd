-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, moments, fifteen determinants, the rule for pairs in one plane,
-- verdict; nothing is rounded. Units are shared over the phases of the slot. A value captured for the pair is named
-- after what it is; later copies end in _h<clocks>, or are elements of x_held.
-- Latency: 16 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    in_v        : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic := '0';
    separated   : out std_logic_vector(8 downto 0);
    overlapping : out std_logic_vector(8 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_v1_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal fitted : signed_18_vector_x5_t;  -- |.| <= 131071
  signal fit_outside : flag_vector_x5_t;
  signal difference_v2_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w0_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w1_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w2_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal outside_flags : unsigned(14 downto 0);
  signal outside_flags_h1 : unsigned(14 downto 0) := (others => '0');
  signal outside_i : std_logic;  -- a difference of coordinates does not fit
  signal fitted_d1 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal moment_component_lane : signed_36_x12_t;  -- |.| <= 34359214082
  signal moment_m0 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_m1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_m2 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal moment_n : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
  signal offset_m0 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_m1 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_m2 : signed_36_vector_t;  -- |.| <= 34359345154
  signal offset_n : signed_36_vector_t;  -- |.| <= 34359345154
  signal fitted_d2 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal fitted_d3 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal fitted_d4 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal offset_n_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal dot_lane : signed_57_x10_t;  -- |.| <= 13510541185384448
  signal determinant_plane_a0 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal offset_m0_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal dot_d1 : signed_57_x3_t := zero_signed_57_x3;  -- |.| <= 13510541185384448
  signal offset_m1_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal offset_m2_d1 : signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359345154
  signal determinant_plane_a1 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_plane_b0 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side20 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side21 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_side22 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal determinant_plane_a2 : signed(56 downto 0) := (others => '0');  -- |.| <= 13510541185384448
  signal of_sign : signed_60_x15_t;  -- |.| <= 54042164741537791
  signal determinant_side00 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side01 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side02 : signed(57 downto 0);  -- |.| <= 13510541185384448
  signal determinant_side10 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal determinant_side11 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal determinant_side12 : signed(58 downto 0);  -- |.| <= 54042164741537790
  signal sign : flag_x2_x15_t;
  signal of_sign_h1 : signed_60_4_to_11_t := zero_signed_60_4_to_11;  -- |.| <= 54042164741537791
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
  signal lines_apart : std_logic;
  signal lines_crosses : std_logic;
  signal lines_agree : std_logic;
  type sign_line_t is array (1 to 4) of flag_x2_x4_t;
  signal sign_line : sign_line_t := (others => zero_flag_x2_x4);
  signal sign_12_to_14_h4 : flag_x2_12_to_14_t := zero_flag_x2_12_to_14;
  signal sign_h1 : flag_x2_4_to_11_t := zero_flag_x2_4_to_11;
  signal edge_missed : std_logic_vector(5 downto 0);
  signal edge_hits : std_logic_vector(5 downto 0);
  signal edge_pierces : std_logic_vector(5 downto 0);
  type sign_h3_line_t is array (1 to 3) of flag_x2_12_to_14_t;
  signal sign_h3_line : sign_h3_line_t := (others => zero_flag_x2_12_to_14);
  signal inner : std_logic_vector(2 downto 0);
  signal skew_word_h1 : unsigned(17 downto 0) := (others => '0');
  signal skew : std_logic;  -- some side sign is not 0
  signal sign_h5 : flag_x2_x4_t := zero_flag_x2_x4;
  signal sign_h2 : flag_x2_4_to_5_t := zero_flag_x2_4_to_5;
  signal edge_missed_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal edge_hits_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal edge_pierces_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal inner_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal skew_h1 : std_logic := '0';
  signal lines_apart_h1 : std_logic := '0';
  signal lines_apart_h2 : std_logic := '0';
  signal lines_crosses_h1 : std_logic := '0';
  signal lines_crosses_h2 : std_logic := '0';
  signal lines_agree_h1 : std_logic := '0';
  signal lines_agree_h2 : std_logic := '0';
  signal outside_line : std_logic_vector(1 to 13) := (others => '0');
  signal fitted_unit_x : signed_33_vector_x5_t;
  signal moment_component_lane_unit_plus : signed_18_x2_x12_t;
  signal moment_component_lane_unit_minus : signed_18_x2_x12_t;
  signal dot_lane_unit_x : signed_18_vector_x10_t;
  signal dot_lane_unit_m : signed_36_vector_x10_t;
  signal of_sign_unit_a : signed_57_x3_t;
  signal of_sign_unit_d : signed_57_x3_x2_t;
  signal of_sign_unit_plane_b : signed_60_x2_t;
  signal of_sign_unit_side0 : signed_58_x3_t;
  signal of_sign_unit_side1 : signed_59_x3_t;
  signal sign_unit_x : signed_60_x15_t;
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
  signal edge_missed_unit_ends : flag_x2_x2_x6_t;
  signal edge_missed_unit_sides : flag_x2_x3_x6_t;
  signal inner_unit_plane_b : flag_x2_x3_t;
  signal inner_unit_side : flag_x2_x3_x3_t;
  signal verdict_unit_planes : flag_x2_x3_x2_t;
begin
  -- Clock 0
  difference_v1_each : for i in 0 to 2 generate
    difference_v1(i) <= resize(in_v(1)(i), 33) - resize(in_v(0)(i), 33);
    difference_v2(i) <= resize(in_v(2)(i), 33) - resize(in_v(0)(i), 33);
    difference_w0(i) <= resize(in_w(0)(i), 33) - resize(in_v(0)(i), 33);
    difference_w1(i) <= resize(in_w(1)(i), 33) - resize(in_v(0)(i), 33);
    difference_w2(i) <= resize(in_w(2)(i), 33) - resize(in_v(0)(i), 33);
  end generate difference_v1_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      difference_v1_h1 <= difference_v1;
      difference_v2_h1 <= difference_v2;
      difference_w0_h1 <= difference_w0;
      difference_w1_h1 <= difference_w1;
      difference_w2_h1 <= difference_w2;
    end if;
  end process clock_1;
  outside_flags <= unsigned(fit_outside(4)) & unsigned(fit_outside(3)) & unsigned(fit_outside(2)) &
      unsigned(fit_outside(1)) & unsigned(fit_outside(0));
  fitted_unit_x(0) <= difference_v1_h1;
  fitted_unit_x(1) <= difference_v2_h1;
  fitted_unit_x(2) <= difference_w0_h1;
  fitted_unit_x(3) <= difference_w1_h1;
  fitted_unit_x(4) <= difference_w2_h1;
  fitted_unit_of : for k in 0 to 4 generate
    fitted_unit : for i in 0 to 2 generate
      unit : entity work.difference_fit
        port map (x => fitted_unit_x(k)(i), fitted => fitted(k)(i), outside => fit_outside(k)(i));
    end generate fitted_unit;
  end generate fitted_unit_of;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      outside_flags_h1 <= outside_flags;
      fitted_d1 <= fitted;
    end if;
  end process clock_2;
  outside_i <= or_reduce(outside_flags_h1);
  moment_component_lane_unit_plus_0_each : for m in 0 to 1 generate
    moment_component_lane_unit_plus(0)(m) <= fitted_d1(m + 2)(m + 1);
    moment_component_lane_unit_plus(1)(m) <= fitted_d1(m + 2)((m + 2) mod 3);
    moment_component_lane_unit_plus(2)(m) <= fitted_d1(m + 2)(m);
    moment_component_lane_unit_plus(3)(m) <= fitted_d1(m + 3)(m + 1);
    moment_component_lane_unit_plus(4)(m) <= fitted_d1(m + 3)((m + 2) mod 3);
    moment_component_lane_unit_plus(5)(m) <= fitted_d1(m + 3)(m);
  end generate moment_component_lane_unit_plus_0_each;
  moment_component_lane_unit_plus_from_6_0_each : for k in 0 to 2 generate
    moment_component_lane_unit_plus(k + 6)(0) <= fitted_d1(4)((k + 1) mod 3);
    moment_component_lane_unit_plus(k + 6)(1) <= fitted_d1(2)((k + 2) mod 3);
  end generate moment_component_lane_unit_plus_from_6_0_each;
  moment_component_lane_unit_plus_9_each : for m in 0 to 1 generate
    moment_component_lane_unit_plus(9)(m) <= fitted_d1(m)(m + 1);
    moment_component_lane_unit_plus(10)(m) <= fitted_d1(m)((m + 2) mod 3);
    moment_component_lane_unit_plus(11)(m) <= fitted_d1(m)(m);
  end generate moment_component_lane_unit_plus_9_each;
  moment_component_lane_unit_minus_0_each : for k in 0 to 2 generate
    moment_component_lane_unit_minus(k)(0) <= fitted_d1(2)((k + 2) mod 3);
    moment_component_lane_unit_minus(k)(1) <= fitted_d1(3)((k + 1) mod 3);
    moment_component_lane_unit_minus(k + 3)(0) <= fitted_d1(3)((k + 2) mod 3);
    moment_component_lane_unit_minus(k + 3)(1) <= fitted_d1(4)((k + 1) mod 3);
    moment_component_lane_unit_minus(k + 6)(0) <= fitted_d1(4)((k + 2) mod 3);
    moment_component_lane_unit_minus(k + 6)(1) <= fitted_d1(2)((k + 1) mod 3);
    moment_component_lane_unit_minus(k + 9)(0) <= fitted_d1(0)((k + 2) mod 3);
    moment_component_lane_unit_minus(k + 9)(1) <= fitted_d1(1)((k + 1) mod 3);
  end generate moment_component_lane_unit_minus_0_each;
  moment_component_lane_unit : for k in 0 to 11 generate
    unit : entity work.cross_component
      port map (clk => clk, plus => moment_component_lane_unit_plus(k), minus => moment_component_lane_unit_minus(k),
                c => moment_component_lane(k));
  end generate moment_component_lane_unit;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      fitted_d2 <= fitted_d1;
    end if;
  end process clock_3;
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
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        moment_m0(i) <= moment_component_lane(i);
        moment_m1(i) <= moment_component_lane(i + 3);
        moment_m2(i) <= moment_component_lane(i + 6);
        moment_n(i) <= moment_component_lane(i + 9);
      end loop;
      fitted_d3 <= fitted_d2;
    end if;
  end process clock_4;
  offset_m0_each : for i in 0 to 2 generate
    offset_m0(i) <= moment_m0(i) + 131072;
    offset_m1(i) <= moment_m1(i) + 131072;
    offset_m2(i) <= moment_m2(i) + 131072;
    offset_n(i) <= moment_n(i) + 131072;
  end generate offset_m0_each;
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
      fitted_d4 <= fitted_d3;
      offset_n_d1 <= offset_n;
      offset_m0_d1 <= offset_m0;
      offset_m1_d1 <= offset_m1;
      offset_m2_d1 <= offset_m2;
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
  dot_lane_unit_x(0) <= fitted_d4(2);
  dot_lane_unit_x(1) <= fitted_d4(0);
  dot_lane_unit_x(2) <= fitted_d4(0);
  dot_lane_unit_x(3) <= fitted_d4(0);
  dot_lane_unit_x(4) <= fitted_d4(3);
  dot_lane_unit_x(5) <= fitted_d4(2);
  dot_lane_unit_x(6) <= fitted_d4(1);
  dot_lane_unit_x(7) <= fitted_d4(1);
  dot_lane_unit_x(8) <= fitted_d4(1);
  dot_lane_unit_x(9) <= fitted_d4(4);
  dot_lane_unit_m(0) <= offset_n_d1;
  dot_lane_unit_m(1) <= offset_m0_d1;
  dot_lane_unit_m(2) <= offset_m1_d1;
  dot_lane_unit_m(3) <= offset_m2_d1;
  dot_lane_unit_m(4) <= offset_n_d1;
  dot_lane_unit_m(5) <= offset_m1_d1;
  dot_lane_unit_m(6) <= offset_m0_d1;
  dot_lane_unit_m(7) <= offset_m1_d1;
  dot_lane_unit_m(8) <= offset_m2_d1;
  dot_lane_unit_m(9) <= offset_n_d1;
  box_lane_apart_unit_v_each_of : for k in 0 to 2 generate
    box_lane_apart_unit_v_each : for m in 0 to 1 generate
      box_lane_apart_unit_v(k)(m) <= fitted_d4(m)(k);
    end generate box_lane_apart_unit_v_each;
    box_lane_apart_unit_w_each : for m in 0 to 2 generate
      box_lane_apart_unit_w(k)(m) <= fitted_d4(m + 2)(k);
    end generate box_lane_apart_unit_w_each;
  end generate box_lane_apart_unit_v_each_of;
  dot_lane_unit : for k in 0 to 9 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;
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

  -- Clock 10
  clock_10 : process (clk)
  begin
    if rising_edge(clk) then
      determinant_plane_a0 <= dot_lane(0);
      for k in 0 to 2 loop
        dot_d1(k) <= dot_lane(k + 1);
      end loop;
      determinant_plane_a1 <= dot_lane(4);
      determinant_plane_b0 <= dot_lane(5);
      determinant_side20 <= dot_lane(6);
      determinant_side21 <= dot_lane(7);
      determinant_side22 <= dot_lane(8);
      determinant_plane_a2 <= dot_lane(9);
    end if;
  end process clock_10;
  of_sign(0) <= resize(determinant_plane_a0, 60);
  of_sign(1) <= resize(determinant_plane_a1, 60);
  of_sign(2) <= resize(determinant_plane_a2, 60);
  of_sign(3) <= resize(determinant_plane_b0, 60);
  of_sign(12) <= resize(determinant_side20, 60);
  of_sign(13) <= resize(determinant_side21, 60);
  of_sign(14) <= resize(determinant_side22, 60);
  of_sign_unit_a(0) <= determinant_plane_a0;
  of_sign_unit_a(1) <= determinant_plane_a1;
  of_sign_unit_a(2) <= determinant_plane_a2;
  of_sign_unit_d(0) <= dot_d1;
  of_sign_unit_d(1)(0) <= determinant_side20;
  of_sign_unit_d(1)(1) <= determinant_side21;
  of_sign_unit_d(1)(2) <= determinant_side22;
  of_sign_from_4_each : for k in 0 to 1 generate
    of_sign(k + 4) <= of_sign_unit_plane_b(k);
  end generate of_sign_from_4_each;
  determinant_side00 <= of_sign_unit_side0(0);
  determinant_side01 <= of_sign_unit_side0(1);
  determinant_side02 <= of_sign_unit_side0(2);
  determinant_side10 <= of_sign_unit_side1(0);
  determinant_side11 <= of_sign_unit_side1(1);
  determinant_side12 <= of_sign_unit_side1(2);
  sign_unit_x_each : for k in 0 to 3 generate
    sign_unit_x(k) <= of_sign(k);
  end generate sign_unit_x_each;
  sign_unit_x_each_2 : for k in 4 to 11 generate
    sign_unit_x(k) <= of_sign_h1(k);
  end generate sign_unit_x_each_2;
  sign_unit_x(12) <= of_sign(12);
  sign_unit_x(13) <= of_sign(13);
  sign_unit_x(14) <= of_sign(14);
  of_sign_unit : entity work.determinant_sums
    port map (clk => clk, a => of_sign_unit_a, d => of_sign_unit_d, v => determinant_plane_b0,
              plane_b => of_sign_unit_plane_b, side0 => of_sign_unit_side0, side1 => of_sign_unit_side1);
  sign_unit : for k in 0 to 14 generate
    unit : entity work.exact_sign
      port map (x => sign_unit_x(k), sign => sign(k));
  end generate sign_unit;

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
  of_sign(6) <= resize(determinant_side00, 60);
  of_sign(7) <= resize(determinant_side01, 60);
  of_sign(8) <= resize(determinant_side02, 60);
  of_sign(9) <= resize(determinant_side10, 60);
  of_sign(10) <= resize(determinant_side11, 60);
  of_sign(11) <= resize(determinant_side12, 60);

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 4 to 11 loop
        of_sign_h1(k) <= of_sign(k);
      end loop;
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

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      sign_12_to_14_h4 <= sign_h3_line(3);
      for k in 4 to 11 loop
        sign_h1(k) <= sign(k);
      end loop;
      skew_word_h1 <= unsigned(sign_h3_line(3)(14)) & unsigned(sign_h3_line(3)(13)) & unsigned(sign_h3_line(3)(12)) &
          unsigned(sign(11)) & unsigned(sign(10)) & unsigned(sign(9)) & unsigned(sign(8)) & unsigned(sign(7)) &
          unsigned(sign(6));
      lines_apart_h1 <= lines_apart;
      lines_crosses_h1 <= lines_crosses;
      lines_agree_h1 <= lines_agree;
    end if;
  end process clock_14;
  skew <= or_reduce(skew_word_h1);
  edge_missed_unit_ends(0)(0) <= sign_line(4)(3);
  edge_missed_unit_ends(0)(1) <= sign_h1(4);
  edge_missed_unit_ends_1_each : for m in 0 to 1 generate
    edge_missed_unit_ends(1)(m) <= sign_h1(m + 4);
  end generate edge_missed_unit_ends_1_each;
  edge_missed_unit_ends(2)(0) <= sign_h1(5);
  edge_missed_unit_ends(2)(1) <= sign_line(4)(3);
  edge_missed_unit_ends_3_each : for m in 0 to 1 generate
    edge_missed_unit_ends(3)(m) <= sign_line(4)(m);
    edge_missed_unit_ends(4)(m) <= sign_line(4)(m + 1);
  end generate edge_missed_unit_ends_3_each;
  edge_missed_unit_ends(5)(0) <= sign_line(4)(2);
  edge_missed_unit_ends(5)(1) <= sign_line(4)(0);
  edge_missed_unit_sides_0_each : for m in 0 to 2 generate
    edge_missed_unit_sides(0)(m) <= sign_h1(m + 6);
    edge_missed_unit_sides(1)(m) <= sign_h1(m + 9);
    edge_missed_unit_sides(2)(m) <= sign_12_to_14_h4(m + 12);
  end generate edge_missed_unit_sides_0_each;
  edge_missed_unit_sides_0_each_2 : for k in 3 to 5 generate
    edge_missed_unit_sides(k)(0) <= sign_h1(k + 3);
    edge_missed_unit_sides(k)(1) <= sign_h1(k + 6);
    edge_missed_unit_sides(k)(2) <= sign_12_to_14_h4(k + 9);
  end generate edge_missed_unit_sides_0_each_2;
  inner_unit_plane_b(0) <= sign_line(4)(3);
  inner_unit_plane_b(1) <= sign_h1(4);
  inner_unit_plane_b(2) <= sign_h1(5);
  inner_unit_side_0_each : for m in 0 to 2 generate
    inner_unit_side(0)(m) <= sign_h1(m + 6);
    inner_unit_side(1)(m) <= sign_h1(m + 9);
    inner_unit_side(2)(m) <= sign_12_to_14_h4(m + 12);
  end generate inner_unit_side_0_each;
  edge_missed_unit : for k in 0 to 5 generate
    unit : entity work.edge_verdict
      port map (ends => edge_missed_unit_ends(k), sides => edge_missed_unit_sides(k), missed => edge_missed(k),
                hits => edge_hits(k), pierces => edge_pierces(k));
  end generate edge_missed_unit;
  inner_unit : entity work.inner_side
    port map (plane_b => inner_unit_plane_b, side => inner_unit_side, inner => inner);

  -- Clock 15
  clock_15 : process (clk)
  begin
    if rising_edge(clk) then
      sign_h5 <= sign_line(4);
      for k in 4 to 5 loop
        sign_h2(k) <= sign_h1(k);
      end loop;
      edge_missed_h1 <= edge_missed;
      edge_hits_h1 <= edge_hits;
      edge_pierces_h1 <= edge_pierces;
      inner_h1 <= inner;
      skew_h1 <= skew;
      lines_apart_h2 <= lines_apart_h1;
      lines_crosses_h2 <= lines_crosses_h1;
      lines_agree_h2 <= lines_agree_h1;
    end if;
  end process clock_15;
  verdict_unit_planes_0_each : for m in 0 to 2 generate
    verdict_unit_planes(0)(m) <= sign_h5(m);
  end generate verdict_unit_planes_0_each;
  verdict_unit_planes(1)(0) <= sign_h5(3);
  verdict_unit_planes(1)(1) <= sign_h2(4);
  verdict_unit_planes(1)(2) <= sign_h2(5);
  verdict_unit : entity work.pair_verdict
    port map (clk => clk, planes => verdict_unit_planes, edges_missed => edge_missed_h1, edges_hits => edge_hits_h1,
              edges_pierces => edge_pierces_h1, inner => inner_h1, skew => skew_h1, plane_apart => lines_apart_h2,
              plane_crosses => lines_crosses_h2, plane_agree => lines_agree_h2, outside => outside_line(13),
              verdict => verdict, separated => separated, overlapping => overlapping);

  -- Clock 16
  clock_16 : process (clk)
  begin
    if rising_edge(clk) then
      outside <= outside_line(13);
    end if;
  end process clock_16;

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
      for k in 0 to 3 loop
        sign_line(1)(k) <= sign(k);
      end loop;
      sign_line(2 to 4) <= sign_line(1 to 3);
      for k in 12 to 14 loop
        sign_h3_line(1)(k) <= sign(k);
      end loop;
      sign_h3_line(2 to 3) <= sign_h3_line(1 to 2);
      outside_line <= outside_i & outside_line(1 to 12);
    end if;
  end process delays;
end architecture rtl;
