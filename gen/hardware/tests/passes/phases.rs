//! What a shared block works on in each phase.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::graph::{Phases, Signals};
use expect_test::expect;

#[test]
fn each_phase_has_its_own() {
    let phases = Phases::new(4, |s| (s != 1).then_some(10 * s)).late(|x| *x == 30);
    let more = phases.filter_map(|x| (*x > 0).then_some(x + 1));
    lines(
        expect![[r#"
            get      [Some(0), None, Some(20), Some(30)]
            busy     [(0, 0), (2, 20), (3, 30)]
            meaning  [(0, false), (2, false), (3, true)]
            marks    [true, false, true, true]
            get      [None, None, Some(21), Some(31)]
            meaning  [(2, false), (3, true)], idle: false
        "#]],
        [
            format!("get      {:?}", (0..4).map(|s| phases.get(s)).collect::<Vec<_>>()),
            format!("busy     {:?}", phases.busy().collect::<Vec<_>>()),
            format!("meaning  {:?}", phases.meaning()),
            format!("marks    {:?}", phases.marks()),
            format!("get      {:?}", (0..4).map(|s| more.get(s)).collect::<Vec<_>>()),
            format!("meaning  {:?}, idle: {}", more.meaning(), more.idle()),
        ],
    );
}

#[test]
fn equal_operands_share_a_leg_and_idle_phases_take_any() {
    let block = block(5, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let phases = Phases::new(5, |s| [Some(a), None, Some(b), Some(a), Some(b)][s]);
        let x = phases.mux().named("x");
        let constant = Phases::new(5, |s| [None, Some(3), None, Some(4), None][s]).constant(top, S8).named("constant");
        let same = Phases::new(5, |_| Some(7)).constant(top, S8);
        let sum = ((x + constant).named("sum") - same).named("less");
        phases.capture(&sum).enumerate().map(|(i, (_, value))| value.named_at("y", i)).collect()
    });
    expect![[r#"
        block sample, 5 phases
          a                s4.4  -128..127  pair   Input
          b                s4.4  -128..127  pair   Input
          (x_select)       flag  0..1       phase  Phase 0 - 1 0 1
          x                s4.4  -128..127  phase  Mux x_select, a, b
          constant         s4.4  3..4       phase  Phase 3 3 3 4 3
          (less_constant)  s4.4  7..7       any    Constant(7, s4.4)
          sum              s5.4  -125..131  phase  Add x, constant
          less             s6.4  -132..124  phase  Subtract sum, less_constant
          y0               s6.4  -132..123  pair   Capture of phase 0 less
          y1               s6.4  -132..123  pair   Capture of phase 2 less
          y2               s6.4  -131..124  pair   Capture of phase 3 less
          y3               s6.4  -132..123  pair   Capture of phase 4 less
          output y0: y0
          output y1: y1
          output y2: y2
          output y3: y3
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn an_operand_is_late_or_not() {
    let block = block(2, |top| {
        let a = top.input(S8, ALL).named("a");
        let both = Phases::new(2, |s| Some((a, s))).late(|(_, s)| *s == 1).map(|(a, _)| *a);
        let x = both.mux().named("x");
        both.capture(&x).enumerate().map(|(s, (_, value))| value.named_at("y", s)).collect()
    });
    expect![[r#"
        block sample, 2 phases
          a           s4.4  -128..127  pair   Input
          (x_select)  flag  0..1       phase  Phase 0 1
          x           s4.4  -128..127  phase  Mux x_select, a, a late
          y0          s4.4  -128..127  pair   Capture of phase 0 x
          y1          s4.4  -128..127  pair   Capture of phase 1 late x
          output y0: y0
          output y1: y1
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn what_never_changes_is_no_multiplexer() {
    let block = block(2, |top| {
        let a = top.steady(S8, ALL).named("a");
        vec![(Phases::new(2, |_| Some(a)).mux() + top.input(S8, ALL).named("b")).named("y")]
    });
    expect![[r#"
        block sample, 2 phases
          a  s4.4  -128..127  any   Steady
          b  s4.4  -128..127  pair  Input
          y  s5.4  -256..254  pair  Add a, b
          output y: y
    "#]]
    .assert_eq(&dump::block(&block));
}
