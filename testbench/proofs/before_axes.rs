//! Claims of what comes before the axes: frame transform and re-normalisation.

use super::axes::COORDINATES;
use super::claim::{Claim, number};
use super::rounding::claim_rounded;
use super::settings::Setting;
use super::unit::Mistake::{
    Inverted, NoUlp, NotMissing, OtherBound, Reversed, WrongArm, WrongComponent, WrongGate, WrongLastGate, WrongSign,
    WrongSlice,
};
use super::unit::Subject;
use efsat::design::rounding::Rounding;
use efsat::params::{Params, Upper};

/// A number as it comes from the host: claims that the value `{name}_ulp` is what its upper bound is above the lower one.
fn host_bounds(claim: &mut Claim, params: &Params, name: &str, exact: bool) {
    let ulp = match params.upper {
        Upper::Sticky => format!("{name}_sticky"),
        Upper::Implied if exact => "(bypass ? 0 : 1)".to_owned(),
        Upper::Implied => "1".to_owned(),
    };
    claim.value(&format!("{name}_ulp"), ulp);
    if params.upper == Upper::Sticky {
        // Lemma declared-range: the ceiling of a number within its range is within it.
        let (_, most) = claim.subject.input(&format!("{name}_lo")).range.expect("inputs have ranges");
        claim.given(format!("{name}_lo + {name}_ulp <= {}", number(most)));
    }
}

/// The numbers of a row of the transform, as they come from the host.
fn row(setting: &Setting, property: &'static str) -> Claim {
    let mut claim = Claim::new(Subject::of_design(setting, "transform_row"), setting.label(), property);
    host_bounds(&mut claim, &setting.params, "t", true);
    for c in COORDINATES {
        host_bounds(&mut claim, &setting.params, &format!("m_{c}"), true);
        host_bounds(&mut claim, &setting.params, &format!("x_{c}"), false);
    }
    claim
}

/// That a row of the matrix is the identity's for coordinate `c`, all exact, with bypass.
fn identity(params: &Params, c: &str) -> String {
    let entry = |j: &str| {
        let entry = number(if j == c { params.one() } else { 0 });
        format!("m_{j}_lo == {entry} && m_{j}_ulp == 0")
    };
    format!("bypass && t_lo == 0 && t_ulp == 0 && {}", COORDINATES.map(entry).join(" && "))
}

/// What the identity adds at an end.
fn identity_term(params: &Params, c: &str, end: &str) -> String {
    if end == "lo" { number(0) } else { format!("(x_{c}_ulp != 0 ? {} : 0)", number(params.one())) }
}

/// What a row of the transform adds, at an end, to its product of lower bounds is what the least (greatest) of the four
/// products of the bounds is above it, summed over the coordinates. The four are told by their differences from the first;
/// see [`one_above`](super::products::one_above).
pub fn transform_end(setting: &Setting, end: &str) -> Claim {
    let lower = end == "lo";
    let mut claim = row(setting, if lower { "terms of the least products" } else { "terms of the greatest products" });
    let terms = format!("{end}_terms");
    claim.seen(&terms);
    let (is, of_sign) = if lower { ("<", "<") } else { (">", ">=") };
    for c in COORDINATES {
        let (m, x) = (format!("m_{c}"), format!("x_{c}"));
        claim.value(&format!("lh_{c}"), format!("{x}_ulp != 0 ? {m}_lo : 0"));
        claim.value(&format!("hl_{c}"), format!("{m}_ulp != 0 ? {x}_lo : 0"));
        let both = format!("({m}_ulp != 0 && {x}_ulp != 0 ? 1 : 0)");
        claim.value(&format!("hh_{c}"), format!("lh_{c} + hl_{c} + {both}"));
        claim.value(&format!("low_{c}"), format!("0 {is} lh_{c} ? 0 : lh_{c}"));
        claim.value(&format!("high_{c}"), format!("hl_{c} {is} hh_{c} ? hl_{c} : hh_{c}"));
        // As the unit finds it, by signs: the solver need not compare in the sum.
        let takes = |own: &str, other: &str| format!("({own}_lo {of_sign} 0 && {other}_ulp != 0)");
        let (takes_m, takes_x) = (takes(&m, &x), takes(&x, &m));
        let of_factors = format!("(({takes_m} ? {m}_lo : 0) + ({takes_x} ? {x}_lo : 0))");
        claim.value(&format!("term_{c}"), format!("{of_factors} + ({takes_m} && {takes_x} ? 1 : 0)"));
        claim.shown(format!("term_{c} == (low_{c} {is} high_{c} ? low_{c} : high_{c})"));
        let of_identity = identity_term(&setting.params, c, end);
        claim.shown(format!("!({}) || {terms} == {of_identity}", identity(&setting.params, c)));
    }
    claim.shown(format!("{terms} == (term_x + term_y) + term_z"));
    claim.mutant(WrongGate, format!("{end}_takes_x(i)")).mutant(Inverted, format!("{end}_takes_m(i)"));
    let sum = format!("{end}_term_floor_1_sum(i)");
    claim.mutant(WrongArm, &sum).mutant(WrongGate, &sum);
    claim
}

