    aclk : in std_logic;
    -- Synchronous, active low; hold it for at least 16 clocks. It forgets everything{% if e.axi %}, also the bursts that are under way: reset the
    -- memory and what is between with it, or use soft_reset{% endif %}.
    aresetn : in std_logic;
    -- Forgets all work at any time, for as long as it is set, {% if e.axi %}and drops what memory still answers{% else %}and keeps the memory{% endif %}; then a report says so.
    soft_reset : in std_logic := '0';
    s_axis_tdata : in std_logic_vector(63 downto 0);
    s_axis_tkeep : in std_logic_vector(7 downto 0) := (others => '1');
    s_axis_tvalid : in std_logic;
    s_axis_tlast : in std_logic;  -- last word of a packet
    s_axis_tready : out std_logic;
{%- if e.axi %}
{%- include "engine/read_ports.vhd" %}
{%- endif %}
    m_axis_tdata : out std_logic_vector(63 downto 0);
    m_axis_tkeep : out std_logic_vector(7 downto 0);  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;  -- last word of an answer
    m_axis_tready : in std_logic
