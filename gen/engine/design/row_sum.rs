//! The sum of a row: what a child of B reaches in a direction of A, before the exponent of its block.

use super::fitted;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::op::Type;
use efsat_unit::parts::product;

/// `S = l0 b[j0] + l1 b[j1] + l2 b[j2] + rest`, and `ceiling` on top of it: see [`ceiling`].
pub fn row_sum<'l>(codes: [Sig<'l>; 3], factors: [Sig<'l>; 3], rest: Sig<'l>, ceiling: Sig<'l>) -> Sig<'l> {
    let doc = [
        "The sum of a row: l0 b[j0] + l1 b[j1] + l2 b[j2] + rest, exact. Added to it is what makes a ceiling of the floor",
        "that follows.",
    ];
    entity!("row_sum", &doc, (codes, factors, rest, ceiling) => {
        let signed = |factor: Sig<'l>| factor.resize(Type { signed: true, bits: factor.ty().bits + 1, fraction: None });
        let product = |j: usize| product(codes[j], signed(factors[j]));
        let products = [0, 1, 2].map(product).named("product");
        let more = (rest + ceiling).named("more");
        fitted((products[0] + products[1]) + (products[2] + more)).named("s")
    })
}

/// `2^(drop - e) - 1` of an exponent e below `drop`, else 0: with it added, the floor of `x 2^e / 2^drop` is the ceiling.
pub fn ceiling<'l>(exponent: Sig<'l>, drop: u32) -> Sig<'l> {
    let entry = |e: u32| (1i128 << drop.saturating_sub(e)) - 1;
    let entries = (0..1 << exponent.ty().bits).map(entry).collect();
    exponent.lookup(entries, Type::unsigned(drop))
}
