-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The dot product x . m, exact. m has 2^17 added to each digit of 18 bits but the highest; less that, a digit is a
-- factor with a sign of its own. Three multipliers for each digit, whose products are added at their places.
-- Latency: 4 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity dot_product is
  port (
    clk : in  std_logic;
    x   : in  signed_18_vector_t;  -- |.| <= 131071
    m   : in  signed_36_vector_t;  -- |.| <= 34359345154
    dot : out signed(56 downto 0)  -- |.| <= 13510541185384448
  );
end entity dot_product;

architecture rtl of dot_product is
  signal digit0_resized_second : signed_19_vector_t;  -- |.| <= 131072
  signal digit : signed_18_x2_vector_t;  -- |.| <= 131072
  signal product_01 : signed_36_vector_t;  -- |.| <= 17179475970
  signal place_1_sum_d1 : signed(36 downto 0) := (others => '0');  -- |.| <= 34358951940
  signal product_01_z_d1 : signed(35 downto 0) := (others => '0');  -- |.| <= 17179475970
  signal place_1 : signed(37 downto 0);  -- |.| <= 51538427910
  signal x_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131071
  signal digit0_d1 : signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
  signal product_00 : signed_36_vector_t;  -- |.| <= 17179738112
  signal place_0_sum_d1 : signed(36 downto 0) := (others => '0');  -- |.| <= 34359476224
  signal product_00_z_d1 : signed(35 downto 0) := (others => '0');  -- |.| <= 17179738112
  signal place_0 : signed(37 downto 0);  -- |.| <= 51539214336
  signal place_1_d1 : signed(37 downto 0) := (others => '0');  -- |.| <= 51538427910
  signal place_1_d2 : signed(37 downto 0) := (others => '0');  -- |.| <= 51538427910
  signal dot_sum_floor_18_d1 : signed(19 downto 0) := (others => '0');  -- |.| <= 196607
  signal dot_low_d1 : unsigned(17 downto 0) := (others => '0');
begin
  -- Clock 0
  digit0_resized_second_each : for i in 0 to 2 generate
    digit0_resized_second(i) <= signed(resize(shift_left(to_unsigned(not m(i)(17), 18), 17), 19));
    digit(i)(0) <= signed(resize(unsigned(m(i)(16 downto 0)), 18)) - digit0_resized_second(i)(17 downto 0);
    digit(i)(1) <= m(i)(35 downto 18);
  end generate digit0_resized_second_each;
  product_01_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => x(i), y => digit(i)(1), p => product_01(i));
  end generate product_01_unit;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      x_d1 <= x;
      for i in 0 to 2 loop
        digit0_d1(i) <= digit(i)(0);
      end loop;
    end if;
  end process clock_1;
  product_00_unit : for i in 0 to 2 generate
    unit : entity work.multiply_18_18
      port map (clk => clk, x => x_d1(i), y => digit0_d1(i), p => product_00(i));
  end generate product_00_unit;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      place_1_sum_d1 <= resize(product_01(0), 37) + resize(product_01(1), 37);
      product_01_z_d1 <= product_01(2);
    end if;
  end process clock_2;
  place_1 <= resize(place_1_sum_d1, 38) + resize(product_01_z_d1, 38);

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      place_0_sum_d1 <= resize(product_00(0), 37) + resize(product_00(1), 37);
      product_00_z_d1 <= product_00(2);
      place_1_d1 <= place_1;
    end if;
  end process clock_3;
  place_0 <= resize(place_0_sum_d1, 38) + resize(product_00_z_d1, 38);

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      place_1_d2 <= place_1_d1;
      dot_sum_floor_18_d1 <= place_0(37 downto 18);
      dot_low_d1 <= unsigned(place_0(17 downto 0));
    end if;
  end process clock_4;
  dot <= resize(place_1_d2, 39) + resize(dot_sum_floor_18_d1, 39) & signed(dot_low_d1);
end architecture rtl;
