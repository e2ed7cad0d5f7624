//! Claims of interval multiplication: two multipliers against the definition by four products.
//!
//! At small widths with the multipliers themselves. At full width in parts: the factors taken are those of the least
//! and the greatest corner whatever numbers the four products are, as long as they are ordered as products are; and what
//! is multiplied and put together from tiles is the product of these factors.

use super::claim::Claim;
use super::settings::Setting;
use super::sums::interval;
use super::unit::Mistake::{Inverted, WrongArm, WrongEntry, WrongGate, WrongSign};
use super::unit::Subject;
use efsat::design::interval::{Factor, multiply, sign};
use efsat::design::product::product;
use efsat::graph::{Library, Signals};
use efsat::op::Type;

const CORNERS: [(&str, &str, &str); 4] =
    [("ll", "x_lo", "y_lo"), ("lh", "x_lo", "y_hi"), ("hl", "x_hi", "y_lo"), ("hh", "x_hi", "y_hi")];

const BOTH_STRADDLE: &str = "(x_lo < 0 && 0 < x_hi && y_lo < 0 && 0 < y_hi)";

/// The sign case of an interval, by its definition.
pub fn sign_case(of: &str) -> String {
    let (positive, negative, upper, lower) = (sign::POSITIVE, sign::NEGATIVE, sign::UPPER, sign::LOWER);
    format!("({of}_lo >= 0 ? {positive} : {of}_hi <= 0 ? {negative} : -{of}_lo <= {of}_hi ? {upper} : {lower})")
}

/// Assumes that the ports for sign cases hold those of their intervals.
fn given_sign_cases(claim: &mut Claim) {
    for of in ["x", "y"] {
        claim.given(format!("{of}_case == {}", sign_case(of)));
    }
}

/// The unit that finds sign cases.
pub fn sign_cases(setting: &Setting) -> Claim {
    let subject = Subject::of_design(setting, "sign_case");
    let mut claim = Claim::new(subject, setting.label(), "sign case as defined");
    claim.shown(format!("number == {}", sign_case("x")));
    claim.mutant(WrongGate, "straddles").mutant(WrongSign, "number_negative_sum").mutant(Inverted, "straddles");
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
    claim.mutant(WrongArm, "p_x_d1.lo|p_x.lo").mutant(WrongArm, "p_y_d1.hi|p_y.hi");
    // By the numbers of the cases: both negative, x straddling and y positive, and both straddling.
    claim.mutant(WrongEntry(5), "lo_takes_x_hi_table").mutant(WrongEntry(8), "hi_takes_y_hi_table");
    claim.mutant(WrongEntry(10), "lo_negates_x_table").mutant(WrongEntry(11), "hi_negates_x_table");
}

/// The multiplication of intervals of so many bits.
fn small((x, y): (u32, u32)) -> Subject {
    let unit = Library::default().block("operator", &[], 1, |u| {
        let factor = |bits| Factor { interval: interval(u, bits), sign_case: u.input(Type::unsigned(2), (0, 3)) };
        multiply(factor(x).named("x"), factor(y).named("y")).named("p")
    });
    Subject::of_unit(&unit, "interval_multiply")
}

/// The product of numbers of so many bits.
fn product_of((x, y): (u32, u32)) -> Subject {
    let unit = Library::default().block("operator", &[], 1, |u| {
        let (x, y) = (interval(u, x).named("x"), interval(u, y).named("y"));
        product(x.lo, y.lo).named("p")
    });
    Subject::of_unit(&unit, &format!("multiply_{x}_{y}"))
}

/// Two factors of few bits, with the multipliers: the definition, and containment of every product.
pub fn by_definition(bits: (u32, u32)) -> Vec<Claim> {
    let widths = format!("{} x {} bits", bits.0, bits.1);
    let mut equal = Claim::new(small(bits), widths.clone(), "nine cases = four products, [-P, P] in the ninth");
    for (name, x, y) in CORNERS {
        equal.product(name, x, y);
    }
    extremes(&mut equal);
    given_sign_cases(&mut equal);
    equal.value("magnitude", "(greatest > -least ? greatest : -least)");
    equal.shown(format!(
        "{BOTH_STRADDLE} ? p_lo == -magnitude && p_hi == magnitude : p_lo == least && p_hi == greatest"
    ));
    mistakes(&mut equal);
    let mut contains = Claim::new(small(bits), widths, "contains x y");
    contains.within("x", "x").within("y", "y").product("xy", "x", "y").shown("p_lo <= xy && xy <= p_hi");
    given_sign_cases(&mut contains);
    mistakes(&mut contains);
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
    let widths = format!("{} x {} bits", bits.0, bits.1);
    let mut claim = Claim::new(small(bits), widths, "corner products are ordered by signs");
    for (name, x, y) in CORNERS {
        claim.product(name, x, y);
    }
    for fact in ordered() {
        claim.shown(fact);
    }
    claim
}

