-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- p contains x * y, by sign cases: two products, none rounded. Wider than x * y only where both straddle 0.
--
--   x \ y   y_lo >= 0                   y_hi <= 0                   y straddles 0
--   x_lo>=0  [x_lo*y_lo, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_hi]      [x_hi*y_lo, x_hi*y_hi]
--   x_hi<=0  [x_lo*y_hi, x_hi*y_lo]      [x_hi*y_hi, x_lo*y_lo]      [x_lo*y_hi, x_lo*y_lo]
--   x str.0  [x_lo*y_hi, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_lo]      [-P, P]
--
--   P = max(-x_lo, x_hi) * max(-y_lo, y_hi): the bounds farther from zero, one of them negated where their
--   signs would give the other end. Sign cases are those of unit sign_case.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity interval_multiply is
  port (
    clk    : in  std_logic;
    x      : in  interval_18_t;  -- |.| <= 65537
    x_case : in  unsigned(1 downto 0);
    y      : in  interval_18_t;  -- |.| <= 131071
    y_case : in  unsigned(1 downto 0);
    p      : out interval_36_t  -- |.| <= 8589869056
  );
end entity interval_multiply;

architecture rtl of interval_multiply is
  constant lo_takes_x_hi_table : std_logic_vector(0 to 15) := "0111010001110100";
  constant lo_takes_y_hi_table : std_logic_vector(0 to 15) := "0000111110101010";
  constant lo_negates_x_table : std_logic_vector(0 to 15) := "0000000000100001";
  constant hi_takes_x_hi_table : std_logic_vector(0 to 15) := "1011100010111000";
  constant hi_takes_y_hi_table : std_logic_vector(0 to 15) := "1111000010101010";
  constant hi_negates_x_table : std_logic_vector(0 to 15) := "0000000000010010";
  signal cases : unsigned(3 downto 0);  -- 4 * (sign case of x) + (sign case of y)
  signal p_x_d1 : interval_18_t := zero_interval_18;  -- |.| <= 65537
  signal p_y_d1 : interval_18_t := zero_interval_18;  -- |.| <= 131071
begin
  -- Clock 0
  cases <= x_case & y_case;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      p_x_d1.lo <= negated_if(lo_negates_x_table(to_integer(known(cases))),
          choose(lo_takes_x_hi_table(to_integer(known(cases))), x.hi, x.lo));
      p_x_d1.hi <= negated_if(hi_negates_x_table(to_integer(known(cases))),
          choose(hi_takes_x_hi_table(to_integer(known(cases))), x.hi, x.lo));
      p_y_d1.lo <= choose(lo_takes_y_hi_table(to_integer(known(cases))), y.hi, y.lo);
      p_y_d1.hi <= choose(hi_takes_y_hi_table(to_integer(known(cases))), y.hi, y.lo);
    end if;
  end process clock_1;
  p_lo_unit : entity work.multiply_18_18
    port map (clk => clk, x => p_x_d1.lo, y => p_y_d1.lo, p => p.lo);
  p_hi_unit : entity work.multiply_18_18
    port map (clk => clk, x => p_x_d1.hi, y => p_y_d1.hi, p => p.hi);
end architecture rtl;
