--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ name }} is
  port (
{%- for port in ports %}
    {{ port.name }} : {{ port.direction }} {{ port.ty }}{% if !port.last %};{% endif %}{% if port.comment.len() > 0 %}  -- {{ port.comment }}{% endif %}
{%- endfor %}
  );
end entity {{ name }};

architecture rtl of {{ name }} is
{%- for declaration in declarations %}
  {{ declaration.text }}{% if declaration.comment.len() > 0 %}  -- {{ declaration.comment }}{% endif %}
{%- endfor %}
begin
{%- for stage in stages %}

  -- ===== {{ stage.title }} =====
{%- for assignment in stage.assignments %}
{%- if assignment.comment.len() > 0 %}
  -- {{ assignment.comment }}
{%- endif %}
{%- for line in assignment.lines %}
  {{ line }}
{%- endfor %}
{%- endfor %}
{%- endfor %}
{%- for instance in instances %}

  {{ instance.label }} : entity work.{{ instance.entity }}
    port map (
{%- for connection in instance.connections %}
      {{ connection.formal }} => {{ connection.actual }}{% if !connection.last %},{% endif %}
{%- endfor %}
    );
{%- endfor %}
{%- for process in processes %}

  -- {{ process.title }}
  {{ process.label }} : process (clk)
  begin
    if rising_edge(clk) then
{%- for line in process.lines %}
      {{ line }}
{%- endfor %}
    end if;
  end process {{ process.label }};
{%- endfor %}

  -- ===== Outputs =====
{%- for line in outputs %}
  {{ line }}
{%- endfor %}
end architecture rtl;
