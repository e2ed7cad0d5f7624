//! Claims of interval multiplication: two multipliers against the definition by four products.
//!
//! At small widths with the multipliers themselves. At full width in parts: the factors taken are those of the least
//! and the greatest corner whatever numbers the four products are, as long as they are ordered as products are; and what
//! is multiplied and put together from tiles is the product of these factors.

use super::claim::Claim;
use super::settings::Setting;
use super::unit::Mistake::{Inverted, NoUlp, WrongArm, WrongGate, WrongSign};
use super::unit::Subject;
use efsat::design::multiply::{self, Span, case};
use efsat::graph::Type;

const CORNERS: [(&str, &str, &str); 4] =
    [("ll", "x_lo", "y_lo"), ("lh", "x_lo", "y_hi"), ("hl", "x_hi", "y_lo"), ("hh", "x_hi", "y_hi")];

const BOTH_STRADDLE: &str = "(x_lo < 0 && 0 < x_hi && y_lo < 0 && 0 < y_hi)";

/// The sign case of an interval, by its definition.
pub fn sign_case(of: &str) -> String {
    let (positive, negative, upper, lower) = (case::POSITIVE, case::NEGATIVE, case::UPPER, case::LOWER);
    format!("({of}_lo >= 0 ? {positive} : {of}_hi <= 0 ? {negative} : -{of}_lo <= {of}_hi ? {upper} : {lower})")
}

/// Assumes that the ports for sign cases hold those of their intervals.
pub fn given_sign_cases(claim: &mut Claim, intervals: &[&str]) {
    for of in intervals {
        claim.given(format!("{of}_sign_case == {}", sign_case(of)));
    }
}

/// The unit that finds sign cases.
pub fn sign_cases(setting: &Setting) -> Claim {
    let subject = Subject::of_design(&setting.params, "sign_case");
    let mut claim = Claim::new(subject, setting.label(), "sign case as defined");
    claim.shown(format!("x_sign_case == {}", sign_case("x")));
    claim.mutant(WrongGate, "hi_above").mutant(WrongGate, "straddles").mutant(WrongSign, "sum");
    claim
}

/// The least and the greatest corner, and the greatest magnitude.
fn extremes(claim: &mut Claim) {
    let extreme = |x: &str, y: &str, is: &str| format!("({x} {is} {y} ? {x} : {y})");
    for (name, is) in [("least", "<"), ("greatest", ">")] {
        claim.value(&format!("{name}_of_x_lo"), extreme("ll", "lh", is));
        claim.value(&format!("{name}_of_x_hi"), extreme("hl", "hh", is));
        claim.value(name, extreme(&format!("{name}_of_x_lo"), &format!("{name}_of_x_hi"), is));
    }
}

fn mistakes(claim: &mut Claim) {
    claim.mutant(WrongArm, "lo_x_bound").mutant(WrongArm, "hi_y").mutant(WrongGate, "lo_takes_x_hi");
    claim.mutant(WrongArm, "hi_takes_y_hi").mutant(WrongGate, "lo_negates_x").mutant(NoUlp, "hi_x");
}

/// Two factors of few bits, with the multipliers: the definition, and containment of every product.
pub fn by_definition(bits: (u32, u32)) -> Vec<Claim> {
    let bound = |bits: u32| (1i128 << (bits - 1)) - 1;
    let unit = || {
        let (x, y) = ((Type::signed(bits.0, 0), bound(bits.0)), (Type::signed(bits.1, 0), bound(bits.1)));
        Subject::of_unit(&multiply::multiply_unit("interval_multiply", x, y))
    };
    let widths = format!("{} x {} bits", bits.0, bits.1);
    let mut equal = Claim::new(unit(), widths.clone(), "nine cases = four products, [-P, P] in the ninth");
    for (name, x, y) in CORNERS {
        equal.product(name, x, y);
    }
    extremes(&mut equal);
    given_sign_cases(&mut equal, &["x", "y"]);
    equal.value("magnitude", "(greatest > -least ? greatest : -least)");
    equal.shown(format!("{BOTH_STRADDLE} ? lo == -magnitude && hi == magnitude : lo == least && hi == greatest"));
    mistakes(&mut equal);
    let mut contains = Claim::new(unit(), widths, "contains x y");
    contains.within("x", "x").within("y", "y").product("xy", "x", "y").shown("lo <= xy && xy <= hi");
    given_sign_cases(&mut contains, &["x", "y"]);
    contains.mutant(WrongArm, "lo_x_bound").mutant(WrongGate, "lo_takes_x_hi").mutant(NoUlp, "hi_x");
    vec![equal, contains]
}

