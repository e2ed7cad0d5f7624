--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity {{ prefix }}efsat_stream is
  port (
    aclk : in std_logic;  -- all ports change with its rising edge
    aresetn : in std_logic;  -- synchronous to aclk, active low: for one clock at the least
    s_axis_tdata : in std_logic_vector({{ word }});
    s_axis_tkeep : in std_logic_vector({{ keep }}) := (others => '1');  -- ones where the source has none, or it is left open
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;  -- last word of a packet
    s_axis_tready : out std_logic;
    m_axis_tdata : out std_logic_vector({{ answer }});
    m_axis_tkeep : out std_logic_vector({{ answer_keep }});  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;  -- last answer to a packet
    m_axis_tready : in std_logic := '1'  -- left open where the sink takes an answer in every clock
  );
end entity {{ prefix }}efsat_stream;

architecture rtl of {{ prefix }}efsat_stream is
  constant pairs_header : std_logic_vector(31 downto 0) := x"{{ pairs_header }}";
{%- if has_pose %}
  constant pose_header : std_logic_vector(31 downto 0) := x"{{ pose_header }}";
{%- endif %}
  constant all_bytes : std_logic_vector({{ keep }}) := (others => '1');
  constant pair_words : natural := {{ pair_words }};
  constant pair_end : unsigned(5 downto 0) := to_unsigned(pair_words - 1, 6);  -- last word of a pair, counted from 0
{%- if has_pose %}
  constant pose_words : natural := {{ pose_words }};
  constant pose_end : unsigned(5 downto 0) := to_unsigned(pose_words - 1, 6);  -- last word of a pose
{%- endif %}

  -- What the next word is.
  type expectation_state is (header_state, pair_state, {% if has_pose %}pose_state, long_pose_state, {% endif %}broken_state, unknown_state);
  signal expectation : expectation_state := header_state;
  signal place : unsigned(5 downto 0) := "000000";  -- of the next word in its record
  signal running : std_logic := '0';  -- clear in reset
  signal reset : std_logic;
  signal header_word : std_logic_vector(31 downto 0);
  signal whole : std_logic;  -- no byte of the word is missing
  signal header_known : std_logic;
  signal at_pair_end : std_logic;
{%- if has_pose %}
  signal at_pose_end : std_logic;
{%- endif %}
  signal word_ready : std_logic;
  signal word_taken : std_logic;

  -- The last words taken, the latest in the high bits: a complete record until the unit has taken it.
  signal assembly : std_logic_vector({{ assembly_high }} downto 0) := (others => '0');
  signal pair_valid : std_logic := '0';  -- the record is a pair
  signal pair_ready : std_logic;
{%- if has_pose %}
  signal pose_valid : std_logic := '0';  -- the record is a pose
  signal pose_ready : std_logic;
{%- endif %}
  signal pair_leaves : std_logic;
{%- if has_pose %}
  signal pose_leaves : std_logic;
{%- endif %}
  signal vacant : std_logic;

  -- The answers owed, in order: bit 3 last of its packet, bit 2 a report, bits 1 downto 0 its reason.
{%- if signs.len() > 0 %} Of a pair bit 0
  -- says that a number of it or its pose does not fit.
{%- endif %}
  constant places : natural := {{ places }};
  constant place_bits : natural := {{ place_bits }};
  type order_words is array (0 to places - 1) of std_logic_vector(3 downto 0);
  signal order_memory : order_words := (others => "0000");
  signal order_entry : std_logic_vector(3 downto 0);
  signal order_write : std_logic;
  signal owed_count : unsigned(place_bits downto 0) := (others => '0');
  signal given_count : unsigned(place_bits downto 0) := (others => '0');
  signal order_full : std_logic;
  signal owing : std_logic;
  signal head : std_logic_vector(3 downto 0);

  signal out_valid : std_logic;
  signal out_ready : std_logic;
  signal out_verdict : std_logic_vector(1 downto 0);
{%- if tag_width > 0 %}
  signal out_tag : std_logic_vector({{ tag }});
{%- endif %}
  signal out_separated : std_logic_vector({{ flags }});
  signal out_overlapping : std_logic_vector({{ flags }});
{%- if guarded %}
  signal out_outside : std_logic;
{%- endif %}
{%- if signs.len() > 0 %}

  -- Numbers that are not the sign extension of what the unit reads of them.
  constant plus_signs : std_logic_vector({{ sign_high }} downto 0) := (others => '0');
  constant minus_signs : std_logic_vector({{ sign_high }} downto 0) := (others => '1');
  signal word_unfit : std_logic;
  signal record_unfit : std_logic;
  signal begun_unfit : std_logic := '0';  -- in the words of the record so far
{%- if has_pose %}
  signal next_pose_unfit : std_logic := '0';
  signal pose_unfit : std_logic := '0';
{%- endif %}
  signal pair_unfit : std_logic;
  signal flags_answer : std_logic_vector({{ flags_high }} downto 0);
  signal outside_answer : std_logic;
  signal code_answer : std_logic_vector(1 downto 0);
{%- endif %}
  constant report_zeros : std_logic_vector({{ report_zeros }}) := (others => '0');
  signal verdict_answer : std_logic_vector({{ answer }});
  signal report_answer : std_logic_vector({{ answer }});
  signal answer_valid : std_logic;
  signal answer_taken : std_logic;
