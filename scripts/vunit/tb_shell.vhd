-- The unit behind its registers, driven by VUnit's AXI4-Lite master: all packets through the queues, and accesses that must be refused.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

library vunit_lib;
context vunit_lib.vunit_context;
context vunit_lib.com_context;
context vunit_lib.vc_context;

use vunit_lib.axi_lite_master_pkg.all;
use work.efsat_register_map.all;

entity tb_shell is
  generic (runner_cfg : string; words : string; answers : string; packets : natural);
end entity tb_shell;

architecture simulation of tb_shell is
  constant bus_handle : bus_master_t := new_bus(data_length => 32, address_length => 12);
  constant all_set : std_logic_vector(31 downto 0) := (others => '1');
  signal clk, resetn : std_logic := '0';
  signal araddr, awaddr : std_logic_vector(11 downto 0);
  signal rdata, wdata : std_logic_vector(31 downto 0);
  signal wstrb : std_logic_vector(3 downto 0);
  signal rresp, bresp : std_logic_vector(1 downto 0);
  signal arready, arvalid, rready, rvalid, awready, awvalid, wready, wvalid, bvalid, bready, irq : std_logic;
begin
  clk <= not clk after 5 ns;
  resetn <= '1' after 200 ns;

  main : process
    file sent : text;
    file received : text;
    variable row : line;
    variable data : std_logic_vector(63 downto 0);
    variable last : std_logic;
    variable keep : std_logic_vector(7 downto 0);
    variable status, low, high : std_logic_vector(31 downto 0);
    variable ended : natural := 0;

    procedure fetch is
    begin
      loop
        read_axi_lite(net, bus_handle, status_at, axi_resp_okay, status);
        exit when unsigned(status(14 downto 8)) = 0;
        read_axi_lite(net, bus_handle, receive_low_at, axi_resp_okay, low);
        read_axi_lite(net, bus_handle, receive_high_at, axi_resp_okay, high);
        hwrite(row, high & low);
        write(row, ' ');
        write(row, status(16));
        writeline(received, row);
        if status(16) = '1' then
          ended := ended + 1;
        end if;
      end loop;
    end procedure fetch;
  begin
    test_runner_setup(runner, runner_cfg);
    wait until resetn = '1';
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    file_open(sent, words, read_mode);
    file_open(received, answers, write_mode);
    -- Unaligned, unknown, partial, only read, only written, and a queue that is empty.
    write_axi_lite(net, bus_handle, x"012", all_set, axi_resp_slverr);
    write_axi_lite(net, bus_handle, x"ffc", all_set, axi_resp_slverr);
    write_axi_lite(net, bus_handle, control_at, all_set, axi_resp_slverr, "0111");
    write_axi_lite(net, bus_handle, identity_at, all_set, axi_resp_slverr);
    read_axi_lite(net, bus_handle, transmit_low_at, axi_resp_slverr, low);
    read_axi_lite(net, bus_handle, receive_high_at, axi_resp_slverr, low);
    check_equal(low, std_logic_vector'(x"00000000"));
    check_axi_lite(net, bus_handle, identity_at, axi_resp_okay, identity_reset);
    -- The queue takes 64 words while the core takes none, and refuses the next.
    for i in 1 to 64 loop
      write_axi_lite(net, bus_handle, transmit_high_at, all_set);
    end loop;
    write_axi_lite(net, bus_handle, transmit_high_at, all_set, axi_resp_slverr);
    check_equal(irq, '0');
    -- A soft reset empties it.
    write_axi_lite(net, bus_handle, control_at, x"00000003");
    write_axi_lite(net, bus_handle, mask_at, x"00000001");
    while not endfile(sent) loop
      readline(sent, row);
      hread(row, data);
      read(row, last);
      hread(row, keep);
      write_axi_lite(net, bus_handle, transmit_low_at, data(31 downto 0));
      if last = '1' then
        write_axi_lite(net, bus_handle, transmit_last_at, data(63 downto 32));
        fetch;
      else
        write_axi_lite(net, bus_handle, transmit_high_at, data(63 downto 32));
      end if;
    end loop;
    while ended < packets loop
      if irq /= '1' then
        wait until irq = '1';
      end if;
      write_axi_lite(net, bus_handle, pending_at, x"00000001");
      fetch;
    end loop;
    test_runner_cleanup(runner);
  end process main;
  test_runner_watchdog(runner, 2 ms);

  from_vunit : entity vunit_lib.axi_lite_master
    generic map (bus_handle => bus_handle)
    port map (
      aclk => clk, arready => arready, arvalid => arvalid, araddr => araddr, rready => rready, rvalid => rvalid, rdata => rdata,
      rresp => rresp, awready => awready, awvalid => awvalid, awaddr => awaddr, wready => wready, wvalid => wvalid, wdata => wdata,
      wstrb => wstrb, bvalid => bvalid, bready => bready, bresp => bresp);
  unit : entity work.efsat_shell
    port map (
      aclk => clk, aresetn => resetn,
      s_axi_awaddr => awaddr, s_axi_awprot => "000", s_axi_awvalid => awvalid, s_axi_awready => awready, s_axi_wdata => wdata,
      s_axi_wstrb => wstrb, s_axi_wvalid => wvalid, s_axi_wready => wready, s_axi_bresp => bresp, s_axi_bvalid => bvalid,
      s_axi_bready => bready, s_axi_araddr => araddr, s_axi_arprot => "000", s_axi_arvalid => arvalid, s_axi_arready => arready,
      s_axi_rdata => rdata, s_axi_rresp => rresp, s_axi_rvalid => rvalid, s_axi_rready => rready, irq => irq);
end architecture simulation;
