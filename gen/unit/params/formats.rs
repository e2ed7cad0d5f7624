//! The table of number formats of the axis test: one row per signal, each with its bound and the derivation.
//!
//! The golden model reads this table; the dataflow graph takes its formats from it too, and its static range analysis
//! must prove, without looking at the derivations, that every row is wide enough.
//!
//! Rule of the contract (section 5): for a range `[-b, b]` after outward rounding, the integral digits k are the
//! least with `b <= 2^(k-1) - ulp`; the fraction bits are then `m = N - k`.

use super::{Params, ProjectionWidth, Transform};
use efsat_hardware::number::{Format, Upper, upper_shift};

/// A bound on the *true* (real) value that the computed interval may stick out of by rounding; clamping the computed
/// bounds to it is sound because the true value lies inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clamp {
    /// Mantissas are clamped to `[-bound, bound]`, in the format of the row.
    pub bound: i128,
    /// Name of the lemma that proves the bound (docs/proofs).
    pub lemma: &'static str,
}

/// One row of the table: a signal of the axis test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatRow {
    /// Name of the signal.
    pub name: &'static str,
    /// Its format, N bits wide.
    pub format: Format,
    /// Greatest magnitude of a bound after rounding (and clamping), as a mantissa of `format`.
    pub bound: i128,
    /// Applied after rounding, if any.
    pub clamp: Option<Clamp>,
    /// Why the bound holds.
    pub derivation: String,
}

/// The kinds of axes that have a format of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AxisKind {
    /// n_A, the normal of A.
    NormalA,
    /// n_B, the normal of B.
    NormalB,
    /// C_kl = e_Ak x e_Bl, by the edge k of A.
    Cross(usize),
    /// n_A x e_Ak.
    InPlaneA(usize),
    /// n_B x e_Bl.
    InPlaneB,
}

/// The whole table for one parameter set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formats {
    /// Coordinates of A after section 4.
    pub coordinate_a: FormatRow,
    /// Coordinates of B after section 4, same format as `coordinate_a`.
    pub coordinate_b: FormatRow,
    /// Edges e_A0, e_A1, e_A2.
    pub edge_a: [FormatRow; 3],
    /// Edges e_B0, e_B1, e_B2 (one format).
    pub edge_b: FormatRow,
    normal_a: [FormatRow; 2],
    normal_b: [FormatRow; 2],
    cross: [[FormatRow; 2]; 3],
    in_plane_a: [[FormatRow; 2]; 3],
    in_plane_b: [FormatRow; 2],
    transformed_bound: i128,
}

/// A quantity `[-bound, bound]` with `fraction` fraction bits, before it is brought to N bits.
struct Exact {
    bound: i128,
    fraction: i32,
}

/// A bound on the true value, as `bound * 2^-fraction`, with its lemma.
struct Truth {
    bound: i128,
    fraction: i32,
    lemma: &'static str,
}

/// Brings `exact` to `width` bits by the least-k rule, clamping to `truth` where only that makes it fit.
fn row(
    name: &'static str,
    width: u32,
    upper: Upper,
    exact: &Exact,
    truth: Option<&Truth>,
    derivation: impl Into<String>,
) -> FormatRow {
    let derivation = derivation.into();
    (1..)
        .find_map(|integral| {
            let format = Format::signed(width, integral);
            let computed = upper_shift(exact.bound, exact.fraction - format.fraction, upper);
            let clamp = match truth {
                Some(t) if computed > format.max() => Some(Clamp {
                    bound: upper_shift(t.bound, t.fraction - format.fraction, Upper::Sticky),
                    lemma: t.lemma,
                }),
                _ => None,
            };
            let bound = clamp.map_or(computed, |c| c.bound);
            (bound <= format.max()).then(|| FormatRow { name, format, bound, clamp, derivation: derivation.clone() })
        })
        .expect("some format is wide enough")
}

/// Greatest width of a projection: what the numbers of the reference model hold.
const WIDEST: u32 = 63;

