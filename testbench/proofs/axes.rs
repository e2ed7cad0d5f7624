//! Claims of the axis units: cross product and projection around their multipliers, and the comparator network.

use super::claim::{Claim, number};
use super::products::{given_sign_cases, sign_case};
use super::rounding::claim_rounded;
use super::settings::Setting;
use super::unit::Mistake::{NoUlp, NotStrict, OtherBound, WrongArm, WrongGate, WrongSlice};
use super::unit::Subject;
use efsat::design::comparator;
use efsat::design::cross_product::COORDINATES;
use efsat::design::interval::Rounding;
use efsat::params::{AxisKind, Formats, Params, Projections, Row};

/// The kinds of the eleven axes in the order in which they are tested.
const KINDS: [AxisKind; 5] =
    [AxisKind::NormalA, AxisKind::NormalB, AxisKind::Cross(0), AxisKind::Cross(1), AxisKind::Cross(2)];

/// Fraction bits of a kind's exact components.
fn exact_fraction(f: &Formats, kind: AxisKind) -> i32 {
    let [left, right] = match kind {
        AxisKind::NormalA => [&f.edge_a[0], &f.edge_a[2]],
        AxisKind::NormalB => [&f.edge_b, &f.edge_b],
        AxisKind::Cross(k) => [&f.edge_a[k], &f.edge_b],
        AxisKind::InPlaneA(_) | AxisKind::InPlaneB => unreachable!("not among the eleven"),
    };
    left.format.fraction + right.format.fraction
}

/// The roundings that a shared unit chooses among, numbered as they first occur.
fn ways<'a>(exact: impl Fn(AxisKind) -> i32, row: impl Fn(AxisKind) -> &'a Row) -> Vec<Rounding> {
    let mut ways = vec![];
    for kind in KINDS {
        let row = row(kind);
        let clamp = row.clamp.map(|c| (c.bound, c.lemma));
        let way = Rounding { drop: exact(kind) - row.format.fraction, clamp };
        if !ways.contains(&way) {
            ways.push(way);
        }
    }
    ways
}

/// Claims an output to be its exact interval rounded by the way that the port `rounding` chooses.
fn claim_chosen(claim: &mut Claim, out: &str, exact: &str, ways: &[Rounding], params: &Params) {
    for (number, way) in ways.iter().enumerate() {
        let when = if ways.len() == 1 { "1".to_owned() } else { format!("rounding == {number}") };
        claim_rounded(claim, &when, &format!("{out}_"), exact, *way, params.upper);
    }
}

/// Claims that the instance `label` of the multiplication multiplies the intervals `x` and `y`, knowing their sign
/// cases; its product is cut.
fn claim_operands(claim: &mut Claim, label: &str, x: &str, y: &str) {
    claim.cut(&[format!("{label}_lo"), format!("{label}_hi")]);
    claim.seen(&["x_lo", "x_hi", "y_lo", "y_hi"].map(|port| format!("{label}.{port}")));
    let same = |factor: &str, of: &str| format!("{label}_{factor}_lo == {of}_lo && {label}_{factor}_hi == {of}_hi");
    claim.shown(same("x", x)).shown(same("y", y));
    for (factor, of) in [("x", x), ("y", y)] {
        claim.seen(&[format!("{label}.{factor}_sign_case")]);
        claim.shown(format!("{label}_{factor}_sign_case == {}", sign_case(of)));
    }
}

