--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- UART transmitter: 8 data bits, least significant first, no parity, one stop bit.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}uart_transmitter is
  generic (
    clocks_per_bit : positive
  );
  port (
    clk : in std_logic;
    reset : in std_logic;
    data : in std_logic_vector(7 downto 0);
    data_valid : in std_logic;
    data_ready : out std_logic;
    tx : out std_logic
  );
end entity {{ prefix }}uart_transmitter;

architecture rtl of {{ prefix }}uart_transmitter is
  signal busy : std_logic := '0';
  signal count : natural range 0 to clocks_per_bit - 1 := 0;
  signal bits : natural range 0 to 9 := 0;  -- bits sent, the start bit included
  signal shift : std_logic_vector(8 downto 0) := "111111111";  -- the lowest bit is on the line
begin
  transmit : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        busy <= '0';
        shift <= "111111111";
      elsif busy = '0' then
        count <= clocks_per_bit - 1;
        bits <= 0;
        if data_valid = '1' then
          busy <= '1';
          shift <= data & '0';
        end if;
      elsif count /= 0 then
        count <= count - 1;
      else
        count <= clocks_per_bit - 1;
        shift <= '1' & shift(8 downto 1);
        if bits = 9 then
          busy <= '0';
        else
          bits <= bits + 1;
        end if;
      end if;
    end if;
  end process transmit;

  data_ready <= not busy;
  tx <= shift(0);
end architecture rtl;
