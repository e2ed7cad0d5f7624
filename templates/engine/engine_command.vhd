--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Packets in, words of 64 bits. The header is in the low 32 bits of the first word; its low byte is the kind of the packet:
--   1  pairs of triangles for the unit alone: {{ e.unit.pair_words }} words for each
--   2  a pose for the pairs after it: {{ e.unit.pose_words }} words
--   3  query: {{ e.query.query_words }} words with the header; above it the first has
--      {{ e.query.directions }} in bits 39..32, {{ e.blocks.offset_bits }} in 43..40, {{ e.blocks.factor_bits }} in 48..44, {{ e.blocks.origin_bits }} in 53..49, and zeros
{%- if e.block_ram %}
--   4  load: the second word is a byte address, a multiple of 64 in bits 31..0 below zeros; then words for the memory from there
--      on, eight for each 64 bytes. Bit 31 of the address is 0 for blocks, 1 for triangles
{%- endif %}
--   5  stop: the header alone, with the number of a query in bits 63..40 and zeros below. Ends that query if it runs or waits, and
--      has no answer of its own
--   6  soft reset: the header alone, with a number for its report in the same place. Everything before it is forgotten
-- Pairs go to the unit from here, while no query runs. Every other packet becomes a job: a query to run, a pose to be handed
-- over, or a report to give; for kinds 1 and 2 the report is one word. One job waits here while another one runs; then words
-- stay in the stream, but for a stop, a soft reset, and the header of a query, behind which everything stays. A soft reset by
-- the port drops the packet of which a word was taken to its end, without an answer.
--
-- The words of a query, of a pose and of a pair are shifted through one register. A pose is shifted on behind its last word, to
-- where a query has it.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_command is
  port (
    clk : in std_logic;
    reset : in std_logic;
    soft_reset : in std_logic;  -- by the port
    s_axis_tdata : in std_logic_vector(63 downto 0);
    s_axis_tkeep : in std_logic_vector(7 downto 0);
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;
    s_axis_tready : out std_logic;
    job_valid : out std_logic;
    job_taken : in std_logic;
    job_query : out std_logic;  -- a query, else a report
    job_posed : out std_logic;  -- with a pose: a query, or a pose alone
    job_short : out std_logic;  -- of a packet of kind 1 or 2, whose report is one word
    -- Of the report: {% if e.block_ram %}0 loaded, {% endif %}6 unknown header, 7 too short, 8 too long. Of a short one: 0 pose taken, 1, 2, 3.
    job_reason : out std_logic_vector(4 downto 0);
    job_number : out std_logic_vector(23 downto 0);
    job_words : out std_logic_vector(job_bits - 1 downto 0);  -- of the query without its header, the first in the low bits
{%- if e.unit.signs.len() > 0 %}
    job_unfit : out std_logic;  -- a number of the pose is no sign extension
{%- endif %}
    busy : in std_logic;  -- a query runs, or a report is sent; from the clock after its job is taken on
    pair_valid : out std_logic;  -- the last {{ e.unit.pair_words }} words are a pair
    pair_taken : in std_logic;
    pair_last : out std_logic;  -- the last of its packet
{%- if e.unit.signs.len() > 0 %}
    pair_unfit : out std_logic;  -- a number of the pair is no sign extension
{%- endif %}
{%- if e.block_ram %}
    block_write : out std_logic;
    triangle_write : out std_logic;
    write_line : out std_logic_vector(load_line_bits - 1 downto 0);
    write_place : out std_logic_vector(2 downto 0);
    write_data : out std_logic_vector(63 downto 0);
{%- endif %}
    stop : out std_logic;
    forgets : out std_logic;  -- a soft reset; control and all others forget a clock later
    forget_number : out std_logic_vector(23 downto 0);  -- of its report, in that clock: 0 of one by the port
    stop_number : out std_logic_vector(23 downto 0)
  );
end entity {{ prefix }}engine_command;

