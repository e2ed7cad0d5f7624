-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The types of the design, and the few functions that its entities share.
--
-- A vector has the components x, y, z at 0, 1, 2. Numbers are mantissas; where the binary point is stands where a signal
-- is declared, or in the table of a unit's header.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package efsat_types is
  type signed_18_x2_t is array (0 to 1) of signed(17 downto 0);
  constant zero_signed_18_x2 : signed_18_x2_t := (others => (others => '0'));
  type signed_38_x2_t is array (0 to 1) of signed(37 downto 0);
  type signed_58_x2_t is array (0 to 1) of signed(57 downto 0);
  constant zero_signed_58_x2 : signed_58_x2_t := (others => (others => '0'));
  type signed_59_x2_t is array (0 to 1) of signed(58 downto 0);
  constant zero_signed_59_x2 : signed_59_x2_t := (others => (others => '0'));
  type signed_60_x2_t is array (0 to 1) of signed(59 downto 0);
  type signed_18_x3_t is array (0 to 2) of signed(17 downto 0);
  type signed_36_x3_t is array (0 to 2) of signed(35 downto 0);
  constant zero_signed_36_x3 : signed_36_x3_t := (others => (others => '0'));
  type signed_37_x3_t is array (0 to 2) of signed(36 downto 0);
  constant zero_signed_37_x3 : signed_37_x3_t := (others => (others => '0'));
  type signed_38_x3_t is array (0 to 2) of signed(37 downto 0);
  constant zero_signed_38_x3 : signed_38_x3_t := (others => (others => '0'));
  type signed_57_x3_t is array (0 to 2) of signed(56 downto 0);
  constant zero_signed_57_x3 : signed_57_x3_t := (others => (others => '0'));
  type signed_58_x3_t is array (0 to 2) of signed(57 downto 0);
  constant zero_signed_58_x3 : signed_58_x3_t := (others => (others => '0'));
  type signed_59_x3_t is array (0 to 2) of signed(58 downto 0);
  constant zero_signed_59_x3 : signed_59_x3_t := (others => (others => '0'));
  type signed_36_x4_t is array (0 to 3) of signed(35 downto 0);
  constant zero_signed_36_x4 : signed_36_x4_t := (others => (others => '0'));
  type signed_36_x6_t is array (0 to 5) of signed(35 downto 0);
  constant zero_signed_36_x6 : signed_36_x6_t := (others => (others => '0'));
  type signed_57_x10_t is array (0 to 9) of signed(56 downto 0);
  type signed_36_x12_t is array (0 to 11) of signed(35 downto 0);
  type signed_60_x15_t is array (0 to 14) of signed(59 downto 0);
  type signed_37_1_to_2_t is array (1 to 2) of signed(36 downto 0);
  constant zero_signed_37_1_to_2 : signed_37_1_to_2_t := (others => (others => '0'));
  type signed_38_1_to_2_t is array (1 to 2) of signed(37 downto 0);
  constant zero_signed_38_1_to_2 : signed_38_1_to_2_t := (others => (others => '0'));
  type signed_60_4_to_11_t is array (4 to 11) of signed(59 downto 0);
  constant zero_signed_60_4_to_11 : signed_60_4_to_11_t := (others => (others => '0'));
  type signed_18_vector_t is array (0 to 2) of signed(17 downto 0);
  constant zero_signed_18_vector : signed_18_vector_t := (others => (others => '0'));
  type signed_19_vector_t is array (0 to 2) of signed(18 downto 0);
  type signed_32_vector_t is array (0 to 2) of signed(31 downto 0);
  constant zero_signed_32_vector : signed_32_vector_t := (others => (others => '0'));
  type signed_33_vector_t is array (0 to 2) of signed(32 downto 0);
  constant zero_signed_33_vector : signed_33_vector_t := (others => (others => '0'));
  type signed_36_vector_t is array (0 to 2) of signed(35 downto 0);
  constant zero_signed_36_vector : signed_36_vector_t := (others => (others => '0'));
  type flag_x2_x2_t is array (0 to 1) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_x2 : flag_x2_x2_t := (others => (others => '0'));
  type signed_18_x2_x2_t is array (0 to 1) of signed_18_x2_t;
  type flag_x3_x2_t is array (0 to 1) of std_logic_vector(2 downto 0);
  constant zero_flag_x3_x2 : flag_x3_x2_t := (others => (others => '0'));
  type signed_36_x3_x2_t is array (0 to 1) of signed_36_x3_t;
  constant zero_signed_36_x3_x2 : signed_36_x3_x2_t := (others => zero_signed_36_x3);
  type signed_57_x3_x2_t is array (0 to 1) of signed_57_x3_t;
  type signed_18_vector_x2_t is array (0 to 1) of signed_18_vector_t;
  constant zero_signed_18_vector_x2 : signed_18_vector_x2_t := (others => zero_signed_18_vector);
  type flag_x2_x3_t is array (0 to 2) of std_logic_vector(1 downto 0);
  type signed_18_x2_x3_t is array (0 to 2) of signed_18_x2_t;
  constant zero_signed_18_x2_x3 : signed_18_x2_x3_t := (others => zero_signed_18_x2);
  type signed_18_x3_x3_t is array (0 to 2) of signed_18_x3_t;
  type signed_32_vector_x3_t is array (0 to 2) of signed_32_vector_t;
  constant zero_signed_32_vector_x3 : signed_32_vector_x3_t := (others => zero_signed_32_vector);
  type flag_x2_x4_t is array (0 to 3) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_x4 : flag_x2_x4_t := (others => (others => '0'));
  type signed_36_vector_x4_t is array (0 to 3) of signed_36_vector_t;
  type flag_vector_x5_t is array (0 to 4) of std_logic_vector(2 downto 0);
  type signed_18_vector_x5_t is array (0 to 4) of signed_18_vector_t;
  constant zero_signed_18_vector_x5 : signed_18_vector_x5_t := (others => zero_signed_18_vector);
  type signed_33_vector_x5_t is array (0 to 4) of signed_33_vector_t;
  type flag_x2_x6_t is array (0 to 5) of std_logic_vector(1 downto 0);
  type signed_18_x2_x6_t is array (0 to 5) of signed_18_x2_t;
  type signed_38_x3_x6_t is array (0 to 5) of signed_38_x3_t;
  constant zero_signed_38_x3_x6 : signed_38_x3_x6_t := (others => zero_signed_38_x3);
  type signed_18_vector_x10_t is array (0 to 9) of signed_18_vector_t;
  type signed_36_vector_x10_t is array (0 to 9) of signed_36_vector_t;
  type signed_18_x2_x12_t is array (0 to 11) of signed_18_x2_t;
  type flag_x2_x15_t is array (0 to 14) of std_logic_vector(1 downto 0);
  type signed_37_1_to_2_3_to_5_t is array (3 to 5) of signed_37_1_to_2_t;
  constant zero_signed_37_1_to_2_3_to_5 : signed_37_1_to_2_3_to_5_t := (others => zero_signed_37_1_to_2);
  type signed_38_1_to_2_3_to_5_t is array (3 to 5) of signed_38_1_to_2_t;
  constant zero_signed_38_1_to_2_3_to_5 : signed_38_1_to_2_3_to_5_t := (others => zero_signed_38_1_to_2);
  type flag_x2_4_to_5_t is array (4 to 5) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_4_to_5 : flag_x2_4_to_5_t := (others => (others => '0'));
  type flag_x2_4_to_11_t is array (4 to 11) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_4_to_11 : flag_x2_4_to_11_t := (others => (others => '0'));
  type flag_x2_12_to_14_t is array (12 to 14) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_12_to_14 : flag_x2_12_to_14_t := (others => (others => '0'));
  type signed_18_x2_vector_t is array (0 to 2) of signed_18_x2_t;
  type flag_x2_x3_x2_t is array (0 to 1) of flag_x2_x3_t;
  type flag_x2_x3_x3_t is array (0 to 2) of flag_x2_x3_t;
  type flag_x2_x2_x6_t is array (0 to 5) of flag_x2_x2_t;
  type flag_x2_x3_x6_t is array (0 to 5) of flag_x2_x3_t;
  type numbers_t is array (natural range <>) of integer;

  -- A condition as a flag.
  function flag(condition : boolean) return std_logic;

  -- x, to be compared or to be an index. In simulation it can have no value yet as long as time is 0, before the registers
  -- have reached what is behind them; it is zero then. Later that is worth a warning.
  impure function known(x : signed) return signed;
  impure function known(x : unsigned) return unsigned;

  -- Whether x < y, two numbers of one length: the sign of the difference.
  function less(x, y : signed) return std_logic;

  -- One of two values by a flag.
  function choose(condition : std_logic; if_set, if_clear : std_logic) return std_logic;
  function choose(condition : std_logic; if_set, if_clear : signed) return signed;
  function choose(condition : std_logic; if_set, if_clear : unsigned) return unsigned;
  function to_unsigned(set : std_logic; bits : positive) return unsigned;

  -- Whether some bit is set.
  function or_reduce(x : unsigned) return std_logic;
