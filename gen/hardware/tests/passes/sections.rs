//! Sections of a block as modules of their own: what goes through their ports, and where later copies are.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::graph::Signals;
use efsat_hardware::netlist::Driver;
use efsat_hardware::vhdl;
use expect_test::expect;

/// A product in one section, two sums in another; the first reads the product at once and its factor later.
fn two_sections() -> Rc<Block> {
    block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(Type::signed(8, 0), ALL).named(name));
        let product = top.section("products", &["a b"], || (a * b).named("product"));
        top.section("sums", &["a b + a, a b - b"], || {
            let sum = (product + a).named("sum");
            vec![(sum * b).named("y"), (product - b).named("z")]
        })
    })
}

#[test]
fn a_copy_is_in_the_section_that_reads_it() {
    let modules = lowered(&two_sections(), 100).hierarchy();
    let text: String = modules.iter().map(|module| dump::module(module)).collect();
    expect![[r#"
        module products
          -- a b
          -- Clocks are those of sample.
          a        s8.0   -128..127      clock 0  Port
          b        s8.0   -128..127      clock 0  Port
          product  s16.0  -16256..16384  clock 1  Register of Multiply a, b
          output product: product
        module sums
          -- a b + a, a b - b
          -- Clocks are those of sample.
          a           s8.0   -128..127          clock 0  Port
          b           s8.0   -128..127          clock 0  Port
          product     s16.0  -16256..16384      clock 1  Port
          a_h1        s8.0   -128..127          clock 1  Register of a
          sum         s17.0  -16384..16511      clock 1  Add product, a_h1
          sum_h1      s17.0  -16384..16511      clock 2  Register of sum
          b_h1        s8.0   -128..127          clock 1  Register of b
          b_h2        s8.0   -128..127          clock 2  Register of b_h1
          y           s25.0  -2113408..2097152  clock 3  Register of Multiply sum_h1, b_h2
          product_d1  s16.0  -16256..16384      clock 2  Register of product
          z           s17.0  -16383..16512      clock 2  Subtract product_d1, b_h2
          output y: y
          output z: z
        module sample, latency 3 clocks
          -- Each section is an entity; delays from one to another are here.
          a        s8.0   -128..127          clock 0  Port
          b        s8.0   -128..127          clock 0  Port
          product  s16.0  -16256..16384      clock 1  product of products_section
          y        s25.0  -2113408..2097152  clock 3  y of sums_section
          z        s17.0  -16383..16512      clock 2  z of sums_section
          z_h1     s17.0  -16383..16512      clock 3  Register of z
          instance products_section: products of a, b
          instance sums_section: sums of a, b, product
          output y: y
          output z: z_h1
    "#]]
    .assert_eq(&text);
}

#[test]
fn a_section_is_an_entity_with_the_clocks_of_its_block() {
    let files = vhdl::print(&lowered(&two_sections(), 100), "", "types", &[]).expect("legal names");
    let text = |name: &str| files.iter().find(|file| file.0 == name).expect("an entity").1.clone();
    expect![[r#"
        --------------------------------------------------------------------------------
        -- a b + a, a b - b
        -- Clocks are those of sample.
        --------------------------------------------------------------------------------
        library ieee;
        use ieee.std_logic_1164.all;
        use ieee.numeric_std.all;

        entity sums is
          port (
            clk     : in  std_logic;
            a       : in  signed(7 downto 0);  -- s8.0; |.| <= 128
            b       : in  signed(7 downto 0);  -- s8.0; |.| <= 128
            product : in  signed(15 downto 0);  -- s16.0; |.| <= 16384
            y       : out signed(24 downto 0) := (others => '0');  -- s25.0; |.| <= 2113408
            z       : out signed(16 downto 0)  -- s17.0; |.| <= 16512
          );
        end entity sums;

        architecture rtl of sums is
          signal a_h1 : signed(7 downto 0) := (others => '0');  -- s8.0; |.| <= 128
          signal sum : signed(16 downto 0);  -- s17.0; |.| <= 16511
          signal sum_h1 : signed(16 downto 0) := (others => '0');  -- s17.0; |.| <= 16511
          signal b_h1 : signed(7 downto 0) := (others => '0');  -- s8.0; |.| <= 128
          signal b_h2 : signed(7 downto 0) := (others => '0');  -- s8.0; |.| <= 128
          signal product_d1 : signed(15 downto 0) := (others => '0');  -- s16.0; |.| <= 16384
        begin
          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              a_h1 <= a;
              b_h1 <= b;
            end if;
          end process clock_1;
          sum <= resize(product, 17) + resize(a_h1, 17);

          -- Clock 2
          clock_2 : process (clk)
          begin
            if rising_edge(clk) then
              sum_h1 <= sum;
              b_h2 <= b_h1;
              product_d1 <= product;
            end if;
          end process clock_2;
          z <= resize(product_d1, 17) - resize(b_h2, 17);

          -- Clock 3
          clock_3 : process (clk)
          begin
            if rising_edge(clk) then
              y <= sum_h1 * b_h2;
            end if;
          end process clock_3;
        end architecture rtl;--------------------------------------------------------------------------------
        -- Each section is an entity; delays from one to another are here.
        -- Latency: 3 clocks.
        --------------------------------------------------------------------------------
        library ieee;
        use ieee.std_logic_1164.all;
        use ieee.numeric_std.all;

        entity sample is
          port (
            clk : in  std_logic;
            a   : in  std_logic_vector(7 downto 0);  -- s8.0; |.| <= 128
            b   : in  std_logic_vector(7 downto 0);  -- s8.0; |.| <= 128
            y   : out std_logic_vector(24 downto 0);  -- s25.0; |.| <= 2113408
            z   : out std_logic_vector(16 downto 0)  -- s17.0; |.| <= 16512
          );
        end entity sample;

        architecture rtl of sample is
          signal product : signed(15 downto 0);  -- s16.0; |.| <= 16384
          signal y_i : signed(24 downto 0);  -- s25.0; |.| <= 2113408
          signal z_i : signed(16 downto 0);  -- s17.0; |.| <= 16512
          signal z_h1 : signed(16 downto 0) := (others => '0');  -- s17.0; |.| <= 16512
          signal products_section_a : signed(7 downto 0);
          signal products_section_b : signed(7 downto 0);
          signal sums_section_a : signed(7 downto 0);
          signal sums_section_b : signed(7 downto 0);
        begin
          -- Sections, in the order of the data
          products_section_a <= signed(a);
          products_section_b <= signed(b);
          sums_section_a <= signed(a);
          sums_section_b <= signed(b);
          products_section : entity work.products
            port map (clk => clk, a => products_section_a, b => products_section_b, product => product);
          sums_section : entity work.sums
            port map (clk => clk, a => sums_section_a, b => sums_section_b, product => product, y => y_i, z => z_i);

          -- Clock 3
          clock_3 : process (clk)
          begin
            if rising_edge(clk) then
              z_h1 <= z_i;
            end if;
          end process clock_3;

          -- Outputs
          y <= std_logic_vector(y_i);
          z <= std_logic_vector(z_h1);
        end architecture rtl;"#]]
    .assert_eq(&(text("sums") + &text("sample")));
}

#[test]
fn a_section_is_in_no_other() {
    let nested = || block(1, |top| top.section("outer", &[], || top.section("inner", &[], Vec::new)));
    expect!["section inner: expected to begin outside of other sections"].assert_eq(&refusal(nested));
}

/// One flag of a vector is read in another section, the other in its own.
#[test]
fn flags_of_a_vector_go_together() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(Type::signed(8, 0), ALL).named(name));
        let (flags, x) = top.section("flags", &[], || {
            let flags = [a.negative(), b.negative()].named("flags");
            (flags, (!flags[0]).named("x"))
        });
        top.section("reads", &[], || vec![(!flags[1]).named("y"), x])
    });
    let modules = lowered(&block, 100).hierarchy();
    for module in &modules {
        let ports = module.signals.iter().filter(|signal| matches!(signal.driver, Driver::Port)).count();
        assert_eq!(ports, module.inputs.len(), "{}", dump::module(module));
    }
    let leave = |name: &str| modules.iter().find(|module| module.name == name).expect("a section").outputs.len();
    assert_eq!((leave("flags"), leave("reads")), (3, 1), "both flags and x, and y");
}
