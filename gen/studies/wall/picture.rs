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
        if x < SIZE * SCALE { colour(maps[map].at(y / SCALE, x / SCALE)) } else { PAPER }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_shows_the_maps() {
        let answers = [Answer::Separate, Answer::PossiblyIncorrect, Answer::Touch, Answer::Intersect];
        let maps =
            [Map::from_fn(|row, column| answers[(row / 3 + column) % 4]), Map::from_fn(|row, _| answers[row % 4])];
        let file = png(&[&maps[0], &maps[1]]);
        assert_eq!(png(&[&maps[0], &maps[1]]), file);

        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (1040, 512));
        let mut wrong = vec![];
        for (at, pixel) in pixels.chunks(3).enumerate() {
            let (x, y) = (at % 1040, at / 1040);
            let expected = match x {
                0..512 => PALETTE[colour(maps[0].at(y / 2, x / 2)) as usize],
                512..528 => [255; 3],
                _ => PALETTE[colour(maps[1].at(y / 2, (x - 528) / 2)) as usize],
            };
            if pixel != expected {
                wrong.push((x, y));
            }
        }
        assert_eq!((pixels.len(), wrong), (1040 * 512 * 3, vec![]));
    }
}
