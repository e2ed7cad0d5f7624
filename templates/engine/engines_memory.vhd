--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- One AXI4 read port for {{ e.engines.count }} engines. Of the engines that ask, the one above the one before comes first. Bursts have one ID, so
-- their words come in the order of the addresses: a queue of {{ e.engines.bursts }} notes whose they are, and how long. An error response and a last
-- word too early are for the engine whose burst it is.
--
-- After a word that should be the last one and is not, nobody knows whose the next words are: nothing is asked then, and every burst
-- that is under way ends with an error, until none is. If the last word never comes, no engine gets a word any more, and their
-- watchdogs say so. A word that nobody has asked for is an error for all engines.
--
-- A soft reset is none here: the engines drain what they have asked for.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engines_memory is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- From the engines, the first in the low bits.
    ask_valid : in std_logic_vector(engines - 1 downto 0);
    ask_ready : out std_logic_vector(engines - 1 downto 0);
{%- for i in e.engines.each %}
    ask_address_{{ i }} : in std_logic_vector(31 downto 0);
    ask_length_{{ i }} : in std_logic_vector(7 downto 0);
{%- endfor %}
    -- To all of them.
    word_valid : out std_logic_vector(engines - 1 downto 0);
    word_data : out std_logic_vector(memory_width - 1 downto 0);
    word_response : out std_logic_vector(1 downto 0);
    word_last : out std_logic;
    m_axi_araddr : out std_logic_vector(31 downto 0);
    m_axi_arlen : out std_logic_vector(7 downto 0);
    m_axi_arsize : out std_logic_vector(2 downto 0);
    m_axi_arburst : out std_logic_vector(1 downto 0);
    m_axi_arvalid : out std_logic;
    m_axi_arready : in std_logic;
    m_axi_rdata : in std_logic_vector(memory_width - 1 downto 0);
    m_axi_rresp : in std_logic_vector(1 downto 0);
    m_axi_rlast : in std_logic;
    m_axi_rvalid : in std_logic;
    m_axi_rready : out std_logic
  );
end entity {{ prefix }}engines_memory;

architecture rtl of {{ prefix }}engines_memory is
  subtype flags is std_logic_vector(engines - 1 downto 0);
  constant nobody : flags := (others => '0');
  constant bad_response : std_logic_vector(1 downto 0) := "10";
  constant bursts : natural := {{ e.engines.bursts }};
  constant burst_bits : natural := {{ e.engines.burst_bits }};
  signal served : flags := (others => '0');  -- who is served next, if somebody is
  signal above : flags := (others => '0');  -- engines above the one before
  signal others_ask : flags;
  signal ahead : flags;
  signal asks : flags;
  signal below : std_logic_vector(engines downto 0);  -- a lower one of them asks
  signal chosen : flags;
  signal accepts : std_logic;
  signal free : std_logic;
  type request_list is array (0 to engines - 1) of std_logic_vector(35 downto 0);  -- beats less one, address
  type merged_requests is array (0 to engines) of std_logic_vector(35 downto 0);
  signal requests : request_list;
  signal merged : merged_requests;
  signal request : std_logic_vector(35 downto 0);
  signal offered : std_logic := '0';
  signal offered_address : std_logic_vector(31 downto 0) := (others => '0');
  signal offered_length : std_logic_vector(3 downto 0) := "0000";

  -- Bursts under way: the engine, one bit each, above the beats less one.
  type burst_words is array (0 to bursts - 1) of std_logic_vector(engines + 3 downto 0);
  signal burst_memory : burst_words := (others => (others => '0'));
  signal burst : std_logic_vector(engines + 3 downto 0);
  signal owner : flags;
  signal asked : unsigned(burst_bits - 1 downto 0) := (others => '0');
  signal answered : unsigned(burst_bits - 1 downto 0) := (others => '0');
  signal under_way : unsigned(burst_bits downto 0) := (others => '0');
  signal nothing_under_way : std_logic;
  signal place : unsigned(3 downto 0) := "0000";  -- of the next word in its burst
  signal due : std_logic;  -- it is the last of its burst
  signal finished : std_logic;
  signal lost : std_logic := '0';  -- whose the words are is not known
