//! Claims of the exact unit's own entities: each is as its section of docs/exact.md defines it.

use super::axes::COORDINATES;
use super::claim::{Claim, number};
use super::determinants::{cut_product, joined, of, sign};
use super::pair::fifteen;
use super::settings::Setting;
use super::unit::Mistake::{
    Inverted, LastNotStrict, NotMissing, NotStrict, OtherCase, OtherElement, Reversed, WrongArm, WrongComponent,
    WrongGate, WrongSign, WrongSlice,
};
use super::unit::Subject;
use efsat::params::Transform;

/// The terms for which a condition holds of each number, and those for which it holds of some.
fn all(of: impl Fn(usize) -> String, numbers: usize) -> String {
    joined(" && ", (0..numbers).map(of))
}

fn any(of: impl Fn(usize) -> String, numbers: usize) -> String {
    joined(" || ", (0..numbers).map(of))
}

/// A difference that fits goes on, another is flagged.
pub fn difference_fit(setting: &Setting) -> Claim {
    let mut claim = of(setting, "difference_fit", "flags what does not fit, keeps what does");
    let most = number((1 << (setting.params.width - 1)) - 1);
    claim.shown(format!("outside == !(-{most} <= x && x <= {most})")).shown("fitted == (outside ? 0 : x)");
    claim.mutant(NotStrict, "outside_i").mutant(LastNotStrict, "outside_i").mutant(WrongArm, "fitted_choice");
    claim.mutant(WrongGate, "outside_i");
    claim
}

/// A component of a cross product from any products.
pub fn cross_component(setting: &Setting) -> Claim {
    let mut claim = of(setting, "cross_component", "operands; exact difference of the products");
    let plus = cut_product(&mut claim, "c_result_first", "plus0", "plus1");
    let minus = cut_product(&mut claim, "c_result_second", "minus0", "minus1");
    claim.shown(format!("c == {plus} - {minus}"));
    claim.mutant(Reversed, "c").mutant(WrongSign, "c");
    claim
}

/// A dot product from any products of its digits: a factor is its two digits at their places.
pub fn dot_product(setting: &Setting) -> Claim {
    let mut claim = of(setting, "dot_product", "operands; digits of each factor; exact sum of the products");
    let mut products = [vec![], vec![]];
    for c in COORDINATES {
        claim.value(&format!("digit0_{c}"), format!("(m_{c} - ((m_{c} >>> 18) <<< 18)) - {}", number(1 << 17)));
        claim.value(&format!("digit1_{c}"), format!("m_{c} >>> 18"));
        for (digit, of_digit) in products.iter_mut().enumerate() {
            of_digit.push(cut_product(
                &mut claim,
                &format!("product_0{digit}_{c}"),
                &format!("x_{c}"),
                &format!("digit{digit}_{c}"),
            ));
        }
        claim.shown(format!("m_{c} - {} == digit0_{c} + (digit1_{c} <<< 18)", number(1 << 17)));
    }
    let [low, high] = products.map(|products| joined(" + ", products));
    claim.shown(format!("dot == {low} + ({high} <<< 18)"));
    claim.mutant(WrongSign, "place_0").mutant(WrongSign, "dot").mutant(WrongComponent, "product_01_unit");
    claim.mutant(NotMissing, "digit0_resized_second(i)").mutant(WrongSlice, "digit(i)(1)");
    claim
}

/// The sign of a number.
pub fn exact_sign(setting: &Setting) -> Claim {
    let mut claim = of(setting, "exact_sign", "the sign");
    claim.shown("sign0 == (x > 0) && sign1 == (x < 0)");
    claim.mutant(WrongGate, "sign_i(0)").mutant(NotMissing, "sign_i(0)").mutant(Inverted, "sign_i(1)");
    claim
}

/// Names the least and the greatest of three numbers of each triangle, and whether all are one number.
fn ranges(claim: &mut Claim, suffix: &str, of_a: [String; 3], of_b: [String; 3]) {
    for (triangle, [x, y, z]) in [("a", of_a), ("b", of_b)] {
        for (end, is_beyond) in [("least", "<"), ("most", ">")] {
            let name = format!("{end}_{triangle}{suffix}");
            claim.value(&format!("of_two_{name}"), format!("({x} {is_beyond} {y} ? {x} : {y})"));
            claim.value(&name, format!("(of_two_{name} {is_beyond} {z} ? of_two_{name} : {z})"));
        }
    }
    let [a, b, c, d] = ["least_a", "most_a", "least_b", "most_b"].map(|end| format!("{end}{suffix}"));
    claim.value(&format!("one_number{suffix}"), format!("{a} == {b} && {c} == {d} && {a} == {c}"));
}

