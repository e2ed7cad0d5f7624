--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- From job to start. A job that can be taken is taken, if no query waits for its check. Queries are checked one at a time, in the
-- order of their lanes, and started or refused. After a soft reset no query waits.
{%- if e.axi %}
-- After a memory error those behind the oldest wait once more. A query about other objects than the one before it waits until it
-- is the oldest; then the caches are emptied.
{%- endif %}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_admission is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forget : in std_logic;  -- a soft reset
    job_due : in std_logic;  -- a job waits that can be taken
    job_query : in std_logic;
    taken : out std_logic;  -- one clock long: the job is
    stored : out std_logic;  -- the same, for the memories of the queries
    -- Lanes: of the next job, of the oldest query, and of those that are to be admitted.
    next_lane : in unsigned(lane_bits - 1 downto 0);
    next_flags : in lane_flags;
    oldest : in unsigned(lane_bits - 1 downto 0);
    oldest_flags : in lane_flags;
    unadmitted : in lane_flags;
    busy : out std_logic;  -- a job is being taken, or a query checked
    -- The first words of the query that is admitted next.
    checked_lane : out std_logic_vector(lane_bits - 1 downto 0);
    checked : in std_logic_vector(head_bits - 1 downto 0);
    most_expansions : out std_logic_vector(31 downto 0);  -- of the query that starts
    admits : out lane_flags;  -- its lane, one clock long
    starts : out std_logic;  -- in that clock: it starts
    refused : out std_logic_vector(4 downto 0);  -- or why not
    start : out std_logic;  -- one clock long, behind that clock
    start_lane : out std_logic_vector(lane_bits - 1 downto 0){% if e.axi %};
    aborting : in std_logic;  -- one clock long: all work is forgotten after a memory error
    memory_draining : in std_logic;  -- old bursts are under way: nothing can be read
    memory_silent : in std_logic;  -- memory does not answer
{%- if e.engines.several %}
    renew : in std_logic;  -- one clock long: the caches are emptied before the next query
{%- endif %}
    flush : out std_logic;  -- one clock long: the caches are emptied
    flushing : in std_logic{% endif %}
  );
end entity {{ prefix }}engine_admission;

architecture rtl of {{ prefix }}engine_admission is
  constant no_lane : lane_flags := (others => '0');
  type phase_state is (waiting_state, take_state, check_state, {% if e.axi %}flush_state, {% endif %}admit_state);
  signal phase : phase_state := waiting_state;
  signal taken_now : std_logic := '0';
  -- The same in a register of its own, because hundreds of cells are written by it. Another first value keeps tools from making one of
  -- both; what is stored in the first clock means nothing.
  signal stored_now : std_logic := '1';
  signal admitted_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');  -- that is admitted next
  signal is_candidate : lane_flags := (0 => '1', others => '0');  -- the same, a flag for each lane
  signal job_found : std_logic := '0';  -- a clock ago; but for errors and resets it is taken, and until then no query comes to wait
  signal waits : std_logic;  -- a query is to be checked
  signal checks : unsigned(1 downto 0) := "00";
  -- What the check came to, a clock before its query is admitted.
  signal starts_now : std_logic := '0';
  signal refused_now : std_logic_vector(4 downto 0) := reason_complete;
  signal started_pulse : std_logic := '0';
  signal started_lane : unsigned(lane_bits - 1 downto 0) := (others => '0');
  signal load_check : std_logic;
{%- if e.axi %}
  signal known : std_logic := '0';  -- the caches are those of the query that was checked last
  constant no_place : std_logic_vector(4 downto 0) := (others => '0');
  signal moved : std_logic_vector(4 downto 0);
  signal flush_now : std_logic := '0';
{%- endif %}
  signal outside : std_logic_vector(3 downto 0);
  signal empty : std_logic;
