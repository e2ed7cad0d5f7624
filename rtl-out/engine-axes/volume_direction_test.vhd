-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- A direction h of A: all points of B's child are below B + U, those of A's child above -V. apart(p) is set where
-- B + U + V < 0 for child p of A.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_direction_test is
  port (
    bound : in  signed(27 downto 0);  -- s6.22; |.| <= 67239742
    u     : in  signed(27 downto 0);  -- s6.22; |.| <= 100605968
    v     : in  signed_25_x2_t;  -- s3.22; |.| <= 16744448
    apart : out std_logic_vector(1 downto 0)
  );
end entity volume_direction_test;

architecture rtl of volume_direction_test is
  signal reach : signed(28 downto 0);  -- s7.22; |.| <= 167845710
  signal apart_sum : signed_29_x2_t;  -- s7.22; |.| <= 184590158
begin
  -- Clock 0
  reach <= resize(bound, 29) + resize(u, 29);
  apart_sum_each : for k in 0 to 1 generate
    apart_sum(k) <= reach + resize(v(k), 29);
    apart(k) <= apart_sum(k)(28);
  end generate apart_sum_each;
end architecture rtl;
