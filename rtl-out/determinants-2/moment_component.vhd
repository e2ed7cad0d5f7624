-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- One component of a moment, c = x y - x' y', without the bits that no shift keeps; one is left to round by.
-- too_great: round(c, N - 1) is not in [-R, R - 1].
-- Latency: 3 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity moment_component is
  port (
    clk       : in  std_logic;
    plus      : in  signed_18_x2_t;  -- |.| <= 131071
    minus     : in  signed_18_x2_t;  -- |.| <= 131071
    cut       : out signed(19 downto 0) := (others => '0');  -- |.| <= 524281
    too_great : out std_logic
  );
end entity moment_component;

architecture rtl of moment_component is
  signal exact_result_first : signed(35 downto 0);  -- |.| <= 17179607041
  signal exact_result_second : signed(35 downto 0);  -- |.| <= 17179607041
  signal exact : signed(35 downto 0);  -- |.| <= 34359214082
  signal exact_floor_16 : signed(19 downto 0);  -- |.| <= 524281
  signal high_0_not_any_not_d1 : unsigned(17 downto 0) := (others => '0');
  signal high_0_floor_18_d1 : signed(1 downto 0) := (others => '0');  -- |.| <= 2
  signal high_0 : signed(2 downto 0);  -- |.| <= 2
  signal too_great_or_equal_first_constant : signed(2 downto 0);  -- |.| <= 0
  signal high_0_d1 : signed(2 downto 0) := (others => '0');  -- |.| <= 2
  signal too_great_or_equal_second_constant : signed(2 downto 0);  -- |.| <= 1
  signal cut_i : signed(19 downto 0);  -- |.| <= 524281
  signal cut_d1 : signed(19 downto 0) := (others => '0');  -- |.| <= 524281
begin
  -- Constants
  too_great_or_equal_first_constant <= to_signed(0, 3);
  too_great_or_equal_second_constant <= to_signed(-1, 3);

  -- Clock 0
  exact_result_first_unit : entity work.multiply_18_18
    port map (clk => clk, x => plus(0), y => plus(1), p => exact_result_first);
  exact_result_second_unit : entity work.multiply_18_18
    port map (clk => clk, x => minus(0), y => minus(1), p => exact_result_second);

  -- Clock 1
  exact <= exact_result_first - exact_result_second;
  exact_floor_16 <= exact(35 downto 16);
  cut_i <= exact(35 downto 16);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      high_0_not_any_not_d1 <= not unsigned(exact_floor_16(17 downto 0));
      high_0_floor_18_d1 <= exact_floor_16(19 downto 18);
      cut_d1 <= cut_i;
    end if;
  end process clock_2;
  high_0 <= resize(high_0_floor_18_d1, 3) + to_signed(not or_reduce(high_0_not_any_not_d1), 3);

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      high_0_d1 <= high_0;
      cut <= cut_d1;
    end if;
  end process clock_3;
  too_great <= not (flag(known(high_0_d1) = known(too_great_or_equal_first_constant)) or
      flag(known(high_0_d1) = known(too_great_or_equal_second_constant)));
end architecture rtl;
