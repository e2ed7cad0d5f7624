//! The code that a term of a row reads.

use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::op::Select;

/// `b[j]`: one of the codes of a slot.
pub fn select_code<'l>(codes: &[Sig<'l>], choice: Sig<'l>) -> Sig<'l> {
    let doc = ["b[j]: the code that a term of a row reads, one of those of its slot."];
    let name = format!("select_code_{}", codes.len());
    let codes = codes.to_vec();
    entity!(&name, &doc, (codes, choice) => choice.apply(Select::default(), &codes).named("code"))
}
