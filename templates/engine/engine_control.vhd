--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The query that runs, from its job to its report: hands its pose to the triangle unit, keeps the rest in registers, starts
-- the traversal and finds out why it ends. Reasons: 0 complete, 1 stopped at a certain contact, 2 limit of expansions,
-- 3 bad tree, 4 memory error, 5 stopped by the host, 9 memory does not answer, 10 soft reset; those of packets that are no query
-- come with the job. A stop ends the query with its number that runs, or else the one that waits, as soon as it runs. After a soft
-- reset there is one report, whatever was forgotten. A pose alone is a job
-- that is done when the triangle unit has it. While no query runs, pairs of packets may be in the triangle unit: a job waits for
-- them.
--
-- The matrix for the origins of blocks is s1.17, cut off and saturated to +-(2^17 - 1); the shift is s4.22, cut off.
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
    job_query : in std_logic;
    job_posed : in std_logic;
    job_short : in std_logic;
    job_reason : in std_logic_vector(4 downto 0);
    job_number : in std_logic_vector(23 downto 0);
    job_words : in std_logic_vector(job_bits - 1 downto 0);
{%- if e.unit.signs.len() > 0 %}
    job_unfit : in std_logic;
    pose_unfit : out std_logic;  -- a number of the pose that holds is no sign extension
{%- endif %}
    stop : in std_logic;
    stop_number : in std_logic_vector(23 downto 0);
    -- The pose is taken from the words of the job.
    pose_valid : out std_logic;
    pose_ready : in std_logic;
    -- The running query.
    busy : out std_logic;  -- there is one, or its report
    running : out std_logic;  -- there is one
    start : out std_logic;
    ending : out std_logic;  -- no query runs, or it has a reason to end
    dropping : out std_logic;  -- a query runs and has a reason to end: its pairs are dropped
    abort : out std_logic;  -- one clock long: all is forgotten after a memory error
    block_base_a : out std_logic_vector(31 downto 0);  -- address / 64
    block_base_b : out std_logic_vector(31 downto 0);
    triangle_base_a : out std_logic_vector(31 downto 0);
    triangle_base_b : out std_logic_vector(31 downto 0);
    block_count_a : out std_logic_vector(31 downto 0) := (others => '0');
    block_count_b : out std_logic_vector(31 downto 0) := (others => '0');
    triangle_count_a : out std_logic_vector(31 downto 0) := (others => '0');
    triangle_count_b : out std_logic_vector(31 downto 0) := (others => '0');
    most_expansions : out std_logic_vector(31 downto 0);
    stop_at_contact : out std_logic;
    separate_too : out std_logic;  -- also while no query runs
    leaves_only : out std_logic;  -- no triangle test
    query_pose : out std_logic_vector(query_pose_bits - 1 downto 0);
    query_shift : out std_logic_vector(query_shift_bits - 1 downto 0);
    query_errors : out std_logic_vector(47 downto 0);
    query_rows : out std_logic_vector(query_rows_bits - 1 downto 0);
    -- How it goes.
    idle : in std_logic;  -- nothing is to be done any more
    contact : in std_logic;
    limit_reached : in std_logic;
    bad_tree : in std_logic;
{%- if e.axi %}
    memory_error : in std_logic;  -- until abort
    memory_draining : in std_logic;  -- old bursts are under way: nothing can be read
    memory_silent : in std_logic;  -- memory does not answer
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
  type phase_state is (waiting_state, take_state, check_state, {% if e.axi %}flush_state, {% endif %}run_state, {% if e.axi %}abort_state, {% endif %}report_state);
  signal phase : phase_state := waiting_state;
  -- What follows from phase and reason, each in a register of its own, because it is read in many places.
  signal taken : std_logic := '0';
  signal running_now : std_logic := '0';
  signal ending_now : std_logic := '1';
  signal dropping_now : std_logic := '0';
  signal report_due_now : std_logic := '0';
  signal idle_before : std_logic := '0';  -- idle, a clock ago: a pair of a packet ends it two clocks before a job can come behind that
  signal job_due : std_logic;  -- the job may be taken, once the unit has its pose
  signal checks : unsigned(1 downto 0) := "00";
  signal stopped : std_logic := '0';
  signal stopped_waiting : std_logic := '0';  -- the query that waits is to be stopped
  signal stops_running : std_logic;
  signal stops_waiting : std_logic;
  signal reason_now : std_logic_vector(4 downto 0) := fine;
  signal number_now : std_logic_vector(23 downto 0) := (others => '0');
  signal started : std_logic := '0';
  type places is array (0 to 3) of unsigned(31 downto 0);  -- blocks of A and B, triangles of A and B
  signal bases : places := (others => (others => '0'));
  signal counts : places := (others => (others => '0'));
{%- if e.axi %}
  signal known : std_logic := '0';  -- the caches are those of the bases
  signal moved : std_logic := '0';
  signal flush_now : std_logic := '0';
{%- endif %}
  signal outside : std_logic_vector(3 downto 0) := "0000";  -- the memory ends before the range
  signal empty : std_logic := '0';  -- a tree without a root
  type words is array (0 to 8) of std_logic_vector({{ e.query.entry }});
  signal entry : words;
  type matrix is array (0 to 8) of std_logic_vector({{ e.query.origin }});
  signal saturated : matrix;
  signal options : std_logic_vector(63 downto 0) := (others => '0');
