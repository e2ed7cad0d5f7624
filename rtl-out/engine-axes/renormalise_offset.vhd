-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Re-normalisation, first step: the point relative to the lower bound of V0, exact (subtracting a constant, not an
-- interval, widens nothing).
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity renormalise_offset is
  port (
    point  : in  interval_32_vector_t;  -- s4.28; |.| <= 1879048192
    origin : in  signed_32_vector_t;  -- s4.28; |.| <= 268435456
    offset : out interval_33_vector_t  -- s5.28; |.| <= 2147483648
  );
end entity renormalise_offset;

architecture rtl of renormalise_offset is
begin
  -- Clock 0
  offset_lo_each : for i in 0 to 2 generate
    offset(i).lo <= resize(point(i).lo, 33) - resize(origin(i), 33);
    offset(i).hi <= resize(point(i).hi, 33) - resize(origin(i), 33);
  end generate offset_lo_each;
end architecture rtl;
