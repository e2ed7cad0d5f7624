//! Modules small enough to be counted by hand.

use super::*;
use crate::device;
use crate::graph::netlist::ModuleBuilder;

const NAMES: [&str; 4] = ["xc2v6000-4", "xc6slx150-3", "xc7a200t-1", "lfe5u-85-6"];

fn module(build: impl FnOnce(&mut ModuleBuilder)) -> std::rc::Rc<Module> {
    let mut b = ModuleBuilder::new("unit", vec![]);
    build(&mut b);
    b.finish()
}

fn of(module: &Module, name: &str) -> Resources {
    own(module, device::find(name).unwrap())
}

fn registered(b: &mut ModuleBuilder, name: &str, d: SignalId) -> SignalId {
    let q = b.register(name, b.ty(d));
    b.drive(q, d, None, None);
    q
}

#[test]
fn a_sum_takes_a_table_and_a_carry_a_bit() {
    let sum = module(|b| {
        let (x, y) = (b.input("x", Type::signed(8, 0)), b.input("y", Type::signed(8, 0)));
        let sum = b.op("sum", Op::Add, &[x, y]);
        b.output("z", sum);
    });
    // Nine bits, of which the top two have the same operands.
    assert_eq!(of(&sum, NAMES[0]), Resources { luts: 8, carry: 8, ..Resources::default() });
    assert_eq!(of(&sum, NAMES[2]), Resources { luts: 8, carry: 12, ..Resources::default() }, "three cells of four");
    // Five carry cells of two bits, each of two tables.
    assert_eq!(of(&sum, NAMES[3]), Resources { luts: 10, carry: 10, ..Resources::default() });
}

#[test]
fn bits_that_are_constant_or_not_read_take_nothing() {
    let cut = module(|b| {
        let x = b.input("x", Type::signed(8, 0));
        let wide = b.op("wide", Op::Resize(Type::signed(12, 0)), &[x]);
        let held = registered(b, "held", wide);
        let high = b.op("high", Op::Floor(3), &[held]);
        b.output("z", high);
    });
    // Bits 3 to 7; the four above are copies of bit 7.
    assert_eq!(of(&cut, NAMES[0]), Resources { flip_flops: 5, ..Resources::default() });
}

#[test]
fn a_choice_in_front_of_a_sum_is_one_table_a_bit() {
    let unit = module(|b| {
        let [x, y, z] = ["x", "y", "z"].map(|name| b.input(name, Type::unsigned(8)));
        let flag = b.input("flag", Type::FLAG);
        let chosen = b.op("chosen", Op::Select, &[flag, x, y]);
        let sum = b.op("sum", Op::Add, &[z, chosen]);
        b.output("s", sum);
    });
    // The top bit is the last carry alone.
    assert_eq!(of(&unit, NAMES[0]).luts, 8);
    assert_eq!(of(&unit, NAMES[3]).luts, 8 + 10, "a complete chain leaves no room for the choice");
}

#[test]
fn a_comparison_with_a_constant_takes_a_carry_for_every_table_of_bits() {
    let clamp = module(|b| {
        let x = b.input("x", Type::signed(18, 0));
        let clamped = b.op("clamped", Op::Clamp(77_777, "none"), &[x]);
        b.output("z", clamped);
    });
    // Two comparisons, each of five groups of four bits; or of three groups of six, in a cell of four.
    assert_eq!(of(&clamp, NAMES[0]).carry, 10);
    assert_eq!(of(&clamp, NAMES[2]).carry, 8);
    assert_eq!(of(&clamp, NAMES[3]).carry, 36);
}

