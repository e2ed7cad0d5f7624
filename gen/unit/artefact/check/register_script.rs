//! What the testbench of the registers does and must see, line by line; the testbench says what lines there are.

use super::Stimulus;
use crate::host::driver::{StandIn, Transfer, packet};
use crate::pair::{Pair, Pose};
use crate::params::Params;
use crate::words::registers::{Access, Behind, PLACES, REFUSALS, Register, registers};
use crate::words::{PacketKind, StreamFormat, StreamWord};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// An address at which there is no register.
const NOWHERE: u32 = 0x2c;
/// All strobes.
const WHOLE: u32 = 0xf;
/// Bits of the interrupts, as in the register `pending`.
const ANSWER: u32 = 1;
const RECEIVE: u32 = 2;
const TRANSMIT: u32 = 4;
const FAULT: u32 = 8;
const REFUSED: u32 = 16;

/// The first 32 bits of the SHA-256 of a command line.
pub fn hash(options: &str) -> u32 {
    let digest = Sha256::digest(options);
    u32::from_be_bytes([digest[0], digest[1], digest[2], digest[3]])
}

/// The first line of a file, which the testbench knows too.
pub fn first_line(options: &str) -> String {
    format!("registers of {:08x}", hash(options))
}

/// A file in the making.
pub struct Script {
    list: Vec<Register>,
    /// The lines so far.
    pub text: String,
    /// Refused accesses so far.
    refused: u32,
    /// What a core answers to a soft reset: the low half of the first word of its report, if it reports one.
    reset_report: Option<u32>,
    /// Soft resets so far that were answered.
    pub answered_resets: u32,
}

impl Script {
    /// After reset.
    pub fn new(behind: Behind, options: &str, reset_report: Option<u32>) -> Self {
        let (list, text) = (registers(behind, hash(options)), first_line(options) + "\n");
        Self { list, text, refused: 0, reset_report, answered_resets: 0 }
    }

    /// A line.
    pub fn line(&mut self, line: &str) {
        writeln!(self.text, "{line}").expect("a string takes text");
    }

    fn at(&self, name: &str) -> u32 {
        self.list.iter().find(|register| register.name == name).expect("a register").offset
    }

    /// A write that is done.
    pub fn write(&mut self, name: &str, word: u32) {
        let at = self.at(name);
        self.line(&format!("W {at:03x} {word:08x} f 0"));
    }

    /// A read that gives the word, as far as the mask goes.
    pub fn read(&mut self, name: &str, word: u32, mask: u32) {
        let at = self.at(name);
        self.line(&format!("R {at:03x} {word:08x} {mask:08x} 0"));
    }

    /// A read that gives the word.
    pub fn reads(&mut self, name: &str, word: u32) {
        self.read(name, word, u32::MAX);
    }

    /// Counts a refusal, and looks at it.
    fn refused(&mut self, at: u32, why: &str) {
        self.refused += 1;
        let code = REFUSALS.iter().find(|row| row.0 == why).expect("a reason").1;
        self.reads("refusal", self.refused | at << 16 | code << 28);
    }

    /// A write that is refused.
    fn refuses_write(&mut self, at: u32, strobes: u32, why: &str) {
        self.line(&format!("W {at:03x} ffffffff {strobes:x} 2"));
        self.refused(at, why);
    }

    /// A read that is refused, and gives 0.
    fn refuses_read(&mut self, at: u32, why: &str) {
        self.line(&format!("R {at:03x} 00000000 ffffffff 2"));
        self.refused(at, why);
    }

    /// Some clocks.
    pub fn pause(&mut self, clocks: u32) {
        self.line(&format!("D {clocks:08x}"));
    }

    /// A soft reset, which a core may answer, after which it is enabled or not; no event is pending.
    pub fn soft_reset(&mut self, enable: bool) {
        self.write("control", 2 | u32::from(enable));
        if let Some(report) = self.reset_report {
            self.line(&format!("E {report:08x}"));
            self.answered_resets += 1;
        }
        self.write("pending", !0);
    }

    fn irq(&mut self, level: bool) {
        self.line(&format!("Q {}", u32::from(level)));
    }

    /// A word for the core.
    pub fn word(&mut self, word: u64, last: bool) {
        self.line(&format!("I {word:016x} {}", u32::from(last)));
    }

