-- Prints what the console says, up to the line "end", into a file.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use std.env.finish;

entity system_tb is
  generic (
    PROGRAM : string := "program.hex";
    ANSWERS : string := "answers.txt";
    MOST_CLOCKS : positive := 20000000
  );
end entity system_tb;

architecture simulation of system_tb is
  signal clock : std_ulogic := '0';
  signal reset : std_ulogic := '1';
  signal console : std_ulogic_vector(7 downto 0);
  signal console_valid : std_ulogic;
begin
  clock <= not clock after 5 ns;
  reset <= '0' after 200 ns;

  dut : entity work.system
    generic map (PROGRAM => PROGRAM)
    port map (clock => clock, reset => reset, console => console, console_valid => console_valid);

  listen : process
    file to_file : text open write_mode is ANSWERS;
    variable row, copy : line;
    variable ended : boolean := false;
    variable clocks : natural := 0;
  begin
    while not ended loop
      wait until rising_edge(clock);
      clocks := clocks + 1;
      assert clocks < MOST_CLOCKS report "no end after " & integer'image(clocks) & " clocks" severity failure;
      if console_valid = '1' and reset = '0' then
        if unsigned(console) = 10 then
          ended := row.all = "end";
          copy := new string'(row.all);
          writeline(output, copy);
          flush(output);
          writeline(to_file, row);
        else
          write(row, character'val(to_integer(unsigned(console))));
        end if;
      end if;
    end loop;
    report integer'image(clocks) & " clocks";
    finish;
  end process listen;
end architecture simulation;
