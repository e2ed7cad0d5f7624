//! Claims of the determinant unit's own entities: each is as its section of docs/determinants.md defines it.

use super::axes::COORDINATES;
use super::claim::{Claim, number};
use super::settings::Setting;
use super::unit::Mistake::{
    Inverted, LastNotStrict, NoUlp, NotMissing, NotStrict, Reversed, WrongArm, WrongComponent, WrongEntry, WrongGate,
    WrongLastGate, WrongSign, WrongSlice,
};
use super::unit::Subject;
use efsat::params::{Params, Transform};

/// A claim of an entity of a design.
pub fn of(setting: &Setting, entity: &str, property: &'static str) -> Claim {
    Claim::new(Subject::of_design(setting, entity), setting.label(), property)
}

/// Numbers joined by an operator.
pub fn joined(operator: &str, terms: impl IntoIterator<Item = String>) -> String {
    format!("({})", terms.into_iter().collect::<Vec<_>>().join(operator))
}

/// Assumes a number to be among some.
fn given_among(claim: &mut Claim, name: &str, least: i128, most: i128) {
    claim.given(format!("{} <= {name} && {name} <= {}", number(least), number(most)));
}

/// By the levels of section 3: `fine`, and the greatest level that the parameters leave.
pub fn levels(p: &Params) -> [u32; 3] {
    let (fine, greatest): (u32, u32) = match p.transform {
        Transform::On => (6, 6),
        Transform::Translate => (4, 4),
        Transform::Off => (3, 2),
    };
    let least = if p.transform == Transform::Off && p.levels >= 2 { 0 } else { fine.saturating_sub(p.levels) };
    [fine, greatest.min(p.levels), least]
}

/// A sign is certain if the number is beyond an eighth of its bound; then the truth, which is no farther from the number than
/// that, has this sign.
pub fn certain_sign(setting: &Setting) -> Claim {
    let mut claim = of(setting, "certain_sign", "as defined; the sign of the truth");
    let [x, bound] = ["x", "bound"].map(|port| claim.subject.input(port).bits);
    claim.free("eighths", bound + 3).given("0 <= eighths && bound == (eighths >>> 3)");
    claim.between("truth", "(x <<< 3) - eighths", "(x <<< 3) + eighths", x + 5);
    claim.shown("sign0 == (x > bound) && sign1 == (x < -bound)");
    claim.shown("!sign0 || truth > 0").shown("!sign1 || truth < 0");
    claim.mutant(NotStrict, "sign(0)").mutant(WrongSign, "sign1_sum").mutant(Inverted, "sign(1)");
    claim
}

/// The determinants that are not dot products themselves.
pub fn determinant_sums(setting: &Setting) -> Claim {
    let mut claim = of(setting, "determinant_sums", "as defined");
    for i in 0..2 {
        claim.shown(format!("plane_b{i} == v - ((d{i}_0 + d{i}_1) + d{i}_2)"));
    }
    for l in 0..3 {
        let next = (l + 1) % 3;
        claim.shown(format!("side0_{l} == -d0_{l} && side1_{l} == (d0_{l} - d1_{l}) + (a{l} - a{next})"));
    }
    claim.mutant(WrongSign, "plane_b(k)").mutant(WrongSign, "side1_i(k)").mutant(Inverted, "side0(k)");
    claim
}

/// What an edge and the other triangle are found to be, by the numbers +1, 0 and -1 of their signs.
pub fn edge(ends: [&str; 2], sides: [&str; 3]) -> [String; 2] {
    let [p, q] = ends;
    let (alike, opposite) = (format!("({p} == {q} && {p} != 0)"), format!("({p} == -{q} && {p} != 0)"));
    let of = |operator, sign: &str| joined(operator, sides.iter().map(|side| format!("{side} == {sign}")));
    let missed = format!("({alike} || ({} && {}))", of(" || ", "1"), of(" || ", "-1"));
    [missed, format!("({opposite} && ({} || {}))", of(" && ", "1"), of(" && ", "-1"))]
}

/// Names a sign by its number; it is not both.
pub fn sign(claim: &mut Claim, name: &str, flag: &str) {
    claim.value(name, format!("{flag}_0 - {flag}_1")).given(format!("{flag}_0 == 0 || {flag}_1 == 0"));
}

