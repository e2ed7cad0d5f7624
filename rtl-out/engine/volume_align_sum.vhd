-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- x 2^e / 2^11, rounded down: a barrel shifter, bit i of the exponent shifts by 2^i.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_align_sum is
  port (
    x        : in  signed(23 downto 0);  -- |.| <= 6287873
    exponent : in  unsigned(3 downto 0);
    aligned  : out signed(27 downto 0)  -- s6.22; |.| <= 100605968
  );
end entity volume_align_sum;

architecture rtl of volume_align_sum is
  signal shifted_0 : signed(24 downto 0);  -- |.| <= 12575746
  signal shifted_1 : signed(26 downto 0);  -- |.| <= 50302984
  signal shifted_2 : signed(30 downto 0);  -- |.| <= 804847744
  signal shifted_2_floor_3 : signed(27 downto 0);  -- |.| <= 100605968
  signal shifted_3 : signed(35 downto 0);  -- |.| <= 25755127808
begin
  -- Clock 0
  shifted_0 <= append(x, 1) when exponent(0) = '1' else resize(x, 25);
  shifted_1 <= append(shifted_0, 2) when exponent(1) = '1' else resize(shifted_0, 27);
  shifted_2 <= append(shifted_1, 4) when exponent(2) = '1' else resize(shifted_1, 31);
  shifted_2_floor_3 <= shifted_2(30 downto 3);
  shifted_3 <= append(shifted_2_floor_3, 8) when exponent(3) = '1' else resize(shifted_2_floor_3, 36);
  aligned <= shifted_3(35 downto 8);
end architecture rtl;