begin
  -- The pose goes first, and a clock later the rest of the job.
  job_due <= job_valid and idle_before when phase = waiting_state else '0';
  pose_valid <= job_due and job_posed;
  job_taken <= taken;
  running <= running_now;
  busy <= '0' when phase = waiting_state and job_valid = '0' else '1';
  report_due <= report_due_now;
  start <= started;
  ending <= ending_now;
  dropping <= dropping_now;
{%- if e.axi %}
  abort <= '1' when phase = abort_state else '0';
  flush <= flush_now;
{%- else %}
  abort <= '0';
{%- endif %}
  reason <= reason_now;
  number <= number_now;
  stops_running <= stop and running_now when number_now = stop_number else '0';
  stops_waiting <= stop and job_valid and job_query and not stops_running when job_number = stop_number else '0';

  -- Entries of the matrix: cut off and saturated.
{%- for name in e.query.entries %}
  entry({{ loop.index0 }}) <= job_words(job_pose_{{ name }});
{%- endfor %}
  entries : for i in 0 to 8 generate
    signal cut : std_logic_vector({{ e.query.origin }});
    constant sign : natural := {{ e.query.entry.high }};
    constant above_bits : natural := {{ e.query.above_bits }};
    signal above : std_logic_vector(above_bits - 1 downto 0);  -- sign bits, if it fits
  begin
    cut <= entry(i)({{ e.query.cut }});
    above <= entry(i)({{ e.query.above }});
    saturated(i) <= "{{ e.query.greatest_entry }}" when entry(i)(sign) = '0' and above /= "{{ e.query.above_zeros }}" else
      "{{ e.query.least_entry }}" when entry(i)(sign) = '1' and (above /= "{{ e.query.above_ones }}" or cut = "{{ e.query.below_least }}") else
      cut;
  end generate entries;

  keep : process (clk)
  begin
    if rising_edge(clk) then
      if forget = '1' then
        number_now <= forget_number;
        short <= '0';
      elsif taken = '1' then
        number_now <= job_number;
        short <= job_short;
      end if;
{%- if e.unit.signs.len() > 0 %}
      if (reset or forget) = '1' then
        pose_unfit <= '0';
      elsif taken = '1' and job_posed = '1' then
        -- With the bypass the numbers are not read.
        pose_unfit <= job_unfit and not job_words(job_bypass);
      end if;
{%- endif %}
      separate_too <= options(option_separate) or not running_now;
      leaves_only <= options(option_leaves) and running_now;
      if taken = '1' and job_query = '1' then
        bases(0) <= unsigned(job_words(job_blocks_a));
        bases(1) <= unsigned(job_words(job_blocks_b));
        bases(2) <= unsigned(job_words(job_triangles_a)){% if e.block_ram %} xor x"02000000"{% endif %};
        bases(3) <= unsigned(job_words(job_triangles_b)){% if e.block_ram %} xor x"02000000"{% endif %};
        counts(0) <= unsigned(job_words(job_block_count_a));
        counts(1) <= unsigned(job_words(job_block_count_b));
        counts(2) <= unsigned(job_words(job_triangle_count_a));
        counts(3) <= unsigned(job_words(job_triangle_count_b));
        options <= job_words(job_options);
        query_errors <= job_words(job_errors);
{%- for name in e.query.entries %}
        query_pose(query_{{ name }}) <= saturated({{ loop.index0 }});
{%- endfor %}
        -- Of the shift the bits below s4.22 are cut off, of a row those above its rest are zero: the command has looked.
{%- for axis in e.query.axes %}
        query_shift(query_shift_{{ axis }}) <= job_words(job_shift_{{ axis }});
{%- endfor %}
{%- for i in 0..e.query.directions %}
        query_rows(query_row_{{ i }}) <= job_words(job_row_{{ i }});
{%- endfor %}
{%- if e.axi %}
        moved <= '0';
        if known = '0' or bases(0) /= unsigned(job_words(job_blocks_a))
          or bases(1) /= unsigned(job_words(job_blocks_b))
          or bases(2) /= unsigned(job_words(job_triangles_a))
          or bases(3) /= unsigned(job_words(job_triangles_b))
          or job_words(job_keep) = '0' then
          moved <= '1';
        end if;
{%- endif %}
      end if;
      for i in 0 to 1 loop
        outside(i) <= '0';
        if resize(bases(i), 33) + resize(counts(i), 33) > {{ e.memory.block_lines }} then
          outside(i) <= '1';
        end if;
        outside(i + 2) <= '0';
        if resize(bases(i + 2), 33) + resize(counts(i + 2), 33) > {{ e.memory.triangle_lines }} then
          outside(i + 2) <= '1';
        end if;
      end loop;
      empty <= '0';
      if counts(0) = 0 or counts(1) = 0 then
        empty <= '1';
      end if;
    end if;
  end process keep;
  block_base_a <= std_logic_vector(bases(0));
  block_base_b <= std_logic_vector(bases(1));
  triangle_base_a <= std_logic_vector(bases(2));
  triangle_base_b <= std_logic_vector(bases(3));
  block_count_a <= std_logic_vector(counts(0));
  block_count_b <= std_logic_vector(counts(1));
  triangle_count_a <= std_logic_vector(counts(2));
  triangle_count_b <= std_logic_vector(counts(3));
  most_expansions <= options(option_expansions);
  stop_at_contact <= options(option_contact);

  proceed : process (clk)
    variable next_phase : phase_state;
    variable next_reason : std_logic_vector(4 downto 0);
  begin
    if rising_edge(clk) then
      next_phase := phase;
      next_reason := reason_now;
      started <= '0';
      idle_before <= idle;
{%- if e.axi %}
      flush_now <= '0';
{%- endif %}
      if reset = '1' then
        next_phase := waiting_state;
        stopped <= '0';
        stopped_waiting <= '0';
        next_reason := fine;
{%- if e.axi %}
        known <= '0';
{%- endif %}
      elsif forget = '1' then
        next_phase := report_state;
        stopped <= '0';
        stopped_waiting <= '0';
        next_reason := reason_reset;
{%- if e.axi %}
        known <= '0';
{%- endif %}
      else
        stopped <= stopped or stops_running;
        stopped_waiting <= stopped_waiting or stops_waiting;
        if taken = '1' then
          stopped <= stopped_waiting or stops_waiting;
          stopped_waiting <= '0';
        end if;
        if phase = waiting_state then
          checks <= "00";
          if job_due = '1' and (pose_ready = '1' or job_posed = '0') then
            next_phase := take_state;
          end if;
        elsif phase = take_state then
          next_reason := job_reason;
          next_phase := report_state;
          if job_query = '1' then
            next_phase := check_state;
          end if;
        elsif phase = check_state then
          checks <= checks + 1;
          if checks = "10" then
            if outside /= "0000" then
              next_reason := reason_memory;
              next_phase := report_state;
{%- if e.axi %}
              known <= '0';
{%- endif %}
            elsif empty = '1' then
              next_reason := reason_bad_tree;
              next_phase := report_state;
{%- if e.axi %}
              known <= '0';
{%- endif %}
{%- if e.axi %}
            elsif moved = '1' then
              flush_now <= '1';
              next_phase := flush_state;
{%- endif %}
            else
              started <= '1';
              next_phase := run_state;
            end if;
          end if;
{%- if e.axi %}
        elsif phase = flush_state then
          known <= '1';
          -- The caches say that they are at it from the clock after flush on.
          if memory_draining = '1' then
            if memory_silent = '1' then
              known <= '0';
              next_reason := reason_silent;
              next_phase := report_state;
            end if;
          elsif flush_now = '0' and flushing = '0' then
            started <= '1';
            next_phase := run_state;
          end if;
{%- endif %}
        elsif phase = run_state then
          -- That is, while there is no reason to end.
          if ending_now = '0' then
            if {% if e.axi %}memory_error = '1' then
              next_reason := reason_memory;
            elsif memory_silent = '1' then
              next_reason := reason_silent;
            elsif {% endif %}bad_tree = '1' then
              next_reason := reason_bad_tree;
            elsif contact = '1' then
              next_reason := reason_contact;
            elsif limit_reached = '1' then
              next_reason := reason_limit;
            elsif stopped = '1' then
              next_reason := reason_stopped;
            end if;
          end if;
{%- if e.axi %}
          -- What memory still answers is drained behind the report.
          if (memory_error or memory_silent) = '1' then
            next_phase := abort_state;
          elsif idle = '1' then
            next_phase := report_state;
          end if;
        elsif phase = abort_state then
          known <= '0';
          next_phase := report_state;
{%- else %}
          if idle = '1' then
            next_phase := report_state;
          end if;
{%- endif %}
        else
          stopped <= '0';
          if report_done = '1' then
            next_reason := fine;
            next_phase := waiting_state;
          end if;
        end if;
      end if;
      phase <= next_phase;
      reason_now <= next_reason;
      taken <= '0';
      running_now <= '1';
      ending_now <= '1';
      dropping_now <= '1';
      report_due_now <= '0';
      if next_phase = waiting_state or next_phase = take_state or next_phase = report_state then
        running_now <= '0';
        dropping_now <= '0';
      elsif next_phase = run_state and next_reason = fine then
        ending_now <= '0';
        dropping_now <= '0';
      end if;
      if next_phase = take_state then
        taken <= '1';
      elsif next_phase = report_state then
        report_due_now <= '1';
      end if;
    end if;
  end process proceed;
end architecture rtl;
