//! Why a pair is left open, in words, and by how little.

use super::{Golden, Test};
use crate::pair::{Pair, Pose, Verdict};
use efsat_hardware::number::Interval;
use std::collections::HashMap;

/// Why a pair is possibly incorrect: the test that came nearest to an answer.
// For the command line, the viewer and the package for Python.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    /// In words.
    pub words: String,
    /// What was measured, in units of the last place that is compared, and by how much it may be wrong: the gap is not greater
    /// than the error. None for a pair outside the declared ranges.
    pub margin: Option<Margin>,
}

/// A gap between images on an axis, negative if they overlap, or a determinant; and its error.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// What was measured.
    pub gap: f64,
    /// By how much it may be wrong.
    pub error: f64,
}

impl Reason {
    /// That of a pair that the unit or the host leaves open because of its range.
    pub fn outside() -> Self {
        Self { words: "a number is outside the declared ranges, and the boxes overlap".to_owned(), margin: None }
    }

    /// The nearest of some tests that are uncertain, by their names.
    fn nearest(tests: Vec<(String, Margin)>, [one, more]: [&str; 2], what: &str) -> Option<Self> {
        let near = |(_, margin): &(String, Margin)| if margin.error == 0.0 { 0.0 } else { margin.gap / margin.error };
        let (name, margin) = tests.iter().max_by(|p, q| near(p).total_cmp(&near(q)))?;
        let others = match tests.len() - 1 {
            0 => String::new(),
            1 => format!("; 1 more {one} is uncertain"),
            n => format!("; {n} more {more} are uncertain"),
        };
        Some(Self { words: format!("{name}: {what}{others}"), margin: Some(*margin) })
    }
}

impl Golden {
    /// Why a pair is possibly incorrect; none if it is not.
    // For the command line, the viewer and the package for Python.
    #[doc(hidden)]
    pub fn reason(&self, pose: &Pose, pair: &Pair) -> Option<Reason> {
        let outcome = self.outcome(pose, pair);
        if outcome.verdict != Verdict::PossiblyIncorrect {
            return None;
        }
        if outcome.outside {
            return Some(Reason::outside());
        }
        let trace = self.trace(pose, pair);
        match &self.test {
            Test::Axes(_) => Reason::nearest(
                axes(&trace),
                ["axis", "axes"],
                "neither that the images are apart nor that they overlap is certain",
            ),
            Test::Determinants(_) | Test::Exact(_) => {
                Reason::nearest(determinants(&trace), ["determinant", "determinants"], "the sign is uncertain")
            }
        }
    }
}

/// The axes that say nothing for certain, each with the gap between the images.
fn axes(trace: &[(String, Interval<i128>)]) -> Vec<(String, Margin)> {
    let parts = trace.iter().filter_map(|(name, x)| Some((name.strip_prefix("enclosure.")?.split_once('.')?, x)));
    let mut ends: Vec<(&str, HashMap<&str, &Interval<i128>>)> = vec![];
    for ((axis, end), x) in parts {
        if ends.last().is_none_or(|(last, _)| *last != axis) {
            ends.push((axis, HashMap::new()));
        }
        ends.last_mut().expect("it was added").1.insert(end, x);
    }
    let margin = |(axis, x): &(&str, HashMap<&str, &Interval<i128>>)| {
        let (a_min, a_max, b_min, b_max) = (x["a_min"], x["a_max"], x["b_min"], x["b_max"]);
        let least = (b_min.lo - a_max.hi).max(a_min.lo - b_max.hi) as f64;
        let most = (b_min.hi - a_max.lo).max(a_min.hi - b_max.lo) as f64;
        let margin = Margin { gap: (least + most) / 2.0, error: (most - least) / 2.0 };
        (least <= 0.0 && most >= 0.0).then(|| (axis_in_words(axis), margin))
    };
    ends.iter().filter_map(margin).collect()
}

