//! Modules small enough to be counted by hand.

use super::*;
use crate::device;
use crate::netlist::{Control, Wire};
use crate::op::{Add, And, Floor, Less, Multiply, Resize};

const NAMES: [&str; 5] = ["xc2v6000-4", "xc6slx150-3", "xc7a200t-1", "lfe5u-85-6", "lifcl-40-9"];

fn module(build: impl FnOnce(&Control)) -> std::rc::Rc<Module> {
    let control = Control::new("unit", vec![]);
    build(&control);
    control.finish()
}

fn of(module: &Module, name: &str) -> Resources {
    own(module, device::find(name).unwrap())
}

fn registered<'m>(b: &'m Control, name: &str, d: Wire<'m>) -> Wire<'m> {
    let q = b.register(name, d.ty());
    q.loads(d, None, None);
    q
}

#[test]
fn a_sum_takes_a_table_and_a_carry_a_bit() {
    let sum = module(|b| {
        let (x, y) = (b.input("x", Type::signed(8, 0)), b.input("y", Type::signed(8, 0)));
        x.apply(Add(None), &[y]).output("z");
    });
    // Nine bits, of which the top two have the same operands.
    assert_eq!(of(&sum, NAMES[0]), Resources { luts: 8, carry: 8, ..Resources::default() });
    assert_eq!(of(&sum, NAMES[2]), Resources { luts: 8, carry: 12, ..Resources::default() }, "three cells of four");
    // Five carry cells of two bits, each of two tables.
    assert_eq!(of(&sum, NAMES[3]), Resources { luts: 10, carry: 10, ..Resources::default() });
    assert_eq!(
        of(&sum, NAMES[4]),
        Resources { luts: 12, carry: 12, ..Resources::default() },
        "and one for the carry in"
    );
}

#[test]
fn bits_that_are_constant_or_not_read_take_nothing() {
    let cut = module(|b| {
        let x = b.input("x", Type::signed(8, 0));
        let wide = x.apply(Resize(Type::signed(12, 0)), &[]);
        registered(b, "held", wide).apply(Floor(3), &[]).output("z");
    });
    // Bits 3 to 7; the four above are copies of bit 7.
    assert_eq!(of(&cut, NAMES[0]), Resources { flip_flops: 5, ..Resources::default() });
}

#[test]
fn a_multiplexer_in_front_of_a_sum_is_one_table_a_bit() {
    let unit = module(|b| {
        let [x, y, z] = ["x", "y", "z"].map(|name| b.input(name, Type::unsigned(8)));
        let flag = b.input("flag", Type::FLAG);
        z.apply(Add(None), &[flag.choose(y, x)]).output("s");
    });
    // The top bit is the last carry alone.
    assert_eq!(of(&unit, NAMES[0]).luts, 8);
    assert_eq!(of(&unit, NAMES[3]).luts, 8 + 10, "a complete chain leaves no room for the multiplexer");
}

#[test]
fn a_comparison_takes_a_carry_for_every_bit() {
    let less = module(|b| {
        let (x, y) = (b.input("x", Type::signed(18, 0)), b.input("y", Type::signed(18, 0)));
        x.apply(Less, &[y]).output("z");
    });
    // The difference has a bit more; the sum of the top bit needs no carry out of it and the same table as the bit below.
    assert_eq!(of(&less, NAMES[0]), Resources { luts: 18, carry: 18, ..Resources::default() });
}

#[test]
fn registers_of_products_are_where_the_family_has_them() {
    let product = module(|b| {
        let (x, y) = (b.input("x", Type::signed(10, 0)), b.input("y", Type::signed(12, 0)));
        let (x, y) = (registered(b, "x_d", x), registered(b, "y_d", y));
        let first = registered(b, "first", x.apply(Multiply, &[y]));
        registered(b, "second", first).output("z");
    });
    let flip_flops = |name| of(&product, name).flip_flops;
    assert!(NAMES.iter().all(|name| of(&product, name).multipliers == 1));
    assert_eq!(flip_flops(NAMES[0]), 22 + 22, "MULT18X18S has one register behind the product");
    assert_eq!(flip_flops(NAMES[1]), 0, "DSP48A1 has one around it on every side, two behind");
    assert_eq!([3, 4].map(|i| flip_flops(NAMES[i])), [22 + 22; 2], "so have MULT18X18D and Nexus' MULT18X18");
}

#[test]
fn small_products_are_made_of_tables() {
    let product = |bits| {
        module(|b| {
            let (x, y) = (b.input("x", Type::signed(bits, 0)), b.input("y", Type::signed(5, 0)));
            x.apply(Multiply, &[y]).output("z");
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
                    x.output("tap");
                }
            }
            x.output("z");
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
        count.loads(count.plus(1), Some(flag), None);
        count.output("z");
    });
    // The lowest bit is inverted, the others are copies into the chain.
    assert_eq!(of(&counter, NAMES[0]), Resources { luts: 1, flip_flops: 4, carry: 3, ..Resources::default() });
}

#[test]
fn instances_count_each() {
    let device = device::find(NAMES[0]).unwrap();
    let inner = module(|b| {
        let (x, y) = (b.input("x", Type::FLAG), b.input("y", Type::FLAG));
        x.apply(And, &[y]).output("z");
    });
    let outer = module(|b| {
        let (x, y) = (b.input("x", Type::FLAG), b.input("y", Type::FLAG));
        let first = b.instance("first", &inner, &[x, y])[0];
        let second = b.instance("second", &inner, &[first, y])[0];
        second.output("q");
    });
    assert_eq!(own(&outer, device), Resources::default());
    assert_eq!(whole(&outer, device).luts, 2);
}
