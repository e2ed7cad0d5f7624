//! A scene made ready for its pairs: quantised for the unit, and as it is for the exact answer.

use super::{SceneHost, ScenePose};
use crate::params::Params;
use efsat_geometry::exact::{self, Exact, Relation};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::{Meeting, Near, Scene};
use efsat_geometry::software::retest::{retest, retest_posed};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Why no number is refused.
const FINITE: &str = "meshes and poses are finite";

/// A scene made ready for its pairs: trees, and the meshes of every meeting normalised and quantised.
pub struct ReadyScene<'a> {
    scene: &'a Scene,
    params: Params,
    /// Finds the meetings and their candidate pairs.
    pub near: Near<'a>,
    /// The vertices of the meshes.
    vertices: Vec<Vec<[f64; 3]>>,
    /// Pairs of meshes that have met.
    hosts: Mutex<HashMap<[usize; 2], Arc<SceneHost>>>,
}

/// Two objects in the pose in which they meet.
pub struct ReadyMeeting<'a> {
    meshes: [&'a Mesh; 2],
    vertices: [&'a [[f64; 3]]; 2],
    host: Arc<SceneHost>,
    m: [[f64; 3]; 3],
    t: [f64; 3],
}

impl<'a> ReadyScene<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene, params: &Params) -> Self {
        let (meshes, _) = scene.meshes();
        let points = |mesh: &&Mesh| mesh.vertices().iter().map(|v| [v.x, v.y, v.z]).collect();
        let vertices = meshes.iter().map(points).collect();
        let params = params.clone();
        Self { scene, params, near: scene.near(), vertices, hosts: Mutex::default() }
    }

    /// The number of frames.
    pub fn frames(&self) -> usize {
        self.scene.frames()
    }

    /// A meeting of the scene.
    pub fn posed(&'a self, meeting: &Meeting) -> ReadyMeeting<'a> {
        let meshes = meeting.meshes;
        let vertices = meshes.map(|mesh| self.vertices[mesh].as_slice());
        let known = self.hosts.lock().unwrap_or_else(PoisonError::into_inner).get(&meshes).cloned();
        // Two threads may make the same one; it is made without the lock.
        let host = known.unwrap_or_else(|| {
            let made = Arc::new(SceneHost::new(vertices[0], vertices[1], &self.params).expect(FINITE));
            let mut hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(hosts.entry(meshes).or_insert(made))
        });
        let m = meeting.pose.rows();
        ReadyMeeting { meshes: self.near.meshes(meeting), vertices, host, m, t: meeting.pose.translation().into() }
    }
}

impl ReadyMeeting<'_> {
    /// What the unit loads, and the pairs as it reads them.
    pub fn host(&self) -> ScenePose<'_> {
        self.host.pose(&self.m, &self.t).expect(FINITE)
    }

    /// The vertices of a pair of triangles by their indices.
    pub fn faces(&self, (a, b): (u32, u32)) -> [[u32; 3]; 2] {
        [self.meshes[0].faces()[a as usize], self.meshes[1].faces()[b as usize]]
    }

    /// The corners of a pair of triangles, each in the frame of its mesh.
    fn corners(&self, pair: (u32, u32)) -> [[[f64; 3]; 3]; 2] {
        let [a, b] = self.faces(pair);
        let [of_a, of_b] = &self.vertices;
        [a.map(|vertex| of_a[vertex as usize]), b.map(|vertex| of_b[vertex as usize])]
    }

    /// What the oracle says of a pair of triangles: of the geometry that the unit answers for, which is the one given or, with
    /// `--truth snapped`, [another](ScenePose::snapped).
    pub fn relation(&self, pair: (u32, u32)) -> Relation {
        if let Some(points) = self.snapped(pair) {
            return exact::relation(&points).expect(FINITE);
        }
        let [a, b] = self.corners(pair);
        exact::posed_relation(&a, &b, &self.m, &self.t).expect(FINITE)
    }

    /// The exact answer for the same geometry, by the fast test that decides for the host.
    pub fn class(&self, pair: (u32, u32)) -> Exact {
        self.snapped(pair).map_or_else(|| self.given(pair), |points| retest(&points).expect(FINITE))
    }

    /// The points of a pair if the unit answers for others than those given.
    fn snapped(&self, pair: (u32, u32)) -> Option<[[f64; 3]; 6]> {
        let [a, b] = self.faces(pair);
        self.host.snaps().then(|| self.host().snapped(a, b)).flatten()
    }

    /// The exact answer for a pair of triangles as they are given, by the fast test.
    pub fn given(&self, pair: (u32, u32)) -> Exact {
        let [a, b] = self.corners(pair);
        retest_posed(&a, &b, &self.m, &self.t).expect(FINITE)
    }
}
