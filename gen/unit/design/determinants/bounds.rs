//! How far each of the fifteen determinants can be from the truth, in eighths of 2^s (section 5 of docs/determinants.md).

use super::coordinates::{Coordinates, Level, by_number};
use super::fifteen::{self, Fifteen};
use super::moments::{Moments, Shift};
use super::{Points, constant, shared};
use crate::params::{Bound, Params};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;

/// Bounds on the norms of the normals of faces, in units of 2^s, behind F.
struct Faces<'l> {
    /// M_l, of m_l.
    m: [Sig<'l>; 3],
    /// Q, of n_A.
    n: Sig<'l>,
    /// X_il, of V_i x W_l.
    vertex: [[Sig<'l>; 3]; 2],
    /// Y_il, of V_i x e_Bl.
    edge_b: [[Sig<'l>; 3]; 2],
    /// Z_l, of e_A1 x W_l.
    edge_a: [Sig<'l>; 3],
}

/// L1 norms of vertices and edges.
struct Lengths<'l> {
    /// |V_i|.
    v: [Sig<'l>; 2],
    /// |e_A1|.
    a: Sig<'l>,
    /// |W_l|.
    w: [Sig<'l>; 3],
    /// |e_Bl|.
    b: [Sig<'l>; 3],
}

/// The bounds of all determinants, as they are compared.
pub(super) fn bounds<'l>(u: Top<'l>, p: &Params, coordinates: &Coordinates<'l>, moments: &Moments<'l>) -> Vec<Sig<'l>> {
    let (level, shift) = (coordinates.level, moments.shift);
    let norms = (p.bound != Bound::Static).then(|| {
        let doc = ["Section 5: edges, norms of vertices and edges, and what the bounds have beside F."];
        u.section("pair_norms", &doc, || norms(u, p, coordinates, shift))
    });
    let doc = ["Section 5: bounds on the errors of the fifteen determinants."];
    u.section("pair_bounds", &doc, || {
        let bounds = match norms {
            None => fixed(u, p, level, shift),
            Some((edges, lengths, tails)) => sums(&faces(u, p, &edges, &lengths, moments, level), &tails),
        };
        // Whole units.
        let whole = bounds.traced("bound").all().iter().map(|e| e.floor(3)).collect();
        fifteen::alike(whole, "compared_bound")
    })
}

/// Edges, L1 norms, and what the bounds have beside F.
fn norms<'l>(
    u: Top<'l>,
    p: &Params,
    coordinates: &Coordinates<'l>,
    shift: Shift<'l>,
) -> (Edges<'l>, Lengths<'l>, Tails<'l>) {
    let (points, level) = (coordinates.points, coordinates.level);
    let Points { v, w } = points;
    let e_a1 = (v[1] - v[0]).named("e_a1");
    let e_b = [0, 1, 2].map(|l| w[(l + 1) % 3] - w[l]).named("e_b");
    let wide = |x: Vec3<Sig<'l>>| x.map(|x| x.bits(p.width + 1));
    let vectors = [v[0], v[1], e_a1, w[0], w[1], w[2], e_b[0], e_b[1], e_b[2]].map(wide);
    let all = shared(u, "norm", &vectors, |k, x| norm("vector_norm", x.named_at("norm_x", k)).named_at("norm_lane", k));
    let lengths = Lengths { v: [all[0], all[1]], a: all[2], w: [all[3], all[4], all[5]], b: [all[6], all[7], all[8]] };
    let rest = by_level_times_2_h(u, level, shift, "rest", |level| c(3, level)).named("rest");
    let rest = rest.comment("c(3); four times that is c(5)");
    let tails = tails(&lengths, rest);
    (Edges { points, e_a1, e_b }, lengths, tails)
}

/// A number for each level, times 2^h.
fn by_level_times_2_h<'l>(
    u: Top<'l>,
    level: Level<'l>,
    shift: Shift<'l>,
    name: &str,
    entry: impl Fn(u32) -> i128,
) -> Sig<'l> {
    if level.signal.is_none() {
        return by_number(shift.places, |places| constant(u, entry(0) << shift.h(places)), shift.span);
    }
    let of_level = by_number(level.signal, |level| constant(u, entry(level)), level.most);
    shift.times_g(of_level.named(&format!("{name}_of_level")).floor(-1))
}

/// c(k) without its factor of 2^h.
fn c(k: u32, level: u32) -> i128 {
    8 << (k + 2 * level.saturating_sub(2))
}

/// The bounds from level and shift alone.
fn fixed<'l>(u: Top<'l>, p: &Params, level: Level<'l>, shift: Shift<'l>) -> Fifteen<Sig<'l>> {
    let r = 1 << (p.width - 1);
    // F(faces q) + edges R + c(k), where q is R 2^h / 4.
    let of = |name: &str, faces: i128, edges: i128, k: u32| {
        let first = |level: u32| faces * (r >> 2) * (4 + (1 << level));
        by_level_times_2_h(u, level, shift, name, |level| first(level) + c(k, level)) + constant(u, edges * r)
    };
    let (three, four) = (of("bound_of_3", 12, 12, 3), of("bound_of_4", 48, 48, 5));
    Fifteen { plane_a: [three; 3], plane_b: [three, four, four], side: [[three; 3], [four; 3], [three; 3]] }
}

