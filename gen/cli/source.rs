//! Where pairs come from: files of pairs, scenes and seeded random numbers.

use super::error::Failure;
use crate::exact::{self, Relation};
use crate::golden::host::{Host, SceneHost, ScenePose};
use crate::golden::pair_file::{self, Points};
use crate::params::Params;
use crate::scene::{self, BroadPhase, Scene};
use std::path::Path;

/// The word for the built-in scene.
const HEADLIGHT: &str = "headlight";

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
        Ok(Self::Scene(if name == HEADLIGHT { Scene::default_scene() } else { scene::load(name.as_ref())? }))
    }
}

/// A whole number, at least 1.
pub(super) fn count(text: &str) -> Result<u64, String> {
    let legal = |e: &u64| *e > 0;
    text.parse().ok().filter(legal).ok_or_else(|| "legal is a whole number, 1 or greater".to_owned())
}

pub(super) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("legal is a whole number from 0 to {}", u64::MAX))
}

/// A scene made ready for its pairs: trees, and both meshes normalised and quantised.
pub(super) struct Stage<'a> {
    scene: &'a Scene,
    /// Finds the candidate pairs.
    pub broad_phase: BroadPhase<'a>,
    host: SceneHost,
    vertices: [Vec<[f64; 3]>; 2],
}

/// A scene in one of its poses.
pub(super) struct Posed<'a> {
    stage: &'a Stage<'a>,
    /// What the unit loads, and the pairs as it reads them.
    pub host: ScenePose<'a>,
    m: [[f64; 3]; 3],
    t: [f64; 3],
}

impl<'a> Stage<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene, params: &Params) -> Self {
        let vertices =
            [&scene.a, &scene.b].map(|mesh| mesh.vertices.iter().map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>());
        let host = SceneHost::new(&vertices[0], &vertices[1], params);
        Self { scene, broad_phase: scene.broad_phase(), host, vertices }
    }

    /// The number of poses.
    pub fn poses(&self) -> usize {
        self.scene.poses.len()
    }

    /// The scene in pose number `pose`.
    pub fn posed(&'a self, pose: usize) -> Posed<'a> {
        let pose = &self.scene.poses[pose];
        let m = [0, 1, 2].map(|i| [0, 1, 2].map(|j| pose.rotation[(i, j)]));
        let t = pose.translation.into();
        Posed { stage: self, host: self.host.pose(&m, &t), m, t }
    }

    fn faces(&self, (a, b): (u32, u32)) -> [[u32; 3]; 2] {
        [self.scene.a.faces[a as usize], self.scene.b.faces[b as usize]]
    }
}

impl Posed<'_> {
    /// A pair of triangles as the host hands it on.
    pub fn pair(&self, pair: (u32, u32)) -> Host {
        let [a, b] = self.stage.faces(pair);
        self.host.pair(a, b)
    }

    /// The exact answer for a pair of triangles.
    pub fn relation(&self, pair: (u32, u32)) -> Relation {
        let [a, b] = self.stage.faces(pair);
        let [of_a, of_b] = &self.stage.vertices;
        let a = a.map(|vertex| of_a[vertex as usize]);
        let b = b.map(|vertex| of_b[vertex as usize]);
        exact::posed_relation(&a, &b, &self.m, &self.t)
    }
}
