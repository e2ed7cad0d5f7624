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
    phase             : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds             : in  std_logic_vector(13 downto 0);  -- whether the slot k slots ago holds a pair
    strobe            : in  std_logic_vector(2 downto 0);  -- one flag per phase
    lane1_select_at_0 : in  std_logic;
    coordinate_v1     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_v2     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w0     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w1     : in  signed_18_vector_t;  -- |.| <= 131071
    coordinate_w2     : in  signed_18_vector_t;  -- |.| <= 131071
    row_m_select_at_2 : in  unsigned(1 downto 0);
    in_phase_0        : in  std_logic;
    places            : out std_logic;
    moment_m0         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m2         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_m1         : out signed_18_vector_t := zero_signed_18_vector;  -- |.| <= 131072
    moment_n          : out signed_18_vector_t := zero_signed_18_vector  -- |.| <= 131072
  );
end entity pair_moments;

architecture rtl of pair_moments is
  constant too_great_0_so_far_select_at_2_table : std_logic_vector(0 to 3) := "010" & "0";
  signal moment_plus : signed_18_x2_x4_t;  -- |.| <= 131071
  signal moment_minus : signed_18_x2_x4_t;  -- |.| <= 131071
  signal moment_plus_d1 : signed_18_x2_x4_t := zero_signed_18_x2_x4;  -- |.| <= 131071
  signal moment_minus_d1 : signed_18_x2_x4_t := zero_signed_18_x2_x4;  -- |.| <= 131071
  signal moment_lane_cut : signed_20_x4_t;  -- |.| <= 524281
  signal moment_too_great0 : std_logic_vector(3 downto 0);
  signal moment_cut : signed_20_x12_t := zero_signed_20_x12;  -- |.| <= 524281
  signal too_great_0_found : std_logic;
  signal too_great_0_so_far_select_at_2 : std_logic := '0';
  signal too_great_0_so_far_before : std_logic := '0';
  signal too_great_0_so_far : std_logic;
  signal places_captured : std_logic := '0';
  signal places_i : std_logic;
  signal moment_exact : signed_20_vector_x2_t;  -- |.| <= 524281
  signal moment_lane : signed_18_vector_x2_t;  -- |.| <= 131072
  signal busy_20 : std_logic := '0';  -- set in clocks 19 to 21 of a pair
