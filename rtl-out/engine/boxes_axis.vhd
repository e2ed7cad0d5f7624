-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Whether along an axis all of A is above all of B, or all of B above all of A, and by more than coordinates can be
-- wrong. V_0 is 0.
-- Latency: 2 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity boxes_axis is
  port (
    clk   : in  std_logic;
    v     : in  signed_18_x2_t;  -- |.| <= 131071
    w     : in  signed_18_x3_t;  -- |.| <= 131071
    wrong : in  unsigned(4 downto 0);
    apart : out std_logic
  );
end entity boxes_axis;

architecture rtl of boxes_axis is
  signal w_sum : signed_19_x3_t;  -- |.| <= 131088
  signal a_above_and_and_and_and_and_and_and_d1 : std_logic := '0';
  signal a_above_and_and_and_and_and_and_less_d1 : std_logic := '0';
  signal a_above_and_and_and_and_and_less_d1 : std_logic := '0';
  signal a_above_and_and_and_and_less_d1 : std_logic := '0';
  signal a_above_and_and_and_less_d1 : std_logic := '0';
  signal a_above_and_and_less_d1 : std_logic := '0';
  signal a_above_and_less_d1 : std_logic := '0';
  signal a_above_less_d1 : std_logic := '0';
  signal a_above : std_logic;
  signal constant_sum : signed(18 downto 0);  -- |.| <= 17
  signal v_sum : signed_19_x2_t;  -- |.| <= 131088
  signal b_above_and_and_and_and_and_and_and_d1 : std_logic := '0';
  signal b_above_and_and_and_and_and_and_less_d1 : std_logic := '0';
  signal b_above_and_and_and_and_and_less_d1 : std_logic := '0';
  signal b_above_and_and_and_and_less_d1 : std_logic := '0';
  signal b_above_and_and_and_less_d1 : std_logic := '0';
  signal b_above_and_and_less_d1 : std_logic := '0';
  signal b_above_and_less_d1 : std_logic := '0';
  signal b_above_less_d1 : std_logic := '0';
  signal b_above : std_logic;
  signal a_above_d1 : std_logic := '0';
  signal b_above_d1 : std_logic := '0';
begin
  -- Clock 0
  w_sum_each : for k in 0 to 2 generate
    w_sum(k) <= resize(w(k), 19) + signed(resize(wrong, 19));
  end generate w_sum_each;
  constant_sum <= 0 + signed(resize(wrong, 19));
  v_sum_each : for k in 0 to 1 generate
    v_sum(k) <= resize(v(k), 19) + signed(resize(wrong, 19));
  end generate v_sum_each;

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      a_above_and_and_and_and_and_and_and_d1 <= less(w_sum(0), to_signed(0, 19)) and less(w_sum(0), resize(v(0), 19));
      a_above_and_and_and_and_and_and_less_d1 <= less(w_sum(0), resize(v(1), 19));
      a_above_and_and_and_and_and_less_d1 <= less(w_sum(1), to_signed(0, 19));
      a_above_and_and_and_and_less_d1 <= less(w_sum(1), resize(v(0), 19));
      a_above_and_and_and_less_d1 <= less(w_sum(1), resize(v(1), 19));
      a_above_and_and_less_d1 <= less(w_sum(2), to_signed(0, 19));
      a_above_and_less_d1 <= less(w_sum(2), resize(v(0), 19));
      a_above_less_d1 <= less(w_sum(2), resize(v(1), 19));
      b_above_and_and_and_and_and_and_and_d1 <= less(constant_sum, resize(w(0), 19)) and
          less(constant_sum, resize(w(1), 19));
      b_above_and_and_and_and_and_and_less_d1 <= less(constant_sum, resize(w(2), 19));
      b_above_and_and_and_and_and_less_d1 <= less(v_sum(0), resize(w(0), 19));
      b_above_and_and_and_and_less_d1 <= less(v_sum(0), resize(w(1), 19));
      b_above_and_and_and_less_d1 <= less(v_sum(0), resize(w(2), 19));
      b_above_and_and_less_d1 <= less(v_sum(1), resize(w(0), 19));
      b_above_and_less_d1 <= less(v_sum(1), resize(w(1), 19));
      b_above_less_d1 <= less(v_sum(1), resize(w(2), 19));
    end if;
  end process clock_1;
  a_above <= a_above_and_and_and_and_and_and_and_d1 and a_above_and_and_and_and_and_and_less_d1 and
      a_above_and_and_and_and_and_less_d1 and a_above_and_and_and_and_less_d1 and a_above_and_and_and_less_d1 and
      a_above_and_and_less_d1 and a_above_and_less_d1 and a_above_less_d1;
  b_above <= b_above_and_and_and_and_and_and_and_d1 and b_above_and_and_and_and_and_and_less_d1 and
      b_above_and_and_and_and_and_less_d1 and b_above_and_and_and_and_less_d1 and b_above_and_and_and_less_d1 and
      b_above_and_and_less_d1 and b_above_and_less_d1 and b_above_less_d1;

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      a_above_d1 <= a_above;
      b_above_d1 <= b_above;
    end if;
  end process clock_2;
  apart <= a_above_d1 or b_above_d1;
end architecture rtl;
