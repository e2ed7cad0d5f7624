//! Claims of the volume unit (docs/engine-volume.md): the units of a direction as defined, and conservative.

use super::claim::{Claim, number};
use super::determinants::cut_product;
use super::unit::Mistake::{NoUlp, Reversed, WrongArm, WrongSign, WrongSlice};
use super::unit::Subject;
use efsat::engine::design::volume_unit::VolumeDesign;
use efsat::engine::format::EngineFormat;
use efsat::engine::params::EngineParams;
use efsat::params::Params;

/// The formats of the default engine.
fn format() -> EngineFormat {
    EngineParams::default().format(&Params::default()).expect("the default engine")
}

fn of(entity: &str, property: &'static str) -> Claim {
    let engine = EngineParams { expansion_clocks: 1, ..EngineParams::default() };
    let design = VolumeDesign::new(&engine, &Params::default()).expect("the default engine");
    let EngineParams { origin_bits, offset_bits, factor_bits, .. } = engine;
    let widths = format!("{origin_bits}/{offset_bits}/{factor_bits} bits");
    Claim::new(Subject::new(&design.stage, &format!("volume_{entity}")), widths, property)
}

/// A component of D.
pub fn origin_row() -> Claim {
    let format = format();
    let mut claim = of("origin_row", "operands; floor of the sum of the products, and the origins");
    let products = ["x", "y", "z"]
        .map(|c| cut_product(&mut claim, &format!("product_{c}_result"), &format!("m_{c}"), &format!("o_b_{c}")));
    let [sum, shift] = [products.join(" + "), format.product_shift().to_string()];
    claim.value("rotated", sum);
    claim.shown(format!("d == (rotated >>> {shift}) + t - (o_a <<< {})", format.origin_shift()));
    claim.mutant(WrongSign, "sum").mutant(Reversed, "from_a").mutant(WrongSign, "d");
    claim
}

/// The code of a term.
pub fn select_code() -> Claim {
    let mut claim = of("select_code_6", "the code of the choice");
    claim.compares_only();
    (0..6).for_each(|i| _ = claim.shown(format!("choice != {i} || code == codes{i}")));
    claim.mutant(WrongArm, "code").mutant(WrongArm, "chosen_0(k)|chosen_0(0)").mutant(WrongArm, "chosen_1(0)|chosen_1");
    claim
}

/// The sum of a row.
pub fn row_sum() -> Claim {
    let mut claim = of("row_sum", "operands; exact sum");
    let products = [0, 1, 2]
        .map(|j| cut_product(&mut claim, &format!("product{j}"), &format!("codes{j}"), &format!("factors{j}")));
    claim.shown(format!("s == {} + rest + ceiling", products.join(" + ")));
    claim.mutant(WrongSign, "more").mutant(WrongSign, "s").mutant(NoUlp, "s");
    claim
}

/// The bound of B on the common grid: with what is added to the sum, the least number that is not below the exact one.
pub fn align_sum() -> Claim {
    let drop = format().factor_fraction();
    let mut claim = of("align_sum", "not below S 2^e / 2^11, and less than one above");
    let bits = claim.subject.input("x").bits;
    claim.room_for(20).free("truth", bits);
    claim.value("ceiling", format!("exponent < {drop} ? ((1 <<< ({drop} - exponent)) - 1) : 0"));
    claim.given("x == truth + ceiling");
    claim.value("exact", "truth <<< exponent");
    claim.value("scaled", format!("aligned <<< {drop}"));
    claim.shown(format!("exact <= scaled && scaled < exact + {}", number(1 << drop)));
    claim.mutant(WrongArm, "shifted_0").mutant(WrongArm, "shifted_3").mutant(WrongSlice, "shifted_2_floor_3");
    claim
}

/// A code of A on the common grid.
pub fn align_code() -> Claim {
    let mut claim = of("align_code", "a 2^e");
    claim.shown("aligned == (x <<< exponent)");
    claim.mutant(WrongArm, "shifted_0").mutant(WrongArm, "shifted_2").mutant(WrongArm, "shifted_3|aligned");
    claim
}

/// The test of a direction.
pub fn direction_test() -> Claim {
    let mut claim = of("direction_test", "apart where B + U + V < 0");
    (0..2).for_each(|p| _ = claim.shown(format!("apart{p} == ((bound + u) + v{p} < 0 ? 1 : 0)")));
    claim.mutant(WrongSign, "reach").mutant(WrongSign, "apart_sum(k)");
    claim
}

/// No direction has two volumes apart with a point in both: one of A's child is at -V or above, one of B's child at B + U
/// or below.
pub fn no_point_in_both() -> Claim {
    let mut claim = of("direction_test", "not apart where a point is in both");
    let bits = claim.subject.input("u").bits + 2;
    claim.between("point", "-v0", "bound + u", bits).shown("apart0 == 0");
    claim.mutant(WrongSign, "reach").mutant(WrongSign, "apart_sum(k)");
    claim
}
