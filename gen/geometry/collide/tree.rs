//! Bounding-box tree over the triangles of a mesh, and the pairs of triangles whose boxes overlap.
//!
//! No pair of triangles with a common point is ever missed. A's boxes are made by comparisons of the given doubles, so
//! they are exact. Mesh B is brought to A's frame vertex by vertex, each coordinate as an interval that surely
//! holds the real number M x + t (see `enclosure`); the box of a triangle is the box of its corners' intervals,
//! hence holds the triangle, because an affine map keeps convex hulls; the box of an inner node holds those of its
//! children.
//! If two triangles have a common point, then it lies in both leaf boxes and in the boxes of all their ancestors, so
//! that every test on the way down sees an overlap: touching boxes count.

use super::Pose;
use super::enclosure::image;
use super::pieces::{MOST, rows};
use super::split::{HEIGHT, Node, halves, nodes};
use crate::mesh::{Bounds, Mesh};

/// A binary tree of axis-aligned boxes over the triangles of a mesh, one triangle to a leaf.
#[derive(Clone, Debug)]
pub struct Tree<'a> {
    mesh: &'a Mesh,
    nodes: Vec<Node>,
    boxes: Vec<Bounds>,
}

impl<'a> Tree<'a> {
    /// Builds the tree, split by the surface area heuristic.
    pub fn new(mesh: &'a Mesh) -> Self {
        let mut tree = Self { mesh, nodes: nodes(mesh), boxes: Vec::new() };
        tree.boxes = tree.fit(&mesh.vertices().iter().map(|&v| Bounds { min: v, max: v }).collect::<Vec<_>>());
        tree
    }

    /// The boxes of all nodes, from the leaves up, for given boxes of the vertices.
    fn fit(&self, vertices: &[Bounds]) -> Vec<Bounds> {
        let mut boxes = vec![Bounds::empty(); self.nodes.len()];
        for (index, node) in self.nodes.iter().enumerate().rev() {
            boxes[index] = match *node {
                Node::Leaf(triangle) => self.mesh.faces()[triangle as usize]
                    .iter()
                    .fold(Bounds::empty(), |b, &v| b.union(&vertices[v as usize])),
                Node::Inner(right) => boxes[index + 1].union(&boxes[right as usize]),
            };
        }
        boxes
    }
}

/// The pairs (triangle of A, triangle of B) whose boxes overlap in A's frame when B is in a pose as seen from A. No pair
/// with a common point is missing, whatever the doubles are.
#[derive(Debug)]
pub struct Candidates<'a> {
    a: &'a Tree<'a>,
    b: &'a Tree<'a>,
    /// The boxes of B in A's frame.
    boxes: Vec<Bounds>,
}

impl<'a> Candidates<'a> {
    /// Brings the boxes of B to A's frame.
    pub fn new(a: &'a Tree<'a>, b: &'a Tree<'a>, pose: &Pose) -> Self {
        let boxes = b.fit(&b.mesh.vertices().iter().map(|v| image(v, pose)).collect::<Vec<_>>());
        Self { a, b, boxes }
    }

    /// All of them in ascending order, unless they are [too many](MOST).
    pub(crate) fn few(&self) -> Option<Vec<(u32, u32)>> {
        let mut pairs = vec![];
        self.below(0, |pair| {
            pairs.push(pair);
            pairs.len() <= MOST
        });
        pairs.sort_unstable();
        (pairs.len() <= MOST).then_some(pairs)
    }

    /// Calls `visit` with all of them in ascending order, in one piece or several, until it fails.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn pieces<E>(&self, mut visit: impl FnMut(&[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        match self.few() {
            Some(pairs) => visit(&pairs),
            None => self.rows(visit),
        }
    }

    /// The same for pairs that are too many.
    pub(crate) fn rows<E>(&self, visit: impl FnMut(&[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        let row = |leaf: usize, pairs: &mut Vec<(u32, u32)>| {
            self.below(leaf, |pair| {
                pairs.push(pair);
                true
            });
        };
        rows(&self.a.nodes, row, visit)
    }

    /// Finds the pairs of the triangles below a node of A, in any order, as long as `more` says yes.
    fn below(&self, root: usize, mut more: impl FnMut((u32, u32)) -> bool) {
        let Self { a, b, boxes } = self;
        let mut stack = Vec::new();
        if !a.nodes.is_empty() && !b.nodes.is_empty() {
            stack.push((root, 0));
        }
        while let Some((i, j)) = stack.pop() {
            if !a.boxes[i].overlaps(&boxes[j]) {
                continue;
            }
            match (a.nodes[i], b.nodes[j]) {
                (Node::Leaf(p), Node::Leaf(q)) => {
                    if !more((p, q)) {
                        return;
                    }
                }
                (Node::Leaf(_), Node::Inner(right)) => stack.extend([(i, j + 1), (i, right as usize)]),
                (Node::Inner(right), Node::Leaf(_)) => stack.extend([(i + 1, j), (right as usize, j)]),
                (Node::Inner(right), Node::Inner(other)) => {
                    let (right, other) = (right as usize, other as usize);
                    stack.extend([(i + 1, j + 1), (i + 1, other), (right, j + 1), (right, other)]);
                }
            }
        }
    }
}

/// The pairs of triangles of one mesh whose boxes overlap, triangle by triangle.
#[derive(Clone, Debug)]
pub struct Overlaps {
    /// The box of each triangle.
    boxes: Vec<Bounds>,
    /// Of each inner node, parents first.
    families: Vec<Family>,
}

/// The children of an inner node, in one line of a cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Family {
    /// How far their boxes reach along the axes and along their opposites, in binary32, rounded outward: two sides a row, each of both
    /// children.
    reach: [[f32; 4]; 3],
    /// The greatest number of a triangle below them.
    last: [u32; 2],
    /// What they are: a family, or a triangle with the highest bit set.
    open: [u32; 2],
}

