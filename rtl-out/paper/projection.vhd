-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Projection of one point on the axis, p = v . l in interval arithmetic (equation 2).
-- (v_x l_x + v_y l_y) + v_z l_z, exact, then rounded outward once.
--
--   axis         v       l       p       |p| <=     rounding
--   n_a          s2.16   s3.15   s4.14   98309      17 bits dropped
--   n_b          s2.16   s4.14   s5.13   98305      17 bits dropped
--   c_00 to c_02 s2.16   s4.14   s5.13   98309      17 bits dropped
--   c_10 to c_12 s2.16   s5.13   s6.12   98309      17 bits dropped
--   c_20 to c_22 s2.16   s4.14   s5.13   98309      17 bits dropped
-- Latency: 3 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity projection is
  port (
    clk    : in  std_logic;
    v      : in  interval_18_vector_t;  -- |.| <= 65536
    v_case : in  unsigned_2_vector_t;
    l      : in  interval_18_vector_t;  -- |.| <= 65539
    l_case : in  unsigned_2_vector_t;
    p      : out interval_18_t  -- |.| <= 98309
  );
end entity projection;

architecture rtl of projection is
  signal term : interval_36_vector_t;  -- |.| <= 4295163904
  signal xy : interval_37_t;  -- |.| <= 8590327808
  signal xy_d1 : interval_37_t := zero_interval_37;  -- |.| <= 8590327808
  signal term_z_d1 : interval_36_t := zero_interval_36;  -- |.| <= 4295163904
  signal exact : interval_38_t;  -- |.| <= 12885491712
  signal p_hi_constant : std_logic;
begin
  -- Constants
  p_hi_constant <= '1';

  -- Clock 0
  term_unit : for i in 0 to 2 generate
    unit : entity work.interval_multiply
      port map (clk => clk, x => v(i), x_case => v_case(i), y => l(i), y_case => l_case(i), p => term(i));
  end generate term_unit;

  -- Clock 2
  xy.lo <= resize(term(0).lo, 37) + resize(term(1).lo, 37);
  xy.hi <= resize(term(0).hi, 37) + resize(term(1).hi, 37);

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      xy_d1 <= xy;
      term_z_d1 <= term(2);
    end if;
  end process clock_3;
  exact.lo <= resize(xy_d1.lo, 38) + resize(term_z_d1.lo, 38);
  exact.hi <= resize(xy_d1.hi, 38) + resize(term_z_d1.hi, 38);
  p.lo <= exact.lo(34 downto 17);
  p.hi <= exact.hi(34 downto 17) + to_signed(p_hi_constant, 18);
end architecture rtl;
