//! The DOPs of two siblings side by side, so that four pairs of nodes are tested at once.
//!
//! A *family* holds the two children of an inner node, or the root of a tree alone. Its numbers are direction after direction,
//! first the offset of the first child, then that of the second, in as many groups of [`LANES`] as that takes; what is left over is
//! 0. So one sum of two groups compares four directions of both children, and another one, with the children of B exchanged,
//! compares the other two pairs.

use super::Directions;
use crate::collide::split::Node;

/// Numbers in a group: those of the widest vector register that is used.
pub(super) const LANES: usize = 8;

/// One group of a family's offsets.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Group(pub [i32; LANES]);

impl Group {
    pub const ZERO: Self = Self([0; LANES]);
}

/// Groups of a family.
pub(super) const fn groups(directions: Directions) -> usize {
    (2 * directions.count()).div_ceil(LANES)
}

/// Which children of which family: a bit for each child in the lowest two, the number of the family above them. Both children
/// stand for the inner node that they are the children of, a single one for itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Members(u32);

impl Members {
    /// Both children of an inner node.
    pub fn both(family: u32) -> Self {
        Self(family << 2 | 3)
    }

    /// One child.
    pub fn one(family: u32, child: u32) -> Self {
        Self(family << 2 | 1 << child)
    }

    /// The number of the family.
    #[inline(always)]
    pub fn family(self) -> usize {
        (self.0 >> 2) as usize
    }

    /// Whether it is one child: 1 or 0.
    #[inline(always)]
    pub fn single(self) -> usize {
        (!(self.0 & self.0 >> 1) & 1) as usize
    }

    /// The number of the child, if it is one.
    pub fn child(self) -> usize {
        (self.0 >> 1 & 1) as usize
    }

    /// Which pairs with those of another family there are: bit 2 p + q for children p and q.
    #[inline(always)]
    pub fn pairs(self, other: Self) -> u32 {
        const ROWS: [u32; 4] = [0b0000, 0b0011, 0b1100, 0b1111];
        const COLUMNS: [u32; 4] = [0b0000, 0b0101, 0b1010, 0b1111];
        ROWS[(self.0 & 3) as usize] & COLUMNS[(other.0 & 3) as usize]
    }
}

/// Where nodes are: for each node, in their order, its place as a child, and what stands for it when it is opened. The root is the
/// only child of the last family.
pub(super) fn members(nodes: &[Node]) -> Vec<(Members, Members)> {
    let mut members = vec![(Members::one(nodes.len() as u32 / 2, 0), Members::default()); nodes.len()];
    let mut families = 0;
    for (index, node) in nodes.iter().enumerate() {
        members[index].1 = match *node {
            Node::Leaf(_) => members[index].0,
            Node::Inner(right) => {
                members[index + 1].0 = Members::one(families, 0);
                members[right as usize].0 = Members::one(families, 1);
                families += 1;
                Members::both(families - 1)
            }
        };
    }
    members
}

/// Which pairs of children overlap in all directions, with the bits of [`Members::pairs`]; touching counts. `there` has its offsets
/// at the places of the opposite directions. Apart in direction h means that the greatest projection of one on h is below the
/// least of the other, which is minus its offset on the opposite of h.
#[inline(always)]
pub(super) fn overlap<const GROUPS: usize>(here: &[Group; GROUPS], there: &[Group; GROUPS]) -> u32 {
    // A sum that is negative leaves its sign: all are made without a branch between them.
    let (mut like, mut unlike) = ([0; LANES], [0; LANES]);
    for (Group(here), Group(there)) in here.iter().zip(there) {
        for lane in 0..LANES {
            like[lane] |= here[lane] + there[lane];
            unlike[lane] |= here[lane] + there[lane ^ 1];
        }
    }
    let together = |signs: [i32; LANES], child: usize| {
        u32::from(signs[child] | signs[child + 2] | signs[child + 4] | signs[child + 6] >= 0)
    };
    together(like, 0) | together(unlike, 0) << 1 | together(unlike, 1) << 2 | together(like, 1) << 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dops_that_touch_overlap() {
        // From -3 to 5, from 0 to 2 and at 0 on the three axes; the other one begins where that ends, or ends where that begins.
        let here = [5, 3, 2, 0, 0, 0];
        // Far away in every direction but one.
        let nowhere = [-9; 6];
        let family = |first: [i32; 6], second: [i32; 6]| {
            let mut groups = [Group::ZERO; 2];
            for (index, pair) in first.into_iter().zip(second).flat_map(|(x, y)| [x, y]).enumerate() {
                groups[index / LANES].0[index % LANES] = pair;
            }
            groups
        };
        let overlap = |[a, b, c, d]: [i32; 4]| {
            let there = [b, a, d, c, 0, 0];
            let place = |p: usize, q: usize| {
                let put = |dop, child| if child == 0 { family(dop, nowhere) } else { family(nowhere, dop) };
                overlap(&put(here, p), &put(there, q))
            };
            let found: Vec<u32> = (0..4).map(|pair| place(pair >> 1, pair & 1)).collect();
            assert!(found.iter().enumerate().all(|(pair, bits)| bits & !(1 << pair) == 0), "{found:?}");
            let bits = found.into_iter().fold(0, |all, bits| all | bits);
            assert!(bits == 0 || bits == 0b1111);
            bits != 0
        };
        assert!(overlap([9, -5, 1, 1]) && overlap([-3, 9, 1, 1]));
        assert!(!overlap([9, -6, 1, 1]) && !overlap([-4, 9, 1, 1]));
        assert!(overlap([0, 0, 0, 7]) && !overlap([0, 0, -1, 7]));
        assert!(overlap([0, 0, 7, -2]) && !overlap([0, 0, 7, -3]));
    }

    #[test]
    fn members_stand_for_nodes() {
        // Two triangles on the left, one on the right.
        let nodes = [Node::Inner(4), Node::Inner(3), Node::Leaf(0), Node::Leaf(1), Node::Leaf(2)];
        let found = members(&nodes);
        let places = [(2, 0), (0, 0), (1, 0), (1, 1), (0, 1)].map(|(family, child)| Members::one(family, child));
        assert!(found.iter().map(|(place, _)| *place).eq(places));
        assert_eq!(found.iter().map(|(_, open)| open.single()).collect::<Vec<_>>(), [0, 0, 1, 1, 1]);
        assert_eq!((found[0].1, found[1].1, found[4].1), (Members::both(0), Members::both(1), places[4]));
        assert_eq!(places.map(Members::child), [0, 0, 0, 1, 1]);
        let pairs = |x: Members, y: Members| x.pairs(y);
        assert_eq!(pairs(Members::both(0), Members::both(7)), 0b1111);
        assert_eq!([0, 1].map(|p| [0, 1].map(|q| pairs(places[p * 4], places[q + 2]))), [[1, 2], [4, 8]]);
        assert!(members(&[]).is_empty());
    }
}
