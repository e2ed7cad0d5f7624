//! Meshes, alone and against each other.

use super::arrays::{Corners, array, corners, poses, rows, value_error};
use super::pairs::number;
use efsat_geometry::collide::Nesting;
use efsat_geometry::mesh;
use efsat_geometry::self_intersections::{Defect, find};
use efsat_geometry::solids::{NotSolid, Solid, Solids};
use efsat_geometry::{Body, Contact};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::OnceLock;

/// A mesh with its tree, which is built when it is first needed.
#[pyclass(frozen, subclass, module = "efsat")]
pub struct Mesh(Body);

#[pymethods]
impl Mesh {
    #[new]
    fn new(py: Python<'_>, vertices: PyReadonlyArray2<'_, f64>, faces: PyReadonlyArray2<'_, u32>) -> PyResult<Self> {
        let (vertices, faces) = (rows(&vertices)?, rows(&faces)?);
        let made = py.detach(|| Ok(mesh::Mesh::new(vertices.iter().copied(), faces.iter().copied())?.into()));
        made.map(Self).map_err(|e: mesh::InvalidMesh| value_error(e))
    }

    /// The vertices, n by 3.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array(py, self.0.mesh().vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect(), 3)
    }

    /// The triangles as numbers of vertices, n by 3.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        array(py, self.0.mesh().faces().as_flattened().to_vec(), 3)
    }

    fn __len__(&self) -> usize {
        self.0.mesh().faces().len()
    }

    fn __repr__(&self) -> String {
        format!("Mesh({} vertices, {} triangles)", self.0.mesh().vertices().len(), self.__len__())
    }
}

impl From<mesh::Mesh> for Mesh {
    fn from(mesh: mesh::Mesh) -> Self {
        Self(mesh.into())
    }
}

#[pyfunction]
pub fn read_mesh(py: Python<'_>, path: PathBuf) -> PyResult<Mesh> {
    py.detach(|| mesh::read(&path).map(Mesh::from)).map_err(value_error)
}

#[pyfunction]
pub fn self_intersections<'py>(
    py: Python<'py>,
    mesh: &Mesh,
) -> PyResult<(Bound<'py, PyArray2<u32>>, Vec<&'static str>)> {
    let found = py.detach(|| find(mesh.0.mesh()));
    let flat = found.iter().flat_map(|Defect { pair: (a, b), .. }| [*a, *b]).collect();
    Ok((array(py, flat, 2)?, found.iter().map(|defect| defect.kind.name()).collect()))
}

/// Contacts as arrays: pairs of triangles, and kinds.
type Contacts<'py> = (Bound<'py, PyArray2<u32>>, Bound<'py, PyArray1<u8>>);

fn arrays<'py>(py: Python<'py>, contacts: &[Contact]) -> PyResult<Contacts<'py>> {
    let pairs = array(py, contacts.iter().flat_map(|contact| [contact.a, contact.b]).collect(), 2)?;
    Ok((pairs, PyArray1::from_vec(py, contacts.iter().map(|contact| number(Some(contact.kind))).collect())))
}

/// Two meshes that move against each other.
#[pyclass(frozen, module = "efsat")]
pub struct Collider {
    collider: efsat_geometry::Collider,
    bodies: [Body; 2],
    solids: OnceLock<Result<[Solid; 2], NotSolid>>,
}

#[pymethods]
impl Collider {
    #[new]
    fn new(a: &Mesh, b: &Mesh) -> Self {
        let bodies = [a.0.clone(), b.0.clone()];
        Self { collider: efsat_geometry::Collider::new(&a.0, &b.0), bodies, solids: OnceLock::new() }
    }

    /// The contacts of all poses, and how many each pose has.
    fn contacts<'py>(
        &self,
        py: Python<'py>,
        at: PyReadonlyArray3<'py, f64>,
    ) -> PyResult<(Contacts<'py>, Bound<'py, PyArray1<u64>>)> {
        let at = poses(&at)?;
        let found = py.detach(|| self.collider.contacts_at(&at));
        let counts = found.iter().map(|contacts| contacts.len() as u64).collect();
        Ok((arrays(py, &found.concat())?, PyArray1::from_vec(py, counts)))
    }

    /// For each pose two triangles that touch and how, or three times -1.
    fn first_contacts<'py>(
        &self,
        py: Python<'py>,
        at: PyReadonlyArray3<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let at = poses(&at)?;
        let found = py.detach(|| self.collider.first_contacts_at(&at));
        let row = |contact: &Option<Contact>| {
            contact
                .map_or([-1; 3], |found| [i64::from(found.a), i64::from(found.b), i64::from(number(Some(found.kind)))])
        };
        array(py, found.iter().flat_map(row).collect(), 3)
    }

    /// What pairs of triangles have in common.
    fn segments<'py>(
        &self,
        py: Python<'py>,
        pairs: PyReadonlyArray2<'py, u32>,
        at: PyReadonlyArray3<'py, f64>,
        exact: bool,
    ) -> PyResult<Corners<'py>> {
        let pose = poses(&at)?[0];
        let pairs = pairs.as_slice().map_err(value_error)?.as_chunks::<2>().0;
        let triangles = self.bodies.each_ref().map(|body| body.mesh().faces().len());
        let is_legal = |pair: &[u32; 2]| (0..2).all(|side| (pair[side] as usize) < triangles[side]);
        if let Some(pair) = pairs.iter().find(|pair| !is_legal(pair)) {
            let [a, b] = triangles;
            return Err(PyIndexError::new_err(format!("triangles {pair:?}: expected less than {a} and {b}")));
        }
        let contact = |&[a, b]: &[u32; 2]| Contact { a, b, kind: efsat_geometry::ContactKind::Touching };
        let found: Vec<_> =
            py.detach(|| pairs.iter().map(|pair| self.collider.common(&contact(pair), &pose)).collect());
        corners(py, &found, exact)
    }

    /// How two solids lie.
    fn solids(&self, py: Python<'_>, at: PyReadonlyArray3<'_, f64>) -> PyResult<&'static str> {
        let pose = poses(&at)?[0];
        let [a, b] = &self.bodies;
        let made = || Ok([Solid::new(a)?, Solid::new(b)?]);
        let lie = || {
            let [a, b] = self.solids.get_or_init(made).as_ref().map_err(|e| *e)?;
            a.beside(b, &pose)
        };
        Ok(match py.detach(lie).map_err(value_error)? {
            Solids::Apart => "apart",
            Solids::Abut => "abut",
            Solids::Overlap => "overlap",
        })
    }

    /// Components inside each other: component of A, of B, and which is inside.
    fn nestings(&self, py: Python<'_>, at: PyReadonlyArray3<'_, f64>) -> PyResult<Vec<(u32, u32, &'static str)>> {
        let pose = poses(&at)?[0];
        let found = py.detach(|| self.collider.nestings(&pose)).map_err(value_error)?;
        let name = |nesting| match nesting {
            Nesting::AInB => "a in b",
            Nesting::BInA => "b in a",
        };
        Ok(found.into_iter().map(|((a, b), nesting)| (a, b, name(nesting))).collect())
    }
}