/// The determinants without a certain sign, which is that of the magnitude.
fn determinants(trace: &[(String, Interval<i128>)]) -> Vec<(String, Margin)> {
    let value = |kind: &str, name: &str| {
        trace.iter().find(|(full, _)| full.strip_prefix(kind) == Some(name)).map_or(0.0, |(_, x)| x.lo as f64)
    };
    let open = trace.iter().filter(|(_, sign)| sign.lo == 0).filter_map(|(name, _)| name.strip_prefix("sign."));
    let margin = |name| Margin { gap: value("determinant.", name).abs(), error: value("bound.", name) / 8.0 };
    open.map(|name| (determinant_in_words(name), margin(name))).collect()
}

/// `c_01` and so on.
fn axis_in_words(axis: &str) -> String {
    let digits: Vec<char> = axis.chars().filter(char::is_ascii_digit).collect();
    match (axis, digits.as_slice()) {
        ("n_a", _) => "n_A, the normal of A".to_owned(),
        ("n_b", _) => "n_B, the normal of B".to_owned(),
        (_, [k, l]) => format!("C_{k}{l}, edge {k} of A x edge {l} of B"),
        (_, [k]) => {
            let side = if axis.starts_with("n_a") { 'A' } else { 'B' };
            format!("n_{side} x e_{side}{k}, across edge {k} in the plane of {side}")
        }
        _ => axis.to_owned(),
    }
}

/// `plane_a0`, `side01` and so on.
fn determinant_in_words(name: &str) -> String {
    let digits: Vec<char> = name.chars().filter(char::is_ascii_digit).collect();
    match (name.starts_with("plane_a"), digits.as_slice()) {
        (true, [l]) => format!("{name}, vertex {l} of B beside the plane of A"),
        (false, [k]) => format!("{name}, vertex {k} of A beside the plane of B"),
        (_, [k, l]) => format!("{name}, edge {k} of A beside edge {l} of B"),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host::{Host, loose_pair};
    use crate::params::{Axes, Method, Params};
    use efsat_geometry::sample::random_points;
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    #[test]
    fn open_pairs_alone_have_a_reason_and_its_gap_is_within_its_error() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let sets =
            [Params::paper(), Params { axes: Axes::Seventeen, ..Params::default() }, Params::of(Method::Determinants)];
        for params in sets {
            let (golden, pose) = (Golden::new(&params), Pose::identity(&params));
            let mut open = 0;
            for _ in 0..2000 {
                let Ok(Host::Unit(pair)) = loose_pair(&random_points(&mut rng), &params) else { continue };
                let reason = golden.reason(&pose, &pair);
                assert_eq!(reason.is_some(), golden.verdict(&pose, &pair) == Verdict::PossiblyIncorrect);
                let Some(Reason { words, margin }) = reason else { continue };
                let Margin { gap, error } = margin.unwrap();
                assert!(gap.abs() <= error && words.contains(": "), "{words}: {gap} {error}");
                open += 1;
            }
            assert!(open > 100, "{open}");
        }
    }

    /// B a little above the plane of A, far within its borders and with no edge parallel to one of A: the normal of A is what is
    /// uncertain.
    #[test]
    fn the_nearest_test_is_named() {
        let above = 1e-6;
        let points = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0.2, 0.2, above], [0.4, 0.2, 1.0], [0.2, 0.3, 1.0]];
        let said = |method| {
            let params = Params::of(method);
            let Ok(Host::Unit(pair)) = loose_pair(&points, &params) else { unreachable!("it fits") };
            Golden::new(&params).reason(&Pose::identity(&params), &pair).unwrap().words
        };
        assert!(said(Method::Axes).starts_with("n_A, the normal of A: "), "{}", said(Method::Axes));
        let determinant = said(Method::Determinants);
        assert!(determinant.starts_with("plane_a0, vertex 0 of B beside the plane of A: "), "{determinant}");
    }
}
