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
    clk            : in  std_logic;
    phase          : in  unsigned(3 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds          : in  std_logic_vector(5 downto 0);  -- whether the slot k slots ago holds a pair
    strobe         : in  std_logic_vector(10 downto 0);  -- one flag per phase
    v              : in  interval_18_vector_x3_t;  -- s2.16; |.| <= 65536
    v_case         : in  unsigned_2_vector_x3_t;
    w              : in  interval_18_vector_x3_t;  -- s2.16; |.| <= 65536
    w_case         : in  unsigned_2_vector_x3_t;
    lane_edge      : in  interval_18_vector_t;  -- |.| <= 65537
    lane_edge_case : in  unsigned_2_vector_t;
    outside_h21    : in  std_logic;
    in_phase_8     : in  std_logic;
    in_phase_9     : in  std_logic;
    separated      : out std_logic_vector(10 downto 0) := (others => '0');
    overlapping    : out std_logic_vector(10 downto 0) := (others => '0')
  );
end entity pair_axes;

architecture rtl of pair_axes is
  constant axis_e_select_tap_at_10_table : numbers_t(0 to 15) := (4, 4, 7, 7, 7, 4, 11, 11, 11, 1, 4, others => 0);
  constant axis_f_select_tap_at_10_table : numbers_t(0 to 15) := (1, 2, 2, 3, 4, 6, 5, 6, 7, 3, 0, others => 0);
  constant axis0_rounding_at_0_table : std_logic_vector(0 to 15) := "00000010000" & "00000";
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
  signal axis0_rounding_at_0 : std_logic := '0';
  signal axis_l : interval_18_vector_t;  -- |.| <= 65539
  signal axis_l_d1 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65539
  signal axis_l_case : unsigned_2_vector_t;
  signal v0_hi_h11 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal v_h11 : interval_18_vector_1_to_2_t := zero_interval_18_vector_1_to_2;  -- s2.16; |.| <= 65536
  signal v0_hi_h13 : signed_18_vector_t := zero_signed_18_vector;  -- s2.16; |.| <= 65536
  signal axis_l_d2 : interval_18_vector_t := zero_interval_18_vector;  -- |.| <= 65539
  signal axis_l_case_d1 : unsigned_2_vector_t := zero_unsigned_2_vector;
  signal p : interval_18_x6_t;  -- |.| <= 98309
  signal v1_h12 : interval_18_vector_t := zero_interval_18_vector;  -- s2.16; |.| <= 65536
  signal v_case_held : unsigned_2_vector_1_to_2_t := zero_unsigned_2_vector_1_to_2;  -- from clock 39 on
  signal w_held : interval_18_vector_x3_t := zero_interval_18_vector_x3;  -- s2.16; |.| <= 65536; from clock 39 on
  signal w_case_held : unsigned_2_vector_x3_t := zero_unsigned_2_vector_x3;  -- from clock 39 on
  signal p_d1 : interval_18_x6_t := zero_interval_18_x6;  -- |.| <= 98309
  signal axis_separated : std_logic;
  signal axis_overlapping : std_logic;
  signal axis_outside_not : std_logic;
  signal axis_counts_separated : std_logic;
  signal axis_counts_overlapping : std_logic;
  signal busy_32 : std_logic := '0';  -- set in clocks 31 to 41 of a pair
  signal busy_33 : std_logic := '0';  -- set in clocks 32 to 42 of a pair
  signal p_unit_v : interval_18_vector_x6_t;
  signal p_unit_v_case : unsigned_2_vector_x6_t;
