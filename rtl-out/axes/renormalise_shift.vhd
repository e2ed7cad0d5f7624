-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Re-normalisation, second step: the leading zeros of the OR of all magnitudes of one coordinate, found by halving
-- from the top. Flag i: shift by 2^i.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity renormalise_shift is
  port (
    clk        : in  std_logic;
    magnitudes : in  unsigned(31 downto 0);
    shift      : out std_logic_vector(4 downto 0)
  );
end entity renormalise_shift;

architecture rtl of renormalise_shift is
  signal shift_i : std_logic_vector(4 downto 0);
  signal word_4 : unsigned(31 downto 0);
  signal shift1_any_d1 : std_logic := '0';
  signal shift3_any_d1 : std_logic := '0';
  signal word_4_d1 : unsigned(31 downto 0) := (others => '0');
  signal word_3 : unsigned(31 downto 0);
  signal word_2 : unsigned(31 downto 0);
  signal word_2_d1 : unsigned(31 downto 0) := (others => '0');
  signal word_1 : unsigned(31 downto 0);
  signal shift_d1 : std_logic_vector(3 downto 2) := (others => '0');
  signal shift4_d1 : std_logic := '0';
  signal shift4_d2 : std_logic := '0';
begin
  -- Clock 0
  shift_i(4) <= not or_reduce(magnitudes(31 downto 16));
  word_4 <= shift_left(magnitudes, 16) when shift_i(4) = '1' else magnitudes;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      shift3_any_d1 <= or_reduce(word_4(31 downto 24));
      word_4_d1 <= word_4;
      shift4_d1 <= shift_i(4);
    end if;
  end process clock_1;
  shift_i(2) <= not or_reduce(word_3(31 downto 28));
  shift_i(3) <= not shift3_any_d1;
  word_3 <= shift_left(word_4_d1, 8) when shift_i(3) = '1' else word_4_d1;
  word_2 <= shift_left(word_3, 4) when shift_i(2) = '1' else word_3;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      shift1_any_d1 <= or_reduce(word_2(31 downto 30));
      word_2_d1 <= word_2;
      for k in 2 to 3 loop
        shift_d1(k) <= shift_i(k);
      end loop;
      shift4_d2 <= shift4_d1;
    end if;
  end process clock_2;
  shift_i(0) <= not word_1(31);
  shift_i(1) <= not shift1_any_d1;
  word_1 <= shift_left(word_2_d1, 2) when shift_i(1) = '1' else word_2_d1;

  -- Outputs
  shift(0) <= shift_i(0);
  shift(1) <= shift_i(1);
  shift(2) <= shift_d1(2);
  shift(3) <= shift_d1(3);
  shift(4) <= shift4_d2;
end architecture rtl;
