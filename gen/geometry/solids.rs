//! Whether two solids have a common inside, or only touch.
//!
//! A *solid* is what a closed mesh bounds whose triangles are oriented outward and have no more in common than vertices and edges:
//! next to a point of a triangle the material is below it, as its corners turn to the left seen from above. Its inside is open. Cavities
//! are components that are oriented into them.
//!
//! Two solids *overlap* if their insides have a common point. That is so if and only if
//! 1. a part of the surface of one is inside the other; or
//! 2. triangles of both share area and have the material on the same side.
//!
//! For if neither is so and the insides meet, then a component of one inside is a component of the other, as none is cut by a surface;
//! so its surface is that of both, and 2 is so. For 1, take the surface of A without what it has in common with that of B: each
//! connected part of that is inside B or outside as a whole. One that is a whole component of A is told by the parity of a ray. Any other
//! part reaches a point of contact, and in a triangle of A there: the part of a triangle beside its contacts ends at corners of what
//! triangles have in common (`exact::clipped`), because contacts of a triangle with two triangles of B meet at such corners, B having
//! no self-intersections. So it is enough to ask for every such corner x, in the plane of every triangle at x, for every direction between
//! two neighbouring contacts or edges, whether the first step from x is inside the other solid.
//!
//! That is told by the triangles of the other solid at x (`is_inside`): on the way from the direction d to a direction m inside one of
//! them, along d (1 - s) + m s, the first one that is crossed has d below it or above it. All of it is exact. Ways that cross an edge
//! or run in a triangle tell nothing; but with weights 1, i, i^2 of the corners, m is in a given plane for two i at most, so one
//! of a few ways does.
//!
//! ```
//! use efsat_geometry::solids::{Solid, Solids};
//! use efsat_geometry::{Mesh, Pose};
//!
//! let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let solid = Solid::new(Mesh::new(corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?)?;
//! // Upside down below it, face to face; a step of binary64 higher; in the same place.
//! let below = |z: f64| Pose::from_rows([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]], [0.0, 0.0, z]);
//! assert_eq!(solid.beside(&solid, &below(0.0)?)?, Solids::Abut);
//! assert_eq!(solid.beside(&solid, &below(5e-324)?)?, Solids::Overlap);
//! assert_eq!(solid.beside(&solid, &Pose::identity())?, Solids::Overlap);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::collide::{Body, Collider, Components, OpenEdge, Pose};
use crate::exact::{ContactKind, ExactPoint, Motion, Scaled, Whole, clipped, cross, difference, dot, is_zero, whole};
use crate::self_intersections::{self, Defect};
use num_bigint::{BigInt, Sign};
use num_traits::Signed;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// How two solids lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Solids {
    /// No common point.
    Apart,
    /// Their surfaces have common points, their insides have none: two boxes face to face.
    Abut,
    /// Their insides have a common point. One may be inside the other.
    Overlap,
}

/// Why a mesh bounds no solid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotSolid {
    /// It is open.
    #[error(transparent)]
    Open(#[from] OpenEdge),
    /// Two triangles at an edge have it in one direction, so that one of them is turned around.
    #[error("triangle {triangle} has an edge in the direction of another one: expected neighbours that turn alike")]
    Turned {
        /// The first such triangle, counted from 0.
        triangle: u32,
    },
    /// Triangles intersect.
    #[error("triangles {} and {} intersect ({}): expected nothing but common vertices and edges", .0.pair.0, .0.pair.1, .0.kind.name())]
    Intersects(Defect),
    /// A component is inside out.
    #[error(
        "component {component} is inside out: expected triangles that turn to the left seen from outside the material"
    )]
    InsideOut {
        /// The component, counted from 0.
        component: u32,
    },
    /// The matrix of the pose has no inverse.
    #[error("the matrix of the pose has the determinant 0: expected a solid that stays one")]
    Flat,
}

