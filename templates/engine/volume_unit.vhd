--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The volume unit: two blocks, each with the volumes of two children, and the four tests whether a child of A and a child
-- of B may overlap. One expansion every {{ interval }} clock{% if interval > 1 %}s{% endif %}; the answer is there {{ latency }} clocks after its acceptance. There is no
-- back-pressure: who sends an expansion has a place for the answer. The query is held outside while expansions of it are
-- in flight. Words of the query and of blocks: docs/engine.md.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

entity {{ prefix }}volume_unit is
  port (
    clk : in std_logic;
    reset : in std_logic;  -- synchronous; what is in flight is forgotten
{%- for word in words %}
{%- if word.name.starts_with("query") %}
    {{ word.name }} : in std_logic_vector({{ word.bits - 1 }} downto 0);
{%- endif %}
{%- endfor %}
    in_valid : in std_logic;
    in_ready : out std_logic;  -- one clock of every {{ interval }}
{%- for word in words %}
{%- if !word.name.starts_with("query") %}
    {{ word.name }} : in std_logic_vector({{ word.bits - 1 }} downto 0);
{%- endif %}
{%- endfor %}
    out_valid : out std_logic;
    out_survive : out std_logic_vector(3 downto 0)  -- bit 2 p + q: child p of A and child q of B may overlap
  );
end entity {{ prefix }}volume_unit;

architecture rtl of {{ prefix }}volume_unit is
begin
  stage : entity work.{{ prefix }}volume_stage
    port map (
      clk => clk,
      reset => reset,
{%- for word in words %}
{%- for number in word.numbers %}
      {{ number.0 }} => {{ word.name }}({% if number.3 %}{{ number.1 }}{% else %}{{ number.2 }} downto {{ number.1 }}{% endif %}),
{%- endfor %}
{%- endfor %}
      in_valid => in_valid,
      in_ready => in_ready,
      out_valid => out_valid,
      out_survive => out_survive
    );
end architecture rtl;
