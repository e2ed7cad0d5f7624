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
  signal forgets : std_logic;  -- a soft reset
  signal forget : std_logic := '0';  -- the same, a clock later
  signal forget_number : std_logic_vector(23 downto 0);  -- for its report
  signal forgotten : std_logic;
  signal restart : std_logic := '0';  -- all that works on a query forgets it

  -- Jobs and the queries in flight
  signal job_valid : std_logic;
  signal job_taken : std_logic;
  signal job_stored : std_logic;
  signal job_query : std_logic;
  signal job_posed : std_logic;
  signal job_short : std_logic;
  signal job_reason : std_logic_vector(4 downto 0);
  signal job_number : std_logic_vector(23 downto 0);
  signal job_words : std_logic_vector(job_bits - 1 downto 0);
  signal job_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal job_flags : lane_flags;
{%- if e.unit.signs.len() > 0 %}
  signal job_unfit : std_logic;
  signal packet_unfit : std_logic;  -- of the pair: a number is no sign extension
{%- endif %}
  signal packet_valid : std_logic;  -- a pair of a packet, not of a query
  signal packet_taken : std_logic;
  signal packet_last : std_logic;
  signal stop : std_logic;
  signal stop_number : std_logic_vector(23 downto 0);  -- of the query that a stop means
  signal pose_valid : std_logic;
  signal pose_ready : std_logic;
  signal busy : std_logic;
  signal running : std_logic;
  signal oldest : std_logic_vector(lane_bits - 1 downto 0);
  signal oldest_flags : lane_flags;
  signal retire : std_logic;
  signal counting : lane_flags;
  signal posed : lane_flags;
  signal started : lane_flags;
  signal ending : lane_flags;
  signal dropping : std_logic;
  signal start : std_logic;
  signal start_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal most_expansions : std_logic_vector(31 downto 0);
{%- if e.axi %}
  signal aborts : std_logic;
{%- endif %}
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
  signal leaves_of : lane_flags;
  signal leaves_only : std_logic := '0';  -- of the query whose pairs are at the unit
  signal query_pose : std_logic_vector(query_pose_bits - 1 downto 0);
  signal query_shift : std_logic_vector(query_shift_bits - 1 downto 0);
  signal query_errors : std_logic_vector(query_errors_bits - 1 downto 0);
  signal query_rows : std_logic_vector(query_rows_bits - 1 downto 0);
  signal pose : std_logic_vector(pose_bits - 1 downto 0);
  signal short : std_logic;
  signal reason : std_logic_vector(4 downto 0);
  signal number : std_logic_vector(23 downto 0);
  signal report_due : std_logic;
  signal report_done : std_logic;
  signal idle : lane_flags;
  signal traverse_idle : lane_flags;
  signal pairs_idle : lane_flags;
  signal pairs_read : std_logic;
  signal reads : std_logic;
  signal bad_tree : lane_flags;
  signal limit_reached : lane_flags;
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
  signal query_written : std_logic;
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
  signal pair_left : lane_flags;
  signal front : std_logic_vector(lane_bits - 1 downto 0);
  signal pair_a : std_logic_vector(27 downto 0);
  signal pair_b : std_logic_vector(27 downto 0);
  signal triangle_request : std_logic;
  signal triangle_accepted : std_logic;
  signal leaf_a : std_logic_vector(27 downto 0);
  signal leaf_b : std_logic_vector(27 downto 0);
  signal triangles_valid : std_logic;
  signal triangles_there : std_logic;{% if e.unit.paced %}  -- and not sent yet{% if e.unit.offers %}, nor offered{% endif %}{% endif %}
  signal triangles_taken : std_logic;
  signal triangles_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal testable : std_logic;
  signal drops : std_logic;
  signal triangle_a : std_logic_vector(triangle_bits - 1 downto 0);
  signal triangle_b : std_logic_vector(triangle_bits - 1 downto 0);
  signal decided_valid : std_logic;
  signal decided_ready : std_logic;
  signal decided_lane : std_logic_vector(lane_bits - 1 downto 0);
  signal verdict : std_logic_vector(1 downto 0);
  signal decided_numbers : std_logic_vector(55 downto 0);
  signal decided_last : std_logic;
{%- if e.unit.guarded %}
  signal decided_outside : std_logic;
{%- endif %}
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
  signal clear : lane_flags;
  signal renew : std_logic := '1';
  signal greatest_stack : unsigned(15 downto 0);
{%- if e.block_ram %}

  -- Words to be stored
  signal block_write : std_logic;
  signal triangle_write : std_logic;
  signal write_line : std_logic_vector(load_line_bits - 1 downto 0);
  signal write_place : std_logic_vector(2 downto 0);
  signal write_data : std_logic_vector(63 downto 0);
{%- else %}

  -- Memory
  signal memory_error : std_logic;
  signal memory_draining : std_logic;
  signal memory_silent : std_logic;
  signal flush : std_logic;
  signal flushing : std_logic;
{%- endif %}
begin
  reset <= not aresetn;
  forgotten <= reset or forget;
  idle <= traverse_idle and pairs_idle;
  reads <= pairs_read or not traverse_idle(to_integer(unsigned(oldest)));

  -- In registers, because they are read everywhere.
  keep : process (aclk)
  begin
    if rising_edge(aclk) then
      forget <= forgets and not reset;
      -- Until the unit has the pose of the query in front, none of its pairs goes on: it may be a clock late.
      leaves_only <= leaves_of(to_integer(unsigned(front)));
      renew <= reset or retire or not running;
      restart <= reset or forgets{% if e.axi %} or aborts{% endif %};
    end if;
  end process keep;

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
      forgets => forgets,
      forget_number => forget_number,
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
      job_stored => job_stored,
      job_query => job_query,
      job_posed => job_posed,
      job_short => job_short,
      job_reason => job_reason,
      job_number => job_number,
      job_lane => job_lane,
      job_flags => job_flags,
      stop => stop,
      stop_number => stop_number,
      checked_lane => checked_lane,
      checked => checked,
      busy => busy,
      running => running,
      oldest => oldest,
      oldest_flags => oldest_flags,
      counting => counting,
      posed => posed,
      started => started,
      ending => ending,
      dropping => dropping,
      start => start,
      start_lane => start_lane,
      most_expansions => most_expansions,
{%- if e.axi %}
      aborts => aborts,
{%- endif %}
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
      store => job_stored,
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
      written => query_written,
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
  -- Of packets of pairs all are answered: what the options of the last query in the lane were means nothing.
  separate_too <= option_separate_too or not running;
  ends_at_contact <= stop_at_contact and running;

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
  -- While words of a query are written, none are read.
  volume_valid <= blocks_valid and not query_written;
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
      oldest_flags => oldest_flags,
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

  triangles : entity work.{{ prefix }}engine_triangles
    port map (
      clk => aclk,
      reset => restart,
      running => running,
      front => front,
      leaves_only => leaves_only,
      triangles_valid => triangles_valid,
      triangles_there => triangles_there,
      triangles_taken => triangles_taken,
      triangles_lane => triangles_lane,
      triangle_a => triangle_a,
      triangle_b => triangle_b,
      testable => testable,
      drops => drops,
      packet_valid => packet_valid,
      packet_taken => packet_taken,
      packet_last => packet_last,
{%- if e.unit.signs.len() > 0 %}
      packet_unfit => packet_unfit,
{%- endif %}
      job_words => job_words,
{%- if e.unit.signs.len() > 0 %}
      forgotten => forgotten,
      job_taken => job_taken,
      job_posed => job_posed,
      job_unfit => job_unfit,
{%- endif %}
      pose_valid => pose_valid,
      pose_ready => pose_ready,
      pose => pose,
      decided_valid => decided_valid,
      decided_ready => decided_ready,
      decided_lane => decided_lane,
      verdict => verdict,
      decided_numbers => decided_numbers,
      decided_last => decided_last{% if e.unit.guarded %},
      decided_outside => decided_outside{% endif %}
    );

  -- ===== Answers =====
  answer : entity work.{{ prefix }}engine_answer
    port map (
      clk => aclk,
      reset => reset,
      forgets => forgets,
      restart => restart,
      decided_valid => decided_valid,
      decided_ready => decided_ready,
      decided_lane => decided_lane,
      running => running,
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
      oldest_flags => oldest_flags,
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
    clear(lane) <= reset or (job_taken and job_flags(lane)) or (abort and not oldest_flags(lane));
  end generate begin_again;
  paired <= pair_valid and pair_ready;
  starved <= volume_ready and waiting and not blocks_valid;
  stalled <= pair_valid and not pair_ready;

  -- ===== Memory =====
  lines : entity work.{{ prefix }}engine_lines
    port map (
      clk => aclk,
      restart => restart,
{%- if e.block_ram %}
      write_line => write_line,
      write_place => write_place,
      write_data => write_data,
      block_write => block_write,
      triangle_write => triangle_write,
{%- else %}
      reset => reset,
      flush => flush,
      flushing => flushing,
      failed => memory_error,
      draining => memory_draining,
      silent => memory_silent,
{%- endif %}
      block_base_a => block_base_a,
      block_base_b => block_base_b,
      block_request => block_request,
      block_accepted => block_accepted,
      request_a => request_a,
      request_b => request_b,
      blocks_valid => blocks_valid,
      blocks_taken => blocks_taken,
      block_a => block_a,
      block_b => block_b,
      triangle_base_a => triangle_base_a,
      triangle_base_b => triangle_base_b,
      triangle_request => triangle_request,
      triangle_accepted => triangle_accepted,
      leaf_a => leaf_a,
      leaf_b => leaf_b,
      triangles_valid => triangles_valid,
      triangles_taken => triangles_taken,
      triangle_a => triangle_a,
      triangle_b => triangle_b,
      block_reads => block_reads,
      triangle_reads => triangle_reads,
      words_read => words_read{% if e.axi %},
{% include "engine/read_port.vhd" %}
{%- else %}
    );
{%- endif %}
end architecture rtl;
