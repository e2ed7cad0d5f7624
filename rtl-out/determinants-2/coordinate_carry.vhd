-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Whether rounding makes R or -R of a coordinate along an axis: then a bit more is dropped.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity coordinate_carry is
  port (
    cut     : in  signed_19_x5_t;  -- |.| <= 262144
    carried : out std_logic
  );
end entity coordinate_carry;

architecture rtl of coordinate_carry is
begin
  -- Clock 0
  carried <= or_reduce((flag(known(cut(4)) = to_signed(-262144, 19)) or flag(known(cut(4)) = 262143)) &
      (flag(known(cut(3)) = to_signed(-262144, 19)) or flag(known(cut(3)) = 262143)) &
      (flag(known(cut(2)) = to_signed(-262144, 19)) or flag(known(cut(2)) = 262143)) &
      (flag(known(cut(1)) = to_signed(-262144, 19)) or flag(known(cut(1)) = 262143)) &
      (flag(known(cut(0)) = to_signed(-262144, 19)) or flag(known(cut(0)) = 262143)));
end architecture rtl;
