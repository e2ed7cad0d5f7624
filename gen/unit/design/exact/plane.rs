//! Pairs in one plane, or on two lines (section 5 of docs/exact.md).

use super::super::determinants::coordinates::by_number;
use super::super::determinants::{Points, shared, table, traced, word};
use super::super::guard::any;
use super::{Factors, Sign, components, factors_of, not_0, sign};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top, Vec3};
use efsat_hardware::record;

record! {
    /// What is known of a pair in one plane.
    Plane "plane" {
        /// It has no common point.
        apart: S,
        /// If it has one, the relative interiors meet.
        crosses: S,
        /// The normals of both triangles have one direction.
        agree: S,
    }
}

record! {
    /// What the boxes say of a pair.
    Boxes "boxes" {
        /// Apart along some coordinate.
        apart: S,
        /// Along some coordinate the ends of A and B have at most one number in common.
        nearly_apart: S,
        /// Along every coordinate, 0 is in the range of B.
        with_0: S,
        /// Along some coordinate, V1 and V2 are on different sides of V0.
        sides_a: S,
        /// Along some coordinate, B has corners on both sides of V0.
        sides_b: S,
    }
}

/// The rule of section 5; what it says has no meaning for other pairs.
pub(super) fn plane<'l>(u: Top<'l>, points: &Points<'l>, moments: &[Vec3<Sig<'l>>; 4]) -> Plane<Sig<'l>> {
    let along = [0, 1, 2].map(|j| points.along(j));
    let boxes = shared(u, "box", &along, |k, [v1, v2, w0, w1, w2]| {
        box_along([v1, v2].named_at("box_v", k), [w0, w1, w2].named_at("box_w", k)).named_at("box_lane", k)
    });
    let some = |of: fn(&Boxes<Sig<'l>>) -> Sig<'l>| any(&[of(&boxes[0]), of(&boxes[1]), of(&boxes[2])]);
    let boxes = Boxes {
        apart: some(|x| x.apart),
        nearly_apart: some(|x| x.nearly_apart),
        with_0: boxes[0].with_0 & boxes[1].with_0 & boxes[2].with_0,
        sides_a: some(|x| x.sides_a),
        sides_b: some(|x| x.sides_b),
    };
    let boxes = boxes.named("boxes");
    let left_out = left_out(moments).named("left_out");
    let lines = left_out.equals(left_out.like(3)).named("lines");
    let [m0, m1, m2, n] = moments.map(|m| by_number(Some(left_out), |c| m[c as usize % 3], 3)).named("moment_c");
    let factors = factors(points, left_out, lines);
    let x = traced(components(u, "cross_in_plane", &factors), "component_c");
    let x = [[x[0], x[1], x[2]], [x[3], x[4], x[5]]];
    let no_u = (!any(&x[0].map(not_0))).named("no_u");
    let (by_edge, [area_a, area_b]) = sums([m0, m1, m2], n, x);
    let by_edge = by_edge.named("by_edge");
    let areas = [[area_a; 3], [area_b; 3]].concat();
    let (parts, nearly): (Vec<_>, Vec<_>) = by_edge.into_iter().zip(areas).map(|(x, area)| edge(x, area)).unzip();
    decided(lines, no_u, parts.named("parts"), nearly.named("nearly_parts"), boxes, [area_a, area_b])
}

