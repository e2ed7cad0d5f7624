--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- {{ m.what }} of one side behind a direct-mapped cache of {{ m.lines }} lines of {{ m.line_bits }} bits. Line i of a tree is at address
-- base + i (in 64 bytes); the low {{ m.line_address_bits }} bits choose its place, the others are its tag. A request that misses takes over the
-- place at once and asks the memory; what was there is still given to the requests before it, because requests are served
-- in order and words from memory are written when the request that asked for them is the next one. Memory is only asked if
-- there are places for all words of the answer ({{ m.places }} lines).{% if m.paced %} A line is served a clock after the one before it is taken.{% endif %}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}{{ m.entity }} is
  port (
    clk : in std_logic;
    reset : in std_logic;
    flush : in std_logic;  -- one clock long, while nothing is under way: forgets all lines
    flushing : out std_logic;  -- also after a reset
    base : in std_logic_vector(25 downto 0);  -- of the tree that the request is about
    request_valid : in std_logic;
    request_ready : out std_logic;
    request : in std_logic_vector({{ m.number }});
    line_valid : out std_logic;
    line_taken : in std_logic;
    data : out std_logic_vector({{ m.line }});
    ask_valid : out std_logic;
    ask_ready : in std_logic;
    ask_address : out std_logic_vector(25 downto 0);
    fill_valid : in std_logic;  -- {{ m.words_per_line }} words for each address asked for, in order
    fill_data : in std_logic_vector({{ m.word }});
    missed : out std_logic  -- one clock long
  );
end entity {{ prefix }}{{ m.entity }};

