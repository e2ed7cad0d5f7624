--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The traversal of two trees, depth first from a stack of pairs of nodes. A pair is popped, its two blocks are fetched,
-- the volume unit tests the children of one against the children of the other, and the pairs that may overlap are
-- pushed, or sent to the triangle unit where both are leaves. Two leaves of one block that meet the same inner node are
-- pushed as one pair, so that one expansion tests both. Pairs in flight keep their order.
--
-- Rule of issue. Let used be the entries of the stack and flying the pairs in flight; a pair pushes at most four.
-- It is popped if used - 1 + 4 (flying + 1) <= {{ e.traversal.wide }}, or if nothing flies; and only if flying < {{ e.traversal.in_flight }}. While only pops
-- of the first kind happen, used <= {{ e.traversal.wide }}. With nothing in flight an entry of level l leaves at most 3 ({{ e.traversal.levels }} - l) + 1
-- entries above what lay below it, and entries of level {{ e.traversal.levels }} push nothing: used <= {{ e.traversal.wide }} + 3 x {{ e.traversal.levels }} + 1 = {{ e.traversal.stack }} at all times.
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
    -- The running query, steady from start to the next.
    start : in std_logic;  -- one clock long: begins with the roots
    ending : in std_logic;  -- no pair is popped any more, and what is in flight is dropped
    most_expansions : in std_logic_vector(31 downto 0);  -- 0: 2^32, after which the count of the report begins again
    block_count_a : in std_logic_vector(31 downto 0);
    block_count_b : in std_logic_vector(31 downto 0);
    triangle_count_a : in std_logic_vector(31 downto 0);
    triangle_count_b : in std_logic_vector(31 downto 0);
    -- Blocks asked for, and blocks that come, in the same order.
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_a : out std_logic_vector(node_bits - 1 downto 0);
    request_b : out std_logic_vector(node_bits - 1 downto 0);
    blocks_taken : in std_logic;  -- the volume unit takes both in this clock
    block_a : in std_logic_vector(block_bits - 1 downto 0);
    block_b : in std_logic_vector(block_bits - 1 downto 0);
    take_a : out std_logic_vector(1 downto 0);  -- children to be tested, if there are such
    take_b : out std_logic_vector(1 downto 0);
    survive_valid : in std_logic;
    survive : in std_logic_vector(3 downto 0);  -- bit 2 p + q: child p of A and child q of B may overlap
    -- Pairs of leaves.
    pair_valid : out std_logic;
    pair_ready : in std_logic;
    pair_a : out std_logic_vector(27 downto 0);  -- number of the triangle
    pair_b : out std_logic_vector(27 downto 0);
    -- State and events, each of one clock.
    idle : out std_logic;  -- nothing is in flight, and nothing is to be popped
    waiting : out std_logic;  -- something is in flight
    bad_tree : out std_logic;
    limit_reached : out std_logic;
    expanded : out std_logic;
    tested : out std_logic_vector(2 downto 0);  -- tests of the expansion: 0, 1, 2 or 4
    survived : out std_logic_vector(1 downto 0);  -- so many more
    greatest_stack : out unsigned(15 downto 0)
  );
end entity {{ prefix }}engine_traverse;

