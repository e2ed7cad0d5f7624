//! The tables of a scene file as TOML has them.

use serde::Deserialize;
use std::collections::BTreeMap;
use toml::{Spanned, Value};

/// A table whose keys are for others.
pub(super) type Entries = BTreeMap<Spanned<String>, Value>;

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneTable {
    pub name: String,
    /// The unit of length of the scene.
    pub unit: Option<Spanned<String>>,
    /// Two objects, `[a]` and `[b]`, or any number of them, `[[object]]`.
    pub a: Option<Spanned<ObjectTable>>,
    pub b: Option<Spanned<ObjectTable>>,
    #[serde(default)]
    pub object: Vec<Spanned<ObjectTable>>,
    pub tumble: Option<TumbleTable>,
    #[serde(default)]
    pub pose: Vec<Spanned<PoseTable>>,
    #[serde(default)]
    pub trajectory: Vec<Spanned<TrajectoryTable>>,
    /// For the unit: which stages are there.
    #[serde(default)]
    pub effects: Entries,
    /// For the unit: options of the command line.
    #[serde(default)]
    pub parameters: Entries,
}

/// `[a]`, `[b]` and `[[object]]`; only the last has a name.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectTable {
    pub name: Option<Spanned<String>>,
    pub mesh: Spanned<String>,
    pub scale: Option<Spanned<Scale>>,
    pub unit: Option<Spanned<String>>,
    pub placed: Option<Spanned<PlaceTable>>,
}

/// A factor, or `"cube"`.
#[derive(Deserialize, Clone, PartialEq)]
#[serde(untagged, expecting = "invalid scale: expected a positive number or \"cube\"")]
pub(super) enum Scale {
    Factor(f64),
    Word(String),
}

/// `[tumble]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TumbleTable {
    pub object: Option<Spanned<String>>,
    pub around: Option<Spanned<String>>,
    pub steps: Spanned<u32>,
    pub distances: Spanned<Vec<f64>>,
    pub direction: Option<Spanned<[f64; 3]>>,
}

/// Where something stands: one of `matrix`, `axis` with `angle_degrees`, and `quaternion`, or none for no rotation.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaceTable {
    pub matrix: Option<Spanned<[f64; 9]>>,
    pub axis: Option<Spanned<[f64; 3]>>,
    pub angle_degrees: Option<Spanned<f64>>,
    pub quaternion: Option<Spanned<[f64; 4]>>,
    pub about: Option<Spanned<[f64; 3]>>,
    pub translation: Option<Spanned<[f64; 3]>>,
}

/// `[[pose]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PoseTable {
    pub label: Option<String>,
    pub object: Option<Spanned<String>>,
    pub matrix: Option<Spanned<[f64; 9]>>,
    pub axis: Option<Spanned<[f64; 3]>>,
    pub angle_degrees: Option<Spanned<f64>>,
    pub quaternion: Option<Spanned<[f64; 4]>>,
    pub about: Option<Spanned<[f64; 3]>>,
    pub translation: Option<Spanned<[f64; 3]>>,
}

/// `[[trajectory]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TrajectoryTable {
    pub label: Option<String>,
    pub frames: Spanned<u32>,
    #[serde(default)]
    pub track: Vec<Spanned<TrackTable>>,
}

/// `[[trajectory.track]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TrackTable {
    pub object: Option<Spanned<String>>,
    #[serde(default)]
    pub key: Vec<Spanned<KeyTable>>,
}

/// `[[trajectory.track.key]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeyTable {
    pub time: Spanned<f64>,
    pub axis: Option<Spanned<[f64; 3]>>,
    pub angle_degrees: Option<Spanned<f64>>,
    pub quaternion: Option<Spanned<[f64; 4]>>,
    pub about: Option<Spanned<[f64; 3]>>,
    pub translation: Option<Spanned<[f64; 3]>>,
}

/// The parts of a pose wherever it is written.
#[derive(Clone, Copy)]
pub(super) struct PoseParts<'a> {
    pub matrix: Option<&'a Spanned<[f64; 9]>>,
    pub axis: Option<&'a Spanned<[f64; 3]>>,
    pub angle_degrees: Option<&'a Spanned<f64>>,
    pub quaternion: Option<&'a Spanned<[f64; 4]>>,
    pub about: Option<&'a Spanned<[f64; 3]>>,
    pub translation: Option<&'a Spanned<[f64; 3]>>,
}

impl PlaceTable {
    pub fn parts(&self) -> PoseParts<'_> {
        let Self { matrix, axis, angle_degrees, quaternion, about, translation } = self;
        PoseParts {
            matrix: matrix.as_ref(),
            axis: axis.as_ref(),
            angle_degrees: angle_degrees.as_ref(),
            quaternion: quaternion.as_ref(),
            about: about.as_ref(),
            translation: translation.as_ref(),
        }
    }
}

impl PoseTable {
    pub fn parts(&self) -> PoseParts<'_> {
        let Self { label: _, object: _, matrix, axis, angle_degrees, quaternion, about, translation } = self;
        PoseParts {
            matrix: matrix.as_ref(),
            axis: axis.as_ref(),
            angle_degrees: angle_degrees.as_ref(),
            quaternion: quaternion.as_ref(),
            about: about.as_ref(),
            translation: translation.as_ref(),
        }
    }
}

impl KeyTable {
    pub fn parts(&self) -> PoseParts<'_> {
        let Self { time: _, axis, angle_degrees, quaternion, about, translation } = self;
        PoseParts {
            matrix: None,
            axis: axis.as_ref(),
            angle_degrees: angle_degrees.as_ref(),
            quaternion: quaternion.as_ref(),
            about: about.as_ref(),
            translation: translation.as_ref(),
        }
    }
}
