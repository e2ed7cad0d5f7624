--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The traversals of the queries in flight, each in a lane of its own: depth first from a stack of pairs of nodes. A pair is
-- popped (engine_issue), its two blocks are fetched, the volume unit tests the children of one against the children of the other
-- (engine_flight), and the pairs that may overlap are pushed, or sent to the triangle unit where both are leaves
-- (engine_survivors).
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
    ending : in lane_flags;  -- from the next clock on no pair is popped any more; what is in flight is dropped
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
    pair_left : in lane_flags;  -- a clock ago a pair left the queue of its lane
    pair_a : out std_logic_vector(27 downto 0);  -- number of the triangle
    pair_b : out std_logic_vector(27 downto 0);
    -- State and events, each of one clock.
    idle : out lane_flags;  -- a clock ago nothing was in flight, and nothing was to be popped
    waiting : out std_logic;  -- something is in flight
    bad_tree : out lane_flags;
    limit_reached : out lane_flags;
    expanded : out std_logic;  -- a clock ago
    expanded_lane : out std_logic_vector(lane_bits - 1 downto 0);
    tested : out std_logic_vector(2 downto 0);  -- tests of the expansion: 0, 1, 2 or 4
    tested_lane : out std_logic_vector(lane_bits - 1 downto 0);
    survived : out std_logic_vector(2 downto 0);  -- so many more
    survived_lane : out std_logic_vector(lane_bits - 1 downto 0);
    greatest_stack : out unsigned(15 downto 0)  -- of the oldest query, a clock ago
  );
end entity {{ prefix }}engine_traverse;

architecture rtl of {{ prefix }}engine_traverse is
  signal ended : lane_flags := (others => '1');  -- ending, a clock later: near to what reads it, and still set in the clock of start
  signal popped : std_logic;
  signal popped_lane : unsigned(lane_bits - 1 downto 0);
  signal popped_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal met : std_logic;
  signal met_lane : unsigned(lane_bits - 1 downto 0);
  signal met_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal met_family : std_logic_vector(119 downto 0);
  signal met_nodes : std_logic_vector(3 downto 0);
  signal met_leaves : std_logic_vector(3 downto 0);
  signal brings_nodes : std_logic;
  signal brings_leaves : std_logic;
  signal pushes : std_logic;
  signal pushes_lane : unsigned(lane_bits - 1 downto 0);
  signal next_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal nodes_finished : std_logic;
  signal finished_lane : unsigned(lane_bits - 1 downto 0);
  signal leaf_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal sends_pair : std_logic;
  signal leaves_finished : std_logic;
begin
  delay : process (clk)
  begin
    if rising_edge(clk) then
      ended <= ending;
    end if;
  end process delay;

  issue : entity work.{{ prefix }}engine_issue
    port map (
      clk => clk,
      reset => reset,
      start => start,
      start_lane => start_lane,
      most_expansions => most_expansions,
      oldest => oldest,
      ending => ending,
      ended => ended,
      popped => popped,
      popped_lane => popped_lane,
      popped_entry => popped_entry,
      expanded => expanded,
      expanded_lane => expanded_lane,
      request_valid => request_valid,
      request_ready => request_ready,
      request_lane => request_lane,
      request_a => request_a,
      request_b => request_b,
      blocks_taken => blocks_taken,
      met => met,
      met_lane => met_lane,
      brings_nodes => brings_nodes,
      brings_leaves => brings_leaves,
      pushes => pushes,
      pushes_lane => pushes_lane,
      next_entry => next_entry,
      nodes_finished => nodes_finished,
      finished_lane => finished_lane,
      sends_pair => sends_pair,
      leaves_finished => leaves_finished,
      leaf_lane => leaf_lane,
      pair_left => pair_left,
      idle => idle,
      waiting => waiting,
      limit_reached => limit_reached,
      greatest_stack => greatest_stack
    );

  flight : entity work.{{ prefix }}engine_flight
    port map (
      clk => clk,
      reset => reset,
      ending => ending,
      popped => popped,
      popped_lane => popped_lane,
      popped_entry => popped_entry,
      blocks_taken => blocks_taken,
      block_a => block_a,
      block_b => block_b,
      take_lane => take_lane,
      take_a => take_a,
      take_b => take_b,
      block_count_a => block_count_a,
      block_count_b => block_count_b,
      triangle_count_a => triangle_count_a,
      triangle_count_b => triangle_count_b,
      tested => tested,
      tested_lane => tested_lane,
      survive_valid => survive_valid,
      survive => survive,
      met => met,
      met_lane => met_lane,
      met_entry => met_entry,
      met_family => met_family,
      met_nodes => met_nodes,
      met_leaves => met_leaves,
      brings_nodes => brings_nodes,
      brings_leaves => brings_leaves,
      bad_tree => bad_tree
    );

  survivors : entity work.{{ prefix }}engine_survivors
    port map (
      clk => clk,
      reset => reset,
      ending => ending,
      met => met,
      met_lane => met_lane,
      met_entry => met_entry,
      met_family => met_family,
      met_nodes => met_nodes,
      met_leaves => met_leaves,
      brings_nodes => brings_nodes,
      brings_leaves => brings_leaves,
      survived => survived,
      survived_lane => survived_lane,
      pushes => pushes,
      pushes_lane => pushes_lane,
      next_entry => next_entry,
      nodes_finished => nodes_finished,
      finished_lane => finished_lane,
      pair_valid => pair_valid,
      pair_ready => pair_ready,
      pair_lane => leaf_lane,
      pair_a => pair_a,
      pair_b => pair_b,
      sends_pair => sends_pair,
      leaves_finished => leaves_finished
    );

  pair_lane <= leaf_lane;
end architecture rtl;