begin
  reset <= not aresetn;

  -- ===== Words in =====
  header_word <= s_axis_tdata(31 downto 0);
  whole <= '1' when s_axis_tkeep = all_bytes else '0';
  at_pair_end <= whole when place = pair_end else '0';
{%- if has_pose %}
  at_pose_end <= whole when place = pose_end else '0';
{%- endif %}
  pair_leaves <= pair_valid and pair_ready;
{%- if has_pose %}
  pose_leaves <= pose_valid and pose_ready;
  vacant <= (not (pair_valid or pose_valid)) or pair_leaves or pose_leaves;
{%- else %}
  vacant <= (not pair_valid) or pair_leaves;
{%- endif %}
{%- if signs.len() > 0 %}
  word_unfit <= '1' when
{%- for sign in signs %}
    ({{ sign.when }} and s_axis_tdata({{ sign.high }} downto {{ sign.low }}) /= plus_signs and s_axis_tdata({{ sign.high }} downto {{ sign.low }}) /= minus_signs){% if !loop.last %} or{% endif %}
{%- endfor %}
    else '0';
  record_unfit <= begun_unfit or word_unfit;
  pair_unfit <= record_unfit{% if has_pose %} or pose_unfit{% endif %};
{%- endif %}
  word_ready <= running and vacant and not order_full;
  word_taken <= word_ready and s_axis_tvalid;
  s_axis_tready <= word_ready;

  receive : process (aclk)
  begin
    if rising_edge(aclk) then
      if word_taken = '1' then
        assembly <= {% if assembly_high >= width %}s_axis_tdata & assembly({{ assembly_high }} downto {{ width }}){% else %}s_axis_tdata{% endif %};
      end if;
      if aresetn = '0' then
        running <= '0';
        expectation <= header_state;
        place <= "000000";
{%- if signs.len() > 0 %}
        begun_unfit <= '0';
{%- if has_pose %}
        pose_unfit <= '0';
{%- endif %}
{%- endif %}
        pair_valid <= '0';
{%- if has_pose %}
        pose_valid <= '0';
{%- endif %}
      else
        running <= '1';
        if pair_leaves = '1' then
          pair_valid <= '0';
        end if;
{%- if has_pose %}
        if pose_leaves = '1' then
          pose_valid <= '0';
{%- if signs.len() > 0 %}
          -- With the bypass the numbers are not read.
          pose_unfit <= next_pose_unfit and not assembly({{ bypass_place }});
{%- endif %}
        end if;
{%- endif %}
        if word_taken = '1' then
          place <= place + 1;
{%- if signs.len() > 0 %}
          begun_unfit <= record_unfit;
{%- endif %}
          -- Not a case: GHDL 2.0 forgets the last arm of one in its Verilog.
          if expectation = header_state then
            place <= "000000";
{%- if signs.len() > 0 %}
            begun_unfit <= '0';
{%- endif %}
            if whole = '0' then
              expectation <= unknown_state;
            elsif header_word = pairs_header then
              expectation <= pair_state;
{%- if has_pose %}
            elsif header_word = pose_header then
              expectation <= pose_state;
{%- endif %}
            else
              expectation <= unknown_state;
            end if;
          elsif expectation = pair_state then
            if at_pair_end = '1' then
              pair_valid <= '1';
              place <= "000000";
{%- if signs.len() > 0 %}
              begun_unfit <= '0';
{%- endif %}
            elsif whole = '0' then
              expectation <= broken_state;
            end if;
{%- if has_pose %}
          elsif expectation = pose_state then
            if at_pose_end = '1' then
              pose_valid <= s_axis_tlast;
{%- if signs.len() > 0 %}
              next_pose_unfit <= record_unfit;
{%- endif %}
              expectation <= long_pose_state;
            elsif whole = '0' then
              expectation <= broken_state;
            end if;
{%- endif %}
          end if;
          if s_axis_tlast = '1' then
            expectation <= header_state;
          end if;
        end if;
      end if;
    end if;
  end process receive;

  -- ===== Answers owed =====
  -- A pair owes a verdict, the end of a packet that is no pair's a report.
  header_known <= '1' when whole = '1' and (header_word = pairs_header{% if has_pose %} or header_word = pose_header{% endif %}) else '0';
  order_entry <= s_axis_tlast & {% if signs.len() > 0 %}"00" & pair_unfit{% else %}"000"{% endif %} when expectation = pair_state and at_pair_end = '1' else
{%- if has_pose %}
    "1100" when expectation = pose_state and at_pose_end = '1' else
    "1111" when expectation = long_pose_state else
{%- endif %}
    "1110" when expectation = pair_state or expectation = broken_state{% if has_pose %} or expectation = pose_state{% endif %} else
    "1110" when expectation = header_state and header_known = '1' else
    "1101";

  order_write <= word_taken and (s_axis_tlast or at_pair_end) when expectation = pair_state else
    word_taken and s_axis_tlast;
  order_full <= '1' when owed_count(owed_count'high) /= given_count(given_count'high)
    and owed_count(place_bits - 1 downto 0) = given_count(place_bits - 1 downto 0) else '0';
  owing <= '1' when owed_count /= given_count else '0';
  head <= order_memory(to_integer(given_count(place_bits - 1 downto 0)));

  keep_order : process (aclk)
  begin
    if rising_edge(aclk) then
      if order_write = '1' then
        order_memory(to_integer(owed_count(place_bits - 1 downto 0))) <= order_entry;
      end if;
      if aresetn = '0' then
        owed_count <= (others => '0');
        given_count <= (others => '0');
      else
        if order_write = '1' then
          owed_count <= owed_count + 1;
        end if;
        if answer_taken = '1' then
          given_count <= given_count + 1;
        end if;
      end if;
    end if;
  end process keep_order;

  -- ===== The unit =====
  unit : entity work.{{ prefix }}efsat
    port map (
      clk => aclk,
      reset => reset,
      in_valid => pair_valid,
      in_ready => pair_ready,
{%- for field in unit_inputs %}
      {{ field.port }} => assembly({{ field.place }}),
{%- endfor %}
{%- if has_pose %}
      pose_valid => pose_valid,
      pose_ready => pose_ready,
{%- endif %}
{%- if tag_width > 0 %}
      out_tag => out_tag{% if tag_width == 1 %}(0){% endif %},
{%- endif %}
      out_valid => out_valid,
      out_ready => out_ready,
      out_verdict => out_verdict,
      out_separated => out_separated,
      out_overlapping => out_overlapping{% if guarded %},
      out_outside => out_outside{% endif %}
    );

  -- ===== Answers out =====
{%- if signs.len() > 0 %}
  flags_answer <= (others => '0') when head(0) = '1' else out_overlapping & out_separated;
  outside_answer <= out_outside or head(0);
  code_answer <= "10" when head(0) = '1' else out_verdict;
  verdict_answer <= {% if unused > 0 %}"{{ unused_zeros }}" & {% endif %}flags_answer & {% if tag_width > 0 %}out_tag & {% endif %}"000" & outside_answer & "00" & code_answer;
{%- else %}
  verdict_answer <= {% if unused > 0 %}"{{ unused_zeros }}" & {% endif %}out_overlapping & out_separated & {% if tag_width > 0 %}out_tag & {% endif %}{% if guarded %}"000" & out_outside & "00"{% else %}"000000"{% endif %} & out_verdict;
{%- endif %}
  report_answer <= report_zeros & (head(1) or head(0)) & "000" & head(1 downto 0) & "11";
  answer_valid <= owing and (head(2) or out_valid);
  answer_taken <= answer_valid and m_axis_tready;
  out_ready <= answer_taken and not head(2);
  m_axis_tvalid <= answer_valid;
  m_axis_tlast <= head(3);
  m_axis_tkeep <= (others => '1');
  m_axis_tdata <= report_answer when head(2) = '1' else verdict_answer;
end architecture rtl;
