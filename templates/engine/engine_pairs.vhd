--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Pairs of leaves between the traversal and their answers. Each lane has a queue of {{ e.traversal.pairs }} pairs of numbers. Triangles are asked
-- for in the order of the queries: those of the front lane, until its query has no more to ask for; then the next lane is
-- the front. So pairs of a younger query may be in the triangle unit while the last ones of an older query are, behind them.
-- In front of its first pair, a query's pose goes to the unit. When a query ends early, its pairs that are not offered to
-- the triangle unit are dropped.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_pairs is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- The queries.
    oldest : in std_logic_vector(lane_bits - 1 downto 0);
    oldest_flags : in lane_flags;  -- the same, a flag for each lane
    retire : in std_logic;  -- it is done, and so is all of it here
    posed : in lane_flags;  -- lanes with a pose for the unit
    started : in lane_flags;
    ending : in lane_flags;
    leaves_only : in lane_flags;
    traversed : in lane_flags;  -- no pair comes any more
    -- Pairs from the traversal.
    pair_valid : in std_logic;
    pair_ready : out std_logic;
    pair_lane : in std_logic_vector(lane_bits - 1 downto 0);
    pair_a : in std_logic_vector(27 downto 0);
    pair_b : in std_logic_vector(27 downto 0);
    pair_left : out lane_flags := (others => '0');  -- a clock ago one left the queue of the lane, or passed by it
    -- Triangles, those of the front lane.
    front : out std_logic_vector(lane_bits - 1 downto 0);
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_a : out std_logic_vector(27 downto 0);
    request_b : out std_logic_vector(27 downto 0);
    -- Triangles that have come, in order.
    triangles_valid : in std_logic;
    triangles_taken : in std_logic;
    triangles_lane : out std_logic_vector(lane_bits - 1 downto 0);
    testable : out std_logic;  -- the unit has their pose
    drops : out std_logic;  -- their query ends early, a clock later
    pose_valid : out std_logic;  -- the pose of the front lane is next
    pose_ready : in std_logic;
    -- Pairs in the unit.
    sent : in std_logic;  -- while no query runs: a pair of a packet goes to the unit
    answered : in std_logic;  -- one pair more, of the oldest query or a packet
    idle : out lane_flags := (others => '1');  -- a clock ago every pair was answered or dropped, and the unit had had the pose
    reads : out std_logic  -- the oldest query still waits for triangles
  );
end entity {{ prefix }}engine_pairs;

