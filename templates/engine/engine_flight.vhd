--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Pairs of nodes in flight, in the order in which they were popped, whatever their lanes: each has a place. Their blocks come from memory, the volume
-- unit takes the volumes of the children, their links are listed here, and its answer says which pairs of children may overlap.
--
-- A leaf has no block: its volume is in that of its parent.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_flight is
  port (
    clk : in std_logic;
    reset : in std_logic;
    ending : in lane_flags;  -- what is in flight of it is dropped
    popped : in std_logic;  -- a pair, which gets the next place
    popped_lane : in unsigned(lane_bits - 1 downto 0);
    popped_entry : in std_logic_vector(entry_bits - 1 downto 0);
    -- The blocks of the oldest pair whose blocks were not taken.
    blocks_taken : in std_logic;  -- the volume unit takes both in this clock
    block_a : in std_logic_vector(block_bits - 1 downto 0);
    block_b : in std_logic_vector(block_bits - 1 downto 0);
    take_lane : out std_logic_vector(lane_bits - 1 downto 0);  -- of the blocks
    take_a : out std_logic_vector(1 downto 0);  -- children to be tested, if there are such
    take_b : out std_logic_vector(1 downto 0);
    -- Of the query whose blocks were taken a clock ago.
    block_count_a : in std_logic_vector(31 downto 0);
    block_count_b : in std_logic_vector(31 downto 0);
    triangle_count_a : in std_logic_vector(31 downto 0);
    triangle_count_b : in std_logic_vector(31 downto 0);
    tested : out std_logic_vector(2 downto 0);  -- tests of the expansion: 0, 1, 2 or 4
    tested_lane : out std_logic_vector(lane_bits - 1 downto 0);
    -- An answer of the volume unit.
    survive_valid : in std_logic;
    survive : in std_logic_vector(3 downto 0);  -- bit 2 p + q: child p of A and child q of B may overlap
    -- The same, a clock later.
    met : out std_logic := '0';
    met_lane : out unsigned(lane_bits - 1 downto 0);
    met_entry : out std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
    met_family : out std_logic_vector(119 downto 0) := (others => '0');  -- children of A, of B, the right one first: leaf, fault, number
    met_nodes : out std_logic_vector(3 downto 0) := "0000";  -- survivors that are pushed
    met_leaves : out std_logic_vector(3 downto 0) := "0000";  -- survivors that are pairs of leaves
    brings_nodes : out std_logic := '0';  -- there are survivors that are pushed, and the query goes on
    brings_leaves : out std_logic := '0';
    bad_tree : out lane_flags := (others => '0')
  );
end entity {{ prefix }}engine_flight;

architecture rtl of {{ prefix }}engine_flight is
  constant flight_places : natural := {{ e.traversal.flight_places }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};
  constant everything : std_logic_vector(level_bits - 1 downto 0) := "{{ e.traversal.deepest }}";  -- level {{ e.traversal.levels }}

  -- Places of the pairs: popped, taken by the volume unit, its children listed, answered by it.
  signal popped_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal taken_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal listed_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal answered_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  type entries is array (0 to flight_places - 1) of std_logic_vector(entry_bits - 1 downto 0);
  signal entry_memory : entries := (others => (others => '0'));
  type children is array (0 to flight_places - 1) of std_logic_vector(119 downto 0);
  signal children_memory : children := (others => (others => '0'));
  -- Faults of their pairs, pairs of leaves, pairs of nodes, written a clock later than the children, as links are compared first: they
  -- can be read three clocks after the blocks were taken.
  type kinds_of_pairs is array (0 to flight_places - 1) of std_logic_vector(11 downto 0);
  signal kinds_memory : kinds_of_pairs := (others => (others => '0'));
  signal kinds_found : std_logic := '0';
  signal found_place : unsigned(flight_bits - 1 downto 0) := (others => '0');
  type lane_list is array (0 to flight_places - 1) of unsigned(lane_bits - 1 downto 0);
  signal lane_memory : lane_list := (others => (others => '0'));

  signal taken_entry : std_logic_vector(entry_bits - 1 downto 0);
  signal taken_lane : unsigned(lane_bits - 1 downto 0);
  signal listed_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal there_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal told_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');  -- of tests, and of a bad block
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
  -- A clock later.
  signal found_deepest : std_logic := '0';
  signal found_nodes : std_logic_vector(3 downto 0) := "0000";
  signal found_leaves : std_logic_vector(3 downto 0) := "0000";
  signal found_fault_a : std_logic_vector(1 downto 0) := "00";
  signal found_fault_b : std_logic_vector(1 downto 0) := "00";
  signal found_astray_a : std_logic_vector(1 downto 0) := "00";  -- a fault of a child that is no leaf
  signal found_astray_b : std_logic_vector(1 downto 0) := "00";
  signal found_faults : std_logic_vector(3 downto 0);

  -- The oldest of the pairs whose children are listed.
  signal answered_children : std_logic_vector(119 downto 0);
  signal answered_kinds : std_logic_vector(11 downto 0);
  signal answered_faults : std_logic_vector(3 downto 0);
  signal answered_leaves : std_logic_vector(3 downto 0);
  signal answered_nodes : std_logic_vector(3 downto 0);
  signal answered_lane : unsigned(lane_bits - 1 downto 0);
  -- Its answer, a clock later.
  signal met_lane_now : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal wrong : std_logic := '0';  -- a survivor has a wrong link
