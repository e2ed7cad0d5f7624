-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The dot product x . m, exact. Three multipliers at up to 18 bits.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity dot_product is
  port (
    clk : in  std_logic;
    x   : in  signed_18_vector_t;  -- |.| <= 131071
    m   : in  signed_18_vector_t;  -- |.| <= 131072
    dot : out signed(37 downto 0)  -- |.| <= 51539214336
  );
end entity dot_product;

architecture rtl of dot_product is
  signal product : signed_36_vector_t;  -- |.| <= 17179738112
  signal dot_sum_d1 : signed(36 downto 0) := (others => '0');  -- |.| <= 34359476224
  signal product_z_d1 : signed(35 downto 0) := (others => '0');  -- |.| <= 17179738112
begin
  -- Clock 0
  product_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => x(i), y => m(i), p => product(i));
  end generate product_unit;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      dot_sum_d1 <= resize(product(0), 37) + resize(product(1), 37);
      product_z_d1 <= product(2);
    end if;
  end process clock_2;
  dot <= resize(dot_sum_d1, 38) + resize(product_z_d1, 38);
end architecture rtl;
