//! Where a pair of a scene is, and its numbers, for tables.

use super::output::quoted;
use efsat_geometry::Points;
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::{Meeting, Pose, Scene};
use efsat_studies::planner::Place;

/// The columns of a scene that say where a pair is.
pub(super) struct Places<'a> {
    scene: &'a Scene,
    /// Whether a face of a mesh file is more than one triangle, so that its number does not name one.
    are_split: bool,
}

impl<'a> Places<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let are_split = scene.objects.iter().any(|object| object.findings.numbers.are_split());
        Self { scene, are_split }
    }

    /// The names of the columns, with others before those that not every scene has.
    pub fn columns(&self, others: &str) -> String {
        let parts = if self.are_split { ",part_a,part_b" } else { "" };
        format!("frame,a,b,triangle_a,triangle_b{others}{parts}")
    }

    /// A pair, with the numbers of the faces in their files; the other columns likewise.
    pub fn row(&self, place: &Place, others: &str) -> String {
        let Place { frame, objects: (a, b), pair: (p, q) } = *place;
        let [[p, part], [q, other]] =
            [(a, p), (b, q)].map(|(object, p)| self.scene.objects[object].findings.numbers.of(p));
        let parts = if self.are_split { format!(",{part},{other}") } else { String::new() };
        let [a, b] = [a, b].map(|object| quoted(&self.scene.objects[object].name));
        format!("{frame},{a},{b},{p},{q}{others}{parts}")
    }
}

/// The names of the numbers of a pair.
pub(super) fn numbers() -> String {
    let corner = |side: char, k: u32| ['x', 'y', 'z'].map(|axis| format!("{side}{k}_{axis}"));
    let all = ['a', 'b'].into_iter().flat_map(|side| (0..3).flat_map(move |k| corner(side, k)));
    all.collect::<Vec<_>>().join(",")
}

/// The corners of a pair in the frame of A: those of B are rounded once behind the pose.
pub(super) fn points(meshes: [&Mesh; 2], pose: &Pose, (p, q): (u32, u32)) -> Points {
    let [a0, a1, a2] = meshes[0].triangle(p as usize).map(<[f64; 3]>::from);
    let [b0, b1, b2] = meshes[1].triangle(q as usize).map(|corner| pose.image(&corner).into());
    [a0, a1, a2, b0, b1, b2]
}

/// Where a pair of a meeting is.
pub(super) fn place(meeting: &Meeting, pair: (u32, u32)) -> Place {
    Place { frame: meeting.frame, objects: (meeting.a, meeting.b), pair }
}

/// The numbers of a pair as fields of a row.
pub(super) fn fields(points: &Points) -> String {
    points.as_flattened().iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}
