--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of {{ prefix }}efsat_shell, as a processor sees it. It reads a file of lines, each a letter and hexadecimal fields:
--   W <address> <word> <strobes> <response>  a write, and its response
--   R <address> <word> <mask> <response>     a read; of the word the bits of the mask are compared
--   Q <level>                                irq is that, and stays it for some clocks
--   D <clocks>                               so many clocks in which nothing is done
--   Z                                        aresetn for 16 clocks
--   I <word> <last>                          a word for the core, as soon as the transmit queue has a place
--   O <word> <mask> <last>                   a word that must come, of which the bits of the mask are compared
--   P <count> <sum>                          so many words that must come, none the last of its packet, by their sum
--   E <low half>                             words up to a last one; that is the end of the low half of the eighth from the end
{%- if has_caches %}
--   M <address> <word>                       64 bits of memory, the address in words of 64 bits; nothing else is to be read
--   K                                        cache_misses is the sum of the reports that have come
{%- endif %}
-- In the first pass addresses and words of writes come together and nothing stalls; in the second there are random stalls on all
-- channels, and either may come first. What AXI4-Lite asks of responses is checked. It stops by itself; the last line that it prints
-- begins with "{{ prefix }}efsat_registers_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.{{ prefix }}efsat_register_map.all;

entity {{ prefix }}efsat_registers_tb is
  generic (
    vectors : string := "{{ prefix }}efsat_registers_tb.vec";
    patience : natural := {{ patience }};  -- reads of a status that does not change before giving up
{%- if has_caches %}
    latency_least : positive := 30;
    latency_most : positive := 30;
    hang : positive := 100000;
{%- endif %}
    seed : positive := 1;
    passes : positive := 2
  );
  port (
    finished : out boolean
  );
end entity {{ prefix }}efsat_registers_tb;

architecture simulation of {{ prefix }}efsat_registers_tb is
  subtype word_64 is std_logic_vector(63 downto 0);
  type words_64 is array (natural range <>) of word_64;

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal aresetn : std_logic := '0';
  signal awaddr : register_address := (others => 'X');
  signal awvalid : std_logic := '0';
  signal awready : std_logic;
  signal wdata : register_word := (others => 'X');
  signal wstrb : std_logic_vector(3 downto 0) := (others => 'X');
  signal wvalid : std_logic := '0';
  signal wready : std_logic;
  signal bresp : std_logic_vector(1 downto 0);
  signal bvalid : std_logic;
  signal bready : std_logic := '0';
  signal araddr_lite : register_address := (others => 'X');
  signal arvalid_lite : std_logic := '0';
  signal arready_lite : std_logic;
  signal rdata_lite : register_word;
  signal rresp_lite : std_logic_vector(1 downto 0);
  signal rvalid_lite : std_logic;
  signal rready_lite : std_logic := '0';
  signal irq : std_logic;
  signal pass : positive := 1;
{%- if has_caches %}
{{ memory_signals }}
{%- endif %}

  -- A number of 16 bits that looks random.
  function following(x : unsigned(15 downto 0)) return unsigned is
  begin
    return x(14 downto 0) & (x(15) xor x(13) xor x(12) xor x(10));
  end function following;

{% let bench = "efsat_registers_tb" %}
{%- include "bench/hex_words.vhd" %}
begin
  clk <= not clk after {{ half_period }} when not done else '0';
  finished <= done;

  shell : entity work.{{ prefix }}efsat_shell
    port map (
      aclk => clk,
      aresetn => aresetn,
      s_axi_awaddr => awaddr,
      s_axi_awvalid => awvalid,
      s_axi_awready => awready,
      s_axi_wdata => wdata,
      s_axi_wstrb => wstrb,
      s_axi_wvalid => wvalid,
      s_axi_wready => wready,
      s_axi_bresp => bresp,
      s_axi_bvalid => bvalid,
      s_axi_bready => bready,
      s_axi_araddr => araddr_lite,
      s_axi_arvalid => arvalid_lite,
      s_axi_arready => arready_lite,
      s_axi_rdata => rdata_lite,
      s_axi_rresp => rresp_lite,
      s_axi_rvalid => rvalid_lite,
      s_axi_rready => rready_lite,
{%- if has_caches %}
      m_axi_araddr => araddr,
      m_axi_arlen => arlen,
      m_axi_arsize => arsize,
      m_axi_arburst => arburst,
      m_axi_arcache => arcache,
      m_axi_arprot => arprot,
      m_axi_arvalid => arvalid,
      m_axi_arready => arready,
      m_axi_rdata => rdata,
      m_axi_rresp => rresp,
      m_axi_rlast => rlast,
      m_axi_rvalid => rvalid,
      m_axi_rready => rready,
{%- endif %}
      irq => irq
    );
{%- if has_caches %}

