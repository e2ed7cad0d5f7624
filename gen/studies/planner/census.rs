//! What there is in a scene, before any unit is asked.

use super::Front;
use super::sample::{Least, Place, mixed};
use efsat_geometry::collide::hierarchy::Statistics;
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::Meeting;
use efsat_unit::host::ReadyScene;
use efsat_unit::params::Params;
use nalgebra::{Matrix3, Point3};
use rayon::prelude::*;
use serde::Serialize;

/// Frames from which vectors are taken to time simulations.
const FRAMES: usize = 8;
/// Vectors of each of them.
const VECTORS: usize = 8;
/// Pairs that a thread looks at at a time.
const SHARE: usize = 4096;

/// Counts over all frames of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Census {
    /// Frames.
    pub frames: u64,
    /// Every two objects of every frame.
    pub object_pairs: u64,
    /// Those of them that meet.
    pub meetings: u64,
    /// All pairs of triangles of these.
    pub all_pairs: u64,
    /// What it took to find the surviving ones, and how many they are.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Surviving pairs with a degenerate triangle.
    pub degenerate_pairs: u64,
    /// Meetings with surviving pairs in which the frame change of the unit would be the identity.
    pub identities: u64,
    /// ... a translation.
    pub translations: u64,
    /// ... anything else.
    pub rotations: u64,
    /// The shortest side of the boxes around the six points of a surviving pair, as a part of the domain, which is the cube
    /// that both meshes are scaled to: re-normalisation scales each side up by itself. Sides below a unit in the last
    /// place of the input are none. Rounded, and none without a side.
    pub smallest: Option<f64>,
    /// Some surviving pairs, of few frames.
    #[serde(skip)]
    pub vectors: Vec<Place>,
}

impl Census {
    /// Looks at all frames. `params` are those of a unit with the whole transform.
    pub fn new(front: &Front<'_>, params: &Params) -> Self {
        let scene = front.scene();
        let stage = ReadyScene::new(scene, params);
        let objects = scene.objects.len() as u64;
        // The domain is two units wide.
        let ulp = (-f64::from(params.input().fraction + 1)).exp2();
        let mut total = Self::default();
        let mut frames = Least::new(FRAMES);
        let Ok(()) = front.near.frames_in_order(
            |frame, scratch| {
                let mut counts = Self { frames: 1, object_pairs: objects * (objects - 1) / 2, ..Self::default() };
                let mut vectors = Least::new(VECTORS);
                for meeting in front.near.meetings(frame) {
                    let mut extent = Extent::new(front, &meeting, ulp);
                    let mut first = None;
                    let found = front.near.pieces(&meeting, scratch, |pairs| {
                        first = first.or(pairs.first().copied());
                        counts.take(front, &meeting, pairs, &mut extent);
                        for &pair in pairs.iter().filter(|pair| !front.answers(&meeting, **pair)) {
                            let place = Place::new(&meeting, pair);
                            vectors.add(place.lot(0), place);
                        }
                    });
                    counts.meetings += 1;
                    counts.all_pairs += front.near.all_pairs(&meeting);
                    counts.statistics = counts.statistics + found;
                    if let Some(pair) = first {
                        counts.pose(&stage, &meeting, pair);
                    }
                }
                (counts, vectors.list())
            },
            |frame, (counts, vectors)| {
                total.add(&counts);
                if !vectors.is_empty() {
                    frames.add(mixed(frame as u64), vectors);
                }
                Ok::<(), std::convert::Infallible>(())
            },
        );
        total.vectors = frames.list().into_iter().flat_map(|(_, vectors)| vectors).map(|(_, place)| place).collect();
        total.vectors.sort_unstable();
        total
    }

    fn take(&mut self, front: &Front<'_>, meeting: &Meeting, pairs: &[(u32, u32)], extent: &mut Extent<'_>) {
        if pairs.is_empty() {
            return;
        }
        extent.prepare();
        let shares = pairs.par_chunks(SHARE).map(|pairs| {
            let degenerate = pairs.iter().filter(|pair| front.is_degenerate(meeting, **pair)).count() as u64;
            (degenerate, pairs.iter().map(|pair| extent.of(*pair)).fold(f64::INFINITY, f64::min))
        });
        let (degenerate, smallest) = shares.reduce(|| (0, f64::INFINITY), |x, y| (x.0 + y.0, x.1.min(y.1)));
        self.degenerate_pairs += degenerate;
        let smallest = Some(smallest).filter(|side| side.is_finite());
        self.smallest = [self.smallest, smallest].into_iter().flatten().reduce(f64::min);
    }

    /// Counts the pose of a meeting, of which one surviving pair is given.
    fn pose(&mut self, stage: &ReadyScene<'_>, meeting: &Meeting, pair: (u32, u32)) {
        if meeting.pose.rotation() != Matrix3::identity() {
            self.rotations += 1;
            return;
        }
        let posed = stage.posed(meeting);
        let host = posed.host();
        let [a, b] = posed.faces(pair);
        // A pose outside the declared ranges is bypassed too, and the host decides all its pairs.
        let is_in_range = matches!(host.pair(a, b), efsat_unit::host::Host::Unit(_));
        match host.pose.bypass && is_in_range {
            true => self.identities += 1,
            false => self.translations += 1,
        }
    }

    fn add(&mut self, other: &Self) {
        self.frames += other.frames;
        self.object_pairs += other.object_pairs;
        self.meetings += other.meetings;
        self.all_pairs += other.all_pairs;
        self.statistics = self.statistics + other.statistics;
        self.degenerate_pairs += other.degenerate_pairs;
        self.identities += other.identities;
        self.translations += other.translations;
        self.rotations += other.rotations;
        self.smallest = [self.smallest, other.smallest].into_iter().flatten().reduce(f64::min);
    }
}

/// How large pairs are; in binary64, for the report alone.
struct Extent<'a> {
    meshes: [&'a Mesh; 2],
    meeting: &'a Meeting,
    /// The vertices of B in the frame of A, once a pair is there.
    moved: Vec<Point3<f64>>,
    domain: f64,
    /// The least side that counts, as a part of the domain.
    ulp: f64,
}

impl<'a> Extent<'a> {
    fn new(front: &Front<'a>, meeting: &'a Meeting, ulp: f64) -> Self {
        let meshes = [meeting.a, meeting.b].map(|object| front.scene().objects[object].mesh.as_ref());
        Self { meshes, meeting, moved: vec![], domain: 0.0, ulp }
    }

    fn prepare(&mut self) {
        if self.moved.is_empty() {
            let [a, b] = self.meshes;
            self.moved = b.vertices().iter().map(|v| self.meeting.pose.image(v)).collect();
            let reach = a.bounds().half_size().max(b.bounds().half_size());
            self.domain = 2.0 * reach.log2().ceil().exp2();
        }
    }

    /// The shortest side of the box of a pair; infinite if none counts.
    fn of(&self, pair: (u32, u32)) -> f64 {
        let [a, b] = self.meshes;
        let corners = b.faces()[pair.1 as usize].map(|v| self.moved[v as usize]);
        let bounds = efsat_geometry::mesh::Bounds::of(a.triangle(pair.0 as usize).iter().chain(&corners));
        let sides = (bounds.max - bounds.min) / self.domain;
        sides.iter().copied().filter(|side| *side >= self.ulp).fold(f64::INFINITY, f64::min)
    }
}
