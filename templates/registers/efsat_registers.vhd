--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Registers behind AXI4-Lite, between a processor and {{ prefix }}{{ core }}: {{ prefix }}efsat_register_map says where each is. Words to the core and
-- its answers wait in queues of {{ places }} words. A soft reset empties both{% if is_engine %}, and ends a packet of which the core has a part{% endif %}.
--
-- An access that is refused is answered by SLVERR and has no effect but to be counted. Address and data of a write may come in any
-- order. What is offered, responses and words, stays until it is taken; a soft reset withdraws the word that is offered to the core.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}efsat_register_map.all;

entity {{ prefix }}efsat_registers is
  port (
    aclk : in std_logic;
    aresetn : in std_logic;  -- synchronous, active low
{% include "registers/lite_ports.vhd" %}
    irq : out std_logic;  -- an interrupt is pending that the mask lets through
    clear_core : out std_logic;  -- a soft reset, one clock long
    m_axis_tdata : out std_logic_vector(63 downto 0);  -- to the core
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;
    m_axis_tready : in std_logic;
    s_axis_tdata : in std_logic_vector({{ answer }});  -- its answers
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;
    s_axis_tready : out std_logic
  );
end entity {{ prefix }}efsat_registers;

architecture rtl of {{ prefix }}efsat_registers is
  constant all_bytes : std_logic_vector(3 downto 0) := "1111";
  constant places : natural := {{ places }};
  constant place_bits : natural := {{ place_bits }};
  subtype level is unsigned(place_bits downto 0);

  -- Writes: what has come of one, and whether it is refused.
  signal running : std_logic := '0';  -- clear in reset
  signal write_address_there : std_logic := '0';
  signal write_address : register_address := (others => '0');
  signal write_word_there : std_logic := '0';
  signal write_word : register_word := (others => '0');
  signal write_whole : std_logic := '0';
  signal write_known : std_logic;
  signal write_legal : std_logic;
  signal write_refusal : refusal_word;
  signal writes : std_logic;  -- a write is done, or refused
  signal write_done : std_logic;
  signal write_answered : std_logic := '0';
  signal write_response : std_logic_vector(1 downto 0) := response_okay;
  signal write_address_free : std_logic;
  signal write_word_free : std_logic;

  -- Reads
  signal read_address_there : std_logic := '0';
  signal read_address : register_address := (others => '0');
  signal read_known : std_logic;
  signal read_legal : std_logic;
  signal read_refusal : refusal_word;
  signal reads : std_logic;
  signal read_done : std_logic;
  signal read_answered : std_logic := '0';
  signal read_response : std_logic_vector(1 downto 0) := response_okay;
  signal read_word : register_word := (others => '0');
  signal read_address_free : std_logic;

  -- Control
  signal enable : std_logic := '0';
  signal soft_reset : std_logic := '0';
  signal refused_count : unsigned(15 downto 0) := (others => '0');
  signal refused_next : unsigned(15 downto 0);
  signal refused_address : register_address := (others => '0');
  signal refused_why : refusal_word := refused_not;

  -- The transmit queue, behind it the word that is offered to the core. Bit 64 says that a word is the last of its packet.
  type transmit_words is array (0 to places - 1) of std_logic_vector(64 downto 0);
  signal transmit_memory : transmit_words := (others => (others => '0'));
  signal transmit_low : register_word := (others => '0');
  signal transmit_written : level := (others => '0');
  signal transmit_read : level := (others => '0');
  signal transmit_level : level;
  signal transmit_full : std_logic;
  signal transmit_there : std_logic;
  signal transmit_ends : std_logic;  -- the word written is the last of its packet
  signal transmit_push : std_logic;
  signal transmit_pop : std_logic;
  signal transmit_begins : std_logic := '1';  -- the next word written is the first of its packet
  signal offered : std_logic := '0';
  signal offered_word : std_logic_vector(64 downto 0) := (others => '0');
  signal offer_free : std_logic;
  signal handed : std_logic;
  signal open_packet : std_logic := '0';
  signal stays_open : std_logic;
{%- if is_engine %}
  signal closing : std_logic := '0';  -- a last word is due to the packet of which the core drops the rest
{%- endif %}

  -- The receive queue. Bit {{ last_place }} says that a word is the last of its packet.
  type receive_words is array (0 to places - 1) of std_logic_vector({{ last_place }} downto 0);
  signal receive_memory : receive_words := (others => (others => '0'));
  signal receive_written : level := (others => '0');
  signal receive_read : level := (others => '0');
  signal receive_level : level;
  signal receive_full : std_logic;
  signal receive_there : std_logic;
  signal receive_push : std_logic;
  signal receive_pop : std_logic;
  signal oldest : std_logic_vector({{ last_place }} downto 0);
  signal oldest_low : register_word;
  signal oldest_high : register_word;

  -- Answers: reports and what is counted
{%- if is_engine %}
  type word_line is array (natural range <>) of register_word;
  constant report_words : natural := {{ report_words }};
  signal lows : word_line(1 to report_words - 1) := (others => (others => '0'));  -- halves of words before, the latest first
{%- if has_caches %}
  signal highs : word_line(1 to 3) := (others => (others => '0'));
{%- endif %}
  signal packet_words : unsigned(31 downto 0) := (others => '0');  -- words of the packet so far
  signal is_long : std_logic;
  signal ended_pairs : unsigned(31 downto 0) := (others => '0');
{%- if has_caches %}
  signal ended_misses : unsigned(31 downto 0) := (others => '0');
  signal cache_misses : unsigned(31 downto 0) := (others => '0');
{%- endif %}
  signal query_count : unsigned(31 downto 0) := (others => '0');
{%- endif %}
  signal is_report : std_logic;
  signal last_report : register_word := (others => '0');
  signal pair_count : unsigned(31 downto 0) := (others => '0');
  signal packets_in : unsigned(31 downto 0) := (others => '0');
  signal packets_out : unsigned(31 downto 0) := (others => '0');

  -- Clocks: the upper half follows the lower one a clock later, so a copy of the lower one is shown.
  signal clocks : unsigned(31 downto 0) := (others => '0');
  signal clocks_wrap : std_logic := '0';
  signal clocks_low : unsigned(31 downto 0) := (others => '0');
  signal clocks_high : unsigned(31 downto 0) := (others => '0');
  signal clocks_kept : unsigned(31 downto 0) := (others => '0');

  -- Interrupts
  subtype interrupts is std_logic_vector(pending_refused downto pending_answer);
  constant no_interrupts : interrupts := (others => '0');
  signal answer_event : std_logic := '0';
  signal fault_event : std_logic := '0';
  signal refused_event : std_logic := '0';
  signal events : interrupts;
  signal cleared : interrupts;
  signal pending : interrupts := (others => '0');
  signal pending_next : interrupts;
  signal mask : interrupts := (others => '0');
  signal transmit_threshold : level := (others => '0');
  signal receive_threshold : level := to_unsigned(1, place_bits + 1);
  signal interrupting : std_logic := '0';
