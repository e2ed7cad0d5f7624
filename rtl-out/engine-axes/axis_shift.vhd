-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The exact axis brought to the working width. First it is shifted left by the leading zeros that its six bounds
-- have in common once they are rounded without a shift: so rounding behind the shift overflows nothing.
-- The shift is at most 7 places; 18 bits are dropped behind it.
-- Latency: 3 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity axis_shift is
  port (
    clk   : in  std_logic;
    exact : in  interval_37_vector_t;  -- |.| <= 8590196738
    l     : out interval_18_vector_t  -- |.| <= 131072
  );
end entity axis_shift;

architecture rtl of axis_shift is
  signal rounded : interval_19_20_vector_t;  -- |.| <= 32770
  signal magnitudes_lo_magnitude : unsigned_19_vector_t;
  signal magnitudes : interval_u17_vector_t;
  signal magnitude_or_or_or_d1 : unsigned(16 downto 0) := (others => '0');
  signal magnitudes_y_hi_d1 : unsigned(16 downto 0) := (others => '0');
  signal magnitudes_z_d1 : interval_u17_t := zero_interval_u17;
  signal magnitude : unsigned(16 downto 0);
  signal magnitude_1_to_2 : unsigned_17_1_to_2_t;
  signal kept : interval_25_vector_t;  -- |.| <= 4194433
  signal zero : std_logic_vector(3 downto 1);
  signal kept_d1 : interval_25_vector_t := zero_interval_25_vector;  -- |.| <= 4194433
  signal shifted1 : interval_25_vector_t;  -- |.| <= 16777216
  signal shifted2 : interval_21_vector_t;  -- |.| <= 1048576
  signal shifted3 : interval_19_19_vector_t;  -- |.| <= 262144
  signal magnitude1_d1 : unsigned(16 downto 0) := (others => '0');
  signal magnitude2_shifted_d1 : unsigned(16 downto 0) := (others => '0');
  signal shifted1_floor_4_d1 : interval_21_vector_t := zero_interval_21_vector;  -- |.| <= 1048576
  signal shifted2_floor_2 : interval_19_19_vector_t;  -- |.| <= 262144
  signal l_i : interval_18_vector_t;  -- |.| <= 131071
  signal l_hi_sum_floor_1_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal l_hi_sum : signed_19_vector_t;  -- |.| <= 131071
  signal l_lo_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
begin
  -- Clock 0
  rounded_lo_each : for i in 0 to 2 generate
    rounded(i).lo <= exact(i).lo(36 downto 18);
    rounded(i).hi <= resize(exact(i).hi(36 downto 18), 20) + 1;
    magnitudes_lo_magnitude(i) <= abs_of(rounded(i).lo);
    magnitudes(i).lo <= magnitudes_lo_magnitude(i)(16 downto 0);
    magnitudes(i).hi <= to_unsigned(0, 17) when rounded(i).hi(19) = '1' else unsigned(rounded(i).hi(16 downto 0));
    kept(i).lo <= exact(i).lo(35 downto 11);
    kept(i).hi <= exact(i).hi(35 downto 11);
  end generate rounded_lo_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      magnitude_or_or_or_d1 <= magnitudes(0).lo or magnitudes(0).hi or magnitudes(1).lo;
      magnitudes_y_hi_d1 <= magnitudes(1).hi;
      magnitudes_z_d1 <= magnitudes(2);
      kept_d1 <= kept;
    end if;
  end process clock_1;
  magnitude <= magnitude_or_or_or_d1 or magnitudes_y_hi_d1 or magnitudes_z_d1.lo or magnitudes_z_d1.hi;
  magnitude_1_to_2(1) <= shift_left(magnitude, 4) when zero(1) = '1' else magnitude;
  zero(1) <= not or_reduce(magnitude(16 downto 13));
  shifted1_lo_each : for i in 0 to 2 generate
    shifted1(i).lo <= shift_left(kept_d1(i).lo, 4) when zero(1) = '1' else kept_d1(i).lo;
    shifted1(i).hi <= shift_left(kept_d1(i).hi, 4) when zero(1) = '1' else kept_d1(i).hi;
  end generate shifted1_lo_each;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      magnitude1_d1 <= magnitude_1_to_2(1);
      magnitude2_shifted_d1 <= shift_left(magnitude_1_to_2(1), 2);
      for i in 0 to 2 loop
        shifted1_floor_4_d1(i).lo <= shifted1(i).lo(24 downto 4);
        shifted1_floor_4_d1(i).hi <= shifted1(i).hi(24 downto 4);
      end loop;
    end if;
  end process clock_2;
  magnitude_1_to_2(2) <= magnitude2_shifted_d1 when zero(2) = '1' else magnitude1_d1;
  zero(2) <= not or_reduce(magnitude1_d1(16 downto 15));
  zero(3) <= not magnitude_1_to_2(2)(16);
  shifted2_lo_each : for i in 0 to 2 generate
    shifted2(i).lo <= shift_left(shifted1_floor_4_d1(i).lo, 2) when zero(2) = '1' else shifted1_floor_4_d1(i).lo;
    shifted2(i).hi <= shift_left(shifted1_floor_4_d1(i).hi, 2) when zero(2) = '1' else shifted1_floor_4_d1(i).hi;
    shifted3(i).lo <= shift_left(shifted2_floor_2(i).lo, 1) when zero(3) = '1' else shifted2_floor_2(i).lo;
    shifted3(i).hi <= shift_left(shifted2_floor_2(i).hi, 1) when zero(3) = '1' else shifted2_floor_2(i).hi;
    shifted2_floor_2(i).lo <= shifted2(i).lo(20 downto 2);
    shifted2_floor_2(i).hi <= shifted2(i).hi(20 downto 2);
    l_i(i).lo <= shifted3(i).lo(18 downto 1);
  end generate shifted2_lo_each;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to 2 loop
        l_hi_sum_floor_1_d1(i) <= shifted3(i).hi(18 downto 1);
        l_lo_d1(i) <= l_i(i).lo;
      end loop;
    end if;
  end process clock_3;
  l_i_hi_each : for i in 0 to 2 generate
    l_i(i).hi <= l_hi_sum(i)(17 downto 0);
    l_hi_sum(i) <= resize(l_hi_sum_floor_1_d1(i), 19) + 1;
  end generate l_i_hi_each;

  -- Outputs
  l_lo_each : for i in 0 to 2 generate
    l(i).lo <= l_lo_d1(i);
    l(i).hi <= l_i(i).hi;
  end generate l_lo_each;
end architecture rtl;
