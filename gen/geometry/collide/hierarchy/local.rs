//! Trees of local blocks: the volumes of two children relative to an origin near them, in few bits (docs/engine.md).

use super::{Directions, Placement};
use crate::collide::split::{Node, best, offsets};
use crate::mesh::Mesh;

/// The number formats of local blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalFormat {
    /// The directions of a volume.
    pub directions: Directions,
    /// The grid has steps of 2^-this, at most 27.
    pub grid_fraction: u32,
    /// Origins have steps of 2^-this, at most that of the grid.
    pub origin_fraction: u32,
    /// The greatest magnitude of a code.
    pub most: i32,
}

/// The greatest exponent of a block.
const EXPONENT: u32 = 15;

/// What a child of a block is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LocalChild {
    /// There is none: the mesh has fewer than two triangles.
    None,
    /// A triangle, by its place in [`LocalTree::triangles`].
    Leaf(u32),
    /// The children of this block, which comes later.
    Inner(u32),
}

/// The volumes of the two children of a node: child c holds all y with n_i . (y - o) <= codes_i 2^exponent G.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LocalBlock {
    /// The children, the one with more triangles first.
    pub children: [LocalChild; 2],
    /// o, in steps of 2^-origin_fraction.
    pub origin: [i32; 3],
    /// At most 15.
    pub exponent: u32,
    /// One code for each direction of each child; zeros for one that is not there.
    pub codes: [Vec<i32>; 2],
}

/// A binary tree over the triangles of a mesh, whose blocks are fitted one by one.
#[derive(Clone, Debug)]
pub struct LocalTree {
    format: LocalFormat,
    nodes: Vec<Node>,
    /// The number of each node among the inner ones, or among the leaves.
    numbers: Vec<u32>,
    /// For each node and direction the least whole number of steps of the grid that holds its triangles.
    offsets: Vec<i32>,
}

impl LocalTree {
    /// Builds the tree of a mesh inside its cube; nodes are split as those of the other trees, but without bins: an image is built once
    /// and asked often.
    ///
    /// # Panics
    /// If the placement does not hold the mesh.
    pub fn new(mesh: &Mesh, placement: &Placement, format: LocalFormat) -> Self {
        let nodes = best(mesh);
        let (mut inner, mut leaves) = (0, 0);
        let number = |node: &Node| {
            let count = if matches!(node, Node::Inner(_)) { &mut inner } else { &mut leaves };
            *count += 1;
            *count - 1
        };
        let numbers = nodes.iter().map(number).collect();
        let mut tree = Self { format, nodes, numbers, offsets: vec![] };
        tree.offsets = tree.fit(mesh, placement);
        tree
    }

    /// The offsets of all nodes, from the leaves up. A ceiling of a maximum is the maximum of the ceilings, so that those of the
    /// vertices do.
    fn fit(&self, mesh: &Mesh, placement: &Placement) -> Vec<i32> {
        let LocalFormat { directions, grid_fraction, .. } = self.format;
        let k = directions.count();
        let of_vertex = |v: &nalgebra::Point3<f64>| {
            let x = [v.x, v.y, v.z];
            (0..k).map(move |index| placement.offset(x, directions.vector(index), grid_fraction))
        };
        let of_vertices: Vec<i32> = mesh.vertices().iter().flat_map(of_vertex).collect();
        offsets(&self.nodes, mesh, &of_vertices, k)
    }

    /// The triangles of the mesh in the order of the leaves.
    pub fn triangles(&self) -> impl Iterator<Item = u32> {
        self.nodes.iter().filter_map(|node| match *node {
            Node::Leaf(triangle) => Some(triangle),
            Node::Inner(_) => None,
        })
    }

    /// The number of blocks: one less than triangles, and at least one.
    pub fn block_count(&self) -> u32 {
        (self.nodes.len() as u32 / 2).max(1)
    }

    /// The most links from the root's block to a triangle.
    pub fn height(&self) -> u32 {
        let mut heights = vec![0; self.nodes.len()];
        for (node, kind) in self.nodes.iter().enumerate().rev() {
            if let Node::Inner(right) = *kind {
                heights[node] = 1 + heights[node + 1].max(heights[right as usize]);
            }
        }
        heights.first().map_or(0, |&height: &u32| height.max(1))
    }

    /// The blocks in order: every child that is a block has a greater number than its parent.
    pub fn blocks(&self) -> impl Iterator<Item = LocalBlock> {
        let roots = (self.nodes.len() < 2).then(|| self.block([(!self.nodes.is_empty()).then_some(0), None]));
        let inner = self.nodes.iter().enumerate().filter_map(|(node, kind)| match *kind {
            Node::Leaf(_) => None,
            // Leaves that come early are likely contacts, and the left child is opened first: it is the larger one.
            Node::Inner(right) => Some(self.block([Some(right as usize), Some(node + 1)])),
        });
        roots.into_iter().chain(inner)
    }

    /// The block of two nodes.
    fn block(&self, nodes: [Option<usize>; 2]) -> LocalBlock {
        let LocalFormat { directions, grid_fraction, origin_fraction, most } = self.format;
        let k = directions.count();
        let of = |node: usize| &self.offsets[node * k..][..k];
        let present = || nodes.into_iter().flatten();
        // The centre of the box around both, rounded to the steps of an origin.
        let drop = grid_fraction - origin_fraction;
        let limit = (1 << origin_fraction) - 1;
        let origin = [0, 1, 2].map(|axis| {
            let side = |index: usize| present().map(|node| i64::from(of(node)[index])).max().unwrap_or(0);
            let twice = side(2 * axis) - side(2 * axis + 1);
            ((twice + (1 << drop)) >> (drop + 1)).clamp(-limit, limit) as i32
        });
        let local = |node: usize| {
            let distance = move |(index, offset): (usize, &i32)| {
                let along = directions.vector(index).into_iter().zip(origin).map(|(n, o)| i64::from(n) * i64::from(o));
                i64::from(*offset) - (along.sum::<i64>() << drop)
            };
            of(node).iter().enumerate().map(distance)
        };
        // Ceilings compose, so that those of whole numbers of steps are those of the real numbers behind them.
        let code = |distance: i64, exponent: u32| -(-distance >> exponent);
        let (least, greatest) =
            present().flat_map(local).fold((0, 0), |(least, greatest), x| (x.min(least), x.max(greatest)));
        let fits = |&exponent: &u32| {
            let most = i64::from(most);
            code(greatest, exponent) <= most && code(least, exponent) >= -most
        };
        let exponent = (0..=EXPONENT).find(fits).expect("the greatest exponent reaches across the cube");
        let child = |node: Option<usize>| match node.map(|node| (self.nodes[node], self.numbers[node])) {
            None => LocalChild::None,
            Some((Node::Leaf(_), number)) => LocalChild::Leaf(number),
            Some((Node::Inner(_), number)) => LocalChild::Inner(number),
        };
        let codes = nodes.map(|node| match node {
            None => vec![0; k],
            Some(node) => local(node).map(|distance| code(distance, exponent) as i32).collect(),
        });
        LocalBlock { children: nodes.map(child), origin, exponent, codes }
    }
}