/// The topmost bits of `exact`, at most so many.
fn truncated(name: &'static str, bits: u32, exact: &Exact, derivation: String) -> FormatRow {
    let least = 129 - exact.bound.leading_zeros();
    let drop = least.saturating_sub(bits) as i32;
    let format = Format { bits: least.min(bits), fraction: exact.fraction - drop };
    FormatRow { name, format, bound: upper_shift(exact.bound, drop, Upper::Sticky), clamp: None, derivation }
}

const NAMES_CROSS: [[&str; 2]; 3] =
    [["axis_c_0", "projection_c_0"], ["axis_c_1", "projection_c_1"], ["axis_c_2", "projection_c_2"]];
const NAMES_IN_PLANE_A: [[&str; 2]; 3] = [
    ["axis_in_plane_a_0", "projection_in_plane_a_0"],
    ["axis_in_plane_a_1", "projection_in_plane_a_1"],
    ["axis_in_plane_a_2", "projection_in_plane_a_2"],
];

impl Formats {
    pub(super) fn new(p: &Params) -> Self {
        let (n, upper) = (p.width, p.upper);
        let make =
            |name, exact: Exact, truth: Option<Truth>, why: String| row(name, n, upper, &exact, truth.as_ref(), why);
        let transformed = transformed_bound(p);
        let [coordinate_a, coordinate_b] = coordinates(p, transformed);
        let grid = coordinate_a.format.fraction;

        // True extents of the triangles' boxes along one coordinate axis, in ulps of the coordinate format.
        let one = 1i128 << grid;
        let natural_b = 2 * coordinate_b.bound;
        let extent_a = if p.renormalise || p.transform != Transform::Off { 2 * one } else { 2 * coordinate_a.bound };
        let extent_b = match (p.renormalise, p.transform) {
            (true, _) | (false, Transform::Translate) => 2 * one,
            (false, Transform::On) => (6 * one).min(natural_b),
            (false, Transform::Off) => natural_b,
        };
        let edge = |name, bound: i128, extent: i128, why: &str| {
            let truth = Truth { bound: extent, fraction: grid, lemma: "edge-extent" };
            make(name, Exact { bound, fraction: grid }, Some(truth), why.to_owned())
        };
        let free = |name, bound: i128| edge(name, 2 * bound, extent_a, "difference of two coordinates of A");
        let anchored = |name| {
            if p.renormalise {
                make(
                    name,
                    Exact { bound: one + 1, fraction: grid },
                    None,
                    "V0 is the origin but for its width: lemma anchored-edge, |e| <= 1 + ulp".to_owned(),
                )
            } else {
                free(name, coordinate_a.bound)
            }
        };
        let edge_a = [anchored("edge_a_0"), free("edge_a_1", coordinate_a.bound), anchored("edge_a_2")];
        let edge_b = edge("edge_b", natural_b, extent_b, "difference of two coordinates of B");

        let cross_of = |a: &FormatRow, b: &FormatRow| Exact {
            bound: 2 * a.bound * b.bound,
            fraction: a.format.fraction + b.format.fraction,
        };
        // What a shifted axis stands for depends on its shift: all of its components are brought to N bits alike.
        let axis = |name, exact: Exact, truth: Option<Truth>, why: String| match p.axis_shift {
            0 => make(name, exact, truth, why),
            _ => {
                let format = Format::signed(n, 2 * n as i32 - exact.fraction);
                let derivation = format!("{why}, shifted left by up to {} places", p.axis_positions());
                FormatRow { name, format, bound: format.max(), clamp: None, derivation }
            }
        };
        let area = |extent: i128| Truth { bound: extent * extent, fraction: 2 * grid, lemma: "triangle-area" };
        let reach = coordinate_a.bound.max(coordinate_b.bound);
        let with_projection = |axis: FormatRow, name: &'static str| {
            let exact = Exact { bound: 3 * reach * axis.bound, fraction: grid + axis.format.fraction };
            let why = "three products of a coordinate and an axis component".to_owned();
            let projection = match p.projection_width {
                ProjectionWidth::Rounded => make(name, exact, None, why),
                // Rounded down, a bound is no farther from zero than its ceiling.
                ProjectionWidth::Plus(bits) => truncated(name, n + bits, &exact, why),
                ProjectionWidth::Full => truncated(name, WIDEST, &exact, why),
            };
            [axis, projection]
        };
        let normal = |names: [&'static str; 2], e: &FormatRow, f: &FormatRow, truth: Option<Truth>, why: &str| {
            with_projection(axis(names[0], cross_of(e, f), truth, why.to_owned()), names[1])
        };
        let twice_area = "|component| <= twice the area of the projected triangle (lemma triangle-area)";
        let normal_a = normal(
            ["axis_n_a", "projection_n_a"],
            &edge_a[0],
            &edge_a[2],
            (!p.renormalise).then(|| area(extent_a)),
            if p.renormalise { "2 |e_A0| |e_A2|" } else { twice_area },
        );
        let normal_b = normal(["axis_n_b", "projection_n_b"], &edge_b, &edge_b, Some(area(extent_b)), twice_area);
        let cross = [0, 1, 2].map(|k| {
            let axis = axis(NAMES_CROSS[k][0], cross_of(&edge_a[k], &edge_b), None, format!("2 |e_A{k}| |e_B|"));
            with_projection(axis, NAMES_CROSS[k][1])
        });
        let in_plane_a = [0, 1, 2].map(|k| {
            let exact = cross_of(&normal_a[0], &edge_a[k]);
            let axis = axis(NAMES_IN_PLANE_A[k][0], exact, None, format!("2 |n_A| |e_A{k}|"));
            with_projection(axis, NAMES_IN_PLANE_A[k][1])
        });
        let exact = cross_of(&normal_b[0], &edge_b);
        let axis = axis("axis_in_plane_b", exact, None, "2 |n_B| |e_B|".to_owned());
        let in_plane_b = with_projection(axis, "projection_in_plane_b");
        Self {
            coordinate_a,
            coordinate_b,
            edge_a,
            edge_b,
            normal_a,
            normal_b,
            cross,
            in_plane_a,
            in_plane_b,
            transformed_bound: transformed,
        }
    }

    /// The row of an axis component.
    pub fn axis(&self, kind: AxisKind) -> &FormatRow {
        &self.pair(kind)[0]
    }

    /// The row of a projection on an axis; one format for all six points, so that they can be compared.
    pub fn projection(&self, kind: AxisKind) -> &FormatRow {
        &self.pair(kind)[1]
    }

    fn pair(&self, kind: AxisKind) -> &[FormatRow; 2] {
        match kind {
            AxisKind::NormalA => &self.normal_a,
            AxisKind::NormalB => &self.normal_b,
            AxisKind::Cross(k) => &self.cross[k],
            AxisKind::InPlaneA(k) => &self.in_plane_a[k],
            AxisKind::InPlaneB => &self.in_plane_b,
        }
    }

    /// Greatest magnitude of a bound of B after the transform, as a mantissa of the input format.
    pub fn transformed_bound(&self) -> i128 {
        self.transformed_bound
    }

    /// Every row, in the order of the data flow; the in-plane rows last.
    pub fn rows(&self) -> impl Iterator<Item = &FormatRow> {
        let points = [&self.coordinate_a, &self.coordinate_b].into_iter();
        let edges = self.edge_a.iter().chain([&self.edge_b]);
        let axes = [&self.normal_a, &self.normal_b].into_iter().chain(&self.cross);
        points.chain(edges).chain(axes.chain(&self.in_plane_a).chain([&self.in_plane_b]).flatten())
    }
}

