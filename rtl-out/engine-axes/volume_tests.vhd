-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The test in each direction, with A's code of the opposite one.
-- Clocks are those of volume_path.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_tests is
  port (
    clk                            : in  std_logic;
    a_exponent                     : in  unsigned(3 downto 0);
    a_code                         : in  signed_10_x18_x2_t;  -- |.| <= 511
    strobe                         : in  std_logic_vector(3 downto 0);  -- one flag per phase
    axis_bound_operand_select_at_2 : in  std_logic;
    bound                          : in  signed_28_x3_t;  -- s6.22; |.| <= 33619871
    u                              : in  signed_28_x9_t;  -- s6.22; |.| <= 100605968
    bound_d1                       : in  signed_28_3_to_8_t;  -- s6.22; |.| <= 67239742
    apart_found                    : out flag_x2_x2_t
  );
end entity volume_tests;

architecture rtl of volume_tests is
  signal a_code_h4 : signed_10_x18_x2_t := zero_signed_10_x18_x2;  -- |.| <= 511
  signal a_code0_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code2_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code4_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code6_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code8_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code10_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code12_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code14_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_code16_h8 : signed_10_x2_t := zero_signed_10_x2;  -- |.| <= 511
  signal a_exponent_h4 : unsigned(3 downto 0) := (others => '0');
  signal a_exponent_h7 : unsigned(3 downto 0) := (others => '0');
  signal v_x_d1 : signed_10_x2_x9_t := zero_signed_10_x2_x9;  -- |.| <= 511
  signal v : signed_25_x2_x9_t;  -- s3.22; |.| <= 16744448
  signal u_d1 : signed_28_x9_t := zero_signed_28_x9;  -- s6.22; |.| <= 100605968
  signal v_d1 : signed_25_x2_x9_t := zero_signed_25_x2_x9;  -- s3.22; |.| <= 16744448
  signal apart : flag_x2_x9_t;
  signal apart_in_phase_word_d1 : unsigned_3_x2_x3_t := zero_unsigned_3_x2_x3;
  signal apart_in_phase : flag_x2_x3_t;
  signal apart_found_word_captured_first : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_second : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_third : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_fourth : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_fifth : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_found_word_captured_sixth : flag_x2_x2_t := zero_flag_x2_x2;
  signal apart_unit_bound : signed_28_x9_t;