architecture rtl of {{ prefix }}engine_command is
  constant pairs_header : std_logic_vector(31 downto 0) := x"{{ e.unit.pairs_header }}";
  constant pose_header : std_logic_vector(31 downto 0) := x"{{ e.unit.pose_header }}";
  constant query_header : std_logic_vector(31 downto 0) := x"{{ e.query.query_header }}";
  constant query_format : std_logic_vector(31 downto 0) := x"{{ e.query.query_format }}";
{%- if e.block_ram %}
  constant load_header : std_logic_vector(31 downto 0) := x"{{ e.query.load_header }}";
{%- endif %}
  constant stop_header : std_logic_vector(31 downto 0) := x"{{ e.query.stop_header }}";
  constant reset_header : std_logic_vector(31 downto 0) := x"{{ e.query.reset_header }}";
  constant all_bytes : std_logic_vector(7 downto 0) := (others => '1');
  constant fine : std_logic_vector(4 downto 0) := reason_complete;
  constant unknown : std_logic_vector(4 downto 0) := reason_unknown_header;
  constant too_short : std_logic_vector(4 downto 0) := reason_too_short;
  constant too_long : std_logic_vector(4 downto 0) := reason_too_long;

  -- Two words are held, so that TREADY depends on registers alone. What a word is, is found in parts when it arrives. Of a header,
  -- its low half is that of a kind:
  constant is_query : natural := 0;
  constant is_stop : natural := 1;
  constant is_reset : natural := 2;
  constant is_pairs : natural := 3;
  constant is_pose : natural := 4;
  constant is_short : natural := 5;  -- its low byte is 1 or 2
  constant is_formatted : natural := 6;  -- its high half is that of a query
  constant is_clear : natural := 7;  -- what is below a number is zero
  -- As a word of a query, behind the header, it has only values that there are:
  constant is_options : natural := 8;
  constant is_row : natural := 9;
{%- if e.block_ram %}
  constant is_load : natural := 10;  -- its low half is that of a load
{%- endif %}
  constant kinds : natural := {{ e.query.kinds }};
{% include "engine/held_signals.vhd" %}
  signal ready : std_logic;
  signal arrives : std_logic;
  signal within_packet : std_logic := '0';  -- the last word that came was not the last of its packet
  signal stays_within : std_logic;
  signal whole : std_logic;
  signal taken : std_logic;

  signal at_header : std_logic := '1';  -- the next word is a header
  -- What the first word that is held is as a header, all of it looked at.
  type header_kind is record
    query : std_logic;
    pairs : std_logic;
    pose : std_logic;
    short : std_logic;  -- of kind 1 or 2, be it known or not
{%- if e.block_ram %}
    load : std_logic;
{%- endif %}
    stop : std_logic;  -- with nothing behind it
    soft_reset : std_logic;  -- with nothing behind it
    long_stop : std_logic;  -- or soft reset, with words behind it
  end record;
  signal header : header_kind;
  signal going : header_kind := (others => '0');  -- the same a clock later, when it is taken
  -- Behind it: what the word belongs to, or that it is left out.
  type expectation_state is (query_state, pose_state, pair_state, {% if e.block_ram %}address_state, load_state, {% endif %}skip_state);
  signal expectation : expectation_state := skip_state;
  -- Behind its header a pair begins here, to end where a pose does.
  constant pair_place : unsigned(5 downto 0) := to_unsigned(row_word - pair_words, 6);
  signal place : unsigned(5 downto 0) := "000000";  -- of the word in its packet, if that is a query; records of pairs and poses end where a query's pose does
  signal at_options : std_logic := '0';  -- the word with the options of a query
  signal at_record : std_logic := '0';  -- the first word of a pose or a pair
  signal at_record_end : std_logic := '0';  -- the last one
  signal at_rows : std_logic := '0';  -- one of the rows
  signal at_end : std_logic := '0';  -- the last word of a query
  signal behind : std_logic := '0';  -- words come after it
  signal gathers : std_logic := '0';  -- the word belongs to a query, a pose or a pair
  signal occupied : std_logic := '0';  -- a pair waits for the unit, or a pose moves to its place
  signal moving : std_logic := '0';  -- a pose does
  signal fault : std_logic_vector(4 downto 0) := fine;
  signal waits : std_logic;  -- the packet does
  signal goes : std_logic := '0';  -- the header is taken
  signal reset_taken : std_logic;  -- the word of a soft reset
  signal reset_now : std_logic := '0';  -- a clock later: control is busy from the next clock on
  signal clears : std_logic;
  signal shifts : std_logic;
  signal unfit : std_logic;  -- the word of a query has a value that there is not
  -- A packet has ended, a clock ago; what became of it.
  signal closing : std_logic := '0';
  signal closing_fault : std_logic_vector(4 downto 0) := fine;
  signal closing_query : std_logic := '0';
{%- if e.block_ram %}
  signal closing_load : std_logic := '0';
{%- endif %}
  signal closing_short : std_logic := '0';
  signal short_pending : std_logic := '0';
  signal pending : std_logic := '0';  -- the register has the words of a job
  signal query_pending : std_logic := '0';
  signal posed_pending : std_logic := '0';
  signal short : std_logic := '0';  -- the packet is of kind 1 or 2
  signal last_pair : std_logic := '0';
  signal words : std_logic_vector(job_bits - 1 downto 0) := (others => '0');
  signal number : std_logic_vector(23 downto 0) := (others => '0');
{%- if e.unit.signs.len() > 0 %}

  -- Numbers that are not the sign extension of what the unit reads of them.
  constant plus_signs : std_logic_vector({{ e.unit.sign_high }} downto 0) := (others => '0');
  constant minus_signs : std_logic_vector({{ e.unit.sign_high }} downto 0) := (others => '1');
  signal word_unfit : std_logic;
  signal record_unfit : std_logic := '0';
{%- endif %}
{%- if e.block_ram %}
  signal load_line : unsigned(load_line_bits downto 0) := (others => '0');
  signal load_place : unsigned(2 downto 0) := "000";
  signal load_triangles : std_logic := '0';
  signal beyond : std_logic;  -- the line is outside the memory
  signal address_unfit : std_logic;
{%- endif %}
begin
  ready <= running and not next_valid;
  s_axis_tready <= ready;
  arrives <= ready and s_axis_tvalid;
  whole <= '1' when s_axis_tkeep = all_bytes else '0';
  stays_within <= not s_axis_tlast when arrives = '1' else within_packet;
  kind(is_query) <= '1' when s_axis_tdata(31 downto 0) = query_header else '0';
  kind(is_stop) <= '1' when s_axis_tdata(31 downto 0) = stop_header else '0';
  kind(is_reset) <= '1' when s_axis_tdata(31 downto 0) = reset_header else '0';
  kind(is_pairs) <= '1' when s_axis_tdata(31 downto 0) = pairs_header else '0';
  kind(is_pose) <= '1' when s_axis_tdata(31 downto 0) = pose_header else '0';
  kind(is_short) <= '1' when s_axis_tdata(7 downto 0) = pairs_header(7 downto 0) or s_axis_tdata(7 downto 0) = pose_header(7 downto 0) else '0';
  kind(is_formatted) <= '1' when s_axis_tdata(63 downto 32) = query_format else '0';
  kind(is_clear) <= '1' when s_axis_tdata(39 downto 32) = "00000000" else '0';
  kind(is_options) <= '1' when s_axis_tdata(39 downto 36) = "0000" else '0';
  -- In simulation the bits of a word that is none may be unknown.
  kind(is_row) <= '0' when s_axis_tvalid = '0'{% for slot in e.query.checked_slots %}
    or to_01(unsigned(s_axis_tdata({{ slot.bits }}))) >= {{ slot.count }}{% endfor %} else
    '1' when s_axis_tdata(63 downto {{ e.query.row_bits }}) = "{{ e.query.row_zeros }}" else '0';
{%- if e.block_ram %}
  kind(is_load) <= '1' when s_axis_tdata(31 downto 0) = load_header else '0';
{%- endif %}