impl Family {
    fn of(children: [&Child; 2]) -> Self {
        let reach = [0, 1, 2].map(|row| [0, 1, 2, 3].map(|lane| children[lane % 2].reach[2 * row + lane / 2]));
        Self { reach, last: children.map(|child| child.last), open: children.map(|child| child.open) }
    }
}

/// What a family knows of one child.
struct Child {
    reach: [f32; 6],
    last: u32,
    open: u32,
}

impl Child {
    /// The same of the family of two.
    fn beside(&self, other: &Self, family: u32) -> Self {
        let reach = std::array::from_fn(|side| self.reach[side].max(other.reach[side]));
        Self { reach, last: self.last.max(other.last), open: family }
    }
}

/// Marks a triangle.
const TRIANGLE: u32 = 1 << 31;

impl Overlaps {
    /// Builds the tree of a mesh.
    ///
    /// # Panics
    /// If the mesh has 2^31 triangles or more.
    pub fn new(mesh: &Mesh) -> Self {
        let count = mesh.faces().len();
        assert!(count < TRIANGLE as usize, "expected fewer than 2^31 triangles, found {count}");
        let nodes = halves(mesh);
        let none = Family { reach: [[0.0; 4]; 3], last: [0; 2], open: [0; 2] };
        let (mut boxes, mut families) = (vec![Bounds::empty(); count], vec![none; count.saturating_sub(1)]);
        // From the last node on, a subtree ends where its root is: what is known of subtrees whose parents are still to come.
        let (mut known, mut first) = (Vec::<Child>::new(), families.len());
        for node in nodes.iter().rev() {
            let child = match *node {
                Node::Leaf(triangle) => {
                    let bounds = Bounds::of(mesh.faces()[triangle as usize].map(|v| &mesh.vertices()[v as usize]));
                    boxes[triangle as usize] = bounds;
                    Child { reach: reach(&bounds).map(outward), last: triangle, open: TRIANGLE | triangle }
                }
                Node::Inner(_) => {
                    let [left, right] = [known.pop(), known.pop()].map(|x| x.expect("an inner node has two children"));
                    first -= 1;
                    families[first] = Family::of([&left, &right]);
                    left.beside(&right, first as u32)
                }
            };
            known.push(child);
        }
        Self { boxes, families }
    }

    /// Calls `visit` with all triangles of a greater number than `triangle` whose boxes overlap its own, in any order.
    pub fn after(&self, triangle: u32, mut visit: impl FnMut(u32)) {
        let bounds = &self.boxes[triangle as usize];
        // A box overlaps if it reaches as far as this one does in the opposite directions.
        let [x, y, z, u, v, w] = reach(bounds).map(|x| -outward(x));
        let from = [[u, u, v, v], [w, w, x, x], [y, y, z, z]];
        // Of each level at most one sibling waits.
        let (mut stack, mut waiting) = ([0; HEIGHT as usize], usize::from(!self.families.is_empty()));
        while waiting > 0 {
            waiting -= 1;
            let Family { reach, last, open } = &self.families[stack[waiting] as usize];
            // All are compared without a branch between them.
            let mut short = [0; 4];
            for (reach, from) in reach.iter().zip(&from) {
                for lane in 0..4 {
                    short[lane] |= u32::from(reach[lane] < from[lane]);
                }
            }
            for child in [1, 0] {
                if (short[child] | short[child + 2] == 0) & (last[child] > triangle) {
                    match open[child] {
                        leaf if leaf & TRIANGLE != 0 => {
                            if self.boxes[last[child] as usize].overlaps(bounds) {
                                visit(last[child]);
                            }
                        }
                        family => {
                            stack[waiting] = family;
                            waiting += 1;
                        }
                    }
                }
            }
        }
    }
}

/// How far a box reaches along the axes, and along their opposites.
fn reach(Bounds { min, max }: &Bounds) -> [f64; 6] {
    [max.x, max.y, max.z, -min.x, -min.y, -min.z]
}

/// The least binary32 number that is not less.
fn outward(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) < x { near.next_up() } else { near }
}