architecture rtl of {{ prefix }}engine_pairs is
  constant places : natural := {{ e.traversal.pairs }};
  constant all_places : natural := {{ e.traversal.all_pairs }};
  constant place_bits : natural := {{ e.traversal.pair_bits }};
  constant open_bits : natural := {{ e.traversal.open_bits }};
  constant nobody : lane_flags := (others => '0');
  -- The queues: the place of a pair is behind its lane.
  type pairs is array (0 to all_places - 1) of std_logic_vector(55 downto 0);
  signal queue : pairs := (others => (others => '0'));
  type lane_places is array (0 to lanes - 1) of unsigned(place_bits - 1 downto 0);
  signal written : lane_places := (others => (others => '0'));
  signal fetched : lane_places := (others => (others => '0'));
  type lane_counts is array (0 to lanes - 1) of unsigned(place_bits downto 0);
  signal waiting : lane_counts := (others => (others => '0'));  -- in the queue
  signal some_wait : lane_flags := (others => '0');
  signal full : lane_flags := (others => '0');  -- but for one place at most
  -- That of the oldest query was full a clock ago, so all pairs wait: the one that came meanwhile has the last place. Others are never
  -- stopped by theirs.
  signal oldest_full : std_logic := '0';
  signal write_place : unsigned(lane_bits + place_bits - 1 downto 0);
  signal fetch_place : unsigned(lane_bits + place_bits - 1 downto 0);
  signal accepts : std_logic;
  signal passes : std_logic;  -- it is the next one of the front lane, and passes by its queue
  signal fetches : std_logic;  -- the memory is read, also where nothing waits{% if e.unit.paced %}; of three clocks in two, if there is always more{% endif %}
  -- The first pair of the front lane and the two behind it: a memory is far from where its word goes, and that the first one
  -- leaves is known late in a clock, so that one more is read whenever there is a place.
  signal front_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal is_front : lane_flags := (0 => '1', others => '0');  -- the same, a flag for each lane
  signal front_is_oldest : std_logic := '1';  -- front_lane = oldest
  signal next_lane : unsigned(lane_bits - 1 downto 0);
  signal front_ending : std_logic;
  signal front_waits : std_logic;
  signal next_pair : std_logic_vector(55 downto 0) := (others => '0');
  signal next_valid : std_logic := '0';
  signal read_pair : std_logic_vector(55 downto 0) := (others => '0');
  signal read_valid : std_logic := '0';
  signal held : std_logic;  -- one of them is there
  signal moves : std_logic;
  signal head : std_logic_vector(55 downto 0) := (others => '0');
  signal head_valid : std_logic := '0';
  signal asks : std_logic;
  signal asked : std_logic;
  -- Pairs asked for and not yet in the unit: those of the lane that was the front before come first.
  signal last_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal of_last : unsigned(open_bits - 1 downto 0) := (others => '0');
  signal of_front : unsigned(open_bits - 1 downto 0) := (others => '0');
  signal some_of_last : std_logic := '0';
  signal last_left : std_logic;  -- there are some behind this clock
  signal front_left : std_logic;
  signal asked_one : std_logic := '0';  -- of_front counts it in this clock: its triangles come later
  signal triangles_of : unsigned(lane_bits - 1 downto 0) := (others => '0');  -- the last lane, or the front where none of it is left; a clock later if the front moves
  signal drops_them : std_logic := '0';  -- a clock ago their query was ending
  signal dropped : std_logic;
  signal has_pose : std_logic := '0';  -- the unit has the pose of the front lane, or is to keep the one it has
  signal offers_pose : std_logic;
  -- Pairs asked for and not answered.
  type open_counts is array (0 to lanes - 1) of unsigned(open_bits - 1 downto 0);
  signal open_pairs : open_counts := (others => (others => '0'));
  signal some_open : lane_flags := (others => '0');
  -- What a clock has changed of them, counted in the next one; one that is new is open at once.
  signal opened : lane_flags := (others => '0');
  signal dropped_one : lane_flags := (others => '0');
  signal answered_one : lane_flags := (others => '0');
  signal ends_front : std_logic;  -- the query in front is done
  signal may_advance : std_logic;  -- the front lane has no more to ask for, and the next one may be the front
  signal advances : std_logic := '0';  -- a clock later; until then nothing of it changes
  signal advance_free : std_logic;
