--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The queries in flight, from job to report, each in a lane of its own; lanes are taken in turn. A job is taken when a lane is
-- free; then its words are in engine_queries. A query is admitted in its turn: it is checked, and its traversal starts. The
-- oldest query is reported when all of it is done, or dropped, and its lane is free again. A job that is no query has a lane
-- alone, without a start.
--
-- Reasons: 0 complete, 1 stopped at a certain contact, 2 limit of expansions, 3 bad tree, 4 memory error, 5 stopped by the host,
-- 9 memory does not answer, 10 soft reset; those of packets that are no query come with the job. A stop ends the oldest query with
-- its number, or else the job that waits, as soon as it runs. After a soft reset there is one report, whatever was forgotten.
{%- if e.axi %}
-- What memory does wrong ends the oldest query that still reads. All work is forgotten then, and the younger queries, of which no
-- pair was answered yet, are admitted once more.
{%- endif %}
-- While no query runs, pairs of packets may be in the triangle unit: a job waits for them.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_control is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forget : in std_logic;  -- a soft reset
    forget_number : in std_logic_vector(23 downto 0);
    job_valid : in std_logic;
    job_taken : out std_logic;
    job_stored : out std_logic;  -- the same, for the memories of the queries
    job_query : in std_logic;
    job_posed : in std_logic;
    job_short : in std_logic;
    job_reason : in std_logic_vector(4 downto 0);
    job_number : in std_logic_vector(23 downto 0);
    job_lane : out std_logic_vector(lane_bits - 1 downto 0);  -- that it gets
    job_flags : out std_logic_vector(lanes - 1 downto 0);  -- the same, a flag for each lane
    stop : in std_logic;
    stop_number : in std_logic_vector(23 downto 0);
    -- The first words of the query that is admitted next.
    checked_lane : out std_logic_vector(lane_bits - 1 downto 0);
    checked : in std_logic_vector(head_bits - 1 downto 0);
    -- The queries in flight.
    busy : out std_logic;  -- a clock ago there was one, or a report, or a job was being taken
    running : out std_logic;  -- there is one, or the report of another job
    oldest : out std_logic_vector(lane_bits - 1 downto 0);
    oldest_flags : out std_logic_vector(lanes - 1 downto 0);  -- the same, a flag for each lane
    counting : out std_logic_vector(lanes - 1 downto 0);  -- lanes with a query that is not reported yet
    posed : out std_logic_vector(lanes - 1 downto 0);  -- lanes with a pose for the triangle unit
    started : out std_logic_vector(lanes - 1 downto 0);
    ending : out std_logic_vector(lanes - 1 downto 0);  -- no query runs there, or it has a reason to end
    dropping : out std_logic;  -- the oldest query had a reason to end a clock ago: its pairs are dropped
    start : out std_logic;  -- one clock long
    start_lane : out std_logic_vector(lane_bits - 1 downto 0);
    most_expansions : out std_logic_vector(31 downto 0);  -- of the query that starts
{%- if e.axi %}
    aborts : out std_logic;  -- the next clock is that of abort
{%- endif %}
    abort : out std_logic;  -- one clock long: all work is forgotten after a memory error
    retire : out std_logic;  -- one clock long: the oldest query is done
    -- How it goes.
    idle : in std_logic_vector(lanes - 1 downto 0);  -- nothing was to be done any more, a clock ago
    contact : in std_logic;  -- of the oldest query
    limit_reached : in std_logic_vector(lanes - 1 downto 0);
    bad_tree : in std_logic_vector(lanes - 1 downto 0);
{%- if e.axi %}
    reads : in std_logic;  -- the oldest query may still need memory
    memory_error : in std_logic;  -- until abort
    memory_draining : in std_logic;  -- old bursts are under way: nothing can be read
    memory_silent : in std_logic;  -- memory does not answer
{%- if e.engines.several %}
    renew : in std_logic;  -- one clock long: the caches are emptied before the next query
{%- endif %}
    flush : out std_logic;  -- one clock long: the caches are emptied
    flushing : in std_logic;
{%- endif %}
    report_due : out std_logic;
    report_done : in std_logic;
    short : out std_logic;  -- the report is one word
    reason : out std_logic_vector(4 downto 0);
    number : out std_logic_vector(23 downto 0)
  );