/// For each edge of A, then of B, the side of it on which each corner of the other triangle is; the signs of both areas.
fn sums<'l>(moment: [Sig<'l>; 3], n: Sig<'l>, x: [[Sig<'l>; 3]; 2]) -> ([[Sig<'l>; 3]; 6], [Sign<'l>; 2]) {
    let doc = [
        "Sides of edges from components c (section 5 of docs/exact.md), and the signs of the areas n and m_0 + m_1 + m_2:",
        "  W_l by the edges of A: x_1l, n + x_2l - x_1l, -x_2l",
        "  V_k by edge l of B: m_l, m_l + x_1l - x_1(l+1), m_l + x_2l - x_2(l+1)",
    ];
    let (sides, area) = entity!("plane_sums", &doc, (moment, n, x) => {
        let next = |l: usize| (l + 1) % 3;
        let of_a = |l: usize| [x[0][l], n + (x[1][l] - x[0][l]), -x[1][l]];
        let of_b = |l: usize| {
            [moment[l], moment[l] + (x[0][l] - x[0][next(l)]), moment[l] + (x[1][l] - x[1][next(l)])]
        };
        // Sums of three.
        let wide = |x: Sig<'l>| x.bits(n.ty().bits + 2);
        let sides: [[Sig<'l>; 3]; 6] =
            std::array::from_fn(|k| if k < 3 { [0, 1, 2].map(|l| wide(of_a(l)[k])) } else { of_b(k - 3).map(wide) });
        let areas = [wide(n), wide((moment[0] + moment[1]) + moment[2])].named("area");
        (sides.named("sides"), areas.map(sign).named("area_sign"))
    });
    (sides, area.named("area"))
}

/// The coordinate that is left out, or 3 if all is on two lines.
fn left_out<'l>(moments: &[Vec3<Sig<'l>>; 4]) -> Sig<'l> {
    let doc = ["The first coordinate in which some moment is not 0, which is left out; 3 if there is none."];
    let moments = *moments;
    entity!("left_out_coordinate", &doc, (moments) => {
        let seen = [0, 1, 2].map(|j| any(&moments.map(|m| not_0(m[j])))).named("seen");
        let entry = |word: u32| i128::from(word.trailing_zeros().min(3));
        table(word(&seen, "all_seen"), (0..8).map(entry).collect()).named("left_out")
    })
}

/// The first of three points that is not V0, which is 0; the last if there is none.
fn first_seen<'l>([x, y, z]: [Vec3<Sig<'l>>; 3]) -> Vec3<Sig<'l>> {
    let doc = ["The first of three points that is not 0, or the last of them."];
    entity!("first_point", &doc, (x, y, z) => {
        let seen = |x: Vec3<Sig<'l>>| any(&x.signals().into_iter().map(not_0).collect::<Vec<_>>());
        seen(x).choose(x, seen(y).choose(y, z)).named("first")
    })
}

/// The factors of component c of v_i x w_l; in the case of lines in place of the first three those of v x w.
fn factors<'l>(points: &Points<'l>, left_out: Sig<'l>, lines: Sig<'l>) -> Vec<Factors<'l>> {
    let Points { v, w } = *points;
    let doc = ["The coordinates of a point in the plane without coordinate c: those after it, in turn."];
    let projected = |x: Vec3<Sig<'l>>| {
        entity!("plane_coordinates", &doc, (x, left_out) => {
            [1, 2].map(|next| by_number(Some(left_out), |c| x[c as usize + next], 3)).named("projected")
        })
    };
    let (v_in_plane, w_in_plane) = (v.map(projected).named("v_in_plane"), w.map(projected).named("w_in_plane"));
    let [first_v, first_w] = [[v[0], v[1], v[1]], w].map(first_seen).named("first");
    let factors = |t: usize| {
        let ([vj, vk], [wj, wk]) = (v_in_plane[t / 3], w_in_plane[t % 3]);
        let in_plane = ([vj, wk], [vk, wj]);
        if t < 3 { lines.choose(factors_of(first_v, first_w, t), in_plane) } else { in_plane }
    };
    (0..6).map(factors).collect()
}

