-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- An edge and the other triangle. It is missed if both ends are on one side of the triangle's plane, or if the sides
-- on which it passes the other edges differ. It pierces if the ends are on different sides and the sides are alike.
-- Of each sign (0) says that it is positive, (1) that it is negative, for certain.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity edge_verdict is
  port (
    ends    : in  flag_x2_x2_t;
    sides   : in  flag_x2_x3_t;
    missed  : out std_logic;
    pierces : out std_logic
  );
end entity edge_verdict;

architecture rtl of edge_verdict is
begin
  -- Clock 0
  missed <= (ends(0)(0) and ends(1)(0)) or (ends(0)(1) and ends(1)(1)) or
      (or_reduce(sides(2)(0) & sides(1)(0) & sides(0)(0)) and or_reduce(sides(2)(1) & sides(1)(1) & sides(0)(1)));
  pierces <= ((ends(0)(0) and ends(1)(1)) or (ends(0)(1) and ends(1)(0))) and
      ((sides(0)(0) and sides(1)(0) and sides(2)(0)) or (sides(0)(1) and sides(1)(1) and sides(2)(1)));
end architecture rtl;
