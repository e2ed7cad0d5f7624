-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One separating axis, l = e x f in interval arithmetic (equation 1).
-- Component i is e_j f_k - e_k f_j, not rounded; what axis_shift makes of it has the format and bound of the table.
--
--   axis         e       f       l       |l| <=     rounding
--   n_a          s2.16   s2.16   s4.14   131071     18 bits dropped
--   n_b          s3.15   s3.15   s6.12   131071     18 bits dropped
--   c_00 to c_02 s2.16   s3.15   s5.13   131071     18 bits dropped
--   c_10 to c_12 s3.15   s3.15   s6.12   131071     18 bits dropped
--   c_20 to c_22 s2.16   s3.15   s5.13   131071     18 bits dropped
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity cross_product is
  port (
    clk    : in  std_logic;
    e      : in  interval_18_vector_t;  -- |.| <= 65537
    e_case : in  unsigned_2_vector_t;
    f      : in  interval_18_vector_t;  -- |.| <= 65537
    f_case : in  unsigned_2_vector_t;
    l      : out interval_37_vector_t  -- |.| <= 8590196738
  );
end entity cross_product;

architecture rtl of cross_product is
  signal e_j_f_k : interval_36_vector_t;  -- |.| <= 4295098369
  signal e_k_f_j : interval_36_vector_t;  -- |.| <= 4295098369
begin
  -- Clock 0
  e_j_f_k_unit : for i in 0 to 2 generate
    unit : entity work.interval_multiply
      port map (clk => clk, x => e((i + 1) mod 3), x_case => e_case((i + 1) mod 3), y => f((i + 2) mod 3),
                y_case => f_case((i + 2) mod 3), p => e_j_f_k(i));
  end generate e_j_f_k_unit;
  e_k_f_j_unit : for i in 0 to 2 generate
    unit : entity work.interval_multiply
      port map (clk => clk, x => e((i + 2) mod 3), x_case => e_case((i + 2) mod 3), y => f((i + 1) mod 3),
                y_case => f_case((i + 1) mod 3), p => e_k_f_j(i));
  end generate e_k_f_j_unit;

  -- Clock 2
  l_lo_each : for i in 0 to 2 generate
    l(i).lo <= resize(e_j_f_k(i).lo, 37) - resize(e_k_f_j(i).hi, 37);
    l(i).hi <= resize(e_j_f_k(i).hi, 37) - resize(e_k_f_j(i).lo, 37);
  end generate l_lo_each;
end architecture rtl;
