//! The reference models of units and engines, and their words.

use super::arrays::{array, pairs, poses, rows, value_error};
use clap::Parser;
use efsat_engine::artefact::EngineDesign;
use efsat_engine::driver::{Objects, QueryOptions, StandIn as EngineStandIn};
use efsat_engine::params::{EngineParams, Memory};
use efsat_geometry::Points;
use efsat_geometry::mesh::Mesh;
use efsat_unit::golden::Reason;
use efsat_unit::host::driver::{Driver, StandIn, Transfer, packet};
use efsat_unit::host::{Host, Reference, loose_pairs};
use efsat_unit::pair::{Outcome, Pair, Verdict};
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, Params};
use efsat_unit::parts::registers::{Behind, Field, Register, hash, registers};
use efsat_unit::words::{StreamWidth, StreamWord};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;

/// Options as the command line spells them.
#[derive(Parser)]
#[command(name = "efsat", disable_help_flag = true)]
struct Options<P: clap::Args> {
    #[command(flatten)]
    params: P,
}

fn read<P: clap::Args>(words: Vec<String>) -> PyResult<P> {
    let read = Options::<P>::try_parse_from(["efsat".to_owned()].into_iter().chain(words));
    // The first line says what was found and expected.
    let line =
        |e: clap::Error| e.to_string().lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned();
    Ok(read.map_err(|e| value_error(line(e)))?.params)
}

fn unit(words: Vec<String>) -> PyResult<Params> {
    let given: Vec<String> = words
        .iter()
        .filter_map(|word| Some(word.strip_prefix("--")?.split('=').next()?.to_owned()))
        .filter(|option| option != "method")
        .collect();
    let like_paper = words.iter().any(|word| word == "--like-paper");
    let params: Params = read(words)?;
    if like_paper && params.method != Method::Axes {
        return Err(value_error(format!(
            "--like-paper with --method {}: expected --method axes",
            params.method.name()
        )));
    }
    let typed = params.every_option().into_iter().filter(|(option, _)| given.iter().any(|name| name == option));
    params.has(typed).and_then(|()| params.validate()).map_err(value_error)?;
    Ok(params)
}

