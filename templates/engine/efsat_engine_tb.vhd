{% let read_ports = &e.engines.ports -%}
--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of {{ prefix }}efsat_engine. It reads a file of lines, each a letter and hexadecimal fields:
--   I <word> <last> <whole>  a word for the engine; one that is not whole lacks a byte by its TKEEP
--   D <clocks>               so many clocks before the next word
--   W                        the next word only when all packets so far are answered
{%- if e.axi %}
--   M <address> <word>       64 bits of memory, the address in words of 64 bits; nothing else is to be read
--   X <address> <kind>       a fault of the memory at a burst with that address, in units of 64 bytes: 1 error response, 2 last
--                            word too early, 3 too late; once. 4: it is answered after hang clocks, and those behind it later; 5: no
--                            word of it is the last one
{%- endif %}
--   S                        a soft reset by the port, one clock long, where a word would come; the rest of a packet has no answer
--   Z                        behind S, or behind the word of a soft reset: the answer with that reason, which ends what was not answered
{%- if e.axi %}
--   N <address> <word>       64 bits of memory are written, where a word would come
{%- endif %}
--   A <word>                 a pair that the next packet is to answer, in ascending order of the words
--   R <low> <mode> <word 1> <word 2> <word 3>  its report: the low half of word 0, and what is compared: 2 all, 1 the low half
--                            and that no other pair is answered, 0 the low half alone; 3 all, and the pairs are in the order of
--                            the file; 4 the low half, and that the pairs are the first of these, in order
--   O <word> <last>          a word that the next packet is to answer, in this place; for packets of pairs and poses
{%- if e.engines.several %}
-- Reports come in any order, up to a Z: that with low is the one that is compared. Words of O come in the order of the file.
{%- endif %}
-- The order of pairs of a query is compared in modes 3 and 4 alone. In the first pass words go at full speed{% if e.axi %} and memory answers after latency_least to
-- latency_most clocks{% endif %}; in the others there are random stalls on all sides. The bounds of the stack, the rules of the streams{% if e.axi %}
-- and of AXI (steady addresses, bursts within 64 bytes, reads of nothing but the memory){% endif %} are checked. It stops by itself;
-- the last line it prints begins with "{{ prefix }}efsat_engine_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity {{ prefix }}efsat_engine_tb is
  generic (
    vectors : string := "{{ prefix }}efsat_engine_tb.vec";
    answers : string := "";  -- a file for all words that come out, each with its TLAST and its clock
    compared : boolean := true;  -- answers, with those in the file
    patience : natural := {{ e.patience }};  -- clocks without a transfer before giving up
{%- if e.axi %}
    latency_least : positive := 30;
    latency_most : positive := 30;
    hang : positive := 100000;
{%- endif %}
    seed : positive := 1;
    first_pass : positive := 1;
    passes : positive := 2  -- the last one
  );
  port (
    finished : out boolean
  );
end entity {{ prefix }}efsat_engine_tb;

architecture simulation of {{ prefix }}efsat_engine_tb is
  constant formats : string := "{{ e.formats }}";
  constant most_pairs : natural := 65536;  -- of a packet
  subtype word_64 is std_logic_vector(63 downto 0);
  type words_64 is array (natural range <>) of word_64;

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal aresetn : std_logic := '0';
  signal soft_reset : std_logic := '0';
  -- Nothing is known of a word that is not there.
  signal s_tdata : word_64 := (others => 'X');
  signal s_tkeep : std_logic_vector(7 downto 0) := (others => 'X');
  signal s_tvalid : std_logic := '0';
  signal s_tlast : std_logic := 'X';
  signal s_tready : std_logic;
  signal m_tdata : word_64;
  signal m_tkeep : std_logic_vector(7 downto 0);
  signal m_tvalid : std_logic;
  signal m_tlast : std_logic;
  signal m_tready : std_logic := '0';
  signal pass : positive := 1;
{%- if e.axi %}
{% include "engine/memory_signals.vhd" %}
{%- endif %}

  -- A number of 16 bits that looks random.
  function following(x : unsigned(15 downto 0)) return unsigned is
  begin
    return x(14 downto 0) & (x(15) xor x(13) xor x(12) xor x(10));
  end function following;

