//! Claims of the axis units: cross product and projection around their multipliers, and the comparator network.

use super::claim::{Claim, number};
use super::rounding::claim_rounded;
use super::settings::Setting;
use super::sums::interval;
use super::unit::Mistake::{
    NoUlp, NotMissing, NotStrict, OtherBound, WrongArm, WrongComponent, WrongGate, WrongLastGate, WrongSign, WrongSlice,
};
use super::unit::Subject;
use efsat::design::comparator::{DUPLICATES, Owners, comparator as network};
use efsat::design::rounding::Rounding;
use efsat::graph::{Library, Signals};
use efsat::number::Upper;
use efsat::op::Type;
use efsat::params::{AxisKind, FormatRow, Formats, Params, Projections};

/// The names of the coordinates.
pub const COORDINATES: [&str; 3] = ["x", "y", "z"];

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
fn ways<'a>(exact: impl Fn(AxisKind) -> i32, row: impl Fn(AxisKind) -> &'a FormatRow) -> Vec<Rounding> {
    let mut ways = vec![];
    for kind in KINDS {
        let way = Rounding::to_row(exact(kind), row(kind));
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
        claim_rounded(claim, &when, out, exact, *way, params.upper);
    }
}

/// Claims that an instance multiplies the intervals `x` and `y`, given with their sign cases; its product is cut.
fn claim_operands(claim: &mut Claim, instance: &str, x: [&str; 2], y: [&str; 2]) {
    claim.cut(&format!("{instance}_p_lo")).cut(&format!("{instance}_p_hi"));
    claim.seen_ports(instance, &["x_lo", "x_hi", "x_case", "y_lo", "y_hi", "y_case"]);
    for (factor, [of, c]) in [("x", x), ("y", y)] {
        let port = format!("{instance}_{factor}");
        claim.shown(format!("{port}_lo == {of}_{c}_lo && {port}_hi == {of}_{c}_hi"));
        claim.shown(format!("{port}_case == {of}_{c}_case"));
    }
}

/// `l = e x f` from any enclosures of its six products: the right operands are multiplied, and every component is
/// contained.
pub fn cross_product(setting: &Setting) -> Claim {
    let params = &setting.params;
    let f = params.formats();
    let ways = ways(|kind| exact_fraction(&f, kind), |kind| f.axis(kind));
    let subject = Subject::of_design(setting, "cross_product");
    let mut claim = Claim::new(subject, setting.label(), "contains e x f, within an ulp; operands");
    for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
        let [i, j, k] = [i, j, k].map(|c: usize| COORDINATES[c]);
        let (plus, minus) = (format!("e_j_f_k_{i}"), format!("e_k_f_j_{i}"));
        claim_operands(&mut claim, &plus, ["e", j], ["f", k]);
        claim_operands(&mut claim, &minus, ["e", k], ["f", j]);
        let exact = format!("exact_{i}");
        claim.value(&format!("{exact}_lo"), format!("{plus}_p_lo - {minus}_p_hi"));
        claim.value(&format!("{exact}_hi"), format!("{plus}_p_hi - {minus}_p_lo"));
        if setting.small {
            let [p, m] = [&plus, &minus].map(|product| format!("true_{product}"));
            claim.within(&p, &format!("{plus}_p")).within(&m, &format!("{minus}_p"));
            claim.value(&format!("{exact}_truth"), format!("{p} - {m}"));
        } else {
            let (lo, hi) = (format!("{exact}_lo"), format!("{exact}_hi"));
            claim.between(&format!("{exact}_truth"), &lo, &hi, 2 * params.width + 1);
        }
        if params.axis_shift > 0 {
            claim.shown(format!("l_{i}_lo == {exact}_lo && l_{i}_hi == {exact}_hi"));
        } else {
            claim_chosen(&mut claim, &format!("l_{i}"), &exact, &ways, params);
        }
    }
    if params.axis_shift > 0 {
        claim.mutant(OtherBound, "l(i).lo").mutant(WrongSign, "l(i).hi").mutant(WrongComponent, "e_j_f_k_unit");
        return claim;
    }
    claim.mutant(NoUlp, "l_hi_up(i)|l_hi_up_d1(i)|l_hi_up_up_d1(i)|l(i).hi").mutant(OtherBound, "exact(i).lo");
    claim
        .mutant(WrongSlice, "l_lo_floor_17_d1(i)|l_lo_floor_5_d1(i)|l_lo_floor_4_d1(i)|l(i).lo")
        .mutant(WrongComponent, "e_j_f_k_unit");
    if ways.len() > 1 {
        claim.mutant(WrongArm, "l(i).lo").mutant(WrongArm, "l_saturated(i).hi");
    }
    claim
}

