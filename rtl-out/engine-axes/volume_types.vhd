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

package volume_types is
  type unsigned_3_x2_t is array (0 to 1) of unsigned(2 downto 0);
  constant zero_unsigned_3_x2 : unsigned_3_x2_t := (others => (others => '0'));
  type signed_10_x2_t is array (0 to 1) of signed(9 downto 0);
  constant zero_signed_10_x2 : signed_10_x2_t := (others => (others => '0'));
  type signed_25_x2_t is array (0 to 1) of signed(24 downto 0);
  constant zero_signed_25_x2 : signed_25_x2_t := (others => (others => '0'));
  type signed_27_x2_t is array (0 to 1) of signed(26 downto 0);
  constant zero_signed_27_x2 : signed_27_x2_t := (others => (others => '0'));
  type signed_29_x2_t is array (0 to 1) of signed(28 downto 0);
  type unsigned_3_x3_t is array (0 to 2) of unsigned(2 downto 0);
  constant zero_unsigned_3_x3 : unsigned_3_x3_t := (others => (others => '0'));
  type unsigned_12_x3_t is array (0 to 2) of unsigned(11 downto 0);
  constant zero_unsigned_12_x3 : unsigned_12_x3_t := (others => (others => '0'));
  type signed_10_x3_t is array (0 to 2) of signed(9 downto 0);
  type signed_13_x3_t is array (0 to 2) of signed(12 downto 0);
  type signed_23_x3_t is array (0 to 2) of signed(22 downto 0);
  type signed_26_x3_t is array (0 to 2) of signed(25 downto 0);
  constant zero_signed_26_x3 : signed_26_x3_t := (others => (others => '0'));
  type signed_28_x3_t is array (0 to 2) of signed(27 downto 0);
  type signed_10_x6_t is array (0 to 5) of signed(9 downto 0);
  type signed_10_x9_t is array (0 to 8) of signed(9 downto 0);
  constant zero_signed_10_x9 : signed_10_x9_t := (others => (others => '0'));
  type signed_24_x9_t is array (0 to 8) of signed(23 downto 0);
  constant zero_signed_24_x9 : signed_24_x9_t := (others => (others => '0'));
  type signed_28_x9_t is array (0 to 8) of signed(27 downto 0);
  constant zero_signed_28_x9 : signed_28_x9_t := (others => (others => '0'));
  type signed_10_x18_t is array (0 to 17) of signed(9 downto 0);
  constant zero_signed_10_x18 : signed_10_x18_t := (others => (others => '0'));
  type signed_28_3_to_8_t is array (3 to 8) of signed(27 downto 0);
  constant zero_signed_28_3_to_8 : signed_28_3_to_8_t := (others => (others => '0'));
  type unsigned_16_vector_t is array (0 to 2) of unsigned(15 downto 0);
  constant zero_unsigned_16_vector : unsigned_16_vector_t := (others => (others => '0'));
  type signed_18_vector_t is array (0 to 2) of signed(17 downto 0);
  constant zero_signed_18_vector : signed_18_vector_t := (others => (others => '0'));
  type signed_26_vector_t is array (0 to 2) of signed(25 downto 0);
  constant zero_signed_26_vector : signed_26_vector_t := (others => (others => '0'));
  type signed_27_vector_t is array (0 to 2) of signed(26 downto 0);
  constant zero_signed_27_vector : signed_27_vector_t := (others => (others => '0'));
  type signed_36_vector_t is array (0 to 2) of signed(35 downto 0);
  type row_u13_t is record
    choice : unsigned_3_x3_t;
    factor : unsigned_12_x3_t;
    rest : unsigned(12 downto 0);
  end record row_u13_t;
  constant zero_row_u13 : row_u13_t := (choice => zero_unsigned_3_x3, factor => zero_unsigned_12_x3, rest => (others => '0'));
  type flag_x2_x2_t is array (0 to 1) of std_logic_vector(1 downto 0);
  constant zero_flag_x2_x2 : flag_x2_x2_t := (others => (others => '0'));
  type signed_10_x18_x2_t is array (0 to 1) of signed_10_x18_t;
  constant zero_signed_10_x18_x2 : signed_10_x18_x2_t := (others => zero_signed_10_x18);
  type flag_x2_x3_t is array (0 to 2) of std_logic_vector(1 downto 0);
  type unsigned_3_x2_x3_t is array (0 to 2) of unsigned_3_x2_t;
  constant zero_unsigned_3_x2_x3 : unsigned_3_x2_x3_t := (others => zero_unsigned_3_x2);
  type flag_x4_x3_t is array (0 to 2) of std_logic_vector(3 downto 0);
  constant zero_flag_x4_x3 : flag_x4_x3_t := (others => (others => '0'));
  type signed_18_vector_x3_t is array (0 to 2) of signed_18_vector_t;
  constant zero_signed_18_vector_x3 : signed_18_vector_x3_t := (others => zero_signed_18_vector);
  type flag_x2_x9_t is array (0 to 8) of std_logic_vector(1 downto 0);
  type signed_10_x2_x9_t is array (0 to 8) of signed_10_x2_t;
  constant zero_signed_10_x2_x9 : signed_10_x2_x9_t := (others => zero_signed_10_x2);
  type signed_25_x2_x9_t is array (0 to 8) of signed_25_x2_t;
  constant zero_signed_25_x2_x9 : signed_25_x2_x9_t := (others => zero_signed_25_x2);
  type signed_10_x3_x9_t is array (0 to 8) of signed_10_x3_t;
  type signed_10_x6_x9_t is array (0 to 8) of signed_10_x6_t;
  type signed_27_x2_vector_t is array (0 to 2) of signed_27_x2_t;
  type row_u13_x9_t is array (0 to 8) of row_u13_t;
  constant zero_row_u13_x9 : row_u13_x9_t := (others => zero_row_u13);
  type numbers_t is array (natural range <>) of integer;

  -- A condition as a flag.
  function flag(condition : boolean) return std_logic;

  -- x, to be compared or to be an index. In simulation it can have no value yet as long as time is 0, before the registers
  -- have reached what is behind them; it is zero then. Later that is worth a warning.
  impure function known(x : signed) return signed;
  impure function known(x : unsigned) return unsigned;

  -- One of two values by a flag.
  function choose(condition : std_logic; if_set, if_clear : std_logic) return std_logic;
  function choose(condition : std_logic; if_set, if_clear : signed) return signed;
  function choose(condition : std_logic; if_set, if_clear : unsigned) return unsigned;

  -- x with zeros appended below.
  function append(x : signed; zeros : positive) return signed;
  function append(x : unsigned; zeros : positive) return unsigned;

  -- Whether some bit is set.
  function or_reduce(x : unsigned) return std_logic;
end package volume_types;

package body volume_types is
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

end package body volume_types;
