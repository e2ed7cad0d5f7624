--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The widths that the entities of the engine share, and the fields of their words: a subtype names the bits of a field, so
-- job_words(job_options) are the options of a query. Flags of lanes and attributes for synthesis are declared here, too.
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
{%- if e.lanes %}

  -- A flag for each lane; the same, each that of the lane before.
  subtype lane_flags is std_logic_vector(lanes - 1 downto 0);
  function rotated(flags : lane_flags) return lane_flags;
{%- endif %}

  -- Memories that synthesis would otherwise put where it likes: XST and Vivado read it.
  attribute ram_style : string;
end package {{ prefix }}engine_layout;
{%- if e.lanes %}

package body {{ prefix }}engine_layout is
  function rotated(flags : lane_flags) return lane_flags is
    variable turned : lane_flags;
  begin
    for lane in 0 to lanes - 1 loop
      turned(lane) := flags((lane + lanes - 1) mod lanes);
    end loop;
    return turned;
  end function rotated;
end package body {{ prefix }}engine_layout;
{%- endif %}
