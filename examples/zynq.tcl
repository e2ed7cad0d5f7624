# NOT TRIED: written without Vivado at hand, from the guides of its IP.
#
# A block design for a Zynq-7000: the processing system, an AXI DMA engine with both streams of a collision engine, and the engine's read
# port at the memory. With a unit in place of the engine the read port is left out.
#
#   efsat generate --engine --device xc7z020-1 --out engine
#   (cd engine/vivado && vivado -mode batch -source package_ip.tcl)
#   vivado -mode batch -source examples/zynq.tcl -tclargs engine/vivado/ip
#
# Put images into memory outside the processor's caches, or flush them; then send queries by the DMA engine, as host/efsat_engine.h
# packs them.
set part xc7z020clg400-1
if {$argc != 1} {
  error "expected -tclargs and the folder of the packaged core"
}
create_project -force -part $part efsat_zynq efsat_zynq
set_property ip_repo_paths [file normalize [lindex $argv 0]] [current_project]
update_ip_catalog
set packaged [get_ipdefs -filter {VLNV =~ efsat:core:*}]
if {[llength $packaged] != 1} {
  error "expected one core in the folder, found [llength $packaged]"
}
create_bd_design system

set processor [create_bd_cell -type ip -vlnv xilinx.com:ip:processing_system7 processor]
apply_bd_automation -rule xilinx.com:bd_rule:processing_system7 -config {make_external "FIXED_IO, DDR"} $processor
set_property -dict [list CONFIG.PCW_FPGA0_PERIPHERAL_FREQMHZ 100 CONFIG.PCW_USE_S_AXI_HP0 1 CONFIG.PCW_USE_S_AXI_HP1 1 \
  CONFIG.PCW_USE_FABRIC_INTERRUPT 1 CONFIG.PCW_IRQ_F2P_INTR 1] $processor
set dma [create_bd_cell -type ip -vlnv xilinx.com:ip:axi_dma dma]
set_property -dict [list CONFIG.c_include_sg 0 CONFIG.c_sg_length_width 23 CONFIG.c_m_axi_mm2s_data_width 64 \
  CONFIG.c_m_axis_mm2s_tdata_width 64 CONFIG.c_m_axi_s2mm_data_width 64] $dma
set core [create_bd_cell -type ip -vlnv $packaged core]

connect_bd_intf_net [get_bd_intf_pins dma/M_AXIS_MM2S] [get_bd_intf_pins core/s_axis]
connect_bd_intf_net [get_bd_intf_pins core/m_axis] [get_bd_intf_pins dma/S_AXIS_S2MM]
# Each master, and the slave that it reaches.
set ways [list /processor/M_AXI_GP0 dma/S_AXI_LITE /dma/M_AXI_MM2S processor/S_AXI_HP0 /dma/M_AXI_S2MM processor/S_AXI_HP0]
if {[llength [get_bd_intf_pins -quiet core/m_axi]]} {
  lappend ways /core/m_axi processor/S_AXI_HP1
}
foreach {master slave} $ways {
  apply_bd_automation -rule xilinx.com:bd_rule:axi4 -config [list Master $master Clk Auto] [get_bd_intf_pins $slave]
}
# A soft reset comes by a word of the stream.
if {[llength [get_bd_pins -quiet core/soft_reset]]} {
  set none [create_bd_cell -type ip -vlnv xilinx.com:ip:xlconstant none]
  set_property CONFIG.CONST_VAL 0 $none
  connect_bd_net [get_bd_pins none/dout] [get_bd_pins core/soft_reset]
}
set interrupts [create_bd_cell -type ip -vlnv xilinx.com:ip:xlconcat interrupts]
connect_bd_net [get_bd_pins dma/mm2s_introut] [get_bd_pins interrupts/In0]
connect_bd_net [get_bd_pins dma/s2mm_introut] [get_bd_pins interrupts/In1]
connect_bd_net [get_bd_pins interrupts/dout] [get_bd_pins processor/IRQ_F2P]
# What no bus has connected: clock and reset of the core's streams.
foreach {pin source} {core/aclk processor/FCLK_CLK0 core/aresetn dma/axi_resetn} {
  if {![llength [get_bd_nets -quiet -of_objects [get_bd_pins $pin]]]} {
    connect_bd_net [get_bd_pins $source] [get_bd_pins $pin]
  }
}
assign_bd_address
validate_bd_design
save_bd_design
make_wrapper -files [get_files system.bd] -top -import
update_compile_order -fileset sources_1
