//! Edges and normals: their extents, and what saturation at them leaves inside.

use super::renormalise::{bit_length, flags, renormalisers, scaled, word};
use super::{Bench, Bounds, UPPERS, at, inputs, tuples};
use efsat::design::cross_product::cross_product;
use efsat::design::interval::Interval;
use efsat::design::rounding::{Rounding, Roundings};
use efsat::graph::{Signals, Vec3};
use efsat::number::{Upper, upper_shift};
use efsat::op::Type;
use efsat::params::{AxisKind, FormatRow, Formats, Params, Transform};
use std::collections::HashSet;

/// Lemma anchored-edge: an edge at V0 stays within 1 + ulp, for every second vertex of A and every common power of two,
/// and reaches it.
#[test]
fn anchored_edges_stay_within_one_and_an_ulp() {
    for p in renormalisers() {
        let (bits, stages) = word(&p);
        let row = &p.formats().edge_a[0];
        let grid = p.formats().coordinate_a.format.fraction;
        let one = 1i128 << grid;
        let roundings = roundings(&p, way(grid, row, 0, None), row.format.fraction);
        let mut unit = Bench::new(|top| {
            let Vec3([v0, v1, _]) = scaled(top, &p);
            let exact = [v1 - v0, v0 - v1].named("exact");
            let edges = exact.assume(one + 1, "anchored-edge").map(|x| x.round_outward(&roundings));
            [edges, exact].signals()
        });
        let reach = 2 * p.coordinate_bound();
        let widths: &[i128] = if p.upper == Upper::Implied { &[1] } else { &[0, 1] };
        let mut greatest = 0;
        for lo in -reach..=reach {
            for (v0_width, v1_width) in widths.iter().flat_map(|x| widths.iter().map(move |y| (*x, *y))) {
                let (v0, v1) = (at(0, v0_width), at(lo, lo + v1_width));
                for length in bit_length(v0.hi | v1.lo.abs() | v1.hi.abs()).max(1)..=bits {
                    let found = unit.bounds(&[v0, v1, v0], &flags(bits - length, stages));
                    let (edges, exact) = found.split_at(2);
                    assert!(edges.iter().all(|e| -row.bound <= e.lo && e.hi <= row.bound), "{v0:?} {v1:?} {edges:?}");
                    greatest = exact.iter().map(|e| e.hi).fold(greatest, i128::max);
                }
            }
        }
        // Both roundings must be inexact for the ulp; an exact ceiling is one where points reach beyond the grid.
        let inexact = p.upper == Upper::Implied || reach >= 2 * one - 1;
        assert_eq!(greatest, one + i128::from(inexact), "{p:?}");
    }
}

/// Rounding to a type of the working width.
pub(super) fn roundings<'l>(p: &Params, way: Rounding, fraction: i32) -> Roundings<'l> {
    Roundings::one(way, p.upper, Type::signed(p.width, fraction))
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

/// The rounding to a row, with `fewer` integral digits less than it has; saturated as the row is, or at the least mantissa
/// above a true bound where that is given as bound, fraction bits and lemma.
pub(super) fn way(exact: i32, row: &FormatRow, fewer: i32, truth: Option<(i128, i32, &'static str)>) -> Rounding {
    let fraction = row.format.fraction + fewer;
    let saturate = match truth {
        None => row.clamp.map(|c| (c.bound, c.lemma)),
        Some((bound, at, lemma)) => Some((upper_shift(bound, at - fraction, Upper::Sticky), lemma)),
    };
    Rounding { drop: exact - fraction, saturate }
}

/// Edges and normal of B, saturated, on triangles in and near the corners of the domain: whatever is saturated,
/// the true number stays inside.
#[test]
fn clamped_edges_and_normals_contain_the_true_ones() {
    let mut lemmas = HashSet::new();
    for upper in UPPERS {
        let (on, translate, off) = (Transform::On, Transform::Translate, Transform::Off);
        for (width, transform, renormalise) in [(6, on, true), (7, on, true), (6, off, false), (6, translate, false)] {
            let p = Params { width, transform_width: width, transform, renormalise, upper, ..Params::paper() };
            let f = p.formats();
            let (coordinate, edge_row, normal_row) = (&f.coordinate_b, &f.edge_b, f.axis(AxisKind::NormalB));
            lemmas.extend([edge_row, normal_row].into_iter().filter_map(|r| r.clamp).map(|c| c.lemma));
            let (grid, fraction) = (coordinate.format.fraction, edge_row.format.fraction);
            let to_edge = roundings(&p, way(grid, edge_row, 0, None), fraction);
            let to_normal = roundings(&p, way(2 * fraction, normal_row, 0, None), normal_row.format.fraction);
            let mut unit = Bench::new(|top| {
                // Vertices in the plane z = 0.
                let [x0, x1, x2, y0, y1, y2] = inputs(top, "w", Type::signed(p.width, grid), coordinate.bound);
                let edges = [x1 - x0, y1 - y0, x0 - x2, y0 - y2].named("exact").map(|e| e.round_outward(&to_edge));
                let [x, y, back_x, back_y] = edges.named("edge");
                // W1 - W0, and W2 - W0 as the negated edge; component z reads nothing of the third one.
                let e = Vec3([x, y, x]).map(Interval::factor).named("e");
                let f = [-back_x, -back_y].map(|e| e.each(|_, end| end.bits(p.width)));
                let f = Vec3([f[0], f[1], f[0]]).map(Interval::factor).named("f");
                [x, y, back_x, back_y, cross_product(e, f, Some(&to_normal), &[])[2]].signals()
            });
            // Half an ulp, so that the true numbers lie on and off the grid; the box is the lemma's.
            let half = extents(&p, &f)[1] - 1;
            tuples(&[-half, 1 - half, -1, 0, half - 2, half], 6, |w| {
                let enclosure = |x: &i128| {
                    let hi = if upper == Upper::Implied { (x >> 1) + 1 } else { -(-x >> 1) };
                    at(x >> 1, hi.min(coordinate.bound))
                };
                let found = unit.bounds(&w.iter().map(enclosure).collect::<Vec<_>>(), &[]);
                for (found, (to, from)) in found.iter().zip([(1, 0), (4, 3), (0, 2), (3, 5)]) {
                    assert!(holds(*found, w[to] - w[from], grid - fraction + 1), "{w:?} {found:?} {p:?}");
                }
                let found = found[4];
                let truth = (w[1] - w[0]) * (w[5] - w[3]) - (w[4] - w[3]) * (w[2] - w[0]);
                assert!(holds(found, truth, 2 * grid - normal_row.format.fraction + 2), "{w:?} {found:?} {p:?}");
                assert!(-normal_row.bound <= found.lo && found.hi <= normal_row.bound);
            });
        }
    }
    assert_eq!(lemmas, HashSet::from(["edge-extent", "triangle-area"]));
}
