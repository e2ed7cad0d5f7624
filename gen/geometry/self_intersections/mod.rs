//! Where a mesh intersects itself: the pairs of its triangles that have more in common than vertices and edges, for the
//! coordinates as given, exactly (docs/self-intersections.md has the kinds and the proofs).
//!
//! Vertices of equal coordinates are one, whatever their indices. Pairs whose boxes overlap come from a tree. Those without a common
//! vertex are decided by the retest in batches, the others by signs (`adjacent`), and what these leave, segments, points and
//! numbers at the ends of binary64, by questions that the retest answers ([`Question`]).

mod adjacent;
mod question;
#[cfg(test)]
mod tests;

// For the unit's host, which asks the exact unit.
#[doc(hidden)]
pub use question::{Faces, Question, points};

use crate::Points;
use crate::collide::Overlaps;
use crate::exact::{self, Exact};
use crate::mesh::Mesh;
use crate::software::retest::retest_batch;
use crate::software::robbins_whitesides::is_in_range;
use rayon::prelude::*;
use std::borrow::Borrow;
use std::convert::Infallible;

/// What is wrong with two triangles of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
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

    /// What is wrong with triangles that share no vertex, by how they lie.
    fn apart(answer: Exact) -> Option<Self> {
        match answer {
            Exact::Separate => None,
            Exact::Touch => Some(Self::Touching),
            Exact::Intersect => Some(Self::Crossing),
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

/// How much was looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize))]
pub struct Effort {
    /// Pairs whose boxes overlap.
    pub candidates: u64,
    /// Of these, pairs that share a vertex at least.
    pub neighbours: u64,
    /// Answers that the exact oracle contradicts; 0 if it was not asked.
    pub contradictions: u64,
}

impl Effort {
    /// Adds what other pairs took.
    pub fn add(&mut self, other: &Self) {
        self.candidates += other.candidates;
        self.neighbours += other.neighbours;
        self.contradictions += other.contradictions;
    }
}

/// All self-intersections of a mesh, ascending.
///
/// ```
/// use efsat_geometry::Mesh;
/// use efsat_geometry::self_intersections::{Kind, find};
///
/// // Two triangles with a common edge, and a third one through the first.
/// let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 0.5, 0.0]];
/// let mesh = Mesh::new(corners, [[0, 1, 2], [1, 3, 2], [4, 5, 6]])?;
/// let found: Vec<_> = find(&mesh).into_iter().map(|defect| (defect.pair, defect.kind)).collect();
/// assert_eq!(found, [((0, 2), Kind::Crossing)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn find(mesh: &Mesh) -> Vec<Defect> {
    let mut found = vec![];
    let Ok(()) = Search::new(mesh, false).each(|_, defects, _| {
        found.extend_from_slice(defects);
        Ok::<(), Infallible>(())
    });
    found.sort_unstable();
    found
}

/// What finds the self-intersections of a mesh.
pub struct Search {
    /// No two vertices are equal.
    mesh: Mesh,
    overlaps: Overlaps,
    /// Whether the predicates are exact for each vertex.
    in_range: Vec<bool>,
    /// Whether the exact oracle is asked about every pair, too.
    oracle: bool,
}

/// Triangles whose pairs are looked for in one go, at first and at most: as long as few defects are found, more are.
const TRIANGLES: (usize, usize) = (16, 1 << 10);
/// Defects in memory, about.
const DEFECTS: usize = 1 << 16;
/// Pairs for the retest at a time.
const BATCH: usize = 64;

impl Search {
    /// For a mesh whose coordinates are finite; with `oracle` every answer is compared with that of [`exact::pair`]. A mesh that is given
    /// away takes no memory from then on.
    pub fn new(given: impl Borrow<Mesh>, oracle: bool) -> Self {
        let mesh = Borrow::<Mesh>::borrow(&given).welded();
        drop(given);
        let overlaps = Overlaps::new(&mesh);
        let in_range = mesh.vertices().iter().map(|&vertex| is_in_range(&vertex.into())).collect();
        Self { mesh, overlaps, in_range, oracle }
    }

    /// The mesh on vertices no two of which are equal.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The number of triangles that are segments or points, exactly.
    pub fn degenerate(&self) -> usize {
        self.mesh.faces().iter().filter(|face| question::on_a_line(&self.mesh, **face)).count()
    }

    /// Calls `visit` with the number of triangles whose pairs with all later ones are done, the defects found since the last
    /// call, ascending, and what they took, until it fails. By all threads of the current pool; what `visit` sees in sum does not
    /// depend on their number, nor does memory grow with the number of pairs.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn each<E>(&self, mut visit: impl FnMut(usize, &[Defect], &Effort) -> Result<(), E>) -> Result<(), E> {
        let count = self.mesh.faces().len();
        let (mut done, mut step) = (0, TRIANGLES.0);
        while done < count {
            let next = count.min(done + step);
            let shares = (done as u32..next as u32).into_par_iter().fold(
                || Share::new(self),
                |mut share, triangle| {
                    share.take(triangle);
                    share
                },
            );
            let found: Vec<(Vec<Defect>, Effort)> = shares.map(Share::finish).collect();
            let mut effort = Effort::default();
            found.iter().for_each(|(_, of_share)| effort.add(of_share));
            let defects: Vec<Defect> = found.into_iter().flat_map(|(defects, _)| defects).collect();
            visit(next, &defects, &effort)?;
            step = if defects.len() > DEFECTS { (step / 2).max(1) } else { (2 * step).min(TRIANGLES.1) };
            done = next;
        }
        Ok(())
    }

    /// What is wrong with two triangles that share a vertex; `places` has a bit for each two corners that are the same.
    fn neighbours(&self, [a, b]: Faces, places: u32) -> Option<Kind> {
        self.by_signs([a, b], places).map_or_else(
            || Question::of(&self.mesh, [a, b]).kind(|faces| question::answer(&self.mesh, faces)),
            |meets| meets.then_some(Kind::Neighbours),
        )
    }

    /// The same by signs, if they can tell.
    fn by_signs(&self, [a, b]: Faces, places: u32) -> Option<bool> {
        if !a.iter().chain(&b).all(|vertex| self.in_range[*vertex as usize]) {
            return None;
        }
        let at = |vertex: u32| -> &[f64; 3] { &self.mesh.vertices()[vertex as usize].coords.data.0[0] };
        let corner = |place: u32| ((place / 3) as usize, (place % 3) as usize);
        let first = corner(places.trailing_zeros());
        let rest = places & (places - 1);
        let second = corner(rest.trailing_zeros());
        let after = |corner: usize| (corner + 1) % 3;
        match rest.count_ones() {
            0 => {
                let others = |face: [u32; 3], corner: usize| [face[after(corner)], face[after(after(corner))]].map(at);
                adjacent::with_vertex(at(a[first.0]), others(a, first.0), others(b, first.1))
            }
            // A repeated vertex makes a segment.
            1 if first.0 != second.0 && first.1 != second.1 => {
                let third = |face: [u32; 3], corners: [usize; 2]| at(face[3 - corners[0] - corners[1]]);
                let edge = [first.0, second.0];
                adjacent::with_edge(edge.map(|corner| at(a[corner])), third(a, edge), third(b, [first.1, second.1]))
            }
            _ => None,
        }
    }

    /// What the oracle says of two triangles.
    fn expected(&self, faces: Faces) -> Option<Kind> {
        Question::of(&self.mesh, faces)
            .kind(|faces| exact::pair(&points(&self.mesh, faces)).expect("meshes are finite"))
    }
}

