//! Numbers and poses of a scene file. TOML can write `inf` and `nan`.

use super::Fault;
use super::tables::PoseParts;
use crate::collide::Pose;
use crate::scene::rotation::{Rotation, about};
use nalgebra::{Matrix3, Vector3};
use toml::Spanned;

/// The numbers of a list, if they are all finite.
pub(super) fn finite<'a, T: AsRef<[f64]>>(list: &'a Spanned<T>, key: &str) -> Result<&'a T, Fault> {
    match list.get_ref().as_ref().iter().find(|x| !x.is_finite()) {
        Some(x) => Err(Fault::at(list, format!("{key} holds {x}: expected finite numbers"))),
        None => Ok(list.get_ref()),
    }
}

/// A finite number.
pub(super) fn number(value: &Spanned<f64>, key: &str) -> Result<f64, Fault> {
    match *value.get_ref() {
        x if x.is_finite() => Ok(x),
        x => Err(Fault::at(value, format!("{key} {x}: expected a finite number"))),
    }
}

/// A direction: three finite numbers, not all zero.
pub(super) fn non_zero(list: &Spanned<[f64; 3]>, key: &str) -> Result<Vector3<f64>, Fault> {
    let vector = Vector3::from(*finite(list, key)?);
    match vector.amax() {
        0.0 => Err(Fault::at(list, format!("{key} of three zeros: expected any other vector"))),
        _ => Ok(vector),
    }
}

/// Three finite numbers, or zeros.
pub(super) fn vector(list: Option<&Spanned<[f64; 3]>>, key: &str) -> Result<Vector3<f64>, Fault> {
    list.map_or(Ok(Vector3::zeros()), |list| Ok(Vector3::from(*finite(list, key)?)))
}

/// The rotation of a pose; `table` is what to blame, and `legal` says what it may hold.
pub(super) fn rotation<T>(parts: &PoseParts<'_>, table: &Spanned<T>, legal: &str) -> Result<Rotation, Fault> {
    match (parts.matrix, parts.axis, parts.angle_degrees, parts.quaternion) {
        (None, None, None, None) => Ok(Rotation::None),
        (Some(m), None, None, None) => Ok(Rotation::Matrix(Matrix3::from_row_slice(finite(m, "matrix")?))),
        (None, Some(axis), Some(angle), None) => {
            let degrees = number(angle, "angle_degrees")?;
            Ok(Rotation::AxisAngle(non_zero(axis, "axis")?, degrees))
        }
        (None, None, None, Some(q)) => {
            if finite(q, "quaternion")?.iter().all(|&x| x == 0.0) {
                return Err(Fault::at(q, "quaternion of four zeros: expected any other [w, x, y, z]"));
            }
            Ok(Rotation::Quaternion(*q.get_ref()))
        }
        _ => Err(Fault::at(table, format!("pose: expected one of {legal}, or none"))),
    }
}

/// A whole pose.
pub(super) fn pose<T>(parts: &PoseParts<'_>, table: &Spanned<T>) -> Result<Pose, Fault> {
    let rotation = rotation(parts, table, "matrix, axis with angle_degrees, and quaternion")?.matrix();
    let translation = vector(parts.translation, "translation")?;
    Ok(match parts.about {
        None => Pose { rotation, translation },
        Some(_) => {
            let centre = vector(parts.about, "about")?;
            Pose { rotation, translation: about(&centre, &rotation, &translation) }
        }
    })
}
