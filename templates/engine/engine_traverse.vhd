--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The traversals of the queries in flight, each in a lane of its own: depth first from a stack of pairs of nodes. A pair is
-- popped, its two blocks are fetched, the volume unit tests the children of one against the children of the other, and the
-- pairs that may overlap are pushed, or sent to the triangle unit where both are leaves. Two leaves of one block that meet
-- the same inner node are pushed as one pair, so that one expansion tests both. Pairs in flight keep their order, whatever
-- their lanes. Of the survivors of an expansion one in each clock is pushed, and one pair of leaves goes; those that wait do
-- so in two queues, a record for each expansion.
--
-- Rule of issue. Let used be the entries of a stack and flying the pairs of its lane in flight; a pair pushes at most four.
-- It is popped if used - 1 + 4 (flying + 1) <= {{ e.traversal.wide }}, or if nothing of its lane flies; and only if less than {{ e.traversal.in_flight }} pairs of all lanes
-- fly. While only pops of the first kind happen, used <= {{ e.traversal.wide }}. With nothing of its lane in flight an entry of level l leaves
-- at most 3 ({{ e.traversal.levels }} - l) + 1 entries above what lay below it, and entries of level {{ e.traversal.levels }} push nothing:
-- used <= {{ e.traversal.wide }} + 3 x {{ e.traversal.levels }} + 1 = {{ e.traversal.stack }} at all times.
--
-- The oldest query comes first. A younger one pops only what the queue of its leaf pairs has room for, even if each of its
-- pairs in flight sends four: so none waits for that queue in front of the oldest query's. And it pops only while few pairs
-- wait for their blocks, so that those of the oldest do not wait behind many.
--
-- A lane is chosen in one clock and its pair popped in a later one, and what frees room is counted a clock late. How many fly is
-- looked at when it is chosen: an answer in between may make two records of one pair, each of which has its place. Meanwhile
-- used + 4 flying, as queued + 4 flying, is at most 3 more than it was counted, while a record has sent three of its four: so a
-- lane is chosen only if there are 3 places more than the rule asks for. Right behind a pop of its own a lane is chosen only if
-- there is plenty.
--
-- A leaf has no block: its volume is in that of its parent.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_traverse is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- The queries.
    start : in std_logic;  -- one clock long: that of a lane begins with the roots
    start_lane : in std_logic_vector(lane_bits - 1 downto 0);
    most_expansions : in std_logic_vector(31 downto 0);  -- of it; 0: 2^32, after which the count of the report begins again
    oldest : in std_logic_vector(lane_bits - 1 downto 0);
    ending : in std_logic_vector(lanes - 1 downto 0);  -- no pair is popped any more, and what is in flight is dropped
    -- Of the query whose blocks were taken a clock ago.
    block_count_a : in std_logic_vector(31 downto 0);
    block_count_b : in std_logic_vector(31 downto 0);
    triangle_count_a : in std_logic_vector(31 downto 0);
    triangle_count_b : in std_logic_vector(31 downto 0);
    -- Blocks asked for, and blocks that come, in the same order.
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_lane : out std_logic_vector(lane_bits - 1 downto 0);
    request_a : out std_logic_vector(node_bits - 1 downto 0);
    request_b : out std_logic_vector(node_bits - 1 downto 0);
    blocks_taken : in std_logic;  -- the volume unit takes both in this clock
    block_a : in std_logic_vector(block_bits - 1 downto 0);
    block_b : in std_logic_vector(block_bits - 1 downto 0);
    take_lane : out std_logic_vector(lane_bits - 1 downto 0);  -- of the blocks
    take_a : out std_logic_vector(1 downto 0);  -- children to be tested, if there are such
    take_b : out std_logic_vector(1 downto 0);
    survive_valid : in std_logic;
    survive : in std_logic_vector(3 downto 0);  -- bit 2 p + q: child p of A and child q of B may overlap
    -- Pairs of leaves.
    pair_valid : out std_logic;
    pair_ready : in std_logic;
    pair_lane : out std_logic_vector(lane_bits - 1 downto 0);
    pair_left : in std_logic_vector(lanes - 1 downto 0);  -- a pair leaves the queue of its lane
    pair_a : out std_logic_vector(27 downto 0);  -- number of the triangle
    pair_b : out std_logic_vector(27 downto 0);
    -- State and events, each of one clock.
    idle : out std_logic_vector(lanes - 1 downto 0) := (others => '1');  -- a clock ago nothing was in flight, and nothing was to be popped
    waiting : out std_logic;  -- something is in flight
    bad_tree : out std_logic_vector(lanes - 1 downto 0) := (others => '0');
    limit_reached : out std_logic_vector(lanes - 1 downto 0) := (others => '0');
    expanded : out std_logic;
    expanded_lane : out std_logic_vector(lane_bits - 1 downto 0);
    tested : out std_logic_vector(2 downto 0);  -- tests of the expansion: 0, 1, 2 or 4
    tested_lane : out std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
    survived : out std_logic_vector(2 downto 0);  -- so many more
    survived_lane : out std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
    greatest_stack : out unsigned(15 downto 0) := (others => '0')  -- of the oldest query, a clock ago
  );
