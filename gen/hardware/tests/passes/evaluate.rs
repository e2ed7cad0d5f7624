//! Values of a graph in every phase.

use super::*;
use efsat_hardware::graph::evaluate::Evaluator;
use efsat_hardware::graph::{Fact, Phases, Signals};
use expect_test::expect;

/// The values of the named nodes of a block in all phases.
fn values(block: &Rc<Block>, inputs: &[i128], names: &[&str]) -> Vec<String> {
    let mut evaluator = Evaluator::new(block);
    evaluator.run(inputs);
    let of = |name: &&str| {
        let node = evaluator.flat().top_node(name).expect("a node of the top");
        let each: Vec<String> = (0..block.interval).map(|s| evaluator.at(node, s).to_string()).collect();
        format!("{name}: {}", each.join(" "))
    };
    names.iter().map(of).collect()
}

#[test]
fn every_node_in_every_phase() {
    let block = block(4, |top| {
        let a = [0; 4].map(|_| top.input(Type::unsigned(4), (0, 15))).to_vec().named("a");
        let x = Phases::new(4, |s| Some(a[s])).mux().named("x");
        let first = Phases::new(4, |s| Some(i128::from(s == 2))).constant(top, Type::FLAG).named("first");
        let so_far = x.or_over_phases(first).named("so_far");
        let before = x.earlier(2).named("before");
        let sum = (so_far + before).named("sum");
        vec![sum.capture(3, false).named("y"), sum.capture(2, false).named("z")]
    });
    let names = ["x", "first", "so_far", "before", "sum", "y", "z"];
    lines(
        expect![[r#"
        x: 1 2 4 9
        first: 0 0 1 0
        so_far: 1 3 4 13
        before: 1 1 1 2
        sum: 2 4 5 15
        y: 15 15 15 15
        z: 5 5 5 5
    "#]],
        values(&block, &[1, 2, 4, 9], &names),
    );
}

#[test]
fn flags_of_a_vector_are_one_output() {
    let block = block(1, |top| {
        let a = top.input(S8, ALL).named("a");
        let flags = [1, 2, 3].map(|bound| a.less(a.like(bound)));
        flags.to_vec().named("below").signals()
    });
    let mut evaluator = Evaluator::new(&block);
    evaluator.run(&[1]);
    assert_eq!(evaluator.output("below"), 0b110);
    evaluator.run(&[2]);
    assert_eq!(evaluator.output("below"), 0b100);
}

#[test]
fn lemmas_that_do_not_hold_are_told() {
    let block = block(2, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let x = Phases::new(2, |s| Some([a, b][s])).mux().named("x");
        let bounded = x.assume_in(&[false, true], 5, "b is small").named("bounded");
        let half = a.floor(1).bits(8).known(Fact::Ceiling(1), &[a]).named("half");
        vec![bounded.capture(1, false).named("y"), half.named("half")]
    });
    let run = |inputs: [i128; 2]| refusal(|| Evaluator::new(&block).run(&inputs));
    lines(
        expect![[r#"
        not refused
        bounded: Assume((-5, 5), "b is small", [false, true]) does not hold of [6]
        half: Known(Ceiling(1)) does not hold of [49, 99]
    "#]],
        [run([100, 5]), run([100, 6]), run([99, 5])],
    );
}