/// Looks at whether a mesh bounds a solid.
fn check(body: &Body) -> Result<(), NotSolid> {
    let (mesh, components) = (body.mesh(), body.components()?);
    let welded = mesh.welded();
    let mut balance: BTreeMap<(u32, u32), i64> = BTreeMap::new();
    let edges = |face: &[u32; 3]| [(face[0], face[1]), (face[1], face[2]), (face[2], face[0])];
    for (p, q) in welded.faces().iter().flat_map(edges).filter(|(p, q)| p != q) {
        *balance.entry((p.min(q), p.max(q))).or_default() += if p < q { 1 } else { -1 };
    }
    let is_turned = |face: &[u32; 3]| {
        edges(face).iter().any(|&(p, q)| balance.get(&(p.min(q), p.max(q))).is_some_and(|sum| *sum != 0))
    };
    if let Some(triangle) = welded.faces().iter().position(is_turned) {
        return Err(NotSolid::Turned { triangle: triangle as u32 });
    }
    if let Some(defect) = self_intersections::find(mesh).first() {
        return Err(NotSolid::Intersects(*defect));
    }
    let places: Vec<[Scaled; 3]> = mesh.vertices().iter().map(|v| [v.x, v.y, v.z].map(Scaled::from)).collect();
    let (vertices, _) = whole(&places);
    let mut volumes = vec![BigInt::ZERO; components.len()];
    for (number, face) in mesh.faces().iter().enumerate() {
        let [p, q, r] = face.map(|vertex| &vertices[vertex as usize]);
        volumes[components.of(number as u32) as usize] += dot(p, &cross(q, r));
    }
    let depths = components.depths(mesh);
    let inside_out = |(volume, depth): (&BigInt, &usize)| match volume.sign() {
        Sign::NoSign => false,
        sign => (sign == Sign::Plus) != (depth % 2 == 0),
    };
    match volumes.iter().zip(&depths).position(inside_out) {
        Some(component) => Err(NotSolid::InsideOut { component: component as u32 }),
        None => Ok(()),
    }
}

/// A body whose mesh is known to bound a solid. Copies share it.
#[derive(Clone, Debug)]
pub struct Solid(Body);

impl Solid {
    /// The solid of a mesh or body.
    ///
    /// # Errors
    /// Why it bounds none.
    pub fn new(body: impl Into<Body>) -> Result<Self, NotSolid> {
        let body = body.into();
        check(&body)?;
        Ok(Self(body))
    }

    /// How it lies to another one in a pose as seen from it, exactly.
    ///
    /// # Errors
    /// If the pose makes the other one flat.
    pub fn beside(&self, other: &Self, pose: &Pose) -> Result<Solids, NotSolid> {
        let ([a, b], legal) = ([&self.0, &other.0], "solids are closed");
        let components = [a, b].map(|body| body.components().expect(legal));
        let turns = determinant(pose);
        if turns == Sign::NoSign {
            return Err(NotSolid::Flat);
        }
        let contacts = Collider::new(a, b).contacts(pose);
        if contacts.iter().any(|contact| contact.kind == ContactKind::Crossing) {
            return Ok(Solids::Overlap);
        }
        // What else touches, in whole numbers, B with its triangles as they turn in the pose.
        let touched: [Vec<u32>; 2] = [
            contacts.iter().map(|contact| contact.a).collect::<BTreeSet<_>>().into_iter().collect(),
            contacts.iter().map(|contact| contact.b).collect::<BTreeSet<_>>().into_iter().collect(),
        ];
        let motion = Motion::new(&pose.rows(), &pose.translation().into());
        let mut places: Vec<[Scaled; 3]> = vec![];
        for &face in &touched[0] {
            places.extend(a.triangle(face).map(|corner| corner.map(Scaled::from)));
        }
        for &face in &touched[1] {
            let [p, q, r] = b.triangle(face).map(|corner| motion.image(&corner));
            places.extend(if turns == Sign::Minus { [p, r, q] } else { [p, q, r] });
        }
        let (corners, _) = whole(&places);
        let facets: Vec<Option<Facet>> = corners.chunks(3).map(Facet::new).collect();
        let (of_a, of_b) = facets.split_at(touched[0].len());
        let place = |side: usize, face: u32| touched[side].binary_search(&face).expect("it touches");
        let mut partners = [vec![vec![]; of_a.len()], vec![vec![]; of_b.len()]];
        for contact in &contacts {
            let (p, q) = (place(0, contact.a), place(1, contact.b));
            // Segments and points bound nothing: what they touch, their neighbours touch.
            if let (Some(x), Some(y)) = (&of_a[p], &of_b[q]) {
                if contact.kind == ContactKind::Coplanar && dot(&x.normal, &y.normal).is_positive() {
                    return Ok(Solids::Overlap);
                }
                partners[0][p].push(y);
                partners[1][q].push(x);
            }
        }
        let enters = |(facet, partners): (&Option<Facet>, &Vec<&Facet>)| {
            facet.as_ref().is_some_and(|facet| facet.enters(partners))
        };
        if of_a.par_iter().zip(&partners[0]).any(enters) || of_b.par_iter().zip(&partners[1]).any(enters) {
            return Ok(Solids::Overlap);
        }
        let touching: [BTreeSet<u32>; 2] =
            [0, 1].map(|side| touched[side].iter().map(|&face| components[side].of(face)).collect());
        if Components::enter([a.mesh(), b.mesh()], components, pose, &touching) {
            return Ok(Solids::Overlap);
        }
        Ok(if contacts.is_empty() { Solids::Apart } else { Solids::Abut })
    }
}

