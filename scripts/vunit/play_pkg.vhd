-- Words from a file to a stream of VUnit, and from one into a file.
library ieee;
use ieee.std_logic_1164.all;
use std.textio.all;

library vunit_lib;
context vunit_lib.vunit_context;
context vunit_lib.com_context;
context vunit_lib.vc_context;

package play_pkg is
  constant stalls : stall_config_t := new_stall_config(0.3, 1, 7);

  -- Lines of a word in hexadecimal, whether it is the last of its packet, and its TKEEP.
  procedure send(signal net : inout network_t; source : axi_stream_master_t; name : string);

  -- All words of so many packets, with their TLAST.
  procedure receive(signal net : inout network_t; sink : axi_stream_slave_t; packets : natural; name : string);
end package play_pkg;

package body play_pkg is
  procedure send(signal net : inout network_t; source : axi_stream_master_t; name : string) is
    file words : text open read_mode is name;
    variable row : line;
    variable data : std_logic_vector(63 downto 0);
    variable last : std_logic;
    variable keep : std_logic_vector(7 downto 0);
  begin
    while not endfile(words) loop
      readline(words, row);
      hread(row, data);
      read(row, last);
      hread(row, keep);
      push_axi_stream(net, source, data, last, keep);
    end loop;
  end procedure send;

  procedure receive(signal net : inout network_t; sink : axi_stream_slave_t; packets : natural; name : string) is
    file words : text open write_mode is name;
    variable row : line;
    variable data : std_logic_vector(63 downto 0);
    variable last : std_logic;
    variable ended : natural := 0;
  begin
    while ended < packets loop
      pop_axi_stream(net, sink, data, last);
      hwrite(row, data);
      write(row, ' ');
      write(row, last);
      writeline(words, row);
      if last = '1' then
        ended := ended + 1;
      end if;
    end loop;
  end procedure receive;
end package body play_pkg;