/// An edge is missed or pierces by the signs of its ends and sides.
pub fn edge_verdict(setting: &Setting) -> Claim {
    let mut claim = of(setting, "edge_verdict", "as defined");
    ["ends0", "ends1", "sides0", "sides1", "sides2"]
        .iter()
        .for_each(|flag| sign(&mut claim, &format!("of_{flag}"), flag));
    let [missed, pierces] = edge(["of_ends0", "of_ends1"], ["of_sides0", "of_sides1", "of_sides2"]);
    claim.shown(format!("missed == {missed} && pierces == {pierces}"));
    claim.mutant(WrongGate, "missed").mutant(WrongGate, "pierces");
    claim.mutant(WrongLastGate, "pierces");
    claim
}

/// The verdict of nine witnesses, from the names of their flags.
pub fn verdict(separated: &str, overlapping: &str) -> String {
    let all = |operator, of: &str, witnesses: std::ops::Range<usize>| {
        joined(operator, witnesses.map(|witness| format!("{of}{witness}")))
    };
    let separate = format!("({} != 0 || {} >= 5)", all(" + ", separated, 0..3), all(" + ", separated, 3..9));
    format!("({separate} ? 0 : {} != 0 ? 1 : 2)", all(" + ", overlapping, 3..9))
}

/// The verdict of the pair by its definition, from any flags.
pub fn pair_verdict(setting: &Setting) -> Claim {
    let mut claim = of(setting, "pair_verdict", "as defined");
    claim.shown(format!("verdict == {}", verdict("separated", "overlapping")));
    // Two edges missed, five, and all.
    claim.mutant(WrongEntry(3), "five_missed_table").mutant(WrongEntry(31), "five_missed_table");
    claim.mutant(WrongEntry(63), "five_missed_table").mutant(WrongGate, "separate").mutant(NotMissing, "verdict");
    claim
}

/// That boxes are apart along an axis, by how a vertex is above one of the other triangle.
pub fn apart(above: impl Fn(&str, &str) -> String) -> String {
    let (of_a, of_b) = (["0", "v0", "v1"], ["w0", "w1", "w2"]);
    let all =
        |high: [&str; 3], low: [&str; 3]| joined(" && ", high.iter().flat_map(|high| low.map(|low| above(high, low))));
    format!("({} || {})", all(of_a, of_b), all(of_b, of_a))
}

/// Boxes are apart along an axis by the definition.
pub fn boxes_axis(setting: &Setting) -> Claim {
    let mut claim = of(setting, "boxes_axis", "as defined");
    claim.compares_only().shown(format!("apart == {}", apart(|high, low| format!("{low} + wrong < {high}"))));
    claim.mutant(NotStrict, "a_above|a_above_and_and_and_and_and_and_and_d1").mutant(WrongSign, "w_sum(k)");
    claim.mutant(LastNotStrict, "b_above|b_above_less_d1").mutant(WrongGate, "apart");
    claim
}

/// Then the true boxes are apart, whatever the error level.
pub fn boxes_axis_of_the_truth(setting: &Setting) -> Claim {
    let mut claim = of(setting, "boxes_axis", "the true boxes are apart");
    let [_, most, _] = levels(&setting.params);
    claim.free("level", 4);
    given_among(&mut claim, "level", 0, most.into());
    claim.given("wrong == 1 + ((1 <<< level) >>> 2)").value("eps", "4 + (1 <<< level)").value("true_0", "0");
    // In eighths; V0 is exact.
    for y in ["v0", "v1", "w0", "w1", "w2"] {
        claim.between(&format!("error_{y}"), "-eps", "eps", most + 2);
        claim.value(&format!("true_{y}"), format!("({y} <<< 3) + error_{y}"));
    }
    claim.shown(format!("!apart || {}", apart(|high, low| format!("true_{low} < true_{high}"))));
    claim.mutant(WrongSign, "w_sum(k)").mutant(WrongSign, "v_sum(k)").mutant(Inverted, "apart");
    claim
}

/// The number that flags stand for which are the steps of a barrel shifter with so many positions.
fn stepped(positions: u32, flag: impl Fn(usize) -> String) -> String {
    let (mut rest, mut terms) = (positions, vec!["0".to_owned()]);
    while rest > 0 {
        let step = rest.div_ceil(2);
        terms.push(format!("({} ? {step} : 0)", flag(terms.len() - 1)));
        rest -= step;
    }
    joined(" + ", terms)
}

