-- The engine between models of VUnit, which check the rules of the streams, and a memory that checks bursts, and refuses reads outside the
-- images. All stall at random. With errors, so many of a thousand words of memory come as an error.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use ieee.math_real.uniform;
use std.textio.all;

library vunit_lib;
context vunit_lib.vunit_context;
context vunit_lib.com_context;
context vunit_lib.vc_context;

use work.play_pkg.all;

entity tb_engine is
  generic (runner_cfg : string; words : string; answers : string; packets : natural; image : string;
    errors : natural);
end entity tb_engine;

architecture simulation of tb_engine is
  constant checker : axi_stream_protocol_checker_t := new_axi_stream_protocol_checker(data_length => 64, max_waits => 1000000);
  constant checker_out : axi_stream_protocol_checker_t := new_axi_stream_protocol_checker(data_length => 64, max_waits => 1000000);
  constant source : axi_stream_master_t := new_axi_stream_master(64, stall_config => stalls, protocol_checker => checker);
  constant sink : axi_stream_slave_t := new_axi_stream_slave(64, stall_config => stalls, protocol_checker => checker_out);
  constant memory : memory_t := new_memory;
  constant reads : axi_slave_t := new_axi_slave(
    memory, address_fifo_depth => 8, address_stall_probability => 0.3, data_stall_probability => 0.3,
    min_response_latency => 50 ns, max_response_latency => 600 ns);
  signal clk, resetn : std_logic := '0';
  signal in_data, out_data, data : std_logic_vector(63 downto 0);
  signal in_keep, out_keep, burst_length : std_logic_vector(7 downto 0);
  signal in_valid, in_last, in_ready, out_valid, out_last, out_ready : std_logic;
  signal address : std_logic_vector(31 downto 0);
  signal size : std_logic_vector(2 downto 0);
  signal burst, response, memory_response : std_logic_vector(1 downto 0);
  signal address_valid, address_ready, data_valid, data_ready, data_last : std_logic;
  signal id : std_logic_vector(0 downto 0);
  signal failing : boolean := false;
begin
  clk <= not clk after 5 ns;
  resetn <= '1' after 200 ns;

  main : process
    file rows : text;
    variable row : line;
    variable word : std_logic_vector(63 downto 0);
    variable place : natural := 0;
    variable given : buffer_t;
  begin
    test_runner_setup(runner, runner_cfg);
    -- Words from address 0 on; a word that is only dashes is not there, and must not be read.
    file_open(rows, image, read_mode);
    while not endfile(rows) loop
      readline(rows, row);
      given := allocate(memory, 8, permissions => read_only);
      if row(1) = '-' then
        for i in 0 to 7 loop
          set_permissions(memory, 8 * place + i, no_access);
        end loop;
      else
        hread(row, word);
        for i in 0 to 7 loop
          set_permissions(memory, 8 * place + i, read_and_write);
        end loop;
        write_word(memory, 8 * place, word);
        for i in 0 to 7 loop
          set_permissions(memory, 8 * place + i, read_only);
        end loop;
      end if;
      place := place + 1;
    end loop;
    wait until resetn = '1';
    send(net, source, words);
    receive(net, sink, packets, answers);
    test_runner_cleanup(runner);
  end process main;
  test_runner_watchdog(runner, 10 ms);

  -- The engine takes every word in the clock in which it is offered.
  fail : process (clk)
    variable seed_1, seed_2 : positive := 1;
    variable drawn : real;
  begin
    if rising_edge(clk) then
      assert data_ready = '1';
      uniform(seed_1, seed_2, drawn);
      failing <= drawn * 1000.0 < real(errors);
    end if;
  end process fail;
  response <= axi_resp_slverr when failing else memory_response;

  from_vunit : entity vunit_lib.axi_stream_master
    generic map (master => source)
    port map (aclk => clk, areset_n => resetn, tvalid => in_valid, tready => in_ready, tdata => in_data, tlast => in_last, tkeep => in_keep);
  to_vunit : entity vunit_lib.axi_stream_slave
    generic map (slave => sink)
    port map (aclk => clk, areset_n => resetn, tvalid => out_valid, tready => out_ready, tdata => out_data, tlast => out_last, tkeep => out_keep);
  memory_of_vunit : entity vunit_lib.axi_read_slave
    generic map (axi_slave => reads)
    port map (
      aclk => clk, arvalid => address_valid, arready => address_ready, arid => "0", araddr => address, arlen => burst_length,
      arsize => size, arburst => burst, rvalid => data_valid, rready => data_ready, rid => id, rdata => data, rresp => memory_response,
      rlast => data_last);
  unit : entity work.efsat_engine
    port map (
      aclk => clk, aresetn => resetn,
      s_axis_tdata => in_data, s_axis_tkeep => in_keep, s_axis_tvalid => in_valid, s_axis_tlast => in_last, s_axis_tready => in_ready,
      m_axi_araddr => address, m_axi_arlen => burst_length, m_axi_arsize => size, m_axi_arburst => burst, m_axi_arvalid => address_valid,
      m_axi_arready => address_ready, m_axi_rdata => data, m_axi_rresp => response, m_axi_rlast => data_last, m_axi_rvalid => data_valid,
      m_axi_rready => data_ready,
      m_axis_tdata => out_data, m_axis_tkeep => out_keep, m_axis_tvalid => out_valid, m_axis_tlast => out_last, m_axis_tready => out_ready);
end architecture simulation;
