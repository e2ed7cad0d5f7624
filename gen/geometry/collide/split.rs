//! How the triangles of a mesh are split into a binary tree: by the surface area heuristic, to a bounded height.

use crate::mesh::{Bounds, Mesh};
use nalgebra::Point3;
use std::cmp::Ordering;

/// No leaf is deeper below the root, so that a stack of fixed size does for every tree.
pub(super) const HEIGHT: u32 = 32;

/// A node of a tree; nodes are stored parent first, left subtree before right.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    /// One triangle.
    Leaf(u32),
    /// Two subtrees: the left one follows its parent, the right one is at this index.
    Inner(u32),
}

/// A triangle on its way to a leaf.
#[derive(Clone, Copy)]
struct Item {
    triangle: u32,
    bounds: Bounds,
    centre: Point3<f64>,
}

impl Item {
    /// The order along an axis; the index breaks ties, so that the tree does not depend on the sorting algorithm.
    fn order(&self, other: &Self, axis: usize) -> Ordering {
        self.centre[axis].total_cmp(&other.centre[axis]).then(self.triangle.cmp(&other.triangle))
    }
}

/// The nodes of a tree over the triangles of a mesh.
pub(super) fn nodes(mesh: &Mesh) -> Vec<Node> {
    let item = |(triangle, face): (u32, &[u32; 3])| {
        let bounds = Bounds::of(face.map(|v| &mesh.vertices()[v as usize]));
        Item { triangle, bounds, centre: bounds.centre() }
    };
    let mut items: Vec<Item> = (0..).zip(mesh.faces()).map(item).collect();
    let mut nodes = Vec::with_capacity(2 * items.len());
    if !items.is_empty() {
        split(&mut items, HEIGHT, &mut nodes);
    }
    nodes
}

/// The nodes of a tree that is built in a fraction of the time and is good enough to be asked once: halves along the longest side of
/// the box of the centres, by all threads of the current pool.
pub(super) fn halves(mesh: &Mesh) -> Vec<Node> {
    let centre = |face: &[u32; 3]| Bounds::of(face.map(|v| &mesh.vertices()[v as usize])).centre();
    let mut items: Vec<(Point3<f64>, u32)> = mesh.faces().iter().map(centre).zip(0..).collect();
    let mut nodes = vec![Node::Leaf(0); (2 * items.len()).saturating_sub(1)];
    halve(&mut items, &mut nodes, 0);
    nodes
}

/// Triangles from which on both halves are worth a thread.
const PARALLEL: usize = 1 << 12;

/// Fills the nodes of a subtree whose root has the number `root`.
fn halve(items: &mut [(Point3<f64>, u32)], nodes: &mut [Node], root: u32) {
    let [parent, below @ ..] = nodes else { return };
    if let [(_, triangle)] = items {
        *parent = Node::Leaf(*triangle);
        return;
    }
    let middle = items.len() / 2;
    let bounds = Bounds::of(items.iter().map(|(centre, _)| centre));
    // Halved, no side overflows.
    let axis = (bounds.max.coords * 0.5 - bounds.min.coords * 0.5).imax();
    items.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let parallel = items.len() >= PARALLEL;
    let (left, right) = items.split_at_mut(middle);
    let (first, second) = (root + 1, root + 2 * middle as u32);
    *parent = Node::Inner(second);
    let (nodes_left, nodes_right) = below.split_at_mut(2 * middle - 1);
    if parallel {
        rayon::join(|| halve(left, nodes_left, first), || halve(right, nodes_right, second));
    } else {
        halve(left, nodes_left, first);
        halve(right, nodes_right, second);
    }
}

/// The offsets of all nodes along `k` directions, one node after the other, from those of the vertices: the greatest of what is
/// below a node.
pub(super) fn offsets(nodes: &[Node], mesh: &Mesh, of_vertices: &[i32], k: usize) -> Vec<i32> {
    let mut offsets = vec![0; nodes.len() * k];
    for (node, kind) in nodes.iter().enumerate().rev() {
        for index in 0..k {
            offsets[node * k + index] = match *kind {
                Node::Leaf(triangle) => {
                    let [p, q, r] = mesh.faces()[triangle as usize].map(|v| of_vertices[v as usize * k + index]);
                    p.max(q).max(r)
                }
                Node::Inner(right) => offsets[(node + 1) * k + index].max(offsets[right as usize * k + index]),
            };
        }
    }
    offsets
}

/// Appends the subtree over `items`, of which there is at least one, with no leaf deeper than `height`.
fn split(items: &mut [Item], height: u32, nodes: &mut Vec<Node>) {
    if let [item] = items {
        nodes.push(Node::Leaf(item.triangle));
        return;
    }
    let middle = divide(items, 1 << (height - 1));
    let (left, right) = items.split_at_mut(middle);
    let parent = nodes.len();
    nodes.push(Node::Inner(0));
    split(left, height - 1, nodes);
    nodes[parent] = Node::Inner(nodes.len() as u32);
    split(right, height - 1, nodes);
}

