--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- {{ m.what }} of one tree behind a direct-mapped cache of {{ m.lines }} lines of {{ m.line_bits }} bits. Line i of the tree is at address
-- base + i (in 64 bytes); the low {{ m.line_address_bits }} bits choose its place, the others are its tag. A request that misses takes over the
-- place at once and asks the memory; what was there is still given to the requests before it, because requests are served
-- in order and words from memory are written when the request that asked for them is the next one. Memory is only asked if
-- there are places for all words of the answer ({{ m.places }} lines).
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}{{ m.entity }} is
  port (
    clk : in std_logic;
    reset : in std_logic;
    flush : in std_logic;  -- one clock long, while nothing is under way: forgets all lines
    flushing : out std_logic;  -- also after a reset
    base : in std_logic_vector(25 downto 0);
    request_valid : in std_logic;
    request_ready : out std_logic;
    request : in std_logic_vector({{ m.number_bits - 1 }} downto 0);
    line_valid : out std_logic;
    line_taken : in std_logic;
    data : out std_logic_vector({{ m.line_bits - 1 }} downto 0);
    ask_valid : out std_logic;
    ask_ready : in std_logic;
    ask_address : out std_logic_vector(25 downto 0);
    fill_valid : in std_logic;  -- {{ m.words_per_line }} words for each address asked for, in order
    fill_data : in std_logic_vector({{ m.word_bits - 1 }} downto 0);
    missed : out std_logic  -- one clock long
  );
end entity {{ prefix }}{{ m.entity }};

architecture rtl of {{ prefix }}{{ m.entity }} is
  -- Requests: two are held, so that readiness depends on registers alone.
  signal arrives : std_logic;
  signal ready : std_logic;
  signal address : unsigned(25 downto 0);
  signal head_valid : std_logic := '0';
  signal head : unsigned(25 downto 0) := (others => '0');
  signal next_valid : std_logic := '0';
  signal next_address : unsigned(25 downto 0) := (others => '0');
  signal head_leaves : std_logic;

  -- Look-up: a tag has a bit that says that the line is there.
  type tags is array (0 to {{ m.lines - 1 }}) of std_logic_vector({{ m.tag_bits }} downto 0);
  signal tag_memory : tags := (others => (others => '0'));
  signal tag_found : std_logic_vector({{ m.tag_bits }} downto 0) := (others => '0');
  signal tag_write : std_logic;
  signal tag_place : unsigned({{ m.line_address_bits - 1 }} downto 0);
  signal tag_written : std_logic_vector({{ m.tag_bits }} downto 0);
  signal tag_wanted : std_logic_vector({{ m.tag_bits }} downto 0);
  signal tag_there : std_logic_vector({{ m.tag_bits }} downto 0);
  signal replaced : std_logic := '0';  -- the tag was written when it was read
  signal replacement : std_logic_vector({{ m.tag_bits }} downto 0) := (others => '0');
  signal looked : std_logic := '0';
  signal looked_at : unsigned(25 downto 0) := (others => '0');
  signal hit : std_logic;
  signal passes : std_logic;
  signal sweeping : std_logic := '1';
  signal sweep_place : unsigned({{ m.line_address_bits - 1 }} downto 0) := (others => '0');
  signal asking : std_logic := '0';
  signal asked_address : unsigned(25 downto 0) := (others => '0');
  signal reserved : unsigned({{ m.place_bits }} downto 0) := (others => '0');  -- lines asked for and not written yet
  signal all_reserved : std_logic;

  -- Requests in order, each with the place of its line and whether that is still to be written.
  type orders is array (0 to {{ m.places - 1 }}) of std_logic_vector({{ m.line_address_bits }} downto 0);
  signal order_memory : orders := (others => (others => '0'));
  signal order_in : unsigned({{ m.place_bits - 1 }} downto 0) := (others => '0');
  signal order_out : unsigned({{ m.place_bits - 1 }} downto 0) := (others => '0');
  signal orders_waiting : unsigned({{ m.place_bits }} downto 0) := (others => '0');
  signal order_free : std_logic;
  signal order_there : std_logic;
  signal order : std_logic_vector({{ m.line_address_bits }} downto 0);
  signal order_place : unsigned({{ m.line_address_bits - 1 }} downto 0);
  signal filled : std_logic := '0';  -- the line of the first request is written
  signal serves : std_logic;
  signal found : std_logic := '0';

  -- Words from memory
  type words is array (0 to {{ m.return_words - 1 }}) of std_logic_vector({{ m.word_bits - 1 }} downto 0);
  signal return_memory : words := (others => (others => '0'));
  signal return_in : unsigned({{ m.return_bits - 1 }} downto 0) := (others => '0');
  signal return_out : unsigned({{ m.return_bits - 1 }} downto 0) := (others => '0');
  signal returned : unsigned({{ m.return_bits }} downto 0) := (others => '0');
  signal fetches : std_logic;
  signal word_valid : std_logic := '0';
  signal word : std_logic_vector({{ m.word_bits - 1 }} downto 0) := (others => '0');
  signal word_place : unsigned(3 downto 0) := "0000";
  signal writes : std_logic;
  signal last_word : std_logic;
  type lines is array (0 to {{ m.lines - 1 }}) of std_logic_vector({{ m.word_bits - 1 }} downto 0);
  type line_words is array (0 to {{ m.words_per_line - 1 }}) of std_logic_vector({{ m.word_bits - 1 }} downto 0);
  signal line_word : line_words := (others => (others => '0'));
  signal whole : std_logic_vector({{ m.padded_bits - 1 }} downto 0);
