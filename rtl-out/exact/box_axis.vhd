-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The ranges of A and B along a coordinate; V_0 is 0. apart: one is wholly below the other. nearly_apart: they have at
-- most one end in common, and are not one number both. with_0: 0 is in that of B. sides_a, sides_b: v_1 and v_2, or
-- some of w_l, are on different sides of 0.
-- Latency: 1 clock.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity box_axis is
  port (
    clk          : in  std_logic;
    v            : in  signed_18_x2_t;  -- |.| <= 131071
    w            : in  signed_18_x3_t;  -- |.| <= 131071
    apart        : out std_logic;
    nearly_apart : out std_logic;
    with_0       : out std_logic;
    sides_a      : out std_logic := '0';
    sides_b      : out std_logic := '0'
  );
end entity box_axis;

architecture rtl of box_axis is
  signal v_above : std_logic_vector(1 downto 0);
  signal v_below : std_logic_vector(1 downto 0);
  signal w_above : std_logic_vector(2 downto 0);
  signal w_below : std_logic_vector(2 downto 0);
  signal v_below_w : flag_x3_x2_t;
  signal w_below_v : flag_x3_x2_t;
  signal apart_and_first_and_and_and_and_and_and_d1 : std_logic := '0';
  signal v_below_w_d1 : flag_x3_x2_t := zero_flag_x3_x2;
  signal apart_and_second_and_and_d1 : std_logic := '0';
  signal w_below_v1_d1 : std_logic_vector(2 downto 1) := (others => '0');
  signal with_0_or_and_first_d1 : std_logic := '0';
  signal with_0_or_and_second_d1 : std_logic := '0';
  signal w_below0_word_any_d1 : std_logic := '0';
  signal w_above0_word_any_d1 : std_logic := '0';
  signal sides_a_i : std_logic;
  signal sides_b_i : std_logic;
begin
  -- Clock 0
  v_above_each : for k in 0 to 1 generate
    v_above(k) <= not v(k)(17) and not flag(known(v(k)) = 0);
    v_below(k) <= v(k)(17);
  end generate v_above_each;
  w_above_each : for k in 0 to 2 generate
    w_above(k) <= not w(k)(17) and not flag(known(w(k)) = 0);
    w_below(k) <= w(k)(17);
  end generate w_above_each;
  v_below_w_each_of : for k in 0 to 1 generate
    v_below_w_each : for m in 0 to 2 generate
      v_below_w(k)(m) <= less(v(k), w(m));
      w_below_v(k)(m) <= less(w(m), v(k));
    end generate v_below_w_each;
  end generate v_below_w_each_of;
  sides_a_i <= (v_above(0) and v_below(1)) or (v_above(1) and v_below(0));
  sides_b_i <= or_reduce(unsigned(w_above)) and or_reduce(unsigned(w_below));

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      apart_and_first_and_and_and_and_and_and_d1 <= w_above(0) and w_above(1) and w_above(2);
      v_below_w_d1 <= v_below_w;
      apart_and_second_and_and_d1 <= w_below(0) and w_below(1) and w_below(2) and w_below_v(0)(0) and w_below_v(0)(1)
          and w_below_v(0)(2) and w_below_v(1)(0);
      for k in 1 to 2 loop
        w_below_v1_d1(k) <= w_below_v(1)(k);
      end loop;
      with_0_or_and_first_d1 <= w_above(0) and w_above(1) and w_above(2);
      with_0_or_and_second_d1 <= w_below(0) and w_below(1) and w_below(2);
      w_below0_word_any_d1 <= or_reduce(unsigned(w_below_v(1)) & unsigned(w_below_v(0)) & unsigned(w_below));
      w_above0_word_any_d1 <= or_reduce(unsigned(v_below_w(1)) & unsigned(v_below_w(0)) & unsigned(w_above));
      sides_a <= sides_a_i;
      sides_b <= sides_b_i;
    end if;
  end process clock_1;
  apart <= (apart_and_first_and_and_and_and_and_and_d1 and v_below_w_d1(0)(0) and v_below_w_d1(0)(1) and
      v_below_w_d1(0)(2) and v_below_w_d1(1)(0) and v_below_w_d1(1)(1) and v_below_w_d1(1)(2)) or
      (apart_and_second_and_and_d1 and w_below_v1_d1(1) and w_below_v1_d1(2));
  nearly_apart <= (w_above0_word_any_d1 and not w_below0_word_any_d1) or
      (w_below0_word_any_d1 and not w_above0_word_any_d1);
  with_0 <= not (with_0_or_and_first_d1 or with_0_or_and_second_d1);
end architecture rtl;
