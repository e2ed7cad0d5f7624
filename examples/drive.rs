//! The unit behind its AXI4-Stream wrapper, driven from a host.
//!
//! `cargo run --release --example drive`. In place of hardware a stand-in answers, word by word as the wrapper does; a real
//! host sends the bytes of `Driver::bytes` through its DMA or UART, and reads words back with `Driver::packet`.

use efsat::exact::Exact;
use efsat::host::driver::{Driver, StandIn};
use efsat::params::Params;
use efsat::words::StreamWidth;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let (answers, sent) = drive()?;
    println!("{sent} bytes sent; exact answers {answers:?}");
    Ok(())
}

/// Sends two meshes, a pose and three pairs of triangles; the exact answers, and how many bytes were sent.
pub fn drive() -> Result<(Vec<Exact>, usize), Box<dyn Error>> {
    let (params, width) = (Params::default(), StreamWidth::Bits64);
    let driver = Driver::new(&params, width)?;
    let mut unit = StandIn::new(&params, width)?;

    // A face; and a mesh of three triangles, which stands on its head after half a turn about the x axis.
    let a = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let b = [[1.0, -1.0, 0.5], [2.0, -1.0, -1.0], [1.0, -2.0, -1.0], [1.0, -1.0, 0.0], [1.0, -1.0, -0.5]];
    let half_turn = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    let pairs = [([0, 1, 2], [0, 1, 2]), ([0, 1, 2], [3, 1, 2]), ([0, 1, 2], [4, 1, 2])];

    let meshes = driver.meshes(&a, &b)?;
    let job = meshes.pose(&half_turn, &[0.0; 3], &pairs)?;
    let sent = driver.bytes(job.transfers()).len();
    let received = unit.answer(job.transfers());
    let results = job.finish(&received)?;
    // Pairs that the unit calls possibly incorrect were decided by `finish`, exactly.
    Ok((results.answers, sent))
}