/// |x|, the sum of the magnitudes of the components.
fn norm<'l>(name: &str, x: Vec3<Sig<'l>>) -> Sig<'l> {
    let doc = ["The L1 norm of a vector: the sum of the magnitudes of its components."];
    entity!(name, &doc, (x) => {
        let magnitudes = x.map(Sig::magnitude).named("magnitude");
        (magnitudes[0] + magnitudes[1] + magnitudes[2]).named("norm")
    })
}

/// What the bounds have beside F: rounding of the moments, and errors of second and third order.
struct Tails<'l> {
    plane_a: [Sig<'l>; 3],
    plane_b: [Sig<'l>; 2],
    end: [Sig<'l>; 2],
    middle: [Sig<'l>; 3],
}

fn tails<'l>(lengths: &Lengths<'l>, rest: Sig<'l>) -> Tails<'l> {
    let doc = [
        "What the bounds have beside F (section 5 of docs/determinants.md), with c = c(3) and c(5) = 4 c:",
        "  plane_a(l) = 4 w_l + c, also of V_0 against the plane of B",
        "  plane_b(i) = 4 w_0 + 12 A_i + 4 c",
        "  ends(i) = 4 A_i + c, of the sides of the edges at V_0",
        "  middle(l) = 4 (A_e + b_l) + 4 c, of the sides of the edge between V_1 and V_2",
    ];
    let Lengths { v, a, w, b } = *lengths;
    let (plane_a, (plane_b, (end, middle))) = entity!("bound_tails", &doc, (v, a, w, b, rest) => {
        let times_4 = |x: Sig<'l>| x.floor(-2);
        let plane_a = w.map(|w| times_4(w) + rest).named("plane_a");
        let plane_b = v.map(|v| times_4((w[0] + (v + v.floor(-1))) + rest)).named("plane_b");
        let end = v.map(|v| times_4(v) + rest).named("ends");
        let a_and_rest = (a + rest).named("a_and_rest");
        (plane_a, (plane_b, (end, b.map(|b| times_4(b + a_and_rest)).named("middle"))))
    });
    Tails { plane_a, plane_b, end, middle }
}

/// Coordinates and edges.
struct Edges<'l> {
    points: Points<'l>,
    e_a1: Vec3<Sig<'l>>,
    e_b: [Vec3<Sig<'l>>; 3],
}

/// The table of section 5, behind F.
fn faces<'l>(
    u: Top<'l>,
    p: &Params,
    edges: &Edges<'l>,
    lengths: &Lengths<'l>,
    moments: &Moments<'l>,
    level: Level<'l>,
) -> Faces<'l> {
    let shift = moments.shift;
    let Lengths { v, a, w, b } = *lengths;
    let wide = |x: Sig<'l>| x.resize(Type::unsigned(p.width + 3));
    // F of norms, or of norms times g.
    let first = |norms: &[Sig<'l>], times_g: bool, name: &str| {
        let norms = norms.iter().map(|x| wide(*x)).collect::<Vec<_>>().named(&format!("{name}_measure"));
        shared(u, &format!("{name}_bound"), &norms, |k, x| {
            let x = x.named_at(&format!("{name}_x"), k);
            let x = if times_g { shift.times_g(x).named_at(&format!("{name}_times_g"), k) } else { x };
            first_order(&format!("{name}_first_order"), level, x).named_at(&format!("{name}_first"), k)
        })
    };
    let three = |x: &[Sig<'l>]| [x[0], x[1], x[2]];
    let of_moments = || {
        let vectors = [moments.m[0], moments.m[1], moments.m[2], moments.n];
        let norms = shared(u, "norm_of_moment", &vectors, |k, x| {
            norm("moment_norm", x.named_at("moment_norm_x", k)).named_at("moment_norm_lane", k)
        });
        first(&norms, false, "moment")
    };
    if p.bound == Bound::Products {
        let of_moments = of_moments();
        let of_faces = products(u, p, edges, shift, level);
        return Faces {
            m: three(&of_moments),
            n: of_moments[3],
            vertex: [three(&of_faces[..3]), three(&of_faces[3..])],
            edge_b: [three(&of_faces[6..]), three(&of_faces[9..])],
            edge_a: three(&of_faces[12..]),
        };
    }
    let lengths = first(&[v[0], v[1], w[0], w[1], w[2], b[0], b[1], b[2], a], true, "length");
    let (v, w, b, a) = ([lengths[0], lengths[1]], three(&lengths[2..]), three(&lengths[5..]), lengths[8]);
    let (m, n) = match p.bound {
        Bound::Edges => (b, a),
        _ => {
            let of_moments = of_moments();
            (three(&of_moments), of_moments[3])
        }
    };
    let lesser = |x: Sig<'l>, y: Sig<'l>| (x - y).negative().choose(x, y);
    let vertex = v.map(|v| w.map(|w| lesser(v, w))).named("face_of_vertex");
    Faces { m, n, vertex, edge_b: [b; 2], edge_a: [a; 3] }
}

/// F(x): eight times the error of a coordinate, times x.
fn first_order<'l>(name: &str, level: Level<'l>, x: Sig<'l>) -> Sig<'l> {
    let doc = ["F(x) = 4 x + 2^level x: what errors of coordinates are multiplied by, in eighths."];
    let by = level.signal;
    entity!(name, &doc, (x, by) => {
        let level = Level { signal: by, ..level };
        (x.floor(-2) + level.shifted(x).named("shifted")).named("first_order")
    })
}

/// F of the bounds of faces by the leading bits of coordinates: of V_i x W_l, of V_i x e_Bl, then of e_A1 x W_l.
fn products<'l>(u: Top<'l>, p: &Params, edges: &Edges<'l>, shift: Shift<'l>, level: Level<'l>) -> Vec<Sig<'l>> {
    let Edges { points: Points { v, w }, e_a1, e_b } = *edges;
    let magnitudes = |x: Vec3<Sig<'l>>| x.map(Sig::magnitude);
    let x = [v[0], v[1], e_a1].map(|x| magnitudes(x).map(|x| leading(p, x).resize(Type::unsigned(7))));
    let others = |y: Vec3<Sig<'l>>| {
        let y = magnitudes(y);
        Vec3::each(|j| leading(p, y[j + 1] + y[j + 2]).resize(Type::unsigned(8)))
    };
    let (x, w, b) = (x.named("leading_x"), w.map(others).named("leading_w"), e_b.map(others).named("leading_b"));
    let faces = [(x[0], w), (x[1], w), (x[0], b), (x[1], b), (x[2], w)];
    let jobs: Vec<_> = faces.iter().flat_map(|(x, y)| y.map(|y| (*x, y))).collect();
    shared(u, "face_bound", &jobs, |k, (x, y)| {
        let sum = short_products(x.named_at("face_x", k), y.named_at("face_y", k)).named_at("face_sum", k);
        // Times 2^(2N-12-s).
        let scaled = |places: u32| match p.width as i32 + p.span as i32 - 12 - places as i32 {
            power @ 0.. => sum.floor(-power),
            power => sum.floor(-power) + constant(u, 1),
        };
        let scaled = by_number(shift.places, scaled, shift.span).named_at("face", k);
        first_order("face_first_order", level, scaled.resize(Type::unsigned(p.width + 6))).named_at("face_first", k)
    })
}

/// The leading bits of a magnitude: z / 2^(N-6), rounded up.
fn leading<'l>(p: &Params, z: Sig<'l>) -> Sig<'l> {
    match p.width - 6 {
        0 => z,
        dropped => (z + constant(z.block(), (1 << dropped) - 1)).floor(dropped as i32),
    }
}

