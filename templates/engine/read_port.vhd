{% include "engine/burst_map.vhd" %}
{%- if e.memory.id.is_some() %}
  m_axi_arid <= (others => '0');
{%- endif %}
  m_axi_arcache <= "0011";
  m_axi_arprot <= "000";