/// Ranges of A and B along a coordinate.
pub fn box_axis(setting: &Setting) -> Claim {
    let mut claim = of(setting, "box_axis", "as defined");
    claim.compares_only();
    ranges(&mut claim, "", ["0", "v0", "v1"].map(str::to_owned), ["w0", "w1", "w2"].map(str::to_owned));
    claim.shown("apart == (most_a < least_b || most_b < least_a)");
    claim.shown("nearly_apart == ((most_a <= least_b || most_b <= least_a) && !one_number)");
    claim.shown("with_0 == (least_b <= 0 && 0 <= most_b)");
    claim.shown("sides_a == ((v0 < 0 && v1 > 0) || (v0 > 0 && v1 < 0)) && sides_b == (least_b < 0 && most_b > 0)");
    claim.mutant(NotStrict, "v_below_w(k)(m)").mutant(NotStrict, "w_below_v(k)(m)").mutant(WrongGate, "sides_b_i");
    claim.mutant(WrongGate, "nearly_apart").mutant(NotMissing, "with_0").mutant(WrongGate, "w_above(k)");
    claim
}

/// The coordinate that is left out: the first in which a moment is not 0.
pub fn left_out_coordinate(setting: &Setting) -> Claim {
    let mut claim = of(setting, "left_out_coordinate", "as defined");
    claim.compares_only();
    for c in COORDINATES {
        claim.value(&format!("seen_{c}"), any(|l| format!("moments{l}_{c} != 0"), 4));
    }
    claim.shown("left_out == (seen_x ? 0 : seen_y ? 1 : seen_z ? 2 : 3)");
    claim.mutant(NotMissing, "seen(k)");
    claim
}

/// The two coordinates of a point that are not left out.
pub fn plane_coordinates(setting: &Setting) -> Claim {
    let mut claim = of(setting, "plane_coordinates", "as defined");
    claim.compares_only().given("left_out <= 2");
    claim.shown("projected0 == (left_out == 0 ? x_y : left_out == 1 ? x_z : x_x)");
    claim.shown("projected1 == (left_out == 0 ? x_z : left_out == 1 ? x_x : x_y)");
    claim.mutant(OtherCase, "projected(k)");
    claim
}

/// The first of three points that is not V0.
pub fn first_point(setting: &Setting) -> Claim {
    let mut claim = of(setting, "first_point", "as defined");
    claim.compares_only();
    let is_0 = |p: &str| joined(" && ", COORDINATES.map(|c| format!("{p}_{c} == 0")));
    for c in COORDINATES {
        claim.shown(format!("first_{c} == (!{} ? x_{c} : !{} ? y_{c} : z_{c})", is_0("x"), is_0("y")));
    }
    claim.mutant(WrongArm, "first").mutant(NotMissing, "y_x_equal_not_word_any");
    claim
}

/// Sides in the plane and signs of areas.
pub fn plane_sums(setting: &Setting) -> Claim {
    let mut claim = of(setting, "plane_sums", "as defined");
    for l in 0..3 {
        let next = (l + 1) % 3;
        claim.shown(format!("sides0_{l} == x0_{l} && sides1_{l} == n + x1_{l} - x0_{l} && sides2_{l} == -x1_{l}"));
        for (k, side) in
            ["moment{l}", "moment{l} + x0_{l} - x0_{next}", "moment{l} + x1_{l} - x1_{next}"].iter().enumerate()
        {
            let side = side.replace("{l}", &l.to_string()).replace("{next}", &next.to_string());
            claim.shown(format!("sides{}_{k} == {side}", 3 + l));
        }
    }
    claim.value("area0", "n").value("area1", "moment0 + moment1 + moment2");
    for t in 0..2 {
        claim.shown(format!("area_sign{t}_0 == (area{t} > 0) && area_sign{t}_1 == (area{t} < 0)"));
    }
    claim
        .mutant(WrongSign, "sides_i(1)(m)")
        .mutant(Reversed, "sides_difference_d1(k + 3)(m + 1)")
        .mutant(WrongSign, "area(1)");
    claim.mutant(NotMissing, "area_sign_i(0)(0)");
    claim
}

