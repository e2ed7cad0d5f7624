//! Sums of products as chains of multipliers.

use super::*;
use efsat_hardware::estimate;
use efsat_hardware::graph::evaluate::Evaluator;
use efsat_hardware::graph::{Phases, Signals};
use efsat_hardware::netlist::simulate::Simulation;
use efsat_hardware::{dump, entity, vhdl};
use expect_test::expect;

const FACTOR: Type = Type::signed(18, 0);
const PART: &str = "xc7a200t-1";

type Make = for<'l> fn(&[Sig<'l>], &[Sig<'l>]) -> Vec<Sig<'l>>;

/// Product `k` by an entity.
fn product<'l>(k: usize, x: Sig<'l>, y: Sig<'l>) -> Sig<'l> {
    entity!("multiply", &[], (x, y) => (x * y).named("p")).named_at("product", k)
}

/// Of two vectors, by name and how many chains there are.
const MADE: [(&str, usize, Make); 16] = [
    ("dot", 1, |a, b| vec![a[0] * b[0] + a[1] * b[1] + a[2] * b[2]]),
    ("of_entities", 1, |a, b| vec![product(0, a[0], b[0]) + product(1, a[1], b[1])]),
    ("difference", 1, |a, b| vec![product(0, a[0], b[1]) - product(1, a[1], b[0])]),
    ("negative", 1, |a, b| vec![a[0] - (product(0, a[1], b[1]) + product(1, a[2], b[2]))]),
    ("mixed", 1, |a, b| vec![a[0].like(-1000) - a[0] * b[0] - (a[1] * b[1] - a[2] * b[2]) + a[3] * b[3]]),
    ("long", 2, |a, b| vec![(0..7).map(|k| product(k, a[k], b[k])).reduce(|x, y| x + y).expect("products")]),
    ("narrow", 1, |a, b| {
        vec![(product(0, a[0].low(4).bits(18).resize(FACTOR), b[0]).bits(22) + product(1, a[1], b[1])).bits(37)]
    }),
    ("beside_others", 1, |a, b| vec![(product(0, a[0], b[0]) - a[1]) + (product(1, a[2], b[2]) - (a[3] + b[3]))]),
    // What is read elsewhere stays.
    ("read_twice", 0, |a, b| {
        let product = (a[0] * b[0]).named("read");
        vec![product + a[1] * b[1], product.floor(3)]
    }),
    ("sum_read_twice", 1, |a, b| {
        let sum = (a[0] * b[0] + a[1] * b[1]).named("read");
        vec![sum + a[2] * b[2], sum.floor(3)]
    }),
    ("square", 0, |a, b| vec![a[0] * b[0] + b[1]]),
    ("of_two_kinds", 1, |a, b| {
        let short = (a[0].floor(9).at_point(Some(3)) * b[0]).at_point(Some(0)).named("short");
        vec![a[1] * b[1] + (short - a[2] * b[2])]
    }),
    ("less_unsigned", 1, |a, b| vec![a[0] - (a[1] * b[1] + a[2] * b[2] + b[0].low(5).at_point(Some(0)) + a[3].low(1))]),
    ("less_all", 1, |a, b| vec![a[0].like(0) - (a[1] * b[1] + a[2] * b[2]) - a[3]]),
    ("other_points", 1, |a, b| {
        let inner = a[0].at_point(Some(2)) * b[0].at_point(Some(1)) + b[2].at_point(Some(3));
        vec![inner.at_point(Some(0)) + a[1] * b[1]]
    }),
    // No multiplier takes both factors.
    ("too_wide", 0, |a, b| vec![a[0].bits(28) * b[0] + a[1].bits(28) * b[1]]),
];

fn made(make: Make) -> Rc<Block> {
    block(1, |top| {
        let factors = |name: &str| (0..7).map(|_| top.input(FACTOR, FACTOR.limits())).collect::<Vec<_>>().named(name);
        let [a, b] = ["a", "b"].map(factors);
        make(&a, &b).into_iter().enumerate().map(|(k, y)| y.named_at("y", k)).collect()
    })
}

fn chains(module: &Module) -> Vec<&str> {
    module.instances.iter().map(|i| &i.module.name[..]).filter(|name| name.contains("_chain_")).collect()
}

#[test]
fn chains_make_the_sums() {
    let (most, least) = (FACTOR.limits().1, FACTOR.limits().0);
    let numbers: Vec<i128> =
        (0..80i128).map(|k| k * k * 7919 % most - most / 2).chain([most, least, 0, least]).collect();
    for (name, count, make) in MADE {
        let block = made(make);
        let mut evaluator = Evaluator::new(&block);
        for device in device::names() {
            for megahertz in [50, 200, 300] {
                let module = lowered_for(device, &block, megahertz).0;
                let chained = part(device).adder > 0;
                assert_eq!(chains(&module).len(), if chained { count } else { 0 }, "{name}, {device}, {megahertz} MHz");
                let latency = module.latency.expect("a latency") as usize;
                let mut simulation = Simulation::new(&module, numbers.len() + latency);
                let input = |port: usize, clock: usize| match clock % 5 {
                    0 => [most, least][(port + clock / 5) % 2],
                    _ => numbers[(clock + 31 * port) % numbers.len()],
                };
                for clock in 0..numbers.len() {
                    (0..14).for_each(|port| simulation.set(port, clock, input(port, clock)));
                }
                simulation.run();
                for clock in 0..numbers.len() {
                    evaluator.run(&(0..14).map(|port| input(port, clock)).collect::<Vec<_>>());
                    for (port, output) in evaluator.flat().outputs.iter().enumerate() {
                        let (found, expected) = (simulation.output(port, clock + latency), evaluator.at(*output, 0));
                        assert_eq!(found, expected, "{name}, {device}, {megahertz} MHz, clock {clock}");
                    }
                }
            }
        }
    }
}

/// Two products of one multiplier in two phases are no chain, and a chain whose multipliers are shared by phases is right.
#[test]
fn products_of_phases() {
    let block = block(3, |top| {
        let ty = Type::signed(8, 0);
        let a: Vec<Sig> = (0..6).map(|_| top.input(ty, ty.limits())).collect::<Vec<_>>().named("a");
        let phases = Phases::new(3, |s| Some([a[s], a[s + 1], a[s + 2], a[s + 3]]));
        let [x, y, z, w] = phases.mux();
        let [x, y, z, w] = [x.named("x"), y.named("y"), z.named("z"), w.named("w")];
        let shared = (x * y).named("shared");
        let captured: Vec<Sig> = phases.capture(&shared).map(|(_, p)| p).collect::<Vec<_>>().named("captured");
        let sum = (x * z + y * w).named("sum");
        let sums: Vec<Sig> = phases.capture(&sum).map(|(_, p)| p).collect::<Vec<_>>().named("sums");
        vec![(captured[0] + captured[1] + captured[2]).named("of_phases"), (sums[0] - sums[2]).named("of_chains")]
    });
    let module = lowered_for(PART, &block, 200).0;
    assert_eq!(chains(&module), ["sample_multiply_8_8_chain_2"]);
}

/// A chain takes no tables; of factors that wait the multiplier takes two clocks in.
#[test]
fn what_a_chain_takes() {
    let cells = |name: &str, megahertz: u32| {
        let make = MADE.iter().find(|made| made.0 == name).expect("of that name").2;
        let all = estimate::whole(&lowered_for(PART, &made(make), megahertz).0, part(PART));
        [all.multipliers, all.luts, all.memory_luts, all.flip_flops]
    };
    assert_eq!(cells("dot", 200), [3, 0, 0, 0]);
    assert_eq!(cells("difference", 200), [2, 0, 0, 0]);
    // Factors have registers in front, and those of the third wait once more in flip-flops.
    assert_eq!(cells("dot", 250), [3, 0, 0, 36]);
}

#[test]
fn a_difference_and_a_constant() {
    let block = made(|a, b| vec![product(0, a[0], b[1]) - (product(1, a[1], b[0]) + a[0].like(-5))]);
    let module = lowered_for(PART, &block, 200).0;
    let files = vhdl::print(&module, "", "sample_types", &[]).expect("legal names");
    let text: String = module.hierarchy().iter().map(|module| dump::module(module)).collect();
    let (_, printed) = files.into_iter().find(|file| file.0.contains("_chain_")).expect("a chain");
    expect![[r#"
        module multiply_chain_1_less_1_plus_5, latency 3 clocks
          -- p = 5 + x(0) y(0) - x(1) y(1), a chain of multipliers: each adds its product to what
          -- the one before has made, and takes its factors a clock later.
          x0               18 bits  -131072..131071            clock 0  Port
          x1               18 bits  -131072..131071            clock 0  Port
          y0               18 bits  -131072..131071            clock 0  Port
          y1               18 bits  -131072..131071            clock 0  Port
          product0         36 bits  -17179738112..17179869184  clock 1  Register of Multiply x0, y0
          (sum0_constant)  4 bits   5..5                                Constant(5, 4 bits)
          sum0             37 bits  -17179738107..17179869189  clock 2  Register of Accumulate { minus: false } sum0_constant, product0
          x1_d1            18 bits  -131072..131071            clock 1  Register of x1
          y1_d1            18 bits  -131072..131071            clock 1  Register of y1
          product1         36 bits  -17179738112..17179869184  clock 2  Register of Multiply x1_d1, y1_d1
          p                38 bits  -34359607291..34359607301  clock 3  Register of Accumulate { minus: true } sum0, product1
          output p: p
        module sample, latency 3 clocks
          a0  s18.0  -131072..131071            clock 0  Port
          a1  s18.0  -131072..131071            clock 0  Port
          a2  s18.0  -131072..131071            clock 0  Port
          a3  s18.0  -131072..131071            clock 0  Port
          a4  s18.0  -131072..131071            clock 0  Port
          a5  s18.0  -131072..131071            clock 0  Port
          a6  s18.0  -131072..131071            clock 0  Port
          b0  s18.0  -131072..131071            clock 0  Port
          b1  s18.0  -131072..131071            clock 0  Port
          b2  s18.0  -131072..131071            clock 0  Port
          b3  s18.0  -131072..131071            clock 0  Port
          b4  s18.0  -131072..131071            clock 0  Port
          b5  s18.0  -131072..131071            clock 0  Port
          b6  s18.0  -131072..131071            clock 0  Port
          y0  s38.0  -34359607291..34359607301  clock 3  p of y0_chain
          instance y0_chain: multiply_chain_1_less_1_plus_5 of a0, a1, b1, b0
          output y0: y0
    "#]].assert_eq(&text);
    expect![[r#"
        architecture rtl of multiply_chain_1_less_1_plus_5 is
          signal product0 : signed(35 downto 0) := (others => '0');  -- |.| <= 17179869184
          signal sum0 : signed(36 downto 0) := (others => '0');  -- |.| <= 17179869189
          signal x1_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131072
          signal y1_d1 : signed(17 downto 0) := (others => '0');  -- |.| <= 131072
          signal product1 : signed(35 downto 0) := (others => '0');  -- |.| <= 17179869184
        begin
          -- Clock 1
          clock_1 : process (clk)
          begin
            if rising_edge(clk) then
              product0 <= x(0) * y(0);
              x1_d1 <= x(1);
              y1_d1 <= y(1);
            end if;
          end process clock_1;

          -- Clock 2
          clock_2 : process (clk)
          begin
            if rising_edge(clk) then
              sum0 <= 5 + resize(product0, 37);
              product1 <= x1_d1 * y1_d1;
            end if;
          end process clock_2;

          -- Clock 3
          clock_3 : process (clk)
          begin
            if rising_edge(clk) then
              p <= resize(sum0, 38) - resize(product1, 38);
            end if;
          end process clock_3;
        end architecture rtl;"#]]
    .assert_eq(&printed[printed.find("architecture").expect("a body")..]);
}
