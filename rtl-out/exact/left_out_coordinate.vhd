-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The first coordinate in which some moment is not 0, which is left out; 3 if there is none.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity left_out_coordinate is
  port (
    moments  : in  signed_36_vector_x4_t;  -- |.| <= 34359214082
    left_out : out unsigned(1 downto 0)
  );
end entity left_out_coordinate;

architecture rtl of left_out_coordinate is
  constant left_out_table : numbers_t(0 to 7) := (3, 0, 1, 0, 2, 0, 1, 0);
  signal seen : std_logic_vector(2 downto 0);
  signal all_seen : unsigned(2 downto 0);
begin
  -- Clock 0
  seen_each : for k in 0 to 2 generate
    seen(k) <= or_reduce(not flag(known(moments(3)(k)) = 0) & not flag(known(moments(2)(k)) = 0) & not
        flag(known(moments(1)(k)) = 0) & not flag(known(moments(0)(k)) = 0));
  end generate seen_each;
  all_seen <= unsigned(seen);
  left_out <= to_unsigned(left_out_table(to_integer(known(all_seen))), 2);
end architecture rtl;
