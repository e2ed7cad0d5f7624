//! Where the origin of B's block is from the origin of A's: one component.

use super::fitted;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_unit::parts::product;

/// `d = floor(m . o_b) + t - o_a`, the product rounded down to the fraction bits of t.
pub fn origin_row<'l>(m: Vec3<Sig<'l>>, t: Sig<'l>, o_b: Vec3<Sig<'l>>, o_a: Sig<'l>) -> Sig<'l> {
    let doc = [
        "One component of D, where the origin of B's block is from the origin of A's, in A's frame:",
        "  d = floor(m . o_b) + t - o_a",
        "m is a row of the matrix, the products are exact, and their sum is rounded down to the common grid.",
    ];
    let grid = t.fraction();
    entity!("origin_row", &doc, (m, t, o_b, o_a) => {
        let products = m.zip(o_b, product).named("product");
        let sum = ((products[0] + products[1]) + products[2]).named("sum");
        let from_a = (t - o_a.floor(o_a.fraction() - grid)).named("from_a").comment("t - o_a");
        fitted(sum.floor(sum.fraction() - grid) + from_a).named("d")
    })
}
