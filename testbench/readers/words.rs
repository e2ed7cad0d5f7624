//! Words and images: what the collision engine and the unit behind its stream read, and what comes back from them.

use super::Reader;
use efsat::engine::artefact::samples::{cuboid, hills};
use efsat::engine::driver as engine;
use efsat::engine::driver::{Objects, QueryOptions};
use efsat::engine::host::{Header, Image, Numbers, memory};
use efsat::engine::model::{Model, Query};
use efsat::engine::params::{EngineParams, Memory};
use efsat::engine::words::{Command, EngineReport};
use efsat::host::driver::{self, Driver};
use efsat::mesh::Mesh;
use efsat::number::Upper;
use efsat::params::Params;
use efsat::scene::Pose;
use efsat::words::{PacketKind, StreamWidth};
use nalgebra::{Matrix3, Vector3};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// Two meshes that cross each other.
static MESHES: LazyLock<[Mesh; 2]> = LazyLock::new(|| [hills(2), cuboid(1, 2, 1)]);

/// An engine with its trees in block RAM, and the meshes in it.
static OBJECTS: LazyLock<Objects<'static>> = LazyLock::new(|| {
    let engine =
        EngineParams { memory: Memory::BlockRam, block_lines: 64, triangle_lines: 64, ..EngineParams::default() };
    Objects::new(&engine, &Params::default(), &MESHES.each_ref()).unwrap()
});

static STAND_IN: LazyLock<engine::StandIn> = LazyLock::new(|| engine::StandIn::new(&OBJECTS).unwrap());

static DRIVER: LazyLock<Driver> = LazyLock::new(|| Driver::new(&Params::default(), StreamWidth::default()).unwrap());

/// Pairs for the unit: one that intersects, and one that is separate.
static PAIRS: LazyLock<[[[f64; 3]; 6]; 2]> = LazyLock::new(|| {
    let pair = |z: f64| {
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, z], [1.5, 1.25, z + 2.0], [2.0, 1.5, z + 2.25]]
    };
    [pair(-1.0), pair(1.0)]
});

/// A query, always the same one: its answers name its number.
fn job() -> engine::Job<'static, 'static> {
    static JOB: LazyLock<engine::Job<'static, 'static>> = LazyLock::new(|| {
        let pose = Pose::new(Matrix3::identity(), Vector3::new(0.25, -0.5, -0.5)).unwrap();
        OBJECTS.query([0, 1], &pose, QueryOptions { limit: 5000, ..QueryOptions::default() })
    });
    JOB.clone()
}

fn bytes(words: &[u64]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// The whole words of a file.
fn words(path: &Path) -> Vec<u64> {
    fs::read(path).unwrap().chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().unwrap())).collect()
}

fn image_of(upper: Upper) -> Vec<u8> {
    let unit = Params { upper, ..Params::default() };
    let format = EngineParams::default().format(&unit).unwrap();
    Image::build_first(&MESHES.each_ref(), &format).unwrap().bytes()
}

fn read_image(path: &Path) -> Result<(), String> {
    let image = Image::read(&fs::read(path).unwrap()).map_err(|e| format!("mesh.tree: {e}"))?;
    // Whether it is of this mesh or not.
    let _ = image.verify(&MESHES[0]);
    let Header { format, .. } = *image.header();
    let engine = EngineParams {
        directions: format.directions,
        offset_bits: format.offset_bits,
        origin_bits: format.origin_bits,
        factor_bits: format.factor_bits,
        ..EngineParams::default()
    };
    let unit = Params {
        width: Params::default().width.min(format.transform_width),
        transform_width: format.transform_width,
        int_bits: format.int_bits,
        upper: if format.sticky { Upper::Sticky } else { Upper::Implied },
        ..Params::default()
    };
    let numbers = Numbers::new(&engine, &unit).unwrap();
    let (memory, sides) = memory(&[&image]);
    let turned = [[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]];
    if let Ok(query) = numbers.query([(&image, sides[0]); 2], &turned, &[0.25, 0.0, 0.5]) {
        let query = Query { limit: 5000, ..query };
        let outcome = Model::new(&engine, &unit).unwrap().run(&memory, &query.words(numbers.format()));
        assert!(outcome.report.expansions <= 5000, "{:?}", outcome.report);
    }
    Ok(())
}

