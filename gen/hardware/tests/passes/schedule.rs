//! When nodes are computed.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Signals, Vec3};
use expect_test::expect;

#[test]
fn what_fits_in_a_clock_shares_it() {
    let block = block(1, |top| {
        let [a, b, c] = ["a", "b", "c"].map(|name| top.input(S8, ALL).named(name));
        let sum = ((a + b).named("ab") + c).named("abc");
        vec![(sum + (a - c).named("ac")).named("y")]
    });
    expect![[r#"
        schedule of sample: latency 1 clock, 1 phase
          input path 6.48 ns, output 3.89 ns, longest path 7.04 ns to sample.abc
          19 register bits, 0 of them in any schedule
          node  start  from  until  ns
          a     0      0     1      0.57
          b     0      0     1      0.57
          c     0      0     1      0.57
          ab    0      0     1      3.78
          abc   0      0     1      7.04
          ac    0      0     1      3.78
          y     1      1     2      3.89  from registers
          abc (10 bits) is captured again 1 time
          ac (9 bits) is captured again 1 time
        schedule of sample: latency 2 clocks, 1 phase
          input path 3.21 ns, output 3.89 ns, longest path 3.89 ns to sample.y
          45 register bits, 0 of them in any schedule
          node  start  from  until  ns
          a     0      0     1      0.57
          b     0      0     1      0.57
          c     0      0     1      0.57
          ab    0      0     1      3.78
          abc   1      1     2      3.83  from registers
          ac    0      0     1      3.78
          y     2      2     3      3.89  from registers
          ab (9 bits) is captured again 1 time
          c (8 bits) is captured again 1 time
          abc (10 bits) is captured again 1 time
          ac (9 bits) is captured again 2 times
    "#]]
    .assert_eq(&(dump::schedule(&scheduled(&block, 100)) + &dump::schedule(&scheduled(&block, 200))));
}

/// The arrival at the end of a clock may take the period less the set-up of a register, and not a bit more.
#[test]
fn set_up_is_part_of_the_clock() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        vec![((a + b).named("sum") - a).named("y")]
    });
    let device = part("xc2v6000-4");
    let ns = scheduled(&block, 50).slots[block.outputs[0].1.0].ns;
    let clocks = |period: f64| {
        // Only whole MHz can be asked for: the next slower clock.
        let schedule = scheduled(&block, (1000.0 / period).floor() as u32);
        (schedule.latency, 1000.0 / (1000.0 / period).floor())
    };
    let (latency, period) = clocks(ns + device.setup());
    assert_eq!(latency, 0, "{ns} ns and {} ns of set-up are within {period} ns", device.setup());
    let (latency, period) = clocks(ns + device.setup() / 2.0);
    assert!(ns < period && period < ns + device.setup(), "{ns} ns, {period} ns");
    assert_eq!(latency, 1, "{ns} ns and {} ns of set-up are more than {period} ns", device.setup());
}

