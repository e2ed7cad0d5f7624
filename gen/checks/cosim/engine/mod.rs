//! The collision engine simulated: in Verilator, the printed VHDL as a netlist, compiled, beside a model of memory, which is fast
//! enough for whole scenes; in GHDL, the printed VHDL under its testbench, for samples; and its two units alone in the built-in
//! simulator, with what queries give them.

pub mod data_path;
mod ghdl;
mod measure;

pub use measure::{Measure, check};

use super::external::{self, call, file_error};
use super::{CosimError, Simulator, verilator};
use crate::synth::verilog;
use askama::Template;
use efsat_engine::artefact::{EngineDesign, TESTBENCH, engine_files};
use efsat_engine::host::{Image, memory};
use efsat_engine::model::{ByNumber, Model, Query};
use efsat_engine::params::Memory;
use efsat_engine::words::{Command, EngineAnswer, EngineReport};
use efsat_hardware::tools::Tool;
use efsat_unit::artefact::testbench::RESET_CLOCKS;
use efsat_unit::artefact::{Prefix, Scratch, origin};
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// What queries come to as packets of pairs by number: the pairs that a traversal finds.
pub(super) fn by_number(design: &EngineDesign, memory: &[u64], queries: &[Query]) -> Vec<ByNumber> {
    let model = Model::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let packet = |query: &Query| {
        let (_, visits) = model.visits(memory, &query.words(model.format()));
        ByNumber::of_query(query, visits.numbers)
    };
    queries.par_iter().map(packet).collect()
}

/// The Verilog of the engine.
const NETLIST: &str = "efsat_engine.v";

/// The memory behind AXI, and the pace of everything around the engine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Clocks from an address to its first word. There is one channel, which answers in order, one word per clock.
    pub latency: RangeInclusive<u32>,
    /// Random gaps: words into the stream, answers taken, addresses taken, words of memory.
    pub gaps: bool,
    /// Chooses latencies and gaps.
    pub seed: u32,
    /// Clocks without a transfer of the stream before it is given up.
    pub patience: u32,
}

impl Default for Channel {
    /// That of the figures in the documentation: 32 clocks, no gaps. A query may work for long without an answer; an expansion or
    /// a pair takes some hundred clocks at most.
    fn default() -> Self {
        Self { latency: 32..=32, gaps: false, seed: 1, patience: 100_000_000 }
    }
}

/// What is done to an engine, one step after the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A packet is sent.
    Packet(Vec<u64>),
    /// So many clocks pass before the next step.
    Pause(u32),
    /// A soft reset by the port, one clock long; also between the words of a packet that [`Step::Begin`] has sent.
    SoftReset,
    /// Words of a packet that goes on with the next step.
    Begin(Vec<u64>),
    /// All answers come before the next step.
    Wait,
    /// A copy of the engine and of memory, as they are in this clock, takes these steps to their end, and its answers come before
    /// those of the engine itself, which goes on with the next step a clock later.
    Apart(Vec<Step>),
}

impl Step {
    /// Numbers for the program that Verilator has made: kind, length, words.
    fn words(&self) -> Vec<u64> {
        let (kind, words) = match self {
            Self::Packet(words) => (0, words.clone()),
            Self::Pause(clocks) => (1, vec![u64::from(*clocks)]),
            Self::SoftReset => (2, vec![]),
            Self::Begin(words) => (3, words.clone()),
            Self::Wait => (4, vec![]),
            Self::Apart(steps) => {
                let inner = steps.iter().flat_map(Self::words);
                return [5, 1, steps.len() as u64].into_iter().chain(inner).collect();
            }
        };
        [vec![kind, words.len() as u64], words].concat()
    }
}

/// A packet that the engine has answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    /// Its words.
    pub words: Vec<u64>,
    /// The clock in which the last of them was taken, counted from the end of reset.
    pub clock: u64,
}

/// What the engine has answered to a query.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reply {
    /// Pairs of triangles, in no order that another engine has to keep.
    pub answers: Vec<EngineAnswer>,
    /// The report.
    pub report: EngineReport,
    /// Clocks since the answer before, from last word to last word: what the query costs in a row of queries.
    pub clocks: u64,
}

impl Reply {
    /// Reads a packet that follows one which ended at clock `before`, none if it is no list of answers with a report behind.
    pub fn of(packet: &Packet, before: u64) -> Option<Self> {
        let (answers, report) = packet.words.split_last_chunk()?;
        Some(Self {
            answers: answers.iter().map(|&word| EngineAnswer::of(word)).collect::<Option<_>>()?,
            report: EngineReport::of(report)?,
            clocks: packet.clock - before,
        })
    }
}

