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
-- It is popped if used - 1 + 4 (flying + 1) <= {{ e.wide }}, or if nothing flies; and only if flying < {{ e.in_flight }}. While only pops
-- of the first kind happen, used <= {{ e.wide }}. With nothing in flight an entry of level l leaves at most 3 ({{ e.levels }} - l) + 1
-- entries above what lay below it, and entries of level {{ e.levels }} push nothing: used <= {{ e.wide }} + 3 x {{ e.levels }} + 1 = {{ e.stack }} at all times.
--
-- An entry of the stack, from the low bits: level ({{ e.level_bits }}), children of B's block ({{ "2" }}), number of B's block ({{ e.node_bits }}), the same of A.
-- Children are 11 (both), 01 (left) or 10 (right): a leaf has no block, its volume is in that of its parent.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}engine_traverse is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- The running query, steady from start to the next.
    start : in std_logic;  -- one clock long: begins with the roots
    ending : in std_logic;  -- no pair is popped any more, and what is in flight is dropped
    most_expansions : in std_logic_vector(31 downto 0);  -- 0: 2^32 - 1
    block_count_a : in std_logic_vector(31 downto 0);
    block_count_b : in std_logic_vector(31 downto 0);
    triangle_count_a : in std_logic_vector(31 downto 0);
    triangle_count_b : in std_logic_vector(31 downto 0);
    -- Blocks asked for, and blocks that come, in the same order.
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_a : out std_logic_vector({{ e.node_bits - 1 }} downto 0);
    request_b : out std_logic_vector({{ e.node_bits - 1 }} downto 0);
    blocks_taken : in std_logic;  -- the volume unit takes both in this clock
    block_a : in std_logic_vector({{ e.block_bits - 1 }} downto 0);
    block_b : in std_logic_vector({{ e.block_bits - 1 }} downto 0);
    take_a : out std_logic_vector(1 downto 0);  -- children to be tested
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
  constant everything : std_logic_vector({{ e.level_bits - 1 }} downto 0) := "{{ e.deepest }}";  -- level {{ e.levels }}

  signal root_due : std_logic := '0';
  signal push : std_logic;
  signal push_entry : std_logic_vector({{ e.entry_bits - 1 }} downto 0);
  signal pop : std_logic;
  signal may_pop : std_logic;
  signal top_entry : std_logic_vector({{ e.entry_bits - 1 }} downto 0);
  signal filled : std_logic;
  signal room : unsigned({{ e.room_bits - 1 }} downto 0) := (others => '0');  -- {{ e.wide - 3 }} - used - 4 flying in two's complement: not negative while a pair may be popped
  signal flying : unsigned({{ e.flight_bits }} downto 0) := (others => '0');
  signal nothing_flies : std_logic;
  signal all_fly : std_logic;
  signal allowed : unsigned(31 downto 0) := (others => '0');  -- expansions
  signal spent : std_logic := '0';  -- allowed = 0

  -- Pairs in flight, each in a place of its own: popped, taken by the volume unit, answered by it, finished.
  signal popped_place : unsigned({{ e.flight_bits - 1 }} downto 0) := (others => '0');
  signal taken_place : unsigned({{ e.flight_bits - 1 }} downto 0) := (others => '0');
  signal listed_place : unsigned({{ e.flight_bits - 1 }} downto 0) := (others => '0');
  signal answered_place : unsigned({{ e.flight_bits - 1 }} downto 0) := (others => '0');
  signal finished_place : unsigned({{ e.flight_bits - 1 }} downto 0) := (others => '0');
  signal answers : unsigned({{ e.flight_bits }} downto 0) := (others => '0');  -- pairs answered and not finished
  signal answered : std_logic;
  type entries is array (0 to {{ e.flight_places - 1 }}) of std_logic_vector({{ e.entry_bits - 1 }} downto 0);
  signal entry_memory : entries := (others => (others => '0'));
  type children is array (0 to {{ e.flight_places - 1 }}) of std_logic_vector(119 downto 0);
  signal children_memory : children := (others => (others => '0'));
  type survivals is array (0 to {{ e.flight_places - 1 }}) of std_logic_vector(3 downto 0);
  signal survive_memory : survivals := (others => "0000");

  signal taken_entry : std_logic_vector({{ e.entry_bits - 1 }} downto 0);
  signal take_a_now : std_logic_vector(1 downto 0);
  signal take_b_now : std_logic_vector(1 downto 0);
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
  signal own : std_logic_vector({{ e.entry_bits - 1 }} downto 0);
  signal family : std_logic_vector(119 downto 0);
  signal done : std_logic_vector(3 downto 0) := "0000";
  signal left_over : std_logic_vector(3 downto 0);
  signal pick : std_logic_vector(3 downto 0);
  signal last_pick : std_logic;
  signal leaves_a : std_logic;  -- both children are leaves
  signal leaves_b : std_logic;
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
  signal is_deepest : std_logic := '0';
  signal child_a : std_logic_vector(29 downto 0) := (others => '0');
  signal child_b : std_logic_vector(29 downto 0) := (others => '0');
  signal side_a : std_logic := '0';  -- the child is the right one
  signal side_b : std_logic := '0';
  signal whole_a : std_logic := '0';  -- both leaves
  signal whole_b : std_logic := '0';
  signal parents : std_logic_vector({{ e.entry_bits - 1 }} downto 0) := (others => '0');
  signal both_leaves : std_logic;
  signal wrong : std_logic;
  signal next_a : std_logic_vector({{ e.node_bits + 1 }} downto 0);
  signal next_b : std_logic_vector({{ e.node_bits + 1 }} downto 0);
  signal next_level : std_logic_vector({{ e.level_bits - 1 }} downto 0) := (others => '0');
  signal pair_due : std_logic;
  signal push_due : std_logic;
  signal finished : std_logic;
