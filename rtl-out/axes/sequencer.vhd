-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Phases of the slot, handshakes and FIFO pointers. A pair is accepted in the last phase of a slot if a place
-- in the result FIFO is free; the data path itself never stops.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity sequencer is
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    in_valid       : in  std_logic;
    pose_valid     : in  std_logic;
    out_ready      : in  std_logic;
    phase          : out unsigned(3 downto 0);
    load_pair      : out std_logic := '1';  -- the last phase, in which hundreds of registers load; set in reset and in the first clock after, where nothing is accepted
    holds          : out std_logic_vector(5 downto 0);
    in_ready       : out std_logic;  -- the last phase, and a place is free
    accept         : out std_logic;
    decide         : out std_logic;
    out_valid      : out std_logic;
    take           : out std_logic;
    accept_address : out unsigned(3 downto 0);
    decide_address : out unsigned(3 downto 0);
    take_address   : out unsigned(3 downto 0);
    pose_load      : out std_logic;  -- a pose waits, and the next pair reads it
    pose_ready     : out std_logic  -- no pose waits; clear in reset and in the first clock after
  );
end entity sequencer;

architecture rtl of sequencer is
  constant phase_entry_table : numbers_t(0 to 15) := (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, others => 0);
  signal phase_i : unsigned(3 downto 0) := (others => '0');
  signal last_phase : std_logic := '0';  -- set in phase 10
  signal accepted : unsigned(4 downto 0) := (others => '0');
  signal taken : unsigned(4 downto 0) := (others => '0');
  signal taken_ahead : unsigned(4 downto 0) := to_unsigned(1, 5);
  signal taken_moved : std_logic := '0';
  signal decided : unsigned(4 downto 0) := (others => '0');
  signal taken_turned : unsigned(4 downto 0);
  signal phase_equal : std_logic;
  signal full : std_logic;
  signal accepts : std_logic := '0';  -- the last phase, and a place is free
  signal accept_pair : std_logic;
  signal holds_i : std_logic_vector(5 downto 0) := (others => '0');
  signal decide_phase : std_logic := '0';  -- set in phase 3
  signal decide_pair : std_logic;
  signal empty_if_moved : std_logic := '1';
  signal empty_if_still : std_logic := '1';
  signal empty : std_logic;
  signal offered : std_logic := '0';
  signal output_free : std_logic;
  signal take_pair : std_logic;
  signal load_pose : std_logic := '0';  -- a pose waits, and the next pair reads it
  signal takes_pose : std_logic := '0';  -- no pose waits; clear in reset and in the first clock after
  signal accept_pose : std_logic;
  signal pose_pending : std_logic := '0';
  signal pose_waits : std_logic;
  signal pose_pending_next : std_logic;
begin
  taken_turned <= taken + 16;
  phase_equal <= flag(known(phase_i) = 9);
  full <= flag(known(accepted) = known(taken_turned));
  accept_pair <= in_valid and accepts;
  decide_pair <= holds_i(5) and decide_phase;
  empty <= empty_if_moved when taken_moved = '1' else empty_if_still;
  output_free <= not offered or out_ready;
  take_pair <= not empty and output_free;
  accept_pose <= pose_valid and takes_pose;
  pose_waits <= pose_pending and not load_pose;
  pose_pending_next <= pose_waits or accept_pose;
  accept_address <= accepted(3 downto 0);
  decide_address <= decided(3 downto 0);
  take_address <= taken(3 downto 0);

  -- State
  state : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        phase_i <= to_unsigned(0, 4);
        last_phase <= '0';
        taken_moved <= '0';
        accepts <= '0';
        decide_phase <= '0';
        empty_if_moved <= '1';
        empty_if_still <= '1';
        offered <= '0';
        load_pose <= '0';
        takes_pose <= '0';
        pose_pending <= '0';
        load_pair <= '1';
      else
        phase_i <= to_unsigned(phase_entry_table(to_integer(known(phase_i))), 4);
        last_phase <= flag(known(phase_i) = 9);
        taken_moved <= take_pair;
        accepts <= phase_equal and not full;
        decide_phase <= flag(known(phase_i) = 2);
        empty_if_moved <= flag(known(taken_ahead) = known(decided));
        empty_if_still <= flag(known(taken) = known(decided));
        offered <= take_pair or not output_free;
        load_pose <= pose_pending_next and phase_equal;
        takes_pose <= not pose_pending_next;
        pose_pending <= pose_pending_next;
        load_pair <= phase_equal;
      end if;
      if reset = '1' then
        accepted <= to_unsigned(0, 5);
      elsif accept_pair = '1' then
        accepted <= accepted + 1;
      end if;
      if reset = '1' then
        taken <= to_unsigned(0, 5);
        taken_ahead <= to_unsigned(1, 5);
      elsif take_pair = '1' then
        taken <= taken_ahead;
        taken_ahead <= taken_ahead + 1;
      end if;
      if reset = '1' then
        decided <= to_unsigned(0, 5);
      elsif decide_pair = '1' then
        decided <= decided + 1;
      end if;
      if reset = '1' then
        for k in 0 to 5 loop
          holds_i(k) <= '0';
        end loop;
      elsif last_phase = '1' then
        holds_i <= holds_i(4 downto 0) & accept_pair;
      end if;
    end if;
  end process state;

  -- Outputs
  phase <= phase_i;
  holds <= holds_i;
  in_ready <= accepts;
  accept <= accept_pair;
  decide <= decide_pair;
  out_valid <= offered;
  take <= take_pair;
  pose_load <= load_pose;
  pose_ready <= takes_pose;
end architecture rtl;