/// A row of the transform, whatever its three products are and what is added to them at each end: the right operands are
/// multiplied, and the row is contained. With bypass nothing is rounded up: the identity is proved from exact products by
/// one and by zero, and from what [`transform_end`] shows of the terms then.
pub fn transform_row(setting: &Setting) -> Claim {
    let params = &setting.params;
    let mut claim = row(setting, "contains m x + t, within an ulp; operands; bypass");
    claim.cut("lo_terms").cut("hi_terms");
    for c in COORDINATES {
        claim.cut(&format!("product_{c}_result_p"));
        claim.seen(&format!("product_{c}_result_x")).seen(&format!("product_{c}_result_y"));
        claim.shown(format!("product_{c}_result_x == m_{c}_lo && product_{c}_result_y == x_{c}_lo"));
    }
    let fraction = params.input().fraction;
    // In the order of the unit: to show that the order does not matter would be the solver's hardest work.
    let [x, y, z] = COORDINATES.map(|c| format!("product_{c}_result_p"));
    claim.value("sum", format!("({x} + {y}) + ({z} + (t_lo <<< {fraction}))"));
    claim.value("exact_lo", "sum + lo_terms").value("exact_hi", format!("(sum + (t_ulp <<< {fraction})) + hi_terms"));
    claim.between("exact_truth", "exact_lo", "exact_hi", 2 * params.transform_width + 4);
    let way = Rounding { drop: fraction, saturate: None };
    // With bypass the implied rule adds no ulp; what holds then is claimed below.
    let when = if params.upper == Upper::Implied { "!bypass" } else { "1" };
    claim_rounded(&mut claim, when, "b", "exact", way, params.upper);
    for c in COORDINATES {
        let product = |j: &str| match j == c {
            true => format!("product_{j}_result_p == (x_{j}_lo <<< {fraction})"),
            false => format!("product_{j}_result_p == 0"),
        };
        let terms = format!("lo_terms == 0 && hi_terms == {}", identity_term(params, c, "hi"));
        let when = format!("{} && {terms} && {}", identity(params, c), COORDINATES.map(product).join(" && "));
        claim.shown(format!("!({when}) || (b_lo == x_{c}_lo && b_hi == x_{c}_lo + x_{c}_ulp)"));
    }
    claim.mutant(WrongSign, "lo_exact").mutant(WrongComponent, "product_result_unit");
    claim.mutant(NoUlp, "b.hi|b_hi_sum").mutant(WrongSlice, "b_floor_28_d1.lo|b_lo_floor_28_d1");
    match params.upper {
        Upper::Implied => claim.mutant(NotMissing, "b_hi_aligned_not_line"),
        Upper::Sticky => claim.mutant(NoUlp, "hi_exact_sum_d1"),
    };
    claim
}

/// A row of a pure translation: exact.
pub fn translated_row(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(setting, "transform_row");
    let mut claim = Claim::new(subject, format!("{}, translate", setting.label()), "exact");
    host_bounds(&mut claim, params, "x", false);
    host_bounds(&mut claim, params, "t", true);
    claim.shown("b_lo == x_lo + t_lo && b_hi == (x_lo + x_ulp) + (t_lo + t_ulp)");
    claim.mutant(NoUlp, "b.lo|b_sum.lo").mutant(NoUlp, "b_hi_sum_first_d1|b_hi_sum|b_sum.hi");
    claim
}

/// A guard flags exactly the numbers outside, and lets none through.
pub fn guard(setting: &Setting, what: &str, entity: &str, bound: i128) -> Claim {
    let subject = Subject::of_design(setting, entity);
    let mut claim =
        Claim::new(subject, format!("{}, {what}", setting.label()), "flags what is outside, keeps what is inside");
    let sticky = setting.params.upper == Upper::Sticky;
    let above = if sticky { " + number_sticky" } else { "" };
    let bound = number(bound);
    claim.value("above", format!("number_lo{above}")).value("least", format!("-{bound}"));
    claim.shown(format!("(outside != 0) == (number_lo < least || above > {bound})"));
    claim.shown(format!("least <= passed && passed{above} <= {bound}"));
    claim.shown("outside != 0 || passed == number_lo");
    claim.mutant(WrongArm, "passed").mutant(WrongSlice, "high").mutant(WrongGate, "outside|outside_i");
    claim.mutant(WrongGate, "above").mutant(Inverted, "below");
    if sticky {
        claim.mutant(WrongLastGate, "above");
    }
    claim
}

