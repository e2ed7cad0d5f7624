{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Packages {{ top }} as an IP in the folder ip beside this script:
#   vivado -mode batch -source package_ip.tcl
# Add that folder to the IP repositories of a project to find it in the catalog.
#
# Its interfaces are inferred from the names of their ports; all are clocked by aclk:
{%- for interface in interfaces %}
#   {{ interface.name }}: {{ interface.what }}
{%- endfor %}
{%- if has_irq %}
#   irq: interrupt
{%- endif %}
set here [file dirname [file normalize [info script]]]
create_project -in_memory -part "{{ part }}"
add_files -norecurse [list \
{%- for file in sources %}
  [file join $here .. {{ file }}] \
{%- endfor %}
]
set_property file_type VHDL [get_files *.vhd]
add_files -fileset constrs_1 -norecurse [file join $here {{ stem }}_ooc.xdc]
set_property used_in {synthesis implementation out_of_context} [get_files {{ stem }}_ooc.xdc]
set_property top {{ top }} [current_fileset]
update_compile_order -fileset sources_1
ipx::package_project -root_dir [file join $here ip] -vendor efsat -library core -name {{ name }} -version {{ ip_version }} \
  -taxonomy /UserIP -import_files -force
set core [ipx::current_core]
set_property display_name "EFSAT: {{ name }}" $core
set_property description "{{ what }}; {{ pace }}. {{ command_line }}" $core
set_property supported_families [list {{ family }} Production] $core
{%- for interface in interfaces %}
ipx::associate_bus_interfaces -busif {{ interface.name }} -clock aclk $core
{%- endfor %}
{%- if has_irq %}
ipx::infer_bus_interface irq xilinx.com:signal:interrupt_rtl:1.0 $core
{%- endif %}
ipx::create_xgui_files $core
ipx::update_checksums $core
ipx::check_integrity $core
ipx::save_core $core
close_project
