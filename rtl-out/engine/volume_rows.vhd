-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- How far B reaches in each direction: its codes through the row.
-- Clocks are those of volume_path.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_rows is
  port (
    clk        : in  std_logic;
    phase      : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds      : in  std_logic_vector(3 downto 0);  -- whether the slot k slots ago holds a pair
    query_row  : in  row_u13_x9_t;
    b_exponent : in  unsigned(3 downto 0);
    b_code     : in  signed_10_x18_x2_t;  -- |.| <= 511
    strobe     : in  std_logic_vector(3 downto 0);  -- one flag per phase
    u          : out signed_28_x9_t  -- s6.22; |.| <= 100605968
  );
end entity volume_rows;

architecture rtl of volume_rows is
  constant b_chosen0_select_at_1_table : numbers_t(0 to 3) := (0, 1, 2, 3);
  constant ceiling_table : numbers_t(0 to 15) := (2047, 1023, 511, 255, 127, 63, 31, 15, 7, 3, 1, 0, 0, 0, 0, 0);
  signal b_code1_h4 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal b_chosen : signed_10_x18_t;  -- |.| <= 511
  signal b_chosen0_select_at_1 : unsigned(1 downto 0) := (others => '0');
  signal query_row_held : row_u13_x9_t := zero_row_u13_x9;  -- from clocks 3, 4 on
  signal b_chosen_d1 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal b_chosen_d2 : signed_10_x18_t := zero_signed_10_x18;  -- |.| <= 511
  signal term0 : signed_10_x9_t;  -- |.| <= 511
  signal term1 : signed_10_x9_t;  -- |.| <= 511
  signal term2 : signed_10_x9_t;  -- |.| <= 511
  signal ceiling_h3 : unsigned(10 downto 0) := (others => '0');
  signal term0_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal term1_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal term2_d1 : signed_10_x9_t := zero_signed_10_x9;  -- |.| <= 511
  signal ceiling_h3_d1 : unsigned(10 downto 0) := (others => '0');
  signal s : signed_24_x9_t;  -- |.| <= 6287873
  signal b_exponent_h4 : unsigned(3 downto 0) := (others => '0');
  signal b_exponent_h7 : unsigned(3 downto 0) := (others => '0');
  signal s_d1 : signed_24_x9_t := zero_signed_24_x9;  -- |.| <= 6287873
  signal term0_unit_codes : signed_10_x6_x9_t;
  signal term1_unit_codes : signed_10_x6_x9_t;
  signal term2_unit_codes : signed_10_x6_x9_t;
  signal s_unit_codes : signed_10_x3_x9_t;
