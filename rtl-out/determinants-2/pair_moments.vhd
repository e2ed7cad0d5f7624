-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 4: moments of the edges of B, and the normal of A.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_moments is
  port (
    clk               : in  std_logic;
    phase             : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
    holds             : in  std_logic_vector(17 downto 0);  -- whether the slot k slots ago holds a pair
    in_phase_1        : in  std_logic;
    strobe            : in  std_logic_vector(1 downto 0);  -- one flag per phase
    row_m_select_at_1 : in  std_logic;
    coordinate_v1     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2     : in  signed_18_vector_t;  -- |.| <= 131071
    places            : out std_logic;
    moment_m0         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m2         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m1         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_n          : out signed_18_vector_t := zero_signed_18_vector  -- |.| <= 131072
  );
end entity pair_moments;

architecture rtl of pair_moments is
  signal moment_plus : signed_18_x2_x6_t;  -- |.| <= 131071
  signal moment_minus : signed_18_x2_x6_t;  -- |.| <= 131071
  signal moment_plus_d1 : signed_18_x2_x6_t := zero_signed_18_x2_x6;  -- |.| <= 131071
  signal moment_minus_d1 : signed_18_x2_x6_t := zero_signed_18_x2_x6;  -- |.| <= 131071
  signal moment_lane_cut : signed_20_x6_t;  -- |.| <= 524281
  signal moment_too_great0 : std_logic_vector(5 downto 0);
  signal moment_cut : signed_20_x12_t := zero_signed_20_x12;  -- |.| <= 524281
  signal too_great_0_found : std_logic;
  signal too_great_0_found_d1 : std_logic := '0';
  signal too_great_0_so_far_select_at_1 : std_logic := '0';
  signal too_great_0_so_far_before : std_logic := '0';
  signal too_great_0_so_far : std_logic;
  signal places_captured : std_logic := '0';
  signal places_i : std_logic;
  signal moment_exact : signed_20_vector_x2_t;  -- |.| <= 524281
  signal moment_exact_d1 : signed_20_vector_x2_t := zero_signed_20_vector_x2;  -- |.| <= 524281
  signal moment_lane : signed_18_vector_x2_t;  -- |.| <= 131072
  signal busy_19 : std_logic := '0';  -- set in clocks 18 to 19 of a pair
begin
  -- Clock 15
  moment_plus_0_each : for k in 0 to 2 generate
    moment_plus(k)(0) <= coordinate_w2((k + 1) mod 3) when row_m_select_at_1 = '1' else coordinate_w0((k + 1) mod 3);
    moment_plus(k)(1) <= coordinate_w0((k + 2) mod 3) when row_m_select_at_1 = '1' else coordinate_w1((k + 2) mod 3);
    moment_plus(k + 3)(0) <= coordinate_v1((k + 1) mod 3) when row_m_select_at_1 = '1' else
        coordinate_w1((k + 1) mod 3);
    moment_plus(k + 3)(1) <= coordinate_v2((k + 2) mod 3) when row_m_select_at_1 = '1' else
        coordinate_w2((k + 2) mod 3);
    moment_minus(k)(0) <= coordinate_w2((k + 2) mod 3) when row_m_select_at_1 = '1' else coordinate_w0((k + 2) mod 3);
    moment_minus(k)(1) <= coordinate_w0((k + 1) mod 3) when row_m_select_at_1 = '1' else coordinate_w1((k + 1) mod 3);
    moment_minus(k + 3)(0) <= coordinate_v1((k + 2) mod 3) when row_m_select_at_1 = '1' else
        coordinate_w1((k + 2) mod 3);
    moment_minus(k + 3)(1) <= coordinate_v2((k + 1) mod 3) when row_m_select_at_1 = '1' else
        coordinate_w2((k + 1) mod 3);
  end generate moment_plus_0_each;

  -- Clock 16
  clock_16 : process (clk)
  begin
    if rising_edge(clk) then
      moment_plus_d1 <= moment_plus;
      moment_minus_d1 <= moment_minus;
    end if;
  end process clock_16;
  moment_lane_cut_unit : for k in 0 to 5 generate
    unit : entity work.moment_component
      port map (clk => clk, plus => moment_plus_d1(k), minus => moment_minus_d1(k), cut => moment_lane_cut(k),
                too_great => moment_too_great0(k));
  end generate moment_lane_cut_unit;

  -- Clock 19
  too_great_0_found <= or_reduce(unsigned(moment_too_great0));

  -- Clock 20
  clock_20 : process (clk)
  begin
    if rising_edge(clk) then
      too_great_0_found_d1 <= too_great_0_found;
    end if;
  end process clock_20;
  too_great_0_so_far <= too_great_0_found_d1 or too_great_0_so_far_before;

  -- Clock 21
  moment_exact_0_each : for i in 0 to 2 generate
    moment_exact(0)(i) <= moment_cut(i + 6) when row_m_select_at_1 = '1' else moment_cut(i);
    moment_exact(1)(i) <= moment_cut(i + 9) when row_m_select_at_1 = '1' else moment_cut(i + 3);
  end generate moment_exact_0_each;

  -- Clock 22
  clock_22 : process (clk)
  begin
    if rising_edge(clk) then
      moment_exact_d1 <= moment_exact;
    end if;
  end process clock_22;
  places_i <= '1' when places_captured = '1' else '0';
  moment_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_round
      port map (cut => moment_exact_d1(k), places => places_i, moment => moment_lane(k));
  end generate moment_lane_unit;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_19 = '1' then
        if phase = '1' then
          too_great_0_so_far_select_at_1 <= '0';
        else
          too_great_0_so_far_select_at_1 <= '1';
        end if;
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(1) = '1' then
        for k in 0 to 5 loop
          moment_cut(k) <= moment_lane_cut(k);
        end loop;
        places_captured <= too_great_0_so_far;
        moment_m2 <= moment_lane(0);
        moment_n <= moment_lane(1);
      end if;
      if strobe(0) = '1' then
        for k in 0 to 5 loop
          moment_cut(k + 6) <= moment_lane_cut(k);
        end loop;
        moment_m0 <= moment_lane(0);
        moment_m1 <= moment_lane(1);
      end if;
      if in_phase_1 = '1' then
        busy_19 <= holds(8);
      end if;
    end if;
  end process captures;

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if too_great_0_so_far_select_at_1 = '1' then
        too_great_0_so_far_before <= '0';
      else
        too_great_0_so_far_before <= too_great_0_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  places <= places_i;
end architecture rtl;