/// Monotonicity of products, on which the full width relies.
fn ordered() -> [String; 8] {
    let rise = |sign: &str, x: &str, y: &str| {
        [format!("!({sign} >= 0) || {x} <= {y}"), format!("!({sign} <= 0) || {y} <= {x}")]
    };
    let [a, b] = rise("y_lo", "ll", "hl");
    let [c, d] = rise("y_hi", "lh", "hh");
    let [e, f] = rise("x_lo", "ll", "lh");
    let [g, h] = rise("x_hi", "hl", "hh");
    [a, b, c, d, e, f, g, h]
}

/// The order of neighbouring corners holds of products. The claim is of numbers, not of a unit: the multiplication
/// brings the two intervals, and no mistake in it matters.
pub fn order_of_corners(bits: (u32, u32)) -> Claim {
    let bound = |bits: u32| (1i128 << (bits - 1)) - 1;
    let (x, y) = ((Type::signed(bits.0, 0), bound(bits.0)), (Type::signed(bits.1, 0), bound(bits.1)));
    let subject = Subject::of_unit(&multiply::multiply_unit("interval_multiply", x, y));
    let mut claim =
        Claim::new(subject, format!("{} x {} bits", bits.0, bits.1), "corner products are ordered by signs");
    for (name, x, y) in CORNERS {
        claim.product(name, x, y);
    }
    for fact in ordered() {
        claim.shown(fact);
    }
    claim
}

/// The factors taken at full width: those of the corners that are least and greatest.
pub fn factors(setting: &Setting, name: &str) -> Claim {
    let subject = Subject::of_design(&setting.params, name);
    let mut claim = Claim::new(subject, setting.label(), "factors of the least and the greatest corner");
    let bits = claim.subject.input("x_lo").bits + claim.subject.input("y_lo").bits;
    for (corner, _, _) in CORNERS {
        claim.free(corner, bits);
    }
    for fact in ordered() {
        claim.given(fact);
    }
    extremes(&mut claim);
    claim.seen(&["lo_x", "lo_y", "hi_x", "hi_y"]);
    given_sign_cases(&mut claim, &["x", "y"]);
    claim.value("x_most", "(-x_lo > x_hi ? -x_lo : x_hi)").value("y_most", "(-y_lo > y_hi ? -y_lo : y_hi)");
    for (end, extreme, signs) in [("lo", "least", "!="), ("hi", "greatest", "==")] {
        let corner =
            |(corner, x, y): (&str, &str, &str)| format!("({end}_x == {x} && {end}_y == {y} && {corner} == {extreme})");
        let corners = CORNERS.map(corner).join(" || ");
        // P or -P: both factors as far from zero as they come, of different signs or of one.
        let far = |factor: &str, most: &str| format!("({factor} == {most} || {factor} == -{most})");
        let (x, y) = (far(&format!("{end}_x"), "x_most"), far(&format!("{end}_y"), "y_most"));
        let magnitude = format!("({x} && {y} && ({end}_x < 0) {signs} ({end}_y < 0))");
        claim.shown(format!("{BOTH_STRADDLE} ? {magnitude} : {corners}"));
    }
    mistakes(&mut claim);
    claim
}

/// The bounds at full width are the products of the factors, where these fit one multiplier: both sides multiply the
/// same signals, so the solver need not look into the multiplier.
pub fn multiplied(setting: &Setting, name: &str) -> Claim {
    let subject = Subject::of_design(&setting.params, name);
    let mut claim = Claim::new(subject, setting.label(), "bounds are the products of the factors");
    claim.seen(&["lo_x", "lo_y", "hi_x", "hi_y"]);
    claim.product("least", "lo_x", "lo_y").product("greatest", "hi_x", "hi_y");
    claim.shown("lo == least && hi == greatest");
    claim.mutant(Inverted, "lo_x_d1");
    claim
}

