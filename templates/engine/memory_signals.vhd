  signal memory_resetn : std_logic := '0';  -- of the memory alone, together with the engine's aresetn and never with a soft reset
{%- for port in read_ports %}
  signal araddr{{ port }} : std_logic_vector(31 downto 0);
  signal arlen{{ port }} : std_logic_vector(7 downto 0);
  signal arsize{{ port }} : std_logic_vector(2 downto 0);
  signal arburst{{ port }} : std_logic_vector(1 downto 0);
  signal arcache{{ port }} : std_logic_vector(3 downto 0);
  signal arprot{{ port }} : std_logic_vector(2 downto 0);
  signal arvalid{{ port }} : std_logic;
  signal arready{{ port }} : std_logic := '0';
  signal rdata{{ port }} : std_logic_vector({{ e.memory.word }}) := (others => '0');
  signal rresp{{ port }} : std_logic_vector(1 downto 0) := "00";
  signal rlast{{ port }} : std_logic := '0';
  signal rvalid{{ port }} : std_logic := '0';
  signal rready{{ port }} : std_logic;
  signal broken{{ port }} : natural := 0;  -- rules of AXI
{%- endfor %}
  signal rewrites : std_logic := '0';  -- memory is written
  signal rewritten_address : std_logic_vector(31 downto 0) := (others => '0');
  signal rewritten_word : word_64 := (others => '0');