{% let bench = "efsat_engine_tb" %}
{%- include "bench/hex_words.vhd" %}

  -- Ascending order, by insertion with shrinking steps.
  procedure sort(words : inout words_64; count : in natural) is
    variable step : natural;
    variable place : natural;
    variable moved : word_64;
  begin
    step := 1;
    while step < count / 3 loop
      step := 3 * step + 1;
    end loop;
    while step > 0 loop
      for i in step to count - 1 loop
        moved := words(i);
        place := i;
        while place >= step loop
          exit when unsigned(words(place - step)) <= unsigned(moved);
          words(place) := words(place - step);
          place := place - step;
        end loop;
        words(place) := moved;
      end loop;
      step := step / 3;
    end loop;
  end procedure sort;
begin
  clk <= not clk after {{ e.half_period }} when not done else '0';
  finished <= done;

  engine : entity work.{{ prefix }}{{ e.top }}
    port map (
      aclk => clk,
      aresetn => aresetn,
      soft_reset => soft_reset,
      s_axis_tdata => s_tdata,
      s_axis_tkeep => s_tkeep,
      s_axis_tvalid => s_tvalid,
      s_axis_tlast => s_tlast,
      s_axis_tready => s_tready,
{%- if e.axi %}
{%- for port in read_ports %}
      m{{ port }}_axi_araddr => araddr{{ port }},
      m{{ port }}_axi_arlen => arlen{{ port }},
      m{{ port }}_axi_arsize => arsize{{ port }},
      m{{ port }}_axi_arburst => arburst{{ port }},
      m{{ port }}_axi_arcache => arcache{{ port }},
      m{{ port }}_axi_arprot => arprot{{ port }},
      m{{ port }}_axi_arvalid => arvalid{{ port }},
      m{{ port }}_axi_arready => arready{{ port }},
      m{{ port }}_axi_rdata => rdata{{ port }},
      m{{ port }}_axi_rresp => rresp{{ port }},
      m{{ port }}_axi_rlast => rlast{{ port }},
      m{{ port }}_axi_rvalid => rvalid{{ port }},
      m{{ port }}_axi_rready => rready{{ port }},
{%- endfor %}
{%- endif %}
      m_axis_tdata => m_tdata,
      m_axis_tkeep => m_tkeep,
      m_axis_tvalid => m_tvalid,
      m_axis_tlast => m_tlast,
      m_axis_tready => m_tready
    );
{%- if e.axi %}

{% include "engine/memory_process.vhd" %}
{%- endif %}

  main : process
    file source : text;
    file wanted : text;
    file log : text;
    variable l : line;
    variable word_line : line;
    variable answer_line : line;
    variable message : line;
    variable kind : character;
    variable more_words : boolean;
    variable more_answers : boolean;
    variable word : word_64;
    variable flag : std_logic_vector(3 downto 0);
    variable pause : natural := 0;
    variable waits : boolean := false;
    variable found : words_64(0 to most_pairs - 1);
    variable found_count : natural := 0;
    variable expected : words_64(0 to most_pairs - 1);
    variable expected_count : natural := 0;
    variable low : std_logic_vector(31 downto 0);
    variable mode : natural;
    variable tail : words_64(0 to 7);
    variable held : word_64;
    variable held_last : std_logic := '0';
    variable holding : boolean := false;
    variable packets_in : natural := 0;
    variable packets_out : natural := 0;
    variable packets_wanted : natural := 0;
    variable pairs : natural := 0;
    variable mismatches : natural := 0;
    variable greatest : natural := 0;
    variable busy : natural := 0;  -- clocks of all reports of the first pass
    variable clock : natural := 0;
    variable quiet : natural := 0;
    variable random : unsigned(15 downto 0);
    variable place : natural;
    variable stop_header : boolean;
    variable reset_header : boolean;
    variable within_packet : boolean;
    variable dropped : boolean;  -- a soft reset by the port came within the packet, which has no answer
    variable packets_reset : natural := 0;  -- packets in up to the last soft reset
{%- if e.engines.several %}
    constant most_packets : natural := 4096;
    type flags is array (natural range <>) of boolean;
    variable compared_before : flags(0 to most_packets - 1) := (others => false);  -- packets of the file
{%- endif %}

    -- The next line of one of the kinds, its rest into found; more says whether there is one.
    procedure find_line(file f : text; kinds : in string; which : out character; rest : inout line; more : out boolean) is
      variable c : character;
    begin
      more := false;
      which := ' ';
      while not endfile(f) loop
        readline(f, rest);
        if rest'length > 0 then
          read(rest, c);
          for i in kinds'range loop
            if kinds(i) = c then
              more := true;
              which := c;
              return;
            end if;
          end loop;
        end if;
      end loop;
    end procedure find_line;

