--------------------------------------------------------------------------------
-- The types of the design, and the few functions that its entities share.
--
-- A vector has the components x, y, z at 0, 1, 2. Numbers are mantissas; where the binary point is stands where a signal
-- is declared, or in the table of a unit's header.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package {{ name }} is
{%- for line in declarations %}
  {{ line }}
{%- endfor %}
  type numbers_t is array (natural range <>) of integer;
{%- if functions.contains("flag") %}

  -- A condition as a flag.
  function flag(condition : boolean) return std_logic;
{%- endif %}
{%- if functions.contains("known") %}

  -- x, to be compared or to be an index. In simulation it can have no value yet as long as time is 0, before the registers
  -- have reached what is behind them; it is zero then. Later that is worth a warning.
  impure function known(x : signed) return signed;
  impure function known(x : unsigned) return unsigned;
{%- endif %}
{%- if functions.contains("less") %}

  -- Whether x < y, two numbers of one length: the sign of the difference.
  function less(x, y : signed) return std_logic;
{%- endif %}
{%- if functions.contains("choose") %}

  -- One of two values by a flag.
  function choose(condition : std_logic; if_set, if_clear : std_logic) return std_logic;
  function choose(condition : std_logic; if_set, if_clear : signed) return signed;
  function choose(condition : std_logic; if_set, if_clear : unsigned) return unsigned;
{%- endif %}
{%- if functions.contains("to_signed") %}

  -- A flag as a number, 0 or 1.
  function to_signed(set : std_logic; bits : positive) return signed;
{%- endif %}
{%- if functions.contains("to_unsigned") %}
  function to_unsigned(set : std_logic; bits : positive) return unsigned;
{%- endif %}
{%- if functions.contains("negated_if") %}

  -- -x where the flag is set, else x: complement and carry, one look-up table per bit.
  function negated_if(condition : std_logic; x : signed) return signed;
{%- endif %}
{%- if functions.contains("abs_of") %}

  -- Absolute value.
  function abs_of(x : signed) return unsigned;
{%- endif %}
{%- if functions.contains("append") %}

  -- x with zeros appended below.
  function append(x : signed; zeros : positive) return signed;
  function append(x : unsigned; zeros : positive) return unsigned;
{%- endif %}
{%- if functions.contains("or_reduce") %}

  -- Whether some bit is set.
  function or_reduce(x : unsigned) return std_logic;
{%- endif %}
end package {{ name }};
{%- if functions.len() > 0 %}

package body {{ name }} is
{%- if functions.contains("flag") %}
  function flag(condition : boolean) return std_logic is
  begin
    if condition then
      return '1';
    else
      return '0';
    end if;
  end function flag;
{% endif %}
{%- if functions.contains("known") %}
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
{% endif %}
{%- if functions.contains("less") %}
  function less(x, y : signed) return std_logic is
    variable difference : signed(x'length downto 0);
  begin
    difference := resize(x, difference'length) - resize(y, difference'length);
    return difference(difference'high);
  end function less;
{% endif %}
{%- if functions.contains("choose") %}
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
{% endif %}
{%- if functions.contains("to_signed") %}
  function to_signed(set : std_logic; bits : positive) return signed is
    variable number : signed(bits - 1 downto 0) := (others => '0');
  begin
    number(0) := set;
    return number;
  end function to_signed;
{% endif %}
{%- if functions.contains("to_unsigned") %}
  function to_unsigned(set : std_logic; bits : positive) return unsigned is
    variable number : unsigned(bits - 1 downto 0) := (others => '0');
  begin
    number(0) := set;
    return number;
  end function to_unsigned;
{% endif %}
{%- if functions.contains("negated_if") %}
  function negated_if(condition : std_logic; x : signed) return signed is
    variable mask, carry : signed(x'length - 1 downto 0) := (others => '0');
  begin
    mask := (others => condition);
    carry(0) := condition;
    return (x xor mask) + carry;
  end function negated_if;
{% endif %}
{%- if functions.contains("abs_of") %}
  function abs_of(x : signed) return unsigned is
    variable mask, carry : signed(x'length - 1 downto 0) := (others => '0');
  begin
    mask := (others => x(x'high));
    carry(0) := x(x'high);
    return unsigned((x xor mask) + carry);
  end function abs_of;
{% endif %}
{%- if functions.contains("append") %}
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
{% endif %}
{%- if functions.contains("or_reduce") %}
  function or_reduce(x : unsigned) return std_logic is
    variable any : std_logic := '0';
  begin
    for i in x'range loop
      any := any or x(i);
    end loop;
    return any;
  end function or_reduce;
{% endif %}
end package body {{ name }};
{%- endif %}
