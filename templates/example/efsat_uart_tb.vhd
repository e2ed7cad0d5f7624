--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of the UART example: {{ story }}, a byte at a time; then three stray
-- bytes. Every byte of every answer is compared. It stops by itself; the last line begins with "{{ prefix }}efsat_uart_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity {{ prefix }}efsat_uart_tb is
  port (
    finished : out boolean
  );
end entity {{ prefix }}efsat_uart_tb;

architecture simulation of {{ prefix }}efsat_uart_tb is
  constant clocks_per_bit : positive := 4;
  constant silence_bits : positive := 24;
  constant patience : positive := 4096;  -- bit times without an answer before giving up

  type byte_list is array (natural range <>) of std_logic_vector(7 downto 0);
{%- for packet in packets %}
  -- {{ packet.what }}
  constant {{ packet.name }} : byte_list(0 to {{ packet.high }}) := (
{%- for row in packet.rows %}
    {{ row }}
{%- endfor %}
  );
{%- endfor %}

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal reset : std_logic := '1';
  signal rx : std_logic := '1';
  signal tx : std_logic;
begin
  clk <= not clk after 5 ns when not done else '0';
  finished <= done;

  example : entity work.{{ prefix }}efsat_uart_top
    generic map (
      clock_frequency => clocks_per_bit,
      baud_rate => 1,
      silence_bits => silence_bits
    )
    port map (
      clk => clk,
      reset => reset,
      rx => rx,
      tx => tx
    );

  main : process
    variable message : line;
    variable mismatches : natural := 0;
    variable compared : natural := 0;

    procedure bits_pass(count : in natural) is
    begin
      for i in 1 to clocks_per_bit * count loop
        wait until rising_edge(clk);
      end loop;
    end procedure bits_pass;

    procedure send(packet : in byte_list) is
    begin
      for i in packet'range loop
        rx <= '0';
        bits_pass(1);
        for j in 0 to 7 loop
          rx <= packet(i)(j);
          bits_pass(1);
        end loop;
        rx <= '1';
        bits_pass(1);
      end loop;
    end procedure send;

    procedure expect_answer(answer : in byte_list) is
      variable waited : natural;
      variable actual : std_logic_vector(7 downto 0);
    begin
      for i in answer'range loop
        waited := 0;
        while tx /= '0' loop
          wait until rising_edge(clk);
          waited := waited + 1;
          assert waited < clocks_per_bit * patience report "{{ prefix }}efsat_uart_tb: no answer" severity failure;
        end loop;
        -- To the middle of the start bit, then bit by bit to the middle of the stop bit.
        for j in 1 to clocks_per_bit / 2 loop
          wait until rising_edge(clk);
        end loop;
        for j in 0 to 7 loop
          bits_pass(1);
          actual(j) := tx;
        end loop;
        bits_pass(1);
        compared := compared + 1;
        if actual /= answer(i) or tx /= '1' then
          mismatches := mismatches + 1;
        end if;
      end loop;
    end procedure expect_answer;
  begin
    bits_pass(2);
    reset <= '0';
    bits_pass(2);
{%- for step in steps %}
    {{ step }}
{%- endfor %}
    write(message, string'("{{ prefix }}efsat_uart_tb: bytes compared "));
    write(message, compared);
    write(message, string'(" mismatches "));
    write(message, mismatches);
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}efsat_uart_tb: the unit and the reference model differ" severity failure;
    done <= true;
    wait;
  end process main;
end architecture simulation;
