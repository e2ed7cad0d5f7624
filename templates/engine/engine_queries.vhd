--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The words of the queries in flight, in look-up tables: written once, when a job is taken, and read by the lane of whoever
-- works on a query. The pose of a job that has no query is kept here, too. Each reader has a memory of its own, with as many
-- rows as a look-up table has: of a memory with a row for each lane tools make flip-flops. Where a clock without a reader costs
-- nothing, memory is read and written at one place: the words for control mean nothing while store is set, those for the volume
-- unit while {% if e.traversal.paced %}they are written, a clock later: store is never set in two clocks on end, and job_words stay for one more{% else %}they are written{% endif %}.
--
-- The matrix for the origins of blocks is s1.17, cut off and saturated to +-(2^17 - 1); the shift is s4.22, cut off.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_queries is
  port (
    clk : in std_logic;
    reset : in std_logic;  -- also a soft reset
    store : in std_logic;
    store_lane : in std_logic_vector(lane_bits - 1 downto 0);
    job_words : in std_logic_vector(job_bits - 1 downto 0);  -- from a clock before store{% if e.traversal.paced %} to a clock after it{% else %} on{% endif %}
    job_query : in std_logic;
    retire : in std_logic;  -- the oldest is done
    oldest : in std_logic_vector(lane_bits - 1 downto 0);
    -- The first words of a query, for control, a clock later; they mean nothing in the clock after one is stored.
    checked_lane : in std_logic_vector(lane_bits - 1 downto 0);
    checked : out std_logic_vector(head_bits - 1 downto 0);
    -- Where the blocks are that the traversal asks for, and how many blocks and triangles the trees have whose volumes the volume unit
    -- read a clock ago: the links are read then.
    request_lane : in std_logic_vector(lane_bits - 1 downto 0);
    block_base_a : out std_logic_vector(31 downto 0);  -- address / 64
    block_base_b : out std_logic_vector(31 downto 0);
    block_count_a : out std_logic_vector(31 downto 0);
    block_count_b : out std_logic_vector(31 downto 0);
    triangle_count_a : out std_logic_vector(31 downto 0);
    triangle_count_b : out std_logic_vector(31 downto 0);
    -- What the volume unit knows{% if e.traversal.paced %} of the lane of a clock ago{% endif %}; not while it is written.
    written : out std_logic;
    volume_lane : in std_logic_vector(lane_bits - 1 downto 0);
    query_pose : out std_logic_vector(query_pose_bits - 1 downto 0);
    query_shift : out std_logic_vector(query_shift_bits - 1 downto 0);
    query_errors : out std_logic_vector(query_errors_bits - 1 downto 0);
    query_rows : out std_logic_vector(query_rows_bits - 1 downto 0);
    -- Where the triangles are that are asked for, and the pose of the triangle unit.
    front : in std_logic_vector(lane_bits - 1 downto 0);
    triangle_base_a : out std_logic_vector(31 downto 0);
    triangle_base_b : out std_logic_vector(31 downto 0);
    pose : out std_logic_vector(pose_bits - 1 downto 0);
    leaves_only : out lane_flags;  -- no triangle test; never where there is no query
    -- Of the oldest query.
    stop_at_contact : out std_logic;
    separate_too : out std_logic
  );
end entity {{ prefix }}engine_queries;

architecture rtl of {{ prefix }}engine_queries is
  constant last : natural := 15;  -- row
  type heads is array (0 to last) of std_logic_vector(head_bits - 1 downto 0);
  signal head : heads := (others => (others => '0'));
  type bases is array (0 to last) of std_logic_vector(63 downto 0);
  signal block_bases : bases := (others => (others => '0'));
  signal triangle_bases : bases := (others => (others => '0'));
  signal head_row : std_logic_vector(lane_bits - 1 downto 0);
{%- if e.traversal.paced %}
  -- In registers, as hundreds of cells hang on them: the lane of the next expansion is there a clock after one, its row another clock
  -- later, and the volume unit takes the next at the earliest three clocks after one.
  signal writes : std_logic := '0';
  signal volume_row : std_logic_vector(lane_bits - 1 downto 0) := (others => '0');
{%- else %}
  signal writes : std_logic;
  signal volume_row : std_logic_vector(lane_bits - 1 downto 0);
{%- endif %}
  signal requested : std_logic_vector(63 downto 0);
  signal asked : std_logic_vector(63 downto 0);
  type counts is array (0 to last) of std_logic_vector(127 downto 0);
  signal object_counts : counts := (others => (others => '0'));
  signal listed : std_logic_vector(127 downto 0) := (others => '0');
  signal new_options : std_logic_vector(63 downto 0);
  type pose_words is array (0 to last) of std_logic_vector(pose_bits - 1 downto 0);
  signal pose_memory : pose_words := (others => (others => '0'));
  type words is array (0 to 8) of std_logic_vector({{ e.query.entry }});
  signal entry : words;
  type entries_cut is array (0 to 8) of std_logic_vector({{ e.query.origin }});
  signal saturated : entries_cut;
  type poses is array (0 to last) of std_logic_vector(query_pose_bits - 1 downto 0);
  signal matrix : poses := (others => (others => '0'));
  signal new_matrix : std_logic_vector(query_pose_bits - 1 downto 0);
  type shifts is array (0 to last) of std_logic_vector(query_shift_bits - 1 downto 0);
  signal shift : shifts := (others => (others => '0'));
  signal new_shift : std_logic_vector(query_shift_bits - 1 downto 0);
  type errors is array (0 to last) of std_logic_vector(query_errors_bits - 1 downto 0);
  signal shift_error : errors := (others => (others => '0'));
  type rows is array (0 to last) of std_logic_vector(query_rows_bits - 1 downto 0);
  signal row : rows := (others => (others => '0'));
  signal new_rows : std_logic_vector(query_rows_bits - 1 downto 0);
  signal leaves : lane_flags := (others => '0');
  signal contact : lane_flags := (others => '0');
  signal separate : lane_flags := (others => '0');
