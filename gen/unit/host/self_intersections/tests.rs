//! The unit's answers against those of the software, on grids that the unit has and on one that is too fine for it.

use super::*;
use crate::params::Method;
use efsat_geometry::self_intersections::Search;
use nalgebra::Point3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::convert::Infallible;

#[test]
fn the_unit_finds_what_the_software_finds() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let params = Params { width: 6, ..Params::of(Method::Exact) };
    let mut counts = [0; 5];
    let mut of_host = 0;
    for round in 0..4000 {
        let size = rng.random_range(1..=3);
        // Differences beyond 6 bits in some rounds.
        let unit = if round % 8 == 0 { 50.0 } else { 1.0 };
        let mut vertices: Vec<[i64; 3]> = (0..9).map(|_| [0; 3].map(|_: i64| rng.random_range(0..=size))).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let count = vertices.len() as u32;
        let faces: Vec<[u32; 3]> = (0..8).map(|_| [0; 3].map(|_: u32| rng.random_range(0..count))).collect();
        // Odd numbers keep the unit's own grid from being coarser.
        let place = |x: i64| if unit > 1.0 && x > 0 { unit * x as f64 + 1.0 } else { x as f64 };
        let vertices: Vec<_> = vertices.iter().map(|x| Point3::from(x.map(place))).collect();
        let mesh = Mesh::new(vertices, faces).unwrap();
        let mut expected = vec![];
        let Ok(()) = Search::new(&mesh, false).each(|_, defects, _| {
            expected.extend_from_slice(defects);
            Ok::<(), Infallible>(())
        });
        let checker = Checker::new(&mesh, &params, true);
        let pairs: Vec<(u32, u32)> = (0..8).flat_map(|q| (0..q).map(move |p| (p, q))).collect();
        let (mut defects, effort, asked) = checker.check(&pairs);
        defects.sort_unstable();
        assert_eq!(defects, expected, "{mesh:?}");
        assert_eq!((effort.contradictions, effort.candidates), (0, pairs.len() as u64));
        let listed: usize = pairs.iter().map(|pair| checker.asked(*pair).len()).sum();
        assert_eq!(asked.asked + asked.by_host, listed as u64);
        of_host += asked.by_host;
        defects.iter().for_each(|defect| counts[defect.kind as usize] += 1);
        counts[4] += pairs.len() - defects.len();
        // No defect is outside the candidates.
        let mut found = 0;
        let Ok(()) = checker.candidates(|pairs| {
            found += checker.check(pairs).0.len();
            Ok::<(), Infallible>(())
        });
        assert_eq!(found, defects.len());
    }
    assert!(counts.iter().all(|count| *count > 100) && of_host > 1000, "{counts:?} {of_host}");
}
