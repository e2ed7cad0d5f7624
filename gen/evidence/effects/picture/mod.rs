//! A frame of a scene as a picture: the objects pale, the triangles that touch on top, coloured by verdict.
//!
//! The view is isometric, z upwards, as if from far out on (1, 1, 1). What is seen is found by an item buffer: the
//! triangle nearest to the eye for every pixel. The touching triangles are drawn over the objects, although they are
//! mostly inside the contact, because they are what a person looks for.

mod font;
mod legend;
mod png;
mod svg;
mod view;

use super::Contact;
use super::mark::Mark;
use efsat_geometry::scene::{Frame, Scene};
use legend::Legend;
use std::collections::{HashMap, HashSet};
use view::{Item, View};

/// Width of the picture in pixels.
const WIDTH: usize = 1200;
/// Its height.
const HEIGHT: usize = 900;

/// Pale colours of the objects, by turns.
const OBJECTS: [[u8; 3]; 4] = [[200, 210, 220], [226, 214, 196], [205, 220, 205], [218, 206, 222]];

/// A picture.
pub struct Picture {
    /// Triangles of all objects that are seen, the farthest first.
    seen: Vec<Item>,
    /// Marked triangles, the farthest first.
    marked: Vec<Item>,
    legend: Legend,
}

impl Picture {
    /// Draws a frame with the contacts in it.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn new(scene: &Scene, frame: usize, contacts: &[Contact]) -> Self {
        let Frame { label, poses, .. } = scene.frame(frame);
        let mut marks: HashMap<(usize, u32), Mark> = HashMap::new();
        for contact in contacts {
            let ((a, b), (p, q)) = (contact.place.objects, contact.place.pair);
            for triangle in [(a, p), (b, q)] {
                let mark = marks.entry(triangle).or_insert(Mark::OpenSeparate);
                *mark = (*mark).min(Mark::of(contact));
            }
        }
        let touched: HashSet<usize> = marks.keys().map(|(object, _)| *object).collect();
        let shown = |object: usize| touched.is_empty() || touched.contains(&object);
        let view = View::new(scene, &poses, shown);
        let mut items = vec![];
        let mut marked = vec![];
        for (number, (object, pose)) in scene.objects.iter().zip(&poses).enumerate() {
            let pale = OBJECTS[number % OBJECTS.len()];
            for face in 0..object.mesh.faces.len() {
                let corners = object.mesh.triangle(face).map(|v| pose.image(&v));
                items.push(view.item(&corners, |light| shaded(pale, light)));
                if let Some(mark) = marks.get(&(number, face as u32)) {
                    marked.push(view.item(&corners, |_| mark.colour()));
                }
            }
        }
        let seen = view::seen(&items);
        let nearest_last = |x: &Item, y: &Item| x.depth().total_cmp(&y.depth());
        marked.sort_by(nearest_last);
        let counts = Mark::ALL.map(|mark| contacts.iter().filter(|contact| Mark::of(contact) == mark).count());
        let names = scene.objects.iter().enumerate();
        let objects = names.map(|(number, object)| (object.name.clone(), OBJECTS[number % OBJECTS.len()])).collect();
        let legend = Legend::new(&scene.name, frame, &label, counts, objects);
        Self { seen, marked, legend }
    }
}

/// A pale colour in the light.
fn shaded(colour: [u8; 3], light: f64) -> [u8; 3] {
    colour.map(|part| (f64::from(part) * light) as u8)
}

#[cfg(test)]
mod tests;
