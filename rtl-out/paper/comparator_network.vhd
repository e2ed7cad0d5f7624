-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Decides one axis by comparing every point of A with every point of B (equations 3 and 6):
--   above: b_lo > a_hi; below: a_lo > b_hi
--   separated   = all above or all below, so b_min_lo > a_max_hi or a_min_lo > b_max_hi
--   overlapping = some above and some below, so a_min_hi < b_max_lo and b_min_hi < a_max_lo (sound in place of
--                 equations 7 to 9; strict)
-- p(0) to p(2) are A's, p(3) to p(5) are B's from the last one down.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity comparator_network is
  port (
    clk         : in  std_logic;
    p           : in  interval_18_x6_t;  -- |.| <= 98309
    separated   : out std_logic;
    overlapping : out std_logic := '0'
  );
end entity comparator_network;

architecture rtl of comparator_network is
  signal above : std_logic_vector(8 downto 0);
  signal below : std_logic_vector(8 downto 0);
  signal not_all_above : std_logic;
  signal not_all_below : std_logic;
  signal separated_and_d1 : std_logic := '0';
  signal some_above : std_logic;
  signal some_below : std_logic;
  signal overlapping_i : std_logic;
begin
  -- Clock 0
  above(0) <= less(p(0).hi, p(5).lo);
  above(1) <= less(p(0).hi, p(4).lo);
  above(2) <= less(p(0).hi, p(3).lo);
  above(3) <= less(p(1).hi, p(5).lo);
  above(4) <= less(p(1).hi, p(4).lo);
  above(5) <= less(p(1).hi, p(3).lo);
  above(6) <= less(p(2).hi, p(5).lo);
  above(7) <= less(p(2).hi, p(4).lo);
  above(8) <= less(p(2).hi, p(3).lo);
  below(0) <= less(p(5).hi, p(0).lo);
  below(1) <= less(p(4).hi, p(0).lo);
  below(2) <= less(p(3).hi, p(0).lo);
  below(3) <= less(p(5).hi, p(1).lo);
  below(4) <= less(p(4).hi, p(1).lo);
  below(5) <= less(p(3).hi, p(1).lo);
  below(6) <= less(p(5).hi, p(2).lo);
  below(7) <= less(p(4).hi, p(2).lo);
  below(8) <= less(p(3).hi, p(2).lo);
  not_all_above <= or_reduce(not above(8) & not above(7) & not above(6) & not above(5) & not above(4) & not above(3) &
      not above(2) & not above(1) & not above(0));
  not_all_below <= or_reduce(not below(8) & not below(7) & not below(6) & not below(5) & not below(4) & not below(3) &
      not below(2) & not below(1) & not below(0));
  some_above <= or_reduce(unsigned(above));
  some_below <= or_reduce(unsigned(below));
  overlapping_i <= some_above and some_below;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      separated_and_d1 <= not_all_above and not_all_below;
      overlapping <= overlapping_i;
    end if;
  end process clock_1;
  separated <= not separated_and_d1;
end architecture rtl;