/// Name, address, access, value after reset, and fields with their lowest bits and sizes.
type Registers = Vec<(&'static str, u32, &'static str, u32, Vec<(&'static str, u32, u32)>)>;

/// The registers of a core whose options are all in the command line.
fn register_list(behind: Behind, command_line: &str) -> Registers {
    let fields = |list: Vec<Field>| list.into_iter().map(|Field { name, low, bits, .. }| (name, low, bits)).collect();
    registers(behind, hash(command_line))
        .into_iter()
        .map(|Register { name, offset, access, reset, fields: list, .. }| {
            (name, offset, access.name(), reset, fields(list))
        })
        .collect()
}

/// Addresses and values of the accesses of two halves for each word, the higher one of the last word at a place of its own.
fn accesses(words: &[u64], names: [&str; 3]) -> Vec<(u32, u32)> {
    let list = registers(Behind::Unit, 0);
    let at = |name| list.iter().find(|register| register.name == name).map_or(0, |register| register.offset);
    let [low, high, last] = names.map(at);
    let of_word = |(place, word): (usize, &u64)| {
        let high = if place + 1 < words.len() { high } else { last };
        [(low, *word as u32), (high, (*word >> 32) as u32)]
    };
    words.iter().enumerate().flat_map(of_word).collect()
}

/// What is written for a packet.
fn writes(words: &[u64]) -> Vec<(u32, u32)> {
    accesses(words, ["transmit_low", "transmit_high", "transmit_last"])
}

/// What is read of an answer.
fn reads(words: &[u64]) -> Vec<(u32, u32)> {
    accesses(words, ["receive_low", "receive_high", "receive_high"])
}

/// Words of so many bytes, little-endian.
fn short_words(packet: &[u8], bytes: usize) -> PyResult<Vec<u64>> {
    if packet.is_empty() || !packet.len().is_multiple_of(bytes) {
        let found = packet.len();
        return Err(value_error(format!("a packet of {found} bytes: expected a multiple of {bytes}")));
    }
    let word = |bytes: &[u8]| bytes.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
    Ok(packet.chunks(bytes).map(word).collect())
}

/// Pairs that a thread takes at a time.
const SHARE: usize = 1 << 8;

/// The unit of some options.
#[pyclass(frozen, module = "efsat")]
pub struct Design {
    reference: Reference,
}

/// Verdict, flags of separated and of overlapping axes, whether a number is outside its range, and whether the host has decided.
type Answers<'py> = (
    Bound<'py, PyArray1<u8>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);

/// Numbers, and whether each is sticky.
type Numbers<'py> = (Bound<'py, PyArray2<i64>>, Bound<'py, PyArray2<bool>>);

impl Design {
    fn hosts(&self, points: &[Points]) -> PyResult<Vec<Host>> {
        let some = |(share, points): (usize, &[Points])| {
            loose_pairs(points, &self.reference.params).map_err(|e| e.of_pair(share * SHARE))
        };
        let all: Result<Vec<Vec<Host>>, efsat_geometry::NotFinite> =
            points.par_chunks(SHARE).enumerate().map(some).collect();
        Ok(all.map_err(value_error)?.concat())
    }
}

#[pymethods]
impl Design {
    #[new]
    fn new(words: Vec<String>) -> PyResult<Self> {
        Ok(Self { reference: Reference::new(&unit(words)?) })
    }

    /// The command line of the design.
    #[getter]
    fn command_line(&self) -> String {
        self.reference.params.command_line()
    }

    /// All options with their values.
    #[getter]
    fn options(&self) -> Vec<(&'static str, String)> {
        self.reference.params.every_option()
    }

    /// How many axes have flags; none of other methods.
    #[getter]
    fn axes(&self) -> usize {
        let params = &self.reference.params;
        if params.method == Method::Axes { params.axes.count() } else { 0 }
    }

    fn classify<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Answers<'py>> {
        let points = pairs(&points)?;
        let Reference { golden, identity, .. } = &self.reference;
        let one = |host: &Host| match host {
            Host::Unit(pair) => (golden.outcome(identity, pair), false),
            Host::Decided(verdict) => {
                (Outcome { verdict: *verdict, separated: 0, overlapping: 0, outside: false }, true)
            }
        };
        let found: Vec<(Outcome, bool)> =
            py.detach(|| Ok::<_, PyErr>(self.hosts(points)?.par_iter().map(one).collect()))?;
        Ok((
            PyArray1::from_iter(py, found.iter().map(|(outcome, _)| outcome.verdict as u8)),
            PyArray1::from_iter(py, found.iter().map(|(outcome, _)| outcome.separated)),
            PyArray1::from_iter(py, found.iter().map(|(outcome, _)| outcome.overlapping)),
            PyArray1::from_iter(py, found.iter().map(|(outcome, _)| outcome.outside)),
            PyArray1::from_iter(py, found.iter().map(|(_, by_host)| *by_host)),
        ))
    }

    /// For each pair why it is left open, the gap and its error; none of what is decided.
    #[allow(clippy::type_complexity, reason = "three columns of a table")]
    fn reasons(
        &self,
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<Option<(String, Option<f64>, Option<f64>)>>> {
        let points = pairs(&points)?;
        let Reference { golden, identity, .. } = &self.reference;
        let one = |host: &Host| {
            let Reason { words, margin } = host.reason(golden, identity)?;
            Some((words, margin.map(|margin| margin.gap), margin.map(|margin| margin.error)))
        };
        py.detach(|| Ok(self.hosts(points)?.par_iter().map(one).collect()))
    }

    /// Names and values of everything the unit computes for a pair; none if the host decides it.
    fn trace(&self, points: PyReadonlyArray2<'_, f64>) -> PyResult<Vec<(String, i128, i128)>> {
        let Reference { golden, identity, .. } = &self.reference;
        Ok(match self.hosts(pairs(&points)?)?.first() {
            Some(Host::Unit(pair)) => {
                golden.trace(identity, pair).into_iter().map(|(name, value)| (name, value.lo, value.hi)).collect()
            }
            _ => vec![],
        })
    }

    /// The numbers at the ports of the unit, n by 18, and the sticky bit of each; zeros for pairs that the host decides.
    fn numbers<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Numbers<'py>> {
        let pair = |host: Host| match host {
            Host::Unit(pair) => pair,
            Host::Decided(_) => Pair::default(),
        };
        let all: Vec<Pair> = self.hosts(pairs(&points)?)?.into_iter().map(pair).collect();
        let inputs = || all.iter().flat_map(|pair| pair.a.iter().chain(&pair.b).flatten());
        Ok((
            array(py, inputs().map(|input| input.lo).collect(), 18)?,
            array(py, inputs().map(|input| input.sticky).collect(), 18)?,
        ))
    }

    /// Packets for the stream: little-endian words, one text of bytes each.
    fn packets<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        width: u32,
    ) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let driver = self.driver(width)?;
        let job = driver.loose(pairs(&points)?).map_err(value_error)?;
        let packets = job.transfers().split_inclusive(|transfer| transfer.last);
        Ok(packets.map(|packet| PyBytes::new(py, &driver.bytes(packet))).collect())
    }

    /// The packets that the unit answers with to packets.
    fn answer<'py>(&self, py: Python<'py>, packets: Vec<Vec<u8>>, width: u32) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let size = stream_width(width)?.bits() as usize / 8;
        let mut unit = StandIn::new(&self.reference.params, stream_width(width)?).map_err(value_error)?;
        let bytes = self.answer_bytes(width)?;
        let one = |given: &Vec<u8>| {
            if given.is_empty() || !given.len().is_multiple_of(size) {
                let found = given.len();
                return Err(PyValueError::new_err(format!("a packet of {found} bytes: expected a multiple of {size}")));
            }
            let answers = unit.answer(&packet(given.chunks(size).map(word).collect()));
            let flat: Vec<u8> = answers.iter().flat_map(|answer| answer.data.bytes().take(bytes)).collect();
            Ok(PyBytes::new(py, &flat))
        };
        packets.iter().map(one).collect()
    }

    /// The exact answers of pairs, from the packets that came back.
    fn finish<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        answers: Vec<Vec<u8>>,
        width: u32,
    ) -> PyResult<Bound<'py, PyArray1<u8>>> {
        let driver = self.driver(width)?;
        let read = |bytes: &Vec<u8>| driver.packet(bytes).map_err(value_error);
        let words: Vec<Transfer> = answers.iter().map(read).collect::<PyResult<Vec<_>>>()?.concat();
        let job = driver.loose(pairs(&points)?).map_err(value_error)?;
        let found = job.finish(&words).map_err(value_error)?;
        Ok(PyArray1::from_vec(py, found.answers.into_iter().map(|exact| exact as u8).collect()))
    }

    /// The registers around the unit's stream.
    fn registers(&self) -> Registers {
        register_list(Behind::Unit, &self.reference.params.command_line())
    }

    /// The writes to registers that send a packet.
    fn writes(&self, packet: Vec<u8>) -> PyResult<Vec<(u32, u32)>> {
        Ok(writes(&short_words(&packet, 8)?))
    }

    /// The reads of registers that get an answer, and what they give.
    fn reads(&self, answer: Vec<u8>) -> PyResult<Vec<(u32, u32)>> {
        Ok(reads(&short_words(&answer, self.answer_bytes(64)?)?))
    }
}

