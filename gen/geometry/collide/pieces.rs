//! Pairs of triangles in pieces, so that memory does not grow with their number: two meshes of n triangles that all lie
//! at one place have n^2 of them.

use super::split::Node;

/// Pairs that are looked for at once. Where there are more, they are found triangle by triangle of A, and handed on when
/// there are so many of them: memory is that for this number and for the triangles of B.
pub(crate) const MOST: usize = 1 << 16;

/// Calls `visit` with the pairs of one triangle of A after the other, some triangles at a time, until it fails. `nodes`
/// are those of A's tree; `row` appends the pairs of a leaf in any order.
pub(super) fn rows<E>(
    nodes: &[Node],
    mut row: impl FnMut(usize, &mut Vec<(u32, u32)>),
    mut visit: impl FnMut(&[(u32, u32)]) -> Result<(), E>,
) -> Result<(), E> {
    let mut leaves = vec![0; nodes.len().div_ceil(2)];
    for (index, node) in nodes.iter().enumerate() {
        if let Node::Leaf(triangle) = node {
            leaves[*triangle as usize] = index;
        }
    }
    let mut pairs = vec![];
    for leaf in leaves {
        let start = pairs.len();
        row(leaf, &mut pairs);
        pairs[start..].sort_unstable();
        if pairs.len() >= MOST {
            visit(&pairs)?;
            pairs.clear();
        }
    }
    visit(&pairs)
}
