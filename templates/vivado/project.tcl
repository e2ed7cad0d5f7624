{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Makes a Vivado project of {{ top }} and synthesises it out of context:
#   vivado -mode batch -source project.tcl [-tclargs PART]
set part [expr {$argc > 0 ? [lindex $argv 0] : "{{ part }}"}]
set here [file dirname [file normalize [info script]]]
create_project -force -part $part {{ stem }} [file join $here {{ stem }}]
add_files -norecurse [list \
{%- for file in sources %}
  [file join $here .. {{ file }}] \
{%- endfor %}
]
set_property file_type VHDL [get_files *.vhd]
add_files -fileset constrs_1 -norecurse [file join $here {{ stem }}_ooc.xdc]
set_property used_in {synthesis implementation out_of_context} [get_files {{ stem }}_ooc.xdc]
set_property top {{ top }} [current_fileset]
set_property -name {STEPS.SYNTH_DESIGN.ARGS.MORE OPTIONS} -value {-mode out_of_context} -objects [get_runs synth_1]
launch_runs synth_1
wait_on_run synth_1
if {[get_property PROGRESS [get_runs synth_1]] ne "100%"} {
  error "synthesis failed"
}
open_run synth_1
report_utilization -file [file join $here utilization.txt]
report_timing_summary -file [file join $here timing.txt]