/// The shift is the greatest that the six bounds allow once they are rounded, the same for all; behind it every component is
/// contained, and in its format.
pub fn axis_shift(setting: &Setting) -> Claim {
    let (p, n) = (&setting.params, setting.params.width);
    let mut claim =
        Claim::new(Subject::of_design(setting, "axis_shift"), setting.label(), "shift as defined; contains l");
    let up = |x: &str| match p.upper {
        Upper::Implied => format!("(({x} >>> {n}) + 1)"),
        Upper::Sticky => format!("-((-{x}) >>> {n})"),
    };
    let mut bounds = vec![];
    for c in COORDINATES {
        let (lo, hi) = (format!("exact_{c}_lo"), format!("exact_{c}_hi"));
        claim.value(&format!("rounded_{c}_lo"), format!("{lo} >>> {n}")).value(&format!("rounded_{c}_hi"), up(&hi));
        bounds.extend(["lo", "hi"].map(|end| format!("rounded_{c}_{end}")));
        claim.between(&format!("truth_{c}"), &lo, &hi, 2 * n + 1);
    }
    let most = number((1 << (n - 1)) - 1);
    let inside = |s: u32| {
        let all = bounds.iter().map(|x| format!("({x} <<< {s}) <= {most} && -{most} <= ({x} <<< {s})"));
        all.collect::<Vec<_>>().join(" && ")
    };
    let left = (1..=p.axis_positions()).fold("0".to_owned(), |less, s| format!("(({}) ? {s} : {less})", inside(s)));
    claim.value("left", left);
    for c in COORDINATES {
        let shifted = |end: &str| format!("(exact_{c}_{end} <<< left)");
        claim.value(&format!("shifted_{c}_lo"), shifted("lo")).value(&format!("shifted_{c}_hi"), shifted("hi"));
        claim.shown(format!("l_{c}_lo == (shifted_{c}_lo >>> {n})"));
        claim.shown(format!("l_{c}_hi == {}", up(&format!("shifted_{c}_hi"))));
        let truth = format!("(truth_{c} <<< left)");
        claim.shown(format!("(l_{c}_lo <<< {n}) <= {truth} && {truth} <= (l_{c}_hi <<< {n})"));
        claim.shown(format!("-{most} <= l_{c}_lo && l_{c}_hi <= {most}"));
    }
    claim
        .mutant(NoUlp, "l_hi_sum(i)|l_hi(i)|l(i).hi")
        .mutant(NoUlp, "rounded(i).hi")
        .mutant(NotMissing, "zero2|zero(2)");
    claim.mutant(WrongArm, "shifted1(i).lo").mutant(WrongSlice, "kept(i).lo").mutant(OtherBound, "kept(i).hi");
    claim
}

