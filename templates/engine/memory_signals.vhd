  signal memory_resetn : std_logic := '0';  -- of the memory alone, together with the engine's aresetn and never with a soft reset
  signal araddr : std_logic_vector(31 downto 0);
  signal arlen : std_logic_vector(7 downto 0);
  signal arsize : std_logic_vector(2 downto 0);
  signal arburst : std_logic_vector(1 downto 0);
  signal arcache : std_logic_vector(3 downto 0);
  signal arprot : std_logic_vector(2 downto 0);
  signal arvalid : std_logic;
  signal arready : std_logic := '0';
  signal rdata : std_logic_vector({{ e.memory.word }}) := (others => '0');
  signal rresp : std_logic_vector(1 downto 0) := "00";
  signal rlast : std_logic := '0';
  signal rvalid : std_logic := '0';
  signal rready : std_logic;
  signal broken : natural := 0;  -- rules of AXI
  signal rewrites : std_logic := '0';  -- memory is written
  signal rewritten_address : std_logic_vector(31 downto 0) := (others => '0');
  signal rewritten_word : word_64 := (others => '0');
