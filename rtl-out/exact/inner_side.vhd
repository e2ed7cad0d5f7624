-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- A meets the plane of B in a segment, which ends on the edges of A whose ends are on different sides of the plane, or
-- one end on it. Whether some end is on the inner side of edge l of B: edge k passes the plane upward and side(k, l) is
-- positive, or downward and it is negative.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity inner_side is
  port (
    plane_b : in  flag_x2_x3_t;
    side    : in  flag_x2_x3_x3_t;
    inner   : out std_logic_vector(2 downto 0)
  );
end entity inner_side;

architecture rtl of inner_side is
  signal up : std_logic_vector(2 downto 0);
  signal down : std_logic_vector(2 downto 0);
begin
  -- Clock 0
  up_each : for k in 0 to 2 generate
    up(k) <= (plane_b(k)(1) and not plane_b((k + 1) mod 3)(1)) or (not plane_b(k)(0) and plane_b((k + 1) mod 3)(0));
    down(k) <= (plane_b(k)(0) and not plane_b((k + 1) mod 3)(0)) or (not plane_b(k)(1) and plane_b((k + 1) mod 3)(1));
    inner(k) <= or_reduce(((up(2) and side(2)(k)(0)) or (down(2) and side(2)(k)(1))) &
        ((up(1) and side(1)(k)(0)) or (down(1) and side(1)(k)(1))) &
        ((up(0) and side(0)(k)(0)) or (down(0) and side(0)(k)(1))));
  end generate up_each;
end architecture rtl;
