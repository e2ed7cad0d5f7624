//! The least integral digits of every row of the formats.

use super::UPPERS;
use super::edge::{extents, way};
use efsat::design::interval::Narrowing;
use efsat::design::{cross_product, interval, multiply, projection};
use efsat::graph::range::analyse;
use efsat::graph::{Type, Unit};
use efsat::params::{Axes, AxisKind, Formats, Params, Row, Transform};
use std::rc::Rc;

/// The rows an axis is made of, left and right factor.
fn factors(f: &Formats, kind: AxisKind) -> [&Row; 2] {
    match kind {
        AxisKind::NormalA => [&f.edge_a[0], &f.edge_a[2]],
        AxisKind::NormalB => [&f.edge_b, &f.edge_b],
        AxisKind::Cross(k) => [&f.edge_a[k], &f.edge_b],
        AxisKind::InPlaneA(k) => [f.axis(AxisKind::NormalA), &f.edge_a[k]],
        AxisKind::InPlaneB => [f.axis(AxisKind::NormalB), &f.edge_b],
    }
}

/// The least-k rule: range analysis proves the unit with the row's format, and rejects the same unit with one integral
/// digit fewer, whatever lemma helps it.
#[test]
fn every_row_has_the_least_integral_digits() {
    let mut rows = 0;
    for width in [6, 9, 18, 25] {
        for (transform, renormalise) in [
            (Transform::On, true),
            (Transform::Off, true),
            (Transform::On, false),
            (Transform::Translate, false),
            (Transform::Off, false),
        ] {
            for upper in UPPERS {
                let transform_width = width.max(12);
                let axes = Axes::Seventeen;
                let p = Params { width, transform_width, axes, transform, renormalise, upper, ..Params::default() };
                let f = p.formats();
                let mut check = |row: &Row, unit: &dyn Fn(i32) -> Rc<Unit>| {
                    analyse(&unit(0)).unwrap_or_else(|e| panic!("{}: {e} {p:?}", row.name));
                    let fewer = analyse(&unit(1)).err().unwrap_or_else(|| panic!("{} is loose: {p:?}", row.name));
                    assert!(fewer.path.contains("rounded"), "{fewer}");
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
                        let ty = Type::signed(width, grid);
                        let range = (-coordinate, coordinate);
                        let truth = (fewer > 0 && !anchored).then_some((extent, grid, "edge-extent"));
                        let narrowing = Narrowing {
                            bound: anchored.then_some((one + 1, "anchored-edge")),
                            rounding: way(grid, row, fewer, truth),
                            bits: width,
                            upper,
                        };
                        interval::subtract_unit("edge", (ty, range), (ty, range), Some(narrowing))
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
                        let roundings = &[way(exact, row, fewer, truth)];
                        let (left, right) = (left.bound, right.bound);
                        cross_product::unit(&cross_product::Spec {
                            bits: width,
                            left,
                            right,
                            roundings,
                            upper,
                            notes: &[],
                            sign_case: &multiply::sign_case_unit(Type::signed(width, 0), left.max(right)),
                        })
                    });
                    let (point, axis) = (f.coordinate_a.bound.max(f.coordinate_b.bound), row.bound);
                    let projected = f.projection(kind);
                    check(projected, &|fewer| {
                        let roundings = &[way(grid + row.format.fraction, projected, fewer, None)];
                        projection::unit(&projection::Spec { bits: width, point, axis, roundings, upper, notes: &[] })
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
