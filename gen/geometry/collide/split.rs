//! How the triangles of a mesh are split into a binary tree: by the surface area heuristic, to a bounded height.
//!
//! The triangles are sorted along each axis once, and stay in order when they are divided. Large meshes are first cut between bins
//! of equal width, which costs a fraction and is as good where there are many triangles.

use crate::mesh::{Bounds, Mesh};
use nalgebra::Point3;
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// No leaf is deeper below the root, so that a stack of fixed size does for every tree.
pub(super) const HEIGHT: u32 = 32;

/// A node of a tree; nodes are stored parent first, left subtree before right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    /// One triangle.
    Leaf(u32),
    /// Two subtrees: the left one follows its parent, the right one is at this index.
    Inner(u32),
}

/// Triangles from which on both halves are worth a thread.
const PARALLEL: usize = 1 << 12;
/// Meshes of more triangles are split by bins, down to groups of a few.
const LARGE: usize = 1 << 14;
/// The triangles of such a group.
const GROUP: usize = 1 << 5;
/// Bins along an axis.
const BINS: usize = 32;

/// A triangle on its way to a leaf.
struct Item {
    reach: Reach,
    centre: [f64; 3],
}

/// How far a box reaches along the axes, and along their opposites.
#[derive(Clone, Copy)]
struct Reach([f64; 6]);

impl Reach {
    /// That of no point.
    const NONE: Self = Self([f64::NEG_INFINITY; 6]);

    fn of(Bounds { min, max }: &Bounds) -> Self {
        Self([max.x, max.y, max.z, -min.x, -min.y, -min.z])
    }

    #[inline(always)]
    fn union(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] }))
    }

    /// Half the surface area.
    #[inline(always)]
    fn area(&self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.0[axis] + self.0[axis + 3]);
        x * y + y * z + z * x
    }
}

/// The nodes of a tree over the triangles of a mesh, by all threads of the current pool.
pub(super) fn nodes(mesh: &Mesh) -> Vec<Node> {
    if mesh.faces().len() > LARGE { split(mesh, GROUP) } else { best(mesh) }
}

/// The same without bins: every cut is the best.
pub(super) fn best(mesh: &Mesh) -> Vec<Node> {
    split(mesh, usize::MAX)
}

/// The same, by bins down to groups.
fn split(mesh: &Mesh, group: usize) -> Vec<Node> {
    let item = |face: &[u32; 3]| {
        let bounds = Bounds::of(face.map(|v| &mesh.vertices()[v as usize]));
        Item { reach: Reach::of(&bounds), centre: bounds.centre().into() }
    };
    let items: Vec<Item> = mesh.faces().iter().map(item).collect();
    let count = items.len();
    let mut nodes = vec![Node::Leaf(0); (2 * count).saturating_sub(1)];
    let [mut x, mut y, mut z] = [(); 3].map(|()| (0..count as u32).collect::<Vec<u32>>());
    let (mut spare, mut costs) = (vec![0; count], vec![0.0; count]);
    let orders = [&mut x[..], &mut y, &mut z];
    let part = Part { orders, spare: &mut spare, costs: &mut costs, nodes: &mut nodes, root: 0, height: HEIGHT };
    if count > 0 {
        part.split(&items, group);
    }
    nodes
}

/// The boxes of the triangles of a mesh.
pub(super) fn boxes(mesh: &Mesh) -> Vec<Bounds> {
    mesh.faces().par_iter().map(|face| Bounds::of(face.map(|v| &mesh.vertices()[v as usize]))).collect()
}

/// So few triangles are halved as they come.
pub(super) const FEW: usize = 4;

/// The nodes of a tree over triangles with the given boxes that is built in a fraction of the time and is good enough to be asked once:
/// cut in the middle of the longest side of the box of the centres, or into halves where the tree would be too high; by all threads of
/// the current pool.
pub(super) fn halves(boxes: &[Bounds]) -> Vec<Node> {
    let mut items: Vec<(Point3<f64>, u32)> = boxes.iter().map(Bounds::centre).zip(0..).collect();
    let mut nodes = vec![Node::Leaf(0); (2 * items.len()).saturating_sub(1)];
    halve(&mut items, &mut nodes, 0, HEIGHT);
    nodes
}