begin
  -- Entries of the matrix: cut off and saturated. Which are is found a clock before.
{%- for name in e.query.entries %}
  entry({{ loop.index0 }}) <= job_words(job_pose_{{ name }});
{%- endfor %}
  entries : for i in 0 to 8 generate
    signal cut : std_logic_vector({{ e.query.origin }});
    constant sign : natural := {{ e.query.entry.high }};
    constant above_bits : natural := {{ e.query.above_bits }};
    signal above : std_logic_vector(above_bits - 1 downto 0);  -- sign bits, if it fits
    signal too_great : std_logic := '0';
    signal too_small : std_logic := '0';
  begin
    cut <= entry(i)({{ e.query.cut }});
    above <= entry(i)({{ e.query.above }});
    saturated(i) <= "{{ e.query.greatest_entry }}" when too_great = '1' else "{{ e.query.least_entry }}" when too_small = '1' else cut;

    look : process (clk)
    begin
      if rising_edge(clk) then
        too_great <= '0';
        if entry(i)(sign) = '0' and above /= "{{ e.query.above_zeros }}" then
          too_great <= '1';
        end if;
        too_small <= '0';
        if entry(i)(sign) = '1' and (above /= "{{ e.query.above_ones }}" or cut = "{{ e.query.below_least }}") then
          too_small <= '1';
        end if;
      end if;
    end process look;
  end generate entries;
{%- for name in e.query.entries %}
  new_matrix(query_{{ name }}) <= saturated({{ loop.index0 }});
{%- endfor %}
  -- Of the shift the bits below s4.22 are cut off, of a row those above its rest are zero: the command has looked.
{%- for axis in e.query.axes %}
  new_shift(query_shift_{{ axis }}) <= job_words(job_shift_{{ axis }});
{%- endfor %}
{%- for i in 0..e.query.rows %}
  new_rows(query_row_{{ i }}) <= job_words(job_row_{{ i }});
{%- endfor %}
  new_options <= job_words(job_options);

  keep : process (clk)
  begin
    if rising_edge(clk) then
      if store = '1' then
        head(to_integer(unsigned(head_row))) <= job_words(head_bits - 1 downto 0);
        block_bases(to_integer(unsigned(store_lane))) <= job_words(job_blocks_b) & job_words(job_blocks_a);
        triangle_bases(to_integer(unsigned(store_lane))) <= job_words(job_triangles_b) & job_words(job_triangles_a);
        pose_memory(to_integer(unsigned(store_lane))) <= job_words(job_pose);
      end if;
      if writes = '1' then
        object_counts(to_integer(unsigned(volume_row))) <= job_words(job_triangle_count_b) & job_words(job_triangle_count_a)
          & job_words(job_block_count_b) & job_words(job_block_count_a);
        matrix(to_integer(unsigned(volume_row))) <= new_matrix;
        shift(to_integer(unsigned(volume_row))) <= new_shift;
        shift_error(to_integer(unsigned(volume_row))) <= job_words(job_errors);
        row(to_integer(unsigned(volume_row))) <= new_rows;
      end if;
{%- if e.traversal.paced %}
      writes <= store;
      volume_row <= volume_lane;
      if store = '1' then
        volume_row <= store_lane;
      end if;
{%- endif %}
      checked <= head(to_integer(unsigned(head_row)));
      listed <= object_counts(to_integer(unsigned(volume_row)));
      for lane in 0 to lanes - 1 loop
        if retire = '1' and unsigned(oldest) = lane then
          leaves(lane) <= '0';
        end if;
        if store = '1' and unsigned(store_lane) = lane then
          leaves(lane) <= new_options(option_leaves) and job_query;
          contact(lane) <= new_options(option_contact);
          separate(lane) <= new_options(option_separate);
        end if;
      end loop;
      if reset = '1' then
        leaves <= (others => '0');
      end if;
    end if;
  end process keep;

  head_row <= store_lane when store = '1' else checked_lane;
  requested <= block_bases(to_integer(unsigned(request_lane)));
  block_base_a <= requested(31 downto 0);
  block_base_b <= requested(63 downto 32);
  block_count_a <= listed(31 downto 0);
  block_count_b <= listed(63 downto 32);
  triangle_count_a <= listed(95 downto 64);
  triangle_count_b <= listed(127 downto 96);
{%- if !e.traversal.paced %}
  writes <= store;
  volume_row <= store_lane when store = '1' else volume_lane;
{%- endif %}
  written <= writes;
  query_pose <= matrix(to_integer(unsigned(volume_row)));
  query_shift <= shift(to_integer(unsigned(volume_row)));
  query_errors <= shift_error(to_integer(unsigned(volume_row)));
  query_rows <= row(to_integer(unsigned(volume_row)));
  asked <= triangle_bases(to_integer(unsigned(front)));
  triangle_base_a <= asked(31 downto 0){% if e.block_ram %} xor x"02000000"{% endif %};
  triangle_base_b <= asked(63 downto 32){% if e.block_ram %} xor x"02000000"{% endif %};
  pose <= pose_memory(to_integer(unsigned(front)));
  leaves_only <= leaves;
  stop_at_contact <= contact(to_integer(unsigned(oldest)));
  separate_too <= separate(to_integer(unsigned(oldest)));
end architecture rtl;
