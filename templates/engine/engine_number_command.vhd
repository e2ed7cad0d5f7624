--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Packets in, words of 64 bits. The header is in the low 32 bits of the first word; its low byte is the kind of the packet:
{%- if e.block_ram %}
--   4  load: the second word is a byte address, a multiple of 64 in bits 31..0 below zeros, with bit 31 set; then words for the
--      memory from there on, eight for each 64 bytes
{%- endif %}
--   6  soft reset: the header alone, with a number for its report in bits 63..40 and zeros below. Everything before it is
--      forgotten. That by the port drops the packet of which a word was taken to its end, without an answer
--   7  pairs by number: {{ e.numbers.pairs_word }} words of head, the options above the header, then a word for each pair
-- The pairs of a packet are asked for when all pairs of the packet before have gone to the unit; then the unit takes the pose of the
-- packet. So what memory has to give is of one packet, and a fault of memory ends that packet alone. The words of the next
-- packet up to its first pair are taken meanwhile.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_number_command is
  port (
    clk : in std_logic;
    reset : in std_logic;
    soft_reset : in std_logic;  -- by the port
    s_axis_tdata : in std_logic_vector(63 downto 0);
    s_axis_tkeep : in std_logic_vector(7 downto 0);
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;
    s_axis_tready : out std_logic;
    -- A pair: the lines of its triangles in memory.
    pair_valid : out std_logic;
    pair_ready : in std_logic;
    line_a : out std_logic_vector(25 downto 0);
    line_b : out std_logic_vector(25 downto 0);
    sent : in std_logic;  -- a pair goes to the unit, which all do in order
    separate_too : out std_logic;  -- of the pairs that go to the unit: they are answered if they are separate, too
    pose_valid : out std_logic;
    pose_ready : in std_logic;
    job_words : out std_logic_vector(job_bits - 1 downto 0);  -- the pose of the packet
{%- if e.axi %}
    memory_error : in std_logic;
    memory_silent : in std_logic;
    failing : out std_logic;  -- the packet ends: no pair of it goes to the unit any more
    restart : out std_logic;  -- memory and caches forget the packet, a clock later
    flush : out std_logic;
    flushing : in std_logic;
    missed : in std_logic_vector(1 downto 0);  -- a triangle of A, of B, is read from memory
    word_read : in std_logic;
{%- else %}
    triangle_write : out std_logic;
    write_line : out std_logic_vector(triangle_line_bits - 1 downto 0);
    write_place : out std_logic_vector(2 downto 0);
    write_data : out std_logic_vector(63 downto 0);
{%- endif %}
    -- The report of a packet, when all its pairs have gone to the unit.
    report_valid : out std_logic;
    report_ready : in std_logic;
    report_reason : out std_logic_vector(4 downto 0);
    report_number : out std_logic_vector(23 downto 0);
    triangles_read : out std_logic_vector(31 downto 0);
    words_read : out std_logic_vector(31 downto 0);
    reset_word : out std_logic;  -- one clock long: a soft reset by the stream; here it is done
    reset_number : out std_logic_vector(23 downto 0)
  );
end entity {{ prefix }}engine_number_command;