/// The sign of the determinant of the matrix of a pose, exactly.
fn determinant(pose: &Pose) -> Sign {
    let (rows, _) = whole(&pose.rows().map(|row| row.map(Scaled::from)));
    dot(&rows[0], &cross(&rows[1], &rows[2])).sign()
}

/// A triangle with area.
struct Facet {
    corners: [Whole; 3],
    /// Out of the material.
    normal: Whole,
}

impl Facet {
    fn new(corners: &[Whole]) -> Option<Self> {
        let corners = [0, 1, 2].map(|k| corners[k].clone());
        let normal = cross(&difference(&corners[1], &corners[0]), &difference(&corners[2], &corners[0]));
        (!is_zero(&normal)).then_some(Self { corners, normal })
    }

    /// Whether a part of it, beside what it has in common with the triangles of a solid that touch it, is inside that.
    fn enters(&self, others: &[&Facet]) -> bool {
        let shared: Vec<Vec<ExactPoint>> = others.iter().map(|other| clipped(&self.corners, &other.corners)).collect();
        let mut asked: Vec<&ExactPoint> = vec![];
        shared.iter().flatten().any(|x| {
            let is_new = !asked.contains(&x);
            if is_new {
                asked.push(x);
            }
            is_new && self.enters_at(x, others, &shared)
        })
    }

    /// The same next to a point of contact.
    fn enters_at(&self, x: &ExactPoint, others: &[&Facet], shared: &[Vec<ExactPoint>]) -> bool {
        // What is in common has x if it has no greater hull with it; corners of it are the ways to it from there.
        let at: Vec<(Wedge, &Vec<ExactPoint>)> =
            others.iter().zip(shared).filter_map(|(other, shared)| Some((Wedge::new(other, x)?, shared))).collect();
        let mut ways: Vec<Whole> = at.iter().flat_map(|(_, shared)| shared.iter().map(|y| x.towards(y))).collect();
        ways.extend(self.corners.iter().map(|corner| x.towards_whole(corner)));
        ways.retain(|way| !is_zero(way));
        let own = Wedge::new(self, x).expect("what is in common is in it");
        let between = sectors(ways, &self.normal);
        let wedges: Vec<&Wedge> = at.iter().map(|(wedge, _)| wedge).collect();
        between.iter().filter(|way| own.side(way) == Side::Inside).any(|way| {
            let is_on = |wedge: &&Wedge| !wedge.is_off(way) && wedge.side(way) == Side::Inside;
            !wedges.iter().any(is_on) && is_inside(way, &wedges)
        })
    }
}

/// Directions between neighbouring ones of some, all of them in the plane of a normal.
fn sectors(mut ways: Vec<Whole>, normal: &Whole) -> Vec<Whole> {
    let first = ways[0].clone();
    let turn = |p: &Whole, q: &Whole| dot(&cross(p, q), normal).sign();
    // Around from the first one: up to half a turn, or more.
    let half = |way: &Whole| match turn(&first, way) {
        Sign::Plus => 1,
        Sign::Minus => 3,
        Sign::NoSign if dot(&first, way).is_positive() => 0,
        Sign::NoSign => 2,
    };
    ways.sort_by(|p, q| half(p).cmp(&half(q)).then_with(|| Sign::NoSign.cmp(&turn(p, q))));
    ways.dedup_by(|p, q| half(p) == half(q) && turn(p, q) == Sign::NoSign);
    let next = |k: usize| &ways[(k + 1) % ways.len()];
    (0..ways.len())
        .map(|k| match turn(&ways[k], next(k)) {
            Sign::Plus => sum(&ways[k], next(k)),
            Sign::Minus => sum(&ways[k], next(k)).map(|x| -x),
            // Half a turn; or all of it, where there is only one.
            Sign::NoSign => cross(normal, &ways[k]),
        })
        .collect()
}

fn sum(p: &Whole, q: &Whole) -> Whole {
    [0, 1, 2].map(|i| &p[i] + &q[i])
}

