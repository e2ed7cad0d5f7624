--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The {{ core.name }} behind the USB serial port of an Arty A7-100T. The button RESET resets, LED 4 is on while the clock runs.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

entity {{ prefix }}efsat_arty_a7 is
  generic (
    clock_frequency : positive := {{ hertz }};  -- Hz, what the PLL makes
    baud_rate : positive := 1000000;
    silence_bits : positive := 16384  -- 16 ms at 1 Mbaud: longer than the gaps that the USB adapter makes
  );
  port (
    clk_100mhz : in std_logic;
    ck_rst : in std_logic;  -- active low
    uart_txd_in : in std_logic;  -- into the FPGA
    uart_rxd_out : out std_logic;  -- out of the FPGA
    led_4 : out std_logic
  );
end entity {{ prefix }}efsat_arty_a7;

architecture rtl of {{ prefix }}efsat_arty_a7 is
  signal clk : std_logic;
  signal locked : std_logic;
  signal reset : std_logic;
begin
  clock : entity work.{{ prefix }}efsat_arty_a7_clock
    port map (
      oscillator => clk_100mhz,
      clk => clk,
      locked => locked
    );

  -- efsat_uart_top takes it through two registers.
  reset <= (not ck_rst) or not locked;

  design : entity work.{{ prefix }}efsat_uart_top
    generic map (
      clock_frequency => clock_frequency,
      baud_rate => baud_rate,
      silence_bits => silence_bits
    )
    port map (
      clk => clk,
      reset => reset,
      rx => uart_txd_in,
      tx => uart_rxd_out
    );

  led_4 <= locked;
end architecture rtl;
