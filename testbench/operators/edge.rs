//! Edges and normals: their extents, and what clamping to them leaves inside.

use super::renormalise::bit_length;
use super::renormalise::renormalisers;
use super::renormalise::scale;
use super::{Bench, Bounds, UPPERS, at, tuples};
use efsat::design::interval::{Narrowing, Rounding};
use efsat::design::{cross_product, interval, multiply, renormalise};
use efsat::graph::Type;
use efsat::number::{Upper, upper_shift};
use efsat::params::{AxisKind, Formats, Params, Row, Transform};
use std::collections::HashSet;

/// Lemma anchored-edge: an edge at V0 stays within 1 + ulp, for every second vertex of A and every common power of two,
/// and reaches it.
#[test]
fn anchored_edges_stay_within_one_and_an_ulp() {
    for p in renormalisers() {
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        let row = &p.formats().edge_a[0];
        let grid = p.formats().coordinate_a.format.fraction;
        let one = 1i128 << grid;
        let ty = Type::signed(p.width, grid);
        let narrowing = Narrowing {
            bound: Some((one + 1, "anchored-edge")),
            rounding: Rounding { drop: grid - row.format.fraction, clamp: None },
            bits: p.width,
            upper: p.upper,
        };
        let mut edge =
            Bench::new(&interval::subtract_unit("edge", (ty, (-one, one)), (ty, (-one, one)), Some(narrowing)));
        let mut unit = Bench::new(&renormalise::scale_unit(&p));
        let reach = 2 * p.coordinate_bound();
        let widths: &[i128] = if p.upper == Upper::Implied { &[1] } else { &[0, 1] };
        let mut greatest = 0;
        for lo in -reach..=reach {
            for (v0_width, v1_width) in widths.iter().flat_map(|x| widths.iter().map(move |y| (*x, *y))) {
                let (v0, v1) = (at(0, v0_width), at(lo, lo + v1_width));
                for length in bit_length(v0.hi | v1.lo.abs() | v1.hi.abs()).max(1)..=bits {
                    let [v0, v1, _] = scale(&mut unit, [v0, v1, v0], bits - length, stages);
                    for [to, from] in [[v1, v0], [v0, v1]] {
                        edge.run(&[to, from], &[]);
                        let found = edge.interval("");
                        assert!(-row.bound <= found.lo && found.hi <= row.bound, "{to:?} {from:?} {found:?}");
                        greatest = greatest.max(to.hi - from.lo).max(from.hi - to.lo);
                    }
                }
            }
        }
        // Both roundings must be inexact for the ulp; an exact ceiling is one where points reach beyond the grid.
        let inexact = p.upper == Upper::Implied || reach >= 2 * one - 1;
        assert_eq!(greatest, one + i128::from(inexact), "{p:?}");
    }
}

/// Lemma triangle-area: twice the area of a triangle in a box is at most the product of the box's sides.
#[test]
fn twice_the_area_of_a_triangle_is_at_most_its_box() {
    for (width, height) in [(1, 1), (2, 2), (4, 4), (2, 5), (3, 1)] {
        let points: Vec<(i128, i128)> = (0..=width).flat_map(|x| (0..=height).map(move |y| (x, y))).collect();
        let mut greatest = 0;
        tuples(&points, 3, |w| {
            let [a, b] = [1, 2].map(|i: usize| (w[i].0 - w[0].0, w[i].1 - w[0].1));
            greatest = greatest.max((a.0 * b.1 - a.1 * b.0).abs());
        });
        assert_eq!(greatest, width * height);
    }
}

/// Lemma edge-extent: a difference of two coordinates in [-1, 1] is at most 2, and of two rows of M B~ + t at most 6;
/// both are multilinear, so the corners decide.
#[test]
fn true_edges_stay_within_their_extent() {
    let mut greatest = [0, 0];
    tuples(&[-2i128, -1, 0, 1, 2], 2, |x| greatest[0] = greatest[0].max((x[1] - x[0]).abs()));
    tuples(&[-1i128, 0, 1], 9, |x| {
        let (m, rest) = x.split_at(3);
        let edge: i128 = (0..3).map(|j| m[j] * (rest[3 + j] - rest[j])).sum();
        greatest[1] = greatest[1].max(edge.abs());
    });
    assert_eq!(greatest, [2 * 2, 6]);
}

/// True bounds along one coordinate axis, of an edge of A and of B, in ulps of the coordinates (lemma edge-extent),
/// written from sections 3 and 4 of the contract.
pub(super) fn extents(p: &Params, f: &Formats) -> [i128; 2] {
    let one = 1i128 << f.coordinate_a.format.fraction;
    let natural = [2 * f.coordinate_a.bound, 2 * f.coordinate_b.bound];
    match (p.renormalise, p.transform) {
        (true, _) | (false, Transform::Translate) => [2 * one; 2],
        (false, Transform::On) => [2 * one, natural[1].min(6 * one)],
        (false, Transform::Off) => natural,
    }
}

