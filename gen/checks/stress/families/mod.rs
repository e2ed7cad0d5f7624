//! The families of hard pairs: each a name and a small function that makes its cases.

mod contact;
mod coplanar;
mod degenerate;
mod draw;
mod extreme;
mod lattice;
mod parallel;
mod scale;
mod shared;
mod sliver;

use super::hash::{BASIS, fnv};
use draw::{Point, Triangle};
use efsat_geometry::Points;
use efsat_geometry::sample;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

pub(super) use draw::power_of_two;

/// A family of pairs.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What its pairs are, in one line.
    pub what: &'static str,
    make: fn(&mut ChaCha8Rng) -> [Triangle; 2],
}

/// All families, by theme.
pub const FAMILIES: &[Family] = &[
    family("anything", "near, far, touching, coplanar and degenerate at mixed scales", anything),
    family("coplanar-disjoint", "one plane, exactly; on both sides of a line", coplanar::disjoint),
    family("coplanar-overlapping", "one plane, exactly; one centroid", coplanar::overlapping),
    family("coplanar-nested", "one plane, exactly; one inside the other", coplanar::nested),
    family("coplanar-touching", "one plane, exactly; a common vertex, edge or part of one", coplanar::touching),
    family("coplanar-rounded", "one plane but for the rounding of binary64", coplanar::rounded),
    family("parallel-planes", "parallel planes 1 to 8 steps apart, steps of 1 to 2^-34", parallel::planes),
    family("tilted-planes", "planes that differ by a few such steps at each vertex", parallel::tilted),
    family("parallel-edges", "an edge along an edge, exactly or but for a few such steps", parallel::edges),
    family("shared-vertex", "one common vertex", shared::vertex),
    family("shared-vertex-off", "one common vertex but for a few ulps", shared::vertex_off),
    family("shared-edge", "a common edge", shared::edge),
    family("shared-edge-off", "a common edge but for a few ulps", shared::edge_off),
    family("shared-triangle", "the same triangle twice", shared::whole_triangle),
    family("shared-triangle-off", "the same triangle twice but for a few ulps", shared::whole_triangle_off),
    family("vertex-on-face", "a vertex exactly on a face", contact::vertex_on_face),
    family(
        "vertex-on-face-sweep",
        "the same, up to 8 steps off or in, steps of 16 to 2^-40",
        contact::vertex_on_face_sweep,
    ),
    family("vertex-on-edge", "a vertex exactly on an edge", contact::vertex_on_edge),
    family("vertex-on-edge-sweep", "the same, up to 8 such steps off or in", contact::vertex_on_edge_sweep),
    family("edge-on-edge", "two edges that cross exactly", contact::edge_on_edge),
    family("edge-on-edge-sweep", "the same, up to 8 such steps off or in", contact::edge_on_edge_sweep),
    family("sliver-sliver", "needles at or through each other, heights of 2^-5 to 2^-50", sliver::against_sliver),
    family("sliver-beside-sliver", "a needle and the same needle moved a little", sliver::beside_sliver),
    family("sliver-fat", "a needle at or through an ordinary triangle", sliver::against_fat),
    family("tiny-huge", "a triangle 2^-8 to 2^-45 of the size of the other, close to it", scale::tiny_against_huge),
    family("tiny-far", "two tiny triangles far from the origin", scale::tiny_and_far),
    family("large-offset", "a near contact moved by 2^8 to 2^44", scale::large_offset),
    family("far-apart", "ordinary triangles up to 2^60 apart", scale::far_apart),
    family("lattice-3", "coordinates -1, 0, 1", lattice::of_three),
    family("lattice-5", "whole coordinates from -2 to 2", lattice::of_five),
    family("lattice-17", "whole coordinates from -8 to 8", lattice::of_seventeen),
    family("axis-aligned", "right triangles along the axes of a small grid", lattice::right_triangles),
    family("segment-triangle", "a segment and a triangle", degenerate::segment_and_triangle),
    family("segment-segment", "two segments", degenerate::segment_and_segment),
    family("colinear-triangle", "three points of a line and a triangle", degenerate::colinear_and_triangle),
    family(
        "colinear-colinear",
        "three points of a line twice, the same line or not",
        degenerate::colinear_and_colinear,
    ),
    family("point-triangle", "a point and a triangle", degenerate::point_and_triangle),
    family("point-segment", "a point and a segment", degenerate::point_and_segment),
    family("point-point", "two points", degenerate::point_and_point),
    family("denormal", "lattice contacts in units of 2^-1074", extreme::denormal),
    family("overflow", "lattice contacts up to 2^1023", extreme::overflow),
    family("stretched", "lattice contacts, each axis at a scale of its own", extreme::stretched),
    family("binary64-corners", "coordinates at the ends of binary64", extreme::binary64_corners),
    family("mixed-exponents", "every coordinate with an exponent of its own", extreme::mixed_exponents),
    family("domain-corners", "coordinates at +-1, 0 and a fixed-point step beside them", extreme::domain_corners),
    family("grid-18-bit", "multiples of 2^-14, a vertex within a step of the other triangle", extreme::grid_of_18_bits),
    family("grid-working-ulp", "the same with multiples of 2^-16", extreme::grid_of_working_ulps),
    family("grid-input-ulp", "the same with multiples of 2^-28", extreme::grid_of_input_ulps),
    family("between-grid-points", "half-way between such numbers, or nearly so", extreme::between_grid_points),
];

const fn family(name: &'static str, what: &'static str, make: fn(&mut ChaCha8Rng) -> [Triangle; 2]) -> Family {
    Family { name, what, make }
}

impl PartialEq for Family {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

fn anything(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let p = sample::random_points(rng).map(Point::from);
    [[p[0], p[1], p[2]], [p[3], p[4], p[5]]]
}

impl Family {
    /// The family of that name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        FAMILIES.iter().find(|family| family.name == name)
    }

    /// Case `index` under a seed, with the generator for everything else that is random about it. It depends on these
    /// and the family's name only.
    pub fn case(&self, seed: u64, index: u64) -> (Points, ChaCha8Rng) {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&fnv(BASIS, self.name.as_bytes()).to_le_bytes());
        let mut rng = ChaCha8Rng::from_seed(key);
        rng.set_stream(index);
        let [a, b] = (self.make)(&mut rng);
        ([a[0], a[1], a[2], b[0], b[1], b[2]].map(Into::into), rng)
    }
}