begin
  taken <= taken_now;
  stored <= stored_now;
  busy <= '0' when phase = waiting_state else '1';
  checked_lane <= std_logic_vector(admitted_lane);
  admits <= is_candidate when phase = admit_state else no_lane;
  starts <= starts_now;
  refused <= refused_now;
  start <= started_pulse;
  start_lane <= std_logic_vector(started_lane);
{%- if e.axi %}
  flush <= flush_now;
{%- endif %}
  waits <= '0' when (unadmitted and is_candidate) = no_lane else '1';
  load_check <= '1' when phase = check_state and checks = "01" else '0';

  check : entity work.{{ prefix }}engine_check
    port map (
      clk => clk,
      load => load_check,
      checked => checked,
{%- if e.axi %}
      known => known,
      moved => moved,
{%- endif %}
      most_expansions => most_expansions,
      outside => outside,
      empty => empty
    );

  proceed : process (clk)
    variable next_phase : phase_state;
    variable now_taken : std_logic;  -- take_state comes, told apart from what follows in the other states
  begin
    if rising_edge(clk) then
      next_phase := phase;
      now_taken := '0';
      job_found <= '0';
      started_pulse <= '0';
      started_lane <= admitted_lane;
{%- if e.axi %}
      flush_now <= '0';
{%- endif %}
      if phase = waiting_state then
        checks <= "00";
        if job_found = '1' then
          next_phase := take_state;
          now_taken := '1';
        elsif waits = '1' then
          next_phase := check_state;
        end if;
        job_found <= job_due and not (waits or job_found);
      elsif phase = take_state then
        next_phase := check_state;
        if job_query = '0' then
          next_phase := waiting_state;
          admitted_lane <= next_lane + 1;
          is_candidate <= rotated(next_flags);
        end if;
      elsif phase = check_state then
        checks <= checks + 1;
        starts_now <= '0';
        if checks = "11" then
          next_phase := admit_state;
          if outside /= "0000" then
            refused_now <= reason_memory;
{%- if e.axi %}
            known <= '0';
{%- endif %}
          elsif empty = '1' then
            refused_now <= reason_bad_tree;
{%- if e.axi %}
            known <= '0';
          elsif moved /= no_place then
            -- Not before the queries that read what is in the caches are done.
            checks <= checks;
            next_phase := check_state;
            if admitted_lane = oldest then
              flush_now <= '1';
              next_phase := flush_state;
            end if;
{%- endif %}
          else
            starts_now <= '1';
          end if;
        end if;
{%- if e.axi %}
      elsif phase = flush_state then
        known <= '1';
        refused_now <= reason_silent;
        -- The caches say that they are at it from the clock after flush on.
        if memory_draining = '1' then
          if memory_silent = '1' then
            known <= '0';
            next_phase := admit_state;
          end if;
        elsif flush_now = '0' and flushing = '0' then
          starts_now <= '1';
          next_phase := admit_state;
        end if;
{%- endif %}
      else
        next_phase := waiting_state;
        admitted_lane <= admitted_lane + 1;
        is_candidate <= rotated(is_candidate);
        started_pulse <= starts_now;
      end if;
{%- if e.axi %}
      if aborting = '1' then
        -- Queries that wait from now on are checked before a job is taken.
        next_phase := waiting_state;
        now_taken := '0';
        job_found <= '0';
        started_pulse <= '0';
        known <= '0';
        admitted_lane <= oldest + 1;
        is_candidate <= rotated(oldest_flags);
      end if;
{%- if e.engines.several %}
      if renew = '1' then
        known <= '0';
      end if;
{%- endif %}
{%- endif %}

      if (reset or forget) = '1' then
        next_phase := waiting_state;
        now_taken := '0';
        job_found <= '0';
        started_pulse <= '0';
{%- if e.axi %}
        known <= '0';
        flush_now <= '0';
{%- endif %}
        -- Behind a soft reset, the lane of the oldest has the report.
        admitted_lane <= oldest;
        is_candidate <= oldest_flags;
        if reset = '0' then
          admitted_lane <= oldest + 1;
          is_candidate <= rotated(oldest_flags);
        end if;
      end if;

      phase <= next_phase;
      taken_now <= now_taken;
      stored_now <= now_taken;
    end if;
  end process proceed;
end architecture rtl;
