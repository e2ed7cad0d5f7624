//! A graph without instances, and the order of its steps.

use super::*;
use efsat_hardware::entity;
use efsat_hardware::graph::flat::{Flat, Step};
use efsat_hardware::graph::{Phases, Signals};
use expect_test::expect;

/// Nodes with their operands and rates, then the steps, each with its operands.
fn text(flat: &Flat) -> Vec<String> {
    let path = |i: usize| flat.nodes[i].path.clone();
    let node = |node: &efsat_hardware::graph::flat::FlatNode| {
        let args: Vec<String> = node.args.iter().map(|a| path(*a)).collect();
        format!("{}: {:?} of {}", node.path, node.rate, args.join(" ")).trim_end().to_owned()
    };
    let at = |step: &Step| format!("{}@{}", path(step.node), step.phase);
    let step = |step: &Step| {
        let operands: Vec<String> = flat.operands(*step).iter().map(at).collect();
        format!("{} <- {}", at(step), operands.join(" ")).trim_end().to_owned()
    };
    flat.nodes.iter().map(node).chain(flat.steps.iter().map(step)).collect()
}

#[test]
fn instances_are_dissolved_and_take_the_rate_of_their_operands() {
    let block = block(2, |top| {
        let [a, b] = ["a", "b"].map(|name| top.input(S8, ALL).named(name));
        let x = Phases::new(2, |s| Some([a, b][s])).mux().named("x");
        let y = entity!("negated", &[], (x) => (-x).named("n")).named("y");
        let z = entity!("outer", &[], (a) => { let x = a; (entity!("negated", &[], (x) => (-x).named("n")) + a).named("s") });
        vec![y, z.named("z")]
    });
    let flat = Flat::new(&block);
    let blocks: Vec<&str> = flat.blocks.iter().map(|block| block.name.as_str()).collect();
    assert_eq!(blocks, ["sample", "negated", "outer"]);
    assert_eq!(flat.top_node("z").map(|i| flat.nodes[i].path.as_str()), Some("z_unit.s"));
    lines(
        expect![[r#"
            a: Pair of
            b: Pair of
            x_select: Phase of
            x: Phase of x_select a b
            y_unit.n: Phase of x
            z_unit.s_result_unit.n: Pair of a
            z_unit.s: Pair of z_unit.s_result_unit.n a
            a@0 <-
            b@0 <-
            x_select@0 <-
            x_select@1 <-
            x@0 <- a@0
            x@1 <- b@0
            y_unit.n@0 <- x@0
            y_unit.n@1 <- x@1
            z_unit.s_result_unit.n@0 <- a@0
            z_unit.s@0 <- z_unit.s_result_unit.n@0 a@0
        "#]],
        text(&flat),
    );
}

#[test]
fn a_step_reads_the_phase_that_its_node_is_about() {
    let block = block(3, |top| {
        let a = [0; 3].map(|_| top.input(S8, ALL)).to_vec().named("a");
        let x = Phases::new(3, |s| Some(a[s])).mux().named("x");
        let first = Phases::new(3, |s| Some(i128::from(s == 0))).constant(top, Type::FLAG).named("first");
        let any = x.low(4).any().named("any").or_over_phases(first).named("so_far");
        vec![x.earlier(1).named("before").capture(2, false).named("y"), any.capture(1, false).named("z")]
    });
    lines(
        expect![[r#"
            a0: Pair of
            a1: Pair of
            a2: Pair of
            x_select: Phase of
            x: Phase of x_select a0 a1 a2
            first: Phase of
            any_low: Phase of x
            any: Phase of any_low
            so_far: Phase of any first
            before: Phase of x
            y: Pair of before
            z: Pair of so_far
            a0@0 <-
            a1@0 <-
            a2@0 <-
            x_select@0 <-
            x_select@1 <-
            x_select@2 <-
            x@0 <- a0@0
            x@1 <- a1@0
            x@2 <- a2@0
            first@0 <-
            first@1 <-
            first@2 <-
            any_low@0 <- x@0
            any_low@1 <- x@1
            any_low@2 <- x@2
            any@0 <- any_low@0
            any@1 <- any_low@1
            any@2 <- any_low@2
            so_far@0 <- any@0 first@0
            so_far@1 <- any@1 first@1 so_far@0
            so_far@2 <- any@2 first@2 so_far@1
            before@0 <- x@0
            before@1 <- x@0
            before@2 <- x@1
            y@0 <- before@2
            z@0 <- so_far@1
        "#]],
        text(&Flat::new(&block)),
    );
}

#[test]
fn what_comes_later_is_ordered_by_phase() {
    let block = block(2, |top| {
        let a = top.input(S8, (0, 9)).named("a");
        let back = top.later(S8, (0, 50));
        let x = Phases::new(2, |s| Some((s, [a, back][s]))).late(|(s, _)| *s == 1).map(|x| x.1).mux().named("x");
        back.connect((x + x.like(1)).bits(8).named("next").capture(0, false).named("first"));
        vec![x.capture(1, true).named("y")]
    });
    lines(
        expect![[r#"
            a: Pair of
            x_select: Phase of
            x: Phase of x_select a first
            next_constant: Any of
            next: Phase of x next_constant
            first: Pair of next
            y: Pair of x
            a@0 <-
            x_select@0 <-
            x_select@1 <-
            x@0 <- a@0
            next_constant@0 <-
            next@0 <- x@0 next_constant@0
            first@0 <- next@0
            x@1 <- first@0
            next@1 <- x@1 next_constant@0
            y@0 <- x@1
        "#]],
        text(&Flat::new(&block)),
    );
}
