-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of an expansion: D, then in each direction h of A the bound of D, B's codes through the row of h, A's
-- code of the opposite direction, and the test. Units are shared over the phases of the slot. A value captured for the
-- expansion is named after what it is; later copies end in _h<clocks>, or are elements of x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 13 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_path is
  port (
    clk         : in  std_logic;
    phase       : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds       : in  std_logic_vector(3 downto 0);  -- whether the slot k slots ago holds a pair
    query_pose  : in  signed_18_vector_x3_t;  -- s1.17; |.| <= 131071
    query_shift : in  signed_26_vector_t;  -- s4.22; |.| <= 16777216
    query_error : in  unsigned_16_vector_t;
    query_row   : in  row_u13_x9_t;
    a_origin    : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    a_exponent  : in  unsigned(3 downto 0);
    a_code      : in  signed_10_x18_x2_t;  -- |.| <= 511
    a_take      : in  std_logic_vector(1 downto 0);
    b_origin    : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    b_exponent  : in  unsigned(3 downto 0);
    b_code      : in  signed_10_x18_x2_t;  -- |.| <= 511
    b_take      : in  std_logic_vector(1 downto 0);
    survive     : out std_logic_vector(3 downto 0)
  );
end entity volume_path;

architecture rtl of volume_path is
  signal in_phase_3 : std_logic;
  signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
  signal strobe : std_logic_vector(3 downto 0) := (others => '0');  -- one flag per phase
  signal axis_bound_operand_select_at_2 : std_logic;
  signal bound : signed_28_x3_t;  -- s6.22; |.| <= 33619871
  signal u : signed_28_x9_t;  -- s6.22; |.| <= 100605968
  signal bound_d1 : signed_28_3_to_8_t;  -- s6.22; |.| <= 67239742
  signal apart_found : flag_x2_x2_t;
  signal survive_and_held : flag_x4_x3_t := zero_flag_x4_x3;  -- from clocks 4, 8, 12 on
  signal survive1_and_h13 : std_logic := '0';
  signal survive3_and_h13 : std_logic := '0';
begin
  -- Sections, in the order of the data
  volume_bounds_section : entity work.volume_bounds
    port map (clk => clk, phase => phase, holds => holds, query_pose => query_pose, query_shift => query_shift,
              query_error => query_error, a_origin => a_origin, b_origin => b_origin, in_phase_3 => in_phase_3,
              strobe => strobe, axis_bound_operand_select_at_2 => axis_bound_operand_select_at_2, bound => bound,
              bound_d1 => bound_d1);
  volume_rows_section : entity work.volume_rows
    port map (clk => clk, phase => phase, holds => holds, query_row => query_row, b_exponent => b_exponent,
              b_code => b_code, strobe => strobe, u => u);
  volume_tests_section : entity work.volume_tests
    port map (clk => clk, a_exponent => a_exponent, a_code => a_code, strobe => strobe,
              axis_bound_operand_select_at_2 => axis_bound_operand_select_at_2, bound => bound, u => u,
              bound_d1 => bound_d1, apart_found => apart_found);

  -- Strobes, one per phase, and flags of pairs
  strobes : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        strobe(k) <= flag(known(phase) = (k + 3) mod 4) and in_flight;
      end loop;
    end if;
  end process strobes;
  in_phase_3 <= flag(known(phase) = 3);
  in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or in_phase_3;

  -- Clock 12
  survive(0) <= survive_and_held(2)(0) and not apart_found(0)(0);
  survive(2) <= survive_and_held(2)(2) and not apart_found(1)(0);

  -- Clock 13
  survive(1) <= survive1_and_h13 and not apart_found(0)(1);
  survive(3) <= survive3_and_h13 and not apart_found(1)(1);

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(3) = '1' then
        survive_and_held(0)(0) <= a_take(0) and b_take(0);
        survive_and_held(0)(1) <= a_take(0) and b_take(1);
        survive_and_held(0)(2) <= a_take(1) and b_take(0);
        survive_and_held(0)(3) <= a_take(1) and b_take(1);
        survive_and_held(1 to 2) <= survive_and_held(0 to 1);
      end if;
      if strobe(0) = '1' then
        survive1_and_h13 <= survive_and_held(2)(1);
        survive3_and_h13 <= survive_and_held(2)(3);
      end if;
    end if;
  end process captures;
end architecture rtl;
