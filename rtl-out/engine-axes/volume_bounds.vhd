-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- D, and what it reaches at most in the directions that units begin with.
-- Clocks are those of volume_path.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.volume_types.all;

entity volume_bounds is
  port (
    clk                            : in  std_logic;
    phase                          : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
    holds                          : in  std_logic_vector(3 downto 0);  -- whether the slot k slots ago holds a pair
    query_pose                     : in  signed_18_vector_x3_t;  -- s1.17; |.| <= 131071
    query_shift                    : in  signed_26_vector_t;  -- s4.22; |.| <= 16777216
    query_error                    : in  unsigned_16_vector_t;
    a_origin                       : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    b_origin                       : in  signed_18_vector_t;  -- s1.17; |.| <= 131072
    in_phase_3                     : in  std_logic;
    strobe                         : in  std_logic_vector(3 downto 0);  -- one flag per phase
    axis_bound_operand_select_at_2 : out std_logic;
    bound                          : out signed_28_x3_t;  -- s6.22; |.| <= 33619871
    bound_d1                       : out signed_28_3_to_8_t := zero_signed_28_3_to_8  -- s6.22; |.| <= 67239742
  );
end entity volume_bounds;

architecture rtl of volume_bounds is
  constant d_lane_m_select_at_0_table : numbers_t(0 to 3) := (1, 2, 0, 0);
  constant axis_bound_operand_select_at_2_i_table : std_logic_vector(0 to 3) := "1001";
  signal d_lane_m : signed_18_vector_t;  -- s1.17; |.| <= 131071
  signal d_lane_m_select_at_0 : unsigned(1 downto 0) := (others => '0');
  signal d_lane_t : signed(25 downto 0);  -- s4.22; |.| <= 16777216
  signal d_lane_o_a : signed(17 downto 0);  -- s1.17; |.| <= 131072
  signal b_origin_h1 : signed_18_vector_t := zero_signed_18_vector;  -- s1.17; |.| <= 131072
  signal d_lane_m_d1 : signed_18_vector_t := zero_signed_18_vector;  -- s1.17; |.| <= 131071
  signal d_lane_t_d1 : signed(25 downto 0) := (others => '0');  -- s4.22; |.| <= 16777216
  signal d_lane_o_a_d1 : signed(17 downto 0) := (others => '0');  -- s1.17; |.| <= 131072
  signal d_lane : signed(25 downto 0);  -- s4.22; |.| <= 33554336
  signal d : signed_26_x3_t := zero_signed_26_x3;  -- s4.22; |.| <= 33554336
  signal query_error_resized_h4 : signed_26_vector_t := zero_signed_26_vector;  -- s4.22; |.| <= 65535
  signal query_error_resized_h6 : signed_26_vector_t := zero_signed_26_vector;  -- s4.22; |.| <= 65535
  signal axis_bound : signed_27_x2_vector_t;  -- s5.22; |.| <= 33619871
  signal axis_bound_x1_h2 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619839
  signal axis_bound_y_h2 : signed_27_x2_t := zero_signed_27_x2;  -- s5.22; |.| <= 33619871
  signal axis_bound_operand_select_at_2_i : std_logic := '0';
  signal axis_bound0_operand_d1 : signed_27_vector_t := zero_signed_27_vector;  -- s5.22; |.| <= 33619871
  signal axis_bound1_z_operand_d1 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619871
  signal axis_bound0_operand_d2 : signed_27_vector_t := zero_signed_27_vector;  -- s5.22; |.| <= 33619871
  signal bound_i : signed_28_3_to_8_t;  -- s6.22; |.| <= 67239742
  signal bound4_operand_second_d1 : signed(26 downto 0) := (others => '0');  -- s5.22; |.| <= 33619871
  signal busy_0 : std_logic;  -- set in the clock before a pair, and in clock 0 of one
  signal in_phase_0 : std_logic;
  signal busy_6 : std_logic := '0';  -- set in clocks 5 to 8 of a pair