#[derive(Template)]
#[template(path = "engine/efsat_engine_tb.cpp", escape = "none")]
struct Bench {
    header: Vec<String>,
    top: &'static str,
    axi: bool,
    ports: Vec<String>,
    port_signals: [&'static str; 13],
    word_bytes: u32,
    word_size: u32,
    by_number: bool,
    query_header: String,
    stop_header: String,
    reset_header: String,
    reset_clocks: usize,
    arguments: u32,
}

impl Bench {
    fn of(design: &EngineDesign) -> Self {
        let axi = design.params.memory == Memory::Axi;
        let word_bytes = design.params.memory_width / 8;
        let header = |command| format!("{:08x}", design.format.header(command) as u32);
        Self {
            header: origin(),
            top: design.top(),
            axi,
            ports: design.read_ports(),
            port_signals: [
                "araddr", "arlen", "arsize", "arburst", "arcache", "arprot", "arvalid", "arready", "rdata", "rresp",
                "rlast", "rvalid", "rready",
            ],
            word_bytes,
            word_size: word_bytes.ilog2(),
            by_number: design.by_number,
            query_header: header(if design.by_number { Command::Numbers } else { Command::Query }),
            stop_header: header(Command::Stop),
            reset_header: header(Command::Reset),
            reset_clocks: RESET_CLOCKS,
            arguments: if axi { 9 } else { 7 },
        }
    }
}

/// What runs an engine.
enum Runner {
    /// The program that Verilator has made.
    Verilator(PathBuf),
    /// GHDL, which has elaborated the testbench.
    Ghdl(Tool),
}

/// The folder of an engine as tools need it that run in it.
fn folder(keep: Option<&Path>) -> Result<(PathBuf, Option<Scratch>), CosimError> {
    let (dir, scratch) = external::folder(keep)?;
    Ok((dir.canonicalize().map_err(file_error(&dir))?, scratch))
}

fn failed(message: impl Into<String>) -> CosimError {
    CosimError::Failed { tool: TESTBENCH.to_owned(), message: message.into() }
}

/// An engine that is compiled and can run.
pub struct Machine {
    /// The simulator that runs it, in words.
    pub simulator: String,
    design: EngineDesign,
    runner: Runner,
    dir: PathBuf,
    /// Deletes the folder at the end, if it is nobody's.
    _scratch: Option<Scratch>,
}

impl Machine {
    /// Compiles an engine with Verilator, in a folder that is kept if one is given. This takes a minute or more.
    ///
    /// # Errors
    /// What is missing, or what a tool said.
    pub fn build(design: EngineDesign, keep: Option<&Path>) -> Result<Self, CosimError> {
        let files = engine_files(&design, &Prefix::default(), &design.command_line())?;
        Self::of(design, &files, keep)
    }

    /// As [`Machine::build`], of VHDL that the engine was printed as, and that may have been changed since.
    ///
    /// # Errors
    /// As there.
    pub fn of(design: EngineDesign, files: &[(String, String)], keep: Option<&Path>) -> Result<Self, CosimError> {
        let verilator = verilator::find()?;
        let (dir, scratch) = folder(keep)?;
        let (top, write) = (design.top(), |name: &str, text: &str| external::write_file(&dir, name, text));
        write(NETLIST, &verilog::from_vhdl(files, top, &dir)?)?;
        let bench = format!("{TESTBENCH}.cpp");
        write(&bench, &Bench::of(&design).render().expect("the template renders"))?;
        let program = verilator::compile(&verilator, &dir, top, NETLIST, &bench, "-MAKEFLAGS OPT_FAST=-O1")?;
        let runner = Runner::Verilator(program);
        Ok(Self { simulator: verilator.version, design, runner, dir, _scratch: scratch })
    }

    /// Analyses an engine and its testbench with GHDL, in a folder that is kept if one is given.
    ///
    /// # Errors
    /// What is missing, or what GHDL said.
    pub fn in_ghdl(design: EngineDesign, keep: Option<&Path>) -> Result<Self, CosimError> {
        let command = external::command(Simulator::Ghdl, false)?;
        let (dir, scratch) = folder(keep)?;
        ghdl::build(&design, &command, &dir)?;
        let simulator = external::version(&command);
        Ok(Self { simulator, design, runner: Runner::Ghdl(command), dir, _scratch: scratch })
    }

    /// The engine.
    pub fn design(&self) -> &EngineDesign {
        &self.design
    }

    /// From reset on: sends packets one behind the other, and returns the answer to each of them but stops, in order.
    /// `memory` is what is behind AXI, from address 0 on.
    ///
    /// # Errors
    /// A breach of the protocols of the stream or of AXI, a read outside the trees of the queries, or no answer.
    pub fn exchange(&self, memory: &[u64], packets: &[Vec<u64>], channel: &Channel) -> Result<Vec<Packet>, CosimError> {
        let program = match &self.runner {
            Runner::Verilator(program) => program,
            Runner::Ghdl(command) => {
                let answers = ghdl::exchange(&self.design, command, &self.dir, memory, packets, channel)?;
                return self.counted(answers, packets);
            }
        };
        let steps: Vec<Step> = packets.iter().cloned().map(Step::Packet).collect();
        self.counted(self.played(program, memory, &steps, channel)?, packets)
    }