/// x . y of short unsigned vectors, in look-up tables.
fn short_products<'l>(x: Vec3<Sig<'l>>, y: Vec3<Sig<'l>>) -> Sig<'l> {
    let doc = ["The dot product x . y of short unsigned numbers, in look-up tables: a row for each bit of x."];
    entity!("short_products", &doc, (x, y) => {
        let product = |x: Sig<'l>, y: Sig<'l>| {
            let row = |bit: u32| {
                let above = x.floor(bit as i32);
                let set = if above.ty().is_flag() { above } else { above.low(1) };
                set.choose(y, y.like(0)).floor(-(bit as i32))
            };
            (0..x.ty().bits).map(row).reduce(|a, b| a + b).expect("a number has bits")
        };
        let products = x.zip(y, product).named("product");
        (products[0] + products[1] + products[2]).named("sum")
    })
}

/// The bounds from norms behind F and tails.
fn sums<'l>(faces: &Faces<'l>, tails: &Tails<'l>) -> Fifteen<Sig<'l>> {
    let Faces { m, n, vertex, edge_b, edge_a } = *faces;
    let twice = |x: Sig<'l>| x.floor(-1);
    // Of two norms that are one there is one signal.
    let both = |x: Sig<'l>, y: Sig<'l>| if x == y { twice(x) } else { x + y };
    let next = |l: usize| (l + 1) % 3;
    let all_m = (m[0] + m[1] + m[2]).named("bound_all_m");
    let plane_a = [0, 1, 2].map(|l| (n + tails.plane_a[l]) + (vertex[0][l] + vertex[1][l]));
    let corner = |i: usize| {
        let [x, y, z] = edge_b[i];
        twice(all_m) + if edge_b[i] == m { all_m } else { x + y + z }
    };
    // The bounds of edges of B are the same for both vertices where they have one bound for both.
    let corners = if edge_b[0] == edge_b[1] { [corner(0).named("bound_corner"); 2] } else { [corner(0), corner(1)] };
    let plane_b = [all_m + tails.plane_a[0], corners[0] + tails.plane_b[0], corners[1] + tails.plane_b[1]];
    let end = |i: usize, l: usize| (m[l] + tails.end[i]) + (vertex[i][l] + vertex[i][next(l)]);
    let of_b = |l: usize| twice(m[l]) + both(edge_b[0][l], edge_b[1][l]);
    let of_a = |l: usize| twice(n) + both(edge_a[l], edge_a[next(l)]);
    let all_of_a = if edge_a[0] == edge_a[1] { [of_a(0).named("bound_of_a"); 3] } else { [0, 1, 2].map(of_a) };
    let middle = |l: usize| (of_b(l) + all_of_a[l]) + tails.middle[l];
    let side = [[0, 1, 2].map(|l| end(0, l)), [0, 1, 2].map(middle), [0, 1, 2].map(|l| end(1, l))];
    Fifteen { plane_a, plane_b, side }
}