begin
  -- Flags of phases and pairs
  busy_0 <= holds(0) or in_phase_3;
  in_phase_0 <= flag(known(phase) = 0);

  -- Clock 0
  d_lane_m <=
    query_pose(0) when known(d_lane_m_select_at_0) = 0 else
    query_pose(1) when known(d_lane_m_select_at_0) = 1 else
    query_pose(2);
  d_lane_t <=
    query_shift(0) when known(d_lane_m_select_at_0) = 0 else
    query_shift(1) when known(d_lane_m_select_at_0) = 1 else
    query_shift(2);
  d_lane_o_a <=
    a_origin(0) when known(d_lane_m_select_at_0) = 0 else
    a_origin(1) when known(d_lane_m_select_at_0) = 1 else
    a_origin(2);

  -- Clock 1
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      d_lane_m_d1 <= d_lane_m;
      d_lane_t_d1 <= d_lane_t;
      d_lane_o_a_d1 <= d_lane_o_a;
    end if;
  end process clock_1;
  d_lane_unit : entity work.volume_origin_row
    port map (clk => clk, m => d_lane_m_d1, t => d_lane_t_d1, o_b => b_origin_h1, o_a => d_lane_o_a_d1, d => d_lane);

  -- Clock 6
  axis_bound_0_each : for i in 0 to 2 generate
    axis_bound(i)(0) <= resize(query_error_resized_h6(i), 27) + resize(d(i), 27);
    axis_bound(i)(1) <= resize(query_error_resized_h6(i), 27) - resize(d(i), 27);
  end generate axis_bound_0_each;

  -- Clock 7
  clock_7 : process (clk)
  begin
    if rising_edge(clk) then
      axis_bound0_operand_d1(0) <= choose(axis_bound_operand_select_at_2_i, axis_bound_x1_h2, axis_bound(0)(0));
      axis_bound0_operand_d1(1) <= choose(axis_bound_operand_select_at_2_i, axis_bound_y_h2(1), axis_bound(1)(0));
      axis_bound0_operand_d1(2) <= choose(axis_bound_operand_select_at_2_i, axis_bound(2)(1), axis_bound(2)(0));
      if axis_bound_operand_select_at_2_i = '1' then
        axis_bound1_z_operand_d1 <= axis_bound(2)(0);
      else
        axis_bound1_z_operand_d1 <= axis_bound(2)(1);
      end if;
      if axis_bound_operand_select_at_2_i = '1' then
        bound4_operand_second_d1 <= axis_bound_y_h2(0);
      else
        bound4_operand_second_d1 <= axis_bound(1)(1);
      end if;
    end if;
  end process clock_7;
  bound_i(3) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound0_operand_d1(1), 28);
  bound_i(4) <= resize(axis_bound0_operand_d1(0), 28) + resize(bound4_operand_second_d1, 28);
  bound_i(5) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound0_operand_d1(2), 28);
  bound_i(6) <= resize(axis_bound0_operand_d1(0), 28) + resize(axis_bound1_z_operand_d1, 28);
  bound_i(7) <= resize(axis_bound0_operand_d1(1), 28) + resize(axis_bound0_operand_d1(2), 28);
  bound_i(8) <= resize(axis_bound0_operand_d1(1), 28) + resize(axis_bound1_z_operand_d1, 28);

  -- Clock 8
  clock_8 : process (clk)
  begin
    if rising_edge(clk) then
      axis_bound0_operand_d2 <= axis_bound0_operand_d1;
      bound_d1 <= bound_i;
    end if;
  end process clock_8;
  bound_each : for k in 0 to 2 generate
    bound(k) <= resize(axis_bound0_operand_d2(k), 28);
  end generate bound_each;

  -- Selectors, set in the clock before their phase
  selectors : process (clk)
  begin
    if rising_edge(clk) then
      if busy_0 = '1' then
        d_lane_m_select_at_0 <= to_unsigned(d_lane_m_select_at_0_table(to_integer(known(phase))), 2);
      end if;
      if busy_6 = '1' then
        axis_bound_operand_select_at_2_i <= axis_bound_operand_select_at_2_i_table(to_integer(known(phase)));
      end if;
    end if;
  end process selectors;

  -- Registers that load under an enable
  captures : process (clk)
  begin
    if rising_edge(clk) then
      if strobe(0) = '1' then
        b_origin_h1 <= b_origin;
      end if;
      for k in 0 to 2 loop
        if strobe((k + 3) mod 4) = '1' then
          d(k) <= d_lane;
        end if;
      end loop;
      if strobe(3) = '1' then
        for i in 0 to 2 loop
          query_error_resized_h4(i) <= signed(resize(query_error(i), 26));
        end loop;
        axis_bound_x1_h2 <= axis_bound(0)(1);
        axis_bound_y_h2 <= axis_bound(1);
      end if;
      if strobe(1) = '1' then
        query_error_resized_h6 <= query_error_resized_h4;
      end if;
      if in_phase_0 = '1' then
        busy_6 <= holds(1);
      end if;
    end if;
  end process captures;

  -- Outputs
  axis_bound_operand_select_at_2 <= axis_bound_operand_select_at_2_i;
end architecture rtl;