/// Fills the nodes of a subtree whose root has the number `root`, no leaf of which may be deeper than `height`.
fn halve(items: &mut [(Point3<f64>, u32)], nodes: &mut [Node], root: u32, height: u32) {
    let [parent, below @ ..] = nodes else { return };
    if let [(_, triangle)] = items {
        *parent = Node::Leaf(*triangle);
        return;
    }
    let mut middle = items.len() / 2;
    if items.len() > FEW {
        let bounds = Bounds::of(items.iter().map(|(centre, _)| centre));
        // Halved, no side overflows.
        let axis = (bounds.max.coords * 0.5 - bounds.min.coords * 0.5).imax();
        let centre = bounds.min[axis] * 0.5 + bounds.max[axis] * 0.5;
        let mut below = 0;
        for index in 0..items.len() {
            // Without a branch, as which it is cannot be foreseen.
            let is_below = items[index].0[axis] < centre;
            items.swap(index, below);
            below += usize::from(is_below);
        }
        if legal(items.len(), height).contains(&below) {
            middle = below;
        } else {
            items.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
        }
    }
    let parallel = items.len() >= PARALLEL;
    let (left, right) = items.split_at_mut(middle);
    let (first, second) = (root + 1, root + 2 * middle as u32);
    *parent = Node::Inner(second);
    let (nodes_left, nodes_right) = below.split_at_mut(2 * middle - 1);
    let height = height - 1;
    if parallel {
        rayon::join(|| halve(left, nodes_left, first, height), || halve(right, nodes_right, second, height));
    } else {
        halve(left, nodes_left, first, height);
        halve(right, nodes_right, second, height);
    }
}

/// How many of the triangles may be on the left so that no leaf is deeper than `height`.
fn legal(count: usize, height: u32) -> RangeInclusive<usize> {
    let most = 1 << (height - 1);
    count.saturating_sub(most).max(1)..=most.min(count - 1)
}

/// The offsets of all nodes along `k` directions, one node after the other, from those of the vertices: the greatest of what is
/// below a node.
pub(super) fn offsets(nodes: &[Node], mesh: &Mesh, of_vertices: &[i32], k: usize) -> Vec<i32> {
    let mut offsets = vec![0; nodes.len() * k];
    for (node, kind) in nodes.iter().enumerate().rev() {
        let (own, below) = offsets[node * k..].split_at_mut(k);
        match *kind {
            Node::Leaf(triangle) => {
                let [p, q, r] = mesh.faces()[triangle as usize].map(|v| &of_vertices[v as usize * k..][..k]);
                own.iter_mut().zip(p).zip(q).zip(r).for_each(|(((to, p), q), r)| *to = *p.max(q).max(r));
            }
            Node::Inner(right) => {
                let [left, right] = [node + 1, right as usize].map(|child| &below[(child - node - 1) * k..][..k]);
                own.iter_mut().zip(left).zip(right).for_each(|((to, left), right)| *to = *left.max(right));
            }
        }
    }
    offsets
}

/// A subtree that is to be made, of at least one triangle.
struct Part<'a> {
    /// Its triangles, in their order along each axis once it is a group; before, the first list holds them in any order.
    orders: [&'a mut [u32]; 3],
    /// As much room again.
    spare: &'a mut [u32],
    costs: &'a mut [f64],
    nodes: &'a mut [Node],
    /// The number of its root.
    root: u32,
    /// No leaf may be deeper.
    height: u32,
}

/// Where a part is cut: by cost, then by how uneven the sides are; along which axis, and how many triangles are on the left or which
/// bin is the first on the right.
type Cut = (f64, usize, usize, usize);

/// A cut costs the sum over both sides of surface area times number of triangles. Of equal cuts the most even one is taken;
/// areas that overflow or vanish lead to halves.
fn better(best: Cut, cut: Cut) -> Cut {
    if cut.0.total_cmp(&best.0).then(cut.1.cmp(&best.1)).is_lt() { cut } else { best }
}

