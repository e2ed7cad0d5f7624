//! Arrays of numpy as what the library takes, and back.

use efsat_geometry::exact::ExactPoint;
use efsat_geometry::{Points, Pose};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Display;

/// An error of the library as one of Python.
pub fn value_error(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Pairs of an array of n by 18 numbers.
pub fn pairs<'a>(array: &'a PyReadonlyArray2<'_, f64>) -> PyResult<&'a [Points]> {
    let (points, _) = array.as_slice().map_err(value_error)?.as_chunks::<3>();
    Ok(points.as_chunks::<6>().0)
}

/// Rows of an array of n by 3 numbers.
pub fn rows<'a, T: numpy::Element>(array: &'a PyReadonlyArray2<'_, T>) -> PyResult<&'a [[T; 3]]> {
    Ok(array.as_slice().map_err(value_error)?.as_chunks::<3>().0)
}

/// Poses of an array of n by 4 by 4 numbers.
pub fn poses(array: &PyReadonlyArray3<'_, f64>) -> PyResult<Vec<Pose>> {
    let (rows, _) = array.as_slice().map_err(value_error)?.as_chunks::<4>();
    rows.as_chunks::<4>().0.iter().map(pose).collect()
}

fn pose(rows: &[[f64; 4]; 4]) -> PyResult<Pose> {
    let [p, q, r, last] = rows;
    if *last != [0.0, 0.0, 0.0, 1.0] {
        return Err(PyValueError::new_err(format!("the last row of a pose is {last:?}: expected 0 0 0 1")));
    }
    let m = [p, q, r].map(|row| [row[0], row[1], row[2]]);
    Pose::from_rows(m, [p[3], q[3], r[3]]).map_err(value_error)
}

/// A pose as 4 rows of 4.
pub fn matrix(pose: &Pose) -> [[f64; 4]; 4] {
    let (m, t) = (pose.rows(), pose.translation());
    let row = |i: usize| [m[i][0], m[i][1], m[i][2], t[i]];
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}

/// Numbers as an array of rows.
pub fn array<'py, T: numpy::Element>(
    py: Python<'py>,
    flat: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let rows = flat.len() / columns;
    PyArray1::from_vec(py, flat).reshape([rows, columns])
}

/// Lists of corners as one array of all of them, and how many each has; with them the exact coordinates, if they are asked for: three
/// numerators and three denominators each.
pub type Corners<'py> = (Bound<'py, PyArray2<f64>>, Vec<usize>, Option<Vec<Fractions>>);

/// Numerators and denominators, as texts of whole numbers.
type Fractions = [(String, String); 3];

/// The corners of what pairs have in common.
pub fn corners<'py>(py: Python<'py>, lists: &[Vec<ExactPoint>], exact: bool) -> PyResult<Corners<'py>> {
    let flat = lists.iter().flatten().flat_map(ExactPoint::rounded).collect();
    let fraction = |point: &ExactPoint| point.coordinates().map(|x| (x.numer().to_string(), x.denom().to_string()));
    let fractions = exact.then(|| lists.iter().flatten().map(fraction).collect());
    Ok((array(py, flat, 3)?, lists.iter().map(Vec::len).collect(), fractions))
}
