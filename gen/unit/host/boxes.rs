//! Box tests for the pairs that the unit must not see.

use crate::dyadic::Dyadic;
use crate::pair::Verdict;

/// The exact coordinates of two meshes in one frame, each replaced by its rank along its axis: equal numbers have
/// equal ranks, so comparing ranks is comparing the numbers.
#[derive(Clone, Debug)]
pub(super) struct Boxes {
    a: Vec<[u32; 3]>,
    b: Vec<[u32; 3]>,
}

impl Boxes {
    pub fn new(a: &[[Dyadic; 3]], b: &[[Dyadic; 3]]) -> Self {
        let mut ranks = vec![[0; 3]; a.len() + b.len()];
        let vertices: Vec<&[Dyadic; 3]> = a.iter().chain(b).collect();
        for axis in 0..3 {
            let mut order: Vec<usize> = (0..vertices.len()).collect();
            order.sort_by(|&i, &j| vertices[i][axis].cmp(&vertices[j][axis]));
            for pair in order.windows(2) {
                let step = u32::from(vertices[pair[0]][axis] != vertices[pair[1]][axis]);
                ranks[pair[1]][axis] = ranks[pair[0]][axis] + step;
            }
        }
        let b = ranks.split_off(a.len());
        Self { a: ranks, b }
    }

    /// `separate` if the exact boxes of the two triangles are strictly disjoint, else `possibly-incorrect`.
    pub fn verdict(&self, a: [usize; 3], b: [usize; 3]) -> Verdict {
        let apart = (0..3).any(|axis| {
            let (a, b) = (a.map(|i| self.a[i][axis]), b.map(|i| self.b[i][axis]));
            let above = |x: [u32; 3], y: [u32; 3]| x.iter().min() > y.iter().max();
            above(a, b) || above(b, a)
        });
        if apart { Verdict::Separate } else { Verdict::PossiblyIncorrect }
    }
}
