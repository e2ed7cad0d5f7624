--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- AXI4 reads for four caches in turn: blocks of A, blocks of B ({{ e.memory.block_words }} words each), triangles of A, triangles of B
-- ({{ e.memory.triangle_words }} words). A burst begins at a multiple of 64 bytes and ends within 64 bytes, so it never crosses 4 KB. There
-- is one ID: answers come in order, and a queue notes for whom. The caches ask only for what they have places for, so
-- RREADY is always set. An error in the response, and a last word too early or too late, end the work: nothing is asked any
-- more until restart.
--
-- Restart forgets who asked, but not what was asked: the address that is offered stays until it is taken, and the count of
-- bursts under way goes on. Words of old bursts are dropped until none of them is under way; nothing is asked before, because
-- with one ID the words of an old burst look like those of a new one. Reset alone forgets everything, and is right only where
-- memory is reset with it.
{%- if e.memory.watchdog > 0 %}
-- If no word comes for {{ e.memory.watchdog }} clocks while a burst is under way, memory is silent, until it gives a word again.
{%- endif %}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_read_master is
  port (
    clk : in std_logic;
    reset : in std_logic;
    restart : in std_logic;  -- who asks forgets everything; bursts under way are drained
    ask_valid : in std_logic_vector(3 downto 0);
    ask_ready : out std_logic_vector(3 downto 0);
    ask_address_0 : in std_logic_vector(25 downto 0);
    ask_address_1 : in std_logic_vector(25 downto 0);
    ask_address_2 : in std_logic_vector(25 downto 0);
    ask_address_3 : in std_logic_vector(25 downto 0);
    fill_valid : out std_logic_vector(3 downto 0);
    fill_data : out std_logic_vector(memory_width - 1 downto 0);
    failed : out std_logic;  -- until restart
    draining : out std_logic;  -- bursts from before restart are under way: nothing is asked
    silent : out std_logic;  -- memory does not answer
    word_read : out std_logic;
{% include "engine/burst_ports.vhd" %}
  );
end entity {{ prefix }}engine_read_master;