architecture rtl of {{ prefix }}engine_number_command is
  constant numbers_header : std_logic_vector(31 downto 0) := x"{{ e.numbers.header }}";
{%- if e.block_ram %}
  constant load_header : std_logic_vector(31 downto 0) := x"{{ e.query.load_header }}";
{%- endif %}
  constant reset_header : std_logic_vector(39 downto 0) := x"00{{ e.query.reset_header }}";
  constant all_bytes : std_logic_vector(7 downto 0) := (others => '1');
  constant fine : std_logic_vector(4 downto 0) := reason_complete;
  constant unknown : std_logic_vector(4 downto 0) := reason_unknown_header;
  constant too_short : std_logic_vector(4 downto 0) := reason_too_short;
{%- if e.block_ram %}
  constant too_long : std_logic_vector(4 downto 0) := reason_too_long;
{%- endif %}
  constant bad_number : std_logic_vector(4 downto 0) := reason_bad_tree;

  -- Two words are held, so that TREADY depends on registers alone. What a word is as a header, and whether it is a pair of triangles
  -- that are there, is found when it arrives: behind the counts of triangles a pose comes first.
  constant is_numbers : natural := 0;
  constant is_reset : natural := 1;  -- with nothing behind it
  constant is_pair : natural := 2;
{%- if e.block_ram %}
  constant is_load : natural := 3;
{%- endif %}
  constant kinds : natural := {{ e.numbers.kinds }};
{% include "engine/held_signals.vhd" %}
  signal whole : std_logic;
  signal ready : std_logic;
  signal arrives : std_logic;
  signal within_packet : std_logic := '0';  -- the last word that came was not the last of its packet
  signal stays_within : std_logic;
  signal taken : std_logic;

  type expectation_state is (header_state, bases_state, counts_state, pose_state, begin_state, pair_state, {% if e.block_ram %}address_state, load_state, {% endif %}skip_state);
  signal expectation : expectation_state := header_state;
  signal place : unsigned(3 downto 0) := "0000";  -- of the word in its pose
  signal fault : std_logic_vector(4 downto 0) := fine;
  signal options : std_logic_vector(63 downto 0) := (others => '0');
  signal separate_now : std_logic := '0';
  type numbers is array (0 to 1) of unsigned(31 downto 0);  -- of A, of B
  signal bases : numbers := (others => (others => '0'));
  signal counts : numbers := (others => (others => '0'));
  signal outside : std_logic_vector(1 downto 0) := "00";  -- the triangles of A, of B, end beyond the memory
  signal words : std_logic_vector(job_bits - 1 downto 0) := (others => '0');
  constant plus_signs : std_logic_vector({{ e.numbers.sign_high }} downto 0) := (others => '0');
  constant minus_signs : std_logic_vector({{ e.numbers.sign_high }} downto 0) := (others => '1');
  signal unfit : std_logic;  -- a number of the word is no sign extension of what the unit reads

  signal checked : std_logic;  -- the pairs of the packet may come
  signal posed : std_logic := '0';  -- the unit has the pose
{%- if e.axi %}
  signal flushed : std_logic := '0';
  signal flush_now : std_logic := '0';
  signal fails : std_logic;
  signal restart_now : std_logic := '0';
{%- endif %}
  signal offers : std_logic;
  signal begins : std_logic;
  signal asked : std_logic := '0';
  signal asked_a : unsigned(25 downto 0) := (others => '0');
  signal asked_b : unsigned(25 downto 0) := (others => '0');
  signal asks : std_logic;
  signal waiting : unsigned(6 downto 0) := (others => '0');  -- pairs that have not gone to the unit
  signal none_wait : std_logic;

  -- A packet that was taken whole, and is reported when none of its pairs waits.
  signal closing : std_logic := '0';
  signal closing_reason : std_logic_vector(4 downto 0) := fine;
  signal closing_number : std_logic_vector(23 downto 0) := (others => '0');
  signal reports : std_logic;
  signal reported : std_logic;
  signal reset_taken : std_logic;
  signal reset_now : std_logic := '0';  -- a clock later, in which the memory may still give a pair
  signal clears : std_logic;
{%- if e.axi %}
  signal lines_read : unsigned(31 downto 0) := (others => '0');
  signal beats_read : unsigned(31 downto 0) := (others => '0');
{%- else %}
  signal load_line : unsigned(triangle_line_bits downto 0) := (others => '0');
  signal load_place : unsigned(2 downto 0) := "000";
{%- endif %}
begin
  -- ===== Words =====
  ready <= running and not next_valid;
  s_axis_tready <= ready;
  arrives <= ready and s_axis_tvalid;
  stays_within <= not s_axis_tlast when arrives = '1' else within_packet;
  whole <= '1' when s_axis_tkeep = all_bytes else '0';
  kind(is_numbers) <= whole when s_axis_tdata(31 downto 0) = numbers_header and s_axis_tdata(option_spare) = "0000"
    and s_axis_tdata(option_contact) = '0' and s_axis_tdata(option_leaves) = '0' else '0';
  kind(is_reset) <= whole and s_axis_tlast when s_axis_tdata(39 downto 0) = reset_header else '0';
  -- A word that is none is not looked at.
  kind(is_pair) <= '0' when s_axis_tvalid = '0' else whole when unsigned(s_axis_tdata(31 downto 0)) < counts(0) and unsigned(s_axis_tdata(63 downto 32)) < counts(1) else '0';
{%- if e.block_ram %}
  kind(is_load) <= whole when s_axis_tdata(31 downto 0) = load_header else '0';
{%- endif %}