/// An edge parts a pair in a plane, or nearly does.
pub fn plane_edge(setting: &Setting) -> Claim {
    let mut claim = of(setting, "plane_edge", "as defined");
    claim.compares_only();
    claim.value("of_area", "area0 - area1").given("!area0 || !area1");
    let each = |test: &str| all(|k| format!("x{k} {test} 0"), 3);
    claim.shown(format!("parts == ({} && of_area != -1 || {} && of_area != 1)", each("<"), each(">")));
    let nothing = format!("({} && of_area == 0)", each("=="));
    claim.shown(format!(
        "nearly == (({} && of_area != -1 || {} && of_area != 1) && !{nothing})",
        each("<="),
        each(">=")
    ));
    claim
        .mutant(WrongGate, "above(k)")
        .mutant(NotMissing, "above(k)")
        .mutant(NotMissing, "nearly_and_first_and_not_second_d1");
    claim.mutant(WrongGate, "nearly").mutant(WrongGate, "parts");
    claim
}

/// What is decided of a pair in one plane, from any flags.
pub fn plane_verdict(setting: &Setting) -> Claim {
    let mut claim = of(setting, "plane_verdict", "as defined");
    let some = |flags: &str| any(|k| format!("{flags}{k} != 0"), 6);
    claim.value("in_plane", "lines == 0").value("one_line", "lines && no_u").value("two_lines", "lines && !no_u");
    let apart =
        format!("in_plane ? boxes_apart || {} : one_line ? boxes_apart : boxes_apart || !boxes_with_0", some("parts"));
    claim.shown(format!("apart == ({apart})"));
    let crosses = format!(
        "in_plane ? !{} && !boxes_nearly_apart : one_line ? !boxes_nearly_apart : boxes_sides_a && boxes_sides_b",
        some("nearly")
    );
    claim.shown(format!("crosses == ({crosses})"));
    claim.shown("agree == (areas0_0 && areas1_0 || areas0_1 && areas1_1)");
    claim.mutant(WrongGate, "apart").mutant(NotMissing, "two_lines").mutant(WrongGate, "crosses");
    claim.mutant(WrongGate, "agree");
    claim
}

/// An edge and the other triangle.
pub fn edge_verdict(setting: &Setting) -> Claim {
    let mut claim = of(setting, "edge_verdict", "as defined");
    ["ends0", "ends1", "sides0", "sides1", "sides2"]
        .iter()
        .for_each(|flag| sign(&mut claim, &format!("of_{flag}"), flag));
    let sides = |way: &str| [0, 1, 2].map(|k| format!("of_sides{k} == {way}"));
    let some = |way: &str| joined(" || ", sides(way));
    let every = |way: &str| joined(" && ", sides(way));
    claim.value("alike", "of_ends0 == of_ends1 && of_ends0 != 0");
    claim.shown(format!("missed == (alike || ({} && {}))", some("1"), some("-1")));
    claim.shown("hits == (!missed && !(of_ends0 == 0 && of_ends1 == 0))");
    let opposite = "of_ends0 == -of_ends1 && of_ends0 != 0";
    claim.shown(format!("pierces == ({opposite} && ({} || {}))", every("1"), every("-1")));
    claim.mutant(WrongGate, "missed_i").mutant(WrongGate, "pierces").mutant(NotMissing, "hits");
    claim
}

/// Whether A has a part on the inner side of each edge of B, in the plane of B.
pub fn inner_side(setting: &Setting) -> Claim {
    let mut claim = of(setting, "inner_side", "as defined");
    for k in 0..3 {
        sign(&mut claim, &format!("of_plane{k}"), &format!("plane_b{k}"));
        (0..3).for_each(|l| sign(&mut claim, &format!("of_side{k}{l}"), &format!("side{k}_{l}")));
    }
    for l in 0..3 {
        let inner = |k: usize| {
            let (p, q) = (format!("of_plane{k}"), format!("of_plane{}", (k + 1) % 3));
            format!("({p} < {q} && of_side{k}{l} == 1 || {p} > {q} && of_side{k}{l} == -1)")
        };
        claim.shown(format!("inner{l} == {}", any(inner, 3)));
    }
    claim.mutant(WrongGate, "up(k)").mutant(NotMissing, "down(k)").mutant(WrongGate, "inner(k)");
    claim
}

