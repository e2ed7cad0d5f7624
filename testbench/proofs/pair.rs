//! Claims of the determinant unit as a whole: inner numbers of a stage are what docs/determinants.md makes of those of the stage
//! before, which are cut or brought out.

use super::axes::COORDINATES;
use super::claim::Claim;
use super::determinants::{edge, joined, verdict};
use super::settings::Setting;
use super::unit::Mistake::{Reversed, WrongArm, WrongGate, WrongSign};
use super::unit::Subject;
use efsat::params::Transform;

/// The vectors whose norms bounds are made of, in the order of their units: points and edges.
const LENGTHS: [(&str, Option<&str>); 9] = [
    ("v1", None),
    ("v2", None),
    ("v2", Some("v1")),
    ("w0", None),
    ("w1", None),
    ("w2", None),
    ("w1", Some("w0")),
    ("w2", Some("w1")),
    ("w0", Some("w2")),
];

/// The names of the fifteen determinants.
pub fn fifteen() -> Vec<String> {
    let planes = ["a", "b"].into_iter().flat_map(|t| (0..3).map(move |i| format!("plane_{t}{i}")));
    planes.chain((0..9).map(|i| format!("side{}{}", i / 3, i % 3))).collect()
}

/// A claim of the whole pipeline of a design that brings its inner numbers out.
fn of(setting: &Setting, property: &'static str) -> Claim {
    let subject = Subject::probed(setting, "pair_pipeline");
    let transform = format!("{:?}", setting.params.transform).to_lowercase();
    let mut claim = Claim::new(subject, format!("{}, transform {transform}", setting.label()), property);
    // Without a guard no pair is found outside.
    let guarded = claim.subject.outputs.iter().any(|wire| wire.name == "outside");
    claim.value("out", if guarded { "outside" } else { "0" });
    // What a row is of its operands is a claim of its own.
    if setting.params.transform == Transform::On {
        (0..9).for_each(|row| _ = claim.cut(&format!("row_turned{row}_turned")));
    }
    claim
}

/// What a vector is made of, as a probed number.
fn coordinate(point: &str, c: &str) -> String {
    format!("probe_coordinate_{point}_{c}")
}

/// Differences are exact, those under a pose from any row.
pub fn differences(setting: &Setting) -> Claim {
    let mut claim = of(setting, "differences as defined, from any rows");
    claim.given("out == 0");
    for (j, c) in COORDINATES.iter().enumerate() {
        for i in 1..3 {
            claim.shown(format!("probe_difference_v{i}_{c} == in_v{i}_{c}_lo - in_v0_{c}_lo"));
        }
        for l in 0..3 {
            let own = format!("in_w{l}_{c}_lo");
            let (turned, moved) = match setting.params.transform {
                Transform::Off => (own, "0".to_owned()),
                Transform::Translate => (own, format!("(pose_bypass ? 0 : pose_t_{c}_lo)")),
                Transform::On => {
                    let row = format!("row_turned{}_turned", 3 * l + j);
                    (format!("(pose_bypass ? {own} : {row})"), format!("(pose_bypass ? 0 : pose_t_{c}_lo)"))
                }
            };
            claim.shown(format!("probe_difference_w{l}_{c} == {turned} + ({moved} - in_v0_{c}_lo)"));
        }
    }
    claim.mutant(Reversed, "difference_v2(i)");
    if setting.params.transform == Transform::On {
        claim.mutant(WrongArm, "row_choice_d1(0)|row_choice_d1(k)");
    }
    claim
}

/// Makes moments any numbers, with any shift.
fn any_moments(claim: &mut Claim, span: u32) {
    for k in 0..12 {
        claim.cut(&format!("moment_lane_cut{k}_cut"));
        (0..span).for_each(|less| _ = claim.cut(&format!("moment_lane_cut{k}_too_great{less}")));
    }
}

/// A norm of a vector, by a function that names its components.
fn l1(of: impl Fn(&str) -> String) -> String {
    joined(" + ", COORDINATES.map(|c| format!("({0} < 0 ? -({0}) : {0})", of(c))))
}