#[test]
fn products_stand_between_registers() {
    let block = block(1, |top| {
        let [a, b, c] = ["a", "b", "c"].map(|name| top.input(S8, ALL).named(name));
        let sum = (a + b).named("sum");
        vec![((sum * c).named("product") + (a * b).named("ab")).named("y")]
    });
    expect![[r#"
        schedule of sample: latency 2 clocks, 1 phase
          input path 9.43 ns, output 7.26 ns, longest path 7.26 ns to sample.y
          66 register bits, 33 of them in any schedule
          node     start  from  until  ns
          a        0      0     1      0.57
          b        0      0     1      0.57
          c        0      0     1      0.57
          sum      0      0     1      3.78
          product  1      2     -      3.57  from registers
          ab       0      1     -      3.57  from registers
          y        2      2     -      7.26
          ab (16 bits) is there from clock 1, delayed by 1 clock
          sum (9 bits) is captured again 1 time
          c (8 bits) is captured again 1 time
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn values_of_pairs_are_there_for_a_slot_and_captured_again_after_it() {
    let block = block(3, |top| {
        let a = top.input(S8, ALL).named("a");
        let b = top.input(S8, ALL).named("b");
        let product = ((a * a).named("square").floor(4).bits(12).named("cut") * a).named("cube");
        let phases = Phases::new(3, |s| Some([a, b, a][s]));
        let x = phases.mux().named("x");
        let held = x.capture(2, false).named("held");
        vec![
            (product + held.at_point(product.ty().fraction)).named("y"),
            (held + a).named("late_use"),
            (b + a).named("early_use"),
        ]
    });
    expect![[r#"
        schedule of sample: latency 3 clocks, 3 phases
          input path 9.43 ns, output 7.42 ns, longest path 7.42 ns to sample.y
          73 register bits, 44 of them in any schedule
          node       start   from    until  ns
          a          0       0       3      0.57
          b          0       0       3      0.57
          square     0       1       -      3.57  from registers
          cut        1       1       -      3.57
          cube       2       3       -      3.57  from registers
          x_select   always  always  -      0.57
          x          0       0       -      2.51
          held       2       3       6      0.57
          y#8        2       3       6      0.57
          y#9        3       3       6      7.42
          late_use   3       3       6      3.78
          early_use  0       0       3      3.78
          cut (12 bits) is there from clock 1, delayed by 1 clock
          a (8 bits) is captured again 1 time
          early_use (9 bits) is captured again 1 time
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn operations_are_shared_over_phases() {
    let block = block(2, |top| {
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| top.input(S8, ALL).named(name));
        let pairs = Phases::new(2, |s| Some([[a, b], [c, d]][s]));
        let [x, y] = pairs.mux();
        let product = (x.named("x") * y.named("y")).named("product");
        pairs.capture(&product).enumerate().map(|(i, (_, p))| p.named_at("p", i)).collect()
    });
    expect![[r#"
        schedule of sample: latency 4 clocks, 2 phases
          input path 1.94 ns, output 0.57 ns, longest path 4.61 ns to sample.product
          64 register bits, 48 of them in any schedule
          node      start   from    until  ns
          a         0       0       2      0.57
          b         0       0       2      0.57
          c         0       0       2      0.57
          d         0       0       2      0.57
          x_select  always  always  -      0.57
          x         0       0       -      2.51
          y         0       0       -      2.51
          product   1       2       -      3.57  from registers
          p0        2       3       5      0.57
          p1        3       4       6      0.57
          x (8 bits) is there from clock 0, delayed by 1 clock
          y (8 bits) is there from clock 0, delayed by 1 clock
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn elements_of_a_bundle_start_together() {
    let block = block(1, |top| {
        let v = Vec3::each(|_| top.input(S8, ALL)).named("v");
        let slow = (v[0] * v[1]).named("slow").floor(4).named("cut");
        Vec3([slow, v[1], v[2]]).map(|x| x + v[0]).named("w").signals()
    });
    expect![[r#"
        schedule of sample: latency 1 clock, 1 phase
          input path 9.43 ns, output 6.99 ns, longest path 6.99 ns to sample.w_x
          40 register bits, 16 of them in any schedule
          node  start  from  until  ns
          v_x   0      0     1      0.57
          v_y   0      0     1      0.57
          v_z   0      0     1      0.57
          slow  0      1     -      3.57  from registers
          cut   1      1     -      3.57
          w_x   1      1     2      6.99
          w_y   1      1     2      3.78
          w_z   1      1     2      3.78
          v_x (8 bits) is captured again 1 time
          v_y (8 bits) is captured again 1 time
          v_z (8 bits) is captured again 1 time
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn late_phases_follow_where_results_come_back() {
    let block = block(2, |top| {
        let a = top.input(S8, (0, 9)).named("a");
        let back = top.later(S8, ALL);
        let x = Phases::new(2, |s| Some((s, [a, back][s]))).late(|(s, _)| *s == 1).map(|x| x.1).mux().named("x");
        let square = (x * x).named("square").floor(10).bits(8).at_point(Some(4));
        back.connect(square.capture(0, false).named("first"));
        vec![square.capture(1, true).named("y")]
    });
    expect![[r#"
        schedule of sample: latency 6 clocks, 2 phases
          input path 1.94 ns, output 0.57 ns, longest path 4.61 ns to sample.square
          40 register bits, 32 of them in any schedule
          late phases follow by 2 clocks
          node                              start   from    until  ns
          a                                 0       0       2      0.57
          x_select                          always  always  -      0.57
          x                                 0       0       -      2.51
          square                            1       2       -      3.57  from registers
          square_floor_10_resized_floor_10  2       2       -      3.57
          square_floor_10_resized_resized   2       2       -      3.57
          square_floor_10_resized           2       2       -      3.57
          first                             2       3       5      0.57
          y                                 5       6       8      0.57
          x (8 bits) is there from clock 0, delayed by 1 clock
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn a_wide_multiplexer_takes_two_clocks() {
    let block = block(9, |top| {
        let a = (0..9).map(|_| top.input(S8, ALL)).collect::<Vec<_>>().named("a");
        let x = Phases::new(9, |s| Some(a[s])).mux().named("x");
        vec![(x + x.like(1)).named("sum").capture(8, false).named("y")]
    });
    let ends = |megahertz| dump::schedule(&scheduled(&block, megahertz));
    expect![[r#"
        schedule of sample: latency 9 clocks, 9 phases
          input path 7.69 ns, output 0.57 ns, longest path 8.26 ns to sample.sum
          9 register bits, 9 of them in any schedule
          node          start   from    until  ns
          a0            0       0       9      0.57
          a1            0       0       9      0.57
          a2            0       0       9      0.57
          a3            0       0       9      0.57
          a4            0       0       9      0.57
          a5            0       0       9      0.57
          a6            0       0       9      0.57
          a7            0       0       9      0.57
          a8            0       0       9      0.57
          x_select      always  always  -      0.57
          x             0       0       -      5.04
          sum_constant  always  always  -      0.00
          sum           0       0       -      8.26
          y             8       9       18     0.57
        schedule of sample: latency 11 clocks, 9 phases
          input path 2.77 ns, output 0.57 ns, longest path 3.78 ns to sample.sum
          41 register bits, 33 of them in any schedule
          node          start   from    until  ns
          a0            0       0       9      0.57
          a1            0       0       9      0.57
          a2            0       0       9      0.57
          a3            0       0       9      0.57
          a4            0       0       9      0.57
          a5            0       0       9      0.57
          a6            0       0       9      0.57
          a7            0       0       9      0.57
          a8            0       0       9      0.57
          x_select      always  always  -      0.57
          x             0       1       -      3.78  from registers
          sum_constant  always  always  -      0.00
          sum           2       2       -      3.78
          y             10      11      20     0.57
          x (8 bits) is there from clock 1, delayed by 1 clock
    "#]]
    .assert_eq(&(ends(100) + &ends(300)));
}

#[test]
fn an_instance_is_one_operation_of_its_parent() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let y = entity!("product", &[], (a, b) => (a * b).named("p")).named("y");
        let z = entity!("sum", &[], (a, b) => (a + b).named("s")).named("z");
        vec![(y + z.at_point(y.ty().fraction)).named("w")]
    });
    expect![[r#"
        schedule of sample: latency 1 clock, 1 phase
          input path 9.43 ns, output 7.20 ns, longest path 7.20 ns to sample.w
          9 register bits, 0 of them in any schedule
          node    start  from  until  ns
          a       0      0     1      0.57
          b       0      0     1      0.57
          y_unit  0      1     2      3.57
          y       0      1     2      3.57
          z_unit  0      0     1      3.78
          z       0      0     1      3.78
          w#6     0      0     1      3.78
          w#7     1      1     2      7.20
          z (9 bits) is captured again 1 time
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

/// A flag of wide numbers is made at once, and waits in place of them; what is narrow waits before it is made wide.
#[test]
fn nodes_start_where_they_take_the_fewest_registers() {
    let block = block(1, |top| {
        let [a, b, c] = ["a", "b", "c"].map(|name| top.input(S8, ALL).named(name));
        let less = b.less(c).named("less");
        let wide = a.floor(-10).named("wide");
        let product = ((a * a).named("square").low(8).below(&[a]).named("word").floor(6) * a).named("cube");
        vec![less.choose(product, product.like(0)).named("y"), (wide + wide.like(1)).named("sum"), (a * b).named("ab")]
    });
    let schedule = scheduled(&block, 100);
    expect![[r#"
        schedule of sample: latency 3 clocks, 1 phase
          input path 9.43 ns, output 5.51 ns, longest path 5.51 ns to sample.y
          152 register bits, 50 of them in any schedule
          node          start   from    until  ns
          a             0       0       1      0.57
          b             0       0       1      0.57
          c             0       0       1      0.57
          less          0       0       1      3.78
          wide          0       0       1      0.57
          square        0       1       -      3.57  from registers
          word_low      1       1       -      3.57
          word          1       1       2      3.57
          cube_floor_6  1       1       2      3.57
          cube          2       3       -      3.57  from registers
          y_constant    always  always  -      0.00
          y             3       3       4      5.51
          sum_constant  always  always  -      0.00
          sum           0       0       1      4.31
          ab            2       3       -      3.57  from registers
          a (8 bits) is captured again 2 times
          cube_floor_6 (10 bits) is captured again 1 time
          less (1 bits) is captured again 3 times
          b (8 bits) is captured again 2 times
          sum (19 bits) is captured again 3 times
    "#]]
    .assert_eq(&dump::schedule(&schedule));
    assert!(schedule.program.holds(&schedule.starts));
}

#[test]
fn a_value_is_carried_to_its_last_use() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let first = (a * b).named("first");
        vec![(first.floor(9) * b).named("second"), first, first.negative().named("sign")]
    });
    expect![[r#"
        schedule of sample: latency 3 clocks, 1 phase
          input path 9.43 ns, output 3.57 ns, longest path 4.61 ns to sample.first
          79 register bits, 31 of them in any schedule
          node            start  from  until  ns
          a               0      0     1      0.57
          b               0      0     1      0.57
          first           0      1     -      3.57  from registers
          second_floor_9  2      2     -      0.57
          second          2      3     -      3.57  from registers
          sign            3      3     -      0.57
          first (16 bits) is there from clock 1, delayed by 2 clocks
          b (8 bits) is captured again 2 times
    "#]]
    .assert_eq(&dump::schedule(&scheduled(&block, 100)));
}

#[test]
fn what_depends_on_itself_is_refused() {
    let refused = refusal(|| {
        let block = block(2, |top| {
            let a = top.input(S8, (0, 9)).named("a");
            let back = top.later(S8, (0, 50));
            let x = Phases::new(2, |s| Some((s, [a, back][s]))).late(|(s, _)| *s == 1).map(|x| x.1).mux().named("x");
            // Of the very phase that it is read in.
            back.connect(x.floor(1).bits(8).at_point(Some(4)).named("next").capture(1, true).named("first"));
            vec![x.capture(1, true).named("y")]
        });
        scheduled(&block, 100)
    });
    expect!["block sample: late operands depend on themselves"].assert_eq(&refused);
}