/// `l = e x f` from any enclosures of its six products: the right operands are multiplied, and every component is
/// contained.
pub fn cross_product(setting: &Setting) -> Claim {
    let params = &setting.params;
    let f = params.formats();
    let ways = ways(|kind| exact_fraction(&f, kind), |kind| f.axis(kind));
    let subject = Subject::of_design(params, "cross_product");
    let mut claim = Claim::new(subject, setting.label(), "contains e x f, within an ulp; operands");
    for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
        let [i, j, k] = [i, j, k].map(|c: usize| COORDINATES[c]);
        let (plus, minus) = (format!("e_{j}_f_{k}"), format!("e_{k}_f_{j}"));
        claim_operands(&mut claim, &plus, &format!("e_{j}"), &format!("f_{k}"));
        claim_operands(&mut claim, &minus, &format!("e_{k}"), &format!("f_{j}"));
        let exact = format!("exact_{i}");
        claim.value(&format!("{exact}_lo"), format!("{plus}_lo - {minus}_hi"));
        claim.value(&format!("{exact}_hi"), format!("{plus}_hi - {minus}_lo"));
        if setting.small {
            let [p, m] = [&plus, &minus].map(|product| format!("true_{product}"));
            claim.within(&p, &plus).within(&m, &minus).value(&format!("{exact}_truth"), format!("{p} - {m}"));
        } else {
            let (lo, hi) = (format!("{exact}_lo"), format!("{exact}_hi"));
            claim.between(&format!("{exact}_truth"), &lo, &hi, 2 * params.width + 1);
        }
        claim_chosen(&mut claim, &format!("l_{i}"), &exact, &ways, params);
    }
    let way = |i: usize| if ways.len() == 1 { String::new() } else { format!("_way_{i}") };
    // Of the upper bound: where a register lies on the way of the lower one alone, the upper one has no copy to take.
    claim
        .mutant(NoUlp, format!("l_x_rounded{}_up", way(0)))
        .mutant(OtherBound, format!("l_z_rounded{}_floor_hi", way(0)));
    claim.mutant(WrongSlice, format!("l_y_rounded{}_floor_lo", way(0)));
    if ways.len() > 1 {
        claim.mutant(WrongArm, "l_z_rounded_chosen_lo").mutant(NoUlp, "l_y_rounded_way_1_up");
    }
    claim
}

/// `p = v * l` from any enclosures of its three products.
pub fn projection(setting: &Setting) -> Claim {
    let params = &setting.params;
    let f = params.formats();
    let grid = f.coordinate_a.format.fraction;
    let ways = ways(|kind| grid + f.axis(kind).format.fraction, |kind| f.projection(kind));
    let subject = Subject::of_design(params, "projection");
    let mut claim = Claim::new(subject, setting.label(), "contains v * l, within an ulp; operands");
    let products = COORDINATES.map(|c| format!("v_{c}_l_{c}"));
    for (product, c) in products.iter().zip(COORDINATES) {
        let (v, l) = (format!("v_{c}"), format!("l_{c}"));
        given_sign_cases(&mut claim, &[&v, &l]);
        claim_operands(&mut claim, product, &v, &l);
    }
    let sum = |end: &str| products.each_ref().map(|product| format!("{product}_{end}")).join(" + ");
    claim.value("exact_lo", sum("lo")).value("exact_hi", sum("hi"));
    if setting.small {
        for product in &products {
            claim.within(&format!("true_{product}"), product);
        }
        claim.value("exact_truth", products.each_ref().map(|product| format!("true_{product}")).join(" + "));
    } else {
        claim.between("exact_truth", "exact_lo", "exact_hi", 2 * params.width + 2);
    }
    claim_chosen(&mut claim, "p", "exact", &ways, params);
    let way = if ways.len() == 1 { "" } else { "_way_0" };
    claim.mutant(NoUlp, format!("p_rounded{way}_up")).mutant(OtherBound, format!("p_rounded{way}_floor_lo"));
    claim.mutant(WrongSlice, format!("p_rounded{way}_floor_lo"));
    claim
}

/// `x < y` as the units compare. That it is the same is claimed too, of any two projections.
fn below(x: &str, y: &str) -> String {
    format!("({x} - {y} < {})", number(0))
}

/// The least of some expressions.
fn least(values: &[String]) -> String {
    let (first, rest) = values.split_first().expect("at least one");
    rest.iter().fold(first.clone(), |found, value| format!("({} ? {found} : {value})", below(&found, value)))
}

/// The greatest of some expressions.
fn greatest(values: &[String]) -> String {
    let (first, rest) = values.split_first().expect("at least one");
    rest.iter().fold(first.clone(), |found, value| format!("({} ? {value} : {found})", below(&found, value)))
}

/// The flags of a design's comparator network are as defined by the bounds.
pub fn comparator(params: &Params) -> Claim {
    let label = Setting::full(params.clone()).label();
    flags(Subject::of_design(params, "comparator_network"), params.projections, &label, false)
}

/// The same at few bits, and what the flags say holds for every choice of true projections.
pub fn sound_comparator(bits: u32, policy: Projections) -> Claim {
    let points = if policy == Projections::Skip { 4 } else { 6 };
    let unit = comparator::unit(bits, (1 << (bits - 1)) - 1, points, policy);
    flags(Subject::of_unit(&unit), policy, &format!("{bits} bits"), true)
}

