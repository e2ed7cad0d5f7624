//! The switched model beside the reference model and beside the exact answers.

use super::super::pairs::{Amount, Asked, Pairs};
use super::*;
use efsat_geometry::exact::Exact as Class;
use efsat_geometry::scene::Scene;
use efsat_hardware::testing::full;
use efsat_unit::golden::AxisAnswer;
use efsat_unit::params::{Axes, Projections, Transform, Upper};

fn settings() -> Vec<Params> {
    let base = Params::default();
    let upper = Upper::Sticky;
    vec![
        base.clone(),
        Params { axes: Axes::Seventeen, upper, projections: Projections::Intersect, ..base.clone() },
        Params { width: 10, projections: Projections::Skip, axes: Axes::Seventeen, ..base.clone() },
        Params { renormalise: false, ..base.clone() },
        Params { renormalise: false, width: 24, transform_width: 24, upper, ..base.clone() },
        Params { width: 20, transform_width: 20, int_bits: 6, ..base.clone() },
        Params { transform: Transform::Off, ..base.clone() },
        Params { transform: Transform::Translate, upper, ..base.clone() },
        Params { width: 32, transform_width: 48, ..base },
    ]
}

/// All stages rounded: every flag of every axis is the reference model's.
#[test]
fn rounded_is_the_reference_model() {
    let scene = Scene::against_itself("headlight", (*efsat_geometry::mesh::headlight()).clone(), 4, &[1.45]).unwrap();
    let pairs = Pairs::draw(&scene, Amount::Some(if full() { 160 } else { 40 }), 3).unwrap();
    let mut wrong = vec![];
    let mut compared = 0;
    for params in settings() {
        let (asked, rounded) = (Asked::new(&pairs, &params), Model::new(&params, Lossless::NONE));
        for place in 0..pairs.len() {
            let (Some(case), Some(outcome)) = (Case::new(&asked, place), asked.outcome(place)) else { continue };
            let axes = rounded.axes(&case);
            let flags =
                |of: fn(&AxisAnswer) -> bool| axes.iter().rev().fold(0, |bits, axis| bits << 1 | u32::from(of(axis)));
            if (flags(|axis| axis.separated), flags(|axis| axis.overlapping))
                != (outcome.separated, outcome.overlapping)
            {
                wrong.push((place, params.command_line()));
            }
            compared += 1;
        }
    }
    assert!(
        wrong.is_empty() && compared > if full() { 1000 } else { 250 },
        "{compared} compared, first wrong {:?}",
        wrong.first()
    );
}

/// No stage rounded: what is left open is a contact, coplanar, degenerate, or has an axis that is zero; and every
/// definite answer is the exact one.
#[test]
fn exact_leaves_genuine_cases_alone() {
    let turned =
        Scene::against_itself("headlight", (*efsat_geometry::mesh::headlight()).clone(), 4, &[1.45, 1.4]).unwrap();
    let tumbling = Scene::default_scene();
    let (mut definite, mut genuine, mut wrong) = (0, Reasons::default(), vec![]);
    for (scene, amount) in [(&turned, 400), (&tumbling, 200)] {
        let pairs = Pairs::draw(scene, Amount::Some(amount), 5).unwrap();
        for params in settings().iter().take(2) {
            let (asked, exact) = (Asked::new(&pairs, params), Model::new(params, Lossless::ALL));
            for place in 0..pairs.len() {
                let Some(case) = Case::new(&asked, place) else { continue };
                let (axes, relation) = (exact.axes(&case), pairs.relation(place));
                let separated = axes.iter().any(|axis| axis.separated);
                let overlapping = axes[..11].iter().all(|axis| axis.overlapping);
                let fits = match (separated, overlapping, Reason::of(relation, &axes)) {
                    (true, false, None) => relation.class == Class::Separate,
                    (false, true, None) => relation.class == Class::Intersect,
                    (false, false, Some(reason)) => {
                        genuine.add(reason);
                        let zero = axes[..11].iter().any(|axis| axis.zero);
                        relation.coplanar
                            || relation.class == Class::Touch
                            || (relation.class == Class::Intersect && zero)
                    }
                    _ => false,
                };
                definite += u64::from(separated || overlapping);
                if !fits {
                    wrong.push((place, relation));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
    assert!(definite > 900 && genuine.total() > 0, "{definite} definite, {genuine:?}");
}

/// The parts and the genuine cases are everything, whatever the counts.
#[test]
fn parts_add_up() {
    let counts: [u64; 32] = std::array::from_fn(|set| (set * set * 7 % 90) as u64);
    let sum: f64 = Loss::ALL.iter().map(|stage| part(&counts, *stage)).sum();
    assert!((sum - (counts[31] as f64 - counts[0] as f64)).abs() < 1e-9);
    // A stage that changes nothing has no part; one that does everything has all.
    let only_axis: [u64; 32] = std::array::from_fn(|set| if set >> Loss::Axis as usize & 1 == 1 { 50 } else { 0 });
    assert_eq!(part(&only_axis, Loss::Input), 0.0);
    assert!((part(&only_axis, Loss::Axis) - 50.0).abs() < 1e-9);
}