/// A bit for each two corners of two faces that are the same vertex: number 3 i + j for corner i of the first and j of the second.
fn places([a, b]: Faces) -> u32 {
    let bit = |place: usize| u32::from(a[place / 3] == b[place % 3]) << place;
    (0..9).fold(0, |places, place| places | bit(place))
}

/// The pairs of some triangles with all later ones.
struct Share<'a> {
    search: &'a Search,
    /// Pairs without a common vertex that are still to be decided.
    apart: Vec<(u32, u32)>,
    points: Vec<Points>,
    answers: Vec<Exact>,
    defects: Vec<Defect>,
    effort: Effort,
}

impl<'a> Share<'a> {
    fn new(search: &'a Search) -> Self {
        let (apart, points, answers) = (vec![], vec![], vec![]);
        Self { search, apart, points, answers, defects: vec![], effort: Effort::default() }
    }

    /// Looks at the pairs of a triangle with all later ones.
    fn take(&mut self, triangle: u32) {
        let search = self.search;
        let faces = search.mesh.faces();
        let face = faces[triangle as usize];
        search.overlaps.after(triangle, |other| {
            let faces = [face, faces[other as usize]];
            self.effort.candidates += 1;
            let places = places(faces);
            if places == 0 {
                self.apart.push((triangle, other));
                self.points.push(points(&search.mesh, faces));
                if self.apart.len() == BATCH {
                    self.flush();
                }
            } else {
                self.effort.neighbours += 1;
                self.settle((triangle, other), search.neighbours(faces, places));
            }
        });
    }

    /// Decides the pairs that wait.
    fn flush(&mut self) {
        self.answers.clear();
        retest_batch(&self.points, &mut self.answers).expect("meshes are finite");
        for index in 0..self.apart.len() {
            self.settle(self.apart[index], Kind::apart(self.answers[index]));
        }
        self.apart.clear();
        self.points.clear();
    }

    fn settle(&mut self, pair: (u32, u32), kind: Option<Kind>) {
        if self.search.oracle {
            let faces = [pair.0, pair.1].map(|triangle| self.search.mesh.faces()[triangle as usize]);
            self.effort.contradictions += u64::from(self.search.expected(faces) != kind);
        }
        self.defects.extend(kind.map(|kind| Defect { pair, kind }));
    }

    fn finish(mut self) -> (Vec<Defect>, Effort) {
        self.flush();
        self.defects.sort_unstable();
        (self.defects, self.effort)
    }
}
