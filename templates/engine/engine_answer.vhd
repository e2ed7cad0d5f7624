--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Answers out. A pair is a word: verdict in bits 1..0, number of A's triangle in 35..8, of B's in 63..36; or, of a packet of
-- pairs, tag and flags of the unit in 63..8. The last pair of such a packet ends the answer. A query is closed by a report of
-- eight words, the last with TLAST; a short report is the first of them alone:
--   0  11 in bits 1..0, reason 6..2, incomplete 7, number of the query 31..8, clocks 63..32
--   1  expansions 31..0, tests 63..32
--   2  survivors, leaf pairs
--   3  pairs that intersect, pairs that are possibly incorrect
--   4  blocks asked for, blocks read from memory
--   5  triangles asked for, triangles read from memory
--   6  words read from memory, clocks in which the volume unit waited for blocks
--   7  clocks in which survivors waited for the queue of pairs, 47..32 the most entries of the stack, at most {{ e.traversal.stack }}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_answer is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forgets : in std_logic;  -- in the next clock it is set: no other word is offered then
    restart : in std_logic;  -- pairs that are held are forgotten, and a report begins again; a word that is offered stays
    -- Pairs with their verdicts.
    decided_valid : in std_logic;
    decided_ready : out std_logic;
    decided_lane : in std_logic_vector(lane_bits - 1 downto 0);  -- of its query: it waits until that is the oldest
    running : in std_logic;  -- there is a query; without one pairs are of a packet, and do not wait
    verdict : in std_logic_vector(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    numbers : in std_logic_vector(55 downto 0);  -- of A's triangle in the low half, of B's in the high one
    last : in std_logic;  -- the pair ends the answer
{%- if e.unit.guarded %}
    outside : in std_logic;  -- of a pair of a packet: a number of it, or of the pose, is outside its range
{%- endif %}
    dropping : in std_logic;  -- pairs are dropped
    separate_too : in std_logic;  -- pairs that are separate are answered, too
    stop_at_contact : in std_logic;
    pair_answered : out std_logic;  -- one pair more has become a word, or was dropped, a clock ago
    contact : out std_logic;  -- a pair of the query intersects, and the query is to end with it; until its report
    -- The report.
    report_due : in std_logic;  -- until the report is done; pairs that come are of the next query, and wait
    short : in std_logic;
    report_done : out std_logic;  -- its last word is on its way, a clock ago
    reason : in std_logic_vector(4 downto 0);
    number : in std_logic_vector(23 downto 0);
    -- Counters of each lane: cleared before its query, then so many more in each clock. The report has those of the oldest.
    oldest : in std_logic_vector(lane_bits - 1 downto 0);
    oldest_flags : in lane_flags;  -- the same, a flag for each lane
    clear : in lane_flags;
    counting : in lane_flags;  -- clocks
    expanded : in std_logic;
    expanded_lane : in std_logic_vector(lane_bits - 1 downto 0);
    tested : in std_logic_vector(2 downto 0);
    tested_lane : in std_logic_vector(lane_bits - 1 downto 0);
    survived : in std_logic_vector(2 downto 0);
    survived_lane : in std_logic_vector(lane_bits - 1 downto 0);
    paired : in std_logic;
    paired_lane : in std_logic_vector(lane_bits - 1 downto 0);
    -- Counters of what all queries in flight do from one report to the next: one more in each clock in which the event is set.
    renew : in std_logic;  -- they begin again with what happened a clock ago: the two clocks before that are in no report
    block_reads : in std_logic_vector(1 downto 0);  -- of A, of B
    triangles_asked : in std_logic;  -- one of A and one of B
    triangle_reads : in std_logic_vector(1 downto 0);
    words_read : in std_logic;
    starved : in std_logic;
    stalled : in std_logic;
    greatest_stack : in unsigned(15 downto 0);
    m_axis_tdata : out std_logic_vector(63 downto 0);
    m_axis_tkeep : out std_logic_vector(7 downto 0);  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;
    m_axis_tready : in std_logic
  );
