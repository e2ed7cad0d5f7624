-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One component of a cross product, c = x y - x' y', exact.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity cross_component is
  port (
    clk   : in  std_logic;
    plus  : in  signed_18_x2_t;  -- |.| <= 131071
    minus : in  signed_18_x2_t;  -- |.| <= 131071
    c     : out signed(35 downto 0)  -- |.| <= 34359214082
  );
end entity cross_component;

architecture rtl of cross_component is
  signal c_result_first : signed(35 downto 0);  -- |.| <= 17179607041
  signal c_result_second : signed(35 downto 0);  -- |.| <= 17179607041
begin
  -- Clock 0
  c_result_first_unit : entity work.multiply_18_18
    port map (clk => clk, x => plus(0), y => plus(1), p => c_result_first);
  c_result_second_unit : entity work.multiply_18_18
    port map (clk => clk, x => minus(0), y => minus(1), p => c_result_second);

  -- Clock 1
  c <= c_result_first - c_result_second;
end architecture rtl;