    /// A word that must come.
    pub fn answer(&mut self, word: u64, mask: u64, last: bool) {
        self.line(&format!("O {word:016x} {mask:016x} {}", u32::from(last)));
    }

    /// The value of every register after reset, but for the clocks, and the receive queue, which is empty.
    fn as_after_reset(&mut self) {
        for register in self.list.clone() {
            match register.name {
                "receive_low" | "receive_high" | "clocks_low" => {}
                name if register.access.reads() => self.reads(name, register.reset),
                _ => {}
            }
        }
    }

    /// Everything that a core need not be there for: values after reset, accesses that are refused and without effect, a full
    /// queue, interrupts of levels. The core is not enabled; at the end it is as after a soft reset.
    pub fn without_core(&mut self) {
        self.as_after_reset();
        self.irq(false);
        self.illegal();
        self.full();
        self.levels();
    }

    fn illegal(&mut self) {
        for register in self.list.clone() {
            for low in 1..4 {
                self.refuses_read(register.offset + low, "unaligned");
            }
            self.refuses_write(register.offset + 2, 3, "unaligned");
            match register.access {
                Access::Read => self.refuses_write(register.offset, WHOLE, "direction"),
                Access::Write => self.refuses_read(register.offset, "direction"),
                Access::ReadWrite | Access::Clear => {}
            }
            self.refuses_write(register.offset, register.offset / 4 % WHOLE, "partial");
        }
        for at in [NOWHERE, 0x6c, 0xffc] {
            self.refuses_read(at, "unknown");
            self.refuses_write(at, 1, "unknown");
        }
        let control = self.at("control");
        (0..WHOLE).for_each(|strobes| self.refuses_write(control, strobes, "partial"));
        for name in ["receive_low", "receive_high"] {
            let at = self.at(name);
            self.refuses_read(at, "empty");
        }
        // None had an effect but to be counted.
        self.reads("pending", TRANSMIT | REFUSED);
        self.write("pending", REFUSED);
        for register in self.list.clone() {
            let name = register.name;
            if register.access.reads() && !["refusal", "receive_low", "receive_high", "clocks_low"].contains(&name) {
                self.reads(name, register.reset);
            }
        }
    }

    /// Words that are not taken fill the queue; one more is refused.
    fn full(&mut self) {
        for i in 0..PLACES {
            // No packet begins as a query does, which would be counted.
            self.write("transmit_low", i << 8);
            self.write(if i % 7 == 6 { "transmit_last" } else { "transmit_high" }, !i);
            self.reads("status", i + 1);
        }
        for name in ["transmit_high", "transmit_last"] {
            let at = self.at(name);
            self.refuses_write(at, WHOLE, "full");
        }
        self.reads("status", PLACES);
        self.reads("packets_in", PLACES / 7);
        self.write("transmit_low", 5);
        // A soft reset empties it, and reads as 0.
        self.soft_reset(false);
        self.reads("control", 0);
        self.reads("status", 0);
    }

    /// The interrupts of levels stay pending while their condition holds; the mask alone decides on the pin.
    fn levels(&mut self) {
        self.reads("pending", TRANSMIT);
        self.write("mask", TRANSMIT);
        self.reads("mask", TRANSMIT);
        self.irq(true);
        self.write("pending", TRANSMIT);
        self.reads("pending", TRANSMIT);
        self.irq(true);
        self.write("mask", 0);
        self.irq(false);
        self.write("mask", u32::MAX);
        self.reads("mask", ANSWER | RECEIVE | TRANSMIT | FAULT | REFUSED);
        self.irq(true);
        // Above the threshold it can be cleared.
        self.write("thresholds", 2 | 3 << 8);
        self.reads("thresholds", 2 | 3 << 8);
        for i in 0..3 {
            self.write("pending", u32::MAX);
            self.reads("pending", TRANSMIT);
            self.write("transmit_high", i);
        }
        self.reads("pending", TRANSMIT);
        self.write("pending", !TRANSMIT);
        self.reads("pending", TRANSMIT);
        self.write("pending", TRANSMIT);
        self.reads("pending", 0);
        self.irq(false);
        self.soft_reset(false);
        self.reads("pending", TRANSMIT);
        self.irq(true);
        self.write("thresholds", u32::MAX);
        self.reads("thresholds", 0x7f | 0x7f << 8);
        self.write("mask", 0);
        self.write("thresholds", 1 << 8);
        self.irq(false);
    }

