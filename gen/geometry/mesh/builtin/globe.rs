//! A globe of meridians and parallels.

use crate::mesh::Mesh;
use crate::mesh::angle::sin_cos_degrees;
use nalgebra::Point3;

/// A sphere of radius 1 about the origin, `around` meridians and `high` zones. Every quadrilateral of the net is split in
/// two, those at the poles too, as some tessellators do: one half of them has a side from the pole to the pole and is a
/// segment.
pub(super) fn mesh(around: u32, high: u32) -> Mesh {
    let (south, north) = (0, 1);
    let mut vertices = vec![Point3::new(0.0, 0.0, -1.0), Point3::new(0.0, 0.0, 1.0)];
    for zone in 1..high {
        let (s, c) = sin_cos_degrees(180.0 * f64::from(zone) / f64::from(high));
        for meridian in 0..around {
            let (y, x) = sin_cos_degrees(360.0 * f64::from(meridian) / f64::from(around));
            vertices.push(Point3::new(s * x, s * y, -c));
        }
    }
    let vertex = |meridian: u32, zone: u32| match zone {
        0 => south,
        zone if zone == high => north,
        zone => 2 + (zone - 1) * around + meridian % around,
    };
    let quad = |meridian: u32, zone: u32| {
        let [p, q] = [0, 1].map(|step| vertex(meridian + step, zone));
        let [s, r] = [0, 1].map(|step| vertex(meridian + step, zone + 1));
        [[p, q, r], [p, r, s]]
    };
    let faces = (0..high).flat_map(|zone| (0..around).flat_map(move |meridian| quad(meridian, zone))).collect();
    Mesh { vertices, faces }
}
