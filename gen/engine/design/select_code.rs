//! The code that a term of a row reads.

use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};

/// `b[j]`: one of the codes of a slot, by the bits of the choice. A choice that is none of the slot's reads some code.
pub fn select_code<'l>(codes: &[Sig<'l>], choice: Sig<'l>) -> Sig<'l> {
    let doc = [
        "b[j]: the code that a term of a row reads, one of those of its slot: a tree of choices between two, bit i of the",
        "choice in stage i.",
    ];
    let name = format!("select_code_{}", codes.len());
    let codes = codes.to_vec();
    entity!(&name, &doc, (codes, choice) => {
        let (mut open, mut stage) = (codes, 0);
        while open.len() > 1 {
            let bit = if stage == 0 { choice.low(1) } else { choice.floor(stage).low(1) };
            let name = format!("chosen_{stage}");
            let chosen = open.chunks(2).enumerate().map(|(i, two)| match two {
                [clear, set] => bit.choose(*set, *clear).named_at(&name, i),
                _ => two[0],
            });
            open = chosen.collect();
            stage += 1;
        }
        open[0].named("code")
    })
}
