//! The self-intersections of a mesh on a grid, from answers of the exact unit (docs/self-intersections.md).

mod adjacent;
#[cfg(test)]
mod tests;

use super::{Host, loose_pair};
use crate::golden::{Golden, Pose, Verdict};
use crate::params::Params;
use adjacent::Question;
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::{Candidates, Pose as ScenePose, Tree};
use rayon::prelude::*;
use serde::Serialize;

/// What is wrong with two triangles of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// They share no vertex, and the relative interiors meet.
    Crossing,
    /// They share no vertex, and have a common point.
    Touching,
    /// They share a vertex or an edge, and have a common point elsewhere.
    Neighbours,
    /// They have the same three vertices.
    Duplicate,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Crossing, Self::Touching, Self::Neighbours, Self::Duplicate];

    /// What a list calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Crossing => "crossing",
            Self::Touching => "touching",
            Self::Neighbours => "neighbours",
            Self::Duplicate => "duplicate",
        }
    }
}

/// Two triangles, by their numbers, the lesser one first, and what is wrong with them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Defect {
    /// The triangles.
    pub pair: (u32, u32),
    /// What is wrong.
    pub kind: Kind,
}

/// How much was asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Effort {
    /// Pairs whose boxes overlap.
    pub candidates: u64,
    /// Of these, pairs that share a vertex at least.
    pub neighbours: u64,
    /// Pairs of triangles, segments or points that the unit decided.
    pub asked: u64,
    /// Those that did not fit the unit, which the host decided.
    pub by_host: u64,
    /// Answers of the unit that the exact oracle contradicts; 0 if it was not asked.
    pub contradictions: u64,
}

impl Effort {
    /// Adds what other pairs took.
    pub fn add(&mut self, other: &Self) {
        self.candidates += other.candidates;
        self.neighbours += other.neighbours;
        self.asked += other.asked;
        self.by_host += other.by_host;
        self.contradictions += other.contradictions;
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
    pub fn check(&self, pairs: &[(u32, u32)]) -> (Vec<Defect>, Effort) {
        let batches: Vec<(Vec<Defect>, Effort)> = pairs
            .par_chunks(BATCH)
            .map(|pairs| {
                let mut effort = Effort::default();
                let kinds = pairs.iter().map(|pair| (*pair, self.kind(*pair, &mut effort)));
                let defects = kinds.filter_map(|(pair, kind)| Some(Defect { pair, kind: kind? })).collect();
                (defects, effort)
            })
            .collect();
        let mut effort = Effort::default();
        batches.iter().for_each(|(_, of_batch)| effort.add(of_batch));
        (batches.into_iter().flat_map(|(defects, _)| defects).collect(), effort)
    }

    /// What is wrong with two triangles.
    fn kind(&self, (p, q): (u32, u32), effort: &mut Effort) -> Option<Kind> {
        let faces = self.faces((p, q));
        effort.candidates += 1;
        effort.neighbours += u64::from(shares(faces));
        match self.question((p, q)) {
            Question::How => match self.answer(faces, effort) {
                Exact::Separate => None,
                Exact::Touch => Some(Kind::Touching),
                Exact::Intersect => Some(Kind::Crossing),
            },
            Question::Duplicate => Some(Kind::Duplicate),
            Question::Crosses => (self.answer(faces, effort) == Exact::Intersect).then_some(Kind::Neighbours),
            Question::Meets(parts) => {
                // All of them are asked, so that as many pairs are counted as `asked` lists.
                let meets = |parts: &&[[u32; 3]; 2]| self.answer(**parts, effort) != Exact::Separate;
                (parts.iter().filter(meets).count() > 0).then_some(Kind::Neighbours)
            }
        }
    }

    fn faces(&self, (p, q): (u32, u32)) -> [[u32; 3]; 2] {
        [p, q].map(|face| self.mesh.faces[face as usize])
    }

    fn question(&self, pair: (u32, u32)) -> Question {
        let faces = self.faces(pair);
        if shares(faces) { adjacent::question(self.mesh, faces) } else { Question::How }
    }

    /// The pairs that the unit is asked about for two triangles of the mesh, in units of the grid.
    pub fn asked(&self, pair: (u32, u32)) -> Vec<[[f64; 3]; 6]> {
        let asked = match self.question(pair) {
            Question::Duplicate => vec![],
            Question::How | Question::Crosses => vec![self.faces(pair)],
            Question::Meets(parts) => parts,
        };
        asked.into_iter().map(|faces| self.points(faces)).collect()
    }

    fn points(&self, faces: [[u32; 3]; 2]) -> [[f64; 3]; 6] {
        let mut corners = faces.iter().flatten().map(|vertex| self.mesh.vertices[*vertex as usize].into());
        std::array::from_fn(|_| corners.next().expect("two triangles have six corners"))
    }

    /// How two triangles lie, which may be segments or points: as the unit says, or the host what does not fit it.
    fn answer(&self, faces: [[u32; 3]; 2], effort: &mut Effort) -> Exact {
        let points = self.points(faces);
        let Host::Unit(pair) = loose_pair(&points, self.params).expect("readers refuse what is not finite") else {
            effort.by_host += 1;
            return exact::pair(&points);
        };
        effort.asked += 1;
        let outcome = self.golden.outcome(&Pose::identity(self.params), &pair);
        let answer = match outcome.verdict {
            Verdict::Separate => Exact::Separate,
            _ if outcome.overlapping & 1 == 1 => Exact::Intersect,
            _ => Exact::Touch,
        };
        effort.contradictions += u64::from(self.oracle && exact::pair(&points) != answer);
        answer
    }
}

/// Whether two faces have a common vertex.
fn shares([a, b]: [[u32; 3]; 2]) -> bool {
    a.iter().any(|vertex| b.contains(vertex))
}
