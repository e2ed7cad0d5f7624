//! The generated testbench: strict VHDL-93, driven by a [vector file](super::vectors).
//!
//! It runs all vectors at full speed, then the first [`paced`] again: until the unit is full, then with
//! random gaps and back-pressure. Both passes
//! are one clocked process, so that the built-in simulator can do the same, clock for clock.

use super::vectors::{Word, answer_word, formats_line, pair_word, pose_word};
use crate::artefact::Prefix;
use crate::artefact::bits::Bits;
use crate::design::sequencer;
use crate::design::top::{Channel, Design};
use crate::pair::{Input, Outcome, Pair, Pose, Verdict};
use crate::params::Params;
use askama::Template;

/// Pairs of the second pass: enough to fill the unit, and some more.
pub fn paced(design: &Design) -> usize {
    96.max(design.places + 32)
}

/// Clocks of refusal after which the unit is full, and so are the queues of answers in it.
pub fn full_after(design: &Design) -> usize {
    let second = design.second.as_ref().map_or(0, |second| {
        let slot = second.pipeline.interval;
        second.latency + slot * (sequencer::places(second.schedule.latency, slot) + 1)
    });
    second.max(design.latency + 2 * design.interval + 4)
}

/// Clocks without an answer after which there will be none.
pub fn patience(design: &Design) -> usize {
    4096 + 4 * design.latency
}

/// Clocks of reset.
pub const RESET_CLOCKS: usize = 4;

/// Half a period of the clock, in picoseconds.
pub fn half_period(p: &Params) -> u32 {
    500_000 / p.frequency
}

/// Name of the testbench entity, without a prefix.
pub const NAME: &str = "efsat_tb";

/// A port of the top and the part of a word behind it.
struct Field {
    port: String,
    high: u32,
    low: u32,
    single: bool,
}

#[derive(Template)]
#[template(path = "efsat_tb.vhd", escape = "none")]
struct Testbench<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    formats: String,
    paced: usize,
    reset_clocks: usize,
    pair: Vec<Field>,
    pair_high: u32,
    pose: Vec<Field>,
    pose_high: u32,
    answer: Vec<Field>,
    answer_high: u32,
    tag_width: u32,
    tag: Bits,
    tags: u64,
    half_period: String,
    patience: usize,
    full_after: usize,
    latency: usize,
    two_stages: bool,
    interval: usize,
    probes: Vec<Field>,
    probe_high: u32,
}

fn fields(word: &Word) -> Vec<Field> {
    let mut low = 0;
    word.fields
        .iter()
        .map(|(port, _, bits)| {
            let field = Field { port: port.clone(), high: low + bits - 1, low, single: *bits == 1 };
            low += bits;
            field
        })
        .collect()
}

/// Words of zeros: pair, pose and answer, to ask for their shape.
pub fn blank(p: &Params) -> [Word; 3] {
    let zero = Input { lo: 0, sticky: false };
    let pair = Pair { a: [[zero; 3]; 3], b: [[zero; 3]; 3] };
    let outcome = Outcome { verdict: Verdict::Separate, separated: 0, overlapping: 0, outside: false };
    [pair_word(p, &pair), pose_word(p, &Pose::identity(p)), answer_word(p, &outcome)]
}

/// The probe ports as one word.
pub fn probe_word(design: &Design) -> Word {
    let ports = design.top.outputs.iter().map(|(place, id)| (place.to_string(), 0, design.top.signal(*id).ty.bits));
    Word { fields: ports.filter(|(name, ..)| Design::channel(name) == Channel::Probe).collect() }
}

/// The text of the testbench of a design with a prefix, `origin` on top.
pub fn text(design: &Design, prefix: &Prefix, origin: &[String]) -> String {
    let p = &design.params;
    let [pair, pose, answer] = blank(p);
    let probes = probe_word(design);
    let last = |word: &Word| word.bits().saturating_sub(1);
    let testbench = Testbench {
        header: origin.to_vec(),
        prefix,
        formats: formats_line(p),
        paced: paced(design),
        reset_clocks: RESET_CLOCKS,
        pair_high: last(&pair),
        pose_high: last(&pose),
        answer_high: last(&answer),
        probe_high: last(&probes),
        pair: fields(&pair),
        pose: fields(&pose),
        answer: fields(&answer),
        probes: fields(&probes),
        tag_width: p.tag_width,
        tag: Bits::all(p.tag_width.max(1)),
        tags: 1 << p.tag_width.min(30),
        half_period: format!("{} ps", half_period(p)),
        patience: patience(design),
        full_after: full_after(design),
        latency: design.latency,
        two_stages: design.second.is_some(),
        interval: design.interval,
    };
    testbench.render().expect("the template renders")
}
