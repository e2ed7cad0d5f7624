--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Answers out: packets of {{ e.engines.count }} engines, one behind the other, in the order in which they are ready; of several the engine above
-- the one before comes first. Words of a packet stay together.
--
-- After a soft reset each engine gives a report. All that comes up to there is dropped, and one report is given for all of them; if
-- words of a packet were given before, it ends that packet. A last word that an engine offers in the clock of the reset is of a
-- packet before: another one follows.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engines_gather is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forget : in std_logic;  -- a soft reset of all engines
    forget_number : in std_logic_vector(23 downto 0);  -- for its report
    -- From the engines, the first in the low bits.
    in_valid : in std_logic_vector(engines - 1 downto 0);
    in_ready : out std_logic_vector(engines - 1 downto 0);
{%- for i in e.engines.each %}
    in_data_{{ i }} : in std_logic_vector(63 downto 0);
{%- endfor %}
    in_last : in std_logic_vector(engines - 1 downto 0);
    answered : out std_logic_vector(engines - 1 downto 0);  -- the last word of an answer has come, which is not dropped
    m_axis_tdata : out std_logic_vector(63 downto 0);
    m_axis_tkeep : out std_logic_vector(7 downto 0);  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;
    m_axis_tready : in std_logic
  );
end entity {{ prefix }}engines_gather;

architecture rtl of {{ prefix }}engines_gather is
  subtype flags is std_logic_vector(engines - 1 downto 0);
  constant nobody : flags := (others => '0');
  type words is array (0 to engines - 1) of std_logic_vector(63 downto 0);
  signal clear : std_logic;
  signal owes : flags := (others => '0');  -- its report of the soft reset has not come
  signal older : flags := (others => '0');  -- before that comes a last word of another packet
  signal passes : flags;
  signal room : flags;
  signal takes : flags;  -- a word of the engine
  signal due : flags;
  signal waits : flags;
  signal taken : flags;
  signal arriving : words;
  signal data : words;
  signal last : flags;

  signal above : flags := (others => '0');  -- engines above the one before
  signal ahead : flags;
  signal asks : flags;
  signal below : std_logic_vector(engines downto 0);  -- a lower one of them asks
  signal chosen : flags;
  signal speaks : std_logic := '0';  -- a packet goes out
  signal speaker : flags := (others => '0');
  signal free : std_logic;
  signal gives : std_logic;
  type merged_words is array (0 to engines) of std_logic_vector(63 downto 0);
  signal spoken : words;
  signal merged : merged_words;
  signal ends : std_logic;
  signal report_due : std_logic := '0';
  signal report_number : std_logic_vector(23 downto 0) := (others => '0');
  signal place : unsigned(2 downto 0) := "000";  -- of the next word of the report
  signal offered : std_logic := '0';
  signal offered_word : std_logic_vector(63 downto 0) := (others => '0');
  signal offered_last : std_logic := '0';
begin
  clear <= reset or forget;
  passes <= in_valid and not owes;
  takes <= in_valid and (owes or room);
  in_ready <= owes or room;
  answered <= takes and in_last and not owes;
{%- for i in e.engines.each %}
  arriving({{ i }}) <= in_data_{{ i }};
{%- endfor %}

  queues : for i in 0 to engines - 1 generate
    queue : entity work.{{ prefix }}engines_queue
      port map (
        clk => clk,
        clear => clear,
        in_valid => passes(i),
        in_ready => room(i),
        in_data => arriving(i),
        in_last => in_last(i),
        due => due(i),
        out_valid => waits(i),
        out_taken => taken(i),
        out_data => data(i),
        out_last => last(i)
      );
    taken(i) <= speaks and speaker(i) and waits(i) and free;
  end generate queues;

  drop : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        owes <= nobody;
        older <= nobody;
      elsif forget = '1' then
        owes <= not nobody;
        older <= in_valid and in_last and not (owes or room);
      else
        owes <= owes and not (in_valid and in_last and not older);
        older <= older and not (in_valid and in_last);
      end if;
    end if;
  end process drop;

  -- ===== Whose turn it is =====
  ahead <= due and above;
  asks <= due when ahead = nobody else ahead;
  below(0) <= '0';
  choose : for i in 0 to engines - 1 generate
    chosen(i) <= asks(i) and not below(i);
    below(i + 1) <= below(i) or asks(i);
  end generate choose;

  merged(0) <= (others => '0');
  merge : for i in 0 to engines - 1 generate
    spoken(i) <= data(i) when speaker(i) = '1' else (others => '0');
    merged(i + 1) <= merged(i) or spoken(i);
  end generate merge;
  ends <= '0' when (last and speaker) = nobody else '1';

  free <= m_axis_tready or not offered;
  gives <= '0' when taken = nobody else '1';

  offer : process (clk)
    variable lower : boolean;
  begin
    if rising_edge(clk) then
      if free = '1' then
        offered_word <= merged(engines);
        offered_last <= ends;
        if report_due = '1' then
          offered_word <= (others => '0');
          if place = 0 then
            offered_word(31 downto 0) <= report_number & '1' & reason_reset & "11";
          end if;
          offered_last <= '0';
          if place = 7 then
            offered_last <= '1';
          end if;
        end if;
      end if;
      if reset = '1' then
        offered <= '0';
        speaks <= '0';
        report_due <= '0';
        above <= nobody;
      else
        if free = '1' then
          offered <= gives;
        end if;
        if speaks = '0' then
          speaker <= chosen;
          if due /= nobody then
            speaks <= '1';
          end if;
        elsif gives = '1' and ends = '1' then
          speaks <= '0';
          lower := true;
          for i in 0 to engines - 1 loop
            above(i) <= '1';
            if lower then
              above(i) <= '0';
            end if;
            if speaker(i) = '1' then
              lower := false;
            end if;
          end loop;
        end if;
        if report_due = '1' then
          speaks <= '0';
          if owes = nobody and free = '1' then
            offered <= '1';
            place <= place + 1;
            if place = 7 then
              report_due <= '0';
            end if;
          end if;
        end if;
        if forget = '1' then
          speaks <= '0';
          report_due <= '1';
          report_number <= forget_number;
          place <= "000";
          offered <= offered and not free;
        end if;
      end if;
    end if;
  end process offer;
  m_axis_tdata <= offered_word;
  m_axis_tkeep <= (others => '1');
  m_axis_tvalid <= offered;
  m_axis_tlast <= offered_last;
end architecture rtl;
