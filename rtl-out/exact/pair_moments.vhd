-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 3: moments of the edges of B, and the normal of A.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_moments is
  port (
    clk       : in  std_logic;
    fitted_d1 : in  signed_18_vector_x5_t;  -- |.| <= 131071
    moment_m0 : out signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
    moment_m1 : out signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
    moment_m2 : out signed_36_vector_t := zero_signed_36_vector;  -- |.| <= 34359214082
    moment_n  : out signed_36_vector_t := zero_signed_36_vector  -- |.| <= 34359214082
  );
end entity pair_moments;

architecture rtl of pair_moments is
  signal moment_component_lane : signed_36_x12_t;  -- |.| <= 34359214082
  signal moment_component_lane_unit_plus : signed_18_x2_x12_t;
  signal moment_component_lane_unit_minus : signed_18_x2_x12_t;
begin
  -- Clock 2
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
    end if;
  end process clock_4;
end architecture rtl;
