//! Operations that no clock holds, in parts.

use super::*;
use efsat_hardware::graph::Signals;
use efsat_hardware::graph::evaluate::Evaluator;
use efsat_hardware::netlist::simulate::Simulation;
use efsat_hardware::op::{Add, Equal, Less, Magnitude, Negate, NegateIf, OrReduce, Select, Subtract};
use efsat_hardware::{testing, tools, vhdl};
use expect_test::expect;
use std::process::Command;

type Make = for<'l> fn(&[Sig<'l>; 3]) -> Sig<'l>;

/// Of two wide numbers and an index.
const MADE: [(&str, Make); 11] = [
    ("a_plus_b", |[a, b, _]| a.apply(Add(None), &[*b])),
    ("cut_sum", |[a, b, _]| a.floor(1).apply(Add(Some(WIDE.bits)), &[b.floor(1)])),
    ("mixed_sum", |[a, b, _]| a.apply(Add(None), &[b.low(40)])),
    ("a_minus_b", |[a, b, _]| a.apply(Subtract(None), &[*b])),
    ("minus_a", |[a, ..]| a.apply(Negate(None), &[])),
    ("under_flag", |[a, b, _]| b.negative().apply(NegateIf, &[*a])),
    ("size_of_a", |[a, ..]| a.apply(Magnitude, &[])),
    ("is_less", |[a, b, _]| a.apply(Less, &[*b])),
    ("is_equal", |[a, b, _]| a.apply(Equal, &[*b])),
    ("is_any", |[a, b, _]| (*a - *b).low(60).apply(OrReduce, &[])),
    ("chosen", |[a, b, index]| {
        index
            .apply(Select::default(), &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11].map(|k| if k == 4 { *b } else { a.like(k) }))
    }),
];

const WIDE: Type = Type::signed(75, 30);

fn made() -> Rc<Block> {
    let most = WIDE.limits().1;
    block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(WIDE, (-most, most)).named(name));
        let index = top.input(Type::unsigned(4), (0, 12)).named("index");
        MADE.map(|(name, make)| make(&[a, b, index]).named(name)).to_vec()
    })
}

/// Where carries run through all parts, and where they do not.
fn values() -> Vec<[i128; 3]> {
    let most = WIDE.limits().1;
    let mut numbers = vec![0, 1, -1, most, -most];
    numbers.extend((3..74).step_by(7).flat_map(|bit| [1 << bit, (1 << bit) - 1, -(1 << bit), most ^ (1 << bit)]));
    let pairs = numbers.iter().flat_map(|a| numbers.iter().map(move |b| (*a, *b)));
    pairs.enumerate().map(|(i, (a, b))| [a, b, i as i128 % 13]).collect()
}

#[test]
fn parts_make_the_whole() {
    let (block, values) = (made(), values());
    let mut evaluator = Evaluator::new(&block);
    for device in device::names() {
        for megahertz in [20, 150, 200, 250] {
            let module = lowered_for(device, &block, megahertz).0;
            let latency = module.latency.expect("a latency") as usize;
            let mut simulation = Simulation::new(&module, values.len() + latency);
            for (clock, inputs) in values.iter().enumerate() {
                inputs.iter().enumerate().for_each(|(port, value)| simulation.set(port, clock, *value));
            }
            simulation.run();
            for (clock, inputs) in values.iter().enumerate() {
                evaluator.run(inputs);
                for (port, (name, _)) in MADE.iter().enumerate() {
                    let expected = evaluator.at(evaluator.flat().outputs[port], 0);
                    let found = simulation.output(port, clock + latency);
                    assert_eq!(found, expected, "{name} of {inputs:?}, {device}, {megahertz} MHz");
                }
            }
        }
    }
}

#[test]
fn ghdl_takes_the_parts() {
    let Some(tool) = tools::ghdl(true) else { return testing::skip("GHDL is not installed") };
    for device in device::names() {
        for megahertz in [150, 200, 250] {
            let folder = tempfile::tempdir().expect("a folder");
            let module = lowered_for(device, &made(), megahertz).0;
            let files = vhdl::print(&module, "", "sample_types", &[]).expect("legal names");
            let text: String = files.into_iter().map(|(_, text)| text + "\n").collect();
            std::fs::write(folder.path().join("sample.vhd"), text).expect("a file");
            let output = Command::new(&tool.path)
                .args(["-a", "--std=93", "sample.vhd"])
                .current_dir(&folder)
                .output()
                .expect("GHDL");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{device}, {megahertz} MHz: {said}");
        }
    }
}

/// What a clock holds is left as it is, and all of these operations fit in one of parts of today.
#[test]
fn the_clock_is_met_and_slow_ones_divide_nothing() {
    let block = made();
    for device in device::names() {
        let slow = scheduled_for(device, &block, 20);
        assert!(Rc::ptr_eq(&slow.block, &block), "{device}");
        let most = if device == "lfe5u-85-6" { 180 } else { 250 };
        let fast = scheduled_for(device, &block, most);
        let (ns, end) = &fast.critical;
        assert!(part(device).megahertz(*ns) >= f64::from(most), "{device}: {end} {ns}");
        // A chain of so many bits takes 1.5 ns of an UltraScale+.
        let divides = device != "xczu3eg-1";
        assert_eq!(fast.block.nodes.len() > block.nodes.len(), divides, "{device}");
        assert!(!divides || fast.latency > slow.latency, "{device}");
    }
}

#[test]
fn a_sum_in_two_parts() {
    let ty = Type::signed(75, 0);
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(ty, ty.limits()).named(name));
        vec![(a + b).named("y")]
    });
    let module = lowered_for("xc7a200t-1", &block, 250).0;
    let files = vhdl::print(&module, "", "sample_types", &[]).expect("legal names");
    let (_, text) = files.into_iter().find(|file| file.0 == "sample").expect("an entity of that name");
    expect![[r#"
        architecture rtl of sample is
          signal y_a_wide : signed(75 downto 0);  -- s76.0; |.| <= 18889465931478580854784
          signal y_b_wide : signed(75 downto 0);  -- s76.0; |.| <= 18889465931478580854784
          signal y_low : unsigned(38 downto 0);
          signal y_a_up_h1 : signed(38 downto 0) := (others => '0');  -- |.| <= 137438953471
          signal y_b_up_h1 : signed(38 downto 0) := (others => '0');  -- |.| <= 137438953472
          signal y_high : signed(38 downto 0);  -- |.| <= 274877906943
          signal y_sum_low_h1 : unsigned(37 downto 0) := (others => '0');
          signal y_i : signed(75 downto 0);  -- s76.0; |.| <= 37778931862957161709568
        begin
          -- Clock 0
          y_a_wide <= resize(signed(a), 76);
          y_b_wide <= resize(signed(b), 76);
          y_low <= resize(unsigned(y_a_wide(37 downto 0)), 39) + resize(unsigned(y_b_wide(37 downto 0)), 39);

          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              y_a_up_h1 <= y_a_wide(75 downto 38) & '1';
              y_b_up_h1 <= y_b_wide(75 downto 38) & y_low(38);
              y_sum_low_h1 <= y_low(37 downto 0);
            end if;
          end process clock_1;
          y_high <= y_a_up_h1 + y_b_up_h1;
          y_i <= y_high(38 downto 1) & signed(y_sum_low_h1);

          -- Outputs
          y <= std_logic_vector(y_i);
        end architecture rtl;"#]]
    .assert_eq(&text[text.find("architecture").expect("a body")..]);
}
