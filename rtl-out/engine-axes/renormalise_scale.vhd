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
  signal shift_z0_d1_copy : std_logic := '0';  -- for at most 64 loads each
  signal shift_y0_d1_copy : std_logic := '0';  -- for at most 64 loads each
  signal shift_x0_d1_copy : std_logic := '0';  -- for at most 64 loads each
  attribute keep of
    shift0_d1,
    shift_z0_d1_copy,
    shift_y0_d1_copy,
    shift_x0_d1_copy : signal is "true";
  attribute equivalent_register_removal of
    shift0_d1,
    shift_z0_d1_copy,
    shift_y0_d1_copy,
    shift_x0_d1_copy : signal is "no";
  attribute syn_preserve of
    shift0_d1,
    shift_z0_d1_copy,
    shift_y0_d1_copy,
    shift_x0_d1_copy : signal is true;
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
      shift_z0_d1_copy <= shift(2)(0);
      shift_y0_d1_copy <= shift(1)(0);
      shift_x0_d1_copy <= shift(0)(0);
    end if;
  end process clock_1;
  shifted_0(0).lo <= shift_left(shifted_1_d1(0).lo, 1) when shift0_d1(0) = '1' else shifted_1_d1(0).lo;
  shifted_0(0).hi <= shift_left(shifted_1_d1(0).hi, 1) when shift_x0_d1_copy = '1' else shifted_1_d1(0).hi;
  shifted_0(1).lo <= shift_left(shifted_1_d1(1).lo, 1) when shift0_d1(1) = '1' else shifted_1_d1(1).lo;
  shifted_0(1).hi <= shift_left(shifted_1_d1(1).hi, 1) when shift_y0_d1_copy = '1' else shifted_1_d1(1).hi;
  shifted_0(2).lo <= shift_left(shifted_1_d1(2).lo, 1) when shift0_d1(2) = '1' else shifted_1_d1(2).lo;
  shifted_0(2).hi <= shift_left(shifted_1_d1(2).hi, 1) when shift_z0_d1_copy = '1' else shifted_1_d1(2).hi;
  scaled_lo_each : for i in 0 to 2 generate
    scaled(i).lo <= resize(shifted_0(i).lo(32 downto 16), 18);
    scaled(i).hi <= resize(shifted_0(i).hi(32 downto 16), 18) + 1;
  end generate scaled_lo_each;
end architecture rtl;
