//! Pairs of triangles.

use super::arrays::{Corners, corners, pairs, value_error};
use efsat_geometry::exact::common;
use efsat_geometry::software::retest::retest_parallel;
use efsat_geometry::{ContactKind, Pair, Points};
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

/// A kind as a number: 0 for none.
pub fn number(kind: Option<ContactKind>) -> u8 {
    match kind {
        None => 0,
        Some(ContactKind::Touching) => 1,
        Some(ContactKind::Crossing) => 2,
        Some(ContactKind::Coplanar) => 3,
    }
}

#[pyfunction]
pub fn retest<'py>(py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray1<u8>>> {
    let points = pairs(&points)?;
    let found = py.detach(|| retest_parallel(points).map(|all| all.into_iter().map(|exact| exact as u8).collect()));
    Ok(PyArray1::from_vec(py, found.map_err(value_error)?))
}

#[pyfunction]
pub fn kinds<'py>(py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray1<u8>>> {
    let points = pairs(&points)?;
    let one = |(at, &[a0, a1, a2, b0, b1, b2]): (usize, &Points)| {
        let pair = Pair::new([a0, a1, a2], [b0, b1, b2]).map_err(|e| e.of_pair(at))?;
        Ok(number(pair.kind()))
    };
    let found: Result<Vec<u8>, efsat_geometry::NotFinite> =
        py.detach(|| points.par_iter().enumerate().with_min_len(1 << 10).map(one).collect());
    Ok(PyArray1::from_vec(py, found.map_err(value_error)?))
}

#[pyfunction]
pub fn segments<'py>(py: Python<'py>, points: PyReadonlyArray2<'py, f64>, exact: bool) -> PyResult<Corners<'py>> {
    let points = pairs(&points)?;
    let one = |(at, points): (usize, &Points)| common(points).map_err(|e| e.of_pair(at));
    let found: Result<Vec<_>, _> = py.detach(|| points.par_iter().enumerate().map(one).collect());
    corners(py, &found.map_err(value_error)?, exact)
}