/// The verdict and the flags by sections 4 to 6, from the signs `plane_a0` ... `plane_b2`, the flags `missed0`, `hits0`,
/// `pierces0` ... of the edges of A, then of B, `inner0` ..., `skew`, `plane_apart`, `plane_crosses` and
/// `plane_agree`.
fn decided(claim: &mut Claim) {
    let plane = |of: &str, test: &str, how: &str| joined(how, (0..3).map(|k| format!("plane_{of}{k} {test}")));
    let one_side = |of| format!("({} || {})", plane(of, "== 1", " && "), plane(of, "== -1", " && "));
    let both_sides = |of| format!("({} && {})", plane(of, "== 1", " || "), plane(of, "== -1", " || "));
    let some = |what: &str| any(|edge| format!("{what}{edge}"), 6);
    claim.value("in_plane", format!("{} && {}", plane("a", "== 0", " && "), plane("b", "== 0", " && ")));
    claim.value("is_apart", format!("in_plane ? skew || plane_apart : !{}", some("hits")));
    let proper = format!("{} && {} && {}", both_sides("a"), both_sides("b"), all(|l| format!("inner{l}"), 3));
    claim.value("is_crossing", format!("in_plane ? !is_apart && plane_crosses : {} || {proper}", some("pierces")));
    claim.shown("verdict == (outside ? 2 : is_apart ? 0 : 1)");
    let mut flags = vec![
        ("in_plane && is_apart".to_owned(), "is_crossing".to_owned()),
        (one_side("a"), "in_plane && !skew".to_owned()),
        (one_side("b"), format!("{} || in_plane && is_crossing && plane_agree", some("pierces"))),
    ];
    flags.extend((0..6).map(|edge| (format!("missed{edge}"), format!("hits{edge}"))));
    for (witness, (separated, overlapping)) in flags.into_iter().enumerate() {
        claim.shown(format!("separated{witness} == (!outside && ({separated}))"));
        claim.shown(format!("overlapping{witness} == (!outside && ({overlapping}))"));
    }
}

/// The verdict of the pair from any flags.
pub fn pair_verdict(setting: &Setting) -> Claim {
    let mut claim = of(setting, "pair_verdict", "as defined");
    for k in 0..3 {
        for (number, plane) in ["a", "b"].iter().enumerate() {
            sign(&mut claim, &format!("plane_{plane}{k}"), &format!("planes{number}_{k}"));
        }
    }
    for edge in 0..6 {
        for what in ["missed", "hits", "pierces"] {
            claim.value(&format!("{what}{edge}"), format!("edges{edge}_{what}"));
        }
    }
    decided(&mut claim);
    claim.mutant(WrongGate, "one_side(k)").mutant(WrongGate, "apart").mutant(WrongGate, "proper");
    claim.mutant(NotMissing, "in_plane").mutant(WrongArm, "crosses").mutant(WrongGate, "alike");
    claim
}

/// The points relative to V0, in the order of their units.
const POINTS: [&str; 5] = ["v1", "v2", "w0", "w1", "w2"];

/// The moments, in the order of their units, three components each.
const MOMENTS: [&str; 4] = ["m0", "m1", "m2", "n"];

/// A claim of the whole pipeline.
fn of_pair(setting: &Setting, property: &'static str) -> Claim {
    let transform = format!("{:?}", setting.params.transform).to_lowercase();
    let subject = Subject::probed(setting, "pair_pipeline");
    Claim::new(subject, format!("{}, transform {transform}", setting.label()), property)
}

/// Makes the coordinates of all points any numbers that fit, named `v1_x` and so on.
fn any_points(claim: &mut Claim) {
    for (k, point) in POINTS.iter().enumerate() {
        for c in COORDINATES {
            let fitted = format!("fitted{k}_{c}_fitted");
            claim.cut(&fitted).value(&format!("{point}_{c}"), fitted);
        }
    }
}

/// Makes all components of moments any numbers, named `m0_x` and so on.
fn any_moments(claim: &mut Claim) {
    for (k, moment) in MOMENTS.iter().enumerate() {
        for (i, c) in COORDINATES.iter().enumerate() {
            let component = format!("moment_component_lane{}_c", 3 * k + i);
            claim.cut(&component).value(&format!("{moment}_{c}"), component);
        }
    }
}

