//! Codes on the common grid: a barrel shifter for the exponent of a block.

use super::fitted;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};

/// `floor(x 2^e / 2^drop)`, as a number of `fraction` bits.
pub fn align<'l>(name: &str, x: Sig<'l>, exponent: Sig<'l>, drop: i32, fraction: i32) -> Sig<'l> {
    let doc = [format!(
        "x 2^e{}: a barrel shifter, bit i of the exponent shifts by 2^i.",
        match drop {
            0 => String::new(),
            drop => format!(" / 2^{drop}, rounded down"),
        }
    )];
    entity!(&format!("align_{name}"), &doc.each_ref().map(String::as_str), (x, exponent) => {
        let stages = exponent.ty().bits;
        let (mut x, mut dropped) = (x.at_point(None), 0);
        for i in 0..stages {
            let step = 1 << i;
            let bit = if i == 0 { exponent.low(1) } else { exponent.floor(i as i32).low(1) };
            x = fitted(bit.choose(x.floor(-step), x)).named(&format!("shifted_{i}"));
            // Bits that no later stage brings up again.
            let lost = drop - ((1 << stages) - 2 * step) - dropped;
            if lost > 0 {
                x = x.floor(lost);
                dropped += lost;
            }
        }
        fitted(x).at_point(Some(fraction)).named("aligned")
    })
}