architecture rtl of {{ prefix }}engine_traverse is
  constant wide : integer := {{ e.traversal.wide }};  -- of the rule of issue
  constant room_bits : natural := {{ e.traversal.room_bits }};
  constant in_flight : natural := {{ e.traversal.in_flight }};
  constant flight_places : natural := {{ e.traversal.flight_places }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};
  constant everything : std_logic_vector(level_bits - 1 downto 0) := "{{ e.traversal.deepest }}";  -- level {{ e.traversal.levels }}

  signal root_due : std_logic := '0';
  signal push : std_logic;
  signal push_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal pop : std_logic;
  signal may_pop : std_logic;
  signal top_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal filled : std_logic;
  signal room : unsigned(room_bits - 1 downto 0) := (others => '0');  -- wide - 3 - used - 4 flying in two's complement: not negative while a pair may be popped although others fly
  signal flying : unsigned(flight_bits downto 0) := (others => '0');
  signal nothing_flies : std_logic := '1';  -- flying = 0
  signal all_fly : std_logic := '0';  -- flying = in_flight
  signal allowed : unsigned(31 downto 0) := (others => '0');  -- expansions
  signal spent : std_logic := '0';  -- no expansion more

  -- Pairs in flight, each in a place of its own: popped, taken by the volume unit, answered by it, finished.
  signal popped_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal taken_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal listed_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal answered_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal finished_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal answers : unsigned(flight_bits downto 0) := (others => '0');  -- pairs answered and not opened
  signal answered : std_logic;
  type entries is array (0 to flight_places - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal entry_memory : entries := (others => (others => '0'));
  type children is array (0 to flight_places - 1) of std_logic_vector(123 downto 0);
  signal children_memory : children := (others => (others => '0'));
  type survivals is array (0 to flight_places - 1) of std_logic_vector(3 downto 0);
  signal survive_memory : survivals := (others => "0000");

  signal taken_entry : std_logic_vector(entry_bits - 1 downto 0);
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

  -- Survivors one by one, from right and right to left and left.
  signal opened : std_logic := '0';  -- there is a pair whose survivors are taken
  signal opens : std_logic;
  signal opened_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal opened_children : std_logic_vector(123 downto 0);
  signal own_is_deepest : std_logic := '0';
  signal present_pairs : std_logic_vector(3 downto 0);
  signal own : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal family : std_logic_vector(119 downto 0) := (others => '0');
  signal left_over : std_logic_vector(3 downto 0) := "0000";
  signal pick : std_logic_vector(3 downto 0);
  signal last_pick : std_logic;
  signal joins_a : std_logic_vector(1 downto 0) := "00";  -- bit q: both children of A are leaves, child q of B is none
  signal joins_b : std_logic_vector(1 downto 0) := "00";
  signal joined_a : std_logic;  -- both leaves meet the same inner node, and go as one pair
  signal joined_b : std_logic;
  signal chosen : std_logic_vector(3 downto 0);  -- what is picked, and what goes with it
  signal chosen_a : std_logic_vector(29 downto 0);  -- leaf, fault, number
  signal chosen_b : std_logic_vector(29 downto 0);
  signal candidate : std_logic := '0';
  signal candidate_free : std_logic;
  signal candidate_leaves : std_logic;
  signal is_survivor : std_logic := '0';  -- a pair without survivors goes this way once, too
  signal is_last : std_logic := '0';
  signal child_a : std_logic_vector(29 downto 0) := (others => '0');
  signal child_b : std_logic_vector(29 downto 0) := (others => '0');
  signal side_a : std_logic := '0';  -- the child is the right one
  signal side_b : std_logic := '0';
  signal whole_a : std_logic := '0';  -- both leaves
  signal whole_b : std_logic := '0';
  signal parents : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal both_leaves : std_logic;
  signal wrong : std_logic;
  signal is_pair : std_logic := '0';  -- what becomes of the survivor
  signal is_entry : std_logic := '0';
  signal is_wrong : std_logic := '0';
  signal next_a : std_logic_vector(node_bits + 1 downto 0);
  signal next_b : std_logic_vector(node_bits + 1 downto 0);
  signal next_level : std_logic_vector(level_bits - 1 downto 0) := (others => '0');
  signal ended : std_logic := '1';  -- ending, a clock later: near to what reads it
  signal pair_due : std_logic;
  signal push_due : std_logic;
  signal finished : std_logic;
begin
  -- ===== Issue =====
  -- What the last query has left on the stack goes with start.
  may_pop <= filled and not start and not ending and not all_fly and not spent and (nothing_flies or not room(room'high));
  request_valid <= may_pop;
  pop <= may_pop and request_ready;
  request_a <= top_entry(entry_node_a);
  request_b <= top_entry(entry_node_b);
  limit_reached <= filled and spent and not start and not ending;
  expanded <= pop;
  idle <= nothing_flies and (ending or not filled) and not start and not root_due;
  waiting <= not nothing_flies;

  stack : entity work.{{ prefix }}engine_stack
    port map (
      clk => clk,
      clear => start,
      push => push,
      push_entry => push_entry,
      pop => pop,
      top_entry => top_entry,
      filled => filled,
      greatest => greatest_stack
    );

  issue : process (clk)
    variable change : integer range -1 to 4;
  begin
    if rising_edge(clk) then
      if start = '1' then
        allowed <= unsigned(most_expansions) - 1;
        spent <= '0';
      elsif pop = '1' then
        allowed <= allowed - 1;
        if allowed = 0 then
          spent <= '1';
        end if;
      end if;
      -- A push takes one place, a pair that is finished frees four, and a pop, below, frees one and reserves four.
      change := 0;
      if push = '1' then
        change := change - 1;
      end if;
      if finished = '1' then
        change := change + 4;
      end if;
      root_due <= start;
      if reset = '1' or start = '1' then
        room <= unsigned(to_signed(wide - 3, room_bits));
        flying <= (others => '0');
        nothing_flies <= '1';
        all_fly <= '0';
        popped_place <= (others => '0');
        root_due <= start and not reset;
      else
        -- Whether a pair is popped is known late in a clock: it only chooses.
        if pop = '1' then
          room <= unsigned(signed(room) + (change - 3));
        else
          room <= unsigned(signed(room) + change);
        end if;
        if pop = '1' and finished = '0' then
          flying <= flying + 1;
          nothing_flies <= '0';
          if flying = in_flight - 1 then
            all_fly <= '1';
          end if;
        elsif pop = '0' and finished = '1' then
          flying <= flying - 1;
          all_fly <= '0';
          if flying = 1 then
            nothing_flies <= '1';
          end if;
        end if;
        if pop = '1' then
          popped_place <= popped_place + 1;
        end if;
      end if;
      if pop = '1' then
        entry_memory(to_integer(popped_place)) <= top_entry;
      end if;
    end if;
  end process issue;

  -- ===== Blocks =====
  taken_entry <= entry_memory(to_integer(taken_place));
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
      there_a <= "00";
      there_b <= "00";
      listed_a <= wanted_a;
      listed_b <= wanted_b;
      if listed = '1' then
        there_a <= listed_a and present_a;
        there_b <= listed_b and present_b;
        children_memory(to_integer(listed_place)) <= present_a & present_b
          & leaf_a(1) & fault_a(1) & right_a & leaf_a(0) & fault_a(0) & left_a
          & leaf_b(1) & fault_b(1) & right_b & leaf_b(0) & fault_b(0) & left_b;
      end if;
      if survive_valid = '1' then
        survive_memory(to_integer(answered_place)) <= survive;
      end if;
      if reset = '1' or start = '1' then
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
  answered <= '1' when answers /= 0 else '0';
  -- The oldest answered pair is opened when the one before it has no more survivors.
  opens <= answered and ((candidate_free and last_pick) or not opened);
  opened_entry <= entry_memory(to_integer(finished_place));
  opened_children <= children_memory(to_integer(finished_place));
  present_pairs <= (opened_children(123) and opened_children(121)) & (opened_children(123) and opened_children(120))
    & (opened_children(122) and opened_children(121)) & (opened_children(122) and opened_children(120));
  pick <= "1000" when left_over(3) = '1' else
    "0100" when left_over(2) = '1' else
    "0010" when left_over(1) = '1' else
    left_over;
  joined_a <= (pick(3) and joins_a(1) and left_over(1)) or (pick(2) and joins_a(0) and left_over(0));
  joined_b <= (pick(3) and joins_b(1) and left_over(2)) or (pick(1) and joins_b(0) and left_over(0));
  chosen(3) <= pick(3);
  chosen(2) <= pick(2) or (pick(3) and joins_b(1) and left_over(2));
  chosen(1) <= pick(1) or (pick(3) and joins_a(1) and left_over(1));
  chosen(0) <= pick(0) or (((pick(2) and joins_a(0)) or (pick(1) and joins_b(0))) and left_over(0));
  last_pick <= '1' when left_over = chosen else '0';
  chosen_a <= family(119 downto 90) when (pick(3) or pick(2)) = '1' else family(89 downto 60);
  chosen_b <= family(59 downto 30) when (pick(3) or pick(1)) = '1' else family(29 downto 0);
  candidate_free <= candidate_leaves or not candidate;
  both_leaves <= chosen_a(29) and chosen_b(29);
  -- A leaf beside an inner node stays where it is: its number is not used yet.
  wrong <= (chosen_a(28) and (both_leaves or not chosen_a(29))) or (chosen_b(28) and (both_leaves or not chosen_b(29)))
    or (own_is_deepest and not both_leaves);

  choose : process (clk)
  begin
    if rising_edge(clk) then
      ended <= ending;
      survived(0) <= candidate_leaves and is_survivor and not (whole_a or whole_b);
      survived(1) <= candidate_leaves and is_survivor and (whole_a or whole_b);
      if candidate_free = '1' then
        is_survivor <= pick(3) or pick(2) or pick(1) or pick(0);
        is_last <= last_pick;
        child_a <= chosen_a;
        child_b <= chosen_b;
        side_a <= pick(3) or pick(2);
        side_b <= pick(3) or pick(1);
        whole_a <= joined_a;
        whole_b <= joined_b;
        parents <= own;
        is_pair <= both_leaves and not wrong;
        is_entry <= not both_leaves and not wrong;
        is_wrong <= wrong;
        next_level <= std_logic_vector(unsigned(own(entry_level)) + 1);
      end if;
      if opens = '1' then
        own <= opened_entry;
        own_is_deepest <= '0';
        if opened_entry(entry_level) = everything then
          own_is_deepest <= '1';
        end if;
        family <= opened_children(119 downto 0);
        joins_a(0) <= opened_children(119) and opened_children(89) and not opened_children(29);
        joins_a(1) <= opened_children(119) and opened_children(89) and not opened_children(59);
        joins_b(0) <= opened_children(59) and opened_children(29) and not opened_children(89);
        joins_b(1) <= opened_children(59) and opened_children(29) and not opened_children(119);
        left_over <= survive_memory(to_integer(finished_place)) and present_pairs;
      elsif candidate_free = '1' then
        left_over <= left_over and not chosen;
      end if;
      if reset = '1' or start = '1' then
        answers <= (others => '0');
        finished_place <= (others => '0');
        opened <= '0';
        candidate <= '0';
      else
        if candidate_free = '1' then
          candidate <= opened;
        end if;
        if opens = '1' then
          opened <= '1';
          finished_place <= finished_place + 1;
        elsif candidate_free = '1' and last_pick = '1' then
          opened <= '0';
        end if;
        if survive_valid = '1' and opens = '0' then
          answers <= answers + 1;
        elsif survive_valid = '0' and opens = '1' then
          answers <= answers - 1;
        end if;
      end if;
    end if;
  end process choose;

  pair_due <= candidate and is_survivor and is_pair and not ended;
  push_due <= candidate and is_survivor and is_entry and not ended;
  candidate_leaves <= candidate and (pair_ready or not pair_due);
  finished <= candidate_leaves and is_last;
  bad_tree <= (candidate and is_survivor and is_wrong) or bad_a or bad_b;
  pair_valid <= pair_due;
  pair_a <= child_a(27 downto 0);
  pair_b <= child_b(27 downto 0);

  -- The number of a block without a fault has no more bits than these.
  next_a <= child_a(node_bits - 1 downto 0) & "11" when child_a(29) = '0' else
    parents(entry_node_a) & "11" when whole_a = '1' else
    parents(entry_node_a) & side_a & not side_a;
  next_b <= child_b(node_bits - 1 downto 0) & "11" when child_b(29) = '0' else
    parents(entry_node_b) & "11" when whole_b = '1' else
    parents(entry_node_b) & side_b & not side_b;
  push <= root_due or push_due;
  push_entry <= "{{ e.traversal.root_entry }}" when root_due = '1' else next_a & next_b & next_level;
end architecture rtl;