/// Sorts two or more items along the axis of the best cut, and says how many are on its left. Neither side gets more
/// than `most`. The larger side is the right one, which a traversal visits first: contacts are likelier there.
///
/// A cut costs the sum over both sides of surface area times number of triangles. Of equal cuts the most even one is taken;
/// areas that overflow or vanish lead to halves.
fn divide(items: &mut [Item], most: usize) -> usize {
    let count = items.len();
    let legal = count.saturating_sub(most).max(1)..=most.min(count - 1);
    let mut right = vec![0.0; count];
    let mut best = (f64::NAN, usize::MAX, 0, 0);
    for axis in 0..3 {
        items.sort_unstable_by(|a, b| a.order(b, axis));
        let mut bounds = Bounds::empty();
        for (item, cost) in items.iter().zip(&mut right).rev() {
            bounds = bounds.union(&item.bounds);
            *cost = area(&bounds);
        }
        bounds = Bounds::empty();
        for cut in 1..count {
            bounds = bounds.union(&items[cut - 1].bounds);
            if legal.contains(&cut) {
                let cost = area(&bounds) * cut as f64 + right[cut] * (count - cut) as f64;
                let uneven = cut.abs_diff(count - cut);
                if cost.total_cmp(&best.0).then(uneven.cmp(&best.1)).is_lt() {
                    best = (cost, uneven, axis, cut);
                }
            }
        }
    }
    let (_, _, axis, cut) = best;
    items.select_nth_unstable_by(cut, |a, b| a.order(b, axis));
    if cut > count / 2 {
        items.rotate_left(cut);
        return count - cut;
    }
    cut
}

/// Half the surface area of a box.
fn area(bounds: &Bounds) -> f64 {
    let size = bounds.max - bounds.min;
    size.x * size.y + size.y * size.z + size.z * size.x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::headlight;

    /// Small triangles at places along x.
    fn row(places: impl Iterator<Item = f64>) -> Mesh {
        let vertices: Vec<Point3<f64>> = places
            .flat_map(|x| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[y, z]| Point3::new(x, 0.1 * y, 0.1 * z)))
            .collect();
        let faces: Vec<_> = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Mesh::new(vertices, faces).unwrap()
    }

    /// The triangles below a node in their order, and how far below it the deepest is.
    fn leaves(nodes: &[Node], node: usize) -> (Vec<u32>, u32) {
        match nodes[node] {
            Node::Leaf(triangle) => (vec![triangle], 0),
            Node::Inner(right) => {
                let (mut triangles, left) = leaves(nodes, node + 1);
                let (others, right) = leaves(nodes, right as usize);
                triangles.extend(others);
                (triangles, 1 + left.max(right))
            }
        }
    }

    #[test]
    fn every_triangle_is_a_leaf_and_none_is_too_deep() {
        // Each place is far beyond all before it, so that without a bound the tree would be a list.
        let doubling = row((0..500).map(|i| 2f64.powi(i)));
        let at_one_point = Mesh::new(vec![Point3::origin()], vec![[0; 3]; 1000]).unwrap();
        let beyond_areas = row((0..64).map(|i| 1e300 * f64::from(i)));
        for (mesh, least, most) in
            [(&doubling, 25, HEIGHT), (&at_one_point, 10, 10), (&beyond_areas, 6, 6), (&headlight(), 13, 25)]
        {
            let nodes = nodes(mesh);
            let (mut triangles, height) = leaves(&nodes, 0);
            assert_eq!(nodes.len(), 2 * mesh.faces().len() - 1);
            assert!((least..=most).contains(&height), "{height}");
            triangles.sort_unstable();
            assert!(triangles.into_iter().eq(0..mesh.faces().len() as u32));
            let halves = halves(mesh);
            let (mut triangles, height) = leaves(&halves, 0);
            assert_eq!(
                (halves.len(), height),
                (2 * mesh.faces().len() - 1, mesh.faces().len().next_power_of_two().ilog2())
            );
            triangles.sort_unstable();
            assert!(triangles.into_iter().eq(0..mesh.faces().len() as u32));
        }
        assert!(nodes(&Mesh::default()).is_empty() && halves(&Mesh::default()).is_empty());
    }

    #[test]
    fn cuts_are_where_the_gap_is() {
        // Two groups, of three and of seven triangles.
        let mesh = row((0..10).map(|i| f64::from(i) + if i < 3 { 0.0 } else { 50.0 }));
        let Node::Inner(right) = nodes(&mesh)[0] else { panic!("ten triangles are no leaf") };
        assert_eq!(leaves(&nodes(&mesh), 1).0.len(), 3);
        assert_eq!(leaves(&nodes(&mesh), right as usize).0.len(), 7);
    }
}
