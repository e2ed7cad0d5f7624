-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The sign of a number: (0) it is positive, (1) it is negative.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity exact_sign is
  port (
    x    : in  signed(59 downto 0);  -- |.| <= 54042164741537791
    sign : out std_logic_vector(1 downto 0)
  );
end entity exact_sign;

architecture rtl of exact_sign is
  signal sign_i : std_logic_vector(1 downto 0);
  signal sign0_not_second_equal_constant : signed(59 downto 0);  -- |.| <= 0
begin
  -- Constants
  sign0_not_second_equal_constant <= to_signed(0, 60);

  -- Clock 0
  sign_i(0) <= not sign_i(1) and not flag(known(x) = known(sign0_not_second_equal_constant));
  sign_i(1) <= x(59);

  -- Outputs
  sign <= sign_i;
end architecture rtl;
