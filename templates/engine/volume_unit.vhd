--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The volume unit: two blocks, each with the volumes of two children, and the four tests whether a child of A and a child
-- of B may overlap. It takes an expansion every {% if interval > 1 %}{{ interval }} clocks{% else %}clock{% endif %} and answers {{ latency }} clocks after it has taken it. There is no
-- back-pressure: whoever sends an expansion has a place for its answer. Each expansion has a query of its own.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}{{ package }}.all;

entity {{ prefix }}volume_unit is
  port (
    clk : in std_logic;
    reset : in std_logic;  -- synchronous; what is in flight is forgotten
{%- for word in words %}
{%- if word.query %}
    {{ word.name }} : in std_logic_vector({{ word.high }} downto 0);
{%- endif %}
{%- endfor %}
    in_valid : in std_logic;
    in_ready : out std_logic;  -- set in {% if interval > 1 %}one clock of every {{ interval }}{% else %}every clock{% endif %}, whatever in_valid is
{%- for word in words %}
{%- if !word.query %}
    {{ word.name }} : in std_logic_vector({{ word.high }} downto 0);
{%- endif %}
{%- endfor %}
    out_valid : out std_logic;
    out_survive : out std_logic_vector(3 downto 0)  -- bit 2 p + q: child p of A and child q of B may overlap
  );
end entity {{ prefix }}volume_unit;

architecture rtl of {{ prefix }}volume_unit is
{%- for bundle in bundles %}
  signal stage_{{ bundle.name }} : {{ bundle.ty }};
{%- endfor %}
  signal stage_survive : unsigned(3 downto 0);
begin
  -- The numbers in the words.
{%- for bundle in bundles %}
{%- for group in bundle.groups %}
{%- if let Some(last) = group.last %}
  each_{{ bundle.name }} : for i in 0 to {{ last }} generate
{%- for part in group.parts %}
    {{ part.target }} <= {{ part.value }};
{%- endfor %}
  end generate each_{{ bundle.name }};
{%- else %}
{%- for part in group.parts %}
  {{ part.target }} <= {{ part.value }};
{%- endfor %}
{%- endif %}
{%- endfor %}
{%- endfor %}

  stage : entity work.{{ prefix }}volume_stage
    port map (
      clk => clk,
      reset => reset,
{%- for bundle in bundles %}
      {{ bundle.name }} => stage_{{ bundle.name }},
{%- endfor %}
      in_valid => in_valid,
      in_ready => in_ready,
      out_valid => out_valid,
      out_survive => stage_survive
    );
  out_survive <= std_logic_vector(stage_survive);
end architecture rtl;
