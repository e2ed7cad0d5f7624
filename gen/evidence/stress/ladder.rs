//! Other parameter sets that every case is asked on: narrower and wider, and every other option changed alone.

use efsat_unit::params::options::{Affects, Choice, TRANSFORM_WIDTH, WIDTH};
use efsat_unit::params::{Axes, Params, Projections, Upper};

/// Working widths of the ladder.
const WIDTHS: [u32; 9] = [6, 8, 10, 12, 15, 18, 21, 26, 32];

/// Transform widths of the ladder.
const TRANSFORM_WIDTHS: [u32; 6] = [18, 20, 24, 32, 40, 48];

/// All parameter sets of the ladder, the given one left out. The working width and the transform width go over their
/// ranges, and next to the given one; then every choice, alone.
pub(super) fn rungs(params: &Params) -> Vec<Params> {
    let mut rungs = vec![];
    let beside = [params.width - 1, params.width + 1];
    for width in WIDTHS.into_iter().chain(beside).filter(|width| WIDTH.contains(width)) {
        let int_bits = params.int_bits.min(width - 2);
        let transform_width = params.transform_width.max(width);
        rungs.push(Params { width, int_bits, transform_width, ..params.clone() });
    }
    let beside = [params.transform_width - 1, params.transform_width + 1];
    let legal = |width: &u32| (params.width..=TRANSFORM_WIDTH).contains(width);
    for transform_width in TRANSFORM_WIDTHS.into_iter().chain(beside).filter(legal) {
        rungs.push(Params { transform_width, ..params.clone() });
    }
    rungs.extend(Axes::ALL.iter().map(|&axes| Params { axes, axes_per_clock: 1, ..params.clone() }));
    rungs.extend(Projections::ALL.iter().map(|&projections| Params { projections, ..params.clone() }));
    rungs.extend(Upper::ALL.iter().map(|&upper| Params { upper, ..params.clone() }));
    rungs.extend(bool::ALL.iter().map(|&renormalise| Params { renormalise, ..params.clone() }));
    let given = arithmetic(params);
    rungs.retain(|rung| arithmetic(rung) != given);
    let mut seen = vec![];
    rungs.retain(|rung| {
        let new = !seen.contains(&arithmetic(rung));
        seen.push(arithmetic(rung));
        new && rung.validate().is_ok()
    });
    rungs
}

/// Options that decide the verdict of a pair inside the declared ranges; the others are about speed, or about pairs outside.
fn arithmetic(params: &Params) -> Vec<(&'static str, String)> {
    let options = params.options().into_iter().zip(Params::OPTIONS);
    options.filter(|(_, (_, affects))| *affects == Affects::Verdicts).map(|(option, _)| option).collect()
}

/// The options in which `params` differs from `base`, as a command line has them.
pub(super) fn difference(params: &Params, base: &Params) -> String {
    let pairs = arithmetic(params).into_iter().zip(arithmetic(base));
    let changed = pairs.filter(|(x, y)| x != y).map(|((name, value), _)| format!("--{name} {value}"));
    changed.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rungs_of_the_default_design() {
        let base = Params::default();
        let names: Vec<String> = rungs(&base).iter().map(|rung| difference(rung, &base)).collect();
        let widths = [6, 8, 10, 12, 15, 21, 26, 32, 17, 19].map(|n| format!("--width {n}"));
        let transforms = [18, 20, 24, 40, 48, 31, 33].map(|n| format!("--transform-width {n}"));
        let others =
            ["--axes 17", "--projections skip", "--projections intersect", "--upper sticky", "--renormalise off"];
        let expected: Vec<String> = widths.into_iter().chain(transforms).chain(others.map(str::to_owned)).collect();
        assert_eq!(names, expected);
    }

    #[test]
    fn every_rung_is_legal_and_different() {
        let ends = [(6, 4, 6), (6, 4, 48), (18, 8, 18), (32, 8, 48), (9, 7, 30)];
        for (width, int_bits, transform_width) in ends {
            let base = Params { width, int_bits, transform_width, ..Params::default() };
            base.validate().unwrap();
            let all = rungs(&base);
            assert!(all.len() >= 12, "{}", all.len());
            for (i, rung) in all.iter().enumerate() {
                assert!(rung.validate().is_ok() && !difference(rung, &base).is_empty());
                assert!(all[..i].iter().all(|other| !difference(rung, other).is_empty()));
            }
        }
    }
}