/// An edge passes through a triangle by the definition, from any flags.
pub fn edge_test(setting: &Setting) -> Claim {
    let mut claim = Claim::new(Subject::of_design(setting, "edge_test"), setting.label(), "as defined");
    let passes = |ends: &str, k: usize, edge: &dyn Fn(&str, usize) -> String| {
        let next = (k + 1) % 3;
        let end = |way: &str, i: usize| format!("raw_{ends}_{way}{i}");
        let all = |way: &str| (0..3).map(|i| edge(way, i)).collect::<Vec<_>>().join(" && ");
        let crosses = |p: &str, q: &str| format!("{} && {}", end(p, k), end(q, next));
        let (up, down) = (crosses("below", "above"), crosses("above", "below"));
        format!("(({up} || {down}) && (({}) || ({})))", all("above"), all("below"))
    };
    let of_a = (0..3).map(|k| passes("v", k, &|way, l| format!("raw_edges_{way}{k}_{l}")));
    let of_b = (0..3).map(|l| passes("w", l, &|way, k| format!("raw_edges_{way}{k}_{l}")));
    let any: Vec<String> = of_a.chain(of_b).collect();
    claim.shown(format!("raw_pierced == ({})", any.join(" || ")));
    claim.mutant(WrongGate, "a_passes(k)").mutant(WrongLastGate, "b_passes(k)");
    claim
}

/// `p = v * l` from any enclosures of its three products.
pub fn projection(setting: &Setting) -> Claim {
    let params = &setting.params;
    let f = params.formats();
    let grid = f.coordinate_a.format.fraction;
    let ways = ways(|kind| grid + f.axis(kind).format.fraction, |kind| f.projection(kind));
    let subject = Subject::of_design(setting, "projection");
    let mut claim = Claim::new(subject, setting.label(), "contains v * l, within an ulp; operands");
    let products = COORDINATES.map(|c| format!("term_{c}"));
    for (product, c) in products.iter().zip(COORDINATES) {
        claim_operands(&mut claim, product, ["v", c], ["l", c]);
    }
    let sum = |end: &str| products.each_ref().map(|product| format!("{product}_p_{end}")).join(" + ");
    claim.value("exact_lo", sum("lo")).value("exact_hi", sum("hi"));
    if setting.small {
        for product in &products {
            claim.within(&format!("true_{product}"), &format!("{product}_p"));
        }
        claim.value("exact_truth", products.each_ref().map(|product| format!("true_{product}")).join(" + "));
    } else {
        claim.between("exact_truth", "exact_lo", "exact_hi", 2 * params.width + 2);
    }
    if params.projection_upper().is_none() {
        // Comparisons of such bounds are those of the exact ones, but for what is too near to tell.
        let [way] = ways[..] else { panic!("expected one way of rounding, found {ways:?}") };
        let rounded = |end: &str| format!("p_{end} == (exact_{end} >>> {})", way.drop);
        claim.shown(format!("{} && {}", rounded("lo"), rounded("hi")));
        claim.mutant(OtherBound, "exact.lo").mutant(WrongSlice, "p.lo").mutant(WrongComponent, "term_unit");
        return claim;
    }
    claim_chosen(&mut claim, "p", "exact", &ways, params);
    claim.mutant(NoUlp, "p.hi|p_hi_up").mutant(OtherBound, "exact.lo");
    claim.mutant(WrongSlice, "p.lo|p_lo_floor_17_d1").mutant(WrongComponent, "term_unit");
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
    let setting = Setting::full(params.clone());
    flags(Subject::of_design(&setting, "comparator_network"), params.projections, &setting.label(), false)
}

/// The same at few bits, and what the flags say holds for every choice of true projections.
pub fn sound_comparator(bits: u32, policy: Projections) -> Claim {
    let points = if policy == Projections::Skip { 4 } else { 6 };
    let unit = Library::default().block("sound", &[], 1, |u| {
        let p: Vec<_> = (0..points).map(|_| interval(u, bits)).collect();
        let flag = || u.input(Type::FLAG, (0, 1));
        let owners = match policy {
            Projections::All => Owners::Fixed,
            Projections::Skip => Owners::Shared([(); 2].map(|()| vec![flag(), flag()]).named("has")),
            Projections::Intersect => Owners::Intersected([(); 2].map(|()| u.input(DUPLICATES, (0, 4))).named("code")),
        };
        let ((separated, overlapping), _) = network(p.named("p"), owners, false);
        (separated.named("separated"), overlapping.named("overlapping"))
    });
    flags(Subject::of_unit(&unit, "comparator_network"), policy, &format!("{bits} bits"), true)
}

