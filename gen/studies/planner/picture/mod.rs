//! A frame of a scene as a picture: the bodies translucent, on top the triangles that touch or are left open, coloured by
//! verdict, and the segments in which they meet. Where these are small in the picture, an inset shows them larger.
//!
//! The view is isometric, z upwards, as if from far out on (1, 1, 1). What is seen of a body is found by an item buffer: the
//! triangle nearest to the eye for every pixel.

mod font;
mod legend;
mod png;
mod svg;
mod view;

use super::Contact;
use super::mark::Mark;
use super::segment::segment;
use efsat_geometry::scene::{Frame, Scene};
use legend::Legend;
use nalgebra::Point3;
use std::collections::{BTreeMap, HashSet};
use view::{Item, View};

/// Width of the picture in pixels.
const WIDTH: usize = 1200;
/// Its height.
const HEIGHT: usize = 900;

/// Pale colours of the objects, by turns.
const OBJECTS: [[u8; 3]; 4] = [[200, 210, 220], [226, 214, 196], [205, 220, 205], [218, 206, 222]];

/// How opaque a body is.
const BODY: f64 = 0.62;
/// How opaque a coloured triangle is.
const CONTACT: f64 = 0.8;

/// The whole picture.
const ALL: view::Frame = view::Frame { low: [0.0; 2], high: [WIDTH as f64, HEIGHT as f64] };
/// Where the objects with contacts are; the legend stands above.
const MAIN: view::Frame = view::Frame { low: [30.0, 190.0], high: [WIDTH as f64 - 30.0, HEIGHT as f64 - 30.0] };
/// The least part of the scene that an inset shows.
const LEAST: f64 = 1e-3;
/// Width and height of the inset, and how far it is from the edges.
const INSET: (f64, f64) = (350.0, 15.0);
/// Contacts are small where they take less than this part of the scene's width and height.
const SMALL: f64 = 0.3;

/// A picture.
pub struct Picture {
    /// The scene, and the inset if there is one.
    panes: Vec<Pane>,
    /// What the inset shows, in the scene.
    spot: Option<view::Frame>,
    legend: Legend,
}

/// A view of the scene.
struct Pane {
    window: view::Frame,
    /// Triangles that are seen of each body, the farthest first; bodies likewise.
    bodies: Vec<Vec<Item>>,
    /// Marked triangles, the farthest first.
    marked: Vec<Item>,
    /// Where marked triangles meet.
    segments: Vec<[[f64; 2]; 2]>,
}

/// What is drawn in any view.
struct Content {
    /// Triangles of each body with its pale colour.
    bodies: Vec<(Vec<Corners>, [u8; 3])>,
    marked: Vec<(Corners, Mark)>,
    segments: Vec<[Point3<f64>; 2]>,
}

type Corners = [Point3<f64>; 3];

