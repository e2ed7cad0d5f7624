//! The pairs of a scene that a campaign asks about: drawn once, with their exact answers, and asked for every point.

use efsat_geometry::Points;
use efsat_geometry::exact::{self, Relation};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::{Meeting, Scene};
use efsat_unit::dyadic::Dyadic;
use efsat_unit::golden::{Golden, Numbers};
use efsat_unit::host::{Answer, Host, SceneHost};
use efsat_unit::pair::{Outcome, Pose};
use efsat_unit::params::Params;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::ops::Range;

/// Why no number is refused.
const FINITE: &str = "meshes and poses are finite";

/// The most pairs that are kept: 24 bytes each.
pub const MOST: u64 = 1 << 24;

/// How many of a scene's candidate pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amount {
    /// Every one of them.
    All,
    /// So many, each as likely as any other; all if there are not that many.
    Some(u64),
}

impl std::fmt::Display for Amount {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::All => f.write_str("all"),
            Self::Some(n) => write!(f, "{n}"),
        }
    }
}

/// A scene of which all pairs are asked for, and there are too many.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("--pairs all: the scene has more than {MOST} candidate pairs; expected --pairs N up to {MOST}")]
pub struct TooMany;

/// The pairs that were drawn of one meeting.
struct Met {
    /// Rotation, row by row, and translation of B as seen from A.
    m: [[f64; 3]; 3],
    t: [f64; 3],
    meeting: Meeting,
    range: Range<usize>,
}

/// Pairs of a scene with their exact answers, in the order of the scene.
pub struct Pairs<'a> {
    meshes: Vec<&'a Mesh>,
    vertices: Vec<Vec<[f64; 3]>>,
    met: Vec<Met>,
    faces: Vec<(u32, u32)>,
    relations: Vec<Relation>,
    /// Candidate pairs of the whole scene.
    pub candidates: u64,
    /// What coordinates are multiplied by for software: the power of two that brings the meshes into [-1, 1]^3.
    unit: f64,
}

impl<'a> Pairs<'a> {
    /// Draws pairs and answers them exactly. The same scene, amount and seed give the same pairs, whatever the number of
    /// threads.
    ///
    /// # Errors
    /// A scene with too many pairs, if all are asked for.
    pub fn draw(scene: &'a Scene, amount: Amount, seed: u64) -> Result<Self, TooMany> {
        let (meshes, _) = scene.meshes();
        let points = |mesh: &&Mesh| mesh.vertices().iter().map(|v| [v.x, v.y, v.z]).collect();
        let vertices: Vec<Vec<[f64; 3]>> = meshes.iter().map(points).collect();
        let near = scene.near();
        let mut reservoir = Reservoir::new(amount, seed);
        let mut meetings = vec![];
        near.try_for_each(|meeting, pairs| {
            // Very many pairs come in pieces.
            if meetings.last() != Some(meeting) {
                meetings.push(meeting.clone());
            }
            pairs.iter().try_for_each(|&pair| reservoir.offer(meetings.len() as u32 - 1, pair))
        })?;
        let candidates = reservoir.seen;
        let drawn = reservoir.sorted();
        let mut met: Vec<Met> = vec![];
        for group in drawn.chunk_by(|x, y| x.meeting == y.meeting) {
            let begin = met.last().map_or(0, |last| last.range.end);
            let meeting = meetings[group[0].meeting as usize].clone();
            met.push(Met {
                m: meeting.pose.rows(),
                t: meeting.pose.translation().into(),
                meeting,
                range: begin..begin + group.len(),
            });
        }
        let faces = drawn.iter().map(|pair| pair.faces).collect();
        let unit = unit(scene);
        let mut pairs = Self { meshes, vertices, met, faces, relations: vec![], candidates, unit };
        let answered = |met: &Met| met.range.clone().map(|pair| pairs.relation_of(met, pair)).collect::<Vec<_>>();
        pairs.relations = pairs.met.par_iter().flat_map_iter(answered).collect();
        Ok(pairs)
    }

    /// The number of pairs drawn.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Whether the scene has no candidate pairs.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// The exact answer of a pair.
    pub fn relation(&self, pair: usize) -> Relation {
        self.relations[pair]
    }

