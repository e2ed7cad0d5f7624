--------------------------------------------------------------------------------
{%- for line in header %}
--{% if line.len() > 0 %} {{ line }}{% endif %}
{%- endfor %}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
{%- if let Some(package) = package %}
use work.{{ package }}.all;
{%- endif %}

entity {{ name }} is
  port (
{%- for port in ports %}
    {{ port.text }}{% if port.comment.len() > 0 %}  -- {{ port.comment }}{% endif %}
{%- endfor %}
  );
end entity {{ name }};

architecture rtl of {{ name }} is
{%- for declaration in declarations %}
  {{ declaration.text }}{% if declaration.comment.len() > 0 %}  -- {{ declaration.comment }}{% endif %}
{%- endfor %}
begin
{%- for block in blocks %}
{%- if block.heading.len() > 0 %}
  -- {{ block.heading }}
{%- endif %}
{%- for line in block.lines %}
  {{ line }}
{%- endfor %}
{%- if !loop.last %}
{% endif %}
{%- endfor %}
end architecture rtl;
