--------------------------------------------------------------------------------
{% for line in header %}--{% if line.len() > 0 %} {{ line }}{% endif %}
{% endfor -%}
--
-- The numbers of the queries in flight, and which of them stops have ended: of those with the number of a stop the oldest that is
-- not reported, or else the job that waits. Numbers are compared in one clock, and looked for in the next; then the oldest that was
-- found is stopped. A job that is taken meanwhile is found in its lane.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.{{ prefix }}engine_layout.all;

entity {{ prefix }}engine_stop is
  port (
    clk : in std_logic;
    reset : in std_logic;
    forget : in std_logic;  -- a soft reset: its number is that of the oldest lane
    forget_number : in std_logic_vector(23 downto 0);
    job_valid : in std_logic;
    job_query : in std_logic;
    job_number : in std_logic_vector(23 downto 0);
    job_taken : in std_logic;
    job_flags : in lane_flags;  -- a flag for each lane: it gets that one
    stop : in std_logic;
    stop_number : in std_logic_vector(23 downto 0);
    oldest : in unsigned(lane_bits - 1 downto 0);
    oldest_flags : in lane_flags;  -- the same, a flag for each lane
    counting : in lane_flags;  -- lanes with a query that is not reported yet
    retire : in std_logic;  -- the oldest query is done
    number : out std_logic_vector(23 downto 0);  -- of the oldest
    stopped : out lane_flags  -- lanes that a stop was for
  );
end entity {{ prefix }}engine_stop;

architecture rtl of {{ prefix }}engine_stop is
  constant no_lane : lane_flags := (others => '0');
  type lane_numbers is array (0 to lanes - 1) of std_logic_vector(23 downto 0);
  signal numbers : lane_numbers := (others => (others => '0'));
  signal order : unsigned(lane_bits - 1 downto 0) := (others => '0');  -- the oldest lane, a clock ago: the one that is free since then is not found, and the others come in the same order
  signal due : std_logic := '0';
  signal same_job : std_logic;
  signal same_job_before : std_logic := '0';
  signal same : lane_flags := (others => '0');  -- lanes whose number it is
  signal moved : lane_flags := (others => '0');  -- lanes that got a job a clock ago: same_job_before says whether its number is meant
  signal found : lane_flags := (others => '0');  -- lanes with such a query
  signal found_job : std_logic := '0';  -- the job that waits has it
  signal first : lane_flags;  -- the oldest of those lanes
  signal stopped_now : lane_flags := (others => '0');
  signal waiting_stopped : std_logic := '0';  -- a stop was for the job that waits
  signal forgotten : std_logic;
begin
  forgotten <= reset or forget;
  stopped <= stopped_now;
  number <= numbers(to_integer(oldest));
  same_job <= job_valid and job_query when job_number = stop_number else '0';

  match : for lane in 0 to lanes - 1 generate
    signal earlier : lane_flags;  -- older queries with that number
  begin
    by_age : for other in 0 to lanes - 1 generate
      earlier(other) <= found(other) when other - order < lane - order else '0';
    end generate by_age;
    first(lane) <= found(lane) when earlier = no_lane else '0';
  end generate match;

  compare : process (clk)
  begin
    if rising_edge(clk) then
      order <= oldest;
      due <= stop and not forgotten;
      same_job_before <= same_job;
      found_job <= due and same_job_before and job_valid and not job_taken and not forgotten;
      for lane in 0 to lanes - 1 loop
        same(lane) <= '0';
        if numbers(lane) = stop_number then
          same(lane) <= '1';
        end if;
        moved(lane) <= job_taken and job_flags(lane);
        found(lane) <= due and same(lane) and counting(lane) and not forgotten;
        if moved(lane) = '1' then
          found(lane) <= due and same_job_before and counting(lane) and not forgotten;
        end if;
        if job_taken = '1' and job_flags(lane) = '1' then
          numbers(lane) <= job_number;
          found(lane) <= due and same_job_before and not forgotten;
        end if;
        if forget = '1' and oldest_flags(lane) = '1' then
          numbers(lane) <= forget_number;
        end if;
      end loop;
    end if;
  end process compare;

  keep : process (clk)
    variable job_stopped : std_logic;
  begin
    if rising_edge(clk) then
      job_stopped := waiting_stopped;
      if first = no_lane then
        job_stopped := waiting_stopped or found_job;
      end if;
      waiting_stopped <= job_stopped and not job_taken and not forgotten;
      for lane in 0 to lanes - 1 loop
        stopped_now(lane) <= (stopped_now(lane) or first(lane)) and not forgotten;
        if job_taken = '1' and job_flags(lane) = '1' then
          stopped_now(lane) <= job_stopped and not forgotten;
        end if;
        if retire = '1' and oldest_flags(lane) = '1' then
          stopped_now(lane) <= '0';
        end if;
      end loop;
    end if;
  end process keep;
end architecture rtl;