/// The norms of which bounds are made.
pub fn norms(setting: &Setting) -> Claim {
    let mut claim = of(setting, "norms as defined, from any moments");
    any_moments(&mut claim, setting.params.span);
    for (k, (end, begin)) in LENGTHS.into_iter().enumerate() {
        let component = |c: &str| match begin {
            None => coordinate(end, c),
            Some(begin) => format!("({} - {})", coordinate(end, c), coordinate(begin, c)),
        };
        claim.seen(&format!("norm_lane{k}_norm")).shown(format!("norm_lane{k}_norm == {}", l1(component)));
    }
    for (k, moment) in ["m0", "m1", "m2", "n"].into_iter().enumerate() {
        let norm = l1(|c| format!("probe_moment_{moment}_{c}"));
        claim.seen(&format!("moment_norm_lane{k}_norm")).shown(format!("moment_norm_lane{k}_norm == {norm}"));
    }
    claim.mutant(WrongSign, "e_b(1)(i)");
    claim
}

/// The witnesses beside the boxes, and the verdict, from any dot products, by the bounds. Of a pair with any number outside its
/// declared range all flags are clear.
pub fn verdicts(setting: &Setting) -> Claim {
    let mut claim = of(setting, "flags by signs and verdict as defined, from any dot products");
    claim.compares_only();
    any_moments(&mut claim, setting.params.span);
    let dot = |k: usize| format!("dot_lane{k}_dot");
    (0..10).for_each(|k| _ = claim.cut(&dot(k)));
    for l in 0..3 {
        let (a, next) = (dot([0, 4, 9][l]), dot([4, 9, 0][l]));
        let (d1, d2) = (dot(1 + l), dot(6 + l));
        claim.value(&format!("plane_a{l}"), &a).value(&format!("side0{l}"), format!("-{d1}"));
        claim.value(&format!("side1{l}"), format!("({d1} - {d2}) + ({a} - {next})")).value(&format!("side2{l}"), d2);
    }
    claim.value("plane_b0", dot(5));
    for (i, first) in [(1, 1), (2, 6)] {
        let [x, y, z] = [0, 1, 2].map(|l| dot(first + l));
        claim.value(&format!("plane_b{i}"), format!("{} - (({x} + {y}) + {z})", dot(5)));
    }
    for name in fifteen() {
        let bound = format!("(probe_bound_{name} >>> 3)");
        claim.value(&format!("sign_{name}"), format!("({bound} - {name} < 0 ? 1 : {name} + {bound} < 0 ? -1 : 0)"));
    }
    let sign = |name: String| format!("sign_{name}");
    let plane = |of: &str, k: usize| sign(format!("plane_{of}{}", k % 3));
    let one_side = |of: &str| {
        let all = |way: &str| joined(" && ", (0..3).map(|k| format!("{} == {way}", plane(of, k))));
        format!("({} || {})", all("1"), all("-1"))
    };
    claim.value("apart1", one_side("a")).value("apart2", one_side("b"));
    for k in 0..3 {
        let of_a = [0, 1, 2].map(|l| sign(format!("side{k}{l}")));
        let of_b = [0, 1, 2].map(|l| sign(format!("side{l}{k}")));
        for (first, planes, sides) in [(3, "b", of_a), (6, "a", of_b)] {
            let ends = [plane(planes, k), plane(planes, k + 1)];
            let [missed, pierces] = edge(ends.each_ref().map(|x| &**x), sides.each_ref().map(|x| &**x));
            claim.value(&format!("apart{}", first + k), missed).value(&format!("meets{}", first + k), pierces);
        }
    }
    for witness in 1..9 {
        let meets = if witness < 3 { "0".to_owned() } else { format!("meets{witness}") };
        claim.shown(format!("separated{witness} == (out ? 0 : apart{witness})"));
        claim.shown(format!("overlapping{witness} == (out ? 0 : {meets})"));
    }
    claim.shown(format!("verdict == {}", verdict("separated", "overlapping")));
    claim.mutant(WrongSign, "side1_i(k)").mutant(WrongGate, "pierces");
    claim
}
