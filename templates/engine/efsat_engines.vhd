--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}efsat_engines is
  port (
{% let read_ports = &e.engines.ports -%}
{%- include "engine/ports.vhd" %}
  );
end entity {{ prefix }}efsat_engines;

architecture rtl of {{ prefix }}efsat_engines is
  subtype flags is std_logic_vector(engines - 1 downto 0);
  signal reset : std_logic;
  signal forget : std_logic;
  signal forget_number : std_logic_vector(23 downto 0);
  signal in_valid : flags;
  signal in_ready : flags;
  signal in_data : std_logic_vector(63 downto 0);
  signal in_keep : std_logic_vector(7 downto 0);
  signal in_last : std_logic;
  signal out_valid : flags;
  signal out_ready : flags;
{%- for i in e.engines.each %}
  signal out_data_{{ i }} : std_logic_vector(63 downto 0);
{%- if !e.engines.own_ports %}
  signal ask_address_{{ i }} : std_logic_vector(31 downto 0);
  signal ask_length_{{ i }} : std_logic_vector(7 downto 0);
{%- endif %}
{%- endfor %}
  signal out_last : flags;
  signal answered : flags;
  signal renew : flags;
{%- if !e.engines.own_ports %}
  signal ask_valid : flags;
  signal ask_ready : flags;
  signal word_valid : flags;
  signal word_data : std_logic_vector(memory_width - 1 downto 0);
  signal word_response : std_logic_vector(1 downto 0);
  signal word_last : std_logic;
{%- endif %}
begin
  reset <= not aresetn;

  dispatch : entity work.{{ prefix }}engines_dispatch
    port map (
      clk => aclk,
      reset => reset,
      soft_reset => soft_reset,
      s_axis_tdata => s_axis_tdata,
      s_axis_tkeep => s_axis_tkeep,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tlast => s_axis_tlast,
      s_axis_tready => s_axis_tready,
      forget => forget,
      forget_number => forget_number,
      out_valid => in_valid,
      out_ready => in_ready,
      out_data => in_data,
      out_keep => in_keep,
      out_last => in_last,
      answered => answered,
      renew => renew
    );
{%- for i in e.engines.each %}

  engine_{{ i }} : entity work.{{ prefix }}efsat_engine
    port map (
      renew_caches => renew({{ i }}),
      aclk => aclk,
      aresetn => aresetn,
      soft_reset => forget,
      s_axis_tdata => in_data,
      s_axis_tkeep => in_keep,
      s_axis_tvalid => in_valid({{ i }}),
      s_axis_tlast => in_last,
      s_axis_tready => in_ready({{ i }}),
{%- if e.engines.own_ports %}
{%- if e.memory.id.is_some() %}
      m_axi_arid => m{{ i }}_axi_arid,
{%- endif %}
      m_axi_araddr => m{{ i }}_axi_araddr,
      m_axi_arlen => m{{ i }}_axi_arlen,
      m_axi_arsize => m{{ i }}_axi_arsize,
      m_axi_arburst => m{{ i }}_axi_arburst,
      m_axi_arcache => m{{ i }}_axi_arcache,
      m_axi_arprot => m{{ i }}_axi_arprot,
      m_axi_arvalid => m{{ i }}_axi_arvalid,
      m_axi_arready => m{{ i }}_axi_arready,
      m_axi_rdata => m{{ i }}_axi_rdata,
      m_axi_rresp => m{{ i }}_axi_rresp,
      m_axi_rlast => m{{ i }}_axi_rlast,
      m_axi_rvalid => m{{ i }}_axi_rvalid,
      m_axi_rready => m{{ i }}_axi_rready,
{%- else %}
      m_axi_araddr => ask_address_{{ i }},
      m_axi_arlen => ask_length_{{ i }},
      m_axi_arsize => open,
      m_axi_arburst => open,
      m_axi_arcache => open,
      m_axi_arprot => open,
      m_axi_arvalid => ask_valid({{ i }}),
      m_axi_arready => ask_ready({{ i }}),
      m_axi_rdata => word_data,
      m_axi_rresp => word_response,
      m_axi_rlast => word_last,
      m_axi_rvalid => word_valid({{ i }}),
      m_axi_rready => open,
{%- endif %}
      m_axis_tdata => out_data_{{ i }},
      m_axis_tkeep => open,
      m_axis_tvalid => out_valid({{ i }}),
      m_axis_tlast => out_last({{ i }}),
      m_axis_tready => out_ready({{ i }})
    );
{%- endfor %}

  gather : entity work.{{ prefix }}engines_gather
    port map (
      clk => aclk,
      reset => reset,
      forget => forget,
      forget_number => forget_number,
      in_valid => out_valid,
      in_ready => out_ready,
{%- for i in e.engines.each %}
      in_data_{{ i }} => out_data_{{ i }},
{%- endfor %}
      in_last => out_last,
      answered => answered,
      m_axis_tdata => m_axis_tdata,
      m_axis_tkeep => m_axis_tkeep,
      m_axis_tvalid => m_axis_tvalid,
      m_axis_tlast => m_axis_tlast,
      m_axis_tready => m_axis_tready
    );
{%- if !e.engines.own_ports %}

  memory : entity work.{{ prefix }}engines_memory
    port map (
      clk => aclk,
      reset => reset,
      ask_valid => ask_valid,
      ask_ready => ask_ready,
{%- for i in e.engines.each %}
      ask_address_{{ i }} => ask_address_{{ i }},
      ask_length_{{ i }} => ask_length_{{ i }},
{%- endfor %}
      word_valid => word_valid,
      word_data => word_data,
      word_response => word_response,
      word_last => word_last,
{% include "engine/read_port.vhd" %}
{%- endif %}
end architecture rtl;
