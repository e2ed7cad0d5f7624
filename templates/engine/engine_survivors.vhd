--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- What comes of the answers of the volume unit. Of the survivors of an expansion one in each clock is pushed, and one pair of leaves
-- goes; those that wait do so in two queues, a record for each expansion. Two leaves of one block that meet the same inner node are
-- pushed as one pair, so that one expansion tests both.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_survivors is
  port (
    clk : in std_logic;
    reset : in std_logic;
    ending : in lane_flags;  -- pairs of leaves of it are dropped from the next clock on
    -- An answer of the volume unit.
    met : in std_logic;
    met_lane : in unsigned(lane_bits - 1 downto 0);
    met_entry : in std_logic_vector(entry_bits - 1 downto 0);
    met_family : in std_logic_vector(119 downto 0);  -- children of A, of B, the right one first: leaf, fault, number
    met_nodes : in std_logic_vector(3 downto 0);  -- survivors that are pushed
    met_leaves : in std_logic_vector(3 downto 0);  -- survivors that are pairs of leaves
    brings_nodes : in std_logic;  -- there are survivors that are pushed, and the query goes on
    brings_leaves : in std_logic;
    survived : out std_logic_vector(2 downto 0);  -- so many more
    survived_lane : out std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
    -- A survivor that is pushed: its lane is known a clock before its entry.
    pushes : out std_logic;
    pushes_lane : out unsigned(lane_bits - 1 downto 0);
    next_entry : out std_logic_vector(entry_bits - 1 downto 0);
    nodes_finished : out std_logic;  -- it was the last of its record
    finished_lane : out unsigned(lane_bits - 1 downto 0) := (others => '0');
    -- Pairs of leaves.
    pair_valid : out std_logic;
    pair_ready : in std_logic;
    pair_lane : out std_logic_vector(lane_bits - 1 downto 0);
    pair_a : out std_logic_vector(27 downto 0);  -- number of the triangle
    pair_b : out std_logic_vector(27 downto 0);
    sends_pair : out std_logic;
    leaves_finished : out std_logic  -- a record is finished
  );
end entity {{ prefix }}engine_survivors;

architecture rtl of {{ prefix }}engine_survivors is
  constant flight_places : natural := {{ e.traversal.flight_places }};
  constant flight_bits : natural := {{ e.traversal.flight_bits }};

  type lane_list is array (0 to flight_places - 1) of unsigned(lane_bits - 1 downto 0);
  -- Records of survivors that are pushed: the first is opened. Behind it there is room for all pairs in flight.
  constant node_record_bits : natural := entry_bits + 125;
  subtype node_record is std_logic_vector(node_record_bits - 1 downto 0);
  type node_records is array (0 to flight_places - 1) of node_record;
  signal node_memory : node_records := (others => (others => '0'));
  signal node_lanes : lane_list := (others => (others => '0'));
  signal node_written : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal node_read : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal node_count : unsigned(flight_bits downto 0) := (others => '0');
  signal nodes_wait : std_logic := '0';
  signal next_nodes : node_record;
  signal next_leaf : std_logic_vector(3 downto 0);  -- which of its children are leaves
  signal next_node_lane : unsigned(lane_bits - 1 downto 0);

  -- The same of pairs of leaves.
  subtype leaf_record is std_logic_vector(115 downto 0);
  type leaf_records is array (0 to flight_places - 1) of leaf_record;
  signal leaf_memory : leaf_records := (others => (others => '0'));
  signal leaf_lanes : lane_list := (others => (others => '0'));
  signal leaf_written : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal leaf_read : unsigned(flight_bits - 1 downto 0) := (others => '0');
  signal leaf_count : unsigned(flight_bits downto 0) := (others => '0');
  signal leaves_wait : std_logic := '0';
  signal next_leaves : leaf_record;
  signal next_leaf_lane : unsigned(lane_bits - 1 downto 0);
  signal leaves_free : std_logic;
  signal leaf_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal leaf_numbers : std_logic_vector(111 downto 0) := (others => '0');
  signal leaves_left : std_logic_vector(3 downto 0) := "0000";
  signal leaf_pick : std_logic_vector(3 downto 0);
  signal some_leaves : std_logic := '0';  -- of leaves_left, a register, as much waits for it
  signal leaves_ended : std_logic := '0';  -- the query ends
  signal last_leaves : std_logic := '0';  -- at most one of them, the same
  signal last_sent : std_logic;  -- the last pair of a record, or the query ends

  -- Survivors that are pushed one by one, from right and right to left and left.
  signal opened : std_logic := '0';  -- there is a record
  signal own_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal own : std_logic_vector(entry_bits - 1 downto 0) := (others => '0');
  signal family : std_logic_vector(119 downto 0) := (others => '0');
  signal left_over : std_logic_vector(3 downto 0) := "0000";
  signal pick : std_logic_vector(3 downto 0);
  signal last_pick : std_logic := '1';  -- what is picked is all that is left over, with what goes with it, or there is no record
  signal nodes_come : std_logic;  -- the next record is there
  signal joins_a : std_logic_vector(1 downto 0) := "00";  -- bit q: both children of A are leaves, child q of B is none
  signal joins_b : std_logic_vector(1 downto 0) := "00";
  signal joined_a : std_logic;  -- both leaves meet the same inner node, and go as one pair
  signal joined_b : std_logic;
  signal gone : std_logic_vector(3 downto 0);  -- what is picked, and what goes with it
  signal candidate : std_logic := '0';
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
  signal pair_due : std_logic;
  signal met_survivors : std_logic_vector(3 downto 0);
  signal met_leaf : std_logic_vector(3 downto 0);
  signal met_node_record : node_record;  -- in front whether what is picked first is all
  signal met_leaf_record : leaf_record;

  function at_most_one(flags : std_logic_vector(3 downto 0)) return std_logic is
  begin
    if flags = "0000" or flags = "0001" or flags = "0010" or flags = "0100" or flags = "1000" then
      return '1';
    end if;
    return '0';
  end function at_most_one;

  -- Bit q: both children of one side are leaves, child q of the other is none.
  function joins(both : std_logic_vector(1 downto 0); other : std_logic_vector(1 downto 0)) return std_logic_vector is
  begin
    return (both(1) and both(0) and not other(1)) & (both(1) and both(0) and not other(0));
  end function joins;

  -- What is picked of these is all, with what goes with it.
  function picks_all(left : std_logic_vector(3 downto 0); of_a : std_logic_vector(1 downto 0); of_b : std_logic_vector(1 downto 0)) return std_logic is
  begin
    if left = "1010" then
      return of_a(1);
    elsif left = "0101" then
      return of_a(0);
    elsif left = "1100" then
      return of_b(1);
    elsif left = "0011" then
      return of_b(0);
    end if;
    return at_most_one(left);
  end function picks_all;
