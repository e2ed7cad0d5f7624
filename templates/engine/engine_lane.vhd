--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The lane of a query: its stack, and what of the rule of issue is about it alone.
--
-- Rule of issue. Let used be the entries of a stack and flying the pairs of its lane in flight; a pair pushes at most four.
-- It is popped if used - 1 + 4 (flying + 1) <= {{ e.traversal.wide }}, or if nothing of its lane flies; and only if less than {{ e.traversal.in_flight }} pairs of all lanes
-- fly. While only pops of the first kind happen, used <= {{ e.traversal.wide }}. With nothing of its lane in flight an entry of level l leaves
-- at most 3 ({{ e.traversal.levels }} - l) + 1 entries above what lay below it, and entries of level {{ e.traversal.levels }} push nothing:
-- used <= {{ e.traversal.wide }} + 3 x {{ e.traversal.levels }} + 1 = {{ e.traversal.stack }} at all times.
--
-- The oldest query comes first. While its queue of leaf pairs is full, but for one place at most, no pair comes into any. A younger
-- query does not fill its own: it is popped only if queued + 4 (flying + 1) < {{ e.traversal.pairs }}. And it pops only while few pairs wait for their
-- blocks, so that those of the oldest do not wait behind many.
--
-- The lane is chosen in one clock (engine_issue) and its pair popped in a later one, and what frees room is counted a clock late or
-- two. Meanwhile used + 4 flying, as queued + 4 flying, is at most 3 more than it was counted, while a record has sent three of its
-- four: so the lane is chosen only if there are 3 places more than the rules ask for. Right behind a pop of its own the lane pops only
-- if there is plenty.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_lane is
  port (
    clk : in std_logic;
    reset : in std_logic;
    start : in std_logic;  -- one clock long: a query begins with the roots
    more_expansions : in unsigned(31 downto 0);  -- of it, behind the first
    only_one : in std_logic;  -- the first is the last
    oldest : in std_logic;  -- it is the oldest query
    ending : in std_logic;  -- from the next clock on it is not chosen any more
    ended : in std_logic;  -- the same, a clock later: no pair is popped
    -- Issue.
    all_fly : in std_logic;  -- no pair more may be in flight
    crowded : in std_logic;  -- so many pairs wait for blocks that a younger query pops none
    may_pop : out std_logic;  -- it may be chosen
    chosen : in std_logic;  -- the next pair that is popped is of this lane
    pop : in std_logic;  -- it is popped
    top_entry : out std_logic_vector(entry_bits - 1 downto 0);
    -- An answer of the volume unit, and the records of survivors that it brings.
    met : in std_logic;
    brings_nodes : in std_logic;
    brings_leaves : in std_logic;
    pushes : in std_logic;  -- a survivor is pushed in the next clock
    next_entry : in std_logic_vector(entry_bits - 1 downto 0);  -- the one that was to be pushed
    nodes_finished : in std_logic;  -- the last of its record
    sends_pair : in std_logic;  -- a pair of leaves goes into its queue
    leaves_finished : in std_logic;  -- a record of leaves is finished
    pair_left : in std_logic;  -- a clock ago a pair left the queue
    -- State.
    idle : out std_logic := '1';  -- a clock ago nothing was in flight, and nothing was to be popped
    limit_reached : out std_logic := '0';
    greatest : out unsigned(15 downto 0)  -- entries of the stack
  );
end entity {{ prefix }}engine_lane;

architecture rtl of {{ prefix }}engine_lane is
  constant wide : integer := {{ e.traversal.wide }};  -- of the rule of issue
  constant room_bits : natural := {{ e.traversal.room_bits }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};
  constant pairs : integer := {{ e.traversal.pairs }};  -- of the queue of leaf pairs
  constant pair_room_bits : natural := {{ e.traversal.pair_room_bits }};

  signal is_root : std_logic := '0';  -- the roots are pushed, and not a survivor
  signal push : std_logic := '0';
  signal push_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal lives : std_logic;
  signal may_start : std_logic := '0';  -- a clock ago it was not chosen, and could be popped
  signal may_follow : std_logic := '0';  -- a clock ago there was plenty, also for a pop then and the one that is due
  signal is_oldest : std_logic := '0';
  signal filled : std_logic;
  signal many : std_logic;  -- three entries or more
  signal room : unsigned(room_bits - 1 downto 0) := (others => '0');  -- wide - 6 - used - 4 flying in two's complement: not negative while a pair may be popped although others of the lane fly
  signal plenty : std_logic := '0';  -- it was at least 16 a clock ago
  signal pair_room : unsigned(pair_room_bits - 1 downto 0) := (others => '0');  -- the same of the queue of leaf pairs: pairs - 8 - those in it - 4 flying
  signal pair_plenty : std_logic := '0';  -- it was at least 32 a clock ago
  signal flying : unsigned(flight_bits + 1 downto 0) := (others => '0');
  signal nothing_flies : std_logic := '1';
  signal allowed : unsigned(31 downto 0) := (others => '0');  -- expansions
  signal last_one : std_logic := '0';  -- the next expansion is the last
  signal few_left : std_logic := '0';  -- a clock ago there were less than eight
  signal spent : std_logic := '0';  -- no expansion more
  -- What a clock changes but for a pop, counted in the next one: a sum is short, or alone in its clock.
  signal freed : signed(4 downto 0) := "00000";  -- places of the stack
  signal pairs_freed : signed(4 downto 0) := "00000";  -- places of the queue of leaf pairs
  signal records : signed(2 downto 0) := "000";  -- that are more than before; a pair in flight counts as one
