{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Makes a Vivado project of the {{ core.name }} behind a UART for an Arty A7-100T, and its bitstream:
#   vivado -mode batch -source project.tcl
set here [file dirname [file normalize [info script]]]
set top {{ prefix }}efsat_arty_a7
create_project -force -part "{{ part }}" $top [file join $here $top]
add_files -norecurse [list \
{%- for file in sources %}
  [file join $here .. {{ file }}] \
{%- endfor %}
]
set_property file_type VHDL [get_files *.vhd]
add_files -fileset constrs_1 -norecurse [file join $here $top.xdc]
set_property top $top [current_fileset]
update_compile_order -fileset sources_1
launch_runs impl_1 -to_step write_bitstream
wait_on_run impl_1
if {[get_property PROGRESS [get_runs impl_1]] ne "100%"} {
  error "no bitstream was made"
}
open_run impl_1
report_timing_summary -file [file join $here timing.txt]
report_utilization -file [file join $here utilization.txt]
if {[get_property SLACK [get_timing_paths]] < 0} {
  error "{{ megahertz }} MHz are missed: timing.txt has the paths"
}
