//! Modules with state, written by hand.

use super::*;
use efsat_hardware::dump;
use efsat_hardware::op::LowBits;
use expect_test::expect;

/// A counter that stops at its end, with a flag that is made later.
fn counter() -> Rc<Module> {
    module(|m| {
        let [reset, go] = ["reset", "go"].map(|name| m.input(name, Type::FLAG));
        let step = m.input("step", Type::unsigned(3)).or(true);
        let done = m.later(Type::FLAG);
        let count = m.register("count", Type::unsigned(3)).comment("steps so far");
        count.loads(count.plus(1), Some(go & !done), Some((reset, 2)));
        done.stands_for((count.is(7).named("full") | count.equals(step)).named("done"));
        count.output("steps");
        done.choose(count.low(2), count.apply(LowBits(2), &[]).plus(3)).output("y");
    })
}

#[test]
fn state_and_logic() {
    expect![[r#"
        module sample
          reset                       flag    Port
          go                          flag    Port
          step                        3 bits  Port or bits 1
          count                       3 bits  Register of count_sum when count_and, 2 at first and by reset  -- steps so far
          (count_sum_constant)        3 bits  Constant(1, 3 bits)
          (count_sum)                 3 bits  Add(Some(3)) count, count_sum_constant
          (count_and_not)             flag    Not done
          (count_and)                 flag    And go, count_and_not
          (full_constant)             3 bits  Constant(7, 3 bits)
          full                        flag    Equal count, full_constant
          (done_equal)                flag    Equal count, step
          done                        flag    Or full, done_equal
          (done_choice_low)           2 bits  LowBits(2) count
          (done_choice_sum_low)       2 bits  LowBits(2) count
          (done_choice_sum_constant)  2 bits  Constant(3, 2 bits)
          (done_choice_sum)           2 bits  Add(Some(2)) done_choice_sum_low, done_choice_sum_constant
          (done_choice)               2 bits  Select done, done_choice_sum, done_choice_low
          output steps: count
          output y: done_choice
    "#]].assert_eq(&dump::module(&counter()));
}

#[test]
fn what_does_not_fit_is_refused() {
    let inner = counter();
    let refused = |body: fn(&Control)| refusal(|| module(body));
    lines(
        expect![[r#"
            register q
            a is no register
            s4.4 is made later as flag
            module sample, and: expected unsigned operands of one width, found s4.4 and s4.4
            module sample: two signals are called x
            assertion `left == right` failed: instance inner of sample
              left: 1
             right: 3
            instance inner: s4.4 at port reset
        "#]],
        [
            refused(|m| m.register("q", S8).loads(m.input("a", Type::FLAG), None, None)),
            refused(|m| m.input("a", S8).loads(m.input("b", S8), None, None)),
            refused(|m| m.later(S8).stands_for(m.input("a", Type::FLAG))),
            refused(|m| (m.input("a", S8) & m.input("b", S8)).output("y")),
            refused(|m| {
                ["x", "x"].iter().zip(["y", "z"]).for_each(|(x, y)| (!m.input(*x, Type::FLAG)).named("n").output(y))
            }),
            refusal(|| module(|m| _ = m.instance("inner", &inner, &[m.input("a", S8)]))),
            refusal(|| module(|m| _ = m.instance("inner", &inner, &[m.input("a", S8); 3]))),
        ],
    );
}
