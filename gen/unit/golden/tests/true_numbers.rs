//! Every signal of the model against exact arithmetic: it contains the real number that it stands for, and stays within its format.

// Loops over components read like the equations.
#![allow(clippy::needless_range_loop)]

use super::super::Golden;
use super::{parameter_sets, query};
use crate::pair::{Input, Pair, Pose};
use crate::params::{Axes, AxisKind, Params, Projections, Transform};
use efsat_hardware::number::{Format, Interval};
use efsat_hardware::testing::full;
use num_bigint::BigInt;
use num_rational::Ratio;
use num_traits::{One, Zero};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use std::collections::HashMap;

type Real = Ratio<BigInt>;

fn power_of_two(exponent: i32) -> Real {
    let power = Real::from_integer(BigInt::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

fn at(mantissa: i128, fraction: i32) -> Real {
    Real::from_integer(mantissa.into()) * power_of_two(-fraction)
}

fn cross(a: &[Real; 3], b: &[Real; 3]) -> [Real; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| &a[j] * &b[k] - &a[k] * &b[j])
}

fn minus(a: &[Real; 3], b: &[Real; 3]) -> [Real; 3] {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

/// Whether a number lies in an interval whose upper bound stands for so many units more.
fn encloses(x: &Interval<i128>, format: Format, beyond: i128, real: &Real) -> bool {
    at(x.lo, format.fraction) <= *real && *real <= at(x.hi + beyond, format.fraction)
}

/// An upper bound of a projection that is rounded down stands for all up to the next number.
fn open(p: &Params) -> i128 {
    i128::from(p.projection_upper().is_none())
}

/// The edges of two triangles.
fn edges(a: &[[Real; 3]; 3], b: &[[Real; 3]; 3]) -> [[[Real; 3]; 3]; 2] {
    [a, b].map(|x| [0, 1, 2].map(|k| minus(&x[(k + 1) % 3], &x[k])))
}

/// The axes of two triangles with their names.
fn true_axes(p: &Params, a: &[[Real; 3]; 3], b: &[[Real; 3]; 3]) -> Vec<(String, AxisKind, [Real; 3])> {
    let edges = edges(a, b);
    let normals = [a, b].map(|x| cross(&minus(&x[1], &x[0]), &minus(&x[2], &x[0])));
    let mut axes = vec![
        ("n_a".to_owned(), AxisKind::NormalA, normals[0].clone()),
        ("n_b".to_owned(), AxisKind::NormalB, normals[1].clone()),
    ];
    for k in 0..3 {
        for l in 0..3 {
            axes.push((format!("c_{k}{l}"), AxisKind::Cross(k), cross(&edges[0][k], &edges[1][l])));
        }
    }
    if p.axes == Axes::Seventeen {
        for k in 0..3 {
            axes.push((format!("n_a_a{k}"), AxisKind::InPlaneA(k), cross(&normals[0], &edges[0][k])));
        }
        for l in 0..3 {
            axes.push((format!("n_b_b{l}"), AxisKind::InPlaneB, cross(&normals[1], &edges[1][l])));
        }
    }
    axes
}

/// The signals of a query in exact arithmetic by name, for one real number out of each input's enclosure, with format
/// and bound of each.
fn true_signals(
    p: &Params,
    pose: &Pose,
    pair: &Pair,
    trace: &HashMap<String, Interval<i128>>,
) -> Vec<(String, Real, Format, i128)> {
    let f = p.formats();
    let input = p.input().fraction;
    // An input off the grid stands for a number between two grid points: take one third.
    let real = |x: Input| {
        (Real::from_integer(x.lo.into()) + if x.sticky { Real::new(1.into(), 3.into()) } else { Real::zero() })
            * power_of_two(-input)
    };
    let a = pair.a.map(|v| v.map(real));
    let b = pair.b.map(|v| v.map(real));
    let b = match p.transform {
        Transform::Off => b,
        _ if pose.bypass => b,
        Transform::Translate => b.map(|v| [0, 1, 2].map(|i| &v[i] + real(pose.t[i]))),
        Transform::On => {
            b.map(|v| [0, 1, 2].map(|i| (0..3).fold(real(pose.t[i]), |sum, j| sum + real(pose.m[i][j]) * &v[j])))
        }
    };
    let names = ["x", "y", "z"];
    let mut signals = Vec::new();
    let mut vector = |name: String, x: &[Real; 3], format: Format, bound: i128| {
        for i in 0..3 {
            signals.push((format!("{name}_{}", names[i]), x[i].clone(), format, bound));
        }
    };
    for l in 0..3 {
        vector(format!("transform.w{l}"), &b[l], p.input(), f.transformed_bound());
    }
    // Section 4, with its powers of two read off the model's own bounds of the transformed points.
    let normal = |x: &[Real; 3]| {
        [0, 1, 2].map(|i| {
            if !p.renormalise {
                return x[i].clone();
            }
            let origin = i128::from(pair.a[0][i].lo);
            let bounds = |x: Input| x.interval(p.upper);
            let from_a = (0..3).flat_map(|k| [bounds(pair.a[k][i]).lo, bounds(pair.a[k][i]).hi]).map(i128::from);
            let from_b = (0..3).map(|l| trace[&format!("transform.w{l}_{}", names[i])]).flat_map(|x| [x.lo, x.hi]);
            let reach = from_a.chain(from_b).map(|x| (x - origin).abs()).max().unwrap();
            let length = (128 - reach.leading_zeros()) as i32;
            (&x[i] - at(origin, input)) * power_of_two(input - length)
        })
    };
    let (a, b) = (a.map(|v| normal(&v)), b.map(|v| normal(&v)));
    for k in 0..3 {
        vector(format!("renormalise.v{k}"), &a[k], f.coordinate_a.format, f.coordinate_a.bound);
        vector(format!("renormalise.w{k}"), &b[k], f.coordinate_b.format, f.coordinate_b.bound);
    }
    let edges = edges(&a, &b);
    for k in 0..3 {
        vector(format!("edge.a{k}"), &edges[0][k], f.edge_a[k].format, f.edge_a[k].bound);
        vector(format!("edge.b{k}"), &edges[1][k], f.edge_b.format, f.edge_b.bound);
    }
    for (name, kind, direction) in true_axes(p, &a, &b) {
        let (row, projection) = (f.axis(kind), f.projection(kind));
        // Section 5: an axis and all that is projected on it carry one power of two, in-plane axes that of the normal too.
        let dots = |triangle: &[[Real; 3]; 3], direction: &[Real; 3]| {
            triangle.clone().map(|x| (0..3).fold(Real::zero(), |sum, i| sum + &x[i] * &direction[i]))
        };
        let fits = |left: &u32| {
            let direction = direction.clone().map(|x| x * power_of_two(*left as i32));
            let on_axis =
                (0..3).all(|i| encloses(&trace[&format!("axis.{name}_{}", names[i])], row.format, 0, &direction[i]));
            on_axis
                && [(&a, "v"), (&b, "w")].iter().all(|(triangle, vertex)| {
                    dots(triangle, &direction).iter().enumerate().all(|(k, dot)| {
                        let found = trace.get(&format!("projection.{name}.{vertex}{k}"));
                        found.is_none_or(|x| encloses(x, projection.format, open(p), dot))
                    })
                })
        };
        let left = (0..=2 * p.axis_positions()).find(fits).unwrap_or(0);
        let direction = direction.clone().map(|x| x * power_of_two(left as i32));
        let mut vector = |name: String, x: &[Real; 3], format: Format, bound: i128| {
            for i in 0..3 {
                signals.push((format!("{name}_{}", names[i]), x[i].clone(), format, bound));
            }
        };
        vector(format!("axis.{name}"), &direction, row.format, row.bound);
        for (triangle, vertex, side) in [(&a, "v", "a"), (&b, "w", "b")] {
            let dots = dots(triangle, &direction);
            for (k, dot) in dots.iter().enumerate() {
                signals.push((
                    format!("projection.{name}.{vertex}{k}"),
                    dot.clone(),
                    projection.format,
                    projection.bound,
                ));
            }
            let (min, max) = (dots.iter().min().unwrap().clone(), dots.iter().max().unwrap().clone());
            signals.push((format!("enclosure.{name}.{side}_min"), min, projection.format, projection.bound));
            signals.push((format!("enclosure.{name}.{side}_max"), max, projection.format, projection.bound));
        }
    }
    signals
}

/// Every traced interval contains the true number and stays within its row of the format table.
#[test]
fn every_signal_contains_the_true_number_and_fits_its_format() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for p in parameter_sets() {
        let golden = Golden::new(&p);
        for _ in 0..if full() { 6 } else { 2 } {
            let (pose, pair) = query(&mut rng, &p);
            let trace: HashMap<String, Interval<i128>> = golden.trace(&pose, &pair).into_iter().collect();
            let mut known = 0;
            for (name, real, format, bound) in true_signals(&p, &pose, &pair, &trace) {
                let Some(x) = trace.get(&name) else {
                    assert!(p.projections == Projections::Skip && name.starts_with("projection"), "{name}");
                    continue;
                };
                known += 1;
                assert!(x.lo <= x.hi && -bound <= x.lo && x.hi <= bound, "{name} {x:?} {bound} {p:?}");
                let beyond = if name.starts_with("projection") || name.starts_with("enclosure") { open(&p) } else { 0 };
                assert!(encloses(x, format, beyond, &real), "{name} {x:?} {real} {p:?}");
            }
            assert_eq!(known, trace.len());
            let projections = trace.keys().filter(|name| name.starts_with("projection.c_")).count()
                + trace
                    .keys()
                    .filter(|name| name.starts_with("projection.n_a.") || name.starts_with("projection.n_b."))
                    .count();
            assert_eq!(projections, if p.projections == Projections::Skip { 44 } else { 66 });
        }
    }
}
