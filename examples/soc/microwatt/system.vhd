-- A system in VHDL: the processor Microwatt, memory, a console, and two cores of efsat behind their registers.
--
--   0x00000000  memory, with the program
--   0xc0000000  registers of pairs_efsat_shell, the unit
--   0xc0001000  registers of efsat_shell, the engine, which reads trees from the memory of the processor
--   0xc0002000  console: a byte written goes out; read, bit 0 is the interrupt of the unit, bit 1 that of the engine
--
-- Microwatt's packages are VHDL-2008; so is this file. The cores are VHDL-93.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.wishbone_types.all;

entity system is
  generic (
    PROGRAM : string;  -- a line of 16 hexadecimal digits per word of 64 bits, from address 0
    MEMORY_WORDS : positive := 32768  -- a power of two
  );
  port (
    clock : in std_ulogic;
    reset : in std_ulogic;
    console : out std_ulogic_vector(7 downto 0);
    console_valid : out std_ulogic
  );
end entity system;

architecture rtl of system is
  -- Who reads and writes, the first before the others: data and instructions of the processor, the engine.
  signal masters : wishbone_master_out_vector(0 to 2);
  signal to_masters : wishbone_slave_out_vector(0 to 2);
  signal bus_out, snooped : wishbone_master_out;
  signal bus_in, from_memory, from_io : wishbone_slave_out;
  signal is_io, interrupt : std_ulogic;

  -- AXI4-Lite of both cores: 0 is the unit, 1 the engine.
  type words is array (natural range <>) of std_logic_vector(31 downto 0);
  type responses is array (natural range <>) of std_logic_vector(1 downto 0);
  signal address : std_logic_vector(11 downto 0);
  signal write_data : std_logic_vector(31 downto 0);
  signal write_strobes : std_logic_vector(3 downto 0);
  signal awvalid, awready, wvalid, wready, bvalid, arvalid, arready, rvalid, irq : std_logic_vector(0 to 1);
  signal rdata : words(0 to 1);
  signal bresp, rresp : responses(0 to 1);

  -- AXI4 of the engine.
  signal m_araddr : std_logic_vector(31 downto 0);
  signal m_arlen : std_logic_vector(7 downto 0);
  signal m_arvalid, m_arready, m_rlast, m_rvalid : std_logic;
  signal m_rdata : std_logic_vector(63 downto 0);
  signal m_rresp : std_logic_vector(1 downto 0);
  signal fetching, outside : std_ulogic;
  signal left : unsigned(7 downto 0);
  signal resetn : std_logic;