begin
  -- ===== Addresses =====
  -- Who is served next is picked a clock before.
  others_ask <= ask_valid and not served;
  ahead <= others_ask and above;
  asks <= others_ask when ahead = nobody else ahead;
  below(0) <= '0';
  choose : for i in 0 to engines - 1 generate
    chosen(i) <= asks(i) and not below(i);
    below(i + 1) <= below(i) or asks(i);
  end generate choose;
{%- for i in e.engines.each %}
  requests({{ i }}) <= ask_length_{{ i }}(3 downto 0) & ask_address_{{ i }} when served({{ i }}) = '1' else (others => '0');
{%- endfor %}
  merged(0) <= (others => '0');
  merge : for i in 0 to engines - 1 generate
    merged(i + 1) <= merged(i) or requests(i);
  end generate merge;
  request <= merged(engines);
  free <= (m_axi_arready or not offered) and not under_way(burst_bits) and not lost;
  accepts <= '0' when served = nobody else free;
  ask_ready <= served when free = '1' else nobody;

  ask : process (clk)
    variable lower : boolean;
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        offered_address <= request(31 downto 0);
        offered_length <= request(35 downto 32);
        burst_memory(to_integer(asked)) <= served & request(35 downto 32);
      end if;
      if reset = '1' then
        served <= nobody;
        above <= nobody;
        asked <= (others => '0');
        offered <= '0';
      else
        if accepts = '1' or served = nobody then
          served <= chosen;
        end if;
        if accepts = '1' then
          lower := true;
          for i in 0 to engines - 1 loop
            above(i) <= '1';
            if lower then
              above(i) <= '0';
            end if;
            if served(i) = '1' then
              lower := false;
            end if;
          end loop;
          asked <= asked + 1;
          offered <= '1';
        elsif m_axi_arready = '1' then
          offered <= '0';
        end if;
      end if;
    end if;
  end process ask;
  m_axi_araddr <= offered_address;
  m_axi_arlen <= "0000" & offered_length;
  m_axi_arsize <= "{{ e.memory.memory_size }}";
  m_axi_arburst <= "01";
  m_axi_arvalid <= offered;

  -- ===== Words =====
  burst <= burst_memory(to_integer(answered));
  owner <= burst(engines + 3 downto 4);
  nothing_under_way <= '1' when under_way = 0 else '0';
  due <= '1' when std_logic_vector(place) = burst(3 downto 0) else '0';
  finished <= m_axi_rvalid and m_axi_rlast and not nothing_under_way;
  m_axi_rready <= '1';

  answer : process (clk)
  begin
    if rising_edge(clk) then
      word_data <= m_axi_rdata;
      word_response <= m_axi_rresp;
      word_last <= m_axi_rlast;
      word_valid <= nobody;
      if reset = '1' then
        answered <= (others => '0');
        under_way <= (others => '0');
        place <= "0000";
        lost <= '0';
      else
        if m_axi_rvalid = '1' then
          place <= place + 1;
          if m_axi_rlast = '1' or nothing_under_way = '1' then
            place <= "0000";
          end if;
          word_valid <= owner;
          if nothing_under_way = '1' then
            word_valid <= not nobody;
            word_response <= bad_response;
            word_last <= '0';
          elsif lost = '1' then
            word_response <= bad_response;
            if m_axi_rlast = '0' then
              word_valid <= nobody;
            end if;
          elsif due = '1' and m_axi_rlast = '0' then
            lost <= '1';
          end if;
        end if;
        if nothing_under_way = '1' then
          lost <= '0';
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
      end if;
    end if;
  end process answer;
end architecture rtl;
