-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Re-normalisation, third step: x / 2^L, a power of two for each coordinate axis (an affine map, so the answer
-- stays), rounded outward to the working format. A barrel shifter; flag i shifts by 2^i.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity renormalise_scale is
  port (
    clk    : in  std_logic;
    offset : in  interval_33_vector_t;  -- |.| <= 2147483648
    shift  : in  flag_x5_vector_t;
    scaled : out interval_18_vector_t  -- s2.16; |.| <= 65536
  );
end entity renormalise_scale;

architecture rtl of renormalise_scale is
  signal shifted_4 : interval_33_vector_t;  -- |.| <= 4294967295
  signal shifted_3 : interval_33_vector_t;  -- |.| <= 4294967295
  signal shifted_2 : interval_33_vector_t;  -- |.| <= 4294967295
  signal shifted_1 : interval_33_vector_t;  -- |.| <= 4294967295
  signal shifted_1_d1 : interval_33_vector_t := zero_interval_33_vector;  -- |.| <= 4294967296
  signal shift0_d1 : std_logic_vector(2 downto 0) := (others => '0');
  signal shifted_0 : interval_33_vector_t;  -- s1.32; |.| <= 4294967295
begin
  -- Clock 0
  shifted_4_lo_each : for i in 0 to 2 generate
    shifted_4(i).lo <= shift_left(offset(i).lo, 16) when shift(i)(4) = '1' else offset(i).lo;
    shifted_4(i).hi <= shift_left(offset(i).hi, 16) when shift(i)(4) = '1' else offset(i).hi;
    shifted_3(i).lo <= shift_left(shifted_4(i).lo, 8) when shift(i)(3) = '1' else shifted_4(i).lo;
    shifted_3(i).hi <= shift_left(shifted_4(i).hi, 8) when shift(i)(3) = '1' else shifted_4(i).hi;
    shifted_2(i).lo <= shift_left(shifted_3(i).lo, 4) when shift(i)(2) = '1' else shifted_3(i).lo;
    shifted_2(i).hi <= shift_left(shifted_3(i).hi, 4) when shift(i)(2) = '1' else shifted_3(i).hi;
    shifted_1(i).lo <= shift_left(shifted_2(i).lo, 2) when shift(i)(1) = '1' else shifted_2(i).lo;
    shifted_1(i).hi <= shift_left(shifted_2(i).hi, 2) when shift(i)(1) = '1' else shifted_2(i).hi;
  end generate shifted_4_lo_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      shifted_1_d1 <= shifted_1;
      for i in 0 to 2 loop
        shift0_d1(i) <= shift(i)(0);
      end loop;
    end if;
  end process clock_1;
  shifted_0_lo_each : for i in 0 to 2 generate
    shifted_0(i).lo <= shift_left(shifted_1_d1(i).lo, 1) when shift0_d1(i) = '1' else shifted_1_d1(i).lo;
    shifted_0(i).hi <= shift_left(shifted_1_d1(i).hi, 1) when shift0_d1(i) = '1' else shifted_1_d1(i).hi;
    scaled(i).lo <= resize(shifted_0(i).lo(32 downto 16), 18);
    scaled(i).hi <= resize(shifted_0(i).hi(32 downto 16), 18) + 1;
  end generate shifted_0_lo_each;
end architecture rtl;
