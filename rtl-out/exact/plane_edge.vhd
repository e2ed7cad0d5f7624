-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- An edge of a triangle, the sides of it on which the other's corners are, and the sign of its own triangle's area.
-- It parts the pair if all corners are on the outer side; nearly, if some are on its line, but not everything is.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity plane_edge is
  port (
    clk    : in  std_logic;
    x      : in  signed_38_x3_t;  -- |.| <= 103077642246
    area   : in  std_logic_vector(1 downto 0);
    parts  : out std_logic;
    nearly : out std_logic
  );
end entity plane_edge;

architecture rtl of plane_edge is
  signal above : std_logic_vector(2 downto 0);
  signal below : std_logic_vector(2 downto 0);
  signal parts_and_second_and_d1 : std_logic := '0';
  signal parts_and_second_not_d1 : std_logic := '0';
  signal parts_and_first_d1 : std_logic := '0';
  signal some_above : std_logic;
  signal some_below : std_logic;
  signal nearly_and_first_and_not_first_d1 : std_logic := '0';
  signal nearly_and_first_and_not_second_d1 : std_logic := '0';
  signal nearly_and_first_or_d1 : std_logic := '0';
  signal nearly_and_second_and_d1 : std_logic := '0';
  signal nearly_and_second_or_d1 : std_logic := '0';
begin
  -- Clock 0
  above_each : for k in 0 to 2 generate
    above(k) <= not x(k)(37) and not flag(known(x(k)) = 0);
    below(k) <= x(k)(37);
  end generate above_each;
  some_above <= or_reduce(unsigned(above));
  some_below <= or_reduce(unsigned(below));

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      parts_and_second_and_d1 <= above(0) and above(1) and above(2);
      parts_and_second_not_d1 <= not area(0);
      parts_and_first_d1 <= below(0) and below(1) and below(2) and not area(1);
      nearly_and_first_and_not_first_d1 <= not some_above;
      nearly_and_first_and_not_second_d1 <= not area(1);
      nearly_and_first_or_d1 <= some_below or area(0);
      nearly_and_second_and_d1 <= not some_below and not area(0);
      nearly_and_second_or_d1 <= some_above or area(1);
    end if;
  end process clock_1;
  parts <= parts_and_first_d1 or (parts_and_second_and_d1 and parts_and_second_not_d1);
  nearly <= (nearly_and_first_and_not_first_d1 and nearly_and_first_and_not_second_d1 and nearly_and_first_or_d1) or
      (nearly_and_second_and_d1 and nearly_and_second_or_d1);
end architecture rtl;
