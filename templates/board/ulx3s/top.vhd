--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The {{ core.name }} behind the USB serial port of a ULX3S with an ECP5-85F. Button FIRE 1 resets, LED 0 is on while the clock runs.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;

entity {{ prefix }}efsat_ulx3s is
  generic (
    clock_frequency : positive := {{ hertz }};  -- Hz, what the PLL makes
    baud_rate : positive := 1000000;
    silence_bits : positive := 16384  -- 16 ms at 1 Mbaud: longer than the gaps that the USB adapter makes
  );
  port (
    clk_25mhz : in std_logic;
    btn_fire1 : in std_logic;  -- active high
    ftdi_txd : in std_logic;  -- into the FPGA
    ftdi_rxd : out std_logic;  -- out of the FPGA
    led_0 : out std_logic;
    wifi_gpio0 : out std_logic
  );
end entity {{ prefix }}efsat_ulx3s;

architecture rtl of {{ prefix }}efsat_ulx3s is
  signal clk : std_logic;
  signal locked : std_logic;
  signal reset : std_logic;
begin
  clock : entity work.{{ prefix }}efsat_ulx3s_clock
    port map (
      oscillator => clk_25mhz,
      clk => clk,
      locked => locked
    );

  -- efsat_uart_top takes it through two registers.
  reset <= btn_fire1 or not locked;

  design : entity work.{{ prefix }}efsat_uart_top
    generic map (
      clock_frequency => clock_frequency,
      baud_rate => baud_rate,
      silence_bits => silence_bits
    )
    port map (
      clk => clk,
      reset => reset,
      rx => ftdi_txd,
      tx => ftdi_rxd
    );

  led_0 <= locked;
  -- While it is low, the WiFi module takes the board over.
  wifi_gpio0 <= '1';
end architecture rtl;
