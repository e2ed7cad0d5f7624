-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The verdict (sections 4 and 6 of docs/exact.md): of a pair in one plane by the rule for those, else intersect if an
-- edge hits. crosses: the relative interiors meet, as an edge pierces, or as each triangle has corners on both sides of
-- the other's plane and A has a part on the inner side of every edge of B. alike: a pair in one plane crosses, and the
-- normals agree. Of a pair that does not fit no flag is set.
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
    plane_agree   : in  std_logic;
    outside       : in  std_logic;
    verdict       : out unsigned(1 downto 0);
    separated     : out std_logic_vector(8 downto 0);
    overlapping   : out std_logic_vector(8 downto 0)
  );
end entity pair_verdict;

architecture rtl of pair_verdict is
  signal one_side : std_logic_vector(1 downto 0);
  signal both_sides : std_logic_vector(1 downto 0);
  signal in_plane : std_logic;  -- all six plane signs are 0
  signal edges_hits_d1 : std_logic_vector(5 downto 0) := (others => '0');
  signal edges_missed_d1 : std_logic_vector(5 downto 0) := (others => '0');
  signal hit : std_logic;
  signal pierced : std_logic;
  signal apart : std_logic;
  signal proper : std_logic;
  signal in_plane_d1 : std_logic := '0';
  signal proper_d1 : std_logic := '0';
  signal crosses_and_d1 : std_logic := '0';
  signal crosses : std_logic;
  signal plane_agree_d1 : std_logic := '0';
  signal alike : std_logic;
  signal outside_d1 : std_logic := '0';
  signal apart_d1 : std_logic := '0';
  signal one_side_d1 : std_logic_vector(1 downto 0) := (others => '0');
  signal pierced_d1 : std_logic := '0';
  signal overlapping1_and_d1 : std_logic := '0';
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
  pierced <= or_reduce(unsigned(edges_pierces));
  apart <= in_plane and (skew or plane_apart);
  proper <= pierced or (both_sides(0) and both_sides(1) and inner(0) and inner(1) and inner(2));

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      edges_hits_d1 <= edges_hits;
      edges_missed_d1 <= edges_missed;
      in_plane_d1 <= in_plane;
      proper_d1 <= proper;
      crosses_and_d1 <= not apart and plane_crosses;
      plane_agree_d1 <= plane_agree;
      outside_d1 <= outside;
      apart_d1 <= apart;
      one_side_d1 <= one_side;
      pierced_d1 <= pierced;
      overlapping1_and_d1 <= in_plane and not skew;
    end if;
  end process clock_1;
  hit <= or_reduce(unsigned(edges_hits_d1));
  crosses <= crosses_and_d1 when in_plane_d1 = '1' else proper_d1;
  alike <= in_plane_d1 and crosses and plane_agree_d1;
  intersects <= not outside_d1 and choose(in_plane_d1, not apart_d1, hit);
  verdict <= outside_d1 & intersects;
  separated(0) <= apart_d1 and not outside_d1;
  separated(1) <= one_side_d1(0) and not outside_d1;
  separated(2) <= one_side_d1(1) and not outside_d1;
  separated_from_3_each : for k in 0 to 5 generate
    separated(k + 3) <= edges_missed_d1(k) and not outside_d1;
  end generate separated_from_3_each;
  overlapping(0) <= crosses and not outside_d1;
  overlapping(1) <= overlapping1_and_d1 and not outside_d1;
  overlapping(2) <= (pierced_d1 or alike) and not outside_d1;
  overlapping_from_3_each : for k in 0 to 5 generate
    overlapping(k + 3) <= edges_hits_d1(k) and not outside_d1;
  end generate overlapping_from_3_each;
end architecture rtl;