/// The bits that an axis drops at least and at most, before rounding carries.
fn dropped(setting: &Setting) -> [u32; 2] {
    let [_, _, least] = levels(&setting.params);
    let shift = Subject::of_design(setting, "coordinate_shift");
    let magnitudes = shift.inputs.iter().filter_map(|x| x.range).map(|(low, high)| high.max(-1 - low));
    let reach = 128 - magnitudes.max().expect("inputs have ranges").leading_zeros();
    [least, (reach + 1).saturating_sub(setting.params.width).max(least)]
}

/// The bits dropped are the least for which all five are within the working width before they are rounded.
pub fn coordinate_shift(setting: &Setting) -> Claim {
    let mut claim = of(setting, "coordinate_shift", "bits dropped as defined");
    let [least, most] = dropped(setting);
    let n = setting.params.width;
    claim.value("dropped", format!("{most} - {}", stepped(most - least, |i| format!("shift{i}"))));
    let fits = |fewer: u32| {
        let one = |x: usize| format!("((x{x} >>> {}) >>> dropped) == (x{x} < 0 ? -1 : 0)", n - 1 - fewer);
        joined(" && ", (0..5).map(one))
    };
    claim.shown(fits(0)).shown(format!("dropped == {least} || !{}", fits(1)));
    claim.mutant(WrongArm, "word_0").mutant(NotMissing, "shift_i(1)").mutant(WrongSlice, "shift_i(2)");
    claim.mutant(WrongArm, "magnitude(k)").mutant(WrongGate, "magnitude0_or_or_or_or_d1");
    claim
}

/// A coordinate is cut as its shift says.
pub fn coordinate_scale(setting: &Setting) -> Claim {
    let mut claim = of(setting, "coordinate_scale", "floor(2 x / 2^d)");
    let [least, most] = dropped(setting);
    let reach = number(1 << setting.params.width);
    for c in COORDINATES {
        let left = stepped(most - least, |i| format!("shift_{c}{i}"));
        claim.value(&format!("exact_{c}"), format!("(x_{c} <<< ({left} + 1)) >>> {most}"));
        claim.given(format!("-{reach} <= exact_{c} && exact_{c} < {reach}")).shown(format!("cut_{c} == exact_{c}"));
    }
    claim.mutant(WrongArm, "shifted_1(i)").mutant(WrongSlice, "shifted_2_floor_2(i)").mutant(WrongSlice, "cut(i)");
    claim
}

/// Rounding carries if it makes R or -R.
pub fn coordinate_carry(setting: &Setting) -> Claim {
    let mut claim = of(setting, "coordinate_carry", "as defined");
    let r = number(1 << (setting.params.width - 1));
    let carries = |k: usize| format!("((cut{k} + 1) >>> 1) == {r} || ((cut{k} + 1) >>> 1) == -{r}");
    claim.shown(format!("carried == {}", joined(" || ", (0..5).map(carries))));
    claim.mutant(WrongLastGate, "carried").mutant(WrongGate, "carried");
    claim
}

/// Coordinates are rounded by the last bit or the last two, within half a unit of what was cut.
pub fn coordinate_round(setting: &Setting) -> Claim {
    let mut claim = of(setting, "coordinate_round", "as defined, within the width and half a unit");
    let most = number((1 << (setting.params.width - 1)) - 1);
    for (c, carried) in COORDINATES.iter().zip(["carried_x", "carried_y", "carried_z"]) {
        // With some of the bits that were cut off.
        claim.free(&format!("exact_{c}"), setting.params.width + 9).given(format!("cut_{c} == (exact_{c} >>> 8)"));
        claim.value(&format!("round_{c}"), format!("({carried} ? (cut_{c} + 2) >>> 2 : (cut_{c} + 1) >>> 1)"));
        claim.given(format!("-{most} <= round_{c} && round_{c} <= {most}")).shown(format!("y_{c} == round_{c}"));
        claim.value(&format!("error_{c}"), format!("(y_{c} <<< (9 + {carried})) - exact_{c}"));
        claim.value(&format!("half_{c}"), format!("256 <<< {carried}"));
        claim.shown(format!("-half_{c} <= error_{c} && error_{c} <= half_{c}"));
    }
    claim.mutant(WrongArm, "chosen(i)").mutant(NoUlp, "y_floor_1_sum(i)").mutant(WrongSlice, "chosen(i)");
    claim
}

