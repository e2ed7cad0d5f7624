--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Packets in, for {{ e.engines.count }} engines. A query goes to the engine that has the fewest, of several the last, and waits here while each
-- has {{ e.engines.most_queries }}: those in flight and one that waits. So does any other packet, but for these:
--   1, 2  pairs and poses go to the first engine, in order
--   5     a stop goes to all of them
--   6     a soft reset is done here, as by the port
-- A query that does not keep the caches empties those of all engines: another one does so before its next query.
--
-- A soft reset by the port drops the packet of which a word was taken to its end, without an answer; an engine that has its header
-- gets a last word in place of the others.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engines_dispatch is
  port (
    clk : in std_logic;
    reset : in std_logic;
    soft_reset : in std_logic;  -- by the port
    s_axis_tdata : in std_logic_vector(63 downto 0);
    s_axis_tkeep : in std_logic_vector(7 downto 0);
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;
    s_axis_tready : out std_logic;
    forget : out std_logic;  -- a soft reset of all engines
    forget_number : out std_logic_vector(23 downto 0);  -- for its report
    -- To the engines, the first in the low bits.
    out_valid : out std_logic_vector(engines - 1 downto 0);
    out_ready : in std_logic_vector(engines - 1 downto 0);
    out_data : out std_logic_vector(63 downto 0);
    out_keep : out std_logic_vector(7 downto 0);
    out_last : out std_logic;
    answered : in std_logic_vector(engines - 1 downto 0);  -- one packet less
    renew : out std_logic_vector(engines - 1 downto 0)  -- the caches are emptied before the next query
  );
end entity {{ prefix }}engines_dispatch;

architecture rtl of {{ prefix }}engines_dispatch is
  constant pairs_kind : std_logic_vector(7 downto 0) := x"{{ e.engines.pairs_kind }}";
  constant pose_kind : std_logic_vector(7 downto 0) := x"{{ e.engines.pose_kind }}";
  constant stop_header : std_logic_vector(39 downto 0) := x"00{{ e.query.stop_header }}";
  constant reset_header : std_logic_vector(39 downto 0) := x"00{{ e.query.reset_header }}";
  constant option_keep : natural := {{ e.engines.keep }};  -- in the word with the options of a query
  constant all_bytes : std_logic_vector(7 downto 0) := (others => '1');
  subtype flags is std_logic_vector(engines - 1 downto 0);
  constant nobody : flags := (others => '0');
  constant first_engine : flags := (0 => '1', others => '0');

  -- Two words are held, so that TREADY depends on registers alone. What a word is as a header is found when it arrives.
  constant is_stop : natural := 0;  -- with nothing behind it
  constant is_reset : natural := 1;  -- with nothing behind it
  constant is_short : natural := 2;  -- pairs or a pose, be they known or not
  constant kinds : natural := 3;
{% include "engine/held_signals.vhd" %}
  signal ready : std_logic;
  signal arrives : std_logic;
  signal within_packet : std_logic := '0';  -- the last word that came was not the last of its packet
  signal stays_within : std_logic;
  signal whole : std_logic;
  signal taken : std_logic;

  signal target : flags := (others => '0');  -- the engine that has the header of the packet
  signal begun : std_logic := '0';  -- it is to have more words of it
  signal place : unsigned(2 downto 0) := "000";  -- of the next word in its packet, up to that behind the options of a query
  signal short : std_logic := '0';  -- the packet has no options
  signal closing : std_logic := '0';  -- it is to have a last one in place of them
  signal skips : std_logic := '0';  -- words are dropped up to the last of the packet
  signal told : flags := (others => '0');  -- engines that have the stop
  signal goes : flags;  -- where a header goes
  signal valid : flags;
  signal gone : flags;
  signal passed : std_logic;
  signal forgets : std_logic := '0';  -- a soft reset by the stream
  signal number : std_logic_vector(23 downto 0) := (others => '0');
  signal clears : std_logic;

  -- Packets that an engine has not answered.
  constant most_queries : natural := {{ e.engines.most_queries }};
  constant most_packets : natural := 63;
  type counts is array (0 to engines - 1) of unsigned(5 downto 0);
  signal count : counts := (others => "000000");
  signal least : unsigned(5 downto 0) := "000000";  -- the fewest, if there is an engine with less than it may have
  signal some : std_logic := '0';  -- there is
  signal chosen : flags := (others => '0');  -- an engine that has so many
  signal stale : unsigned(1 downto 0) := "00";  -- clocks until they are those of the counts
