//! Tests of pictures.

use super::*;
use crate::effects::Place;
use efsat_geometry::exact::Exact;
use efsat_geometry::mesh::{Findings, builtin};
use efsat_geometry::scene;
use efsat_unit::golden::Verdict;
use std::path::Path;

/// One plate on the other, with one pair of each kind.
fn picture() -> Picture {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/plates.toml");
    let scene = scene::load(&path).unwrap();
    assert_eq!(scene.objects[0].findings, Findings::of_mesh(&builtin("plate").unwrap()));
    let contact = |pair: (u32, u32), verdict, exact| {
        let place = Place { frame: 0, objects: (0, 1), pair };
        Contact { place, verdict, exact: Some(exact) }
    };
    let contacts = [
        contact((2, 2), Some(Verdict::PossiblyIncorrect), Exact::Separate),
        contact((2, 3), Some(Verdict::Intersect), Exact::Intersect),
        contact((9, 11), Some(Verdict::PossiblyIncorrect), Exact::Touch),
        contact((10, 10), None, Exact::Touch),
    ];
    Picture::new(&scene, 0, &contacts)
}

#[test]
fn triangles_have_the_most_important_colour() {
    let picture = picture();
    let count = |mark: Mark| picture.marked.iter().filter(|item| item.colour == mark.colour()).count();
    // Triangle 2 of A is in two pairs.
    assert_eq!(Mark::ALL.map(count), [2, 2, 2, 1]);
    let svg = picture.svg();
    assert_eq!(svg, self::picture().svg());
    for words in ["#d55e00", "#0072b2", "#009e73", "#f0e442", "intersect: 1 pairs", "plates, frame 0: one on the other"]
    {
        assert!(svg.contains(words), "{words}");
    }
    // The lower plate's underside is not seen, nor are the sides behind.
    assert!((8..24).contains(&picture.seen.len()), "{}", picture.seen.len());
}

#[test]
fn the_png_shows_the_marks() {
    let file = picture().png();
    assert_eq!(file, picture().png());
    let mut reader = png_reader(&file);
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width as usize, info.height as usize), (WIDTH, HEIGHT));
    let below = &pixels[3 * 190 * WIDTH..];
    let has = |colour: [u8; 3]| below.chunks_exact(3).filter(|pixel| **pixel == colour).count();
    assert!(has(Mark::Intersect.colour()) > 1000 && has([255; 3]) > 10_000, "the scene and the paper");
    // The swatch of the first mark.
    assert_eq!(pixels[3 * (37 * WIDTH + 30)..][..3], Mark::Intersect.colour());
}

fn png_reader(file: &[u8]) -> ::png::Reader<std::io::Cursor<&[u8]>> {
    ::png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap()
}

#[test]
fn the_nearest_triangle_is_seen() {
    let item = |depth: f64, colour: u8| Item {
        corners: [[10.0, 300.0, depth], [110.0, 300.0, depth], [10.0, 400.0, depth]],
        colour: [colour; 3],
    };
    let items = [item(1.0, 1), item(3.0, 3), item(2.0, 2)];
    let seen = view::seen(&items);
    assert_eq!(seen.len(), 1);
    assert_eq!(seen[0].colour, [3; 3]);
    let covered = view::buffer(&items).into_iter().flatten().count();
    assert!((4900..=5100).contains(&covered), "{covered} pixels of a half of 100 by 100");
}

#[test]
fn the_font_has_what_legends_say() {
    let unknown = font::glyph('\u{263a}');
    let texts = Mark::ALL.map(Mark::words).concat() + "frame 0123456789: one pairs, and more objects...";
    assert!(texts.chars().all(|character| font::glyph(character) != unknown));
}