end entity {{ prefix }}engine_traverse;

architecture rtl of {{ prefix }}engine_traverse is
  constant wide : integer := {{ e.traversal.wide }};  -- of the rule of issue
  constant room_bits : natural := {{ e.traversal.room_bits }};
  constant in_flight : natural := {{ e.traversal.in_flight }};
  constant flight_places : natural := {{ e.traversal.flight_places }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};
  constant everything : std_logic_vector(level_bits - 1 downto 0) := "{{ e.traversal.deepest }}";  -- level {{ e.traversal.levels }}

  constant pairs : integer := {{ e.traversal.pairs }};  -- of the queue of a lane
  constant pair_room_bits : natural := {{ e.traversal.pair_room_bits }};
  constant crowd : natural := {{ e.traversal.crowd }};
  subtype flags is std_logic_vector(lanes - 1 downto 0);
  constant nobody : flags := (others => '0');

  signal is_root : flags := (others => '0');  -- the roots are pushed, and nothing else of the lane
  signal is_pushed : flags := (others => '0');  -- a candidate
  signal starts : flags;
  signal push : flags;
  type lane_entries is array (0 to lanes - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal push_entry : lane_entries;
  signal pop : std_logic;
  signal pops : flags;
  signal may_start : flags := (others => '0');  -- a clock ago it was not chosen, and could be popped
  signal may_follow : flags := (others => '0');  -- a clock ago there was plenty, also for a pop then and the one that is due
  signal may_pop : flags;
  -- The oldest query, a clock later: the next one is oldest only when nothing of the one before it is left.
  signal first_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal is_oldest : flags := (others => '0');
  signal choice : flags;  -- the oldest lane that may
  signal choice_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal chosen : flags := (others => '0');  -- the lane that pops next; none may be
  signal chosen_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal some_chosen : std_logic;
  signal top_entry : lane_entries;
  signal filled : flags;
  signal many : flags;  -- three entries or more
  type stack_counts is array (0 to lanes - 1) of unsigned(15 downto 0);
  signal greatest : stack_counts;
  type lane_rooms is array (0 to lanes - 1) of unsigned(room_bits - 1 downto 0);
  signal room : lane_rooms := (others => (others => '0'));  -- wide - 6 - used - 4 flying in two's complement: not negative while a pair may be popped although others of the lane fly
  signal plenty : flags := (others => '0');  -- it was at least 16 a clock ago
  type pair_rooms is array (0 to lanes - 1) of unsigned(pair_room_bits - 1 downto 0);
  signal pair_room : pair_rooms := (others => (others => '0'));  -- the same of the queue of leaf pairs: pairs - 7 - those in it - 4 flying
  signal pair_plenty : flags := (others => '0');  -- it was at least 32 a clock ago
  type lane_flights is array (0 to lanes - 1) of unsigned(flight_bits + 1 downto 0);
  signal lane_flying : lane_flights := (others => (others => '0'));
  signal nothing_flies : flags := (others => '1');  -- of the lane
  signal flying : unsigned(flight_bits + 1 downto 0) := (others => '0');  -- of all lanes
  signal all_fly : std_logic := '0';  -- flying >= in_flight
  signal nearly_all_fly : std_logic := '0';  -- but for one
  signal without_blocks : unsigned(flight_bits downto 0) := (others => '0');  -- popped and not taken by the volume unit
  signal crowded : std_logic := '0';  -- so many that a younger query waits
  type lane_numbers is array (0 to lanes - 1) of unsigned(31 downto 0);
  signal allowed : lane_numbers := (others => (others => '0'));  -- expansions
  signal last_one : flags := (others => '0');  -- the next expansion is the last
  signal few_left : flags := (others => '0');  -- a clock ago there were less than eight
  signal spent : flags := (others => '0');  -- no expansion more
  -- What a clock has changed, counted in the next one.
  signal pushed : flags := (others => '0');
  signal pushed_all : flags := (others => '0');  -- a record that is pushed is finished
  signal pair_gone : flags := (others => '0');  -- a pair has left the queue of the lane
  signal pair_sent : flags := (others => '0');  -- a pair has gone into it
  signal sent_all : flags := (others => '0');  -- a record of leaves is finished
  signal no_nodes : flags := (others => '0');  -- an answer without a record that is pushed
  signal no_leaves : flags := (others => '0');  -- an answer without a record of leaves
  signal both_records : flags := (others => '0');  -- an answer with both
  -- The same of all lanes, for the records.
  signal one_more : std_logic := '0';
  signal met_nothing : std_logic := '0';
  signal pushed_one : std_logic := '0';
  signal sent_one : std_logic := '0';
  subtype record_change is integer range -3 to 1;
  signal issued : std_logic := '0';  -- a pair that was popped and whose blocks are asked for
  signal issued_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal issued_entry : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal issue_free : std_logic;

  -- Pairs in flight, each in a place of its own: popped, taken by the volume unit, answered by it.
  signal popped_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal taken_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal listed_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal answered_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  type entries is array (0 to flight_places - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal entry_memory : entries := (others => (others => '0'));
  type children is array (0 to flight_places - 1) of std_logic_vector(131 downto 0);
  signal children_memory : children := (others => (others => '0'));
  type lane_list is array (0 to flight_places - 1) of unsigned(lane_bits - 1 downto 0);
  signal lane_memory : lane_list := (others => (others => '0'));

  signal taken_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal taken_lane : unsigned(lane_bits - 1 downto 0);
  signal listed_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal there_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal wanted_a : std_logic_vector(1 downto 0);
  signal wanted_b : std_logic_vector(1 downto 0);
  signal listed_a : std_logic_vector(1 downto 0) := "00";  -- wanted one clock ago
  signal listed_b : std_logic_vector(1 downto 0) := "00";
  signal present_a : std_logic_vector(1 downto 0);
  signal present_b : std_logic_vector(1 downto 0);
  signal there_a : std_logic_vector(1 downto 0) := "00";  -- wanted and present, another clock later
  signal there_b : std_logic_vector(1 downto 0) := "00";
  signal leaf_a : std_logic_vector(1 downto 0);
  signal leaf_b : std_logic_vector(1 downto 0);
  signal fault_a : std_logic_vector(1 downto 0);
  signal fault_b : std_logic_vector(1 downto 0);
  signal left_a : std_logic_vector(27 downto 0);
  signal left_b : std_logic_vector(27 downto 0);
  signal right_a : std_logic_vector(27 downto 0);
  signal right_b : std_logic_vector(27 downto 0);
  signal bad_a : std_logic;
  signal bad_b : std_logic;
  signal listed : std_logic := '0';  -- the children of the blocks taken one clock ago
  signal tests : std_logic_vector(2 downto 0);

  -- Of the four pairs of children of two blocks: which go on, which are pairs of leaves, and which have a wrong link.
  signal listed_deepest : std_logic := '0';
  signal listed_nodes : std_logic_vector(3 downto 0);
  signal listed_leaves : std_logic_vector(3 downto 0);
  signal listed_faults : std_logic_vector(3 downto 0);

  -- An answer of the volume unit, a clock later.
  signal answered_children : std_logic_vector(131 downto 0);
  signal answered_lane : unsigned(lane_bits - 1 downto 0);
  signal met : std_logic := '0';
  signal met_entry : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal met_family : std_logic_vector(119 downto 0) := (others => '0');  -- children of A, of B, the right one first: leaf, fault, number
  signal met_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal met_nodes : std_logic_vector(3 downto 0) := "0000";  -- survivors that are pushed
  signal met_leaves : std_logic_vector(3 downto 0) := "0000";  -- survivors that are pairs of leaves
  signal met_survivors : std_logic_vector(3 downto 0);
  signal wrong : std_logic := '0';  -- one has a wrong link
  signal brings_nodes : std_logic := '0';  -- there are survivors that are pushed, and the query goes on
  signal brings_leaves : std_logic := '0';

  -- Records of survivors that are pushed: the first is opened. Behind it there is room for all pairs in flight.
  constant node_record_bits : natural := entry_bits + 124;
  subtype node_record is std_logic_vector(node_record_bits - 1 downto 0);
  type node_records is array (0 to flight_places - 1) of node_record;
  signal node_memory : node_records := (others => (others => '0'));
  signal node_lanes : lane_list := (others => (others => '0'));
  signal node_written : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal node_read : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal node_count : unsigned(flight_bits downto 0) := (others => '0');
  signal nodes_wait : std_logic;
  signal next_nodes : node_record;
  signal next_leaf : std_logic_vector(3 downto 0);  -- which of its children are leaves
  signal next_node_lane : unsigned(lane_bits - 1 downto 0);
  signal nodes_free : std_logic;

  -- The same of pairs of leaves.
  subtype leaf_record is std_logic_vector(115 downto 0);
  type leaf_records is array (0 to flight_places - 1) of leaf_record;
  signal leaf_memory : leaf_records := (others => (others => '0'));
  signal leaf_lanes : lane_list := (others => (others => '0'));
  signal leaf_written : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal leaf_read : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal leaf_count : unsigned(flight_bits downto 0) := (others => '0');
  signal leaves_wait : std_logic;
  signal next_leaves : leaf_record;
  signal next_leaf_lane : unsigned(lane_bits - 1 downto 0);
  signal leaves_free : std_logic;
  signal leaf_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal leaf_numbers : std_logic_vector(111 downto 0) := (others => '0');
  signal leaves_left : std_logic_vector(3 downto 0) := "0000";
  signal leaf_pick : std_logic_vector(3 downto 0);
  signal some_leaves : std_logic;
  signal leaves_ended : std_logic;
  signal last_leaves : std_logic;
  signal leaves_finished : std_logic;

  -- Survivors that are pushed one by one, from right and right to left and left.
  signal opened : std_logic := '0';  -- there is a record
  signal own_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal own : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal family : std_logic_vector(119 downto 0) := (others => '0');
  signal left_over : std_logic_vector(3 downto 0) := "0000";
  signal pick : std_logic_vector(3 downto 0);
  signal last_pick : std_logic;
  signal joins_a : std_logic_vector(1 downto 0) := "00";  -- bit q: both children of A are leaves, child q of B is none
  signal joins_b : std_logic_vector(1 downto 0) := "00";
  signal joined_a : std_logic;  -- both leaves meet the same inner node, and go as one pair
  signal joined_b : std_logic;
  signal gone : std_logic_vector(3 downto 0);  -- what is picked, and what goes with it
  signal candidate : std_logic := '0';
  signal candidate_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal is_last : std_logic := '0';
  signal child_a : std_logic_vector(29 downto 0) := (others => '0');
  signal child_b : std_logic_vector(29 downto 0) := (others => '0');
  signal side_a : std_logic := '0';  -- the child is the right one
  signal side_b : std_logic := '0';
  signal whole_a : std_logic := '0';  -- both leaves
  signal whole_b : std_logic := '0';
  signal parents : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal next_a : std_logic_vector(node_bits + 1 downto 0);
  signal next_b : std_logic_vector(node_bits + 1 downto 0);
  signal next_level : std_logic_vector(level_bits - 1 downto 0) := (others => '0');
  signal ended : flags := (others => '1');  -- ending, a clock later: near to what reads it, and still set in the clock of start
  signal pair_due : std_logic;
  signal nodes_finished : std_logic;
begin
  -- ===== Issue =====
  each_lane : for lane in 0 to lanes - 1 generate
    signal earlier : flags;  -- lanes of older queries that may pop
    signal lives : std_logic;
  begin
    lives <= not ending(lane) and not ended(lane) and not spent(lane);  -- what the last query has left on the stack goes with start
    starts(lane) <= start when unsigned(start_lane) = lane else '0';
    pops(lane) <= chosen(lane) and not ending(lane) and issue_free;
    may_pop(lane) <= may_start(lane) when chosen(lane) = '0' else may_follow(lane);
    push(lane) <= is_pushed(lane) or is_root(lane);
    push_entry(lane) <= "{{ e.traversal.root_entry }}" when is_root(lane) = '1' else next_a & next_b & next_level;

    by_age : for other in 0 to lanes - 1 generate
      earlier(other) <= may_pop(other) when other - first_lane < lane - first_lane else '0';
    end generate by_age;
    choice(lane) <= may_pop(lane) when earlier = nobody else '0';

    stack : entity work.{{ prefix }}engine_stack
      port map (
        clk => clk,
        clear => starts(lane),
        push => push(lane),
        push_entry => push_entry(lane),
        pop => pops(lane),
        top_entry => top_entry(lane),
        filled => filled(lane),
        many => many(lane),
        greatest => greatest(lane)
      );

    rest : process (clk)
    begin
      if rising_edge(clk) then
        may_start(lane) <= lives and filled(lane) and not chosen(lane) and not all_fly
          and (nothing_flies(lane) or not room(lane)(room_bits - 1)) and (is_oldest(lane) or not (pair_room(lane)(pair_room_bits - 1) or crowded));
        may_follow(lane) <= lives and many(lane) and not few_left(lane) and plenty(lane)
          and (is_oldest(lane) or (pair_plenty(lane) and not crowded));
        is_root(lane) <= starts(lane) and not reset;
        is_pushed(lane) <= '0';
        if own_lane = lane then
          is_pushed(lane) <= opened and not ending(lane) and not reset;
        end if;
        limit_reached(lane) <= filled(lane) and spent(lane) and not ended(lane) and not ending(lane);
        is_oldest(lane) <= '0';
        if unsigned(oldest) = lane then
          is_oldest(lane) <= '1';
        end if;
        idle(lane) <= nothing_flies(lane) and (ending(lane) or not (filled(lane) or ended(lane))) and not is_root(lane);
      end if;
    end process rest;
  end generate each_lane;

  number_lane : for digit in 0 to lane_bits - 1 generate
    signal has_bit : flags;
  begin
    lanes_with_bit : for lane in 0 to lanes - 1 generate
      has_bit(lane) <= choice(lane) when (lane / 2 ** digit) mod 2 = 1 else '0';
    end generate lanes_with_bit;
    choice_lane(digit) <= '0' when has_bit = nobody else '1';
  end generate number_lane;
  some_chosen <= '0' when chosen = nobody else '1';
  issue_free <= request_ready or not issued;
  pop <= '0' when pops = nobody else '1';
  expanded <= pop;
  expanded_lane <= std_logic_vector(chosen_lane);
  request_valid <= issued;
  request_lane <= std_logic_vector(issued_lane);
  request_a <= issued_entry(entry_node_a);
  request_b <= issued_entry(entry_node_b);
  waiting <= '0' when flying = 0 else '1';

  issue : process (clk)
    variable change : integer range -1 to 9;
    variable pair_change : integer range -1 to 9;
    variable records : record_change;  -- that are more than before; a pair in flight counts as one
    variable lane_steady : unsigned(flight_bits + 1 downto 0);  -- pairs in flight and records but for a pop
    variable steady : unsigned(flight_bits + 1 downto 0);
  begin
    if rising_edge(clk) then
      first_lane <= unsigned(oldest);
      greatest_stack <= greatest(to_integer(unsigned(oldest)));
      if issue_free = '1' then
        issued_lane <= chosen_lane;
        issued_entry <= top_entry(to_integer(chosen_lane));
      end if;
      if pop = '1' then
        entry_memory(to_integer(popped_place)) <= top_entry(to_integer(chosen_lane));
        lane_memory(to_integer(popped_place)) <= chosen_lane;
      end if;
      for lane in 0 to lanes - 1 loop
        if starts(lane) = '1' then
          allowed(lane) <= unsigned(most_expansions) - 1;
          last_one(lane) <= '0';
          if unsigned(most_expansions) = 1 then
            last_one(lane) <= '1';
          end if;
          spent(lane) <= '0';
        elsif pops(lane) = '1' then
          allowed(lane) <= allowed(lane) - 1;
          last_one(lane) <= '0';
          if allowed(lane) = 1 then
            last_one(lane) <= '1';
          end if;
          spent(lane) <= last_one(lane);
        end if;
        pushed(lane) <= push(lane);
        pushed_all(lane) <= '0';
        if candidate_lane = lane then
          pushed_all(lane) <= nodes_finished;
        end if;
        pair_gone(lane) <= pair_left(lane);
        pair_sent(lane) <= '0';
        sent_all(lane) <= '0';
        if leaf_lane = lane then
          pair_sent(lane) <= pair_due and pair_ready;
          sent_all(lane) <= leaves_finished;
        end if;
        no_nodes(lane) <= '0';
        no_leaves(lane) <= '0';
        both_records(lane) <= '0';
        if met_lane = lane then
          no_nodes(lane) <= met and not brings_nodes;
          no_leaves(lane) <= met and not brings_leaves;
          both_records(lane) <= met and brings_nodes and brings_leaves;
        end if;
        -- A push takes one place, a record that is finished frees four, and a pop, below, frees one and reserves four. In the
        -- queue of leaf pairs a pop reserves four.
        change := 0;
        pair_change := 0;
        records := 0;
        if pushed(lane) = '1' then
          change := change - 1;
        end if;
        if pushed_all(lane) = '1' then
          change := change + 4;
          records := records - 1;
        end if;
        if no_nodes(lane) = '1' then
          change := change + 4;
        end if;
        if pair_gone(lane) = '1' then
          pair_change := pair_change + 1;
        end if;
        if pair_sent(lane) = '1' then
          pair_change := pair_change - 1;
        end if;
        if sent_all(lane) = '1' then
          pair_change := pair_change + 4;
          records := records - 1;
        end if;
        if no_leaves(lane) = '1' then
          pair_change := pair_change + 4;
        end if;
        if both_records(lane) = '1' then
          records := records + 1;
        elsif (no_nodes(lane) and no_leaves(lane)) = '1' then
          records := records - 1;
        end if;
        few_left(lane) <= '0';
        if allowed(lane)(31 downto 3) = 0 then
          few_left(lane) <= '1';
        end if;
        plenty(lane) <= '0';
        if signed(room(lane)) >= 16 then
          plenty(lane) <= '1';
        end if;
        pair_plenty(lane) <= '0';
        if signed(pair_room(lane)) >= 32 then
          pair_plenty(lane) <= '1';
        end if;
        lane_steady := unsigned(signed(lane_flying(lane)) + records);
        if reset = '1' or starts(lane) = '1' then
          room(lane) <= unsigned(to_signed(wide - 6, room_bits));
          pair_room(lane) <= to_unsigned(pairs - 7, pair_room_bits);
          pushed(lane) <= '0';
          pushed_all(lane) <= '0';
          pair_gone(lane) <= '0';
          pair_sent(lane) <= '0';
          sent_all(lane) <= '0';
          no_nodes(lane) <= '0';
          no_leaves(lane) <= '0';
          both_records(lane) <= '0';
          lane_flying(lane) <= (others => '0');
          nothing_flies(lane) <= '1';
        else
          if pops(lane) = '1' then
            room(lane) <= unsigned(signed(room(lane)) + (change - 3));
            pair_room(lane) <= unsigned(signed(pair_room(lane)) + (pair_change - 4));
          else
            room(lane) <= unsigned(signed(room(lane)) + change);
            pair_room(lane) <= unsigned(signed(pair_room(lane)) + pair_change);
          end if;
          if pops(lane) = '1' then
            lane_flying(lane) <= lane_steady + 1;
            nothing_flies(lane) <= '0';
          else
            lane_flying(lane) <= lane_steady;
            nothing_flies(lane) <= '0';
            if lane_steady = 0 then
              nothing_flies(lane) <= '1';
            end if;
          end if;
        end if;
      end loop;
      records := 0;
      if one_more = '1' then
        records := records + 1;
      end if;
      if met_nothing = '1' then
        records := records - 1;
      end if;
      if pushed_one = '1' then
        records := records - 1;
      end if;
      if sent_one = '1' then
        records := records - 1;
      end if;
      one_more <= brings_nodes and brings_leaves and not reset;
      met_nothing <= met and not brings_nodes and not brings_leaves and not reset;
      pushed_one <= nodes_finished and not reset;
      sent_one <= leaves_finished and not reset;
      steady := unsigned(signed(flying) + records);
      if reset = '1' then
        flying <= (others => '0');
        all_fly <= '0';
        nearly_all_fly <= '0';
        without_blocks <= (others => '0');
        crowded <= '0';
        popped_place <= (others => '0');
        issued <= '0';
        chosen <= nobody;
      else
        if issue_free = '1' then
          issued <= pop;
        end if;
        if (issue_free or not some_chosen) = '1' then
          chosen <= choice;
          chosen_lane <= unsigned(choice_lane);
          -- With the one that is chosen all would fly.
          if all_fly = '1' or (some_chosen and nearly_all_fly) = '1' then
            chosen <= nobody;
          end if;
        else
          chosen <= chosen and not ending;
        end if;
        if pop = '1' then
          popped_place <= popped_place + 1;
        end if;
        all_fly <= '0';
        nearly_all_fly <= '0';
        if pop = '1' then
          flying <= steady + 1;
          if steady >= in_flight - 1 then
            all_fly <= '1';
          end if;
          if steady + 2 >= in_flight then
            nearly_all_fly <= '1';
          end if;
        else
          flying <= steady;
          if steady >= in_flight then
            all_fly <= '1';
          end if;
          if steady + 1 >= in_flight then
            nearly_all_fly <= '1';
          end if;
        end if;
        if pop = '1' and blocks_taken = '0' then
          without_blocks <= without_blocks + 1;
          if without_blocks >= crowd - 1 then
            crowded <= '1';
          end if;
        elsif pop = '0' and blocks_taken = '1' then
          without_blocks <= without_blocks - 1;
          if without_blocks <= crowd then
            crowded <= '0';
          end if;
        end if;
      end if;
    end if;
  end process issue;

  -- ===== Blocks =====
  taken_entry <= entry_memory(to_integer(taken_place));
  taken_lane <= lane_memory(to_integer(taken_place));
  take_lane <= std_logic_vector(taken_lane);
  wanted_a <= taken_entry(entry_children_a);
  wanted_b <= taken_entry(entry_children_b);
  take_a <= wanted_a;
  take_b <= wanted_b;

  children_a : entity work.{{ prefix }}engine_children
    port map (
      clk => clk,
      reset => reset,
      taken => blocks_taken,
      data => block_a,
      own => taken_entry(entry_node_a),
      block_count => block_count_a,
      triangle_count => triangle_count_a,
      present => present_a,
      leaf => leaf_a,
      fault => fault_a,
      left => left_a,
      right => right_a,
      bad => bad_a
    );

  children_b : entity work.{{ prefix }}engine_children
    port map (
      clk => clk,
      reset => reset,
      taken => blocks_taken,
      data => block_b,
      own => taken_entry(entry_node_b),
      block_count => block_count_b,
      triangle_count => triangle_count_b,
      present => present_b,
      leaf => leaf_b,
      fault => fault_b,
      left => left_b,
      right => right_b,
      bad => bad_b
    );

  tests <= "000" when there_a = "00" or there_b = "00" else
    "100" when there_a = "11" and there_b = "11" else
    "010" when there_a = "11" or there_b = "11" else
    "001";

  list : process (clk)
  begin
    if rising_edge(clk) then
      tested <= tests;
      tested_lane <= std_logic_vector(there_lane);
      listed_lane <= taken_lane;
      there_lane <= listed_lane;
      there_a <= "00";
      there_b <= "00";
      listed_a <= wanted_a;
      listed_b <= wanted_b;
      listed_deepest <= '0';
      if taken_entry(entry_level) = everything then
        listed_deepest <= '1';
      end if;
      if listed = '1' then
        there_a <= listed_a and present_a;
        there_b <= listed_b and present_b;
        children_memory(to_integer(listed_place)) <= listed_faults & listed_leaves & listed_nodes
          & leaf_a(1) & fault_a(1) & right_a & leaf_a(0) & fault_a(0) & left_a
          & leaf_b(1) & fault_b(1) & right_b & leaf_b(0) & fault_b(0) & left_b;
      end if;
      if reset = '1' then
        taken_place <= (others => '0');
        listed_place <= (others => '0');
        answered_place <= (others => '0');
        listed <= '0';
      else
        listed <= blocks_taken;
        if blocks_taken = '1' then
          taken_place <= taken_place + 1;
        end if;
        if listed = '1' then
          listed_place <= listed_place + 1;
        end if;
        if survive_valid = '1' then
          answered_place <= answered_place + 1;
        end if;
      end if;
    end if;
  end process list;

  -- ===== Survivors =====
  -- A leaf beside an inner node stays where it is: its number is not used yet.
  kinds : for k in 0 to 3 generate
    constant a : natural := k / 2;
    constant b : natural := k mod 2;
  begin
    listed_nodes(k) <= present_a(a) and present_b(b) and not (leaf_a(a) and leaf_b(b));
    listed_leaves(k) <= present_a(a) and present_b(b) and leaf_a(a) and leaf_b(b);
    listed_faults(k) <= (listed_nodes(k) and ((fault_a(a) and not leaf_a(a)) or (fault_b(b) and not leaf_b(b)) or listed_deepest))
      or (listed_leaves(k) and (fault_a(a) or fault_b(b)));
  end generate kinds;

  answered_children <= children_memory(to_integer(answered_place));
  answered_lane <= lane_memory(to_integer(answered_place));

  meet : process (clk)
  begin
    if rising_edge(clk) then
      ended <= ending;
      brings_nodes <= '0';
      brings_leaves <= '0';
      wrong <= '0';
      if (survive and answered_children(131 downto 128)) /= "0000" then
        wrong <= survive_valid and not reset;
      elsif ending(to_integer(answered_lane)) = '0' then
        if (survive and answered_children(123 downto 120)) /= "0000" then
          brings_nodes <= survive_valid and not reset;
        end if;
        if (survive and answered_children(127 downto 124)) /= "0000" then
          brings_leaves <= survive_valid and not reset;
        end if;
      end if;
      met_entry <= entry_memory(to_integer(answered_place));
      met_family <= answered_children(119 downto 0);
      met_lane <= answered_lane;
      met_nodes <= survive and answered_children(123 downto 120);
      met_leaves <= survive and answered_children(127 downto 124);
      met <= survive_valid and not reset;
    end if;
  end process meet;

  met_survivors <= met_nodes or met_leaves;

  -- A record goes into its queue if it is not the first.
  nodes_wait <= '0' when node_count = 0 else '1';
  nodes_free <= last_pick or not opened;
  next_nodes <= node_memory(to_integer(node_read)) when nodes_wait = '1' else met_nodes & met_family & met_entry;
  next_leaf <= next_nodes(entry_bits + 119) & next_nodes(entry_bits + 89) & next_nodes(entry_bits + 59) & next_nodes(entry_bits + 29);
  next_node_lane <= node_lanes(to_integer(node_read)) when nodes_wait = '1' else met_lane;
  leaves_wait <= '0' when leaf_count = 0 else '1';
  leaves_free <= leaves_finished or not some_leaves;
  next_leaves <= leaf_memory(to_integer(leaf_read)) when leaves_wait = '1' else
    met_leaves & met_family(117 downto 90) & met_family(87 downto 60) & met_family(57 downto 30) & met_family(27 downto 0);
  next_leaf_lane <= leaf_lanes(to_integer(leaf_read)) when leaves_wait = '1' else met_lane;

  queue : process (clk)
    variable nodes_come : boolean;
    variable nodes_go : boolean;
    variable leaves_come : boolean;
    variable leaves_go : boolean;
  begin
    if rising_edge(clk) then
      nodes_come := brings_nodes = '1' and (nodes_wait = '1' or nodes_free = '0');
      nodes_go := nodes_wait = '1' and nodes_free = '1';
      leaves_come := brings_leaves = '1' and (leaves_wait = '1' or leaves_free = '0');
      leaves_go := leaves_wait = '1' and leaves_free = '1';
      if nodes_come then
        node_memory(to_integer(node_written)) <= met_nodes & met_family & met_entry;
        node_lanes(to_integer(node_written)) <= met_lane;
      end if;
      if leaves_come then
        leaf_memory(to_integer(leaf_written)) <=
          met_leaves & met_family(117 downto 90) & met_family(87 downto 60) & met_family(57 downto 30) & met_family(27 downto 0);
        leaf_lanes(to_integer(leaf_written)) <= met_lane;
      end if;
      if reset = '1' then
        node_written <= (others => '0');
        node_read <= (others => '0');
        node_count <= (others => '0');
        leaf_written <= (others => '0');
        leaf_read <= (others => '0');
        leaf_count <= (others => '0');
      else
        if nodes_come then
          node_written <= node_written + 1;
        end if;
        if nodes_go then
          node_read <= node_read + 1;
        end if;
        if nodes_come and not nodes_go then
          node_count <= node_count + 1;
        elsif nodes_go and not nodes_come then
          node_count <= node_count - 1;
        end if;
        if leaves_come then
          leaf_written <= leaf_written + 1;
        end if;
        if leaves_go then
          leaf_read <= leaf_read + 1;
        end if;
        if leaves_come and not leaves_go then
          leaf_count <= leaf_count + 1;
        elsif leaves_go and not leaves_come then
          leaf_count <= leaf_count - 1;
        end if;
      end if;
    end if;
  end process queue;

  pick <= "1000" when left_over(3) = '1' else
    "0100" when left_over(2) = '1' else
    "0010" when left_over(1) = '1' else
    left_over;
  joined_a <= (pick(3) and joins_a(1) and left_over(1)) or (pick(2) and joins_a(0) and left_over(0));
  joined_b <= (pick(3) and joins_b(1) and left_over(2)) or (pick(1) and joins_b(0) and left_over(0));
  gone(3) <= pick(3);
  gone(2) <= pick(2) or (pick(3) and joins_b(1) and left_over(2));
  gone(1) <= pick(1) or (pick(3) and joins_a(1) and left_over(1));
  gone(0) <= pick(0) or (((pick(2) and joins_a(0)) or (pick(1) and joins_b(0))) and left_over(0));
  last_pick <= '1' when left_over = gone else '0';

  choose : process (clk)
  begin
    if rising_edge(clk) then
      survived_lane <= std_logic_vector(met_lane);
      survived <= "000";
      if met = '1' then
        survived <= std_logic_vector(("00" & unsigned(met_survivors(0 downto 0))) + unsigned(met_survivors(1 downto 1))
          + unsigned(met_survivors(2 downto 2)) + unsigned(met_survivors(3 downto 3)));
      end if;
      candidate <= opened and not reset;
      candidate_lane <= own_lane;
      is_last <= last_pick;
      child_a <= family(89 downto 60);
      if (pick(3) or pick(2)) = '1' then
        child_a <= family(119 downto 90);
      end if;
      child_b <= family(29 downto 0);
      if (pick(3) or pick(1)) = '1' then
        child_b <= family(59 downto 30);
      end if;
      side_a <= pick(3) or pick(2);
      side_b <= pick(3) or pick(1);
      whole_a <= joined_a;
      whole_b <= joined_b;
      parents <= own;
      next_level <= std_logic_vector(unsigned(own(entry_level)) + 1);
      if nodes_free = '1' then
        own <= next_nodes(entry_bits - 1 downto 0);
        family <= next_nodes(entry_bits + 119 downto entry_bits);
        joins_a(0) <= next_leaf(3) and next_leaf(2) and not next_leaf(0);
        joins_a(1) <= next_leaf(3) and next_leaf(2) and not next_leaf(1);
        joins_b(0) <= next_leaf(1) and next_leaf(0) and not next_leaf(2);
        joins_b(1) <= next_leaf(1) and next_leaf(0) and not next_leaf(3);
        left_over <= next_nodes(entry_bits + 123 downto entry_bits + 120);
        own_lane <= next_node_lane;
        opened <= nodes_wait or brings_nodes;
      else
        left_over <= left_over and not gone;
      end if;
      if reset = '1' then
        opened <= '0';
      end if;
    end if;
  end process choose;

  nodes_finished <= candidate and is_last;
  find_bad : process (clk)
  begin
    if rising_edge(clk) then
      for lane in 0 to lanes - 1 loop
        bad_tree(lane) <= '0';
        if (wrong = '1' and met_lane = lane) or ((bad_a or bad_b) = '1' and there_lane = lane) then
          bad_tree(lane) <= not reset;
        end if;
      end loop;
    end if;
  end process find_bad;

  -- The number of a block without a fault has no more bits than these.
  next_a <= child_a(node_bits - 1 downto 0) & "11" when child_a(29) = '0' else
    parents(entry_node_a) & "11" when whole_a = '1' else
    parents(entry_node_a) & side_a & not side_a;
  next_b <= child_b(node_bits - 1 downto 0) & "11" when child_b(29) = '0' else
    parents(entry_node_b) & "11" when whole_b = '1' else
    parents(entry_node_b) & side_b & not side_b;

  -- ===== Pairs of leaves =====
  leaf_pick <= "1000" when leaves_left(3) = '1' else
    "0100" when leaves_left(2) = '1' else
    "0010" when leaves_left(1) = '1' else
    leaves_left;
  some_leaves <= '0' when leaves_left = "0000" else '1';
  last_leaves <= '1' when leaves_left = leaf_pick else '0';
  leaves_ended <= ended(to_integer(leaf_lane));
  pair_due <= some_leaves and not leaves_ended;
  leaves_finished <= some_leaves and (leaves_ended or (pair_ready and last_leaves));
  pair_valid <= pair_due;
  pair_lane <= std_logic_vector(leaf_lane);
  pair_a <= leaf_numbers(111 downto 84) when (leaf_pick(3) or leaf_pick(2)) = '1' else leaf_numbers(83 downto 56);
  pair_b <= leaf_numbers(55 downto 28) when (leaf_pick(3) or leaf_pick(1)) = '1' else leaf_numbers(27 downto 0);

  part : process (clk)
  begin
    if rising_edge(clk) then
      if leaves_free = '1' then
        leaf_numbers <= next_leaves(111 downto 0);
        leaf_lane <= next_leaf_lane;
        leaves_left <= "0000";
        if (leaves_wait or brings_leaves) = '1' then
          leaves_left <= next_leaves(115 downto 112);
        end if;
      elsif pair_ready = '1' then
        leaves_left <= leaves_left and not leaf_pick;
      end if;
      if reset = '1' then
        leaves_left <= "0000";
      end if;
    end if;
  end process part;
end architecture rtl;
