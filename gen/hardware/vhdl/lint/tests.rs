//! Good files that every rule passes, and for each rule changes of them that it does not.

use super::*;
use std::collections::BTreeSet;

const FILES: [(&str, &str); 4] =
    [("types_pkg.vhd", TYPES), ("multiply.vhd", MULTIPLY), ("chain.vhd", CHAIN), ("top.vhd", TOP)];

const TYPES: &str = "library ieee;
use ieee.numeric_std.all;
package types_pkg is
  type interval_t is record
    lo, hi : signed(7 downto 0);
  end record interval_t;
  type vectors_t is array (0 to 5, 0 to 2) of interval_t;
end package types_pkg;
";

const MULTIPLY: &str = "library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity multiply is
  port (clk : in std_logic; factor, other : in signed(7 downto 0); p : out signed(15 downto 0));
end entity multiply;
architecture rtl of multiply is begin
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then  -- s8.0
      p <= factor * other; end if;
  end process clock_1;
end architecture rtl;
";

const CHAIN: &str = "library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.types_pkg.all;
entity chain is
  port (clk : in std_logic; x, y : in bytes_t; r : out signed(17 downto 0));
end entity chain;
architecture rtl of chain is
  signal x1_d1, y1_d1 : signed(7 downto 0);
  signal product0, product1 : signed(15 downto 0);
  signal sum0 : signed(16 downto 0);
begin
  clock_1 : process (clk)
  begin
    if rising_edge(clk) then
      product0 <= x(0) * y(0); x1_d1 <= x(1); y1_d1 <= y(1);
      sum0 <= 5 + resize(product0, 17); product1 <= x1_d1 * y1_d1;
      r <= resize(sum0, 18) - resize(product1, 18); end if;
  end process clock_1;
end architecture rtl;
";

const TOP: &str = "library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.types_pkg.all;
entity top is
  port (clk : in std_logic; aresetn : in std_logic; operand : in signed(7 downto 0);
        flags : out std_logic_vector(1 downto 0); p : out signed(15 downto 0));
end entity top;
architecture rtl of top is
  constant text : string := \"wait?\" & character'('?');
  type state_of is (idle, busy);
  type line_t is array (1 to 4) of vectors_t;
  signal state : state_of := idle;
  signal product : signed(15 downto 0);
  signal data : signed(7 downto 0) := (others => '0');
  signal vectors : vectors_t;
  signal level : unsigned(1 downto 0) := \"00\";
begin
  flags <= level(1) & '1' when state = idle and level /= \"10\" else std_logic_vector'('0' & '1');  -- wait, after
  p <= product;
  unit : entity work.multiply
    port map (clk => clk, factor => vectors(0, 1).lo, other => data, p => product);
  registers : process (clk)
  begin
    if rising_edge(clk) then
      if state = idle then null; else data <= operand; end if;
      if aresetn = '0' then level <= \"00\"; elsif state = busy then level <= level + 1; data <= operand; end if;
      for i in 0 to 2 loop vectors(0, i).lo <= data; vectors(0, i).hi <= data; end loop;
      case state is
        when idle => state <= busy;
        when others => case level is when \"01\" => state <= idle; when others => null; end case;
      end case;
    end if;
  end process registers;
end architecture rtl;
";