/// Factors wider than a multiplier, one of them by few bits: the sum of tiles is the product.
pub fn in_tiles(bits: (u32, u32)) -> Claim {
    let bound = |bits: u32| (1i128 << (bits - 1)) - 1;
    let (x, y) = ((Type::signed(bits.0, 0), bound(bits.0)), (Type::signed(bits.1, 0), bound(bits.1)));
    let subject = Subject::of_unit(&multiply::multiply_unit("interval_multiply", x, y));
    let mut claim = Claim::new(subject, format!("{} x {} bits", bits.0, bits.1), "sum of tiles = product");
    claim.seen(&["lo_x", "lo_y", "hi_x", "hi_y"]);
    claim.product("least", "lo_x", "lo_y").product("greatest", "hi_x", "hi_y");
    claim.shown("lo == least && hi == greatest");
    claim.mutant(WrongSign, "product_lo_sum_1_above");
    claim
}

/// The upper bounds of quantised factors, as free numbers that equal them.
fn quantised_bounds(claim: &mut Claim) {
    for name in ["m", "x"] {
        let bits = claim.subject.input(&format!("{name}_lo")).bits + 1;
        claim.free(&format!("{name}_hi"), bits).given(format!("{name}_hi == {name}_lo + {name}_ulp"));
    }
}

const QUANTISED_CORNERS: [(&str, &str, &str); 4] =
    [("ll", "m_lo", "x_lo"), ("lh", "m_lo", "x_hi"), ("hl", "m_hi", "x_lo"), ("hh", "m_hi", "x_hi")];

/// The least and the greatest corner of quantised factors.
fn quantised_extremes(claim: &mut Claim) {
    let extreme = |x: &str, y: &str, is: &str| format!("({x} {is} {y} ? {x} : {y})");
    for (name, is) in [("least", "<"), ("greatest", ">")] {
        claim.value(&format!("{name}_of_m"), extreme("ll", "lh", is));
        claim.value(&format!("{name}_of_m_hi"), extreme("hl", "hh", is));
        claim.value(name, extreme(&format!("{name}_of_m"), &format!("{name}_of_m_hi"), is));
    }
    claim.mutant(WrongGate, "lo_m_up").mutant(NoUlp, "hi_x_sum").mutant(NoUlp, "lo_x_sum");
}

/// Quantised factors of few bits, with the multipliers: the definition by four products.
pub fn quantised_by_definition(bits: u32) -> Claim {
    let lo = (1i128 << (bits - 1)) - 2;
    let span = Span { ty: Type::signed(bits, 0), lo, hi: lo + 1 };
    let unit = multiply::quantised_multiply_unit("quantised_multiply", span, span);
    let mut claim = Claim::new(Subject::of_unit(&unit), format!("{bits} x {bits} bits"), "= four products");
    quantised_bounds(&mut claim);
    for (name, m, x) in QUANTISED_CORNERS {
        claim.product(name, m, x);
    }
    quantised_extremes(&mut claim);
    claim.shown("lo == least && hi == greatest");
    claim
}

/// The factors taken of quantised numbers at full width: those of the corners that are least and greatest.
pub fn quantised_factors(setting: &Setting) -> Claim {
    let subject = Subject::of_design(&setting.params, "transform_multiply");
    let mut claim = Claim::new(subject, setting.label(), "factors of the least and the greatest corner");
    quantised_bounds(&mut claim);
    let bits = claim.subject.input("m_lo").bits + claim.subject.input("x_lo").bits;
    for (corner, _, _) in QUANTISED_CORNERS {
        claim.free(corner, bits);
    }
    let rise = |sign: &str, x: &str, y: &str| {
        [format!("!({sign} >= 0) || {x} <= {y}"), format!("!({sign} <= 0) || {y} <= {x}")]
    };
    let pairs = [("x_lo", "ll", "hl"), ("x_hi", "lh", "hh"), ("m_lo", "ll", "lh"), ("m_hi", "hl", "hh")];
    for fact in pairs.into_iter().flat_map(|(sign, x, y)| rise(sign, x, y)) {
        claim.given(fact);
    }
    quantised_extremes(&mut claim);
    claim.seen(&["lo_m", "lo_x", "hi_m", "hi_x"]);
    for (end, extreme) in [("lo", "least"), ("hi", "greatest")] {
        let corner =
            |(corner, m, x): (&str, &str, &str)| format!("({end}_m == {m} && {end}_x == {x} && {corner} == {extreme})");
        claim.shown(QUANTISED_CORNERS.map(corner).join(" || "));
    }
    claim
}
