-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, coordinates of working width, moments, fifteen determinants with
-- bounds on their errors, verdict. Units are shared over the phases of the slot. A value captured for the pair is
-- named after what it is; later copies end in _h<clocks>, or are elements of x_held.
-- Latency: 28 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    in_v        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m      : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t      : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass : in  std_logic;
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic;
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
  signal pose_t_inside_number_h1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 2147483648
  signal pose_t_inside : signed_32_x3_t;  -- |.| <= 1073741816
  signal pose_t_outside : std_logic_vector(2 downto 0);
  signal in_v_inside0_h1 : signed_32_x3_t := zero_signed_32_x3;  -- |.| <= 268435456
  signal moved : signed_33_vector_t;  -- |.| <= 1342177272; t - V0, or - V0 with the bypass
  signal pose_m_inside_number_h1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- s4.28; |.| <= 2147483648
  signal pose_m_inside : signed_32_x3_x3_t;  -- |.| <= 268435456
  signal pose_m_outside : flag_x3_x3_t;
  signal pose_m_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal in_w_inside_d1 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal in_w_inside_d2 : signed_32_x3_x3_t := zero_signed_32_x3_x3;  -- |.| <= 268435456
  signal row_turned : signed_32_x9_t;  -- |.| <= 805306372
  signal pose_bypass_line : std_logic_vector(1 to 7) := (others => '0');
  type in_w_inside_line_t is array (1 to 4) of signed_32_x3_x3_t;
  signal in_w_inside_line : in_w_inside_line_t := (others => zero_signed_32_x3_x3);  -- |.| <= 268435456
  signal row_choice_d1 : signed_32_x9_t := zero_signed_32_x9;  -- |.| <= 805306372
  type moved_line_t is array (1 to 6) of signed_33_vector_t;
  signal moved_line : moved_line_t := (others => zero_signed_33_vector);  -- |.| <= 1342177272
  signal row : signed_34_x9_t;  -- |.| <= 2147483644
  signal difference : signed_34_x9_t := zero_signed_34_x9;  -- |.| <= 2147483644
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 2147483644
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 2147483644
  signal in_v_outside_h1 : flag_x3_x3_t := zero_flag_x3_x3;
  signal in_w_outside_h1 : flag_x3_x3_t := zero_flag_x3_x3;
  signal outside_flags : unsigned(29 downto 0);
  signal outside_i : std_logic;  -- a number of the pair or its pose is outside its declared range
  type difference_v1_line_t is array (1 to 8) of signed_33_vector_t;
  signal difference_v1_line : difference_v1_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  type difference_v2_line_t is array (1 to 8) of signed_33_vector_t;
  signal difference_v2_line : difference_v2_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  signal shift : flag_x4_vector_t;
  type difference_v1_d11_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_v1_d11_line : difference_v1_d11_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  signal shift_d1 : flag_x4_vector_t := zero_flag_x4_vector;
  signal lane_shifted : signed_19_vector_x5_t;  -- |.| <= 262144
  signal coordinate_cut : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  type difference_v2_d11_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_v2_d11_line : difference_v2_d11_line_t := (others => zero_signed_33_vector);  -- |.| <= 536870912
  type difference_w0_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w0_line : difference_w0_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  type difference_w1_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w1_line : difference_w1_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  type difference_w2_line_t is array (1 to 3) of signed_33_vector_t;
  signal difference_w2_line : difference_w2_line_t := (others => zero_signed_33_vector);  -- |.| <= 2147483644
  signal carried : std_logic_vector(2 downto 0);
  signal coordinate_cut_h1 : signed_19_vector_x5_t := zero_signed_19_vector_x5;  -- |.| <= 262144
  signal carried_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal coordinate_v1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_v2 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w0 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w1 : signed_18_vector_t;  -- |.| <= 131071
  signal coordinate_w2 : signed_18_vector_t;  -- |.| <= 131071
  signal shift_h2 : flag_x4_vector_t := zero_flag_x4_vector;
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
  signal axis_level0_resized_less_choice_h1 : unsigned(2 downto 0) := (others => '0');
  signal axis_level2_h1 : unsigned(2 downto 0) := (others => '0');
  signal level : unsigned(2 downto 0);
  signal coordinate_w0_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_w1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal moment_lane_cut : signed_20_x12_t;  -- |.| <= 524281
  signal moment_too_great0 : std_logic_vector(11 downto 0);
  signal moment_cut : signed_20_x12_t := zero_signed_20_x12;  -- |.| <= 524281
  signal coordinate_w2_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal coordinate_v2_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal too_great_0_found : std_logic;
  signal places_captured : std_logic := '0';
  signal places : std_logic;
  signal moment_lane : signed_18_vector_x4_t;  -- |.| <= 131072
  signal moment_m0 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_m1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_m2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal moment_n : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal coordinate_w0_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w0_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w0_line : coordinate_w0_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal dot_lane : signed_38_x10_t;  -- |.| <= 51539214336
  signal determinant_plane_a0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal coordinate_v1_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_v1_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_v1_line : coordinate_v1_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal dot_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal coordinate_w1_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w1_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w1_line : coordinate_w1_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal determinant_plane_a1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_b0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal coordinate_v2_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_v2_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_v2_line : coordinate_v2_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal determinant_side20 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side21 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side22 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal coordinate_w2_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  type coordinate_w2_line_t is array (1 to 4) of signed_18_vector_t;
  signal coordinate_w2_line : coordinate_w2_line_t := (others => zero_signed_18_vector);  -- |.| <= 131071
  signal determinant_plane_a2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal compared : signed_41_x15_t;  -- |.| <= 206156857344
  signal determinant_side00 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side01 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side02 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side10 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side11 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side12 : signed(39 downto 0);  -- |.| <= 206156857344
  signal e_a1 : signed_19_vector_t;  -- |.| <= 262142
  signal e_b : signed_19_vector_x3_t;  -- |.| <= 262142
  signal norm_x_0_to_1_resized_d1 : signed_19_vector_x2_t := zero_signed_19_vector_x2;  -- |.| <= 131071
  signal norm_x_resized_d1 : signed_19_vector_3_to_5_t := zero_signed_19_vector_3_to_5;  -- |.| <= 131071
  signal norm_lane : unsigned_21_x9_t;
  signal e_a1_d1 : signed_19_vector_t := zero_signed_19_vector;  -- |.| <= 262142
  signal length_measure : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal e_b_d1 : signed_19_vector_x3_t := zero_signed_19_vector_x3;  -- |.| <= 262142
  type level_line_t is array (1 to 3) of unsigned(2 downto 0);
  signal level_line : level_line_t := (others => (others => '0'));
  signal rest_of_level : unsigned(14 downto 0);
  signal rest_of_level_aligned : unsigned(15 downto 0);
  signal rest_aligned_second_h1 : unsigned(16 downto 0) := (others => '0');
  signal rest_of_level_aligned_h1 : unsigned(15 downto 0) := (others => '0');
  signal rest : unsigned(16 downto 0);  -- c(3); four times that is c(5)
  type length_measure_line_t is array (1 to 3) of unsigned_21_x5_t;
  signal length_measure_line : length_measure_line_t := (others => zero_unsigned_21_x5);
  signal length_measure_5_to_8_h2 : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal length_measure_h3 : unsigned_21_x5_t := zero_unsigned_21_x5;
  signal length_measure_h4 : unsigned_21_x5_t := zero_unsigned_21_x5;
  signal length_measure_h1 : unsigned_21_5_to_8_t := zero_unsigned_21_5_to_8;
  signal rest_h1 : unsigned(16 downto 0) := (others => '0');
  signal rest_h2 : unsigned(16 downto 0) := (others => '0');
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
  signal length_times_g : unsigned_22_x9_t;
  signal length_times_g_d1 : unsigned_22_x9_t := zero_unsigned_22_x9;
  signal level_d4 : unsigned(2 downto 0) := (others => '0');
  signal level_d5 : unsigned(2 downto 0) := (others => '0');
  signal length_first : unsigned_29_x9_t;
  signal length_bound : unsigned_29_x9_t := zero_unsigned_29_x9;
  signal moment_norm_lane : unsigned_20_x4_t;
  signal norm_of_moment : unsigned_20_x4_t := zero_unsigned_20_x4;
  signal moment_measure : unsigned_21_x4_t;
  signal level_d6 : unsigned(2 downto 0) := (others => '0');
  signal level_d7 : unsigned(2 downto 0) := (others => '0');
  signal moment_first : unsigned_28_x4_t;
  signal moment_bound : unsigned_28_x4_t := zero_unsigned_28_x4;
  signal face_of_vertex_negative_difference : signed_30_x3_x2_t;  -- |.| <= 53476968
  signal face_of_vertex : unsigned_29_x3_x2_t;
  signal bound_all_m : unsigned(29 downto 0);
  signal length_measure0_plane_a0_h1 : unsigned(23 downto 0) := (others => '0');
  signal face_of_vertex_h1 : unsigned_29_x3_x2_t := zero_unsigned_29_x3_x2;
  signal bound_plane_a0_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a0 : unsigned(30 downto 0);
  signal bound_plane_a1_sum_first_result_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a1_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a1 : unsigned(30 downto 0);
  signal bound_plane_a2_sum_first_result_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_a2_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_plane_a2 : unsigned(30 downto 0);
  signal bound_corner_aligned_h1 : unsigned(30 downto 0) := (others => '0');
  type bound_corner_sum_line_t is array (1 to 3) of unsigned(30 downto 0);
  signal bound_corner_sum_line : bound_corner_sum_line_t := (others => (others => '0'));
  signal bound_corner : unsigned(31 downto 0);
  signal bound_all_m_h1 : unsigned(29 downto 0) := (others => '0');
  signal length_measure0_plane_a0_h2 : unsigned(23 downto 0) := (others => '0');
  signal bound_plane_b0 : unsigned(30 downto 0);
  signal bound_plane_b1_result_h1 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b1 : unsigned(32 downto 0);
  signal bound_plane_b2_result_h1 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2_result_h2 : unsigned(26 downto 0) := (others => '0');
  signal bound_plane_b2 : unsigned(32 downto 0);
  signal bound_of_a_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_of_a : unsigned(30 downto 0);
  signal length_measure0_ends0_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_side00_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side00 : unsigned(30 downto 0);
  signal bound_side01_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side01 : unsigned(30 downto 0);
  signal bound_side02_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side02 : unsigned(30 downto 0);
  signal bound_side10_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side10_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side10_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side10 : unsigned(32 downto 0);
  signal bound_side11_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side11_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side11_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side11 : unsigned(32 downto 0);
  signal bound_side12_sum_sum_aligned_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_sum_aligned_second_h2 : unsigned(29 downto 0) := (others => '0');
  signal bound_side12_sum_h1 : unsigned(31 downto 0) := (others => '0');
  signal bound_side12_result_h1 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12_result_h2 : unsigned(24 downto 0) := (others => '0');
  signal bound_side12 : unsigned(32 downto 0);
  signal length_measure0_ends1_h1 : unsigned(23 downto 0) := (others => '0');
  signal bound_side20_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side20 : unsigned(30 downto 0);
  signal bound_side21_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side21 : unsigned(30 downto 0);
  signal bound_side22_sum_second_h1 : unsigned(29 downto 0) := (others => '0');
  signal bound_side22 : unsigned(30 downto 0);
  signal compared_bound : signed_31_x15_t;  -- |.| <= 67665506
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
  signal separated0_not_line : std_logic_vector(1 to 17) := (others => '0');
  signal separated_i : std_logic_vector(8 downto 0);
  signal separated1_or_h1 : std_logic := '0';
  signal separated2_or_h1 : std_logic := '0';
  signal separated1_not_line : std_logic_vector(1 to 23) := (others => '0');
  type separated_not_line_t is array (1 to 25) of std_logic_vector(8 downto 2);
  signal separated_not_line : separated_not_line_t := (others => (others => '0'));
  signal overlapping_i : std_logic_vector(8 downto 0);
  type overlapping_not_line_t is array (1 to 25) of std_logic_vector(8 downto 3);
  signal overlapping_not_line : overlapping_not_line_t := (others => (others => '0'));
  signal separated0_line : std_logic_vector(1 to 9) := (others => '0');
  signal separated1_line : std_logic_vector(1 to 3) := (others => '0');
  signal separated_h1 : std_logic_vector(8 downto 2) := (others => '0');
  type overlapping_line_t is array (1 to 26) of std_logic_vector(2 downto 0);
  signal overlapping_line : overlapping_line_t := (others => (others => '0'));
  signal overlapping_h1 : std_logic_vector(8 downto 3) := (others => '0');
  signal outside_line : std_logic_vector(1 to 26) := (others => '0');
  signal row_turned_unit_m : signed_32_vector_x9_t;
  signal row_turned_unit_w : signed_32_vector_x9_t;
  signal shift_unit_x : signed_33_x5_vector_t;
  signal lane_shifted_unit_x : signed_33_vector_x5_t;
  signal carried_unit_cut : signed_19_x5_vector_t;
  signal moment_lane_cut_unit_plus : signed_18_x2_x12_t;
  signal moment_lane_cut_unit_minus : signed_18_x2_x12_t;
  signal moment_lane_unit_cut : signed_20_vector_x4_t;
  signal dot_lane_unit_x : signed_18_vector_x10_t;
  signal dot_lane_unit_m : signed_18_vector_x10_t;
  signal compared_unit_a : signed_38_x3_t;
  signal compared_unit_d : signed_38_x3_x2_t;
  signal compared_unit_plane_b : signed_41_x2_t;
  signal compared_unit_side0 : signed_39_x3_t;
  signal compared_unit_side1 : signed_40_x3_t;
  signal norm_lane_unit_x : signed_19_vector_x9_t;
  signal length_measure0_plane_a0_unit_v : unsigned_21_x2_t;
  signal length_measure0_plane_a0_unit_w : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_b : unsigned_21_x3_t;
  signal length_measure0_plane_a0_unit_plane_a : unsigned_24_x3_t;
  signal length_measure0_plane_a0_unit_plane_b : unsigned_27_x2_t;
  signal length_measure0_plane_a0_unit_ends : unsigned_24_x2_t;
  signal length_measure0_plane_a0_unit_middle : unsigned_25_x3_t;
  signal moment_norm_lane_unit_x : signed_18_vector_x4_t;
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
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 2 loop
        pose_t_inside_number_h1(k) <= choose(pose_bypass, to_signed(0, 32), pose_t(k));
        for m in 0 to 2 loop
          pose_m_inside_number_h1(k)(m) <= choose(pose_bypass, to_signed(0, 32), pose_m(k)(m));
        end loop;
      end loop;
    end if;
  end process clock_1;
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
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      in_v_inside0_h1 <= in_v_inside(0);
      in_w_inside_d1 <= in_w_inside;
      in_v_outside_h1 <= in_v_outside;
      in_w_outside_h1 <= in_w_outside;
    end if;
  end process clock_2;
  moved_each : for i in 0 to 2 generate
    moved(i) <= resize(pose_t_inside(i), 33) - resize(in_v_inside0_h1(i), 33);
  end generate moved_each;
  outside_flags <= unsigned(pose_m_outside(2)) & unsigned(pose_m_outside(1)) & unsigned(pose_m_outside(0)) &
      unsigned(pose_t_outside) & unsigned(in_w_outside_h1(2)) & unsigned(in_w_outside_h1(1)) &
      unsigned(in_w_outside_h1(0)) & unsigned(in_v_outside_h1(2)) & unsigned(in_v_outside_h1(1)) &
      unsigned(in_v_outside_h1(0));
  outside_i <= or_reduce(outside_flags);
  overlapping_i(0) <= overlapping_constant(0) and not outside_i;
  overlapping_i(1) <= overlapping_constant(1) and not outside_i;
  overlapping_i(2) <= overlapping_constant(2) and not outside_i;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      pose_m_inside_d1 <= pose_m_inside;
      in_w_inside_d2 <= in_w_inside_d1;
    end if;
  end process clock_3;
  row_turned_unit_m_each_of : for k in 0 to 8 generate
    row_turned_unit_m_each : for i in 0 to 2 generate
      row_turned_unit_m(k)(i) <= pose_m_inside_d1(k mod 3)(i);
    end generate row_turned_unit_m_each;
  end generate row_turned_unit_m_each_of;
  row_turned_unit_w_each_of : for k in 0 to 2 generate
    row_turned_unit_w_each : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d2(0)(i);
    end generate row_turned_unit_w_each;
  end generate row_turned_unit_w_each_of;
  row_turned_unit_w_each_of_2 : for k in 3 to 5 generate
    row_turned_unit_w_each_2 : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d2(1)(i);
    end generate row_turned_unit_w_each_2;
  end generate row_turned_unit_w_each_of_2;
  row_turned_unit_w_each_of_3 : for k in 6 to 8 generate
    row_turned_unit_w_each_3 : for i in 0 to 2 generate
      row_turned_unit_w(k)(i) <= in_w_inside_d2(2)(i);
    end generate row_turned_unit_w_each_3;
  end generate row_turned_unit_w_each_of_3;
  row_turned_unit : for k in 0 to 8 generate
    unit : entity work.difference_row
      port map (clk => clk, m => row_turned_unit_m(k), w => row_turned_unit_w(k), turned => row_turned(k));
  end generate row_turned_unit;

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      row_choice_d1(0) <= choose(pose_bypass_line(7), in_w_inside_line(4)(0)(0), row_turned(0));
      row_choice_d1(1) <= choose(pose_bypass_line(7), in_w_inside_line(4)(0)(1), row_turned(1));
      row_choice_d1(2) <= choose(pose_bypass_line(7), in_w_inside_line(4)(0)(2), row_turned(2));
      row_choice_d1(3) <= choose(pose_bypass_line(7), in_w_inside_line(4)(1)(0), row_turned(3));
      row_choice_d1(4) <= choose(pose_bypass_line(7), in_w_inside_line(4)(1)(1), row_turned(4));
      row_choice_d1(5) <= choose(pose_bypass_line(7), in_w_inside_line(4)(1)(2), row_turned(5));
      row_choice_d1(6) <= choose(pose_bypass_line(7), in_w_inside_line(4)(2)(0), row_turned(6));
      row_choice_d1(7) <= choose(pose_bypass_line(7), in_w_inside_line(4)(2)(1), row_turned(7));
      row_choice_d1(8) <= choose(pose_bypass_line(7), in_w_inside_line(4)(2)(2), row_turned(8));
    end if;
  end process clock_8;
  row_each : for k in 0 to 8 generate
    row(k) <= resize(row_choice_d1(k), 34) + resize(moved_line(6)(k mod 3), 34);
  end generate row_each;

  -- Clock 9
  clock_9 : process (clk)
  begin
    if rising_edge(clk) then
      difference <= row;
    end if;
  end process clock_9;
  difference_w0_each : for i in 0 to 2 generate
    difference_w0(i) <= difference(i)(32 downto 0);
    difference_w1(i) <= difference(i + 3)(32 downto 0);
    difference_w2(i) <= difference(i + 6)(32 downto 0);
    shift_unit_x(i)(0) <= difference_v1_line(8)(i);
    shift_unit_x(i)(1) <= difference_v2_line(8)(i);
    shift_unit_x(i)(2) <= difference_w0(i);
    shift_unit_x(i)(3) <= difference_w1(i);
    shift_unit_x(i)(4) <= difference_w2(i);
  end generate difference_w0_each;
  shift_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_shift
      port map (clk => clk, x => shift_unit_x(i), shift => shift(i));
  end generate shift_unit;

  -- Clock 12
  clock_12 : process (clk)
  begin
    if rising_edge(clk) then
      shift_d1 <= shift;
    end if;
  end process clock_12;
  lane_shifted_unit_x(0) <= difference_v1_d11_line(3);
  lane_shifted_unit_x(1) <= difference_v2_d11_line(3);
  lane_shifted_unit_x(2) <= difference_w0_line(3);
  lane_shifted_unit_x(3) <= difference_w1_line(3);
  lane_shifted_unit_x(4) <= difference_w2_line(3);
  lane_shifted_unit : for k in 0 to 4 generate
    unit : entity work.coordinate_scale
      port map (x => lane_shifted_unit_x(k), shift => shift_d1, cut => lane_shifted(k));
  end generate lane_shifted_unit;

  -- Clock 13
  clock_13 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_cut <= lane_shifted;
      shift_h2 <= shift_d1;
    end if;
  end process clock_13;
  taken_x <= carried(0) & unsigned(shift_h2(0));
  taken_y <= carried(1) & unsigned(shift_h2(1));
  taken_z <= carried(2) & unsigned(shift_h2(2));
  carried_unit_cut_each_of : for i in 0 to 2 generate
    carried_unit_cut_each : for k in 0 to 4 generate
      carried_unit_cut(i)(k) <= coordinate_cut(k)(i);
    end generate carried_unit_cut_each;
  end generate carried_unit_cut_each_of;
  carried_unit : for i in 0 to 2 generate
    unit : entity work.coordinate_carry
      port map (cut => carried_unit_cut(i), carried => carried(i));
  end generate carried_unit;

  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_cut_h1 <= coordinate_cut;
      carried_h1 <= carried;
      taken_x_h1 <= taken_x;
      taken_y_h1 <= taken_y;
      taken_z_h1 <= taken_z;
    end if;
  end process clock_14;
  axis_level(0) <= to_unsigned(axis_level_0_table(to_integer(known(taken_x_h1))), 3);
  axis_level(1) <= to_unsigned(axis_level_1_table(to_integer(known(taken_y_h1))), 3);
  axis_level(2) <= to_unsigned(axis_level_2_table(to_integer(known(taken_z_h1))), 3);
  axis_level0_resized_less_choice <= axis_level(1) when
      less(signed(resize(axis_level(0), 4)), signed(resize(axis_level(1), 4))) = '1' else axis_level(0);
  coordinate_v1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(0), carried => carried_h1, y => coordinate_v1);
  coordinate_v2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(1), carried => carried_h1, y => coordinate_v2);
  coordinate_w0_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(2), carried => carried_h1, y => coordinate_w0);
  coordinate_w1_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(3), carried => carried_h1, y => coordinate_w1);
  coordinate_w2_unit : entity work.coordinate_round
    port map (cut => coordinate_cut_h1(4), carried => carried_h1, y => coordinate_w2);

  -- Clock 15
  clock_15 : process (clk)
  begin
    if rising_edge(clk) then
      level_less_resized_first_h1 <= signed(resize(axis_level0_resized_less_choice, 4));
      level_less_resized_second_h1 <= signed(resize(axis_level(2), 4));
      axis_level0_resized_less_choice_h1 <= axis_level0_resized_less_choice;
      axis_level2_h1 <= axis_level(2);
      coordinate_w0_d1 <= coordinate_w0;
      coordinate_w1_d1 <= coordinate_w1;
      coordinate_w2_d1 <= coordinate_w2;
      coordinate_v1_d1 <= coordinate_v1;
      coordinate_v2_d1 <= coordinate_v2;
      for i in 0 to 2 loop
        norm_x_0_to_1_resized_d1(0)(i) <= resize(coordinate_v1(i), 19);
        norm_x_0_to_1_resized_d1(1)(i) <= resize(coordinate_v2(i), 19);
        norm_x_resized_d1(3)(i) <= resize(coordinate_w0(i), 19);
        norm_x_resized_d1(4)(i) <= resize(coordinate_w1(i), 19);
        norm_x_resized_d1(5)(i) <= resize(coordinate_w2(i), 19);
      end loop;
    end if;
  end process clock_15;
  level <= axis_level2_h1 when less(level_less_resized_first_h1, level_less_resized_second_h1) = '1' else
      axis_level0_resized_less_choice_h1;
  moment_lane_cut_unit_plus_0_each : for k in 0 to 2 generate
    moment_lane_cut_unit_plus(k)(0) <= coordinate_w0_d1((k + 1) mod 3);
    moment_lane_cut_unit_plus(k)(1) <= coordinate_w1_d1((k + 2) mod 3);
    moment_lane_cut_unit_plus(k + 3)(0) <= coordinate_w1_d1((k + 1) mod 3);
    moment_lane_cut_unit_plus(k + 3)(1) <= coordinate_w2_d1((k + 2) mod 3);
    moment_lane_cut_unit_plus(k + 6)(0) <= coordinate_w2_d1((k + 1) mod 3);
    moment_lane_cut_unit_plus(k + 6)(1) <= coordinate_w0_d1((k + 2) mod 3);
    moment_lane_cut_unit_plus(k + 9)(0) <= coordinate_v1_d1((k + 1) mod 3);
    moment_lane_cut_unit_plus(k + 9)(1) <= coordinate_v2_d1((k + 2) mod 3);
    moment_lane_cut_unit_minus(k)(0) <= coordinate_w0_d1((k + 2) mod 3);
    moment_lane_cut_unit_minus(k)(1) <= coordinate_w1_d1((k + 1) mod 3);
    moment_lane_cut_unit_minus(k + 3)(0) <= coordinate_w1_d1((k + 2) mod 3);
    moment_lane_cut_unit_minus(k + 3)(1) <= coordinate_w2_d1((k + 1) mod 3);
    moment_lane_cut_unit_minus(k + 6)(0) <= coordinate_w2_d1((k + 2) mod 3);
    moment_lane_cut_unit_minus(k + 6)(1) <= coordinate_w0_d1((k + 1) mod 3);
    moment_lane_cut_unit_minus(k + 9)(0) <= coordinate_v1_d1((k + 2) mod 3);
    moment_lane_cut_unit_minus(k + 9)(1) <= coordinate_v2_d1((k + 1) mod 3);
  end generate moment_lane_cut_unit_plus_0_each;
  norm_lane_unit_x(0) <= norm_x_0_to_1_resized_d1(0);
  norm_lane_unit_x(1) <= norm_x_0_to_1_resized_d1(1);
  norm_lane_unit_x(2) <= e_a1_d1;
  norm_lane_unit_x(3) <= norm_x_resized_d1(3);
  norm_lane_unit_x(4) <= norm_x_resized_d1(4);
  norm_lane_unit_x(5) <= norm_x_resized_d1(5);
  norm_lane_unit_x(6) <= e_b_d1(0);
  norm_lane_unit_x(7) <= e_b_d1(1);
  norm_lane_unit_x(8) <= e_b_d1(2);
  moment_lane_cut_unit : for k in 0 to 11 generate
    unit : entity work.moment_component
      port map (clk => clk, plus => moment_lane_cut_unit_plus(k), minus => moment_lane_cut_unit_minus(k),
                cut => moment_lane_cut(k), too_great => moment_too_great0(k));
  end generate moment_lane_cut_unit;
  norm_lane_unit : for k in 0 to 8 generate
    unit : entity work.vector_norm
      port map (clk => clk, x => norm_lane_unit_x(k), norm => norm_lane(k));
  end generate norm_lane_unit;

  -- Clock 16
  clock_16 : process (clk)
  begin
    if rising_edge(clk) then
      coordinate_w0_d2 <= coordinate_w0_d1;
      coordinate_v1_d2 <= coordinate_v1_d1;
      coordinate_w1_d2 <= coordinate_w1_d1;
      coordinate_v2_d2 <= coordinate_v2_d1;
      coordinate_w2_d2 <= coordinate_w2_d1;
      boxes_wrong_d1 <= to_unsigned(boxes_wrong_table(to_integer(known(level))), 5);
    end if;
  end process clock_16;
  e_a1_each : for i in 0 to 2 generate
    e_a1(i) <= resize(coordinate_v2_d2(i), 19) - resize(coordinate_v1_d2(i), 19);
    e_b(0)(i) <= resize(coordinate_w1_d2(i), 19) - resize(coordinate_w0_d2(i), 19);
    e_b(1)(i) <= resize(coordinate_w2_d2(i), 19) - resize(coordinate_w1_d2(i), 19);
    e_b(2)(i) <= resize(coordinate_w0_d2(i), 19) - resize(coordinate_w2_d2(i), 19);
  end generate e_a1_each;
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

  -- Clock 17
  clock_17 : process (clk)
  begin
    if rising_edge(clk) then
      e_a1_d1 <= e_a1;
      e_b_d1 <= e_b;
    end if;
  end process clock_17;

  -- Clock 18
  too_great_0_found <= or_reduce(unsigned(moment_too_great0));
  rest_of_level <=
    to_unsigned(64, 15) when known(level_line(3)) = 0 else
    to_unsigned(64, 15) when known(level_line(3)) = 1 else
    to_unsigned(64, 15) when known(level_line(3)) = 2 else
    to_unsigned(256, 15) when known(level_line(3)) = 3 else
    to_unsigned(1024, 15) when known(level_line(3)) = 4 else
    to_unsigned(4096, 15) when known(level_line(3)) = 5 else
    to_unsigned(16384, 15);
  rest_of_level_aligned <= append(rest_of_level, 1);

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      moment_cut <= moment_lane_cut;
      places_captured <= too_great_0_found;
      length_measure(5) <= norm_lane(6);
      length_measure(6) <= norm_lane(7);
      length_measure(7) <= norm_lane(8);
      length_measure(8) <= norm_lane(2);
      rest_aligned_second_h1 <= append(rest_of_level_aligned, 1);
      rest_of_level_aligned_h1 <= rest_of_level_aligned;
      level_d4 <= level_line(3);
      boxes_apart_along <= boxes_lane;
    end if;
  end process clock_19;
  places <= '1' when places_captured = '1' else '0';
  rest <= resize(rest_of_level_aligned_h1, 17) when places = '1' else rest_aligned_second_h1;
  length_times_g_each : for k in 0 to 4 generate
    length_times_g(k) <= resize(length_measure_line(3)(k), 22) when places = '1' else
        append(length_measure_line(3)(k), 1);
  end generate length_times_g_each;
  length_times_g_each_2 : for k in 5 to 8 generate
    length_times_g(k) <= resize(length_measure(k), 22) when places = '1' else append(length_measure(k), 1);
  end generate length_times_g_each_2;
  boxes_apart <= or_reduce(unsigned(boxes_apart_along));
  separated_i(0) <= boxes_apart and separated0_not_line(17);
  moment_lane_unit_cut_0_each : for i in 0 to 2 generate
    moment_lane_unit_cut(0)(i) <= moment_cut(i);
    moment_lane_unit_cut(1)(i) <= moment_cut(i + 3);
    moment_lane_unit_cut(2)(i) <= moment_cut(i + 6);
    moment_lane_unit_cut(3)(i) <= moment_cut(i + 9);
  end generate moment_lane_unit_cut_0_each;
  moment_lane_unit : for k in 0 to 3 generate
    unit : entity work.moment_round
      port map (cut => moment_lane_unit_cut(k), places => places, moment => moment_lane(k));
  end generate moment_lane_unit;

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      moment_m0 <= moment_lane(0);
      moment_m1 <= moment_lane(1);
      moment_m2 <= moment_lane(2);
      moment_n <= moment_lane(3);
      length_measure_h3 <= length_measure_line(3);
      length_measure_h1 <= length_measure;
      rest_h1 <= rest;
      length_times_g_d1 <= length_times_g;
      level_d5 <= level_d4;
    end if;
  end process clock_20;
  dot_lane_unit_x(0) <= coordinate_w0_line(4);
  dot_lane_unit_x(1) <= coordinate_v1_line(4);
  dot_lane_unit_x(2) <= coordinate_v1_line(4);
  dot_lane_unit_x(3) <= coordinate_v1_line(4);
  dot_lane_unit_x(4) <= coordinate_w1_line(4);
  dot_lane_unit_x(5) <= coordinate_w0_line(4);
  dot_lane_unit_x(6) <= coordinate_v2_line(4);
  dot_lane_unit_x(7) <= coordinate_v2_line(4);
  dot_lane_unit_x(8) <= coordinate_v2_line(4);
  dot_lane_unit_x(9) <= coordinate_w2_line(4);
  dot_lane_unit_m(0) <= moment_n;
  dot_lane_unit_m(1) <= moment_m0;
  dot_lane_unit_m(2) <= moment_m1;
  dot_lane_unit_m(3) <= moment_m2;
  dot_lane_unit_m(4) <= moment_n;
  dot_lane_unit_m(5) <= moment_m1;
  dot_lane_unit_m(6) <= moment_m0;
  dot_lane_unit_m(7) <= moment_m1;
  dot_lane_unit_m(8) <= moment_m2;
  dot_lane_unit_m(9) <= moment_n;
  moment_norm_lane_unit_x(0) <= moment_m0;
  moment_norm_lane_unit_x(1) <= moment_m1;
  moment_norm_lane_unit_x(2) <= moment_m2;
  moment_norm_lane_unit_x(3) <= moment_n;
  dot_lane_unit : for k in 0 to 9 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;
  length_first_unit : for k in 0 to 8 generate
    unit : entity work.length_first_order
      port map (x => length_times_g_d1(k), by => level_d5, first_order => length_first(k));
  end generate length_first_unit;
  moment_norm_lane_unit : for k in 0 to 3 generate
    unit : entity work.moment_norm
      port map (clk => clk, x => moment_norm_lane_unit_x(k), norm => moment_norm_lane(k));
  end generate moment_norm_lane_unit;

  -- Clock 21
  clock_21 : process (clk)
  begin
    if rising_edge(clk) then
      length_measure_5_to_8_h2 <= length_measure_h1;
      length_measure_h4 <= length_measure_h3;
      rest_h2 <= rest_h1;
      length_bound <= length_first;
      level_d6 <= level_d5;
    end if;
  end process clock_21;
  face_of_vertex_negative_difference_each_of : for k in 0 to 1 generate
    face_of_vertex_negative_difference_each : for m in 0 to 2 generate
      face_of_vertex_negative_difference(k)(m) <= signed(resize(length_bound(k), 30)) -
          signed(resize(length_bound(m + 2), 30));
      face_of_vertex(k)(m) <= length_bound(k) when face_of_vertex_negative_difference(k)(m)(29) = '1' else
          length_bound(m + 2);
    end generate face_of_vertex_negative_difference_each;
    length_measure0_plane_a0_unit_v(k) <= length_measure_h4(k);
  end generate face_of_vertex_negative_difference_each_of;
  length_measure0_plane_a0_unit_w_each : for k in 0 to 2 generate
    length_measure0_plane_a0_unit_w(k) <= length_measure_h4(k + 2);
    length_measure0_plane_a0_unit_b(k) <= length_measure_5_to_8_h2(k + 5);
  end generate length_measure0_plane_a0_unit_w_each;
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
    port map (clk => clk, v => length_measure0_plane_a0_unit_v, a => length_measure_5_to_8_h2(8),
              w => length_measure0_plane_a0_unit_w, b => length_measure0_plane_a0_unit_b, rest => rest_h2,
              plane_a => length_measure0_plane_a0_unit_plane_a, plane_b => length_measure0_plane_a0_unit_plane_b,
              ends => length_measure0_plane_a0_unit_ends, middle => length_measure0_plane_a0_unit_middle);

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      norm_of_moment <= moment_norm_lane;
      level_d7 <= level_d6;
      face_of_vertex_h1 <= face_of_vertex;
      bound_of_a_aligned_second_h1 <= append(length_bound(8), 1);
      bound_side10_sum_sum_aligned_second_h1 <= append(length_bound(5), 1);
      bound_side11_sum_sum_aligned_second_h1 <= append(length_bound(6), 1);
      bound_side12_sum_sum_aligned_second_h1 <= append(length_bound(7), 1);
    end if;
  end process clock_22;
  moment_measure_each : for k in 0 to 3 generate
    moment_measure(k) <= resize(norm_of_moment(k), 21);
  end generate moment_measure_each;
  moment_first_unit : for k in 0 to 3 generate
    unit : entity work.moment_first_order
      port map (x => moment_measure(k), by => level_d7, first_order => moment_first(k));
  end generate moment_first_unit;

  -- Clock 23
  clock_23 : process (clk)
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
      moment_bound <= moment_first;
      length_measure0_plane_a0_h1 <= length_measure0_plane_a0;
      bound_plane_a0_sum_second_h1 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(1)(0), 30);
      bound_plane_a1_sum_first_result_h1 <= bound_plane_a1_sum_first_result;
      bound_plane_a1_sum_second_h1 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(1)(1), 30);
      bound_plane_a2_sum_first_result_h1 <= bound_plane_a2_sum_first_result;
      bound_plane_a2_sum_second_h1 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(1)(2), 30);
      bound_plane_b1_result_h1 <= bound_plane_b1_result;
      bound_plane_b2_result_h1 <= bound_plane_b2_result;
      bound_of_a_aligned_second_h2 <= bound_of_a_aligned_second_h1;
      length_measure0_ends0_h1 <= length_measure0_ends0;
      bound_side00_sum_second_h1 <= resize(face_of_vertex_h1(0)(0), 30) + resize(face_of_vertex_h1(0)(1), 30);
      bound_side01_sum_second_h1 <= resize(face_of_vertex_h1(0)(1), 30) + resize(face_of_vertex_h1(0)(2), 30);
      bound_side02_sum_second_h1 <= resize(face_of_vertex_h1(0)(2), 30) + resize(face_of_vertex_h1(0)(0), 30);
      bound_side10_sum_sum_aligned_second_h2 <= bound_side10_sum_sum_aligned_second_h1;
      bound_side10_result_h1 <= bound_side10_result;
      bound_side11_sum_sum_aligned_second_h2 <= bound_side11_sum_sum_aligned_second_h1;
      bound_side11_result_h1 <= bound_side11_result;
      bound_side12_sum_sum_aligned_second_h2 <= bound_side12_sum_sum_aligned_second_h1;
      bound_side12_result_h1 <= bound_side12_result;
      length_measure0_ends1_h1 <= length_measure0_ends1;
      bound_side20_sum_second_h1 <= resize(face_of_vertex_h1(1)(0), 30) + resize(face_of_vertex_h1(1)(1), 30);
      bound_side21_sum_second_h1 <= resize(face_of_vertex_h1(1)(1), 30) + resize(face_of_vertex_h1(1)(2), 30);
      bound_side22_sum_second_h1 <= resize(face_of_vertex_h1(1)(2), 30) + resize(face_of_vertex_h1(1)(0), 30);
    end if;
  end process clock_23;
  compared(0) <= resize(determinant_plane_a0, 41);
  compared(1) <= resize(determinant_plane_a1, 41);
  compared(2) <= resize(determinant_plane_a2, 41);
  compared(3) <= resize(determinant_plane_b0, 41);
  compared(12) <= resize(determinant_side20, 41);
  compared(13) <= resize(determinant_side21, 41);
  compared(14) <= resize(determinant_side22, 41);
  bound_all_m <= resize(resize(moment_bound(0), 29) + resize(moment_bound(1), 29), 30) + resize(moment_bound(2), 30);
  bound_plane_a0 <= resize(resize(moment_bound(3), 29) + resize(length_measure0_plane_a0_h1, 29), 31) +
      resize(bound_plane_a0_sum_second_h1, 31);
  bound_plane_a1 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a1_sum_first_result_h1, 29), 31) +
      resize(bound_plane_a1_sum_second_h1, 31);
  bound_plane_a2 <= resize(resize(moment_bound(3), 29) + resize(bound_plane_a2_sum_first_result_h1, 29), 31) +
      resize(bound_plane_a2_sum_second_h1, 31);
  bound_of_a <= resize(append(moment_bound(3), 1), 31) + resize(bound_of_a_aligned_second_h2, 31);
  bound_side00 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side00_sum_second_h1, 31);
  bound_side01 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side01_sum_second_h1, 31);
  bound_side02 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends0_h1, 29), 31) +
      resize(bound_side02_sum_second_h1, 31);
  bound_side20 <= resize(resize(moment_bound(0), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side20_sum_second_h1, 31);
  bound_side21 <= resize(resize(moment_bound(1), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side21_sum_second_h1, 31);
  bound_side22 <= resize(resize(moment_bound(2), 29) + resize(length_measure0_ends1_h1, 29), 31) +
      resize(bound_side22_sum_second_h1, 31);
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
  compared_unit_d(0) <= dot_d1;
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

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      bound_corner_aligned_h1 <= append(bound_all_m, 1);
      bound_all_m_h1 <= bound_all_m;
      length_measure0_plane_a0_h2 <= length_measure0_plane_a0_h1;
      bound_plane_b1_result_h2 <= bound_plane_b1_result_h1;
      bound_plane_b2_result_h2 <= bound_plane_b2_result_h1;
      bound_side10_sum_h1 <= resize(resize(append(moment_bound(0), 1), 31) +
          resize(bound_side10_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side10_result_h2 <= bound_side10_result_h1;
      bound_side11_sum_h1 <= resize(resize(append(moment_bound(1), 1), 31) +
          resize(bound_side11_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side11_result_h2 <= bound_side11_result_h1;
      bound_side12_sum_h1 <= resize(resize(append(moment_bound(2), 1), 31) +
          resize(bound_side12_sum_sum_aligned_second_h2, 31), 32) + resize(bound_of_a, 32);
      bound_side12_result_h2 <= bound_side12_result_h1;
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
  end process clock_24;
  bound_corner <= resize(bound_corner_aligned_h1, 32) + resize(bound_corner_sum_line(3), 32);
  bound_plane_b0 <= resize(bound_all_m_h1, 31) + resize(length_measure0_plane_a0_h2, 31);
  bound_plane_b1 <= resize(bound_corner, 33) + resize(bound_plane_b1_result_h2, 33);
  bound_plane_b2 <= resize(bound_corner, 33) + resize(bound_plane_b2_result_h2, 33);
  bound_side10 <= resize(bound_side10_sum_h1, 33) + resize(bound_side10_result_h2, 33);
  bound_side11 <= resize(bound_side11_sum_h1, 33) + resize(bound_side11_result_h2, 33);
  bound_side12 <= resize(bound_side12_sum_h1, 33) + resize(bound_side12_result_h2, 33);
  compared_bound(3) <= signed(resize(bound_plane_b0(30 downto 3), 31));
  compared_bound(4) <= signed(resize(bound_plane_b1(32 downto 3), 31));
  compared_bound(5) <= signed(resize(bound_plane_b2(32 downto 3), 31));
  compared_bound(9) <= signed(resize(bound_side10(32 downto 3), 31));
  compared_bound(10) <= signed(resize(bound_side11(32 downto 3), 31));
  compared_bound(11) <= signed(resize(bound_side12(32 downto 3), 31));
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

  -- Clock 25
  clock_25 : process (clk)
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
  end process clock_25;
  compared(6) <= resize(determinant_side00, 41);
  compared(7) <= resize(determinant_side01, 41);
  compared(8) <= resize(determinant_side02, 41);
  compared(9) <= resize(determinant_side10, 41);
  compared(10) <= resize(determinant_side11, 41);
  compared(11) <= resize(determinant_side12, 41);
  separated_i(1) <= separated1_or_h1 and separated1_not_line(23);

  -- Clock 26
  clock_26 : process (clk)
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
  end process clock_26;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 4 to 11 loop
        sign_h1(k) <= sign(k);
      end loop;
      sign3_h2 <= sign3_h1;
      separated2_or_h1 <= (sign3_h1(0) and sign(4)(0) and sign(5)(0)) or (sign3_h1(1) and sign(4)(1) and sign(5)(1));
    end if;
  end process clock_27;
  separated_i(2) <= separated2_or_h1 and separated_not_line(25)(2);
  separated_i_each : for k in 3 to 8 generate
    separated_i(k) <= separated_result(k) and separated_not_line(25)(k);
    overlapping_i(k) <= overlapping_result(k) and overlapping_not_line(25)(k);
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

  -- Clock 28
  clock_28 : process (clk)
  begin
    if rising_edge(clk) then
      for k in 2 to 8 loop
        separated_h1(k) <= separated_i(k);
      end loop;
      for k in 3 to 8 loop
        overlapping_h1(k) <= overlapping_i(k);
      end loop;
    end if;
  end process clock_28;
  verdict_unit_separated(0) <= separated0_line(9);
  verdict_unit_separated(1) <= separated1_line(3);
  verdict_unit_separated_each : for k in 2 to 8 generate
    verdict_unit_separated(k) <= separated_h1(k);
  end generate verdict_unit_separated_each;
  verdict_unit_overlapping(0) <= overlapping_line(26)(0);
  verdict_unit_overlapping(1) <= overlapping_line(26)(1);
  verdict_unit_overlapping(2) <= overlapping_line(26)(2);
  verdict_unit_overlapping_each : for k in 3 to 8 generate
    verdict_unit_overlapping(k) <= overlapping_h1(k);
  end generate verdict_unit_overlapping_each;
  verdict_unit : entity work.pair_verdict
    port map (separated => verdict_unit_separated, overlapping => verdict_unit_overlapping, verdict => verdict);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      pose_bypass_line <= pose_bypass & pose_bypass_line(1 to 6);
      in_w_inside_line <= in_w_inside_d2 & in_w_inside_line(1 to 3);
      moved_line <= moved & moved_line(1 to 5);
      difference_v1_line <= difference_v1 & difference_v1_line(1 to 7);
      difference_v2_line <= difference_v2 & difference_v2_line(1 to 7);
      difference_v1_d11_line <= difference_v1_line(8) & difference_v1_d11_line(1 to 2);
      difference_v2_d11_line <= difference_v2_line(8) & difference_v2_d11_line(1 to 2);
      difference_w0_line <= difference_w0 & difference_w0_line(1 to 2);
      difference_w1_line <= difference_w1 & difference_w1_line(1 to 2);
      difference_w2_line <= difference_w2 & difference_w2_line(1 to 2);
      coordinate_w0_line <= coordinate_w0_d2 & coordinate_w0_line(1 to 3);
      coordinate_v1_line <= coordinate_v1_d2 & coordinate_v1_line(1 to 3);
      coordinate_w1_line <= coordinate_w1_d2 & coordinate_w1_line(1 to 3);
      coordinate_v2_line <= coordinate_v2_d2 & coordinate_v2_line(1 to 3);
      coordinate_w2_line <= coordinate_w2_d2 & coordinate_w2_line(1 to 3);
      level_line <= level & level_line(1 to 2);
      length_measure_line(1)(0) <= norm_lane(0);
      length_measure_line(1)(1) <= norm_lane(1);
      length_measure_line(1)(2) <= norm_lane(3);
      length_measure_line(1)(3) <= norm_lane(4);
      length_measure_line(1)(4) <= norm_lane(5);
      length_measure_line(2 to 3) <= length_measure_line(1 to 2);
      bound_corner_sum_line <= (resize(resize(length_bound(5), 30) + resize(length_bound(6), 30), 31) +
          resize(length_bound(7), 31)) & bound_corner_sum_line(1 to 2);
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
      separated0_not_line <= not outside_i & separated0_not_line(1 to 16);
      separated1_not_line <= not outside_i & separated1_not_line(1 to 22);
      for k in 2 to 8 loop
        separated_not_line(1)(k) <= not outside_i;
      end loop;
      separated_not_line(2 to 25) <= separated_not_line(1 to 24);
      for k in 3 to 8 loop
        overlapping_not_line(1)(k) <= not outside_i;
      end loop;
      overlapping_not_line(2 to 25) <= overlapping_not_line(1 to 24);
      separated0_line <= separated_i(0) & separated0_line(1 to 8);
      separated1_line <= separated_i(1) & separated1_line(1 to 2);
      for k in 0 to 2 loop
        overlapping_line(1)(k) <= overlapping_i(k);
      end loop;
      overlapping_line(2 to 26) <= overlapping_line(1 to 25);
      outside_line <= outside_i & outside_line(1 to 25);
    end if;
  end process delays;

  -- Outputs
  outside <= outside_line(26);
  separated(0) <= separated0_line(9);
  separated(1) <= separated1_line(3);
  separated_each : for k in 2 to 8 generate
    separated(k) <= separated_h1(k);
  end generate separated_each;
  overlapping(0) <= overlapping_line(26)(0);
  overlapping(1) <= overlapping_line(26)(1);
  overlapping(2) <= overlapping_line(26)(2);
  overlapping_each : for k in 3 to 8 generate
    overlapping(k) <= overlapping_h1(k);
  end generate overlapping_each;
end architecture rtl;