impl Design {
    fn answer_bytes(&self, width: u32) -> PyResult<usize> {
        Ok(self.driver(width)?.format().answer_width() as usize / 8)
    }

    fn driver(&self, width: u32) -> PyResult<Driver> {
        Driver::new(&self.reference.params, stream_width(width)?).map_err(value_error)
    }
}

/// A word of little-endian bytes.
fn word(bytes: &[u8]) -> StreamWord {
    let digits: String = bytes.iter().rev().map(|byte| format!("{byte:02x}")).collect();
    StreamWord::from_hex(&digits).expect("digits, and no more than the widest word has")
}

fn stream_width(bits: u32) -> PyResult<StreamWidth> {
    let legal: Vec<&str> = StreamWidth::ALL.iter().map(|width| width.name()).collect();
    let found = StreamWidth::ALL.iter().find(|width| width.bits() == bits);
    found.copied().ok_or_else(|| value_error(format!("width {bits}: expected one of {}", legal.join(", "))))
}

/// The collision engine of some options, with two meshes.
#[pyclass(frozen, module = "efsat")]
pub struct Engine {
    engine: EngineParams,
    unit: Params,
    meshes: [Mesh; 2],
}

#[pymethods]
impl Engine {
    #[new]
    fn new(
        a: (PyReadonlyArray2<'_, f64>, PyReadonlyArray2<'_, u32>),
        b: (PyReadonlyArray2<'_, f64>, PyReadonlyArray2<'_, u32>),
        words: Vec<String>,
        unit_words: Vec<String>,
    ) -> PyResult<Self> {
        let mesh = |(vertices, faces): &(PyReadonlyArray2<'_, f64>, PyReadonlyArray2<'_, u32>)| {
            Mesh::new(rows(vertices)?.iter().copied(), rows(faces)?.iter().copied()).map_err(value_error)
        };
        let made = Self { engine: read(words)?, unit: unit(unit_words)?, meshes: [mesh(&a)?, mesh(&b)?] };
        made.objects()?;
        Ok(made)
    }

