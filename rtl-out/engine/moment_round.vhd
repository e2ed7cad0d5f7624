-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- A moment rounded to the working width: places bits are dropped, and one by rounding.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity moment_round is
  port (
    cut    : in  signed_20_vector_t;  -- |.| <= 524281
    places : in  std_logic;
    moment : out signed_18_vector_t  -- |.| <= 131072
  );
end entity moment_round;

architecture rtl of moment_round is
  signal chosen : signed_20_vector_t;  -- |.| <= 524281
  signal moment_floor_1_sum : signed_21_vector_t;  -- |.| <= 524281
begin
  -- Clock 0
  chosen_each : for i in 0 to 2 generate
    chosen(i) <= resize(cut(i)(19 downto 1), 20) when places = '1' else cut(i);
    moment_floor_1_sum(i) <= resize(chosen(i), 21) + 1;
    moment(i) <= moment_floor_1_sum(i)(18 downto 1);
  end generate chosen_each;
end architecture rtl;
