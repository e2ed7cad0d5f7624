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
use super::split::{FEW, HEIGHT, Node, boxes, halves, nodes};
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
    /// Children before parents.
    families: Vec<Family>,
}

/// Children of a node: as many as need no order among them.
const CHILDREN: usize = FEW;

/// The children of a node, in two lines of a cache: numbers of four children side by side, each of 31 bits below one that is set
/// and stays so if a number is taken away that is not greater.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Family {
    /// How far their boxes reach along the axes and along their opposites.
    reach: [u128; 6],
    /// The greatest number of a triangle below them, so that a child that is not there is below no triangle: 0.
    last: u128,
    /// What they are: a family, or a triangle with the highest bit set.
    open: [u32; CHILDREN],
}

/// A number for each child.
fn lanes(numbers: [u32; CHILDREN]) -> u128 {
    numbers.into_iter().rev().fold(0, |lanes, number| lanes << 32 | u128::from(number))
}

/// What a family knows of one child.
#[derive(Clone, Copy, Default)]
struct Child {
    reach: [u32; 6],
    last: u32,
    open: u32,
}

impl Child {
    /// The same of a new family of its children.
    fn of(children: &[Self], families: &mut Vec<Family>) -> Self {
        let mut all = Self { open: families.len() as u32, ..Self::default() };
        let mut four = [Self::default(); CHILDREN];
        for (to, child) in four.iter_mut().zip(children) {
            *to = *child;
            all.reach.iter_mut().zip(child.reach).for_each(|(all, reach)| *all = reach.max(*all));
            all.last = all.last.max(child.last);
        }
        let top = lanes([TOP; CHILDREN]);
        families.push(Family {
            reach: [0, 1, 2, 3, 4, 5].map(|side| top | lanes(four.map(|child| child.reach[side]))),
            last: top | lanes(four.map(|child| child.last)),
            open: four.map(|child| child.open),
        });
        all
    }
}

/// The highest bit of a number of 32.
const TOP: u32 = 1 << 31;
/// Marks a triangle.
const TRIANGLE: u32 = TOP;

impl Overlaps {
    /// Builds the tree of a mesh.
    ///
    /// # Panics
    /// If the mesh has 2^31 triangles or more.
    pub fn new(mesh: &Mesh) -> Self {
        let count = mesh.faces().len();
        assert!(count < TRIANGLE as usize, "expected fewer than 2^31 triangles, found {count}");
        let boxes = boxes(mesh);
        let mut families = Vec::with_capacity(count / 2 + 1);
        // From the last node on, a subtree ends where its root is. The children without a family of the subtrees whose parents are
        // still to come, and how many each subtree has; those on the left come later.
        let (mut children, mut counts) = (vec![], vec![]);
        for node in halves(&boxes).iter().rev() {
            match *node {
                Node::Leaf(triangle) => {
                    let reach = reach(&boxes[triangle as usize]).map(|x| order(outward(x)).div_ceil(2));
                    children.push(Child { reach, last: triangle, open: triangle | TRIANGLE });
                    counts.push(1);
                }
                Node::Inner(_) => {
                    let [right, left] = counts.last_chunk_mut().expect("an inner node has two children");
                    while *left + *right > CHILDREN {
                        let (first, larger) = match left < right {
                            true => (children.len() - *left - *right, &mut *right),
                            false => (children.len() - *left, &mut *left),
                        };
                        children[first] = Child::of(&children[first..][..*larger], &mut families);
                        children.drain(first + 1..first + *larger);
                        *larger = 1;
                    }
                    *right += *left;
                    counts.pop();
                }
            }
        }
        if !children.is_empty() {
            Child::of(&children, &mut families);
        }
        Self { boxes, families }
    }

    /// Calls `visit` with all triangles of a greater number than `triangle` whose boxes overlap its own, in any order.
    pub fn after(&self, triangle: u32, mut visit: impl FnMut(u32)) {
        let bounds = &self.boxes[triangle as usize];
        // A box overlaps if it reaches as far as this one does in the opposite directions.
        let [x, y, z, u, v, w] = reach(bounds).map(|x| lanes([order(-outward(x)) / 2; CHILDREN]));
        let (from, after) = ([u, v, w, x, y, z], lanes([triangle + 1; CHILDREN]));
        // Of each level all siblings but one wait.
        let mut stack = [0; (CHILDREN - 1) * HEIGHT as usize + 1];
        let mut waiting = self.families.len().min(1);
        stack[0] = self.families.len().saturating_sub(1) as u32;
        while waiting > 0 {
            waiting -= 1;
            let Family { reach, last, open } = &self.families[stack[waiting] as usize];
            // All are compared without a branch between them.
            let enough = reach.iter().zip(&from).fold(last - after, |enough, (reach, from)| enough & (reach - from));
            let mut hits =
                (0..CHILDREN).fold(0, |hits, child| hits | ((enough >> (32 * child + 31)) as u32 & 1) << child);
            while hits != 0 {
                let child = hits.trailing_zeros() as usize % CHILDREN;
                hits &= hits - 1;
                match open[child] {
                    leaf if leaf & TRIANGLE != 0 => {
                        let other = leaf ^ TRIANGLE;
                        if self.boxes[other as usize].overlaps(bounds) {
                            visit(other);
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

/// How far a box reaches along the axes, and along their opposites.
fn reach(Bounds { min, max }: &Bounds) -> [f64; 6] {
    [max.x, max.y, max.z, -min.x, -min.y, -min.z]
}

/// A number of 32 bits that is ordered as a number is, but for the two zeros, which differ by one: half of the lesser one, rounded
/// up, is half of the other one.
fn order(x: f32) -> u32 {
    let bits = x.to_bits();
    if bits & TOP == 0 { bits | TOP } else { !bits }
}

/// The least binary32 number that is not less.
fn outward(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) < x { near.next_up() } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    /// Boxes that touch, zeros of both signs, numbers beyond binary32 and below it, and trees that are as high as they may be.
    #[test]
    fn overlaps_are_those_of_all_boxes() {
        const SPECIAL: [f64; 8] = [0.0, -0.0, 1e300, -1e300, 1e-300, -1e-300, 16_777_217.0, -16_777_217.0];
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut found = 0;
        for round in 0..600 {
            let count = if round < 300 { round % 12 } else { 200u32 };
            let mut number = || match round % 4 {
                0 => f64::from(rng.random_range(-3..=3)),
                1 => SPECIAL[rng.random_range(0..SPECIAL.len())],
                2 => f64::from(rng.random_range(-300..300)).exp2(),
                _ => 1.0 + f64::from(rng.random_range(0..8)) * f64::EPSILON,
            };
            let vertices: Vec<[f64; 3]> = (0..3 * count).map(|_| [(); 3].map(|()| number())).collect();
            let mesh = Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap();
            let overlaps = Overlaps::new(&mesh);
            let all = boxes(&mesh);
            for (triangle, bounds) in (0..count).zip(&all) {
                let mut others = vec![];
                overlaps.after(triangle, |other| others.push(other));
                others.sort_unstable();
                let expected: Vec<u32> =
                    (triangle + 1..count).filter(|other| all[*other as usize].overlaps(bounds)).collect();
                assert_eq!(others, expected, "round {round}, triangle {triangle}");
                found += others.len();
            }
        }
        assert!(found > 10_000, "{found}");
    }
}
