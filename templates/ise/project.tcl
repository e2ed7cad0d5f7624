{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# Makes the project {{ project }} for {{ releases }} and synthesises it: xtclsh project.tcl
#
# It is a core for a design around it, so no I/O buffers are added, and synthesis is the last step that makes sense.
project new {{ project }}
project set family {{ family }}
project set device {{ device }}
project set package {{ package }}
project set speed {{ speed }}
{%- for file in files %}
xfile add ../{{ file }}
{%- endfor %}
xfile add {{ stem }}.ucf
project set top "rtl" "{{ top }}"
{%- for setting in options %}
project set "{{ setting.property }}" {{ setting.property_value }} -process "Synthesize - XST"
{%- endfor %}
set done [process run "Synthesize - XST"]
project close
if {!$done} {
  error "synthesis failed"
}
