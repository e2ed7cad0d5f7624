--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Testbench of {{ prefix }}volume_unit. Reads queries and expansions with their answers from a file and sends them, the first half at
-- full speed and the others with random gaps. It compares the answers, and the clocks until each is there, and stops by
-- itself. The last line it prints begins with "{{ prefix }}volume_unit_tb:".
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity {{ prefix }}volume_unit_tb is
  generic (
    vectors : string := "{{ prefix }}volume_unit_tb.vec";
    full_speed : natural := 0  -- expansions that are sent without gaps
  );
end entity {{ prefix }}volume_unit_tb;

architecture simulation of {{ prefix }}volume_unit_tb is
  constant latency : natural := {{ latency }};

  signal clk : std_logic := '0';
  signal done : boolean := false;
  signal reset : std_logic := '1';
{%- for word in words %}
  signal {{ word.name }} : std_logic_vector({{ word.high }} downto 0) := (others => '0');
{%- endfor %}
  signal in_valid : std_logic := '0';
  signal in_ready : std_logic;
  signal out_valid : std_logic;
  signal out_survive : std_logic_vector(3 downto 0);

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
          assert false report "{{ prefix }}volume_unit_tb: no hexadecimal digit: " & c severity failure;
      end case;
      bits(4 * i + 3 downto 4 * i) := std_logic_vector(to_unsigned(nibble, 4));
    end loop;
    word := bits(word'length - 1 downto 0);
  end procedure read_word;
begin
  clk <= not clk after 5 ns when not done else '0';

  unit : entity work.{{ prefix }}volume_unit
    port map (
      clk => clk,
      reset => reset,
{%- for word in words %}
      {{ word.name }} => {{ word.name }},
{%- endfor %}
      in_valid => in_valid,
      in_ready => in_ready,
      out_valid => out_valid,
      out_survive => out_survive
    );

  main : process
    type flags is array (0 to latency) of boolean;
    type answers is array (0 to latency) of std_logic_vector(3 downto 0);
    file source : text open read_mode is vectors;
    variable l, message : line;
    variable kind : character := ' ';
    variable due : flags := (others => false);  -- in so many clocks an answer is there
    variable expected : answers;
    variable answer : std_logic_vector(3 downto 0);
    variable sent : natural := 0;
    variable mismatches : natural := 0;
    variable idle : boolean;
    variable random : unsigned(15 downto 0) := x"ace1";
{%- for word in words %}
    variable {{ word.name }}_word : std_logic_vector({{ word.high }} downto 0);
{%- endfor %}
  begin
    for i in 1 to 4 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    loop
      wait until rising_edge(clk);
      -- An answer is due, or none.
      if due(0) then
        if out_valid /= '1' or out_survive /= expected(0) then
          mismatches := mismatches + 1;
        end if;
      elsif out_valid /= '0' then
        mismatches := mismatches + 1;
      end if;
      due(0 to latency - 1) := due(1 to latency);
      expected(0 to latency - 1) := expected(1 to latency);
      due(latency) := false;
      if in_valid = '1' and in_ready = '1' then
        in_valid <= '0';
        due(latency - 1) := true;
        expected(latency - 1) := answer;
        sent := sent + 1;
      end if;
      idle := true;
      for i in 0 to latency loop
        idle := idle and not due(i);
      end loop;
      -- The next line, once the expansion before is accepted.
      random := random(14 downto 0) & (random(15) xor random(13) xor random(12) xor random(10));
      if in_valid = '0' or in_ready = '1' then
        if kind = ' ' then
          kind := '.';
          if not endfile(source) then
            readline(source, l);
            read(l, kind);
          end if;
        end if;
        case kind is
          when 'Q' =>
{%- for word in words %}
{%- if word.query %}
            read_word(l, {{ word.name }}_word);
            {{ word.name }} <= {{ word.name }}_word;
{%- endif %}
{%- endfor %}
            kind := ' ';
          when 'E' =>
            if sent < full_speed or random(1 downto 0) = 0 then
{%- for word in words %}
{%- if !word.query %}
              read_word(l, {{ word.name }}_word);
              {{ word.name }} <= {{ word.name }}_word;
{%- endif %}
{%- endfor %}
              read_word(l, answer);
              in_valid <= '1';
              kind := ' ';
            end if;
          when '.' => exit when idle;
          when others => assert false report "{{ prefix }}volume_unit_tb: no record: " & kind severity failure;
        end case;
      end if;
    end loop;
    write(message, string'("{{ prefix }}volume_unit_tb: "));
    write(message, sent);
    write(message, string'(" expansions, "));
    write(message, mismatches);
    write(message, string'(" mismatches"));
    writeline(output, message);
    assert mismatches = 0 report "{{ prefix }}volume_unit_tb: the unit and the reference model differ" severity failure;
    done <= true;
    wait;
  end process main;
end architecture simulation;
