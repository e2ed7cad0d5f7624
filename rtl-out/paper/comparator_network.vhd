--------------------------------------------------------------------------------
-- Decides one axis: enclosures of the least and greatest projection of each triangle (equation 3), then
--   separated   = b_min_lo > a_max_hi or a_min_lo > b_max_hi   (equation 6)
--   overlapping = a_min_hi < b_max_lo and b_min_hi < a_max_lo  (sound in place of 7 to 9; strict)
-- Latency: 2 clocks.
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
    overlapping : out std_logic
  );
end entity comparator_network;

architecture rtl of comparator_network is
  signal a_ordered_lo : std_logic;
  signal a_lesser_lo : signed(17 downto 0);  -- |.| <= 98309
  signal a_greater_lo : signed(17 downto 0);  -- |.| <= 98309
  signal a_lesser_lo_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal p2_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
  signal p5_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
  signal a_min : interval_18_t;  -- |.| <= 98309
  signal a_greater_lo_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal a_max : interval_18_t;  -- |.| <= 98309
  signal a_ordered_hi : std_logic;
  signal a_lesser_hi : signed(17 downto 0);  -- |.| <= 98309
  signal a_greater_hi : signed(17 downto 0);  -- |.| <= 98309
  signal a_lesser_hi_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal a_greater_hi_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal b_ordered_lo : std_logic;
  signal b_lesser_lo : signed(17 downto 0);  -- |.| <= 98309
  signal b_greater_lo : signed(17 downto 0);  -- |.| <= 98309
  signal b_lesser_lo_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal b_min : interval_18_t;  -- |.| <= 98309
  signal b_greater_lo_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal b_max : interval_18_t;  -- |.| <= 98309
  signal b_ordered_hi : std_logic;
  signal b_lesser_hi : signed(17 downto 0);  -- |.| <= 98309
  signal b_greater_hi : signed(17 downto 0);  -- |.| <= 98309
  signal b_lesser_hi_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal b_greater_hi_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 98309
  signal a_max_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
  signal b_min_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
  signal b_max_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
  signal a_min_d1 : interval_18_t := zero_interval_18;  -- |.| <= 98309
begin
  -- Clock 0
  a_ordered_lo <= less(p(0).lo, p(1).lo);
  a_lesser_lo <= p(0).lo when a_ordered_lo = '1' else p(1).lo;
  a_greater_lo <= p(1).lo when a_ordered_lo = '1' else p(0).lo;
  a_ordered_hi <= less(p(0).hi, p(1).hi);
  a_lesser_hi <= p(0).hi when a_ordered_hi = '1' else p(1).hi;
  a_greater_hi <= p(1).hi when a_ordered_hi = '1' else p(0).hi;
  b_ordered_lo <= less(p(3).lo, p(4).lo);
  b_lesser_lo <= p(3).lo when b_ordered_lo = '1' else p(4).lo;
  b_greater_lo <= p(4).lo when b_ordered_lo = '1' else p(3).lo;
  b_ordered_hi <= less(p(3).hi, p(4).hi);
  b_lesser_hi <= p(3).hi when b_ordered_hi = '1' else p(4).hi;
  b_greater_hi <= p(4).hi when b_ordered_hi = '1' else p(3).hi;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      a_lesser_lo_d1 <= a_lesser_lo;
      p2_d1 <= p(2);
      p5_d1 <= p(5);
      a_greater_lo_d1 <= a_greater_lo;
      a_lesser_hi_d1 <= a_lesser_hi;
      a_greater_hi_d1 <= a_greater_hi;
      b_lesser_lo_d1 <= b_lesser_lo;
      b_greater_lo_d1 <= b_greater_lo;
      b_lesser_hi_d1 <= b_lesser_hi;
      b_greater_hi_d1 <= b_greater_hi;
    end if;
  end process clock_1;
  a_min.lo <= a_lesser_lo_d1 when less(a_lesser_lo_d1, p2_d1.lo) = '1' else p2_d1.lo;
  a_min.hi <= a_lesser_hi_d1 when less(a_lesser_hi_d1, p2_d1.hi) = '1' else p2_d1.hi;
  a_max.lo <= p2_d1.lo when less(a_greater_lo_d1, p2_d1.lo) = '1' else a_greater_lo_d1;
  a_max.hi <= p2_d1.hi when less(a_greater_hi_d1, p2_d1.hi) = '1' else a_greater_hi_d1;
  b_min.lo <= b_lesser_lo_d1 when less(b_lesser_lo_d1, p5_d1.lo) = '1' else p5_d1.lo;
  b_min.hi <= b_lesser_hi_d1 when less(b_lesser_hi_d1, p5_d1.hi) = '1' else p5_d1.hi;
  b_max.lo <= p5_d1.lo when less(b_greater_lo_d1, p5_d1.lo) = '1' else b_greater_lo_d1;
  b_max.hi <= p5_d1.hi when less(b_greater_hi_d1, p5_d1.hi) = '1' else b_greater_hi_d1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      a_max_d1 <= a_max;
      b_min_d1 <= b_min;
      b_max_d1 <= b_max;
      a_min_d1 <= a_min;
    end if;
  end process clock_2;
  separated <= less(a_max_d1.hi, b_min_d1.lo) or less(b_max_d1.hi, a_min_d1.lo);
  overlapping <= less(a_min_d1.hi, b_max_d1.lo) and less(b_min_d1.hi, a_max_d1.lo);
end architecture rtl;
