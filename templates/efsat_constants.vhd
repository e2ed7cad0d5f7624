--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Constants of the design, for those who instantiate {{ whose }} does not use them.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

package {{ prefix }}{{ of }}_constants is
{%- for group in groups %}
{%- if !loop.first %}
{% endif %}
  -- {{ group.what }}
{%- for constant in group.constants %}
  constant {{ prefix }}{{ of }}_{{ constant.name }} : {{ constant.vhdl() }};  -- {{ constant.what }}
{%- endfor %}
{%- endfor %}
end package {{ prefix }}{{ of }}_constants;
