//! The checks themselves are checked: a slice of what `efsat mutate` does in full.

use crate::extent::{full, share};
use crate::tools::ghdl;
use efsat::artefact::Stimulus;
use efsat::evidence::cosim::{Bench, Simulator, Trial};
use efsat::evidence::mutation::campaign::{self, Campaign, Options};
use efsat::evidence::mutation::score::{Entry, Standing};
use efsat::evidence::mutation::{Fate, Kind, Mutant, explained, spread};
use efsat::params::{Axes, Method, Params, Projections, Transform, Upper};
use rayon::prelude::*;
use std::collections::HashSet;

/// A small design, quick to simulate, with every unit of the default one.
fn small() -> Params {
    Params { width: 8, transform_width: 10, frequency: 40, ..Params::default() }
}

#[test]
fn every_mutant_of_the_default_design_changes_its_file_and_has_a_name_of_its_own() {
    let params = Params::default();
    let all = campaign::mutants(&params).unwrap();
    let design = efsat::design::Design::new(&params, false).unwrap();
    let files = efsat::artefact::vhdl_files(&design, &Default::default(), &params.command_line()).unwrap();
    let names: HashSet<String> = all.iter().map(Mutant::name).collect();
    assert!(all.len() > 2000 && names.len() == all.len(), "{} names of {} mutants", names.len(), all.len());
    for (name, text) in &files {
        let mutants: Vec<&Mutant> = all.iter().filter(|mutant| format!("{}.vhd", mutant.unit) == *name).collect();
        assert!(mutants.len() >= 3, "{name} has {} mutants", mutants.len());
        let mut seen: HashSet<String> = HashSet::from([text.clone()]);
        let idle: Vec<String> = mutants.iter().filter(|m| !seen.insert(m.apply(text))).map(|m| m.name()).collect();
        assert!(idle.is_empty(), "{name}: a mutant twice, or no change: {idle:?}");
    }
    for kind in Kind::ALL {
        let units: HashSet<&str> = all.iter().filter(|m| m.kind == kind).map(|m| m.unit.as_str()).collect();
        assert!(units.len() >= 3, "{kind} in {units:?}");
    }
}

#[test]
fn sticky_bits_yield_mutants_of_rounding_too() {
    let all = campaign::mutants(&Params { upper: Upper::Sticky, ..Params::default() }).unwrap();
    for change in ["sticky bit dropped", "sticky bit forced", "ulp dropped"] {
        let found = all.iter().filter(|m| m.kind == Kind::Rounding && m.change.starts_with(change)).count();
        assert!(found > 5, "{found} times {change}");
    }
}

#[test]
fn unchanged_and_equivalent_text_is_not_killed_and_wrong_text_is() {
    if ghdl().is_none() {
        return;
    }
    let params = Params { projections: Projections::All, ..small() };
    let bench = Bench::new(&params, Stimulus::random(&params, 12, 1), Simulator::Ghdl, false).unwrap();
    let try_line = |file: &str, from: &str, to: &str| {
        let (name, text) = bench.files().iter().find(|(name, _)| name == file).unwrap();
        assert!(text.contains(from), "{text}");
        bench.run(name, &text.replace(from, to)).unwrap()
    };
    let multiply = |from: &str, to: &str| try_line("interval_multiply.vhd", from, to);
    assert_eq!(multiply("architecture", "architecture"), Trial::Agrees);
    let either = ["not (not_all_above and not_all_below);", "not not_all_above or not not_all_below;"];
    assert_eq!(try_line("comparator_network.vhd", either[0], either[1]), Trial::Agrees);
    assert!(matches!(multiply("y.hi, y.lo)", "y.lo, y.hi)"), Trial::Answer(_)));
    assert!(matches!(multiply("end architecture rtl;", "end architecture;;"), Trial::Invalid(_)));
    // Another type, and another length, which only elaboration tells.
    assert!(matches!(multiply("<= x_case & y_case;", "<= y;"), Trial::Invalid(_)));
    assert!(matches!(multiply("<= x_case & y_case;", "<= x_case;"), Trial::Invalid(_)));
    // A unit that never offers an answer is silent.
    let closed = try_line("sequencer.vhd", "out_valid <= offered;", "out_valid <= '0';");
    assert!(matches!(closed, Trial::Silent(_)));
}

