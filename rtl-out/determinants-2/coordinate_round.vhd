-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The coordinates of a point: the last bit rounded off, or the last two where an axis carries.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity coordinate_round is
  port (
    cut     : in  signed_19_vector_t;  -- |.| <= 262144
    carried : in  std_logic_vector(2 downto 0);
    y       : out signed_18_vector_t  -- |.| <= 131071
  );
end entity coordinate_round;

architecture rtl of coordinate_round is
  signal chosen : signed_19_vector_t;  -- |.| <= 262144
  signal y_floor_1_sum : signed_20_vector_t;  -- |.| <= 262144
begin
  -- Clock 0
  chosen_each : for i in 0 to 2 generate
    chosen(i) <= resize(cut(i)(18 downto 1), 19) when carried(i) = '1' else cut(i);
    y_floor_1_sum(i) <= resize(chosen(i), 20) + 1;
    y(i) <= y_floor_1_sum(i)(18 downto 1);
  end generate chosen_each;
end architecture rtl;
