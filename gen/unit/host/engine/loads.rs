//! Load packets: images in the block RAM of an engine.

use super::image::{Image, LINE};
use crate::golden::engine::Side;
use crate::params::engine::{Command, EngineFormat};

/// Address of the memory of triangles in block RAM, in units of 64 bytes; that of blocks is at 0.
pub const TRIANGLES_AT: u32 = 1 << 25;

/// The packets that fill block RAM with images, each part behind that of the image before, and where the images are then. Each
/// packet is answered by a report.
pub fn loads(images: &[&Image], format: &EngineFormat) -> (Vec<Vec<u64>>, Vec<Side>) {
    let (mut packets, mut sides) = (vec![], vec![]);
    let (mut block, mut triangle) = (0, TRIANGLES_AT);
    for image in images {
        let header = image.header();
        sides.push(Side { blocks_at: block, triangles_at: triangle, ..image.side(0) });
        let parts = [
            (&mut block, u64::from(header.blocks_at()), header.blocks, header.format.block().stride),
            (&mut triangle, header.triangles_at(), header.triangles, header.format.triangle().stride),
        ];
        for (to, from, count, stride) in parts {
            let bytes = u64::from(count) * u64::from(stride);
            let words = &image.words()[from as usize / 8..][..bytes as usize / 8];
            if !words.is_empty() {
                let head = [format.header(Command::Load), u64::from(*to) * u64::from(LINE)];
                packets.push(head.iter().chain(words).copied().collect());
            }
            *to += bytes.div_ceil(LINE.into()) as u32;
        }
    }
    (packets, sides)
}