end entity {{ prefix }}engine_control;

architecture rtl of {{ prefix }}engine_control is
  constant fine : std_logic_vector(4 downto 0) := reason_complete;
  subtype flags is std_logic_vector(lanes - 1 downto 0);
  constant no_lane : flags := (others => '0');
  constant all_lanes : flags := (others => '1');
  subtype lane_number is unsigned(lane_bits - 1 downto 0);

  -- Flags of lanes, each with that of the lane before.
  function rotated(flag : flags) return flags is
    variable turned : flags;
  begin
    for lane in 0 to lanes - 1 loop
      turned(lane) := flag((lane + lanes - 1) mod lanes);
    end loop;
    return turned;
  end function rotated;

  -- Lanes, in turn: from the oldest to where the next job goes.
  signal oldest_lane : lane_number := (others => '0');
  signal is_oldest : flags := (0 => '1', others => '0');  -- the same, a flag for each lane
  signal admitted_lane : lane_number := (others => '0');  -- that is admitted next
  signal is_candidate : flags := (0 => '1', others => '0');  -- the same, a flag for each lane
  signal next_lane : lane_number := (others => '0');  -- of the next job
  signal is_next : flags := (0 => '1', others => '0');
  signal occupied : flags := (others => '0');
  signal asked : flags := (others => '0');  -- by a query, and not by another job
  signal has_pose : flags := (others => '0');
  signal admitted : flags := (others => '0');  -- checked, and started if it is a query that can be
  signal started_now : flags := (others => '0');
  signal stopped : flags;  -- a stop was for it
  signal shorts : flags := (others => '0');
  type lane_reasons is array (0 to lanes - 1) of std_logic_vector(4 downto 0);
  signal reasons : lane_reasons := (others => fine);
  signal sound : flags := (others => '0');  -- the reason is fine
  -- A reason to end that was found a clock ago.
  signal found : flags := (others => '0');
  signal found_reasons : lane_reasons := (others => fine);
  signal not_reported : flags;  -- lanes with a query that is not reported yet
  -- What follows from these, each in a register of its own, because it is read in many places.
  signal running_now : std_logic := '0';
  signal busy_now : std_logic := '0';  -- a clock ago there was a query or another job, or one was being taken
  signal ending_now : flags := (others => '1');
  signal drops : flags := (others => '0');  -- a clock ago a query ran there, and had a reason to end

  -- Jobs and what admits a query.
  type phase_state is (waiting_state, take_state, check_state, {% if e.axi %}flush_state, {% endif %}admit_state);
  signal phase : phase_state := waiting_state;
  signal taken : std_logic := '0';
  -- The same in a register of its own, because hundreds of cells are written by it. Another first value keeps tools from making one of
  -- both; what is stored in the first clock means nothing.
  signal stored : std_logic := '1';
  signal all_idle : std_logic;  -- a clock ago: a pair of a packet ends it two clocks before a job can come behind that
  signal idle_is_old : std_logic := '0';  -- a job was taken or the oldest query reported in the clock before: idle is of that clock
  signal job_due : std_logic;
  signal job_found : std_logic := '0';  -- a clock ago; nothing but its taking ends that
  signal admits : std_logic;  -- a query is to be checked
  signal checks : unsigned(1 downto 0) := "00";
  -- What the check came to, a clock before its query is admitted.
  signal starts : std_logic := '0';
  signal refused : std_logic_vector(4 downto 0) := fine;  -- why it does not start
  signal started_pulse : std_logic := '0';
  signal started_lane : lane_number := (others => '0');
  signal load_check : std_logic;
{%- if e.axi %}
  signal known : std_logic := '0';  -- the caches are those of the query that was checked last
  constant no_place : std_logic_vector(4 downto 0) := (others => '0');
  signal moved : std_logic_vector(4 downto 0);
  signal flush_now : std_logic := '0';
{%- endif %}
  signal outside : std_logic_vector(3 downto 0);
  signal empty : std_logic;

  -- The end of the oldest query.
  signal reporting : std_logic := '0';
  signal retires : std_logic;
  signal here : flags;  -- the lane of the oldest, if it is admitted
  signal done : std_logic;  -- all of it is
{%- if e.axi %}
  signal reads_before : std_logic := '0';
  signal error_before : std_logic := '0';
  signal silent_before : std_logic := '0';
  signal fails : std_logic;  -- it reads, and memory has failed
  signal aborting : std_logic := '0';
{%- endif %}
begin
  all_idle <= '1' when idle = all_lanes else '0';
  job_taken <= taken;
  job_stored <= stored;
  job_lane <= std_logic_vector(next_lane);
  job_flags <= is_next;
  checked_lane <= std_logic_vector(admitted_lane);
  running <= running_now;
  busy <= busy_now;
  oldest <= std_logic_vector(oldest_lane);
  oldest_flags <= is_oldest;
  posed <= has_pose;
  started <= started_now;
  ending <= ending_now;
  dropping <= drops(to_integer(oldest_lane));
  start <= started_pulse;
  start_lane <= std_logic_vector(started_lane);
  retire <= retires;
  retires <= reporting and report_done;
  report_due <= reporting;
  short <= '0' when (shorts and is_oldest) = no_lane else '1';

  tell : for digit in 0 to 4 generate
    signal has_bit : flags;
  begin
    lanes_with_bit : for lane in 0 to lanes - 1 generate
      has_bit(lane) <= reasons(lane)(digit) and is_oldest(lane);
    end generate lanes_with_bit;
    reason(digit) <= '0' when has_bit = no_lane else '1';
  end generate tell;
{%- if e.axi %}
  aborts <= fails and not (reset or forget);
  abort <= aborting;
  flush <= flush_now;
{%- else %}
  abort <= '0';
{%- endif %}

  -- ===== Jobs =====
  -- A query is taken beside others, another job alone.
  job_due <= job_valid and all_idle when occupied = no_lane else
    job_valid and job_query when (asked and is_oldest) /= no_lane and (occupied and is_next) = no_lane else '0';
  admits <= '0' when (occupied and is_candidate and not admitted) = no_lane else '1';

  here <= admitted and is_oldest;
  -- What has just begun was idle a clock ago.
  done <= not (started_pulse or idle_is_old) when (here and idle) /= no_lane else '0';
{%- if e.axi %}
  fails <= reads_before and (error_before or silent_before) and not (reporting or aborting)
    when (started_now and is_oldest) /= no_lane else '0';
{%- endif %}

  by_lane : for lane in 0 to lanes - 1 generate
    not_reported(lane) <= occupied(lane) and asked(lane) when reporting = '0' or is_oldest(lane) = '0' else '0';
  end generate by_lane;
  counting <= not_reported;

  stops : entity work.{{ prefix }}engine_stop
    port map (
      clk => clk,
      reset => reset,
      forget => forget,
      forget_number => forget_number,
      job_valid => job_valid,
      job_query => job_query,
      job_number => job_number,
      job_taken => taken,
      job_flags => is_next,
      stop => stop,
      stop_number => stop_number,
      oldest => oldest_lane,
      oldest_flags => is_oldest,
      counting => not_reported,
      retire => retires,
      number => number,
      stopped => stopped
    );

  -- ===== Checks =====
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

  -- ===== From job to report =====
  proceed : process (clk)
    variable next_phase : phase_state;
    variable next_oldest : lane_number;
    variable next_is_oldest : flags;
    variable now_occupied : flags;
    variable now_started : flags;
    variable now_reasons : lane_reasons;
    variable now_sound : flags;
    variable now_reporting : std_logic;
    variable now_taken : std_logic;  -- take_state comes, told apart from what follows in the other states
  begin
    if rising_edge(clk) then
      next_phase := phase;
      next_oldest := oldest_lane;
      next_is_oldest := is_oldest;
      now_occupied := occupied;
      now_started := started_now;
      now_reasons := reasons;
      now_sound := sound;
      now_reporting := reporting;
      started_pulse <= '0';
      started_lane <= admitted_lane;
      idle_is_old <= taken or retires;
{%- if e.axi %}
      reads_before <= reads;
      error_before <= memory_error;
      silent_before <= memory_silent;
{%- endif %}
{%- if e.axi %}
      flush_now <= '0';
      aborting <= fails and not (reset or forget);
{%- endif %}

      -- Jobs, and the query that is admitted next.
      job_found <= '0';
      now_taken := '0';
      if phase = waiting_state then
        checks <= "00";
        if admits = '1' then
          next_phase := check_state;
        elsif job_found = '1' then
          next_phase := take_state;
          now_taken := '1';
        end if;
        job_found <= job_due and not (admits or job_found);
      elsif phase = take_state then
        next_phase := waiting_state;
        if job_query = '1' then
          next_phase := check_state;
        end if;
        next_lane <= next_lane + 1;
        is_next <= rotated(is_next);
        for lane in 0 to lanes - 1 loop
          if is_next(lane) = '1' then
            now_occupied(lane) := '1';
            now_reasons(lane) := job_reason;
            now_sound(lane) := '0';
            if job_reason = fine then
              now_sound(lane) := '1';
            end if;
            shorts(lane) <= job_short;
            asked(lane) <= job_query;
            has_pose(lane) <= job_posed;
            admitted(lane) <= not job_query;
          end if;
        end loop;
        if job_query = '0' then
          admitted_lane <= next_lane + 1;
          is_candidate <= rotated(is_next);
        end if;
      elsif phase = check_state then
        checks <= checks + 1;
        starts <= '0';
        if checks = "11" then
          next_phase := admit_state;
          if outside /= "0000" then
            refused <= reason_memory;
{%- if e.axi %}
            known <= '0';
{%- endif %}
          elsif empty = '1' then
            refused <= reason_bad_tree;
{%- if e.axi %}
            known <= '0';
          elsif moved /= no_place then
            -- Not before the queries that read what is in the caches are done.
            checks <= checks;
            next_phase := check_state;
            if admitted_lane = oldest_lane then
              flush_now <= '1';
              next_phase := flush_state;
            end if;
{%- endif %}
          else
            starts <= '1';
          end if;
        end if;
{%- if e.axi %}
      elsif phase = flush_state then
        known <= '1';
        refused <= reason_silent;
        -- The caches say that they are at it from the clock after flush on.
        if memory_draining = '1' then
          if memory_silent = '1' then
            known <= '0';
            next_phase := admit_state;
          end if;
        elsif flush_now = '0' and flushing = '0' then
          starts <= '1';
          next_phase := admit_state;
        end if;
{%- endif %}
      else
        next_phase := waiting_state;
        admitted_lane <= admitted_lane + 1;
        is_candidate <= rotated(is_candidate);
        started_pulse <= starts;
        for lane in 0 to lanes - 1 loop
          if is_candidate(lane) = '1' then
            admitted(lane) <= '1';
            now_started(lane) := starts;
            if starts = '0' then
              now_reasons(lane) := refused;
              now_sound(lane) := '0';
            end if;
          end if;
        end loop;
      end if;

      -- Reasons to end are found in one clock and taken in the next; that of the oldest stays from its report on.
      for lane in 0 to lanes - 1 loop
        found(lane) <= '0';
        found_reasons(lane) <= reason_stopped;
        if limit_reached(lane) = '1' then
          found_reasons(lane) <= reason_limit;
        end if;
        if contact = '1' and is_oldest(lane) = '1' then
          found_reasons(lane) <= reason_contact;
        end if;
        if bad_tree(lane) = '1' then
          found_reasons(lane) <= reason_bad_tree;
        end if;
        if is_oldest(lane) = '0' or (reporting or done) = '0' then
          found(lane) <= bad_tree(lane) or (contact and is_oldest(lane)) or limit_reached(lane) or stopped(lane);
        end if;
        if (found(lane) and started_now(lane) and sound(lane)) = '1' then
          now_reasons(lane) := found_reasons(lane);
          now_sound(lane) := '0';
        end if;
      end loop;

      -- The oldest query.
      if reporting = '1' then
        if report_done = '1' then
          now_reporting := '0';
          next_oldest := oldest_lane + 1;
          next_is_oldest := rotated(is_oldest);
          for lane in 0 to lanes - 1 loop
            if is_oldest(lane) = '1' then
              now_occupied(lane) := '0';
              now_started(lane) := '0';
              admitted(lane) <= '0';
              has_pose(lane) <= '0';
            end if;
          end loop;
        end if;
{%- if e.axi %}
      elsif aborting = '1' then
        -- What memory still answers is drained behind the report.
        now_reporting := '1';
        known <= '0';
        next_phase := waiting_state;
        now_taken := '0';
        started_pulse <= '0';
        for lane in 0 to lanes - 1 loop
          if is_oldest(lane) = '0' then
            admitted(lane) <= '0';
            now_started(lane) := '0';
            now_reasons(lane) := fine;
            now_sound(lane) := '1';
          elsif sound(lane) = '1' then
            now_sound(lane) := '0';
            now_reasons(lane) := reason_silent;
            if error_before = '1' then
              now_reasons(lane) := reason_memory;
            end if;
          end if;
        end loop;
        admitted_lane <= oldest_lane + 1;
        is_candidate <= rotated(is_oldest);
{%- endif %}
      elsif done = '1'{% if e.axi %} and fails = '0'{% endif %} then
        now_reporting := '1';
      end if;
{%- if e.engines.several %}
      if renew = '1' then
        known <= '0';
      end if;
{%- endif %}

      -- Told before what is forgotten is, which then is not in the way of all this.
      running_now <= '0';
      if now_occupied /= no_lane then
        running_now <= '1';
      end if;
      -- Not later than the job that is taken stops to wait.
      busy_now <= '0';
      if occupied /= no_lane or phase /= waiting_state then
        busy_now <= '1';
      end if;
      for lane in 0 to lanes - 1 loop
        ending_now(lane) <= not (now_started(lane) and now_sound(lane));
        drops(lane) <= started_now(lane) and not sound(lane);
      end loop;

      if (reset or forget) = '1' then
        running_now <= not reset;
        busy_now <= not reset;
        ending_now <= all_lanes;
        drops <= no_lane;
        next_phase := waiting_state;
        now_taken := '0';
        job_found <= '0';
        now_reporting := '0';
        now_occupied := no_lane;
        now_started := no_lane;
        admitted <= no_lane;
        has_pose <= no_lane;
        started_pulse <= '0';
{%- if e.axi %}
        known <= '0';
        flush_now <= '0';
{%- endif %}
        -- One report for all that is forgotten, in the lane of the oldest.
        next_oldest := oldest_lane;
        next_is_oldest := is_oldest;
        admitted_lane <= oldest_lane;
        is_candidate <= is_oldest;
        next_lane <= oldest_lane;
        is_next <= is_oldest;
        if reset = '0' then
          for lane in 0 to lanes - 1 loop
            if is_oldest(lane) = '1' then
              now_occupied(lane) := '1';
              asked(lane) <= '0';
              admitted(lane) <= '1';
              shorts(lane) <= '0';
              now_reasons(lane) := reason_reset;
              now_sound(lane) := '0';
            end if;
          end loop;
          admitted_lane <= oldest_lane + 1;
          is_candidate <= rotated(is_oldest);
          next_lane <= oldest_lane + 1;
          is_next <= rotated(is_oldest);
        end if;
      end if;

      phase <= next_phase;
      oldest_lane <= next_oldest;
      is_oldest <= next_is_oldest;
      occupied <= now_occupied;
      started_now <= now_started;
      reasons <= now_reasons;
      sound <= now_sound;
      reporting <= now_reporting;
      taken <= now_taken;
      stored <= now_taken;
    end if;
  end process proceed;
end architecture rtl;