/// Worse than all cuts.
const NONE: Cut = (f64::NAN, usize::MAX, 0, 0);

impl<'a> Part<'a> {
    /// Cuts between bins while there are more triangles than in a group, and then wherever it is best.
    fn split(mut self, items: &[Item], group: usize) {
        let count = self.spare.len();
        let cut = if count > group { self.cut_of_bins(items) } else { None };
        match cut {
            Some(middle) => self.both(middle, |part| part.split(items, group)),
            None => {
                let [first, others @ ..] = &mut self.orders;
                others.iter_mut().for_each(|order| order.copy_from_slice(first));
                let mut keyed = Vec::with_capacity(count);
                for (axis, order) in self.orders.iter_mut().enumerate() {
                    keyed.clear();
                    keyed.extend(order.iter().map(|&triangle| (key(items[triangle as usize].centre[axis]), triangle)));
                    keyed.sort_unstable();
                    order.iter_mut().zip(&keyed).for_each(|(to, (_, triangle))| *to = *triangle);
                }
                self.settle(items);
            }
        }
    }

    /// Cuts a group that is in order.
    fn settle(mut self, items: &[Item]) {
        match self.orders[0] {
            [triangle] => self.nodes[0] = Node::Leaf(*triangle),
            _ => {
                let middle = self.cut(items);
                self.both(middle, |part| part.settle(items));
            }
        }
    }

    /// Puts the triangles left of the best cut between two of them before the others, or those right of it if there are fewer: a
    /// traversal visits the right side first, where the larger one makes contacts likelier. Says how many these are.
    fn cut(&mut self, items: &[Item]) -> usize {
        let count = self.spare.len();
        let legal = legal(count, self.height);
        let mut best = NONE;
        for (axis, order) in self.orders.iter().enumerate() {
            let mut reach = Reach::NONE;
            for (triangle, cost) in order.iter().zip(&mut *self.costs).rev() {
                reach = reach.union(&items[*triangle as usize].reach);
                *cost = reach.area();
            }
            reach = Reach::NONE;
            for cut in 1..count {
                reach = reach.union(&items[order[cut - 1] as usize].reach);
                if legal.contains(&cut) {
                    let cost = reach.area() * cut as f64 + self.costs[cut] * (count - cut) as f64;
                    best = better(best, (cost, cut.abs_diff(count - cut), axis, cut));
                }
            }
        }
        let (_, _, axis, cut) = best;
        let first_right = self.orders[axis][cut];
        let pivot = (key(items[first_right as usize].centre[axis]), first_right);
        let is_left = |triangle: u32| (key(items[triangle as usize].centre[axis]), triangle) < pivot;
        let turned = cut > count / 2;
        for (other, order) in self.orders.iter_mut().enumerate() {
            if other != axis {
                partition(order, self.spare, |triangle| is_left(triangle) != turned);
            } else if turned {
                order.rotate_left(cut);
            }
        }
        if turned { count - cut } else { cut }
    }

