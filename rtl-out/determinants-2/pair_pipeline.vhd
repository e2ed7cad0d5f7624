-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with
-- bounds on their errors, verdict. Units are shared over the phases of the slot. A value captured for the pair is
-- named after what it is; later copies end in _h<clocks>, or are elements of x_held.
-- Latency: 35 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    phase       : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(17 downto 0);  -- whether the slot k slots ago holds a pair
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic := '0';
    separated   : out std_logic_vector(8 downto 0);
    overlapping : out std_logic_vector(8 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  constant axis_level_0_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_1_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant axis_level_2_table : numbers_t(0 to 31) := (0, 0, 0, 3, 0, 1, 0, 5, 0, 0, 0, 4, 0, 2, 0, 6, 0, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 3, 0, 1, 0, 5);
  constant boxes_wrong_table : numbers_t(0 to 7) := (1, 1, 2, 3, 5, 9, 17, others => 0);
  signal in_v_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal in_v_outside : flag_x3_x3_t;
  signal in_w_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal in_w_outside : flag_x3_x3_t;
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 536870912
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 536870912
  signal in_phase_1 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(1 downto 0) := (others => '0');  -- one flag per phase
  signal pose_t_inside_number_h1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 2147483648
  signal pose_t_inside : signed_32_x3_t;  -- |.| <= 1073741816
  signal pose_t_outside : std_logic_vector(2 downto 0);
  signal moved : signed_33_vector_t;  -- |.| <= 1342177272; t - V0, or - V0 with the bypass
  signal pose_m_inside_number_h1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- s4.28; |.| <= 2147483648
  signal pose_m_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_m_outside : flag_x3_x3_t;
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
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 2147483644
  signal outside_flags : unsigned(29 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  signal difference_v1_held : signed_33_vector_x5_t := zero_signed_33_vector_x5;  -- |.| <= 536870912; from clocks 3, 5, ... 11 on
  signal difference_v1_h9 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 536870912
  signal difference_v2_held : signed_33_vector_x5_t := zero_signed_33_vector_x5;  -- |.| <= 536870912; from clocks 3, 5, ... 11 on
  signal difference_v2_h9 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 536870912
  signal shift : flag_x4_vector_t;
  signal difference_w1_h2 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal lane : signed_33_vector_x2_t;  -- |.| <= 2147483644
  signal shift_held : flag_x4_vector_x2_t := zero_flag_x4_vector_x2;  -- from clocks 13, 15 on
  signal lane_d1 : signed_33_vector_x2_t := zero_signed_33_vector_x2;  -- |.| <= 2147483644
  signal lane_shifted : signed_19_vector_x3_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal difference_w2_x_held : signed_33_x2_t := zero_signed_33_x2;  -- |.| <= 2147483644; from clocks 11, 13 on
  signal difference_w2_z_held : signed_33_x2_t := zero_signed_33_x2;  -- |.| <= 2147483644; from clocks 11, 13 on
  signal difference_w2_y_h2 : signed(32 downto 0) := (others => '0');  -- |.| <= 2147483644
  signal difference_w0_h2 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal difference_w0_h2_d1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 2147483644
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_held : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144; from clock 16 on
  signal coordinate_cut_h3 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 262144
  signal carried_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal carried_h2 : std_logic_vector(2 downto 0) := (others => '0');
  signal coordinate_v1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_v2 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w0 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w2 : signed_18_vector_t;  -- |.| <= 131071
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
  signal level_less_held : std_logic_vector(1 downto 0) := (others => '0');  -- from clocks 19, 21 on
  signal axis_level0_resized_less_choice_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 18, 20 on
  signal axis_level0_resized_less_choice_h5 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 18, 20 on
  signal axis_level2_h5 : unsigned(2 downto 0) := (others => '0');
  signal level : unsigned(2 downto 0);
  signal moment_plus : signed_18_x2_x6_t;  -- |.| <= 131071
  signal moment_minus : signed_18_x2_x6_t;  -- |.| <= 131071
  signal moment_plus_d1 : signed_18_x2_x6_t := zero_signed_18_x2_x6;  -- |.| <= 131071
  signal moment_minus_d1 : signed_18_x2_x6_t := zero_signed_18_x2_x6;  -- |.| <= 131071
  signal moment_lane_cut : signed_20_x6_t;  -- |.| <= 524281
  signal moment_too_great0 : std_logic_vector(5 downto 0);
  signal moment_cut : signed_20_x12_t := zero_signed_20_x12;  -- |.| <= 524281
  signal too_great_0_found : std_logic;
  signal too_great_0_found_d1 : std_logic := '0';
  signal too_great_0_so_far_select_at_0 : std_logic := '0';
  signal too_great_0_so_far_before : std_logic := '0';
  signal too_great_0_so_far : std_logic;
  signal places_captured : std_logic := '0';
  signal places : std_logic;
  signal moment_exact : signed_20_vector_x2_t;  -- |.| <= 524281
  signal moment_exact_d1 : signed_20_vector_x2_t := zero_signed_20_vector_x2;  -- |.| <= 524281
  signal moment_lane : signed_18_vector_x2_t;  -- |.| <= 131072
  signal moment_m0 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_m2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_m1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_n : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal coordinate_w0_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 18, 20, ... 24 on
  signal moment_m1_h2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_m : signed_18_vector_t;  -- |.| <= 131072
  signal coordinate_w0_h8_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w0_h8_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal dot_m_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_lane : signed_38_x5_t;  -- |.| <= 51539214336
  signal determinant_plane_a0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_b0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal coordinate_v1_held : signed_18_vector_x3_t := zero_signed_18_vector_x3;  -- |.| <= 131071; from clocks 19, 21, 23 on
  signal coordinate_v2_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 19, 21, ... 25 on
  signal dot_x : signed_18_vector_1_to_4_t;  -- |.| <= 131071
  signal dot_x_d1 : signed_18_vector_1_to_4_t := zero_signed_18_vector_1_to_4;  -- |.| <= 131071
  signal moment_m0_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal determinant_side20 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal moment_m1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal determinant_side21 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_x_d2 : signed_18_vector_3_to_4_t := zero_signed_18_vector_3_to_4;  -- |.| <= 131071
  signal moment_m2_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal determinant_side22 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal coordinate_w1_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 18, 20, ... 24 on
  signal coordinate_w2_held : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071; from clocks 18, 20, ... 24 on
  signal moment_n_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal determinant_plane_a1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_a2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_d1_h2 : signed_38_x2_t := zero_signed_38_x2;  -- |.| <= 51539214336
  signal compared : signed_41_x15_t;  -- |.| <= 206156857344
  signal determinant_side00 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side01 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side02 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side10 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side11 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side12 : signed(39 downto 0);  -- |.| <= 206156857344
  signal coordinate_v2_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_h1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal e_a1 : signed_19_vector_t;  -- |.| <= 262142
  signal coordinate_w1_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w0_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal e_b : signed_19_vector_x3_t;  -- |.| <= 262142
  signal coordinate_w2_h3 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal norm_x0_resized_third_h2 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 131071
  signal norm_x : signed_19_vector_x4_t;  -- |.| <= 262142
  signal norm_x_d1 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 262142
  signal norm_x2_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal norm_x3_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal norm_lane : unsigned_21_x5_t;
  signal length_measure : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal norm_x_resized_h2 : signed_19_vector_3_to_4_t := zero_signed_19_vector_3_to_4;  -- |.| <= 131071
  signal norm_x4_resized_h2_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 131071
  signal rest_of_level : unsigned(14 downto 0);
  signal rest_of_level_aligned : unsigned(15 downto 0);
  signal rest_aligned_second_h2 : unsigned(16 downto 0) := (others => '0');
  signal rest_of_level_aligned_h2 : unsigned(15 downto 0) := (others => '0');
  signal rest : unsigned(16 downto 0);  -- c(3); four times that is c(5)
  signal length_measure_h2 : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal length_measure_h4 : unsigned_21_x9_t := zero_unsigned_21_x9;
  signal length_measure_held : unsigned_21_x6_t := zero_unsigned_21_x6;  -- from clock 27 on
  signal length_measure_7_to_8_held : unsigned_21_7_to_8_t := zero_unsigned_21_7_to_8;  -- from clock 27 on
  signal rest_held : unsigned_17_x2_t := zero_unsigned_17_x2;  -- from clocks 25, 27 on
  signal length_measure0_plane_a0 : unsigned(23 downto 0);
  signal bound_plane_a1_sum_first_result : unsigned(23 downto 0);
  signal bound_plane_a2_sum_first_result : unsigned(23 downto 0);
  signal bound_plane_b1_result : unsigned(26 downto 0);
  signal bound_plane_b2_result : unsigned(26 downto 0);
  signal length_measure0_ends0 : unsigned(23 downto 0);
  signal length_measure0_ends1 : unsigned(23 downto 0);
  signal bound_side10_result : unsigned(24 downto 0);
  signal bound_side11_result : unsigned(24 downto 0);
  signal bound_side12_result : unsigned(24 downto 0);
  signal length_x : unsigned_21_x4_t;
  signal places_d1 : std_logic := '0';
  signal places_d2 : std_logic := '0';
  signal length_times_g : unsigned_22_x5_t;
  signal level_held : unsigned_3_x2_t := zero_unsigned_3_x2;  -- from clocks 23, 25 on
  signal length_times_g_d1 : unsigned_22_x5_t := zero_unsigned_22_x5;
  signal level_h4_d1 : unsigned(2 downto 0) := (others => '0');
  signal length_first : unsigned_29_x5_t;
  signal length_bound : unsigned_29_x9_t := zero_unsigned_29_x9;
  signal moment_norm_x : signed_18_vector_x2_t;  -- |.| <= 131072
  signal moment_norm_x_d1 : signed_18_vector_x2_t := zero_signed_18_vector_x2;  -- |.| <= 131072
  signal moment_norm_lane : unsigned_20_x2_t;
  signal norm_of_moment : unsigned_20_x4_t := zero_unsigned_20_x4;
  signal moment_measure : unsigned_21_x4_t;
  signal moment_x : unsigned_21_x2_t;
  signal moment_x_d1 : unsigned_21_x2_t := zero_unsigned_21_x2;
  signal level_h4_d2 : unsigned(2 downto 0) := (others => '0');
  signal level_h4_d3 : unsigned(2 downto 0) := (others => '0');
  signal moment_first : unsigned_28_x2_t;
  signal moment_bound : unsigned_28_x4_t := zero_unsigned_28_x4;
  signal face_of_vertex_negative_difference : signed_30_x3_x2_t;  -- |.| <= 53476968
  signal face_of_vertex : unsigned_29_x3_x2_t;
  signal bound_all_m : unsigned(29 downto 0);
  signal length_measure0_plane_a0_h2 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex_h1 : unsigned_29_x3_x2_t := zero_unsigned_29_x3_x2;
  signal bound_plane_a0_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a0 : unsigned(30 downto 0);
  signal bound_plane_a1_sum_first_result_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a1_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a1 : unsigned(30 downto 0);
  signal bound_plane_a2_sum_first_result_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a2_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a2 : unsigned(30 downto 0);
  signal bound_corner_aligned_h1 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h2 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner_sum_h3 : unsigned(30 downto 0) := (others => '0');
  signal bound_corner : unsigned(31 downto 0);
  signal bound_all_m_h1 : unsigned(29 downto 0) := (others => '0');
  signal length_measure0_plane_a0_h3 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_b0 : unsigned(30 downto 0);
  signal bound_plane_b1_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1 : unsigned(32 downto 0);
  signal bound_plane_b2_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2_result_h3 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2 : unsigned(32 downto 0);
  signal bound_of_a_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a : unsigned(30 downto 0);
  signal length_measure0_ends0_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_side00_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side00 : unsigned(30 downto 0);
  signal bound_side01_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side01 : unsigned(30 downto 0);
  signal bound_side02_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side02 : unsigned(30 downto 0);
  signal bound_side10_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side10_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10 : unsigned(32 downto 0);
  signal bound_side11_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side11_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11 : unsigned(32 downto 0);
  signal bound_side12_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side12_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12_result_h3 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12 : unsigned(32 downto 0);
  signal length_measure0_ends1_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_side20_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side20 : unsigned(30 downto 0);
  signal bound_side21_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side21 : unsigned(30 downto 0);
  signal bound_side22_sum_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side22 : unsigned(30 downto 0);
  signal compared_bound : signed_31_x15_t;  -- |.| <= 67665506
  signal compared_held : signed_41_x15_t := zero_signed_41_x15;  -- |.| <= 206156857344; from clocks 31, 32, 33 on
  signal compared_bound_held : signed_31_x15_t := zero_signed_31_x15;  -- |.| <= 67665506; from clocks 31, 32, 33 on
  signal sign : flag_x2_x15_t;
  signal compared_bound_h3 : signed_31_6_to_8_t := zero_signed_31_6_to_8;  -- |.| <= 16916376
  signal boxes_v : signed_18_x2_t;  -- |.| <= 131071
  signal boxes_w : signed_18_x3_t;  -- |.| <= 131071
  signal boxes_v_d1 : signed_18_x2_t := zero_signed_18_x2;  -- |.| <= 131071
  signal boxes_w_d1 : signed_18_x3_t := zero_signed_18_x3;  -- |.| <= 131071
  signal boxes_wrong_d1 : unsigned(4 downto 0) := (others => '0');
  signal boxes_lane : std_logic_vector(1 downto 0);
  signal boxes_apart_along : std_logic_vector(2 downto 0) := (others => '0');
  signal coordinate_v1_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_v2_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w0_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w1_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal coordinate_w2_y_h4_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131071
  signal boxes_apart : std_logic;
  signal sign_held : flag_x2_x15_t := zero_flag_x2_x15;  -- from clocks 33, 34 on
  signal separated_result : std_logic_vector(8 downto 3);
  signal overlapping_result : std_logic_vector(8 downto 3);
  signal sign_h3 : flag_x2_x3_t := zero_flag_x2_x3;
  signal sign_12_to_14_h3 : flag_x2_12_to_14_t := zero_flag_x2_12_to_14;
  signal overlapping_constant : std_logic_vector(2 downto 0);
  signal separated0_not_held : std_logic_vector(11 downto 0) := (others => '0');  -- from clocks 3, 5, ... 25 on
  signal separated_not_held_2 : std_logic_vector(8 downto 0) := (others => '0');  -- from clocks 26, 32, 34 on
  signal separated_i : std_logic_vector(8 downto 0);
  signal separated_or_h1 : std_logic_vector(2 downto 1) := (others => '0');
  signal separated1_not_held : std_logic_vector(14 downto 0) := (others => '0');  -- from clocks 3, 5, ... 31 on
  signal separated_not_held : flag_2_to_8_x16_t := zero_flag_2_to_8_x16;  -- from clocks 3, 5, ... 33 on
  signal overlapping_i : std_logic_vector(8 downto 0);
  signal overlapping_not_held : flag_3_to_8_x16_t := zero_flag_3_to_8_x16;  -- from clocks 3, 5, ... 33 on
  signal overlapping_not_h32 : std_logic_vector(8 downto 3) := (others => '0');
  signal separated0_held : std_logic_vector(4 downto 0) := (others => '0');  -- from clocks 27, 29, ... 35 on
  signal separated_held : std_logic_vector(8 downto 1) := (others => '0');  -- from clocks 34, 35 on
  signal separated1_h3 : std_logic := '0';
  signal overlapping_held : flag_x3_x17_t := zero_flag_x3_x17;  -- from clocks 3, 5, ... 35 on
  signal overlapping_h1 : std_logic_vector(8 downto 3) := (others => '0');
  signal outside_held : std_logic_vector(15 downto 0) := (others => '0');  -- from clocks 3, 5, ... 33 on
  signal in_phase_0 : std_logic;
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
  signal busy_20 : std_logic := '0';  -- set in clocks 19 to 20 of a pair
  signal row_turned_unit_m : signed_32_vector_x5_t;
  signal row_turned_unit_w : signed_32_vector_x5_t;
  signal shift_unit_x : signed_33_x5_vector_t;
  signal lane_shifted_unit_x : signed_33_vector_x3_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
  signal dot_lane_unit_x : signed_18_vector_x5_t;
  signal dot_lane_unit_m : signed_18_vector_x5_t;
  signal compared_unit_a : signed_38_x3_t;
  signal compared_unit_d : signed_38_x3_x2_t;
  signal compared_unit_plane_b : signed_41_x2_t;
  signal compared_unit_side0 : signed_39_x3_t;
  signal compared_unit_side1 : signed_40_x3_t;
  signal norm_lane_unit_x : signed_19_vector_x5_t;
  signal length_measure0_plane_a0_unit_v : unsigned_21_x2_t;
  signal length_measure0_plane_a0_unit_w : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_b : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_plane_a : unsigned_24_x3_t;
  signal length_measure0_plane_a0_unit_plane_b : unsigned_27_x2_t;
  signal length_measure0_plane_a0_unit_ends : unsigned_24_x2_t;
  signal length_measure0_plane_a0_unit_middle : unsigned_25_x3_t;
  signal sign_unit_bound : signed_31_x15_t;
  signal boxes_lane_unit_v : signed_18_x2_x2_t;
  signal boxes_lane_unit_w : signed_18_x3_x2_t;
  signal separated_result_unit_ends : flag_x2_x2_3_to_8_t;
  signal separated_result_unit_sides : flag_x2_x3_3_to_8_t;
  signal verdict_unit_separated : std_logic_vector(8 downto 0);
  signal verdict_unit_overlapping : std_logic_vector(8 downto 0);
begin
  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      strobe(0) <= flag(phase = '1') and in_flight;
      strobe(1) <= flag(phase = '0') and in_flight;
    end if;
  end process strobes;
  in_phase_1 <= flag(phase = '1');
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or holds(5) or holds(6) or holds(7) or holds(8)
      or holds(9) or holds(10) or holds(11) or holds(12) or holds(13) or holds(14) or holds(15) or holds(16) or
      holds(17) or in_phase_1;
  overlapping_constant_each : for k in 0 to 2 generate
    overlapping_constant(k) <= '0';
  end generate overlapping_constant_each;
  in_phase_0 <= flag(phase = '0');
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
  outside_flags <= unsigned(pose_m_outside(2)) & unsigned(pose_m_outside(1)) & unsigned(pose_m_outside(0)) &
      unsigned(pose_t_outside) & unsigned(in_w_outside(2)) & unsigned(in_w_outside(1)) & unsigned(in_w_outside(0)) &
      unsigned(in_v_outside(2)) & unsigned(in_v_outside(1)) & unsigned(in_v_outside(0));
  outside_i <= or_reduce(outside_flags);
  overlapping_i(0) <= overlapping_constant(0) and not outside_i;
  overlapping_i(1) <= overlapping_constant(1) and not outside_i;
  overlapping_i(2) <= overlapping_constant(2) and not outside_i;

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
  shift_unit_x_0_each : for i in 0 to 2 generate
    shift_unit_x(i)(0) <= difference_v1_h9(i);
    shift_unit_x(i)(1) <= difference_v2_h9(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate shift_unit_x_0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 12
  lane(0) <= difference_w1_h2 when row_m0_select_at_0 = '1' else difference_v1_held(4);
  lane(1)(0) <= difference_w2_x_held(1) when row_m0_select_at_0 = '1' else difference_v2_held(4)(0);
  lane(1)(1) <= difference_w2_y_h2 when row_m0_select_at_0 = '1' else difference_v2_held(4)(1);
  lane(1)(2) <= difference_w2_z_held(1) when row_m0_select_at_0 = '1' else difference_v2_held(4)(2);

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      lane_d1 <= lane;
      difference_w0_h2_d1 <= difference_w0_h2;
    end if;
  end process clock_13;
  lane_shifted_unit_x(0) <= lane_d1(0);
  lane_shifted_unit_x(1) <= lane_d1(1);
  lane_shifted_unit_x(2) <= difference_w0_h2_d1;
  lane_shifted_unit : for k in 0 to 2 generate
    unit : entity work.coordinate_scale
      port map (x => lane_shifted_unit_x(k), shift => shift_held(0), cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 15
  taken_x <= carried(0) & unsigned(shift_held(1)(0));
  taken_y <= carried(1) & unsigned(shift_held(1)(1));
  taken_z <= carried(2) & unsigned(shift_held(1)(2));
  carried_unit_cut_each_of : for i in 0 to 2 generate
    carried_unit_cut_each : for k in 0 to 4 generate
      carried_unit_cut(i)(k) <= coordinate_cut(k)(i);
    end generate carried_unit_cut_each;
  end generate carried_unit_cut_each_of;
  carried_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_carry
      port map (cut => carried_unit_cut(i), carried => carried(i));
  end generate carried_unit;

  -- Clock 16
  axis_level(0) <= to_unsigned(axis_level_0_table(to_integer(known(taken_x_h1))), 3);
  axis_level(1) <= to_unsigned(axis_level_1_table(to_integer(known(taken_y_h1))), 3);
  axis_level(2) <= to_unsigned(axis_level_2_table(to_integer(known(taken_z_h1))), 3);
  axis_level0_resized_less_choice <= axis_level(1) when
      less(signed(resize(axis_level(0), 4)), signed(resize(axis_level(1), 4))) = '1' else axis_level(0);
  moment_plus_0_each : for k in 0 to 2 generate
    moment_plus(k)(0) <= coordinate_w2((k + 1) mod 3) when row_m0_select_at_0 = '1' else coordinate_w0((k + 1) mod 3);
    moment_plus(k)(1) <= coordinate_w0((k + 2) mod 3) when row_m0_select_at_0 = '1' else coordinate_w1((k + 2) mod 3);
    moment_plus(k + 3)(0) <= coordinate_v1((k + 1) mod 3) when row_m0_select_at_0 = '1' else
        coordinate_w1((k + 1) mod 3);
    moment_plus(k + 3)(1) <= coordinate_v2((k + 2) mod 3) when row_m0_select_at_0 = '1' else
        coordinate_w2((k + 2) mod 3);
    moment_minus(k)(0) <= coordinate_w2((k + 2) mod 3) when row_m0_select_at_0 = '1' else coordinate_w0((k + 2) mod 3);
    moment_minus(k)(1) <= coordinate_w0((k + 1) mod 3) when row_m0_select_at_0 = '1' else coordinate_w1((k + 1) mod 3);
    moment_minus(k + 3)(0) <= coordinate_v1((k + 2) mod 3) when row_m0_select_at_0 = '1' else
        coordinate_w1((k + 2) mod 3);
    moment_minus(k + 3)(1) <= coordinate_v2((k + 1) mod 3) when row_m0_select_at_0 = '1' else
        coordinate_w2((k + 1) mod 3);
  end generate moment_plus_0_each;
  coordinate_w0_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(2), carried => carried_h1, y => coordinate_w0);
  coordinate_w1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(3), carried => carried_h1, y => coordinate_w1);
  coordinate_w2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_held(4), carried => carried_h1, y => coordinate_w2);

  -- Clock 17
  clock_17 : process (clk)
  begin
    if rising_edge(clk) then
      moment_plus_d1 <= moment_plus;
      moment_minus_d1 <= moment_minus;
    end if;
  end process clock_17;
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h3(0), carried => carried_h2, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h3(1), carried => carried_h2, y => coordinate_v2);
  moment_lane_cut_unit : for k in 0 to 5 generate
    unit : entity work.moment_component
      port map (clk => clk, plus => moment_plus_d1(k), minus => moment_minus_d1(k), cut => moment_lane_cut(k),
                too_great => moment_too_great0(k));
  end generate moment_lane_cut_unit;

  -- Clock 18
  e_a1_each : for i in 0 to 2 generate
    e_a1(i) <= resize(coordinate_v2_h1(i), 19) - resize(coordinate_v1_h1(i), 19);
    norm_x(0)(i) <= norm_x0_resized_third_h2(i) when row_m0_select_at_0 = '1' else resize(coordinate_v1(i), 19);
    norm_x(1)(i) <= e_b(0)(i) when row_m0_select_at_0 = '1' else resize(coordinate_v2(i), 19);
  end generate e_a1_each;
  norm_x(3) <= e_b(2) when row_m0_select_at_0 = '1' else norm_x_resized_h2(3);

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 1 loop
        norm_x_d1(k) <= norm_x(k);
      end loop;
      norm_x3_d1 <= norm_x(3);
      norm_x4_resized_h2_d1 <= norm_x_resized_h2(4);
    end if;
  end process clock_19;
  e_b_0_each : for i in 0 to 2 generate
    e_b(0)(i) <= resize(coordinate_w1_h3(i), 19) - resize(coordinate_w0_h3(i), 19);
    e_b(1)(i) <= resize(coordinate_w2_h3(i), 19) - resize(coordinate_w1_h3(i), 19);
    e_b(2)(i) <= resize(coordinate_w0_h3(i), 19) - resize(coordinate_w2_h3(i), 19);
  end generate e_b_0_each;
  norm_x(2) <= e_b(1) when row_m0_select_at_1 = '1' else e_a1;
  norm_lane_unit_x(0) <= norm_x_d1(0);
  norm_lane_unit_x(1) <= norm_x_d1(1);
  norm_lane_unit_x(2) <= norm_x2_d1;
  norm_lane_unit_x(3) <= norm_x3_d1;
  norm_lane_unit_x(4) <= norm_x4_resized_h2_d1;
  norm_lane_unit : for k in 0 to 4 generate
    unit : entity work.vector_norm
      port map (clk => clk, x => norm_lane_unit_x(k), norm => norm_lane(k));
  end generate norm_lane_unit;

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      norm_x2_d1 <= norm_x(2);
    end if;
  end process clock_20;
  too_great_0_found <= or_reduce(unsigned(moment_too_great0));

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      too_great_0_found_d1 <= too_great_0_found;
    end if;
  end process clock_21;
  level <= axis_level2_h5 when level_less_held(1) = '1' else axis_level0_resized_less_choice_h5;
  too_great_0_so_far <= too_great_0_found_d1 or too_great_0_so_far_before;
  rest_of_level <=
    to_unsigned(64, 15) when known(level) = 0 else
    to_unsigned(64, 15) when known(level) = 1 else
    to_unsigned(64, 15) when known(level) = 2 else
    to_unsigned(256, 15) when known(level) = 3 else
    to_unsigned(1024, 15) when known(level) = 4 else
    to_unsigned(4096, 15) when known(level) = 5 else
    to_unsigned(16384, 15);
  rest_of_level_aligned <= append(rest_of_level, 1);
  boxes_v(0) <= coordinate_v1_held(1)(2) when row_m0_select_at_1 = '1' else coordinate_v1_held(1)(0);
  boxes_v(1) <= coordinate_v2_held(1)(2) when row_m0_select_at_1 = '1' else coordinate_v2_held(1)(0);
  boxes_w(0) <= coordinate_w0_held(2)(2) when row_m0_select_at_1 = '1' else coordinate_w0_held(1)(0);
  boxes_w(1) <= coordinate_w1_held(2)(2) when row_m0_select_at_1 = '1' else coordinate_w1_held(1)(0);
  boxes_w(2) <= coordinate_w2_held(2)(2) when row_m0_select_at_1 = '1' else coordinate_w2_held(1)(0);

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      boxes_v_d1 <= boxes_v;
      boxes_w_d1 <= boxes_w;
      boxes_wrong_d1 <= to_unsigned(boxes_wrong_table(to_integer(known(level))), 5);
      coordinate_v1_y_h4_d1 <= coordinate_v1_held(1)(1);
      coordinate_v2_y_h4_d1 <= coordinate_v2_held(1)(1);
      coordinate_w0_y_h4_d1 <= coordinate_w0_held(1)(1);
      coordinate_w1_y_h4_d1 <= coordinate_w1_held(1)(1);
      coordinate_w2_y_h4_d1 <= coordinate_w2_held(1)(1);
    end if;
  end process clock_22;
  moment_exact_0_each : for i in 0 to 2 generate
    moment_exact(0)(i) <= moment_cut(i + 6) when row_m0_select_at_0 = '1' else moment_cut(i);
    moment_exact(1)(i) <= moment_cut(i + 9) when row_m0_select_at_0 = '1' else moment_cut(i + 3);
  end generate moment_exact_0_each;
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

  -- Clock 23
  clock_23 : process (clk)
  begin
    if rising_edge(clk) then
      moment_exact_d1 <= moment_exact;
    end if;
  end process clock_23;
  places <= '1' when places_captured = '1' else '0';
  rest <= resize(rest_of_level_aligned_h2, 17) when places = '1' else rest_aligned_second_h2;
  moment_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_round
      port map (cut => moment_exact_d1(k), places => places, moment => moment_lane(k));
  end generate moment_lane_unit;

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      places_d1 <= places;
    end if;
  end process clock_24;
  dot_x(1) <= coordinate_v2_held(3) when row_m0_select_at_0 = '1' else coordinate_v1_held(2);
  dot_x(2) <= coordinate_v2_held(3) when row_m0_select_at_0 = '1' else coordinate_v1_held(2);
  dot_x(3) <= coordinate_v2_held(3) when row_m0_select_at_0 = '1' else coordinate_v1_held(2);
  dot_x(4) <= coordinate_w2_held(3) when row_m0_select_at_0 = '1' else coordinate_w1_held(3);
  moment_norm_x(0) <= moment_m2 when row_m0_select_at_0 = '1' else moment_m0;
  moment_norm_x(1) <= moment_n when row_m0_select_at_0 = '1' else moment_m1;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_h8_d1 <= coordinate_w0_held(3);
      dot_x_d1 <= dot_x;
      moment_m0_d1 <= moment_m0;
      moment_m1_d1 <= moment_m1;
      places_d2 <= places_d1;
      moment_norm_x_d1 <= moment_norm_x;
    end if;
  end process clock_25;
  dot_m <= moment_m1_h2 when row_m0_select_at_1 = '1' else moment_n;
  length_x(0) <= length_measure_h4(5) when row_m0_select_at_1 = '1' else length_measure_h4(0);
  length_x(1) <= length_measure_h2(6) when row_m0_select_at_1 = '1' else length_measure_h4(1);
  length_x(2) <= length_measure_h4(7) when row_m0_select_at_1 = '1' else length_measure_h4(2);
  length_x(3) <= length_measure_h4(8) when row_m0_select_at_1 = '1' else length_measure_h4(3);
  length_times_g_each : for k in 0 to 3 generate
    length_times_g(k) <= resize(length_x(k), 22) when places_d2 = '1' else append(length_x(k), 1);
  end generate length_times_g_each;
  length_times_g(4) <= resize(length_measure_h2(4), 22) when places_d2 = '1' else append(length_measure_h2(4), 1);
  moment_norm_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_norm
      port map (clk => clk, x => moment_norm_x_d1(k), norm => moment_norm_lane(k));
  end generate moment_norm_lane_unit;

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_h8_d2 <= coordinate_w0_h8_d1;
      dot_m_d1 <= dot_m;
      for k in 3 to 4 loop
        dot_x_d2(k) <= dot_x_d1(k);
      end loop;
      moment_m2_d1 <= moment_m2;
      moment_n_d1 <= moment_n;
      length_times_g_d1 <= length_times_g;
      level_h4_d1 <= level_held(1);
    end if;
  end process clock_26;
  boxes_apart <= or_reduce(unsigned(boxes_apart_along));
  separated_i(0) <= boxes_apart and separated_not_held_2(0);
  dot_lane_unit_x(0) <= coordinate_w0_h8_d2;
  dot_lane_unit_x(1) <= dot_x_d1(1);
  dot_lane_unit_x(2) <= dot_x_d1(2);
  dot_lane_unit_x(3) <= dot_x_d2(3);
  dot_lane_unit_x(4) <= dot_x_d2(4);
  dot_lane_unit_m(0) <= dot_m_d1;
  dot_lane_unit_m(1) <= moment_m0_d1;
  dot_lane_unit_m(2) <= moment_m1_d1;
  dot_lane_unit_m(3) <= moment_m2_d1;
  dot_lane_unit_m(4) <= moment_n_d1;
  dot_lane_unit : for k in 0 to 4 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;
  length_first_unit : for k in 0 to 4 generate
    unit : entity work.length_first_order
      port map (x => length_times_g_d1(k), by => level_h4_d1, first_order => length_first(k));
  end generate length_first_unit;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      level_h4_d2 <= level_h4_d1;
    end if;
  end process clock_27;
  moment_measure(0) <= resize(norm_of_moment(0), 21);
  moment_measure(1) <= resize(norm_of_moment(1), 21);
  moment_x_each : for k in 0 to 1 generate
    moment_x(k) <= moment_measure(k + 2) when row_m0_select_at_1 = '1' else moment_measure(k);
    face_of_vertex_negative_difference_each : for m in 0 to 2 generate
      face_of_vertex_negative_difference(k)(m) <= signed(resize(length_bound(k), 30)) -
          signed(resize(length_bound(m + 2), 30));
      face_of_vertex(k)(m) <= length_bound(k) when face_of_vertex_negative_difference(k)(m)(29) = '1' else
          length_bound(m + 2);
    end generate face_of_vertex_negative_difference_each;
    length_measure0_plane_a0_unit_v(k) <= length_measure_held(k);
  end generate moment_x_each;
  length_measure0_plane_a0_unit_w_each : for k in 0 to 2 generate
    length_measure0_plane_a0_unit_w(k) <= length_measure_held(k + 2);
  end generate length_measure0_plane_a0_unit_w_each;
  length_measure0_plane_a0_unit_b(0) <= length_measure_held(5);
  length_measure0_plane_a0_unit_b(1) <= length_measure_h4(6);
  length_measure0_plane_a0_unit_b(2) <= length_measure_7_to_8_held(7);
  length_measure0_plane_a0 <= length_measure0_plane_a0_unit_plane_a(0);
  bound_plane_a1_sum_first_result <= length_measure0_plane_a0_unit_plane_a(1);
  bound_plane_a2_sum_first_result <= length_measure0_plane_a0_unit_plane_a(2);
  bound_plane_b1_result <= length_measure0_plane_a0_unit_plane_b(0);
  bound_plane_b2_result <= length_measure0_plane_a0_unit_plane_b(1);
  length_measure0_ends0 <= length_measure0_plane_a0_unit_ends(0);
  length_measure0_ends1 <= length_measure0_plane_a0_unit_ends(1);
  bound_side10_result <= length_measure0_plane_a0_unit_middle(0);
  bound_side11_result <= length_measure0_plane_a0_unit_middle(1);
  bound_side12_result <= length_measure0_plane_a0_unit_middle(2);
  length_measure0_plane_a0_unit : entity work.bound_tails
    port map (clk => clk, v => length_measure0_plane_a0_unit_v, a => length_measure_7_to_8_held(8),
              w => length_measure0_plane_a0_unit_w, b => length_measure0_plane_a0_unit_b, rest => rest_held(1),
              plane_a => length_measure0_plane_a0_unit_plane_a, plane_b => length_measure0_plane_a0_unit_plane_b,
              ends => length_measure0_plane_a0_unit_ends, middle => length_measure0_plane_a0_unit_middle);

  -- Clock 28
  clock_28 : process (clk)
  begin
    if rising_edge(clk) then
      moment_x_d1 <= moment_x;
      level_h4_d3 <= level_h4_d2;
    end if;
  end process clock_28;
  moment_measure(2) <= resize(norm_of_moment(2), 21);
  moment_measure(3) <= resize(norm_of_moment(3), 21);
  moment_first_unit : for k in 0 to 1 generate
    unit : entity work.moment_first_order
      port map (x => moment_x_d1(k), by => level_h4_d3, first_order => moment_first(k));
  end generate moment_first_unit;

  -- Clock 29
  compared(0) <= resize(determinant_plane_a0, 41);
  compared(1) <= resize(determinant_plane_a1, 41);
  compared(12) <= resize(determinant_side20, 41);
  compared(13) <= resize(determinant_side21, 41);

  -- Clock 30
  compared(2) <= resize(determinant_plane_a2, 41);
  compared(3) <= resize(determinant_plane_b0, 41);
  compared(14) <= resize(determinant_side22, 41);
  bound_all_m <= resize(resize(moment_bound(0), 29) + resize(moment_bound(1), 29), 30) + resize(moment_bound(2), 30);
  bound_plane_a0 <= resize(resize(moment_bound(3), 29) + resize(length_measure0_plane_a0_h2, 29), 31) +
      resize(bound_plane_a0_sum_second_h2, 31);
  bound_plane_a1 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a1_sum_first_result_h2, 29), 31) +
      resize(bound_plane_a1_sum_second_h2, 31);
  bound_plane_a2 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a2_sum_first_result_h2, 29), 31) +
      resize(bound_plane_a2_sum_second_h2, 31);
  bound_of_a <= resize(append(moment_bound(3), 1), 31) + resize(bound_of_a_aligned_second_h2, 31);
  bound_side00 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side00_sum_second_h2, 31);
  bound_side01 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side01_sum_second_h2, 31);
  bound_side02 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends0_h2, 29), 31) +
      resize(bound_side02_sum_second_h2, 31);
  bound_side20 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side20_sum_second_h2, 31);
  bound_side21 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side21_sum_second_h2, 31);
  bound_side22 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends1_h2, 29), 31) +
      resize(bound_side22_sum_second_h2, 31);
  compared_bound(0) <= signed(resize(bound_plane_a0(30 downto 3), 31));
  compared_bound(1) <= signed(resize(bound_plane_a1(30 downto 3), 31));
  compared_bound(2) <= signed(resize(bound_plane_a2(30 downto 3), 31));
  compared_bound(6) <= signed(resize(bound_side00(30 downto 3), 31));
  compared_bound(7) <= signed(resize(bound_side01(30 downto 3), 31));
  compared_bound(8) <= signed(resize(bound_side02(30 downto 3), 31));
  compared_bound(12) <= signed(resize(bound_side20(30 downto 3), 31));
  compared_bound(13) <= signed(resize(bound_side21(30 downto 3), 31));
  compared_bound(14) <= signed(resize(bound_side22(30 downto 3), 31));
  compared_unit_a(0) <= determinant_plane_a0;
  compared_unit_a(1) <= determinant_plane_a1;
  compared_unit_a(2) <= determinant_plane_a2;
  compared_unit_d(0)(0) <= dot_d1_h2(0);
  compared_unit_d(0)(1) <= dot_d1_h2(1);
  compared_unit_d(0)(2) <= dot_d1(2);
  compared_unit_d(1)(0) <= determinant_side20;
  compared_unit_d(1)(1) <= determinant_side21;
  compared_unit_d(1)(2) <= determinant_side22;
  compared_from_4_each : for k in 0 to 1 generate
    compared(k + 4) <= compared_unit_plane_b(k);
  end generate compared_from_4_each;
  determinant_side00 <= compared_unit_side0(0);
  determinant_side01 <= compared_unit_side0(1);
  determinant_side02 <= compared_unit_side0(2);
  determinant_side10 <= compared_unit_side1(0);
  determinant_side11 <= compared_unit_side1(1);
  determinant_side12 <= compared_unit_side1(2);
  compared_unit : entity work.determinant_sums
    port map (clk => clk, a => compared_unit_a, d => compared_unit_d, v => determinant_plane_b0,
              plane_b => compared_unit_plane_b, side0 => compared_unit_side0, side1 => compared_unit_side1);

  -- Clock 31
  bound_corner <= resize(bound_corner_aligned_h1, 32) + resize(bound_corner_sum_h3, 32);
  bound_plane_b0 <= resize(bound_all_m_h1, 31) + resize(length_measure0_plane_a0_h3, 31);
  bound_plane_b1 <= resize(bound_corner, 33) + resize(bound_plane_b1_result_h3, 33);
  bound_plane_b2 <= resize(bound_corner, 33) + resize(bound_plane_b2_result_h3, 33);
  bound_side10 <= resize(bound_side10_sum_h1, 33) + resize(bound_side10_result_h3, 33);
  bound_side11 <= resize(bound_side11_sum_h1, 33) + resize(bound_side11_result_h3, 33);
  bound_side12 <= resize(bound_side12_sum_h1, 33) + resize(bound_side12_result_h3, 33);
  compared_bound(3) <= signed(resize(bound_plane_b0(30 downto 3), 31));
  compared_bound(4) <= signed(resize(bound_plane_b1(32 downto 3), 31));
  compared_bound(5) <= signed(resize(bound_plane_b2(32 downto 3), 31));
  compared_bound(9) <= signed(resize(bound_side10(32 downto 3), 31));
  compared_bound(10) <= signed(resize(bound_side11(32 downto 3), 31));
  compared_bound(11) <= signed(resize(bound_side12(32 downto 3), 31));
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

  -- Clock 32
  compared(6) <= resize(determinant_side00, 41);
  compared(7) <= resize(determinant_side01, 41);
  compared(8) <= resize(determinant_side02, 41);
  compared(9) <= resize(determinant_side10, 41);
  compared(10) <= resize(determinant_side11, 41);
  compared(11) <= resize(determinant_side12, 41);
  separated_i(1) <= separated_or_h1(1) and separated_not_held_2(1);

  -- Clock 34
  separated_i(2) <= separated_or_h1(2) and separated_not_held_2(2);
  separated_i_each : for k in 3 to 8 generate
    separated_i(k) <= separated_result(k) and separated_not_held_2(k);
    overlapping_i(k) <= overlapping_result(k) and overlapping_not_h32(k);
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

  -- Clock 35
  verdict_unit_separated(0) <= separated0_held(4);
  verdict_unit_separated(1) <= separated1_h3;
  verdict_unit_separated_each : for k in 2 to 8 generate
    verdict_unit_separated(k) <= separated_held(k);
  end generate verdict_unit_separated_each;
  verdict_unit_overlapping(0) <= overlapping_held(16)(0);
  verdict_unit_overlapping(1) <= overlapping_held(16)(1);
  verdict_unit_overlapping(2) <= overlapping_held(16)(2);
  verdict_unit_overlapping_each : for k in 3 to 8 generate
    verdict_unit_overlapping(k) <= overlapping_h1(k);
  end generate verdict_unit_overlapping_each;
  verdict_unit : entity work.pair_verdict
    port map (separated => verdict_unit_separated, overlapping => verdict_unit_overlapping, verdict => verdict);

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
      if busy_20 = '1' then
        if phase = '1' then
          too_great_0_so_far_select_at_0 <= '1';
        else
          too_great_0_so_far_select_at_0 <= '0';
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
        difference_v1_held <= difference_v1 & difference_v1_held(0 to 3);
        difference_v2_held <= difference_v2 & difference_v2_held(0 to 3);
        shift_held(0) <= shift;
        shift_held(1) <= shift_held(0);
        coordinate_cut(3) <= lane_shifted(0);
        coordinate_cut(4) <= lane_shifted(1);
        difference_w2_x_held(0) <= difference_w2(0);
        difference_w2_x_held(1) <= difference_w2_x_held(0);
        difference_w2_z_held(0) <= difference_w2(2);
        difference_w2_z_held(1) <= difference_w2_z_held(0);
        difference_w0_h2 <= difference_w0;
        for k in 0 to 1 loop
          coordinate_cut_h3(k) <= coordinate_cut_held(k);
        end loop;
        carried_h2 <= carried_h1;
        level_less_resized_first_h1 <= signed(resize(axis_level0_resized_less_choice, 4));
        level_less_resized_second_h1 <= signed(resize(axis_level(2), 4));
        level_less_held(0) <= less(level_less_resized_first_h1, level_less_resized_second_h1);
        level_less_held(1) <= level_less_held(0);
        axis_level0_resized_less_choice_h5 <= axis_level0_resized_less_choice_held(1);
        axis_level2_h5 <= axis_level2_held(1);
        for k in 0 to 5 loop
          moment_cut(k) <= moment_lane_cut(k);
        end loop;
        places_captured <= too_great_0_so_far;
        moment_m2 <= moment_lane(0);
        moment_n <= moment_lane(1);
        determinant_plane_a0 <= dot_lane(0);
        coordinate_v1_held <= coordinate_v1 & coordinate_v1_held(0 to 1);
        coordinate_v2_held <= coordinate_v2 & coordinate_v2_held(0 to 2);
        dot_d1(2) <= dot_lane(3);
        determinant_side20 <= dot_lane(1);
        determinant_side21 <= dot_lane(2);
        determinant_plane_a1 <= dot_lane(4);
        coordinate_w1_h3 <= coordinate_w1_held(0);
        coordinate_w0_h3 <= coordinate_w0_held(0);
        coordinate_w2_h3 <= coordinate_w2_held(0);
        length_measure(0) <= norm_lane(0);
        length_measure(1) <= norm_lane(1);
        length_measure(2) <= norm_lane(3);
        length_measure(3) <= norm_lane(4);
        length_measure(6) <= norm_lane(2);
        rest_aligned_second_h2 <= append(rest_of_level_aligned, 1);
        rest_of_level_aligned_h2 <= rest_of_level_aligned;
        for k in 0 to 3 loop
          length_measure_h2(k) <= length_measure(k);
        end loop;
        length_measure_h2(6) <= length_measure(6);
        for k in 0 to 3 loop
          length_measure_h4(k) <= length_measure_h2(k);
        end loop;
        length_measure_h4(6) <= length_measure_h2(6);
        for k in 0 to 5 loop
          length_measure_held(k) <= length_measure_h4(k);
        end loop;
        for k in 7 to 8 loop
          length_measure_7_to_8_held(k) <= length_measure_h4(k);
        end loop;
        rest_held(0) <= rest;
        rest_held(1) <= rest_held(0);
        level_held(0) <= level;
        level_held(1) <= level_held(0);
        for k in 0 to 4 loop
          length_bound(k) <= length_first(k);
        end loop;
        norm_of_moment(0) <= moment_norm_lane(0);
        norm_of_moment(1) <= moment_norm_lane(1);
        moment_bound(0) <= moment_first(0);
        moment_bound(1) <= moment_first(1);
        bound_corner_aligned_h1 <= append(bound_all_m, 1);
        bound_corner_sum_h3 <= bound_corner_sum_h2;
        bound_all_m_h1 <= bound_all_m;
        length_measure0_plane_a0_h3 <= length_measure0_plane_a0_h2;
        bound_plane_b1_result_h3 <= bound_plane_b1_result_h2;
        bound_plane_b2_result_h3 <= bound_plane_b2_result_h2;
        bound_side10_sum_h1 <= resize(resize(append(moment_bound(0), 1), 31) +
            resize(bound_side10_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side10_result_h3 <= bound_side10_result_h2;
        bound_side11_sum_h1 <= resize(resize(append(moment_bound(1), 1), 31) +
            resize(bound_side11_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side11_result_h3 <= bound_side11_result_h2;
        bound_side12_sum_h1 <= resize(resize(append(moment_bound(2), 1), 31) +
            resize(bound_side12_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
        bound_side12_result_h3 <= bound_side12_result_h2;
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
        separated0_not_held <= separated0_not_held(10 downto 0) & not outside_i;
        separated1_not_held <= separated1_not_held(13 downto 0) & not outside_i;
        for m in 2 to 8 loop
          separated_not_held(0)(m) <= not outside_i;
        end loop;
        separated_not_held(1 to 15) <= separated_not_held(0 to 14);
        for m in 3 to 8 loop
          overlapping_not_held(0)(m) <= not outside_i;
        end loop;
        overlapping_not_held(1 to 15) <= overlapping_not_held(0 to 14);
        separated0_held <= separated0_held(3 downto 0) & separated_i(0);
        for k in 2 to 8 loop
          separated_held(k) <= separated_i(k);
        end loop;
        separated1_h3 <= separated_held(1);
        for m in 0 to 2 loop
          overlapping_held(0)(m) <= overlapping_i(m);
        end loop;
        overlapping_held(1 to 16) <= overlapping_held(0 to 15);
        for k in 3 to 8 loop
          overlapping_h1(k) <= overlapping_i(k);
        end loop;
        outside_held <= outside_held(14 downto 0) & outside_i;
        outside <= outside_held(15);
      end if;
      if strobe(1) = '1' then
        pose_bypass_held <= pose_bypass_held(1 downto 0) & pose_bypass;
        for k in 0 to 3 loop
          difference(k + 5) <= row(k);
        end loop;
        difference_v1_h9 <= difference_v1_held(3);
        difference_v2_h9 <= difference_v2_held(3);
        difference_w1_h2 <= difference_w1;
        coordinate_cut(0) <= lane_shifted(0);
        coordinate_cut(1) <= lane_shifted(1);
        coordinate_cut(2) <= lane_shifted(2);
        difference_w2_y_h2 <= difference_w2(1);
        coordinate_cut_held <= coordinate_cut;
        carried_h1 <= carried;
        taken_x_h1 <= taken_x;
        taken_y_h1 <= taken_y;
        taken_z_h1 <= taken_z;
        axis_level0_resized_less_choice_held(0) <= axis_level0_resized_less_choice;
        axis_level0_resized_less_choice_held(1) <= axis_level0_resized_less_choice_held(0);
        axis_level2_held(0) <= axis_level(2);
        axis_level2_held(1) <= axis_level2_held(0);
        for k in 0 to 5 loop
          moment_cut(k + 6) <= moment_lane_cut(k);
        end loop;
        moment_m0 <= moment_lane(0);
        moment_m1 <= moment_lane(1);
        coordinate_w0_held <= coordinate_w0 & coordinate_w0_held(0 to 2);
        moment_m1_h2 <= moment_m1;
        determinant_plane_b0 <= dot_lane(0);
        dot_d1(0) <= dot_lane(1);
        dot_d1(1) <= dot_lane(2);
        determinant_side22 <= dot_lane(3);
        coordinate_w1_held <= coordinate_w1 & coordinate_w1_held(0 to 2);
        coordinate_w2_held <= coordinate_w2 & coordinate_w2_held(0 to 2);
        determinant_plane_a2 <= dot_lane(4);
        for k in 0 to 1 loop
          dot_d1_h2(k) <= dot_d1(k);
        end loop;
        coordinate_v2_h1 <= coordinate_v2;
        coordinate_v1_h1 <= coordinate_v1;
        for i in 0 to 2 loop
          norm_x0_resized_third_h2(i) <= resize(coordinate_w2(i), 19);
        end loop;
        length_measure(4) <= norm_lane(0);
        length_measure(5) <= norm_lane(1);
        length_measure(7) <= norm_lane(3);
        length_measure(8) <= norm_lane(2);
        for i in 0 to 2 loop
          norm_x_resized_h2(3)(i) <= resize(coordinate_w0(i), 19);
          norm_x_resized_h2(4)(i) <= resize(coordinate_w1(i), 19);
        end loop;
        length_measure_h2(4) <= length_measure(4);
        length_measure_h2(5) <= length_measure(5);
        length_measure_h2(7) <= length_measure(7);
        length_measure_h2(8) <= length_measure(8);
        length_measure_h4(4) <= length_measure_h2(4);
        length_measure_h4(5) <= length_measure_h2(5);
        length_measure_h4(7) <= length_measure_h2(7);
        length_measure_h4(8) <= length_measure_h2(8);
        for k in 0 to 3 loop
          length_bound(k + 5) <= length_first(k);
        end loop;
        norm_of_moment(2) <= moment_norm_lane(0);
        norm_of_moment(3) <= moment_norm_lane(1);
        moment_bound(2) <= moment_first(0);
        moment_bound(3) <= moment_first(1);
        length_measure0_plane_a0_h2 <= length_measure0_plane_a0;
        face_of_vertex_h1 <= face_of_vertex;
        bound_plane_a0_sum_second_h2 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(1)(0), 30);
        bound_plane_a1_sum_first_result_h2 <= bound_plane_a1_sum_first_result;
        bound_plane_a1_sum_second_h2 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(1)(1), 30);
        bound_plane_a2_sum_first_result_h2 <= bound_plane_a2_sum_first_result;
        bound_plane_a2_sum_second_h2 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(1)(2), 30);
        bound_corner_sum_h2 <= resize(resize(length_bound(5), 30) + resize(length_bound(6), 30), 31) +
            resize(length_bound(7), 31);
        bound_plane_b1_result_h2 <= bound_plane_b1_result;
        bound_plane_b2_result_h2 <= bound_plane_b2_result;
        bound_of_a_aligned_second_h2 <= append(length_bound(8), 1);
        length_measure0_ends0_h2 <= length_measure0_ends0;
        bound_side00_sum_second_h2 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(0)(1), 30);
        bound_side01_sum_second_h2 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(0)(2), 30);
        bound_side02_sum_second_h2 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(0)(0), 30);
        bound_side10_sum_sum_aligned_second_h2 <= append(length_bound(5), 1);
        bound_side10_result_h2 <= bound_side10_result;
        bound_side11_sum_sum_aligned_second_h2 <= append(length_bound(6), 1);
        bound_side11_result_h2 <= bound_side11_result;
        bound_side12_sum_sum_aligned_second_h2 <= append(length_bound(7), 1);
        bound_side12_result_h2 <= bound_side12_result;
        length_measure0_ends1_h2 <= length_measure0_ends1;
        bound_side20_sum_second_h2 <= resize(face_of_vertex_h1(1)(0), 30) + resize(face_of_vertex_h1(1)(1), 30);
        bound_side21_sum_second_h2 <= resize(face_of_vertex_h1(1)(1), 30) + resize(face_of_vertex_h1(1)(2), 30);
        bound_side22_sum_second_h2 <= resize(face_of_vertex_h1(1)(2), 30) + resize(face_of_vertex_h1(1)(0), 30);
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
        separated_not_held_2(0) <= separated0_not_held(11);
        separated_not_held_2(1) <= separated1_not_held(14);
        for k in 2 to 8 loop
          separated_not_held_2(k) <= separated_not_held(15)(k);
        end loop;
        separated_or_h1(1) <= (sign(0)(0) and sign(1)(0) and sign(2)(0)) or (sign(0)(1) and sign(1)(1) and sign(2)(1));
        separated_or_h1(2) <= (sign(3)(0) and sign(4)(0) and sign(5)(0)) or (sign(3)(1) and sign(4)(1) and sign(5)(1));
        overlapping_not_h32 <= overlapping_not_held(15);
        separated_held(1) <= separated_i(1);
      end if;
      if in_phase_0 = '1' then
        busy_2 <= holds(0);
        busy_12 <= holds(5);
        busy_16 <= holds(7);
        busy_18 <= holds(8);
        busy_22 <= holds(10);
        busy_24 <= holds(11);
        busy_20 <= holds(9);
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

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if too_great_0_so_far_select_at_0 = '1' then
        too_great_0_so_far_before <= '0';
      else
        too_great_0_so_far_before <= too_great_0_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  separated(0) <= separated0_held(4);
  separated(1) <= separated1_h3;
  separated_each : for k in 2 to 8 generate
    separated(k) <= separated_i(k);
  end generate separated_each;
  overlapping(0) <= overlapping_held(16)(0);
  overlapping(1) <= overlapping_held(16)(1);
  overlapping(2) <= overlapping_held(16)(2);
  overlapping_each : for k in 3 to 8 generate
    overlapping(k) <= overlapping_i(k);
  end generate overlapping_each;
end architecture rtl;
