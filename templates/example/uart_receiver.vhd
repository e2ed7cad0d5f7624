--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- UART receiver: 8 data bits, least significant first, no parity, one stop bit.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}uart_receiver is
  generic (
    clocks_per_bit : positive  -- at least 4
  );
  port (
    clk : in std_logic;
    reset : in std_logic;
    rx : in std_logic;
    data : out std_logic_vector(7 downto 0);
    data_valid : out std_logic;  -- one clock per byte
    silent_bit : out std_logic  -- one clock per bit while no byte is coming in
  );
end entity {{ prefix }}uart_receiver;

architecture rtl of {{ prefix }}uart_receiver is
  signal early : std_logic := '1';
  signal line_in : std_logic := '1';
  signal busy : std_logic := '0';
  signal count : natural range 0 to clocks_per_bit - 1 := clocks_per_bit - 1;  -- clocks until the next sample
  signal bits : natural range 0 to 9 := 0;  -- samples taken of start, data and stop bit
  signal shift : std_logic_vector(7 downto 0) := "00000000";
  signal valid : std_logic := '0';
  signal silent : std_logic := '0';
begin
  receive : process (clk)
  begin
    if rising_edge(clk) then
      -- Two registers against metastability.
      early <= rx;
      line_in <= early;
      valid <= '0';
      silent <= '0';
      if reset = '1' then
        busy <= '0';
        bits <= 0;
        count <= clocks_per_bit - 1;
      elsif busy = '0' then
        bits <= 0;
        if line_in = '0' then
          busy <= '1';
          count <= clocks_per_bit / 2 - 1;
        elsif count = 0 then
          silent <= '1';
          count <= clocks_per_bit - 1;
        else
          count <= count - 1;
        end if;
      elsif count /= 0 then
        count <= count - 1;
      else
        count <= clocks_per_bit - 1;
        if bits = 0 then
          -- A start bit that is over by its middle is none.
          busy <= not line_in;
          bits <= 1;
        elsif bits = 9 then
          -- Without a stop bit it was no byte.
          busy <= '0';
          valid <= line_in;
        else
          shift <= line_in & shift(7 downto 1);
          bits <= bits + 1;
        end if;
      end if;
    end if;
  end process receive;

  data <= shift;
  data_valid <= valid;
  silent_bit <= silent;
end architecture rtl;