    /// As [`Machine::exchange`], in Verilator, of any steps. What was not answered at a soft reset has no answer but its report, and
    /// words before that in its packet.
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// If the engine does not run in Verilator.
    pub fn play(&self, memory: &[u64], steps: &[Step], channel: &Channel) -> Result<Vec<Packet>, CosimError> {
        match &self.runner {
            Runner::Verilator(program) => self.played(program, memory, steps, channel),
            Runner::Ghdl(_) => panic!("expected Verilator"),
        }
    }

    fn played(
        &self,
        program: &Path,
        memory: &[u64],
        steps: &[Step],
        channel: &Channel,
    ) -> Result<Vec<Packet>, CosimError> {
        let io = Scratch::new().map_err(file_error(&std::env::temp_dir()))?;
        let [memory_file, packet_file, answer_file] =
            ["memory.bin", "packets.bin", "answers.bin"].map(|name| io.path().join(name));
        let write = |path: &Path, words: &mut dyn Iterator<Item = u64>| {
            let bytes: Vec<u8> = words.flat_map(u64::to_le_bytes).collect();
            std::fs::write(path, bytes).map_err(file_error(path))
        };
        write(&memory_file, &mut memory.iter().copied())?;
        write(&packet_file, &mut steps.iter().flat_map(Step::words))?;
        let mut arguments: Vec<String> =
            [&memory_file, &packet_file, &answer_file].map(|path| path.to_string_lossy().into_owned()).into();
        if self.design.params.memory == Memory::Axi {
            arguments.extend([channel.latency.start(), channel.latency.end()].map(ToString::to_string));
        }
        arguments.extend([u32::from(channel.gaps), channel.seed, channel.patience].map(|number| number.to_string()));
        let said = call(&self.dir, program, &arguments, false)?;
        if !said.trim_end().ends_with(" clocks") {
            return Err(failed(said.trim().trim_start_matches("error: ")));
        }
        let bytes = std::fs::read(&answer_file).map_err(file_error(&answer_file))?;
        let mut words = bytes.chunks_exact(8).map(|chunk| u64::from_le_bytes(chunk.try_into().expect("eight bytes")));
        let mut answers = vec![];
        while let (Some(clock), Some(length)) = (words.next(), words.next()) {
            answers.push(Packet { clock, words: words.by_ref().take(length as usize).collect() });
        }
        Ok(answers)
    }

    /// Answers, if there is one for every packet but stops.
    fn counted(&self, answers: Vec<Packet>, packets: &[Vec<u64>]) -> Result<Vec<Packet>, CosimError> {
        let is_stop = |packet: &Vec<u64>| packet.len() == 1 && self.design.format.is_order(Command::Stop, packet[0]);
        let stops = packets.iter().filter(|packet| is_stop(packet)).count();
        match answers.len() + stops == packets.len() {
            true => Ok(answers),
            false => Err(failed(format!("{} answers to {} packets", answers.len(), packets.len()))),
        }
    }

    /// Puts images into memory and answers queries about them; their sides are those of [`memory`]. Queries of several engines have
    /// numbers of their own.
    ///
    /// # Errors
    /// As [`Machine::exchange`], and images that do not fit into block RAM.
    pub fn run(&self, images: &[&Image], queries: &[Query], channel: &Channel) -> Result<Vec<Reply>, CosimError> {
        let format = &self.design.format;
        let layout = self.design.layout(images).map_err(|e| CosimError::Design(e.into()))?;
        let (words, sides) = memory(images);
        let numbers = self.design.by_number.then(|| by_number(&self.design, &words, queries));
        let words = queries.iter().enumerate().map(|(i, query)| {
            let query = layout.moved(query, &sides);
            match &numbers {
                None => query.words(format),
                Some(packets) => ByNumber { sides: query.sides, ..packets[i].clone() }.words(format),
            }
        });
        let packets: Vec<Vec<u64>> = layout.loads.iter().cloned().chain(words).collect();
        let replies = self.exchange(&layout.memory, &packets, channel)?;
        let (loads, replies) = replies.split_at(layout.loads.len());
        let mut before = loads.last().map_or(0, |packet| packet.clock);
        let read = |packet: &Packet| {
            let reply = Reply::of(packet, std::mem::replace(&mut before, packet.clock));
            reply.ok_or_else(|| failed(format!("no answer with a report: {:x?}", packet.words)))
        };
        let replies: Vec<Reply> = replies.iter().map(read).collect::<Result<_, _>>()?;
        if self.design.params.engines == 1 {
            return Ok(replies);
        }
        // They come in any order, each with the number of its query.
        let mut by_number: HashMap<u32, Reply> =
            replies.into_iter().map(|reply| (reply.report.number, reply)).collect();
        let mut of = |number| by_number.remove(&number).ok_or_else(|| failed(format!("no answer to query {number}")));
        queries.iter().map(|query| of(query.number)).collect()
    }
}
