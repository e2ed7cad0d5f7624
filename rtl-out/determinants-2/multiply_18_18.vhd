-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- p = x * y with its register, in an entity of its own, so that synthesis merges the two (Xilinx AR 13182).
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity multiply_18_18 is
  port (
    clk : in  std_logic;
    x   : in  signed(17 downto 0);  -- |.| <= 131071
    y   : in  signed(17 downto 0);  -- |.| <= 131072
    p   : out signed(35 downto 0) := (others => '0')  -- |.| <= 17179738112
  );
end entity multiply_18_18;

architecture rtl of multiply_18_18 is
begin
  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      p <= x * y;
    end if;
  end process clock_1;
end architecture rtl;