begin
  taken_entry <= entry_memory(to_integer(taken_place));
  taken_lane <= lane_memory(to_integer(taken_place));
  take_lane <= std_logic_vector(taken_lane);
  tested_lane <= std_logic_vector(told_lane);
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
      if popped = '1' then
        entry_memory(to_integer(popped_place)) <= popped_entry;
        lane_memory(to_integer(popped_place)) <= popped_lane;
      end if;
      tested <= tests;
      told_lane <= there_lane;
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
        children_memory(to_integer(listed_place)) <= leaf_a(1) & fault_a(1) & right_a & leaf_a(0) & fault_a(0) & left_a
          & leaf_b(1) & fault_b(1) & right_b & leaf_b(0) & fault_b(0) & left_b;
      end if;
      kinds_found <= listed and not reset;
      found_place <= listed_place;
      found_deepest <= listed_deepest;
      found_nodes <= listed_nodes;
      found_leaves <= listed_leaves;
      found_fault_a <= fault_a;
      found_fault_b <= fault_b;
      found_astray_a <= fault_a and not leaf_a;
      found_astray_b <= fault_b and not leaf_b;
      if kinds_found = '1' then
        kinds_memory(to_integer(found_place)) <= found_faults & found_leaves & found_nodes;
      end if;
      if reset = '1' then
        popped_place <= (others => '0');
        taken_place <= (others => '0');
        listed_place <= (others => '0');
        answered_place <= (others => '0');
        listed <= '0';
        there_a <= "00";
        there_b <= "00";
        tested <= "000";  -- of what is forgotten nothing is counted
      else
        listed <= blocks_taken;
        if popped = '1' then
          popped_place <= popped_place + 1;
        end if;
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

  -- A leaf beside an inner node stays where it is: its number is not used yet.
  kinds : for k in 0 to 3 generate
    constant a : natural := k / 2;
    constant b : natural := k mod 2;
  begin
    listed_nodes(k) <= present_a(a) and present_b(b) and not (leaf_a(a) and leaf_b(b));
    listed_leaves(k) <= present_a(a) and present_b(b) and leaf_a(a) and leaf_b(b);
    found_faults(k) <= (found_nodes(k) and (found_astray_a(a) or found_astray_b(b) or found_deepest))
      or (found_leaves(k) and (found_fault_a(a) or found_fault_b(b)));
  end generate kinds;

  answered_children <= children_memory(to_integer(answered_place));
  answered_kinds <= kinds_memory(to_integer(answered_place));
  answered_faults <= answered_kinds(11 downto 8);
  answered_leaves <= answered_kinds(7 downto 4);
  answered_nodes <= answered_kinds(3 downto 0);
  answered_lane <= lane_memory(to_integer(answered_place));

  meet : process (clk)
  begin
    if rising_edge(clk) then
      brings_nodes <= '0';
      brings_leaves <= '0';
      wrong <= '0';
      if (survive and answered_faults) /= "0000" then
        wrong <= survive_valid and not reset;
      elsif ending(to_integer(answered_lane)) = '0' then
        if (survive and answered_nodes) /= "0000" then
          brings_nodes <= survive_valid and not reset;
        end if;
        if (survive and answered_leaves) /= "0000" then
          brings_leaves <= survive_valid and not reset;
        end if;
      end if;
      met_entry <= entry_memory(to_integer(answered_place));
      met_family <= answered_children;
      met_lane_now <= answered_lane;
      met_nodes <= survive and answered_nodes;
      met_leaves <= survive and answered_leaves;
      met <= survive_valid and not reset;
    end if;
  end process meet;

  met_lane <= met_lane_now;

  find_bad : process (clk)
  begin
    if rising_edge(clk) then
      for lane in 0 to lanes - 1 loop
        bad_tree(lane) <= '0';
        if (wrong = '1' and met_lane_now = lane) or ((bad_a or bad_b) = '1' and told_lane = lane) then
          bad_tree(lane) <= not reset;
        end if;
      end loop;
    end if;
  end process find_bad;
end architecture rtl;
