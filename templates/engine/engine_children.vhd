--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- What the traversal needs to know of a block: which children there are, where their links go, and whether block and links
-- are good. One clock after the block was taken: the children. Three clocks after: bad, one clock long.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_children is
  port (
    clk : in std_logic;
    reset : in std_logic;
    taken : in std_logic;  -- the block is taken in this clock
    data : in std_logic_vector(block_bits - 1 downto 0);
    own : in std_logic_vector(node_bits - 1 downto 0);  -- number of the block
    block_count : in std_logic_vector(31 downto 0);
    triangle_count : in std_logic_vector(31 downto 0);
    present : out std_logic_vector(1 downto 0);  -- bit 0 left, bit 1 right child: there is one
    leaf : out std_logic_vector(1 downto 0);  -- the link goes to a triangle
    fault : out std_logic_vector(1 downto 0);  -- it goes to no block or triangle of the tree, or to a block that is not behind this one
    left : out std_logic_vector(27 downto 0);  -- number of the block or triangle
    right : out std_logic_vector(27 downto 0);
    bad : out std_logic  -- the block has another format, or a code that the volume unit does not take
  );
end entity {{ prefix }}engine_children;

architecture rtl of {{ prefix }}engine_children is
  constant none : std_logic_vector(31 downto 0) := (others => '1');
  -- The bits of a block may come out of block RAM, late in their clock: they are compared in short parts, these are put together
  -- a clock later, and all of them in the clock after that. A code is unusable if it has its sign bit alone. The tag has k in bits 7..0, bits of a code in 11..8,
  -- version in 15..12, then zeros.
  constant codes : natural := {{ e.blocks.code_count }};
  constant tag_parts : natural := {{ e.blocks.block_tag_parts.len() }};
  constant usable : std_logic_vector(codes - 1 downto 0) := (others => '0');
  constant same : std_logic_vector(tag_parts - 1 downto 0) := (others => '0');
  -- Bit i of part p: part p of code i is that of the unusable one.
  constant code_parts : natural := {{ e.blocks.code_parts }};
  type code_flags is array (0 to code_parts - 1) of std_logic_vector(codes - 1 downto 0);
  signal part : code_flags;
  signal part_before : code_flags := (others => (others => '0'));
  signal other : std_logic_vector(tag_parts - 1 downto 0);  -- parts of the tag that differ
  signal other_before : std_logic_vector(tag_parts - 1 downto 0) := (others => '0');
  signal taken_before : std_logic := '0';
  -- Another clock later.
  signal unusable : std_logic_vector(codes - 1 downto 0) := (others => '0');
  signal alien : std_logic := '0';  -- the tag is another one
  signal judged : std_logic := '0';
  type links is array (0 to 1) of std_logic_vector(31 downto 0);
  signal link : links := (others => (others => '0'));
  signal number : std_logic_vector(node_bits - 1 downto 0) := (others => '0');
begin
{%- for code in e.blocks.codes %}
{%- let i = loop.index0 %}
{%- for part in code %}
  part({{ loop.index0 }})({{ i }}) <= '1' when data({{ part.bits }}) = "{{ part.due }}" else '0';
{%- endfor %}
{%- endfor %}
{%- for part in e.blocks.block_tag_parts %}
  other({{ loop.index0 }}) <= '1' when data({{ part.bits }}) /= "{{ part.due }}" else '0';
{%- endfor %}

  hold : process (clk)
    variable all_parts : std_logic_vector(codes - 1 downto 0);
  begin
    if rising_edge(clk) then
      link(0) <= data(31 downto 0);
      link(1) <= data(63 downto 32);
      number <= own;
      part_before <= part;
      other_before <= other;
      taken_before <= taken and not reset;
      bad <= '0';
      all_parts := part_before(0);
      for p in 1 to part_before'high loop
        all_parts := all_parts and part_before(p);
      end loop;
      unusable <= all_parts;
      alien <= '0';
      if other_before /= same then
        alien <= '1';
      end if;
      judged <= taken_before and not reset;
      if unusable /= usable or alien = '1' then
        bad <= judged and not reset;
      end if;
    end if;
  end process hold;

  children : for i in 0 to 1 generate
    signal target : unsigned(30 downto 0) := (others => '0');
    signal beyond : std_logic;  -- no triangle of the tree
    signal astray : std_logic;  -- no block behind this one
  begin
    present(i) <= '1' when link(i) /= none else '0';
    target <= unsigned(link(i)(30 downto 0));
    leaf(i) <= link(i)(31);
    beyond <= '1' when target >= unsigned(triangle_count) else '0';
    astray <= '1' when target >= unsigned(block_count) or target <= unsigned(number)
      or target(30 downto node_bits) /= 0 else '0';
    fault(i) <= beyond when link(i)(31) = '1' else astray;
  end generate children;
  -- Bits 30..28 are zero where there is no fault: no tree that a query can name has so many blocks or triangles.
  left <= link(0)(27 downto 0);
  right <= link(1)(27 downto 0);
end architecture rtl;