/// Cuts the product of an instance, and claims that these are its factors.
pub fn cut_product(claim: &mut Claim, instance: &str, x: &str, y: &str) -> String {
    let product = format!("{instance}_p");
    claim.cut(&product).seen_ports(instance, &["x", "y"]);
    claim.shown(format!("{instance}_x == {x} && {instance}_y == {y}"));
    product
}

/// A component of a moment from any products; for each lesser shift whether it is too great.
pub fn moment_component(setting: &Setting) -> Claim {
    let mut claim = of(setting, "moment_component", "operands; cut and flags as defined");
    let (n, span) = (setting.params.width, setting.params.span);
    let x = cut_product(&mut claim, "exact_result_first", "plus0", "plus1");
    let y = cut_product(&mut claim, "exact_result_second", "minus0", "minus1");
    claim.value("exact", format!("{x} - {y}")).shown(format!("cut == (exact >>> {})", n - span - 1));
    let r = number(1 << (n - 1));
    for k in 0..span {
        let s = n - span + k;
        claim.value(&format!("rounded{k}"), format!("(exact + {}) >>> {s}", number(1 << (s - 1))));
        claim.shown(format!("too_great{k} == !(-{r} <= rounded{k} && rounded{k} < {r})"));
    }
    claim.mutant(Reversed, "exact").mutant(WrongSlice, "cut_i").mutant(WrongSign, "high_0");
    claim.mutant(WrongGate, "too_great|too_great(0)");
    claim
}

/// Moments are rounded by the shift, within half a unit of it.
pub fn moment_round(setting: &Setting) -> Claim {
    let mut claim = of(setting, "moment_round", "round(c, s), within half a unit");
    let (n, span) = (setting.params.width, setting.params.span);
    let r = number(1 << (n - 1));
    given_among(&mut claim, "places", 0, span.into());
    claim.value("half", format!("({} <<< places)", number(1 << (n - span - 1))));
    for c in COORDINATES {
        claim.free(&format!("exact_{c}"), 2 * n + 1).given(format!("cut_{c} == (exact_{c} >>> {})", n - span - 1));
        claim.value(&format!("rounded_{c}"), format!("(exact_{c} + half) >>> ({} + places)", n - span));
        claim.given(format!("-{r} <= rounded_{c} && rounded_{c} < {r}")).shown(format!("moment_{c} == rounded_{c}"));
        claim.value(&format!("error_{c}"), format!("(moment_{c} <<< ({} + places)) - exact_{c}", n - span));
        claim.shown(format!("-half < error_{c} && error_{c} <= half"));
    }
    claim.mutant(NoUlp, "moment_floor_1_sum(i)").mutant(WrongSlice, "moment(i)").mutant(WrongArm, "chosen(i)");
    claim
}

/// A dot product from any products.
pub fn dot_product(setting: &Setting) -> Claim {
    let mut claim = of(setting, "dot_product", "operands; sum as defined");
    let products =
        COORDINATES.map(|c| cut_product(&mut claim, &format!("product_{c}"), &format!("x_{c}"), &format!("m_{c}")));
    claim.shown(format!("dot == {}", joined(" + ", products)));
    claim.mutant(WrongSign, "dot|dot_sum_d1").mutant(WrongComponent, "product_unit");
    claim
}

/// The L1 norm.
pub fn norm(setting: &Setting, entity: &str) -> Claim {
    let mut claim = of(setting, entity, "as defined");
    let magnitude = |c| format!("(x_{c} < 0 ? -x_{c} : x_{c})");
    claim.shown(format!("norm == {}", joined(" + ", COORDINATES.map(magnitude))));
    claim.mutant(WrongSign, "norm").mutant(NoUlp, "norm").mutant(NoUlp, "norm_sum_d1");
    claim
}

/// F(x) at every level.
pub fn first_order(setting: &Setting, entity: &str) -> Claim {
    let mut claim = of(setting, entity, "as defined");
    let [_, most, _] = levels(&setting.params);
    given_among(&mut claim, "by", 0, most.into());
    claim.shown("first_order == (x <<< 2) + (x <<< by)");
    claim.mutant(WrongArm, "shifted").mutant(WrongSign, "first_order").mutant(NoUlp, "first_order");
    claim
}

