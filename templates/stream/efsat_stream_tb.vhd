--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of {{ prefix }}efsat_stream. Reads words and expected answers from a file: I <word> <last> <whole> and O <word> <last>,
-- in hexadecimal; a word that is not whole lacks bytes. Drives all words at full speed. Then it resets in the middle of
-- a packet and drives all again: without TREADY for an answer until the unit is full and offers one, then with random
-- stalls on both sides. It compares every answer and its TLAST, expects one packet of answers for every packet of
-- words, and that an answer offered stays as it is until it is taken. A file without answers is not compared; the
-- answers of the first pass are written to the file that the generic answers names. It stops by itself; the last line
-- it prints begins with "{{ prefix }}efsat_stream_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity {{ prefix }}efsat_stream_tb is
  generic (
    vectors : string := "{{ prefix }}efsat_stream_tb.vec";
    answers : string := "";
    passes : positive := 2
  );
  port (
    finished : out boolean
  );
end entity {{ prefix }}efsat_stream_tb;

architecture simulation of {{ prefix }}efsat_stream_tb is
  constant formats : string := "{{ formats }}";
  constant patience : natural := {{ patience }};  -- clocks without a transfer before giving up
  constant full_after : natural := {{ full_after }};  -- clocks of refusal after which the unit is full
  constant begun : natural := {{ begun }};  -- words before the reset between passes: a pair in the unit, one that waits

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal aresetn : std_logic := '0';
  -- Without TVALID nobody may look at the others.
  signal s_tdata : std_logic_vector({{ word }}) := (others => 'X');
  signal s_tkeep : std_logic_vector({{ keep }}) := (others => 'X');
  signal s_tvalid : std_logic := '0';
  signal s_tlast : std_logic := 'X';
  signal s_tready : std_logic;
  signal m_tdata : std_logic_vector({{ answer }});
  signal m_tkeep : std_logic_vector({{ answer_keep }});
  signal m_tvalid : std_logic;
  signal m_tlast : std_logic;
  signal m_tready : std_logic := '0';

