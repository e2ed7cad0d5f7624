-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The differences of a point go left, each axis by its own shift; what is cut off below leaves one bit to round by:
-- floor(2 x / 2^d).
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity coordinate_scale is
  port (
    x     : in  signed_33_vector_t;  -- |.| <= 2147483644
    shift : in  flag_x4_vector_t;
    cut   : out signed_19_vector_t  -- |.| <= 262144
  );
end entity coordinate_scale;

architecture rtl of coordinate_scale is
  signal x_aligned_aligned : signed_34_vector_t;  -- |.| <= 4294967288
  signal x_aligned_resized : signed_33_vector_t;  -- |.| <= 4294967288
  signal shifted_0 : signed_33_vector_t;  -- |.| <= 4294967296
  signal shifted_0_floor_7 : signed_26_vector_t;  -- |.| <= 33554432
  signal shifted_1 : signed_26_vector_t;  -- |.| <= 33554432
  signal shifted_1_floor_4 : signed_22_vector_t;  -- |.| <= 2097152
  signal shifted_2 : signed_22_vector_t;  -- |.| <= 2097152
  signal shifted_2_floor_2 : signed_20_vector_t;  -- |.| <= 524288
  signal shifted_3 : signed_20_vector_t;  -- |.| <= 524288
begin
  -- Clock 0
  x_aligned_aligned_each : for i in 0 to 2 generate
    x_aligned_aligned(i) <= append(x(i), 1);
    x_aligned_resized(i) <= x_aligned_aligned(i)(32 downto 0);
    shifted_0(i) <= shift_left(x_aligned_resized(i), 7) when shift(i)(0) = '1' else x_aligned_resized(i);
    shifted_0_floor_7(i) <= shifted_0(i)(32 downto 7);
    shifted_1(i) <= shift_left(shifted_0_floor_7(i), 4) when shift(i)(1) = '1' else shifted_0_floor_7(i);
    shifted_1_floor_4(i) <= shifted_1(i)(25 downto 4);
    shifted_2(i) <= shift_left(shifted_1_floor_4(i), 2) when shift(i)(2) = '1' else shifted_1_floor_4(i);
    shifted_2_floor_2(i) <= shifted_2(i)(21 downto 2);
    shifted_3(i) <= shift_left(shifted_2_floor_2(i), 1) when shift(i)(3) = '1' else shifted_2_floor_2(i);
    cut(i) <= shifted_3(i)(19 downto 1);
  end generate x_aligned_aligned_each;
end architecture rtl;
