//! A mesh under construction: what all formats do with the vertices and faces that they read.

use super::error::Fault;
use super::{Defect, Mesh, Numbers, Parsed, Remark, polygon};
use nalgebra::Point3;
use std::collections::HashMap;

/// What is expected of a coordinate that a face uses.
pub(super) const FINITE: &str = "expected a finite number";
const POLYGON: &str = "expected corners that make a simple polygon as seen along a coordinate axis";

/// Takes all vertices, then all faces.
#[derive(Default)]
pub(super) struct Builder {
    mesh: Mesh,
    /// Those that are not finite, with their lines.
    not_finite: HashMap<u32, Option<usize>>,
    /// The number that the format gives the first vertex.
    first_vertex: usize,
    numbers: Numbers,
    faces: u32,
    faults: Faults,
    remarks: Vec<Remark>,
}

/// How often faces were at fault, and the first fault of each kind, in the order of the file.
#[derive(Clone, Debug, Default)]
pub(super) struct Faults(pub(super) Vec<(Defect, u64, Fault)>);

impl Faults {
    fn add(&mut self, defect: Defect, fault: Fault) {
        match self.0.iter_mut().find(|(known, ..)| *known == defect) {
            Some((_, count, _)) => *count += 1,
            None => self.0.push((defect, 1, fault)),
        }
    }
}

/// A fault at a line, if there are lines.
pub(super) fn located(fault: Fault, line: Option<usize>) -> Fault {
    line.into_iter().fold(fault, Fault::at)
}

impl Builder {
    /// For a format that numbers vertices from `first_vertex`.
    pub fn new(first_vertex: usize) -> Self {
        Self { first_vertex, ..Self::default() }
    }

    /// The number of vertices so far.
    pub fn vertices(&self) -> usize {
        self.mesh.vertices.len()
    }

    /// The number of faces so far, with those left out.
    pub fn faces(&self) -> u32 {
        self.faces
    }

    /// Takes a vertex, which may be infinite or no number as long as no face uses it.
    ///
    /// # Errors
    /// More vertices than 32 bits count.
    pub fn vertex(&mut self, point: [f64; 3], line: Option<usize>) -> Result<(), Fault> {
        let number = u32::try_from(self.mesh.vertices.len()).ok().filter(|number| *number < u32::MAX);
        let number =
            number.ok_or_else(|| located(Fault::new("too many vertices", "expected fewer than 2^32 - 1"), line))?;
        if point.iter().any(|x| !x.is_finite()) {
            self.not_finite.insert(number, line);
        }
        self.mesh.vertices.push(point.into());
        Ok(())
    }

    /// Takes a face of the file that cannot be used.
    pub fn left_out(&mut self, defect: Defect, fault: Fault) {
        self.faces += 1;
        self.faults.add(defect, fault);
    }

    /// Takes a face, the corners of which are places of vertices.
    ///
    /// # Errors
    /// A polygon with more corners than are looked at.
    pub fn face(&mut self, corners: &[u32], line: Option<usize>) -> Result<(), Fault> {
        let name = |this: &Self| match line {
            Some(_) => String::new(),
            None => format!("face {}: ", this.faces),
        };
        if corners.len() > polygon::MOST {
            let legal = "expected a polygon of at most 16384 corners";
            return Err(located(Fault::new(format!("{}a face of {} corners", name(self), corners.len()), legal), line));
        }
        if let Some(corner) = corners.iter().find(|corner| self.not_finite.contains_key(corner)) {
            let point = self.mesh.vertices[*corner as usize];
            let bad = point.iter().find(|x| !x.is_finite()).unwrap_or(&f64::NAN);
            let number = *corner as usize + self.first_vertex;
            let fault = Fault::new(format!("vertex {number} has the coordinate {bad}"), FINITE);
            let fault = located(fault, self.not_finite[corner]);
            self.left_out(Defect::NonFinite, fault);
            return Ok(());
        }
        let points: Vec<Point3<f64>> = corners.iter().map(|&corner| self.mesh.vertices[corner as usize]).collect();
        let Some(found) = polygon::triangulate(&points) else {
            let fault = Fault::new(format!("{}a face of {} corners", name(self), corners.len()), POLYGON);
            self.left_out(Defect::NotSimple, located(fault, line));
            return Ok(());
        };
        if let Some(off) = found.off {
            let found = format!("{}a corner is {off:.1e} off the plane of others", name(self));
            self.faults.add(Defect::NotPlanar, located(Fault::new(found, ""), line));
        }
        for (part, triangle) in found.triangles.into_iter().enumerate() {
            self.triangle(triangle.map(|place| corners[place]), part as u32)?;
        }
        self.faces += 1;
        Ok(())
    }

    /// Takes a strip: every corner but the first two makes a triangle with the two before it, every other one turned round.
    /// Corners that repeat join the parts of a strip, and make no triangle.
    ///
    /// # Errors
    /// As [`face`](Self::face).
    pub fn strip(&mut self, corners: &[u32], line: Option<usize>) -> Result<(), Fault> {
        let mut part = 0;
        let face = self.faces;
        for (place, window) in corners.windows(3).enumerate() {
            let [p, q, r] = [window[0], window[1], window[2]];
            if p == q || q == r || r == p {
                continue;
            }
            let triangle = if place % 2 == 0 { [p, q, r] } else { [q, p, r] };
            if let Some(corner) = triangle.iter().find(|corner| self.not_finite.contains_key(corner)) {
                let number = *corner as usize + self.first_vertex;
                let fault = Fault::new(format!("vertex {number} is not finite"), FINITE);
                let fault = located(fault, self.not_finite[corner].or(line));
                self.faults.add(Defect::NonFinite, fault);
            } else {
                self.triangle(triangle, part)?;
            }
            part += 1;
        }
        self.faces = face + 1;
        Ok(())
    }

    fn triangle(&mut self, triangle: [u32; 3], part: u32) -> Result<(), Fault> {
        if self.mesh.faces.len() >= u32::MAX as usize {
            return Err(Fault::new("too many triangles", "expected fewer than 2^32"));
        }
        self.numbers.push(self.mesh.faces.len(), self.faces, part);
        self.mesh.faces.push(triangle);
        Ok(())
    }

    /// Something about the file that is no fault of a face.
    pub fn remark(&mut self, what: &'static str, first: impl FnOnce() -> String) {
        match self.remarks.iter_mut().find(|remark| remark.what == what) {
            Some(remark) => remark.count += 1,
            None => self.remarks.push(Remark { what, count: 1, first: Fault::new(first(), "").brief() }),
        }
    }

    /// The mesh, without the vertices that no face uses: they are on no surface, so they have no say in its box, its scale or its grid.
    /// Among them are all that are not finite.
    pub fn finish(self) -> Parsed {
        let Self { mut mesh, numbers, faults, remarks, .. } = self;
        let mut used = vec![false; mesh.vertices.len()];
        mesh.faces.iter().flatten().for_each(|vertex| used[*vertex as usize] = true);
        if used.contains(&false) {
            let mut moved = vec![0; mesh.vertices.len()];
            let mut kept = vec![];
            for (number, vertex) in mesh.vertices.iter().enumerate() {
                moved[number] = kept.len() as u32;
                if used[number] {
                    kept.push(*vertex);
                }
            }
            mesh.vertices = kept;
            for vertex in mesh.faces.iter_mut().flatten() {
                *vertex = moved[*vertex as usize];
            }
        }
        Parsed { mesh, numbers, faults, remarks }
    }
}