begin
  met_survivors <= met_nodes or met_leaves;
  met_leaf <= met_family(119) & met_family(89) & met_family(59) & met_family(29);
  met_node_record <= picks_all(met_nodes, joins(met_leaf(3 downto 2), met_leaf(1 downto 0)), joins(met_leaf(1 downto 0), met_leaf(3 downto 2)))
    & met_nodes & met_family & met_entry;
  -- Of the children their numbers.
  met_leaf_record <= met_leaves & met_family(117 downto 90) & met_family(87 downto 60) & met_family(57 downto 30) & met_family(27 downto 0);

  -- A record goes into its queue if it is not the first.
  nodes_come <= nodes_wait or brings_nodes;
  next_nodes <= node_memory(to_integer(node_read)) when nodes_wait = '1' else met_node_record;
  next_leaf <= next_nodes(entry_bits + 119) & next_nodes(entry_bits + 89) & next_nodes(entry_bits + 59) & next_nodes(entry_bits + 29);
  next_node_lane <= node_lanes(to_integer(node_read)) when nodes_wait = '1' else met_lane;
  leaves_free <= last_sent or not some_leaves;
  next_leaves <= leaf_memory(to_integer(leaf_read)) when leaves_wait = '1' else met_leaf_record;
  next_leaf_lane <= leaf_lanes(to_integer(leaf_read)) when leaves_wait = '1' else met_lane;

  queue : process (clk)
    variable node_left : unsigned(flight_bits downto 0);  -- if the first may go
    variable leaf_left : unsigned(flight_bits downto 0);
    variable node_more : unsigned(flight_bits downto 0);  -- if none goes
    variable leaf_more : unsigned(flight_bits downto 0);
  begin
    if rising_edge(clk) then
      -- Whether the first may go is known late in a clock, so both counts are there before. What does not wait is written, too, to
      -- a place that counts as free.
      node_left := node_count;
      if nodes_wait = '1' and brings_nodes = '0' then
        node_left := node_count - 1;
      end if;
      node_more := node_count;
      if brings_nodes = '1' then
        node_more := node_count + 1;
        node_memory(to_integer(node_written)) <= met_node_record;
        node_lanes(to_integer(node_written)) <= met_lane;
      end if;
      leaf_left := leaf_count;
      if leaves_wait = '1' and brings_leaves = '0' then
        leaf_left := leaf_count - 1;
      end if;
      leaf_more := leaf_count;
      if brings_leaves = '1' then
        leaf_more := leaf_count + 1;
        leaf_memory(to_integer(leaf_written)) <= met_leaf_record;
        leaf_lanes(to_integer(leaf_written)) <= met_lane;
      end if;
      if reset = '1' then
        node_written <= (others => '0');
        node_read <= (others => '0');
        node_count <= (others => '0');
        nodes_wait <= '0';
        leaf_written <= (others => '0');
        leaf_read <= (others => '0');
        leaf_count <= (others => '0');
        leaves_wait <= '0';
      else
        if brings_nodes = '1' and (nodes_wait = '1' or last_pick = '0') then
          node_written <= node_written + 1;
        end if;
        if nodes_wait = '1' and last_pick = '1' then
          node_read <= node_read + 1;
        end if;
        node_count <= node_more;
        nodes_wait <= '0';
        if last_pick = '1' then
          node_count <= node_left;
          if node_left /= 0 then
            nodes_wait <= '1';
          end if;
        elsif node_more /= 0 then
          nodes_wait <= '1';
        end if;
        if brings_leaves = '1' and (leaves_wait = '1' or leaves_free = '0') then
          leaf_written <= leaf_written + 1;
        end if;
        if leaves_wait = '1' and leaves_free = '1' then
          leaf_read <= leaf_read + 1;
        end if;
        leaf_count <= leaf_more;
        leaves_wait <= '0';
        if leaves_free = '1' then
          leaf_count <= leaf_left;
          if leaf_left /= 0 then
            leaves_wait <= '1';
          end if;
        elsif leaf_more /= 0 then
          leaves_wait <= '1';
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

  choose : process (clk)
    variable next_left : std_logic_vector(3 downto 0);
    variable next_joins_a : std_logic_vector(1 downto 0);
    variable next_joins_b : std_logic_vector(1 downto 0);
    variable next_last : std_logic;
  begin
    if rising_edge(clk) then
      next_left := left_over and not gone;
      -- Known a clock before, because much waits for it.
      next_last := picks_all(next_left, joins_a, joins_b);
      next_joins_a := joins_a;
      next_joins_b := joins_b;
      survived_lane <= std_logic_vector(met_lane);
      survived <= "000";
      if (met and not reset) = '1' then
        survived <= std_logic_vector(("00" & unsigned(met_survivors(0 downto 0))) + unsigned(met_survivors(1 downto 1))
          + unsigned(met_survivors(2 downto 2)) + unsigned(met_survivors(3 downto 3)));
      end if;
      candidate <= opened and not reset;
      finished_lane <= own_lane;
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
      if last_pick = '1' then
        next_left := next_nodes(entry_bits + 123 downto entry_bits + 120);
        next_joins_a := joins(next_leaf(3 downto 2), next_leaf(1 downto 0));
        next_joins_b := joins(next_leaf(1 downto 0), next_leaf(3 downto 2));
        next_last := next_nodes(entry_bits + 124);
        own <= next_nodes(entry_bits - 1 downto 0);
        family <= next_nodes(entry_bits + 119 downto entry_bits);
        own_lane <= next_node_lane;
        opened <= nodes_come;
      end if;
      left_over <= next_left;
      joins_a <= next_joins_a;
      joins_b <= next_joins_b;
      last_pick <= next_last or (last_pick and not nodes_come);
      if reset = '1' then
        opened <= '0';
        last_pick <= '1';
      end if;
    end if;
  end process choose;

  pushes <= opened;
  pushes_lane <= own_lane;
  nodes_finished <= candidate and is_last;

  -- The number of a block without a fault has no more bits than these.
  next_a <= child_a(node_bits - 1 downto 0) & "11" when child_a(29) = '0' else
    parents(entry_node_a) & "11" when whole_a = '1' else
    parents(entry_node_a) & side_a & not side_a;
  next_b <= child_b(node_bits - 1 downto 0) & "11" when child_b(29) = '0' else
    parents(entry_node_b) & "11" when whole_b = '1' else
    parents(entry_node_b) & side_b & not side_b;

  next_entry <= next_a & next_b & next_level;

  -- ===== Pairs of leaves =====
  leaf_pick <= "1000" when leaves_left(3) = '1' else
    "0100" when leaves_left(2) = '1' else
    "0010" when leaves_left(1) = '1' else
    leaves_left;
  pair_due <= some_leaves and not leaves_ended;
  last_sent <= some_leaves and (leaves_ended or (pair_ready and last_leaves));
  pair_valid <= pair_due;
  pair_lane <= std_logic_vector(leaf_lane);
  sends_pair <= pair_due and pair_ready;
  leaves_finished <= last_sent;
  pair_a <= leaf_numbers(111 downto 84) when (leaf_pick(3) or leaf_pick(2)) = '1' else leaf_numbers(83 downto 56);
  pair_b <= leaf_numbers(55 downto 28) when (leaf_pick(3) or leaf_pick(1)) = '1' else leaf_numbers(27 downto 0);

  part : process (clk)
    variable next_left : std_logic_vector(3 downto 0);
  begin
    if rising_edge(clk) then
      next_left := leaves_left;
      leaves_ended <= ending(to_integer(leaf_lane));
      if leaves_free = '1' then
        leaf_numbers <= next_leaves(111 downto 0);
        leaf_lane <= next_leaf_lane;
        leaves_ended <= ending(to_integer(next_leaf_lane));
        next_left := "0000";
        if (leaves_wait or brings_leaves) = '1' then
          next_left := next_leaves(115 downto 112);
        end if;
      elsif pair_ready = '1' then
        next_left := leaves_left and not leaf_pick;
      end if;
      if reset = '1' then
        next_left := "0000";
      end if;
      leaves_left <= next_left;
      some_leaves <= '1';
      if next_left = "0000" then
        some_leaves <= '0';
      end if;
      last_leaves <= at_most_one(next_left);
    end if;
  end process part;
end architecture rtl;
