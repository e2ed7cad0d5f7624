//! Claims of what comes before the axes: frame transform and re-normalisation.

use super::claim::{Claim, number};
use super::rounding::claim_rounded;
use super::settings::Setting;
use super::unit::Mistake::{NoUlp, NotMissing, OtherBound, Reversed, WrongArm, WrongGate, WrongSign, WrongSlice};
use super::unit::Subject;
use efsat::design::cross_product::COORDINATES;
use efsat::design::interval::Rounding;
use efsat::design::renormalise;
use efsat::number::Upper;
use efsat::params::Params;

/// A number as it comes from the host: claims that the value `{name}_above` is its upper bound.
fn host_bounds(claim: &mut Claim, params: &Params, name: &str, exact: bool) {
    let ulp = match params.upper {
        Upper::Sticky => format!("{name}_sticky"),
        Upper::Implied if exact => "(bypass ? 0 : 1)".to_owned(),
        Upper::Implied => "1".to_owned(),
    };
    claim.value(&format!("{name}_above"), format!("{name} + {ulp}"));
    if params.upper == Upper::Sticky {
        // Lemma declared-range: the ceiling of a number within its range is within it.
        let (_, most) = claim.subject.input(name).range.expect("inputs have ranges");
        claim.given(format!("{name}_above <= {}", number(most)));
    }
}

/// A row of the transform from any enclosures of its three products: the right operands are multiplied, and the row is
/// contained. With bypass nothing is rounded up: the identity is proved from exact products by one and by zero.
pub fn transform_row(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(params, "transform_row");
    let mut claim = Claim::new(subject, setting.label(), "contains m x + t, within an ulp; operands; bypass");
    for name in ["m0", "m1", "m2", "x0", "x1", "x2", "t"] {
        host_bounds(&mut claim, params, name, !name.starts_with('x'));
    }
    let products = [0, 1, 2].map(|j| format!("m{j}_x{j}"));
    for (j, product) in products.iter().enumerate() {
        claim.cut(&[format!("{product}_lo"), format!("{product}_hi")]);
        claim.seen(&["m_lo", "m_ulp", "x_lo", "x_ulp"].map(|port| format!("{product}.{port}")));
        for factor in ["m", "x"] {
            let port = format!("{product}_{factor}");
            let above = format!("{port}_lo + {port}_ulp == {factor}{j}_above");
            claim.shown(format!("{port}_lo == {factor}{j} && {above}"));
        }
    }
    let fraction = params.input().fraction;
    // In the order of the unit: to show that the order does not matter would be the solver's hardest work.
    let sum = |end: &str, t: &str| {
        let [first, second, third] = products.each_ref().map(|product| format!("{product}_{end}"));
        format!("({first} + {second}) + ({third} + ({t} <<< {fraction}))")
    };
    claim.value("exact_lo", sum("lo", "t")).value("exact_hi", sum("hi", "t_above"));
    claim.between("exact_truth", "exact_lo", "exact_hi", 2 * params.transform_width + 3);
    let way = Rounding { drop: fraction, clamp: None };
    // With bypass the implied rule adds no ulp; what holds then is claimed below.
    let when = if params.upper == Upper::Implied { "!bypass" } else { "1" };
    claim_rounded(&mut claim, when, "b_", "exact", way, params.upper);
    // The coordinate of row 0 on the identity: products by one and by zero are exact.
    let identity = [
        format!("m0_x0_lo == (x0 <<< {fraction}) && m0_x0_hi == (x0_above <<< {fraction})"),
        "m1_x1_lo == 0 && m1_x1_hi == 0 && m2_x2_lo == 0 && m2_x2_hi == 0".to_owned(),
        "t == 0 && t_above == 0".to_owned(),
    ];
    claim.shown(format!("!(bypass && {}) || (b_lo == x0 && b_hi == x0_above)", identity.join(" && ")));
    claim.mutant(NoUlp, "t_above");
    if params.upper == Upper::Implied {
        claim.mutant(OtherBound, "b_floor_lo").mutant(WrongSlice, "b_floor_lo");
        claim.mutant(NoUlp, "b_up_above").mutant(NotMissing, "b_up_inexact").mutant(NotMissing, "m0_inexact");
    } else {
        claim.mutant(OtherBound, "b_rounded_floor_lo").mutant(NoUlp, "b_rounded_up");
    }
    claim
}

/// A row of a pure translation: exact.
pub fn translated_row(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(params, "transform_row");
    let widths = format!("{}, translate", setting.label());
    let mut claim = Claim::new(subject, widths, "exact");
    host_bounds(&mut claim, params, "x0", false);
    host_bounds(&mut claim, params, "t", true);
    claim.shown("b_lo == x0 + t && b_hi == x0_above + t_above");
    claim.mutant(OtherBound, "b_lo_bits").mutant(NoUlp, "x0_above");
    claim
}