begin
  resetn <= not reset;
  interrupt <= irq(0) or irq(1);

  processor : entity work.core
    generic map (LOG_LENGTH => 0)
    port map (
      clk => clock,
      rst => reset,
      alt_reset => '0',
      wishbone_data_out => masters(0),
      wishbone_data_in => to_masters(0),
      wishbone_insn_out => masters(1),
      wishbone_insn_in => to_masters(1),
      wb_snoop_in => snooped,
      dmi_addr => (others => '0'),
      dmi_din => (others => '0'),
      dmi_dout => open,
      dmi_req => '0',
      dmi_wr => '0',
      dmi_ack => open,
      ext_irq => interrupt,
      terminated_out => open
    );

  arbiter : entity work.wishbone_arbiter
    generic map (NUM_MASTERS => 3)
    port map (
      clk => clock,
      rst => reset,
      wb_masters_in => masters,
      wb_masters_out => to_masters,
      wb_slave_out => bus_out,
      wb_slave_in => bus_in
    );

  is_io <= bus_out.adr(28) and bus_out.adr(27);
  bus_in <= from_io when is_io = '1' else from_memory;

  -- The caches of the processor watch what others write; a request that waits is not seen twice.
  snoop : process (all)
  begin
    snooped <= bus_out;
    snooped.stb <= bus_out.stb and not bus_in.stall;
  end process snoop;

  memory : process (clock)
    type contents is array (0 to MEMORY_WORDS - 1) of std_ulogic_vector(63 downto 0);

    impure function loaded return contents is
      file source : text open read_mode is PROGRAM;
      variable row : line;
      variable word : std_logic_vector(63 downto 0);
      variable all_words : contents := (others => (others => '0'));
      variable i : natural := 0;
    begin
      while not endfile(source) loop
        readline(source, row);
        hread(row, word);
        all_words(i) := word;
        i := i + 1;
      end loop;
      return all_words;
    end function loaded;

    variable word : contents := loaded;
    variable i : natural range 0 to MEMORY_WORDS - 1;
  begin
    if rising_edge(clock) then
      from_memory.ack <= '0';
      if bus_out.cyc = '1' and bus_out.stb = '1' and is_io = '0' and reset = '0' then
        i := to_integer(unsigned(bus_out.adr)) mod MEMORY_WORDS;
        if bus_out.we = '1' then
          for byte in 0 to 7 loop
            if bus_out.sel(byte) = '1' then
              word(i)(8 * byte + 7 downto 8 * byte) := bus_out.dat(8 * byte + 7 downto 8 * byte);
            end if;
          end loop;
        end if;
        from_memory.dat <= word(i);
        from_memory.ack <= '1';
      end if;
    end if;
  end process memory;

  from_memory.stall <= '0';

  -- Wishbone to AXI4-Lite: one access of 32 bits at a time, in the half of the word that is selected.
  io : process (clock)
    type states is (IDLE, WRITE, READ);
    variable state : states;
    variable high : boolean;
    variable target : natural range 0 to 3;

    procedure answer(word : std_ulogic_vector(31 downto 0)) is
    begin
      from_io.dat <= word & word;
      from_io.ack <= '1';
      from_io.stall <= '0';
      state := IDLE;
    end procedure answer;
  begin
    if rising_edge(clock) then
      from_io.ack <= '0';
      console_valid <= '0';
      if reset = '1' then
        state := IDLE;
        from_io.stall <= '0';
        awvalid <= "00";
        wvalid <= "00";
        arvalid <= "00";
      else
        awvalid <= awvalid and not awready;
        wvalid <= wvalid and not wready;
        arvalid <= arvalid and not arready;
        case state is
          when IDLE =>
            if bus_out.cyc = '1' and bus_out.stb = '1' and is_io = '1' then
              assert bus_out.sel(7 downto 4) = "0000" or bus_out.sel(3 downto 0) = "0000"
                report "registers have 32 bits" severity failure;
              from_io.stall <= '1';
              high := bus_out.sel(7 downto 4) /= "0000";
              target := to_integer(unsigned(bus_out.adr(10 downto 9)));
              address <= bus_out.adr(8 downto 0) & "000";
              write_data <= bus_out.dat(31 downto 0);
              write_strobes <= bus_out.sel(3 downto 0);
              if high then
                address(2) <= '1';
                write_data <= bus_out.dat(63 downto 32);
                write_strobes <= bus_out.sel(7 downto 4);
              end if;
              if target > 1 then
                console <= bus_out.dat(7 downto 0);
                console_valid <= bus_out.we;
                answer((0 => irq(0), 1 => irq(1), others => '0'));
              elsif bus_out.we = '1' then
                awvalid(target) <= '1';
                wvalid(target) <= '1';
                state := WRITE;
              else
                arvalid(target) <= '1';
                state := READ;
              end if;
            end if;
          when WRITE =>
            if bvalid(target) = '1' then
              assert bresp(target) = "00" report "a write is refused" severity failure;
              answer((others => '0'));
            end if;
          when READ =>
            if rvalid(target) = '1' then
              assert rresp(target) = "00" report "a read is refused" severity failure;
              answer(rdata(target));
            end if;
        end case;
      end if;
    end if;
  end process io;

  pairs : entity work.pairs_efsat_shell
    port map (
      aclk => clock,
      aresetn => resetn,
      s_axi_awaddr => address,
      s_axi_awvalid => awvalid(0),
      s_axi_awready => awready(0),
      s_axi_wdata => write_data,
      s_axi_wstrb => write_strobes,
      s_axi_wvalid => wvalid(0),
      s_axi_wready => wready(0),
      s_axi_bresp => bresp(0),
      s_axi_bvalid => bvalid(0),
      s_axi_bready => '1',
      s_axi_araddr => address,
      s_axi_arvalid => arvalid(0),
      s_axi_arready => arready(0),
      s_axi_rdata => rdata(0),
      s_axi_rresp => rresp(0),
      s_axi_rvalid => rvalid(0),
      s_axi_rready => '1',
      irq => irq(0)
    );

  queries : entity work.efsat_shell
    port map (
      aclk => clock,
      aresetn => resetn,
      s_axi_awaddr => address,
      s_axi_awvalid => awvalid(1),
      s_axi_awready => awready(1),
      s_axi_wdata => write_data,
      s_axi_wstrb => write_strobes,
      s_axi_wvalid => wvalid(1),
      s_axi_wready => wready(1),
      s_axi_bresp => bresp(1),
      s_axi_bvalid => bvalid(1),
      s_axi_bready => '1',
      s_axi_araddr => address,
      s_axi_arvalid => arvalid(1),
      s_axi_arready => arready(1),
      s_axi_rdata => rdata(1),
      s_axi_rresp => rresp(1),
      s_axi_rvalid => rvalid(1),
      s_axi_rready => '1',
      m_axi_araddr => m_araddr,
      m_axi_arlen => m_arlen,
      m_axi_arsize => open,
      m_axi_arburst => open,
      m_axi_arcache => open,
      m_axi_arprot => open,
      m_axi_arvalid => m_arvalid,
      m_axi_arready => m_arready,
      m_axi_rdata => m_rdata,
      m_axi_rresp => m_rresp,
      m_axi_rlast => m_rlast,
      m_axi_rvalid => m_rvalid,
      m_axi_rready => open,
      irq => irq(1)
    );

  -- AXI4 to Wishbone: a burst word by word. What is not memory is answered by a decode error, which the engine reports.
  fetch : process (clock)
  begin
    if rising_edge(clock) then
      if reset = '1' then
        fetching <= '0';
        masters(2).stb <= '0';
      elsif fetching = '0' then
        fetching <= m_arvalid;
        masters(2).stb <= m_arvalid;
        masters(2).adr <= m_araddr(31 downto 3);
        left <= unsigned(m_arlen);
        outside <= '0';
        if unsigned(m_araddr(31 downto 3)) >= MEMORY_WORDS then
          outside <= m_arvalid;
        end if;
      else
        masters(2).stb <= masters(2).stb and to_masters(2).stall;
        if m_rvalid = '1' then
          masters(2).stb <= not m_rlast;
          masters(2).adr <= std_ulogic_vector(unsigned(masters(2).adr) + 1);
          left <= left - 1;
          fetching <= not m_rlast;
        end if;
      end if;
    end if;
  end process fetch;

  masters(2).cyc <= fetching and not outside;
  masters(2).we <= '0';
  masters(2).sel <= x"ff";
  masters(2).dat <= (others => '0');
  m_arready <= not fetching;
  m_rvalid <= fetching and (to_masters(2).ack or outside);
  m_rlast <= '1' when left = 0 else '0';
  m_rdata <= to_masters(2).dat;
  m_rresp <= outside & outside;
end architecture rtl;
