//! The comparator against the definition of section 6 of the contract.

use super::{Bench, Bounds, at, inputs, intervals, tuples, values};
use efsat::design::comparator::{DUPLICATES, Owners, comparator};
use efsat::graph::{Signals, Top};
use efsat::op::Type;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::HashSet;

/// A comparator of `N` projections.
fn unit<const N: usize>(owners: impl for<'l> FnOnce(Top<'l>) -> Owners<'l>) -> Bench {
    Bench::new(|top| {
        let p = inputs::<N>(top, "p", Type::signed(4, 0), 4).to_vec();
        comparator(p, owners(top), false).signals()
    })
}

/// All images (least and greatest projection) that three true projections can have, duplicates being equal.
fn images(p: &[Bounds], equal: &[(usize, usize)]) -> Vec<(i128, i128)> {
    let mut found = HashSet::new();
    let third = p.get(2).copied();
    for x in values(p[0]) {
        for y in p.get(1).map_or(x..=x, |p| values(*p)) {
            for z in third.map_or(x..=x, values) {
                let v = [x, y, z];
                if equal.iter().all(|(i, j)| v[*i] == v[*j]) {
                    found.insert((x.min(y).min(z), x.max(y).max(z)));
                }
            }
        }
    }
    found.into_iter().collect()
}

/// Section 6 by definition: what holds for every choice of true projections. `None` if there is none.
fn decided(a: &[(i128, i128)], b: &[(i128, i128)]) -> Option<(bool, bool)> {
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let all = |test: fn((i128, i128), (i128, i128)) -> bool| a.iter().all(|x| b.iter().all(|y| test(*x, *y)));
    let separated = all(|a, b| a.1 < b.0) || all(|a, b| b.1 < a.0);
    assert_eq!(separated, all(|a, b| a.1 < b.0 || b.1 < a.0));
    Some((separated, all(|a, b| a.0 < b.1 && b.0 < a.1)))
}

/// Compares a comparator with the definition; counts separated, overlapping, unknown, to see that a test met all three.
fn check(unit: &mut Bench, p: &[Bounds], extra: &[i128], expected: Option<(bool, bool)>, counts: &mut [usize; 3]) {
    let Some(expected) = expected else { return };
    let found = unit.run(p, extra);
    assert_eq!((found[0] != 0, found[1] != 0), expected, "{p:?} {extra:?}");
    counts[if expected.0 { 0 } else { 2 - usize::from(expected.1) }] += 1;
}

/// Six projections at random, each up to 3 wide.
fn drawn(rng: &mut ChaCha8Rng) -> [Bounds; 6] {
    [(); 6].map(|()| {
        let lo = rng.random_range(-4..=4);
        at(lo, rng.random_range(lo..=(lo + 3).min(4)))
    })
}

/// All small integer cases against section 6, with every projection computed.
#[test]
fn comparators_decide_by_definition_with_all_projections() {
    let mut unit = unit::<6>(|_| Owners::Fixed);
    let mut counts = [0; 3];
    let mut try_out = |p: &[Bounds]| {
        check(&mut unit, p, &[], decided(&images(&p[..3], &[]), &images(&p[3..], &[])), &mut counts);
    };
    tuples(&intervals(-1..=1), 6, &mut try_out);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    (0..20_000).for_each(|_| try_out(&drawn(&mut rng)));
    assert!(counts.iter().all(|n| *n > 300), "{counts:?}");
}

/// With duplicates skipped: A's projections from the first, B's from the last; what lies between changes hands.
#[test]
fn comparators_decide_by_definition_with_duplicates_skipped() {
    fn has(top: Top<'_>) -> Owners<'_> {
        Owners::Shared(["a", "b"].map(|of| [(); 2].map(|()| top.input(Type::FLAG, (0, 1))).named(of).to_vec()))
    }
    // Eleven axes need four projections, seventeen five.
    let four = (unit::<4>(has), 4, vec![(2, 2), (1, 3), (3, 1)], -1..=2);
    let five = (unit::<5>(has), 5, vec![(2, 2), (1, 3), (3, 1), (2, 3), (3, 2)], -1..=1);
    for (mut unit, points, splits, range) in [four, five] {
        for (of_a, of_b) in splits {
            let has = [of_a > 1, of_a > 2, of_b > 1, of_b > 2].map(i128::from);
            let mut counts = [0; 3];
            tuples(&intervals(range.clone()), points, |p| {
                let (a, b) = (&p[..of_a], &p[p.len() - of_b..]);
                check(&mut unit, p, &has, decided(&images(a, &[]), &images(b, &[])), &mut counts);
            });
            // One projection of A alone never overlaps strictly where all three of it are equal.
            assert!(counts[0] > 50 && counts[2] > 50 && counts[1] > 0, "{counts:?} {of_a} {of_b}");
        }
    }
}

/// With duplicates intersected: the choices are those in which duplicates are equal; there is at least the true one.
#[test]
fn comparators_decide_by_definition_with_duplicates_intersected() {
    let mut unit = unit::<6>(|top| {
        let codes = [(); 2].map(|()| top.input(DUPLICATES, (0, 4))).named("duplicates");
        Owners::Intersected(codes)
    });
    let groups: [&[(usize, usize)]; 5] = [&[], &[(0, 1)], &[(1, 2)], &[(2, 0)], &[(0, 1), (1, 2)]];
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for (code_a, code_b) in (0..5).flat_map(|a| (0..5).map(move |b| (a, b))) {
        let mut counts = [0; 3];
        let mut try_out = |p: &[Bounds]| {
            let expected = decided(&images(&p[..3], groups[code_a]), &images(&p[3..], groups[code_b]));
            check(&mut unit, p, &[code_a as i128, code_b as i128], expected, &mut counts);
        };
        tuples(&[at(-1, -1), at(-1, 0), at(0, 1), at(0, 0), at(-1, 1)], 6, &mut try_out);
        (0..5_000).for_each(|_| try_out(&drawn(&mut rng)));
        assert!(counts[0] > 0 && counts[2] > 0, "{counts:?}");
        // Both triangles seen edge on: two points never overlap strictly.
        assert_eq!(counts[1] > 0, (code_a, code_b) != (4, 4), "{counts:?} {code_a} {code_b}");
    }
}
