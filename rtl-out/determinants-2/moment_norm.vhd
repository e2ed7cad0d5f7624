-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The L1 norm of a vector: the sum of the magnitudes of its components.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity moment_norm is
  port (
    clk  : in  std_logic;
    x    : in  signed_18_vector_t;  -- |.| <= 131072
    norm : out unsigned(19 downto 0)
  );
end entity moment_norm;

architecture rtl of moment_norm is
  signal magnitude : unsigned_18_vector_t;
  signal norm_sum_d1 : unsigned(18 downto 0) := (others => '0');
  signal magnitude_z_d1 : unsigned(17 downto 0) := (others => '0');
begin
  -- Clock 0
  magnitude_each : for i in 0 to 2 generate
    magnitude(i) <= abs_of(x(i));
  end generate magnitude_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      norm_sum_d1 <= resize(magnitude(0), 19) + resize(magnitude(1), 19);
      magnitude_z_d1 <= magnitude(2);
    end if;
  end process clock_1;
  norm <= resize(norm_sum_d1, 20) + resize(magnitude_z_d1, 20);
end architecture rtl;
