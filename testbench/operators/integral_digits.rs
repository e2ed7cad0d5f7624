//! The least integral digits of every row of the formats.

use super::edge::{extents, roundings, way};
use super::{UPPERS, inputs, vector};
use efsat::design::cross_product::cross_product;
use efsat::design::interval::{Factors, Interval};
use efsat::design::projection::projection;
use efsat::graph::{Library, Sig, Signals, Top};
use efsat::op::Type;
use efsat::params::{Axes, AxisKind, FormatRow, Formats, Params, Transform};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The rows an axis is made of, left and right factor.
fn factors(f: &Formats, kind: AxisKind) -> [&FormatRow; 2] {
    match kind {
        AxisKind::NormalA => [&f.edge_a[0], &f.edge_a[2]],
        AxisKind::NormalB => [&f.edge_b, &f.edge_b],
        AxisKind::Cross(k) => [&f.edge_a[k], &f.edge_b],
        AxisKind::InPlaneA(k) => [f.axis(AxisKind::NormalA), &f.edge_a[k]],
        AxisKind::InPlaneB => [f.axis(AxisKind::NormalB), &f.edge_b],
    }
}

/// A factor of a product.
fn factor<'l>(top: Top<'l>, name: &str, fraction: i32, bound: i128, p: &Params) -> Factors<'l> {
    vector(top, name, Type::signed(p.width, fraction), bound).map(Interval::factor).named(name)
}

/// Whether a unit can be made; if not, the reason must be what a rounding makes.
fn possible(body: impl for<'l> FnOnce(Top<'l>) -> Vec<Sig<'l>>) -> bool {
    let made = catch_unwind(AssertUnwindSafe(|| {
        Library::default().block("row", &[], 1, |top| body(top).named("result"));
    }));
    let Err(why) = made else { return true };
    let why = why.downcast::<String>().expect("a message");
    assert!([", resized(", ", sum(floor("].iter().any(|made| why.contains(made)), "{why}");
    assert!(why.contains(" do not fit "), "{why}");
    false
}

/// The least-k rule: a unit with the row's format can be made, and the same unit with one integral digit fewer cannot,
/// whatever lemma helps it.
#[test]
fn every_row_has_the_least_integral_digits() {
    let mut rows = 0;
    for width in [6, 9, 18, 25] {
        let (on, translate, off) = (Transform::On, Transform::Translate, Transform::Off);
        for (transform, renormalise) in [(on, true), (off, true), (on, false), (translate, false), (off, false)] {
            for upper in UPPERS {
                let transform_width = width.max(12);
                let axes = Axes::Seventeen;
                let p = Params { width, transform_width, axes, transform, renormalise, upper, ..Params::paper() };
                let f = p.formats();
                let mut check = |row: &FormatRow, unit: &dyn Fn(i32) -> bool| {
                    assert!(unit(0), "{} does not fit: {p:?}", row.name);
                    assert!(!unit(1), "{} is loose: {p:?}", row.name);
                    rows += 1;
                };
                let grid = f.coordinate_a.format.fraction;
                let one = 1i128 << grid;
                let [extent_a, extent_b] = extents(&p, &f);
                let edges = [
                    (&f.edge_a[0], f.coordinate_a.bound, extent_a, renormalise),
                    (&f.edge_a[1], f.coordinate_a.bound, extent_a, false),
                    (&f.edge_a[2], f.coordinate_a.bound, extent_a, renormalise),
                    (&f.edge_b, f.coordinate_b.bound, extent_b, false),
                ];
                for (row, coordinate, extent, anchored) in edges {
                    check(row, &|fewer| {
                        let truth = (fewer > 0 && !anchored).then_some((extent, grid, "edge-extent"));
                        let to = roundings(&p, way(grid, row, fewer, truth), row.format.fraction + fewer);
                        possible(|top| {
                            let [x, y] = inputs(top, "x", Type::signed(width, grid), coordinate);
                            let exact = (x - y).named("exact");
                            let exact = if anchored { exact.assume(one + 1, "anchored-edge") } else { exact };
                            exact.round_outward(&to).signals()
                        })
                    });
                }
                let mut kinds = vec![AxisKind::NormalA, AxisKind::NormalB, AxisKind::InPlaneB];
                kinds.extend((0..3).flat_map(|k| [AxisKind::Cross(k), AxisKind::InPlaneA(k)]));
                for kind in kinds {
                    let (row, [left, right]) = (f.axis(kind), factors(&f, kind));
                    let area = match kind {
                        AxisKind::NormalA => Some(extent_a * extent_a),
                        AxisKind::NormalB => Some(extent_b * extent_b),
                        _ => None,
                    };
                    check(row, &|fewer| {
                        let truth = area.filter(|_| fewer > 0).map(|area| (area, 2 * grid, "triangle-area"));
                        let exact = left.format.fraction + right.format.fraction;
                        let to = roundings(&p, way(exact, row, fewer, truth), row.format.fraction + fewer);
                        possible(|top| {
                            let e = factor(top, "e", left.format.fraction, left.bound, &p);
                            let f = factor(top, "f", right.format.fraction, right.bound, &p);
                            cross_product(e, f, Some(&to), &[]).signals()
                        })
                    });
                    let (point, axis) = (f.coordinate_a.bound.max(f.coordinate_b.bound), row);
                    let projected = f.projection(kind);
                    check(projected, &|fewer| {
                        let exact = way(grid + axis.format.fraction, projected, fewer, None);
                        let to = roundings(&p, exact, projected.format.fraction + fewer);
                        possible(|top| {
                            let v = factor(top, "v", grid, point, &p);
                            let l = factor(top, "l", axis.format.fraction, axis.bound, &p);
                            projection(&p, v, l, &to, &[]).signals()
                        })
                    });
                }
                if renormalise {
                    // 1 is representable, and would not be with one integral digit.
                    let format = f.coordinate_a.format;
                    assert!(one <= format.max() && 2 * one > format.max());
                }
            }
        }
    }
    assert_eq!(rows, 4 * 5 * 2 * (4 + 18));
}
