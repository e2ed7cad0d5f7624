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
  type unsigned_3_x2_t is array (0 to 1) of unsigned(2 downto 0);
  constant zero_unsigned_3_x2 : unsigned_3_x2_t := (others => (others => '0'));
  type unsigned_20_x2_t is array (0 to 1) of unsigned(19 downto 0);
  type unsigned_21_x2_t is array (0 to 1) of unsigned(20 downto 0);
  constant zero_unsigned_21_x2 : unsigned_21_x2_t := (others => (others => '0'));
  type unsigned_24_x2_t is array (0 to 1) of unsigned(23 downto 0);
  constant zero_unsigned_24_x2 : unsigned_24_x2_t := (others => (others => '0'));
  type unsigned_27_x2_t is array (0 to 1) of unsigned(26 downto 0);
  type unsigned_28_x2_t is array (0 to 1) of unsigned(27 downto 0);
  type signed_18_x2_t is array (0 to 1) of signed(17 downto 0);
  constant zero_signed_18_x2 : signed_18_x2_t := (others => (others => '0'));
  type signed_19_x2_t is array (0 to 1) of signed(18 downto 0);
  type signed_38_x2_t is array (0 to 1) of signed(37 downto 0);
  constant zero_signed_38_x2 : signed_38_x2_t := (others => (others => '0'));
  type signed_39_x2_t is array (0 to 1) of signed(38 downto 0);
  constant zero_signed_39_x2 : signed_39_x2_t := (others => (others => '0'));
  type signed_40_x2_t is array (0 to 1) of signed(39 downto 0);
  constant zero_signed_40_x2 : signed_40_x2_t := (others => (others => '0'));
  type signed_41_x2_t is array (0 to 1) of signed(40 downto 0);
  type unsigned_3_x3_t is array (0 to 2) of unsigned(2 downto 0);
  type unsigned_21_x3_t is array (0 to 2) of unsigned(20 downto 0);
  constant zero_unsigned_21_x3 : unsigned_21_x3_t := (others => (others => '0'));
  type unsigned_22_x3_t is array (0 to 2) of unsigned(21 downto 0);
  constant zero_unsigned_22_x3 : unsigned_22_x3_t := (others => (others => '0'));
  type unsigned_23_x3_t is array (0 to 2) of unsigned(22 downto 0);
  constant zero_unsigned_23_x3 : unsigned_23_x3_t := (others => (others => '0'));
  type unsigned_24_x3_t is array (0 to 2) of unsigned(23 downto 0);
  type unsigned_25_x3_t is array (0 to 2) of unsigned(24 downto 0);
  type unsigned_29_x3_t is array (0 to 2) of unsigned(28 downto 0);
  constant zero_unsigned_29_x3 : unsigned_29_x3_t := (others => (others => '0'));
  type signed_18_x3_t is array (0 to 2) of signed(17 downto 0);
  constant zero_signed_18_x3 : signed_18_x3_t := (others => (others => '0'));
  type signed_19_x3_t is array (0 to 2) of signed(18 downto 0);
  type signed_30_x3_t is array (0 to 2) of signed(29 downto 0);
  type signed_31_x3_t is array (0 to 2) of signed(30 downto 0);
  constant zero_signed_31_x3 : signed_31_x3_t := (others => (others => '0'));
  type signed_32_x3_t is array (0 to 2) of signed(31 downto 0);
  constant zero_signed_32_x3 : signed_32_x3_t := (others => (others => '0'));
  type signed_34_x3_t is array (0 to 2) of signed(33 downto 0);
  type signed_38_x3_t is array (0 to 2) of signed(37 downto 0);
  constant zero_signed_38_x3 : signed_38_x3_t := (others => (others => '0'));
  type signed_39_x3_t is array (0 to 2) of signed(38 downto 0);
  constant zero_signed_39_x3 : signed_39_x3_t := (others => (others => '0'));
  type signed_40_x3_t is array (0 to 2) of signed(39 downto 0);
  constant zero_signed_40_x3 : signed_40_x3_t := (others => (others => '0'));
  type unsigned_20_x4_t is array (0 to 3) of unsigned(19 downto 0);
  constant zero_unsigned_20_x4 : unsigned_20_x4_t := (others => (others => '0'));
  type unsigned_21_x4_t is array (0 to 3) of unsigned(20 downto 0);
  type unsigned_28_x4_t is array (0 to 3) of unsigned(27 downto 0);
  constant zero_unsigned_28_x4 : unsigned_28_x4_t := (others => (others => '0'));
  type signed_20_x4_t is array (0 to 3) of signed(19 downto 0);
  type signed_31_x4_t is array (0 to 3) of signed(30 downto 0);
  constant zero_signed_31_x4 : signed_31_x4_t := (others => (others => '0'));
  type signed_38_x4_t is array (0 to 3) of signed(37 downto 0);
  type signed_41_x4_t is array (0 to 3) of signed(40 downto 0);
  constant zero_signed_41_x4 : signed_41_x4_t := (others => (others => '0'));
  type unsigned_31_x5_t is array (0 to 4) of unsigned(30 downto 0);
  type signed_19_x5_t is array (0 to 4) of signed(18 downto 0);
  type signed_31_x5_t is array (0 to 4) of signed(30 downto 0);
  type signed_33_x5_t is array (0 to 4) of signed(32 downto 0);
  type signed_41_x5_t is array (0 to 4) of signed(40 downto 0);
  type unsigned_21_x8_t is array (0 to 7) of unsigned(20 downto 0);
  type unsigned_21_x9_t is array (0 to 8) of unsigned(20 downto 0);
  constant zero_unsigned_21_x9 : unsigned_21_x9_t := (others => (others => '0'));
  type unsigned_29_x9_t is array (0 to 8) of unsigned(28 downto 0);
  constant zero_unsigned_29_x9 : unsigned_29_x9_t := (others => (others => '0'));
  type signed_34_x9_t is array (0 to 8) of signed(33 downto 0);
  constant zero_signed_34_x9 : signed_34_x9_t := (others => (others => '0'));
  type signed_20_x12_t is array (0 to 11) of signed(19 downto 0);
  constant zero_signed_20_x12 : signed_20_x12_t := (others => (others => '0'));
  type signed_31_x15_t is array (0 to 14) of signed(30 downto 0);
  type signed_41_x15_t is array (0 to 14) of signed(40 downto 0);
  type signed_31_4_to_8_t is array (4 to 8) of signed(30 downto 0);
  constant zero_signed_31_4_to_8 : signed_31_4_to_8_t := (others => (others => '0'));
  type signed_41_9_to_14_t is array (9 to 14) of signed(40 downto 0);
  constant zero_signed_41_9_to_14 : signed_41_9_to_14_t := (others => (others => '0'));
  type signed_31_12_to_14_t is array (12 to 14) of signed(30 downto 0);
  constant zero_signed_31_12_to_14 : signed_31_12_to_14_t := (others => (others => '0'));
  type unsigned_18_vector_t is array (0 to 2) of unsigned(17 downto 0);
  type unsigned_19_vector_t is array (0 to 2) of unsigned(18 downto 0);
  type signed_18_vector_t is array (0 to 2) of signed(17 downto 0);
  constant zero_signed_18_vector : signed_18_vector_t := (others => (others => '0'));
  type signed_19_vector_t is array (0 to 2) of signed(18 downto 0);
  constant zero_signed_19_vector : signed_19_vector_t := (others => (others => '0'));
  type signed_20_vector_t is array (0 to 2) of signed(19 downto 0);
  type signed_21_vector_t is array (0 to 2) of signed(20 downto 0);
  type signed_22_vector_t is array (0 to 2) of signed(21 downto 0);
  type signed_26_vector_t is array (0 to 2) of signed(25 downto 0);
  type signed_31_vector_t is array (0 to 2) of signed(30 downto 0);
  type signed_32_vector_t is array (0 to 2) of signed(31 downto 0);
  constant zero_signed_32_vector : signed_32_vector_t := (others => (others => '0'));
  type signed_33_vector_t is array (0 to 2) of signed(32 downto 0);
  constant zero_signed_33_vector : signed_33_vector_t := (others => (others => '0'));
  type signed_34_vector_t is array (0 to 2) of signed(33 downto 0);
  type signed_36_vector_t is array (0 to 2) of signed(35 downto 0);
  type signed_37_vector_t is array (0 to 2) of signed(36 downto 0);
  constant zero_signed_37_vector : signed_37_vector_t := (others => (others => '0'));
  type flag_x2_x2_t is array (0 to 1) of std_logic_vector(1 downto 0);
  type unsigned_29_x3_x2_t is array (0 to 1) of unsigned_29_x3_t;
  constant zero_unsigned_29_x3_x2 : unsigned_29_x3_x2_t := (others => zero_unsigned_29_x3);
  type signed_30_x3_x2_t is array (0 to 1) of signed_30_x3_t;
  type signed_38_x3_x2_t is array (0 to 1) of signed_38_x3_t;
  type signed_18_vector_x2_t is array (0 to 1) of signed_18_vector_t;
  constant zero_signed_18_vector_x2 : signed_18_vector_x2_t := (others => zero_signed_18_vector);
  type signed_19_vector_x2_t is array (0 to 1) of signed_19_vector_t;
  constant zero_signed_19_vector_x2 : signed_19_vector_x2_t := (others => zero_signed_19_vector);
  type signed_20_vector_x2_t is array (0 to 1) of signed_20_vector_t;
  type signed_33_vector_x2_t is array (0 to 1) of signed_33_vector_t;
  constant zero_signed_33_vector_x2 : signed_33_vector_x2_t := (others => zero_signed_33_vector);
  type flag_x2_x3_t is array (0 to 2) of std_logic_vector(1 downto 0);
  type flag_x3_x3_t is array (0 to 2) of std_logic_vector(2 downto 0);
  type signed_32_x3_x3_t is array (0 to 2) of signed_32_x3_t;
  constant zero_signed_32_x3_x3 : signed_32_x3_x3_t := (others => zero_signed_32_x3);
  type signed_18_vector_x3_t is array (0 to 2) of signed_18_vector_t;
  constant zero_signed_18_vector_x3 : signed_18_vector_x3_t := (others => zero_signed_18_vector);
  type signed_19_vector_x3_t is array (0 to 2) of signed_19_vector_t;
  constant zero_signed_19_vector_x3 : signed_19_vector_x3_t := (others => zero_signed_19_vector);
  type signed_32_vector_x3_t is array (0 to 2) of signed_32_vector_t;
  constant zero_signed_32_vector_x3 : signed_32_vector_x3_t := (others => zero_signed_32_vector);
  type signed_33_vector_x3_t is array (0 to 2) of signed_33_vector_t;
  constant zero_signed_33_vector_x3 : signed_33_vector_x3_t := (others => zero_signed_33_vector);
  type signed_18_x2_x4_t is array (0 to 3) of signed_18_x2_t;
  constant zero_signed_18_x2_x4 : signed_18_x2_x4_t := (others => zero_signed_18_x2);
  type signed_18_vector_x4_t is array (0 to 3) of signed_18_vector_t;
  constant zero_signed_18_vector_x4 : signed_18_vector_x4_t := (others => zero_signed_18_vector);
  type flag_x2_x5_t is array (0 to 4) of std_logic_vector(1 downto 0);
  type signed_19_vector_x5_t is array (0 to 4) of signed_19_vector_t;
  constant zero_signed_19_vector_x5 : signed_19_vector_x5_t := (others => zero_signed_19_vector);
  type flag_x2_x15_t is array (0 to 14) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_x15 : flag_x2_x15_t := (others => (others => '0'));
  type signed_32_x3_1_to_2_t is array (1 to 2) of signed_32_x3_t;
  constant zero_signed_32_x3_1_to_2 : signed_32_x3_1_to_2_t := (others => zero_signed_32_x3);
  type signed_18_vector_1_to_2_t is array (1 to 2) of signed_18_vector_t;
  constant zero_signed_18_vector_1_to_2 : signed_18_vector_1_to_2_t := (others => zero_signed_18_vector);
  type flag_x2_2_to_3_t is array (2 to 3) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_2_to_3 : flag_x2_2_to_3_t := (others => (others => '0'));
  type flag_x4_vector_t is array (0 to 2) of std_logic_vector(3 downto 0);
  constant zero_flag_x4_vector : flag_x4_vector_t := (others => (others => '0'));
  type signed_19_x5_vector_t is array (0 to 2) of signed_19_x5_t;
  type signed_33_x5_vector_t is array (0 to 2) of signed_33_x5_t;
  type flag_x4_vector_x2_t is array (0 to 1) of flag_x4_vector_t;
  constant zero_flag_x4_vector_x2 : flag_x4_vector_x2_t := (others => zero_flag_x4_vector);
  type flag_x2_x2_3_to_8_t is array (3 to 8) of flag_x2_x2_t;
  type flag_x2_x3_3_to_8_t is array (3 to 8) of flag_x2_x3_t;
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

  -- A flag as a number, 0 or 1.
  function to_signed(set : std_logic; bits : positive) return signed;

  -- Absolute value.
  function abs_of(x : signed) return unsigned;

  -- x with zeros appended below.
  function append(x : signed; zeros : positive) return signed;
  function append(x : unsigned; zeros : positive) return unsigned;

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

  function to_signed(set : std_logic; bits : positive) return signed is
    variable number : signed(bits - 1 downto 0) := (others => '0');
  begin
    number(0) := set;
    return number;
  end function to_signed;

  function abs_of(x : signed) return unsigned is
    variable mask, carry : signed(x'length - 1 downto 0) := (others => '0');
  begin
    mask := (others => x(x'high));
    carry(0) := x(x'high);
    return unsigned((x xor mask) + carry);
  end function abs_of;

  function append(x : signed; zeros : positive) return signed is
    variable wide : signed(x'length + zeros - 1 downto 0) := (others => '0');
  begin
    wide(wide'high downto zeros) := x;
    return wide;
  end function append;

  function append(x : unsigned; zeros : positive) return unsigned is
    variable wide : unsigned(x'length + zeros - 1 downto 0) := (others => '0');
  begin
    wide(wide'high downto zeros) := x;
    return wide;
  end function append;

  function or_reduce(x : unsigned) return std_logic is
    variable any : std_logic := '0';
  begin
    for i in x'range loop
      any := any or x(i);
    end loop;
    return any;
  end function or_reduce;

end package body efsat_types;
