-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- x 2^e: a barrel shifter, bit i of the exponent shifts by 2^i.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_align_code is
  port (
    x        : in  signed(9 downto 0);  -- |.| <= 511
    exponent : in  unsigned(3 downto 0);
    aligned  : out signed(24 downto 0)  -- s3.22; |.| <= 16744448
  );
end entity volume_align_code;

architecture rtl of volume_align_code is
  signal shifted_0 : signed(10 downto 0);  -- |.| <= 1022
  signal shifted_1 : signed(12 downto 0);  -- |.| <= 4088
  signal shifted_2 : signed(16 downto 0);  -- |.| <= 65408
begin
  -- Clock 0
  shifted_0 <= append(x, 1) when exponent(0) = '1' else resize(x, 11);
  shifted_1 <= append(shifted_0, 2) when exponent(1) = '1' else resize(shifted_0, 13);
  shifted_2 <= append(shifted_1, 4) when exponent(2) = '1' else resize(shifted_1, 17);
  aligned <= append(shifted_2, 8) when exponent(3) = '1' else resize(shifted_2, 25);
end architecture rtl;
