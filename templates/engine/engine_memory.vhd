--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- {{ m.what }} of both trees in block RAM: {{ m.lines }} lines of {{ m.line_bits }} bits, written in words of {{ m.word_bits }} bits. Line i of
-- a tree is at its base + i. A request names a line of A and one of B; both come together two clocks later, in order, and
-- stay until they are taken.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}{{ m.entity }} is
  port (
    clk : in std_logic;
    reset : in std_logic;
    -- Words to be stored, while nothing is asked for.
    write_valid : in std_logic;
    write_line : in std_logic_vector({{ m.place }});
    write_place : in std_logic_vector(2 downto 0);  -- of the word in its line
    write_data : in std_logic_vector({{ m.word }});
    base_a : in std_logic_vector({{ m.place }});  -- of the trees that the request is about
    base_b : in std_logic_vector({{ m.place }});
    request_valid : in std_logic;
    request_ready : out std_logic;
    request_a : in std_logic_vector({{ m.number }});
    request_b : in std_logic_vector({{ m.number }});
    lines_valid : out std_logic;
    lines_taken : in std_logic;
    line_a : out std_logic_vector({{ m.line }});
    line_b : out std_logic_vector({{ m.line }})
  );
end entity {{ prefix }}{{ m.entity }};

architecture rtl of {{ prefix }}{{ m.entity }} is
  constant line_count : natural := {{ m.lines }};
  constant place_bits : natural := {{ m.line_address_bits }};
  constant word_bits : natural := {{ m.word_bits }};
  constant words_per_line : natural := {{ m.words_per_line }};
  type words is array (0 to line_count - 1) of std_logic_vector(word_bits - 1 downto 0);
  signal asked : std_logic := '0';
  signal asked_a : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal asked_b : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal found : std_logic := '0';
  signal moves : std_logic;  -- the lines asked for are read
  signal accepts : std_logic;
  signal place_a : unsigned(place_bits - 1 downto 0);
  type line_words is array (0 to words_per_line - 1) of std_logic_vector(word_bits - 1 downto 0);
  signal words_a : line_words := (others => (others => '0'));
  signal words_b : line_words := (others => (others => '0'));
  signal whole_a : std_logic_vector({{ m.padded }});
  signal whole_b : std_logic_vector({{ m.padded }});
begin
  moves <= asked and {% if m.paced %}not found{% else %}(lines_taken or not found){% endif %};
  accepts <= moves or not asked;
  request_ready <= accepts;
  lines_valid <= found;
  whole_a <= {% for i in m.word_places %}words_a({{ i }}){% if !loop.last %}
    & {% endif %}{% endfor %};
  whole_b <= {% for i in m.word_places %}words_b({{ i }}){% if !loop.last %}
    & {% endif %}{% endfor %};
  -- A line ends within its last word: what is above is not of the line.
  line_a <= whole_a({{ m.line }});
  line_b <= whole_b({{ m.line }});
  place_a <= unsigned(write_line) when write_valid = '1' else asked_a;

  -- Control runs no query whose tree ends beyond the memory, and the traversal asks for nothing beyond the tree: what is dropped of
  -- a number is zero.
  ask : process (clk)
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        asked_a <= unsigned(base_a) + unsigned(request_a({{ m.used_number }}));
        asked_b <= unsigned(base_b) + unsigned(request_b({{ m.used_number }}));
      end if;
      if reset = '1' then
        asked <= '0';
        found <= '0';
      else
        if accepts = '1' then
          asked <= request_valid;
        end if;
        if moves = '1' then
          found <= '1';
        elsif lines_taken = '1' then
          found <= '0';
        end if;
      end if;
    end if;
  end process ask;

  banks : for i in 0 to words_per_line - 1 generate
    signal bank : words := (others => (others => '0'));
    attribute ram_style of bank : signal is "block";
    signal written : std_logic;
  begin
    written <= write_valid when unsigned(write_place) = i else '0';

    store : process (clk)
    begin
      if rising_edge(clk) then
        if written = '1' then
          bank(to_integer(place_a)) <= write_data;
        end if;
        if moves = '1' then
          words_a(i) <= bank(to_integer(place_a));
          words_b(i) <= bank(to_integer(asked_b));
        end if;
      end if;
    end process store;
  end generate banks;
end architecture rtl;
