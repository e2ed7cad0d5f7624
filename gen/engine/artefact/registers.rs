//! The engine behind registers: what they need to know of it, and the file of their testbench.

use super::meshes::{cuboid, hills, turn};
use super::values::Values;
use super::vectors::EngineVectors;
use super::{EngineDesign, NAME};
use crate::host::{Image, Numbers};
use crate::model::{ByNumber, Query};
use crate::params::Memory;
use crate::words::{Command, EngineReport, Reason};
use askama::Template;
use efsat_unit::artefact::{Prefix, testbench};
use efsat_unit::pair::Pair;
use efsat_unit::parts::registers::{Behind, PLACES, Script, Shell};
use efsat_unit::words::REPORT;

#[derive(Template)]
#[template(path = "engine/read_ports.vhd", escape = "none")]
struct ReadPorts<'a> {
    e: &'a Values,
    read_ports: [&'a str; 1],
}

#[derive(Template)]
#[template(path = "engine/memory_signals.vhd", escape = "none")]
struct MemorySignals<'a> {
    e: &'a Values,
    read_ports: [&'a str; 1],
}

#[derive(Template)]
#[template(path = "engine/memory_process.vhd", escape = "none")]
struct MemoryProcess<'a> {
    prefix: &'a Prefix,
    bench: &'a str,
    e: &'a Values,
    read_ports: [&'a str; 1],
}

/// Registers around an engine, whose options are all in the command line.
pub(super) fn shell<'a>(design: &EngineDesign, prefix: &'a Prefix, options: &'a str) -> Shell<'a> {
    let caches = design.params.memory == Memory::Axi;
    let (values, behind) = (&Values::new(design), Behind::Engine { by_number: design.by_number, caches });
    let text = |text: askama::Result<String>| if caches { text.expect("the template renders") } else { String::new() };
    let query = if design.by_number { Command::Numbers } else { Command::Query };
    let read_ports = [""];
    Shell {
        behind,
        options,
        prefix,
        core: NAME,
        answer_bits: 64,
        query_kind: format!("{:02x}", query as u8),
        report: (EngineReport::WORDS, format!("{:05b}", Reason::Reset as u8)),
        more_ports: text(ReadPorts { e: values, read_ports }.render()),
        half_period: format!("{} ps", testbench::half_period(&design.unit.params)),
        memory: [
            text(MemorySignals { e: values, read_ports }.render()),
            text(MemoryProcess { prefix, bench: "efsat_registers_tb", e: values, read_ports }.render()),
        ],
        script: script(design, behind, options),
    }
}

/// Lines of vectors as lines of a script, with what is counted meanwhile.
struct Converter {
    script: Script,
    packets: u32,
    pairs: u32,
    queries: u32,
    query: u64,
}

impl Converter {
    /// Packets and their answers; those that are not answered are only sent.
    fn add(&mut self, text: &str, answered: bool) {
        let (mut pairs, mut begins) = (vec![], true);
        for line in text.lines() {
            let fields: Vec<&str> = line.split(' ').collect();
            let word = |i: usize| u64::from_str_radix(fields[i], 16).expect("a field of vectors");
            match fields[0] {
                "M" => self.script.line(line),
                "I" => {
                    let last = fields[2] == "1";
                    self.script.word(word(1), last);
                    self.packets += u32::from(last);
                    self.queries += u32::from(begins && word(1) & 0xff == self.query);
                    begins = last;
                }
                _ if !answered => {}
                "A" => pairs.push(word(1)),
                "O" => {
                    self.pairs += u32::from(word(1) as u8 & REPORT != REPORT);
                    self.script.answer(word(1), u64::MAX, fields[2] == "1");
                }
                "R" => {
                    let sum = pairs.iter().fold(0, |sum: u64, word| sum.wrapping_add(*word));
                    self.script.line(&format!("P {:08x} {sum:016x}", pairs.len()));
                    self.pairs += pairs.len() as u32;
                    pairs.clear();
                    self.report(word(1), [3, 4, 5].map(word));
                }
                _ => {}
            }
        }
    }

    /// The report, but for clocks and what memory has done.
    fn report(&mut self, low: u64, counts: [u64; 3]) {
        self.script.answer(low, u64::from(u32::MAX), false);
        counts.iter().for_each(|word| self.script.answer(*word, u64::MAX, false));
        (4..EngineReport::WORDS).for_each(|i| self.script.answer(0, 0, i + 1 == EngineReport::WORDS));
    }
}

/// The low half of the first word of the report of a soft reset by the port.
fn after_reset() -> u32 {
    EngineReport { reason: Reason::Reset, ..EngineReport::default() }.words()[0] as u32
}

