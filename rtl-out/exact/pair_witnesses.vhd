-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 6: witnesses and verdict.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_witnesses is
  port (
    clk           : in  std_logic;
    sign          : in  flag_x2_x15_t;
    lines_apart   : in  std_logic;
    lines_crosses : in  std_logic;
    lines_agree   : in  std_logic;
    outside_h13   : in  std_logic;
    verdict       : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    separated     : out std_logic_vector(8 downto 0);
    overlapping   : out std_logic_vector(8 downto 0)
  );
end entity pair_witnesses;

architecture rtl of pair_witnesses is
  type sign_line_t is array (1 to 4) of flag_x2_x4_t;
  signal sign_line : sign_line_t := (others => zero_flag_x2_x4);
  signal sign_12_to_14_h4 : flag_x2_12_to_14_t := zero_flag_x2_12_to_14;
  signal sign_h1 : flag_x2_4_to_11_t := zero_flag_x2_4_to_11;
  signal edge_missed : std_logic_vector(5 downto 0);
  signal edge_hits : std_logic_vector(5 downto 0);
  signal edge_pierces : std_logic_vector(5 downto 0);
  type sign_h3_line_t is array (1 to 3) of flag_x2_12_to_14_t;
  signal sign_h3_line : sign_h3_line_t := (others => zero_flag_x2_12_to_14);
  signal inner : std_logic_vector(2 downto 0);
  signal skew_word_h1 : unsigned(17 downto 0) := (others => '0');
  signal skew : std_logic;  -- some side sign is not 0
  signal sign_h5 : flag_x2_x4_t := zero_flag_x2_x4;
  signal sign_h2 : flag_x2_4_to_5_t := zero_flag_x2_4_to_5;
  signal edge_missed_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal edge_hits_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal edge_pierces_h1 : std_logic_vector(5 downto 0) := (others => '0');
  signal inner_h1 : std_logic_vector(2 downto 0) := (others => '0');
  signal skew_h1 : std_logic := '0';
  signal lines_apart_h1 : std_logic := '0';
  signal lines_apart_h2 : std_logic := '0';
  signal lines_crosses_h1 : std_logic := '0';
  signal lines_crosses_h2 : std_logic := '0';
  signal lines_agree_h1 : std_logic := '0';
  signal lines_agree_h2 : std_logic := '0';
  signal edge_missed_unit_ends : flag_x2_x2_x6_t;
  signal edge_missed_unit_sides : flag_x2_x3_x6_t;
  signal inner_unit_plane_b : flag_x2_x3_t;
  signal inner_unit_side : flag_x2_x3_x3_t;
  signal verdict_unit_planes : flag_x2_x3_x2_t;
