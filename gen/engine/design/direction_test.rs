//! One direction: whether it has a child of B beyond a child of A.

use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};

/// `B + U + V < 0` for each child of A, from a sum of so many bits.
pub fn direction_test<'l>(bits: u32, bound: Sig<'l>, u: Sig<'l>, v: [Sig<'l>; 2]) -> [Sig<'l>; 2] {
    let doc = [
        "A direction h of A: all points of B's child are below B + U, those of A's child above -V. apart(p) is set where",
        "B + U + V < 0 for child p of A.",
    ];
    entity!("direction_test", &doc, (bound, u, v) => {
        let reach = (bound + u).bits(bits).named("reach");
        v.map(|v| (reach + v).bits(bits).negative()).named("apart")
    })
}