    /// What lies in the memory of the engine, as 64-bit words; empty for block RAM.
    fn memory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        Ok(PyArray1::from_vec(py, self.objects()?.memory().to_vec()))
    }

    /// The packets that fill block RAM.
    fn loads(&self) -> PyResult<Vec<Vec<u64>>> {
        Ok(self.objects()?.loads().to_vec())
    }

    /// The registers around the engine.
    fn registers(&self) -> PyResult<Registers> {
        let design = EngineDesign::new(&self.engine, &self.unit).map_err(value_error)?;
        let behind = Behind::Engine { by_number: false, caches: self.engine.memory == Memory::Axi };
        Ok(register_list(behind, &design.command_line()))
    }

    /// The writes to registers that send a packet.
    #[staticmethod]
    fn writes(packet: Vec<u64>) -> Vec<(u32, u32)> {
        writes(&packet)
    }

    /// The reads of registers that get an answer, and what they give.
    #[staticmethod]
    fn reads(answer: Vec<u64>) -> Vec<(u32, u32)> {
        reads(&answer)
    }

    /// For each pose the packet of its query, the packet that the engine answers with, and the pairs that touch, exactly; no packets
    /// for a query that the software answers.
    #[allow(clippy::type_complexity, reason = "three columns of a table")]
    fn queries(
        &self,
        py: Python<'_>,
        at: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<Vec<(Option<Vec<u64>>, Vec<u64>, Vec<[u32; 2]>)>> {
        let at = poses(&at)?;
        py.detach(|| {
            let objects = self.objects()?;
            let mut engine = EngineStandIn::new(&objects).map_err(value_error)?;
            let one = |pose| {
                let job = objects.query([0, 1], pose, QueryOptions::default());
                let packet = job.packet().map(<[u64]>::to_vec);
                let answer = packet.as_ref().map_or(vec![], |packet| engine.packet(packet));
                let found = job.finish(&answer).map_err(value_error)?;
                Ok((packet, answer, found.touching().collect()))
            };
            at.iter().map(one).collect()
        })
    }
}

impl Engine {
    fn objects(&self) -> PyResult<Objects<'_>> {
        let [a, b] = &self.meshes;
        Objects::new(&self.engine, &self.unit, &[a, b]).map_err(value_error)
    }
}

/// Kept so that the numbers of verdicts are those that the module names.
const _: () =
    assert!(Verdict::Separate as u8 == 0 && Verdict::Intersect as u8 == 1 && Verdict::PossiblyIncorrect as u8 == 2);
