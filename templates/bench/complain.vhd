    procedure complain(what : in string) is
    begin
      mismatches := mismatches + 1;
      if mismatches <= 10 then
        write(message, string'("{{ prefix }}{{ bench }}: {{ place }} "));
        write(message, {{ counter }});
        write(message, string'(" pass "));
        write(message, pass);
        write(message, string'(": "));
        write(message, what);
        writeline(output, message);
      end if;
    end procedure complain;

    procedure compare_word(what : in string; actual : in std_logic_vector; due : in std_logic_vector) is
    begin
      if actual /= due then
        mismatches := mismatches + 1;
        if mismatches <= 10 then
          write(message, string'("{{ prefix }}{{ bench }}: {{ place }} "));
          write(message, {{ counter }});
          write(message, string'(" pass "));
          write(message, pass);
          write(message, string'(": "));
          write(message, what);
          write(message, string'(" expected "));
          write_word(message, due);
          write(message, string'(" actual "));
          write_word(message, actual);
          writeline(output, message);
        end if;
      end if;
    end procedure compare_word;