{% let place = "packet" %}
{%- let counter = "packets_out" %}
{%- include "bench/complain.vhd" %}

{%- if e.engines.several %}

    -- The next packet of the file: its kind, and what its report begins with.
    procedure next_packet(which : out character; more : out boolean) is
      variable kind_found : character;
    begin
      find_line(wanted, "ROZ", kind_found, answer_line, more_answers);
      which := kind_found;
      more := more_answers;
      if kind_found = 'R' then
        read_word(answer_line, low);
      elsif kind_found = 'O' then
        loop
          read_word(answer_line, word);
          read_word(answer_line, flag);
          exit when flag(0) = '1';
          find_line(wanted, "O", kind_found, answer_line, more_answers);
        end loop;
      end if;
    end procedure next_packet;

    procedure first_packet is
    begin
      file_close(wanted);
      file_open(wanted, vectors, read_mode);
    end procedure first_packet;

    -- Goes in the file to the packet that has just come: by its report, or the first that has none. What ends all before it is a
    -- soft reset.
    procedure seek(ends : in boolean; there : out boolean) is
      variable which : character;
      variable more : boolean;
      variable packet : natural := 0;
      variable reports : boolean;
      variable fits : boolean := false;
    begin
      reports := found_count >= 8;
      if reports then
        reports := found(found_count - 8)(1 downto 0) = "11";
      end if;
      first_packet;
      loop
        next_packet(which, more);
        exit when not more;
        if not compared_before(packet) then
          fits := (which = 'Z' and ends) or (which = 'O' and not reports)
            or (which = 'R' and reports and not ends and low = found(found_count - 8)(31 downto 0));
          exit when fits or which = 'Z';
        end if;
        packet := packet + 1;
      end loop;
      there := fits;
      if fits then
        first_packet;
        for i in 0 to packet - 1 loop
          compared_before(i) := compared_before(i) or ends;
          next_packet(which, more);
        end loop;
        compared_before(packet) := true;
      end if;
    end procedure seek;
{%- endif %}

    -- Pairs and report of the packet that has just ended, against the file.
    procedure compare is
      variable which : character;
      variable due : word_64;
{%- if e.engines.several %}
      variable there : boolean;
{%- endif %}
    begin
      if found_count >= 8 and found(found_count - 8)(7 downto 0) = x"ab" then
        -- A report with reason 10.
{%- if e.engines.several %}
        seek(true, there);
{%- endif %}
        find_line(wanted, "Z", which, answer_line, more_answers);
        if not more_answers then
          complain("a soft reset too many");
        end if;
        packets_out := packets_reset - 1;
        return;
      end if;
{%- if e.engines.several %}
      seek(false, there);
      if not there then
        complain("a packet that nothing waits for");
        return;
      end if;
{%- endif %}
      expected_count := 0;
      loop
        find_line(wanted, "AROZ", which, answer_line, more_answers);
        if not more_answers or which = 'Z' then
          complain("a packet too many");
          return;
        end if;
        exit when which /= 'A';
        read_word(answer_line, expected(expected_count));
        expected_count := expected_count + 1;
      end loop;
      if which = 'O' then
        pairs := pairs + found_count;
        for i in 0 to found_count - 1 loop
          read_word(answer_line, due);
          read_word(answer_line, flag);
          compare_word("answer " & integer'image(i), found(i), due);
          if (flag(0) = '1') /= (i = found_count - 1) then
            complain("an answer of another length");
            return;
          end if;
          if flag(0) = '0' then
            find_line(wanted, "O", which, answer_line, more_answers);
          end if;
        end loop;
        return;
      end if;
      if found_count < 8 then
        complain("a packet without a report");
        return;
      end if;
      found_count := found_count - 8;
      tail := found(found_count to found_count + 7);
      read_word(answer_line, low);
      read_word(answer_line, flag);
      mode := to_integer(unsigned(flag));
      compare_word("word 0", tail(0)(31 downto 0), low);
      for i in 1 to 3 loop
        read_word(answer_line, due);
        if mode = 2 or mode = 3 then
          compare_word("word " & integer'image(i), tail(i), due);
        end if;
      end loop;
      place := 0;
      if mode > 2 then
        for i in 0 to found_count - 1 loop
          if i < expected_count then
            compare_word("pair " & integer'image(i), found(i), expected(i));
          else
            compare_word("a pair too many", found(i), (word_64'range => '0'));
          end if;
        end loop;
        if mode = 3 and found_count < expected_count then
          complain("a pair is missing");
        end if;
      elsif mode > 0 then
        sort(found, found_count);
        for i in 0 to found_count - 1 loop
          while place < expected_count and unsigned(expected(place)) < unsigned(found(i)) loop
            if mode = 2 then
              compare_word("a pair is missing", found(i), expected(place));
            end if;
            place := place + 1;
          end loop;
          if place < expected_count and expected(place) = found(i) then
            place := place + 1;
          else
            compare_word("a pair too many", found(i), (word_64'range => '0'));
          end if;
        end loop;
        if mode = 2 and place < expected_count then
          complain("a pair is missing");
        end if;
      end if;
      pairs := pairs + found_count;
      if to_integer(unsigned(tail(7)(47 downto 32))) > greatest then
        greatest := to_integer(unsigned(tail(7)(47 downto 32)));
      end if;
      if greatest > {{ e.traversal.stack }} then
        complain("the stack is too full");
      end if;
      if pass = 1 then
        busy := busy + to_integer(unsigned(tail(0)(62 downto 32)));
      end if;
    end procedure compare;
  begin
    random := to_unsigned(seed, 16) xor x"ace1";
    for i in 1 to 4 loop
      wait until rising_edge(clk);
    end loop;
    if answers /= "" then
      file_open(log, answers, write_mode);
    end if;
    for run in first_pass to passes loop
      pass <= run;
      aresetn <= '0';
{%- if e.axi %}
      memory_resetn <= '0';
{%- endif %}
      s_tvalid <= '0';
      for i in 1 to 4 loop
        wait until rising_edge(clk);
      end loop;
      if (s_tready or m_tvalid) /= '0' then
        complain("a handshake in reset");
      end if;
      aresetn <= '1';
{%- if e.axi %}
      memory_resetn <= '1';
{%- endif %}
      holding := false;
      within_packet := false;
      dropped := false;
      stop_header := false;
      reset_header := false;
      file_open(source, vectors, read_mode);
      file_open(wanted, vectors, read_mode);
      readline(source, l);
      assert l.all = formats
        report "{{ prefix }}efsat_engine_tb: " & vectors & " is for another design: " & l.all & " instead of " & formats
        severity failure;
      find_line(source, "IDWSN", kind, word_line, more_words);
      packets_in := 0;
      packets_out := 0;
      found_count := 0;
      quiet := 0;
      pause := 0;
      loop
        wait until rising_edge(clk);
        clock := clock + 1;
        quiet := quiet + 1;
        random := following(random);
        -- An answer is offered, and perhaps taken.
        if holding and (m_tvalid /= '1' or m_tdata /= held or m_tlast /= held_last) then
          complain("an answer changed before it was taken");
        end if;
        holding := m_tvalid = '1' and m_tready = '0';
        held := m_tdata;
        held_last := m_tlast;
        if (m_tvalid and m_tready) = '1' then
          quiet := 0;
          if answers /= "" then
            write_word(message, m_tdata);
            write(message, ' ');
            write(message, to_bit(m_tlast));
            write(message, ' ');
            write(message, clock);
            writeline(log, message);
          end if;
          found(found_count) := m_tdata;
          found_count := found_count + 1;
          if m_tlast = '1' then
            if compared then
              compare;
            end if;
            packets_out := packets_out + 1;
            found_count := 0;
          end if;
        end if;
        -- A word is taken. A stop has no answer, nor has the rest of a packet behind a soft reset.
        if (s_tvalid and s_tready) = '1' then
          quiet := 0;
          s_tvalid <= '0';
          s_tdata <= (others => 'X');
          s_tkeep <= (others => 'X');
          s_tlast <= 'X';
          within_packet := s_tlast = '0';
          if s_tlast = '1' and not stop_header and not dropped then
            packets_in := packets_in + 1;
            if reset_header then
              packets_reset := packets_in;
            end if;
          end if;
          stop_header := s_tlast = '1' and stop_header;
          dropped := dropped and within_packet;
        end if;
        soft_reset <= '0';
{%- if e.axi %}
        rewrites <= '0';
{%- endif %}
        -- The next word, once the one before is taken.
        if s_tvalid = '0' or s_tready = '1' then
          if pause > 0 then
            pause := pause - 1;
          elsif more_words then
            if kind = 'D' then
              read_word(word_line, low);
              pause := to_integer(unsigned(low(30 downto 0)));
              find_line(source, "IDWSN", kind, word_line, more_words);
{%- if e.axi %}
            elsif kind = 'N' then
              read_word(word_line, low);
              rewritten_address <= low;
              read_word(word_line, word);
              rewritten_word <= word;
              rewrites <= '1';
              find_line(source, "IDWSN", kind, word_line, more_words);
{%- endif %}
            elsif kind = 'S' then
              soft_reset <= '1';
              packets_in := packets_in + 1;
              packets_reset := packets_in;
              dropped := within_packet;
              find_line(source, "IDWSN", kind, word_line, more_words);
            elsif kind = 'W' then
              if packets_out = packets_in then
                find_line(source, "IDWSN", kind, word_line, more_words);
              end if;
            elsif run = 1 or random(1) = '1' or random(6) = '1' then
              read_word(word_line, word);
              read_word(word_line, flag);
              s_tdata <= word;
              s_tlast <= flag(0);
              stop_header := flag(0) = '1' and word(39 downto 0) = x"00{{ e.query.stop_header }}";
              reset_header := flag(0) = '1' and word(39 downto 0) = x"00{{ e.query.reset_header }}";
              read_word(word_line, flag);
              stop_header := stop_header and flag(0) = '1';
              reset_header := reset_header and flag(0) = '1';
              s_tkeep <= (others => '1');
              s_tkeep(7) <= flag(0);
              s_tvalid <= '1';
              find_line(source, "IDWSN", kind, word_line, more_words);
            end if;
          elsif packets_out = packets_in then
            exit;
          end if;
        end if;
        m_tready <= '1';
        if run > 1 then
          m_tready <= random(4) or random(9);
        end if;
        if quiet > patience + pause then
          assert false report "{{ prefix }}efsat_engine_tb: no transfer any more" severity failure;
        end if;
      end loop;
{%- if e.engines.several %}
      first_packet;
      for packet in compared_before'range loop
        next_packet(kind, more_answers);
        exit when not more_answers;
        if not compared_before(packet) then
          complain("a packet is missing");
        end if;
        compared_before(packet) := false;
      end loop;
{%- else %}
      find_line(wanted, "AROZ", kind, answer_line, more_answers);
      if more_answers then
        complain("a packet is missing");
      end if;
{%- endif %}
      file_close(source);
      file_close(wanted);
    end loop;
    if answers /= "" then
      file_close(log);
    end if;
{%- if e.axi %}
{%- for port in read_ports %}
    mismatches := mismatches + broken{{ port }};
{%- endfor %}
{%- endif %}
    write(message, string'("{{ prefix }}efsat_engine_tb: packets "));
    write(message, packets_out);
    write(message, string'(" pairs "));
    write(message, pairs);
    write(message, string'(" mismatches "));
    write(message, mismatches);
    write(message, string'(" stack "));
    write(message, greatest);
    write(message, string'(" clocks "));
    write(message, busy);
    write(message, string'(" total "));
    write(message, clock);
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}efsat_engine_tb: the engine and the reference model differ" severity failure;
    done <= true;
    wait;
  end process main;
end architecture simulation;
