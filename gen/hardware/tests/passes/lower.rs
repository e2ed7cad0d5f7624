//! Scheduled blocks as modules: registers where values wait, phases, multiplexers, delay lines.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Signals};
use expect_test::expect;

#[test]
fn values_of_every_clock_wait_in_registers() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let product = (a * b).named("product").comment("a b");
        vec![(product + a.at_point(product.ty().fraction)).named("y"), (product.floor(9) * b).named("z")]
    });
    expect![[r#"
        module sample, latency 3 clocks
          a             s0.8   -128..127      clock 0  Port
          b             s4.4   -128..127      clock 0  Port
          product       s8.8   -16256..16384  clock 1  Register of Multiply a, b                -- a b
          a_h1          s0.8   -128..127      clock 1  Register of a
          y             s9.8   -16384..16511  clock 1  Add product, a_h1
          (z_floor_9)   s8.-1  -32..32        clock 1  Floor(9) product
          z_floor_9_d1  s8.-1  -32..32        clock 2  Register of z_floor_9
          b_h1          s4.4   -128..127      clock 1  Register of b
          b_h2          s4.4   -128..127      clock 2  Register of b_h1
          z             s12.3  -4096..4096    clock 3  Register of Multiply z_floor_9_d1, b_h2
          y_h1          s9.8   -16384..16511  clock 2  Register of y
          y_h2          s9.8   -16384..16511  clock 3  Register of y_h1
          output y: y_h2
          output z: z
    "#]]
    .assert_eq(&dump::module(&lowered(&block, 100)));
}

#[test]
fn values_of_pairs_are_held_and_captured() {
    let block = block(2, |top| {
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| top.input(S8, ALL).named(name));
        let pairs = Phases::new(2, |s| Some([[a, b], [c, d]][s]));
        let [x, y] = pairs.mux();
        let product = (x.named("x") * y.named("y")).named("product");
        let p: Vec<Sig> = pairs.capture(&product).enumerate().map(|(i, (_, p))| p.named_at("p", i)).collect();
        vec![(p[0] - p[1]).named("difference"), (a * d).named("ad").negative().named("sign")]
    });
    expect![[r#"
        module sample, latency 4 clocks
          phase            flag                          Port                                                -- phase of the slot: 0 in the first clock of the inputs
          holds0           flag                          Port                                                -- whether the slot k slots ago holds a pair
          holds1           flag                          Port                                                -- whether the slot k slots ago holds a pair
          holds2           flag                          Port                                                -- whether the slot k slots ago holds a pair
          a                s4.4  -128..127      clock 0  Port
          b                s4.4  -128..127      clock 0  Port
          c                s4.4  -128..127      clock 0  Port
          d                s4.4  -128..127      clock 0  Port
          x                s4.4  -128..127      clock 0  Select x_select_at_0, a, c
          x_select_at_0    flag                          Register of Lookup([1, 0], flag) phase when busy_0
          y                s4.4  -128..127      clock 0  Select x_select_at_0, b, d
          x_d1             s4.4  -128..127      clock 1  Register of x
          y_d1             s4.4  -128..127      clock 1  Register of y
          product          s8.8  -16256..16384  clock 2  Register of Multiply x_d1, y_d1
          (flag#14)        flag                          Or holds0, holds1
          (flag#15)        flag                          Or flag#14, holds2
          phase_number#16  flag                          Constant(1, flag)
          in_phase_1       flag                          Equal phase, phase_number#16
          in_flight        flag                          Or flag#15, in_phase_1                              -- a pair is in the data path, or may be in the next clock
          phase_number#19  flag                          Constant(1, flag)
          (flag#20)        flag                          Equal phase, phase_number#19
          strobe0          flag                          Register of And flag#20, in_flight                  -- one flag per phase
          phase_number#22  flag                          Constant(0, flag)
          (flag#23)        flag                          Equal phase, phase_number#22
          strobe1          flag                          Register of And flag#23, in_flight                  -- one flag per phase
          p0               s8.8  -16256..16384  clock 3  Register of product when strobe0
          p1               s8.8  -16256..16384  clock 4  Register of product when strobe1
          difference       s9.8  -32640..32640  clock 4  Subtract p0, p1
          ad               s8.8  -16256..16384  clock 1  Register of Multiply a, d
          sign             flag  0..1           clock 1  SignBit ad
          sign_d1          flag  0..1           clock 2  Register of sign
          sign_d2          flag  0..1           clock 3  Register of sign_d1
          sign_d3          flag  0..1           clock 4  Register of sign_d2
          busy_0           flag                          Or holds0, in_phase_1                               -- set in the clock before a pair, and in clock 0 of one
          output difference: difference
          output sign: sign_d3
          delay line sign: sign_d1, sign_d2, sign_d3
    "#]].assert_eq(&dump::module(&lowered(&block, 100)));
}

#[test]
fn running_flags_are_reset_in_the_clock_before_they_start_anew() {
    let block = block(3, |top| {
        let a = [0; 3].map(|_| top.input(Type::FLAG, (0, 1))).to_vec().named("a");
        let x = Phases::new(3, |s| Some(a[s])).mux().named("x");
        let first = Phases::new(3, |s| Some(i128::from(s != 2))).constant(top, Type::FLAG).named("first");
        vec![x.or_over_phases(first).named("so_far").capture(2, false).named("y")]
    });
    expect![[r#"
        module sample, latency 3 clocks
          phase            2 bits                 Port                                                     -- phase of the slot: 0 in the first clock of the inputs
          holds0           flag                   Port                                                     -- whether the slot k slots ago holds a pair
          holds1           flag                   Port                                                     -- whether the slot k slots ago holds a pair
          a0               flag    0..1  clock 0  Port
          a1               flag    0..1  clock 0  Port
          a2               flag    0..1  clock 0  Port
          x                flag    0..1  clock 0  Select x_select_at_0, a0, a1, a2
          x_select_at_0    2 bits                 Register of Lookup([1, 2, 0], 2 bits) phase when busy_0
          first_at_2       flag                   Register of Lookup([0, 1, 1], flag) phase
          so_far_before    flag                   Register of so_far, 0 at first and by first_at_2
          so_far           flag    0..1  clock 0  Or x, so_far_before
          (flag#11)        flag                   Or holds0, holds1
          phase_number#12  2 bits                 Constant(2, 2 bits)
          in_phase_2       flag                   Equal phase, phase_number#12
          in_flight        flag                   Or flag#11, in_phase_2                                   -- a pair is in the data path, or may be in the next clock
          phase_number#15  2 bits                 Constant(2, 2 bits)
          (flag#16)        flag                   Equal phase, phase_number#15
          strobe0          flag                   Register of And flag#16, in_flight                       -- one flag per phase
          phase_number#18  2 bits                 Constant(0, 2 bits)
          (flag#19)        flag                   Equal phase, phase_number#18
          strobe1          flag                   Register of And flag#19, in_flight                       -- one flag per phase
          phase_number#21  2 bits                 Constant(1, 2 bits)
          (flag#22)        flag                   Equal phase, phase_number#21
          strobe2          flag                   Register of And flag#22, in_flight                       -- one flag per phase
          y                flag    0..1  clock 3  Register of so_far when strobe2
          busy_0           flag                   Or holds0, in_phase_2                                    -- set in the clock before a pair, and in clock 0 of one
          output y: y
    "#]].assert_eq(&dump::module(&lowered_for("lfe5u-85-6", &block, 100).0));
}

#[test]
fn what_was_before_is_a_tap_of_a_delay_line() {
    let block = block(3, |top| {
        let a = [0; 3].map(|_| top.input(S8, ALL)).to_vec().named("a");
        let x = Phases::new(3, |s| Some(a[s])).mux().named("x");
        let constant = Phases::new(3, |s| Some(s as i128)).constant(top, S8).named("constant");
        let sum = (x + x.earlier(2).named("before")).named("sum");
        let other = (x - constant.earlier(1).named("constant_before")).named("other");
        vec![sum.capture(2, false).named("y"), other.capture(2, false).named("z")]
    });
    expect![[r#"
        module sample, latency 3 clocks
          phase            2 bits                      Port                                                     -- phase of the slot: 0 in the first clock of the inputs
          holds0           flag                        Port                                                     -- whether the slot k slots ago holds a pair
          holds1           flag                        Port                                                     -- whether the slot k slots ago holds a pair
          a0               s4.4    -128..127  clock 0  Port
          a1               s4.4    -128..127  clock 0  Port
          a2               s4.4    -128..127  clock 0  Port
          x                s4.4    -128..127  clock 0  Select x_select_at_0, a0, a1, a2
          x_select_at_0    2 bits                      Register of Lookup([1, 2, 0], 2 bits) phase when busy_0
          x_d1             s4.4    -128..127  clock 1  Register of x
          x_d2             s4.4    -128..127  clock 2  Register of x_d1
          sum              s5.4    -256..254  clock 0  Add x, x_d2
          constant_at_1    s4.4                        Register of Lookup([0, 1, 2], s4.4) phase when busy_0
          other            s5.4    -129..127  clock 0  Subtract x, constant_at_1
          (flag#13)        flag                        Or holds0, holds1
          phase_number#14  2 bits                      Constant(2, 2 bits)
          in_phase_2       flag                        Equal phase, phase_number#14
          in_flight        flag                        Or flag#13, in_phase_2                                   -- a pair is in the data path, or may be in the next clock
          phase_number#17  2 bits                      Constant(2, 2 bits)
          (flag#18)        flag                        Equal phase, phase_number#17
          strobe0          flag                        Register of And flag#18, in_flight                       -- one flag per phase
          phase_number#20  2 bits                      Constant(0, 2 bits)
          (flag#21)        flag                        Equal phase, phase_number#20
          strobe1          flag                        Register of And flag#21, in_flight                       -- one flag per phase
          phase_number#23  2 bits                      Constant(1, 2 bits)
          (flag#24)        flag                        Equal phase, phase_number#23
          strobe2          flag                        Register of And flag#24, in_flight                       -- one flag per phase
          y                s5.4    -256..254  clock 3  Register of sum when strobe2
          z                s5.4    -129..126  clock 3  Register of other when strobe2
          busy_0           flag                        Or holds0, in_phase_2                                    -- set in the clock before a pair, and in clock 0 of one
          output y: y
          output z: z
    "#]].assert_eq(&dump::module(&lowered_for("lfe5u-85-6", &block, 100).0));
}

#[test]
fn wide_multiplexers_choose_in_groups_and_among_them() {
    let block = block(9, |top| {
        let a = (0..9).map(|_| top.input(S8, ALL)).collect::<Vec<_>>().named("a");
        let x = Phases::new(9, |s| (s != 3).then(|| a[s])).mux().named("x");
        vec![x.capture(8, false).named("y")]
    });
    expect![[r#"
        module sample, latency 10 clocks
          phase                   4 bits                       Port                                                                       -- phase of the slot: 0 in the first clock of the inputs
          holds0                  flag                         Port                                                                       -- whether the slot k slots ago holds a pair
          holds1                  flag                         Port                                                                       -- whether the slot k slots ago holds a pair
          a0                      s4.4    -128..127  clock 0   Port
          a1                      s4.4    -128..127  clock 0   Port
          a2                      s4.4    -128..127  clock 0   Port
          a3                      s4.4    -128..127  clock 0   Port
          a4                      s4.4    -128..127  clock 0   Port
          a5                      s4.4    -128..127  clock 0   Port
          a6                      s4.4    -128..127  clock 0   Port
          a7                      s4.4    -128..127  clock 0   Port
          a8                      s4.4    -128..127  clock 0   Port
          x                       s4.4    -128..127  clock 1   Select x_select_group_at_1, x_group_0, x_group_1
          x_select_in_group_at_0  2 bits                       Register of Lookup([1, 2, 0, 3, 0, 1, 2, 3, 0], 2 bits) phase when busy_0
          x_group_0               s4.4    -128..127  clock 1   Register of Select x_select_in_group_at_0, a0, a1, a2, a4                  -- operands 0 to 3
          x_group_1               s4.4    -128..127  clock 1   Register of Select x_select_in_group_at_0, a5, a6, a7, a8                  -- operands 4 to 7
          x_select_group_at_1     flag                         Register of Lookup([0, 0, 0, 0, 0, 1, 1, 1, 1], flag) phase when holds0
          (flag#17)               flag                         Or holds0, holds1
          phase_number#18         4 bits                       Constant(8, 4 bits)
          in_phase_8              flag                         Equal phase, phase_number#18
          in_flight               flag                         Or flag#17, in_phase_8                                                     -- a pair is in the data path, or may be in the next clock
          phase_number#21         4 bits                       Constant(8, 4 bits)
          (flag#22)               flag                         Equal phase, phase_number#21
          strobe0                 flag                         Register of And flag#22, in_flight                                         -- one flag per phase
          phase_number#24         4 bits                       Constant(0, 4 bits)
          (flag#25)               flag                         Equal phase, phase_number#24
          strobe1                 flag                         Register of And flag#25, in_flight                                         -- one flag per phase
          phase_number#27         4 bits                       Constant(1, 4 bits)
          (flag#28)               flag                         Equal phase, phase_number#27
          strobe2                 flag                         Register of And flag#28, in_flight                                         -- one flag per phase
          phase_number#30         4 bits                       Constant(2, 4 bits)
          (flag#31)               flag                         Equal phase, phase_number#30
          strobe3                 flag                         Register of And flag#31, in_flight                                         -- one flag per phase
          phase_number#33         4 bits                       Constant(3, 4 bits)
          (flag#34)               flag                         Equal phase, phase_number#33
          strobe4                 flag                         Register of And flag#34, in_flight                                         -- one flag per phase
          phase_number#36         4 bits                       Constant(4, 4 bits)
          (flag#37)               flag                         Equal phase, phase_number#36
          strobe5                 flag                         Register of And flag#37, in_flight                                         -- one flag per phase
          phase_number#39         4 bits                       Constant(5, 4 bits)
          (flag#40)               flag                         Equal phase, phase_number#39
          strobe6                 flag                         Register of And flag#40, in_flight                                         -- one flag per phase
          phase_number#42         4 bits                       Constant(6, 4 bits)
          (flag#43)               flag                         Equal phase, phase_number#42
          strobe7                 flag                         Register of And flag#43, in_flight                                         -- one flag per phase
          phase_number#45         4 bits                       Constant(7, 4 bits)
          (flag#46)               flag                         Equal phase, phase_number#45
          strobe8                 flag                         Register of And flag#46, in_flight                                         -- one flag per phase
          y                       s4.4    -128..127  clock 10  Register of x when strobe0
          busy_0                  flag                         Or holds0, in_phase_8                                                      -- set in the clock before a pair, and in clock 0 of one
          output y: y
    "#]].assert_eq(&dump::module(&lowered(&block, 300)));
}

#[test]
fn values_captured_of_one_stream_are_read_from_a_delay_line_with_a_tap() {
    let block = block(4, |top| {
        let a = [0; 4].map(|_| top.input(S8, ALL)).to_vec().named("a");
        let x = Phases::new(4, |s| Some(a[s])).mux().named("x");
        let held: Vec<Sig> = (0..3).map(|s| x.capture(s, false).named_at("held", s)).collect();
        let again = Phases::new(4, |s| [Some(held[2]), None, Some(held[0]), Some(held[1])][s]).mux().named("again");
        vec![again.capture(3, false).named("y")]
    });
    expect![[r#"
        module sample, latency 7 clocks
          phase                  2 bits                      Port                                                        -- phase of the slot: 0 in the first clock of the inputs
          holds0                 flag                        Port                                                        -- whether the slot k slots ago holds a pair
          holds1                 flag                        Port                                                        -- whether the slot k slots ago holds a pair
          a0                     s4.4    -128..127  clock 0  Port
          a1                     s4.4    -128..127  clock 0  Port
          a2                     s4.4    -128..127  clock 0  Port
          a3                     s4.4    -128..127  clock 0  Port
          x                      s4.4    -128..127  clock 0  Select x_select_at_0, a0, a1, a2, a3
          x_select_at_0          2 bits                      Register of Lookup([1, 2, 3, 0], 2 bits) phase when busy_0
          (flag#9)               flag                        Or holds0, holds1
          phase_number#10        2 bits                      Constant(3, 2 bits)
          in_phase_3             flag                        Equal phase, phase_number#10
          in_flight              flag                        Or flag#9, in_phase_3                                       -- a pair is in the data path, or may be in the next clock
          phase_number#13        2 bits                      Constant(3, 2 bits)
          (flag#14)              flag                        Equal phase, phase_number#13
          strobe0                flag                        Register of And flag#14, in_flight                          -- one flag per phase
          phase_number#16        2 bits                      Constant(0, 2 bits)
          (flag#17)              flag                        Equal phase, phase_number#16
          strobe1                flag                        Register of And flag#17, in_flight                          -- one flag per phase
          phase_number#19        2 bits                      Constant(1, 2 bits)
          (flag#20)              flag                        Equal phase, phase_number#19
          strobe2                flag                        Register of And flag#20, in_flight                          -- one flag per phase
          phase_number#22        2 bits                      Constant(2, 2 bits)
          (flag#23)              flag                        Equal phase, phase_number#22
          strobe3                flag                        Register of And flag#23, in_flight                          -- one flag per phase
          again_select_tap_at_3  4 bits                      Register of Lookup([4, 4, 0, 1], 4 bits) phase when busy_3
          again                  s4.4    -128..127  clock 3  y of again_line
          y                      s4.4    -128..127  clock 7  Register of again when strobe2
          busy_0                 flag                        Or holds0, in_phase_3                                       -- set in the clock before a pair, and in clock 0 of one
          phase_number#29        2 bits                      Constant(1, 2 bits)
          in_phase_1             flag                        Equal phase, phase_number#29
          busy_3                 flag                        Register of holds0 when in_phase_1                          -- set in clocks 2 to 5 of a pair
          instance again_line: tapped_line_8 of x, again_select_tap_at_3
          output y: y
    "#]].assert_eq(&dump::module(&lowered(&block, 100)));
}

#[test]
fn late_operands_are_connected_last() {
    let block = block(2, |top| {
        let a = top.input(S8, (0, 9)).named("a");
        let back = top.later(S8, (0, 50));
        let x = Phases::new(2, |s| Some((s, [a, back][s]))).late(|(s, _)| *s == 1).map(|x| x.1).mux().named("x");
        back.connect((x + x.like(1)).bits(8).named("next").capture(0, false).named("first"));
        vec![x.capture(1, true).named("y")]
    });
    expect![[r#"
        module sample, latency 2 clocks
          phase            flag                  Port                                                -- phase of the slot: 0 in the first clock of the inputs
          holds0           flag                  Port                                                -- whether the slot k slots ago holds a pair
          holds1           flag                  Port                                                -- whether the slot k slots ago holds a pair
          a                s4.4  0..9   clock 0  Port
          x                s4.4  0..50  clock 0  Select x_select_at_0, a, first
          (next_constant)  s4.4  1..1            Constant(1, s4.4)
          next             s4.4  1..51  clock 0  Add(Some(8)) x, next_constant
          (flag#7)         flag                  Or holds0, holds1
          phase_number#8   flag                  Constant(1, flag)
          in_phase_1       flag                  Equal phase, phase_number#8
          in_flight        flag                  Or flag#7, in_phase_1                               -- a pair is in the data path, or may be in the next clock
          phase_number#11  flag                  Constant(1, flag)
          (flag#12)        flag                  Equal phase, phase_number#11
          strobe0          flag                  Register of And flag#12, in_flight                  -- one flag per phase
          phase_number#14  flag                  Constant(0, flag)
          (flag#15)        flag                  Equal phase, phase_number#14
          strobe1          flag                  Register of And flag#15, in_flight                  -- one flag per phase
          first            s4.4  1..10  clock 1  Register of next when strobe0
          y                s4.4  0..50  clock 2  Register of x when strobe1
          x_select_at_0    flag                  Register of Lookup([1, 0], flag) phase when busy_0
          busy_0           flag                  Or holds0, in_phase_1                               -- set in the clock before a pair, and in clock 0 of one
          output y: y
    "#]].assert_eq(&dump::module(&lowered(&block, 100)));
}

#[test]
fn what_is_no_hardware_is_its_operand() {
    let block = block(1, |top| {
        let a = top.input(S8, (-100, 100)).named("a");
        let size = a.magnitude().within((0, 9), "a is small").named("size").comment("|a|");
        vec![
            size.at_point(Some(1)).named("point").floor(1).named("y"),
            size.resize(Type { bits: 8, ..size.ty() }).named("same"),
        ]
    });
    expect![[r#"
        module sample, latency 0 clocks
          a     s4.4  -100..100  clock 0  Port
          same  u7.1  0..9       clock 0  Magnitude a    -- |a|
          y     u7.0  0..4       clock 0  Floor(1) same
          output y: y
          output same: same
    "#]]
    .assert_eq(&dump::module(&lowered(&block, 100)));
}

#[test]
fn instances_and_probes() {
    let block = block(2, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let x = Phases::new(2, |s| Some([a, b][s])).mux().named("x").probe(&[(0, false), (1, false)]);
        let square = entity!("square", &["x x"], (x) => (x * x).named("y")).named("square");
        vec![square.capture(1, false).named("z").probe(&[(0, false)])]
    });
    let (module, probes) = lowered_for("xc2v6000-4", &block, 100);
    let probes = probes.into_iter().map(|probe| format!("{probe:?}\n")).collect::<String>();
    let text = module.hierarchy().iter().map(|module| dump::module(module)).collect::<String>() + &probes;
    expect![[r#"
        module square, latency 1 clock
          -- x x
          x  s4.4  -128..127      clock 0  Port
          y  s8.8  -16256..16384  clock 1  Register of Multiply x, x
          output y: y
        module sample, latency 4 clocks
          phase            flag                          Port                                                -- phase of the slot: 0 in the first clock of the inputs
          holds0           flag                          Port                                                -- whether the slot k slots ago holds a pair
          holds1           flag                          Port                                                -- whether the slot k slots ago holds a pair
          holds2           flag                          Port                                                -- whether the slot k slots ago holds a pair
          a                s4.4  -128..127      clock 0  Port
          b                s4.4  -128..127      clock 0  Port
          x                s4.4  -128..127      clock 0  Select x_select_at_0, a, b
          x_select_at_0    flag                          Register of Lookup([1, 0], flag) phase when busy_0
          x_d1             s4.4  -128..127      clock 1  Register of x
          square           s8.8  -16256..16384  clock 2  y of square_unit
          (flag#10)        flag                          Or holds0, holds1
          (flag#11)        flag                          Or flag#10, holds2
          phase_number#12  flag                          Constant(1, flag)
          in_phase_1       flag                          Equal phase, phase_number#12
          in_flight        flag                          Or flag#11, in_phase_1                              -- a pair is in the data path, or may be in the next clock
          phase_number#15  flag                          Constant(1, flag)
          (flag#16)        flag                          Equal phase, phase_number#15
          strobe0          flag                          Register of And flag#16, in_flight                  -- one flag per phase
          phase_number#18  flag                          Constant(0, flag)
          (flag#19)        flag                          Equal phase, phase_number#18
          strobe1          flag                          Register of And flag#19, in_flight                  -- one flag per phase
          z                s8.8  -16256..16384  clock 4  Register of square when strobe1
          busy_0           flag                          Or holds0, in_phase_1                               -- set in the clock before a pair, and in clock 0 of one
          instance square_unit: square of x_d1
          output z: z
          output probe_x: x
          output probe_z: z
        Probe { name: "x", ty: s4.4, per_phase: true, clocks: [(0, 0), (1, 1)] }
        Probe { name: "z", ty: s8.8, per_phase: false, clocks: [(0, 4)] }
    "#]].assert_eq(&text);
}

#[test]
fn delay_lines_end_where_they_are_read() {
    let module = module(|m| {
        let delayed = |name: &str, x| {
            let q = m.register(name, S8);
            q.loads(x, None, None);
            q
        };
        let a = m.input("a", S8);
        let b = (1..=7).fold(a, |x, i| {
            let x = delayed(&format!("a_d{i}"), x);
            if i == 4 {
                x.output("tap")
            }
            x
        });
        b.output("end");
        let go = m.input("go", Type::FLAG);
        let held = m.register("held", S8);
        held.loads(b, Some(go), None);
        held.output("held_out");
    });
    expect![[r#"
        module sample
          a     s4.4  Port
          a_d1  s4.4  Register of a
          a_d2  s4.4  Register of a_d1
          a_d3  s4.4  Register of a_d2
          a_d4  s4.4  Register of a_d3
          a_d5  s4.4  Register of a_d4
          a_d6  s4.4  Register of a_d5
          a_d7  s4.4  Register of a_d6
          go    flag  Port
          held  s4.4  Register of a_d7 when go
          output tap: a_d4
          output end: a_d7
          output held_out: held
          delay line a: a_d1, a_d2, a_d3, a_d4
          delay line a_d4: a_d5, a_d6, a_d7
    "#]]
    .assert_eq(&dump::module(&module));
}

#[test]
fn multipliers_and_register_bits_are_counted_in_all_instances() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let c = top.input(Type::signed(4, 4), (-8, 7)).named("c");
        fn product<'l>(a: Sig<'l>, b: Sig<'l>) -> Sig<'l> {
            entity!("product", &[], (a, b) => (a * b).named("p"))
        }
        vec![product(a, b).named("y"), product(b, a).named("z"), (c * c).named("w")]
    });
    let module = lowered(&block, 100);
    // Look-up tables make the shortest product.
    assert_eq!((module.multipliers(), module.register_bits()), (2, 16 + 16 + 8));
}
