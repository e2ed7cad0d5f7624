--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Which pair of nodes is opened next: of the lanes that may pop that of the oldest query, if less than {{ e.traversal.in_flight }} pairs of all lanes fly. Its two
-- blocks are asked for.
--
-- A lane is chosen in one clock and its pair popped in a later one, and counted as flying in the one behind that. How many fly is looked
-- at when a lane is chosen: an answer in between may make two records of one pair, each of which has its place.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_issue is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- The queries.
    start : in std_logic;  -- one clock long: that of a lane begins with the roots
    start_lane : in std_logic_vector(lane_bits - 1 downto 0);
    most_expansions : in std_logic_vector(31 downto 0);  -- of it; 0: 2^32, after which the count of the report begins again
    oldest : in std_logic_vector(lane_bits - 1 downto 0);
    ending : in lane_flags;  -- from the next clock on none is chosen any more
    ended : in lane_flags;  -- the same, a clock later: none is popped
    -- A pair that is popped, and its blocks, which are asked for a clock later.
    popped : out std_logic;
    popped_lane : out unsigned(lane_bits - 1 downto 0);
    popped_entry : out std_logic_vector(entry_bits - 1 downto 0);
    expanded : out std_logic;  -- a pair was popped a clock ago
    expanded_lane : out std_logic_vector(lane_bits - 1 downto 0);
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_lane : out std_logic_vector(lane_bits - 1 downto 0);
    request_a : out std_logic_vector(node_bits - 1 downto 0);
    request_b : out std_logic_vector(node_bits - 1 downto 0);
    blocks_taken : in std_logic;  -- the volume unit takes both in this clock
    -- Its answer, and the records of survivors that it brings.
    met : in std_logic;
    met_lane : in unsigned(lane_bits - 1 downto 0);
    brings_nodes : in std_logic;
    brings_leaves : in std_logic;
    -- A survivor that is pushed: its lane is known a clock before its entry.
    pushes : in std_logic;
    pushes_lane : in unsigned(lane_bits - 1 downto 0);
    next_entry : in std_logic_vector(entry_bits - 1 downto 0);
    nodes_finished : in std_logic;  -- it was the last of its record
    finished_lane : in unsigned(lane_bits - 1 downto 0);
    -- Pairs of leaves.
    sends_pair : in std_logic;  -- one goes into the queue of its lane
    leaves_finished : in std_logic;  -- a record is finished
    leaf_lane : in std_logic_vector(lane_bits - 1 downto 0);
    pair_left : in lane_flags;  -- a clock ago a pair left the queue of its lane
    -- State and events, each of one clock.
    idle : out lane_flags;  -- a clock ago nothing was in flight, and nothing was to be popped
    waiting : out std_logic;  -- something is in flight
    limit_reached : out lane_flags;
    greatest_stack : out unsigned(15 downto 0) := (others => '0')  -- of the oldest query, a clock ago
  );
end entity {{ prefix }}engine_issue;