end entity {{ prefix }}engine_answer;

architecture rtl of {{ prefix }}engine_answer is
  constant separate : std_logic_vector(1 downto 0) := "00";
  constant certain : std_logic_vector(1 downto 0) := "01";
  -- Two pairs are held, so that readiness depends on registers alone.
  signal head_valid : std_logic := '0';
  signal head_lane : std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
  signal head_due : std_logic := '0';  -- a clock ago no older query had to be answered first
  signal head_verdict : std_logic_vector(1 downto 0) := separate;
  signal head_numbers : std_logic_vector(55 downto 0) := (others => '0');
  signal head_last : std_logic := '0';
  signal next_valid : std_logic := '0';
  signal next_lane : std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
  signal coming_lane : std_logic_vector(lane_bits - 1 downto 0);  -- of the pair that is held first in the next clock
  -- It is of the oldest query: compared before it is known which one it is.
  signal coming_due : std_logic;
  signal stays_due : std_logic;
  signal next_due : std_logic;
  signal decided_due : std_logic;
  signal next_verdict : std_logic_vector(1 downto 0) := separate;
  signal next_numbers : std_logic_vector(55 downto 0) := (others => '0');
  signal next_last : std_logic := '0';
{%- if e.unit.guarded %}
  signal head_outside : std_logic := '0';
  signal next_outside : std_logic := '0';
{%- endif %}
  signal arrives : std_logic;
  signal due : std_logic;
  signal moves : std_logic;  -- another pair is held first
  signal offered : std_logic := '0';
  signal offered_word : std_logic_vector(63 downto 0) := (others => '0');
  signal offered_last : std_logic := '0';
  signal free : std_logic;
  signal speaks : std_logic;  -- the pair becomes a word
  signal taken : std_logic;
  signal counts : std_logic;
  signal meets : std_logic;  -- it intersects, and the query ends with it
  signal contact_now : std_logic := '0';
  -- What holds for the query, a clock later: its first pair is not due before.
  signal drops : std_logic := '0';
  signal all_speak : std_logic := '0';
  signal one_contact : std_logic := '0';
  constant first_word : std_logic_vector(7 downto 0) := x"01";
  signal turn : std_logic_vector(7 downto 0) := first_word;  -- of the words of the report: the next one has it
  signal sent : std_logic := '0';
  type report_words is array (0 to 7) of std_logic_vector(63 downto 0);
  signal report_word : report_words;
  signal ends : std_logic;  -- it is the last one
  signal incomplete : std_logic;

  type lane_counts is array (0 to lanes - 1) of unsigned(31 downto 0);
  signal clocks : lane_counts := (others => (others => '0'));
  signal expansions : lane_counts := (others => (others => '0'));
  signal tests : lane_counts := (others => (others => '0'));
  signal survivors : lane_counts := (others => (others => '0'));
  signal pairs : lane_counts := (others => (others => '0'));
  -- Of the oldest query, a clock later, and which one that is another clock later: not later than its report.
  signal shown : lane_flags := (others => '0');
  signal clocks_now : unsigned(31 downto 0) := (others => '0');
  signal expansions_now : unsigned(31 downto 0) := (others => '0');
  signal tests_now : unsigned(31 downto 0) := (others => '0');
  signal survivors_now : unsigned(31 downto 0) := (others => '0');
  signal pairs_now : unsigned(31 downto 0) := (others => '0');
  type counter_values is array (0 to 9) of unsigned(31 downto 0);
  signal counter : counter_values := (others => (others => '0'));
  signal steps : std_logic_vector(9 downto 0) := (others => '0');  -- a clock later: a report comes later still
  constant intersect_at : natural := 0;
  constant incorrect_at : natural := 1;
  constant blocks_a_read_at : natural := 2;
  constant blocks_b_read_at : natural := 3;
  constant triangles_asked_at : natural := 4;
  constant triangles_a_read_at : natural := 5;
  constant triangles_b_read_at : natural := 6;
  constant words_at : natural := 7;
  constant starved_at : natural := 8;
  constant stalled_at : natural := 9;
  signal blocks_read : unsigned(31 downto 0) := (others => '0');
  signal triangles_read : unsigned(31 downto 0) := (others => '0');
