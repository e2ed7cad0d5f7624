//! The test of two volumes, for the engine (docs/engine-volume.md): do the children of a node of one tree and those of a
//! node of another, in the frame of the first, overlap?
//!
//! One file per unit. [`origin_row`] is a component of where B's origin is from A's; [`select_code`], [`row_sum`] and
//! [`align`] make the bound of a child of B in a direction of A, [`direction_test`] holds it against a child of A;
//! [`volume_path`] says which unit works on what in which phase, and [`volume_unit`] is all of that with its handshakes.

pub mod align;
pub mod direction_test;
pub mod origin_row;
pub mod row_sum;
pub mod select_code;
pub mod volume_path;
pub mod volume_unit;

use efsat_hardware::graph::Sig;

/// A number in as few bits as its proven range takes.
fn fitted(x: Sig<'_>) -> Sig<'_> {
    let (least, most) = x.range();
    let bits = (0..127).find(|bits| -(1i128 << bits) <= least && most < 1i128 << bits).expect("numbers of 127 bits");
    x.bits(bits + 1)
}