    /// The same for triangles in any order, between bins of equal width, if some cut is legal.
    fn cut_of_bins(&mut self, items: &[Item]) -> Option<usize> {
        let count = self.spare.len();
        let legal = legal(count, self.height);
        let [triangles, ..] = &mut self.orders;
        let centres = triangles.iter().fold(Reach::NONE, |reach, &triangle| {
            let [x, y, z] = items[triangle as usize].centre;
            reach.union(&Reach([x, y, z, -x, -y, -z]))
        });
        let least = [0, 1, 2].map(|axis| -centres.0[axis + 3]);
        let scale = [0, 1, 2].map(|axis| BINS as f64 / (centres.0[axis] - least[axis]));
        // What is no number goes to the first bin.
        let bin = |item: &Item, axis: usize| (((item.centre[axis] - least[axis]) * scale[axis]) as usize).min(BINS - 1);
        let mut bins = [[(Reach::NONE, 0); BINS]; 3];
        for &triangle in &**triangles {
            let item = &items[triangle as usize];
            for (axis, bins) in bins.iter_mut().enumerate() {
                let (reach, count) = &mut bins[bin(item, axis)];
                (*reach, *count) = (reach.union(&item.reach), *count + 1);
            }
        }
        let mut best = NONE;
        for (axis, bins) in bins.iter().enumerate() {
            let mut right = [0.0; BINS];
            let mut reach = Reach::NONE;
            for (cost, (of_bin, _)) in right.iter_mut().zip(bins).rev() {
                reach = reach.union(of_bin);
                *cost = reach.area();
            }
            reach = Reach::NONE;
            let mut cut = 0;
            for first_right in 1..BINS {
                let (of_bin, in_bin) = &bins[first_right - 1];
                (reach, cut) = (reach.union(of_bin), cut + in_bin);
                if legal.contains(&cut) {
                    let cost = reach.area() * cut as f64 + right[first_right] * (count - cut) as f64;
                    best = better(best, (cost, cut.abs_diff(count - cut), axis, first_right));
                }
            }
        }
        let (_, _, axis, first_right) = best;
        let cut: usize = bins[axis][..first_right].iter().map(|(_, in_bin)| in_bin).sum();
        let turned = cut > count / 2;
        partition(triangles, self.spare, |triangle| (bin(&items[triangle as usize], axis) < first_right) != turned);
        (first_right > 0).then_some(if turned { count - cut } else { cut })
    }

    /// Makes an inner node and both of its subtrees, the left one of the first so many triangles.
    fn both(self, middle: usize, make: impl Fn(Part<'_>) + Sync) {
        let Self { orders: [x, y, z], spare, costs, nodes, root, height } = self;
        let parallel = spare.len() >= PARALLEL;
        let second = root + 2 * middle as u32;
        let Some((parent, nodes)) = nodes.split_first_mut() else { return };
        *parent = Node::Inner(second);
        let ((x, of_x), (y, of_y), (z, of_z)) =
            (x.split_at_mut(middle), y.split_at_mut(middle), z.split_at_mut(middle));
        let ((spare, of_spare), (costs, of_costs)) = (spare.split_at_mut(middle), costs.split_at_mut(middle));
        let (nodes, of_nodes) = nodes.split_at_mut(2 * middle - 1);
        let height = height - 1;
        let left = Part { orders: [x, y, z], spare, costs, nodes, root: root + 1, height };
        let orders = [of_x, of_y, of_z];
        let right = Part { orders, spare: of_spare, costs: of_costs, nodes: of_nodes, root: second, height };
        if parallel {
            rayon::join(|| make(left), || make(right));
        } else {
            make(left);
            make(right);
        }
    }
}

/// A whole number that is ordered as a number is.
fn key(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    bits ^ ((bits >> 63) as u64 >> 1) as i64
}

/// Puts the triangles that are `first` before the others, both in the order in which they were.
fn partition(order: &mut [u32], spare: &mut [u32], first: impl Fn(u32) -> bool) {
    let (mut kept, mut moved) = (0, 0);
    for index in 0..order.len() {
        let triangle = order[index];
        // Without a branch, as which it is cannot be foreseen.
        (order[kept], spare[moved]) = (triangle, triangle);
        let is_first = usize::from(first(triangle));
        (kept, moved) = (kept + is_first, moved + 1 - is_first);
    }
    order[kept..].copy_from_slice(&spare[..moved]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::headlight;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

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
            let halves = halves(&boxes(mesh));
            let (mut triangles, height) = leaves(&halves, 0);
            assert_eq!(halves.len(), nodes.len());
            assert!((least.min(20)..=HEIGHT).contains(&height), "{height}");
            triangles.sort_unstable();
            assert!(triangles.into_iter().eq(0..mesh.faces().len() as u32));
        }
        assert!(nodes(&Mesh::default()).is_empty() && halves(&[]).is_empty());
    }

