--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The triangle unit and the way to it: triangles of a query's pairs of leaves, or pairs of packets while no query runs. Pairs of a
-- query that asks for leaf pairs alone pass by the unit.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_triangles is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- The queries.
    running : in std_logic;  -- there is one, so that there are no packets
    front : in std_logic_vector(lane_bits - 1 downto 0);  -- that whose pairs are at the unit
    leaves_only : in std_logic;  -- of it
    -- Triangles of a pair of leaves.
    triangles_valid : in std_logic;
    triangles_there : out std_logic;{% if e.unit.paced %}  -- and not sent yet{% if e.unit.offers %}, nor offered{% endif %}{% endif %}
    triangles_taken : out std_logic;
    triangles_lane : in std_logic_vector(lane_bits - 1 downto 0);
    triangle_a : in std_logic_vector(triangle_bits - 1 downto 0);
    triangle_b : in std_logic_vector(triangle_bits - 1 downto 0);
    testable : in std_logic;
    drops : in std_logic;  -- the query ends
    -- Pairs of packets, in the last words of a job.
    packet_valid : in std_logic;
    packet_taken : out std_logic;
    packet_last : in std_logic;
{%- if e.unit.signs.len() > 0 %}
    packet_unfit : in std_logic;  -- of the pair: a number is no sign extension
{%- endif %}
    job_words : in std_logic_vector(job_bits - 1 downto 0);
{%- if e.unit.signs.len() > 0 %}
    forgotten : in std_logic;  -- reset, but not by an error of memory: the pose stays then
    job_taken : in std_logic;
    job_posed : in std_logic;  -- it has a pose
    job_unfit : in std_logic;  -- a number of the pose is no sign extension
{%- endif %}
    pose_valid : in std_logic;
    pose_ready : out std_logic;
    pose : in std_logic_vector(pose_bits - 1 downto 0);
    -- Pairs that are decided, in order.
    decided_valid : out std_logic;
    decided_ready : in std_logic;
    decided_lane : out std_logic_vector(lane_bits - 1 downto 0);
    verdict : out std_logic_vector(1 downto 0);
    decided_numbers : out std_logic_vector(55 downto 0);  -- of the triangles; flags and tag of a pair of a packet
    decided_last : out std_logic{% if e.unit.guarded %};
    decided_outside : out std_logic{% endif %}
  );
end entity {{ prefix }}engine_triangles;

