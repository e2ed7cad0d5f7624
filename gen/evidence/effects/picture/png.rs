//! The picture as PNG.

use super::font::{GLYPH, glyph};
use super::view::buffer;
use super::{HEIGHT, Picture, WIDTH};

/// Pixels of a dot of the font.
const DOT: usize = 2;
/// From line to line of the legend.
const LINE: usize = 20;

impl Picture {
    /// The picture as PNG. Equal pictures are equal bytes.
    pub fn png(&self) -> Vec<u8> {
        let mut canvas = vec![[255u8; 3]; WIDTH * HEIGHT];
        for items in [&self.seen, &self.marked] {
            for (pixel, number) in buffer(items).into_iter().enumerate() {
                if let Some(number) = number {
                    canvas[pixel] = items[number].colour;
                }
            }
        }
        for (row, (colour, text)) in self.legend.lines.iter().enumerate() {
            let top = 10 + LINE * row;
            let mut left = 20;
            if let Some(colour) = colour {
                fill(&mut canvas, left, top, 20, 14, [0; 3]);
                fill(&mut canvas, left + 1, top + 1, 18, 12, *colour);
                left += 28;
            }
            for character in text.chars() {
                write(&mut canvas, left, top, character);
                left += DOT * (GLYPH.0 + 1);
            }
        }
        encoded(&canvas)
    }
}

fn fill(canvas: &mut [[u8; 3]], left: usize, top: usize, width: usize, height: usize, colour: [u8; 3]) {
    for y in top..(top + height).min(HEIGHT) {
        for x in left..(left + width).min(WIDTH) {
            canvas[y * WIDTH + x] = colour;
        }
    }
}

fn write(canvas: &mut [[u8; 3]], left: usize, top: usize, character: char) {
    for (y, row) in glyph(character).into_iter().enumerate() {
        for x in (0..GLYPH.0).filter(|x| row >> (GLYPH.0 - 1 - x) & 1 == 1) {
            fill(canvas, left + DOT * x, top + DOT * y, DOT, DOT, [0; 3]);
        }
    }
}

fn encoded(canvas: &[[u8; 3]]) -> Vec<u8> {
    let mut file = vec![];
    let mut encoder = ::png::Encoder::new(&mut file, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(::png::Compression::High);
    let mut writer = encoder.write_header().expect("the header is well-formed");
    writer.write_image_data(canvas.as_flattened()).expect("the data fit the header");
    writer.finish().expect("a vector takes all bytes");
    file
}
