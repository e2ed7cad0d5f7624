--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of {{ prefix }}efsat. Reads poses, pairs and expected answers from a vector file and drives all of them at full speed,
-- then the first {{ paced }} again: until the unit is full, then with random gaps and back-pressure. It compares verdict,
-- flags, tag and order of every answer and stops by itself. The last line it prints begins with "{{ prefix }}efsat_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity {{ prefix }}efsat_tb is
  generic (
    vectors : string := "{{ prefix }}efsat_tb.vec"
  );
  port (
    finished : out boolean
  );
end entity {{ prefix }}efsat_tb;

architecture simulation of {{ prefix }}efsat_tb is
  constant formats : string := "{{ formats }}";
  constant paced : natural := {{ paced }};  -- pairs of the second pass
  constant patience : natural := {{ patience }};  -- clocks without an answer before giving up
  constant in_flight : natural := 4096;  -- answers awaited at most
  constant full_after : natural := {{ full_after }};  -- clocks of refusal after which the unit is full

  subtype pair_word is std_logic_vector({{ pair_high }} downto 0);
{%- if pose.len() > 0 %}
  subtype pose_word is std_logic_vector({{ pose_high }} downto 0);
{%- endif %}
  subtype answer_word is std_logic_vector({{ answer_high }} downto 0);
  type pair_list is array (0 to in_flight - 1) of pair_word;
  type answer_list is array (0 to in_flight - 1) of answer_word;

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal reset : std_logic := '1';
  signal in_valid : std_logic := '0';
  signal in_ready : std_logic;
  signal pair : pair_word := (others => '0');
{%- if tag_width > 0 %}
  signal in_tag : std_logic_vector({{ tag }}) := (others => '0');
  signal out_tag : std_logic_vector({{ tag }});
{%- endif %}
{%- if pose.len() > 0 %}
  signal pose_valid : std_logic := '0';
  signal pose_ready : std_logic;
  signal pose : pose_word := (others => '0');
{%- endif %}
  signal out_valid : std_logic;
  signal out_ready : std_logic := '0';
  signal answer : answer_word;
{%- if probes.len() > 0 %}
  signal probes : std_logic_vector({{ probe_high }} downto 0);
{%- endif %}

  -- Hexadecimal digits into a word; surplus high bits of the first digit must be zero.
  procedure read_word(l : inout line; word : out std_logic_vector) is
    constant digits : natural := (word'length + 3) / 4;
    variable bits : std_logic_vector(4 * digits - 1 downto 0);
    variable c : character;
    variable nibble : natural;
  begin
    read(l, c);  -- the space before it
    for i in digits - 1 downto 0 loop
      read(l, c);
      case c is
        when '0' to '9' => nibble := character'pos(c) - character'pos('0');
        when 'a' to 'f' => nibble := character'pos(c) - character'pos('a') + 10;
        when others =>
          nibble := 0;
          assert false report "{{ prefix }}efsat_tb: no hexadecimal digit: " & c severity failure;
      end case;
      bits(4 * i + 3 downto 4 * i) := std_logic_vector(to_unsigned(nibble, 4));
    end loop;
    word := bits(word'length - 1 downto 0);
  end procedure read_word;

  procedure write_word(l : inout line; word : in std_logic_vector) is
    constant hex : string(1 to 16) := "0123456789abcdef";
    constant digits : natural := (word'length + 3) / 4;
    variable bits : std_logic_vector(4 * digits - 1 downto 0) := (others => '0');
    variable nibble : std_logic_vector(3 downto 0);
    variable value : natural;
  begin
    bits(word'length - 1 downto 0) := word;
    for i in digits - 1 downto 0 loop
      nibble := bits(4 * i + 3 downto 4 * i);
      value := 0;
      for j in 3 downto 0 loop
        value := 2 * value;
        case nibble(j) is
          when '1' => value := value + 1;
          when '0' => null;
          when others => value := 99;
        end case;
        exit when value >= 99;
      end loop;
      if value < 16 then
        write(l, hex(value + 1));
      else
        write(l, '?');
      end if;
    end loop;
  end procedure write_word;
begin
  clk <= not clk after {{ half_period }} when not done else '0';
  finished <= done;

  unit : entity work.{{ prefix }}efsat
    port map (
      clk => clk,
      reset => reset,
      in_valid => in_valid,
{%- if tag_width > 0 %}
      in_tag => in_tag{% if tag_width == 1 %}(0){% endif %},
{%- endif %}
{%- for field in pair %}
      {{ field.port }} => pair({% if field.single %}{{ field.low }}{% else %}{{ field.high }} downto {{ field.low }}{% endif %}),
{%- endfor %}
{%- if pose.len() > 0 %}
      pose_valid => pose_valid,
      pose_ready => pose_ready,
{%- for field in pose %}
      {{ field.port }} => pose({% if field.single %}{{ field.low }}{% else %}{{ field.high }} downto {{ field.low }}{% endif %}),
{%- endfor %}
{%- endif %}
      out_ready => out_ready,
      in_ready => in_ready,
      out_valid => out_valid,
{%- if tag_width > 0 %}
      out_tag => out_tag{% if tag_width == 1 %}(0){% endif %},
{%- endif %}
{%- for field in probes %}
      {{ field.port }} => probes({% if field.single %}{{ field.low }}{% else %}{{ field.high }} downto {{ field.low }}{% endif %}),
{%- endfor %}
{%- for field in answer %}
      {{ field.port }} => answer({% if field.single %}{{ field.low }}{% else %}{{ field.high }} downto {{ field.low }}{% endif %}){% if !loop.last %},{% endif %}
{%- endfor %}
    );

  main : process
    file source : text;
{%- if probes.len() > 0 %}
    file probe_log : text open write_mode is "{{ prefix }}efsat_tb.probe";
{%- endif %}
    variable l : line;
    variable message : line;
    variable kind : character;
    variable word : pair_word;
{%- if pose.len() > 0 %}
    variable pose_read : pose_word;
{%- endif %}
    variable answer_read : answer_word;
    variable pairs : pair_list;
    variable answers : answer_list;
    variable offered : natural := 0;  -- pairs of this pass given to the unit, accepted or not
    variable taken : natural := 0;  -- answers of this pass
    variable clock : natural := 0;  -- since reset
    variable quiet : natural := 0;  -- clocks without an answer
    variable mismatches : natural := 0;
    variable vectors_seen : natural := 0;  -- of the first pass
    variable first_accepted : integer := -1;
    variable previous_accepted : integer := -1;
    variable interval : natural := 0;
    variable latency : natural := 0;
    variable clocks : natural := 0;
    variable random : unsigned(15 downto 0) := x"ace1";
    variable go : boolean;
    variable waited : natural := 0;  -- clocks since a pair was offered and not accepted
    variable filled : boolean := false;
    variable tag_fits : boolean;

    -- The next line that is no comment, into l; none leaves kind = '.'.
    procedure next_record is
    begin
      kind := '.';
      while not endfile(source) loop
        readline(source, l);
        if l'length > 0 then
          if l(l'left) /= '#' then
            read(l, kind);
            exit;
          end if;
        end if;
      end loop;
    end procedure next_record;

    procedure rewind is
    begin
      file_open(source, vectors, read_mode);
      readline(source, l);
      assert l.all = formats
        report "{{ prefix }}efsat_tb: " & vectors & " is for another design: " & l.all & " instead of " & formats severity failure;
      next_record;
    end procedure rewind;
  begin
    for i in 1 to {{ reset_clocks }} loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    for pass in 1 to 2 loop
      rewind;
      offered := 0;
      taken := 0;
      loop
        wait until rising_edge(clk);
        quiet := quiet + 1;
{%- if probes.len() > 0 %}
        if pass = 1 then
          if (in_valid and in_ready) = '1' then
            write(message, string'("1 "));
          else
            write(message, string'("0 "));
          end if;
          write_word(message, probes);
          writeline(probe_log, message);
        end if;
{%- endif %}
        -- An answer is taken.
        if (out_valid and out_ready) = '1' then
          quiet := 0;
          tag_fits := true;
{%- if tag_width > 0 %}
          tag_fits := out_tag = std_logic_vector(resize(to_unsigned((taken + 1) mod {{ tags }}, 31), {{ tag_width }}));
{%- endif %}
          if answer /= answers(taken mod in_flight) or not tag_fits then
            mismatches := mismatches + 1;
            if mismatches <= 10 then
              write(message, string'("{{ prefix }}efsat_tb: mismatch at vector "));
              write(message, taken);
              write(message, string'(" pass "));
              write(message, pass);
              write(message, string'(" pair "));
              write_word(message, pairs(taken mod in_flight));
              write(message, string'(" expected "));
              write_word(message, answers(taken mod in_flight));
              write(message, string'(" actual "));
              write_word(message, answer);
              if not tag_fits then
                write(message, string'(" with a wrong tag"));
              end if;
              writeline(output, message);
            end if;
          end if;
          if pass = 1 then
            if taken = 0 then
              latency := clock - first_accepted;
            end if;
            clocks := clock - first_accepted;
          end if;
          taken := taken + 1;
        end if;
        -- A pair or a pose is accepted. What stands there while nothing is offered must not matter.
        if (in_valid and in_ready) = '1' then
          in_valid <= '0';
          pair <= not pair;
          if pass = 1 then
            if previous_accepted < 0 then
              first_accepted := clock;
            elsif interval = 0 or clock - previous_accepted < interval then
              interval := clock - previous_accepted;
            end if;
            previous_accepted := clock;
          end if;
        end if;
{%- if pose.len() > 0 %}
        if (pose_valid and pose_ready) = '1' then
          pose_valid <= '0';
          pose <= not pose;
        end if;
{%- endif %}
        -- Pace: full speed; in the second pass no answer is taken until the unit is full, then all is random.
        random := random(14 downto 0) & (random(15) xor random(13) xor random(12) xor random(10));
        if in_valid = '1' and in_ready = '0' then
          waited := waited + 1;
        else
          waited := 0;
        end if;
        if pass = 1 then
          go := true;
          out_ready <= '1';
        elsif not filled then
          go := true;
          out_ready <= '0';
          filled := waited > full_after or (in_valid = '0' and (kind = '.' or offered = paced));
        else
          go := random(3 downto 0) = 0 or (random(0) = '1' and (clock / 256) mod 2 = 1);
          out_ready <= random(4);
        end if;
        -- The next record, once the one before is accepted.
        if go and (in_valid = '0' or in_ready = '1')
{%- if pose.len() > 0 %} and (pose_valid = '0' or pose_ready = '1')
{%- endif %}
          and kind /= '.' and (pass = 1 or offered < paced) then
          case kind is
            when 'V' =>
              read_word(l, word);
              read_word(l, answer_read);
              pair <= word;
              pairs(offered mod in_flight) := word;
              answers(offered mod in_flight) := answer_read;
{%- if tag_width > 0 %}
              -- From 1 on, as what was never written is 0.
              in_tag <= std_logic_vector(resize(to_unsigned((offered + 1) mod {{ tags }}, 31), {{ tag_width }}));
{%- endif %}
              in_valid <= '1';
              offered := offered + 1;
{%- if pose.len() > 0 %}
            when 'P' =>
              read_word(l, pose_read);
              pose <= pose_read;
              pose_valid <= '1';
{%- endif %}
            when others =>
              assert false report "{{ prefix }}efsat_tb: no record: " & kind severity failure;
          end case;
          next_record;
        elsif taken = offered and (kind = '.' or (pass = 2 and offered = paced)) then
          exit;
        end if;
        clock := clock + 1;
        if quiet > patience then
          assert false report "{{ prefix }}efsat_tb: no answer any more" severity failure;
        end if;
      end loop;
      clock := clock + 1;
      quiet := 0;
      if pass = 1 then
        vectors_seen := taken;
      end if;
      file_close(source);
    end loop;
    write(message, string'("{{ prefix }}efsat_tb: vectors "));
    write(message, vectors_seen);
    write(message, string'(" mismatches "));
    write(message, mismatches);
    write(message, string'(" clocks "));
    write(message, clocks);
    write(message, string'(" latency "));
    write(message, latency);
    write(message, string'(" interval "));
    write(message, interval);
    write(message, string'(" paced "));
    write(message, taken);
    write(message, string'(" total "));
    write(message, clock);
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}efsat_tb: the unit and the reference model differ" severity failure;
    assert interval = 0 or interval = {{ interval }} report "{{ prefix }}efsat_tb: initiation interval is not {{ interval }}" severity failure;
    assert latency {% if two_stages %}>{% endif %}= {{ latency }} report "{{ prefix }}efsat_tb: latency is not {{ latency }}" severity failure;
    done <= true;
    wait;
  end process main;
end architecture simulation;