end package efsat_types;

package body efsat_types is
  function flag(condition : boolean) return std_logic is
  begin
    if condition then
      return '1';
    else
      return '0';
    end if;
  end function flag;

  impure function known(x : signed) return signed is
  begin
    -- synthesis translate_off
    if is_x(std_logic_vector(x)) then
      assert now = 0 ns report "metavalue in a comparison" severity warning;
      return to_signed(0, x'length);
    end if;
    -- synthesis translate_on
    return x;
  end function known;

  impure function known(x : unsigned) return unsigned is
  begin
    -- synthesis translate_off
    if is_x(std_logic_vector(x)) then
      assert now = 0 ns report "metavalue in a comparison or an index" severity warning;
      return to_unsigned(0, x'length);
    end if;
    -- synthesis translate_on
    return x;
  end function known;

  function less(x, y : signed) return std_logic is
    variable difference : signed(x'length downto 0);
  begin
    difference := resize(x, difference'length) - resize(y, difference'length);
    return difference(difference'high);
  end function less;

  function choose(condition : std_logic; if_set, if_clear : std_logic) return std_logic is
  begin
    if condition = '1' then
      return if_set;
    else
      return if_clear;
    end if;
  end function choose;

  function choose(condition : std_logic; if_set, if_clear : signed) return signed is
  begin
    if condition = '1' then
      return if_set;
    else
      return if_clear;
    end if;
  end function choose;

  function choose(condition : std_logic; if_set, if_clear : unsigned) return unsigned is
  begin
    if condition = '1' then
      return if_set;
    else
      return if_clear;
    end if;
  end function choose;

  function to_unsigned(set : std_logic; bits : positive) return unsigned is
    variable number : unsigned(bits - 1 downto 0) := (others => '0');
  begin
    number(0) := set;
    return number;
  end function to_unsigned;

  function or_reduce(x : unsigned) return std_logic is
    variable any : std_logic := '0';
  begin
    for i in x'range loop
      any := any or x(i);
    end loop;
    return any;
  end function or_reduce;

end package body efsat_types;
