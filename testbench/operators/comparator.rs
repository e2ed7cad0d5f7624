//! The comparator against the definition of section 6 of the contract.

use super::{Bench, Bounds, at, intervals, tuples, values};
use efsat::design::comparator;
use efsat::params::Projections;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::HashSet;

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

/// Tallies of (separated, overlapping, unknown), to see that a test met all three.
fn tally(counts: &mut [usize; 3], flags: (bool, bool)) {
    counts[if flags.0 { 0 } else { 2 - usize::from(flags.1) }] += 1;
}

/// All small integer cases against section 6, with every projection computed.
#[test]
fn comparators_decide_by_definition_with_all_projections() {
    let mut unit = Bench::new(&comparator::unit(4, 4, 6, Projections::All));
    let mut counts = [0; 3];
    let mut check = |p: &[Bounds]| {
        unit.run(p, &[]);
        let found = (unit.flag("separated"), unit.flag("overlapping"));
        assert_eq!(Some(found), decided(&images(&p[..3], &[]), &images(&p[3..], &[])), "{p:?}");
        tally(&mut counts, found);
    };
    tuples(&intervals(-1..=1), 6, &mut check);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..20_000 {
        let p: Vec<Bounds> = (0..6)
            .map(|_| {
                let lo = rng.random_range(-4..=4);
                at(lo, rng.random_range(lo..=(lo + 3).min(4)))
            })
            .collect();
        check(&p);
    }
    assert!(counts.iter().all(|n| *n > 300), "{counts:?}");
}

/// With duplicates skipped: A's projections from the first, B's from the last; what lies between changes hands.
#[test]
fn comparators_decide_by_definition_with_duplicates_skipped() {
    // Eleven axes need four projections, seventeen five.
    for (points, splits) in [(4usize, vec![(2, 2), (1, 3), (3, 1)]), (5, vec![(2, 2), (1, 3), (3, 1), (2, 3), (3, 2)])]
    {
        let mut unit = Bench::new(&comparator::unit(4, 3, points, Projections::Skip));
        let last = points - 1;
        let flags = ["a_has_1", "a_has_2"].map(str::to_owned).into_iter();
        let flags: Vec<String> = flags.chain([1, 2].map(|i| format!("b_has_{}", last - i))).collect();
        assert_eq!(unit.ports[2 * points..], flags);
        for (of_a, of_b) in splits {
            let has = [of_a > 1, of_a > 2, of_b > 1, of_b > 2].map(i128::from);
            let mut counts = [0; 3];
            tuples(&intervals(if points == 4 { -1..=2 } else { -1..=1 }), points as u32, |p| {
                unit.run(p, &has);
                let found = (unit.flag("separated"), unit.flag("overlapping"));
                let (a, b) = (&p[..of_a], &p[points - of_b..]);
                assert_eq!(Some(found), decided(&images(a, &[]), &images(b, &[])), "{p:?} {of_a} {of_b}");
                tally(&mut counts, found);
            });
            // One projection of A alone never overlaps strictly where all three of it are equal.
            assert!(counts[0] > 50 && counts[2] > 50 && counts[1] > 0, "{counts:?} {of_a} {of_b}");
        }
    }
}

/// With duplicates intersected: the choices are those in which duplicates are equal; there is at least the true one.
#[test]
fn comparators_decide_by_definition_with_duplicates_intersected() {
    let mut unit = Bench::new(&comparator::unit(4, 4, 6, Projections::Intersect));
    assert_eq!(unit.ports[12..], ["duplicates_a", "duplicates_b"]);
    let groups: [&[(usize, usize)]; 5] = [&[], &[(0, 1)], &[(1, 2)], &[(2, 0)], &[(0, 1), (1, 2)]];
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for (code_a, code_b) in (0..5).flat_map(|a| (0..5).map(move |b| (a, b))) {
        let mut counts = [0; 3];
        let mut check = |p: &[Bounds]| {
            let expected = decided(&images(&p[..3], groups[code_a]), &images(&p[3..], groups[code_b]));
            let Some(expected) = expected else { return };
            unit.run(p, &[code_a as i128, code_b as i128]);
            let found = (unit.flag("separated"), unit.flag("overlapping"));
            assert_eq!(found, expected, "{p:?} {code_a} {code_b}");
            tally(&mut counts, found);
        };
        tuples(&[at(-1, -1), at(-1, 0), at(0, 1), at(0, 0), at(-1, 1)], 6, &mut check);
        for _ in 0..5_000 {
            let p: Vec<Bounds> = (0..6)
                .map(|_| {
                    let lo = rng.random_range(-4..=4);
                    at(lo, rng.random_range(lo..=(lo + 3).min(4)))
                })
                .collect();
            check(&p);
        }
        assert!(counts[0] > 0 && counts[2] > 0, "{counts:?}");
        // Both triangles seen edge on: two points never overlap strictly.
        assert_eq!(counts[1] > 0, (code_a, code_b) != (4, 4), "{counts:?} {code_a} {code_b}");
    }
}