begin
  -- ===== Requests =====
  ready <= not next_valid and not sweeping;
  request_ready <= ready;
  arrives <= ready and request_valid;
  address <= unsigned(base) + unsigned(request({{ m.used_number_bits - 1 }} downto 0));
  head_leaves <= head_valid and (passes or not looked);

  hold : process (clk)
  begin
    if rising_edge(clk) then
      if head_leaves = '1' or head_valid = '0' then
        head <= address;
        if next_valid = '1' then
          head <= next_address;
        end if;
      end if;
      if next_valid = '0' then
        next_address <= address;
      end if;
      if reset = '1' then
        head_valid <= '0';
        next_valid <= '0';
      elsif head_leaves = '1' or head_valid = '0' then
        head_valid <= next_valid or arrives;
        next_valid <= '0';
      else
        next_valid <= next_valid or arrives;
      end if;
    end if;
  end process hold;

  -- ===== Look-up =====
  tag_there <= replacement when replaced = '1' else tag_found;
  tag_wanted <= '1' & std_logic_vector(looked_at(25 downto {{ m.line_address_bits }}));
  hit <= '1' when tag_there = tag_wanted else '0';
  all_reserved <= reserved(reserved'high);
  passes <= looked and order_free and (hit or not (asking or all_reserved));
  tag_write <= sweeping or (passes and not hit);
  tag_place <= sweep_place when sweeping = '1' else looked_at({{ m.line_address_bits - 1 }} downto 0);
  tag_written <= (others => '0') when sweeping = '1' else tag_wanted;
  flushing <= sweeping;
  missed <= passes and not hit;
  ask_valid <= asking;
  ask_address <= std_logic_vector(asked_address);

  look : process (clk)
  begin
    if rising_edge(clk) then
      if tag_write = '1' then
        tag_memory(to_integer(tag_place)) <= tag_written;
      end if;
      if head_leaves = '1' then
        tag_found <= tag_memory(to_integer(head({{ m.line_address_bits - 1 }} downto 0)));
        looked_at <= head;
        replacement <= tag_written;
        replaced <= '0';
        if tag_write = '1' and tag_place = head({{ m.line_address_bits - 1 }} downto 0) then
          replaced <= '1';
        end if;
      end if;
      if passes = '1' and hit = '0' then
        asked_address <= looked_at;
      end if;
      if reset = '1' then
        looked <= '0';
        asking <= '0';
        sweeping <= '1';
        sweep_place <= (others => '0');
        reserved <= (others => '0');
      else
        if passes = '1' or looked = '0' then
          looked <= head_valid;
        end if;
        if passes = '1' and hit = '0' then
          asking <= '1';
        elsif ask_ready = '1' then
          asking <= '0';
        end if;
        sweep_place <= sweep_place + 1;
        if flush = '1' then
          sweeping <= '1';
          sweep_place <= (others => '0');
        elsif sweep_place = {{ m.lines - 1 }} then
          sweeping <= '0';
        end if;
        if (passes and not hit) = '1' and last_word = '0' then
          reserved <= reserved + 1;
        elsif (passes and not hit) = '0' and last_word = '1' then
          reserved <= reserved - 1;
        end if;
      end if;
    end if;
  end process look;

  -- ===== Lines in order =====
  order_free <= not orders_waiting(orders_waiting'high);
  order_there <= '1' when orders_waiting /= 0 else '0';
  order <= order_memory(to_integer(order_out));
  order_place <= unsigned(order({{ m.line_address_bits - 1 }} downto 0));
  serves <= order_there and (filled or not order({{ m.line_address_bits }})) and (line_taken or not found);
  writes <= word_valid and order_there and order({{ m.line_address_bits }}) and not filled;
  last_word <= writes when word_place = {{ m.words_per_line - 1 }} else '0';
  line_valid <= found;
  whole <= {% for i in m.word_places %}line_word({{ i }}){% if !loop.last %}
    & {% endif %}{% endfor %};
  data <= whole({{ m.line_bits - 1 }} downto 0);

  serve : process (clk)
  begin
    if rising_edge(clk) then
      if passes = '1' then
        order_memory(to_integer(order_in)) <= (not hit) & std_logic_vector(looked_at({{ m.line_address_bits - 1 }} downto 0));
      end if;
      if reset = '1' then
        order_in <= (others => '0');
        order_out <= (others => '0');
        orders_waiting <= (others => '0');
        filled <= '0';
        found <= '0';
        word_place <= "0000";
      else
        if passes = '1' then
          order_in <= order_in + 1;
        end if;
        if serves = '1' then
          order_out <= order_out + 1;
        end if;
        if passes = '1' and serves = '0' then
          orders_waiting <= orders_waiting + 1;
        elsif passes = '0' and serves = '1' then
          orders_waiting <= orders_waiting - 1;
        end if;
        if serves = '1' then
          filled <= '0';
          found <= '1';
        elsif line_taken = '1' then
          found <= '0';
        end if;
        if writes = '1' then
          word_place <= word_place + 1;
          if last_word = '1' then
            word_place <= "0000";
            filled <= '1';
          end if;
        end if;
      end if;
    end if;
  end process serve;

  banks : for i in 0 to {{ m.words_per_line - 1 }} generate
    signal bank : lines := (others => (others => '0'));
    signal written : std_logic;
  begin
    written <= writes when word_place = i else '0';

    store : process (clk)
    begin
      if rising_edge(clk) then
        if written = '1' then
          bank(to_integer(order_place)) <= word;
        end if;
        if serves = '1' then
          line_word(i) <= bank(to_integer(order_place));
        end if;
      end if;
    end process store;
  end generate banks;

  -- ===== Words from memory =====
  fetches <= '1' when returned /= 0 and (word_valid = '0' or writes = '1') else '0';

  take_words : process (clk)
  begin
    if rising_edge(clk) then
      if fill_valid = '1' then
        return_memory(to_integer(return_in)) <= fill_data;
      end if;
      if fetches = '1' then
        word <= return_memory(to_integer(return_out));
      end if;
      if reset = '1' then
        return_in <= (others => '0');
        return_out <= (others => '0');
        returned <= (others => '0');
        word_valid <= '0';
      else
        if fill_valid = '1' then
          return_in <= return_in + 1;
        end if;
        if fetches = '1' then
          return_out <= return_out + 1;
        end if;
        if fill_valid = '1' and fetches = '0' then
          returned <= returned + 1;
        elsif fill_valid = '0' and fetches = '1' then
          returned <= returned - 1;
        end if;
        if fetches = '1' or writes = '1' then
          word_valid <= fetches;
        end if;
      end if;
    end if;
  end process take_words;
end architecture rtl;
