//! One bad example a rule, each a good pair of files with one thing changed.

use super::*;
use std::collections::BTreeSet;

const MULTIPLY: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity multiply is
  port (
    clk : in std_logic;
    in_a : in std_logic_vector(7 downto 0);  -- s8.0
    in_b : in std_logic_vector(7 downto 0);
    p : out std_logic_vector(15 downto 0)
  );
end entity multiply;

architecture rtl of multiply is
  signal a_high : signed(3 downto 0);
  signal product_p : signed(11 downto 0) := (others => '0');
begin
  a_high <= signed(in_a(7 downto 4));

  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      product_p <= a_high * signed(in_b);
    end if;
  end process clock_1;

  p <= std_logic_vector(resize(product_p, 16));
end architecture rtl;
";

const TOP: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity top is
  port (
    clk : in std_logic;
    reset : in std_logic;
    in_x : in std_logic_vector(7 downto 0);
    in_y : in std_logic_vector(7 downto 0);
    flag : out std_logic;
    z : out std_logic_vector(15 downto 0)
  );
end entity top;

architecture rtl of top is
  type words is array (0 to 3) of unsigned(7 downto 0);
  signal memory : words := (others => (others => '0'));
  signal x_r : signed(7 downto 0) := (others => '0');
  signal y_r : signed(7 downto 0) := (others => '0');
  signal state : std_logic := '1';
  signal level : unsigned(1 downto 0) := (others => '0');
  signal below : std_logic;
  signal chosen : std_logic;
  signal part_p : std_logic_vector(15 downto 0);
begin
  below <= '1' when x_r < y_r else '0';
  with level select chosen <= below when \"01\", not below when others;

  part : entity work.multiply
    port map (
      clk => clk,
      in_a => std_logic_vector(x_r),
      in_b => std_logic_vector(y_r),
      p => part_p
    );

  registers : process (clk)
  begin
    if rising_edge(clk) then
      x_r <= signed(in_x);
      y_r <= -signed(in_y);
      memory(to_integer(level)) <= unsigned(in_x);
      if reset = '1' then
        state <= '1';
        level <= \"00\";
      elsif below = '1' then
        state <= not state;
      else
        case level is
          when \"00\" => level <= \"01\";
          when others => null;
        end case;
      end if;
    end if;
  end process registers;

  flag <= state and chosen;
  z <= part_p;
end architecture rtl;
";

fn findings(multiply: &str, top: &str) -> Vec<Finding> {
    lint(&[("multiply.vhd", multiply), ("top.vhd", top)])
}

#[test]
fn good_files_pass() {
    assert_eq!(findings(MULTIPLY, TOP), []);
}

/// Rule, text of a good file, and what stands there in its place.
const BAD: [(&str, &str, &str); 62] = [
    ("ascii", "-- s8.0", "-- 8 \u{b5}m"),
    ("ascii", "-- s8.0", "-- \u{1}"),
    ("names", "below", "label"),
    ("names", "below", "Priority"),
    ("names", "below", "_below"),
    ("names", "below", "be__low"),
    ("names", "chosen", "X_R"),
    ("names", "registers", "memory"),
    ("names", "part :", "level :"),
    ("names", "below", "\\below\\"),
    ("libraries", "use ieee.numeric_std.all", "use ieee.std_logic_arith.all"),
    ("libraries", "use ieee.numeric_std.all", "use ieee.std_logic_unsigned.all"),
    ("libraries", "use ieee.numeric_std.all", "use std.textio.all"),
    ("libraries", "library ieee;", "library ieee, unisim;"),
    ("constructs", "a_high <= signed(in_a(7 downto 4));", "a_high <= signed(in_a(7 downto 4)) after 1 ns;"),
    ("constructs", "signal a_high", "shared variable a_high"),
    ("constructs", "signal below : std_logic;", "signal below : std_logic; constant volts : real := 1.0;"),
    ("constructs", "state <= not state;", "wait for 10 ns;"),
    ("constructs", "signal below : std_logic;", "signal below : std_logic; component multiply is end component;"),
    ("constructs", "signal below : std_logic;", "signal below : std_logic; function f return bit;"),
    ("constructs", "library ieee;", "context ieee.ieee_std_context;"),
    ("vhdl-2008", "not below when others", "?? below when others"),
    ("vhdl-2008", "x_r < y_r", "(x_r ?= y_r) = '1'"),
    ("vhdl-2008", "\"01\", not", "2d\"1\", not"),
    ("vhdl-2008", "\"01\", not", "8x\"01\", not"),
    ("vhdl-2008", "\"01\", not", "ux\"01\", not"),
    ("vhdl-2008", "flag <= state and", "flag <= or level and"),
    ("vhdl-2008", "process (clk)", "process (all)"),
    ("vhdl-2008", "case level is", "case? level is"),
    ("vhdl-2008", "flag <= ", "one : if true generate else generate end generate; flag <= "),
    ("vhdl-2008", "-- s8.0", "/* s8.0 */"),
    ("vhdl-2008", "below <= '1' when x_r < y_r else '0'", "below <= << signal .top.part.a_high : std_logic >>"),
    ("choice-in-process", "state <= not state", "state <= '1' when below = '0' else '0'"),
    ("choice-in-process", "state <= not state", "with below select state <= '1' when '1', '0' when others"),
    ("ports", "in_a : in std_logic_vector(7 downto 0)", "in_a : in signed(7 downto 0)"),
    ("ports", "p : out", "p : inout"),
    ("ports", "p : out", "p : buffer"),
    ("ports", "reset : in std_logic", "reset : in std_logic := '0'"),
    ("out-port-read", "z <= part_p", "z <= part_p or z"),
    ("out-port-read", "state <= not state", "state <= not FLAG"),
    ("direct-entity", "entity work.multiply", "multiply"),
    ("direct-entity", "entity work.multiply", "entity other.multiply"),
    ("named-association", "clk => clk,", "clk,"),
    ("clocked-process", "rising_edge", "falling_edge"),
    ("clocked-process", "if rising_edge(clk) then", "if clk'event and clk = '1' then"),
    ("clocked-process", "  end process registers", "    state <= '0';\n  end process registers"),
    ("asynchronous-reset", "registers : process (clk)", "registers : process (clk, reset)"),
    ("asynchronous-reset", "registers : process (clk)", "registers : process"),
    ("initial-value", "signal x_r : signed(7 downto 0) := (others => '0')", "signal x_r : signed(7 downto 0)"),
    ("initial-value", "signal below : std_logic", "signal below : std_logic := '0'"),
    ("reset-value", "state : std_logic := '1'", "state : std_logic := '0'"),
    ("reset-value", "level <= \"00\";", "level <= \"10\";"),
    ("product", "a_high * signed(in_b)", "resize(a_high * signed(in_b), 12)"),
    ("product", "a_high * signed(in_b)", "a_high * signed(in_b) + 1"),
    ("product", "p <= std_logic_vector(resize(product_p, 16))", "p <= std_logic_vector(signed(in_a) * signed(in_b))"),
    ("product", "product_p <= a_high", "if reset = '1' then product_p <= (others => '0'); end if; product_p <= a_high"),
    ("aggregate", "x_r < y_r else", "x_r = (others => '0') else"),
    ("case-others", "when others => null;", ""),
    ("bound", "entity work.multiply", "entity work.multiplier"),
    ("one-driver", "z <= part_p;", "z <= part_p; below <= x_r(0);"),
    ("declared", "state <= not state", "reset <= not state"),
    ("product-operand", "in_b => std_logic_vector(y_r)", "in_b => std_logic_vector(-y_r)"),
];

