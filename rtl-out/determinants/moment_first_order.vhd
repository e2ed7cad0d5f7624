-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- F(x) = 4 x + 2^level x: what errors of coordinates are multiplied by, in eighths.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity moment_first_order is
  port (
    x           : in  unsigned(20 downto 0);
    by          : in  unsigned(2 downto 0);
    first_order : out unsigned(27 downto 0)
  );
end entity moment_first_order;

architecture rtl of moment_first_order is
  signal shifted : unsigned(26 downto 0);
begin
  -- Clock 0
  shifted <=
    resize(x, 27) when known(by) = 0 else
    resize(append(x, 1), 27) when known(by) = 1 else
    resize(append(x, 2), 27) when known(by) = 2 else
    resize(append(x, 3), 27) when known(by) = 3 else
    resize(append(x, 4), 27) when known(by) = 4 else
    resize(append(x, 5), 27) when known(by) = 5 else
    append(x, 6);
  first_order <= resize(append(x, 2), 28) + resize(shifted, 28);
end architecture rtl;
