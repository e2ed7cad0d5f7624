-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Section 3: B's vertices in A's frame.
-- Clocks are those of pair_pipeline.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity pair_transform is
  port (
    clk            : in  std_logic;
    phase          : in  unsigned(3 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds          : in  std_logic_vector(5 downto 0);  -- whether the slot k slots ago holds a pair
    in_w           : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_m         : in  signed_32_vector_x3_t;  -- s4.28; |.| <= 2147483648
    pose_t         : in  signed_32_vector_t;  -- s4.28; |.| <= 2147483648
    pose_bypass    : in  std_logic;
    in_phase_10    : in  std_logic;
    row0_t_outside : out std_logic;
    row0_m_outside : out std_logic_vector(2 downto 0);
    row0_x_outside : out std_logic_vector(2 downto 0);
    row            : out interval_32_t  -- s4.28; |.| <= 1879048192
  );
end entity pair_transform;

architecture rtl of pair_transform is
  constant row_t_pose_select_at_0_table : numbers_t(0 to 15) := (1, 2, 0, 1, 2, 0, 1, 2, 0, 0, 0, others => 0);
  constant row_diagonal_at_0_0_table : std_logic_vector(0 to 15) := "00100100111" & "00000";
  constant row_diagonal_at_0_1_table : std_logic_vector(0 to 15) := "10010010000" & "00000";
  constant row_diagonal_at_0_2_table : std_logic_vector(0 to 15) := "01001001000" & "00000";
  constant row_x_select_at_0_table : numbers_t(0 to 15) := (0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, others => 0);
  signal row_t_pose : signed(31 downto 0);  -- s4.28; |.| <= 2147483648
  signal row_t_pose_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_t : signed(31 downto 0);  -- s4.28; |.| <= 2147483648
  signal row_t_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 2147483648
  signal row0_t_inside : signed(31 downto 0);  -- s4.28; |.| <= 1073741816
  signal row_m_pose : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_diagonal_at_0 : std_logic_vector(2 downto 0) := (others => '0');
  signal row_m : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_m_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal row0_m_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal row_x : signed_32_vector_t;  -- s4.28; |.| <= 2147483648
  signal row_x_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal row_x_d1 : signed_32_vector_t := zero_signed_32_vector;  -- s4.28; |.| <= 2147483648
  signal row0_x_inside : signed_32_x3_t;  -- s4.28; |.| <= 268435456
  signal row0_m_inside_d1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal row0_x_inside_d1 : signed_32_x3_t := zero_signed_32_x3;  -- s4.28; |.| <= 268435456
  signal row0_t_inside_d1 : signed(31 downto 0) := (others => '0');  -- s4.28; |.| <= 1073741816
  signal pose_bypass_line : std_logic_vector(1 to 3) := (others => '0');
  signal busy_0 : std_logic;  -- set in the clock before a pair, and in clock 0 of one
  signal row_unit_m : signed_32_vector_t;
  signal row_unit_x : signed_32_vector_t;
begin
  -- Flags of phases and pairs
  busy_0 <= holds(0) or in_phase_10;

  -- Clock 0
  row_t_pose <=
    pose_t(0) when known(row_t_pose_select_at_0) = 0 else
    pose_t(1) when known(row_t_pose_select_at_0) = 1 else
    pose_t(2);
  row_t <= to_signed(0, 32) when pose_bypass = '1' else row_t_pose;
  row_m_pose <=
    pose_m(0) when known(row_t_pose_select_at_0) = 0 else
    pose_m(1) when known(row_t_pose_select_at_0) = 1 else
    pose_m(2);
  row_m_each : for i in 0 to 2 generate
    row_m(i) <= choose(row_diagonal_at_0(i), to_signed(268435456, 32), to_signed(0, 32)) when pose_bypass = '1' else
        row_m_pose(i);
  end generate row_m_each;
  row_x <=
    in_w(0) when known(row_x_select_at_0) = 0 else
    in_w(1) when known(row_x_select_at_0) = 1 else
    in_w(2);

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      row_t_d1 <= row_t;
      row_m_d1 <= row_m;
      row_x_d1 <= row_x;
    end if;
  end process clock_1;
  row0_t_inside_unit : entity work.guard_translation
    port map (clk => clk, number => row_t_d1, passed => row0_t_inside, outside => row0_t_outside);
  row0_m_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => row_m_d1(k), passed => row0_m_inside(k), outside => row0_m_outside(k));
  end generate row0_m_inside_unit;
  row0_x_inside_unit : for k in 0 to 2 generate
    unit : entity work.guard_coordinate
      port map (clk => clk, number => row_x_d1(k), passed => row0_x_inside(k), outside => row0_x_outside(k));
  end generate row0_x_inside_unit;

  -- Clock 3
  clock_3 : process (clk)
  begin
    if rising_edge(clk) then
      row0_m_inside_d1 <= row0_m_inside;
      row0_x_inside_d1 <= row0_x_inside;
      row0_t_inside_d1 <= row0_t_inside;
    end if;
  end process clock_3;
  row_unit_m_each : for i in 0 to 2 generate
    row_unit_m(i) <= row0_m_inside_d1(i);
    row_unit_x(i) <= row0_x_inside_d1(i);
  end generate row_unit_m_each;
  row_unit : entity work.transform_row
    port map (clk => clk, m => row_unit_m, x => row_unit_x, t => row0_t_inside_d1, bypass => pose_bypass_line(3),
              b => row);

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_0 = '1' then
        row_t_pose_select_at_0 <= to_unsigned(row_t_pose_select_at_0_table(to_integer(known(phase))), 2);
        row_diagonal_at_0(0) <= row_diagonal_at_0_0_table(to_integer(known(phase)));
        row_diagonal_at_0(1) <= row_diagonal_at_0_1_table(to_integer(known(phase)));
        row_diagonal_at_0(2) <= row_diagonal_at_0_2_table(to_integer(known(phase)));
        row_x_select_at_0 <= to_unsigned(row_x_select_at_0_table(to_integer(known(phase))), 2);
      end if;
    end if;
  end process selectors;

  -- Delay lines
  delays : process (clk)
  begin
    if rising_edge(clk) then
      pose_bypass_line <= pose_bypass & pose_bypass_line(1 to 2);
    end if;
  end process delays;
end architecture rtl;
