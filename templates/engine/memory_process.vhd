  -- Memory: bursts are answered in order, each not before its latency is over.
{%- for port in read_ports %}
  memory{{ port }} : process
{%- if e.memory.memory_width > 32 %}
    constant beat_words : natural := {{ e.memory.memory_words }};
{%- endif %}
    constant most_bursts : natural := 64;
    constant most_faults : natural := 64;
    type memory_words is array (natural range <>) of word_64;
    type memory_pointer is access memory_words;
    type flags is array (natural range <>) of boolean;
    type flags_pointer is access flags;
    type numbers is array (natural range <>) of natural;
    file source : text;
    variable l : line;
    variable c : character;
    variable address : std_logic_vector(31 downto 0);
    variable word : word_64;
    variable kind : std_logic_vector(3 downto 0);
    variable words : memory_pointer;
    variable known : flags_pointer;
    variable size : natural := 0;
    variable fault_address : numbers(0 to most_faults - 1);
    variable fault_kind : numbers(0 to most_faults - 1);
    variable fault_pass : numbers(0 to most_faults - 1) := (others => 0);  -- the last in which it has happened
    variable faults : natural := 0;
    variable burst_address : numbers(0 to most_bursts - 1);  -- in words of 64 bits
    variable burst_beats : numbers(0 to most_bursts - 1);
    variable burst_due : numbers(0 to most_bursts - 1);
    variable burst_fault : numbers(0 to most_bursts - 1);
    variable first : natural := 0;
    variable waiting : natural := 0;
    variable beat : natural := 0;
    variable beats : natural;
    variable clock : natural := 0;
    variable random : unsigned(15 downto 0);
    variable held_address : std_logic_vector(31 downto 0);
    variable holding : boolean := false;
    variable place : natural;
    variable errors : natural := 0;

    procedure complain(what : in string) is
    begin
      errors := errors + 1;
      broken{{ port }} <= errors;
      assert false report "{{ prefix }}{{ bench }}: " & what severity error;
    end procedure complain;

    -- Half of a word of 64 bits in 32-bit memories, else whole ones.
    procedure read_beat(from : in natural; number : in natural) is
    begin
{%- if e.memory.memory_width == 32 %}
      place := from + number / 2;
      if place < size then
        word := words(place);
        if number mod 2 = 0 then
          rdata{{ port }} <= word(31 downto 0);
        else
          rdata{{ port }} <= word(63 downto 32);
        end if;
      end if;
{%- else %}
      for i in 0 to beat_words - 1 loop
        place := from + beat_words * number + i;
        if place < size then
          rdata{{ port }}(64 * i + 63 downto 64 * i) <= words(place);
        end if;
      end loop;
{%- endif %}
    end procedure read_beat;
  begin
    -- The size, then the words.
    file_open(source, vectors, read_mode);
    while not endfile(source) loop
      readline(source, l);
      if l'length > 0 then
        read(l, c);
        if c = 'M' then
          read_word(l, address);
          if to_integer(unsigned(address(30 downto 0))) >= size then
            size := to_integer(unsigned(address(30 downto 0))) + 1;
          end if;
        end if;
      end if;
    end loop;
    file_close(source);
    words := new memory_words(0 to size);
    known := new flags(0 to size);
    for i in 0 to size loop
      known(i) := false;
      words(i) := (others => '0');
    end loop;
    file_open(source, vectors, read_mode);
    while not endfile(source) loop
      readline(source, l);
      if l'length > 0 then
        read(l, c);
        if c = 'M' then
          read_word(l, address);
          read_word(l, word);
          words(to_integer(unsigned(address(30 downto 0)))) := word;
          known(to_integer(unsigned(address(30 downto 0)))) := true;
        elsif c = 'X' then
          read_word(l, address);
          read_word(l, kind);
          fault_address(faults) := to_integer(unsigned(address(30 downto 0)));
          fault_kind(faults) := to_integer(unsigned(kind));
          faults := faults + 1;
        end if;
      end if;
    end loop;
    file_close(source);
    random := to_unsigned(seed, 16) xor x"5a17";
    loop
      wait until rising_edge(clk);
      clock := clock + 1;
      random := following(random);
      exit when done;
      if rewrites = '1' then
        words(to_integer(unsigned(rewritten_address(30 downto 0)))) := rewritten_word;
      end if;
      if memory_resetn = '0' then
        waiting := 0;
        beat := 0;
        holding := false;
        rvalid{{ port }} <= '0';
        arready{{ port }} <= '0';
      else
        -- Addresses
        if holding and (arvalid{{ port }} /= '1' or araddr{{ port }} /= held_address) then
          complain("an address changed before it was taken");
        end if;
        holding := arvalid{{ port }} = '1' and arready{{ port }} = '0';
        held_address := araddr{{ port }};
        if (arvalid{{ port }} and arready{{ port }}) = '1' then
          beats := to_integer(unsigned(arlen{{ port }})) + 1;
          place := to_integer(unsigned(araddr{{ port }}(30 downto 3)));
          if arcache{{ port }} /= "0011" or arprot{{ port }} /= "000" then
            complain("another kind of access");
          end if;
          if arburst{{ port }} /= "01" or arsize{{ port }} /= "{{ e.memory.memory_size }}" or araddr{{ port }}(5 downto 0) /= "000000" or {{ e.memory.memory_bytes }} * beats > 64 then
            complain("a burst that is not within 64 bytes");
          end if;
          for i in 0 to ({{ e.memory.memory_bytes }} * beats + 7) / 8 - 1 loop
            if araddr{{ port }}(31) = '1' or place + i >= size then
              complain("a read outside the memory");
              exit;
            elsif not known(place + i) then
              complain("a read outside the images");
              exit;
            end if;
          end loop;
          if waiting = most_bursts then
            complain("too many bursts");
          else
            burst_address((first + waiting) mod most_bursts) := place;
            burst_beats((first + waiting) mod most_bursts) := beats;
            burst_due((first + waiting) mod most_bursts) :=
              clock + latency_least - 1 + to_integer(random(9 downto 0)) mod (latency_most - latency_least + 1);
            burst_fault((first + waiting) mod most_bursts) := 0;
            for i in 0 to faults - 1 loop
              if fault_address(i) = place / 8 and fault_pass(i) < pass then
                fault_pass(i) := pass;
                burst_fault((first + waiting) mod most_bursts) := fault_kind(i);
                if fault_kind(i) = 4 then
                  burst_due((first + waiting) mod most_bursts) := clock + hang;
                end if;
              end if;
            end loop;
            waiting := waiting + 1;
          end if;
        end if;
        arready{{ port }} <= '1';
        if pass > 1 then
          -- A memory may wait for an address before it is ready; who offers one must not wait for that.
          arready{{ port }} <= arvalid{{ port }} and (random(3) or random(7));
        end if;
        -- Words
        if (rvalid{{ port }} and not rready{{ port }}) = '1' then
          complain("RREADY is not set");
        end if;
        rvalid{{ port }} <= '0';
        rlast{{ port }} <= '0';
        rresp{{ port }} <= "00";
        if waiting > 0 and burst_due(first) <= clock and (pass = 1 or random(5) = '1' or random(11) = '1') then
          read_beat(burst_address(first), beat);
          rvalid{{ port }} <= '1';
          if burst_fault(first) = 1 and beat = 1 mod burst_beats(first) then
            rresp{{ port }} <= "10";
          end if;
          beat := beat + 1;
          -- A word less or more than asked for.
          if (burst_fault(first) = 2 and beat + 1 >= burst_beats(first)) or (burst_fault(first) = 3 and beat > burst_beats(first))
            or (burst_fault(first) /= 2 and burst_fault(first) /= 3 and beat = burst_beats(first)) then
            if burst_fault(first) /= 5 then
              rlast{{ port }} <= '1';
            end if;
            beat := 0;
            first := (first + 1) mod most_bursts;
            waiting := waiting - 1;
          end if;
        end if;
      end if;
    end loop;
    wait;
  end process memory{{ port }};
{%- endfor %}
