//! Words for the engine and what it must answer, from the reference model.
//!
//! The file begins with the line of formats, which the testbench compares with its own; the testbench says what the other
//! lines are.

use super::EngineDesign;
use crate::format::EngineFormat;
use crate::host::{Image, Layout, memory};
use crate::model::{ByNumber, Model, Query, Side};
use crate::params::Memory;
use crate::words::{Command, EngineAnswer, EngineReport, Reason};
use efsat_unit::artefact::{Stimulus, vectors};
use efsat_unit::pair::{Pair, Pose};
use efsat_unit::parts::Maker;
use std::fmt::Write;

/// How a report is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Compared {
    /// Reason and number of the query alone.
    Reason = 0,
    /// These, and that no pair is answered that is not expected.
    NoOther = 1,
    /// Everything that does not depend on time.
    All = 2,
    /// This, and the order of the pairs.
    InOrder = 3,
    /// Reason and number, and that the pairs are the first of those expected, in order.
    FirstOf = 4,
}

/// The first line of a file, also a constant of the testbench.
pub fn formats_line(design: &EngineDesign) -> String {
    let format = &design.format;
    let memory = match design.params.memory {
        Memory::Axi => "axi".to_owned(),
        Memory::BlockRam => format!("block-ram {} {}", design.params.block_lines, design.params.triangle_lines),
    };
    let (command, words) = match design.by_number {
        false => (Command::Query, format.query_words()),
        true => (Command::Numbers, format.pairs_at()),
    };
    format!(
        "{} query {:016x} words {words} memory {memory}",
        vectors::formats_line(&design.unit.params),
        format.header(command)
    )
}

/// A vector file in the making: what is in memory, then packets in the order of their answers.
pub struct EngineVectors<'a> {
    design: &'a EngineDesign,
    model: Model,
    /// The images as the model sees them.
    memory: Vec<u64>,
    sides: Vec<Side>,
    /// Where the engine has them.
    layout: Layout,
    /// Makes packets of pairs and poses.
    unit: Maker<'a>,
    /// A query came behind the last pose, and of several engines nobody knows which has it.
    unposed: bool,
    text: String,
}

impl<'a> EngineVectors<'a> {
    /// Puts images into memory, one after the other: through the stream, if the memory is block RAM.
    ///
    /// # Panics
    /// If they do not fit into block RAM.
    pub fn new(design: &'a EngineDesign, images: &[&Image]) -> Self {
        let (memory, sides) = memory(images);
        let model =
            Model::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
        let layout = design.layout(images).expect("images that fit");
        let unit = Maker::new(&design.unit.params, &design.format.stream);
        let text = format!("{}\n", formats_line(design));
        let mut vectors = Self { design, model, memory, sides, layout, unit, unposed: false, text };
        for (address, word) in vectors.layout.memory.iter().enumerate() {
            writeln!(vectors.text, "M {address:08x} {word:016x}").expect("a string takes text");
        }
        for (i, load) in std::mem::take(&mut vectors.layout.loads).into_iter().enumerate() {
            vectors.packet(&load);
            vectors.expect(&[], &EngineReport::default(), Compared::All);
            if i == 0 {
                // It ends inside a line.
                vectors.packet(&load[..load.len() - 1]);
                let reason = Reason::TooShort;
                vectors.expect(&[], &EngineReport { reason, ..EngineReport::default() }, Compared::All);
            }
        }
        vectors
    }

    /// Where image i is for the model: what a query for [`EngineVectors::query`] says.
    pub fn side(&self, i: usize) -> Side {
        self.sides[i]
    }

    /// Changes a word of memory; with AXI before the first packet alone, with block RAM not at all.
    ///
    /// # Panics
    /// If the memory is block RAM, which is loaded already.
    pub fn change(&mut self, address: usize, change: impl FnOnce(&mut u64)) {
        assert_eq!(self.design.params.memory, Memory::Axi);
        change(&mut self.memory[address]);
        writeln!(self.text, "M {address:08x} {:016x}", self.memory[address]).expect("a string takes text");
    }