/// Differences are exact, and a pair is outside if one of them does not fit.
pub fn fits(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "differences as defined; outside if one does not fit");
    let most = number((1 << (setting.params.width - 1)) - 1);
    let mut fit = vec![];
    for (k, point) in POINTS.iter().enumerate() {
        for c in COORDINATES {
            let moved = match setting.params.transform {
                Transform::Translate if k > 1 => format!(" + (pose_bypass ? 0 : pose_t_{c}_lo)"),
                _ => String::new(),
            };
            let difference = format!("difference_{point}_{c}");
            claim.value(&difference, format!("in_{point}_{c}_lo{moved} - in_v0_{c}_lo"));
            claim.seen(&format!("fitted{k}_{c}_x")).shown(format!("fitted{k}_{c}_x == {difference}"));
            fit.push(format!("(-{most} <= {difference} && {difference} <= {most})"));
        }
    }
    claim.shown(format!("outside == !{}", joined(" && ", fit)));
    claim.mutant(WrongSign, "difference_v2(i)|difference_v2_i(i)").mutant(NotStrict, "outside_i");
    claim
}

/// What is multiplied: coordinates for the moments, coordinates and moments for the dot products. Of a moment's two digits the
/// lower one has 2^17 added.
pub fn operands(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "operands of moments and of dot products");
    any_points(&mut claim);
    any_moments(&mut claim);
    for (l, [x, y]) in [["w0", "w1"], ["w1", "w2"], ["w2", "w0"], ["v1", "v2"]].iter().enumerate() {
        for i in 0..3 {
            let [next, last] = [COORDINATES[(i + 1) % 3], COORDINATES[(i + 2) % 3]];
            let lane = format!("moment_component_lane{}", 3 * l + i);
            claim.seen_ports(&lane, &["plus0", "plus1", "minus0", "minus1"]);
            claim.shown(format!("{lane}_plus0 == {x}_{next} && {lane}_plus1 == {y}_{last}"));
            claim.shown(format!("{lane}_minus0 == {x}_{last} && {lane}_minus1 == {y}_{next}"));
        }
    }
    let of_b = [("v1", 1), ("v2", 6)].map(|(v, first)| [0, 1, 2].map(|l| (first + l, v, MOMENTS[l]))).concat();
    let of_a = [(0, "w0", "n"), (4, "w1", "n"), (9, "w2", "n"), (5, "w0", "m1")];
    for (k, point, moment) in of_b.into_iter().chain(of_a) {
        for c in COORDINATES {
            claim.seen_ports(&format!("dot_lane{k}"), &[&format!("x_{c}"), &format!("m_{c}")]);
            claim.shown(format!("dot_lane{k}_x_{c} == {point}_{c}"));
            claim.shown(format!("dot_lane{k}_m_{c} == {moment}_{c} + {}", number(1 << 17)));
        }
    }
    claim.mutant(OtherElement, "moment_component_lane_unit_minus(k + 9)(0)").mutant(WrongSign, "offset_m1(i)");
    claim
}

/// The verdict and all flags by the signs of the fifteen determinants, from any dot products and any answer of the rule for
/// pairs in one plane.
pub fn by_signs(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "flags by signs and verdict as defined, from any dot products");
    claim.room_for(3);
    let dot = |k: usize| format!("dot_lane{k}_dot");
    (0..10).for_each(|k| _ = claim.cut(&dot(k)));
    for what in ["apart", "crosses", "agree"] {
        let said = format!("lines_apart_{what}");
        claim.cut(&said).value(&format!("plane_{what}"), said);
    }
    claim.value("of_plane_b0", dot(5));
    for (i, first) in [(1, 1), (2, 6)] {
        let [x, y, z] = [0, 1, 2].map(|l| dot(first + l));
        claim.value(&format!("of_plane_b{i}"), format!("{} - (({x} + {y}) + {z})", dot(5)));
    }
    for l in 0..3 {
        let (a, next) = (dot([0, 4, 9][l]), dot([4, 9, 0][l]));
        let (d1, d2) = (dot(1 + l), dot(6 + l));
        claim.value(&format!("of_plane_a{l}"), &a).value(&format!("of_side0{l}"), format!("-{d1}"));
        claim.value(&format!("of_side1{l}"), format!("({d1} - {d2}) + ({a} - {next})"));
        claim.value(&format!("of_side2{l}"), d2);
    }
    for name in fifteen() {
        claim.value(&name, format!("(of_{name} > 0 ? 1 : of_{name} < 0 ? -1 : 0)"));
    }
    claim.value("skew", joined(" || ", (0..9).map(|i| format!("side{}{} != 0", i / 3, i % 3))));
    for k in 0..3 {
        let next = (k + 1) % 3;
        let of_a = [0, 1, 2].map(|l| format!("side{k}{l}"));
        let of_b = [0, 1, 2].map(|l| format!("side{l}{k}"));
        for (number, plane, sides) in [(k, "b", of_a), (3 + k, "a", of_b)] {
            let [p, q] = [k, next].map(|k| format!("plane_{plane}{k}"));
            let of = |how, way: &str| joined(how, sides.iter().map(|side| format!("{side} == {way}")));
            let missed = format!("({p} == {q} && {p} != 0) || {} && {}", of(" || ", "1"), of(" || ", "-1"));
            claim.value(&format!("missed{number}"), missed);
            claim.value(&format!("hits{number}"), format!("!missed{number} && !({p} == 0 && {q} == 0)"));
            let all_on_one = format!("({} || {})", of(" && ", "1"), of(" && ", "-1"));
            claim.value(&format!("pierces{number}"), format!("{p} == -{q} && {p} != 0 && {all_on_one}"));
        }
        let inner = |edge: usize| {
            let (p, q) = (format!("plane_b{edge}"), format!("plane_b{}", (edge + 1) % 3));
            format!("({p} < {q} && side{edge}{k} == 1 || {p} > {q} && side{edge}{k} == -1)")
        };
        claim.value(&format!("inner{k}"), any(inner, 3));
    }
    decided(&mut claim);
    claim.mutant(WrongSign, "side1_i(k)").mutant(WrongGate, "pierces").mutant(WrongGate, "up(k)");
    claim
}