begin
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
  axis_l_unit : entity work.cross_product
    port map (clk => clk, e => axis_e_d1, e_case => axis_e_case_d1, f => axis_f_d1, f_case => axis_f_case_d1,
              rounding => axis0_rounding_at_0, l => axis_l);

  -- Clock 38
  clock_38 : process (clk)
  begin
    if rising_edge(clk) then
      axis_l_d1 <= axis_l;
    end if;
  end process clock_38;
  axis_l_case_unit : for i in 0 to 2 generate
    unit : entity work.sign_case
      port map (x => axis_l_d1(i), number => axis_l_case(i));
  end generate axis_l_case_unit;

  -- Clock 39
  clock_39 : process (clk)
  begin
    if rising_edge(clk) then
      axis_l_d2 <= axis_l_d1;
      axis_l_case_d1 <= axis_l_case;
    end if;
  end process clock_39;
  p_unit_v_0_lo_each : for i in 0 to 2 generate
    p_unit_v(0)(i).lo <= v(0)(i).lo;
    p_unit_v(0)(i).hi <= v0_hi_h13(i);
  end generate p_unit_v_0_lo_each;
  p_unit_v(1) <= v1_h12;
  p_unit_v(2) <= v_h11(2);
  p_unit_v(3) <= w_held(0);
  p_unit_v(4) <= w_held(1);
  p_unit_v(5) <= w_held(2);
  p_unit_v_case(0) <= v_case(0);
  p_unit_v_case(1) <= v_case_held(1);
  p_unit_v_case(2) <= v_case_held(2);
  p_unit_v_case(3) <= w_case_held(0);
  p_unit_v_case(4) <= w_case_held(1);
  p_unit_v_case(5) <= w_case_held(2);
  p_unit : for k in 0 to 5 generate
    unit : entity work.projection
      port map (clk => clk, v => p_unit_v(k), v_case => p_unit_v_case(k), l => axis_l_d2, l_case => axis_l_case_d1,
                p => p(k));
  end generate p_unit;

  -- Clock 43
  clock_43 : process (clk)
  begin
    if rising_edge(clk) then
      p_d1 <= p;
    end if;
  end process clock_43;
  axis_separated_unit : entity work.comparator_network
    port map (clk => clk, p => p_d1, separated => axis_separated, overlapping => axis_overlapping);

  -- Clock 44
  axis_outside_not <= not outside_h21;
  axis_counts_separated <= axis_separated and axis_outside_not;
  axis_counts_overlapping <= axis_overlapping and axis_outside_not;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_32 = '1' then
        axis_e_select_tap_at_10 <= to_unsigned(axis_e_select_tap_at_10_table(to_integer(known(phase))), 4);
        axis_f_select_tap_at_10 <= to_unsigned(axis_f_select_tap_at_10_table(to_integer(known(phase))), 4);
      end if;
      if busy_33 = '1' then
        axis0_rounding_at_0 <= axis0_rounding_at_0_table(to_integer(known(phase)));
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
        separated(8) <= axis_counts_separated;
        overlapping(8) <= axis_counts_overlapping;
      end if;
      for k in 1 to 2 loop
        if strobe(k + 3) = '1' then
          v_h11(k) <= v(k);
        end if;
      end loop;
      if strobe(5) = '1' then
        v0_hi_h13 <= v0_hi_h11;
        v1_h12 <= v_h11(1);
        for k in 1 to 2 loop
          v_case_held(k) <= v_case(k);
        end loop;
        w_held <= w;
        w_case_held <= w_case;
        separated(6) <= axis_counts_separated;
        overlapping(6) <= axis_counts_overlapping;
      end if;
      if in_phase_8 = '1' then
        busy_32 <= holds(2);
      end if;
      if in_phase_9 = '1' then
        busy_33 <= holds(2);
      end if;
      if strobe(0) = '1' then
        separated(0) <= axis_counts_separated;
        overlapping(0) <= axis_counts_overlapping;
      end if;
      if strobe(7) = '1' then
        separated(1) <= axis_counts_separated;
        overlapping(1) <= axis_counts_overlapping;
      end if;
      if strobe(1) = '1' then
        separated(2) <= axis_counts_separated;
        overlapping(2) <= axis_counts_overlapping;
      end if;
      if strobe(4) = '1' then
        separated(3) <= axis_counts_separated;
        overlapping(3) <= axis_counts_overlapping;
      end if;
      if strobe(8) = '1' then
        separated(4) <= axis_counts_separated;
        overlapping(4) <= axis_counts_overlapping;
      end if;
      if strobe(2) = '1' then
        separated(5) <= axis_counts_separated;
        overlapping(5) <= axis_counts_overlapping;
      end if;
      if strobe(9) = '1' then
        separated(7) <= axis_counts_separated;
        overlapping(7) <= axis_counts_overlapping;
      end if;
      if strobe(6) = '1' then
        separated(9) <= axis_counts_separated;
        overlapping(9) <= axis_counts_overlapping;
      end if;
      if strobe(10) = '1' then
        separated(10) <= axis_counts_separated;
        overlapping(10) <= axis_counts_overlapping;
      end if;
    end if;
  end process captures;
end architecture rtl;