    /// A query and its answer.
    pub fn query(&mut self, query: &Query) {
        self.packet(&self.layout.moved(query, &self.sides).words(&self.design.format));
        let run = |query: &Query| self.model.run(&self.memory, &query.words(&self.design.format));
        let outcome = run(query);
        self.unit.pose = query.pose;
        self.unposed = self.design.params.engines > 1;
        match outcome.report.reason {
            Reason::Complete => self.expect(&outcome.answers, &outcome.report, Compared::All),
            Reason::Contact | Reason::Limit => {
                let all = run(&Query { first_contact: false, limit: 0, ..query.clone() });
                self.expect(&all.answers, &outcome.report, Compared::NoOther);
            }
            _ => self.expect(&[], &outcome.report, Compared::Reason),
        }
    }

    /// A packet of pairs by number and its answer.
    pub fn numbers(&mut self, packet: &ByNumber) {
        self.words_of_numbers(packet, &self.numbers_words(packet));
    }

    /// The words of a packet of pairs by number, whose sides are those of [`EngineVectors::side`], to the engine.
    pub fn numbers_words(&self, packet: &ByNumber) -> Vec<u64> {
        let sides = packet.sides.map(|side| self.layout.there(side, &self.sides));
        ByNumber { sides, ..packet.clone() }.words(&self.design.format)
    }

    /// Words for the engine, and the answer to the packet that they are of for the model.
    pub fn words_of_numbers(&mut self, packet: &ByNumber, words: &[u64]) {
        self.packet(words);
        let outcome = self.model.run_numbers(&self.memory, &packet.words(&self.design.format));
        self.expect(&outcome.answers, &outcome.report, Compared::InOrder);
    }

    /// A packet of pairs by number that memory ends: of its pairs the first are answered.
    pub fn numbers_that_end(&mut self, packet: &ByNumber, reason: Reason) {
        self.packet(&self.numbers_words(packet));
        let outcome = self.model.run_numbers(&self.memory, &packet.words(&self.design.format));
        self.expect(&outcome.answers, &EngineReport { reason, ..outcome.report }, Compared::FirstOf);
    }

    /// A query that ends for a reason that the model does not know.
    pub fn query_that_ends(&mut self, query: &Query, reason: Reason) {
        let before = self.text.len();
        self.query(query);
        let report = EngineReport { reason, number: query.number, ..EngineReport::default() };
        let end = self.text[before..].find("\nA ").or(self.text[before..].find("\nR ")).map(|at| before + at + 1);
        self.text.truncate(end.expect("an answer"));
        self.expect(&[], &report, Compared::Reason);
    }

    /// A load that is refused: the words behind its header, and the reason.
    pub fn refused_load(&mut self, rest: &[u64], reason: Reason) {
        let words = [self.design.format.header(Command::Load)].into_iter().chain(rest.iter().copied());
        self.malformed(&words.map(|word| (word, true)).collect::<Vec<_>>(), reason);
    }

    /// A packet that is no query, and the reason that its report gives.
    ///
    /// # Panics
    /// If the model has another reason. It knows queries of whole words alone.
    pub fn malformed(&mut self, words: &[(u64, bool)], reason: Reason) {
        let end = words.len() - 1;
        let others = [Command::Load, Command::Stop, Command::Reset];
        let other = others.iter().any(|&command| self.design.format.is_order(command, words[0].0));
        if words.iter().all(|(_, whole)| *whole) && !other {
            let packet: Vec<u64> = words.iter().map(|(word, _)| *word).collect();
            let outcome = match self.design.by_number {
                false => self.model.run(&self.memory, &packet),
                true => self.model.run_numbers(&self.memory, &packet),
            };
            assert_eq!(outcome.report.reason, reason, "{packet:x?}");
        }
        for (i, (word, whole)) in words.iter().enumerate() {
            self.word_in(*word, i == end, *whole);
        }
        self.expect(&[], &EngineReport { reason, ..EngineReport::default() }, Compared::All);
    }

    /// A packet of pairs; under the pose of the last query or packet that had one.
    pub fn pairs(&mut self, pairs: &[Pair]) {
        self.unit(|unit| unit.pairs(pairs));
    }

    /// A packet with a pose.
    pub fn pose(&mut self, pose: &Pose) {
        self.unit(|unit| unit.pose(pose));
    }

    /// Packets of pairs or a pose that are none, made of these; to a unit with a guard, numbers outside their ranges.
    pub fn unusual_pairs(&mut self, pair: &Pair, pose: &Pose) {
        self.unit(|unit| unit.malformed(pair, pose));
        let params = EngineFormat::packets(&self.design.unit.params);
        if params.guarded() {
            self.unit(|unit| unit.outside(&params));
        }
    }