begin
  -- Clock 17
  moment_plus(0)(0) <=
    coordinate_w0(1) when known(row_m_select_at_2) = 0 else
    coordinate_w1(2) when known(row_m_select_at_2) = 1 else
    coordinate_w2(0);
  moment_plus(0)(1) <=
    coordinate_w1(2) when known(row_m_select_at_2) = 0 else
    coordinate_w2(0) when known(row_m_select_at_2) = 1 else
    coordinate_w0(1);
  moment_plus(1)(0) <=
    coordinate_w0(2) when known(row_m_select_at_2) = 0 else
    coordinate_w1(0) when known(row_m_select_at_2) = 1 else
    coordinate_v1(1);
  moment_plus(1)(1) <=
    coordinate_w1(0) when known(row_m_select_at_2) = 0 else
    coordinate_w2(1) when known(row_m_select_at_2) = 1 else
    coordinate_v2(2);
  moment_plus(2)(0) <=
    coordinate_w0(0) when known(row_m_select_at_2) = 0 else
    coordinate_w2(1) when known(row_m_select_at_2) = 1 else
    coordinate_v1(2);
  moment_plus(2)(1) <=
    coordinate_w1(1) when known(row_m_select_at_2) = 0 else
    coordinate_w0(2) when known(row_m_select_at_2) = 1 else
    coordinate_v2(0);
  moment_plus(3)(0) <=
    coordinate_w1(1) when known(row_m_select_at_2) = 0 else
    coordinate_w2(2) when known(row_m_select_at_2) = 1 else
    coordinate_v1(0);
  moment_plus(3)(1) <=
    coordinate_w2(2) when known(row_m_select_at_2) = 0 else
    coordinate_w0(0) when known(row_m_select_at_2) = 1 else
    coordinate_v2(1);
  moment_minus(0)(0) <=
    coordinate_w0(2) when known(row_m_select_at_2) = 0 else
    coordinate_w1(0) when known(row_m_select_at_2) = 1 else
    coordinate_w2(1);
  moment_minus(0)(1) <=
    coordinate_w1(1) when known(row_m_select_at_2) = 0 else
    coordinate_w2(2) when known(row_m_select_at_2) = 1 else
    coordinate_w0(0);
  moment_minus(1)(0) <=
    coordinate_w0(0) when known(row_m_select_at_2) = 0 else
    coordinate_w1(1) when known(row_m_select_at_2) = 1 else
    coordinate_v1(2);
  moment_minus(1)(1) <=
    coordinate_w1(2) when known(row_m_select_at_2) = 0 else
    coordinate_w2(0) when known(row_m_select_at_2) = 1 else
    coordinate_v2(1);
  moment_minus(2)(0) <=
    coordinate_w0(1) when known(row_m_select_at_2) = 0 else
    coordinate_w2(2) when known(row_m_select_at_2) = 1 else
    coordinate_v1(0);
  moment_minus(2)(1) <=
    coordinate_w1(0) when known(row_m_select_at_2) = 0 else
    coordinate_w0(1) when known(row_m_select_at_2) = 1 else
    coordinate_v2(2);
  moment_minus(3)(0) <=
    coordinate_w1(2) when known(row_m_select_at_2) = 0 else
    coordinate_w2(0) when known(row_m_select_at_2) = 1 else
    coordinate_v1(1);
  moment_minus(3)(1) <=
    coordinate_w2(1) when known(row_m_select_at_2) = 0 else
    coordinate_w0(2) when known(row_m_select_at_2) = 1 else
    coordinate_v2(0);

  -- Clock 18
  clock_18 : process (clk)
  begin
    if rising_edge(clk) then
      moment_plus_d1 <= moment_plus;
      moment_minus_d1 <= moment_minus;
    end if;
  end process clock_18;
  moment_lane_cut_unit : for k in 0 to 3 generate
    unit : entity work.moment_component
      port map (clk => clk, plus => moment_plus_d1(k), minus => moment_minus_d1(k), cut => moment_lane_cut(k),
                too_great => moment_too_great0(k));
  end generate moment_lane_cut_unit;

  -- Clock 21
  too_great_0_found <= or_reduce(unsigned(moment_too_great0));
  too_great_0_so_far <= too_great_0_found or too_great_0_so_far_before;

  -- Clock 24
  places_i <= '1' when places_captured = '1' else '0';
  moment_exact_0_each : for i in 0 to 2 generate
    moment_exact(0)(i) <= moment_cut(i + 6) when lane1_select_at_0 = '1' else moment_cut(i);
    moment_exact(1)(i) <= moment_cut(i + 9) when lane1_select_at_0 = '1' else moment_cut(i + 3);
  end generate moment_exact_0_each;
  moment_lane_unit : for k in 0 to 1 generate
    unit : entity work.moment_round
      port map (cut => moment_exact(k), places => places_i, moment => moment_lane(k));
  end generate moment_lane_unit;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_20 = '1' then
        too_great_0_so_far_select_at_2 <= too_great_0_so_far_select_at_2_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        for k in 0 to 3 loop
          moment_cut(k) <= moment_lane_cut(k);
        end loop;
        moment_m0 <= moment_lane(0);
        moment_m1 <= moment_lane(1);
      end if;
      if strobe(1) = '1' then
        for k in 0 to 3 loop
          moment_cut(k + 4) <= moment_lane_cut(k);
        end loop;
        moment_m2 <= moment_lane(0);
        moment_n <= moment_lane(1);
      end if;
      if strobe(2) = '1' then
        for k in 0 to 3 loop
          moment_cut(k + 8) <= moment_lane_cut(k);
        end loop;
        places_captured <= too_great_0_so_far;
      end if;
      if in_phase_0 = '1' then
        busy_20 <= holds(6);
      end if;
    end if;
  end process captures;

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if too_great_0_so_far_select_at_2 = '1' then
        too_great_0_so_far_before <= '0';
      else
        too_great_0_so_far_before <= too_great_0_so_far;
      end if;
    end if;
  end process state;

  -- Outputs
  places <= places_i;
end architecture rtl;
