//! Every parameter set answers as at commit 269ec08: verdicts, flags of all axes, the guard's `outside`, and every inner
//! signal that `efsat cosim --probe` compares.
//!
//! `baseline.txt` has a line for each parameter set: what verdicts it gave how often, then hashes of what it was given, of its
//! answers, and of each family of signals, all of the reference model. The reference model is asked again for every parameter
//! set, and a design with probes is run in the built-in simulator for every twelfth unless everything is asked for.
//!
//! EFSAT_BASELINE=write makes the file anew. To be done at commit 269ec08, with this test put there, and at no other: a
//! baseline made by what it is to check says nothing.

pub mod hardware;
mod sets;
mod vectors;

use crate::extent::share;
use efsat::golden::Golden;
use efsat::pair::Input;
use efsat::params::{Params, Transform};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use vectors::Segment;

/// What is recorded.
const RECORDED: &str = include_str!("baseline.txt");

/// Pairs for each parameter set, and for the default one.
const PAIRS: [usize; 2] = [128, 256];

/// Of so many parameter sets one is simulated, unless all are.
const SIMULATED: usize = 12;

/// Families of signals in the order of the data flow: the column, and how the names of its signals begin.
const FAMILIES: [(&str, &str); 9] = [
    ("b", "transform.w"),
    ("v", "renormalise.v"),
    ("w", "renormalise.w"),
    ("e_a", "edge.a"),
    ("e_b", "edge.b"),
    ("axis", "axis."),
    ("projection", "projection."),
    ("enclosure", "enclosure."),
    ("flags", "flags."),
];

/// Inner signals of one pair, each with its two bounds or flags, by the names of the reference model's trace. The flags of
/// an axis, `flags.{axis}`, are those before the guard and before the verdict.
type Signals = BTreeMap<String, [i128; 2]>;

/// What is seen of one pair.
pub struct Seen {
    /// Verdict, separated, overlapping, outside.
    answer: [i128; 4],
    signals: Signals,
}

impl Seen {
    /// The verdict's code, or 3 for a pair outside.
    fn kind(&self) -> usize {
        let [verdict, .., outside] = self.answer;
        if outside == 1 { 3 } else { verdict as usize }
    }
}

/// What the reference model says.
fn expected(p: &Params, segments: &[Segment]) -> Vec<Seen> {
    let golden = Golden::new(p);
    let pairs = segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
    let seen = pairs.map(|(pose, pair)| {
        let outcome = golden.outcome(pose, pair);
        let flags = [outcome.separated, outcome.overlapping].map(i128::from);
        let answer = [outcome.verdict as i128, flags[0], flags[1], i128::from(outcome.outside)];
        let trace = golden.trace(pose, pair).into_iter();
        let mut signals: Signals = trace.map(|(name, x)| (name, [x.lo, x.hi])).collect();
        if p.transform == Transform::Off {
            // These are the pair's own words.
            signals.retain(|name, _| !name.starts_with("transform."));
        }
        let axes: BTreeSet<String> = signals.keys().filter_map(|name| Some(axis(name)?.to_owned())).collect();
        for axis in axes {
            let of = |end: &str| signals[&format!("enclosure.{axis}.{end}")];
            let ([a_min, a_max], [b_min, b_max]) = (["a_min", "a_max"].map(of), ["b_min", "b_max"].map(of));
            let separated = b_min[0] > a_max[1] || a_min[0] > b_max[1];
            let overlapping = a_min[1] < b_max[0] && b_min[1] < a_max[0];
            signals.insert(format!("flags.{axis}"), [separated, overlapping].map(i128::from));
        }
        Seen { answer, signals }
    });
    seen.collect()
}

/// The axis that a signal encloses images on.
fn axis(signal: &str) -> Option<&str> {
    Some(signal.strip_prefix("enclosure.")?.split_once('.')?.0)
}

/// The first hexadecimal digits of the SHA-256 of numbers, `-` if there are none.
fn hash(digits: usize, numbers: impl Iterator<Item = i128>) -> String {
    let bytes: Vec<u8> = numbers.flat_map(i128::to_le_bytes).collect();
    if bytes.is_empty() {
        return "-".to_owned();
    }
    Sha256::digest(bytes).iter().take(digits / 2).map(|byte| format!("{byte:02x}")).collect()
}

/// A parameter set with its vectors. The options seed them, so that a set names its vectors whatever the others are.
fn vectors(p: &Params) -> Vec<Segment> {
    let seed = Sha256::digest(sets::options(p)).iter().take(8).fold(0, |seed, byte| (seed << 8) | u64::from(*byte));
    vectors::segments(p, PAIRS[usize::from(*p == sets::default())], seed)
}

/// The columns before the options: what is seen of a parameter set.
fn columns(segments: &[Segment], seen: &[Seen]) -> Vec<String> {
    let number = |x: &Input| [i128::from(x.lo), i128::from(x.sticky)];
    let words = segments.iter().flat_map(|(pose, pairs)| {
        let of_pose = pose.m.iter().flatten().chain(&pose.t).flat_map(number).chain([i128::from(pose.bypass)]);
        of_pose.chain(pairs.iter().flat_map(move |pair| pair.a.iter().chain(&pair.b).flatten().flat_map(number)))
    });
    let answers = seen.iter().flat_map(|one| one.answer);
    let mut columns = vec![mix(seen).map(|n| n.to_string()).join("/"), hash(8, words), hash(16, answers)];
    columns.extend(FAMILIES.iter().map(|(_, start)| {
        let signals = seen.iter().flat_map(|one| one.signals.iter().filter(|(name, _)| name.starts_with(start)));
        hash(8, signals.flat_map(|(_, values)| *values))
    }));
    columns
}