begin
  -- ===== Issue =====
  nothing_flies <= '1' when flying = 0 else '0';
  all_fly <= '1' when flying = {{ e.in_flight }} else '0';
  -- What the last query has left on the stack goes with start.
  may_pop <= filled and not start and not ending and not all_fly and not spent and (nothing_flies or not room(room'high));
  request_valid <= may_pop;
  pop <= may_pop and request_ready;
  request_a <= top_entry({{ e.a_high }} downto {{ e.a_low }});
  request_b <= top_entry({{ e.b_high }} downto {{ e.b_low }});
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
    variable change : integer range -4 to 4;
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
      -- A push takes one place, a pop frees one and reserves four, a pair that is finished frees four.
      change := 0;
      if push = '1' then
        change := change - 1;
      end if;
      if pop = '1' then
        change := change - 3;
      end if;
      if finished = '1' then
        change := change + 4;
      end if;
      root_due <= start;
      if reset = '1' or start = '1' then
        room <= unsigned(to_signed({{ e.wide - 3 }}, {{ e.room_bits }}));
        flying <= (others => '0');
        popped_place <= (others => '0');
        root_due <= start and not reset;
      else
        room <= unsigned(signed(room) + change);
        if pop = '1' and finished = '0' then
          flying <= flying + 1;
        elsif pop = '0' and finished = '1' then
          flying <= flying - 1;
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
  take_a <= take_a_now;
  take_b <= take_b_now;

  children_a : entity work.{{ prefix }}engine_children
    port map (
      clk => clk,
      reset => reset,
      taken => blocks_taken,
      data => block_a,
      own => taken_entry({{ e.a_high }} downto {{ e.a_low }}),
      wanted => taken_entry({{ e.a_low - 1 }} downto {{ e.a_low - 2 }}),
      block_count => block_count_a,
      triangle_count => triangle_count_a,
      take => take_a_now,
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
      own => taken_entry({{ e.b_high }} downto {{ e.b_low }}),
      wanted => taken_entry({{ e.b_low - 1 }} downto {{ e.b_low - 2 }}),
      block_count => block_count_b,
      triangle_count => triangle_count_b,
      take => take_b_now,
      leaf => leaf_b,
      fault => fault_b,
      left => left_b,
      right => right_b,
      bad => bad_b
    );

  tests <= "000" when take_a_now = "00" or take_b_now = "00" else
    "100" when take_a_now = "11" and take_b_now = "11" else
    "010" when take_a_now = "11" or take_b_now = "11" else
    "001";

  list : process (clk)
  begin
    if rising_edge(clk) then
      tested <= "000";
      if blocks_taken = '1' then
        tested <= tests;
      end if;
      if listed = '1' then
        children_memory(to_integer(listed_place)) <= leaf_a(1) & fault_a(1) & right_a & leaf_a(0) & fault_a(0) & left_a
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
  own <= entry_memory(to_integer(finished_place));
  family <= children_memory(to_integer(finished_place));
  left_over <= survive_memory(to_integer(finished_place)) and not done;
  pick <= "1000" when left_over(3) = '1' else
    "0100" when left_over(2) = '1' else
    "0010" when left_over(1) = '1' else
    left_over;
  leaves_a <= family(119) and family(89);
  leaves_b <= family(59) and family(29);
  joined_a <= leaves_a and not chosen_b(29) and ((pick(3) and left_over(1)) or (pick(2) and left_over(0)));
  joined_b <= leaves_b and not chosen_a(29) and ((pick(3) and left_over(2)) or (pick(1) and left_over(0)));
  chosen(3) <= pick(3);
  chosen(2) <= pick(2) or (pick(3) and joined_b);
  chosen(1) <= pick(1) or (pick(3) and joined_a);
  chosen(0) <= pick(0) or ((pick(2) or pick(1)) and (joined_a or joined_b));
  last_pick <= '1' when left_over = chosen else '0';
  chosen_a <= family(119 downto 90) when (pick(3) or pick(2)) = '1' else family(89 downto 60);
  chosen_b <= family(59 downto 30) when (pick(3) or pick(1)) = '1' else family(29 downto 0);
  candidate_free <= candidate_leaves or not candidate;

  choose : process (clk)
  begin
    if rising_edge(clk) then
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
        is_deepest <= '0';
        if own({{ e.level_bits - 1 }} downto 0) = everything then
          is_deepest <= '1';
        end if;
        next_level <= std_logic_vector(unsigned(own({{ e.level_bits - 1 }} downto 0)) + 1);
      end if;
      if reset = '1' or start = '1' then
        answers <= (others => '0');
        finished_place <= (others => '0');
        done <= "0000";
        candidate <= '0';
      else
        if candidate_free = '1' then
          candidate <= answered;
          if answered = '1' then
            done <= done or chosen;
            if last_pick = '1' then
              done <= "0000";
              finished_place <= finished_place + 1;
            end if;
          end if;
        end if;
        if survive_valid = '1' and (candidate_free and answered and last_pick) = '0' then
          answers <= answers + 1;
        elsif survive_valid = '0' and (candidate_free and answered and last_pick) = '1' then
          answers <= answers - 1;
        end if;
      end if;
    end if;
  end process choose;

  both_leaves <= child_a(29) and child_b(29);
  -- A leaf beside an inner node stays where it is: its number is not used yet.
  wrong <= (child_a(28) and (both_leaves or not child_a(29))) or (child_b(28) and (both_leaves or not child_b(29)))
    or (is_deepest and not both_leaves);
  pair_due <= candidate and is_survivor and both_leaves and not wrong and not ending;
  push_due <= candidate and is_survivor and not both_leaves and not wrong and not ending;
  candidate_leaves <= candidate and (pair_ready or not pair_due);
  finished <= candidate_leaves and is_last;
  bad_tree <= (candidate and is_survivor and wrong) or bad_a or bad_b;
  survived(0) <= candidate_leaves and is_survivor and not (whole_a or whole_b);
  survived(1) <= candidate_leaves and is_survivor and (whole_a or whole_b);
  pair_valid <= pair_due;
  pair_a <= child_a(27 downto 0);
  pair_b <= child_b(27 downto 0);

  next_a <= child_a({{ e.node_bits - 1 }} downto 0) & "11" when child_a(29) = '0' else
    parents({{ e.a_high }} downto {{ e.a_low }}) & "11" when whole_a = '1' else
    parents({{ e.a_high }} downto {{ e.a_low }}) & side_a & not side_a;
  next_b <= child_b({{ e.node_bits - 1 }} downto 0) & "11" when child_b(29) = '0' else
    parents({{ e.b_high }} downto {{ e.b_low }}) & "11" when whole_b = '1' else
    parents({{ e.b_high }} downto {{ e.b_low }}) & side_b & not side_b;
  push <= root_due or push_due;
  push_entry <= "{{ e.root_entry }}" when root_due = '1' else next_a & next_b & next_level;
end architecture rtl;