/// Greatest magnitude of a bound of an input number whose true magnitude is at most `bound`: the implied upper bound
/// is one ulp above the lower one.
fn input_bound(p: &Params, bound: i128) -> i128 {
    match p.upper {
        Upper::Implied => bound + 1,
        Upper::Sticky => bound,
    }
}

/// Section 3: |B| <= 3 |M| |B~| + |t|, rounded; with the bypass B = B~, which is less.
fn transformed_bound(p: &Params) -> i128 {
    let coordinate = input_bound(p, p.coordinate_bound());
    let translation = input_bound(p, p.translation_bound());
    match p.transform {
        Transform::Off => coordinate,
        Transform::Translate => coordinate + translation,
        Transform::On => {
            let entry = input_bound(p, p.one());
            upper_shift(3 * entry * coordinate + translation * p.one(), p.input().fraction, p.upper)
        }
    }
}

/// Section 4: the coordinates of A and of B in their common format.
fn coordinates(p: &Params, transformed: i128) -> [FormatRow; 2] {
    let names = ["coordinate_a", "coordinate_b"];
    if p.renormalise {
        let format = Format::signed(p.width, 2);
        return names.map(|name| FormatRow {
            name,
            format,
            bound: 1 << (p.width - 2),
            clamp: None,
            derivation: "x / 2^L with |x| < 2^L, rounded outward to a grid that holds 1".to_owned(),
        });
    }
    let format = Format::signed(p.width, p.int_bits as i32);
    let drop = p.transform_width as i32 - p.width as i32;
    let inputs = [input_bound(p, p.coordinate_bound()), transformed];
    let derivations = ["the declared input range, rounded", "the transform's range, rounded"];
    [0, 1].map(|i| FormatRow {
        name: names[i],
        format,
        bound: upper_shift(inputs[i], drop, p.upper),
        clamp: None,
        derivation: derivations[i].to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Axes;

    #[test]
    fn the_papers_table() {
        let table: Vec<String> = Params::paper()
            .formats()
            .rows()
            .map(|r| format!("{} {}{}", r.name, r.format, if r.clamp.is_some() { " clamped" } else { "" }))
            .collect();
        let expected = [
            "coordinate_a s2.16",
            "coordinate_b s2.16",
            "edge_a_0 s2.16",
            "edge_a_1 s3.15",
            "edge_a_2 s2.16",
            "edge_b s3.15",
            "axis_n_a s3.15",
            "projection_n_a s4.14",
            "axis_n_b s4.14 clamped",
            "projection_n_b s5.13",
            "axis_c_0 s4.14",
            "projection_c_0 s5.13",
            "axis_c_1 s5.13",
            "projection_c_1 s6.12",
            "axis_c_2 s4.14",
            "projection_c_2 s5.13",
        ];
        assert_eq!(table[..16], expected);
    }

    #[test]
    fn every_row_holds_its_bound() {
        for width in 6..=32 {
            for int_bits in 4..=8.min(width - 2) {
                for transform_width in [width, width + 1, 40, 48].map(|t| t.max(width)) {
                    for transform in [Transform::On, Transform::Translate, Transform::Off] {
                        for renormalise in [true, false] {
                            for upper in [Upper::Implied, Upper::Sticky] {
                                let axes = Axes::Seventeen;
                                let p = Params {
                                    width,
                                    int_bits,
                                    transform_width,
                                    transform,
                                    renormalise,
                                    upper,
                                    axes,
                                    ..Params::default()
                                };
                                for r in p.formats().rows() {
                                    let bits = if r.name.starts_with("projection") {
                                        width..=width + 4
                                    } else {
                                        width..=width
                                    };
                                    assert!(bits.contains(&r.format.bits) && r.bound <= r.format.max(), "{p:?}: {r:?}");
                                }
                                for r in
                                    (Params { axis_shift: 0, projection_width: ProjectionWidth::Rounded, ..p.clone() })
                                        .formats()
                                        .rows()
                                {
                                    assert!(r.format.bits == width && r.bound <= r.format.max(), "{p:?}: {r:?}");
                                }
                                assert!(p.formats().transformed_bound() <= p.input().max(), "{p:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}