/// The factors taken at full width: those of the corners that are least and greatest.
pub fn factors(setting: &Setting) -> Claim {
    let subject = Subject::of_design(setting, "interval_multiply");
    let mut claim = Claim::new(subject, setting.label(), "factors of the least and the greatest corner");
    let bits = claim.subject.input("x_lo").bits + claim.subject.input("y_lo").bits;
    for (corner, _, _) in CORNERS {
        claim.free(corner, bits);
    }
    for fact in ordered() {
        claim.given(fact);
    }
    extremes(&mut claim);
    claim.seen_ports("p_lo", &["x", "y"]).seen_ports("p_hi", &["x", "y"]);
    given_sign_cases(&mut claim);
    claim.value("x_most", "(-x_lo > x_hi ? -x_lo : x_hi)").value("y_most", "(-y_lo > y_hi ? -y_lo : y_hi)");
    for (end, extreme, signs) in [("lo", "least", "!="), ("hi", "greatest", "==")] {
        let corner = |(corner, x, y): (&str, &str, &str)| {
            format!("(p_{end}_x == {x} && p_{end}_y == {y} && {corner} == {extreme})")
        };
        let corners = CORNERS.map(corner).join(" || ");
        // P or -P: both factors as far from zero as they come, of different signs or of one.
        let far = |factor: &str| {
            let (port, most) = (format!("p_{end}_{factor}"), format!("{factor}_most"));
            format!("({port} == {most} || {port} == -{most})")
        };
        let magnitude = format!("({} && {} && (p_{end}_x < 0) {signs} (p_{end}_y < 0))", far("x"), far("y"));
        claim.shown(format!("{BOTH_STRADDLE} ? {magnitude} : {corners}"));
    }
    mistakes(&mut claim);
    claim
}

/// The bounds at full width are the products of the factors, where these fit one multiplier: both sides multiply the
/// same signals, so the solver need not look into the multiplier.
pub fn multiplied(setting: &Setting) -> Claim {
    let subject = Subject::of_design(setting, "interval_multiply");
    let mut claim = Claim::new(subject, setting.label(), "bounds are the products of the factors");
    claim.seen_ports("p_lo", &["x", "y"]).seen_ports("p_hi", &["x", "y"]);
    claim.product("least", "p_lo_x", "p_lo_y").product("greatest", "p_hi_x", "p_hi_y");
    claim.shown("p_lo == least && p_hi == greatest");
    claim.mutant(Inverted, "p");
    claim
}

/// Factors wider than a multiplier, one of them by few bits: the sum of partial products is the product.
pub fn in_parts(bits: (u32, u32)) -> Claim {
    let mut claim = Claim::new(product_of(bits), format!("{} x {} bits", bits.0, bits.1), "sum of parts = product");
    claim.product("xy", "x", "y").shown("p == xy");
    claim.mutant(WrongSign, "above_17|above_0|p");
    claim
}

/// A factor is a lower bound plus none or one: the four products are one product and sums. The transform row is proved
/// from the sums.
pub fn one_above(bits: u32) -> Claim {
    let property = "products of x, x + 1 and y, y + 1 by one product";
    let mut claim = Claim::new(product_of((bits, bits)), format!("{bits} x {bits} bits"), property);
    for of in ["x", "y"] {
        claim.free(&format!("{of}_hi"), bits + 1).given(format!("{of}_hi == {of} + 1"));
    }
    claim.product("ll", "x", "y").product("lh", "x", "y_hi").product("hl", "x_hi", "y").product("hh", "x_hi", "y_hi");
    claim.shown("ll == p").shown("lh == p + x").shown("hl == p + y").shown("hh == p + x + y + 1");
    claim.mutant(Inverted, "p");
    claim
}