    /// The exact answers of all pairs, in their order.
    pub fn relations(&self) -> &[Relation] {
        &self.relations
    }

    fn relation_of(&self, met: &Met, pair: usize) -> Relation {
        let [a, b] = self.corners(met, pair);
        exact::posed_relation(&a, &b, &met.m, &met.t).expect(FINITE)
    }

    fn vertices_of(&self, met: &Met, pair: usize) -> [[u32; 3]; 2] {
        let (a, b) = self.faces[pair];
        [self.meshes[met.meeting.meshes[0]].faces()[a as usize], self.meshes[met.meeting.meshes[1]].faces()[b as usize]]
    }

    /// The vertices of a pair as in the meshes, each triangle in its own frame.
    fn corners(&self, met: &Met, pair: usize) -> [[[f64; 3]; 3]; 2] {
        let of = self.vertices_of(met, pair);
        [0, 1].map(|side| of[side].map(|vertex| self.vertices[met.meeting.meshes[side]][vertex as usize]))
    }

    /// The meeting that a pair belongs to.
    fn met(&self, pair: usize) -> &Met {
        let at = self.met.partition_point(|met| met.range.end <= pair);
        &self.met[at]
    }

    /// A pair as software reads it: in one frame, B's vertices transformed and rounded, scaled to the cube [-1, 1]^3.
    pub fn points(&self, pair: usize) -> Points {
        let met = self.met(pair);
        let [a, b] = self.corners(met, pair);
        let image = |x: [f64; 3]| -> [f64; 3] { met.meeting.pose.image(&x.into()).into() };
        let [p, q, r] = a;
        let [s, t, u] = b.map(image);
        // The factor is a power of two and rounds nothing.
        [p, q, r, s, t, u].map(|point| point.map(|x| self.unit * x))
    }

    /// So many pairs at most of those at these places, evenly spread.
    pub fn spread(places: &[u32], most: usize) -> Vec<u32> {
        let count = places.len().min(most);
        (0..count).map(|i| places[i * places.len() / count]).collect()
    }
}

/// The pairs of a campaign asked with one parameter set.
pub(super) struct Asked<'a> {
    pairs: &'a Pairs<'a>,
    golden: Golden,
    hosts: HashMap<[usize; 2], SceneHost>,
}

impl<'a> Asked<'a> {
    pub fn new(pairs: &'a Pairs<'a>, params: &Params) -> Self {
        let mut hosts = HashMap::new();
        for &[a, b] in pairs.met.iter().map(|met| &met.meeting.meshes) {
            hosts
                .entry([a, b])
                .or_insert_with(|| SceneHost::new(&pairs.vertices[a], &pairs.vertices[b], params).expect(FINITE));
        }
        Self { pairs, golden: Golden::new(params), hosts }
    }

    /// What `answer` makes of every pair, in order.
    pub fn all<T: Send>(&self, of: impl Fn(Answer) -> T + Sync) -> Vec<T> {
        let answers = |met: &Met| {
            let posed = self.hosts[&met.meeting.meshes].pose(&met.m, &met.t).expect(FINITE);
            let one = |pair| {
                let [a, b] = self.pairs.vertices_of(met, pair);
                of(posed.pair(a, b).answer(&self.golden, &posed.pose))
            };
            met.range.clone().map(one).collect::<Vec<T>>()
        };
        self.pairs.met.par_iter().flat_map_iter(answers).collect()
    }

    /// A pair as the unit reads it, and the pose; the pair alone if the host decides it.
    pub fn inputs(&self, pair: usize) -> (Pose, Host) {
        let met = self.pairs.met(pair);
        let posed = self.hosts[&met.meeting.meshes].pose(&met.m, &met.t).expect(FINITE);
        let [a, b] = self.pairs.vertices_of(met, pair);
        (posed.pose, posed.pair(a, b))
    }

    /// The real numbers behind the inputs of a pair.
    pub fn numbers(&self, pair: usize) -> Numbers<Dyadic> {
        let met = self.pairs.met(pair);
        let numbers = self.hosts[&met.meeting.meshes].numbers(&met.m, &met.t, &self.pairs.corners(met, pair));
        numbers.expect(FINITE)
    }