architecture rtl of {{ prefix }}engine_read_master is
  constant nobody : std_logic_vector(3 downto 0) := "0000";
  constant block_words : natural := {{ e.memory.block_words }};
  constant triangle_words : natural := {{ e.memory.triangle_words }};
  constant last_of_block : unsigned(3 downto 0) := to_unsigned(block_words - 1, 4);
  constant last_of_triangle : unsigned(3 downto 0) := to_unsigned(triangle_words - 1, 4);
  signal picked : std_logic := '0';  -- somebody is to be served
  signal turn : unsigned(1 downto 0) := "00";  -- who is served next, or was last
  signal served : std_logic_vector(3 downto 0);
  signal others_ask : std_logic_vector(3 downto 0);
  signal ahead : std_logic_vector(3 downto 0);  -- those of them that come after
  signal asks : std_logic_vector(3 downto 0);
  signal chosen : unsigned(1 downto 0);
  signal free : std_logic;
  signal accepts : std_logic;
  signal address : std_logic_vector(25 downto 0);
  signal offered : std_logic := '0';
  signal offered_address : std_logic_vector(25 downto 0) := (others => '0');
  signal offered_triangle : std_logic := '0';

  type owners is array (0 to 31) of std_logic_vector(1 downto 0);
  signal owner_memory : owners := (others => "00");
  signal owner : std_logic_vector(1 downto 0);
  signal asked : unsigned(4 downto 0) := "00000";
  signal answered : unsigned(4 downto 0) := "00000";
  signal under_way : unsigned(5 downto 0) := "000000";
  signal nothing_under_way : std_logic;
  signal place : unsigned(3 downto 0) := "0000";  -- of the next word in its burst
  signal due : std_logic;  -- it is the last of its burst
  signal finished : std_logic;
  signal fault : std_logic;
  signal failed_now : std_logic := '0';
  signal draining_now : std_logic := '0';
{%- if e.memory.watchdog > 0 %}
  constant watchdog : natural := {{ e.memory.watchdog }};
  constant silence_bits : natural := {{ e.memory.watchdog_bits }};
  signal silence : unsigned(silence_bits - 1 downto 0) := (others => '0');  -- clocks without a word
  signal silent_now : std_logic := '0';
{%- endif %}
begin
  -- ===== Addresses =====
  -- Who is served next is picked a clock before. Whoever is above the one before comes first.
  served <= nobody when picked = '0' else
    "0001" when turn = 0 else
    "0010" when turn = 1 else
    "0100" when turn = 2 else
    "1000";
  others_ask <= ask_valid and not served;
  ahead <= others_ask and "1110" when turn = 0 else
    others_ask and "1100" when turn = 1 else
    others_ask and "1000" when turn = 2 else
    nobody;
  asks <= ahead when ahead /= nobody else others_ask;
  chosen <= "00" when asks(0) = '1' else
    "01" when asks(1) = '1' else
    "10" when asks(2) = '1' else
    "11";
  address <= ask_address_0 when turn = 0 else
    ask_address_1 when turn = 1 else
    ask_address_2 when turn = 2 else
    ask_address_3;
  free <= (m_axi_arready or not offered) and not under_way(5) and not failed_now and not draining_now;
  accepts <= picked and free;
  ready : for i in 0 to 3 generate
    ask_ready(i) <= served(i) and free;
  end generate ready;

  ask : process (clk)
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        offered_address <= address;
        offered_triangle <= turn(1);
        owner_memory(to_integer(asked)) <= std_logic_vector(turn);
      end if;
      if reset = '1' then
        turn <= "00";
        picked <= '0';
        asked <= "00000";
        offered <= '0';
      else
        if accepts = '1' or picked = '0' then
          picked <= '0';
          if others_ask /= nobody then
            picked <= '1';
            turn <= chosen;
          end if;
        end if;
        if accepts = '1' then
          asked <= asked + 1;
          offered <= '1';
        elsif m_axi_arready = '1' then
          offered <= '0';
        end if;
        if restart = '1' then
          picked <= '0';
        end if;
      end if;
    end if;
  end process ask;
  m_axi_araddr <= offered_address & "000000";
  m_axi_arlen <= "0000" & std_logic_vector(last_of_triangle) when offered_triangle = '1' else "0000" & std_logic_vector(last_of_block);
  m_axi_arsize <= "{{ e.memory.memory_size }}";
  m_axi_arburst <= "01";
  m_axi_arvalid <= offered;

  -- ===== Words =====
  owner <= owner_memory(to_integer(answered));
  nothing_under_way <= '1' when under_way = 0 else '0';
  due <= '1' when (owner(1) = '1' and place = last_of_triangle) or (owner(1) = '0' and place = last_of_block) else '0';
  finished <= m_axi_rvalid and m_axi_rlast and not nothing_under_way;
  -- Bit 1 of a response is set for both errors; bit 0 tells which, or which of the two kinds of success.
  fault <= m_axi_rvalid and (m_axi_rresp(1) or (m_axi_rlast xor due) or nothing_under_way);
  m_axi_rready <= '1';
  failed <= failed_now;
  draining <= draining_now;
  silent <= {% if e.memory.watchdog > 0 %}silent_now{% else %}'0'{% endif %};

  answer : process (clk)
  begin
    if rising_edge(clk) then
      fill_data <= m_axi_rdata;
      fill_valid <= nobody;
      word_read <= m_axi_rvalid and not draining_now and not reset;
      if reset = '1' then
        answered <= "00000";
        under_way <= "000000";
        place <= "0000";
        failed_now <= '0';
        draining_now <= '0';
      else
        if m_axi_rvalid = '1' then
          place <= place + 1;
          if m_axi_rlast = '1' or nothing_under_way = '1' then
            place <= "0000";
          end if;
          if fault = '1' then
            failed_now <= '1';
          elsif failed_now = '0' and draining_now = '0' then
            fill_valid(to_integer(unsigned(owner))) <= '1';
          end if;
        end if;
        if finished = '1' then
          answered <= answered + 1;
        end if;
        -- Under way is what is offered, too.
        if accepts = '1' and finished = '0' then
          under_way <= under_way + 1;
        elsif accepts = '0' and finished = '1' then
          under_way <= under_way - 1;
        end if;
        if restart = '1' then
          fill_valid <= nobody;
          draining_now <= '1';
        elsif nothing_under_way = '1' then
          draining_now <= '0';
        end if;
        -- What old bursts bring is nobody's fault.
        if restart = '1' or draining_now = '1' then
          failed_now <= '0';
        end if;
      end if;
    end if;
  end process answer;
{%- if e.memory.watchdog > 0 %}

  watch : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' or m_axi_rvalid = '1' or nothing_under_way = '1' then
        silence <= (others => '0');
        silent_now <= '0';
      elsif silence = watchdog - 1 then
        silent_now <= '1';
      else
        silence <= silence + 1;
      end if;
    end if;
  end process watch;
{%- endif %}
end architecture rtl;
