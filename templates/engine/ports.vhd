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
{%- if let Some(id) = e.memory.id %}
    m_axi_arid : out std_logic_vector({{ id }});  -- always 0
{%- endif %}
    m_axi_araddr : out std_logic_vector(31 downto 0);
    m_axi_arlen : out std_logic_vector(7 downto 0);  -- beats of the burst less one
    m_axi_arsize : out std_logic_vector(2 downto 0);  -- always whole words
    m_axi_arburst : out std_logic_vector(1 downto 0);  -- always INCR
    m_axi_arcache : out std_logic_vector(3 downto 0);  -- always 0011: normal, not cacheable, bufferable
    m_axi_arprot : out std_logic_vector(2 downto 0);  -- always 000: data, secure, not privileged
    m_axi_arvalid : out std_logic;
    m_axi_arready : in std_logic;
{%- if let Some(id) = e.memory.id %}
    m_axi_rid : in std_logic_vector({{ id }}) := (others => '0');  -- not read: with one ID words come in order
{%- endif %}
    m_axi_rdata : in std_logic_vector({{ e.memory.word }});
    m_axi_rresp : in std_logic_vector(1 downto 0);
    m_axi_rlast : in std_logic;
    m_axi_rvalid : in std_logic;
    m_axi_rready : out std_logic;  -- always set
{%- endif %}
    m_axis_tdata : out std_logic_vector(63 downto 0);
    m_axis_tkeep : out std_logic_vector(7 downto 0);  -- always ones
    m_axis_tvalid : out std_logic;
    m_axis_tlast : out std_logic;  -- last word of an answer
    m_axis_tready : in std_logic