begin
  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      for m in 0 to 1 loop
        v_x_d1(0)(m) <= choose(axis_bound_operand_select_at_2, a_code0_h8(m), a_code_h4(m)(1));
        v_x_d1(1)(m) <= choose(axis_bound_operand_select_at_2, a_code2_h8(m), a_code_h4(m)(3));
        v_x_d1(2)(m) <= choose(axis_bound_operand_select_at_2, a_code4_h8(m), a_code_h4(m)(5));
        v_x_d1(3)(m) <= choose(axis_bound_operand_select_at_2, a_code6_h8(m), a_code_h4(m)(7));
        v_x_d1(4)(m) <= choose(axis_bound_operand_select_at_2, a_code8_h8(m), a_code_h4(m)(9));
        v_x_d1(5)(m) <= choose(axis_bound_operand_select_at_2, a_code10_h8(m), a_code_h4(m)(11));
        v_x_d1(6)(m) <= choose(axis_bound_operand_select_at_2, a_code12_h8(m), a_code_h4(m)(13));
        v_x_d1(7)(m) <= choose(axis_bound_operand_select_at_2, a_code14_h8(m), a_code_h4(m)(15));
        v_x_d1(8)(m) <= choose(axis_bound_operand_select_at_2, a_code16_h8(m), a_code_h4(m)(17));
      end loop;
    end if;
  end process clock_7;
  v_unit_of : for k in 0 to 8 generate
    v_unit : for m in 0 to 1 generate
      unit : entity work.volume_align_code
        port map (x => v_x_d1(k)(m), exponent => a_exponent_h7, aligned => v(k)(m));
    end generate v_unit;
  end generate v_unit_of;

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      u_d1 <= u;
      v_d1 <= v;
    end if;
  end process clock_8;
  apart_unit_bound(0) <= bound(0);
  apart_unit_bound(1) <= bound(1);
  apart_unit_bound(2) <= bound(2);
  apart_unit_bound_each : for k in 3 to 8 generate
    apart_unit_bound(k) <= bound_d1(k);
  end generate apart_unit_bound_each;
  apart_unit : for k in 0 to 8 generate
    unit : entity work.volume_direction_test
      port map (bound => apart_unit_bound(k), u => u_d1(k), v => v_d1(k), apart => apart(k));
  end generate apart_unit;

  -- Clock 9
  clock_9 : process (clk)
  begin
    if rising_edge(clk) then
      for m in 0 to 1 loop
        apart_in_phase_word_d1(0)(m) <= apart(2)(m) & apart(1)(m) & apart(0)(m);
        apart_in_phase_word_d1(1)(m) <= apart(5)(m) & apart(4)(m) & apart(3)(m);
        apart_in_phase_word_d1(2)(m) <= apart(8)(m) & apart(7)(m) & apart(6)(m);
      end loop;
    end if;
  end process clock_9;
  apart_in_phase_each_of : for k in 0 to 2 generate
    apart_in_phase_each : for m in 0 to 1 generate
      apart_in_phase(k)(m) <= or_reduce(apart_in_phase_word_d1(k)(m));
    end generate apart_in_phase_each;
  end generate apart_in_phase_each_of;

  -- Clock 12
  apart_found_0_each : for k in 0 to 1 generate
    apart_found(k)(0) <= or_reduce(apart_found_word_captured_sixth(k)(0) & apart_found_word_captured_fifth(k)(0) &
        apart_found_word_captured_fourth(k)(0) & apart_found_word_captured_third(k)(0) &
        apart_found_word_captured_second(k)(0) & apart_found_word_captured_first(k)(0));
  end generate apart_found_0_each;

  -- Clock 13
  apart_found_1_each : for k in 0 to 1 generate
    apart_found(k)(1) <= or_reduce(apart_found_word_captured_sixth(k)(1) & apart_found_word_captured_fifth(k)(1) &
        apart_found_word_captured_fourth(k)(1) & apart_found_word_captured_third(k)(1) &
        apart_found_word_captured_second(k)(1) & apart_found_word_captured_first(k)(1));
  end generate apart_found_1_each;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(3) = '1' then
        a_code_h4 <= a_code;
        for k in 0 to 1 loop
          a_code0_h8(k) <= a_code_h4(k)(0);
          a_code2_h8(k) <= a_code_h4(k)(2);
          a_code4_h8(k) <= a_code_h4(k)(4);
          a_code6_h8(k) <= a_code_h4(k)(6);
          a_code8_h8(k) <= a_code_h4(k)(8);
          a_code10_h8(k) <= a_code_h4(k)(10);
          a_code12_h8(k) <= a_code_h4(k)(12);
          a_code14_h8(k) <= a_code_h4(k)(14);
          a_code16_h8(k) <= a_code_h4(k)(16);
        end loop;
        a_exponent_h4 <= a_exponent;
      end if;
      if strobe(2) = '1' then
        a_exponent_h7 <= a_exponent_h4;
      end if;
      for k in 0 to 1 loop
        for m in 0 to 1 loop
          if strobe(m + 1) = '1' then
            apart_found_word_captured_first(k)(m) <= apart_in_phase(0)(k);
            apart_found_word_captured_third(k)(m) <= apart_in_phase(1)(k);
            apart_found_word_captured_fifth(k)(m) <= apart_in_phase(2)(k);
          end if;
          if strobe((m + 3) mod 4) = '1' then
            apart_found_word_captured_second(k)(m) <= apart_in_phase(0)(k);
            apart_found_word_captured_fourth(k)(m) <= apart_in_phase(1)(k);
            apart_found_word_captured_sixth(k)(m) <= apart_in_phase(2)(k);
          end if;
        end loop;
      end loop;
    end if;
  end process captures;
end architecture rtl;
