//! Other parameter sets that every case is asked on: narrower and wider, and every other option changed alone.

use efsat_unit::params::options::{Affects, Choice, TRANSFORM_WIDTH, WIDTH};
use efsat_unit::params::{Axes, Bound, EXACT_CLOCKS, LEVELS, Method, Params, Projections, SPAN, Upper};

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
    match params.method {
        Method::Axes => {
            rungs.extend(Axes::ALL.iter().map(|&axes| Params { axes, axes_per_clock: 1, ..params.clone() }));
            rungs.extend(Projections::ALL.iter().map(|&projections| Params { projections, ..params.clone() }));
            rungs.extend(Upper::ALL.iter().map(|&upper| Params { upper, ..params.clone() }));
            rungs.extend(bool::ALL.iter().map(|&renormalise| Params { renormalise, ..params.clone() }));
        }
        Method::Determinants => {
            rungs.extend(SPAN.iter().map(|&span| Params { span, ..params.clone() }));
            rungs.extend(LEVELS.iter().map(|&levels| Params { levels, ..params.clone() }));
            rungs.extend(Bound::ALL.iter().map(|&bound| Params { bound, ..params.clone() }));
            rungs.extend(bool::ALL.iter().map(|&boxes| Params { boxes, ..params.clone() }));
        }
        Method::Exact => {
            let exact_clocks = params.exact_clocks.is_none().then_some(*EXACT_CLOCKS.start());
            rungs.push(Params { exact_clocks, ..params.clone() });
        }
    }
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

/// Whether an option decides the verdict of a pair inside the declared ranges; the others are about speed, or about pairs
/// outside.
fn is_arithmetic(name: &str) -> bool {
    Params::OPTIONS.iter().any(|option| option.name == name && option.affects == Affects::Verdicts)
}

/// The options that decide verdicts.
fn arithmetic(params: &Params) -> Vec<(&'static str, String)> {
    params.options().into_iter().filter(|(name, _)| is_arithmetic(name)).collect()
}

/// The options in which `params` differs from `base`, as a command line has them.
pub(super) fn difference(params: &Params, base: &Params) -> String {
    let changed = params.differences(base).into_iter().filter(|(name, _)| is_arithmetic(name));
    changed.map(|(name, value)| format!("--{name} {value}")).collect::<Vec<_>>().join(" ")
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
            ["--axes 17", "--projections all", "--projections intersect", "--upper sticky", "--renormalise off"];
        let expected: Vec<String> = widths.into_iter().chain(transforms).chain(others.map(str::to_owned)).collect();
        assert_eq!(names, expected);
    }

    #[test]
    fn the_rungs_of_a_determinant_unit() {
        let base = Params { method: Method::Determinants, ..Params::default() };
        let all = rungs(&base);
        let names: Vec<String> = all.iter().map(|rung| difference(rung, &base)).collect();
        let choices = [
            "--span 0",
            "--span 3",
            "--levels 0",
            "--levels 2",
            "--bound static",
            "--bound edges",
            "--bound products",
            "--boxes off",
        ];
        assert_eq!(names[names.len() - choices.len()..], choices);
        assert!(all.iter().all(|rung| rung.validate().is_ok()));
        assert_eq!(difference(&all[0], &Params::default()), "--method determinants --width 6");
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