    /// Interrupts of the events of a packet with answers, in several orders. `send` writes a packet; of `answers` words with that
    /// content, its report says *malformed*.
    pub fn events(&mut self, send: &dyn Fn(&mut Self), take: &dyn Fn(&mut Self)) {
        // The mask before the event.
        self.write("pending", !0);
        self.write("mask", ANSWER);
        self.irq(false);
        send(self);
        self.pause(400);
        self.irq(true);
        self.read("pending", ANSWER | RECEIVE | FAULT, ANSWER | RECEIVE | FAULT | REFUSED);
        self.write("pending", 0);
        self.irq(true);
        self.write("pending", ANSWER);
        self.irq(false);
        // What has come is still there: a level, which no clear takes away.
        self.write("pending", RECEIVE);
        self.read("pending", RECEIVE | FAULT, ANSWER | RECEIVE | FAULT | REFUSED);
        take(self);
        self.write("pending", RECEIVE);
        self.read("pending", FAULT, ANSWER | RECEIVE | FAULT | REFUSED);
        // The event before the mask; two at once, cleared one by one; the pin falls with the last.
        self.write("mask", 0);
        send(self);
        self.pause(400);
        self.irq(false);
        self.write("mask", ANSWER | FAULT);
        self.irq(true);
        self.write("pending", FAULT);
        self.irq(true);
        self.read("pending", ANSWER, ANSWER | FAULT);
        self.write("pending", ANSWER);
        self.irq(false);
        // The other order, and a refused access as the third.
        send(self);
        self.pause(400);
        self.line(&format!("R {NOWHERE:03x} 00000000 ffffffff 2"));
        self.refused(NOWHERE, "unknown");
        self.write("mask", ANSWER | FAULT | REFUSED);
        self.write("pending", ANSWER);
        self.irq(true);
        self.write("pending", REFUSED);
        self.irq(true);
        self.write("mask", ANSWER | REFUSED);
        self.irq(false);
        self.write("mask", ANSWER | FAULT | REFUSED);
        self.irq(true);
        self.write("pending", FAULT);
        self.irq(false);
        take(self);
        take(self);
        // Masked all the time.
        self.write("mask", 0);
        send(self);
        self.pause(400);
        self.irq(false);
        self.read("pending", ANSWER | FAULT, ANSWER | FAULT);
        take(self);
        self.write("pending", !0);
    }

    /// Everything as after power-up.
    pub fn reset(&mut self) {
        self.line("Z");
        (self.refused, self.answered_resets) = (0, 0);
        self.as_after_reset();
        self.irq(false);
    }
}

/// Packets for the unit behind registers, with the answers of the reference model.
struct Packets<'a> {
    script: Script,
    format: &'a StreamFormat,
    unit: StandIn,
}

impl Packets<'_> {
    fn header(&self, kind: PacketKind) -> Vec<StreamWord> {
        vec![u128::from(self.format.header(kind)).into()]
    }

    /// A packet of pairs, tagged one after the other.
    fn pairs(&self, pairs: &[Pair]) -> Vec<StreamWord> {
        let records = (1..).zip(pairs).flat_map(|(tag, pair)| {
            let tag = tag & u64::MAX.checked_shr(64 - self.format.tag_width).unwrap_or(0);
            self.format.pair_record(tag, pair)
        });
        self.header(PacketKind::Pairs).into_iter().chain(records).collect()
    }

    fn pose(&self, pose: &Pose) -> Vec<StreamWord> {
        [self.header(PacketKind::Pose), self.format.pose_record(pose)].concat()
    }

    fn send(&mut self, words: &[StreamWord]) -> Vec<Transfer> {
        let transfers = packet(words.to_vec());
        transfers.iter().for_each(|transfer| self.script.word(transfer.data.low() as u64, transfer.last));
        self.unit.answer(&transfers)
    }

    fn take(&mut self, answers: &[Transfer]) {
        answers.iter().for_each(|answer| self.script.answer(answer.data.low() as u64, u64::MAX, answer.last));
    }

    fn exchange(&mut self, words: &[StreamWord]) {
        let answers = self.send(words);
        self.take(&answers);
    }
}