/// How many pairs are answered separate, intersect, possibly incorrect, and, not counted there, outside.
fn mix(seen: &[Seen]) -> [usize; 4] {
    [0, 1, 2, 3].map(|kind| seen.iter().filter(|one| one.kind() == kind).count())
}

/// Names of the columns.
fn titles() -> impl Iterator<Item = &'static str> {
    ["verdicts", "words", "answers"].into_iter().chain(FAMILIES.iter().map(|family| family.0))
}

/// The lines of the file by their options.
fn recorded() -> BTreeMap<String, Vec<&'static str>> {
    let lines = RECORDED.lines().filter(|line| !line.starts_with('#'));
    let line = |line: &'static str| {
        let mut columns: Vec<&str> = line.split(' ').collect();
        let options = columns.split_off(titles().count());
        (options.join(" "), columns)
    };
    lines.map(line).collect()
}

/// Which columns differ from what is recorded, but for one that is not seen.
fn compare(p: &Params, segments: &[Segment], seen: &[Seen], unseen: &str) -> Result<(), String> {
    let options = sets::options(p);
    let recorded = recorded().remove(&options).ok_or_else(|| format!("{options}: not recorded"))?;
    let now = columns(segments, seen);
    let wrong = titles().zip(recorded.iter().zip(&now)).filter(|(_, (recorded, now))| recorded != now);
    let wrong: Vec<&str> = wrong.map(|(title, _)| title).filter(|title| *title != unseen).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    let verdicts = format!(" ({} instead of {})", now[0], recorded[0]);
    let verdicts = if now[0] == recorded[0] { "" } else { &verdicts };
    Err(format!("{options}: not as before: {}{verdicts}", wrong.join(", ")))
}

/// Runs a check on parameter sets, on all cores, and fails with everything that went wrong.
fn all_hold(sets: &[Params], check: impl Fn(&Params) -> Result<(), String> + Sync) {
    let failures: Vec<String> = sets.par_iter().filter_map(|p| check(p).err()).collect();
    assert!(failures.is_empty(), "{} of {} parameter sets:\n{}", failures.len(), sets.len(), failures.join("\n"));
}

/// Whether the file is to be made anew.
fn to_write() -> bool {
    std::env::var_os("EFSAT_BASELINE").is_some_and(|value| value == "write")
}

#[test]
fn the_reference_model_answers_as_before() {
    if to_write() {
        return write();
    }
    let sets = sets::all();
    assert_eq!(recorded().into_keys().collect::<BTreeSet<_>>(), sets.iter().map(sets::options).collect());
    all_hold(&sets, |p| {
        let segments = vectors(p);
        compare(p, &segments, &expected(p, &segments), "")
    });
}

#[test]
fn designs_answer_as_before() {
    if to_write() {
        return;
    }
    let sets = share(SIMULATED, sets::all());
    all_hold(&sets, |p| {
        let segments = vectors(p);
        let seen = hardware::seen(p, &segments);
        // Least and greatest projections have no probes; the flags follow from them.
        compare(p, &segments, &seen, "enclosure")
            .map_err(|message| format!("{message}\n  {}", first_difference(&seen, &expected(p, &segments))))
    });
}

/// Where a design first differs from the reference model.
fn first_difference(seen: &[Seen], expected: &[Seen]) -> String {
    for (number, (seen, expected)) in seen.iter().zip(expected).enumerate() {
        let families = FAMILIES.iter().filter(|family| family.0 != "enclosure");
        for name in families.flat_map(|family| expected.signals.keys().filter(|name| name.starts_with(family.1))) {
            let due = expected.signals[name];
            match seen.signals.get(name) {
                Some(now) if *now == due => {}
                Some(now) => return format!("vector {number}: {name} is {now:?}, the reference model's {due:?}"),
                None => return format!("vector {number}: no probe shows {name}"),
            }
        }
        if seen.answer != expected.answer {
            return format!("vector {number}: answer {:?}, the reference model's {:?}", seen.answer, expected.answer);
        }
    }
    "the reference model says the same".to_owned()
}

/// Makes the file. To be done at commit 269ec08 and at no other.
fn write() {
    let lines: Vec<(String, [usize; 4])> = sets::all()
        .par_iter()
        .map(|p| {
            let segments = vectors(p);
            let seen = expected(p, &segments);
            (format!("{} {}\n", columns(&segments, &seen).join(" "), sets::options(p)), mix(&seen))
        })
        .collect();
    let total = |kind: usize| lines.iter().map(|line| line.1[kind]).sum::<usize>();
    let [separate, intersect, open, outside] = [0, 1, 2, 3].map(total);
    let mut text = format!(
        "# What every parameter set answered at commit 269ec08; testbench/baseline.rs says what is hashed, and checks it.\n\
         # Made there, and to be made nowhere else: EFSAT_BASELINE=write cargo test --release --test testbench baseline::\n\
         # {} parameter sets, {} pairs: {separate} separate, {intersect} intersect, {open} possibly incorrect, {outside} outside.\n\
         # {} options\n",
        lines.len(),
        separate + intersect + open + outside,
        titles().collect::<Vec<_>>().join(" "),
    );
    text.extend(lines.into_iter().map(|line| line.0));
    std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/testbench/baseline.txt"), text).expect("the file is written");
}