begin
  -- ===== Pairs =====
  decided_ready <= not next_valid;
  arrives <= decided_valid and not next_valid;
  free <= m_axis_tready or not offered;
  due <= head_valid and head_due;
  speaks <= due and not drops and not contact_now when head_verdict /= separate or all_speak = '1' else '0';
  taken <= due and (free or not speaks);
  moves <= taken or not head_valid;
  coming_lane <= head_lane when moves = '0' else next_lane when next_valid = '1' else decided_lane;
  stays_due <= '1' when head_lane = oldest else '0';
  next_due <= '1' when next_lane = oldest else '0';
  decided_due <= '1' when decided_lane = oldest else '0';
  coming_due <= stays_due when moves = '0' else next_due when next_valid = '1' else decided_due;
  counts <= taken and not drops and not contact_now;
  meets <= counts and one_contact when head_verdict = certain else '0';
  contact <= contact_now;

  hold : process (clk)
  begin
    if rising_edge(clk) then
      head_due <= coming_due or not running;
      head_lane <= coming_lane;
      if moves = '1' then
        head_verdict <= verdict;
        head_numbers <= numbers;
        head_last <= last;
{%- if e.unit.guarded %}
        head_outside <= outside;
{%- endif %}
        if next_valid = '1' then
          head_verdict <= next_verdict;
          head_numbers <= next_numbers;
          head_last <= next_last;
{%- if e.unit.guarded %}
          head_outside <= next_outside;
{%- endif %}
        end if;
      end if;
      if next_valid = '0' then
        next_lane <= decided_lane;
        next_verdict <= verdict;
        next_numbers <= numbers;
        next_last <= last;
{%- if e.unit.guarded %}
        next_outside <= outside;
{%- endif %}
      end if;
      pair_answered <= taken and not restart;
      drops <= dropping;
      all_speak <= separate_too;
      one_contact <= stop_at_contact;
      contact_now <= (contact_now or meets) and not report_due and not restart;
      if restart = '1' then
        head_valid <= '0';
        next_valid <= '0';
      elsif moves = '1' then
        head_valid <= next_valid or arrives;
        next_valid <= '0';
      else
        next_valid <= next_valid or arrives;
      end if;
    end if;
  end process hold;

  -- ===== Report =====
  incomplete <= '0' when reason = reason_complete or (reason = reason_contact and short = '0') else '1';
  -- Each expansion asks for two blocks and each pair for two triangles: twice the count, whose highest bit is lost as every count
  -- of 32 bits begins again.
  report_word(0) <= std_logic_vector(clocks_now) & number & incomplete & reason & "11";
  report_word(1) <= std_logic_vector(tests_now) & std_logic_vector(expansions_now);
  report_word(2) <= std_logic_vector(pairs_now) & std_logic_vector(survivors_now);
  report_word(3) <= std_logic_vector(counter(incorrect_at)) & std_logic_vector(counter(intersect_at));
  report_word(4) <= std_logic_vector(blocks_read) & std_logic_vector(expansions_now(30 downto 0)) & '0';
  report_word(5) <= std_logic_vector(triangles_read) & std_logic_vector(counter(triangles_asked_at)(30 downto 0)) & '0';
  report_word(6) <= std_logic_vector(counter(starved_at)) & std_logic_vector(counter(words_at));
  report_word(7) <= x"0000" & std_logic_vector(greatest_stack) & std_logic_vector(counter(stalled_at));
  ends <= turn(7) or short;
  report_done <= sent;

  offer : process (clk)
    variable said : std_logic_vector(63 downto 0);
  begin
    if rising_edge(clk) then
      said := (others => '0');
      for i in 0 to 7 loop
        if turn(i) = '1' then
          said := said or report_word(i);
        end if;
      end loop;
      if free = '1' then
        if report_due = '1' then
          offered_word <= said;
        else
          offered_word <= head_numbers & {% if e.unit.guarded %}"000" & head_outside & "00"{% else %}"000000"{% endif %} & head_verdict;
        end if;
        offered_last <= head_last;
        if report_due = '1' then
          offered_last <= ends;
        end if;
      end if;
      if reset = '1' then
        offered <= '0';
        turn <= first_word;
        sent <= '0';
      elsif (forgets or restart) = '1' then
        turn <= first_word;
        sent <= '0';
        offered <= offered and not free;
      else
        if free = '1' then
          offered <= (report_due and not sent) or speaks;
          if report_due = '1' and sent = '0' and short = '0' then
            turn <= turn(6 downto 0) & turn(7);
          end if;
        end if;
        if report_due = '0' then
          sent <= '0';
        elsif free = '1' and ends = '1' then
          sent <= '1';
        end if;
      end if;
    end if;
  end process offer;
  m_axis_tdata <= offered_word;
  m_axis_tkeep <= (others => '1');
  m_axis_tvalid <= offered;
  m_axis_tlast <= offered_last;

  -- ===== Counters =====
  count : process (clk)
  begin
    if rising_edge(clk) then
      steps(intersect_at) <= '0';
      if head_verdict = certain then
        steps(intersect_at) <= counts;
      end if;
      steps(incorrect_at) <= counts and head_verdict(1);
      steps(blocks_a_read_at) <= block_reads(0);
      steps(blocks_b_read_at) <= block_reads(1);
      steps(triangles_asked_at) <= triangles_asked;
      steps(triangles_a_read_at) <= triangle_reads(0);
      steps(triangles_b_read_at) <= triangle_reads(1);
      steps(words_at) <= words_read;
      steps(starved_at) <= starved;
      steps(stalled_at) <= stalled;
      for lane in 0 to lanes - 1 loop
        if counting(lane) = '1' then
          clocks(lane) <= clocks(lane) + 1;
        end if;
        if expanded = '1' and unsigned(expanded_lane) = lane then
          expansions(lane) <= expansions(lane) + 1;
        end if;
        if unsigned(tested_lane) = lane then
          tests(lane) <= tests(lane) + unsigned(tested);
        end if;
        if unsigned(survived_lane) = lane then
          survivors(lane) <= survivors(lane) + unsigned(survived);
        end if;
        if paired = '1' and unsigned(paired_lane) = lane then
          pairs(lane) <= pairs(lane) + 1;
        end if;
        if clear(lane) = '1' then
          clocks(lane) <= (others => '0');
          expansions(lane) <= (others => '0');
          tests(lane) <= (others => '0');
          survivors(lane) <= (others => '0');
          pairs(lane) <= (others => '0');
        end if;
      end loop;
      shown <= oldest_flags;
      for lane in 0 to lanes - 1 loop
        if shown(lane) = '1' then
          clocks_now <= clocks(lane);
          expansions_now <= expansions(lane);
          tests_now <= tests(lane);
          survivors_now <= survivors(lane);
          pairs_now <= pairs(lane);
        end if;
      end loop;
      for i in 0 to 9 loop
        if renew = '1' then
          counter(i) <= (others => '0');
          counter(i)(0) <= steps(i);
        elsif steps(i) = '1' then
          counter(i) <= counter(i) + 1;
        end if;
      end loop;
      blocks_read <= counter(blocks_a_read_at) + counter(blocks_b_read_at);
      triangles_read <= counter(triangles_a_read_at) + counter(triangles_b_read_at);
    end if;
  end process count;
end architecture rtl;
