//! The module `efsat._efsat`: what `python/efsat/__init__.py` shows. Arrays come in as `__init__.py` has made them, contiguous and of the
//! right kind, and are read where they lie; what is computed goes out without a copy. Nothing holds the interpreter while it computes.

mod arrays;
mod meshes;
mod pairs;
mod scenes;
mod units;

use pyo3::prelude::*;

#[pymodule]
mod _efsat {
    #[pymodule_export]
    use super::meshes::{Collider, Mesh, read_mesh, self_intersections};
    #[pymodule_export]
    use super::pairs::{kinds, retest, segments};
    #[pymodule_export]
    use super::scenes::Scene;
    #[pymodule_export]
    use super::units::{Design, Engine};
}
