{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Packages {{ top }} as an IP with {% if has_registers %}an AXI4-Lite interface and an interrupt{% else %}two AXI4-Stream interfaces{% endif %}, in the folder ip beside this script:
#   vivado -mode batch -source package_ip.tcl
# Add that folder to the IP repositories of a project to find it in the catalog.
set here [file dirname [file normalize [info script]]]
create_project -in_memory -part "{{ part }}"
add_files -norecurse [list \
{%- for file in sources %}
  [file join $here .. {{ file }}] \
{%- endfor %}
]
set_property file_type VHDL [get_files *.vhd]
set_property top {{ top }} [current_fileset]
update_compile_order -fileset sources_1
ipx::package_project -root_dir [file join $here ip] -vendor efsat -library core -name {{ name }} -version {{ ip_version }} \
  -taxonomy /UserIP -import_files -force
set core [ipx::current_core]
set_property display_name "EFSAT: {{ name }}" $core
set_property description "Triangle-triangle intersection, one pair every {{ interval }} clocks: {{ command_line }}" $core
set_property supported_families [list {{ family }} Production] $core
{% if has_registers -%}
# The interface is inferred from the names of its ports; it is clocked by aclk.
ipx::associate_bus_interfaces -busif s_axi -clock aclk $core
ipx::infer_bus_interface irq xilinx.com:signal:interrupt_rtl:1.0 $core
{% else -%}
# The two streams are inferred from the names of their ports; both are clocked by aclk.
ipx::associate_bus_interfaces -busif s_axis -clock aclk $core
ipx::associate_bus_interfaces -busif m_axis -clock aclk $core
{% endif -%}
ipx::create_xgui_files $core
ipx::update_checksums $core
ipx::check_integrity $core
ipx::save_core $core
close_project
