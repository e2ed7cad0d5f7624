-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The first of three points that is not 0, or the last of them.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity first_point is
  port (
    clk   : in  std_logic;
    x     : in  signed_18_vector_t;  -- |.| <= 131071
    y     : in  signed_18_vector_t;  -- |.| <= 131071
    z     : in  signed_18_vector_t;  -- |.| <= 131071
    first : out signed_18_vector_t  -- |.| <= 131071
  );
end entity first_point;

architecture rtl of first_point is
  signal y_x_equal_not_word_any : std_logic;
  signal x_x_equal_not_word_any_d1 : std_logic := '0';
  signal first_choice_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal x_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
begin
  -- Clock 0
  y_x_equal_not_word_any <= or_reduce(not flag(known(y(2)) = 0) & not flag(known(y(1)) = 0) & not
      flag(known(y(0)) = 0));

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      x_x_equal_not_word_any_d1 <= or_reduce(not flag(known(x(2)) = 0) & not flag(known(x(1)) = 0) & not
          flag(known(x(0)) = 0));
      if y_x_equal_not_word_any = '1' then
        first_choice_d1 <= y;
      else
        first_choice_d1 <= z;
      end if;
      x_d1 <= x;
    end if;
  end process clock_1;
  first <= x_d1 when x_x_equal_not_word_any_d1 = '1' else first_choice_d1;
end architecture rtl;
