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
    l     : out interval_18_vector_t  -- |.| <= 131071
  );
end entity axis_shift;

architecture rtl of axis_shift is
  signal rounded : interval_19_20_vector_t;  -- |.| <= 32770
  signal magnitudes_magnitude : interval_u19_vector_t;
  signal magnitudes : interval_u17_vector_t;
  signal magnitudes_d1 : interval_u17_vector_t := zero_interval_u17_vector;
  signal magnitude : unsigned(16 downto 0);
  signal magnitude1 : unsigned(16 downto 0);
  signal magnitude2 : unsigned(16 downto 0);
  signal kept : interval_25_vector_t;  -- |.| <= 4194433
  signal zero1 : std_logic;  -- the top 4 bits of the magnitude are zero
  signal zero2 : std_logic;  -- the top 2 bits of the magnitude are zero
  signal zero3 : std_logic;  -- the top 1 bits of the magnitude are zero
  signal magnitude_d1 : unsigned(16 downto 0) := (others => '0');
  signal zero1_d1 : std_logic := '0';
  signal zero3_d1 : std_logic := '0';
  signal kept_d1 : interval_25_vector_t := zero_interval_25_vector;  -- |.| <= 4194433
  signal kept_d2 : interval_25_vector_t := zero_interval_25_vector;  -- |.| <= 4194433
  signal shifted1 : interval_25_vector_t;  -- |.| <= 16777216
  signal shifted2 : interval_21_vector_t;  -- |.| <= 1048576
  signal shifted3 : interval_19_19_vector_t;  -- |.| <= 262144
  signal shifted1_floor_4 : interval_21_vector_t;  -- |.| <= 1048576
  signal shifted2_floor_2 : interval_19_19_vector_t;  -- |.| <= 262144
  signal shifted2_floor_2_d1 : interval_19_19_vector_t := zero_interval_19_19_vector;  -- |.| <= 262144
  signal shifted3_shifted_d1 : interval_19_19_vector_t := zero_interval_19_19_vector;  -- |.| <= 262144
  signal l_hi_sum : signed_19_vector_t;  -- |.| <= 131071
begin
  -- Clock 0
  rounded_lo_each : for i in 0 to 2 generate
    rounded(i).lo <= exact(i).lo(36 downto 18);
    rounded(i).hi <= resize(exact(i).hi(36 downto 18), 20) + 1;
    magnitudes_magnitude(i).lo <= abs_of(rounded(i).lo);
    magnitudes_magnitude(i).hi <= abs_of(rounded(i).hi);
    magnitudes(i).lo <= magnitudes_magnitude(i).lo(16 downto 0);
    magnitudes(i).hi <= magnitudes_magnitude(i).hi(16 downto 0);
    kept(i).lo <= exact(i).lo(35 downto 11);
    kept(i).hi <= exact(i).hi(35 downto 11);
  end generate rounded_lo_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      magnitudes_d1 <= magnitudes;
      kept_d1 <= kept;
    end if;
  end process clock_1;
  magnitude <= magnitudes_d1(0).lo or magnitudes_d1(0).hi or magnitudes_d1(1).lo or magnitudes_d1(1).hi or
      magnitudes_d1(2).lo or magnitudes_d1(2).hi;
  zero1 <= not or_reduce(magnitude(16 downto 13));

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      magnitude_d1 <= magnitude;
      zero1_d1 <= zero1;
      kept_d2 <= kept_d1;
    end if;
  end process clock_2;
  magnitude1 <= shift_left(magnitude_d1, 4) when zero1_d1 = '1' else magnitude_d1;
  magnitude2 <= shift_left(magnitude1, 2) when zero2 = '1' else magnitude1;
  zero2 <= not or_reduce(magnitude1(16 downto 15));
  zero3 <= not magnitude2(16);
  shifted1_lo_each : for i in 0 to 2 generate
    shifted1(i).lo <= shift_left(kept_d2(i).lo, 4) when zero1_d1 = '1' else kept_d2(i).lo;
    shifted1(i).hi <= shift_left(kept_d2(i).hi, 4) when zero1_d1 = '1' else kept_d2(i).hi;
    shifted2(i).lo <= shift_left(shifted1_floor_4(i).lo, 2) when zero2 = '1' else shifted1_floor_4(i).lo;
    shifted2(i).hi <= shift_left(shifted1_floor_4(i).hi, 2) when zero2 = '1' else shifted1_floor_4(i).hi;
    shifted1_floor_4(i).lo <= shifted1(i).lo(24 downto 4);
    shifted1_floor_4(i).hi <= shifted1(i).hi(24 downto 4);
    shifted2_floor_2(i).lo <= shifted2(i).lo(20 downto 2);
    shifted2_floor_2(i).hi <= shifted2(i).hi(20 downto 2);
  end generate shifted1_lo_each;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      zero3_d1 <= zero3;
      shifted2_floor_2_d1 <= shifted2_floor_2;
      for i in 0 to 2 loop
        shifted3_shifted_d1(i).lo <= shift_left(shifted2_floor_2(i).lo, 1);
        shifted3_shifted_d1(i).hi <= shift_left(shifted2_floor_2(i).hi, 1);
      end loop;
    end if;
  end process clock_3;
  shifted3 <= shifted3_shifted_d1 when zero3_d1 = '1' else shifted2_floor_2_d1;
  l_hi_sum_each : for i in 0 to 2 generate
    l_hi_sum(i) <= resize(shifted3(i).hi(18 downto 1), 19) + 1;
    l(i).lo <= shifted3(i).lo(18 downto 1);
    l(i).hi <= l_hi_sum(i)(17 downto 0);
  end generate l_hi_sum_each;
end architecture rtl;