/// Coordinate `c`, or the one after it or before it, by the coordinate that is left out.
fn in_the_plane(point: &str, next: usize) -> String {
    let [x, y, z] = [0, 1, 2].map(|c| format!("{point}_{}", COORDINATES[(c + next) % 3]));
    format!("(left_out == 0 ? {x} : left_out == 1 ? {y} : {z})")
}

/// Names what is left out (3: everything is on two lines), from moments.
fn left_out(claim: &mut Claim) {
    let seen = COORDINATES.map(|c| joined(" || ", MOMENTS.map(|m| format!("{m}_{c} != 0"))));
    claim.value("left_out", format!("({} ? 0 : {} ? 1 : {} ? 2 : 3)", seen[0], seen[1], seen[2]));
}

/// What is multiplied for pairs in one plane.
pub fn in_plane_operands(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "operands for pairs in one plane");
    any_points(&mut claim);
    any_moments(&mut claim);
    left_out(&mut claim);
    let is_0 = |p: &str| joined(" && ", COORDINATES.map(|c| format!("{p}_{c} == 0")));
    for c in COORDINATES {
        claim.value(&format!("v_{c}"), format!("({} ? v2_{c} : v1_{c})", is_0("v1")));
        claim.value(&format!("w_{c}"), format!("(!{} ? w0_{c} : !{} ? w1_{c} : w2_{c})", is_0("w0"), is_0("w1")));
    }
    for k in 0..6 {
        let lane = format!("cross_in_plane_lane{k}");
        claim.seen_ports(&lane, &["plus0", "plus1", "minus0", "minus1"]);
        let (v, w) = (format!("v{}", k / 3 + 1), format!("w{}", k % 3));
        let [next, last] = [COORDINATES[(k + 1) % 3], COORDINATES[(k + 2) % 3]];
        let on_lines = [format!("v_{next}"), format!("w_{last}"), format!("v_{last}"), format!("w_{next}")];
        let in_plane = [in_the_plane(&v, 1), in_the_plane(&w, 2), in_the_plane(&v, 2), in_the_plane(&w, 1)];
        for (port, (line, plane)) in ["plus0", "plus1", "minus0", "minus1"].iter().zip(on_lines.iter().zip(in_plane)) {
            // On two lines the last three have no meaning.
            let factor = if k < 3 { format!("(left_out == 3 ? {line} : {plane})") } else { plane };
            let asked = if k < 3 { String::new() } else { "left_out == 3 || ".to_owned() };
            claim.shown(format!("{asked}{lane}_{port} == {factor}"));
        }
    }
    claim.mutant(OtherCase, "projected(k)").mutant(NotMissing, "y_x_equal_not_word_any");
    claim
}

