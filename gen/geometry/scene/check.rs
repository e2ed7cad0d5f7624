//! What must hold in every frame of a scene.

use super::{Pose, Scene, sweep};
use nalgebra::Matrix3;

/// The greatest translation, and the greatest entry of a matrix that is seen from a rotated object: what is computed with two of them
/// stays finite.
const GREATEST: f64 = 1e306;

/// Why a scene cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct InvalidScene(String);

impl Scene {
    /// The scene, if all its poses are finite, those of one object as seen from another too, and all objects but the last are rotated
    /// and not distorted.
    pub(super) fn checked(self) -> Result<Self, InvalidScene> {
        let last = self.objects.len().saturating_sub(1);
        let (mut rotated, mut huge) = (false, None);
        let mut sound = |label: &str, object: usize, pose: &Pose| {
            let name = &self.objects[object].name;
            // Both comparisons refuse what is no number, too.
            if !pose.translation.iter().all(|x| x.abs() <= GREATEST) {
                let legal = "expected smaller meshes or distances";
                return Err(InvalidScene(format!("{label}: the translation of {name} overflows: {legal}")));
            }
            let turns = sweep::skew(&pose.rotation) <= sweep::SKEW;
            if object < last && !turns {
                let legal = "expected rotations to within 2^-20, and any matrix for the last object";
                return Err(InvalidScene(format!("{label}: the matrix of {name} is no rotation: {legal}")));
            }
            if let Some(x) = pose.rotation.iter().find(|x| !x.is_finite()) {
                let message = format!("{label}: the matrix of {name} holds {x}: expected finite numbers");
                return Err(InvalidScene(message));
            }
            rotated |= object < last && pose.rotation != Matrix3::identity();
            if pose.rotation.amax() > GREATEST {
                huge.get_or_insert_with(|| (label.to_owned(), name.clone()));
            }
            Ok(())
        };
        for (number, object) in self.objects.iter().enumerate() {
            sound("placed", number, &object.placed)?;
        }
        for motion in &self.motions {
            for frame in 0..motion.frames() {
                let change = motion.change(frame);
                for (object, pose) in &change.poses {
                    sound(&change.label, *object, pose)?;
                }
            }
        }
        match huge {
            Some((label, name)) if rotated => Err(InvalidScene(format!(
                "{label}: an entry of the matrix of {name} is above {GREATEST:e}, and another object is rotated: expected smaller entries"
            ))),
            _ => Ok(self),
        }
    }
}