begin
  -- Clock 1
  b_chosen(0) <=
    b_code(0)(0) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(0) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(1) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(1);
  b_chosen(1) <=
    b_code(0)(1) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(1) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(0) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(0);
  b_chosen(2) <=
    b_code(0)(2) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(2) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(3) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(3);
  b_chosen(3) <=
    b_code(0)(3) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(3) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(2) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(2);
  b_chosen(4) <=
    b_code(0)(4) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(4) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(5) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(5);
  b_chosen(5) <=
    b_code(0)(5) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(5) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(4) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(4);
  b_chosen(6) <=
    b_code(0)(6) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(6) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(7) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(7);
  b_chosen(7) <=
    b_code(0)(7) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(7) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(6) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(6);
  b_chosen(8) <=
    b_code(0)(8) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(8) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(9) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(9);
  b_chosen(9) <=
    b_code(0)(9) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(9) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(8) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(8);
  b_chosen(10) <=
    b_code(0)(10) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(10) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(11) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(11);
  b_chosen(11) <=
    b_code(0)(11) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(11) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(10) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(10);
  b_chosen(12) <=
    b_code(0)(12) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(12) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(13) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(13);
  b_chosen(13) <=
    b_code(0)(13) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(13) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(12) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(12);
  b_chosen(14) <=
    b_code(0)(14) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(14) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(15) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(15);
  b_chosen(15) <=
    b_code(0)(15) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(15) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(14) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(14);
  b_chosen(16) <=
    b_code(0)(16) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(16) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(17) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(17);
  b_chosen(17) <=
    b_code(0)(17) when known(b_chosen0_select_at_1) = 0 else
    b_code(1)(17) when known(b_chosen0_select_at_1) = 1 else
    b_code(0)(16) when known(b_chosen0_select_at_1) = 2 else
    b_code1_h4(16);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      b_chosen_d1 <= b_chosen;
    end if;
  end process clock_2;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      b_chosen_d2 <= b_chosen_d1;
    end if;
  end process clock_3;
  term0_unit_codes_0_each : for k in 0 to 8 generate
    term0_unit_codes(k)(0) <= b_chosen_d2(0);
    term0_unit_codes(k)(1) <= b_chosen_d2(1);
    term0_unit_codes_each : for m in 2 to 5 generate
      term0_unit_codes(k)(m) <= b_chosen_d2(m + 12);
    end generate term0_unit_codes_each;
    term1_unit_codes(k)(0) <= b_chosen_d2(2);
    term1_unit_codes(k)(1) <= b_chosen_d2(3);
    term1_unit_codes_each : for m in 2 to 5 generate
      term1_unit_codes(k)(m) <= b_chosen_d2(m + 8);
    end generate term1_unit_codes_each;
    term2_unit_codes_each : for m in 0 to 5 generate
      term2_unit_codes(k)(m) <= b_chosen_d2(m + 4);
    end generate term2_unit_codes_each;
  end generate term0_unit_codes_0_each;
  term0_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term0_unit_codes(k), choice => query_row_held(k).choice(0), code => term0(k));
  end generate term0_unit;
  term1_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term1_unit_codes(k), choice => query_row_held(k).choice(1), code => term1(k));
  end generate term1_unit;
  term2_unit : for k in 0 to 8 generate
    unit : entity work.volume_select_code_6
      port map (codes => term2_unit_codes(k), choice => query_row_held(k).choice(2), code => term2(k));
  end generate term2_unit;

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      term0_d1 <= term0;
      term1_d1 <= term1;
      term2_d1 <= term2;
      ceiling_h3_d1 <= ceiling_h3;
    end if;
  end process clock_4;
  s_unit_codes_0_each : for k in 0 to 8 generate
    s_unit_codes(k)(0) <= term0_d1(k);
    s_unit_codes(k)(1) <= term1_d1(k);
    s_unit_codes(k)(2) <= term2_d1(k);
  end generate s_unit_codes_0_each;
  s_unit : for k in 0 to 8 generate
    unit : entity work.volume_row_sum
      port map (clk => clk, codes => s_unit_codes(k), factors => query_row_held(k).factor,
                rest => query_row_held(k).rest, ceiling => ceiling_h3_d1, s => s(k));
  end generate s_unit;

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      s_d1 <= s;
    end if;
  end process clock_7;
  u_unit : for k in 0 to 8 generate
    unit : entity work.volume_align_sum
      port map (x => s_d1(k), exponent => b_exponent_h7, aligned => u(k));
  end generate u_unit;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if holds(0) = '1' then
        b_chosen0_select_at_1 <= to_unsigned(b_chosen0_select_at_1_table(to_integer(known(phase))), 2);
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(3) = '1' then
        b_code1_h4 <= b_code(1);
        b_exponent_h4 <= b_exponent;
      end if;
      for k in 0 to 8 loop
        if strobe(2) = '1' then
          query_row_held(k).choice <= query_row(k).choice;
        end if;
        if strobe(3) = '1' then
          query_row_held(k).factor <= query_row(k).factor;
          query_row_held(k).rest <= query_row(k).rest;
        end if;
      end loop;
      if strobe(2) = '1' then
        ceiling_h3 <= to_unsigned(ceiling_table(to_integer(known(b_exponent))), 11);
        b_exponent_h7 <= b_exponent_h4;
      end if;
    end if;
  end process captures;
end architecture rtl;
