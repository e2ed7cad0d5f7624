  hold : process (clk)
  begin
    if rising_edge(clk) then
      if taken = '1' or head_valid = '0' then
        if next_valid = '1' then
          head <= next_word;
          head_last <= next_last;
          head_whole <= next_whole;
          head_kind <= next_kind;
        else
          head <= s_axis_tdata;
          head_last <= s_axis_tlast;
          head_whole <= whole;
          head_kind <= kind;
        end if;
      end if;
      if next_valid = '0' then
        next_word <= s_axis_tdata;
        next_last <= s_axis_tlast;
        next_whole <= whole;
        next_kind <= kind;
      end if;
      if reset = '1' then
        within_packet <= '0';
      else
        within_packet <= stays_within;
      end if;
      if (reset or soft_reset) = '1' then
        running <= '0';
        head_valid <= '0';
        next_valid <= '0';
      else
        running <= '1';
        if taken = '1' or head_valid = '0' then
          head_valid <= next_valid or arrives;
          next_valid <= '0';
        else
          next_valid <= next_valid or arrives;
        end if;
      end if;
    end if;
  end process hold;