/// Where a direction in the plane of a triangle leads from a point of it.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Inside,
    Edge,
    Outside,
}

/// A triangle as seen from one of its points: directions.
struct Wedge<'a> {
    facet: &'a Facet,
    /// Directions to its corners.
    spokes: [Whole; 3],
    /// Out of the edges that the point is on, in the plane: from the inside none of them is left behind.
    inward: Vec<Whole>,
}

impl<'a> Wedge<'a> {
    /// None if the point is not one of the triangle.
    fn new(facet: &'a Facet, x: &ExactPoint) -> Option<Self> {
        let spokes = facet.corners.each_ref().map(|corner| x.towards_whole(corner));
        if !dot(&facet.normal, &spokes[0]).is_zero_sign() {
            return None;
        }
        let mut inward = vec![];
        for (k, spoke) in spokes.iter().enumerate() {
            let upright = cross(&facet.normal, &difference(&facet.corners[(k + 1) % 3], &facet.corners[k]));
            // How far x is from the edge, times minus a positive number.
            match dot(&upright, spoke).sign() {
                Sign::Plus => return None,
                Sign::NoSign => inward.push(upright),
                Sign::Minus => {}
            }
        }
        Some(Self { facet, spokes, inward })
    }

    /// Whether a direction leads out of the plane.
    fn is_off(&self, way: &Whole) -> bool {
        !dot(&self.facet.normal, way).is_zero_sign()
    }

    /// Where a direction in the plane leads.
    fn side(&self, way: &Whole) -> Side {
        let least = self.inward.iter().map(|inward| dot(inward, way).sign()).min();
        match least {
            Some(Sign::Minus) => Side::Outside,
            Some(Sign::NoSign) => Side::Edge,
            Some(Sign::Plus) | None => Side::Inside,
        }
    }

    /// A direction to its inside, one of many.
    fn middle(&self, number: u32) -> Whole {
        let weights = [1, number, number * number];
        [0, 1, 2].map(|i| (0..3).map(|k| &self.spokes[k][i] * weights[k]).sum())
    }
}

/// Whether a number is zero.
trait ZeroSign {
    fn is_zero_sign(&self) -> bool;
}

impl ZeroSign for BigInt {
    fn is_zero_sign(&self) -> bool {
        self.sign() == Sign::NoSign
    }
}

/// Whether the first step along a direction from a point leads into the solid of the triangles at that point, on none of which it is.
fn is_inside(way: &Whole, wedges: &[&Wedge<'_>]) -> bool {
    // Each plane that a way must not be in rules out two numbers at most: those through the direction and each edge, and the planes.
    let most = 8 * wedges.len() as u32 + 2;
    let targets = (1..=most).flat_map(|number| (0..wedges.len()).map(move |target| (number, target)));
    let mut told = targets.filter_map(|(number, target)| first_crossed(way, wedges, target, number));
    told.next().expect("a closed surface is crossed")
}

/// Whether a direction is below the first triangle that is crossed on the way to the inside of one of them, if that tells it.
fn first_crossed(way: &Whole, wedges: &[&Wedge<'_>], target: usize, number: u32) -> Option<bool> {
    let middle = wedges[target].middle(number);
    // The share of the way to the first crossing as a fraction, and whether the direction is below.
    let start = dot(&wedges[target].facet.normal, way);
    let mut first: (BigInt, BigInt) = (1.into(), 1.into());
    let mut below = match start.sign() {
        Sign::NoSign => return None,
        sign => sign == Sign::Minus,
    };
    for (_, wedge) in wedges.iter().enumerate().filter(|(place, _)| *place != target) {
        let [from, to] = [way, &middle].map(|x| dot(&wedge.facet.normal, x));
        match (from.sign(), to.sign()) {
            (Sign::NoSign, Sign::NoSign) => return None,
            (Sign::Plus, Sign::Minus) | (Sign::Minus, Sign::Plus) => {}
            _ => continue,
        }
        let (near, far) = (from.abs(), to.abs());
        let crossed = [0, 1, 2].map(|i| &way[i] * &far + &middle[i] * &near);
        let share = (near.clone(), near + far);
        match wedge.side(&crossed) {
            Side::Outside => continue,
            Side::Edge => return None,
            Side::Inside if is_zero(&crossed) => return None,
            Side::Inside => {}
        }
        if &share.0 * &first.1 < &first.0 * &share.1 {
            first = share;
            below = from.sign() == Sign::Minus;
        }
    }
    Some(below)
}

#[cfg(test)]
mod tests;
