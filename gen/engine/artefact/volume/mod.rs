//! The files of a volume unit: VHDL sources, a testbench, and what it reads.

mod stimulus;

pub use stimulus::{Expansion, VolumeStimulus};

use crate::design::volume_unit::{VolumeDesign, WordPort};
use askama::Template;
use efsat_hardware::vhdl::{self, Clash};
use efsat_unit::artefact::{Prefix, origin};

/// Name of the entity, without a prefix.
pub const NAME: &str = "volume_unit";

/// Name of its testbench, without a prefix.
pub const BENCH: &str = "volume_unit_tb";

/// Name of its package of types, without a prefix.
pub const PACKAGE: &str = "volume_types";

/// A port.
struct Word {
    name: &'static str,
    high: u32,
    query: bool,
}

impl Word {
    fn new(word: &WordPort) -> Self {
        Self { name: word.name, high: word.bits - 1, query: word.of_query() }
    }
}

/// A port of the stage.
struct Bundle {
    name: String,
    ty: String,
    /// Elements that are cut from the words alike, so many at a time.
    groups: Vec<Group>,
}

/// Parts of a port with an index i, which is 0 to `last`; or those without one.
struct Group {
    last: Option<u32>,
    parts: Vec<Part>,
}

/// A part of a port, and where it is in a word.
struct Part {
    target: String,
    value: String,
}

/// A number in a word: the part of a bundle, its lowest bit, and how many it has.
struct Number {
    target: String,
    conversion: &'static str,
    word: &'static str,
    low: u32,
    bits: u32,
}

impl Number {
    /// The part without the index in one of its brackets, and that index.
    fn without(&self, bracket: usize) -> Option<(String, u32)> {
        let open = self.target.match_indices('(').nth(bracket)?.0;
        let close = open + self.target[open..].find(')')?;
        let index = self.target[open + 1..close].parse().ok()?;
        Some((format!("{}(i){}", &self.target[..open], &self.target[close + 1..]), index))
    }

    /// As a part, `stride` bits from one index to the next.
    fn part(&self, target: String, stride: Option<u32>) -> Part {
        let at = |bit: u32| match (stride, bit) {
            (None, _) => bit.to_string(),
            (Some(1), 0) => "i".to_owned(),
            (Some(stride), 0) => format!("{stride} * i"),
            (Some(stride), _) => format!("{stride} * i + {bit}"),
        };
        let (low, high) = (at(self.low), at(self.low + self.bits - 1));
        let bits = if self.bits == 1 { low } else { format!("{high} downto {low}") };
        let value = format!("{}({bits})", self.word);
        Part { target, value: if self.bits == 1 { value } else { format!("{}({value})", self.conversion) } }
    }
}

/// The numbers of a bundle, those that differ in the index of a bracket together where they lie alike.
fn by_index(numbers: &[Number], bracket: usize) -> Vec<Group> {
    let mut runs: Vec<(String, Vec<(u32, &Number)>)> = vec![];
    for number in numbers {
        let (target, index) = number.without(bracket).unwrap_or((number.target.clone(), 0));
        match runs.iter_mut().find(|run| run.0 == target) {
            Some(run) => run.1.push((index, number)),
            None => runs.push((target, vec![(index, number)])),
        }
    }
    let mut groups: Vec<Group> = vec![];
    let mut push = |last: Option<u32>, part: Part| match groups.iter_mut().find(|group| group.last == last) {
        Some(group) => group.parts.push(part),
        None => groups.push(Group { last, parts: vec![part] }),
    };
    for (target, run) in runs {
        let first = run[0].1;
        let stride = run.get(1).and_then(|second| second.1.low.checked_sub(first.low));
        let lies = |i: usize| {
            let (index, number) = run[i];
            let same = (number.word, number.bits, number.conversion) == (first.word, first.bits, first.conversion);
            same && index == i as u32 && Some(number.low) == stride.map(|n| first.low + n * index)
        };
        match run.len() > 1 && (0..run.len()).all(lies) {
            true => push(Some(run.len() as u32 - 1), first.part(target, stride)),
            false => run.iter().for_each(|(_, number)| push(None, number.part(number.target.clone(), None))),
        }
    }
    groups
}

/// What the stage gets from the words: every number of them, and nothing else but its handshakes.
fn bundles(design: &VolumeDesign, ports: Vec<vhdl::Bundle>) -> Vec<Bundle> {
    let words = design.words();
    let numbers = || words.iter().flat_map(|word| word.numbers.iter().map(|number| (word.name, number)));
    let mut cut = 0;
    let mut bundle = |bundle: vhdl::Bundle| {
        let number = |(port, target, signed): &(String, String, bool)| {
            let (word, (_, low, bits)) =
                numbers().find(|(_, number)| number.0 == *port).unwrap_or_else(|| panic!("{port} is in no word"));
            let conversion = if *signed { "signed" } else { "unsigned" };
            Number { target: format!("{STAGE}{target}"), conversion, word, low: *low, bits: *bits }
        };
        let numbers: Vec<Number> = bundle.numbers.iter().map(number).collect();
        cut += numbers.len();
        let lines = |groups: &Vec<Group>| groups.iter().map(|group| group.parts.len()).sum::<usize>();
        let groups = (0..2).map(|bracket| by_index(&numbers, bracket)).min_by_key(lines).expect("two ways");
        assert!(groups.iter().filter(|group| group.last.is_some()).count() < 2, "{}: two loops", bundle.name);
        Bundle { name: bundle.name, ty: bundle.ty, groups }
    };
    let is_number = |bundle: &vhdl::Bundle| !["reset", "in_valid"].contains(&&bundle.name[..]);
    let all = ports.into_iter().filter(is_number).map(&mut bundle).collect();
    assert_eq!(cut, numbers().count(), "numbers of the words");
    all
}

/// Stands before the names of what goes to ports of the stage.
const STAGE: &str = "stage_";

#[derive(Template)]
#[template(path = "engine/volume_unit.vhd", escape = "none")]
struct VolumeUnit<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    package: &'static str,
    interval: usize,
    latency: usize,
    words: Vec<Word>,
    bundles: Vec<Bundle>,
}

#[derive(Template)]
#[template(path = "engine/volume_unit_tb.vhd", escape = "none")]
struct Bench<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    latency: usize,
    words: Vec<Word>,
}

fn words(design: &VolumeDesign) -> Vec<Word> {
    design.words().iter().map(Word::new).collect()
}

/// Name and text of each source file, in dependency order: the package, the entities of the data path, the unit. All names
/// begin with the prefix.
///
/// # Errors
/// A name that some tool would refuse.
pub fn volume_files(design: &VolumeDesign, prefix: &Prefix) -> Result<Vec<(String, String)>, Clash> {
    let (mut files, ports) = vhdl::print_inner(&design.stage, &prefix.of(""), PACKAGE, &origin())?;
    let VolumeDesign { interval, latency, .. } = *design;
    let unit = VolumeUnit {
        header: origin(),
        prefix,
        package: PACKAGE,
        interval,
        latency,
        words: words(design),
        bundles: bundles(design, ports),
    };
    files.push((prefix.of(NAME), unit.render().expect("the template renders")));
    Ok(files.into_iter().map(|(name, text)| (format!("{name}.vhd"), text)).collect())
}

/// The text of the testbench, which reads the lines of a [`VolumeStimulus`] from a file `volume_unit_tb.vec`.
pub fn volume_bench(design: &VolumeDesign, prefix: &Prefix) -> String {
    let bench = Bench { header: origin(), prefix, latency: design.latency, words: words(design) };
    bench.render().expect("the template renders")
}