architecture rtl of {{ prefix }}{{ m.entity }} is
  constant line_count : natural := {{ m.lines }};
  constant place_bits : natural := {{ m.line_address_bits }};  -- of the place of a line
  constant tag_bits : natural := {{ m.tag_bits }};
  constant word_bits : natural := {{ m.word_bits }};
  constant words_per_line : natural := {{ m.words_per_line }};
  constant most_orders : natural := {{ m.places }};
  constant order_bits : natural := {{ m.place_bits }};  -- of the place of an order
  constant most_returned : natural := {{ m.return_words }};
  constant return_bits : natural := {{ m.return_bits }};  -- of the place of a word that has come

  -- Requests: two are held, so that readiness depends on registers alone.
  signal arrives : std_logic;
  signal ready : std_logic := '0';
  signal head_valid : std_logic := '0';
  signal wanted : unsigned(25 downto 0);  -- address of the line
  signal address : unsigned(25 downto 0) := (others => '0');  -- of the first request
  signal next_valid : std_logic := '0';
  signal next_stays : std_logic;
  signal next_address : unsigned(25 downto 0) := (others => '0');
  signal head_leaves : std_logic;

  -- Look-up in two stages: a tag is read, then compared. A tag has a bit that says that the line is there. Tags are not read in
  -- a clock in which one is written, as what a memory gives then costs a table behind it. What the memory says of a place is too
  -- old while a request for that place is in one of the two stages: then the youngest such request counts, because its line is
  -- there after it. That a request misses is known late in a clock: its tag is written in the next one, and no request passes
  -- while a line is being asked for or all are reserved. Lines are given in order, so a hit would wait for that line anyhow.
  type tags is array (0 to line_count - 1) of std_logic_vector(tag_bits downto 0);
  signal tag_memory : tags := (others => (others => '0'));
  signal tag_found : std_logic_vector(tag_bits downto 0) := (others => '0');
  signal tag_write : std_logic;
  signal tag_place : unsigned(place_bits - 1 downto 0);
  signal tag_written : std_logic_vector(tag_bits downto 0);
  signal looked : std_logic := '0';
  signal looked_at : unsigned(25 downto 0) := (others => '0');
  signal follows : std_logic := '0';  -- another request for the place was under way
  signal follows_same : std_logic := '0';  -- and it was for the same line
  signal looked_leaves : std_logic;
  signal judged : std_logic := '0';
  signal judged_at : unsigned(25 downto 0) := (others => '0');
  constant tag_parts : natural := {{ m.tag_parts.len() }};
  constant all_same : std_logic_vector(tag_parts downto 0) := (others => '1');
  signal same : std_logic_vector(tag_parts downto 0) := (others => '0');  -- parts of the comparison: short ones, because tags come late in their clock
  signal same_as_before : std_logic := '0';  -- it follows a request for the same line
  signal hit : std_logic;
  signal may_pass : std_logic;
  signal judged_free : std_logic;  -- the second stage holds none, or lets it pass
  signal passes : std_logic;
  signal misses : std_logic;
  signal missed_before : std_logic := '0';  -- a clock ago one did
  signal sweeping : std_logic := '1';
  signal sweeps : std_logic;  -- and goes on
  signal sweep_place : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal asking : std_logic := '0';
  signal asked_address : unsigned(25 downto 0) := (others => '0');
  signal reserved : unsigned(order_bits downto 0) := (others => '0');  -- lines asked for and not written yet, as of a clock ago
  signal all_reserved : std_logic;

  -- Requests in order, each with the place of its line and whether that is still to be written. The first is in registers.
  type orders is array (0 to most_orders - 1) of std_logic_vector(place_bits downto 0);
  signal order_memory : orders := (others => (others => '0'));
  signal order_in : unsigned(order_bits - 1 downto 0) := (others => '0');
  signal order_out : unsigned(order_bits - 1 downto 0) := (others => '0');
  signal orders_waiting : unsigned(order_bits downto 0) := (others => '0');
  signal some_wait : std_logic := '0';
  signal order_free : std_logic;
  signal new_order : std_logic_vector(place_bits downto 0);
  signal order_valid : std_logic := '0';
  signal order : std_logic_vector(place_bits downto 0) := (others => '0');
  signal order_leaves : std_logic;
  signal order_place : unsigned(place_bits - 1 downto 0);
  signal reads_line : std_logic;
  signal line_read : std_logic := '0';  -- its words are behind the banks
  signal line_free : std_logic;
  signal comes_forward : std_logic;
  signal found : std_logic := '0';
  -- Registers in front of all that reads a line, because block RAM gives its words late in a clock.
  signal front_line : std_logic_vector({{ m.line }}) := (others => '0');

  -- Words from memory
  type words is array (0 to most_returned - 1) of std_logic_vector(word_bits - 1 downto 0);
  signal return_memory : words := (others => (others => '0'));
  signal return_in : unsigned(return_bits - 1 downto 0) := (others => '0');
  signal return_out : unsigned(return_bits - 1 downto 0) := (others => '0');
  signal returned : unsigned(return_bits downto 0) := (others => '0');
  signal some_returned : std_logic := '0';
  signal fetches : std_logic;
  -- A word that was read, and one in front of the banks, far from the memory.
  signal read_valid : std_logic := '0';
  signal read_word : std_logic_vector(word_bits - 1 downto 0) := (others => '0');
  signal moves : std_logic;
  signal word_valid : std_logic := '0';
  signal word : std_logic_vector(word_bits - 1 downto 0) := (others => '0');
  signal at_word : std_logic_vector(words_per_line - 1 downto 0) := (0 => '1', others => '0');  -- where it goes in its line, a flag for each place
  signal writes : std_logic;
  signal last_word : std_logic;
  signal line_written : std_logic := '0';  -- a clock ago
  type lines is array (0 to line_count - 1) of std_logic_vector(word_bits - 1 downto 0);
  type line_words is array (0 to words_per_line - 1) of std_logic_vector(word_bits - 1 downto 0);
  signal line_word : line_words := (others => (others => '0'));
  signal whole : std_logic_vector({{ m.padded }});
