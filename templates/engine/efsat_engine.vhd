--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}efsat_engine is
  port (
{%- if e.engines.several %}
    renew_caches : in std_logic;  -- one clock long: another engine has a query that does not keep them
{%- endif %}
{% let read_ports = [""] -%}
{%- include "engine/ports.vhd" %}
  );
end entity {{ prefix }}efsat_engine;

architecture rtl of {{ prefix }}efsat_engine is
  signal reset : std_logic;
  signal reset_word : std_logic;  -- a soft reset by the stream
  signal forget : std_logic;  -- a soft reset
  signal forget_number : std_logic_vector(23 downto 0);  -- for its report
  signal forgotten : std_logic;
  signal restart : std_logic;  -- all that works on a query forgets it

  -- Jobs and the queries in flight
  signal job_valid : std_logic;
  signal job_taken : std_logic;
  signal job_query : std_logic;
  signal job_posed : std_logic;
  signal job_short : std_logic;
  signal job_reason : std_logic_vector(4 downto 0);
  signal job_number : std_logic_vector(23 downto 0);
  signal job_words : std_logic_vector(job_bits - 1 downto 0);
  signal job_lane : std_logic_vector(lane_bits - 1 downto 0);
{%- if e.unit.signs.len() > 0 %}
  signal job_unfit : std_logic;
  signal packet_unfit : std_logic;  -- of the pair: a number is no sign extension
  signal pose_unfit : std_logic := '0';  -- the same of the pose
{%- endif %}
  signal packet_valid : std_logic;  -- a pair of a packet, not of a query
  signal packet_taken : std_logic;
  signal packet_last : std_logic;
  signal stop : std_logic;
  signal stop_number : std_logic_vector(23 downto 0);  -- of the query that a stop means, or that comes with a reset word
  signal pose_valid : std_logic;
  signal pose_ready : std_logic;
  signal busy : std_logic;
  signal running : std_logic;
  signal oldest : std_logic_vector(lane_bits - 1 downto 0);
  signal retire : std_logic;
  signal counting : std_logic_vector(lanes - 1 downto 0);
  signal posed : std_logic_vector(lanes - 1 downto 0);
  signal started : std_logic_vector(lanes - 1 downto 0);
  signal ending : std_logic_vector(lanes - 1 downto 0);
  signal dropping : std_logic;
  signal start : std_logic;
  signal start_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal most_expansions : std_logic_vector(31 downto 0);
  signal abort : std_logic;
  signal checked_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal checked : std_logic_vector(head_bits - 1 downto 0);
  signal block_base_a : std_logic_vector(31 downto 0);
  signal block_base_b : std_logic_vector(31 downto 0);
  signal triangle_base_a : std_logic_vector(31 downto 0);
  signal triangle_base_b : std_logic_vector(31 downto 0);
  signal block_count_a : std_logic_vector(31 downto 0);
  signal block_count_b : std_logic_vector(31 downto 0);
  signal triangle_count_a : std_logic_vector(31 downto 0);
  signal triangle_count_b : std_logic_vector(31 downto 0);
  signal stop_at_contact : std_logic;
  signal ends_at_contact : std_logic;
  signal option_separate_too : std_logic;
  signal separate_too : std_logic;
  signal leaves_of : std_logic_vector(lanes - 1 downto 0);
  signal leaves_only : std_logic;  -- of the query whose pairs are at the unit
  signal query_pose : std_logic_vector(query_pose_bits - 1 downto 0);
  signal query_shift : std_logic_vector(query_shift_bits - 1 downto 0);
  signal query_errors : std_logic_vector(query_errors_bits - 1 downto 0);
  signal query_rows : std_logic_vector(query_rows_bits - 1 downto 0);
  signal pose : std_logic_vector(pose_bits - 1 downto 0);
  signal pose_words : std_logic_vector(job_pose);
  signal short : std_logic;
  signal reason : std_logic_vector(4 downto 0);
  signal number : std_logic_vector(23 downto 0);
  signal report_due : std_logic;
  signal report_done : std_logic;
  signal idle : std_logic_vector(lanes - 1 downto 0);
  signal traverse_idle : std_logic_vector(lanes - 1 downto 0);
  signal pairs_idle : std_logic_vector(lanes - 1 downto 0);
  signal pairs_read : std_logic;
  signal reads : std_logic;
  signal bad_tree : std_logic_vector(lanes - 1 downto 0);
  signal limit_reached : std_logic_vector(lanes - 1 downto 0);
  signal contact : std_logic;

  -- Blocks and volumes
  signal block_request : std_logic;
  signal block_accepted : std_logic;
  signal request_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal request_a : std_logic_vector(node_bits - 1 downto 0);
  signal request_b : std_logic_vector(node_bits - 1 downto 0);
  signal blocks_valid : std_logic;
  signal blocks_taken : std_logic;
  signal block_a : std_logic_vector(block_bits - 1 downto 0);
  signal block_b : std_logic_vector(block_bits - 1 downto 0);
  signal volume_valid : std_logic;
  signal volume_ready : std_logic;
  signal take_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal take_a : std_logic_vector(1 downto 0);
  signal take_b : std_logic_vector(1 downto 0);
  signal survive_valid : std_logic;
  signal survive : std_logic_vector(3 downto 0);

  -- Pairs of leaves and their triangles
  signal pair_valid : std_logic;
  signal pair_ready : std_logic;
  signal pair_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal pair_left : std_logic_vector(lanes - 1 downto 0);
  signal front : std_logic_vector(lane_bits - 1 downto 0);
  signal pair_a : std_logic_vector(27 downto 0);
  signal pair_b : std_logic_vector(27 downto 0);
  signal triangle_request : std_logic;
  signal triangle_accepted : std_logic;
  signal leaf_a : std_logic_vector(27 downto 0);
  signal leaf_b : std_logic_vector(27 downto 0);
  signal triangles_valid : std_logic;
  signal triangles_there : std_logic;{% if e.unit.paced %}  -- and not sent yet{% endif %}
  signal triangles_go : std_logic;  -- to the unit, or past it, or they are dropped
  signal triangles_taken : std_logic{% if e.unit.paced %} := '0';  -- the same, a clock ago{% else %};{% endif %}
  signal triangles_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal testable : std_logic;
  signal drops : std_logic;
  signal tests_them : std_logic;  -- they are for the unit
  signal passes_them : std_logic;  -- they are for the way past it
  signal triangle_a : std_logic_vector(triangle_bits - 1 downto 0);
  signal triangle_b : std_logic_vector(triangle_bits - 1 downto 0);
  signal numbers : std_logic_vector(55 downto 0);
  signal unit_v : std_logic_vector(287 downto 0);  -- nine words for each triangle
  signal unit_w : std_logic_vector(287 downto 0);
{%- if e.unit.sticky %}
  signal sticky_v : std_logic_vector(8 downto 0);
  signal sticky_w : std_logic_vector(8 downto 0);
{%- endif %}
  signal unit_tag : std_logic_vector(lane_bits + 55 downto 0);
  signal unit_valid : std_logic;
  signal unit_ready : std_logic;
  signal tested_valid : std_logic;
  signal tested_verdict : std_logic_vector(1 downto 0);
  signal tested_separated : std_logic_vector({{ e.unit.flags }});
  signal tested_overlapping : std_logic_vector({{ e.unit.flags }});
{%- if e.unit.guarded %}
  signal tested_outside : std_logic;
{%- endif %}
  signal tested_tag : std_logic_vector(lane_bits + 55 downto 0);
  signal tested_numbers : std_logic_vector(55 downto 0);
  constant tag_last : natural := {{ e.unit.tag_last }};  -- of a pair of a packet: it is the last one
{%- if e.unit.signs.len() > 0 %}
  constant tag_unfit : natural := {{ e.unit.tag_unfit }};  -- a number of it does not fit
{%- endif %}
  signal tested_flags : std_logic_vector(39 downto 0);
{%- if e.unit.signs.len() > 0 %}
  signal tested_unfit : std_logic;
{%- endif %}
  signal tested_taken : std_logic;
  signal decided_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal answerable : std_logic;  -- no older query has to be answered first
  signal decided_taken : std_logic;
  signal decided_valid : std_logic;
  signal decided_ready : std_logic;
  signal verdict : std_logic_vector(1 downto 0);
  signal decided_numbers : std_logic_vector(55 downto 0);
  signal decided_last : std_logic;
{%- if e.unit.guarded %}
  signal decided_outside : std_logic;
{%- endif %}
  signal bypass_free : std_logic;
  signal bypassed_valid : std_logic := '0';
  signal bypassed_numbers : std_logic_vector(55 downto 0) := (others => '0');
  signal pair_answered : std_logic;

  -- Events
  signal expanded : std_logic;
  signal expanded_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal tests : std_logic_vector(2 downto 0);
  signal tested_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal survived : std_logic_vector(2 downto 0);
  signal survived_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal paired : std_logic;
  signal waiting : std_logic;
  signal starved : std_logic;
  signal stalled : std_logic;
  signal triangles_asked : std_logic;
  signal block_reads : std_logic_vector(1 downto 0);
  signal triangle_reads : std_logic_vector(1 downto 0);
  signal words_read : std_logic;
  signal clear : std_logic_vector(lanes - 1 downto 0);
  signal renew : std_logic;
  signal greatest_stack : unsigned(15 downto 0);
{%- if e.block_ram %}

  -- Words to be stored
  signal block_write : std_logic;
  signal triangle_write : std_logic;
  signal write_line : std_logic_vector(load_line_bits - 1 downto 0);
  signal write_place : std_logic_vector(2 downto 0);
  signal write_data : std_logic_vector(63 downto 0);
{%- else %}

  -- Memory: blocks of A, blocks of B, triangles of A, triangles of B
  signal memory_error : std_logic;
  signal memory_draining : std_logic;
  signal memory_silent : std_logic;
  signal flush : std_logic;
  signal flushing : std_logic;
  signal busy_caches : std_logic_vector(3 downto 0);
  signal ask_valid : std_logic_vector(3 downto 0);
  signal ask_ready : std_logic_vector(3 downto 0);
  signal ask_address_0 : std_logic_vector(25 downto 0);
  signal ask_address_1 : std_logic_vector(25 downto 0);
  signal ask_address_2 : std_logic_vector(25 downto 0);
  signal ask_address_3 : std_logic_vector(25 downto 0);
  signal fill_valid : std_logic_vector(3 downto 0);
  signal fill_data : std_logic_vector(memory_width - 1 downto 0);
  signal line_ready : std_logic_vector(3 downto 0);
  signal line_valid : std_logic_vector(3 downto 0);
  signal missed : std_logic_vector(3 downto 0);
  signal both_blocks_ask : std_logic;
  signal both_triangles_ask : std_logic;
{%- endif %}
begin
  reset <= not aresetn;
  forget <= soft_reset or reset_word;
  forget_number <= stop_number when reset_word = '1' else (others => '0');
  forgotten <= reset or forget;
  restart <= forgotten or abort;
  idle <= traverse_idle and pairs_idle;
  reads <= pairs_read or not traverse_idle(to_integer(unsigned(oldest)));

  -- ===== Queries =====
  command : entity work.{{ prefix }}engine_command
    port map (
      clk => aclk,
      reset => reset,
      soft_reset => soft_reset,
      s_axis_tdata => s_axis_tdata,
      s_axis_tkeep => s_axis_tkeep,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tlast => s_axis_tlast,
      s_axis_tready => s_axis_tready,
      job_valid => job_valid,
      job_taken => job_taken,
      job_query => job_query,
      job_posed => job_posed,
      job_short => job_short,
      job_reason => job_reason,
      job_number => job_number,
      job_words => job_words,
{%- if e.unit.signs.len() > 0 %}
      job_unfit => job_unfit,
{%- endif %}
      busy => busy,
      pair_valid => packet_valid,
      pair_taken => packet_taken,
      pair_last => packet_last,
{%- if e.unit.signs.len() > 0 %}
      pair_unfit => packet_unfit,
{%- endif %}
{%- if e.block_ram %}
      block_write => block_write,
      triangle_write => triangle_write,
      write_line => write_line,
      write_place => write_place,
      write_data => write_data,
{%- endif %}
      stop => stop,
      reset_word => reset_word,
      stop_number => stop_number
    );

  control : entity work.{{ prefix }}engine_control
    port map (
      clk => aclk,
      reset => reset,
      forget => forget,
      forget_number => forget_number,
      job_valid => job_valid,
      job_taken => job_taken,
      job_query => job_query,
      job_posed => job_posed,
      job_short => job_short,
      job_reason => job_reason,
      job_number => job_number,
      job_lane => job_lane,
      stop => stop,
      stop_number => stop_number,
      checked_lane => checked_lane,
      checked => checked,
      busy => busy,
      running => running,
      oldest => oldest,
      counting => counting,
      posed => posed,
      started => started,
      ending => ending,
      dropping => dropping,
      start => start,
      start_lane => start_lane,
      most_expansions => most_expansions,
      abort => abort,
      retire => retire,
      idle => idle,
      contact => contact,
      limit_reached => limit_reached,
      bad_tree => bad_tree,
{%- if e.axi %}
      reads => reads,
      memory_error => memory_error,
      memory_draining => memory_draining,
      memory_silent => memory_silent,
      flush => flush,
      flushing => flushing,
{%- if e.engines.several %}
      renew => renew_caches,
{%- endif %}
{%- endif %}
      report_due => report_due,
      report_done => report_done,
      short => short,
      reason => reason,
      number => number
    );

  queries : entity work.{{ prefix }}engine_queries
    port map (
      clk => aclk,
      reset => forgotten,
      store => job_taken,
      store_lane => job_lane,
      job_words => job_words,
      job_query => job_query,
      retire => retire,
      oldest => oldest,
      checked_lane => checked_lane,
      checked => checked,
      request_lane => request_lane,
      block_base_a => block_base_a,
      block_base_b => block_base_b,
      block_count_a => block_count_a,
      block_count_b => block_count_b,
      triangle_count_a => triangle_count_a,
      triangle_count_b => triangle_count_b,
      volume_lane => take_lane,
      query_pose => query_pose,
      query_shift => query_shift,
      query_errors => query_errors,
      query_rows => query_rows,
      front => front,
      triangle_base_a => triangle_base_a,
      triangle_base_b => triangle_base_b,
      pose => pose,
      leaves_only => leaves_of,
      stop_at_contact => stop_at_contact,
      separate_too => option_separate_too
    );
  pose_words <= pose;
  leaves_only <= leaves_of(to_integer(unsigned(front)));
  -- Of packets of pairs all are answered: what the options of the last query in the lane were means nothing.
  separate_too <= option_separate_too or not running;
  ends_at_contact <= stop_at_contact and running;
{%- if e.unit.signs.len() > 0 %}

  -- With the bypass the numbers of a pose are not read.
  look : process (aclk)
  begin
    if rising_edge(aclk) then
      if forgotten = '1' then
        pose_unfit <= '0';
      elsif (job_taken and job_posed) = '1' then
        pose_unfit <= job_unfit and not job_words(job_bypass);
      end if;
    end if;
  end process look;
{%- endif %}

  -- ===== Volumes =====
  traverse : entity work.{{ prefix }}engine_traverse
    port map (
      clk => aclk,
      reset => restart,
      start => start,
      start_lane => start_lane,
      most_expansions => most_expansions,
      oldest => oldest,
      ending => ending,
      block_count_a => block_count_a,
      block_count_b => block_count_b,
      triangle_count_a => triangle_count_a,
      triangle_count_b => triangle_count_b,
      request_valid => block_request,
      request_ready => block_accepted,
      request_lane => request_lane,
      request_a => request_a,
      request_b => request_b,
      blocks_taken => blocks_taken,
      block_a => block_a,
      block_b => block_b,
      take_lane => take_lane,
      take_a => take_a,
      take_b => take_b,
      survive_valid => survive_valid,
      survive => survive,
      pair_valid => pair_valid,
      pair_ready => pair_ready,
      pair_lane => pair_lane,
      pair_left => pair_left,
      pair_a => pair_a,
      pair_b => pair_b,
      idle => traverse_idle,
      waiting => waiting,
      bad_tree => bad_tree,
      limit_reached => limit_reached,
      expanded => expanded,
      expanded_lane => expanded_lane,
      tested => tests,
      tested_lane => tested_lane,
      survived => survived,
      survived_lane => survived_lane,
      greatest_stack => greatest_stack
    );
  -- While a job is stored, the words of a query are not read.
  volume_valid <= blocks_valid and not job_taken;
  blocks_taken <= volume_valid and volume_ready;

  volume : entity work.{{ prefix }}volume_unit
    port map (
      clk => aclk,
      reset => restart,
      query_pose => query_pose,
      query_shift => query_shift,
      query_errors => query_errors,
      query_rows => query_rows,
      in_valid => volume_valid,
      in_ready => volume_ready,
      in_block_a => block_a,
      in_block_b => block_b,
      in_take_a => take_a,
      in_take_b => take_b,
      out_valid => survive_valid,
      out_survive => survive
    );

  -- ===== Triangles =====
  pairs : entity work.{{ prefix }}engine_pairs
    port map (
      clk => aclk,
      reset => restart,
      oldest => oldest,
      retire => retire,
      posed => posed,
      started => started,
      ending => ending,
      leaves_only => leaves_of,
      traversed => traverse_idle,
      pair_valid => pair_valid,
      pair_ready => pair_ready,
      pair_lane => pair_lane,
      pair_a => pair_a,
      pair_b => pair_b,
      pair_left => pair_left,
      front => front,
      request_valid => triangle_request,
      request_ready => triangle_accepted,
      request_a => leaf_a,
      request_b => leaf_b,
      triangles_valid => triangles_there,
      triangles_taken => triangles_taken,
      triangles_lane => triangles_lane,
      testable => testable,
      drops => drops,
      pose_valid => pose_valid,
      pose_ready => pose_ready,
      sent => packet_taken,
      answered => pair_answered,
      idle => pairs_idle,
      reads => pairs_read
    );
  triangles_asked <= triangle_request and triangle_accepted;

  -- While no query runs, the unit tests pairs of packets: the last words of the stream. Above the {{ e.unit.pair_tag_bits }} bits of their tag the
  -- unit's tag says which is the last of its packet{% if e.unit.signs.len() > 0 %}, and which has a number that does not fit{% endif %}.
  -- A number of a triangle has a place of 32 bits, of which the unit reads the low ones: the others are its sign{% if e.unit.signs.len() > 0 %}, which is looked at for
  -- pairs of packets{% endif %}.
  unit_v <= triangle_a(triangle_corners) when running = '1' else job_words(job_pair_v);
  unit_w <= triangle_b(triangle_corners) when running = '1' else job_words(job_pair_w);
{%- if e.unit.sticky %}
  sticky_v <= triangle_a(triangle_sticky) when running = '1' else job_words(job_pair_sticky_v);
  sticky_w <= triangle_b(triangle_sticky) when running = '1' else job_words(job_pair_sticky_w);
{%- endif %}
  unit_tag <= triangles_lane & numbers when running = '1' else
    "{{ e.unit.unit_tag_zeros }}" & {% if e.unit.signs.len() > 0 %}(packet_unfit or pose_unfit) & {% endif %}packet_last & job_words(job_pair_tag);
  packet_taken <= packet_valid and unit_ready;

  -- With leaves_only pairs pass by the unit, which is empty then, through a register: their numbers come late out of block RAM.
  -- The numbers of triangles are in the low bits of the first word, {{ e.unit.triangle_number_bits }} of them.
  numbers <= {{ e.unit.number_above }}triangle_b(triangle_number) & {{ e.unit.number_above }}triangle_a(triangle_number);
  bypass_free <= not bypassed_valid;
  tests_them <= triangles_there and testable and not leaves_only and not drops;
  passes_them <= triangles_there and testable and leaves_only and not drops;
  unit_valid <= tests_them or packet_valid;
  triangles_go <= triangles_there and (drops or (passes_them and bypass_free) or (tests_them and unit_ready));
{%- if e.unit.paced %}
  -- Whether the triangles go is known late in a clock: the memory hears of it a clock later, which costs a pair nothing, because
  -- the unit does not take the next one at once.
  triangles_there <= triangles_valid and not triangles_taken;

  send : process (aclk)
  begin
    if rising_edge(aclk) then
      triangles_taken <= triangles_go and not restart;
    end if;
  end process send;
{%- else %}
  triangles_there <= triangles_valid;
  triangles_taken <= triangles_go;
{%- endif %}

  bypass : process (aclk)
  begin
    if rising_edge(aclk) then
      if bypass_free = '1' then
        bypassed_numbers <= numbers;
      end if;
      if restart = '1' then
        bypassed_valid <= '0';
      elsif bypass_free = '1' then
        bypassed_valid <= passes_them;
      elsif decided_taken = '1' then
        bypassed_valid <= '0';
      end if;
    end if;
  end process bypass;

  unit : entity work.{{ prefix }}efsat
    port map (
      clk => aclk,
      reset => restart,
      in_valid => unit_valid,
      in_ready => unit_ready,
      in_tag => unit_tag,
{%- for field in e.unit.unit_inputs %}
      {{ field.port }} => {{ field.value }},
{%- endfor %}
      pose_valid => pose_valid,
      pose_ready => pose_ready,
      pose_bypass => pose_words(job_bypass),
      out_valid => tested_valid,
      out_ready => tested_taken,
      out_verdict => tested_verdict,
      out_separated => tested_separated,
      out_overlapping => tested_overlapping,
{%- if e.unit.guarded %}
      out_outside => tested_outside,
{%- endif %}
      out_tag => tested_tag
    );
  tested_numbers <= tested_tag(55 downto 0);
  decided_lane <= front when leaves_only = '1' else tested_tag(lane_bits + 55 downto 56);
  answerable <= '1' when decided_lane = oldest or running = '0' else '0';
  decided_taken <= decided_ready and answerable;
  tested_taken <= decided_taken and not leaves_only;
  decided_valid <= bypassed_valid and answerable when leaves_only = '1' else tested_valid and answerable;
{%- if e.unit.signs.len() > 0 %}
  tested_unfit <= tested_numbers(tag_unfit) and not running;
  verdict <= "10" when leaves_only = '1' or tested_unfit = '1' else tested_verdict;
  tested_flags <= (others => '0') when tested_unfit = '1' else "{{ e.unit.flag_zeros }}" & tested_overlapping & tested_separated;
  decided_outside <= (tested_outside or tested_unfit) and not running;
{%- else %}
  verdict <= "10" when leaves_only = '1' else tested_verdict;
  tested_flags <= "{{ e.unit.flag_zeros }}" & tested_overlapping & tested_separated;
{%- if e.unit.guarded %}
  decided_outside <= tested_outside and not running;
{%- endif %}
{%- endif %}
  decided_numbers <= bypassed_numbers when leaves_only = '1' else
    tested_numbers when running = '1' else
    tested_flags & tested_numbers({{ e.unit.pair_tag }});
  decided_last <= tested_numbers(tag_last) and not running;

  -- ===== Answers =====
  answer : entity work.{{ prefix }}engine_answer
    port map (
      clk => aclk,
      reset => reset,
      restart => restart,
      decided_valid => decided_valid,
      decided_ready => decided_ready,
      verdict => verdict,
      numbers => decided_numbers,
      last => decided_last,
{%- if e.unit.guarded %}
      outside => decided_outside,
{%- endif %}
      dropping => dropping,
      separate_too => separate_too,
      stop_at_contact => ends_at_contact,
      pair_answered => pair_answered,
      contact => contact,
      report_due => report_due,
      report_done => report_done,
      short => short,
      reason => reason,
      number => number,
      oldest => oldest,
      clear => clear,
      counting => counting,
      expanded => expanded,
      expanded_lane => expanded_lane,
      tested => tests,
      tested_lane => tested_lane,
      survived => survived,
      survived_lane => survived_lane,
      paired => paired,
      paired_lane => pair_lane,
      renew => renew,
      block_reads => block_reads,
      triangles_asked => triangles_asked,
      triangle_reads => triangle_reads,
      words_read => words_read,
      starved => starved,
      stalled => stalled,
      greatest_stack => greatest_stack,
      m_axis_tdata => m_axis_tdata,
      m_axis_tkeep => m_axis_tkeep,
      m_axis_tvalid => m_axis_tvalid,
      m_axis_tlast => m_axis_tlast,
      m_axis_tready => m_axis_tready
    );
  begin_again : for lane in 0 to lanes - 1 generate
    clear(lane) <= reset or job_taken or (abort and not counting(lane)) when unsigned(job_lane) = lane else
      reset or abort when unsigned(oldest) /= lane else reset;
  end generate begin_again;
  renew <= reset or retire or not running;
  paired <= pair_valid and pair_ready;
  starved <= volume_ready and waiting and not blocks_valid;
  stalled <= pair_valid and not pair_ready;

  -- ===== Memory =====
{%- if e.block_ram %}
  -- A line or base in the memory has no bits above these: commands write, and control runs queries, within it alone.
  block_memory : entity work.{{ prefix }}engine_block_memory
    port map (
      clk => aclk,
      reset => restart,
      write_valid => block_write,
      write_line => write_line(block_line_bits - 1 downto 0),
      write_place => write_place,
      write_data => write_data,
      base_a => block_base_a(block_line_bits - 1 downto 0),
      base_b => block_base_b(block_line_bits - 1 downto 0),
      request_valid => block_request,
      request_ready => block_accepted,
      request_a => request_a,
      request_b => request_b,
      lines_valid => blocks_valid,
      lines_taken => blocks_taken,
      line_a => block_a,
      line_b => block_b
    );

  triangle_memory : entity work.{{ prefix }}engine_triangle_memory
    port map (
      clk => aclk,
      reset => restart,
      write_valid => triangle_write,
      write_line => write_line(triangle_line_bits - 1 downto 0),
      write_place => write_place,
      write_data => write_data,
      base_a => triangle_base_a(triangle_line_bits - 1 downto 0),
      base_b => triangle_base_b(triangle_line_bits - 1 downto 0),
      request_valid => triangle_request,
      request_ready => triangle_accepted,
      request_a => leaf_a,
      request_b => leaf_b,
      lines_valid => triangles_valid,
      lines_taken => triangles_taken,
      line_a => triangle_a,
      line_b => triangle_b
    );
  block_reads <= "00";
  triangle_reads <= "00";
  words_read <= '0';
{%- else %}
  -- Bases are addresses / 64: control runs no query about a tree that ends beyond 2^32, so bits 31..26 are zero where a line is read.
{%- for cache in e.memory.caches %}
  {{ cache.label }} : entity work.{{ prefix }}{{ cache.entity }}
    port map (
      clk => aclk,
      reset => restart,
      flush => flush,
      flushing => busy_caches({{ loop.index0 }}),
      base => {{ cache.base }}(25 downto 0),
      request_valid => {{ cache.request }},
      request_ready => line_ready({{ loop.index0 }}),
      request => {{ cache.number }},
      line_valid => line_valid({{ loop.index0 }}),
      line_taken => {{ cache.taken }},
      data => {{ cache.line }},
      ask_valid => ask_valid({{ loop.index0 }}),
      ask_ready => ask_ready({{ loop.index0 }}),
      ask_address => ask_address_{{ loop.index0 }},
      fill_valid => fill_valid({{ loop.index0 }}),
      fill_data => fill_data,
      missed => missed({{ loop.index0 }})
    );
{% endfor %}
  -- Both sides take a request, or none; so do both give their lines.
  block_accepted <= line_ready(0) and line_ready(1);
  both_blocks_ask <= block_request and block_accepted;
  triangle_accepted <= line_ready(2) and line_ready(3);
  both_triangles_ask <= triangle_request and triangle_accepted;
  blocks_valid <= line_valid(0) and line_valid(1);
  triangles_valid <= line_valid(2) and line_valid(3);
  flushing <= '0' when busy_caches = "0000" else '1';
  -- Caches 0 and 1 hold blocks, 2 and 3 triangles.
  block_reads <= missed(1 downto 0);
  triangle_reads <= missed(3 downto 2);

  read_master : entity work.{{ prefix }}engine_read_master
    port map (
      clk => aclk,
      reset => reset,
      restart => restart,
      ask_valid => ask_valid,
      ask_ready => ask_ready,
      ask_address_0 => ask_address_0,
      ask_address_1 => ask_address_1,
      ask_address_2 => ask_address_2,
      ask_address_3 => ask_address_3,
      fill_valid => fill_valid,
      fill_data => fill_data,
      failed => memory_error,
      draining => memory_draining,
      silent => memory_silent,
      word_read => words_read,
{% include "engine/read_port.vhd" %}
{%- endif %}
end architecture rtl;
