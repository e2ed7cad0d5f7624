//! Scene files.

use super::arrays::{array, matrix, value_error};
use super::meshes::Mesh;
use efsat_geometry::scene;
use numpy::PyArray2;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A scene: objects, and frames in which they meet.
#[pyclass(frozen, subclass, module = "efsat")]
pub struct Scene(scene::Scene);

/// Two objects that may touch, and the pose of the second as seen from the first.
type Meeting<'py> = (usize, usize, Bound<'py, PyArray2<f64>>);

#[pymethods]
impl Scene {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| scene::load(&path)).map(Self).map_err(value_error)
    }

    /// What the scene is called.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// The names of the objects.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.0.objects.iter().map(|object| object.name.as_str()).collect()
    }

    /// The meshes of the objects.
    fn meshes(&self) -> Vec<Mesh> {
        self.0.objects.iter().map(|object| (*object.mesh).clone().into()).collect()
    }

    /// The number of frames.
    fn __len__(&self) -> usize {
        self.0.frames()
    }

    /// What a frame is called.
    fn label(&self, frame: usize) -> PyResult<String> {
        self.check(frame)?;
        Ok(self.0.frame(frame).label)
    }

    /// The objects that may touch in a frame.
    fn meetings<'py>(&self, py: Python<'py>, frame: usize) -> PyResult<Vec<Meeting<'py>>> {
        self.check(frame)?;
        let found = self.0.near().meetings(frame);
        let one = |found: &scene::Meeting| {
            let flat = matrix(&found.pose).as_flattened().to_vec();
            Ok((found.a, found.b, array(py, flat, 4)?))
        };
        found.iter().map(one).collect()
    }
}

impl Scene {
    fn check(&self, frame: usize) -> PyResult<()> {
        let count = self.__len__();
        if frame < count {
            Ok(())
        } else {
            Err(PyIndexError::new_err(format!("frame {frame}: expected less than {count}")))
        }
    }
}
