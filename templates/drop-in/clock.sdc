{% for line in header -%}
# {{ line }}
{% endfor -%}
#
# The clock of {{ top }}. Out of context only: in a design around it the clock is that of the design.
create_clock -name aclk -period {{ period }} [get_ports aclk]