begin
  -- ===== Requests =====
  request_ready <= ready;
  arrives <= ready and request_valid;
  head_leaves <= head_valid and not (sweeping or missed_before) and judged_free;
  next_stays <= '0' when head_leaves = '1' or head_valid = '0' else next_valid or arrives;
  sweeps <= '1' when flush = '1' or (sweeping = '1' and sweep_place /= line_count - 1) else '0';
  wanted <= unsigned(base) + unsigned(request({{ m.used_number }}));

  -- A number has at most {{ m.number_bits }} bits, an address 26. Control runs no query whose tree ends beyond the last address, and the
  -- traversal asks for nothing beyond the tree: what is dropped of a number is zero.
  hold : process (clk)
  begin
    if rising_edge(clk) then
      if head_leaves = '1' or head_valid = '0' then
        address <= wanted;
        if next_valid = '1' then
          address <= next_address;
        end if;
      end if;
      if next_valid = '0' then
        next_address <= wanted;
      end if;
      if reset = '1' then
        head_valid <= '0';
        next_valid <= '0';
        ready <= '0';
      else
        if head_leaves = '1' or head_valid = '0' then
          head_valid <= next_valid or arrives;
        end if;
        next_valid <= next_stays;
        ready <= not (next_stays or sweeps);
      end if;
    end if;
  end process hold;

  -- ===== Look-up =====
  looked_leaves <= looked and judged_free;
  hit <= '1' when same = all_same or same_as_before = '1' else '0';
  all_reserved <= reserved(reserved'high);
  may_pass <= order_free and not (asking or all_reserved);
  passes <= judged and may_pass;
  judged_free <= may_pass or not judged;
  misses <= passes and not hit;
  tag_write <= sweeping or missed_before;
  tag_place <= sweep_place when sweeping = '1' else asked_address(place_bits - 1 downto 0);
  tag_written <= (others => '0') when sweeping = '1' else '1' & std_logic_vector(asked_address(25 downto place_bits));
  flushing <= sweeping;
  missed <= missed_before;
  ask_valid <= asking;
  ask_address <= std_logic_vector(asked_address);

  look : process (clk)
  begin
    if rising_edge(clk) then
      if tag_write = '1' then
        tag_memory(to_integer(tag_place)) <= tag_written;
      end if;
      if head_leaves = '1' then
        tag_found <= tag_memory(to_integer(address(place_bits - 1 downto 0)));
        looked_at <= address;
        follows <= '0';
        follows_same <= '0';
        if judged = '1' and judged_at(place_bits - 1 downto 0) = address(place_bits - 1 downto 0) then
          follows <= '1';
          if judged_at = address then
            follows_same <= '1';
          end if;
        end if;
        if looked = '1' and looked_at(place_bits - 1 downto 0) = address(place_bits - 1 downto 0) then
          follows <= '1';
          follows_same <= '0';
          if looked_at = address then
            follows_same <= '1';
          end if;
        end if;
      end if;
      if looked_leaves = '1' then
        judged_at <= looked_at;
        same <= (others => '0');
{%- for part in m.tag_parts %}
        if tag_found({{ part.tag }}) = std_logic_vector(looked_at({{ part.address }})) then
          same({{ loop.index0 }}) <= '1';
        end if;
{%- endfor %}
        same(tag_parts) <= tag_found(tag_bits) and not follows;
        same_as_before <= follows and follows_same;
      end if;
      if asking = '0' then
        asked_address <= judged_at;
      end if;
      if reset = '1' then
        looked <= '0';
        judged <= '0';
        missed_before <= '0';
        asking <= '0';
        sweeping <= '1';
        sweep_place <= (others => '0');
        reserved <= (others => '0');
      else
        if looked_leaves = '1' or looked = '0' then
          looked <= head_leaves;
        end if;
        if judged_free = '1' then
          judged <= looked;
        end if;
        missed_before <= misses;
        if misses = '1' then
          asking <= '1';
        elsif ask_ready = '1' then
          asking <= '0';
        end if;
        sweep_place <= sweep_place + 1;
        if flush = '1' then
          sweep_place <= (others => '0');
        end if;
        sweeping <= sweeps;
        -- While one is asked for none passes, so it is counted in time.
        if missed_before = '1' and line_written = '0' then
          reserved <= reserved + 1;
        elsif missed_before = '0' and line_written = '1' then
          reserved <= reserved - 1;
        end if;
      end if;
    end if;
  end process look;

  -- ===== Lines in order =====
  order_free <= not orders_waiting(orders_waiting'high);
  new_order <= (not hit) & std_logic_vector(judged_at(place_bits - 1 downto 0));
  order_leaves <= reads_line or not order_valid;
  order_place <= unsigned(order(place_bits - 1 downto 0));
  line_free <= {% if m.paced %}not found{% else %}line_taken or not found{% endif %};
  comes_forward <= line_read and line_free;
  reads_line <= order_valid and not order(place_bits) and (line_free or not line_read);
  writes <= word_valid and order_valid and order(place_bits);
  last_word <= writes and at_word(words_per_line - 1);
  line_valid <= found;
  whole <= {% for i in m.word_places %}line_word({{ i }}){% if !loop.last %}
    & {% endif %}{% endfor %};
  -- A line ends within its last word: what is above is not of the line.
  data <= front_line;

  serve : process (clk)
    variable queued : std_logic;
    variable more : unsigned(order_bits downto 0);  -- waiting orders, if none leaves
    variable less : unsigned(order_bits downto 0);  -- if one does
  begin
    if rising_edge(clk) then
      if comes_forward = '1' then
        front_line <= whole({{ m.line }});
      end if;
      -- A request that passes becomes the first one, or waits behind others.
      queued := passes and (some_wait or not order_leaves);
      if queued = '1' then
        order_memory(to_integer(order_in)) <= new_order;
      end if;
      if order_leaves = '1' then
        order <= new_order;
        if some_wait = '1' then
          order <= order_memory(to_integer(order_out));
        end if;
      elsif last_word = '1' then
        order(place_bits) <= '0';
      end if;
      if reset = '1' then
        order_in <= (others => '0');
        order_out <= (others => '0');
        orders_waiting <= (others => '0');
        some_wait <= '0';
        order_valid <= '0';
        line_read <= '0';
        found <= '0';
        at_word <= (0 => '1', others => '0');
        line_written <= '0';
      else
        line_written <= last_word;
        if queued = '1' then
          order_in <= order_in + 1;
        end if;
        if (order_leaves and some_wait) = '1' then
          order_out <= order_out + 1;
        end if;
        -- Whether one leaves is known late in a clock, so both counts are there before.
        more := orders_waiting;
        less := orders_waiting;
        if passes = '1' then
          more := orders_waiting + 1;
        elsif some_wait = '1' then
          less := orders_waiting - 1;
        end if;
        if some_wait = '0' then
          less := (others => '0');
        end if;
        orders_waiting <= more;
        some_wait <= some_wait or passes;
        if order_leaves = '1' then
          orders_waiting <= less;
          some_wait <= '0';
          if some_wait = '1' and (passes = '1' or orders_waiting /= 1) then
            some_wait <= '1';
          end if;
        end if;
        if order_leaves = '1' then
          order_valid <= some_wait or passes;
        end if;
        if reads_line = '1' then
          line_read <= '1';
        elsif line_free = '1' then
          line_read <= '0';
        end if;
        if comes_forward = '1' then
          found <= '1';
        elsif line_taken = '1' then
          found <= '0';
        end if;
        if writes = '1' then
          for i in 0 to words_per_line - 1 loop
            at_word((i + 1) mod words_per_line) <= at_word(i);
          end loop;
        end if;
      end if;
    end if;
  end process serve;

  banks : for i in 0 to words_per_line - 1 generate
    signal bank : lines := (others => (others => '0'));
    attribute ram_style of bank : signal is "block";
    signal written : std_logic;
  begin
    written <= writes and at_word(i);

    store : process (clk)
    begin
      if rising_edge(clk) then
        if written = '1' then
          bank(to_integer(order_place)) <= word;
        end if;
        if reads_line = '1' then
          line_word(i) <= bank(to_integer(order_place));
        end if;
      end if;
    end process store;
  end generate banks;

  -- ===== Words from memory =====
  moves <= read_valid and (writes or not word_valid);
  fetches <= some_returned and (moves or not read_valid);

  take_words : process (clk)
  begin
    if rising_edge(clk) then
      if fill_valid = '1' then
        return_memory(to_integer(return_in)) <= fill_data;
      end if;
      if fetches = '1' then
        read_word <= return_memory(to_integer(return_out));
      end if;
      if moves = '1' then
        word <= read_word;
      end if;
      if reset = '1' then
        return_in <= (others => '0');
        return_out <= (others => '0');
        returned <= (others => '0');
        some_returned <= '0';
        read_valid <= '0';
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
          some_returned <= '1';
        elsif fill_valid = '0' and fetches = '1' then
          returned <= returned - 1;
          if returned = 1 then
            some_returned <= '0';
          end if;
        end if;
        if fetches = '1' or moves = '1' then
          read_valid <= fetches;
        end if;
        if moves = '1' or writes = '1' then
          word_valid <= moves;
        end if;
      end if;
    end if;
  end process take_words;
end architecture rtl;
