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
    clk               : in  std_logic;
    strobe            : in  std_logic_vector(2 downto 0);  -- one flag per phase
    row_m_select_at_1 : in  unsigned(1 downto 0);
    row_m_select_at_2 : in  unsigned(1 downto 0);
    moment_m0         : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m2         : in  signed_18_vector_t;  -- |.| <= 131072
    moment_m1         : in  signed_18_vector_t;  -- |.| <= 131072
    moment_n          : in  signed_18_vector_t;  -- |.| <= 131072
    coordinate_w0_h6  : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_h9  : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_h6  : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_h6  : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0_h9  : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_h9  : in  signed_18_vector_t;  -- |.| <= 131071
    lane1_select_at_1 : in  std_logic;
    lane1_select_at_2 : in  std_logic;
    compared          : out signed_41_x15_t  -- |.| <= 206156857344
  );
end entity pair_determinants;

architecture rtl of pair_determinants is
  signal dot_x : signed_18_vector_x4_t;  -- |.| <= 131071
  signal dot_m : signed_18_vector_x4_t;  -- |.| <= 131072
  signal dot_x_d1 : signed_18_vector_x4_t := zero_signed_18_vector_x4;  -- |.| <= 131071
  signal dot_x0_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal dot_x3_d2 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal dot_m0_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_m_d1 : signed_18_vector_1_to_2_t := zero_signed_18_vector_1_to_2;  -- |.| <= 131072
  signal dot_m3_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal dot_lane : signed_38_x4_t;  -- |.| <= 51539214336
  signal determinant_plane_a0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_a1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side22 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_d1 : signed_38_x3_t := zero_signed_38_x3;  -- |.| <= 51539214336
  signal determinant_plane_b0 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_plane_a2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side20 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal determinant_side21 : signed(37 downto 0) := (others => '0');  -- |.| <= 51539214336
  signal dot_d1_h3 : signed_38_x2_t := zero_signed_38_x2;  -- |.| <= 51539214336
  signal determinant_side00 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side01 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side02 : signed(38 downto 0);  -- |.| <= 51539214336
  signal determinant_side10 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side11 : signed(39 downto 0);  -- |.| <= 206156857344
  signal determinant_side12 : signed(39 downto 0);  -- |.| <= 206156857344
  signal dot_lane_unit_x : signed_18_vector_x4_t;
  signal dot_lane_unit_m : signed_18_vector_x4_t;
  signal compared_unit_a : signed_38_x3_t;
  signal compared_unit_d : signed_38_x3_x2_t;
  signal compared_unit_plane_b : signed_41_x2_t;
  signal compared_unit_side0 : signed_39_x3_t;
  signal compared_unit_side1 : signed_40_x3_t;
begin
  -- Clock 25
  dot_x(0) <=
    coordinate_w0_h6 when known(row_m_select_at_1) = 0 else
    coordinate_w1_h9 when known(row_m_select_at_1) = 1 else
    coordinate_v2_h6;
  dot_x(1) <=
    coordinate_v1_h6 when known(row_m_select_at_1) = 0 else
    coordinate_w0_h9 when known(row_m_select_at_1) = 1 else
    coordinate_w2_h9;
  dot_x(2) <= coordinate_v2_h6 when lane1_select_at_1 = '1' else coordinate_v1_h6;
  dot_x(3) <= coordinate_v2_h6 when lane1_select_at_1 = '1' else coordinate_v1_h6;
  dot_m(1) <=
    moment_m0 when known(row_m_select_at_1) = 0 else
    moment_m1 when known(row_m_select_at_1) = 1 else
    moment_n;
  dot_m(2) <= moment_m0 when lane1_select_at_1 = '1' else moment_m1;

  -- Clock 26
  clock_26 : process (clk)
  begin
    if rising_edge(clk) then
      dot_x_d1 <= dot_x;
      for k in 1 to 2 loop
        dot_m_d1(k) <= dot_m(k);
      end loop;
    end if;
  end process clock_26;
  dot_m(0) <=
    moment_n when known(row_m_select_at_2) = 0 else
    moment_n when known(row_m_select_at_2) = 1 else
    moment_m2;
  dot_m(3) <= moment_m1 when lane1_select_at_2 = '1' else moment_m2;

  -- Clock 27
  clock_27 : process (clk)
  begin
    if rising_edge(clk) then
      dot_x0_d2 <= dot_x_d1(0);
      dot_x3_d2 <= dot_x_d1(3);
      dot_m0_d1 <= dot_m(0);
      dot_m3_d1 <= dot_m(3);
    end if;
  end process clock_27;
  dot_lane_unit_x(0) <= dot_x0_d2;
  dot_lane_unit_x(1) <= dot_x_d1(1);
  dot_lane_unit_x(2) <= dot_x_d1(2);
  dot_lane_unit_x(3) <= dot_x3_d2;
  dot_lane_unit_m(0) <= dot_m0_d1;
  dot_lane_unit_m(1) <= dot_m_d1(1);
  dot_lane_unit_m(2) <= dot_m_d1(2);
  dot_lane_unit_m(3) <= dot_m3_d1;
  dot_lane_unit : for k in 0 to 3 generate
    unit : entity work.dot_product
      port map (clk => clk, x => dot_lane_unit_x(k), m => dot_lane_unit_m(k), dot => dot_lane(k));
  end generate dot_lane_unit;

  -- Clock 30
  compared(0) <= resize(determinant_plane_a0, 41);
  compared(3) <= resize(determinant_plane_b0, 41);
  compared(12) <= resize(determinant_side20, 41);

  -- Clock 31
  compared(1) <= resize(determinant_plane_a1, 41);
  compared(2) <= resize(determinant_plane_a2, 41);
  compared(13) <= resize(determinant_side21, 41);

  -- Clock 32
  compared(14) <= resize(determinant_side22, 41);
  compared_unit_a(0) <= determinant_plane_a0;
  compared_unit_a(1) <= determinant_plane_a1;
  compared_unit_a(2) <= determinant_plane_a2;
  compared_unit_d(0)(0) <= dot_d1_h3(0);
  compared_unit_d(0)(1) <= dot_d1_h3(1);
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

  -- Clock 34
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
      if strobe(2) = '1' then
        determinant_plane_a0 <= dot_lane(0);
        dot_d1(2) <= dot_lane(3);
        determinant_plane_b0 <= dot_lane(1);
        determinant_side20 <= dot_lane(2);
      end if;
      if strobe(0) = '1' then
        determinant_plane_a1 <= dot_lane(0);
        determinant_plane_a2 <= dot_lane(1);
        determinant_side21 <= dot_lane(3);
      end if;
      if strobe(1) = '1' then
        determinant_side22 <= dot_lane(0);
        dot_d1(0) <= dot_lane(1);
        dot_d1(1) <= dot_lane(2);
        for k in 0 to 1 loop
          dot_d1_h3(k) <= dot_d1(k);
        end loop;
      end if;
    end if;
  end process captures;
end architecture rtl;
