--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Pairs of leaves between the traversal and their answers: a queue of {{ e.traversal.pairs }} pairs of numbers, the request of their
-- triangles, and the count of pairs that are not answered yet. When the query ends early, pairs that have not reached the
-- triangle unit are dropped.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}engine_pairs is
  port (
    clk : in std_logic;
    reset : in std_logic;
    ending : in std_logic;
    pair_valid : in std_logic;
    pair_ready : out std_logic;
    pair_a : in std_logic_vector(27 downto 0);
    pair_b : in std_logic_vector(27 downto 0);
    request_valid : out std_logic;
    request_ready : in std_logic;
    request_a : out std_logic_vector(27 downto 0);
    request_b : out std_logic_vector(27 downto 0);
    triangles_valid : in std_logic;
    triangles_ready : in std_logic;  -- of who takes them
    triangles_taken : out std_logic;
    sent : in std_logic;  -- while no query runs: a pair of a packet goes to the unit
    answered : in std_logic;  -- one pair more
    idle : out std_logic  -- every pair is answered or dropped
  );
end entity {{ prefix }}engine_pairs;

architecture rtl of {{ prefix }}engine_pairs is
  constant places : natural := {{ e.traversal.pairs }};
  constant place_bits : natural := {{ e.traversal.pair_bits }};
  constant open_bits : natural := {{ e.traversal.open_bits }};
  type pairs is array (0 to places - 1) of std_logic_vector(55 downto 0);
  signal queue : pairs := (others => (others => '0'));
  signal written : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal fetched : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal waiting : unsigned(place_bits downto 0) := (others => '0');  -- in the queue
  signal full : std_logic := '0';
  signal head : std_logic_vector(55 downto 0) := (others => '0');
  signal head_valid : std_logic := '0';
  signal head_leaves : std_logic;
  signal fetches : std_logic;
  signal accepts : std_logic;
  signal opens : std_logic;  -- one pair more has to be answered
  signal drops : std_logic;
  signal asks : std_logic;
  signal open_pairs : unsigned(open_bits - 1 downto 0) := (others => '0');
  signal idle_now : std_logic := '1';  -- clear as soon as a pair has come
begin
  accepts <= pair_valid and not full;
  opens <= accepts or sent;
  pair_ready <= not full;
  asks <= head_valid and not ending;
  request_valid <= asks;
  request_a <= head(55 downto 28);
  request_b <= head(27 downto 0);
  drops <= triangles_valid and ending;
  triangles_taken <= triangles_valid and (ending or triangles_ready);
  head_leaves <= head_valid and (ending or request_ready);
  fetches <= '1' when waiting /= 0 and (head_valid = '0' or head_leaves = '1') else '0';
  idle <= idle_now;

  remember : process (clk)
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        queue(to_integer(written)) <= pair_a & pair_b;
      end if;
      if fetches = '1' then
        head <= queue(to_integer(fetched));
      end if;
    end if;
  end process remember;

  count : process (clk)
    variable change : integer range -3 to 1;
  begin
    if rising_edge(clk) then
      change := 0;
      if opens = '1' then
        change := change + 1;
      end if;
      if (head_leaves and ending) = '1' then
        change := change - 1;
      end if;
      if drops = '1' then
        change := change - 1;
      end if;
      if answered = '1' then
        change := change - 1;
      end if;
      if reset = '1' then
        written <= (others => '0');
        fetched <= (others => '0');
        waiting <= (others => '0');
        full <= '0';
        head_valid <= '0';
        open_pairs <= (others => '0');
        idle_now <= '1';
      else
        open_pairs <= unsigned(signed(open_pairs) + change);
        if opens = '1' then
          idle_now <= '0';
        elsif open_pairs = 0 then
          idle_now <= '1';
        end if;
        if accepts = '1' then
          written <= written + 1;
        end if;
        if fetches = '1' then
          fetched <= fetched + 1;
        end if;
        if fetches = '1' or head_leaves = '1' then
          head_valid <= fetches;
        end if;
        if accepts = '1' and fetches = '0' then
          waiting <= waiting + 1;
          if waiting = places - 1 then
            full <= '1';
          end if;
        elsif accepts = '0' and fetches = '1' then
          waiting <= waiting - 1;
          full <= '0';
        end if;
      end if;
    end if;
  end process count;
end architecture rtl;
