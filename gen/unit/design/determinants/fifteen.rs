//! The second level of products, and the fifteen determinants whose signs decide a pair (section 4 of
//! docs/determinants.md).

use super::super::product::product;
use super::{Points, traced};
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_hardware::op::Type;

/// Something for each of the fifteen determinants.
pub(in super::super) struct Fifteen<T> {
    /// Of W_l against the plane of A.
    pub plane_a: [T; 3],
    /// Of V_k against the plane of B.
    pub plane_b: [T; 3],
    /// Of edge l of B against edge k of A, `[k][l]`.
    pub side: [[T; 3]; 3],
}

impl<T: Copy> Fifteen<T> {
    /// All fifteen in a row.
    pub fn all(&self) -> Vec<T> {
        [[self.plane_a, self.plane_b].concat(), self.side.concat()].concat()
    }

    /// From all fifteen in a row.
    pub fn of(all: &[T]) -> Self {
        let three = |i: usize| [all[i], all[i + 1], all[i + 2]];
        Self { plane_a: three(0), plane_b: three(3), side: [three(6), three(9), three(12)] }
    }
}

impl<'l> Fifteen<Sig<'l>> {
    /// Names all and brings them out of a probed design; what stands for several has the first one's name.
    pub fn traced(self, stage: &str) -> Self {
        let all = self.all();
        for (i, x) in all.iter().enumerate() {
            if !all[..i].contains(x) {
                traced(*x, &format!("{stage}_{}", NAMES[i]));
            }
        }
        self
    }
}

/// Numbers as signed ones of as many bits as the widest takes.
pub(in super::super) fn alike<'l>(all: Vec<Sig<'l>>, name: &str) -> Vec<Sig<'l>> {
    let bits = all.iter().map(|x| x.ty().bits + u32::from(!x.ty().signed)).max().unwrap_or(1);
    let ty = Type { signed: true, bits, fraction: None };
    all.into_iter().map(|x| x.resize(ty)).collect::<Vec<_>>().named(name)
}

/// The names of the fifteen, in a row.
const NAMES: [&str; 15] = [
    "plane_a0", "plane_a1", "plane_a2", "plane_b0", "plane_b1", "plane_b2", "side00", "side01", "side02", "side10",
    "side11", "side12", "side20", "side21", "side22",
];

/// The determinants from the moments of the edges of B and the normal of A, by what makes the ten dot products.
pub(in super::super) fn determinants<'l>(
    points: &Points<'l>,
    [m0, m1, m2, n]: &[Vec3<Sig<'l>>; 4],
    dot_products: impl FnOnce(&[(Vec3<Sig<'l>>, Vec3<Sig<'l>>)]) -> Vec<Sig<'l>>,
) -> Fifteen<Sig<'l>> {
    let Points { v: [v1, v2], w: [w0, w1, w2] } = *points;
    // So that with two clocks per pair both dot products of a unit have a factor in common.
    let jobs = [(w0, n), (v1, m0), (v1, m1), (v1, m2), (w1, n), (w0, m1), (v2, m0), (v2, m1), (v2, m2), (w2, n)];
    let dots = dot_products(&jobs.map(|(x, m)| (x, *m)));
    let a = [0, 1, 2].map(|l| dots[[0, 4, 9][l]]);
    let d = [0, 1].map(|i| [0, 1, 2].map(|l| dots[[1, 6][i] + l]));
    let v = dots[5];
    d[0].named("dot_d1");
    sums(a, d, v).traced("determinant")
}

/// x . m, exact.
pub(super) fn dot_product<'l>(x: Vec3<Sig<'l>>, m: Vec3<Sig<'l>>) -> Sig<'l> {
    let doc = ["The dot product x . m, exact. Three multipliers at up to 18 bits."];
    entity!("dot_product", &doc, (x, m) => {
        let products = x.zip(m, product).named("product");
        (products[0] + products[1] + products[2]).named("dot")
    })
}

/// The determinants that are not dot products themselves.
fn sums<'l>(a: [Sig<'l>; 3], d: [[Sig<'l>; 3]; 2], v: Sig<'l>) -> Fifteen<Sig<'l>> {
    let doc = [
        "Determinants from dot products (section 4 of docs/determinants.md):",
        "  plane_b(i) = v - (d_i0 + d_i1 + d_i2)",
        "  side_0(l) = -d_1l, side_1(l) = d_1l - d_2l + a_l - a_(l+1)",
    ];
    let (plane_b, [side_0, side_1]) = entity!("determinant_sums", &doc, (a, d, v) => {
        let [d1, d2] = d;
        let sum = |d: [Sig<'l>; 3]| d[0] + d[1] + d[2];
        let plane_b = [v - sum(d1), v - sum(d2)].named("plane_b");
        let side_1 = |l: usize| (d1[l] - d2[l]) + (a[l] - a[(l + 1) % 3]);
        let sides = [[0, 1, 2].map(|l| -d1[l]), [0, 1, 2].map(side_1)];
        (plane_b, sides.named("side"))
    });
    Fifteen { plane_a: a, plane_b: [v, plane_b[0], plane_b[1]], side: [side_0, side_1, d[1]] }
}
