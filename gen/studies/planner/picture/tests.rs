//! Tests of pictures.

use super::*;
use crate::planner::Place;
use efsat_geometry::exact::Exact;
use efsat_geometry::mesh::{Findings, builtin};
use efsat_geometry::scene;
use efsat_unit::pair::Verdict;
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
    let count = |mark: Mark| picture.panes[0].marked.iter().filter(|item| item.colour == mark.colour()).count();
    // Triangle 2 of A is in two pairs.
    assert_eq!(Mark::ALL.map(count), [2, 2, 2, 1]);
    let svg = picture.svg();
    assert_eq!(svg, self::picture().svg());
    for words in ["#d55e00", "#0072b2", "#009e73", "#f0e442", "intersect: 1 pair<", "plates, frame 0: one on the other"]
    {
        assert!(svg.contains(words), "{words}");
    }
    // Of each plate the underside is not seen, nor are the sides behind.
    let seen: Vec<usize> = picture.panes[0].bodies.iter().map(Vec::len).collect();
    assert!(seen.len() == 2 && seen.iter().all(|seen| (4..12).contains(seen)), "{seen:?}");
    // Contacts all over the plates are large enough, and two pairs have a segment in common.
    assert!(picture.panes.len() == 1 && picture.spot.is_none());
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
    let near = |colour: [u8; 3]| move |pixel: &&[u8]| (0..3).all(|i| pixel[i].abs_diff(colour[i]) < 50);
    let has = |colour: [u8; 3]| below.chunks_exact(3).filter(near(colour)).count();
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
    let seen = view::seen(&items, &ALL);
    assert_eq!(seen.len(), 1);
    assert_eq!(seen[0].colour, [3; 3]);
    let covered = view::buffer(&items, &ALL).into_iter().flatten().count();
    assert!((4900..=5100).contains(&covered), "{covered} pixels of a half of 100 by 100");
}

#[test]
fn the_font_has_what_legends_say() {
    let unknown = font::glyph('\u{263a}');
    let texts =
        Mark::ALL.map(Mark::words).concat() + "no pair touches or is frame 0123456789: one pairs, and more objects...";
    assert!(texts.chars().all(|character| font::glyph(character) != unknown));
}

#[test]
fn small_contacts_have_an_inset() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gears.toml");
    let scene = scene::load(&path).unwrap();
    let contact = |pair| {
        let place = Place { frame: 0, objects: (0, 1), pair };
        Contact { place, verdict: Some(Verdict::Intersect), exact: Some(Exact::Intersect) }
    };
    let picture = Picture::new(&scene, 0, &[contact((2, 162)), contact((3, 162))]);
    let [main, inset] = picture.panes.as_slice() else { panic!("{} panes", picture.panes.len()) };
    let spot = picture.spot.unwrap();
    let length = |pane: &Pane| (0..2).map(|i| (pane.segments[0][0][i] - pane.segments[0][1][i]).abs()).sum::<f64>();
    let scale = INSET.0 / spot.size()[0];
    assert!(scale > 2.0 && (length(inset) / length(main) / scale - 1.0).abs() < 1e-9, "{scale}");
    let inside = |at: &[f64; 2]| (0..2).all(|i| (inset.window.low[i]..inset.window.high[i]).contains(&at[i]));
    assert!(inset.segments.iter().flatten().all(inside));
}