fn script(design: &EngineDesign, behind: Behind, options: &str) -> String {
    let numbers =
        Numbers::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let meshes = [hills(6), cuboid(3, 4, 2)];
    let images = Image::build(&[&meshes[0], &meshes[1]], &design.format).expect("small meshes");
    let images: Vec<&Image> = images.iter().collect();
    let mut vectors = EngineVectors::new(design, &images);
    let sides = [0, 1].map(|i| vectors.side(i));
    let query = |number: u32, t: [f64; 3]| -> Query {
        let query = numbers.query([(images[0], sides[0]), (images[1], sides[1])], &turn(2), &t);
        Query { number, ..query.expect("a pose inside the ranges") }
    };
    let crossing = query(1, [2.5, 1.0, -1.0]);
    let ask = |vectors: &mut EngineVectors<'_>, query: &Query| match design.by_number {
        false => vectors.query(query),
        true => {
            let pairs = (0..72).flat_map(|a| (0..12).map(move |b| [a, b])).filter(|[a, b]| (a + b) % 19 == 0).collect();
            vectors.numbers(&ByNumber::of_query(query, pairs));
        }
    };
    let random = vectors.random_pairs(32, 7);
    let pairs: Vec<Pair> = random.iter().flat_map(|(_, pairs)| pairs).copied().collect();
    let test_pairs = |vectors: &mut EngineVectors<'_>, from: usize| {
        if !design.by_number {
            vectors.pairs(&pairs[from..from + 3]);
            vectors.pose(&random[0].0);
            vectors.pairs(&pairs[from + 3..from + 12]);
        }
    };
    let kind = if design.by_number { Command::Numbers } else { Command::Query };
    let script = Script::new(behind, options, Some(after_reset()));
    let mut all = Converter { script, packets: 0, pairs: 0, queries: 0, query: kind as u64 };

    // Counted from here on, behind what the tests without a core have written.
    all.script.without_core();
    all.script.write("control", 1);
    test_pairs(&mut vectors, 0);
    ask(&mut vectors, &crossing);
    test_pairs(&mut vectors, 12);
    vectors.malformed(&[(0, true)], Reason::UnknownHeader);
    ask(&mut vectors, &query(2, [0.0, 0.0, 9.0]));
    ask(&mut vectors, &Query { keep_caches: true, number: 3, ..crossing.clone() });
    all.add(vectors.text(), true);
    let report = EngineReport { number: 3, ..EngineReport::default() };
    all.script.reads("last_report", report.words()[0] as u32 & !1);
    all.script.reads("pairs", all.pairs);
    all.script.reads("queries", all.queries);
    all.script.reads("packets_out", all.packets + all.script.answered_resets);
    all.script.reads("packets_in", PLACES / 7 + all.packets);
    if design.params.memory == Memory::Axi {
        all.script.line("K");
    }
    let refused = EngineReport { reason: Reason::UnknownHeader, ..EngineReport::default() }.words();
    all.script.events(&|script| script.word(0, true), &|script| {
        for (i, word) in refused.iter().enumerate() {
            let mask = if i == 0 { u64::from(u32::MAX) } else { 0 };
            script.answer(*word, mask, i + 1 == refused.len());
        }
    });

    // Soft resets: in a part of a packet, while a query runs, with words of it in all places.
    let mut sent = vectors.text().len();
    ask(&mut vectors, &crossing);
    let one: Vec<String> =
        vectors.text()[sent..].lines().filter(|line| line.starts_with('I')).map(str::to_owned).collect();
    let parts = [1, 2, one.len() / 2, one.len() - 1].map(|count| (count, 50));
    let wholes = [0, 150, 700, 1500].map(|clocks| (one.len(), clocks));
    for (i, (count, clocks)) in parts.into_iter().chain(wholes).enumerate() {
        all.add(&one[..count].join("\n"), false);
        all.script.pause(clocks);
        if count == 1 {
            all.script.read("status", 1 << 17, 1 << 17);
        }
        all.script.soft_reset(true);
        vectors.reset(0, None);
        sent = vectors.text().len();
        test_pairs(&mut vectors, i);
        if i % 3 == 0 {
            ask(&mut vectors, &crossing);
        }
        all.add(&vectors.text()[sent..], true);
    }
    all.add(&one.join("\n"), false);
    all.script.reset();
    all.script.write("control", 1);
    vectors.reset(0, None);
    sent = vectors.text().len();
    test_pairs(&mut vectors, 3);
    ask(&mut vectors, &crossing);
    let before = all.pairs;
    all.add(&vectors.text()[sent..], true);
    all.script.reads("pairs", all.pairs - before);
    all.script.text
}