/// Whether an interval contains a number given with `drop` fraction bits more.
fn holds(x: Bounds, value: i128, drop: i32) -> bool {
    let (finer, coarser) = ((-drop).max(0), drop.max(0));
    x.lo << coarser <= value << finer && value << finer <= x.hi << coarser
}

/// The rounding to a row, with `fewer` integral digits less than it has; the clamp is the row's, or the least mantissa
/// above a true bound where that is given as bound, fraction bits and lemma.
pub(super) fn way(exact: i32, row: &Row, fewer: i32, truth: Option<(i128, i32, &'static str)>) -> Rounding {
    let fraction = row.format.fraction + fewer;
    let clamp = match truth {
        None => row.clamp.map(|c| (c.bound, c.lemma)),
        Some((bound, at, lemma)) => Some((upper_shift(bound, at - fraction, Upper::Sticky), lemma)),
    };
    Rounding { drop: exact - fraction, clamp }
}

/// Edges and normal of B with their clamps, on triangles in and near the corners of the domain: whatever is clamped,
/// the true number stays inside.
#[test]
fn clamped_edges_and_normals_contain_the_true_ones() {
    let mut clamps = HashSet::new();
    for upper in UPPERS {
        for (width, transform, renormalise) in [
            (6, Transform::On, true),
            (7, Transform::On, true),
            (6, Transform::Off, false),
            (6, Transform::Translate, false),
        ] {
            let p = Params { width, transform_width: width, transform, renormalise, upper, ..Params::default() };
            let f = p.formats();
            let (coordinate, edge_row, normal_row) = (&f.coordinate_b, &f.edge_b, f.axis(AxisKind::NormalB));
            clamps.extend([edge_row, normal_row].into_iter().filter_map(|r| r.clamp).map(|c| c.lemma));
            let grid = coordinate.format.fraction;
            let ty = Type::signed(p.width, grid);
            let range = (-coordinate.bound, coordinate.bound);
            let narrowing = Narrowing { bound: None, rounding: way(grid, edge_row, 0, None), bits: p.width, upper };
            let mut edge = Bench::new(&interval::subtract_unit("edge_b", (ty, range), (ty, range), Some(narrowing)));
            let rounding = way(2 * edge_row.format.fraction, normal_row, 0, None);
            let spec = cross_product::Spec {
                bits: p.width,
                left: edge_row.bound,
                right: edge_row.bound,
                roundings: &[rounding],
                upper,
                notes: &[],
                sign_case: &multiply::sign_case_unit(Type::signed(p.width, 0), edge_row.bound),
            };
            let mut cross = Bench::new(&cross_product::unit(&spec));
            // Half an ulp, so that the true numbers lie on and off the grid; the box is the lemma's.
            let half = extents(&p, &f)[1] - 1;
            tuples(&[-half, 1 - half, -1, 0, half - 2, half], 6, |w| {
                // Vertices in the plane z = 0: x0 x1 x2 y0 y1 y2.
                let enclosure = |x: i128| {
                    let hi = if upper == Upper::Implied { (x >> 1) + 1 } else { -(-x >> 1) };
                    at(x >> 1, hi.min(coordinate.bound))
                };
                let mut difference = |to: usize, from: usize| {
                    edge.run(&[enclosure(w[to]), enclosure(w[from])], &[]);
                    let found = edge.interval("");
                    let drop = grid - edge_row.format.fraction;
                    assert!(holds(found, w[to] - w[from], drop + 1), "{w:?} {found:?} {p:?}");
                    found
                };
                // W1 - W0, and W2 - W0 as the negated edge.
                let e = [difference(1, 0), difference(4, 3), at(0, 0)];
                let minus = |x: Bounds| at(-x.hi, -x.lo);
                let g = [minus(difference(0, 2)), minus(difference(3, 5)), at(0, 0)];
                cross.run(&[e[0], e[1], e[2], g[0], g[1], g[2]], &[]);
                let found = cross.interval("l_z");
                let truth = (w[1] - w[0]) * (w[5] - w[3]) - (w[4] - w[3]) * (w[2] - w[0]);
                assert!(holds(found, truth, 2 * grid - normal_row.format.fraction + 2), "{w:?} {found:?} {p:?}");
                assert!(-normal_row.bound <= found.lo && found.hi <= normal_row.bound);
            });
        }
    }
    assert_eq!(clamps, HashSet::from(["edge-extent", "triangle-area"]));
}
