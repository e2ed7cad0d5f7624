-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 2: the points relative to V0, B's in A's frame, and whether they fit.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_differences is
  port (
    clk     : in  std_logic;
    in_v    : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    in_w    : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    fitted  : out signed_18_vector_x5_t;  -- |.| <= 131071
    outside : out std_logic  -- a difference of coordinates does not fit
  );
end entity pair_differences;

architecture rtl of pair_differences is
  signal difference_v1 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_v2 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w0 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w1 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_w2 : signed_33_vector_t;  -- |.| <= 4294967295
  signal difference_v1_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal fit_outside : flag_vector_x5_t;
  signal difference_v2_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w0_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w1_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal difference_w2_h1 : signed_33_vector_t := zero_signed_33_vector;  -- |.| <= 4294967295
  signal outside_flags : unsigned(14 downto 0);
  signal outside_flags_h1 : unsigned(14 downto 0) := (others => '0');
  signal fitted_unit_x : signed_33_vector_x5_t;
begin
  -- Clock 0
  difference_v1_each : for i in 0 to 2 generate
    difference_v1(i) <= resize(in_v(1)(i), 33) - resize(in_v(0)(i), 33);
    difference_v2(i) <= resize(in_v(2)(i), 33) - resize(in_v(0)(i), 33);
    difference_w0(i) <= resize(in_w(0)(i), 33) - resize(in_v(0)(i), 33);
    difference_w1(i) <= resize(in_w(1)(i), 33) - resize(in_v(0)(i), 33);
    difference_w2(i) <= resize(in_w(2)(i), 33) - resize(in_v(0)(i), 33);
  end generate difference_v1_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      difference_v1_h1 <= difference_v1;
      difference_v2_h1 <= difference_v2;
      difference_w0_h1 <= difference_w0;
      difference_w1_h1 <= difference_w1;
      difference_w2_h1 <= difference_w2;
    end if;
  end process clock_1;
  outside_flags <= unsigned(fit_outside(4)) & unsigned(fit_outside(3)) & unsigned(fit_outside(2)) &
      unsigned(fit_outside(1)) & unsigned(fit_outside(0));
  fitted_unit_x(0) <= difference_v1_h1;
  fitted_unit_x(1) <= difference_v2_h1;
  fitted_unit_x(2) <= difference_w0_h1;
  fitted_unit_x(3) <= difference_w1_h1;
  fitted_unit_x(4) <= difference_w2_h1;
  fitted_unit_of : for k in 0 to 4 generate
    fitted_unit : for i in 0 to 2 generate
      unit : entity work.difference_fit
        port map (x => fitted_unit_x(k)(i), fitted => fitted(k)(i), outside => fit_outside(k)(i));
    end generate fitted_unit;
  end generate fitted_unit_of;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      outside_flags_h1 <= outside_flags;
    end if;
  end process clock_2;
  outside <= or_reduce(outside_flags_h1);
end architecture rtl;