    /// The best tree, cut by cut: all triangles are sorted for each, along each axis.
    fn by_sorting(mesh: &Mesh, triangles: &mut [u32], height: u32, nodes: &mut Vec<Node>) {
        if let [triangle] = triangles {
            return nodes.push(Node::Leaf(*triangle));
        }
        let bounds = |t: u32| Bounds::of(mesh.faces()[t as usize].map(|v| &mesh.vertices()[v as usize]));
        let sort = |triangles: &mut [u32], axis: usize| {
            let centre = |t: u32| bounds(t).centre()[axis];
            triangles.sort_by(|p, q| centre(*p).total_cmp(&centre(*q)).then(p.cmp(q)));
        };
        let (count, most) = (triangles.len(), 1 << (height - 1));
        let mut best = NONE;
        for axis in 0..3 {
            sort(triangles, axis);
            for cut in (1..count).filter(|cut| *cut <= most && count - cut <= most) {
                let cost = |side: &[u32]| {
                    Reach::of(&side.iter().fold(Bounds::empty(), |sum, t| sum.union(&bounds(*t)))).area()
                        * side.len() as f64
                };
                let (left, right) = triangles.split_at(cut);
                best = better(best, (cost(left) + cost(right), cut.abs_diff(count - cut), axis, cut));
            }
        }
        let (_, _, axis, mut cut) = best;
        sort(triangles, axis);
        if cut > count / 2 {
            triangles.rotate_left(cut);
            cut = count - cut;
        }
        let (left, right) = triangles.split_at_mut(cut);
        let parent = nodes.len();
        nodes.push(Node::Inner(0));
        by_sorting(mesh, left, height - 1, nodes);
        nodes[parent] = Node::Inner(nodes.len() as u32);
        by_sorting(mesh, right, height - 1, nodes);
    }

    #[test]
    fn trees_of_few_triangles_are_the_best_cut_by_cut() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for round in 0..60 {
            let count = rng.random_range(1..200u32);
            let coarse = round % 3 == 0;
            let mut number = || match coarse {
                true => f64::from(rng.random_range(-2..=2)),
                false => rng.random_range(-1.0..1.0),
            };
            let vertices: Vec<Point3<f64>> = (0..3 * count).map(|_| Point3::from([(); 3].map(|()| number()))).collect();
            let faces = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
            let mesh = Mesh::new(vertices, faces).unwrap();
            let mut expected = vec![];
            by_sorting(&mesh, &mut (0..count).collect::<Vec<_>>(), HEIGHT, &mut expected);
            assert_eq!(nodes(&mesh), expected);
        }
        let doubling = row((0..200).map(|i| 2f64.powi(i)));
        let mut expected = vec![];
        by_sorting(&doubling, &mut (0..200).collect::<Vec<_>>(), HEIGHT, &mut expected);
        assert_eq!(nodes(&doubling), expected);
    }

    /// The cost of a tree: the areas of its inner nodes.
    fn cost(mesh: &Mesh, nodes: &[Node]) -> f64 {
        let mut boxes = vec![Bounds::empty(); nodes.len()];
        let mut sum = 0.0;
        for (index, node) in nodes.iter().enumerate().rev() {
            match *node {
                Node::Leaf(t) => {
                    boxes[index] = Bounds::of(mesh.faces()[t as usize].map(|v| &mesh.vertices()[v as usize]))
                }
                Node::Inner(right) => {
                    boxes[index] = boxes[index + 1].union(&boxes[right as usize]);
                    sum += Reach::of(&boxes[index]).area();
                }
            }
        }
        sum
    }

    #[test]
    fn bins_make_trees_that_are_about_as_good() {
        let mesh = headlight();
        let count = mesh.faces().len();
        let binned = split(&mesh, GROUP);
        let (mut triangles, height) = leaves(&binned, 0);
        triangles.sort_unstable();
        assert!(triangles.into_iter().eq(0..count as u32) && height <= HEIGHT);
        let (least, binned) = (cost(&mesh, &best(&mesh)), cost(&mesh, &binned));
        assert!(binned < 1.05 * least && binned != least, "{binned} {least}");
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
