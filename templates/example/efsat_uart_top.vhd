--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Example: the {{ core.name }} behind a UART, a whole design with four pins. Bytes in are the words of {{ prefix }}{{ core.entity }}, low byte
-- first; a packet ends when the line has been silent for silence_bits bit times. Bytes out are the words of answers, low
{%- for line in core.packets %}
-- {{ line }}
{%- endfor %}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}efsat_uart_top is
  generic (
    clock_frequency : positive := {{ frequency }}000000;  -- Hz
    baud_rate : positive := 115200;
    silence_bits : positive := 4096  -- 36 ms at 115200 baud: longer than the gaps that serial adapters make
  );
  port (
    clk : in std_logic;
    reset : in std_logic;  -- a pin, active high, asynchronous to the clock
    rx : in std_logic;
    tx : out std_logic
  );
end entity {{ prefix }}efsat_uart_top;

architecture rtl of {{ prefix }}efsat_uart_top is
  constant clocks_per_bit : positive := clock_frequency / baud_rate;
  constant word_bytes : positive := {{ word_bytes }};
  constant answer_bytes : positive := {{ answer_bytes }};

  signal reset_early : std_logic := '1';
  signal reset_in : std_logic := '1';
  signal aresetn : std_logic;
  signal byte_in : std_logic_vector(7 downto 0);
  signal byte_in_valid : std_logic;
  signal silent_bit : std_logic;
  signal silence : natural range 0 to silence_bits := 0;  -- bit times

  signal collected : std_logic_vector({{ word }}) := (others => '0');  -- the bytes of the next word
  signal collected_bytes : natural range 0 to word_bytes - 1 := 0;
  signal held : std_logic_vector({{ word }}) := (others => '0');  -- a whole word, perhaps the last
  signal held_valid : std_logic := '0';
  signal s_tdata : std_logic_vector({{ word }}) := (others => '0');
  signal s_tkeep : std_logic_vector(word_bytes - 1 downto 0) := (others => '1');
  signal s_tvalid : std_logic := '0';
  signal s_tlast : std_logic := '0';
  signal s_tready : std_logic;

  signal m_tdata : std_logic_vector({{ answer }});
  signal m_tkeep : std_logic_vector(answer_bytes - 1 downto 0);
  signal m_tvalid : std_logic;
  signal m_tlast : std_logic;
  signal m_tready : std_logic;
  signal leaving : std_logic_vector({{ answer }}) := (others => '0');  -- the next byte in the low bits
  signal leaving_bytes : natural range 0 to answer_bytes := 0;
  signal byte_out_valid : std_logic;
  signal byte_out_ready : std_logic;
  signal line_out : std_logic;
begin
  -- Two registers against metastability.
  synchronise : process (clk)
  begin
    if rising_edge(clk) then
      reset_early <= reset;
      reset_in <= reset_early;
    end if;
  end process synchronise;

  aresetn <= not reset_in;

  receiver : entity work.{{ prefix }}uart_receiver
    generic map (
      clocks_per_bit => clocks_per_bit
    )
    port map (
      clk => clk,
      reset => reset_in,
      rx => rx,
      data => byte_in,
      data_valid => byte_in_valid,
      silent_bit => silent_bit
    );

  -- A word is held back until it is known whether it is the last of its packet.
  collect : process (clk)
  begin
    if rising_edge(clk) then
      if byte_in_valid = '1' then
        collected <= byte_in & collected({{ word.high }} downto 8);
      end if;
      if reset_in = '1' then
        silence <= 0;
        collected_bytes <= 0;
        held_valid <= '0';
        s_tvalid <= '0';
      else
        if s_tready = '1' then
          s_tvalid <= '0';
        end if;
        if byte_in_valid = '1' then
          silence <= 0;
          if held_valid = '1' then
            s_tdata <= held;
            s_tvalid <= '1';
            s_tlast <= '0';
            s_tkeep <= (others => '1');
            held_valid <= '0';
          end if;
          if collected_bytes = word_bytes - 1 then
            collected_bytes <= 0;
            held <= byte_in & collected({{ word.high }} downto 8);
            held_valid <= '1';
          else
            collected_bytes <= collected_bytes + 1;
          end if;
        elsif silence /= silence_bits then
          if silent_bit = '1' then
            silence <= silence + 1;
          end if;
        elsif s_tvalid = '0' then
          s_tdata <= held;
          s_tlast <= '1';
          s_tkeep <= (others => '1');
          if collected_bytes /= 0 then
            -- Some bytes of a word: the packet is malformed, whatever they are.
            s_tkeep(word_bytes - 1) <= '0';
          end if;
          if collected_bytes /= 0 or held_valid = '1' then
            s_tvalid <= '1';
          end if;
          collected_bytes <= 0;
          held_valid <= '0';
        end if;
      end if;
    end if;
  end process collect;

  {{ core.label }} : entity work.{{ prefix }}{{ core.entity }}
    port map (
      aclk => clk,
      aresetn => aresetn,
      s_axis_tdata => s_tdata,
      s_axis_tkeep => s_tkeep,
      s_axis_tvalid => s_tvalid,
      s_axis_tlast => s_tlast,
      s_axis_tready => s_tready,
      m_axis_tdata => m_tdata,
      m_axis_tkeep => m_tkeep,
      m_axis_tvalid => m_tvalid,
      m_axis_tlast => m_tlast,
      m_axis_tready => m_tready
    );

  m_tready <= '1' when leaving_bytes = 0 else '0';
  byte_out_valid <= not m_tready;

  give : process (clk)
  begin
    if rising_edge(clk) then
      if (m_tvalid and m_tready) = '1' then
        leaving <= m_tdata;
      elsif (byte_out_valid and byte_out_ready) = '1' then
        leaving <= "00000000" & leaving({{ answer.high }} downto 8);
      end if;
      if reset_in = '1' then
        leaving_bytes <= 0;
      elsif (m_tvalid and m_tready) = '1' then
        leaving_bytes <= answer_bytes;
      elsif (byte_out_valid and byte_out_ready) = '1' then
        leaving_bytes <= leaving_bytes - 1;
      end if;
    end if;
  end process give;

  transmitter : entity work.{{ prefix }}uart_transmitter
    generic map (
      clocks_per_bit => clocks_per_bit
    )
    port map (
      clk => clk,
      reset => reset_in,
      data => leaving(7 downto 0),
      data_valid => byte_out_valid,
      data_ready => byte_out_ready,
      tx => line_out
    );

  tx <= line_out;
end architecture rtl;