{% include "engine/held_words.vhd" %}

  -- ===== Packets =====
  -- A packet begins when its job has a place to go, and pairs when everything before them is done. The header of a query goes
  -- nowhere: its words wait for the register. A header is looked at in one clock and taken in the next; nothing that it waits for
  -- begins in between.
  header.query <= head_whole and head_kind(is_query) and head_kind(is_formatted);
  header.pairs <= head_whole and head_kind(is_pairs);
  header.pose <= head_whole and head_kind(is_pose);
  header.short <= head_kind(is_short);
{%- if e.block_ram %}
  header.load <= head_whole and head_kind(is_load);
{%- endif %}
  header.stop <= head_whole and head_last and head_kind(is_stop) and head_kind(is_clear);
  header.soft_reset <= head_whole and head_last and head_kind(is_reset) and head_kind(is_clear);
  header.long_stop <= head_whole and not head_last and (head_kind(is_stop) or head_kind(is_reset)) and head_kind(is_clear);
  waits <= reset_now or ((pending or closing) and (head_last or not header.query)) or (busy and {% if e.block_ram %}(header.load or header.pairs){% else %}header.pairs{% endif %});
  taken <= goes when at_header = '1' else head_valid and not occupied and not pending;
  reset_taken <= goes and going.soft_reset;
  clears <= reset or soft_reset or reset_taken;
  shifts <= (head_valid and gathers and not pending) or moving;
  unfit <= (at_options and not head_kind(is_options)) or (at_record and head(31)) or (at_rows and not head_kind(is_row));
{%- if e.unit.signs.len() > 0 %}
  word_unfit <= '1' when
{%- for sign in e.unit.signs %}
    (head({{ sign }}) /= plus_signs and head({{ sign }}) /= minus_signs){% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
{%- endif %}
{%- if e.block_ram %}
  beyond <= '1' when (load_triangles = '0' and load_line >= {{ e.memory.blocks }}) or (load_triangles = '1' and load_line >= {{ e.memory.triangles }}) else '0';
  address_unfit <= '1' when head(63 downto 32) /= x"00000000" or head(5 downto 0) /= "000000" else '0';
{%- endif %}

  receive : process (clk)
    variable found : std_logic_vector(4 downto 0);
    variable answer_short : std_logic;
    variable next_expectation : expectation_state;
  begin
    if rising_edge(clk) then
      next_expectation := expectation;
      if shifts = '1' then
        -- While a pose moves, the word behind it may be none: in simulation its bits are then unknown.
        words <= std_logic_vector(to_01(unsigned(head))) & words(job_bits - 1 downto 64);
      end if;
      stop <= '0';
      closing <= '0';
      reset_now <= reset_taken and not (reset or soft_reset);
      goes <= at_header and head_valid and not goes
        and (header.soft_reset or (not occupied and (header.stop or not waits)));
      going <= header;
      stop_number <= head(option_number);
      forget_number <= (others => '0');
      if (reset_taken and not soft_reset) = '1' then
        forget_number <= head(option_number);
      end if;
{%- if e.block_ram %}
      block_write <= '0';
      triangle_write <= '0';
      -- The bit above is set only beyond the memory, where nothing is written.
      write_line <= std_logic_vector(load_line(load_line_bits - 1 downto 0));
      write_place <= std_logic_vector(load_place);
      write_data <= head;
{%- endif %}
      if job_taken = '1' then
        pending <= '0';
      end if;
      if at_options = '1' and gathers = '1' then
        number <= head(option_number);
      end if;
      if taken = '1' or moving = '1' then
        place <= place + 1;
        at_options <= '0';
        if place = options_word - 1 then
          at_options <= '1';
        end if;
        at_record <= '0';
        if place = pose_word - 1 and expectation = query_state then
          at_record <= '1';
        end if;
        at_record_end <= '0';
        if place = row_word - 2 then
          at_record_end <= '1';
        end if;
        if place = row_word - 1 then
          at_rows <= '1';
        end if;
        at_end <= '0';
        if place = query_words - 2 then
          at_end <= '1';
        end if;
        if at_end = '1' then
          behind <= '1';
        end if;
      end if;
      -- Of a header that is taken; one that is not taken yet has them, too, as nothing looks at them before its next word.
      if at_header = '1' and moving = '0' then
        place <= "000001";
        if going.pose = '1' then
          place <= to_unsigned(pose_word, 6);
        elsif going.pairs = '1' then
          place <= pair_place;
        end if;
        at_options <= '0';
        at_record <= going.pose or going.pairs;
        at_record_end <= '0';
        at_rows <= '0';
        at_end <= '0';
        behind <= '0';
      end if;
      if moving = '1' and at_end = '1' then
        moving <= '0';
        occupied <= '0';
        pending <= '1';
        job_reason <= fine;
        query_pending <= '0';
        posed_pending <= '1';
        short_pending <= '1';
      end if;
      if pair_taken = '1' then
        occupied <= '0';
        if expectation = pair_state then
          gathers <= '1';
        end if;
      end if;
      if taken = '1' then
        at_header <= head_last;  -- behind a header alone there is none
        found := fault;
        answer_short := short;
{%- if e.unit.signs.len() > 0 %}
        if gathers = '1' and at_record = '1' then
          record_unfit <= '0';
        elsif gathers = '1' and at_rows = '0' then
          record_unfit <= record_unfit or word_unfit;
        end if;
{%- endif %}
        if at_header = '1' then
          answer_short := going.short;
          short <= going.short;
          gathers <= going.query or going.pose or going.pairs;
          found := fine;
          if head_last = '1' then
            found := too_short;  -- alone, the header of a packet that has words
          end if;
          if going.query = '1' then
            next_expectation := query_state;
          elsif going.pose = '1' then
            next_expectation := pose_state;
          elsif going.pairs = '1' then
            next_expectation := pair_state;
{%- if e.block_ram %}
          elsif going.load = '1' then
            next_expectation := address_state;
{%- endif %}
          elsif going.stop = '1' or going.soft_reset = '1' then
            found := fine;
            stop <= going.stop;
          else
            next_expectation := skip_state;
            found := unknown;
            if going.long_stop = '1' then
              found := too_long;
            end if;
          end if;
        elsif expectation = query_state then
          if fault = fine then
            if head_whole = '0' then
              found := too_short;
            elsif behind = '1' then
              found := too_long;
            elsif unfit = '1' then
              found := unknown;
            elsif head_last = '1' and at_end = '0' then
              found := too_short;
            end if;
          end if;
        elsif expectation = pose_state then
          if fault = fine then
            if at_rows = '1' then
              found := too_long;
            elsif head_whole = '0' or (head_last = '1' and at_record_end = '0') then
              found := too_short;
            elsif at_record_end = '1' then
              gathers <= '0';
              occupied <= head_last;
              moving <= head_last;
            end if;
          end if;
        elsif expectation = pair_state then
          if head_whole = '0' or (head_last = '1' and at_record_end = '0') then
            found := too_short;
            gathers <= '0';
            next_expectation := skip_state;
          elsif at_record_end = '1' then
            gathers <= '0';
            occupied <= '1';
            last_pair <= head_last;
            place <= pair_place;
            at_record <= '1';
            at_rows <= '0';
          end if;
{%- if e.block_ram %}
        elsif expectation = address_state then
          next_expectation := load_state;
          load_line <= '0' & unsigned(head({{ e.memory.load_line }}));
          load_place <= "000";
          load_triangles <= head(31);
          if head_whole = '0' or head_last = '1' then
            found := too_short;
          elsif address_unfit = '1' then
            found := unknown;
          end if;
          -- A line that has no number here is beyond both memories, as the one behind the last is.
          if head({{ e.memory.load_above }}) /= "{{ e.memory.load_zeros }}" then
            load_line(load_line_bits) <= '1';
          end if;
        elsif expectation = load_state then
          load_place <= load_place + 1;
          if load_place = 7 then
            load_line <= load_line + 1;
          end if;
          if fault = fine then
            if head_whole = '0' then
              found := too_short;
            elsif beyond = '1' then
              found := too_long;
            else
              block_write <= not load_triangles;
              triangle_write <= load_triangles;
              if head_last = '1' and load_place /= 7 then
                found := too_short;
              end if;
            end if;
          end if;
{%- endif %}
        end if;
        fault <= found;
        if head_last = '1' then
          next_expectation := skip_state;
          fault <= fine;
          gathers <= '0';
          closing <= '1';
          closing_fault <= found;
          closing_query <= '0';
          if expectation = query_state then
            closing_query <= '1';
          end if;
{%- if e.block_ram %}
          closing_load <= '0';
          if expectation = load_state then
            closing_load <= '1';
          end if;
{%- endif %}
          closing_short <= answer_short;
        end if;
      end if;
      -- A stop has no answer, pairs are no job, and a pose becomes one when it is in its place.
      if closing = '1' and (closing_fault /= fine or closing_query = '1'{% if e.block_ram %} or closing_load = '1'{% endif %}) then
        pending <= '1';
        query_pending <= '0';
        posed_pending <= '0';
        short_pending <= closing_short;
        job_reason <= closing_fault;
        if closing_fault = fine then
          query_pending <= closing_query;
          posed_pending <= closing_query;
        elsif closing_short = '1' then
          -- 6, 7 and 8 become 1, 2 and 3: the two low bits tell them apart.
          job_reason <= "000" & std_logic_vector(unsigned(closing_fault(1 downto 0)) - 1);
        end if;
      end if;
      -- What is forgotten by reset and by both kinds of soft reset. That of the port drops the rest of a packet, too.
      if clears = '1' then
        next_expectation := skip_state;
        pending <= '0';
        closing <= '0';
        goes <= '0';
        query_pending <= '0';
        posed_pending <= '0';
        fault <= fine;
        gathers <= '0';
        occupied <= '0';
        moving <= '0';
        stop <= '0';
        at_header <= not (soft_reset and stays_within) or reset;
{%- if e.block_ram %}
        block_write <= '0';
        triangle_write <= '0';
{%- endif %}
      end if;
      expectation <= next_expectation;
    end if;
  end process receive;
  job_valid <= pending;
  forgets <= soft_reset or reset_taken;
  job_words <= words;
  job_query <= query_pending;
  job_posed <= posed_pending;
  job_short <= short_pending;
{%- if e.unit.signs.len() > 0 %}
  job_unfit <= record_unfit;
  pair_unfit <= record_unfit;
{%- endif %}
  pair_valid <= occupied and not moving;
  pair_last <= last_pair;
  job_number <= number when query_pending = '1' else (others => '0');
end architecture rtl;
