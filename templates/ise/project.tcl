{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Makes the project {{ project }} for {{ releases }} and synthesises it: xtclsh project.tcl
#
# The unit is a core: it has more ports than the part has pins, so no I/O buffers are added, and synthesis is the last
# step that makes sense without the design around it.
project new {{ project }}
project set family {{ family }}
project set device {{ device }}
project set package {{ package }}
project set speed {{ speed }}
{%- for file in files %}
xfile add ../{{ file }}
{%- endfor %}
xfile add {{ prefix }}efsat.ucf
project set top "rtl" "{{ prefix }}efsat"
project set "Optimization Goal" Speed -process "Synthesize - XST"
project set "Register Balancing" Yes -process "Synthesize - XST"
project set "Add I/O Buffers" false -process "Synthesize - XST"
set done [process run "Synthesize - XST"]
project close
if {!$done} {
  error "synthesis failed"
}
