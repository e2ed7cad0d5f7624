//! The self-intersections of a mesh on a grid, from answers of the exact unit (docs/self-intersections.md). Those of a mesh as it
//! is given need no unit: [`efsat_geometry::self_intersections`].

#[cfg(test)]
mod tests;

use super::{Host, loose_pair};
use crate::golden::Golden;
use crate::pair::{Pose, Verdict};
use crate::params::Params;
use efsat_geometry::collide::{Candidates, Pose as ScenePose, Tree};
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::self_intersections::{self as pairs, Defect, Effort, Faces, Question};
use efsat_geometry::software::retest::retest;
use rayon::prelude::*;
use serde::Serialize;

/// How much was asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Asked {
    /// Pairs of triangles, segments or points that the unit decided.
    pub asked: u64,
    /// Those that did not fit the unit, which the host decided.
    pub by_host: u64,
}

impl Asked {
    /// Adds what was asked about other pairs.
    pub fn add(&mut self, other: &Self) {
        self.asked += other.asked;
        self.by_host += other.by_host;
    }
}

/// What asks and counts.
pub struct Checker<'a> {
    mesh: &'a Mesh,
    params: &'a Params,
    golden: Golden,
    /// Whether the exact oracle is asked too.
    oracle: bool,
}

/// Why no number is refused.
const FINITE: &str = "meshes are finite";

/// Pairs that are looked at in one go.
const BATCH: usize = 4096;

impl<'a> Checker<'a> {
    /// For a mesh on a grid, and an exact unit without transform.
    pub fn new(mesh: &'a Mesh, params: &'a Params, oracle: bool) -> Self {
        Self { mesh, params, golden: Golden::new(params), oracle }
    }

    /// Calls `visit` with the pairs whose boxes overlap, in ascending order, in one piece or several, until it fails.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn candidates<E>(&self, mut visit: impl FnMut(&[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        let tree = Tree::new(self.mesh);
        Candidates::new(&tree, &tree, &ScenePose::identity()).pieces(|pairs| {
            let each_once: Vec<(u32, u32)> = pairs.iter().copied().filter(|(p, q)| p < q).collect();
            visit(&each_once)
        })
    }

    /// The defects among some pairs, ascending as the pairs are, and what they took.
    pub fn check(&self, pairs: &[(u32, u32)]) -> (Vec<Defect>, Effort, Asked) {
        let batches: Vec<(Vec<Defect>, Effort, Asked)> = pairs
            .par_chunks(BATCH)
            .map(|pairs| {
                let (mut defects, mut effort, mut asked) = (vec![], Effort::default(), Asked::default());
                for &pair in pairs {
                    let question = self.question(pair);
                    effort.candidates += 1;
                    effort.neighbours += u64::from(!matches!(question, Question::How(_)));
                    let kind = question.kind(|faces| self.answer(faces, &mut effort, &mut asked));
                    defects.extend(kind.map(|kind| Defect { pair, kind }));
                }
                (defects, effort, asked)
            })
            .collect();
        let (mut defects, mut effort, mut asked) = (vec![], Effort::default(), Asked::default());
        for batch in batches {
            defects.extend(batch.0);
            effort.add(&batch.1);
            asked.add(&batch.2);
        }
        (defects, effort, asked)
    }

    fn question(&self, (p, q): (u32, u32)) -> Question {
        Question::of(self.mesh, [p, q].map(|face| self.mesh.faces()[face as usize]))
    }

    /// The pairs that the unit is asked about for two triangles of the mesh, in units of the grid.
    pub fn asked(&self, pair: (u32, u32)) -> Vec<[[f64; 3]; 6]> {
        self.question(pair).asked().iter().map(|faces| pairs::points(self.mesh, *faces)).collect()
    }

    /// How two triangles lie, which may be segments or points: as the unit says, or the host what does not fit it.
    fn answer(&self, faces: Faces, effort: &mut Effort, asked: &mut Asked) -> Exact {
        let points = pairs::points(self.mesh, faces);
        let answer = if let Host::Unit(pair) = loose_pair(&points, self.params).expect(FINITE) {
            asked.asked += 1;
            let outcome = self.golden.outcome(&Pose::identity(self.params), &pair);
            match outcome.verdict {
                Verdict::Separate => Exact::Separate,
                _ if outcome.overlapping & 1 == 1 => Exact::Intersect,
                _ => Exact::Touch,
            }
        } else {
            asked.by_host += 1;
            retest(&points).expect(FINITE)
        };
        effort.contradictions += u64::from(self.oracle && exact::pair(&points) != Ok(answer));
        answer
    }
}
