//! Maps as a picture.

use super::grid::SIZE;
use super::map::{Answer, Map};

/// Pixels of a cell, each way.
const SCALE: usize = 2;
/// Pixels between two maps.
const GAP: usize = 16;

/// Colours that are told apart with any kind of colour vision (after Okabe and Ito), the paper last.
const PALETTE: [[u8; 3]; 5] = [[86, 180, 233], [240, 228, 66], [0, 0, 0], [213, 94, 0], [255, 255, 255]];
const PAPER: u8 = 4;

fn colour(answer: Answer) -> u8 {
    match answer {
        Answer::Separate => 0,
        Answer::PossiblyIncorrect => 1,
        Answer::Touch => 2,
        Answer::Intersect => 3,
    }
}

/// A PNG of maps side by side: separate is blue, possibly-incorrect yellow, touch black, intersect orange.
///
/// Equal maps yield equal bytes.
pub fn png(maps: &[&Map]) -> Vec<u8> {
    let width = maps.len() * (SIZE * SCALE + GAP) - GAP;
    let height = SIZE * SCALE;
    let pixel = |x: usize, y: usize| {
        let (map, x) = (x / (SIZE * SCALE + GAP), x % (SIZE * SCALE + GAP));
        if x < SIZE * SCALE {
            colour(maps[map].at(y / SCALE, x / SCALE))
        } else {
            PAPER
        }
    };
    // Two pixels a byte.
    let packed = |y: usize| (0..width / 2).map(move |x| pixel(2 * x, y) << 4 | pixel(2 * x + 1, y));
    let data: Vec<u8> = (0..height).flat_map(packed).collect();

    let mut file = vec![];
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Four);
    encoder.set_palette(PALETTE.as_flattened());
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header().expect("the header is well-formed");
    writer.write_image_data(&data).expect("the data fit the header");
    writer.finish().expect("a vector takes all bytes");
    file
}
