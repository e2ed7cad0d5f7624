--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The check of a query that is admitted: have its trees roots, do they lie within the memory{% if e.axi %}, and are they the ones
-- that the caches hold{% endif %}?
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_check is
  port (
    clk : in std_logic;
    load : in std_logic;  -- one clock long: the first words of the query are there
    checked : in std_logic_vector(head_bits - 1 downto 0);  -- the first words of the query
{%- if e.axi %}
    known : in std_logic;  -- the caches are those of the query that was checked last
{%- endif %}
    -- From the clock behind load on.
    most_expansions : out std_logic_vector(31 downto 0) := (others => '0');
{%- if e.axi %}
    moved : out std_logic_vector(4 downto 0) := (others => '0');  -- places that are not those of the caches; bit 4: caches are not known, or not to be kept
{%- endif %}
    -- A clock later.
    outside : out std_logic_vector(3 downto 0) := "0000";  -- the memory ends before the range
    empty : out std_logic := '0'  -- a tree without a root
  );
end entity {{ prefix }}engine_check;

architecture rtl of {{ prefix }}engine_check is
  type places is array (0 to 3) of unsigned(31 downto 0);  -- blocks of A and B, triangles of A and B
  signal new_bases : places;
  signal bases : places := (others => (others => '0'));
  signal counts : places := (others => (others => '0'));
  signal options : std_logic_vector(63 downto 0);
begin
  new_bases(0) <= unsigned(checked(job_blocks_a));
  new_bases(1) <= unsigned(checked(job_blocks_b));
  new_bases(2) <= unsigned(checked(job_triangles_a)){% if e.block_ram %} xor x"02000000"{% endif %};
  new_bases(3) <= unsigned(checked(job_triangles_b)){% if e.block_ram %} xor x"02000000"{% endif %};
  options <= checked(job_options);

  check : process (clk)
  begin
    if rising_edge(clk) then
      if load = '1' then
        bases <= new_bases;
        counts(0) <= unsigned(checked(job_block_count_a));
        counts(1) <= unsigned(checked(job_block_count_b));
        counts(2) <= unsigned(checked(job_triangle_count_a));
        counts(3) <= unsigned(checked(job_triangle_count_b));
        most_expansions <= options(option_expansions);
{%- if e.axi %}
        moved <= (others => '0');
        for i in 0 to 3 loop
          if bases(i) /= new_bases(i) then
            moved(i) <= '1';
          end if;
        end loop;
        moved(4) <= not known or not checked(job_keep);
{%- endif %}
      end if;
      for i in 0 to 1 loop
        outside(i) <= '0';
        if resize(bases(i), 33) + resize(counts(i), 33) > {{ e.memory.block_lines }} then
          outside(i) <= '1';
        end if;
        outside(i + 2) <= '0';
        if resize(bases(i + 2), 33) + resize(counts(i + 2), 33) > {{ e.memory.triangle_lines }} then
          outside(i + 2) <= '1';
        end if;
      end loop;
      empty <= '0';
      if counts(0) = 0 or counts(1) = 0 then
        empty <= '1';
      end if;
    end if;
  end process check;
end architecture rtl;
