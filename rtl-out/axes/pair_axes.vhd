-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Sections 5 and 6: the axes, and what each of them says.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_axes is
  port (
    clk               : in  std_logic;
    phase             : in  unsigned(3 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds             : in  std_logic_vector(5 downto 0);  -- whether the slot k slots ago holds a pair
    strobe            : in  std_logic_vector(10 downto 0);  -- one flag per phase
    v                 : in  interval_18_vector_x2_t;  -- s2.16; |.| <= 65536
    v_case            : in  unsigned_2_vector_x2_t;
    w                 : in  interval_18_vector_x2_t;  -- s2.16; |.| <= 65536
    w_case            : in  unsigned_2_vector_x2_t;
    lane_edge         : in  interval_18_vector_t;  -- |.| <= 65537
    lane_edge_case    : in  unsigned_2_vector_t;
    outside           : in  std_logic;  -- a number of the pair or its pose is outside its declared range
    scaled_d8         : in  interval_18_vector_t;  -- |.| <= 65536
    scaled_case_d6    : in  unsigned_2_vector_t;
    scaled_d9         : in  interval_18_vector_t;  -- |.| <= 65536
    scaled_case_d7    : in  unsigned_2_vector_t;
    axis0_has_b2_at_1 : in  std_logic;
    outside_h23       : in  std_logic;
    in_phase_8        : in  std_logic;
    busy_45           : in  std_logic;  -- set in clocks 44 to 54 of a pair
    separated         : out std_logic_vector(10 downto 0) := (others => '0');
    overlapping       : out std_logic_vector(10 downto 0) := (others => '0');
    pierced_h1        : out std_logic := '0'
  );
end entity pair_axes;

architecture rtl of pair_axes is
  constant axis_e_select_tap_at_10_table : numbers_t(0 to 15) := (4, 4, 7, 7, 7, 4, 11, 11, 11, 1, 4, others => 0);
  constant axis_f_select_tap_at_10_table : numbers_t(0 to 15) := (1, 2, 2, 3, 4, 6, 5, 6, 7, 3, 0, others => 0);
  constant axis0_v0_select_at_7_table : std_logic_vector(0 to 15) := "01000100010" & "00000";
  constant axis0_v1_select_tap_at_7_1_table : numbers_t(0 to 15) := (10, 10, 12, 12, 14, 14, 0, 5, 7, 7, 8, others => 0);
  constant axis0_v1_select_tap_at_7_2_table : numbers_t(0 to 15) := (5, 6, 10, 7, 8, 9, 0, 0, 1, 2, 4, others => 0);
  constant axis0_v3_select_at_7_table : std_logic_vector(0 to 15) := "00011100000" & "00000";
  constant axis0_has_a1_at_1_table : std_logic_vector(0 to 15) := "01111111111" & "00000";
  constant axis0_has_a2_at_1_table : std_logic_vector(0 to 15) := "00000001000" & "00000";
  constant axis0_has_b1_at_1_table : std_logic_vector(0 to 15) := "11111110111" & "00000";
  signal axis_e_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal axis_e : interval_18_vector_t;  -- |.| <= 65537
  signal axis_e_case : unsigned_2_vector_t;
  signal axis_f_select_tap_at_10 : unsigned(3 downto 0) := (others => '0');
  signal axis_f : interval_18_vector_t;  -- |.| <= 65537
  signal axis_f_case : unsigned_2_vector_t;
  signal axis_e_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65537
  signal axis_e_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis_f_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65537
  signal axis_f_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis_exact : interval_37_vector_t;  -- |.| <= 8590196738
  signal axis_exact_d1 : interval_37_vector_t := zero_interval_37_vector;  -- |.| <= 8590196738
  signal axis_l : interval_18_vector_t;  -- |.| <= 131071
  signal axis_l_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 131071
  signal axis_l_case : unsigned_2_vector_t;
  signal v0_hi_h11 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v1_h11 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal v1_h16 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal axis0_v : interval_18_vector_x4_t;  -- s2.16; |.| <= 65536
  signal axis0_v0_select_at_7 : std_logic := '0';
  signal axis0_v3_select_at_7 : std_logic := '0';
  signal v0_hi_h14 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v1_case_h11 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal axis0_v_case : unsigned_2_vector_x4_t;
  signal axis0_v_d1 : interval_18_vector_x4_t := zero_interval_18_vector_x4;  -- s2.16; |.| <= 65536
  signal axis0_v_case_d1 : unsigned_2_vector_x4_t := zero_unsigned_2_vector_x4;
  signal axis_l_d2 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 131071
  signal axis_l_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal p : interval_22_x4_t;  -- |.| <= 1572852
  signal axis0_v1_select_tap_at_7 : unsigned_4_1_to_2_t := zero_unsigned_4_1_to_2;
  signal w_held : interval_18_vector_x2_t := zero_interval_18_vector_x2;  -- s2.16; |.| <= 65536; from clocks 40, 42 on
  signal w_case_held : unsigned_2_vector_x2_t := zero_unsigned_2_vector_x2;  -- from clocks 40, 44 on
  signal p_d1 : interval_22_x4_t := zero_interval_22_x4;  -- |.| <= 1572852
  signal axis0_has_a1_at_1 : std_logic := '0';
  signal axis0_has_a2_at_1 : std_logic := '0';
  signal axis0_has_b1_at_1 : std_logic := '0';
  signal axis_separated : std_logic;
  signal axis_overlapping : std_logic;
  signal axis0_above : std_logic_vector(5 downto 0);
  signal axis0_below : std_logic_vector(5 downto 0);
  signal pierced_result_w_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_w_below : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_edges_above : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_result_edges_below : flag_x3_x3_t := zero_flag_x3_x3;
  signal pierced_result_v_above : std_logic_vector(2 downto 0) := (others => '0');
  signal pierced_result_v_below : std_logic_vector(2 downto 0) := (others => '0');
  signal axis_outside_not : std_logic;
  signal axis_counts_separated : std_logic;
  signal axis_counts_overlapping : std_logic;
  signal pierced_result : std_logic;
  signal pierced_not_held : std_logic_vector(2 downto 0) := (others => '0');  -- from clocks 34, 45, 56 on
  signal pierced_not_h34 : std_logic := '0';
  signal pierced : std_logic;
  signal busy_32 : std_logic := '0';  -- set in clocks 31 to 41 of a pair
  signal in_phase_5 : std_logic;
  signal busy_40 : std_logic := '0';  -- set in clocks 39 to 49 of a pair
  signal axis0_v_lo_line_x : signed_18_vector_1_to_2_t;
  signal axis0_v_hi_line_x : signed_18_vector_1_to_2_t;
  signal axis0_v_case_line_x : unsigned_2_vector_1_to_2_t;
  signal axis_separated_unit_has : flag_x2_x2_t;
begin
  -- Flags of phases and pairs
  in_phase_5 <= flag(known(phase) = 5);

  -- Clock 27
  axis_e_lo_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_e_select_tap_at_10, y => axis_e(i).lo);
  end generate axis_e_lo_line;
  axis_e_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_e_select_tap_at_10, y => axis_e(i).hi);
  end generate axis_e_hi_line;
  axis_e_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_e_select_tap_at_10, y => axis_e_case(i));
  end generate axis_e_case_line;
  axis_f_lo_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).lo, tap => axis_f_select_tap_at_10, y => axis_f(i).lo);
  end generate axis_f_lo_line;
  axis_f_hi_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_18
      port map (clk => clk, x => lane_edge(i).hi, tap => axis_f_select_tap_at_10, y => axis_f(i).hi);
  end generate axis_f_hi_line;
  axis_f_case_line : for i in 0 to 2 generate
    unit : entity work.tapped_line_u2
      port map (clk => clk, x => lane_edge_case(i), tap => axis_f_select_tap_at_10, y => axis_f_case(i));
  end generate axis_f_case_line;

  -- Clock 33
  clock_33 : process (clk)
  begin
    if rising_edge(clk) then
      axis_e_d1 <= axis_e;
      axis_e_case_d1 <= axis_e_case;
      axis_f_d1 <= axis_f;
      axis_f_case_d1 <= axis_f_case;
    end if;
  end process clock_33;
  axis0_v_lo_line_x_1_each : for i in 0 to 2 generate
    axis0_v_lo_line_x(1)(i) <= scaled_d8(i).lo;
    axis0_v_lo_line_x(2)(i) <= scaled_d9(i).lo;
    axis0_v_hi_line_x(1)(i) <= scaled_d8(i).hi;
    axis0_v_hi_line_x(2)(i) <= scaled_d9(i).hi;
  end generate axis0_v_lo_line_x_1_each;
  axis0_v_case_line_x(1) <= scaled_case_d6;
  axis0_v_case_line_x(2) <= scaled_case_d7;
  axis_exact_unit : entity work.cross_product
    port map (clk => clk, e => axis_e_d1, e_case => axis_e_case_d1, f => axis_f_d1, f_case => axis_f_case_d1,
              l => axis_exact);
  axis0_v_lo_line_of : for k in 1 to 2 generate
    axis0_v_lo_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_18
        port map (clk => clk, x => axis0_v_lo_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k), y => axis0_v(k)(i).lo);
    end generate axis0_v_lo_line;
  end generate axis0_v_lo_line_of;
  axis0_v_hi_line_of : for k in 1 to 2 generate
    axis0_v_hi_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_18
        port map (clk => clk, x => axis0_v_hi_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k), y => axis0_v(k)(i).hi);
    end generate axis0_v_hi_line;
  end generate axis0_v_hi_line_of;
  axis0_v_case_line_of : for k in 1 to 2 generate
    axis0_v_case_line : for i in 0 to 2 generate
      unit : entity work.tapped_line_u2
        port map (clk => clk, x => axis0_v_case_line_x(k)(i), tap => axis0_v1_select_tap_at_7(k),
                  y => axis0_v_case(k)(i));
    end generate axis0_v_case_line;
  end generate axis0_v_case_line_of;

  -- Clock 36
  clock_36 : process (clk)
  begin
    if rising_edge(clk) then
      axis_exact_d1 <= axis_exact;
    end if;
  end process clock_36;
  axis_l_unit : entity work.axis_shift
    port map (clk => clk, exact => axis_exact_d1, l => axis_l);

  -- Clock 40
  clock_40 : process (clk)
  begin
    if rising_edge(clk) then
      axis_l_d1 <= axis_l;
    end if;
  end process clock_40;
  axis0_v_0_lo_each : for i in 0 to 2 generate
    axis0_v(0)(i).lo <= v1_h16(i).lo when axis0_v0_select_at_7 = '1' else v(0)(i).lo;
    axis0_v(0)(i).hi <= v1_h16(i).hi when axis0_v0_select_at_7 = '1' else v0_hi_h14(i);
  end generate axis0_v_0_lo_each;
  axis0_v(3) <= w_held(1) when axis0_v3_select_at_7 = '1' else w_held(0);
  axis0_v_case(0) <= v1_case_h11 when axis0_v0_select_at_7 = '1' else v_case(0);
  axis0_v_case(3) <= w_case_held(1) when axis0_v3_select_at_7 = '1' else w_case_held(0);
  axis_l_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => axis_l_d1(i), number => axis_l_case(i));
  end generate axis_l_case_unit;

  -- Clock 41
  clock_41 : process (clk)
  begin
    if rising_edge(clk) then
      axis0_v_d1 <= axis0_v;
      axis0_v_case_d1 <= axis0_v_case;
      axis_l_d2 <= axis_l_d1;
      axis_l_case_d1 <= axis_l_case;
    end if;
  end process clock_41;
  p_unit : for k in 0 to 3 generate
    unit : entity work.projection
      port map (clk => clk, v => axis0_v_d1(k), v_case => axis0_v_case_d1(k), l => axis_l_d2, l_case => axis_l_case_d1,
                p => p(k));
  end generate p_unit;

  -- Clock 45
  clock_45 : process (clk)
  begin
    if rising_edge(clk) then
      p_d1 <= p;
    end if;
  end process clock_45;
  axis_separated_unit_has(0)(0) <= axis0_has_a1_at_1;
  axis_separated_unit_has(0)(1) <= axis0_has_a2_at_1;
  axis_separated_unit_has(1)(0) <= axis0_has_b1_at_1;
  axis_separated_unit_has(1)(1) <= axis0_has_b2_at_1;
  axis_separated_unit : entity work.comparator_network
    port map (clk => clk, p => p_d1, has => axis_separated_unit_has, separated => axis_separated,
              overlapping => axis_overlapping, above => axis0_above, below => axis0_below);

  -- Clock 46
  axis_outside_not <= not outside_h23;
  axis_counts_separated <= axis_separated and axis_outside_not;
  axis_counts_overlapping <= axis_overlapping and axis_outside_not;

  -- Clock 57
  pierced <= pierced_result and pierced_not_h34;
  pierced_result_unit : entity work.edge_test
    port map (v_above => pierced_result_v_above, v_below => pierced_result_v_below, w_above => pierced_result_w_above,
              w_below => pierced_result_w_below, edges_above => pierced_result_edges_above,
              edges_below => pierced_result_edges_below, pierced => pierced_result);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_32 = '1' then
        axis_e_select_tap_at_10 <= to_unsigned(axis_e_select_tap_at_10_table(to_integer(known(phase))), 4);
        axis_f_select_tap_at_10 <= to_unsigned(axis_f_select_tap_at_10_table(to_integer(known(phase))), 4);
      end if;
      if busy_40 = '1' then
        axis0_v0_select_at_7 <= axis0_v0_select_at_7_table(to_integer(known(phase)));
        axis0_v3_select_at_7 <= axis0_v3_select_at_7_table(to_integer(known(phase)));
        axis0_v1_select_tap_at_7(1) <= to_unsigned(axis0_v1_select_tap_at_7_1_table(to_integer(known(phase))), 4);
        axis0_v1_select_tap_at_7(2) <= to_unsigned(axis0_v1_select_tap_at_7_2_table(to_integer(known(phase))), 4);
      end if;
      if busy_45 = '1' then
        axis0_has_a1_at_1 <= axis0_has_a1_at_1_table(to_integer(known(phase)));
        axis0_has_a2_at_1 <= axis0_has_a2_at_1_table(to_integer(known(phase)));
        axis0_has_b1_at_1 <= axis0_has_b1_at_1_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(3) = '1' then
        for i in 0 to 2 loop
          v0_hi_h11(i) <= v(0)(i).hi;
        end loop;
        pierced_result_edges_above(0)(0) <= axis0_above(0);
        pierced_result_edges_below(0)(0) <= axis0_below(0);
        separated(2) <= axis_counts_separated;
        overlapping(2) <= axis_counts_overlapping;
      end if;
      if strobe(4) = '1' then
        v1_h11 <= v(1);
        pierced_result_edges_above(1)(0) <= axis0_above(3);
        pierced_result_edges_below(1)(0) <= axis0_below(3);
        separated(5) <= axis_counts_separated;
        overlapping(5) <= axis_counts_overlapping;
      end if;
      if strobe(9) = '1' then
        v1_h16 <= v1_h11;
        pierced_result_v_above(0) <= axis0_above(0);
        pierced_result_v_above(1) <= axis0_above(3);
        pierced_result_v_above(2) <= axis0_above(5);
        pierced_result_v_below(0) <= axis0_below(0);
        pierced_result_v_below(1) <= axis0_below(3);
        pierced_result_v_below(2) <= axis0_below(5);
        separated(1) <= axis_counts_separated;
        overlapping(1) <= axis_counts_overlapping;
      end if;
      if strobe(6) = '1' then
        v0_hi_h14 <= v0_hi_h11;
        v1_case_h11 <= v_case(1);
        w_held(0) <= w(0);
        w_case_held(0) <= w_case(0);
        pierced_result_edges_above(0)(1) <= axis0_above(1);
        pierced_result_edges_below(0)(1) <= axis0_below(1);
        separated(3) <= axis_counts_separated;
        overlapping(3) <= axis_counts_overlapping;
      end if;
      if strobe(8) = '1' then
        w_held(1) <= w(1);
        pierced_result_edges_above(2)(1) <= axis0_above(4);
        pierced_result_edges_below(2)(1) <= axis0_below(4);
        separated(9) <= axis_counts_separated;
        overlapping(9) <= axis_counts_overlapping;
      end if;
      if strobe(10) = '1' then
        w_case_held(1) <= w_case(1);
        pierced_result_edges_above(0)(2) <= axis0_above(1);
        pierced_result_edges_below(0)(2) <= axis0_below(1);
        separated(4) <= axis_counts_separated;
        overlapping(4) <= axis_counts_overlapping;
      end if;
      if strobe(2) = '1' then
        for k in 0 to 2 loop
          pierced_result_w_above(k) <= axis0_above(k);
          pierced_result_w_below(k) <= axis0_below(k);
        end loop;
        separated(0) <= axis_counts_separated;
        overlapping(0) <= axis_counts_overlapping;
        pierced_h1 <= pierced;
      end if;
      if strobe(7) = '1' then
        pierced_result_edges_above(1)(1) <= axis0_above(4);
        pierced_result_edges_below(1)(1) <= axis0_below(4);
        separated(6) <= axis_counts_separated;
        overlapping(6) <= axis_counts_overlapping;
      end if;
      if strobe(0) = '1' then
        pierced_result_edges_above(1)(2) <= axis0_above(4);
        pierced_result_edges_below(1)(2) <= axis0_below(4);
        pierced_not_held <= pierced_not_held(1 downto 0) & not outside;
        separated(7) <= axis_counts_separated;
        overlapping(7) <= axis_counts_overlapping;
      end if;
      if strobe(5) = '1' then
        pierced_result_edges_above(2)(0) <= axis0_above(3);
        pierced_result_edges_below(2)(0) <= axis0_below(3);
        separated(8) <= axis_counts_separated;
        overlapping(8) <= axis_counts_overlapping;
      end if;
      if strobe(1) = '1' then
        pierced_result_edges_above(2)(2) <= axis0_above(4);
        pierced_result_edges_below(2)(2) <= axis0_below(4);
        pierced_not_h34 <= pierced_not_held(2);
        separated(10) <= axis_counts_separated;
        overlapping(10) <= axis_counts_overlapping;
      end if;
      if in_phase_8 = '1' then
        busy_32 <= holds(2);
      end if;
      if in_phase_5 = '1' then
        busy_40 <= holds(3);
      end if;
    end if;
  end process captures;
end architecture rtl;