{% let bench = "efsat_stream_tb" %}
{%- include "bench/hex_words.vhd" %}

  procedure read_flag(l : inout line; flag : out std_logic) is
    variable c : character;
  begin
    read(l, c);  -- the space before it
    read(l, c);
    if c = '1' then
      flag := '1';
    else
      flag := '0';
    end if;
  end procedure read_flag;

  procedure write_answer(l : inout line; word : in std_logic_vector; last : in std_logic) is
  begin
    write_word(l, word);
    if last = '1' then
      write(l, string'(" 1"));
    else
      write(l, string'(" 0"));
    end if;
  end procedure write_answer;
begin
  clk <= not clk after {{ half_period }} when not done else '0';
  finished <= done;

  wrapper : entity work.{{ prefix }}efsat_stream
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

  main : process
    file source : text;
    file wanted : text;
    file log : text;
    variable l : line;
    variable word_line : line;
    variable answer_line : line;
    variable message : line;
    variable more_words : boolean;
    variable more_answers : boolean;
    variable word : std_logic_vector(s_tdata'range);
    variable word_last : std_logic;
    variable word_whole : std_logic;
    variable expected : std_logic_vector(m_tdata'range);
    variable expected_last : std_logic;
    variable held : std_logic_vector(m_tdata'range);
    variable held_last : std_logic := '0';
    variable holding : boolean := false;
    variable comparing : boolean := false;
    variable packets_in : natural := 0;
    variable packets_out : natural := 0;
    variable taken : natural := 0;  -- answers of this pass
    variable taken_first : natural := 0;  -- answers of the first pass
    variable compared : natural := 0;
    variable mismatches : natural := 0;
    variable clock : natural := 0;  -- since reset
    variable first_word : integer := -1;
    variable clocks : natural := 0;  -- from the first word to the last answer of the first pass
    variable quiet : natural := 0;  -- clocks without a transfer
    variable refused : natural := 0;  -- clocks since a word was offered and not taken
    variable filled : boolean := false;
    variable random : unsigned(15 downto 0) := x"ace1";
    variable go : boolean;

    -- The next line of the kind, its rest into found; more says whether there is one.
    procedure find_line(file f : text; kind : in character; found : inout line; more : out boolean) is
      variable c : character;
    begin
      more := false;
      while not endfile(f) loop
        readline(f, found);
        if found'length > 0 then
          read(found, c);
          if c = kind then
            more := true;
            exit;
          end if;
        end if;
      end loop;
    end procedure find_line;

    procedure rewind is
    begin
      file_open(source, vectors, read_mode);
      file_open(wanted, vectors, read_mode);
      readline(source, l);
      assert l.all = formats
        report "{{ prefix }}efsat_stream_tb: " & vectors & " is for another design: " & l.all & " instead of " & formats
        severity failure;
      find_line(source, 'I', word_line, more_words);
      find_line(wanted, 'O', answer_line, more_answers);
    end procedure rewind;

    procedure no_word is
    begin
      s_tvalid <= '0';
      s_tdata <= (others => 'X');
      s_tkeep <= (others => 'X');
      s_tlast <= 'X';
    end procedure no_word;

    procedure next_word is
    begin
      read_word(word_line, word);
      read_flag(word_line, word_last);
      read_flag(word_line, word_whole);
      find_line(source, 'I', word_line, more_words);
      s_tdata <= word;
      s_tlast <= word_last;
      s_tkeep <= (others => '1');
      s_tkeep(s_tkeep'high) <= word_whole;
      s_tvalid <= '1';
    end procedure next_word;

    -- Reset in the middle of a packet, answers owed: all that was begun is forgotten, and so is the pose.
    procedure interrupt is
    begin
      rewind;
      m_tready <= '0';
      for i in 1 to begun loop
        exit when not more_words;
        next_word;
        wait until rising_edge(clk) and s_tready = '1' for patience * {{ half_period }};
      end loop;
      no_word;
      aresetn <= '0';
      wait until rising_edge(clk);
      for i in 1 to 4 loop
        wait until rising_edge(clk);
        if (s_tready or m_tvalid) /= '0' then
          mismatches := mismatches + 1;
          assert false report "{{ prefix }}efsat_stream_tb: a handshake in reset" severity error;
        end if;
      end loop;
      aresetn <= '1';
      file_close(source);
      file_close(wanted);
    end procedure interrupt;
  begin
    for i in 1 to 4 loop
      wait until rising_edge(clk);
    end loop;
    aresetn <= '1';
    if answers /= "" then
      file_open(log, answers, write_mode);
    end if;
    for pass in 1 to passes loop
      if pass > 1 then
        interrupt;
      end if;
      rewind;
      comparing := more_answers;
      packets_in := 0;
      packets_out := 0;
      taken := 0;
      loop
        wait until rising_edge(clk);
        quiet := quiet + 1;
        -- An answer is offered, and perhaps taken.
        if holding and (m_tvalid /= '1' or m_tdata /= held or m_tlast /= held_last) then
          mismatches := mismatches + 1;
          assert false report "{{ prefix }}efsat_stream_tb: an answer changed before it was taken" severity error;
        end if;
        holding := m_tvalid = '1' and m_tready = '0';
        held := m_tdata;
        held_last := m_tlast;
        if (m_tvalid and m_tready) = '1' then
          quiet := 0;
          if answers /= "" and pass = 1 then
            write_answer(message, m_tdata, m_tlast);
            writeline(log, message);
          end if;
          if more_answers then
            read_word(answer_line, expected);
            read_flag(answer_line, expected_last);
            find_line(wanted, 'O', answer_line, more_answers);
            compared := compared + 1;
            if m_tdata /= expected or m_tlast /= expected_last then
              mismatches := mismatches + 1;
              if mismatches <= 10 then
                write(message, string'("{{ prefix }}efsat_stream_tb: mismatch at answer "));
                write(message, taken);
                write(message, string'(" pass "));
                write(message, pass);
                write(message, string'(" expected "));
                write_answer(message, expected, expected_last);
                write(message, string'(" actual "));
                write_answer(message, m_tdata, m_tlast);
                writeline(output, message);
              end if;
            end if;
          elsif comparing then
            mismatches := mismatches + 1;
            assert false report "{{ prefix }}efsat_stream_tb: an answer too many" severity error;
          end if;
          taken := taken + 1;
          if m_tlast = '1' then
            packets_out := packets_out + 1;
          end if;
          if pass = 1 then
            clocks := clock - first_word;
          end if;
        end if;
        -- A word is taken.
        if (s_tvalid and s_tready) = '1' then
          quiet := 0;
          refused := 0;
          if first_word < 0 then
            first_word := clock;
          end if;
          no_word;
          if s_tlast = '1' then
            packets_in := packets_in + 1;
          end if;
        elsif s_tvalid = '1' then
          refused := refused + 1;
        end if;
        -- Pace: full speed; in the second pass no answer is taken until the unit is full and offers one, which must not
        -- wait for TREADY; then all is random.
        random := random(14 downto 0) & (random(15) xor random(13) xor random(12) xor random(10));
        if pass = 1 then
          go := true;
          m_tready <= '1';
        elsif not filled then
          go := true;
          m_tready <= '0';
          filled := (refused > full_after or not more_words) and m_tvalid = '1';
        else
          go := random(1) = '1' or (clock / 256) mod 2 = 1;
          m_tready <= random(4);
        end if;
        -- The next word, once the one before is taken.
        if go and (s_tvalid = '0' or s_tready = '1') and more_words then
          next_word;
        elsif not more_words and (s_tvalid = '0' or s_tready = '1') and packets_out >= packets_in then
          exit;
        end if;
        clock := clock + 1;
        if quiet > patience then
          assert false report "{{ prefix }}efsat_stream_tb: no transfer any more" severity failure;
        end if;
      end loop;
      clock := clock + 1;
      if more_answers or packets_out /= packets_in then
        mismatches := mismatches + 1;
        assert false report "{{ prefix }}efsat_stream_tb: an answer is missing, or a packet too many" severity error;
      end if;
      if pass = 1 then
        taken_first := taken;
      end if;
      file_close(source);
      file_close(wanted);
    end loop;
    if answers /= "" then
      file_close(log);
    end if;
    write(message, string'("{{ prefix }}efsat_stream_tb: packets "));
    write(message, packets_in);
    write(message, string'(" answers "));
    write(message, taken_first);
    write(message, string'(" compared "));
    write(message, compared);
    write(message, string'(" mismatches "));
    write(message, mismatches);
    write(message, string'(" clocks "));
    write(message, clocks);
    write(message, string'(" total "));
    write(message, clock);
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}efsat_stream_tb: the wrapper and the reference model differ" severity failure;
    done <= true;
    wait;
  end process main;
end architecture simulation;