/// What an explanation of the table of equivalent mutants relies on.
#[test]
fn no_bound_that_may_be_clamped_is_the_greatest_number_of_its_format() {
    // The rows for which a bound on the true value is known.
    let clamped = ["edge", "axis_n_"];
    let mut wrong = vec![];
    for width in 6..=32 {
        for transform_width in [width, width + 1, 40, 48].map(|t| t.max(width)) {
            for transform in [Transform::On, Transform::Translate, Transform::Off] {
                for (renormalise, upper) in
                    [(true, Upper::Implied), (true, Upper::Sticky), (false, Upper::Implied), (false, Upper::Sticky)]
                {
                    let p = Params {
                        width,
                        transform_width,
                        transform,
                        renormalise,
                        upper,
                        axes: Axes::Seventeen,
                        ..Params::paper()
                    };
                    let rows = p.formats();
                    let equal = rows.rows().filter(|r| {
                        clamped.iter().any(|name| r.name.starts_with(name))
                            && r.clamp.is_none()
                            && r.bound == r.format.max()
                    });
                    wrong.extend(equal.map(|r| format!("{} of {p:?}", r.name)));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}: {}", wrong.len(), wrong[0]);
}

/// Everything that is neither killed nor explained, in words.
fn holes(entries: Vec<Entry>) -> Vec<String> {
    let fine = |entry: &Entry| matches!(entry.standing(), Standing::Killed | Standing::Equivalent | Standing::Hidden);
    entries
        .into_iter()
        .filter(|entry| !fine(entry))
        .map(|entry| format!("{} {:?}", entry.mutant.name(), entry.fate))
        .collect()
}

/// A statement that the design with probes has in another form: its mutant has to survive as many pairs without probes.
#[test]
#[ignore = "a mutant of a whole exact unit: scripts/test full"]
fn mutants_of_what_has_another_form_with_probes_meet_all_pairs() {
    if ghdl().is_none() {
        return;
    }
    let params = Params::of(Method::Exact);
    let name = "pair_determinants:of_sign_unit_a:operand:determinant_plane_a1 -> determinant_plane_a0";
    let mutant = campaign::mutants(&params).unwrap().into_iter().find(|mutant| mutant.name() == name).unwrap();
    let fate = |vectors| {
        let options = Options { simulator: Simulator::Ghdl, vectors, seed: 1 };
        Campaign::new(&params, &options).unwrap().fate(&mutant).unwrap()
    };
    // Sixteen pairs do not show it.
    assert!(!full() || matches!(fate(0), Fate::Survived));
    assert!(matches!(fate(96), Fate::Killed(_)));
}

#[test]
fn co_simulation_kills_mutants_of_every_kind() {
    if ghdl().is_none() {
        return;
    }
    let params = small();
    let all = campaign::mutants(&params).unwrap();
    let each = if full() { 2 } else { 1 };
    let of_kind = |kind: Kind| spread(all.iter().filter(|m| m.kind == kind).cloned().collect(), each);
    let slice: Vec<Mutant> = share(2, Kind::ALL).into_iter().flat_map(of_kind).collect();
    assert_eq!(slice.len(), if full() { 7 * 2 } else { 4 });
    let campaign =
        Campaign::new(&params, &Options { simulator: Simulator::Ghdl, vectors: if full() { 64 } else { 32 }, seed: 1 })
            .unwrap();
    let run = |mutant: Mutant| {
        let fate = campaign.fate(&mutant).unwrap();
        Entry::new(mutant, fate, &explained::vhdl(&params))
    };
    assert_eq!(holes(slice.into_par_iter().map(run).collect()), Vec::<String>::new());
}