/// More of the rules that see all files.
const ACROSS: [(&str, &str, &str); 6] = [
    ("bound", "      in_b => std_logic_vector(y_r),\n", ""),
    ("bound", "clk => clk,", "clk => clk, c => open,"),
    ("one-driver", "z <= part_p;", ""),
    ("one-driver", "z <= part_p;", "z <= part_p; part_p <= (others => '0');"),
    ("product-operand", "a_high <= signed(in_a(7 downto 4));", "a_high <= signed(in_a(7 downto 4)) + 1;"),
    ("product-operand", "in_a => std_logic_vector(x_r)", "in_a => std_logic_vector(chosen & x_r(6 downto 0))"),
];

#[test]
fn every_bad_example_is_caught_by_its_rule() {
    let mut missed = vec![];
    for (rule, from, to) in BAD.iter().chain(&ACROSS) {
        let (multiply, top) = (MULTIPLY.replacen(from, to, 1), TOP.replace(from, to));
        assert!(multiply != MULTIPLY || top != TOP, "{from} stands nowhere");
        let found = findings(&multiply, &top);
        if !found.iter().any(|f| f.rule == *rule) {
            missed.push(format!("{rule}: {to}: {found:?}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn every_rule_has_a_bad_example() {
    let rules: BTreeSet<&str> = rules().iter().map(|rule| rule.0).collect();
    let examples: BTreeSet<&str> = BAD.iter().chain(&ACROSS).map(|example| example.0).collect();
    assert_eq!(rules, examples);
}

/// What is not generated today and is good all the same.
#[test]
fn attributes_loops_and_generates_pass() {
    let declared =
        "signal below : std_logic;\n  attribute keep : string;\n  attribute keep of below : signal is \"true\";";
    let looped = "for i in 0 to 2 loop memory(i + 1) <= memory(i); end loop; memory(0) <= unsigned(in_x)";
    let top = TOP
        .replace("signal below : std_logic;", declared)
        .replace("memory(to_integer(level)) <= unsigned(in_x)", looped)
        .replace(
            "  flag <= state and chosen;",
            "  always_on : if true generate\n    flag <= state and chosen;\n  end generate;",
        );
    assert_eq!(findings(MULTIPLY, &top.replace("always_on", "one")), []);
}

#[test]
fn a_finding_is_told_by_file_line_and_rule() {
    let top = TOP.replace("z <= part_p;", "z <= part_p or z;");
    let found: Vec<String> = findings(MULTIPLY, &top).iter().map(ToString::to_string).collect();
    assert_eq!(found, ["top.vhd:59: out-port-read: z is read"]);
}

#[test]
fn any_text_is_read_to_its_end() {
    for end in 0..TOP.len() {
        lint(&[("top.vhd", &TOP[..end])]);
        lint(&[("top.vhd", &TOP[end..])]);
    }
    let loops = TOP.replace("z <= part_p;", "z <= part_p; below <= chosen;").replace("x_r < y_r else '0'", "below");
    assert!(!findings(MULTIPLY, &loops).is_empty());
}
