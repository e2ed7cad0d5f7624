--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- Answers out, in order. A pair is a word: verdict in bits 1..0, number of A's triangle in 35..8, of B's in 63..36. A packet is
-- closed by a report of eight words, the last with TLAST. What is not said here is zero:
--   0  11 in bits 1..0, reason 6..2, incomplete 7, number of the packet 31..8
--   2  63..32 pairs tested
--   3  pairs that intersect 31..0, pairs that are possibly incorrect 63..32
--   5  triangles asked for, triangles read from memory
--   6  31..0 words read from memory
-- Pairs of several packets may be in the unit. A report notes how many pairs had gone to the unit when its packet was closed,
-- counted modulo {{ e.numbers.marks }}, which is more than the unit holds; it comes behind the last of these.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_number_answer is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forget : in std_logic;  -- a soft reset: pairs and reports are forgotten, a word that is offered stays, and a report says so
    forget_number : in std_logic_vector(23 downto 0);
    sent : in std_logic;  -- a pair goes to the unit
    -- Pairs from the unit.
    tested_valid : in std_logic;
    tested_taken : out std_logic;
    verdict : in std_logic_vector(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    numbers : in std_logic_vector(55 downto 0);  -- of A's triangle in the low half, of B's in the high one
    separate_too : in std_logic;  -- the pair is answered if it is separate, too
    -- Reports
    report_valid : in std_logic;
    report_ready : out std_logic;
    report_reason : in std_logic_vector(4 downto 0);
    report_number : in std_logic_vector(23 downto 0);
    triangles_read : in std_logic_vector(31 downto 0);
    words_read : in std_logic_vector(31 downto 0);
    m_axis_tdata : out std_logic_vector(63 downto 0);
    m_axis_tkeep : out std_logic_vector(7 downto 0);  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;
    m_axis_tready : in std_logic
  );
end entity {{ prefix }}engine_number_answer;

architecture rtl of {{ prefix }}engine_number_answer is
  constant separate : std_logic_vector(1 downto 0) := "00";
  constant certain : std_logic_vector(1 downto 0) := "01";
  constant mark_bits : natural := {{ e.numbers.mark_bits }};
  signal sent_count : unsigned(mark_bits - 1 downto 0) := (others => '0');
  signal taken_count : unsigned(mark_bits - 1 downto 0) := (others => '0');

  -- Reports that wait: mark, reason, number, counts of memory.
  subtype mark_field is natural range {{ e.numbers.mark_field }};
  subtype reason_field is natural range 92 downto 88;
  subtype number_field is natural range 87 downto 64;
  subtype triangles_field is natural range 63 downto 32;
  subtype words_field is natural range 31 downto 0;
  constant places : natural := 8;
  type report_words is array (0 to places - 1) of std_logic_vector({{ e.numbers.report_high }} downto 0);
  signal report_memory : report_words := (others => (others => '0'));
  signal report_in : unsigned(3 downto 0) := "0000";
  signal report_out : unsigned(3 downto 0) := "0000";
  signal full : std_logic;
  signal some : std_logic;
  signal accepts : std_logic;
  signal head : std_logic_vector({{ e.numbers.report_high }} downto 0);
  signal reset_due : std_logic := '0';
  signal reset_number : std_logic_vector(23 downto 0) := (others => '0');

  signal due : std_logic;  -- a report
  signal reason : std_logic_vector(4 downto 0);
  signal number : std_logic_vector(23 downto 0);
  signal incomplete : std_logic;
  signal place : unsigned(2 downto 0) := "000";  -- of the next word of the report
  signal ends : std_logic;
  signal report_word : std_logic_vector(63 downto 0);
  signal pairs : unsigned(31 downto 0) := (others => '0');
  signal intersecting : unsigned(31 downto 0) := (others => '0');
  signal incorrect : unsigned(31 downto 0) := (others => '0');

  signal offered : std_logic := '0';
  signal offered_word : std_logic_vector(63 downto 0) := (others => '0');
  signal offered_last : std_logic := '0';
  signal free : std_logic;
  signal speaks : std_logic;  -- the pair becomes a word
  signal takes : std_logic;
begin
  -- ===== Reports that wait =====
  full <= '1' when report_in(2 downto 0) = report_out(2 downto 0) and report_in(3) /= report_out(3) else '0';
  some <= '1' when report_in /= report_out else '0';
  report_ready <= not full;
  accepts <= report_valid and not full;
  head <= report_memory(to_integer(report_out(2 downto 0)));

  keep : process (clk)
  begin
    if rising_edge(clk) then
      if accepts = '1' then
        report_memory(to_integer(report_in(2 downto 0))) <=
          std_logic_vector(sent_count) & report_reason & report_number & triangles_read & words_read;
      end if;
      if (reset or forget) = '1' then
        report_in <= "0000";
        report_out <= "0000";
        sent_count <= (others => '0');
        taken_count <= (others => '0');
      else
        if accepts = '1' then
          report_in <= report_in + 1;
        end if;
        if ends = '1' and reset_due = '0' then
          report_out <= report_out + 1;
        end if;
        if sent = '1' then
          sent_count <= sent_count + 1;
        end if;
        if takes = '1' then
          taken_count <= taken_count + 1;
        end if;
      end if;
      if reset = '1' then
        reset_due <= '0';
      elsif forget = '1' then
        reset_due <= '1';
        reset_number <= forget_number;
      elsif ends = '1' then
        reset_due <= '0';
      end if;
    end if;
  end process keep;

  -- ===== Words =====
  due <= '1' when reset_due = '1' or (some = '1' and std_logic_vector(taken_count) = head(mark_field)) else '0';
  free <= m_axis_tready or not offered;
  speaks <= '1' when verdict /= separate or separate_too = '1' else '0';
  takes <= tested_valid and not due and (free or not speaks);
  tested_taken <= takes;
  ends <= due and free when place = 7 else '0';
  reason <= reason_reset when reset_due = '1' else head(reason_field);
  number <= reset_number when reset_due = '1' else head(number_field);
  incomplete <= '0' when reason = reason_complete else '1';
  report_word <=
    x"00000000" & number & incomplete & reason & "11" when place = 0 else
    std_logic_vector(pairs) & x"00000000" when place = 2 else
    std_logic_vector(incorrect) & std_logic_vector(intersecting) when place = 3 else
    head(triangles_field) & std_logic_vector(pairs(30 downto 0)) & '0' when place = 5 else
    x"00000000" & head(words_field) when place = 6 else
    (others => '0');

  offer : process (clk)
  begin
    if rising_edge(clk) then
      if free = '1' then
        offered_word <= numbers & "000000" & verdict;
        offered_last <= '0';
        if due = '1' then
          offered_word <= report_word;
          offered_last <= ends;
        end if;
      end if;
      if reset = '1' then
        offered <= '0';
        place <= "000";
      elsif forget = '1' then
        offered <= offered and not free;
        place <= "000";
      elsif free = '1' then
        offered <= due or (tested_valid and speaks);
        if due = '1' then
          place <= place + 1;
        end if;
      end if;
      if takes = '1' then
        pairs <= pairs + 1;
        if verdict = certain then
          intersecting <= intersecting + 1;
        elsif verdict /= separate then
          incorrect <= incorrect + 1;
        end if;
      end if;
      if (reset or forget or ends) = '1' then
        pairs <= (others => '0');
        intersecting <= (others => '0');
        incorrect <= (others => '0');
      end if;
    end if;
  end process offer;
  m_axis_tdata <= offered_word;
  m_axis_tkeep <= (others => '1');
  m_axis_tvalid <= offered;
  m_axis_tlast <= offered_last;
end architecture rtl;
