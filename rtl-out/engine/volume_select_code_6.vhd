-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- b[j]: the code that a term of a row reads, one of those of its slot: a tree of choices between two, bit i of the
-- choice in stage i.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_select_code_6 is
  port (
    codes  : in  signed_10_x6_t;  -- |.| <= 511
    choice : in  unsigned(2 downto 0);
    code   : out signed(9 downto 0)  -- |.| <= 511
  );
end entity volume_select_code_6;

architecture rtl of volume_select_code_6 is
  signal choice_low : std_logic;
  signal chosen_0 : signed_10_x3_t;  -- |.| <= 511
  signal chosen_1 : signed(9 downto 0);  -- |.| <= 511
begin
  -- Clock 0
  choice_low <= choice(0);
  chosen_0(0) <= codes(1) when choice_low = '1' else codes(0);
  chosen_0(1) <= codes(3) when choice_low = '1' else codes(2);
  chosen_0(2) <= codes(5) when choice_low = '1' else codes(4);
  chosen_1 <= chosen_0(1) when choice(1) = '1' else chosen_0(0);
  code <= chosen_0(2) when choice(2) = '1' else chosen_1;
end architecture rtl;