/// A packet for the engine, and the query after it.
fn read_packet(path: &Path) -> Result<(), String> {
    let sent = words(path);
    let mut stand_in = STAND_IN.clone();
    let answer = stand_in.packet(&sent);
    let header = |command| sent.first() == Some(&OBJECTS.numbers().format().header(command));
    if sent.len() == 1 && OBJECTS.numbers().format().is_order(Command::Stop, sent[0]) {
        assert!(answer.is_empty());
        return Ok(());
    }
    let report = |words: &[u64]| EngineReport::of(words.last_chunk().expect("a report")).expect("a report");
    let query = job();
    let after = stand_in.packet(query.packet().unwrap());
    report(&after);
    if !header(Command::Load) {
        assert_eq!(after, STAND_IN.clone().packet(query.packet().unwrap()), "nothing but a load changes the memory");
    }
    // The software answers, whatever was loaded.
    query.finish(&after).map_err(|e| format!("packet.words: {e}"))?;
    match report(&answer).reason {
        reason if reason.is_incomplete() => Err(format!("packet.words: {reason:?}")),
        _ => Ok(()),
    }
}

/// What an engine says of a query.
fn read_answer(path: &Path) -> Result<(), String> {
    let contacts = job().finish(&words(path)).map_err(|e| format!("answer.words: {e}"))?;
    assert!(contacts.touching().all(|[a, b]| a < 8 && b < 12));
    Ok(())
}

/// Packets for the unit, with an end wherever a header stands.
fn read_stream(path: &Path) -> Result<(), String> {
    let format = DRIVER.format();
    let sent = words(path);
    let is_header =
        |word: &u64| [PacketKind::Pairs, PacketKind::Pose].iter().any(|&kind| *word == u64::from(format.header(kind)));
    let transfers = sent.iter().enumerate().map(|(at, &word)| driver::Transfer {
        data: u128::from(word).into(),
        last: sent.get(at + 1).is_none_or(is_header),
    });
    let transfers: Vec<driver::Transfer> = transfers.collect();
    let answers = driver::StandIn::new(&Params::default(), StreamWidth::default()).unwrap().answer(&transfers);
    assert!(answers.iter().all(|answer| DRIVER.unpack(answer.data).is_some()), "the model says what no unit says");
    DRIVER.loose(&*PAIRS).unwrap().finish(&answers).map(drop).map_err(|e| format!("stream.words: {e}"))
}

/// What the unit says of the two pairs.
fn read_verdicts(path: &Path) -> Result<(), String> {
    let named = |e| format!("verdicts.words: {e}");
    let all = fs::read(path).unwrap();
    let word = DRIVER.format().answer_width() as usize / 8;
    // The report of the pose, and then the pairs.
    let (pose, pairs) = all.split_at(word.min(all.len()));
    let answers = [DRIVER.packet(pose).map_err(named)?, DRIVER.packet(pairs).map_err(named)?].concat();
    DRIVER.loose(&*PAIRS).unwrap().finish(&answers).map(drop).map_err(named)
}

fn stream() -> Vec<u8> {
    DRIVER.bytes(DRIVER.loose(&*PAIRS).unwrap().transfers())
}

fn verdicts() -> Vec<u8> {
    let job = DRIVER.loose(&*PAIRS).unwrap();
    let mut stand_in = driver::StandIn::new(&Params::default(), StreamWidth::default()).unwrap();
    let word = DRIVER.format().answer_width() as usize / 8;
    stand_in
        .answer(job.transfers())
        .iter()
        .flat_map(|answer| answer.data.bytes().take(word).collect::<Vec<_>>())
        .collect()
}

/// All of them.
pub(super) fn readers() -> Vec<Reader> {
    let query = job().packet().unwrap().to_vec();
    let mut packets: Vec<Vec<u8>> = OBJECTS.loads().iter().map(|load| bytes(load)).collect();
    packets.push(bytes(&query));
    packets.push(bytes(&[OBJECTS.numbers().format().header(Command::Stop)]));
    let answer = bytes(&STAND_IN.clone().packet(&query));
    let of = |name, examples, read| Reader { name, examples, read };
    vec![
        of("mesh.tree", vec![image_of(Upper::Implied), image_of(Upper::Sticky)], read_image),
        of("packet.words", packets, read_packet),
        of("answer.words", vec![answer], read_answer),
        of("stream.words", vec![stream()], read_stream),
        of("verdicts.words", vec![verdicts()], read_verdicts),
    ]
}