fn flags(subject: Subject, policy: Projections, widths: &str, sound: bool) -> Claim {
    let points = subject.inputs.iter().filter(|w| w.path.ends_with("_lo")).count();
    let widths = format!("{widths}, projections {}", format!("{policy:?}").to_lowercase());
    let property = if sound { "flags as defined, sound" } else { "flags as defined" };
    let mut claim = Claim::new(subject, widths, property);
    claim.compares_only();
    // What belongs to a triangle at its place i, counted from the first for A and from the last for B.
    let own = |triangle: &str, i: usize, value: &dyn Fn(usize) -> String| {
        let port = |i: usize| if triangle == "a" { i } else { points - 1 - i };
        match policy {
            Projections::Skip if i > 0 => {
                format!("(raw_{triangle}_has_{} ? {} : {})", port(i), value(port(i)), value(port(0)))
            }
            _ => value(port(i)),
        }
    };
    // Places that the code of duplicates makes equal; B's are counted from the last, so its edges run backwards.
    let groups = |triangle: &str| match triangle {
        "a" => [(1, vec![0, 1]), (2, vec![1, 2]), (3, vec![2, 0]), (4, vec![0, 1, 2])],
        _ => [(1, vec![2, 1]), (2, vec![1, 0]), (3, vec![0, 2]), (4, vec![0, 1, 2])],
    };
    for triangle in ["a", "b"] {
        for (end, tightest) in [("lo", greatest as fn(&[String]) -> String), ("hi", least)] {
            let bound = |i: usize| own(triangle, i, &|port| format!("p{port}_{end}"));
            let joint = |i: usize| {
                let mut value = bound(i);
                if policy == Projections::Intersect {
                    for (code, group) in groups(triangle).into_iter().filter(|(_, group)| group.contains(&i)) {
                        let all: Vec<String> = group.into_iter().map(bound).collect();
                        value = format!("(duplicates_{triangle} == {code} ? {} : {value})", tightest(&all));
                    }
                }
                value
            };
            let all = [0, 1, 2].map(|i| {
                let name = format!("{triangle}_{i}_{end}");
                claim.value(&name, joint(i));
                name
            });
            claim.value(&format!("{triangle}_min_{end}"), least(&all));
            claim.value(&format!("{triangle}_max_{end}"), greatest(&all));
        }
    }
    claim.shown(format!("{} == (p0_lo < p1_hi)", below("p0_lo", "p1_hi")));
    let both = |x: (&str, &str), sign: &str, y: (&str, &str)| format!("{} {sign} {}", below(x.0, x.1), below(y.0, y.1));
    let separated = both(("a_max_hi", "b_min_lo"), "||", ("b_max_hi", "a_min_lo"));
    let overlapping = both(("a_min_hi", "b_max_lo"), "&&", ("b_min_hi", "a_max_lo"));
    claim.shown(format!("separated == ({separated})")).shown(format!("overlapping == ({overlapping})"));
    if sound {
        for i in 0..points {
            claim.within(&format!("t{i}"), &format!("p{i}"));
        }
        for triangle in ["a", "b"] {
            let all = [0, 1, 2].map(|i| own(triangle, i, &|port| format!("t{port}")));
            claim.value(&format!("{triangle}_min"), least(&all));
            claim.value(&format!("{triangle}_max"), greatest(&all));
            if policy == Projections::Intersect {
                for (code, group) in groups(triangle) {
                    let same = group.windows(2).map(|pair| format!("{} == {}", all[pair[0]], all[pair[1]]));
                    let same = same.collect::<Vec<_>>().join(" && ");
                    claim.given(format!("duplicates_{triangle} != {code} || ({same})"));
                }
            }
        }
        claim.shown("!separated || a_max < b_min || b_max < a_min");
        claim.shown("!overlapping || (a_min < b_max && b_min < a_max)");
    }
    for relation in ["a_below_b", "a_reaches_b", "b_reaches_a"] {
        claim.mutant(NotStrict, format!("{relation}_difference"));
    }
    claim.mutant(WrongArm, "a_max_hi").mutant(WrongGate, "is_overlapping");
    claim
}
