//! The objects of a scene file.

use super::Fault;
use super::numbers::pose;
use super::tables::{ObjectTable, Scale, SceneTable};
use crate::mesh::{self, Findings, Mesh};
use crate::scene::{Object, Pose};
use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// What stands before the name of a built-in mesh in a scene file.
pub(super) const BUILTIN: &str = "builtin:";

/// Units of length in micrometres.
const UNITS: [(&str, f64); 6] =
    [("um", 1.0), ("mm", 1e3), ("cm", 1e4), ("m", 1e6), ("inch", 25_400.0), ("foot", 304_800.0)];

/// The objects of the file, at least two.
pub(super) fn of(scene: &SceneTable, folder: &Path) -> Result<Vec<Object>, Fault> {
    let tables = tables(scene)?;
    let mut names = HashSet::new();
    let mut read: Vec<(&ObjectTable, Object)> = vec![];
    for (name, table) in tables {
        if !names.insert(name) {
            return Err(Fault::at(table, format!("a second object '{name}': expected different names")));
        }
        let table = table.get_ref();
        // Equal meshes are one in memory.
        let known = read.iter().find(|(other, _)| same_mesh(other, table));
        let (mesh, findings) = match known {
            Some((_, object)) => (Arc::clone(&object.mesh), object.findings.clone()),
            None => mesh_of(table, scene.unit.as_ref(), folder)?,
        };
        let placed = match &table.placed {
            Some(placed) => pose(&placed.get_ref().parts(), placed)?,
            None => Pose::identity(),
        };
        read.push((table, Object { name: name.to_owned(), mesh, findings, placed }));
    }
    Ok(read.into_iter().map(|(_, object)| object).collect())
}

/// The tables with their names: `[a]` and `[b]`, or `[[object]]`.
fn tables(scene: &SceneTable) -> Result<Vec<(&str, &Spanned<ObjectTable>)>, Fault> {
    const LEGAL: &str = "expected two tables [a] and [b], or two or more tables [[object]]";
    match (&scene.a, &scene.b, &scene.object[..]) {
        (Some(a), Some(b), []) => {
            for (name, table) in [("a", a), ("b", b)] {
                if let Some(given) = &table.get_ref().name {
                    return Err(Fault::at(given, format!("a name for [{name}], which has one: expected none")));
                }
            }
            Ok(vec![("a", a), ("b", b)])
        }
        (None, None, objects) if objects.len() >= 2 => objects
            .iter()
            .map(|table| match &table.get_ref().name {
                Some(name) => Ok((name.get_ref().as_str(), table)),
                None => Err(Fault::at(table, "an object without a name: expected name = 'any word'")),
            })
            .collect(),
        (None, None, [one]) => Err(Fault::at(one, format!("one object: {LEGAL}"))),
        (None, None, _) => Err(Fault::whole(format!("no object: {LEGAL}"))),
        (Some(a), None, []) => Err(Fault::at(a, format!("[a] without [b]: {LEGAL}"))),
        (None, Some(b), []) => Err(Fault::at(b, format!("[b] without [a]: {LEGAL}"))),
        (_, _, [object, ..]) => Err(Fault::at(object, format!("[[object]] beside [a] or [b]: {LEGAL}"))),
    }
}

fn same_mesh(x: &ObjectTable, y: &ObjectTable) -> bool {
    fn value<T>(option: &Option<Spanned<T>>) -> Option<&T> {
        option.as_ref().map(Spanned::get_ref)
    }
    x.mesh.get_ref() == y.mesh.get_ref() && value(&x.scale) == value(&y.scale) && value(&x.unit) == value(&y.unit)
}

/// The mesh of a table in the units of the scene: factors are applied to the vertices, and these as rounded to binary64
/// are the truth (a power of two rounds nothing).
fn mesh_of(table: &ObjectTable, unit: Option<&Spanned<String>>, folder: &Path) -> Result<(Arc<Mesh>, Findings), Fault> {
    let source = table.mesh.get_ref();
    let (mesh, findings) = match source.strip_prefix(BUILTIN) {
        None => {
            let read = mesh::survey(&folder.join(source));
            read.map(|(mesh, findings)| (Arc::new(mesh), findings))
                .map_err(|e| Fault::at(&table.mesh, e.to_string()))?
        }
        Some(name) => {
            let mesh = mesh::builtin(name).ok_or_else(|| {
                let legal = mesh::BUILTIN.map(|name| format!("{BUILTIN}{name}")).join(", ");
                Fault::at(&table.mesh, format!("mesh '{source}': expected one of {legal}"))
            })?;
            let findings = Findings::of_mesh(&mesh);
            (mesh, findings)
        }
    };
    let mut scaled = mesh;
    if let Some((factor, blamed)) = unit_factor(table, unit)? {
        scaled = Arc::new(times(&scaled, factor).ok_or_else(|| Fault::at(blamed, "unit: the vertices overflow"))?);
    }
    if let Some(scale) = &table.scale {
        let factor = scale_factor(scale, &scaled)?;
        let overflow = || Fault::at(scale, format!("scale {factor}: the vertices overflow"));
        scaled = Arc::new(times(&scaled, factor).ok_or_else(overflow)?);
    }
    Ok((scaled, findings))
}

/// A mesh with its vertices multiplied, if they stay finite.
fn times(mesh: &Mesh, factor: f64) -> Option<Mesh> {
    Mesh::new(mesh.vertices().iter().map(|vertex| vertex * factor), mesh.faces().iter().copied()).ok()
}

fn scale_factor(scale: &Spanned<Scale>, mesh: &Mesh) -> Result<f64, Fault> {
    match scale.get_ref() {
        Scale::Factor(factor) if factor.is_finite() && *factor > 0.0 => Ok(*factor),
        Scale::Factor(factor) => {
            Err(Fault::at(scale, format!("scale {factor}: expected a positive number or \"cube\"")))
        }
        Scale::Word(word) if word == "cube" => match 1.0 / mesh.bounds().half_size() {
            factor if factor.is_finite() && factor > 0.0 => Ok(factor),
            _ => Err(Fault::at(scale, "scale \"cube\": the mesh is a point, or too small or large: expected a number")),
        },
        Scale::Word(word) => Err(Fault::at(scale, format!("scale '{word}': expected a positive number or \"cube\""))),
    }
}

/// From the unit of the object to that of the scene, and what to blame.
fn unit_factor<'a>(
    table: &'a ObjectTable,
    unit: Option<&'a Spanned<String>>,
) -> Result<Option<(f64, &'a Spanned<String>)>, Fault> {
    let size = |unit: &Spanned<String>| {
        let found = UNITS.iter().find(|(name, _)| name == unit.get_ref()).map(|(_, size)| *size);
        found.ok_or_else(|| {
            let legal: Vec<&str> = UNITS.iter().map(|(name, _)| *name).collect();
            Fault::at(unit, format!("unit '{}': expected one of {}", unit.get_ref(), legal.join(", ")))
        })
    };
    let scene = unit.map(size).transpose()?;
    match (&table.unit, scene) {
        (None, _) => Ok(None),
        (Some(own), Some(scene)) => Ok(Some((size(own)? / scene, own))),
        (Some(own), None) => Err(Fault::at(own, "unit of an object in a scene without one: expected unit at the top")),
    }
}
