//! Claims of interval multiplication: two multipliers against the definition by four products.
//!
//! At small widths with the multipliers themselves. At full width in parts: the factors taken are those of the least
//! and the greatest corner whatever numbers the four products are, as long as they are ordered as products are; and what
//! is multiplied and put together from tiles is the product of these factors.

use super::claim::Claim;
use super::settings::Setting;
use super::unit::Mistake::{Inverted, NotStrict, WrongArm, WrongGate, WrongSign};
use super::unit::Subject;
use efsat::design::interval;
use efsat::graph::Type;

const CORNERS: [(&str, &str, &str); 4] =
    [("ll", "x_lo", "y_lo"), ("lh", "x_lo", "y_hi"), ("hl", "x_hi", "y_lo"), ("hh", "x_hi", "y_hi")];

const BOTH_STRADDLE: &str = "(x_lo < 0 && 0 < x_hi && y_lo < 0 && 0 < y_hi)";

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
    claim.mutant(WrongArm, "lo_x_bound").mutant(WrongArm, "hi_y_bound").mutant(WrongGate, "lo_takes_x_hi");
    claim.mutant(NotStrict, "x_hi_above").mutant(WrongGate, "both_straddle").mutant(WrongArm, "x_greatest_wide");
}

/// Two factors of few bits, with the multipliers: the definition, and containment of every product.
pub fn by_definition(bits: (u32, u32)) -> Vec<Claim> {
    let bound = |bits: u32| (1i128 << (bits - 1)) - 1;
    let unit = || {
        let (x, y) = ((Type::signed(bits.0, 0), bound(bits.0)), (Type::signed(bits.1, 0), bound(bits.1)));
        Subject::of_unit(&interval::multiply_unit("interval_multiply", x, y))
    };
    let widths = format!("{} x {} bits", bits.0, bits.1);
    let mut equal = Claim::new(unit(), widths.clone(), "nine cases = four products, [-P, P] in the ninth");
    for (name, x, y) in CORNERS {
        equal.product(name, x, y);
    }
    extremes(&mut equal);
    equal.value("magnitude", "(greatest > -least ? greatest : -least)");
    equal.shown(format!("{BOTH_STRADDLE} ? lo == -magnitude && hi == magnitude : lo == least && hi == greatest"));
    mistakes(&mut equal);
    let mut contains = Claim::new(unit(), widths, "contains x y");
    contains.within("x", "x").within("y", "y").product("xy", "x", "y").shown("lo <= xy && xy <= hi");
    contains.mutant(WrongArm, "lo_x_bound").mutant(WrongGate, "lo_takes_x_hi").mutant(WrongArm, "x_greatest_wide");
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
    let subject = Subject::of_unit(&interval::multiply_unit("interval_multiply", x, y));
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
    claim.value("x_most", "(-x_lo > x_hi ? -x_lo : x_hi)").value("y_most", "(-y_lo > y_hi ? -y_lo : y_hi)");
    for (end, extreme, sign) in [("lo", "least", "-"), ("hi", "greatest", "")] {
        let corner =
            |(corner, x, y): (&str, &str, &str)| format!("({end}_x == {x} && {end}_y == {y} && {corner} == {extreme})");
        let corners = CORNERS.map(corner).join(" || ");
        claim.shown(format!("{BOTH_STRADDLE} ? {end}_x == {sign}x_most && {end}_y == y_most : {corners}"));
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
    let subject = Subject::of_unit(&interval::multiply_unit("interval_multiply", x, y));
    let mut claim = Claim::new(subject, format!("{} x {} bits", bits.0, bits.1), "sum of tiles = product");
    claim.seen(&["lo_x", "lo_y", "hi_x", "hi_y"]);
    claim.product("least", "lo_x", "lo_y").product("greatest", "hi_x", "hi_y");
    claim.shown("lo == least && hi == greatest");
    claim.mutant(WrongSign, if bits.0.max(bits.1) > 35 { "product_lo_sum_l" } else { "product_lo_sum" });
    claim
}