/// A guard flags exactly the numbers outside, and lets none through.
pub fn guard(setting: &Setting, what: &str, entity: &str, bound: i128) -> Claim {
    let subject = Subject::of_design(&setting.params, entity);
    let mut claim =
        Claim::new(subject, format!("{}, {what}", setting.label()), "flags what is outside, keeps what is inside");
    let sticky = if setting.params.upper == Upper::Sticky { " + word_sticky" } else { "" };
    let bound = number(bound);
    claim.value("above", format!("word{sticky}")).value("least", format!("-{bound}"));
    claim.shown(format!("(outside != 0) == (word < least || above > {bound})"));
    claim.shown(format!("least <= passed && passed{sticky} <= {bound}"));
    claim.shown("outside != 0 || passed == word");
    claim.mutant(WrongArm, "held").mutant(WrongSlice, "high");
    claim.mutant(WrongGate, "is_outside").mutant(WrongGate, "just_above");
    if setting.params.upper == Upper::Sticky {
        claim.mutant(WrongGate, "more");
    }
    claim
}

/// Offsets from V0 are exact, and their magnitudes are true absolute values.
pub fn offset(setting: &Setting) -> Claim {
    let subject = Subject::of_design(&setting.params, "renormalise_offset");
    let mut claim = Claim::new(subject, setting.label(), "exact offsets, OR of true magnitudes");
    for c in COORDINATES {
        for end in ["lo", "hi"] {
            claim.shown(format!("offset_{c}_{end} == point_{c}_{end} - origin_{c}"));
            let offset = format!("point_{c}_{end} - origin_{c}");
            claim.value(&format!("size_{c}_{end}"), format!("{offset} < 0 ? -({offset}) : {offset}"));
        }
        claim.shown(format!("magnitude_{c} == (size_{c}_lo | size_{c}_hi)"));
    }
    claim.mutant(Reversed, "difference_x_lo").mutant(OtherBound, "difference_y_hi");
    claim.mutant(WrongGate, "magnitudes_z").mutant(WrongSign, "magnitude_z_hi_bits");
    claim
}

/// The shift moves the highest set bit of any word to the top.
pub fn shift(setting: &Setting) -> Claim {
    let subject = Subject::of_design(&setting.params, "renormalise_shift");
    let bits = renormalise::magnitude_bits(&setting.params);
    let mut claim = Claim::new(subject, setting.label(), "shift = leading zeros");
    claim.value("zeros", shift_by(setting, "shift"));
    claim.value("shifted", "magnitudes <<< zeros");
    let (top, most) = (number(1 << (bits - 1)), number((1 << bits) - 1));
    claim.shown(format!("magnitudes == 0 || ({top} <= shifted && shifted <= {most})"));
    let last = renormalise::stages(&setting.params) - 1;
    claim.mutant(WrongArm, "word_1").mutant(NotMissing, "shift_0_flag").mutant(WrongSlice, format!("top_{}", last - 1));
    claim
}

/// The number that the flags `{name}_<i>` are the bits of.
fn shift_by(setting: &Setting, name: &str) -> String {
    let stages = (0..renormalise::stages(&setting.params)).rev();
    format!("{{{}}}", stages.map(|i| format!("raw_{name}_{i}")).collect::<Vec<_>>().join(", "))
}

/// Scaling encloses `x / 2^L` within an ulp and within [-1, 1], for every shift that the magnitudes allow.
pub fn scale(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(params, "renormalise_scale");
    let bits = renormalise::magnitude_bits(params);
    let mut claim = Claim::new(subject, setting.label(), "contains x / 2^L in [-1, 1], within an ulp");
    let most = number((1 << bits) - 1);
    let one = number(1 << (params.width - 2));
    for c in COORDINATES {
        // Lemma normalise: shifted by W - L, every |x| < 2^L stays below 2^W.
        claim.value(&format!("shift_{c}"), shift_by(setting, &format!("shift_{c}")));
        for end in ["lo", "hi"] {
            let name = format!("{c}_exact_{end}");
            claim.value(&name, format!("offset_{c}_{end} <<< shift_{c}"));
            claim.given(format!("-{most} <= {name} && {name} <= {most}"));
        }
        let (lo, hi) = (format!("{c}_exact_lo"), format!("{c}_exact_hi"));
        claim.between(&format!("{c}_exact_truth"), &lo, &hi, bits + 2);
        let way = Rounding { drop: bits as i32 - (params.width as i32 - 2), clamp: None };
        claim_rounded(&mut claim, "1", &format!("{c}_"), &format!("{c}_exact"), way, params.upper);
        claim.shown(format!("-{one} <= {c}_lo && {c}_hi <= {one}"));
    }
    claim.mutant(WrongArm, "either_x_lo_1").mutant(WrongSlice, "y_rounded_floor_hi").mutant(NoUlp, "z_rounded_up");
    claim
}

/// Without re-normalisation: coordinates rounded to the working width.
pub fn rounded_coordinates(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(params, "coordinate_round");
    let mut claim = Claim::new(subject, setting.label(), "contains x, within an ulp");
    let way = Rounding { drop: params.transform_width as i32 - params.width as i32, clamp: None };
    for c in COORDINATES {
        let exact = format!("{c}_exact");
        claim.value(&format!("{exact}_lo"), format!("point_{c}_lo"));
        claim.value(&format!("{exact}_hi"), format!("point_{c}_hi"));
        claim.within(&format!("{exact}_truth"), &format!("point_{c}"));
        claim_rounded(&mut claim, "1", &format!("{c}_"), &exact, way, params.upper);
    }
    claim.mutant(NoUlp, "x_rounded_up").mutant(WrongSlice, "z_rounded_floor_lo");
    claim
}
