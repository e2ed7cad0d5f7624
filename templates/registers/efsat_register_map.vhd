--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Where the registers of {{ prefix }}efsat_registers are: an address in bytes for each, its value after reset, and the bits of its fields.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

package {{ prefix }}efsat_register_map is
  subtype register_address is std_logic_vector({{ address }});
  subtype register_word is std_logic_vector(31 downto 0);
{%- for register in registers %}

  -- {{ register.access }}{% if register.what.len() > 0 %}: {{ register.what }}{% endif %}
  constant {{ register.name }}_at : register_address := x"{{ register.at }}";
  constant {{ register.name }}_reset : register_word := x"{{ register.reset }}";
{%- for field in register.fields %}
{%- if field.wide %}
  constant {{ register.name }}_{{ field.name }}_low : natural := {{ field.low }};{% if field.what.len() > 0 %}  -- {{ field.what }}{% endif %}
  constant {{ register.name }}_{{ field.name }}_high : natural := {{ field.high }};
{%- else %}
  constant {{ register.name }}_{{ field.name }} : natural := {{ field.low }};{% if field.what.len() > 0 %}  -- {{ field.what }}{% endif %}
{%- endif %}
{%- endfor %}
{%- endfor %}

  -- Why an access is refused: refusal_why.
  subtype refusal_word is std_logic_vector(2 downto 0);
  constant refused_not : refusal_word := "000";
{%- for refusal in refusals %}
  constant refused_{{ refusal.name }} : refusal_word := "{{ refusal.bits }}";  -- {{ refusal.what }}
{%- endfor %}

  -- Responses of AXI.
  constant response_okay : std_logic_vector(1 downto 0) := "00";
  constant response_error : std_logic_vector(1 downto 0) := "10";
end package {{ prefix }}efsat_register_map;
