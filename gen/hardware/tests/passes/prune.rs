//! What nothing depends on goes, and what would leave a port open stays.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::entity;
use efsat_hardware::graph::Signals;
use expect_test::expect;

#[test]
fn nodes_that_no_output_needs_go_with_their_probes() {
    let block = block(1, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let _ = (a * b).named("forgotten").probe(&[(0, false)]);
        let kept = (a - a.like(1)).named("kept").probe(&[(0, false)]);
        vec![kept.magnitude().named("y")]
    });
    expect![[r#"
        block sample, 1 phase
          a                s4.4  -128..127  pair  Input
          b                s4.4  -128..127  pair  Input
          (kept_constant)  s4.4  1..1       any   Constant(1, s4.4)
          kept             s5.4  -129..126  pair  Subtract a, kept_constant
          y                u5.4  0..129     pair  Magnitude kept
          output y: y
          probe kept in phases 0
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn all_outputs_of_an_instance_stay() {
    let block = block(1, |top| {
        let a = top.input(S8, ALL).named("a");
        let [size, sign] = entity!("parts", &[], (a) => [a.magnitude().named("size"), a.negative().named("sign")]);
        let _ = size;
        vec![sign.named("y")]
    });
    expect![[r#"
        block sample, 1 phase
          a              s4.4  -128..127  pair  Input
          (a_size_unit)  flag  0..0       pair  Instance of parts a
          (a_size)       u4.4  0..128     pair  Output size a_size_unit
          y              flag  0..1       pair  Output sign a_size_unit
          output y: y
    "#]]
    .assert_eq(&dump::block(&block));
}

#[test]
fn signals_of_modules_go_and_flags_of_one_vector_stay_together() {
    use efsat_hardware::graph::{Place, Step};
    let module = module(|m| {
        let [a, b] = ["a", "b"].map(|name| m.input(name, Type::FLAG));
        let flags = [a, b, a & b].into_iter().enumerate();
        let flags: Vec<_> = flags
            .map(|(i, x)| {
                let at = Place::at("flag", &[Step::Index(i)]);
                let q = m.register(at, Type::FLAG);
                q.loads(x, None, None);
                q
            })
            .collect();
        let _ = (!a).named("forgotten");
        flags[1].output("y");
    });
    expect![[r#"
        module sample
          a            flag  Port
          b            flag  Port
          (flag2_and)  flag  And a, b
          flag0        flag  Register of a
          flag1        flag  Register of b
          flag2        flag  Register of flag2_and
          output y: flag1
    "#]]
    .assert_eq(&dump::module(&module));
}

#[test]
fn an_instance_that_nothing_needs_is_refused() {
    let inner = module(|m| (!m.input("x", Type::FLAG)).output("y"));
    let refused = refusal(|| {
        module(|m| {
            let a = m.input("a", Type::FLAG);
            let _ = m.instance("inner", &inner, &[a]);
            a.output("b");
        })
    });
    expect!["module sample: an instance is not used"].assert_eq(&refused);
}
