--------------------------------------------------------------------------------
-- Re-normalisation, first step: the point relative to the lower bound of V0, exact (subtracting a constant, not an
-- interval, widens nothing), and the OR of the magnitudes of its bounds, coordinate by coordinate.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity renormalise_offset is
  port (
    clk       : in  std_logic;
    point     : in  interval_32_vector_t;  -- s4.28; |.| <= 1879048192
    origin    : in  signed_32_vector_t;  -- s4.28; |.| <= 268435456
    offset    : out interval_33_vector_t;  -- s5.28; |.| <= 2147483648
    magnitude : out unsigned_32_vector_t
  );
end entity renormalise_offset;

architecture rtl of renormalise_offset is
  signal offset_i : interval_33_vector_t;  -- s5.28; |.| <= 2147483648
  signal offset_d1 : interval_33_vector_t := zero_interval_33_vector;  -- s5.28; |.| <= 2147483648
  signal magnitude_first_magnitude : unsigned_33_vector_t;
  signal magnitude_second_magnitude : unsigned_33_vector_t;
begin
  -- Clock 0
  offset_i_lo_each : for i in 0 to 2 generate
    offset_i(i).lo <= resize(point(i).lo, 33) - resize(origin(i), 33);
    offset_i(i).hi <= resize(point(i).hi, 33) - resize(origin(i), 33);
  end generate offset_i_lo_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      offset_d1 <= offset_i;
    end if;
  end process clock_1;
  magnitude_first_magnitude_each : for i in 0 to 2 generate
    magnitude_first_magnitude(i) <= abs_of(offset_d1(i).lo);
    magnitude_second_magnitude(i) <= abs_of(offset_d1(i).hi);
    magnitude(i) <= magnitude_first_magnitude(i)(31 downto 0) or magnitude_second_magnitude(i)(31 downto 0);
  end generate magnitude_first_magnitude_each;

  -- Outputs
  offset <= offset_d1;
end architecture rtl;