architecture rtl of {{ prefix }}engine_triangles is
  signal there : std_logic;  -- triangles{% if e.unit.paced %}, and not sent yet{% endif %}
  signal triangles_go : std_logic;  -- to the unit, or past it, or they are dropped
{%- if e.unit.paced %}
  signal taken : std_logic := '0';  -- the same, a clock ago
{%- if e.unit.offers %}
  signal offered : std_logic := '0';  -- to the unit, which takes them whatever their query does
{%- endif %}
{%- endif %}
  signal tests_them : std_logic;  -- they are for the unit
  signal passes_them : std_logic;  -- they are for the way past it
  signal numbers : std_logic_vector(55 downto 0);
  signal unit_v : std_logic_vector(287 downto 0);  -- nine words for each triangle
  signal unit_w : std_logic_vector(287 downto 0);
{%- if e.unit.sticky %}
  signal sticky_v : std_logic_vector(8 downto 0);
  signal sticky_w : std_logic_vector(8 downto 0);
{%- endif %}
  signal unit_tag : std_logic_vector(lane_bits + 55 downto 0);
  signal packet_tag : std_logic_vector({{ e.unit.packet_tag }});
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
  signal of_queries : std_logic := '0';  -- running, a clock later: between pairs of queries and of packets there are many clocks
  signal bypass_free : std_logic;
  signal bypassed_valid : std_logic := '0';
  signal bypassed_numbers : std_logic_vector(55 downto 0) := (others => '0');
  signal pose_words : std_logic_vector(job_pose);
{%- if e.unit.signs.len() > 0 %}
  signal pose_unfit : std_logic := '0';  -- a number of the pose is no sign extension
{%- endif %}
begin
  pose_words <= pose;
  triangles_there <= there{% if e.unit.offers %} and not offered{% endif %};
{%- if e.unit.signs.len() > 0 %}

  -- With the bypass the numbers of a pose are not read.
  look : process (clk)
  begin
    if rising_edge(clk) then
      if forgotten = '1' then
        pose_unfit <= '0';
      elsif (job_taken and job_posed) = '1' then
        pose_unfit <= job_unfit and not job_words(job_bypass);
      end if;
    end if;
  end process look;
{%- endif %}

  -- While no query runs, the unit tests pairs of packets: the last words of the stream. Above the {{ e.unit.pair_tag_bits }} bits of their tag the
  -- unit's tag says which is the last of its packet{% if e.unit.signs.len() > 0 %}, and which has a number that does not fit{% endif %}.
  -- A number of a triangle has a place of 32 bits, of which the unit reads the low ones: the others are its sign{% if e.unit.signs.len() > 0 %}, which is looked at for
  -- pairs of packets{% endif %}.
  unit_v <= triangle_a(triangle_corners) when of_queries = '1' else job_words(job_pair_v);
  unit_w <= triangle_b(triangle_corners) when of_queries = '1' else job_words(job_pair_w);
{%- if e.unit.sticky %}
  sticky_v <= triangle_a(triangle_sticky) when of_queries = '1' else job_words(job_pair_sticky_v);
  sticky_w <= triangle_b(triangle_sticky) when of_queries = '1' else job_words(job_pair_sticky_w);
{%- endif %}
  -- Of a packet nothing reads the bits of the tag above these.
  packet_tag <= {% if e.unit.signs.len() > 0 %}(packet_unfit or pose_unfit) & {% endif %}packet_last & job_words(job_pair_tag);
  unit_tag(lane_bits + 55 downto packet_tag'length) <= triangles_lane & numbers(55 downto packet_tag'length);
  unit_tag(packet_tag'range) <= numbers(packet_tag'range) when of_queries = '1' else packet_tag;
  packet_taken <= packet_valid and unit_ready;

  -- With leaves_only pairs pass by the unit, which is empty then, through a register: their numbers may come late out of block RAM.
  -- The numbers of triangles are in the low bits of the first word, {{ e.unit.triangle_number_bits }} of them.
  numbers <= {{ e.unit.number_above }}triangle_b(triangle_number) & {{ e.unit.number_above }}triangle_a(triangle_number);
  bypass_free <= not bypassed_valid;
  tests_them <= there and testable and not leaves_only and not drops;
  passes_them <= there and testable and leaves_only and not drops;
{%- if e.unit.offers %}
  -- From a register, as hundreds of registers load a pair that is offered.
  unit_valid <= offered or packet_valid;
  triangles_go <= unit_ready when offered = '1' else there and (drops or (passes_them and bypass_free));
{%- else %}
  unit_valid <= tests_them or packet_valid;
  triangles_go <= there and (drops or (passes_them and bypass_free) or (tests_them and unit_ready));
{%- endif %}
{%- if e.unit.paced %}
  -- Whether the triangles go is known late in a clock: the memory hears of it a clock later, which costs a pair nothing, because
  -- the unit does not take the next one at once.
  there <= triangles_valid and not taken;
  triangles_taken <= taken;

  send : process (clk)
  begin
    if rising_edge(clk) then
      taken <= triangles_go and not reset;
{%- if e.unit.offers %}
      offered <= tests_them and not reset;
      if offered = '1' then
        offered <= not (unit_ready or reset);
      end if;
{%- endif %}
    end if;
  end process send;
{%- else %}
  there <= triangles_valid;
  triangles_taken <= triangles_go;
{%- endif %}

  bypass : process (clk)
  begin
    if rising_edge(clk) then
      of_queries <= running;
      if bypass_free = '1' then
        bypassed_numbers <= numbers;
      end if;
      if reset = '1' then
        bypassed_valid <= '0';
      elsif bypass_free = '1' then
        bypassed_valid <= passes_them;
      elsif decided_ready = '1' then
        bypassed_valid <= '0';
      end if;
    end if;
  end process bypass;

  unit : entity work.{{ prefix }}efsat
    port map (
      clk => clk,
      reset => reset,
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
  tested_taken <= decided_ready and not leaves_only;
  decided_valid <= bypassed_valid when leaves_only = '1' else tested_valid;
{%- if e.unit.signs.len() > 0 %}
  tested_unfit <= tested_numbers(tag_unfit) and not of_queries;
  verdict <= "10" when leaves_only = '1' or tested_unfit = '1' else tested_verdict;
  tested_flags <= (others => '0') when tested_unfit = '1' else "{{ e.unit.flag_zeros }}" & tested_overlapping & tested_separated;
  decided_outside <= (tested_outside or tested_unfit) and not of_queries;
{%- else %}
  verdict <= "10" when leaves_only = '1' else tested_verdict;
  tested_flags <= "{{ e.unit.flag_zeros }}" & tested_overlapping & tested_separated;
{%- if e.unit.guarded %}
  decided_outside <= tested_outside and not of_queries;
{%- endif %}
{%- endif %}
  decided_numbers <= bypassed_numbers when leaves_only = '1' else
    tested_numbers when of_queries = '1' else
    tested_flags & tested_numbers({{ e.unit.pair_tag }});
  decided_last <= tested_numbers(tag_last) and not of_queries;
end architecture rtl;
