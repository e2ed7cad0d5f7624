-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Whether a number is certainly positive, and whether it is certainly negative: x > bound, x < -bound.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity certain_sign is
  port (
    x     : in  signed(40 downto 0);  -- |.| <= 206156857344
    bound : in  signed(30 downto 0);  -- |.| <= 67665506
    sign  : out std_logic_vector(1 downto 0)
  );
end entity certain_sign;

architecture rtl of certain_sign is
  signal sign1_sum : signed(41 downto 0);  -- |.| <= 206224522850
begin
  -- Clock 0
  sign1_sum <= resize(x, 42) + resize(bound, 42);
  sign(0) <= less(resize(bound, 41), x);
  sign(1) <= sign1_sum(41);
end architecture rtl;