/// What the boxes say along one coordinate.
fn box_along<'l>(v: [Sig<'l>; 2], w: [Sig<'l>; 3]) -> Boxes<Sig<'l>> {
    let doc = [
        "The ranges of A and B along a coordinate; V_0 is 0. apart: one is wholly below the other. nearly_apart: they have at",
        "most one end in common, and are not one number both. with_0: 0 is in that of B. sides_a, sides_b: v_1 and v_2, or",
        "some of w_l, are on different sides of 0.",
    ];
    entity!("box_axis", &doc, (v, w) => {
        let (above, below) = (|x: Sig<'l>| !x.negative() & not_0(x), Sig::negative);
        let (v_above, v_below) = (v.map(above).named("v_above"), v.map(below).named("v_below"));
        let (w_above, w_below) = (w.map(above).named("w_above"), w.map(below).named("w_below"));
        let v_w = v.map(|v| w.map(|w| v.less(w))).named("v_below_w");
        let w_v = v.map(|v| w.map(|w| w.less(v))).named("w_below_v");
        // All comparisons of a corner of A with one of B.
        let a_below = [w_above.to_vec(), v_w.concat()].concat();
        let b_below = [w_below.to_vec(), w_v.concat()].concat();
        let [some_a, some_b] = [&a_below, &b_below].map(|flags| any(flags));
        let all = |flags: Vec<Sig<'l>>| flags.into_iter().reduce(|a, b| a & b).expect("triangles have corners");
        let apart = all(a_below) | all(b_below);
        let with_0 = !(all(w_above.to_vec()) | all(w_below.to_vec()));
        Boxes {
            apart: apart.named("apart"),
            nearly_apart: (some_a & !some_b | some_b & !some_a).named("nearly_apart"),
            with_0: with_0.named("with_0"),
            sides_a: (v_above[0] & v_below[1] | v_above[1] & v_below[0]).named("sides_a"),
            sides_b: (any(&w_above) & any(&w_below)).named("sides_b"),
        }
    })
}

/// Whether an edge parts a pair in a plane, and whether it nearly does.
fn edge<'l>(x: [Sig<'l>; 3], area: Sign<'l>) -> (Sig<'l>, Sig<'l>) {
    let doc = [
        "An edge of a triangle, the sides of it on which the other's corners are, and the sign of its own triangle's area.",
        "It parts the pair if all corners are on the outer side; nearly, if some are on its line, but not everything is.",
    ];
    entity!("plane_edge", &doc, (x, area) => {
        let [above, below] = [x.map(|x| !x.negative() & not_0(x)).named("above"), x.map(Sig::negative).named("below")];
        let all = |flags: [Sig<'l>; 3]| flags[0] & flags[1] & flags[2];
        let [positive, negative] = area;
        let parts = all(below) & !negative | all(above) & !positive;
        let (some_above, some_below) = (any(&above).named("some_above"), any(&below).named("some_below"));
        let outside = !some_above & !negative & (some_below | positive);
        let inside = !some_below & !positive & (some_above | negative);
        (parts.named("parts"), (outside | inside).named("nearly"))
    })
}

/// The rule itself.
fn decided<'l>(
    lines: Sig<'l>,
    no_u: Sig<'l>,
    parts: Vec<Sig<'l>>,
    nearly: Vec<Sig<'l>>,
    boxes: Boxes<Sig<'l>>,
    areas: [Sign<'l>; 2],
) -> Plane<Sig<'l>> {
    let doc = [
        "Pairs in one plane (section 5 of docs/exact.md). In a plane: separate if an edge parts the pair or the boxes are apart. On",
        "one line (u = 0): if the boxes are apart. On two lines: if B does not have V_0, where they meet. Of triangles in a plane the",
        "normals agree if the areas have one sign.",
    ];
    entity!("plane_verdict", &doc, (lines, no_u, parts, nearly, boxes, areas) => {
        let in_plane = !lines & any(&parts);
        let on_lines = lines & !no_u & !boxes.with_0;
        let two_lines = (lines & !no_u).named("two_lines");
        let through = two_lines & boxes.sides_a & boxes.sides_b;
        let near = boxes.nearly_apart | !lines & any(&nearly);
        let apart = boxes.apart | in_plane | on_lines;
        let [a, b] = areas;
        Plane {
            apart: apart.named("apart"),
            crosses: (through | !two_lines & !near).named("crosses"),
            agree: (a[0] & b[0] | a[1] & b[1]).named("agree"),
        }
    })
}