fn flags(subject: Subject, policy: Projections, widths: &str, sound: bool) -> Claim {
    let points = subject.inputs.iter().filter(|w| w.name.ends_with("_lo")).count();
    let widths = format!("{widths}, projections {}", format!("{policy:?}").to_lowercase());
    let property = if sound { "flags as defined, sound" } else { "flags as defined" };
    let mut claim = Claim::new(subject, widths, property);
    claim.compares_only();
    // What belongs to a triangle at its place i; where projections are shared, B's are counted from the last.
    let own = |triangle: usize, i: usize, value: &dyn Fn(usize) -> String| match (policy, triangle) {
        (Projections::Skip, _) => {
            let port = |i: usize| if triangle == 0 { i } else { points - 1 - i };
            let has = |i: usize| format!("raw_has{triangle}_{}", i - 1);
            if i == 0 { value(port(0)) } else { format!("({} ? {} : {})", has(i), value(port(i)), value(port(0))) }
        }
        _ => value(3 * triangle + i),
    };
    if policy == Projections::Skip {
        // No projection belongs to both triangles.
        let places = (1..3).flat_map(|a| (1..3).map(move |b| (a, b))).filter(|(a, b)| a + b > points - 2);
        for (a, b) in places {
            claim.given(format!("!(raw_has0_{} && raw_has1_{})", a - 1, b - 1));
        }
    }
    // Places that the code of duplicates makes equal.
    let groups = [(1, vec![0, 1]), (2, vec![1, 2]), (3, vec![2, 0]), (4, vec![0, 1, 2])];
    for (t, triangle) in ["a", "b"].into_iter().enumerate() {
        for (end, tightest) in [("lo", greatest as fn(&[String]) -> String), ("hi", least)] {
            let bound = |i: usize| own(t, i, &|port| format!("p{port}_{end}"));
            let joint = |i: usize| {
                let mut value = bound(i);
                if policy == Projections::Intersect {
                    for (code, group) in groups.iter().filter(|(_, group)| group.contains(&i)) {
                        let all: Vec<String> = group.iter().map(|i| bound(*i)).collect();
                        value = format!("(duplicates{t} == {code} ? {} : {value})", tightest(&all));
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
        for (t, triangle) in ["a", "b"].into_iter().enumerate() {
            let all = [0, 1, 2].map(|i| own(t, i, &|port| format!("t{port}")));
            claim.value(&format!("{triangle}_min"), least(&all));
            claim.value(&format!("{triangle}_max"), greatest(&all));
            if policy == Projections::Intersect {
                for (code, group) in &groups {
                    let same = group.windows(2).map(|pair| format!("{} == {}", all[pair[0]], all[pair[1]]));
                    let same = same.collect::<Vec<_>>().join(" && ");
                    claim.given(format!("duplicates{t} != {code} || ({same})"));
                }
            }
        }
        claim.shown("!separated || a_max < b_min || b_max < a_min");
        claim.shown("!overlapping || (a_min < b_max && b_min < a_max)");
    }
    let flag = |name: &str, i: usize| {
        if policy == Projections::Intersect {
            format!("joint_{name}({i})")
        } else {
            format!("{name}({i})|{name}_i({i})")
        }
    };
    claim.mutant(NotStrict, flag("above", 0)).mutant(OtherBound, flag("below", 1));
    claim
        .mutant(WrongGate, "separated|separated_and_d1")
        .mutant(NotMissing, "separated")
        .mutant(WrongGate, "overlapping|overlapping_i");
    claim
}
