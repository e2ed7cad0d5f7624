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
{% let read_ports = [""] -%}
{%- include "engine/ports.vhd" %}
  );
end entity {{ prefix }}efsat_engine;

architecture rtl of {{ prefix }}efsat_engine is
  signal reset : std_logic;
  signal reset_word : std_logic;  -- a soft reset by the stream
  signal reset_number : std_logic_vector(23 downto 0);
  signal forget : std_logic;  -- a soft reset
  signal forget_number : std_logic_vector(23 downto 0);  -- for its report
  signal clears : std_logic;  -- all but the stream out forget everything
  signal forgets : std_logic;  -- memory does

  -- Pairs and their triangles
  signal pair_valid : std_logic;
  signal pair_ready : std_logic;
  signal line_a : std_logic_vector(25 downto 0);
  signal line_b : std_logic_vector(25 downto 0);
  signal request_a : std_logic_vector(27 downto 0);
  signal request_b : std_logic_vector(27 downto 0);
  signal separate_too : std_logic;
  signal triangles_valid : std_logic;
  signal triangles_taken : std_logic;
{%- if e.unit.paced %}
  signal triangles_there : std_logic;  -- and not sent yet
  signal triangles_sent : std_logic := '0';  -- the unit has taken them, a clock ago
{%- endif %}
  signal triangle_a : std_logic_vector(triangle_bits - 1 downto 0);
  signal triangle_b : std_logic_vector(triangle_bits - 1 downto 0);
  signal pose_valid : std_logic;
  signal pose_ready : std_logic;
  signal pose_words : std_logic_vector(job_bits - 1 downto 0);

  -- The unit
  signal unit_v : std_logic_vector(287 downto 0);  -- nine words for each triangle
  signal unit_w : std_logic_vector(287 downto 0);
{%- if e.unit.sticky %}
  signal sticky_v : std_logic_vector(8 downto 0);
  signal sticky_w : std_logic_vector(8 downto 0);
{%- endif %}
  signal unit_valid : std_logic;
  signal unit_ready : std_logic;
  signal unit_tag : std_logic_vector(56 downto 0);  -- separate_too, numbers of the triangles of B and A
  signal sent : std_logic;
  signal tested_valid : std_logic;
  signal tested_taken : std_logic;
  signal tested_verdict : std_logic_vector(1 downto 0);
  signal tested_tag : std_logic_vector(56 downto 0);

  -- Reports
  signal report_valid : std_logic;
  signal report_ready : std_logic;
  signal report_reason : std_logic_vector(4 downto 0);
  signal report_number : std_logic_vector(23 downto 0);
  signal triangles_read : std_logic_vector(31 downto 0);
  signal words_read : std_logic_vector(31 downto 0);
{%- if e.block_ram %}

  -- Words to be stored
  signal triangle_write : std_logic;
  signal write_line : std_logic_vector(triangle_line_bits - 1 downto 0);
  signal write_place : std_logic_vector(2 downto 0);
  signal write_data : std_logic_vector(63 downto 0);
  constant from_zero : std_logic_vector(triangle_line_bits - 1 downto 0) := (others => '0');
{%- else %}

  -- Memory: triangles of A and of B have the places that they have where there are blocks, too.
  signal memory_error : std_logic;
  signal memory_silent : std_logic;
  signal failing : std_logic;
  signal restart : std_logic;
  signal flush : std_logic;
  signal flushing : std_logic;
  signal busy_caches : std_logic_vector(3 downto 2);
  signal ask_valid : std_logic_vector(3 downto 0);
  signal ask_ready : std_logic_vector(3 downto 0);
  signal ask_address_2 : std_logic_vector(25 downto 0);
  signal ask_address_3 : std_logic_vector(25 downto 0);
  signal fill_valid : std_logic_vector(3 downto 0);
  signal fill_data : std_logic_vector(memory_width - 1 downto 0);
  signal line_ready : std_logic_vector(3 downto 2);
  signal line_valid : std_logic_vector(3 downto 2);
  signal missed : std_logic_vector(3 downto 2);
  signal word_read : std_logic;
  signal both_ask : std_logic;
  constant from_zero : std_logic_vector(25 downto 0) := (others => '0');
{%- endif %}
begin
  reset <= not aresetn;
  forget <= soft_reset or reset_word;
  forget_number <= reset_number when reset_word = '1' else (others => '0');
  clears <= reset or forget;

  command : entity work.{{ prefix }}engine_number_command
    port map (
      clk => aclk,
      reset => reset,
      soft_reset => soft_reset,
      s_axis_tdata => s_axis_tdata,
      s_axis_tkeep => s_axis_tkeep,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tlast => s_axis_tlast,
      s_axis_tready => s_axis_tready,
      pair_valid => pair_valid,
      pair_ready => pair_ready,
      line_a => line_a,
      line_b => line_b,
      sent => sent,
      separate_too => separate_too,
      pose_valid => pose_valid,
      pose_ready => pose_ready,
      job_words => pose_words,
{%- if e.axi %}
      memory_error => memory_error,
      memory_silent => memory_silent,
      failing => failing,
      restart => restart,
      flush => flush,
      flushing => flushing,
      missed => missed,
      word_read => word_read,
{%- else %}
      triangle_write => triangle_write,
      write_line => write_line,
      write_place => write_place,
      write_data => write_data,
{%- endif %}
      report_valid => report_valid,
      report_ready => report_ready,
      report_reason => report_reason,
      report_number => report_number,
      triangles_read => triangles_read,
      words_read => words_read,
      reset_word => reset_word,
      reset_number => reset_number
    );

  -- ===== Triangles =====
  -- A number of a triangle has a place of 32 bits, of which the unit reads the low ones. The numbers that answers carry are in the low
  -- bits of the first word, {{ e.unit.triangle_number_bits }} of them.
  unit_v <= triangle_a(triangle_corners);
  unit_w <= triangle_b(triangle_corners);
{%- if e.unit.sticky %}
  sticky_v <= triangle_a(triangle_sticky);
  sticky_w <= triangle_b(triangle_sticky);
{%- endif %}
  unit_tag <= separate_too & {{ e.unit.number_above }}triangle_b(triangle_number) & {{ e.unit.number_above }}triangle_a(triangle_number);
  sent <= unit_valid and unit_ready;
{%- if e.unit.paced %}
  -- Whether the unit takes a pair is known late in a clock: the memory hears of it a clock later, which costs nothing, because the
  -- unit does not take the next one at once.
  triangles_there <= triangles_valid and not triangles_sent;
  triangles_taken <= triangles_sent;
  unit_valid <= triangles_there{% if e.axi %} and not failing{% endif %};

  send : process (aclk)
  begin
    if rising_edge(aclk) then
      triangles_sent <= sent and not forgets;
    end if;
  end process send;
{%- else %}
  unit_valid <= triangles_valid{% if e.axi %} and not failing{% endif %};
  triangles_taken <= sent;
{%- endif %}

  unit : entity work.{{ prefix }}efsat
    port map (
      clk => aclk,
      reset => clears,
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
      out_separated => open,
      out_overlapping => open,
{%- if e.unit.guarded %}
      out_outside => open,
{%- endif %}
      out_tag => tested_tag
    );

  answer : entity work.{{ prefix }}engine_number_answer
    port map (
      clk => aclk,
      reset => reset,
      forget => forget,
      forget_number => forget_number,
      sent => sent,
      tested_valid => tested_valid,
      tested_taken => tested_taken,
      verdict => tested_verdict,
      numbers => tested_tag(55 downto 0),
      separate_too => tested_tag(56),
      report_valid => report_valid,
      report_ready => report_ready,
      report_reason => report_reason,
      report_number => report_number,
      triangles_read => triangles_read,
      words_read => words_read,
      m_axis_tdata => m_axis_tdata,
      m_axis_tkeep => m_axis_tkeep,
      m_axis_tvalid => m_axis_tvalid,
      m_axis_tlast => m_axis_tlast,
      m_axis_tready => m_axis_tready
    );

  -- ===== Memory =====
  -- Lines are counted from the first address on, so that pairs of two packets may have other bases.
  request_a <= "00" & line_a;
  request_b <= "00" & line_b;
{%- if e.block_ram %}
  forgets <= clears;
  triangle_memory : entity work.{{ prefix }}engine_triangle_memory
    port map (
      clk => aclk,
      reset => forgets,
      write_valid => triangle_write,
      write_line => write_line,
      write_place => write_place,
      write_data => write_data,
      base_a => from_zero,
      base_b => from_zero,
      request_valid => pair_valid,
      request_ready => pair_ready,
      request_a => request_a,
      request_b => request_b,
      lines_valid => triangles_valid,
      lines_taken => triangles_taken,
      line_a => triangle_a,
      line_b => triangle_b
    );
{%- else %}
  forgets <= clears or restart;
{%- for side in e.numbers.sides %}
  triangles_of_{{ side.name }} : entity work.{{ prefix }}engine_triangle_cache
    port map (
      clk => aclk,
      reset => forgets,
      flush => flush,
      flushing => busy_caches({{ side.cache }}),
      base => from_zero,
      request_valid => both_ask,
      request_ready => line_ready({{ side.cache }}),
      request => request_{{ side.name }},
      line_valid => line_valid({{ side.cache }}),
      line_taken => triangles_taken,
      data => triangle_{{ side.name }},
      ask_valid => ask_valid({{ side.cache }}),
      ask_ready => ask_ready({{ side.cache }}),
      ask_address => ask_address_{{ side.cache }},
      fill_valid => fill_valid({{ side.cache }}),
      fill_data => fill_data,
      missed => missed({{ side.cache }})
    );
{% endfor %}
  -- Both sides take a request, or none; so do both give their lines.
  pair_ready <= line_ready(2) and line_ready(3);
  both_ask <= pair_valid and pair_ready;
  triangles_valid <= line_valid(2) and line_valid(3);
  flushing <= '0' when busy_caches = "00" else '1';
  ask_valid(1 downto 0) <= "00";

  read_master : entity work.{{ prefix }}engine_read_master
    port map (
      clk => aclk,
      reset => reset,
      restart => forgets,
      ask_valid => ask_valid,
      ask_ready => ask_ready,
      ask_address_0 => from_zero,
      ask_address_1 => from_zero,
      ask_address_2 => ask_address_2,
      ask_address_3 => ask_address_3,
      fill_valid => fill_valid,
      fill_data => fill_data,
      failed => memory_error,
      draining => open,
      silent => memory_silent,
      word_read => word_read,
{% include "engine/read_port.vhd" %}
{%- endif %}
end architecture rtl;
