-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Decides one axis by comparing every point of A with every point of B (equations 3 and 6):
--   above: b_lo > a_hi; below: a_lo > b_hi
--   separated   = all above or all below, so b_min_lo > a_max_hi or a_min_lo > b_max_hi
--   overlapping = some above and some below, so a_min_hi < b_max_lo and b_min_hi < a_max_lo (sound in place of
--                 equations 7 to 9; strict)
-- p(0) is A's, p(3) is B's. separated and overlapping count comparisons of A with B:
--   p(1) is A's if has(0)(0) is set, B's if has(1)(1) is set
--   p(2) is A's if has(0)(1) is set, B's if has(1)(0) is set
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity comparator_network is
  port (
    clk         : in  std_logic;
    p           : in  interval_22_x4_t;  -- |.| <= 1572852
    has         : in  flag_x2_x2_t;
    separated   : out std_logic;
    overlapping : out std_logic := '0';
    above       : out std_logic_vector(5 downto 0) := (others => '0');
    below       : out std_logic_vector(5 downto 0) := (others => '0')
  );
end entity comparator_network;

architecture rtl of comparator_network is
  signal above_i : std_logic_vector(5 downto 0);
  signal below_i : std_logic_vector(5 downto 0);
  signal counts4 : std_logic;
  signal not_all_above : std_logic;
  signal not_all_below : std_logic;
  signal not_all_above_d1 : std_logic := '0';
  signal not_all_below_d1 : std_logic := '0';
  signal some_above : std_logic;
  signal some_below : std_logic;
  signal overlapping_i : std_logic;
begin
  -- Clock 0
  above_i(0) <= less(p(0).hi, p(3).lo);
  above_i(1) <= less(p(0).hi, p(2).lo);
  above_i(2) <= less(p(0).hi, p(1).lo);
  above_i(3) <= less(p(1).hi, p(3).lo);
  above_i(4) <= less(p(1).hi, p(2).lo);
  above_i(5) <= less(p(2).hi, p(3).lo);
  below_i(0) <= less(p(3).hi, p(0).lo);
  below_i(1) <= less(p(2).hi, p(0).lo);
  below_i(2) <= less(p(1).hi, p(0).lo);
  below_i(3) <= less(p(3).hi, p(1).lo);
  below_i(4) <= less(p(2).hi, p(1).lo);
  below_i(5) <= less(p(3).hi, p(2).lo);
  counts4 <= has(0)(0) and has(1)(0);
  not_all_above <= or_reduce((not above_i(5) and has(0)(1)) & (not above_i(4) and counts4) &
      (not above_i(3) and has(0)(0)) & (not above_i(2) and has(1)(1)) & (not above_i(1) and has(1)(0)) & not
      above_i(0));
  not_all_below <= or_reduce((not below_i(5) and has(0)(1)) & (not below_i(4) and counts4) &
      (not below_i(3) and has(0)(0)) & (not below_i(2) and has(1)(1)) & (not below_i(1) and has(1)(0)) & not
      below_i(0));
  some_above <= or_reduce((above_i(5) and has(0)(1)) & (above_i(4) and counts4) & (above_i(3) and has(0)(0)) &
      (above_i(2) and has(1)(1)) & (above_i(1) and has(1)(0)) & above_i(0));
  some_below <= or_reduce((below_i(5) and has(0)(1)) & (below_i(4) and counts4) & (below_i(3) and has(0)(0)) &
      (below_i(2) and has(1)(1)) & (below_i(1) and has(1)(0)) & below_i(0));
  overlapping_i <= some_above and some_below;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      not_all_above_d1 <= not_all_above;
      not_all_below_d1 <= not_all_below;
      overlapping <= overlapping_i;
      above <= above_i;
      below <= below_i;
    end if;
  end process clock_1;
  separated <= not (not_all_above_d1 and not_all_below_d1);
end architecture rtl;