impl Picture {
    /// Draws a frame with the contacts in it.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn new(scene: &Scene, frame: usize, contacts: &[Contact]) -> Self {
        let Frame { label, poses, .. } = scene.frame(frame);
        let corners = |object: usize, face: u32| -> Corners {
            scene.objects[object].mesh.triangle(face as usize).map(|v| poses[object].image(&v))
        };
        let mut marks: BTreeMap<(usize, u32), Mark> = BTreeMap::new();
        let mut segments = vec![];
        for contact in contacts {
            let ((a, b), (p, q)) = (contact.place.objects, contact.place.pair);
            for triangle in [(a, p), (b, q)] {
                let mark = marks.entry(triangle).or_insert(Mark::OpenSeparate);
                *mark = (*mark).min(Mark::of(contact));
            }
            segments.extend(contact.touches().then(|| segment(scene, &poses, contact)).flatten());
        }
        let colour = |object: usize| OBJECTS[object % OBJECTS.len()];
        let faces = |object: usize| 0..scene.objects[object].mesh.faces().len() as u32;
        let body = |object: usize| (faces(object).map(|face| corners(object, face)).collect(), colour(object));
        let content = Content {
            bodies: (0..scene.objects.len()).map(body).collect(),
            marked: marks.iter().map(|((object, face), mark)| (corners(*object, *face), *mark)).collect(),
            segments,
        };
        let touched: HashSet<usize> = marks.keys().map(|(object, _)| *object).collect();
        let shown = |object: usize| touched.is_empty() || touched.contains(&object);
        let bodies = content.bodies.iter().enumerate().filter(|(object, _)| shown(*object));
        let whole = view::Frame::around(bodies.flat_map(|(_, (faces, _))| faces.iter().flatten()));
        // Where triangles are long, the segments say better where the contacts are, if each has one.
        let part = if content.segments.len() < contacts.len() {
            view::Frame::around(content.marked.iter().flat_map(|(corners, _)| corners))
        } else {
            view::Frame::around(content.segments.iter().flatten())
        };
        let view = View::new(&whole, &MAIN);
        let main = content.pane(&view, ALL);
        let small = !marks.is_empty() && (0..2).all(|axis| part.size()[axis] < SMALL * whole.size()[axis]);
        // The contact may be one point.
        let close = part.square(1.4, LEAST * whole.size()[0].max(whole.size()[1]));
        let window = emptiest(&main);
        let inset = small.then(|| content.pane(&View::new(&close, &window), window));
        let counts = Mark::ALL.map(|mark| contacts.iter().filter(|contact| Mark::of(contact) == mark).count());
        let names = scene.objects.iter().enumerate();
        let objects = names.map(|(number, object)| (object.name.clone(), colour(number))).collect();
        let legend = Legend::new(&scene.name, frame, &label, counts, objects);
        Self { panes: [main].into_iter().chain(inset).collect(), spot: small.then(|| view.frame(&close)), legend }
    }
}

impl Picture {
    /// Around the inset, and around what it shows.
    fn outlines(&self) -> impl Iterator<Item = view::Frame> {
        self.spot.into_iter().flat_map(|spot| [spot, self.panes[1].window])
    }
}

/// The corner, but for that of the legend, in which least of the scene is hidden by an inset.
fn emptiest(main: &Pane) -> view::Frame {
    let (size, gap) = INSET;
    let [right, bottom] = [WIDTH as f64, HEIGHT as f64].map(|end| end - gap - size);
    let corner = |low: [f64; 2]| view::Frame { low, high: low.map(|x| x + size) };
    let corners = [[right, gap], [right, bottom], [gap, bottom]].map(corner);
    let items: Vec<Item> = main.bodies.iter().flatten().cloned().collect();
    let hidden = |corner: &view::Frame| view::buffer(&items, corner).into_iter().flatten().count();
    corners.into_iter().min_by_key(hidden).expect("there are three corners")
}

impl Content {
    fn pane(&self, view: &View, window: view::Frame) -> Pane {
        let farthest_first = |x: &Item, y: &Item| x.depth().total_cmp(&y.depth());
        let body = |(faces, pale): &(Vec<Corners>, [u8; 3])| {
            let items: Vec<Item> = faces.iter().map(|face| view.item(face, |light| shaded(*pale, light))).collect();
            view::seen(&items, &window)
        };
        let mut bodies: Vec<Vec<Item>> = self.bodies.iter().map(body).filter(|items| !items.is_empty()).collect();
        let depth = |items: &Vec<Item>| items.iter().map(Item::depth).sum::<f64>() / items.len() as f64;
        bodies.sort_by(|x, y| depth(x).total_cmp(&depth(y)));
        let mut marked: Vec<Item> =
            self.marked.iter().map(|(corners, mark)| view.item(corners, |_| mark.colour())).collect();
        marked.sort_by(farthest_first);
        let end = |point: &Point3<f64>| {
            let [x, y, _] = view.point(point);
            [x, y]
        };
        let segments = self.segments.iter().map(|ends| ends.each_ref().map(end)).collect();
        Pane { window, bodies, marked, segments }
    }
}

/// A pale colour in the light.
fn shaded(colour: [u8; 3], light: f64) -> [u8; 3] {
    colour.map(|part| (f64::from(part) * light) as u8)
}

#[cfg(test)]
mod tests;
