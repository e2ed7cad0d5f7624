-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- F(x) = 4 x + 2^level x: what errors of coordinates are multiplied by, in eighths.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity length_first_order is
  port (
    x           : in  unsigned(21 downto 0);
    by          : in  unsigned(2 downto 0);
    first_order : out unsigned(28 downto 0)
  );
end entity length_first_order;

architecture rtl of length_first_order is
  signal shifted : unsigned(27 downto 0);
begin
  -- Clock 0
  shifted <=
    resize(x, 28) when known(by) = 0 else
    resize(append(x, 1), 28) when known(by) = 1 else
    resize(append(x, 2), 28) when known(by) = 2 else
    resize(append(x, 3), 28) when known(by) = 3 else
    resize(append(x, 4), 28) when known(by) = 4 else
    resize(append(x, 5), 28) when known(by) = 5 else
    append(x, 6);
  first_order <= resize(append(x, 2), 29) + resize(shifted, 29);
end architecture rtl;
