-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 4: moments of the edges of B, and the normal of A.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_moments is
  port (
    clk              : in  std_logic;
    coordinate_w0_d1 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1_d1 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2_d1 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v1_d1 : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2_d1 : in  signed_18_vector_t;  -- |.| <= 131071
    places           : out std_logic;
    moment_m0        : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m1        : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m2        : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_n         : out signed_18_vector_t := zero_signed_18_vector  -- |.| <= 131072
  );
end entity pair_moments;

architecture rtl of pair_moments is
  signal moment_lane_cut : signed_20_x12_t;  -- |.| <= 524281
  signal moment_too_great0 : std_logic_vector(11 downto 0);
  signal moment_cut : signed_20_x12_t := zero_signed_20_x12;  -- |.| <= 524281
  signal too_great_0_found : std_logic;
  signal places_captured : std_logic := '0';
  signal places_i : std_logic;
  signal moment_lane : signed_18_vector_x4_t;  -- |.| <= 131072
  signal moment_lane_cut_unit_plus : signed_18_x2_x12_t;
  signal moment_lane_cut_unit_minus : signed_18_x2_x12_t;
  signal moment_lane_unit_cut : signed_20_vector_x4_t;
begin
  -- Clock 14
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
  moment_lane_cut_unit : for k in 0 to 11 generate
    unit : entity work.moment_component
      port map (clk => clk, plus => moment_lane_cut_unit_plus(k), minus => moment_lane_cut_unit_minus(k),
                cut => moment_lane_cut(k), too_great => moment_too_great0(k));
  end generate moment_lane_cut_unit;

  -- Clock 17
  too_great_0_found <= or_reduce(unsigned(moment_too_great0));

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      moment_cut <= moment_lane_cut;
      places_captured <= too_great_0_found;
    end if;
  end process clock_18;
  places_i <= '1' when places_captured = '1' else '0';
  moment_lane_unit_cut_0_each : for i in 0 to 2 generate
    moment_lane_unit_cut(0)(i) <= moment_cut(i);
    moment_lane_unit_cut(1)(i) <= moment_cut(i + 3);
    moment_lane_unit_cut(2)(i) <= moment_cut(i + 6);
    moment_lane_unit_cut(3)(i) <= moment_cut(i + 9);
  end generate moment_lane_unit_cut_0_each;
  moment_lane_unit : for k in 0 to 3 generate
    unit : entity work.moment_round
      port map (cut => moment_lane_unit_cut(k), places => places_i, moment => moment_lane(k));
  end generate moment_lane_unit;

  -- Clock 19
  clock_19 : process (clk)
  begin
    if rising_edge(clk) then
      moment_m0 <= moment_lane(0);
      moment_m1 <= moment_lane(1);
      moment_m2 <= moment_lane(2);
      moment_n <= moment_lane(3);
    end if;
  end process clock_19;

  -- Outputs
  places <= places_i;
end architecture rtl;
