-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- What the bounds have beside F (section 5 of docs/determinants.md), with c = c(3) and c(5) = 4 c:
--   plane_a(l) = 4 w_l + c, also of V_0 against the plane of B
--   plane_b(i) = 4 w_0 + 12 A_i + 4 c
--   ends(i) = 4 A_i + c, of the sides of the edges at V_0
--   middle(l) = 4 (A_e + b_l) + 4 c, of the sides of the edge between V_1 and V_2
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity bound_tails is
  port (
    clk     : in  std_logic;
    v       : in  unsigned_21_x2_t;
    a       : in  unsigned(20 downto 0);
    w       : in  unsigned_21_x3_t;
    b       : in  unsigned_21_x3_t;
    rest    : in  unsigned(16 downto 0);
    plane_a : out unsigned_24_x3_t;
    plane_b : out unsigned_27_x2_t;
    ends    : out unsigned_24_x2_t;
    middle  : out unsigned_25_x3_t
  );
end entity bound_tails;

architecture rtl of bound_tails is
  signal w_d1 : unsigned_21_x3_t := zero_unsigned_21_x3;
  signal rest_d1 : unsigned(16 downto 0) := (others => '0');
  signal plane_b_sum_sum_d1 : unsigned_24_x2_t := zero_unsigned_24_x2;
  signal v_d1 : unsigned_21_x2_t := zero_unsigned_21_x2;
  signal a_and_rest : unsigned(21 downto 0);
  signal middle_sum_d1 : unsigned_23_x3_t := zero_unsigned_23_x3;
begin
  -- Clock 0
  a_and_rest <= resize(a, 22) + resize(rest, 22);

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      w_d1 <= w;
      rest_d1 <= rest;
      for k in 0 to 1 loop
        plane_b_sum_sum_d1(k) <= resize(w(0), 24) + resize(resize(v(k), 23) + resize(append(v(k), 1), 23), 24);
      end loop;
      v_d1 <= v;
      for k in 0 to 2 loop
        middle_sum_d1(k) <= resize(b(k), 23) + resize(a_and_rest, 23);
      end loop;
    end if;
  end process clock_1;
  plane_a_each : for k in 0 to 2 generate
    plane_a(k) <= resize(append(w_d1(k), 2), 24) + resize(rest_d1, 24);
  end generate plane_a_each;
  plane_b_each : for k in 0 to 1 generate
    plane_b(k) <= append(resize(plane_b_sum_sum_d1(k), 25) + resize(rest_d1, 25), 2);
    ends(k) <= resize(append(v_d1(k), 2), 24) + resize(rest_d1, 24);
  end generate plane_b_each;
  middle_each : for k in 0 to 2 generate
    middle(k) <= append(middle_sum_d1(k), 2);
  end generate middle_each;
end architecture rtl;