architecture rtl of {{ prefix }}engine_issue is
  constant in_flight : natural := {{ e.traversal.in_flight }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};
  constant crowd : natural := {{ e.traversal.crowd }};
  constant nobody : lane_flags := (others => '0');

  signal starts : lane_flags;
  signal more_expansions : unsigned(31 downto 0);  -- behind the first
  signal only_one : std_logic;
  type lane_entries is array (0 to lanes - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal pop : std_logic;
  signal lives : lane_flags;  -- chosen, and not ended
  signal pops : lane_flags;
  signal may_pop : lane_flags;
  -- The oldest query, a clock later: the next one is oldest only when nothing of the one before it is left.
  signal first_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal choice : lane_flags;  -- the oldest lane that may
  signal choice_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal chosen : lane_flags := (others => '0');  -- the lane that pops next; none may be
  signal chosen_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal some_chosen : std_logic;
  signal chosen_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal top_entry : lane_entries;
  type stack_counts is array (0 to lanes - 1) of unsigned(15 downto 0);
  signal greatest : stack_counts;
  signal flying : unsigned(flight_bits + 1 downto 0) := (others => '0');  -- of all lanes
  signal all_fly : std_logic := '0';  -- flying >= in_flight
  signal all_but_one_fly : std_logic := '0';
{% if !e.traversal.paced %}  signal all_but_two_fly : std_logic := '0';
{% endif %}  signal popped_one : std_logic := '0';  -- a clock ago: flying does not have it yet
  signal without_blocks : unsigned(flight_bits downto 0) := (others => '0');  -- popped and not taken by the volume unit; both are counted a clock later
  signal took_blocks : std_logic := '0';
  signal crowded : std_logic := '0';  -- so many that a younger query waits
  -- So many records of all lanes more than a clock before, a pair in flight as one; counted a clock later.
  signal records : signed(2 downto 0) := "000";
  signal issued : std_logic := '0';  -- a pair that was popped and whose blocks are asked for
  signal issued_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal issued_entry : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal issue_free : std_logic;
begin
  more_expansions <= unsigned(most_expansions) - 1;
  only_one <= '1' when unsigned(most_expansions) = 1 else '0';

  each_lane : for lane in 0 to lanes - 1 generate
    signal earlier : lane_flags;  -- lanes of older queries that may pop
    signal oldest_here : std_logic;
    -- Events of this lane.
    signal met_here : std_logic;
    signal pushed_here : std_logic;
    signal finished_here : std_logic;
    signal sent_here : std_logic;
    signal leaves_here : std_logic;
  begin
    starts(lane) <= start when unsigned(start_lane) = lane else '0';
    oldest_here <= '1' when unsigned(oldest) = lane else '0';
    met_here <= met when met_lane = lane else '0';
    pushed_here <= pushes when pushes_lane = lane else '0';
    finished_here <= nodes_finished when finished_lane = lane else '0';
    sent_here <= sends_pair when unsigned(leaf_lane) = lane else '0';
    leaves_here <= leaves_finished when unsigned(leaf_lane) = lane else '0';
    pops(lane) <= lives(lane) and issue_free;

    by_age : for other in 0 to lanes - 1 generate
      earlier(other) <= may_pop(other) when other - first_lane < lane - first_lane else '0';
    end generate by_age;
    choice(lane) <= may_pop(lane) when earlier = nobody else '0';

    query : entity work.{{ prefix }}engine_lane
      port map (
        clk => clk,
        reset => reset,
        start => starts(lane),
        more_expansions => more_expansions,
        only_one => only_one,
        oldest => oldest_here,
        ending => ending(lane),
        ended => ended(lane),
        all_fly => all_fly,
        crowded => crowded,
        may_pop => may_pop(lane),
        chosen => chosen(lane),
        pop => pops(lane),
        top_entry => top_entry(lane),
        met => met_here,
        brings_nodes => brings_nodes,
        brings_leaves => brings_leaves,
        pushes => pushed_here,
        next_entry => next_entry,
        nodes_finished => finished_here,
        sends_pair => sent_here,
        leaves_finished => leaves_here,
        pair_left => pair_left(lane),
        idle => idle(lane),
        limit_reached => limit_reached(lane),
        greatest => greatest(lane)
      );
  end generate each_lane;

  number_lane : for digit in 0 to lane_bits - 1 generate
    signal has_bit : lane_flags;
  begin
    lanes_with_bit : for lane in 0 to lanes - 1 generate
      has_bit(lane) <= choice(lane) when (lane / 2 ** digit) mod 2 = 1 else '0';
    end generate lanes_with_bit;
    choice_lane(digit) <= '0' when has_bit = nobody else '1';
  end generate number_lane;
  chosen_entry <= top_entry(to_integer(chosen_lane));
{% if e.traversal.paced %}  -- Of registers alone, as hundreds of cells hang on it: a pair every other clock is more than the volume unit takes.
  issue_free <= not issued;
{% else %}  issue_free <= request_ready or not issued;
{% endif %}  some_chosen <= '0' when chosen = nobody else '1';
  lives <= chosen and not ended;
  pop <= '0' when lives = nobody else issue_free;
  popped <= pop;
  popped_lane <= chosen_lane;
  popped_entry <= chosen_entry;
  request_valid <= issued;
  expanded <= popped_one;
  expanded_lane <= std_logic_vector(issued_lane);
  request_lane <= std_logic_vector(issued_lane);
  request_a <= issued_entry(entry_node_a);
  request_b <= issued_entry(entry_node_b);
  waiting <= popped_one when flying = 0 else '1';

  issue : process (clk)
    variable more : integer range -3 to 1;
    variable now_flying : unsigned(flight_bits + 1 downto 0);  -- pairs in flight and records
  begin
    if rising_edge(clk) then
      first_lane <= unsigned(oldest);
      greatest_stack <= greatest(to_integer(unsigned(oldest)));
      if issue_free = '1' then
        issued_lane <= chosen_lane;
        issued_entry <= chosen_entry;
      end if;
      more := 0;
      if (brings_nodes and brings_leaves) = '1' then
        more := 1;
      elsif (met and not brings_nodes and not brings_leaves) = '1' then
        more := -1;
      end if;
      if nodes_finished = '1' then
        more := more - 1;
      end if;
      if leaves_finished = '1' then
        more := more - 1;
      end if;
      if reset = '1' then
        more := 0;
      end if;
      records <= to_signed(more, 3);
      now_flying := unsigned(signed(flying) + records);
      if popped_one = '1' then
        now_flying := unsigned(signed(flying) + (records + 1));
      end if;
      if reset = '1' then
        flying <= (others => '0');
        all_fly <= '0';
        all_but_one_fly <= '0';
{% if !e.traversal.paced %}        all_but_two_fly <= '0';
{% endif %}        popped_one <= '0';
        without_blocks <= (others => '0');
        crowded <= '0';
        took_blocks <= '0';
        issued <= '0';
        chosen <= nobody;
      else
        if issue_free = '1' then
          issued <= pop;
{% if e.traversal.paced %}        elsif request_ready = '1' then
          issued <= '0';
{% endif %}        end if;
        if (issue_free or not some_chosen) = '1' then
          chosen <= choice;
          chosen_lane <= unsigned(choice_lane);
          -- With the one that is chosen, and the one that was popped, all would fly.
          if all_fly = '1' or ((some_chosen or popped_one) and all_but_one_fly) = '1'
{%- if !e.traversal.paced %}
            or (some_chosen and popped_one and all_but_two_fly) = '1'
{%- endif %} then
            chosen <= nobody;
          end if;
        else
          chosen <= chosen and not ended;
        end if;
        flying <= now_flying;
        all_fly <= '0';
        if now_flying >= in_flight then
          all_fly <= '1';
        end if;
        all_but_one_fly <= '0';
        if now_flying + 1 >= in_flight then
          all_but_one_fly <= '1';
        end if;
{% if !e.traversal.paced %}        all_but_two_fly <= '0';
        if now_flying + 2 >= in_flight then
          all_but_two_fly <= '1';
        end if;
{% endif %}        popped_one <= pop;
        took_blocks <= blocks_taken;
        if popped_one = '1' and took_blocks = '0' then
          without_blocks <= without_blocks + 1;
          if without_blocks >= crowd - 1 then
            crowded <= '1';
          end if;
        elsif popped_one = '0' and took_blocks = '1' then
          without_blocks <= without_blocks - 1;
          if without_blocks <= crowd then
            crowded <= '0';
          end if;
        end if;
      end if;
    end if;
  end process issue;
end architecture rtl;
