{% for line in header -%}
# {{ line }}
{% endfor -%}
create_clock -name aclk -period {{ period }} [get_ports aclk]