begin
  ready <= running and not next_valid;
  s_axis_tready <= ready;
  arrives <= ready and s_axis_tvalid;
  whole <= '1' when s_axis_tkeep = all_bytes else '0';
  stays_within <= not s_axis_tlast when arrives = '1' else within_packet;
  kind(is_stop) <= whole and s_axis_tlast when s_axis_tdata(39 downto 0) = stop_header else '0';
  kind(is_reset) <= whole and s_axis_tlast when s_axis_tdata(39 downto 0) = reset_header else '0';
  kind(is_short) <= '1' when s_axis_tdata(7 downto 0) = pairs_kind or s_axis_tdata(7 downto 0) = pose_kind else '0';

{% include "engine/held_words.vhd" %}

  -- ===== Where words go =====
  goes <= nobody when forgets = '1' else
    not told when head_kind(is_stop) = '1' else
    nobody when head_kind(is_reset) = '1' else
    first_engine when head_kind(is_short) = '1' and count(0) /= most_packets else
    nobody when head_kind(is_short) = '1' or stale /= 0 else
    chosen;
  valid <= target when closing = '1' else
    nobody when head_valid = '0' or skips = '1' else
    target when begun = '1' else
    goes;
  out_valid <= valid;
  out_data <= head;
  out_keep <= (7 => head_whole, others => '1');
  out_last <= head_last or closing;
  gone <= valid and out_ready;
  passed <= '0' when gone = nobody else '1';
  taken <= '0' when head_valid = '0' or closing = '1' else
    '1' when skips = '1' else
    passed when begun = '1' else
    not forgets when head_kind(is_reset) = '1' else
    '1' when head_kind(is_stop) = '1' and (told or gone) = not nobody else
    passed and not head_kind(is_stop);
  forget <= soft_reset or forgets;
  forget_number <= number when forgets = '1' else (others => '0');
  clears <= reset or soft_reset;

  receive : process (clk)
    variable still : std_logic;  -- the engine with the header has more to come
  begin
    if rising_edge(clk) then
      forgets <= '0';
      renew <= nobody;
      if head_valid = '1' then
        number <= head(option_number);
      end if;
      still := begun;
      if closing = '1' then
        if passed = '1' then
          closing <= '0';
        end if;
      elsif taken = '1' then
        if skips = '1' then
          skips <= not head_last;
        elsif begun = '1' then
          still := not head_last;
          if place <= options_word then
            place <= place + 1;
          end if;
          if place = options_word and (short or head(option_keep)) = '0' then
            renew <= not target;
          end if;
        else
          place <= "001";
          short <= head_kind(is_short);
          told <= nobody;
          forgets <= head_kind(is_reset);
          if (head_kind(is_reset) or head_kind(is_stop)) = '0' then
            target <= gone;
            still := not head_last;
          end if;
        end if;
      elsif begun = '0' and head_kind(is_stop) = '1' then
        told <= told or gone;
      end if;
      begun <= still;
      if clears = '1' then
        forgets <= '0';
        told <= nobody;
        begun <= '0';
        closing <= (still or (closing and not passed)) and not reset;
        skips <= stays_within and not reset;
      end if;
    end if;
  end process receive;

  -- ===== Which engine is next =====
  choose : process (clk)
    variable fewest : unsigned(5 downto 0);
    variable found : std_logic;
  begin
    if rising_edge(clk) then
      for i in 0 to engines - 1 loop
        if valid(i) = '1' and out_ready(i) = '1' and (begun or closing or head_kind(is_stop)) = '0' then
          if answered(i) = '0' then
            count(i) <= count(i) + 1;
          end if;
        elsif answered(i) = '1' then
          count(i) <= count(i) - 1;
        end if;
      end loop;
      fewest := to_unsigned(most_queries - 1, 6);
      found := '0';
      for level in most_queries - 1 downto 0 loop
        for i in 0 to engines - 1 loop
          if count(i) = level then
            fewest := to_unsigned(level, 6);
            found := '1';
          end if;
        end loop;
      end loop;
      least <= fewest;
      some <= found;
      found := '0';
      chosen <= nobody;
      for i in engines - 1 downto 0 loop
        if some = '1' and count(i) = least and found = '0' then
          chosen(i) <= '1';
          found := '1';
        end if;
      end loop;
      if passed = '1' and (begun or closing) = '0' then
        stale <= "11";
      elsif stale /= 0 then
        stale <= stale - 1;
      end if;
      if (clears or forgets) = '1' then
        count <= (others => "000000");
        stale <= "11";
      end if;
    end if;
  end process choose;
end architecture rtl;