begin
  -- ===== Writes =====
  write_address_free <= running and not write_address_there;
  write_word_free <= running and not write_word_there;
  s_axi_awready <= write_address_free;
  s_axi_wready <= write_word_free;
  s_axi_bvalid <= write_answered;
  s_axi_bresp <= write_response;
  write_known <= '1' when
{%- for register in registers %}
    write_address = {{ register.name }}_at{% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
  write_legal <= '1' when
{%- for name in written %}
    write_address = {{ name }}_at{% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
  transmit_ends <= '1' when write_address = transmit_last_at else '0';
  write_refusal <= refused_unaligned when write_address(1 downto 0) /= "00" else
    refused_unknown when write_known = '0' else
    refused_partial when write_whole = '0' else
    refused_direction when write_legal = '0' else
    refused_full when (write_address = transmit_high_at or write_address = transmit_last_at) and transmit_full = '1' else
    refused_not;
  writes <= write_address_there and write_word_there and not write_answered;
  write_done <= writes when write_refusal = refused_not else '0';

  write : process (aclk)
  begin
    if rising_edge(aclk) then
      if write_address_free = '1' then
        write_address <= s_axi_awaddr;
      end if;
      if write_word_free = '1' then
        write_word <= s_axi_wdata;
        write_whole <= '0';
        if s_axi_wstrb = all_bytes then
          write_whole <= '1';
        end if;
      end if;
      if writes = '1' then
        write_response <= response_okay;
        if write_refusal /= refused_not then
          write_response <= response_error;
        end if;
      end if;
      soft_reset <= '0';
      if aresetn = '0' then
        running <= '0';
        write_address_there <= '0';
        write_word_there <= '0';
        write_answered <= '0';
        enable <= '0';
        mask <= (others => '0');
        transmit_threshold <= (others => '0');
        receive_threshold <= to_unsigned(1, place_bits + 1);
      else
        running <= '1';
        if (write_address_free and s_axi_awvalid) = '1' then
          write_address_there <= '1';
        end if;
        if (write_word_free and s_axi_wvalid) = '1' then
          write_word_there <= '1';
        end if;
        if s_axi_bready = '1' then
          write_answered <= '0';
        end if;
        if writes = '1' then
          write_answered <= '1';
          write_address_there <= '0';
          write_word_there <= '0';
        end if;
        if write_done = '1' then
          if write_address = control_at then
            enable <= write_word(control_enable);
            soft_reset <= write_word(control_soft_reset);
          end if;
          if write_address = transmit_low_at then
            transmit_low <= write_word;
          end if;
          if write_address = mask_at then
            mask <= write_word(mask_refused downto mask_answer);
          end if;
          if write_address = thresholds_at then
            transmit_threshold <= unsigned(write_word(thresholds_transmit_high downto thresholds_transmit_low));
            receive_threshold <= unsigned(write_word(thresholds_receive_high downto thresholds_receive_low));
          end if;
        end if;
      end if;
    end if;
  end process write;
  clear_core <= soft_reset;

  -- ===== Reads =====
  read_address_free <= running and not read_address_there;
  s_axi_arready <= read_address_free;
  s_axi_rvalid <= read_answered;
  s_axi_rresp <= read_response;
  s_axi_rdata <= read_word;
  read_known <= '1' when
{%- for register in registers %}
    read_address = {{ register.name }}_at{% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
  read_legal <= '1' when
{%- for name in read %}
    read_address = {{ name }}_at{% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
  read_refusal <= refused_unaligned when read_address(1 downto 0) /= "00" else
    refused_unknown when read_known = '0' else
    refused_direction when read_legal = '0' else
    refused_empty when (read_address = receive_low_at or read_address = receive_high_at) and receive_there = '0' else
    refused_not;
  reads <= read_address_there and not read_answered;
  read_done <= reads when read_refusal = refused_not else '0';

  read : process (aclk)
  begin
    if rising_edge(aclk) then
      if read_address_free = '1' then
        read_address <= s_axi_araddr;
      end if;
      if reads = '1' then
        read_response <= response_okay;
        read_word <= (others => '0');
        if read_refusal /= refused_not then
          read_response <= response_error;
{%- for name in constants %}
        elsif read_address = {{ name }}_at then
          read_word <= {{ name }}_reset;
{%- endfor %}
        elsif read_address = control_at then
          read_word(control_enable) <= enable;
        elsif read_address = status_at then
          read_word(status_transmit_level_high downto status_transmit_level_low) <= std_logic_vector(transmit_level);
          read_word(status_receive_level_high downto status_receive_level_low) <= std_logic_vector(receive_level);
          read_word(status_receive_last) <= receive_there and oldest({{ last_place }});
          read_word(status_open) <= open_packet;
        elsif read_address = last_report_at then
          read_word <= last_report;
        elsif read_address = refusal_at then
          read_word(refusal_count_high downto refusal_count_low) <= std_logic_vector(refused_count);
          read_word(refusal_address_high downto refusal_address_low) <= refused_address;
          read_word(refusal_why_high downto refusal_why_low) <= refused_why;
        elsif read_address = receive_low_at then
          read_word <= oldest_low;
        elsif read_address = receive_high_at then
          read_word <= oldest_high;
        elsif read_address = pending_at then
          read_word(pending_refused downto pending_answer) <= pending;
        elsif read_address = mask_at then
          read_word(mask_refused downto mask_answer) <= mask;
        elsif read_address = thresholds_at then
          read_word(thresholds_transmit_high downto thresholds_transmit_low) <= std_logic_vector(transmit_threshold);
          read_word(thresholds_receive_high downto thresholds_receive_low) <= std_logic_vector(receive_threshold);
        elsif read_address = packets_in_at then
          read_word <= std_logic_vector(packets_in);
        elsif read_address = packets_out_at then
          read_word <= std_logic_vector(packets_out);
        elsif read_address = pairs_at then
          read_word <= std_logic_vector(pair_count);
{%- if is_engine %}
        elsif read_address = queries_at then
          read_word <= std_logic_vector(query_count);
{%- endif %}
{%- if has_caches %}
        elsif read_address = cache_misses_at then
          read_word <= std_logic_vector(cache_misses);
{%- endif %}
        elsif read_address = clocks_low_at then
          read_word <= std_logic_vector(clocks_low);
          clocks_kept <= clocks_high;
        elsif read_address = clocks_high_at then
          read_word <= std_logic_vector(clocks_kept);
        end if;
      end if;
      if aresetn = '0' then
        read_address_there <= '0';
        read_answered <= '0';
        clocks_kept <= (others => '0');
      else
        if (read_address_free and s_axi_arvalid) = '1' then
          read_address_there <= '1';
        end if;
        if s_axi_rready = '1' then
          read_answered <= '0';
        end if;
        if reads = '1' then
          read_answered <= '1';
          read_address_there <= '0';
        end if;
      end if;
    end if;
  end process read;

  -- ===== Refused accesses =====
  refused_next <= refused_count + 1;

  refuse : process (aclk)
    variable count : unsigned(15 downto 0);
  begin
    if rising_edge(aclk) then
      refused_event <= '0';
      count := refused_count;
      if reads = '1' and read_refusal /= refused_not then
        refused_event <= '1';
        refused_address <= read_address;
        refused_why <= read_refusal;
        if count /= x"ffff" then
          count := refused_next;
        end if;
      end if;
      if writes = '1' and write_refusal /= refused_not then
        refused_event <= '1';
        refused_address <= write_address;
        refused_why <= write_refusal;
        if count /= x"ffff" then
          count := count + 1;
        end if;
      end if;
      refused_count <= count;
      if aresetn = '0' then
        refused_event <= '0';
        refused_count <= (others => '0');
        refused_address <= (others => '0');
        refused_why <= refused_not;
      end if;
    end if;
  end process refuse;

  -- ===== Words to the core =====
  transmit_level <= transmit_written - transmit_read;
  transmit_full <= transmit_level(place_bits);
  transmit_there <= '1' when transmit_level /= 0 else '0';
  transmit_push <= write_done when write_address = transmit_high_at or write_address = transmit_last_at else '0';
  offer_free <= m_axis_tready or not offered;
{%- if is_engine %}
  transmit_pop <= offer_free and transmit_there and enable and not closing;
{%- else %}
  transmit_pop <= offer_free and transmit_there and enable;
{%- endif %}
  handed <= offered and m_axis_tready;
  stays_open <= not offered_word(64) when handed = '1' else open_packet;
  m_axis_tvalid <= offered;
  m_axis_tdata <= offered_word(63 downto 0);
  m_axis_tlast <= offered_word(64);

  transmit : process (aclk)
  begin
    if rising_edge(aclk) then
      if transmit_push = '1' then
        transmit_memory(to_integer(transmit_written(place_bits - 1 downto 0))) <= transmit_ends & write_word & transmit_low;
      end if;
      if offer_free = '1' then
        offered_word <= transmit_memory(to_integer(transmit_read(place_bits - 1 downto 0)));
{%- if is_engine %}
        if closing = '1' then
          offered_word(64) <= '1';
        end if;
{%- endif %}
      end if;
      if aresetn = '0' then
        transmit_written <= (others => '0');
        transmit_read <= (others => '0');
        transmit_begins <= '1';
        offered <= '0';
        open_packet <= '0';
{%- if is_engine %}
        closing <= '0';
        query_count <= (others => '0');
{%- endif %}
        packets_in <= (others => '0');
      else
        if transmit_push = '1' then
          transmit_written <= transmit_written + 1;
          transmit_begins <= transmit_ends;
{%- if is_engine %}
          if transmit_begins = '1' and transmit_low(7 downto 0) = x"{{ query_kind }}" then
            query_count <= query_count + 1;
          end if;
{%- endif %}
          if transmit_ends = '1' then
            packets_in <= packets_in + 1;
          end if;
        end if;
        if transmit_pop = '1' then
          transmit_read <= transmit_read + 1;
        end if;
        if offer_free = '1' then
{%- if is_engine %}
          offered <= transmit_pop or closing;
          closing <= '0';
{%- else %}
          offered <= transmit_pop;
{%- endif %}
        end if;
        open_packet <= stays_open;
        if soft_reset = '1' then
          transmit_written <= (others => '0');
          transmit_read <= (others => '0');
          transmit_begins <= '1';
          offered <= '0';
{%- if is_engine %}
          -- The core drops what comes of this packet, up to its last word.
          closing <= stays_open;
{%- else %}
          open_packet <= '0';
{%- endif %}
        end if;
      end if;
    end if;
  end process transmit;

  -- ===== Answers =====
  receive_level <= receive_written - receive_read;
  receive_full <= receive_level(place_bits);
  receive_there <= '1' when receive_level /= 0 else '0';
  s_axis_tready <= running and not receive_full;
  receive_push <= s_axis_tvalid and running and not receive_full and not soft_reset;
  receive_pop <= read_done when read_address = receive_high_at else '0';
  oldest <= receive_memory(to_integer(receive_read(place_bits - 1 downto 0)));
  oldest_low <= oldest(31 downto 0);
  oldest_high <= {% if has_high %}oldest(63 downto 32){% else %}(others => '0'){% endif %};

  receive : process (aclk)
  begin
    if rising_edge(aclk) then
      if receive_push = '1' then
        receive_memory(to_integer(receive_written(place_bits - 1 downto 0))) <= s_axis_tlast & s_axis_tdata;
      end if;
      if (soft_reset or not aresetn) = '1' then
        receive_written <= (others => '0');
        receive_read <= (others => '0');
      else
        if receive_push = '1' then
          receive_written <= receive_written + 1;
        end if;
        if receive_pop = '1' then
          receive_read <= receive_read + 1;
        end if;
      end if;
    end if;
  end process receive;
{%- if is_engine %}

  -- A report of the engine is the last eight words of its packet: their first has 11 in its low bits, which no pair has. A report
  -- of the unit is the last word alone.
  is_long <= '1' when packet_words >= report_words - 1 and lows(report_words - 1)(1 downto 0) = "11" else '0';
  is_report <= '1' when is_long = '1' or s_axis_tdata(1 downto 0) = "11" else '0';

  look : process (aclk)
  begin
    if rising_edge(aclk) then
      answer_event <= receive_push and s_axis_tlast;
      fault_event <= '0';
      ended_pairs <= (others => '0');
{%- if has_caches %}
      ended_misses <= (others => '0');
{%- endif %}
      if receive_push = '1' then
        lows <= s_axis_tdata(31 downto 0) & lows(1 to report_words - 2);
{%- if has_caches %}
        highs <= s_axis_tdata(63 downto 32) & highs(1 to 2);
{%- endif %}
        packet_words <= packet_words + 1;
        if s_axis_tlast = '1' then
          packet_words <= (others => '0');
          packets_out <= packets_out + 1;
          ended_pairs <= packet_words + 1;
          if is_long = '1' then
            last_report <= lows(report_words - 1);
            last_report(last_report_kind_high downto last_report_kind_low) <= "10";
            fault_event <= lows(report_words - 1)(last_report_fault);
            ended_pairs <= packet_words - (report_words - 1);
{%- if has_caches %}
            -- The counts of a soft reset mean nothing.
            if lows(report_words - 1)(last_report_reason_high downto last_report_reason_low) /= "{{ reset_reason }}" then
              ended_misses <= unsigned(highs(3)) + unsigned(highs(2));
            end if;
{%- endif %}
          elsif is_report = '1' then
            last_report <= (others => '0');
            last_report(7 downto 2) <= s_axis_tdata(7 downto 2);
            last_report(last_report_kind_high downto last_report_kind_low) <= "01";
            fault_event <= s_axis_tdata(last_report_fault);
            ended_pairs <= packet_words;
          end if;
        end if;
      end if;
      pair_count <= pair_count + ended_pairs;
{%- if has_caches %}
      cache_misses <= cache_misses + ended_misses;
{%- endif %}
      if aresetn = '0' then
        answer_event <= '0';
        fault_event <= '0';
        packet_words <= (others => '0');
        ended_pairs <= (others => '0');
        last_report <= (others => '0');
        pair_count <= (others => '0');
        packets_out <= (others => '0');
{%- if has_caches %}
        ended_misses <= (others => '0');
        cache_misses <= (others => '0');
{%- endif %}
      end if;
    end if;
  end process look;
{%- else %}

  -- A report has 11 in the low bits, which no verdict has.
  is_report <= '1' when s_axis_tdata(1 downto 0) = "11" else '0';

  look : process (aclk)
  begin
    if rising_edge(aclk) then
      answer_event <= receive_push and s_axis_tlast;
      fault_event <= '0';
      if receive_push = '1' then
        if s_axis_tlast = '1' then
          packets_out <= packets_out + 1;
        end if;
        if is_report = '1' then
          last_report <= (others => '0');
          last_report(7 downto 2) <= s_axis_tdata(7 downto 2);
          last_report(last_report_kind_high downto last_report_kind_low) <= "01";
          fault_event <= s_axis_tdata(last_report_fault);
        else
          pair_count <= pair_count + 1;
        end if;
      end if;
      if aresetn = '0' then
        answer_event <= '0';
        fault_event <= '0';
        last_report <= (others => '0');
        pair_count <= (others => '0');
        packets_out <= (others => '0');
      end if;
    end if;
  end process look;
{%- endif %}

  -- ===== Clocks =====
  clock_count : process (aclk)
  begin
    if rising_edge(aclk) then
      clocks <= clocks + 1;
      clocks_low <= clocks;
      clocks_wrap <= '0';
      if clocks = x"ffffffff" then
        clocks_wrap <= '1';
      end if;
      if clocks_wrap = '1' then
        clocks_high <= clocks_high + 1;
      end if;
      if aresetn = '0' then
        clocks <= (others => '0');
        clocks_low <= (others => '0');
        clocks_wrap <= '0';
        clocks_high <= (others => '0');
      end if;
    end if;
  end process clock_count;

  -- ===== Interrupts =====
  events(pending_answer) <= answer_event;
  events(pending_receive) <= '1' when receive_level >= receive_threshold else '0';
  events(pending_transmit) <= '1' when transmit_level <= transmit_threshold else '0';
  events(pending_fault) <= fault_event;
  events(pending_refused) <= refused_event;
  cleared <= write_word(pending_refused downto pending_answer) when write_done = '1' and write_address = pending_at else no_interrupts;

  -- What happens in the clock of a clear is not lost.
  pending_next <= (pending and not cleared) or events;

  interrupt : process (aclk)
  begin
    if rising_edge(aclk) then
      pending <= pending_next;
      interrupting <= '0';
      if (pending and mask) /= no_interrupts then
        interrupting <= '1';
      end if;
      if aresetn = '0' then
        pending <= pending_reset(pending_refused downto pending_answer);
        interrupting <= '0';
      end if;
    end if;
  end process interrupt;
  irq <= interrupting;
end architecture rtl;
