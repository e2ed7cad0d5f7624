--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The widths that the entities of the engine share, and the fields of their words: a subtype names the bits of a field, so
-- job_words(job_options) are the options of a query. Attributes for synthesis are declared here, too.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

package {{ prefix }}engine_layout is
{%- for group in e.layout %}
{%- if !loop.first %}
{% endif %}
  -- {{ group.what }}
{%- for item in group.items %}
  {{ item }}{% if item.what.len() > 0 %}  -- {{ item.what }}{% endif %}
{%- endfor %}
{%- endfor %}

  -- Memories that synthesis would otherwise put where it likes: XST and Vivado read it.
  attribute ram_style : string;
end package {{ prefix }}engine_layout;
