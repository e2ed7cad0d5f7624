{%- for port in read_ports %}
{%- if let Some(id) = e.memory.id %}
    m{{ port }}_axi_arid : out std_logic_vector({{ id }});  -- always 0
{%- endif %}
    m{{ port }}_axi_araddr : out std_logic_vector(31 downto 0);
    m{{ port }}_axi_arlen : out std_logic_vector(7 downto 0);  -- beats of the burst less one
    m{{ port }}_axi_arsize : out std_logic_vector(2 downto 0);  -- always whole words
    m{{ port }}_axi_arburst : out std_logic_vector(1 downto 0);  -- always INCR
    m{{ port }}_axi_arcache : out std_logic_vector(3 downto 0);  -- always 0011: normal, not cacheable, bufferable
    m{{ port }}_axi_arprot : out std_logic_vector(2 downto 0);  -- always 000: data, secure, not privileged
    m{{ port }}_axi_arvalid : out std_logic;
    m{{ port }}_axi_arready : in std_logic;
{%- if let Some(id) = e.memory.id %}
    m{{ port }}_axi_rid : in std_logic_vector({{ id }}) := (others => '0');  -- not read: with one ID words come in order
{%- endif %}
    m{{ port }}_axi_rdata : in std_logic_vector({{ e.memory.word }});
    m{{ port }}_axi_rresp : in std_logic_vector(1 downto 0);
    m{{ port }}_axi_rlast : in std_logic;
    m{{ port }}_axi_rvalid : in std_logic;
    m{{ port }}_axi_rready : out std_logic;  -- always set
{%- endfor %}
