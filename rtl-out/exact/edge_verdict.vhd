-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- An edge and the other triangle. It is missed if both ends are on one side of the triangle's plane, or if the sides
-- on which it passes the other edges differ. Else it hits, unless it is in the plane. It pierces if the ends are on
-- different sides and the other edges are all passed on one. Of each sign (0) says that it is positive, (1) negative.
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
    hits    : out std_logic;
    pierces : out std_logic
  );
end entity edge_verdict;

architecture rtl of edge_verdict is
  signal missed_i : std_logic;
begin
  -- Clock 0
  missed_i <= (ends(0)(0) and ends(1)(0)) or (ends(0)(1) and ends(1)(1)) or
      (or_reduce(sides(2)(0) & sides(1)(0) & sides(0)(0)) and or_reduce(sides(2)(1) & sides(1)(1) & sides(0)(1)));
  hits <= or_reduce(unsigned(ends(1)) & unsigned(ends(0))) and not missed_i;
  pierces <= ((ends(0)(0) and ends(1)(1)) or (ends(0)(1) and ends(1)(0))) and
      ((sides(0)(0) and sides(1)(0) and sides(2)(0)) or (sides(0)(1) and sides(1)(1) and sides(2)(1)));

  -- Outputs
  missed <= missed_i;
end architecture rtl;