    /// Random pairs, and a pose for each few of them.
    pub fn random_pairs(&self, count: usize, seed: u64) -> Vec<(Pose, Vec<Pair>)> {
        Stimulus::random(&EngineFormat::packets(&self.design.unit.params), count, seed).segments
    }

    fn unit(&mut self, make: impl FnOnce(&mut Maker<'a>)) {
        if std::mem::take(&mut self.unposed) {
            let pose = self.unit.pose;
            self.pose(&pose);
        }
        make(&mut self.unit);
        let made = std::mem::take(&mut self.unit.vectors);
        for word in made.words {
            self.word_in(word.data.low() as u64, word.last, word.whole);
        }
        for (word, last) in made.answers {
            writeln!(self.text, "O {word:016x} {}", u8::from(last)).expect("a string takes text");
        }
    }

    /// Stops the query with a number, so many clocks after the words before.
    pub fn stop(&mut self, clocks: u32, number: u32) {
        self.pause(clocks);
        self.word_in(self.design.format.order(Command::Stop, number), true, true);
    }

    /// A soft reset so many clocks after the words before: by the stream, with a number, or by the port. Packets before it that are not
    /// answered then have no other answer. The next words come when it is answered.
    pub fn reset(&mut self, clocks: u32, number: Option<u32>) {
        self.pause(clocks);
        match number {
            Some(number) => self.word_in(self.design.format.order(Command::Reset, number), true, true),
            None => self.text.push_str("S\n"),
        }
        self.text.push_str("Z\n");
        self.unposed = false;
        self.unit.pose = Pose::identity(&self.design.unit.params);
        self.wait();
    }

    /// A soft reset by the port behind so many words of a packet, the rest of which is dropped.
    ///
    /// # Panics
    /// If these are none or all of its words.
    pub fn reset_within(&mut self, words: &[u64], words_before: usize) {
        assert!((1..words.len()).contains(&words_before));
        let (before, dropped) = words.split_at(words_before);
        before.iter().for_each(|&word| self.word_in(word, false, true));
        self.reset(0, None);
        self.packet(dropped);
    }

    /// A word of memory is written behind the answers to all packets before. Passes after the first begin with it.
    ///
    /// # Panics
    /// If the memory is block RAM.
    pub fn rewrite(&mut self, address: usize, word: u64) {
        assert_eq!(self.design.params.memory, Memory::Axi);
        self.memory[address] = word;
        self.wait();
        writeln!(self.text, "N {address:08x} {word:016x}").expect("a string takes text");
    }

    /// The next words come so many clocks later.
    pub fn pause(&mut self, clocks: u32) {
        writeln!(self.text, "D {clocks:08x}").expect("a string takes text");
    }

    /// The next words come when all packets are answered.
    pub fn wait(&mut self) {
        self.text.push_str("W\n");
    }

    /// A fault of memory, once in a run: 1 error response, 2 last word too early, 3 too late, 4 a long time without an answer, 5 no
    /// last word. Address in units of 64 bytes.
    pub fn fault(&mut self, address: u32, kind: u8) {
        writeln!(self.text, "X {address:08x} {kind:x}").expect("a string takes text");
    }

    fn packet(&mut self, words: &[u64]) {
        let end = words.len() - 1;
        for (i, word) in words.iter().enumerate() {
            self.word_in(*word, i == end, true);
        }
    }

    fn word_in(&mut self, word: u64, last: bool, whole: bool) {
        writeln!(self.text, "I {word:016x} {} {}", u8::from(last), u8::from(whole)).expect("a string takes text");
    }

    fn expect(&mut self, answers: &[EngineAnswer], report: &EngineReport, compared: Compared) {
        let mut words: Vec<u64> = answers.iter().map(EngineAnswer::word).collect();
        if compared != Compared::InOrder && compared != Compared::FirstOf {
            words.sort_unstable();
        }
        for word in words {
            writeln!(self.text, "A {word:016x}").expect("a string takes text");
        }
        let [low, one, two, three, ..] = report.words();
        let (low, mode) = (low as u32, compared as u8);
        writeln!(self.text, "R {low:08x} {mode} {one:016x} {two:016x} {three:016x}").expect("a string takes text");
    }

    /// The file.
    pub fn text(&self) -> &str {
        &self.text
    }
}
