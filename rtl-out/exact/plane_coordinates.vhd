-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The coordinates of a point in the plane without coordinate c: those after it, in turn.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity plane_coordinates is
  port (
    x         : in  signed_18_vector_t;  -- |.| <= 131071
    left_out  : in  unsigned(1 downto 0);
    projected : out signed_18_x2_t  -- |.| <= 131071
  );
end entity plane_coordinates;

architecture rtl of plane_coordinates is
begin
  -- Clock 0
  projected_each : for k in 0 to 1 generate
    projected(k) <=
      x(k + 1) when known(left_out) = 0 else
      x((k + 2) mod 3) when known(left_out) = 1 else
      x(k) when known(left_out) = 2 else
      x(k + 1);
  end generate projected_each;
end architecture rtl;
