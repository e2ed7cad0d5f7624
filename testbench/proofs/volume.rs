//! Claims of the volume unit (docs/engine-volume.md): the units of a direction as defined, and conservative.

use super::claim::{Claim, number};
use super::determinants::cut_product;
use super::unit::Mistake::{NoUlp, OtherElement, Reversed, WrongArm, WrongGate, WrongSign, WrongSlice};
use super::unit::Subject;
use efsat::design::engine::volume_unit::VolumeDesign;
use efsat::directions::Directions;
use efsat::params::engine::EngineFormat;
use efsat::params::{EngineParams, Params};

/// An engine of the default widths with an expansion per clock.
fn engine(directions: Directions) -> EngineParams {
    EngineParams { directions, expansion_clocks: 1, ..EngineParams::default() }
}

/// The formats of the default engine.
fn format() -> EngineFormat {
    EngineParams::default().format(&Params::default()).expect("the default engine")
}

fn of(entity: &str, property: &'static str) -> Claim {
    of_engine(&engine(Directions::Eighteen), entity, property)
}

fn of_engine(engine: &EngineParams, entity: &str, property: &'static str) -> Claim {
    let design = VolumeDesign::new(engine, &Params::default()).expect("the default widths");
    let EngineParams { origin_bits, offset_bits, factor_bits, .. } = engine;
    let widths = format!("{origin_bits}/{offset_bits}/{factor_bits} bits, k = {}", engine.directions.count());
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

/// From the words of the query and the codes of both blocks to the answer, from any values of the units on the way: with the
/// claims of these the whole path, at one expansion per clock.
pub fn path(directions: Directions) -> Claim {
    let engine = engine(directions);
    let format = engine.format(&Params::default()).expect("the default widths");
    let mut claim = of_engine(&engine, "path", "operands of all units; answer by the flags of all directions");
    let axes = ["x", "y", "z"];
    for (i, axis) in axes.into_iter().enumerate() {
        let lane = format!("d_lane{i}");
        claim.cut(&format!("{lane}_d")).seen_ports(&lane, &["t", "o_a"]);
        claim.shown(format!("{lane}_t == query_shift_{axis} && {lane}_o_a == a_origin_{axis}"));
        for column in axes {
            claim.seen_ports(&lane, &[&format!("m_{column}"), &format!("o_b_{column}")]);
            claim.shown(format!(
                "{lane}_m_{column} == query_pose{i}_{column} && {lane}_o_b_{column} == b_origin_{column}"
            ));
        }
    }
    let drop = format.factor_fraction();
    claim.value("ceiling", format!("b_exponent < {drop} ? ((1 <<< ({drop} - b_exponent)) - 1) : 0"));
    let mut apart = vec![vec![]; 4];
    for unit in 0..2 * format.directions.count() {
        let (h, q) = (unit / 2, unit % 2);
        let row = format!("query_row{h}");
        let s = format!("s{unit}");
        for (slot, directions) in format.directions.slots().into_iter().enumerate() {
            let term = format!("term{slot}_{unit}");
            claim.cut(&format!("{term}_code")).seen_ports(&term, &["choice"]);
            claim.shown(format!("{term}_choice == {row}_choice{slot}"));
            for (i, j) in directions.iter().enumerate() {
                claim.seen_ports(&term, &[&format!("codes{i}")]);
                claim.shown(format!("{term}_codes{i} == b_code{q}_{j}"));
            }
            claim.seen_ports(&s, &[&format!("codes{slot}"), &format!("factors{slot}")]);
            claim.shown(format!("{s}_codes{slot} == {term}_code && {s}_factors{slot} == {row}_factor{slot}"));
        }
        claim.cut(&format!("{s}_s")).seen_ports(&s, &["rest", "ceiling"]);
        claim.shown(format!("{s}_rest == {row}_rest && {s}_ceiling == ceiling"));
        let (u, test) = (format!("u{unit}"), format!("apart{unit}"));
        claim.cut(&format!("{u}_aligned")).seen_ports(&u, &["x", "exponent"]);
        claim.shown(format!("{u}_x == {s}_s && {u}_exponent == b_exponent"));
        claim.seen_ports(&test, &["bound", "u"]).shown(format!("{test}_u == {u}_aligned"));
        let of_axis = |(i, entry): (usize, i8)| {
            let sign = if entry < 0 { "-" } else { "+" };
            (entry != 0).then(|| format!("(query_error_{} {sign} d_lane{i}_d)", axes[i]))
        };
        let terms = format.directions.vector(h).into_iter().enumerate().filter_map(of_axis);
        claim.shown(format!("{test}_bound == {}", terms.collect::<Vec<_>>().join(" + ")));
        for p in 0..2 {
            let v = format!("v{unit}_{p}");
            claim.cut(&format!("{v}_aligned")).seen_ports(&v, &["x", "exponent"]);
            claim.shown(format!("{v}_x == a_code{p}_{} && {v}_exponent == a_exponent", h ^ 1));
            claim.seen_ports(&test, &[&format!("v{p}")]).shown(format!("{test}_v{p} == {v}_aligned"));
            claim.seen_ports(&test, &[&format!("apart{p}")]);
            apart[2 * p + q].push(format!("{test}_apart{p} != 0"));
        }
    }
    for (pair, apart) in apart.into_iter().enumerate() {
        let (p, q) = (pair / 2, pair % 2);
        claim
            .shown(format!("survive{pair} == (a_take{p} != 0 && b_take{q} != 0 && !({}) ? 1 : 0)", apart.join(" || ")));
    }
    claim.room_for(4);
    claim.mutant(WrongSign, "axis_bound(i)(0)|bound(0)").mutant(Reversed, "axis_bound(i)(1)|bound(1)");
    if directions == Directions::Eighteen {
        claim.mutant(OtherElement, "term0_unit_codes(k)(0)");
    }
    claim.mutant(WrongGate, "survive(0)");
    claim
}