/// What is asked of each edge of a pair in one plane: the sides of it on which the other's corners are, and the sign of its
/// own triangle's area, from any moments and components.
pub fn in_plane_edges(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "sides and areas for pairs in one plane, from any products");
    claim.room_for(3);
    any_moments(&mut claim);
    left_out(&mut claim);
    claim.given("left_out != 3");
    for (k, moment) in MOMENTS.iter().enumerate() {
        claim.value(&format!("area{k}"), in_the_plane(moment, 0));
    }
    claim.value("of_a", "area3").value("of_b", "area0 + area1 + area2");
    for i in 1..3 {
        for l in 0..3 {
            let component = format!("cross_in_plane_lane{}_c", 3 * (i - 1) + l);
            claim.cut(&component).value(&format!("x{i}{l}"), component);
        }
    }
    for k in 0..3 {
        let next = (k + 1) % 3;
        let of_a =
            [0, 1, 2].map(|l| [format!("x1{l}"), format!("area3 + x2{l} - x1{l}"), format!("-x2{l}")][k].clone());
        let of_b = [format!("area{k}"), format!("area{k} + x1{k} - x1{next}"), format!("area{k} + x2{k} - x2{next}")];
        for (edge, area, sides) in [(k, "of_a", of_a), (3 + k, "of_b", of_b)] {
            claim.seen_ports(&format!("parts{edge}"), &["x0", "x1", "x2", "area0", "area1"]);
            for (corner, side) in sides.iter().enumerate() {
                claim.shown(format!("parts{edge}_x{corner} == {side}"));
            }
            claim.shown(format!("parts{edge}_area0 == ({area} > 0) && parts{edge}_area1 == ({area} < 0)"));
        }
    }
    claim.mutant(WrongSign, "sides_i(1)(m)").mutant(NotMissing, "seen(k)").mutant(WrongSign, "area(1)");
    claim
}

/// The answer of the rule for pairs in one plane, from what each edge says.
pub fn in_plane(setting: &Setting) -> Claim {
    let mut claim = of_pair(setting, "rule for pairs in one plane as defined, from any edges");
    claim.compares_only();
    any_points(&mut claim);
    any_moments(&mut claim);
    left_out(&mut claim);
    (0..6).for_each(|k| _ = claim.cut(&format!("parts{k}_parts")).cut(&format!("parts{k}_nearly")));
    (0..3).for_each(|k| _ = claim.cut(&format!("cross_in_plane_lane{k}_c")));
    claim.seen("lines_apart_apart").seen("lines_apart_crosses");
    for c in COORDINATES {
        let (of_a, of_b) =
            (["0".to_owned(), format!("v1_{c}"), format!("v2_{c}")], ["w0", "w1", "w2"].map(|w| format!("{w}_{c}")));
        ranges(&mut claim, &format!("_{c}"), of_a, of_b);
    }
    let along = |how: &str, of: &dyn Fn(&str) -> String| joined(how, COORDINATES.map(of));
    let apart = along(" || ", &|c| format!("(most_a_{c} < least_b_{c} || most_b_{c} < least_a_{c})"));
    let nearly =
        along(" || ", &|c| format!("((most_a_{c} <= least_b_{c} || most_b_{c} <= least_a_{c}) && !one_number_{c})"));
    let with_0 = along(" && ", &|c| format!("(least_b_{c} <= 0 && 0 <= most_b_{c})"));
    let through_a = along(" || ", &|c| format!("((v1_{c} < 0 && v2_{c} > 0) || (v1_{c} > 0 && v2_{c} < 0))"));
    let through_b = along(" || ", &|c| format!("(least_b_{c} < 0 && 0 < most_b_{c})"));
    claim.value("apart", apart).value("nearly_apart", nearly).value("with_0", with_0);
    claim.value("through", format!("{through_a} && {through_b}"));
    claim.value("no_u", joined(" && ", (0..3).map(|k| format!("cross_in_plane_lane{k}_c == 0"))));
    let some = |what: &str| any(|k| format!("parts{k}_{what}"), 6);
    let parts = format!("left_out != 3 ? {} : !no_u && !with_0", some("parts"));
    claim.shown(format!("lines_apart_apart == (apart || ({parts}))"));
    let crosses = format!("left_out != 3 ? !{} && !nearly_apart : no_u ? !nearly_apart : through", some("nearly"));
    claim.shown(format!("lines_apart_crosses == ({crosses})"));
    claim.mutant(NotStrict, "w_below_v(k)(m)").mutant(NotMissing, "seen(k)").mutant(WrongGate, "crosses");
    claim
}
