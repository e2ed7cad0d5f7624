-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- A difference in 18 bits. One beyond +-131071 is flagged, and 0 goes on.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity difference_fit is
  port (
    x       : in  signed(32 downto 0);  -- |.| <= 4294967295
    fitted  : out signed(17 downto 0);  -- |.| <= 131071
    outside : out std_logic
  );
end entity difference_fit;

architecture rtl of difference_fit is
  signal outside_i : std_logic;
  signal fitted_choice : signed(32 downto 0);  -- |.| <= 131071
begin
  -- Clock 0
  outside_i <= less(x, to_signed(-131071, 33)) or less(to_signed(131071, 33), x);
  fitted_choice <= to_signed(0, 33) when outside_i = '1' else x;
  fitted <= fitted_choice(17 downto 0);

  -- Outputs
  outside <= outside_i;
end architecture rtl;