begin
  write_place <= unsigned(pair_lane) & written(to_integer(unsigned(pair_lane)));
  fetch_place <= front_lane & fetched(to_integer(front_lane));
  pair_ready <= not oldest_full;
  accepts <= pair_valid and not oldest_full;
  passes <= accepts and is_front(to_integer(unsigned(pair_lane))) and not (held or front_waits);
  held <= head_valid or next_valid or read_valid;
  front_ending <= '0' when (ending and is_front) = nobody else '1';
  front_waits <= '0' when (some_wait and is_front) = nobody else '1';
  asks <= head_valid and not front_ending;
  asked <= asks and request_ready;
  request_valid <= asks;
  request_a <= head(55 downto 28);
  request_b <= head(27 downto 0);
  moves <= request_ready or not head_valid;
  -- What an ending query fetches here is forgotten in the same clock.
  fetches <= {% if e.unit.paced %}not (next_valid and read_valid){% else %}moves or not (next_valid and read_valid){% endif %};
  front <= std_logic_vector(front_lane);

  last_left <= '0' when some_of_last = '0' or (triangles_taken = '1' and of_last = 1) else '1';
  -- The front changes only where none was asked for in this clock or the one before.
  front_left <= '0' when of_front = 0 or (triangles_taken = '1' and some_of_last = '0' and of_front = 1) else '1';
  triangles_lane <= std_logic_vector(triangles_of);
  testable <= some_of_last or has_pose;
  drops <= drops_them;
  dropped <= triangles_valid and drops_them;
  offers_pose <= posed(to_integer(front_lane)) and not has_pose and not some_of_last;
  pose_valid <= offers_pose;

  -- A query without triangle tests and another one are never in the unit together.
  next_lane <= front_lane + 1;
  advance_free <= '1' when (some_open or opened) = nobody else
    not (leaves_only(to_integer(front_lane)) or leaves_only(to_integer(next_lane)));
  ends_front <= retire and front_is_oldest;
  may_advance <= has_pose and traversed(to_integer(front_lane)) and advance_free and not (held or front_waits)
    and started(to_integer(next_lane)) when next_lane /= unsigned(oldest) else '0';

  each_lane : for lane in 0 to lanes - 1 generate
  begin
    rest : process (clk)
    begin
      if rising_edge(clk) then
        idle(lane) <= not some_open(lane) and not opened(lane) and not some_wait(lane)
          and not (is_front(lane) and (held or (posed(lane) and not has_pose)));
      end if;
    end process rest;
  end generate each_lane;
  reads <= '1' when some_wait(to_integer(unsigned(oldest))) = '1'
    or (front_is_oldest = '1' and (held = '1' or asked_one = '1' or of_front /= 0))
    or (front_is_oldest = '0' and some_of_last = '1') else '0';

  remember : process (clk)
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        queue(to_integer(write_place)) <= pair_a & pair_b;
      end if;
      if fetches = '1' then
        read_pair <= queue(to_integer(fetch_place));
      end if;
      if (moves or not next_valid) = '1' then
        next_pair <= read_pair;
      end if;
      if moves = '1' then
        head <= pair_a & pair_b;
        if next_valid = '1' then
          head <= next_pair;
        end if;
      end if;
    end if;
  end process remember;

  count : process (clk)
    variable comes : boolean;
    variable is_fetched : boolean;
    variable may_pass : boolean;
    variable goes : boolean;
    variable kept : unsigned(place_bits downto 0);
    variable left : unsigned(place_bits downto 0);
    variable change : integer range -2 to 1;
    variable left_of_last : unsigned(open_bits - 1 downto 0);
    variable left_of_front : unsigned(open_bits - 1 downto 0);
    variable next_of : unsigned(lane_bits - 1 downto 0);
  begin
    if rising_edge(clk) then
      for lane in 0 to lanes - 1 loop
        comes := accepts = '1' and unsigned(pair_lane) = lane;
        -- One is fetched, or one that comes would pass by: of what the clock knows first, as much hangs on it.
        is_fetched := (is_front(lane) and some_wait(lane) and fetches) = '1';
        may_pass := (is_front(lane) and not (some_wait(lane) or held)) = '1';
        goes := is_fetched or (comes and may_pass);
        pair_left(lane) <= '0';
        if goes and reset = '0' then
          pair_left(lane) <= '1';
        end if;
        if comes then
          written(lane) <= written(lane) + 1;
        end if;
        if goes then
          fetched(lane) <= fetched(lane) + 1;
        end if;
        -- Whether one goes is known after whether one comes: what it chooses between is there before.
        kept := waiting(lane);
        left := waiting(lane) - 1;
        if comes then
          kept := waiting(lane) + 1;
          left := waiting(lane);
        end if;
        waiting(lane) <= kept;
        if goes then
          waiting(lane) <= left;
        end if;
        if comes and not (is_fetched or may_pass) then
          some_wait(lane) <= '1';
          if waiting(lane) = places - 2 then
            full(lane) <= '1';
          end if;
        elsif is_fetched and not comes then
          if waiting(lane) = places - 1 then
            full(lane) <= '0';
          end if;
          if waiting(lane) = 1 then
            some_wait(lane) <= '0';
          end if;
        end if;
        -- No query is in the lane, or it drops what it has.
        if reset = '1' or ending(lane) = '1' then
          written(lane) <= (others => '0');
          fetched(lane) <= (others => '0');
          waiting(lane) <= (others => '0');
          some_wait(lane) <= '0';
          full(lane) <= '0';
        end if;
        opened(lane) <= '0';
        if (asked = '1' and is_front(lane) = '1') or (sent and oldest_flags(lane)) = '1' then
          opened(lane) <= '1';
        end if;
        dropped_one(lane) <= '0';
        if triangles_of = lane then
          dropped_one(lane) <= dropped;
        end if;
        answered_one(lane) <= answered and oldest_flags(lane);
        change := 0;
        if opened(lane) = '1' then
          change := change + 1;
        end if;
        if dropped_one(lane) = '1' then
          change := change - 1;
        end if;
        if answered_one(lane) = '1' then
          change := change - 1;
        end if;
        open_pairs(lane) <= unsigned(signed(open_pairs(lane)) + change);
        if signed(open_pairs(lane)) + change = 0 then
          some_open(lane) <= '0';
        else
          some_open(lane) <= '1';
        end if;
        if reset = '1' then
          opened(lane) <= '0';
          dropped_one(lane) <= '0';
          answered_one(lane) <= '0';
          open_pairs(lane) <= (others => '0');
          some_open(lane) <= '0';
        end if;
      end loop;
      if moves = '1' then
        head_valid <= next_valid or passes;
      end if;
      if (moves or not next_valid) = '1' then
        next_valid <= read_valid;
      end if;
      read_valid <= (front_waits and fetches) or (read_valid and next_valid and not moves);
      if front_ending = '1' then
        head_valid <= '0';
        next_valid <= '0';
        read_valid <= '0';
      end if;
      oldest_full <= '0';
      if (full and oldest_flags) /= nobody then
        oldest_full <= not reset;
      end if;
      asked_one <= asked and not reset;
      left_of_last := of_last;
      left_of_front := of_front;
      if (triangles_taken and some_of_last) = '1' then
        left_of_last := of_last - 1;
      end if;
      if asked_one = '1' and (triangles_taken = '0' or some_of_last = '1') then
        left_of_front := of_front + 1;
      elsif asked_one = '0' and triangles_taken = '1' and some_of_last = '0' then
        left_of_front := of_front - 1;
      end if;
      if (offers_pose and pose_ready) = '1' then
        has_pose <= '1';
      end if;
      advances <= may_advance and not advances and not ends_front;
      some_of_last <= last_left;
      next_of := front_lane;
      if last_left = '1' then
        next_of := last_lane;
      end if;
      if (advances or ends_front) = '1' then
        left_of_last := left_of_front;
        left_of_front := (others => '0');
        some_of_last <= front_left;
        last_lane <= front_lane;
        front_lane <= next_lane;
        is_front <= rotated(is_front);
        has_pose <= '0';
      end if;
      if advances = '1' and retire = '0' then
        front_is_oldest <= '0';
      elsif advances = '0' and retire = '1' and front_is_oldest = '0' and front_lane = unsigned(oldest) + 1 then
        front_is_oldest <= '1';
      end if;
      if reset = '1' then
        left_of_last := (others => '0');
        left_of_front := (others => '0');
        some_of_last <= '0';
        front_lane <= unsigned(oldest);
        is_front <= oldest_flags;
        front_is_oldest <= '1';
        next_of := unsigned(oldest);
        has_pose <= '0';
        advances <= '0';
        head_valid <= '0';
        next_valid <= '0';
        read_valid <= '0';
      end if;
      triangles_of <= next_of;
      drops_them <= ending(to_integer(next_of)) and not reset;
      of_last <= left_of_last;
      of_front <= left_of_front;
    end if;
  end process count;
end architecture rtl;
