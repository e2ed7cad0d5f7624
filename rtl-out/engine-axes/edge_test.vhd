-- SPDX-License-Identifier: MIT OR Apache-2.0
--------------------------------------------------------------------------------
-- Whether an edge passes through the other triangle: its ends are on different sides of that triangle's plane, and
-- the edges of that triangle are all on one side of it (contract, section 7).
-- v_above(k): V_k is above B's plane; w_above(l): W_l is above A's; edges_above(k)(l): edge l of B is above edge k
-- of A, seen along both. Below likewise; neither where it is not certain.
-- Combinational.
--------------------------------------------------------------------------------
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.efsat_types.all;

entity edge_test is
  port (
    v_above     : in  std_logic_vector(2 downto 0);
    v_below     : in  std_logic_vector(2 downto 0);
    w_above     : in  std_logic_vector(2 downto 0);
    w_below     : in  std_logic_vector(2 downto 0);
    edges_above : in  flag_x3_x3_t;
    edges_below : in  flag_x3_x3_t;
    pierced     : out std_logic
  );
end entity edge_test;

architecture rtl of edge_test is
  signal a_passes : std_logic_vector(2 downto 0);
  signal b_passes : std_logic_vector(2 downto 0);
begin
  -- Clock 0
  a_passes_each : for k in 0 to 2 generate
    a_passes(k) <= ((v_above(k) and v_below((k + 1) mod 3)) or (v_below(k) and v_above((k + 1) mod 3))) and
        ((edges_above(k)(0) and edges_above(k)(1) and edges_above(k)(2)) or
        (edges_below(k)(0) and edges_below(k)(1) and edges_below(k)(2)));
    b_passes(k) <= ((w_above(k) and w_below((k + 1) mod 3)) or (w_below(k) and w_above((k + 1) mod 3))) and
        ((edges_above(0)(k) and edges_above(1)(k) and edges_above(2)(k)) or
        (edges_below(0)(k) and edges_below(1)(k) and edges_below(2)(k)));
  end generate a_passes_each;
  pierced <= or_reduce(unsigned(b_passes) & unsigned(a_passes));
end architecture rtl;
