--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Where blocks and triangles come from: {% if e.block_ram %}block RAM that the host has filled{% else %}caches in front of the memory, for blocks of A, blocks of B, triangles of A, triangles of B{% endif %}.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_lines is
  port (
    clk : in std_logic;
    restart : in std_logic;  -- what was asked for is forgotten
{%- if e.block_ram %}
    write_line : in std_logic_vector(load_line_bits - 1 downto 0);
    write_place : in std_logic_vector(2 downto 0);
    write_data : in std_logic_vector(63 downto 0);
    block_write : in std_logic;
    triangle_write : in std_logic;
{%- else %}
    reset : in std_logic;  -- also what memory still answers is forgotten
    flush : in std_logic;  -- one clock long: the caches are emptied
    flushing : out std_logic;
    failed : out std_logic;  -- memory has answered with an error
    draining : out std_logic;  -- old bursts are under way
    silent : out std_logic;  -- memory does not answer
{%- endif %}
    -- Blocks of a pair of nodes.
    block_base_a : in std_logic_vector(31 downto 0);
    block_base_b : in std_logic_vector(31 downto 0);
    block_request : in std_logic;
    block_accepted : out std_logic;
    request_a : in std_logic_vector(node_bits - 1 downto 0);
    request_b : in std_logic_vector(node_bits - 1 downto 0);
    blocks_valid : out std_logic;
    blocks_taken : in std_logic;
    block_a : out std_logic_vector(block_bits - 1 downto 0);
    block_b : out std_logic_vector(block_bits - 1 downto 0);
    -- Triangles of a pair of leaves.
    triangle_base_a : in std_logic_vector(31 downto 0);
    triangle_base_b : in std_logic_vector(31 downto 0);
    triangle_request : in std_logic;
    triangle_accepted : out std_logic;
    leaf_a : in std_logic_vector(27 downto 0);
    leaf_b : in std_logic_vector(27 downto 0);
    triangles_valid : out std_logic;
    triangles_taken : in std_logic;
    triangle_a : out std_logic_vector(triangle_bits - 1 downto 0);
    triangle_b : out std_logic_vector(triangle_bits - 1 downto 0);
    -- Lines and words that are read from memory.
    block_reads : out std_logic_vector(1 downto 0);
    triangle_reads : out std_logic_vector(1 downto 0);
    words_read : out std_logic{% if e.axi %};
{% include "engine/burst_ports.vhd" %}{% endif %}
  );
end entity {{ prefix }}engine_lines;

architecture rtl of {{ prefix }}engine_lines is
{%- if e.axi %}
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
  signal accepts_blocks : std_logic;
  signal accepts_triangles : std_logic;
  signal both_blocks_ask : std_logic;
  signal both_triangles_ask : std_logic;
{%- endif %}
begin
{%- if e.block_ram %}
  -- A line or base in the memory has no bits above these: commands write, and control runs queries, within it alone.
  block_memory : entity work.{{ prefix }}engine_block_memory
    port map (
      clk => clk,
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
      clk => clk,
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
      clk => clk,
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
  accepts_blocks <= line_ready(0) and line_ready(1);
  block_accepted <= accepts_blocks;
  both_blocks_ask <= block_request and accepts_blocks;
  accepts_triangles <= line_ready(2) and line_ready(3);
  triangle_accepted <= accepts_triangles;
  both_triangles_ask <= triangle_request and accepts_triangles;
  blocks_valid <= line_valid(0) and line_valid(1);
  triangles_valid <= line_valid(2) and line_valid(3);
  flushing <= '0' when busy_caches = "0000" else '1';
  -- Caches 0 and 1 hold blocks, 2 and 3 triangles.
  block_reads <= missed(1 downto 0);
  triangle_reads <= missed(3 downto 2);

  read_master : entity work.{{ prefix }}engine_read_master
    port map (
      clk => clk,
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
      failed => failed,
      draining => draining,
      silent => silent,
      word_read => words_read,
{% include "engine/burst_map.vhd" %}
{%- endif %}
end architecture rtl;
