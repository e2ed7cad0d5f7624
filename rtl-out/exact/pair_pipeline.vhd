-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- The data path of one pair: differences from V0, moments, fifteen determinants, the rule for pairs in one plane,
-- verdict; nothing is rounded. Units are shared over the phases of the slot; a bound at a port covers all uses of the
-- unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements of
-- x_held.
-- Each section is an entity; delays from one to another are here.
-- Latency: 16 clocks.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_pipeline is
  port (
    clk         : in  std_logic;
    in_v        : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    in_w        : in  signed_32_vector_x3_t;  -- |.| <= 2147483648
    verdict     : out unsigned(1 downto 0);  -- 00 separate, 01 intersect, 10 possibly incorrect
    outside     : out std_logic := '0';
    separated   : out std_logic_vector(8 downto 0);
    overlapping : out std_logic_vector(8 downto 0)
  );
end entity pair_pipeline;

architecture rtl of pair_pipeline is
  signal fitted : signed_18_vector_x5_t;  -- |.| <= 131071
  signal outside_i : std_logic;  -- a difference of coordinates does not fit
  signal fitted_d1 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal moment_m0 : signed_36_vector_t;  -- |.| <= 34359214082
  signal moment_m1 : signed_36_vector_t;  -- |.| <= 34359214082
  signal moment_m2 : signed_36_vector_t;  -- |.| <= 34359214082
  signal moment_n : signed_36_vector_t;  -- |.| <= 34359214082
  signal fitted_d2 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal fitted_d3 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal fitted_d4 : signed_18_vector_x5_t := zero_signed_18_vector_x5;  -- |.| <= 131071
  signal sign : flag_x2_x15_t;
  signal lines_apart : std_logic;
  signal lines_crosses : std_logic;
  signal lines_agree : std_logic;
  signal outside_line : std_logic_vector(1 to 13) := (others => '0');
begin
  -- Sections, in the order of the data
  pair_differences_section : entity work.pair_differences
    port map (clk => clk, in_v => in_v, in_w => in_w, fitted => fitted, outside => outside_i);
  pair_moments_section : entity work.pair_moments
    port map (clk => clk, fitted_d1 => fitted_d1, moment_m0 => moment_m0, moment_m1 => moment_m1,
              moment_m2 => moment_m2, moment_n => moment_n);
  pair_determinants_section : entity work.pair_determinants
    port map (clk => clk, moment_m0 => moment_m0, moment_m1 => moment_m1, moment_m2 => moment_m2, moment_n => moment_n,
              fitted_d4 => fitted_d4, sign => sign);
  pair_plane_section : entity work.pair_plane
    port map (clk => clk, moment_m0 => moment_m0, moment_m1 => moment_m1, moment_m2 => moment_m2, moment_n => moment_n,
              fitted_d2 => fitted_d2, fitted_d4 => fitted_d4, lines_apart => lines_apart,
              lines_crosses => lines_crosses, lines_agree => lines_agree);
  pair_witnesses_section : entity work.pair_witnesses
    port map (clk => clk, sign => sign, lines_apart => lines_apart, lines_crosses => lines_crosses,
              lines_agree => lines_agree, outside_h13 => outside_line(13), verdict => verdict, separated => separated,
              overlapping => overlapping);

  -- Clock 2
  clock_2 : process (clk)
  begin
    if rising_edge(clk) then
      fitted_d1 <= fitted;
    end if;
  end process clock_2;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      fitted_d2 <= fitted_d1;
    end if;
  end process clock_3;

  -- Clock 4
  clock_4 : process (clk)
  begin
    if rising_edge(clk) then
      fitted_d3 <= fitted_d2;
    end if;
  end process clock_4;

  -- Clock 5
  clock_5 : process (clk)
  begin
    if rising_edge(clk) then
      fitted_d4 <= fitted_d3;
    end if;
  end process clock_5;

  -- Clock 16
  clock_16 : process (clk)
  begin
    if rising_edge(clk) then
      outside <= outside_line(13);
    end if;
  end process clock_16;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      outside_line <= outside_i & outside_line(1 to 12);
    end if;
  end process delays;
end architecture rtl;
