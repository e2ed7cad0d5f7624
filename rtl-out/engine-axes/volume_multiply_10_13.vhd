-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- p = x * y with its register, in an entity of its own, so that synthesis merges the two (Xilinx AR 13182).
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity volume_multiply_10_13 is
  port (
    clk : in  std_logic;
    x   : in  signed(9 downto 0);  -- |.| <= 511
    y   : in  signed(12 downto 0);  -- |.| <= 4095
    p   : out signed(22 downto 0) := (others => '0')  -- |.| <= 2092545
  );
end entity volume_multiply_10_13;

architecture rtl of volume_multiply_10_13 is
begin
  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      p <= x * y;
    end if;
  end process clock_1;
end architecture rtl;
