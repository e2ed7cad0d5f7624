//! Modules as text.

use super::*;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Place, Signals, Step, Vec3};
use efsat_hardware::netlist::Wire;
use efsat_hardware::vhdl;
use expect_test::expect;

efsat_hardware::record! {
    /// Two bounds.
    Bounds "bounds" { least: S, most: S }
}

/// An entity without its header: what stands behind its name.
fn entity(module: &Rc<Module>, name: &str) -> String {
    let files = vhdl::print(module, "", "sample_types", &[]).expect("legal names");
    let (_, text) = files.into_iter().find(|file| file.0 == name).expect("an entity of that name");
    let body = text.find("entity ").expect("an entity");
    text[body..].to_owned()
}

/// The same for what a module has inside, the ports of a top being plain vectors.
fn inside(module: &Rc<Module>) -> String {
    let top = Control::new("outer", vec![]);
    let inputs: Vec<Wire> =
        module.inputs.iter().map(|id| top.input(module.signal(*id).name().as_str(), module.signal(*id).ty)).collect();
    let outputs = top.instance("inner", module, &inputs);
    outputs.iter().zip(&module.outputs).for_each(|(wire, (place, _))| wire.output(place.clone()));
    entity(&top.finish(), &module.name)
}

#[test]
fn registers_begin_with_the_value_that_they_are_reset_to() {
    let module = module(|m| {
        let [reset, go] = ["reset", "go"].map(|name| m.input(name, Type::FLAG));
        let a = m.input("a", S8);
        let q = |name: &str, ty| m.register(name, ty);
        let count = q("count", S8);
        count.loads(a, Some(go), Some((reset, -3)));
        let ready = q("ready", Type::FLAG);
        ready.loads(go, None, Some((reset, 1)));
        let plain = q("plain", S8);
        plain.loads(count, None, None);
        let held = q("held", S8);
        held.loads(plain, Some(ready), None);
        held.output("y");
        ready.output("z");
    });
    expect![[r#"
        entity sample is
          port (
            clk   : in  std_logic;
            reset : in  std_logic;
            go    : in  std_logic;
            a     : in  signed(7 downto 0);  -- s4.4
            y     : out signed(7 downto 0) := (others => '0');  -- s4.4
            z     : out std_logic
          );
        end entity sample;

        architecture rtl of sample is
          signal count : signed(7 downto 0) := to_signed(-3, 8);  -- s4.4
          signal ready : std_logic := '1';
          signal plain : signed(7 downto 0) := (others => '0');  -- s4.4
        begin
          registers : process (clk)
          begin
            if rising_edge(clk) then
              plain <= count;
            end if;
          end process registers;

          -- Registers that load under an enable
          captures : process (clk)
          begin
            if rising_edge(clk) then
              if ready = '1' then
                y <= plain;
              end if;
            end if;
          end process captures;

          -- State
          state : process (clk)
          begin
            if rising_edge(clk) then
              if reset = '1' then
                count <= to_signed(-3, 8);
              elsif go = '1' then
                count <= a;
              end if;
              if reset = '1' then
                ready <= '1';
              else
                ready <= go;
              end if;
            end if;
          end process state;

          -- Outputs
          z <= ready;
        end architecture rtl;"#]]
    .assert_eq(&inside(&module));
}

#[test]
fn what_has_one_reader_is_written_where_it_is_read() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let sum = (a + b).floor(1) - a.floor(1);
        let twice = (a - b).magnitude();
        vec![
            sum.named("y"),
            (twice | twice.like(1)).named("z"),
            a.less(b).choose(a, b).named("most").comment("the greater"),
        ]
    });
    expect![[r#"
        entity sample is
          port (
            a    : in  signed(7 downto 0);  -- s4.4; |.| <= 128
            b    : in  signed(7 downto 0);  -- s4.4; |.| <= 128
            y    : out signed(8 downto 0);  -- s6.3; |.| <= 191
            z    : out unsigned(8 downto 0);
            most : out signed(7 downto 0)  -- s4.4; |.| <= 128; the greater
          );
        end entity sample;

        architecture rtl of sample is
          signal y_floor_1_first_sum : signed(8 downto 0);  -- s5.4; |.| <= 256
        begin
          -- Clock 0
          y_floor_1_first_sum <= resize(a, 9) + resize(b, 9);
          y <= resize(y_floor_1_first_sum(8 downto 1), 9) - resize(a(7 downto 1), 9);
          z <= abs_of(resize(a, 9) - resize(b, 9)) or to_unsigned(1, 9);
          most <= a when less(a, b) = '1' else b;
        end architecture rtl;"#]]
    .assert_eq(&inside(&lowered(&block, 100)));
}

#[test]
fn bundles_are_records_and_arrays_and_what_is_done_alike_is_a_loop() {
    let block = block(1, |top| {
        let v = Vec3::each(|_| Bounds { least: top.input(S8, ALL), most: top.input(S8, ALL) }).named("v");
        let w = [0; 4].map(|_| top.input(S8, ALL)).named("w");
        let wide = v.map(|b| Bounds { least: b.least - b.most, most: b.most + b.most }).named("wide");
        let turned = Vec3::each(|i| (v[i + 1].least * v[i].most).named_at("turned", i));
        let sums = [0, 1, 2, 3].map(|i| w[i] + w[(i + 1) % 4]).named("sums");
        let flags = w.map(|x| x.negative()).named("flags");
        [wide.signals(), turned.signals(), sums.signals(), flags.signals()].concat()
    });
    let module = lowered(&block, 100);
    let files = {
        let top = Control::new("outer", vec![]);
        let inputs: Vec<Wire> = module
            .inputs
            .iter()
            .map(|id| top.input(module.signal(*id).name().as_str(), module.signal(*id).ty))
            .collect();
        let outputs = top.instance("inner", &module, &inputs);
        outputs.iter().zip(&module.outputs).for_each(|(wire, (place, _))| wire.output(Place::new(place.to_string())));
        vhdl::print(&top.finish(), "", "sample_types", &[]).expect("legal names")
    };
    let texts: Vec<&str> = files.iter().map(|file| file.1.as_str()).collect();
    expect![[r#"
        --------------------------------------------------------------------------------
        -- The types of the design, and the few functions that its entities share.
        --
        -- A vector has the components x, y, z at 0, 1, 2. Numbers are mantissas; where the binary point is stands where a signal
        -- is declared, or in the table of a unit's header.
        --------------------------------------------------------------------------------
        library ieee;
        use ieee.std_logic_1164.all;
        use ieee.numeric_std.all;

        package sample_types is
          type bounds_8_t is record
            least : signed(7 downto 0);
            most : signed(7 downto 0);
          end record bounds_8_t;
          type bounds_9_t is record
            least : signed(8 downto 0);
            most : signed(8 downto 0);
          end record bounds_9_t;
          constant zero_bounds_9 : bounds_9_t := (least => (others => '0'), most => (others => '0'));
          type signed_16_x3_t is array (0 to 2) of signed(15 downto 0);
          constant zero_signed_16_x3 : signed_16_x3_t := (others => (others => '0'));
          type signed_8_x4_t is array (0 to 3) of signed(7 downto 0);
          type signed_9_x4_t is array (0 to 3) of signed(8 downto 0);
          constant zero_signed_9_x4 : signed_9_x4_t := (others => (others => '0'));
          type bounds_8_vector_t is array (0 to 2) of bounds_8_t;
          type bounds_9_vector_t is array (0 to 2) of bounds_9_t;
          constant zero_bounds_9_vector : bounds_9_vector_t := (others => zero_bounds_9);
          type numbers_t is array (natural range <>) of integer;
        end package sample_types;--------------------------------------------------------------------------------
        -- Latency: 1 clock.
        --------------------------------------------------------------------------------
        library ieee;
        use ieee.std_logic_1164.all;
        use ieee.numeric_std.all;
        use work.sample_types.all;

        entity sample is
          port (
            clk    : in  std_logic;
            v      : in  bounds_8_vector_t;  -- s4.4; |.| <= 128
            w      : in  signed_8_x4_t;  -- s4.4; |.| <= 128
            wide   : out bounds_9_vector_t := zero_bounds_9_vector;  -- s5.4; |.| <= 256
            turned : out signed_16_x3_t := zero_signed_16_x3;  -- s8.8; |.| <= 16384
            sums   : out signed_9_x4_t := zero_signed_9_x4;  -- s5.4; |.| <= 256
            flags  : out std_logic_vector(3 downto 0) := (others => '0')
          );
        end entity sample;

        architecture rtl of sample is
          signal wide_i : bounds_9_vector_t;  -- s5.4; |.| <= 256
          signal sums_i : signed_9_x4_t;  -- s5.4; |.| <= 256
          signal flags_i : std_logic_vector(3 downto 0);
        begin
          -- Clock 0
          wide_i_least_each : for i in 0 to 2 generate
            wide_i(i).least <= resize(v(i).least, 9) - resize(v(i).most, 9);
            wide_i(i).most <= resize(v(i).most, 9) + resize(v(i).most, 9);
          end generate wide_i_least_each;
          sums_i_each : for k in 0 to 3 generate
            sums_i(k) <= resize(w(k), 9) + resize(w((k + 1) mod 4), 9);
            flags_i(k) <= w(k)(7);
          end generate sums_i_each;

          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              wide <= wide_i;
              for k in 0 to 2 loop
                turned(k) <= v((k + 1) mod 3).least * v(k).most;
              end loop;
              sums <= sums_i;
              flags <= flags_i;
            end if;
          end process clock_1;
        end architecture rtl;--------------------------------------------------------------------------------
        --------------------------------------------------------------------------------
        library ieee;
        use ieee.std_logic_1164.all;
        use ieee.numeric_std.all;
        use work.sample_types.all;

        entity outer is
          port (
            clk          : in  std_logic;
            v_x_least    : in  std_logic_vector(7 downto 0);  -- s4.4
            v_x_most     : in  std_logic_vector(7 downto 0);  -- s4.4
            v_y_least    : in  std_logic_vector(7 downto 0);  -- s4.4
            v_y_most     : in  std_logic_vector(7 downto 0);  -- s4.4
            v_z_least    : in  std_logic_vector(7 downto 0);  -- s4.4
            v_z_most     : in  std_logic_vector(7 downto 0);  -- s4.4
            w0           : in  std_logic_vector(7 downto 0);  -- s4.4
            w1           : in  std_logic_vector(7 downto 0);  -- s4.4
            w2           : in  std_logic_vector(7 downto 0);  -- s4.4
            w3           : in  std_logic_vector(7 downto 0);  -- s4.4
            wide_x_least : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 255
            wide_x_most  : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            wide_y_least : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 255
            wide_y_most  : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            wide_z_least : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 255
            wide_z_most  : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            turned0      : out std_logic_vector(15 downto 0);  -- s8.8; |.| <= 16384
            turned1      : out std_logic_vector(15 downto 0);  -- s8.8; |.| <= 16384
            turned2      : out std_logic_vector(15 downto 0);  -- s8.8; |.| <= 16384
            sums0        : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            sums1        : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            sums2        : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            sums3        : out std_logic_vector(8 downto 0);  -- s5.4; |.| <= 256
            flags0       : out std_logic;
            flags1       : out std_logic;
            flags2       : out std_logic;
            flags3       : out std_logic
          );
        end entity outer;

        architecture rtl of outer is
          signal inner_wide : bounds_9_vector_t;  -- s5.4; |.| <= 256
          signal inner_turned : signed_16_x3_t;  -- s8.8; |.| <= 16384
          signal inner_sums : signed_9_x4_t;  -- s5.4; |.| <= 256
          signal inner_v : bounds_8_vector_t;
          signal inner_w : signed_8_x4_t;
          signal inner_flags : std_logic_vector(3 downto 0);
        begin
          inner_v(0).least <= signed(v_x_least);
          inner_v(0).most <= signed(v_x_most);
          inner_v(1).least <= signed(v_y_least);
          inner_v(1).most <= signed(v_y_most);
          inner_v(2).least <= signed(v_z_least);
          inner_v(2).most <= signed(v_z_most);
          inner_w(0) <= signed(w0);
          inner_w(1) <= signed(w1);
          inner_w(2) <= signed(w2);
          inner_w(3) <= signed(w3);
          flags0 <= inner_flags(0);
          flags1 <= inner_flags(1);
          flags2 <= inner_flags(2);
          flags3 <= inner_flags(3);
          inner : entity work.sample
            port map (clk => clk, v => inner_v, w => inner_w, wide => inner_wide, turned => inner_turned, sums => inner_sums,
                      flags => inner_flags);

          -- Outputs
          wide_x_least <= std_logic_vector(inner_wide(0).least);
          wide_x_most <= std_logic_vector(inner_wide(0).most);
          wide_y_least <= std_logic_vector(inner_wide(1).least);
          wide_y_most <= std_logic_vector(inner_wide(1).most);
          wide_z_least <= std_logic_vector(inner_wide(2).least);
          wide_z_most <= std_logic_vector(inner_wide(2).most);
          turned0 <= std_logic_vector(inner_turned(0));
          turned1 <= std_logic_vector(inner_turned(1));
          turned2 <= std_logic_vector(inner_turned(2));
          sums0 <= std_logic_vector(inner_sums(0));
          sums1 <= std_logic_vector(inner_sums(1));
          sums2 <= std_logic_vector(inner_sums(2));
          sums3 <= std_logic_vector(inner_sums(3));
        end architecture rtl;"#]].assert_eq(&texts.concat());
}

#[test]
fn bits_of_a_port_of_a_top_are_converted_and_not_cut_off_a_conversion() {
    let top = Control::new("top", vec![]);
    let a = top.input("a", S8);
    a.low(3).named("three").output("three");
    a.low(1).named("one").output("one");
    expect![[r#"
        entity top is
          port (
            a     : in  std_logic_vector(7 downto 0);  -- s4.4
            three : out std_logic_vector(2 downto 0);
            one   : out std_logic
          );
        end entity top;

        architecture rtl of top is
          signal three_i : unsigned(2 downto 0);
        begin
          three_i <= unsigned(signed(a(2 downto 0)));
          one <= a(0);

          -- Outputs
          three <= std_logic_vector(three_i);
        end architecture rtl;"#]]
    .assert_eq(&entity(&top.finish(), "top"));
}

#[test]
fn loops_begin_with_any_element() {
    let block = block(1, |top| {
        let w = [0; 4].map(|_| top.input(S8, ALL)).named("w");
        [0, 1, 2].map(|i| w[i + 1] - w[i]).named("steps").to_vec()
    });
    expect![[r#"
        entity sample is
          port (
            w     : in  signed_8_x4_t;  -- s4.4; |.| <= 128
            steps : out signed_9_x3_t  -- s5.4; |.| <= 255
          );
        end entity sample;

        architecture rtl of sample is
        begin
          -- Clock 0
          steps_each : for k in 0 to 2 generate
            steps(k) <= resize(w(k + 1), 9) - resize(w(k), 9);
          end generate steps_each;
        end architecture rtl;"#]]
    .assert_eq(&inside(&lowered(&block, 100)));
}

#[test]
fn delays_are_lines_and_phases_are_tables() {
    let block = block(4, |top| {
        let a = [0; 4].map(|_| top.input(S8, ALL)).to_vec().named("a");
        let x = Phases::new(4, |s| Some(a[s])).mux().named("x");
        let held: Vec<Sig> = (0..3).map(|s| x.capture(s, false).named_at("held", s)).collect();
        let again = Phases::new(4, |s| [Some(held[2]), None, Some(held[0]), Some(held[1])][s]).mux().named("again");
        let shift = Phases::new(4, |s| Some(s as i128 - 2)).constant(top, S8).named("shift");
        let sum = ((x * x).named("square").floor(4) + x.earlier(3).named("before")).named("sum");
        vec![(again + shift).named("shifted").capture(3, false).named("y"), sum.capture(3, false).named("z")]
    });
    expect![[r#"
        entity sample is
          port (
            clk   : in  std_logic;
            phase : in  unsigned(1 downto 0);  -- phase of the slot: 0 in the first clock of the inputs
            holds : in  std_logic_vector(1 downto 0);  -- whether the slot k slots ago holds a pair
            a     : in  signed_8_x4_t;  -- s4.4; |.| <= 128
            y     : out signed(8 downto 0) := (others => '0');  -- s5.4; |.| <= 128
            z     : out signed(12 downto 0) := (others => '0')  -- s9.4; |.| <= 1151
          );
        end entity sample;

        architecture rtl of sample is
          constant x_select_at_0_table : numbers_t(0 to 3) := (1, 2, 3, 0);
          constant again_select_tap_at_3_table : numbers_t(0 to 3) := (4, 4, 0, 1);
          constant shift_at_3_table : numbers_t(0 to 3) := (0, 1, -2, -1);
          signal x : signed(7 downto 0);  -- s4.4; |.| <= 128
          signal x_select_at_0 : unsigned(1 downto 0) := (others => '0');
          signal in_phase_3 : std_logic;
          signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
          signal strobe : std_logic_vector(3 downto 0) := (others => '0');  -- one flag per phase
          signal again_select_tap_at_3 : unsigned(3 downto 0) := (others => '0');
          signal again : signed(7 downto 0);  -- s4.4; |.| <= 128
          signal x_d1 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal square : signed(15 downto 0) := (others => '0');  -- s8.8; |.| <= 16384
          type x_line_t is array (1 to 4) of signed(7 downto 0);
          signal x_line : x_line_t := (others => (others => '0'));  -- s4.4; |.| <= 128
          signal sum : signed(12 downto 0);  -- s9.4; |.| <= 1151
          signal shift_at_3 : signed(7 downto 0) := (others => '0');  -- s4.4
          signal shifted : signed(8 downto 0);  -- s5.4; |.| <= 130
          signal busy_0 : std_logic;  -- set in the clock before a pair, and in clock 0 of one
          signal in_phase_1 : std_logic;
          signal busy_3 : std_logic := '0';  -- set in clocks 2 to 5 of a pair
        begin
          -- Strobes, one per phase, and flags of pairs
          strobes : process (clk)
          begin
            if rising_edge(clk) then
              for k in 0 to 3 loop
                strobe(k) <= flag(known(phase) = (k + 3) mod 4) and in_flight;
              end loop;
            end if;
          end process strobes;
          in_phase_3 <= flag(known(phase) = 3);
          in_flight <= holds(0) or holds(1) or in_phase_3;
          busy_0 <= holds(0) or in_phase_3;
          in_phase_1 <= flag(known(phase) = 1);

          -- Clock 0
          x <=
            a(0) when known(x_select_at_0) = 0 else
            a(1) when known(x_select_at_0) = 1 else
            a(2) when known(x_select_at_0) = 2 else
            a(3);
          again_line : entity work.tapped_line_8
            port map (clk => clk, x => x, tap => again_select_tap_at_3, y => again);

          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              x_d1 <= x;
            end if;
          end process clock_1;

          -- Clock 2
          clock_2 : process (clk)
          begin
            if rising_edge(clk) then
              square <= x_d1 * x_d1;
            end if;
          end process clock_2;
          sum <= resize(square(15 downto 4), 13) + resize(x_line(4), 13);

          -- Clock 3
          shifted <= resize(again, 9) + resize(shift_at_3, 9);

          -- Selectors, set in the clock before their phase
          selectors : process (clk)
          begin
            if rising_edge(clk) then
              if busy_0 = '1' then
                x_select_at_0 <= to_unsigned(x_select_at_0_table(to_integer(known(phase))), 2);
              end if;
              if busy_3 = '1' then
                again_select_tap_at_3 <= to_unsigned(again_select_tap_at_3_table(to_integer(known(phase))), 4);
                shift_at_3 <= to_signed(shift_at_3_table(to_integer(known(phase))), 8);
              end if;
            end if;
          end process selectors;

          -- Registers that load under an enable
          captures : process (clk)
          begin
            if rising_edge(clk) then
              if in_phase_1 = '1' then
                busy_3 <= holds(0);
              end if;
              if strobe(2) = '1' then
                y <= shifted;
              end if;
              if strobe(1) = '1' then
                z <= sum;
              end if;
            end if;
          end process captures;

          -- Delay lines
          delays : process (clk)
          begin
            if rising_edge(clk) then
              x_line <= x_d1 & x_line(1 to 3);
            end if;
          end process delays;
        end architecture rtl;"#]]
    .assert_eq(&inside(&lowered(&block, 100)));
}

#[test]
fn copies_that_are_held_are_arrays_with_the_numbers_of_the_bundle() {
    let block = block(2, |top| {
        let a = [0; 5].map(|_| top.input(S8, ALL)).to_vec().named("a");
        let b = top.input(S8, ALL).named("b");
        let mut power = b;
        for k in 0..4 {
            power = (power * b).named_at("power", k).negative().choose(b, a[0]);
        }
        let sums: Vec<Sig> = a[1..].iter().map(|a| *a + power).collect();
        [vec![(a[0] + power.negative().choose(a[0], b)).named("y")], sums.named("sums")].concat()
    });
    expect![[r#"
        entity sample is
          port (
            clk   : in  std_logic;
            phase : in  std_logic;  -- phase of the slot: 0 in the first clock of the inputs
            holds : in  std_logic_vector(4 downto 0);  -- whether the slot k slots ago holds a pair
            a     : in  signed_8_x5_t;  -- s4.4; |.| <= 128
            b     : in  signed(7 downto 0);  -- s4.4; |.| <= 128
            y     : out signed(8 downto 0);  -- s5.4; |.| <= 256
            sums  : out signed_9_x4_t  -- s5.4; |.| <= 256
          );
        end entity sample;

        architecture rtl of sample is
          signal power0 : signed(15 downto 0) := (others => '0');  -- s8.8; |.| <= 16384
          signal power1 : signed(15 downto 0) := (others => '0');  -- s8.8; |.| <= 16384
          signal power2 : signed(15 downto 0) := (others => '0');  -- s8.8; |.| <= 16384
          signal power3 : signed(15 downto 0) := (others => '0');  -- s8.8; |.| <= 16384
          signal in_phase_1 : std_logic;
          signal in_flight : std_logic;  -- a pair is in the data path, or may be in the next clock
          signal strobe : std_logic_vector(1 downto 0) := (others => '0');  -- one flag per phase
          signal power_choice_h1 : signed_8_1_to_3_t := zero_signed_8_1_to_3;  -- s4.4; |.| <= 128
          signal b_held : signed_8_x3_t := zero_signed_8_x3;  -- s4.4; |.| <= 128; from clocks 2, 4, 6 on
          signal a0_held : signed_8_x4_t := zero_signed_8_x4;  -- s4.4; |.| <= 128; from clocks 2, 4, ... 8 on
          signal a_held_2 : signed_8_x5_t := zero_signed_8_x5;  -- s4.4; |.| <= 128; from clocks 3, 7 on
          signal b_h3 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal a0_h5 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal b_h5 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal a0_h7 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal b_h7 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
          signal power3_negative_choice : signed(7 downto 0);  -- s4.4; |.| <= 128
          signal a_held : signed_8_1_to_4_x3_t := zero_signed_8_1_to_4_x3;  -- s4.4; |.| <= 128; from clocks 2, 4, 6 on
          signal y_choice_h1 : signed(7 downto 0) := (others => '0');  -- s4.4; |.| <= 128
        begin
          -- Strobes, one per phase, and flags of pairs
          strobes : process (clk)
          begin
            if rising_edge(clk) then
              strobe(0) <= flag(phase = '1') and in_flight;
              strobe(1) <= flag(phase = '0') and in_flight;
            end if;
          end process strobes;
          in_phase_1 <= flag(phase = '1');
          in_flight <= holds(0) or holds(1) or holds(2) or holds(3) or holds(4) or in_phase_1;

          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              power0 <= b * b;
            end if;
          end process clock_1;

          -- Clock 3
          clock_3 : process (clk)
          begin
            if rising_edge(clk) then
              power1 <= power_choice_h1(1) * b_held(0);
            end if;
          end process clock_3;

          -- Clock 5
          clock_5 : process (clk)
          begin
            if rising_edge(clk) then
              power2 <= power_choice_h1(2) * b_held(1);
            end if;
          end process clock_5;

          -- Clock 7
          clock_7 : process (clk)
          begin
            if rising_edge(clk) then
              power3 <= power_choice_h1(3) * b_held(2);
            end if;
          end process clock_7;
          power3_negative_choice <= b_h7 when power3(15) = '1' else a0_h7;
          sums_each : for k in 0 to 3 generate
            sums(k) <= resize(a_held_2(k + 1), 9) + resize(power3_negative_choice, 9);
          end generate sums_each;

          -- Clock 8
          y <= resize(a0_held(3), 9) + resize(y_choice_h1, 9);

          -- Registers that load under an enable
          captures : process (clk)
          begin
            if rising_edge(clk) then
              if strobe(1) = '1' then
                power_choice_h1(1) <= choose(power0(15), b, a(0));
                power_choice_h1(2) <= choose(power1(15), b_h3, a_held_2(0));
                power_choice_h1(3) <= choose(power2(15), b_h5, a0_h5);
                b_held <= b & b_held(0 to 1);
                a0_held <= a(0) & a0_held(0 to 2);
                for m in 1 to 4 loop
                  a_held(0)(m) <= a(m);
                end loop;
                a_held(1 to 2) <= a_held(0 to 1);
                if power3_negative_choice(7) = '1' then
                  y_choice_h1 <= a0_h7;
                else
                  y_choice_h1 <= b_h7;
                end if;
              end if;
              if strobe(0) = '1' then
                a_held_2(0) <= a0_held(0);
                for k in 1 to 4 loop
                  a_held_2(k) <= a_held(2)(k);
                end loop;
                b_h3 <= b_held(0);
                a0_h5 <= a0_held(1);
                b_h5 <= b_held(1);
                a0_h7 <= a0_held(2);
                b_h7 <= b_held(2);
              end if;
            end if;
          end process captures;
        end architecture rtl;"#]]
    .assert_eq(&inside(&lowered(&block, 100)));
}

#[test]
fn memories_flags_and_choices() {
    let module = module(|m| {
        let [reset, write] = ["reset", "write"].map(|name| m.input(name, Type::FLAG));
        let [address, read] = ["address", "read"].map(|name| m.input(name, Type::unsigned(2)));
        let data = m.input("data", S8);
        let word = m.memory("word", write, address, data, read);
        let history = [0, 1, 2].map(|i| m.register(Place::at("history", &[Step::Index(i)]), Type::FLAG));
        history[0].loads(write, None, Some((reset, 0)));
        (1..3).for_each(|i| history[i].loads(history[i - 1], None, Some((reset, 0))));
        let next = read.apply(efsat_hardware::op::Lookup(vec![3, 1, 2], Type::unsigned(2)), &[]).named("next");
        let chosen = read.apply(efsat_hardware::op::Select(None), &[data, word, data.plus(1), word]).named("chosen");
        chosen.output("y");
        (history[2] & !reset).output("was");
        next.output("z");
    });
    expect![[r#"
        entity sample is
          port (
            clk     : in  std_logic;
            reset   : in  std_logic;
            write   : in  std_logic;
            address : in  unsigned(1 downto 0);
            read    : in  unsigned(1 downto 0);
            data    : in  signed(7 downto 0);  -- s4.4
            y       : out signed(7 downto 0);  -- s4.4
            was     : out std_logic;
            z       : out unsigned(1 downto 0)
          );
        end entity sample;

        architecture rtl of sample is
          constant z_table : numbers_t(0 to 3) := (3, 1, 2, others => 0);
          type word_words_t is array (0 to 3) of signed(7 downto 0);
          signal word_words : word_words_t := (others => (others => '0'));
          signal word : signed(7 downto 0);  -- s4.4
          signal history : std_logic_vector(2 downto 0) := (others => '0');
        begin
          y <=
            data when known(read) = 0 else
            word when known(read) = 1 else
            data + 1 when known(read) = 2 else
            word;
          was <= history(2) and not reset;
          z <= to_unsigned(z_table(to_integer(known(read))), 2);

          -- State
          state : process (clk)
          begin
            if rising_edge(clk) then
              if reset = '1' then
                for k in 0 to 2 loop
                  history(k) <= '0';
                end loop;
              else
                history <= history(1 downto 0) & write;
              end if;
            end if;
          end process state;
          write_word : process (clk)
          begin
            if rising_edge(clk) then
              if write = '1' then
                word_words(to_integer(known(address))) <= data;
              end if;
            end if;
          end process write_word;
          word <= word_words(to_integer(known(read)));
        end architecture rtl;"#]]
    .assert_eq(&inside(&module));
}

#[test]
fn instances_that_are_alike_are_generated() {
    let block = block(1, |top| {
        let v = Vec3::each(|_| top.input(S8, ALL)).named("v");
        let a = top.input(S8, ALL).named("a");
        let each = Vec3::each(|i| {
            let x = v[i + 1];
            entity!("part", &["One of three."], (x, a) => (x * a).named("p")).named_at("y", i)
        });
        let x = a;
        let alone = entity!("part", &["One of three."], (x, a) => (x * a).named("p")).named("z");
        [each.signals(), vec![alone]].concat()
    });
    expect![[r#"
        entity sample is
          port (
            clk : in  std_logic;
            v   : in  signed_8_vector_t;  -- s4.4; |.| <= 128
            a   : in  signed(7 downto 0);  -- s4.4; |.| <= 128
            y   : out signed_16_x3_t;  -- s8.8; |.| <= 16384
            z   : out signed(15 downto 0)  -- s8.8; |.| <= 16384
          );
        end entity sample;

        architecture rtl of sample is
        begin
          -- Clock 0
          y_unit : for k in 0 to 2 generate
            unit : entity work.part
              port map (clk => clk, x => v((k + 1) mod 3), a => a, p => y(k));
          end generate y_unit;
          z_unit : entity work.part
            port map (clk => clk, x => a, a => a, p => z);
        end architecture rtl;"#]]
    .assert_eq(&inside(&lowered(&block, 100)));
}

#[test]
fn ports_of_a_top_are_plain_vectors_and_may_be_left_open() {
    let top = module(|m| {
        let a = m.input("a", S8).or(true);
        let go = m.input("go", Type::FLAG).or(false);
        let q = m.register("q", S8);
        q.loads(a, Some(go), None);
        q.output("y");
        go.output("gone");
    });
    expect![[r#"
        entity sample is
          port (
            clk  : in  std_logic;
            a    : in  std_logic_vector(7 downto 0) := (others => '1');  -- s4.4
            go   : in  std_logic := '0';
            y    : out std_logic_vector(7 downto 0);  -- s4.4
            gone : out std_logic
          );
        end entity sample;

        architecture rtl of sample is
          signal q : signed(7 downto 0) := (others => '0');  -- s4.4
        begin
          -- Registers that load under an enable
          captures : process (clk)
          begin
            if rising_edge(clk) then
              if go = '1' then
                q <= signed(a);
              end if;
            end if;
          end process captures;

          -- Outputs
          y <= std_logic_vector(q);
          gone <= go;
        end architecture rtl;"#]]
    .assert_eq(&entity(&top, "sample"));
}

#[test]
fn names_that_a_tool_would_refuse_are_told() {
    let clash = |names: [&str; 2]| {
        let module = module(|m| {
            let [a, b] = names.map(|name| m.input(name, Type::FLAG));
            (a & b).output("y");
        });
        vhdl::print(&module, "", "types", &[]).expect_err("a name is refused").to_string()
    };
    lines(
        expect![[r#"
        sample: signal: is a keyword of VHDL-87
        sample: clk: is used twice
        sample: A: does not begin with a lower-case letter
        sample: b__c: has a trailing or double underscore
    "#]],
        [clash(["a", "signal"]), clash(["a", "clk"]), clash(["a", "A"]), clash(["a", "b__c"])],
    );
}
