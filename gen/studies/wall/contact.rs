//! The classic contacts of two triangles.

/// Two triangles in contact, one vertex of which is to be moved.
///
/// The columns of a map go along the contact, its rows go through it: upwards is away from the other triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What it is called on the command line and in file names.
    pub name: &'static str,
    /// What lies on what, in words.
    pub about: &'static str,
    /// A common point of the triangles.
    pub at: [f64; 3],
    /// The points a0 a1 a2 b0 b1 b2 relative to the common point.
    pub offsets: [[f64; 3]; 6],
    /// The index of the vertex that moves.
    pub moved: usize,
    /// What a step to the right adds to the vertex, in units of the step.
    pub along: [f64; 3],
    /// What a step upwards adds.
    pub through: [f64; 3],
}

const AT: [f64; 3] = [0.5, 0.75, 0.625];
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// All contacts. But for the coplanar one each step is one unit of one coordinate, and no wall is parallel to a plane
/// of coordinates. No difference of coordinates is near a power of two, so that re-normalisation scales all cells of a
/// map alike.
pub const CONTACTS: [Contact; 11] = [
    Contact {
        name: "vertex-on-face",
        about: "a vertex of A inside the face of B",
        at: AT,
        offsets: [[0., 0., 0.], [3., -2., 9.], [-4., 5., 7.], [12., -3., 5.], [-7., 11., 3.], [-5., -8., -8.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "vertex-on-edge",
        about: "a vertex of A inside an edge of B",
        at: AT,
        offsets: [[0., 0., 0.], [3., -9., 9.], [-2., 10., 7.], [12., 3., -2.], [-12., -3., 2.], [1., -2., -11.]],
        moved: 0,
        along: Y,
        through: Z,
    },
    Contact {
        name: "vertex-on-vertex",
        about: "a vertex of B on a vertex of A",
        at: AT,
        offsets: [[0., 0., 0.], [9., -6., -9.], [-7., 4., -11.], [0., 0., 0.], [5., 9., 10.], [-6., -11., 7.]],
        moved: 3,
        along: X,
        through: Z,
    },
    // Seen along z these are the points (0.5, 0.5), (12, 12) and (24, 24) of Kettner et al., figure 2.
    Contact {
        name: "edge-on-edge",
        about: "crossing edges; the moved vertex is the end of one of them",
        at: [12., 12., 0.],
        offsets: [[-11.5, -11.5, 0.], [12., 12., 0.], [-11., 12., 3.], [0., 0., -20.], [0., 0., 20.], [12., -11., 5.]],
        moved: 0,
        along: X,
        through: Y,
    },
    Contact {
        name: "edge-along-edge",
        about: "collinear edges that share a piece; A opens like a hinge about a point beyond B",
        at: AT,
        offsets: [[0., 0., 0.], [12., -6., 3.], [3., 5., 10.], [-8., 4., -2.], [4., -2., 1.], [-2., 9., -11.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "shared-edge",
        about: "a common edge, torn open at one end; the other end stays common",
        at: AT,
        offsets: [[0., 0., 0.], [12., -6., 3.], [3., 5., 10.], [0., 0., 0.], [12., -6., 3.], [-2., 9., -11.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "edge-on-face",
        about: "an edge of A in the face of B",
        at: AT,
        offsets: [[0., 0., 0.], [13., -9., 1.], [2., -3., 10.], [8., -2., 3.], [-5., 7., 2.], [-3., -5., -5.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "face-on-face",
        about: "coplanar faces that share area; A tilts about a line outside B, so that both sides are separate",
        at: AT,
        offsets: [[0., 0., 0.], [12., -10., -8.], [2., 5., 12.], [6., -5., -4.], [-2., 5., 8.], [-4., 0., -4.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "coplanar",
        about: "all in one plane: a vertex of A on an edge of B, moved within the plane",
        at: AT,
        offsets: [[0., 0., 0.], [-4., -7., 11.], [5., -10., 5.], [9., -6., -3.], [-9., 6., 3.], [2., 7., -9.]],
        moved: 0,
        along: [1., 0., -1.],
        through: [0., -1., 1.],
    },
    Contact {
        name: "sliver-tip",
        about: "the tip of a needle, 100 times as long as wide, inside the face of B",
        at: AT,
        offsets: [[0., 0., 0.], [5., -4., 11.], [5.125, -4.0625, 11.], [12., -3., 5.], [-7., 11., 3.], [-5., -8., -8.]],
        moved: 0,
        along: X,
        through: Z,
    },
    Contact {
        name: "vertex-on-sliver",
        about: "a vertex of A inside the face of a sliver, 10 times as long as wide",
        at: AT,
        offsets: [[0., 0., 0.], [-3., 2., 11.], [-7., -4., 9.], [10., -9., 9.], [-4.5, 5.5, -4.], [-5.5, 3.5, -5.]],
        moved: 0,
        along: X,
        through: Z,
    },
];

impl Contact {
    /// The contact of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        CONTACTS.iter().find(|contact| contact.name == name)
    }

    /// The points a0 a1 a2 b0 b1 b2 in contact.
    pub fn points(&self) -> [[f64; 3]; 6] {
        self.offsets.map(|offset| [0, 1, 2].map(|i| self.at[i] + offset[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_geometry::exact::{self, Exact};

    #[test]
    fn all_are_contacts() {
        for contact in &CONTACTS {
            let expected = if contact.name == "face-on-face" { Exact::Intersect } else { Exact::Touch };
            assert_eq!(exact::pair(&contact.points()).unwrap(), expected, "{}", contact.name);
            assert_eq!(Contact::named(contact.name), Some(contact));
        }
        assert_eq!(Contact::named("vertex"), None);
    }

    /// What a sentence above says: the scale of no coordinate axis changes on the widest grid.
    #[test]
    fn scales_are_constant() {
        for contact in &CONTACTS {
            let points = contact.points();
            for i in 0..3 {
                let reach = points.iter().map(|x| (x[i] - points[0][i]).abs()).fold(0.0, f64::max);
                assert_eq!((reach - 0.99).log2().floor(), (reach + 0.99).log2().floor(), "{} {i}", contact.name);
            }
        }
    }
}