/// The file for the unit.
pub fn unit(p: &Params, format: &StreamFormat, options: &str) -> String {
    let script = Script::new(Behind::Unit, options, None);
    let unit = StandIn::new(p, format.width).expect("parameters of a design are in their ranges");
    let mut all = Packets { script, format, unit };
    let segments = Stimulus::random(p, 96, 3).segments;
    let pairs: Vec<Pair> = segments.iter().flat_map(|(_, pairs)| pairs).copied().collect();
    let pose = segments[1].0;
    all.script.without_core();
    all.script.write("control", 1);
    all.script.reads("control", 1);
    // Pairs, a pose, pairs under it, what is malformed in every way that whole words allow.
    let few = all.pairs(&pairs[..5]);
    all.exchange(&few);
    let (mut count, mut packets) = (5, 1);
    if format.has_pose() {
        let words = all.pose(&pose);
        all.exchange(&words);
        all.script.reads("last_report", 1);
        let longer = [words.clone(), words[..2].to_vec()].concat();
        all.exchange(&longer);
        all.script.reads("last_report", 0x8d);
        packets += 2;
    }
    let more = all.pairs(&pairs[5..16]);
    all.exchange(&more);
    all.exchange(&[1u128.into()]);
    all.script.reads("last_report", 0x85);
    let short = few[..few.len() - 1].to_vec();
    all.exchange(&short);
    all.script.reads("last_report", 0x89);
    count += 11 + 4;
    packets += 3;
    all.script.reads("pairs", count);
    all.script.reads("packets_out", packets);
    // The queue of the tests without a core took some, too.
    all.script.reads("packets_in", PLACES / 7 + packets);
    let unknown = [1u128.into()];
    let report = all.unit.answer(&packet(unknown.to_vec()));
    let send = |script: &mut Script| script.word(1, true);
    let take = |script: &mut Script| {
        report.iter().for_each(|answer| script.answer(answer.data.low() as u64, u64::MAX, answer.last));
    };
    all.script.events(&send, &take);
    // More answers than the receive queue has places wait in the unit, and none is lost.
    let many = all.pairs(&pairs[16..16 + PLACES as usize + 6]);
    let answers = all.send(&many);
    all.script.pause(2600);
    all.script.read("status", PLACES << 8, 0x7f << 8);
    all.take(&answers);
    all.script.reads("status", 0);
    resets(&mut all, &pairs, &pose);
    all.script.text
}

/// Soft resets at several places of packets, and a reset of everything.
fn resets(all: &mut Packets<'_>, pairs: &[Pair], pose: &Pose) {
    let few = all.pairs(&pairs[..4]);
    let record = all.format.record_words(PacketKind::Pairs) as usize;
    for words in [1, 2, record, record + 1, 2 * record + 2] {
        if all.format.has_pose() {
            let pose = all.pose(pose);
            all.exchange(&pose);
        }
        // A part of a packet, of which the unit has some words and perhaps pairs.
        few[..words.min(few.len() - 1)].iter().for_each(|word| all.script.word(word.low() as u64, false));
        if words == 1 {
            all.script.pause(100);
            all.script.read("status", 1 << 17, 1 << 17);
        }
        all.script.soft_reset(true);
        all.script.reads("status", 0);
        all.unit.reset();
        all.exchange(&few);
    }
    // While answers are on their way, and while some wait.
    for clocks in [0, 20, 60, 600] {
        all.send(&few);
        all.script.pause(clocks);
        all.script.soft_reset(true);
        all.unit.reset();
        all.exchange(&few);
    }
    // Words wait while the core is not enabled.
    all.script.write("control", 0);
    let two = all.pairs(&pairs[..2]);
    let answers = all.send(&two);
    all.script.pause(200);
    all.script.read("status", two.len() as u32, 0x7f7f);
    all.script.write("control", 1);
    all.take(&answers);
    all.send(&few);
    all.script.reset();
    all.unit.reset();
    all.script.write("control", 1);
    all.exchange(&few);
    all.script.reads("pairs", 4);
}
