//! The picture as PNG.

use super::font::{GLYPH, glyph};
use super::view::{Frame, Item, buffer};
use super::{ALL, BODY, CONTACT, HEIGHT, Picture, WIDTH};

/// Pixels of a dot of the font.
const DOT: usize = 2;
/// Thickness of a segment.
const THICK: usize = 2;
/// From line to line of the legend.
const LINE: usize = 20;

impl Picture {
    /// The picture as PNG. Equal pictures are equal bytes.
    pub fn png(&self) -> Vec<u8> {
        let mut canvas = vec![[255u8; 3]; WIDTH * HEIGHT];
        for (number, pane) in self.panes.iter().enumerate() {
            if number > 0 {
                let [left, top] = pane.window.low.map(|x| x as usize);
                let [width, height] = pane.window.size().map(|x| x as usize);
                fill(&mut canvas, left, top, width, height, [255; 3]);
            }
            for body in &pane.bodies {
                blend(&mut canvas, body, &pane.window, BODY);
            }
            blend(&mut canvas, &pane.marked, &pane.window, CONTACT);
            pane.segments.iter().for_each(|ends| line(&mut canvas, &pane.window, *ends, THICK));
        }
        for Frame { low: [left, top], high: [right, bottom] } in self.outlines() {
            let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
            (0..4).for_each(|k| line(&mut canvas, &ALL, [corners[k], corners[(k + 1) % 4]], 1));
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

/// Puts what is seen of items over what is there.
fn blend(canvas: &mut [[u8; 3]], items: &[Item], window: &Frame, opacity: f64) {
    for (pixel, number) in buffer(items, window).into_iter().enumerate() {
        if let Some(number) = number {
            let (below, above) = (canvas[pixel], items[number].colour);
            let mix = |part: usize| opacity * f64::from(above[part]) + (1.0 - opacity) * f64::from(below[part]);
            canvas[pixel] = [0, 1, 2].map(|part| mix(part).round() as u8);
        }
    }
}

/// A black line, so many pixels thick, as far as it is in a window.
fn line(canvas: &mut [[u8; 3]], window: &Frame, [from, to]: [[f64; 2]; 2], thick: usize) {
    let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs()).ceil().max(1.0);
    for step in 0..=steps as usize {
        let at = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * step as f64 / steps);
        if (0..2).all(|axis| (window.low[axis]..window.high[axis]).contains(&at[axis])) {
            fill(canvas, at[0] as usize, at[1] as usize, thick, thick, [0; 3]);
        }
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
