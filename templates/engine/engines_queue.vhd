--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Answers of one engine that wait for their turn, in block RAM. A packet has its turn when all of it is here, or when no place is
-- left: so no engine holds up the others while it works.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}engines_queue is
  port (
    clk : in std_logic;
    clear : in std_logic;  -- empties it
    in_valid : in std_logic;
    in_ready : out std_logic;
    in_data : in std_logic_vector(63 downto 0);
    in_last : in std_logic;
    due : out std_logic;  -- a packet may go
    out_valid : out std_logic;
    out_taken : in std_logic;
    out_data : out std_logic_vector(63 downto 0);
    out_last : out std_logic
  );
end entity {{ prefix }}engines_queue;

architecture rtl of {{ prefix }}engines_queue is
  constant places : natural := {{ e.engines.answer_places }};
  constant place_bits : natural := {{ e.engines.answer_bits }};
  type words is array (0 to places - 1) of std_logic_vector(64 downto 0);
  signal memory : words := (others => (others => '0'));
  signal write_place : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal read_place : unsigned(place_bits - 1 downto 0) := (others => '0');
  signal stored : unsigned(place_bits downto 0) := (others => '0');  -- words in memory, without the one that is offered
  signal packets : unsigned(place_bits downto 0) := (others => '0');  -- that have come to their end, that one included
  signal full : std_logic;
  signal some : std_logic;
  signal stores : std_logic;
  signal fetches : std_logic;
  signal ends : std_logic;
  signal leaves : std_logic;
  signal offered : std_logic := '0';
  signal word : std_logic_vector(64 downto 0) := (others => '0');
begin
  full <= stored(place_bits);
  some <= '0' when stored = 0 else '1';
  in_ready <= not full;
  stores <= in_valid and not full;
  fetches <= some and (out_taken or not offered);
  ends <= stores and in_last;
  leaves <= out_taken and word(64);
  due <= '1' when packets /= 0 or full = '1' else '0';
  out_valid <= offered;
  out_data <= word(63 downto 0);
  out_last <= word(64);

  remember : process (clk)
  begin
    if rising_edge(clk) then
      if stores = '1' then
        memory(to_integer(write_place)) <= in_last & in_data;
      end if;
      if fetches = '1' then
        word <= memory(to_integer(read_place));
      end if;
    end if;
  end process remember;

  move : process (clk)
  begin
    if rising_edge(clk) then
      if clear = '1' then
        write_place <= (others => '0');
        read_place <= (others => '0');
        stored <= (others => '0');
        packets <= (others => '0');
        offered <= '0';
      else
        if stores = '1' then
          write_place <= write_place + 1;
        end if;
        if fetches = '1' then
          read_place <= read_place + 1;
          offered <= '1';
        elsif out_taken = '1' then
          offered <= '0';
        end if;
        if stores = '1' and fetches = '0' then
          stored <= stored + 1;
        elsif stores = '0' and fetches = '1' then
          stored <= stored - 1;
        end if;
        if ends = '1' and leaves = '0' then
          packets <= packets + 1;
        elsif ends = '0' and leaves = '1' then
          packets <= packets - 1;
        end if;
      end if;
    end if;
  end process move;
end architecture rtl;