/// Rule, a snippet of the good files, and what stands in its place: `\t` a tab, `\s` a blank, `\l` many of them.
const BAD: &str = r#"
characters | -- s8.0 | -- 8 µm
characters | -- s8.0 | \t-- s8.0
characters | -- s8.0 | -- s8.0\s
line-length | p <= product; | p <= \l product;
names | state_of | wire
names | signal data | signal reg
names | vectors_t is | vectors__t is
libraries | library ieee; | library ieee, unisim;
libraries | use ieee.numeric_std.all; | use ieee.std_logic_arith.all;
libraries | use work.types_pkg.all; | use work.types_pkg.all; use std.textio.all;
constructs | p <= product; | p <= product after 1 ns;
constructs | state <= busy; | wait for 10 ns;
constructs | p : out | p : inout
constructs | type state_of | shared variable count : natural; type state_of
constructs | type state_of | constant volts : real := 1.0; type state_of
constructs | type state_of | component multiply is end component; type state_of
constructs | product | \product\
constructs | state = idle and | (level ?= "00") = '1' and
constructs | -- s8.0 | /* s8.0 */
constructs | flags <= level(1) | flags <= or level
constructs | registers : process (clk) | registers : process (all)
direct-entity | unit : entity work.multiply | unit : multiply
direct-entity | unit : entity work.multiply | unit : entity other.multiply
named-association | clk => clk, factor | clk, factor
clocked-process | registers : process (clk) | registers : process (clk, aresetn)
clocked-process | clk : in std_logic; a | clock : in std_logic; a
clocked-process | if rising_edge(clk) then | if clk = '0' then null; elsif rising_edge(clk) then
clocked-process | end process registers; | level <= "00"; end process registers;
clocked-process | end process registers; | if state = idle then null; end if; end process registers;
clocked-process | other; end if; | other; else null; end if;
clocked-process | p <= product; | p <= product when rising_edge(clk);
product | factor * other; | factor * other + 1;
product | p <= factor * other; | if factor > other then p <= factor * other; end if;
product | end process clock_1; | end process clock_1; q <= factor;
product | x1_d1 * y1_d1; | x1_d1 * y1_d1 + 1;
product | - resize(product1, 18); | - resize(product1, 18) + 1;
product | 5 + resize(product0, 17) | 5 + 3 * 4
product | sum0 <= 5 + | if x = y then null; end if; end if; end process; sum0 <= 5 +
product | p <= product; | p <= data * data;
reset | level <= "00"; | level <= "00"; data <= operand;
reset | level <= "00"; | if level = "01" then p <= product; end if;
reset | level <= "00"; | for i in 0 to 2 loop vectors(0, i).lo <= data; end loop;
reset | level <= "00"; | if level = "01" then null; else data <= operand; end if;
reset | level <= "00"; | case level is when others => data <= operand; end case;
reset | elsif state = busy | elsif state = busy or aresetn = '0'
dimensions | type vectors_t is array (0 to 5, | type vectors_t is array (0 to 5, 0 to 1,
dimensions | type line_t is array (1 to 4) | type line_t is array (1 to 4, 0 to 1)
record-fields | hi : signed(7 downto 0) | hi : signed
record-fields | hi : signed(7 downto 0) | hi : std_logic_vector
case-others | when others => null; |
case-others | when others => case | when busy => case
"#;

fn findings(from: &str, to: &str) -> Vec<Finding> {
    let texts = FILES.map(|(name, text)| (name, text.replace(from, to)));
    lint(&texts.each_ref().map(|(name, text)| (*name, text.as_str())))
}

#[test]
fn good_files_pass_and_every_rule_catches_its_bad_examples() {
    assert_eq!(lint(&FILES), []);
    // The index of a loop is no factor.
    let cut = |by: &str| {
        format!("p <= product; cut : for k in 0 to 1 generate flags(k) <= level({by} * k); end generate cut;")
    };
    assert_eq!(findings("p <= product;", &cut("1")), []);
    assert!(findings("p <= product;", &cut("n")).iter().any(|finding| finding.rule == "product"));
    let mut names = BTreeSet::new();
    for example in BAD.trim().lines() {
        let parts: Vec<&str> = example.split('|').map(str::trim).collect();
        let (rule, from, to) = (parts[0], parts[1], parts[2]);
        assert!(FILES.iter().any(|(_, text)| text.contains(from)), "{from} stands nowhere");
        let to = to.replace(r"\t", "\t").replace(r"\s", " ").replace(r"\l", &" ".repeat(200));
        let found = findings(from, &to);
        assert!(found.iter().any(|finding| finding.rule == rule), "{example}: {found:?}");
        names.insert(rule);
    }
    assert_eq!(names, rules().iter().map(|rule| rule.0).collect(), "every rule has a bad example");
}

#[test]
fn what_synthesis_skips_is_not_looked_at_if_it_ends() {
    let (off, on) = ("-- synthesis translate_off\n  ", "  -- synthesis translate_on\n  p <= product;");
    let delayed = "p <= product after 1 ns;\n";
    assert_eq!(findings("p <= product;", &format!("{off}{delayed}{on}")), []);
    for wrong in [format!("{off}{delayed}"), format!("{off}{on} {delayed}")] {
        assert!(findings("p <= product;", &wrong).iter().any(|found| found.rule == "constructs"), "{wrong}");
    }
}

#[test]
fn a_finding_is_told_by_file_line_and_what_is_expected() {
    let found = findings("hi : signed(7 downto 0)", "hi : signed").remove(0);
    assert_eq!(found.to_string(), "types_pkg.vhd:5: signed without a range; expected a range");
}

#[test]
fn any_text_is_read_to_its_end() {
    for text in [TYPES, MULTIPLY, TOP, "x'('1'&\"open\n'", "'\u{e9}'\u{e9}\"\u{e9}--", "type a is array (a of a"] {
        for (at, _) in text.char_indices() {
            lint(&[("begin.vhd", &text[..at]), ("end.vhd", &text[at..])]);
        }
    }
}
