  -- The hexadecimal digits of a word, after a space.
  procedure read_word(l : inout line; word : out std_logic_vector) is
    constant digits : natural := word'length / 4;
    variable bits : std_logic_vector(word'length - 1 downto 0);
    variable c : character;
    variable nibble : natural;
  begin
    read(l, c);
    for i in digits - 1 downto 0 loop
      read(l, c);
      case c is
        when '0' to '9' => nibble := character'pos(c) - character'pos('0');
        when 'a' to 'f' => nibble := character'pos(c) - character'pos('a') + 10;
        when others =>
          nibble := 0;
          assert false report "{{ prefix }}{{ bench }}: no hexadecimal digit: " & c severity failure;
      end case;
      bits(4 * i + 3 downto 4 * i) := std_logic_vector(to_unsigned(nibble, 4));
    end loop;
    word := bits;
  end procedure read_word;

  procedure write_word(l : inout line; word : in std_logic_vector) is
    constant hex : string(1 to 16) := "0123456789abcdef";
    constant digits : natural := word'length / 4;
    variable bits : std_logic_vector(word'length - 1 downto 0);
    variable nibble : std_logic_vector(3 downto 0);
  begin
    bits := word;
    for i in digits - 1 downto 0 loop
      nibble := bits(4 * i + 3 downto 4 * i);
      if is_x(nibble) then
        write(l, '?');
      else
        write(l, hex(to_integer(unsigned(nibble)) + 1));
      end if;
    end loop;
  end procedure write_word;