/// What bounds have beside F, from any norms.
pub fn bound_tails(setting: &Setting) -> Claim {
    let mut claim = of(setting, "bound_tails", "as defined");
    for i in 0..2 {
        claim.shown(format!("plane_b{i} == ((w0 + (v{i} + (v{i} <<< 1)) + rest) <<< 2)"));
        claim.shown(format!("ends{i} == (v{i} <<< 2) + rest"));
    }
    for l in 0..3 {
        claim.shown(format!("plane_a{l} == (w{l} <<< 2) + rest && middle{l} == ((b{l} + (a + rest)) <<< 2)"));
    }
    claim.mutant(WrongSign, "plane_a(k)").mutant(NoUlp, "plane_b(k)").mutant(WrongSign, "ends(k)");
    claim.mutant(NoUlp, "a_and_rest");
    claim
}

/// Products in look-up tables: a row for each bit of a factor.
pub fn short_products(setting: &Setting) -> Claim {
    let mut claim = of(setting, "short_products", "sum of the rows of all products");
    let bits = claim.subject.input("x_x").bits;
    let rows = |c| joined(" + ", (0..bits).map(move |bit| format!("(raw_x_{c}[{bit}] ? (y_{c} <<< {bit}) : 0)")));
    claim.shown(format!("sum == {}", joined(" + ", COORDINATES.map(rows))));
    claim.mutant(WrongSign, "sum").mutant(WrongSign, "product(i)").mutant(NoUlp, "product(i)");
    claim
}

/// A row from any products: as defined, and no farther from the sum of all products of the factors than half an ulp and what
/// the products of low parts that are left out can make up.
pub fn difference_row(setting: &Setting) -> Claim {
    let mut claim = of(setting, "difference_row", "operands; as defined, within the stated error");
    let p = &setting.params;
    let f = p.input().fraction as u32;
    let q = (f + 3).saturating_sub(18);
    let half = number(1 << (f + 1));
    let (mut high, mut mixed, mut low) = (vec![], vec![], vec![]);
    for c in COORDINATES {
        for of in ["m", "w"] {
            claim.value(&format!("middle_{of}_{c}"), format!("({of}_{c} <<< 1) + 1"));
            claim.value(&format!("high_{of}_{c}"), format!("middle_{of}_{c} >>> {q}"));
            claim.value(&format!("low_{of}_{c}"), format!("middle_{of}_{c} - (high_{of}_{c} <<< {q})"));
        }
        let [hm, hw, lm, lw] = ["high_m", "high_w", "low_m", "low_w"].map(|of| format!("{of}_{c}"));
        high.push(cut_product(&mut claim, &format!("high_high_{c}"), &hm, &hw));
        mixed.push(cut_product(&mut claim, &format!("high_low_{c}_result_first"), &hm, &lw));
        mixed.push(cut_product(&mut claim, &format!("high_low_{c}_result_second"), &lm, &hw));
        claim.free(&format!("low_{c}"), 2 * q + 1).room_for(2 * q + 4);
        given_among(&mut claim, &format!("low_{c}"), 1, ((1 << q) - 1) * ((1 << q) - 1));
        low.push(format!("low_{c}"));
    }
    let pairs = |x: &[String]| x.chunks(2).map(|two| joined(" + ", two.to_vec())).collect::<Vec<_>>();
    claim.value("high", joined(" + ", high)).value("mixed", joined(" + ", pairs(&mixed)));
    claim.value("without_low", format!("(high <<< {}) + (mixed <<< {q})", 2 * q));
    let left_out = number(3 << (2 * q - 1));
    claim.value("row", format!("(without_low + {left_out} + {half}) >>> {}", f + 2));
    // Lemma row: a bound on the rounded sum.
    let most = number(3 * p.one() + 4);
    claim.given(format!("-{most} <= row && row <= {most}")).shown("turned == row");
    claim.value("error", format!("(turned <<< {}) - (without_low + {})", f + 2, joined(" + ", low)));
    claim.shown(format!("-({half} + {left_out}) <= error && error <= {half} + {left_out}"));
    claim.mutant(WrongComponent, "high_high_unit").mutant(NoUlp, "mixed_sum_second_d1").mutant(WrongSlice, "turned");
    claim.mutant(WrongSlice, "high_high_x(i)").mutant(WrongSign, "mixed");
    claim
}
