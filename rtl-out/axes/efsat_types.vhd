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
  type interval_u17_t is record
    lo : unsigned(16 downto 0);
    hi : unsigned(16 downto 0);
  end record interval_u17_t;
  constant zero_interval_u17 : interval_u17_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_18_t is record
    lo : signed(17 downto 0);
    hi : signed(17 downto 0);
  end record interval_18_t;
  constant zero_interval_18 : interval_18_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_19_19_t is record
    lo : signed(18 downto 0);
    hi : signed(18 downto 0);
  end record interval_19_19_t;
  constant zero_interval_19_19 : interval_19_19_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_19_20_t is record
    lo : signed(18 downto 0);
    hi : signed(19 downto 0);
  end record interval_19_20_t;
  type interval_21_t is record
    lo : signed(20 downto 0);
    hi : signed(20 downto 0);
  end record interval_21_t;
  constant zero_interval_21 : interval_21_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_22_t is record
    lo : signed(21 downto 0);
    hi : signed(21 downto 0);
  end record interval_22_t;
  constant zero_interval_22 : interval_22_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_25_t is record
    lo : signed(24 downto 0);
    hi : signed(24 downto 0);
  end record interval_25_t;
  constant zero_interval_25 : interval_25_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_32_t is record
    lo : signed(31 downto 0);
    hi : signed(31 downto 0);
  end record interval_32_t;
  constant zero_interval_32 : interval_32_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_33_t is record
    lo : signed(32 downto 0);
    hi : signed(32 downto 0);
  end record interval_33_t;
  constant zero_interval_33 : interval_33_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_36_t is record
    lo : signed(35 downto 0);
    hi : signed(35 downto 0);
  end record interval_36_t;
  constant zero_interval_36 : interval_36_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_37_t is record
    lo : signed(36 downto 0);
    hi : signed(36 downto 0);
  end record interval_37_t;
  constant zero_interval_37 : interval_37_t := (lo => (others => '0'), hi => (others => '0'));
  type interval_38_t is record
    lo : signed(37 downto 0);
    hi : signed(37 downto 0);
  end record interval_38_t;
  type interval_39_t is record
    lo : signed(38 downto 0);
    hi : signed(38 downto 0);
  end record interval_39_t;
  constant zero_interval_39 : interval_39_t := (lo => (others => '0'), hi => (others => '0'));
  type signed_32_x3_t is array (0 to 2) of signed(31 downto 0);
  constant zero_signed_32_x3 : signed_32_x3_t := (others => (others => '0'));
  type unsigned_4_1_to_2_t is array (1 to 2) of unsigned(3 downto 0);
  constant zero_unsigned_4_1_to_2 : unsigned_4_1_to_2_t := (others => (others => '0'));
  type unsigned_17_1_to_2_t is array (1 to 2) of unsigned(16 downto 0);
  type unsigned_2_vector_t is array (0 to 2) of unsigned(1 downto 0);
  constant zero_unsigned_2_vector : unsigned_2_vector_t := (others => (others => '0'));
  type unsigned_4_vector_t is array (0 to 2) of unsigned(3 downto 0);
  type unsigned_19_vector_t is array (0 to 2) of unsigned(18 downto 0);
  type unsigned_32_vector_t is array (0 to 2) of unsigned(31 downto 0);
  constant zero_unsigned_32_vector : unsigned_32_vector_t := (others => (others => '0'));
  type unsigned_33_vector_t is array (0 to 2) of unsigned(32 downto 0);
  type signed_18_vector_t is array (0 to 2) of signed(17 downto 0);
  constant zero_signed_18_vector : signed_18_vector_t := (others => (others => '0'));
  type signed_19_vector_t is array (0 to 2) of signed(18 downto 0);
  constant zero_signed_19_vector : signed_19_vector_t := (others => (others => '0'));
  type signed_32_vector_t is array (0 to 2) of signed(31 downto 0);
  constant zero_signed_32_vector : signed_32_vector_t := (others => (others => '0'));
  type signed_33_vector_t is array (0 to 2) of signed(32 downto 0);
  constant zero_signed_33_vector : signed_33_vector_t := (others => (others => '0'));
  type signed_34_vector_t is array (0 to 2) of signed(33 downto 0);
  type signed_64_vector_t is array (0 to 2) of signed(63 downto 0);
  constant zero_signed_64_vector : signed_64_vector_t := (others => (others => '0'));
  type flag_x2_x2_t is array (0 to 1) of std_logic_vector(1 downto 0);
  type flag_x3_x2_t is array (0 to 1) of std_logic_vector(2 downto 0);
  constant zero_flag_x3_x2 : flag_x3_x2_t := (others => (others => '0'));
  type unsigned_2_vector_x2_t is array (0 to 1) of unsigned_2_vector_t;
  constant zero_unsigned_2_vector_x2 : unsigned_2_vector_x2_t := (others => zero_unsigned_2_vector);
  type flag_x3_x3_t is array (0 to 2) of std_logic_vector(2 downto 0);
  constant zero_flag_x3_x3 : flag_x3_x3_t := (others => (others => '0'));
  type signed_32_vector_x3_t is array (0 to 2) of signed_32_vector_t;
  constant zero_signed_32_vector_x3 : signed_32_vector_x3_t := (others => zero_signed_32_vector);
  type interval_22_x4_t is array (0 to 3) of interval_22_t;
  constant zero_interval_22_x4 : interval_22_x4_t := (others => zero_interval_22);
  type unsigned_2_vector_x4_t is array (0 to 3) of unsigned_2_vector_t;
  constant zero_unsigned_2_vector_x4 : unsigned_2_vector_x4_t := (others => zero_unsigned_2_vector);
  type unsigned_2_vector_1_to_2_t is array (1 to 2) of unsigned_2_vector_t;
  type signed_18_vector_1_to_2_t is array (1 to 2) of signed_18_vector_t;
  type signed_32_vector_1_to_2_t is array (1 to 2) of signed_32_vector_t;
  constant zero_signed_32_vector_1_to_2 : signed_32_vector_1_to_2_t := (others => zero_signed_32_vector);
  type interval_u17_vector_t is array (0 to 2) of interval_u17_t;
  type interval_18_vector_t is array (0 to 2) of interval_18_t;
  constant zero_interval_18_vector : interval_18_vector_t := (others => zero_interval_18);
  type interval_19_19_vector_t is array (0 to 2) of interval_19_19_t;
  constant zero_interval_19_19_vector : interval_19_19_vector_t := (others => zero_interval_19_19);
  type interval_19_20_vector_t is array (0 to 2) of interval_19_20_t;
  type interval_21_vector_t is array (0 to 2) of interval_21_t;
  constant zero_interval_21_vector : interval_21_vector_t := (others => zero_interval_21);
  type interval_25_vector_t is array (0 to 2) of interval_25_t;
  constant zero_interval_25_vector : interval_25_vector_t := (others => zero_interval_25);
  type interval_32_vector_t is array (0 to 2) of interval_32_t;
  constant zero_interval_32_vector : interval_32_vector_t := (others => zero_interval_32);
  type interval_33_vector_t is array (0 to 2) of interval_33_t;
  constant zero_interval_33_vector : interval_33_vector_t := (others => zero_interval_33);
  type interval_36_vector_t is array (0 to 2) of interval_36_t;
  type interval_37_vector_t is array (0 to 2) of interval_37_t;
  constant zero_interval_37_vector : interval_37_vector_t := (others => zero_interval_37);
  type flag_x5_vector_t is array (0 to 2) of std_logic_vector(4 downto 0);
  constant zero_flag_x5_vector : flag_x5_vector_t := (others => (others => '0'));
  type interval_18_vector_x2_t is array (0 to 1) of interval_18_vector_t;
  constant zero_interval_18_vector_x2 : interval_18_vector_x2_t := (others => zero_interval_18_vector);
  type interval_18_vector_x4_t is array (0 to 3) of interval_18_vector_t;
  constant zero_interval_18_vector_x4 : interval_18_vector_x4_t := (others => zero_interval_18_vector);
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

  -- -x where the flag is set, else x: complement and carry, one look-up table per bit.
  function negated_if(condition : std_logic; x : signed) return signed;

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

  function to_unsigned(set : std_logic; bits : positive) return unsigned is
    variable number : unsigned(bits - 1 downto 0) := (others => '0');
  begin
    number(0) := set;
    return number;
  end function to_unsigned;

  function negated_if(condition : std_logic; x : signed) return signed is
    variable mask, carry : signed(x'length - 1 downto 0) := (others => '0');
  begin
    mask := (others => condition);
    carry(0) := condition;
    return (x xor mask) + carry;
  end function negated_if;

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
