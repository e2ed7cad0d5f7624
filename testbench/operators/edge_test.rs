//! Edges that pass through the other triangle, against the definition.

use super::Bench;
use efsat::design::comparator::{Owners, comparator};
use efsat::design::edge_test::{Seen, pierced};
use efsat::graph::Signals;
use efsat::op::Type;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

#[test]
fn a_side_is_certain_if_it_is_the_same_for_every_choice() {
    let mut unit = Bench::new(|top| {
        let [a, b] = super::inputs(top, "p", Type::signed(4, 0), 4);
        let [above, below] = comparator(vec![a, a, a, b, b, b], Owners::Fixed, true).1.expect("edges are tested");
        [above, below].concat()
    });
    super::tuples(&super::intervals(-4..=4), 2, |p| {
        let all = |test: fn(i128, i128) -> bool| super::values(p[0]).all(|a| super::values(p[1]).all(|b| test(a, b)));
        let certain = [all(|a, b| b > a), all(|a, b| b < a)].map(|side| [i128::from(side); 9]);
        assert_eq!(unit.run(p, &[]), certain.concat(), "{p:?}");
    });
}

#[test]
fn edges_pass_by_definition() {
    // Signs: -1, 0 where it is not certain, 1; of W_l against A's plane, V_k against B's, and edge l against edge k.
    let mut unit = Bench::new(|top| {
        let flag = || top.input(Type::FLAG, (0, 1));
        let vertices = [(); 2].map(|()| [(); 3].map(|()| [(); 2].map(|()| flag()))).named("vertices");
        let edges = [(); 3].map(|()| [(); 3].map(|()| [(); 2].map(|()| flag()))).named("edges");
        let of = |seen: Seen| match seen {
            Seen::Vertex(triangle, i) => vertices[triangle][i],
            Seen::Edge(k, l) => edges[k][l],
        };
        vec![pierced(of)]
    });
    let mut rng = ChaCha8Rng::seed_from_u64(15);
    let mut counts = [0; 2];
    for _ in 0..20_000 {
        // Most sides alike, so that edges do pass.
        let common = [-1, 1][rng.random_range(0..2)];
        let mut sign = || if rng.random_range(0..3) > 0 { common } else { rng.random_range(-1..=1) };
        let vertices = [(); 2].map(|()| [(); 3].map(|()| sign()));
        let edges = [(); 3].map(|()| [(); 3].map(|()| sign()));
        let passes = |ends: [i128; 3], k: usize, sides: [i128; 3]| {
            ends[k] * ends[(k + 1) % 3] == -1 && sides.iter().sum::<i128>().abs() == 3
        };
        let expected = (0..3).any(|k| passes(vertices[1], k, edges[k]))
            || (0..3).any(|l| passes(vertices[0], l, [0, 1, 2].map(|k| edges[k][l])));
        let signs = vertices.iter().flatten().chain(edges.iter().flatten());
        let flags: Vec<i128> = signs.flat_map(|s| [i128::from(*s > 0), i128::from(*s < 0)]).collect();
        assert_eq!(unit.run(&[], &flags), [i128::from(expected)], "{vertices:?} {edges:?}");
        counts[usize::from(expected)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 2000), "{counts:?}");
}
