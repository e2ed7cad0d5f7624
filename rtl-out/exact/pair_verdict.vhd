-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The verdict (sections 4 and 6 of docs/exact.md): of a pair in one plane by the rule for those, else intersect if an
-- edge hits. crosses: the relative interiors meet, as an edge pierces, or as each triangle has corners on both sides of
-- the other's plane and A has a part on the inner side of every edge of B. Of a pair that does not fit no flag is set.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_verdict is
  port (
    clk           : in  std_logic;
    planes        : in  flag_x2_x3_x2_t;
    edges_missed  : in  std_logic_vector(5 downto 0);
    edges_hits    : in  std_logic_vector(5 downto 0);
    edges_pierces : in  std_logic_vector(5 downto 0);
    inner         : in  std_logic_vector(2 downto 0);
    skew          : in  std_logic;
    plane_apart   : in  std_logic;
    plane_crosses : in  std_logic;
    outside       : in  std_logic;
    verdict       : out unsigned(1 downto 0);
    separated     : out std_logic_vector(8 downto 0) := (others => '0');
    overlapping   : out std_logic_vector(8 downto 0)
  );
end entity pair_verdict;

architecture rtl of pair_verdict is
  signal one_side : std_logic_vector(1 downto 0);
  signal both_sides : std_logic_vector(1 downto 0);
  signal in_plane : std_logic;  -- all six plane signs are 0
  signal hit : std_logic;
  signal pierced : std_logic;
  signal apart : std_logic;
  signal proper : std_logic;
  signal in_plane_d1 : std_logic := '0';
  signal proper_d1 : std_logic := '0';
  signal crosses_and_d1 : std_logic := '0';
  signal crosses : std_logic;
  signal separated_i : std_logic_vector(8 downto 0);
  signal outside_d1 : std_logic := '0';
  signal overlapping1_and_d1 : std_logic := '0';
  signal pierced_d1 : std_logic := '0';
  signal edges_hits_d1 : std_logic_vector(5 downto 0) := (others => '0');
  signal intersects_choice_d1 : std_logic := '0';
  signal intersects : std_logic;
begin
  -- Clock 0
  one_side_each : for k in 0 to 1 generate
    one_side(k) <= (planes(k)(0)(0) and planes(k)(1)(0) and planes(k)(2)(0)) or
        (planes(k)(0)(1) and planes(k)(1)(1) and planes(k)(2)(1));
    both_sides(k) <= or_reduce(planes(k)(2)(0) & planes(k)(1)(0) & planes(k)(0)(0)) and
        or_reduce(planes(k)(2)(1) & planes(k)(1)(1) & planes(k)(0)(1));
  end generate one_side_each;
  in_plane <= not or_reduce(unsigned(planes(1)(2)) & unsigned(planes(1)(1)) & unsigned(planes(1)(0)) &
      unsigned(planes(0)(2)) & unsigned(planes(0)(1)) & unsigned(planes(0)(0)));
  hit <= or_reduce(unsigned(edges_hits));
  pierced <= or_reduce(unsigned(edges_pierces));
  apart <= in_plane and (skew or plane_apart);
  proper <= pierced or (both_sides(0) and both_sides(1) and inner(0) and inner(1) and inner(2));
  separated_i(0) <= apart and not outside;
  separated_i(1) <= one_side(0) and not outside;
  separated_i(2) <= one_side(1) and not outside;
  separated_i(3) <= edges_missed(0) and not outside;
  separated_i(4) <= edges_missed(1) and not outside;
  separated_i(5) <= edges_missed(2) and not outside;
  separated_i(6) <= edges_missed(3) and not outside;
  separated_i(7) <= edges_missed(4) and not outside;
  separated_i(8) <= edges_missed(5) and not outside;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      in_plane_d1 <= in_plane;
      proper_d1 <= proper;
      crosses_and_d1 <= not apart and plane_crosses;
      outside_d1 <= outside;
      overlapping1_and_d1 <= in_plane and not skew;
      pierced_d1 <= pierced;
      edges_hits_d1 <= edges_hits;
      if in_plane = '1' then
        intersects_choice_d1 <= not apart;
      else
        intersects_choice_d1 <= hit;
      end if;
      separated <= separated_i;
    end if;
  end process clock_1;
  crosses <= crosses_and_d1 when in_plane_d1 = '1' else proper_d1;
  intersects <= not outside_d1 and intersects_choice_d1;
  verdict <= outside_d1 & intersects;
  overlapping(0) <= crosses and not outside_d1;
  overlapping(1) <= overlapping1_and_d1 and not outside_d1;
  overlapping(2) <= pierced_d1 and not outside_d1;
  overlapping(3) <= edges_hits_d1(0) and not outside_d1;
  overlapping(4) <= edges_hits_d1(1) and not outside_d1;
  overlapping(5) <= edges_hits_d1(2) and not outside_d1;
  overlapping(6) <= edges_hits_d1(3) and not outside_d1;
  overlapping(7) <= edges_hits_d1(4) and not outside_d1;
  overlapping(8) <= edges_hits_d1(5) and not outside_d1;
end architecture rtl;
