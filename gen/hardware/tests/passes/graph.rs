//! Building graphs: ranges, types and rates of nodes, and what is refused.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::entity;
use efsat_hardware::graph::{Fact, Phases, Signals, Vec3};
use efsat_hardware::op::Multiply;
use expect_test::expect;

#[test]
fn ranges_follow_from_those_of_operands() {
    let block = block(1, |top| {
        let a = top.input(S8, (-3, 100)).named("a");
        let b = top.input(S8, (5, 7)).named("b");
        let product = (a * b).named("product");
        let low = product.low(4).named("low");
        let sum = (a + b).named("sum");
        let sign = (a - b).negative().named("sign");
        let at_least = b.positive(3).named("at_least");
        vec![product, low, sum, sign, at_least, a.magnitude().named("size"), sign.choose(a, b).named("chosen")]
    });
    expect![[r#"
        block sample, 1 phase
          a                    s4.4   -3..100   pair  Input
          b                    s4.4   5..7      pair  Input
          product              s8.8   -21..700  pair  Multiply a, b
          low                  u-4.8  0..15     pair  LowBits(4) product
          sum                  s5.4   2..107    pair  Add a, b
          (sign_difference)    s5.4   -10..95   pair  Subtract a, b
          sign                 flag   0..1      pair  SignBit sign_difference
          (at_least_low)       u-1.4  5..7      pair  LowBits(3) b
          (at_least_negative)  flag   0..0      pair  SignBit b
          (at_least_constant)  u-1.4  0..0      any   Constant(0, u-1.4)
          at_least             u-1.4  5..7      pair  Select at_least_negative, at_least_low, at_least_constant
          size                 u4.4   0..100    pair  Magnitude a
          chosen               s4.4   -3..100   pair  Select sign, b, a
          output product: product
          output low: low
          output sum: sum
          output sign: sign
          output at_least: at_least
          output size: size
          output chosen: chosen
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn operations_on_constants_are_constants() {
    let block = block(1, |top| {
        let a = top.input(S8, ALL).named("a");
        let five = a.like(5);
        let flag = a.less(five).named("flag");
        // A flag that is always set changes nothing.
        let both = (top.constant(1, Type::FLAG) & flag).named("both");
        // Values, not the bounds of their ranges.
        let or = five.low(3).at_point(None) | top.constant(2, Type::unsigned(3));
        let odd = five.low(1).at_point(None) & five.equals(five);
        vec![
            both,
            (a + (five + five)).named("sum"),
            (a.low(3).at_point(None) & or).named("or"),
            (flag | odd).named("odd"),
        ]
    });
    expect![[r#"
        block sample, 1 phase
          a                s4.4    -128..127  pair  Input
          (both_constant)  s4.4    5..5       any   Constant(5, s4.4)
          both             flag    0..1       pair  Less a, both_constant
          (or_constant)    3 bits  7..7       any   Constant(7, 3 bits)
          (odd_constant)   flag    1..1       any   Constant(1, flag)
          (sum_constant)   s5.4    10..10     any   Constant(10, s5.4)
          sum              s6.4    -118..137  pair  Add a, sum_constant
          (or_low)         u-1.4   0..7       pair  LowBits(3) a
          (or#8)           3 bits  0..7       pair  Point or_low
          or#9             3 bits  0..7       pair  And or#8, or_constant
          odd              flag    1..1       pair  Or both, odd_constant
          output both: both
          output sum: sum
          output or: or#9
          output odd: odd
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn a_sum_without_a_name_is_made_in_the_bits_asked_for() {
    let block = block(1, |top| {
        let a = top.input(S8, (-10, 10)).named("a");
        let named = (a + a).named("named");
        vec![(a - a.like(1)).bits(6).named("six"), named.bits(6).named("cut")]
    });
    expect![[r#"
        block sample, 1 phase
          a               s4.4  -10..10  pair  Input
          named           s5.4  -20..20  pair  Add a, a
          (six_constant)  s4.4  1..1     any   Constant(1, s4.4)
          six             s2.4  -11..9   pair  Subtract(Some(6)) a, six_constant
          cut             s2.4  -20..20  pair  Resize(s2.4) named
          output six: six
          output cut: cut
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn composed_operations() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let carry = top.input(Type::FLAG, (0, 1)).named("carry");
        let sum = a.plus(b, carry).named("sum");
        vec![sum, a.saturate(20, "a is small").named("small"), carry.below(&[a.low(3).at_point(None)]).named("word")]
    });
    expect![[r#"
        block sample, 1 phase
          a                                      s4.4     -128..127  pair  Input
          b                                      s4.4     -128..127  pair  Input
          carry                                  flag     0..1       pair  Input
          (sum_floor_1_sum_word_first_constant)  flag     1..1       any   Constant(1, flag)
          (sum_floor_1_sum_word_first#4)         8 bits   -128..127  pair  Point a
          (sum_floor_1_sum_word_first#5)         9 bits   -255..255  pair  Concatenate sum_floor_1_sum_word_first_constant, sum_floor_1_sum_word_first#4
          (sum_floor_1_sum_word_second#6)        8 bits   -128..127  pair  Point b
          (sum_floor_1_sum_word_second#7)        9 bits   -256..255  pair  Concatenate carry, sum_floor_1_sum_word_second#6
          (sum_floor_1_sum)                      10 bits  -511..510  pair  Add sum_floor_1_sum_word_first#5, sum_floor_1_sum_word_second#7
          (sum_floor_1)                          9 bits   -256..255  pair  Floor(1) sum_floor_1_sum
          sum                                    s5.4     -256..255  pair  Point sum_floor_1
          (sample_constant#11)                   s4.4     20..20     any   Constant(20, s4.4)
          (sample_constant#12)                   s4.4     -20..-20   any   Constant(-20, s4.4)
          (small_saturated_raised_too_low)       flag     0..1       pair  Less a, sample_constant#12
          (small_saturated_raised)               s4.4     -128..127  pair  Select small_saturated_raised_too_low, a, sample_constant#12
          (small_saturated_too_high)             flag     0..1       pair  Less sample_constant#11, a
          (small_saturated)                      s4.4     -128..127  pair  Select small_saturated_too_high, small_saturated_raised, sample_constant#11
          (small#17)                             s4.4     -20..20    pair  Assume -20..20 by "a is small" small_saturated
          small#18                               s2.4     -20..20    pair  Resize(s2.4) small#17
          (word_low)                             u-1.4    0..7       pair  LowBits(3) a
          (word#20)                              3 bits   0..7       pair  Point word_low
          word#21                                4 bits   0..15      pair  Concatenate carry, word#20
          output sum: sum
          output small: small#18
          output word: word#21
    "#]].assert_eq(&dump::block(&block));
}

#[test]
fn what_does_not_fit_is_refused_by_its_name() {
    let refused = |body: for<'l> fn(Top<'l>) -> Sig<'l>| refusal(|| block(1, |top| vec![body(top).named("y")]));
    lines(
        expect![[r#"
            block sample, Input(): values from -129 to 0 do not fit s4.4
            block sample, resized(a): values from -128 to 127 do not fit s3.4
            block sample, a: shifted of a: expected to shift s4.4 by less than its width, found 8
            block sample, a: product of a and b: expected signed factors, found s4.4 and 3 bits
            block sample, a: sum of a and b: expected one binary point, found s4.4 and s3.5
            block sample, floor(a): floor of floor(a): expected to drop 1 to 5 bits of s4.2, found 6
            block sample, a: values up to 16 do not fit 4 bits
            block sample: a value that comes later is not connected
            block sample, a: expected s4.4 within (0, 5), found b of s4.4 within (0, 6)
        "#]],
        [
            refused(|top| top.input(S8, (-129, 0))),
            refused(|top| top.input(S8, ALL).named("a").bits(7)),
            refused(|top| top.input(S8, ALL).named("a").shift_left(8)),
            refused(|top| top.input(S8, ALL).named("a") * top.input(Type::unsigned(3), (0, 7)).named("b")),
            refused(|top| top.input(S8, ALL).named("a") + top.input(Type::signed(8, 5), ALL).named("b")),
            refused(|top| top.input(S8, ALL).named("a").floor(2).floor(6)),
            refused(|top| top.input(S8, (0, 16)).named("a").positive(4)),
            refused(|top| top.later(S8, ALL).named("a") + top.constant(1, S8)),
            refused(|top| {
                let (a, b) = (top.later(S8, (0, 5)).named("a"), top.input(S8, (0, 6)).named("b"));
                a.connect(b);
                a
            }),
        ],
    );
}

#[test]
fn what_does_not_fit_in_one_phase_is_refused() {
    let refused = refusal(|| {
        block(2, |top| {
            let operands = [(0, 3), (0, 100)].map(|range| top.input(S8, range));
            let x = Phases::new(2, |s| Some(operands[s])).mux().named("x");
            vec![(x + x).bits(8).named("y")]
        })
    });
    expect!["block sample, sum(x, x): values from 0 to 200 in phase 1 do not fit s4.4"].assert_eq(&refused);
    let refused = refusal(|| {
        block(2, |top| {
            let (a, b) = (top.input(S8, ALL).named("a"), top.input(Type::signed(9, 4), ALL).named("b"));
            vec![Phases::new(2, |s| Some(if s == 0 { a } else { b })).mux().named("y")]
        })
    });
    expect!["block sample, b: expected s4.4 as the other operands of the multiplexer, found s5.4"].assert_eq(&refused);
}

#[test]
fn signals_of_two_units_do_not_meet() {
    let library = Library::default();
    let refused = refusal(|| {
        library.block("outer", &[], 1, |top| {
            let a = top.input(S8, ALL).named("a");
            let b = top.input(S8, ALL).named("b");
            entity!("inner", &[], (a) => (a.apply(Multiply, &[b])).named("y"))
        })
    });
    expect!["block inner, a: b is in another block"].assert_eq(&refused);
}

#[test]
fn values_of_pairs_are_brought_into_the_phases_of_others_once() {
    let block = block(2, |top| {
        let [a, b, c] = ["a", "b", "c"].map(|name| top.input(S8, ALL).named(name));
        let x = Phases::new(2, |s| Some([a, b][s])).mux().named("x");
        let sum = (x + c).named("sum");
        let difference = (x - c).named("difference");
        vec![sum, difference]
    });
    expect![[r#"
        block sample, 2 phases
          a                     s4.4  -128..127  pair   Input
          b                     s4.4  -128..127  pair   Input
          c                     s4.4  -128..127  pair   Input
          (x_select)            flag  0..1       phase  Phase 0 1
          x                     s4.4  -128..127  phase  Mux x_select, a, b
          (c_operand_constant)  flag  0..0       any    Constant(0, flag)
          (c_operand)           s4.4  -128..127  phase  Mux c_operand_constant, c
          sum                   s5.4  -256..254  phase  Add x, c_operand
          difference            s5.4  -255..255  phase  Subtract x, c_operand
          output sum: sum
          output difference: difference
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn a_mux_has_in_each_phase_the_range_of_its_operand() {
    let block = block(3, |top| {
        let [a, b] = [(0, 1), (10, 20)].map(|range| top.input(S8, range));
        let operands = [a.named("a"), b.named("b")];
        let phases = Phases::new(3, |s| operands.get(s).copied());
        let twice = phases.mux().named("x").shift_left(1).named("twice");
        let mut held: Vec<Sig> = phases.capture(&twice).map(|(_, value)| value).collect();
        held[0] = held[0].named("first");
        held[1] = held[1].named("second");
        held
    });
    expect![[r#"
        block sample, 3 phases
          a           s4.4  0..1    pair   Input
          b           s4.4  10..20  pair   Input
          (x_select)  flag  0..1    phase  Phase 0 1 -
          x           s4.4  0..20   phase  Mux x_select, a, b
          twice       s4.4  0..40   phase  ShiftLeft(1) x
          first       s4.4  0..2    pair   Capture of phase 0 twice
          second      s4.4  20..40  pair   Capture of phase 1 twice
          output first: first
          output second: second
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn or_over_phases_starts_anew_in_phase_0_and_where_it_is_told() {
    let block = block(4, |top| {
        let ty = Type::unsigned(4);
        let operands = [1, 2, 4, 8].map(|most| top.input(ty, (0, most)));
        let operands = operands.to_vec().named("a");
        let x = Phases::new(4, |s| Some(operands[s])).mux().named("x");
        let first = Phases::new(4, |s| Some(i128::from(s == 2))).constant(top, Type::FLAG).named("first");
        let so_far = x.or_over_phases(first).named("so_far");
        (0..4).map(|s| so_far.capture(s, false).named_at("y", s)).collect()
    });
    expect![[r#"
        block sample, 4 phases
          a0          4 bits  0..1   pair   Input
          a1          4 bits  0..2   pair   Input
          a2          4 bits  0..4   pair   Input
          a3          4 bits  0..8   pair   Input
          (x_select)  2 bits  0..3   phase  Phase 0 1 2 3
          x           4 bits  0..8   phase  Mux x_select, a0, a1, a2, a3
          first       flag    0..1   phase  Phase 0 0 1 0
          so_far      4 bits  0..15  phase  ScanOr x, first
          y0          4 bits  0..1   pair   Capture of phase 0 so_far
          y1          4 bits  0..3   pair   Capture of phase 1 so_far
          y2          4 bits  0..4   pair   Capture of phase 2 so_far
          y3          4 bits  0..15  pair   Capture of phase 3 so_far
          output y0: y0
          output y1: y1
          output y2: y2
          output y3: y3
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn earlier_takes_the_range_of_the_phase_before() {
    let block = block(3, |top| {
        let operands = [1, 2, 4].map(|most| top.input(S8, (0, most))).to_vec().named("a");
        let x = Phases::new(3, |s| Some(operands[s])).mux().named("x");
        let before = x.earlier(1).named("before");
        (0..3).map(|s| before.capture(s, false).named_at("y", s)).collect()
    });
    expect![[r#"
        block sample, 3 phases
          a0          s4.4    0..1  pair   Input
          a1          s4.4    0..2  pair   Input
          a2          s4.4    0..4  pair   Input
          (x_select)  2 bits  0..2  phase  Phase 0 1 2
          x           s4.4    0..4  phase  Mux x_select, a0, a1, a2
          before      s4.4    0..2  phase  Earlier(1) x
          y0          s4.4    0..1  pair   Capture of phase 0 before
          y1          s4.4    0..1  pair   Capture of phase 1 before
          y2          s4.4    0..2  pair   Capture of phase 2 before
          output y0: y0
          output y1: y1
          output y2: y2
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn what_is_known_bounds_the_range() {
    let block = block(2, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, (-100, 100)).named(name));
        let small = a.within((-9, 5), "a lemma").named("small");
        let up = (a.floor(2) + a.low(2).any()).known(Fact::Ceiling(2), &[a]).named("up");
        let x = Phases::new(2, |s| Some([a, b][s])).mux().named("x");
        let bounded = x.assume_in(&[true, false], 7, "another").named("bounded");
        let held = [0, 1].map(|s| bounded.capture(s, false).named_at("held", s));
        let square = (small * small).known(Fact::Product, &[small, small]).named("square");
        [vec![up, square], held.to_vec()].concat()
    });
    expect![[r#"
        block sample, 2 phases
          a                 s4.4   -100..100  pair   Input
          b                 s4.4   -100..100  pair   Input
          small             s4.4   -9..5      pair   Assume -9..5 by "a lemma" a
          (up_sum_floor_2)  s4.2   -25..25    pair   Floor(2) a
          (up_sum_any_low)  u-2.4  0..3       pair   LowBits(2) a
          (up_sum_any)      flag   0..1       pair   OrReduce up_sum_any_low
          (up_sum)          s5.2   -25..26    pair   Add up_sum_floor_2, up_sum_any
          up                s5.2   -25..25    pair   Known(Ceiling(2)) up_sum, a
          (x_select)        flag   0..1       phase  Phase 0 1
          x                 s4.4   -100..100  phase  Mux x_select, a, b
          bounded           s4.4   -100..100  phase  Assume -7..7 by "another" in phases 0 x
          held0             s4.4   -7..7      pair   Capture of phase 0 bounded
          held1             s4.4   -100..100  pair   Capture of phase 1 bounded
          (square_product)  s8.8   -45..81    pair   Multiply small, small
          square            s8.8   -45..81    pair   Known(Product) square_product, small, small
          output up: up
          output square: square
          output held0: held0
          output held1: held1
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn a_block_has_the_ranges_of_all_its_uses() {
    let library = Library::default();
    let ranges = [(-20, 0), (3, 50), (1, 2)];
    let top = library.block("outer", &[], 1, |top| {
        let twice = |(i, range): (usize, &Range)| {
            let x = top.input(S8, *range).named_at("x", i);
            entity!("inner", &["Twice."], (x) => (x + x).named("y")).named_at("z", i)
        };
        ranges.iter().enumerate().map(twice).collect::<Vec<_>>()
    });
    let efsat_hardware::graph::Op::Instance(inner) = &top.nodes[1].op else { panic!("an instance") };
    expect![[r#"
        block inner, 1 phase
          -- Twice.
          x  s4.4  -20..50   any  Input
          y  s5.4  -40..100  any  Add x, x
          output y: y
        block outer, 1 phase
          x0         s4.4  -20..0  pair  Input
          (z0_unit)  flag  0..0    pair  Instance of inner x0
          z0         s5.4  -40..0  pair  Output y z0_unit
          x1         s4.4  3..50   pair  Input
          (z1_unit)  flag  0..0    pair  Instance of inner x1
          z1         s5.4  6..100  pair  Output y z1_unit
          x2         s4.4  1..2    pair  Input
          (z2_unit)  flag  0..0    pair  Instance of inner x2
          z2         s5.4  2..4    pair  Output y z2_unit
          output z0: z0
          output z1: z1
          output z2: z2
    "#]]
    .assert_eq(&(dump::block(inner) + &dump::block(&top)));
}

#[test]
fn two_different_units_of_one_name_are_refused() {
    let refused = refusal(|| {
        block(1, |top| {
            let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
            let one = entity!("inner", &[], (a) => (-a).named("y")).named("one");
            let other = entity!("inner", &[], (b) => b.magnitude().named("y")).named("other");
            vec![one, other]
        })
    });
    expect!["two different blocks are called inner"].assert_eq(&refused);
}

#[test]
fn a_value_that_comes_later_is_connected() {
    let block = block(2, |top| {
        let a = top.input(S8, (0, 9)).named("a");
        let back = top.later(S8, (0, 50));
        let x = Phases::new(2, |s| Some((if s == 0 { a } else { back }, s))).late(|(_, s)| *s == 1);
        let x = x.map(|(x, _)| *x).mux().named("x");
        let next = (x + x.like(1)).bits(8).named("next");
        back.connect(next.capture(0, false).named("first"));
        vec![next.capture(1, true).named("y")]
    });
    expect![[r#"
        block sample, 2 phases
          a                s4.4  0..9   pair   Input
          (x_select)       flag  0..1   phase  Phase 0 1
          x                s4.4  0..50  phase  Mux x_select, a, first late
          (next_constant)  s4.4  1..1   any    Constant(1, s4.4)
          next             s4.4  1..51  phase  Add(Some(8)) x, next_constant
          first            s4.4  1..10  pair   Capture of phase 0 next
          y                s4.4  1..51  pair   Capture of phase 1 late next
          output y: y
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn vectors_are_named_by_component() {
    let block = block(1, |top| {
        let [e, f] = ["e", "f"].map(|name| Vec3::each(|_| top.input(S8, (-9, 9))).named(name));
        let dot = e.dot(f).named("dot");
        e.cross(f).named("cross").comment("e x f").signals().into_iter().chain([dot]).collect()
    });
    expect![[r#"
        block sample, 1 phase
          e_x                       s4.4   -9..9      pair  Input
          e_y                       s4.4   -9..9      pair  Input
          e_z                       s4.4   -9..9      pair  Input
          f_x                       s4.4   -9..9      pair  Input
          f_y                       s4.4   -9..9      pair  Input
          f_z                       s4.4   -9..9      pair  Input
          (dot_sum_product_first)   s8.8   -81..81    pair  Multiply e_x, f_x
          (dot_sum_product_second)  s8.8   -81..81    pair  Multiply e_y, f_y
          (dot_sum)                 s9.8   -162..162  pair  Add dot_sum_product_first, dot_sum_product_second
          (dot_product)             s8.8   -81..81    pair  Multiply e_z, f_z
          dot                       s10.8  -243..243  pair  Add dot_sum, dot_product
          (cross_x_product_first)   s8.8   -81..81    pair  Multiply e_y, f_z
          (cross_x_product_second)  s8.8   -81..81    pair  Multiply e_z, f_y
          cross_x                   s9.8   -162..162  pair  Subtract cross_x_product_first, cross_x_product_second  -- e x f
          (cross_y_product_first)   s8.8   -81..81    pair  Multiply e_z, f_x
          (cross_y_product_second)  s8.8   -81..81    pair  Multiply e_x, f_z
          cross_y                   s9.8   -162..162  pair  Subtract cross_y_product_first, cross_y_product_second  -- e x f
          (cross_z_product_first)   s8.8   -81..81    pair  Multiply e_x, f_y
          (cross_z_product_second)  s8.8   -81..81    pair  Multiply e_y, f_x
          cross_z                   s9.8   -162..162  pair  Subtract cross_z_product_first, cross_z_product_second  -- e x f
          output cross_x: cross_x
          output cross_y: cross_y
          output cross_z: cross_z
          output dot: dot
    "#]].assert_eq(&dump::block(&block));
}
