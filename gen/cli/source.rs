//! Where pairs come from: files of pairs, scenes and seeded random numbers.

use super::error::Failure;
use super::output::warn;
use crate::exact::{self, Relation};
use crate::golden::host::{SceneHost, ScenePose};
use crate::golden::pair_file::{self, Points};
use crate::mesh::Mesh;
use crate::params::Params;
use crate::scene::{self, BroadPhase, Meeting, Scene};
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// The word for the built-in scene.
pub(super) const HEADLIGHT: &str = "headlight";

/// Options that name a scene or random pairs.
#[derive(Debug, clap::Args)]
pub(super) struct SourceArguments {
    /// All candidate pairs of a scene: a TOML file, or `headlight` for the built-in scene
    #[arg(long, value_name = "FILE", conflicts_with = "random")]
    pub scene: Option<String>,
    /// Random pairs
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub random: Option<u64>,
    /// Seed of the random pairs
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    #[arg(conflicts_with = "scene")]
    pub seed: u64,
}

/// A source of pairs that is not random.
#[derive(Debug)]
pub(super) enum Source {
    /// Pairs of a file.
    Pairs(Vec<Points>),
    /// A scene.
    Scene(Scene),
}

impl Source {
    /// Reads a file of pairs, or a scene if its name ends in `.toml`.
    pub fn file(name: &str) -> Result<Self, Failure> {
        if Path::new(name).extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            return Self::scene(name);
        }
        Ok(Self::Pairs(pair_file::read(name)?))
    }

    /// Reads a scene, or takes the built-in one.
    pub fn scene(name: &str) -> Result<Self, Failure> {
        Ok(Self::Scene(load_scene(name)?))
    }
}

/// Reads a scene, or takes the built-in one. Faces that cannot be used are left out, which is said on standard error.
pub(super) fn load_scene(name: &str) -> Result<Scene, Failure> {
    if name == HEADLIGHT {
        return Ok(Scene::default_scene());
    }
    let scene = scene::load(name.as_ref())?;
    for object in scene.objects.iter().filter(|object| object.findings.left_out() > 0) {
        warn(&format!("{name}: object {}: {}", object.name, object.findings));
    }
    Ok(scene)
}

/// A whole number, at least 1.
pub(super) fn count(text: &str) -> Result<u64, String> {
    let legal = |e: &u64| *e > 0;
    text.parse().ok().filter(legal).ok_or_else(|| "legal is a whole number, 1 or greater".to_owned())
}

pub(super) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("legal is a whole number from 0 to {}", u64::MAX))
}

/// A scene made ready for its pairs: trees, and the meshes of every meeting normalised and quantised.
pub(super) struct Stage<'a> {
    scene: &'a Scene,
    params: &'a Params,
    /// Finds the meetings and their candidate pairs.
    pub broad_phase: BroadPhase<'a>,
    /// The vertices of the meshes, and which mesh each object has.
    vertices: Vec<Vec<[f64; 3]>>,
    mesh_of: Vec<usize>,
    /// Pairs of meshes that have met.
    hosts: Mutex<HashMap<[usize; 2], Arc<SceneHost>>>,
}

/// Two objects in the pose in which they meet.
pub(super) struct Posed<'a> {
    meshes: [&'a Mesh; 2],
    vertices: [&'a [[f64; 3]]; 2],
    host: Arc<SceneHost>,
    m: [[f64; 3]; 3],
    t: [f64; 3],
}

impl<'a> Stage<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene, params: &'a Params) -> Self {
        let (meshes, mesh_of) = scene.meshes();
        let points = |mesh: &&Mesh| mesh.vertices.iter().map(|v| [v.x, v.y, v.z]).collect();
        let vertices = meshes.iter().map(points).collect();
        Self { scene, params, broad_phase: scene.broad_phase(), vertices, mesh_of, hosts: Mutex::default() }
    }

    /// The number of frames.
    pub fn frames(&self) -> usize {
        self.scene.frames()
    }

    /// A meeting of the scene.
    pub fn posed(&'a self, meeting: &Meeting) -> Posed<'a> {
        let meshes = [meeting.a, meeting.b].map(|object| self.mesh_of[object]);
        let vertices = meshes.map(|mesh| self.vertices[mesh].as_slice());
        let known = self.hosts.lock().unwrap_or_else(PoisonError::into_inner).get(&meshes).cloned();
        // Two threads may make the same one; it is made without the lock.
        let host = known.unwrap_or_else(|| {
            let made = Arc::new(SceneHost::new(vertices[0], vertices[1], self.params));
            let mut hosts = self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(hosts.entry(meshes).or_insert(made))
        });
        let m = [0, 1, 2].map(|i| [0, 1, 2].map(|j| meeting.pose.rotation[(i, j)]));
        Posed { meshes: self.broad_phase.meshes(meeting), vertices, host, m, t: meeting.pose.translation.into() }
    }
}

impl Posed<'_> {
    /// What the unit loads, and the pairs as it reads them.
    pub fn host(&self) -> ScenePose<'_> {
        self.host.pose(&self.m, &self.t)
    }

    /// The vertices of a pair of triangles by their indices.
    pub fn faces(&self, (a, b): (u32, u32)) -> [[u32; 3]; 2] {
        [self.meshes[0].faces[a as usize], self.meshes[1].faces[b as usize]]
    }

    /// The exact answer for a pair of triangles.
    pub fn relation(&self, pair: (u32, u32)) -> Relation {
        let [a, b] = self.faces(pair);
        let [of_a, of_b] = &self.vertices;
        let a = a.map(|vertex| of_a[vertex as usize]);
        let b = b.map(|vertex| of_b[vertex as usize]);
        exact::posed_relation(&a, &b, &self.m, &self.t)
    }
}
