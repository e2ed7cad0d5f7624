-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The verdict: separate if the boxes are apart, if a plane has the other triangle on one side, or if at least five of
-- the six edges are missed; else intersect if an edge pierces; else possibly incorrect.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_verdict is
  port (
    separated   : in  std_logic_vector(8 downto 0);
    overlapping : in  std_logic_vector(8 downto 0);
    verdict     : out unsigned(1 downto 0)
  );
end entity pair_verdict;

architecture rtl of pair_verdict is
  constant five_missed_table : std_logic_vector(0 to 63) := "0000000000000000000000000000000100000000000000010000000100010111";
  signal edges_missed : unsigned(5 downto 0);
  signal separate : std_logic;
  signal intersects : std_logic;
begin
  -- Clock 0
  edges_missed <= separated(8) & separated(7) & separated(6) & separated(5) & separated(4) & separated(3);
  separate <= or_reduce(separated(2) & separated(1) & separated(0)) or
      five_missed_table(to_integer(known(edges_missed)));
  intersects <= not separate and or_reduce(overlapping(8) & overlapping(7) & overlapping(6) & overlapping(5) &
      overlapping(4) & overlapping(3));
  verdict <= (not separate and not intersects) & intersects;
end architecture rtl;
