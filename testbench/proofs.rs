//! Machine proofs on the generated VHDL, for all inputs: GHDL synthesizes the printed text, Yosys' SAT solver looks for
//! a counterexample. `docs/machine-proofs.md` says what is proved and what follows from it.
//!
//! Every claim is also tried on units with one mistake in their text, which it must refute. Without Yosys or GHDL the
//! tests say so on standard error and prove nothing. If everything is asked for, greater widths and both rules for upper
//! bounds are proved.

mod axes;
mod before_axes;
mod certificate;
mod claim;
mod determinants;
mod exact;
mod handshakes;
mod invariant;
mod pair;
mod products;
mod queues;
mod rounding;
mod settings;
mod sums;
mod table;
mod tools;
mod unit;
mod volume;

use crate::extent::{full, share};
use claim::Claim;
use efsat::params::{Bound, Method, Params, Projections, Transform, Upper};
use rayon::prelude::*;
use settings::Setting;

/// Proves all claims; prints the table and fails if one is refuted or a mutant survives.
fn prove(title: &str, claims: Vec<Claim>) {
    if !tools::there() {
        return;
    }
    report(title, &claims.par_iter().map(|claim| claim.run()).collect::<Vec<_>>());
}

/// Prints a table, and fails if a row is not as it should be.
fn report(title: &str, rows: &[claim::Row]) {
    table::print(&table::text(title, rows));
    let failures: Vec<String> = rows.iter().flat_map(table::failures).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The queue of answers of several units, one of them the first stage of a cascade with the places that it really has; and the
/// second stage of a cascade with few places: both stages take a pair every 11 clocks.
#[test]
fn queues() {
    let title = "Queues";
    if !tools::there() {
        return;
    }
    let params = Params {
        width: 8,
        transform_width: 8,
        frequency: 20,
        clocks_per_pair: 11,
        exact_clocks: Some(11),
        ..Params::of(Method::Exact)
    };
    let wide = Params { width: 32, exact_clocks: Some(16), ..Params::of(Method::Exact) };
    let designs = [Params::default(), Params::of(Method::Determinants), params.clone(), wide];
    let mut rows: Vec<_> = designs.iter().map(|params| queues::answers(params).run()).collect();
    rows.push(queues::Cascade::new(&params).second_stage().run());
    report(title, &rows);
}

/// What is offered stays until it is taken: by the registers, the stream wrapper and the engine's read master.
#[test]
fn handshakes() {
    if !tools::there() {
        return;
    }
    let claims =
        [handshakes::registers(false), handshakes::registers(true), handshakes::wrapper(), handshakes::read_master()];
    report("Handshakes", &claims.par_iter().map(invariant::Invariant::run).collect::<Vec<_>>());
}

/// The rules for upper bounds, the other options as given.
fn rules(others: &Params) -> Vec<Params> {
    share(2, [Upper::Implied, Upper::Sticky].map(|upper| Params { upper, ..others.clone() }))
}

#[test]
fn sums_and_edges() {
    // The products of 6-bit factors, and those of the design's 18 bits.
    let mut claims = sums::exact_sums(12, true);
    claims.extend(sums::exact_sums(36, false));
    for params in rules(&Params::default()) {
        claims.extend(sums::edges(&Setting::small(params.clone())));
        claims.extend(sums::edges(&Setting::full(params)));
    }
    prove("Sums and edges", claims);
}

#[test]
fn roundings() {
    prove("Roundings", sums::roundings(37, 17));
}

#[test]
fn products() {
    let small: &[(u32, u32)] = if full() { &[(4, 4), (3, 6), (5, 5)] } else { &[(4, 4)] };
    let mut claims: Vec<Claim> = small.iter().flat_map(|bits| products::by_definition(*bits)).collect();
    claims.extend(small.iter().map(|bits| products::order_of_corners(*bits)));
    let wide: &[(u32, u32)] = if full() { &[(19, 2), (2, 19), (19, 4), (36, 2)] } else { &[(19, 2), (2, 19)] };
    claims.extend(wide.iter().map(|bits| products::in_parts(*bits)));
    let setting = Setting::full(Params::default());
    claims.extend([products::sign_cases(&setting), products::factors(&setting), products::multiplied(&setting)]);
    claims.push(products::one_above(if full() { 6 } else { 4 }));
    prove("Products", claims);
}

#[test]
fn cross_products_and_projections() {
    let mut settings: Vec<Setting> = rules(&Params::paper()).into_iter().map(Setting::full).collect();
    settings.push(Setting::full(Params::default()));
    let both = |setting| [axes::cross_product(setting), axes::projection(setting)];
    let mut claims: Vec<Claim> = settings.iter().flat_map(both).collect();
    if full() {
        // Not the projection: no solver ended with three products that are anywhere in their enclosures.
        claims.push(axes::cross_product(&Setting::small(Params::paper())));
    }
    for params in rules(&Params::default()) {
        claims.push(axes::axis_shift(&Setting::full(params)));
    }
    claims.push(axes::edge_test(&Setting::full(Params::default())));
    prove("Cross products and projections", claims);
}

#[test]
fn comparators() {
    let of_design = |projections| axes::comparator(&Params { projections, ..Params::default() });
    let policies = [Projections::All, Projections::Skip, Projections::Intersect];
    let bits = if full() { 5 } else { 3 };
    let mut claims: Vec<Claim> = policies.map(|policy| axes::sound_comparator(bits, policy)).into();
    claims.extend([Projections::All, Projections::Skip].map(of_design));
    if full() {
        claims.push(of_design(Projections::Intersect));
    }
    prove("Comparators", claims);
}

#[test]
#[ignore = "proofs of ten seconds; others are made on every change: scripts/test full"]
fn transform_and_renormalisation() {
    let mut claims = vec![];
    for params in rules(&Params::default()) {
        let setting = Setting::full(params.clone());
        claims.extend(share(2, ["lo", "hi"]).iter().map(|end| before_axes::transform_end(&setting, end)));
        claims.push(before_axes::transform_row(&setting));
        claims.push(before_axes::scale(&setting));
        let translate = Setting::full(Params { transform: Transform::Translate, ..params.clone() });
        claims.push(before_axes::translated_row(&translate));
        let bare = Setting::full(Params { transform: Transform::Off, renormalise: false, ..params.clone() });
        claims.push(before_axes::guard(
            &translate,
            "translate",
            "guard_coordinate",
            translate.params.coordinate_bound(),
        ));
        claims.push(before_axes::guard(
            &translate,
            "translate",
            "guard_translation",
            translate.params.translation_bound(),
        ));
        claims.push(before_axes::guard(&bare, "no transform", "guard_coordinate", bare.params.coordinate_bound()));
        claims.push(before_axes::rounded_coordinates(&Setting::full(Params { renormalise: false, ..params })));
    }
    let setting = Setting::full(Params::default());
    claims.push(before_axes::offset(&setting));
    claims.push(before_axes::shift(&setting));
    prove("Transform and re-normalisation", claims);
}

#[test]
fn determinants() {
    use determinants::*;
    let params = Params { method: Method::Determinants, ..Params::default() };
    let products = Setting::full(Params { bound: Bound::Products, ..params.clone() });
    let setting = Setting::full(params);
    let claims = [
        certain_sign,
        determinant_sums,
        edge_verdict,
        pair_verdict,
        boxes_axis,
        boxes_axis_of_the_truth,
        coordinate_shift,
        coordinate_scale,
        coordinate_carry,
        coordinate_round,
        moment_component,
        moment_round,
        dot_product,
        bound_tails,
        difference_row,
    ];
    let mut claims: Vec<Claim> = claims.iter().map(|claim| claim(&setting)).collect();
    claims.extend(["vector_norm", "moment_norm"].map(|entity| norm(&setting, entity)));
    claims.extend(["length_first_order", "moment_first_order"].map(|entity| first_order(&setting, entity)));
    claims.push(short_products(&products));
    prove("Determinants", claims);
}

#[test]
fn pairs_by_determinants() {
    let params = |transform| Params { method: Method::Determinants, transform, ..Params::default() };
    let settings =
        share(3, [Transform::Off, Transform::Translate, Transform::On].map(params)).into_iter().map(Setting::full);
    let mut claims: Vec<Claim> = settings.map(|setting| pair::differences(&setting)).collect();
    if full() {
        let setting = Setting::full(params(Transform::On));
        claims.extend([pair::norms(&setting), pair::verdicts(&setting)]);
    }
    prove("Pairs by determinants", claims);
}

#[test]
fn exact() {
    use exact::*;
    let setting = Setting::full(Params { method: Method::Exact, transform: Transform::Off, ..Params::default() });
    let claims = [
        difference_fit,
        cross_component,
        dot_product,
        determinants::determinant_sums,
        exact_sign,
        box_axis,
        left_out_coordinate,
        plane_coordinates,
        first_point,
        plane_sums,
        plane_edge,
        plane_verdict,
        edge_verdict,
        inner_side,
        pair_verdict,
    ];
    prove("Exact", claims.iter().map(|claim| claim(&setting)).collect());
}

#[test]
fn exact_pairs() {
    use exact::*;
    let params = |transform| Params { method: Method::Exact, transform, ..Params::default() };
    let setting = Setting::full(params(Transform::Off));
    let mut claims = vec![
        operands(&setting),
        in_plane_operands(&setting),
        by_signs(&setting),
        in_plane_edges(&setting),
        in_plane(&setting),
    ];
    claims.extend([Transform::Off, Transform::Translate].map(|transform| fits(&Setting::full(params(transform)))));
    prove("Exact pairs", share(5, claims));
}

#[test]
fn volumes() {
    use volume::*;
    let claims = [origin_row, select_code, row_sum, align_sum, align_code, direction_test, no_point_in_both];
    prove("Volumes", claims.into_iter().map(|claim| claim()).collect());
}

/// The certificate of a claim is accepted, by the checker and by Coq's kernel. One with a step less is not, nor is it one of a
/// wrong text, where the solver finds what is wrong.
#[test]
fn certificates() {
    let (true, Some(tools)) = (tools::there(), certificate::Tools::new()) else { return };
    let bits = if full() { 4 } else { 3 };
    let [right, wrong] = sums::exact_sums(bits, true)[0].answers().map(|answer| answer.formula.expect("a formula"));
    let found = tools.certify(&right).unwrap().expect("a certificate in time");
    table::print(&format!("\nCertificate of a sum of {bits} bits: {found}\n"));
    let (formula, [proof, hints]) = (right.path(), right.certificates());
    let [of_wrong, with_hints] = wrong.certificates();
    let wrong_formula = wrong.path();
    assert_eq!(tools.decide(&wrong_formula, &of_wrong), Err("there is a solution".to_owned()));
    tools.check(&wrong_formula, &proof, &with_hints).unwrap_err();
    let read = |path| std::fs::read_to_string(path).unwrap();
    let (formula_text, steps) = (read(&formula), read(&hints));
    // Without the first step that adds a clause.
    let first = steps.lines().find(|line| !line.contains(" d ")).expect("a step");
    let fewer = crate::tools::replaced(&steps, &format!("{first}\n"), "");
    let theorems = [(&formula_text, &steps), (&formula_text, &fewer), (&read(&wrong_formula), &steps)];
    if let Some(accepted) =
        crate::theorems::certified(&theorems.map(|(formula, steps)| certificate::theorem(formula, steps)))
    {
        assert_eq!(accepted, [true, false, false]);
    }
    std::fs::write(&proof, "0\n").unwrap();
    tools.check(&formula, &proof, &hints).unwrap_err();
}