    /// What the unit says of a pair, with the flags of all axes; none if the host decides it.
    pub fn outcome(&self, pair: usize) -> Option<Outcome> {
        match self.inputs(pair) {
            (pose, Host::Unit(pair)) => Some(self.golden.outcome(&pose, &pair)),
            (_, Host::Decided(_)) => None,
        }
    }
}

/// A pair that was drawn.
#[derive(Clone, Copy)]
struct Drawn {
    order: u64,
    meeting: u32,
    faces: (u32, u32),
}

/// Keeps a uniform sample of what it is offered (J. S. Vitter's algorithm R, 1985).
struct Reservoir {
    capacity: u64,
    all: bool,
    rng: ChaCha8Rng,
    kept: Vec<Drawn>,
    seen: u64,
}

impl Reservoir {
    fn new(amount: Amount, seed: u64) -> Self {
        let (capacity, all) = match amount {
            Amount::All => (MOST, true),
            Amount::Some(n) => (n.min(MOST), false),
        };
        Self { capacity, all, rng: ChaCha8Rng::seed_from_u64(seed), kept: vec![], seen: 0 }
    }

    fn offer(&mut self, meeting: u32, faces: (u32, u32)) -> Result<(), TooMany> {
        let drawn = Drawn { order: self.seen, meeting, faces };
        self.seen += 1;
        if (self.kept.len() as u64) < self.capacity {
            self.kept.push(drawn);
        } else if self.all {
            return Err(TooMany);
        } else {
            let place = self.rng.random_range(0..self.seen);
            if place < self.capacity {
                self.kept[place as usize] = drawn;
            }
        }
        Ok(())
    }

    fn sorted(mut self) -> Vec<Drawn> {
        self.kept.sort_unstable_by_key(|drawn| drawn.order);
        self.kept
    }
}

/// The power of two that brings all meshes into the cube.
fn unit(scene: &Scene) -> f64 {
    let half = scene.objects.iter().map(|object| object.mesh.bounds().half_size()).fold(0.0, f64::max);
    let (exponent, fraction) = ((half.to_bits() >> 52) as i32 - 1023, half.to_bits() << 12);
    if half > 0.0 { (-f64::from(exponent + i32::from(fraction != 0))).exp2() } else { 1.0 }
}

/// A digest of all numbers of a scene: its meshes, and where they stand in each frame.
pub fn digest(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    let (meshes, mesh_of) = scene.meshes();
    for mesh in meshes {
        hash.update((mesh.vertices().len() as u64).to_le_bytes());
        mesh.vertices().iter().flat_map(|v| v.iter()).for_each(|x| hash.update(x.to_le_bytes()));
        mesh.faces().iter().flatten().for_each(|vertex| hash.update(vertex.to_le_bytes()));
    }
    mesh_of.iter().for_each(|mesh| hash.update((*mesh as u64).to_le_bytes()));
    for frame in 0..scene.frames() {
        for pose in scene.frame(frame).poses {
            pose.rotation().iter().chain(pose.translation().iter()).for_each(|x| hash.update(x.to_le_bytes()));
        }
    }
    hex(hash)
}

/// The first 64 bits of a digest.
pub(super) fn hex(hash: Sha256) -> String {
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_uniform_and_in_order() {
        let mut hits = [0; 20];
        for seed in 0..2000 {
            let mut reservoir = Reservoir::new(Amount::Some(5), seed);
            (0..20).for_each(|i| reservoir.offer(i, (i, i)).unwrap());
            let drawn = reservoir.sorted();
            assert!(drawn.len() == 5 && drawn.is_sorted_by(|x, y| x.order < y.order));
            drawn.iter().for_each(|x| hits[x.meeting as usize] += 1);
        }
        // 500 expected, standard deviation 19.
        assert!(hits.iter().all(|n| (400..600).contains(n)), "{hits:?}");
    }

    #[test]
    fn a_spread_is_even_and_within_bounds() {
        let places: Vec<u32> = (0..10).collect();
        assert_eq!(Pairs::spread(&places, 5), [0, 2, 4, 6, 8]);
        assert_eq!(Pairs::spread(&places, 20), places);
        assert!(Pairs::spread(&[], 5).is_empty());
    }
}
