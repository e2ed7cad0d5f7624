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
    job_flags : out lane_flags;  -- the same, a flag for each lane
    stop : in std_logic;
    stop_number : in std_logic_vector(23 downto 0);
    -- The first words of the query that is admitted next.
    checked_lane : out std_logic_vector(lane_bits - 1 downto 0);
    checked : in std_logic_vector(head_bits - 1 downto 0);
    -- The queries in flight.
    busy : out std_logic;  -- a clock ago there was one, or a report, or a job was being taken
    running : out std_logic;  -- there is one, or the report of another job
    oldest : out std_logic_vector(lane_bits - 1 downto 0);
    oldest_flags : out lane_flags;  -- the same, a flag for each lane
    counting : out lane_flags;  -- lanes with a query that is not reported yet
    posed : out lane_flags;  -- lanes with a pose for the triangle unit
    started : out lane_flags;
    ending : out lane_flags;  -- no query runs there, or it has a reason to end
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
    idle : in lane_flags;  -- nothing was to be done any more, a clock ago
    contact : in std_logic;  -- of the oldest query
    limit_reached : in lane_flags;
    bad_tree : in lane_flags;
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
  constant no_lane : lane_flags := (others => '0');
  constant all_lanes : lane_flags := (others => '1');
  subtype lane_number is unsigned(lane_bits - 1 downto 0);

  -- Lanes, in turn: from the oldest to where the next job goes.
  signal oldest_lane : lane_number := (others => '0');
  signal is_oldest : lane_flags := (0 => '1', others => '0');  -- the same, a flag for each lane
  signal next_lane : lane_number := (others => '0');  -- of the next job
  signal is_next : lane_flags := (0 => '1', others => '0');
  signal occupied : lane_flags := (others => '0');
  signal asked : lane_flags := (others => '0');  -- by a query, and not by another job
  signal has_pose : lane_flags := (others => '0');
  signal admitted : lane_flags := (others => '0');  -- checked, and started if it is a query that can be
  signal unadmitted : lane_flags;
  signal started_now : lane_flags := (others => '0');
  signal stopped : lane_flags;  -- a stop was for it
  signal shorts : lane_flags := (others => '0');
  type lane_reasons is array (0 to lanes - 1) of std_logic_vector(4 downto 0);
  signal reasons : lane_reasons := (others => fine);
  signal sound : lane_flags := (others => '0');  -- the reason is fine
  -- A reason to end that was found a clock ago.
  signal found : lane_flags := (others => '0');
  signal found_reasons : lane_reasons := (others => fine);
  signal not_reported : lane_flags;  -- lanes with a query that is not reported yet
  -- What follows from these, each in a register of its own, because it is read in many places.
  signal running_now : std_logic := '0';
  signal busy_now : std_logic := '0';  -- a clock ago there was a query or another job, or one was being taken
  signal ending_now : lane_flags := (others => '1');
  signal drops : lane_flags := (others => '0');  -- a clock ago a query ran there, and had a reason to end

  -- Jobs, and what admits a query.
  signal taken : std_logic;
  signal all_idle : std_logic;  -- a clock ago: a pair of a packet ends it two clocks before a job can come behind that
  signal idle_is_old : std_logic := '0';  -- a job was taken or the oldest query reported in the clock before: idle is of that clock
  signal job_due : std_logic;
  signal admission_busy : std_logic;
  signal admits : lane_flags;  -- the lane of a query that is admitted
  signal starts : std_logic;
  signal refused : std_logic_vector(4 downto 0);  -- why it does not start
  signal started_pulse : std_logic;

  -- The end of the oldest query.
  signal reporting : std_logic := '0';
  signal retires : std_logic;
  signal here : lane_flags;  -- the lane of the oldest, if it is admitted
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
  job_lane <= std_logic_vector(next_lane);
  job_flags <= is_next;
  running <= running_now;
  busy <= busy_now;
  oldest <= std_logic_vector(oldest_lane);
  oldest_flags <= is_oldest;
  posed <= has_pose;
  started <= started_now;
  ending <= ending_now;
  dropping <= drops(to_integer(oldest_lane));
  start <= started_pulse;
  retire <= retires;
  retires <= reporting and report_done;
  report_due <= reporting;
  short <= '0' when (shorts and is_oldest) = no_lane else '1';

  tell : for digit in 0 to 4 generate
    signal has_bit : lane_flags;
  begin
    lanes_with_bit : for lane in 0 to lanes - 1 generate
      has_bit(lane) <= reasons(lane)(digit) and is_oldest(lane);
    end generate lanes_with_bit;
    reason(digit) <= '0' when has_bit = no_lane else '1';
  end generate tell;
{%- if e.axi %}
  aborts <= fails and not (reset or forget);
  abort <= aborting;
{%- else %}
  abort <= '0';
{%- endif %}

  -- ===== Jobs =====
  -- A query is taken beside others, another job alone.
  job_due <= job_valid and all_idle when occupied = no_lane else
    job_valid and job_query when (asked and is_oldest) /= no_lane and (occupied and is_next) = no_lane else '0';
  unadmitted <= occupied and not admitted;

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

  admission : entity work.{{ prefix }}engine_admission
    port map (
      clk => clk,
      reset => reset,
      forget => forget,
      job_due => job_due,
      job_query => job_query,
      taken => taken,
      stored => job_stored,
      next_lane => next_lane,
      next_flags => is_next,
      oldest => oldest_lane,
      oldest_flags => is_oldest,
      unadmitted => unadmitted,
      busy => admission_busy,
      checked_lane => checked_lane,
      checked => checked,
      most_expansions => most_expansions,
      admits => admits,
      starts => starts,
      refused => refused,
      start => started_pulse,
      start_lane => start_lane{% if e.axi %},
      aborting => aborting,
      memory_draining => memory_draining,
      memory_silent => memory_silent,
{%- if e.engines.several %}
      renew => renew,
{%- endif %}
      flush => flush,
      flushing => flushing{% endif %}
    );

  -- ===== From job to report =====
  proceed : process (clk)
    variable next_oldest : lane_number;
    variable next_is_oldest : lane_flags;
    variable now_occupied : lane_flags;
    variable now_started : lane_flags;
    variable now_reasons : lane_reasons;
    variable now_sound : lane_flags;
    variable now_reporting : std_logic;
  begin
    if rising_edge(clk) then
      next_oldest := oldest_lane;
      next_is_oldest := is_oldest;
      now_occupied := occupied;
      now_started := started_now;
      now_reasons := reasons;
      now_sound := sound;
      now_reporting := reporting;
      idle_is_old <= taken or retires;
{%- if e.axi %}
      reads_before <= reads;
      error_before <= memory_error;
      silent_before <= memory_silent;
      aborting <= fails and not (reset or forget);
{%- endif %}

      -- Jobs, and the query that is admitted.
      if taken = '1' then
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
      end if;
      for lane in 0 to lanes - 1 loop
        if admits(lane) = '1' then
          admitted(lane) <= '1';
          now_started(lane) := starts;
          if starts = '0' then
            now_reasons(lane) := refused;
            now_sound(lane) := '0';
          end if;
        end if;
      end loop;

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
{%- endif %}
      elsif done = '1'{% if e.axi %} and fails = '0'{% endif %} then
        now_reporting := '1';
      end if;

      -- Told before what is forgotten is, which then is not in the way of all this.
      running_now <= '0';
      if now_occupied /= no_lane then
        running_now <= '1';
      end if;
      -- Not later than the job that is taken stops to wait.
      busy_now <= '0';
      if occupied /= no_lane or admission_busy = '1' then
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
        now_reporting := '0';
        now_occupied := no_lane;
        now_started := no_lane;
        admitted <= no_lane;
        has_pose <= no_lane;
        -- One report for all that is forgotten, in the lane of the oldest.
        next_oldest := oldest_lane;
        next_is_oldest := is_oldest;
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
          next_lane <= oldest_lane + 1;
          is_next <= rotated(is_oldest);
        end if;
      end if;

      oldest_lane <= next_oldest;
      is_oldest <= next_is_oldest;
      occupied <= now_occupied;
      started_now <= now_started;
      reasons <= now_reasons;
      sound <= now_sound;
      reporting <= now_reporting;
    end if;
  end process proceed;
end architecture rtl;
