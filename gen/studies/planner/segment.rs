//! Where two triangles of a frame meet, for drawing: exact, then rounded and moved to the frame.

use super::outcome::Contact;
use efsat_geometry::exact::posed_common;
use efsat_geometry::scene::{Pose, Scene};
use nalgebra::Point3;

/// The ends of the segment that the two triangles of a contact have in common with objects in these poses; none if they share a
/// polygon, or nothing.
pub(super) fn segment(scene: &Scene, poses: &[Pose], contact: &Contact) -> Option<[Point3<f64>; 2]> {
    let ((a, b), (p, q)) = (contact.place.objects, contact.place.pair);
    let corners = |object: usize, face: u32| scene.objects[object].mesh.triangle(face as usize).map(<[f64; 3]>::from);
    // B as the contact was decided: seen from A.
    let pose = poses[a].seen(&poses[b]).ok()?;
    let common = posed_common(&corners(a, p), &corners(b, q), &pose.rows(), &pose.translation().into());
    let common = common.expect("meshes and poses are finite");
    let ends = [common.first()?, common.last()?].map(|end| poses[a].image(&end.rounded().into()));
    (common.len() <= 2).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::super::Place;
    use super::*;
    use efsat_geometry::mesh::{Findings, Mesh};
    use efsat_geometry::scene::Object;
    use std::sync::Arc;

    const FACE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    /// Of two triangles, both in one pose.
    fn found(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> Option<[[f64; 3]; 2]> {
        let placed = Pose::from_rows([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 5.0]).unwrap();
        let object = |corners: [[f64; 3]; 3]| Object {
            name: String::new(),
            mesh: Arc::new(Mesh::from_triangles([corners]).unwrap()),
            findings: Findings::default(),
            placed,
        };
        let scene = Scene::at_rest("x", vec![object(a), object(b)]).unwrap();
        let place = Place { frame: 0, objects: (0, 1), pair: (0, 0) };
        let contact = Contact { place, verdict: None, exact: None };
        let ends = segment(&scene, &scene.frame(0).poses, &contact)?;
        let mut ends = ends.map(<[f64; 3]>::from);
        ends.sort_by(|p, q| p.partial_cmp(q).expect("finite numbers"));
        Some(ends)
    }

    #[test]
    fn segments_end_where_triangles_meet() {
        let upright = |x: f64| [[x, 1.0, -1.0], [x, 1.0, 1.0], [x, 2.0, 0.0]];
        assert_eq!(found(FACE, upright(1.0)), Some([[-2.0, 1.0, 5.0], [-1.0, 1.0, 5.0]]));
        // The slanted edge of the face cuts it short.
        assert_eq!(found(FACE, upright(2.5)), Some([[-1.5, 2.5, 5.0], [-1.0, 2.5, 5.0]]));
        assert_eq!(found(FACE, upright(3.5)), None);
        assert_eq!(found(FACE, [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]), Some([[-1.0, 1.0, 5.0]; 2]));
        assert_eq!(found(FACE, FACE), None);
    }
}
