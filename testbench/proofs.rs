//! Machine proofs on the generated VHDL, for all inputs: GHDL synthesizes the printed text, Yosys' SAT solver looks for
//! a counterexample. `docs/machine-proofs.md` says what is proved and what follows from it.
//!
//! Every claim is also tried on units with one mistake in their text, which it must refute. Without Yosys or GHDL the
//! tests say so on standard error and prove nothing. `EFSAT_PROOFS=full` (what `scripts/prove full` sets) takes greater
//! widths.

#[path = "proofs/claim.rs"]
mod claim;
#[path = "proofs/products.rs"]
mod products;
#[path = "proofs/rounding.rs"]
mod rounding;
#[path = "proofs/settings.rs"]
mod settings;
#[path = "proofs/sums.rs"]
mod sums;
#[path = "proofs/table.rs"]
mod table;
#[path = "proofs/tools.rs"]
mod tools;
#[path = "proofs/unit.rs"]
mod unit;

use claim::Claim;
use efsat::number::Upper;
use efsat::params::Params;
use rayon::prelude::*;
use settings::Setting;

/// Proves all claims; prints the table and fails if one is refuted or a mutant survives.
fn prove(title: &str, claims: Vec<Claim>) {
    let ghdl = match tools::ghdl() {
        Ok(ghdl) => ghdl,
        Err(missing) => return table::print(&format!("{title}: skipped: {missing}\n")),
    };
    let rows: Vec<claim::Row> = claims.par_iter().map(|claim| claim.run(ghdl)).collect();
    table::print(&table::text(title, &rows));
    let failures: Vec<String> = rows.iter().flat_map(table::failures).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn default_settings() -> Vec<Setting> {
    [Upper::Implied, Upper::Sticky]
        .map(|upper| Setting { params: Params { upper, ..Params::default() } })
        .into()
}

#[test]
fn sums_and_edges() {
    let settings = default_settings();
    let mut claims = sums::exact_sums(&settings[0]);
    claims.extend(settings.iter().flat_map(sums::edges));
    prove("Sums and edges", claims);
}

#[test]
fn roundings() {
    prove("Roundings", sums::roundings(37, 17));
}

#[test]
fn products() {
    let mut claims = products::by_definition((4, 4));
    claims.extend(products::by_definition((5, 5)));
    claims.push(products::order_of_corners((5, 5)));
    claims.push(products::in_tiles((19, 3)));
    claims.push(products::in_tiles((3, 19)));
    let settings = default_settings();
    for name in ["axis_multiply", "projection_multiply", "transform_multiply"] {
        claims.push(products::factors(&settings[0], name));
    }
    for name in ["axis_multiply", "projection_multiply"] {
        claims.push(products::multiplied(&settings[0], name));
    }
    prove("Products", claims);
}
