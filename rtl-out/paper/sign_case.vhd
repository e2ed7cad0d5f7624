-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The sign case of an interval, which tells a product which bounds to take.
--   00: 0 <= lo        01: lo < 0, hi <= 0
--   10: lo < 0 < hi, -lo <= hi        11: lo < 0 < hi, -lo > hi
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity sign_case is
  port (
    x      : in  interval_18_t;  -- |.| <= 65539
    number : out unsigned(1 downto 0)
  );
end entity sign_case;

architecture rtl of sign_case is
  signal straddles : std_logic;  -- lo < 0 < hi
  signal number_negative_sum : signed(18 downto 0);  -- |.| <= 131077
begin
  -- Clock 0
  straddles <= x.lo(17) and not x.hi(17) and or_reduce(unsigned(x.hi(16 downto 0)));
  number_negative_sum <= resize(x.lo, 19) + resize(x.hi, 19);
  number <= straddles & number_negative_sum(18);
end architecture rtl;
