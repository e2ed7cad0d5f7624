//! A tree of k-DOPs over the triangles of a mesh.

use super::Directions;
use super::family::{Group, LANES, Members, groups, members};
use crate::collide::split::{Node, nodes, offsets};
use crate::mesh::Mesh;
use crate::power::{ceil_log2, scaled};
use nalgebra::{Point3, Vector3};

/// The half-size of a mesh is at most 2^FRACTION steps of its grid.
pub(super) const FRACTION: i32 = 20;
/// The exponents of grids: a mesh of one point has one too.
const EXPONENTS: std::ops::RangeInclusive<i32> = -900..=1004;
/// What is added to a projection before it is rounded up, in steps of the grid: more than its rounding errors.
const SLACK: f64 = 1.0 / (1u64 << 28) as f64;

/// A binary tree of k-DOPs over the triangles of a mesh, one triangle to a leaf.
///
/// With the directions n_i, the DOP of a node is the set of all x with n_i . (x - c) <= d_i g: c is the centre of the
/// mesh's box, g = 2^exponent the step of its grid, and the d_i are integers, rounded up.
#[derive(Clone, Debug)]
pub struct DopTree {
    pub(super) directions: Directions,
    pub(super) nodes: Vec<Node>,
    /// The d_i, one family after the other; below 3 * 2^20 + 2, so that 23 bits hold them.
    pub(super) families: Vec<Group>,
    /// What the children of each family are when they are opened.
    pub(super) links: Vec<[Members; 2]>,
    /// The triangles of those that are leaves.
    triangles: Vec<[u32; 2]>,
    /// c.
    pub(super) centre: Point3<f64>,
    /// g = 2^exponent.
    pub(super) exponent: i32,
    /// No coordinate of a vertex is farther from the centre than that, in steps of the grid.
    pub(super) reach: Vector3<f64>,
}

impl DopTree {
    /// Builds the tree; nodes are split as those of the tree of boxes.
    pub fn new(mesh: &Mesh, directions: Directions) -> Self {
        let bounds = mesh.bounds();
        let (centre, half) = match mesh.vertices().is_empty() {
            true => (Point3::origin(), 0.0),
            false => (bounds.centre(), bounds.half_size()),
        };
        let exponent = (ceil_log2(half) - FRACTION).clamp(*EXPONENTS.start(), *EXPONENTS.end());
        // |v - c| <= half, give or take a rounding, so |y| <= 2^20 (1 + 2^-50) and each difference is wrong by at most
        // 2^-32 steps (the scaling is exact, but for results below 2^-1022).
        let steps = |v: &Point3<f64>| (v - centre).map(|x| scaled(x, -exponent));
        let vertices: Vec<Vector3<f64>> = mesh.vertices().iter().map(steps).collect();
        let reach = vertices.iter().fold(Vector3::zeros(), |reach, y| reach.sup(&y.abs())).add_scalar(SLACK);
        let (families, links, triangles) = (vec![], vec![], vec![]);
        let mut tree = Self { directions, nodes: nodes(mesh), families, links, triangles, centre, exponent, reach };
        tree.settle(&tree.fit(mesh, &vertices));
        tree
    }

    /// The set of directions.
    pub fn directions(&self) -> Directions {
        self.directions
    }

    /// The number of nodes: one less than twice the number of triangles.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the mesh has no triangle.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// What the coordinates of the vertices are at most, but for a few roundings.
    pub(super) fn farthest(&self) -> Vector3<f64> {
        self.centre.coords.abs() + self.reach.map(|steps| scaled(steps, self.exponent))
    }

    /// The root as the only child of its family.
    pub(super) fn root(&self) -> Option<Members> {
        self.links.len().checked_sub(1).map(|last| Members::one(last as u32, 0))
    }

    /// The number of children of a family: two, but for that of the root.
    #[inline(always)]
    pub(super) fn children(&self, family: usize) -> u64 {
        1 + u64::from(family + 1 < self.links.len())
    }

    /// The triangle of a leaf.
    pub(super) fn triangle(&self, leaf: Members) -> u32 {
        self.triangles[leaf.family()][leaf.child()]
    }

    /// The places of all nodes, and what they are when they are opened.
    pub(super) fn members(&self) -> Vec<(Members, Members)> {
        members(&self.nodes)
    }

    /// Puts nodes with their offsets into families.
    fn settle(&mut self, offsets: &[i32]) {
        let (k, groups) = (self.directions.count(), groups(self.directions));
        let count = self.nodes.len().div_ceil(2);
        self.families = vec![Group::ZERO; count * groups];
        self.links = vec![[Members::default(); 2]; count];
        self.triangles = vec![[0; 2]; count];
        for (node, (place, open)) in self.members().into_iter().enumerate() {
            let (family, child) = (place.family(), place.child());
            for (index, &offset) in offsets[node * k..][..k].iter().enumerate() {
                let lane = 2 * index + child;
                self.families[family * groups + lane / LANES].0[lane % LANES] = offset;
            }
            self.links[family][child] = open;
            if let Node::Leaf(triangle) = self.nodes[node] {
                self.triangles[family][child] = triangle;
            }
        }
    }

    /// The offsets of all nodes, from the leaves up.
    fn fit(&self, mesh: &Mesh, vertices: &[Vector3<f64>]) -> Vec<i32> {
        let k = self.directions.count();
        // A sum of three differences below 2^20 is wrong by less than 2^-30 steps, so that with the slack it is an
        // upper bound before it is rounded up.
        let offset = |y: &Vector3<f64>, n: [i8; 3]| {
            let projection: f64 = n.iter().zip(y.iter()).map(|(&n, &y)| f64::from(n) * y).sum();
            // The conversion makes 0 of NaN; but the coordinates of a mesh are finite, and so are their differences from the centre of
            // their box, which are at most its half-size.
            let (bound, whole) = (projection + SLACK, (projection + SLACK) as i32);
            whole + i32::from(bound > f64::from(whole))
        };
        let mut of_vertices = vec![0; vertices.len() * k];
        for (y, offsets) in vertices.iter().zip(of_vertices.chunks_exact_mut(k)) {
            offsets.iter_mut().enumerate().for_each(|(index, to)| *to = offset(y, self.directions.vector(index)));
        }
        offsets(&self.nodes, mesh, &of_vertices, k)
    }
}