begin
  lives <= not ending and not ended and not spent;  -- what the last query has left on the stack goes with start
  may_pop <= may_start when chosen = '0' else may_follow;
  push_entry <= "{{ e.traversal.root_entry }}" when is_root = '1' else next_entry;

  stack : entity work.{{ prefix }}engine_stack
    port map (
      clk => clk,
      clear => start,
      push => push,
      push_entry => push_entry,
      pop => pop,
      top_entry => top_entry,
      filled => filled,
      many => many,
      greatest => greatest
    );

  rest : process (clk)
  begin
    if rising_edge(clk) then
      may_start <= lives and filled and not chosen and not all_fly
        and (nothing_flies or not room(room_bits - 1)) and (is_oldest or not (pair_room(pair_room_bits - 1) or crowded));
      may_follow <= lives and many and not few_left and plenty
        and (is_oldest or (pair_plenty and not crowded));
      is_root <= start and not reset;
      push <= (start or (pushes and not ending)) and not reset;
      limit_reached <= filled and spent and not ended and not ending;
      is_oldest <= oldest;
      idle <= nothing_flies and ((ending and ended) or not (filled or ended)) and not is_root;
    end if;
  end process rest;

  count : process (clk)
    variable change : integer range -1 to 9;
    variable pair_change : integer range -1 to 9;
    variable more : integer range -3 to 1;
    variable steady : unsigned(flight_bits + 1 downto 0);  -- pairs in flight and records but for a pop
  begin
    if rising_edge(clk) then
      if start = '1' then
        allowed <= more_expansions;
        last_one <= only_one;
        spent <= '0';
      elsif pop = '1' then
        allowed <= allowed - 1;
        last_one <= '0';
        if allowed = 1 then
          last_one <= '1';
        end if;
        spent <= last_one;
      end if;
      -- A push takes one place, a record that is finished frees four, and a pop, below, frees one and reserves four. In the
      -- queue of leaf pairs a pop reserves four.
      change := 0;
      pair_change := 0;
      more := 0;
      if push = '1' then
        change := change - 1;
      end if;
      if nodes_finished = '1' then
        change := change + 4;
        more := more - 1;
      end if;
      if (met and not brings_nodes) = '1' then
        change := change + 4;
      end if;
      if pair_left = '1' then
        pair_change := pair_change + 1;
      end if;
      if sends_pair = '1' then
        pair_change := pair_change - 1;
      end if;
      if leaves_finished = '1' then
        pair_change := pair_change + 4;
        more := more - 1;
      end if;
      if (met and not brings_leaves) = '1' then
        pair_change := pair_change + 4;
      end if;
      if (met and brings_nodes and brings_leaves) = '1' then
        more := more + 1;
      elsif (met and not brings_nodes and not brings_leaves) = '1' then
        more := more - 1;
      end if;
      if reset = '1' or start = '1' then
        change := 0;
        pair_change := 0;
        more := 0;
      end if;
      freed <= to_signed(change, 5);
      pairs_freed <= to_signed(pair_change, 5);
      records <= to_signed(more, 3);
      few_left <= '0';
      if allowed(31 downto 3) = 0 then
        few_left <= '1';
      end if;
      plenty <= '0';
      if signed(room) >= 16 then
        plenty <= '1';
      end if;
      pair_plenty <= '0';
      if signed(pair_room) >= 32 then
        pair_plenty <= '1';
      end if;
      steady := unsigned(signed(flying) + records);
      if reset = '1' or start = '1' then
        room <= unsigned(to_signed(wide - 6, room_bits));
        pair_room <= to_unsigned(pairs - 8, pair_room_bits);
        flying <= (others => '0');
        nothing_flies <= '1';
      else
        if pop = '1' then
          room <= unsigned(signed(room) + (freed - 3));
          pair_room <= unsigned(signed(pair_room) + (pairs_freed - 4));
          flying <= steady + 1;
          nothing_flies <= '0';
        else
          room <= unsigned(signed(room) + freed);
          pair_room <= unsigned(signed(pair_room) + pairs_freed);
          flying <= steady;
          nothing_flies <= '0';
          if steady = 0 then
            nothing_flies <= '1';
          end if;
        end if;
      end if;
    end if;
  end process count;
end architecture rtl;
