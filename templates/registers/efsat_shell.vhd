--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- {{ prefix }}{{ core }} behind the registers of {{ prefix }}efsat_registers, for a processor that has AXI4-Lite and an interrupt.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

entity {{ prefix }}efsat_shell is
  port (
    aclk : in std_logic;
    aresetn : in std_logic;  -- synchronous, active low{% if more_ports.len() > 0 %}; with the memory behind m_axi, for at least 16 clocks{% endif %}
{% include "registers/lite_ports.vhd" %}
{%- if more_ports.len() > 0 %}
{{ more_ports }}
{%- endif %}
    irq : out std_logic  -- until what is pending is cleared or masked
  );
end entity {{ prefix }}efsat_shell;

architecture rtl of {{ prefix }}efsat_shell is
  signal clear_core : std_logic;
{%- if !is_engine %}
  signal core_resetn : std_logic;
{%- endif %}
  signal words_tdata : std_logic_vector(63 downto 0);
  signal words_tvalid : std_logic;
  signal words_tlast : std_logic;
  signal words_tready : std_logic;
  signal answers_tdata : std_logic_vector({{ answer }});
  signal answers_tvalid : std_logic;
  signal answers_tlast : std_logic;
  signal answers_tready : std_logic;
begin
  registers : entity work.{{ prefix }}efsat_registers
    port map (
      aclk => aclk,
      aresetn => aresetn,
{%- for port in lite_ports %}
      {{ port }} => {{ port }},
{%- endfor %}
      irq => irq,
      clear_core => clear_core,
      m_axis_tdata => words_tdata,
      m_axis_tvalid => words_tvalid,
      m_axis_tlast => words_tlast,
      m_axis_tready => words_tready,
      s_axis_tdata => answers_tdata,
      s_axis_tvalid => answers_tvalid,
      s_axis_tlast => answers_tlast,
      s_axis_tready => answers_tready
    );
{%- if !is_engine %}
  core_resetn <= aresetn and not clear_core;
{%- endif %}

  core : entity work.{{ prefix }}{{ core }}
    port map (
      aclk => aclk,
{%- if is_engine %}
      aresetn => aresetn,
      soft_reset => clear_core,
{%- else %}
      aresetn => core_resetn,
{%- endif %}
      s_axis_tdata => words_tdata,
      s_axis_tvalid => words_tvalid,
      s_axis_tlast => words_tlast,
      s_axis_tready => words_tready,
{%- for port in more_names %}
      {{ port }} => {{ port }},
{%- endfor %}
      m_axis_tdata => answers_tdata,
      m_axis_tkeep => open,
      m_axis_tvalid => answers_tvalid,
      m_axis_tlast => answers_tlast,
      m_axis_tready => answers_tready
    );
end architecture rtl;