begin
  -- Clock 14
  clock_14 : process (clk)
  begin
    if rising_edge(clk) then
      sign_12_to_14_h4 <= sign_h3_line(3);
      for k in 4 to 11 loop
        sign_h1(k) <= sign(k);
      end loop;
      skew_word_h1 <= unsigned(sign_h3_line(3)(14)) & unsigned(sign_h3_line(3)(13)) & unsigned(sign_h3_line(3)(12)) &
          unsigned(sign(11)) & unsigned(sign(10)) & unsigned(sign(9)) & unsigned(sign(8)) & unsigned(sign(7)) &
          unsigned(sign(6));
      lines_apart_h1 <= lines_apart;
      lines_crosses_h1 <= lines_crosses;
      lines_agree_h1 <= lines_agree;
    end if;
  end process clock_14;
  skew <= or_reduce(skew_word_h1);
  edge_missed_unit_ends(0)(0) <= sign_line(4)(3);
  edge_missed_unit_ends(0)(1) <= sign_h1(4);
  edge_missed_unit_ends_1_each : for m in 0 to 1 generate
    edge_missed_unit_ends(1)(m) <= sign_h1(m + 4);
  end generate edge_missed_unit_ends_1_each;
  edge_missed_unit_ends(2)(0) <= sign_h1(5);
  edge_missed_unit_ends(2)(1) <= sign_line(4)(3);
  edge_missed_unit_ends_3_each : for m in 0 to 1 generate
    edge_missed_unit_ends(3)(m) <= sign_line(4)(m);
    edge_missed_unit_ends(4)(m) <= sign_line(4)(m + 1);
  end generate edge_missed_unit_ends_3_each;
  edge_missed_unit_ends(5)(0) <= sign_line(4)(2);
  edge_missed_unit_ends(5)(1) <= sign_line(4)(0);
  edge_missed_unit_sides_0_each : for m in 0 to 2 generate
    edge_missed_unit_sides(0)(m) <= sign_h1(m + 6);
    edge_missed_unit_sides(1)(m) <= sign_h1(m + 9);
    edge_missed_unit_sides(2)(m) <= sign_12_to_14_h4(m + 12);
  end generate edge_missed_unit_sides_0_each;
  edge_missed_unit_sides_0_each_2 : for k in 3 to 5 generate
    edge_missed_unit_sides(k)(0) <= sign_h1(k + 3);
    edge_missed_unit_sides(k)(1) <= sign_h1(k + 6);
    edge_missed_unit_sides(k)(2) <= sign_12_to_14_h4(k + 9);
  end generate edge_missed_unit_sides_0_each_2;
  inner_unit_plane_b(0) <= sign_line(4)(3);
  inner_unit_plane_b(1) <= sign_h1(4);
  inner_unit_plane_b(2) <= sign_h1(5);
  inner_unit_side_0_each : for m in 0 to 2 generate
    inner_unit_side(0)(m) <= sign_h1(m + 6);
    inner_unit_side(1)(m) <= sign_h1(m + 9);
    inner_unit_side(2)(m) <= sign_12_to_14_h4(m + 12);
  end generate inner_unit_side_0_each;
  edge_missed_unit : for k in 0 to 5 generate
    unit : entity work.edge_verdict
      port map (ends => edge_missed_unit_ends(k), sides => edge_missed_unit_sides(k), missed => edge_missed(k),
                hits => edge_hits(k), pierces => edge_pierces(k));
  end generate edge_missed_unit;
  inner_unit : entity work.inner_side
    port map (plane_b => inner_unit_plane_b, side => inner_unit_side, inner => inner);

  -- Clock 15
  clock_15 : process (clk)
  begin
    if rising_edge(clk) then
      sign_h5 <= sign_line(4);
      for k in 4 to 5 loop
        sign_h2(k) <= sign_h1(k);
      end loop;
      edge_missed_h1 <= edge_missed;
      edge_hits_h1 <= edge_hits;
      edge_pierces_h1 <= edge_pierces;
      inner_h1 <= inner;
      skew_h1 <= skew;
      lines_apart_h2 <= lines_apart_h1;
      lines_crosses_h2 <= lines_crosses_h1;
      lines_agree_h2 <= lines_agree_h1;
    end if;
  end process clock_15;
  verdict_unit_planes_0_each : for m in 0 to 2 generate
    verdict_unit_planes(0)(m) <= sign_h5(m);
  end generate verdict_unit_planes_0_each;
  verdict_unit_planes(1)(0) <= sign_h5(3);
  verdict_unit_planes(1)(1) <= sign_h2(4);
  verdict_unit_planes(1)(2) <= sign_h2(5);
  verdict_unit : entity work.pair_verdict
    port map (clk => clk, planes => verdict_unit_planes, edges_missed => edge_missed_h1, edges_hits => edge_hits_h1,
              edges_pierces => edge_pierces_h1, inner => inner_h1, skew => skew_h1, plane_apart => lines_apart_h2,
              plane_crosses => lines_crosses_h2, plane_agree => lines_agree_h2, outside => outside_h13,
              verdict => verdict, separated => separated, overlapping => overlapping);

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      for k in 0 to 3 loop
        sign_line(1)(k) <= sign(k);
      end loop;
      sign_line(2 to 4) <= sign_line(1 to 3);
      for k in 12 to 14 loop
        sign_h3_line(1)(k) <= sign(k);
      end loop;
      sign_h3_line(2 to 3) <= sign_h3_line(1 to 2);
    end if;
  end process delays;
end architecture rtl;
