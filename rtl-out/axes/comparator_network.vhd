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
    p           : in  interval_22_x4_t;  -- |.| <= 1572852
    has         : in  flag_x2_x2_t;
    separated   : out std_logic;
    overlapping : out std_logic
  );
end entity comparator_network;

architecture rtl of comparator_network is
  signal a : interval_22_x2_t;  -- |.| <= 1572852
  signal b : interval_22_x2_t;  -- |.| <= 1572852
  signal a_ordered_lo : std_logic;
  signal a_lesser_lo : signed(21 downto 0);  -- |.| <= 1572852
  signal a_greater_lo : signed(21 downto 0);  -- |.| <= 1572852
  signal a_lesser_lo_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal a1_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
  signal a_min : interval_22_t;  -- |.| <= 1572852
  signal a_greater_lo_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal a_max : interval_22_t;  -- |.| <= 1572852
  signal a_ordered_hi : std_logic;
  signal a_lesser_hi : signed(21 downto 0);  -- |.| <= 1572852
  signal a_greater_hi : signed(21 downto 0);  -- |.| <= 1572852
  signal a_lesser_hi_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal a_greater_hi_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal b_ordered_lo : std_logic;
  signal b_lesser_lo : signed(21 downto 0);  -- |.| <= 1572852
  signal b_greater_lo : signed(21 downto 0);  -- |.| <= 1572852
  signal b_lesser_lo_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal b1_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
  signal b_min : interval_22_t;  -- |.| <= 1572852
  signal b_greater_lo_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal b_max : interval_22_t;  -- |.| <= 1572852
  signal b_ordered_hi : std_logic;
  signal b_lesser_hi : signed(21 downto 0);  -- |.| <= 1572852
  signal b_greater_hi : signed(21 downto 0);  -- |.| <= 1572852
  signal b_lesser_hi_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal b_greater_hi_d1 : signed(21 downto 0) := (others => '0');  -- |.| <= 1572852
  signal a_max_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
  signal b_min_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
  signal b_max_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
  signal a_min_d1 : interval_22_t := zero_interval_22;  -- |.| <= 1572852
begin
  -- Clock 0
  a_each : for k in 0 to 1 generate
    a(k) <= p(k + 1) when has(0)(k) = '1' else p(0);
  end generate a_each;
  b(0) <= p(2) when has(1)(0) = '1' else p(3);
  b(1) <= p(1) when has(1)(1) = '1' else p(3);
  a_ordered_lo <= less(p(0).lo, a(0).lo);
  a_lesser_lo <= p(0).lo when a_ordered_lo = '1' else a(0).lo;
  a_greater_lo <= a(0).lo when a_ordered_lo = '1' else p(0).lo;
  a_ordered_hi <= less(p(0).hi, a(0).hi);
  a_lesser_hi <= p(0).hi when a_ordered_hi = '1' else a(0).hi;
  a_greater_hi <= a(0).hi when a_ordered_hi = '1' else p(0).hi;
  b_ordered_lo <= less(p(3).lo, b(0).lo);
  b_lesser_lo <= p(3).lo when b_ordered_lo = '1' else b(0).lo;
  b_greater_lo <= b(0).lo when b_ordered_lo = '1' else p(3).lo;
  b_ordered_hi <= less(p(3).hi, b(0).hi);
  b_lesser_hi <= p(3).hi when b_ordered_hi = '1' else b(0).hi;
  b_greater_hi <= b(0).hi when b_ordered_hi = '1' else p(3).hi;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      a_lesser_lo_d1 <= a_lesser_lo;
      a1_d1 <= a(1);
      a_greater_lo_d1 <= a_greater_lo;
      a_lesser_hi_d1 <= a_lesser_hi;
      a_greater_hi_d1 <= a_greater_hi;
      b_lesser_lo_d1 <= b_lesser_lo;
      b1_d1 <= b(1);
      b_greater_lo_d1 <= b_greater_lo;
      b_lesser_hi_d1 <= b_lesser_hi;
      b_greater_hi_d1 <= b_greater_hi;
    end if;
  end process clock_1;
  a_min.lo <= a_lesser_lo_d1 when less(a_lesser_lo_d1, a1_d1.lo) = '1' else a1_d1.lo;
  a_min.hi <= a_lesser_hi_d1 when less(a_lesser_hi_d1, a1_d1.hi) = '1' else a1_d1.hi;
  a_max.lo <= a1_d1.lo when less(a_greater_lo_d1, a1_d1.lo) = '1' else a_greater_lo_d1;
  a_max.hi <= a1_d1.hi when less(a_greater_hi_d1, a1_d1.hi) = '1' else a_greater_hi_d1;
  b_min.lo <= b_lesser_lo_d1 when less(b_lesser_lo_d1, b1_d1.lo) = '1' else b1_d1.lo;
  b_min.hi <= b_lesser_hi_d1 when less(b_lesser_hi_d1, b1_d1.hi) = '1' else b1_d1.hi;
  b_max.lo <= b1_d1.lo when less(b_greater_lo_d1, b1_d1.lo) = '1' else b_greater_lo_d1;
  b_max.hi <= b1_d1.hi when less(b_greater_hi_d1, b1_d1.hi) = '1' else b_greater_hi_d1;

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
