-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Pairs in one plane (section 5 of docs/exact.md). In a plane: separate if an edge parts the pair or the boxes are apart. On
-- one line (u = 0): if the boxes are apart. On two lines: if B does not have V_0, where they meet. Of triangles in a plane the
-- normals agree if the areas have one sign.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity plane_verdict is
  port (
    lines              : in  std_logic;
    no_u               : in  std_logic;
    parts              : in  std_logic_vector(5 downto 0);
    nearly             : in  std_logic_vector(5 downto 0);
    boxes_apart        : in  std_logic;
    boxes_nearly_apart : in  std_logic;
    boxes_with_0       : in  std_logic;
    boxes_sides_a      : in  std_logic;
    boxes_sides_b      : in  std_logic;
    areas              : in  flag_x2_x2_t;
    apart              : out std_logic;
    crosses            : out std_logic;
    agree              : out std_logic
  );
end entity plane_verdict;

architecture rtl of plane_verdict is
  signal two_lines : std_logic;
begin
  -- Clock 0
  two_lines <= lines and not no_u;
  apart <= boxes_apart or (not lines and or_reduce(unsigned(parts))) or (lines and not no_u and not boxes_with_0);
  crosses <= (two_lines and boxes_sides_a and boxes_sides_b) or
      (not two_lines and not (boxes_nearly_apart or (not lines and or_reduce(unsigned(nearly)))));
  agree <= (areas(0)(0) and areas(1)(0)) or (areas(0)(1) and areas(1)(1));
end architecture rtl;
