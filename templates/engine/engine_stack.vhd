--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The stack of pairs of a query that are still to be opened. The two uppermost entries are in registers, the third at the output of the
-- memory or, after a push, in a register; so a push and a pop are possible in every clock, also both in one. The second has a register
-- for each of the two ways to it, because a memory gives its word late in a clock.
-- There are never more than {{ e.traversal.stack }} entries: the traversal sees to it (rule of issue), and the report tells the most there were.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_stack is
  port (
    clk : in std_logic;
    clear : in std_logic;  -- empties it
    push : in std_logic;
    push_entry : in std_logic_vector(entry_bits - 1 downto 0);
    pop : in std_logic;  -- only while filled
    top_entry : out std_logic_vector(entry_bits - 1 downto 0);
    filled : out std_logic;  -- there is an entry
    many : out std_logic;  -- there are three or more
    greatest : out unsigned(15 downto 0)  -- number of entries, the most since it was emptied
  );
end entity {{ prefix }}engine_stack;

architecture rtl of {{ prefix }}engine_stack is
  constant places : natural := {{ e.traversal.stack_places }};
  constant place_bits : natural := {{ e.traversal.stack_bits }};
  type entries is array (0 to places - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal memory : entries := (others => (others => '0'));  -- all entries but the two uppermost
  signal used : unsigned(place_bits downto 0) := (others => '0');  -- entries
  signal push_place : unsigned(place_bits - 1 downto 0) := (others => '0');  -- used - 2: where the second goes
  signal pop_place : unsigned(place_bits - 1 downto 0) := (others => '0');  -- used - 4: the third after a pop
  signal place : unsigned(place_bits - 1 downto 0);
  signal top : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal second : std_logic_vector(entry_bits - 1 downto 0);
  signal second_pushed : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');  -- top before the last push
  signal second_popped : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');  -- third before the last pop
  signal pushed_over : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');  -- second before the last push
  signal remembered : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');  -- output of the memory
  signal third : std_logic_vector(entry_bits - 1 downto 0);
  signal last_was_push : std_logic := '0';
  signal grows : std_logic;
  signal shrinks : std_logic;
  signal changes : std_logic;  -- either
  signal filled_now : std_logic := '0';
  signal several : std_logic := '0';  -- two or more
  signal many_now : std_logic := '0';
  signal four : std_logic := '0';  -- or more
  signal most : unsigned(place_bits downto 0) := (others => '0');
begin
  filled <= filled_now;
  many <= many_now;
  top_entry <= top;
  greatest <= resize(most, 16);
  grows <= push and not pop;
  shrinks <= pop and not push;
  changes <= push xor pop;
  -- With a push and a pop at once nothing is read, and what is written is written again before it is read.
  place <= push_place when push = '1' else pop_place;
  second <= second_pushed when last_was_push = '1' else second_popped;
  third <= pushed_over when last_was_push = '1' else remembered;

  remember : process (clk)
  begin
    if rising_edge(clk) then
      -- So is what a push onto fewer than two entries writes.
      if push = '1' then
        memory(to_integer(place)) <= second;
      end if;
      if shrinks = '1' then
        remembered <= memory(to_integer(place));
      end if;
    end if;
  end process remember;

  move : process (clk)
  begin
    if rising_edge(clk) then
      if push = '1' then
        top <= push_entry;
      elsif pop = '1' then
        top <= second;
      end if;
      if grows = '1' then
        pushed_over <= second;
        second_pushed <= top;
      end if;
      if shrinks = '1' then
        second_popped <= third;
      end if;
      if clear = '1' then
        used <= (others => '0');
        filled_now <= '0';
        several <= '0';
        many_now <= '0';
        four <= '0';
        push_place <= to_unsigned(places - 2, place_bits);
        pop_place <= to_unsigned(places - 4, place_bits);
        most <= (others => '0');
        last_was_push <= '0';
      else
        if changes = '1' then
          last_was_push <= push;
          if push = '1' then
            used <= used + 1;
            filled_now <= '1';
            several <= filled_now;
            many_now <= several;
            four <= many_now;
            push_place <= push_place + 1;
            pop_place <= pop_place + 1;
          else
            used <= used - 1;
            filled_now <= several;
            several <= many_now;
            many_now <= four;
            if used = 4 then
              four <= '0';
            end if;
            push_place <= push_place - 1;
            pop_place <= pop_place - 1;
          end if;
        end if;
        if used > most then
          most <= used;
        end if;
      end if;
    end if;
  end process move;
end architecture rtl;
