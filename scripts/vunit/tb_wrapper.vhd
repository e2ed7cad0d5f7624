-- The stream wrapper between models of VUnit, which check the rules of AXI4-Stream on both sides and stall at random.
library ieee;
use ieee.std_logic_1164.all;

library vunit_lib;
context vunit_lib.vunit_context;
context vunit_lib.com_context;
context vunit_lib.vc_context;

use work.play_pkg.all;

entity tb_wrapper is
  generic (runner_cfg : string; words : string; answers : string; packets : natural);
end entity tb_wrapper;

architecture simulation of tb_wrapper is
  constant checker : axi_stream_protocol_checker_t := new_axi_stream_protocol_checker(data_length => 64, max_waits => 100000);
  constant checker_out : axi_stream_protocol_checker_t := new_axi_stream_protocol_checker(data_length => 64, max_waits => 100000);
  constant source : axi_stream_master_t := new_axi_stream_master(64, stall_config => stalls, protocol_checker => checker);
  constant sink : axi_stream_slave_t := new_axi_stream_slave(64, stall_config => stalls, protocol_checker => checker_out);
  signal clk, resetn : std_logic := '0';
  signal in_data, out_data : std_logic_vector(63 downto 0);
  signal in_keep, out_keep : std_logic_vector(7 downto 0);
  signal in_valid, in_last, in_ready, out_valid, out_last, out_ready : std_logic;
begin
  clk <= not clk after 5 ns;
  resetn <= '1' after 200 ns;

  main : process
  begin
    test_runner_setup(runner, runner_cfg);
    wait until resetn = '1';
    send(net, source, words);
    receive(net, sink, packets, answers);
    test_runner_cleanup(runner);
  end process main;
  test_runner_watchdog(runner, 2 ms);

  from_vunit : entity vunit_lib.axi_stream_master
    generic map (master => source)
    port map (aclk => clk, areset_n => resetn, tvalid => in_valid, tready => in_ready, tdata => in_data, tlast => in_last, tkeep => in_keep);
  to_vunit : entity vunit_lib.axi_stream_slave
    generic map (slave => sink)
    port map (aclk => clk, areset_n => resetn, tvalid => out_valid, tready => out_ready, tdata => out_data, tlast => out_last, tkeep => out_keep);
  unit : entity work.efsat_stream
    port map (
      aclk => clk, aresetn => resetn,
      s_axis_tdata => in_data, s_axis_tkeep => in_keep, s_axis_tvalid => in_valid, s_axis_tlast => in_last, s_axis_tready => in_ready,
      m_axis_tdata => out_data, m_axis_tkeep => out_keep, m_axis_tvalid => out_valid, m_axis_tlast => out_last, m_axis_tready => out_ready);
end architecture simulation;