{{ memory_process }}
{%- endif %}

  processor : process
    file source : text;
    variable l : line;
    variable message : line;
    variable kind : character;
    variable random : unsigned(15 downto 0);
    variable mismatches : natural := 0;
    variable accesses : natural := 0;
    variable words : natural := 0;
    variable lines : natural := 0;
    variable held_bvalid : std_logic := '0';
    variable held_bresp : std_logic_vector(1 downto 0);
    variable held_rvalid : std_logic := '0';
    variable held_rresp : std_logic_vector(1 downto 0);
    variable held_rdata : register_word;
    variable address : register_address;
    variable word : register_word;
    variable mask : register_word;
    variable found : register_word;
    variable strobes : std_logic_vector(3 downto 0);
    variable response : std_logic_vector(3 downto 0);
    variable said : std_logic_vector(1 downto 0);
    variable flag : std_logic_vector(3 downto 0);
    variable long : word_64;
    variable long_mask : word_64;
    variable came : word_64;
    variable came_last : std_logic;
    variable recent : words_64(0 to 7);
    variable sum : unsigned(63 downto 0);
    variable misses : unsigned(31 downto 0) := (others => '0');
    variable packet : natural := 0;

{% let place = "line" %}
{%- let counter = "lines" %}
{%- include "bench/complain.vhd" %}

    -- A clock; what was offered and not taken has to stay.
    procedure step is
    begin
      wait until rising_edge(clk);
      random := following(random);
      if aresetn = '1' then
        if held_bvalid = '1' and (bvalid /= '1' or bresp /= held_bresp) then
          complain("a response to a write changed before it was taken");
        end if;
        if held_rvalid = '1' and (rvalid_lite /= '1' or rresp_lite /= held_rresp or rdata_lite /= held_rdata) then
          complain("an answer to a read changed before it was taken");
        end if;
      end if;
      held_bvalid := bvalid and not bready and aresetn;
      held_bresp := bresp;
      held_rvalid := rvalid_lite and not rready_lite and aresetn;
      held_rresp := rresp_lite;
      held_rdata := rdata_lite;
    end procedure step;

    -- Clocks before something is done, in the second pass.
    procedure draw(clocks : out natural) is
    begin
      random := following(random);
      clocks := 0;
      if pass > 1 and random(5) = '1' then
        clocks := to_integer(random(9 downto 7));
      end if;
    end procedure draw;

    procedure store(to_address : in register_address; value : in register_word; of_bytes : in std_logic_vector(3 downto 0); answer : out std_logic_vector(1 downto 0)) is
      variable address_after : natural;
      variable word_after : natural;
      variable take_after : natural;
      variable address_taken : boolean := false;
      variable word_taken : boolean := false;
      variable clocks : natural := 0;
    begin
      draw(address_after);
      draw(word_after);
      draw(take_after);
      loop
        if not address_taken and clocks >= address_after then
          awvalid <= '1';
          awaddr <= to_address;
        end if;
        if not word_taken and clocks >= word_after then
          wvalid <= '1';
          wdata <= value;
          wstrb <= of_bytes;
        end if;
        -- BREADY may be set before there is a response.
        if take_after = 0 then
          bready <= '1';
        end if;
        step;
        clocks := clocks + 1;
        if bvalid = '1' then
          complain("a response without a write");
        end if;
        if (awvalid and awready) = '1' then
          address_taken := true;
          awvalid <= '0';
          awaddr <= (others => 'X');
        end if;
        if (wvalid and wready) = '1' then
          word_taken := true;
          wvalid <= '0';
          wdata <= (others => 'X');
          wstrb <= (others => 'X');
        end if;
        exit when address_taken and word_taken;
        if clocks > 64 then
          assert false report "{{ prefix }}efsat_registers_tb: a write is not taken" severity failure;
        end if;
      end loop;
      clocks := 0;
      loop
        if clocks >= take_after then
          bready <= '1';
        end if;
        step;
        clocks := clocks + 1;
        exit when (bvalid and bready) = '1';
        if clocks > 64 then
          assert false report "{{ prefix }}efsat_registers_tb: a write is not answered" severity failure;
        end if;
      end loop;
      answer := bresp;
      bready <= '0';
      accesses := accesses + 1;
    end procedure store;

    procedure load(from_address : in register_address; value : out register_word; answer : out std_logic_vector(1 downto 0)) is
      variable address_after : natural;
      variable take_after : natural;
      variable clocks : natural := 0;
    begin
      draw(address_after);
      draw(take_after);
      for i in 1 to address_after loop
        step;
      end loop;
      arvalid_lite <= '1';
      araddr_lite <= from_address;
      if take_after = 0 then
        rready_lite <= '1';
      end if;
      loop
        step;
        clocks := clocks + 1;
        if rvalid_lite = '1' then
          complain("an answer without a read");
        end if;
        exit when arready_lite = '1';
        if clocks > 64 then
          assert false report "{{ prefix }}efsat_registers_tb: a read is not taken" severity failure;
        end if;
      end loop;
      arvalid_lite <= '0';
      araddr_lite <= (others => 'X');
      clocks := 0;
      loop
        if clocks >= take_after then
          rready_lite <= '1';
        end if;
        step;
        clocks := clocks + 1;
        exit when (rvalid_lite and rready_lite) = '1';
        if clocks > 64 then
          assert false report "{{ prefix }}efsat_registers_tb: a read is not answered" severity failure;
        end if;
      end loop;
      value := rdata_lite;
      answer := rresp_lite;
      rready_lite <= '0';
      accesses := accesses + 1;
    end procedure load;

    -- A word for the core, when there is a place.
    procedure send(value : in word_64; last : in boolean) is
      variable tries : natural := 0;
    begin
      if pass = 1 or random(3) = '1' then
        loop
          load(status_at, found, said);
          exit when unsigned(found(status_transmit_level_high downto status_transmit_level_low)) < {{ places }};
          tries := tries + 1;
          if tries > patience then
            assert false report "{{ prefix }}efsat_registers_tb: the transmit queue stays full" severity failure;
          end if;
        end loop;
      end if;
      -- Else it is tried until it is not refused.
      store(transmit_low_at, value(31 downto 0), "1111", said);
      compare_word("response", said, response_okay);
      loop
        if last then
          store(transmit_last_at, value(63 downto 32), "1111", said);
        else
          store(transmit_high_at, value(63 downto 32), "1111", said);
        end if;
        exit when said = response_okay;
        tries := tries + 1;
        if tries > patience then
          assert false report "{{ prefix }}efsat_registers_tb: the transmit queue stays full" severity failure;
        end if;
      end loop;
    end procedure send;

    -- The next word that comes.
    procedure receive is
      variable tries : natural := 0;
    begin
      loop
        load(status_at, found, said);
        exit when unsigned(found(status_receive_level_high downto status_receive_level_low)) /= 0;
        tries := tries + 1;
        if tries > patience then
          assert false report "{{ prefix }}efsat_registers_tb: no word comes" severity failure;
        end if;
      end loop;
      came_last := found(status_receive_last);
      load(receive_low_at, found, said);
      compare_word("response", said, response_okay);
      came(31 downto 0) := found;
      load(receive_high_at, found, said);
      compare_word("response", said, response_okay);
      came(63 downto 32) := found;
      words := words + 1;
      recent(0 to 6) := recent(1 to 7);
      recent(7) := came;
      packet := packet + 1;
      if came_last = '1' then
{%- if has_caches %}
        -- The blocks and triangles that an engine has read, by its report; that of a soft reset counts nothing.
        if packet >= 8 and recent(0)(1 downto 0) = "11" and recent(0)(6 downto 2) /= "{{ reset_reason }}" then
          misses := misses + unsigned(recent(4)(63 downto 32)) + unsigned(recent(5)(63 downto 32));
        end if;
{%- endif %}
        packet := 0;
      end if;
    end procedure receive;
  begin
    random := to_unsigned(seed, 16) xor x"ace1";
    for run in 1 to passes loop
      pass <= run;
      aresetn <= '0';
{%- if has_caches %}
      memory_resetn <= '0';
{%- endif %}
      for i in 1 to 16 loop
        step;
      end loop;
      if (awready or wready or bvalid or arready_lite or rvalid_lite or irq) /= '0' then
        complain("a handshake in reset");
      end if;
      aresetn <= '1';
{%- if has_caches %}
      memory_resetn <= '1';
{%- endif %}
      step;
      misses := (others => '0');
      packet := 0;
      lines := 1;
      file_open(source, vectors, read_mode);
      readline(source, l);
      assert l.all = "{{ first_line }}"
        report "{{ prefix }}efsat_registers_tb: " & vectors & " is for another design" severity failure;
      while not endfile(source) loop
        readline(source, l);
        lines := lines + 1;
        kind := '#';
        if l'length > 0 then
          read(l, kind);
        end if;
        case kind is
          when 'W' =>
            read_word(l, address);
            read_word(l, word);
            read_word(l, strobes);
            read_word(l, response);
            store(address, word, strobes, said);
            compare_word("response", said, response(1 downto 0));
          when 'R' =>
            read_word(l, address);
            read_word(l, word);
            read_word(l, mask);
            read_word(l, response);
            load(address, found, said);
            compare_word("response", said, response(1 downto 0));
            compare_word("register", found and mask, word and mask);
          when 'Q' =>
            read_word(l, flag);
            for i in 1 to 8 loop
              step;
            end loop;
            for i in 1 to 8 loop
              step;
              if irq /= flag(0) then
                complain("irq is not as expected");
                exit;
              end if;
            end loop;
          when 'D' =>
            read_word(l, word);
            for i in 1 to to_integer(unsigned(word(30 downto 0))) loop
              step;
            end loop;
          when 'Z' =>
            aresetn <= '0';
{%- if has_caches %}
            memory_resetn <= '0';
{%- endif %}
            for i in 1 to 16 loop
              step;
            end loop;
            aresetn <= '1';
{%- if has_caches %}
            memory_resetn <= '1';
{%- endif %}
            misses := (others => '0');
            packet := 0;
            step;
          when 'I' =>
            read_word(l, long);
            read_word(l, flag);
            send(long, flag(0) = '1');
          when 'O' =>
            read_word(l, long);
            read_word(l, long_mask);
            read_word(l, flag);
            receive;
            compare_word("word", came and long_mask, long and long_mask);
            if came_last /= flag(0) then
              complain("another word is the last one");
            end if;
          when 'P' =>
            read_word(l, word);
            read_word(l, long);
            sum := (others => '0');
            for i in 1 to to_integer(unsigned(word(30 downto 0))) loop
              receive;
              sum := sum + unsigned(came);
              if came_last = '1' then
                complain("a packet is too short");
              end if;
            end loop;
            compare_word("sum", std_logic_vector(sum), long);
          when 'E' =>
            read_word(l, word);
            loop
              receive;
              exit when came_last = '1';
            end loop;
            compare_word("report", recent(0)(31 downto 0), word);
{%- if has_caches %}
          when 'K' =>
            load(cache_misses_at, found, said);
            compare_word("cache_misses", found, std_logic_vector(misses));
            if misses = 0 then
              complain("no cache misses at all");
            end if;
{%- endif %}
          when others => null;
        end case;
      end loop;
      file_close(source);
    end loop;
{%- if has_caches %}
    mismatches := mismatches + broken;
{%- endif %}
    write(message, string'("{{ prefix }}efsat_registers_tb: words "));
    write(message, words);
    write(message, string'(" accesses "));
    write(message, accesses);
    write(message, string'(" mismatches "));
    write(message, mismatches);
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}efsat_registers_tb: the registers do not answer as expected" severity failure;
    done <= true;
    wait;
  end process processor;
end architecture simulation;
