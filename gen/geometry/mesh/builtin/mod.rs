//! Meshes that are built in: the headlight, which is a file of the repository, and those that are computed. All are the
//! same bits on every machine.

mod gear;
mod globe;
mod plate;
mod sheet;

use super::{Mesh, stl};
use std::sync::{Arc, OnceLock};

/// The headlight as it stands in the repository.
const HEADLIGHT: &[u8] = include_bytes!("../../scenes/cad_headlight.stl");

/// The names of the built-in meshes.
pub const BUILTIN: [&str; 6] = ["headlight", "gear", "globe", "fine_globe", "plate", "sheet"];

/// A built-in mesh by its name; none if there is no such.
pub fn builtin(name: &str) -> Option<Arc<Mesh>> {
    match name {
        "headlight" => Some(headlight()),
        "gear" => Some(Arc::new(gear::mesh())),
        "globe" => Some(Arc::new(globe::mesh(32, 16))),
        "fine_globe" => Some(Arc::new(globe::mesh(100, 100))),
        "plate" => Some(Arc::new(plate::mesh())),
        "sheet" => Some(Arc::new(sheet::mesh())),
        _ => None,
    }
}

/// The built-in car headlight: a stand-in, made for this project, for the one the paper measured (5962 triangles
/// against 5947). Millimetres; its lens faces +z.
pub fn headlight() -> Arc<Mesh> {
    static MESH: OnceLock<Arc<Mesh>> = OnceLock::new();
    let mesh =
        MESH.get_or_init(|| Arc::new(stl::parse(HEADLIGHT).expect("the built-in mesh is a valid STL file").mesh));
    Arc::clone(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn all_names_have_a_mesh() {
        let sizes = BUILTIN.map(|name| builtin(name).unwrap().faces.len());
        assert_eq!(sizes, [5962, 1280, 1024, 20_000, 12, 3200]);
        assert_eq!(builtin("teapot"), None);
        let degenerate = BUILTIN.map(|name| builtin(name).unwrap().degenerate().len());
        assert_eq!(degenerate[1..], [0, 64, 200, 0, 0]);
    }

    /// Every edge of a solid belongs to two triangles, once in each direction, and the volume is positive. Edges from a
    /// vertex to itself are those of degenerate triangles.
    #[test]
    fn solids_are_closed_and_face_outwards() {
        for name in ["gear", "globe", "fine_globe", "plate"] {
            let mesh = builtin(name).unwrap();
            let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
            for [p, q, r] in &mesh.faces {
                for (from, to) in [(p, q), (q, r), (r, p)] {
                    *edges.entry((*from, *to)).or_default() += 1;
                    *edges.entry((*to, *from)).or_default() -= 1;
                }
            }
            let open = edges.values().filter(|count| **count != 0).count();
            assert_eq!(open, 0, "{name}");
            let corners = (0..mesh.faces.len()).map(|face| mesh.triangle(face).map(|v| v.coords));
            let volume: f64 = corners.map(|[p, q, r]| p.dot(&q.cross(&r)) / 6.0).sum();
            assert!(volume > 1.0, "{name}: {volume}");
        }
    }
}