{% include "engine/held_words.vhd" %}

  -- ===== Packets =====
  -- The last word of a packet is taken when the packet before is reported, so are words for the memory; a soft reset at any time.
  taken <= head_valid and (head_kind(is_reset) or not (head_last and closing)) when expectation = header_state else
    '0' when expectation = begin_state else
    asks or (head_valid and not head_kind(is_pair){% if e.axi %} and not fails{% endif %}) when expectation = pair_state else
{%- if e.block_ram %}
    head_valid and not closing when expectation = address_state or expectation = load_state else
{%- endif %}
    head_valid and not (head_last and closing){% if e.axi %} and not (fails and not closing){% endif %};
  reset_taken <= taken and head_kind(is_reset) when expectation = header_state else '0';
  clears <= reset or soft_reset or reset_taken;
  unfit <= '1' when {% for sign in e.numbers.signs %}(head({{ sign }}) /= plus_signs and head({{ sign }}) /= minus_signs){% if !loop.last %} or {% endif %}{% endfor %} else '0';
  asks <= head_valid and head_kind(is_pair) and (pair_ready or not asked){% if e.axi %} and not fails{% endif %} when expectation = pair_state else '0';
  pair_valid <= asked;
  line_a <= std_logic_vector(asked_a);
  line_b <= std_logic_vector(asked_b);
  none_wait <= '1' when waiting = 0 else '0';

  -- What the head says is looked at when the packet before is reported.
  checked <= not closing when expectation = begin_state and outside = "00" else '0';
  offers <= checked and not posed;
  pose_valid <= offers;
  job_words <= words;
  begins <= checked and posed{% if e.axi %} and (flushed or options(option_keep)) and not flush_now and not flushing{% endif %};
  separate_too <= separate_now;
{%- if e.axi %}
  -- While pairs wait, they are of one packet: that which closes, or else that which is taken.
  fails <= (memory_error or memory_silent) and not none_wait;
  failing <= fails or restart_now;
  restart <= restart_now;
  flush <= flush_now;
{%- endif %}
  reports <= closing and none_wait;
  reported <= reports and report_ready;
  report_valid <= reports;
  report_reason <= closing_reason;
  report_number <= closing_number;

  receive : process (clk)
    variable found : std_logic_vector(4 downto 0);
    variable ends : std_logic;
    variable at_last_of_pose : boolean;  -- with which a packet without pairs ends
  begin
    if rising_edge(clk) then
      reset_now <= reset_taken and not (reset or soft_reset);
      reset_number <= head(option_number);
      found := fault;
      ends := '0';
      at_last_of_pose := expectation = pose_state and place = {{ e.numbers.last_of_pose }};
{%- if e.block_ram %}
      triangle_write <= '0';
      -- The bit above is set only beyond the memory, where nothing is written.
      write_line <= std_logic_vector(load_line(triangle_line_bits - 1 downto 0));
      write_place <= std_logic_vector(load_place);
      write_data <= head;
{%- endif %}
      if reported = '1' then
        closing <= '0';
      end if;
      for i in 0 to 1 loop
        outside(i) <= '0';
        if resize(bases(i), 33) + resize(counts(i), 33) > {{ e.memory.triangle_lines }} then
          outside(i) <= '1';
        end if;
      end loop;
      if pair_ready = '1' then
        asked <= '0';
      end if;
      if asks = '1' then
        asked <= '1';
        asked_a <= bases(0)(25 downto 0) + unsigned(head(25 downto 0));
        asked_b <= bases(1)(25 downto 0) + unsigned(head(57 downto 32));
      end if;
      if asks = '1' and sent = '0' then
        waiting <= waiting + 1;
      elsif asks = '0' and sent = '1' then
        waiting <= waiting - 1;
      end if;
      if taken = '1' then
        ends := head_last;
        if expectation = header_state then
          found := fine;
          options <= head;
          place <= "0000";
          if head_kind(is_numbers) = '1' then
            expectation <= bases_state;
{%- if e.block_ram %}
          elsif head_kind(is_load) = '1' then
            expectation <= address_state;
{%- endif %}
          elsif head_kind(is_reset) = '0' then
            found := unknown;
          end if;
          if head_last = '1' and found = fine and head_kind(is_reset) = '0' then
            found := too_short;
          end if;
        elsif expectation = bases_state then
          bases(0) <= unsigned(head(31 downto 0)){% if e.block_ram %} xor x"02000000"{% endif %};
          bases(1) <= unsigned(head(63 downto 32)){% if e.block_ram %} xor x"02000000"{% endif %};
          expectation <= counts_state;
        elsif expectation = counts_state then
          counts(0) <= unsigned(head(31 downto 0));
          counts(1) <= unsigned(head(63 downto 32));
          expectation <= pose_state;
        elsif expectation = pose_state then
          words <= head & words(job_bits - 1 downto 64);
          place <= place + 1;
          if at_last_of_pose then
            expectation <= begin_state;
          end if;
          if place /= 0 and unfit = '1' then
            found := unknown;
          elsif head_last = '1' and outside /= "00" then
            found := reason_memory;
          end if;
        elsif expectation = pair_state then
          if head_kind(is_pair) = '0' then
            found := bad_number;
          end if;
{%- if e.block_ram %}
        elsif expectation = address_state then
          expectation <= load_state;
          load_line <= '0' & unsigned(head({{ e.numbers.load_line }}));
          load_place <= "000";
          if head_last = '0' and (head(63 downto 32) /= x"00000000" or head(31) = '0' or head(5 downto 0) /= "000000") then
            found := unknown;
          end if;
          -- A line that has no number here is beyond the memory, as the one behind the last is.
          if head({{ e.numbers.load_above }}) /= "{{ e.numbers.load_zeros }}" then
            load_line(triangle_line_bits) <= '1';
          end if;
        elsif expectation = load_state then
          load_place <= load_place + 1;
          if load_place = 7 then
            load_line <= load_line + 1;
          end if;
          if head_whole = '1' then
            if load_line(triangle_line_bits) = '1' then
              found := too_long;
            else
              triangle_write <= '1';
              if head_last = '1' and load_place /= 7 then
                found := too_short;
              end if;
            end if;
          end if;
{%- endif %}
        end if;
        if expectation /= header_state and expectation /= skip_state then
          if head_whole = '0' then
            found := too_short;
          elsif head_last = '1' and expectation /= pair_state{% if e.block_ram %} and expectation /= load_state{% endif %} and not at_last_of_pose then
            found := too_short;
          end if;
        end if;
        if found /= fine then
          expectation <= skip_state;
        end if;
      elsif expectation = begin_state and closing = '0' and outside /= "00" then
        found := reason_memory;
        expectation <= skip_state;
      end if;
      if expectation /= begin_state then
        posed <= '0';
      elsif offers = '1' and pose_ready = '1' then
        posed <= '1';
      end if;
      if begins = '1' then
        expectation <= pair_state;
        separate_now <= options(option_separate);
      end if;
{%- if e.axi %}
      flush_now <= '0';
      if expectation /= begin_state then
        flushed <= '0';
      elsif checked = '1' and flushed = '0' and options(option_keep) = '0' then
        flush_now <= '1';
        flushed <= '1';
      end if;
      restart_now <= '0';
      if fails = '1' then
        restart_now <= '1';
        asked <= '0';
        waiting <= (others => '0');
        if closing = '1' then
          closing_reason <= reason_silent;
          if memory_error = '1' then
            closing_reason <= reason_memory;
          end if;
        else
          expectation <= skip_state;
          found := reason_silent;
          if memory_error = '1' then
            found := reason_memory;
          end if;
        end if;
      end if;
{%- endif %}
      fault <= found;
      -- What is dropped after a soft reset has no fault, and no report.
      if ends = '1' then
        expectation <= header_state;
        fault <= fine;
        if found /= fine or {% if e.block_ram %}expectation = load_state or {% endif %}expectation = pair_state or expectation = pose_state then
          closing <= '1';
          closing_reason <= found;
          closing_number <= options(option_number);
          if found = unknown or found = too_short{% if e.block_ram %} or found = too_long or expectation = load_state{% endif %} then
            closing_number <= (others => '0');
          end if;
        end if;
      end if;
      -- What is forgotten by reset and by both kinds of soft reset. That of the port drops the rest of a packet, too.
      if clears = '1' then
        expectation <= header_state;
        if (soft_reset and stays_within and not reset) = '1' then
          expectation <= skip_state;
        end if;
        fault <= fine;
        asked <= '0';
        closing <= '0';
{%- if e.axi %}
        restart_now <= '0';
{%- else %}
        triangle_write <= '0';
{%- endif %}
      end if;
      if (clears or reset_now) = '1' then
        waiting <= (others => '0');
      end if;
    end if;
  end process receive;
  reset_word <= reset_now;
{%- if e.axi %}

  -- ===== Counts of what memory has given for the packet =====
  count : process (clk)
  begin
    if rising_edge(clk) then
      if missed = "11" then
        lines_read <= lines_read + 2;
      elsif missed /= "00" then
        lines_read <= lines_read + 1;
      end if;
      if word_read = '1' then
        beats_read <= beats_read + 1;
      end if;
      if (clears or reset_now or reported) = '1' then
        lines_read <= (others => '0');
        beats_read <= (others => '0');
      end if;
    end if;
  end process count;
  triangles_read <= std_logic_vector(lines_read);
  words_read <= std_logic_vector(beats_read);
{%- else %}
  triangles_read <= (others => '0');
  words_read <= (others => '0');
{%- endif %}
end architecture rtl;