#[test]
fn registers_of_products_are_where_the_family_has_them() {
    let product = module(|b| {
        let (x, y) = (b.input("x", Type::signed(10, 0)), b.input("y", Type::signed(12, 0)));
        let (x, y) = (registered(b, "x_d", x), registered(b, "y_d", y));
        let product = b.op("product", Op::Multiply, &[x, y]);
        let first = registered(b, "first", product);
        let second = registered(b, "second", first);
        b.output("z", second);
    });
    let flip_flops = |name| of(&product, name).flip_flops;
    assert!(NAMES.iter().all(|name| of(&product, name).multipliers == 1));
    assert_eq!(flip_flops(NAMES[0]), 22 + 22, "MULT18X18S has one register behind the product");
    assert_eq!(flip_flops(NAMES[1]), 0, "DSP48A1 has one around it on every side, two behind");
    assert_eq!(flip_flops(NAMES[3]), 22 + 22, "so has MULT18X18D");
}

#[test]
fn small_products_are_made_of_tables() {
    let product = |bits| {
        module(|b| {
            let (x, y) = (b.input("x", Type::signed(bits, 0)), b.input("y", Type::signed(5, 0)));
            let product = b.op("product", Op::Multiply, &[x, y]);
            b.output("z", product);
        })
    };
    assert_eq!(of(&product(4), NAMES[0]), Resources { multipliers: 1, ..Resources::default() });
    let small = of(&product(3), NAMES[0]);
    assert!(small.multipliers == 0 && small.luts > 0, "{small:?}");
    assert_eq!(of(&product(3), NAMES[3]), Resources { multipliers: 1, ..Resources::default() });
}

#[test]
fn long_delays_are_shift_registers() {
    let line = |clocks: usize, tap: Option<usize>| {
        module(|b| {
            let mut x = b.input("x", Type::unsigned(4));
            for i in 0..clocks {
                x = registered(b, &format!("d{i}"), x);
                if tap == Some(i) {
                    b.output("tap", x);
                }
            }
            b.output("z", x);
        })
    };
    let taken = |clocks, tap, name| {
        let all = of(&line(clocks, tap), name);
        (all.flip_flops, all.memory_luts)
    };
    assert_eq!(taken(2, None, NAMES[0]), (8, 0));
    assert_eq!(taken(3, None, NAMES[0]), (0, 4));
    assert_eq!(taken(17, None, NAMES[0]), (0, 8), "an SRL16 makes sixteen clocks");
    assert_eq!(taken(17, None, NAMES[2]), (0, 4), "an SRLC32 more");
    assert_eq!(taken(9, Some(1), NAMES[0]), (8, 4), "a tap ends the line before it");
    assert_eq!(taken(9, None, NAMES[3]), (36, 0));
}

#[test]
fn registers_that_depend_on_themselves_are_counted() {
    let counter = module(|b| {
        let flag = b.input("flag", Type::FLAG);
        let count = b.register("count", Type::unsigned(4));
        let one = b.constant("one", 1, Type::FLAG);
        let next = b.op("next", Op::Add, &[count, one]);
        let next = b.op("next_bits", Op::Resize(Type::unsigned(4)), &[next]);
        b.drive(count, next, Some(flag), None);
        b.output("z", count);
    });
    // The lowest bit is inverted, the others are copies into the chain.
    assert_eq!(of(&counter, NAMES[0]), Resources { luts: 1, flip_flops: 4, carry: 3, ..Resources::default() });
}

#[test]
fn instances_count_each() {
    let device = device::find(NAMES[0]).unwrap();
    let inner = module(|b| {
        let (x, y) = (b.input("x", Type::FLAG), b.input("y", Type::FLAG));
        let both = b.op("both", Op::And, &[x, y]);
        b.output("z", both);
    });
    let outer = module(|b| {
        let (x, y) = (b.input("x", Type::FLAG), b.input("y", Type::FLAG));
        let first = b.instance("first", &inner, &[x, y])[0];
        let second = b.instance("second", &inner, &[first, y])[0];
        b.output("q", second);
    });
    assert_eq!(own(&outer, device), Resources::default());
    assert_eq!(whole(&outer, device).luts, 2);
}
