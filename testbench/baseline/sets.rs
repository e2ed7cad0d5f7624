//! The parameter sets: every option over its values, one at a time, then seeded combinations.

use super::vectors::Draw;
use efsat::params::options::Choice;
use efsat::params::{Axes, Guard, Params, Projections, Transform, Upper};

/// The default design at the commit of the record: the paper's, with a guard only where a stage is left out.
pub fn default() -> Params {
    Params { guard: Guard::LeftOut, ..Params::paper() }
}

/// Combinations.
const COMBINED: usize = 60;

/// The options of a parameter set as on the command line, those that are not the default's.
pub fn options(p: &Params) -> String {
    let (given, default) = (p.options(), default().options());
    let other = given.iter().zip(&default).filter(|(given, default)| given != default);
    let options: Vec<String> = other.map(|((name, value), _)| format!("--{name} {value}")).collect();
    if options.is_empty() { "(default)".to_owned() } else { options.join(" ") }
}

/// All parameter sets, the default first.
pub fn all() -> Vec<Params> {
    let mut sets = one_at_a_time();
    let mut draw = Draw(269);
    let count = sets.len() + COMBINED;
    while sets.len() < count {
        let p = combination(&mut draw);
        if p.validate().is_ok() && !sets.contains(&p) {
            sets.push(p);
        }
    }
    sets
}

fn one_at_a_time() -> Vec<Params> {
    let mut sets = vec![default()];
    let mut set = |change: &dyn Fn(&mut Params)| {
        let mut p = default();
        change(&mut p);
        p.validate().expect("a legal parameter set");
        sets.push(p);
    };
    for width in [6, 7, 8, 9, 10, 12, 14, 16, 17, 19, 20, 22, 24, 25, 28, 30, 31, 32] {
        set(&|p| p.width = width);
    }
    for width in [6, 8, 10, 12, 17, 18, 24] {
        set(&|p| (p.width, p.transform_width) = (width, width));
    }
    for transform_width in [19, 20, 24, 28, 31, 33, 34, 35, 36, 40, 44, 47, 48] {
        set(&|p| p.transform_width = transform_width);
    }
    for int_bits in 5..=8 {
        set(&|p| p.int_bits = int_bits);
    }
    for axes_per_clock in [2, 3, 4, 6, 11] {
        set(&|p| p.axes_per_clock = axes_per_clock);
    }
    for axes_per_clock in [1, 2, 3, 4, 6, 11, 17] {
        set(&|p| (p.axes, p.axes_per_clock) = (Axes::Seventeen, axes_per_clock));
    }
    for projections in [Projections::Skip, Projections::Intersect] {
        set(&|p| p.projections = projections);
        set(&|p| (p.projections, p.axes) = (projections, Axes::Seventeen));
    }
    for width in [6, 7, 9, 12, 18, 25, 32] {
        set(&|p| (p.upper, p.width) = (Upper::Sticky, width));
    }
    set(&|p| (p.upper, p.axes) = (Upper::Sticky, Axes::Seventeen));
    for &transform in Transform::ALL {
        for &renormalise in bool::ALL {
            for &guard in Guard::ALL {
                if (transform, renormalise, guard) != (Transform::On, true, Guard::LeftOut) {
                    set(&|p| (p.transform, p.renormalise, p.guard) = (transform, renormalise, guard));
                }
            }
        }
    }
    for frequency in [20, 50, 133, 200, 250] {
        set(&|p| p.frequency = frequency);
    }
    for device in ["xc6slx150-3", "xc7a200t-1", "lfe5u-85-6"] {
        set(&|p| p.device = device.to_owned());
    }
    for tag_width in [0, 64] {
        set(&|p| p.tag_width = tag_width);
    }
    sets
}

fn combination(draw: &mut Draw) -> Params {
    Params {
        width: draw.one_of(&[6, 8, 11, 12, 14, 16, 18, 18, 19, 21, 24, 27, 32]),
        int_bits: draw.one_of(&[4, 4, 5, 6, 7, 8]),
        transform_width: draw.one_of(&[12, 16, 18, 20, 26, 32, 32, 36, 42, 48]),
        axes: draw.one_of(Axes::ALL),
        axes_per_clock: draw.one_of(&[1, 2, 3, 4, 6, 11, 17]),
        projections: draw.one_of(Projections::ALL),
        upper: draw.one_of(Upper::ALL),
        renormalise: draw.one_of(&[true, true, false]),
        transform: draw.one_of(Transform::ALL),
        guard: draw.one_of(Guard::ALL),
        device: draw.one_of(&["xc2v6000-4", "xc2v6000-4", "xc6slx150-3", "xc7a200t-1", "lfe5u-85-6"]).to_owned(),
        frequency: draw.one_of(&[20, 66, 100, 100, 150, 250]),
        tag_width: draw.one_of(&[0, 8, 16]),
        // Options that came later.
        ..default()
    }
}
