-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 4: the fifteen determinants, from ten dot products.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_determinants is
  port (
    clk                 : in  std_logic;
    strobe              : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_1   : in  std_logic;
    row_m_select_at_0   : in  std_logic;
    moment_m0           : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2           : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1           : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n            : in  signed_18_vector_t;  -- |.| <= 131072
    coordinate_w0_h8_d2 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_h6    : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_h8    : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_h8    : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_h8    : in  signed_18_vector_t;  -- |.| <= 131071
    compared            : out signed_41_x15_t  -- |.| <= 206156857344
  );
end entity pair_determinants;

architecture rtl of pair_determinants is
  signal moment_m1_h2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_m : signed_18_vector_t;  -- |.| <= 131072
  signal dot_m_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_lane : signed_38_x5_t;  -- |.| <= 51539214336
  signal determinant_plane_a0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_b0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
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
  signal moment_n_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal determinant_plane_a1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_a2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_d1_h2 : signed_38_x2_t := zero_signed_38_x2;  -- |.| <= 51539214336
  signal determinant_side00 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side01 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side02 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side10 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side11 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side12 : signed(39 downto 0);  -- |.| <= 206156857344
  signal dot_lane_unit_x : signed_18_vector_x5_t;
  signal dot_lane_unit_m : signed_18_vector_x5_t;
  signal compared_unit_a : signed_38_x3_t;
  signal compared_unit_d : signed_38_x3_x2_t;
  signal compared_unit_plane_b : signed_41_x2_t;
  signal compared_unit_side0 : signed_39_x3_t;
  signal compared_unit_side1 : signed_40_x3_t;
begin
  -- Clock 23
  dot_x(1) <= coordinate_v2_h8 when row_m_select_at_1 = '1' else coordinate_v1_h6;
  dot_x(2) <= coordinate_v2_h8 when row_m_select_at_1 = '1' else coordinate_v1_h6;
  dot_x(3) <= coordinate_v2_h8 when row_m_select_at_1 = '1' else coordinate_v1_h6;
  dot_x(4) <= coordinate_w2_h8 when row_m_select_at_1 = '1' else coordinate_w1_h8;

  -- Clock 24
  clock_24 : process (clk)
  begin
    if rising_edge(clk) then
      dot_x_d1 <= dot_x;
      moment_m0_d1 <= moment_m0;
      moment_m1_d1 <= moment_m1;
    end if;
  end process clock_24;
  dot_m <= moment_m1_h2 when row_m_select_at_0 = '1' else moment_n;

  -- Clock 25
  clock_25 : process (clk)
  begin
    if rising_edge(clk) then
      dot_m_d1 <= dot_m;
      for k in 3 to 4 loop
        dot_x_d2(k) <= dot_x_d1(k);
      end loop;
      moment_m2_d1 <= moment_m2;
      moment_n_d1 <= moment_n;
    end if;
  end process clock_25;
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

  -- Clock 28
  compared(0) <= resize(determinant_plane_a0, 41);
  compared(1) <= resize(determinant_plane_a1, 41);
  compared(12) <= resize(determinant_side20, 41);
  compared(13) <= resize(determinant_side21, 41);

  -- Clock 29
  compared(2) <= resize(determinant_plane_a2, 41);
  compared(3) <= resize(determinant_plane_b0, 41);
  compared(14) <= resize(determinant_side22, 41);
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
  compared(6) <= resize(determinant_side00, 41);
  compared(7) <= resize(determinant_side01, 41);
  compared(8) <= resize(determinant_side02, 41);
  compared(9) <= resize(determinant_side10, 41);
  compared(10) <= resize(determinant_side11, 41);
  compared(11) <= resize(determinant_side12, 41);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        moment_m1_h2 <= moment_m1;
        determinant_plane_b0 <= dot_lane(0);
        dot_d1(0) <= dot_lane(1);
        dot_d1(1) <= dot_lane(2);
        determinant_side22 <= dot_lane(3);
        determinant_plane_a2 <= dot_lane(4);
        for k in 0 to 1 loop
          dot_d1_h2(k) <= dot_d1(k);
        end loop;
      end if;
      if strobe(1) = '1' then
        determinant_plane_a0 <= dot_lane(0);
        dot_d1(2) <= dot_lane(3);
        determinant_side20 <= dot_lane(1);
        determinant_side21 <= dot_lane(2);
        determinant_plane_a1 <= dot_lane(4);
      end if;
    end if;
  end process captures;
end architecture rtl;
