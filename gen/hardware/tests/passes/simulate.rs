//! Modules clock by clock, in blocks of any length.

use super::*;
use efsat_hardware::graph::Place;
use efsat_hardware::netlist::Wire;
use efsat_hardware::netlist::simulate::Simulation;
use efsat_hardware::op::{Add, Multiply};
use expect_test::expect;

/// The outputs in every clock, a row each, after the inputs of every clock; the same for blocks of every length.
fn trace(module: &Rc<Module>, inputs: &[&[i128]]) -> Vec<String> {
    let clocks = inputs[0].len();
    let run = |block: usize| {
        let mut simulation = Simulation::new(module, block);
        let mut rows = vec![vec![]; module.outputs.len()];
        for start in (0..clocks).step_by(block) {
            let now = block.min(clocks - start);
            for (port, values) in inputs.iter().enumerate() {
                (0..block).for_each(|t| simulation.set(port, t, values[(start + t).min(clocks - 1)]));
            }
            simulation.run();
            for (port, row) in rows.iter_mut().enumerate() {
                row.extend((0..now).map(|t| simulation.output(port, t).to_string()));
            }
        }
        rows
    };
    let rows = run(1);
    [2, 5, clocks, clocks + 3].into_iter().for_each(|block| assert_eq!(run(block), rows, "in blocks of {block}"));
    module.outputs.iter().zip(rows).map(|((place, _), row)| format!("{place}: {}", row.join(" "))).collect()
}

fn register<'m>(m: &'m Control, name: &str, ty: Type, connect: impl FnOnce(Wire<'m>)) {
    let q = m.register(name, ty);
    connect(q);
    q.output(Place::new(format!("{name}_q")));
}

#[test]
fn registers_load_when_enabled_and_are_reset() {
    let module = module(|m| {
        let [reset, go] = ["reset", "go"].map(|name| m.input(name, Type::FLAG));
        let a = m.input("a", S8);
        register(m, "plain", S8, |q| q.loads(a, None, None));
        register(m, "enabled", S8, |q| q.loads(a, Some(go), None));
        register(m, "resettable", S8, |q| q.loads(a, None, Some((reset, 5))));
        register(m, "both", S8, |q| q.loads(a, Some(go), Some((reset, -5))));
        register(m, "counter", S8, |q| q.loads(q.plus(1), Some(go), Some((reset, 7))));
    });
    let inputs: [&[i128]; 3] = [&[0, 0, 0, 0, 1, 0, 0], &[0, 1, 1, 0, 1, 1, 0], &[1, 2, 3, 4, 5, 6, 7]];
    lines(
        expect![[r#"
        plain_q: 0 1 2 3 4 5 6
        enabled_q: 0 0 2 3 3 5 6
        resettable_q: 0 1 2 3 4 5 6
        both_q: 0 0 2 3 3 -5 6
        counter_q: 0 0 1 2 2 7 8
    "#]],
        trace(&module, &inputs),
    );
}

#[test]
fn memories_are_read_at_once_and_written_a_clock_later() {
    let module = module(|m| {
        let write = m.input("write", Type::FLAG);
        let [address, read] = ["address", "read"].map(|name| m.input(name, Type::unsigned(2)));
        let data = m.input("data", S8);
        m.memory("words", write, address, data, read).output("y");
        // One that depends on what it gives.
        let again = m.later(S8);
        let words = m.memory("more", write, address, again, address);
        again.stands_for(words.plus(3));
        words.output("z");
    });
    let inputs: [&[i128]; 4] =
        [&[1, 1, 0, 1, 0, 1], &[0, 1, 1, 1, 0, 0], &[0, 0, 1, 1, 1, 0], &[10, 20, 30, 40, 50, 60]];
    lines(
        expect![[r#"
        y: 0 10 20 20 40 10
        z: 0 0 3 3 3 3
    "#]],
        trace(&module, &inputs),
    );
}

#[test]
fn numbers_of_more_than_64_bits_are_exact() {
    let wide = Type::signed(90, 0);
    let module = module(|m| {
        let a = m.input("a", Type::signed(45, 0));
        let square = a.apply(Multiply, &[a]);
        register(m, "square", wide, |q| q.loads(square, None, None));
        register(m, "sum", wide, |q| q.loads(q.apply(Add(Some(90)), &[square]), None, None));
    });
    let most = Type::signed(45, 0).limits().0;
    lines(
        expect![[r#"
        square_q: 0 309485009821345068724781056 309485009821309884352692225 9
        sum_q: 0 309485009821345068724781056 618970019642654953077473281 618970019642654953077473290
    "#]],
        trace(&module, &[&[most, most + 1, 3, -3]]),
    );
}

#[test]
fn instances_are_dissolved_by_their_ports() {
    let inner = module(|m| {
        let [a, b] = ["a", "b"].map(|name| m.input(name, S8));
        let q = m.register("q", S8);
        q.loads(a, None, None);
        q.output("first");
        b.plus(1).output("second");
    });
    let module = module(|m| {
        let [a, b] = ["a", "b"].map(|name| m.input(name, S8));
        let one = m.instance("one", &inner, &[a, b]);
        let two = m.instance("two", &inner, &[one[1], one[0]]);
        two.iter().zip(["y", "z"]).for_each(|(wire, name)| wire.output(name));
    });
    lines(
        expect![[r#"
        y: 0 11 21 31
        z: 1 2 3 4
    "#]],
        trace(&module, &[&[1, 2, 3, 4], &[10, 20, 30, 40]]),
    );
}

#[test]
fn a_part_of_a_module_depends_on_the_inputs_that_reach_it() {
    let module = module(|m| {
        let [a, b] = ["a", "b"].map(|name| m.input(name, S8));
        register(m, "x", S8, |q| q.loads(a, None, None));
        register(m, "y", S8, |q| q.loads(b, None, None));
    });
    let mut part = Simulation::restricted(&module, &["y_q"]);
    assert_eq!([0, 1].map(|port| part.reaches(port)), [false, true]);
    part.set(0, 0, 3);
    part.set(1, 0, 4);
    part.run();
    part.run();
    assert_eq!(part.output(0, 0), 4);
}

#[test]
fn the_operands_of_products_are_told() {
    let module = module(|m| {
        let [a, b] = ["a", "b"].map(|name| m.input(name, S8));
        a.apply(Multiply, &[b]).output("y");
        a.apply(Add(None), &[b]).output("z");
    });
    let mut simulation = Simulation::new(&module, 2);
    [[1, 2], [3, 4]]
        .iter()
        .enumerate()
        .for_each(|(port, values)| (0..2).for_each(|t| simulation.set(port, t, values[t])));
    simulation.run();
    assert_eq!(simulation.multiplied(), [2, 4]);
}