/// Offsets from V0 are exact.
pub fn offset(setting: &Setting) -> Claim {
    let subject = Subject::of_design(setting, "renormalise_offset");
    let mut claim = Claim::new(subject, setting.label(), "exact");
    for (c, end) in COORDINATES.into_iter().flat_map(|c| [(c, "lo"), (c, "hi")]) {
        claim.shown(format!("offset_{c}_{end} == point_{c}_{end} - origin_{c}"));
    }
    claim.mutant(Reversed, "offset(i).lo").mutant(OtherBound, "offset(i).hi");
    claim
}

/// The shift moves the highest set bit of any word to the top.
pub fn shift(setting: &Setting) -> Claim {
    let subject = Subject::of_design(setting, "renormalise_shift");
    let (bits, stages) = (subject.input("magnitudes").bits, subject.outputs.len());
    let mut claim = Claim::new(subject, setting.label(), "shift = leading zeros");
    claim.value("zeros", shift_by(stages, "shift"));
    claim.value("shifted", "magnitudes <<< zeros");
    let (top, most) = (number(1 << (bits - 1)), number((1 << bits) - 1));
    claim.shown(format!("magnitudes == 0 || ({top} <= shifted && shifted <= {most})"));
    claim.mutant(WrongArm, "word_1").mutant(NotMissing, "shift_i(0)").mutant(WrongSlice, "shift_i(2)");
    claim
}

/// The number that the flags `{name}<i>` are the bits of.
fn shift_by(stages: usize, name: &str) -> String {
    let flags = (0..stages).rev().map(|i| format!("raw_{name}{i}"));
    format!("{{{}}}", flags.collect::<Vec<_>>().join(", "))
}

/// Scaling encloses `x / 2^L` within an ulp and within [-1, 1], for every shift that the magnitudes allow.
pub fn scale(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(setting, "renormalise_scale");
    // A bound has a sign more than its magnitude, and a vector a word of flags.
    let (bits, stages) = (subject.input("offset_x_lo").bits - 1, subject.inputs.len() / 3 - 2);
    let mut claim = Claim::new(subject, setting.label(), "contains x / 2^L in [-1, 1], within an ulp");
    let most = number((1 << bits) - 1);
    let one = number(1 << (params.width - 2));
    for c in COORDINATES {
        // Lemma normalise: shifted by W - L, every |x| < 2^L stays below 2^W.
        claim.value(&format!("shift_{c}"), shift_by(stages, &format!("shift_{c}")));
        for end in ["lo", "hi"] {
            let name = format!("{c}_exact_{end}");
            claim.value(&name, format!("offset_{c}_{end} <<< shift_{c}"));
            claim.given(format!("-{most} <= {name} && {name} <= {most}"));
        }
        let (lo, hi) = (format!("{c}_exact_lo"), format!("{c}_exact_hi"));
        claim.between(&format!("{c}_exact_truth"), &lo, &hi, bits + 2);
        let way = Rounding { drop: bits as i32 - (params.width as i32 - 2), saturate: None };
        claim_rounded(&mut claim, "1", &format!("scaled_{c}"), &format!("{c}_exact"), way, params.upper);
        claim.shown(format!("-{one} <= scaled_{c}_lo && scaled_{c}_hi <= {one}"));
    }
    claim
        .mutant(WrongArm, "shifted_1(i).lo")
        .mutant(WrongSlice, "scaled(i).hi")
        .mutant(NoUlp, "scaled(i).hi|scaled_hi_up(i)|scaled_hi_up_d1(i)");
    claim
}

/// Without re-normalisation: coordinates rounded to the working width.
pub fn rounded_coordinates(setting: &Setting) -> Claim {
    let params = &setting.params;
    let subject = Subject::of_design(setting, "coordinate_round");
    let mut claim = Claim::new(subject, setting.label(), "contains x, within an ulp");
    let way = Rounding { drop: params.transform_width as i32 - params.width as i32, saturate: None };
    for c in COORDINATES {
        let exact = format!("{c}_exact");
        claim.value(&format!("{exact}_lo"), format!("point_{c}_lo"));
        claim.value(&format!("{exact}_hi"), format!("point_{c}_hi"));
        claim.within(&format!("{exact}_truth"), &format!("point_{c}"));
        claim_rounded(&mut claim, "1", &format!("rounded_{c}"), &exact, way, params.upper);
    }
    claim.mutant(NoUlp, "rounded(i).hi|rounded_hi_up(i)").mutant(WrongSlice, "rounded(i).lo");
    claim
}
