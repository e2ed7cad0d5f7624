//! The entities of the collision engine one by one in GHDL: each is driven clock by clock by a test that knows what it is for,
//! with random work and random stalls, and each test notices mistakes in the text.

mod cache;
mod children;
mod memory;
mod pairs;
mod player;
mod read_master;
mod stack;

use crate::tools::{ghdl, replaced};
use efsat::artefact::Prefix;
use efsat::artefact::engine::{EngineDesign, engine_files};
use efsat::params::Params;
use efsat::params::engine::{EngineParams, Memory};
use player::Entity;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// What a test found wrong.
type Outcome = Result<(), String>;

/// An engine whose queues are soon full.
fn small(memory: Memory) -> EngineDesign {
    let engine = EngineParams {
        memory,
        block_lines: 32,
        triangle_lines: 32,
        stack: 40,
        tree_height: 10,
        pair_queue: 16,
        ..EngineParams::default()
    };
    EngineDesign::new(&engine, &Params::default()).unwrap()
}

/// Tests an entity of a design; then with each of some changes of its text, which the test must notice.
fn tried(design: &EngineDesign, name: &str, changes: &[(&str, &str)], test: impl Fn(&mut Entity) -> Outcome) {
    let Some(ghdl) = ghdl() else { return };
    let files = engine_files(design, &Prefix::default(), "efsat generate --engine").unwrap();
    let (_, text) = files.iter().find(|(file, _)| *file == format!("{name}.vhd")).unwrap();
    test(&mut Entity::new(ghdl, name, text)).unwrap_or_else(|error| panic!("{name}: {error}"));
    for (from, to) in changes {
        let outcome = test(&mut Entity::new(ghdl, name, &replaced(text, from, to)));
        assert!(outcome.is_err(), "{name}: not noticed: {from}");
    }
}

/// An error where something does not hold.
fn expect(holds: bool, clock: usize, what: &str) -> Outcome {
    if holds { Ok(()) } else { Err(format!("clock {clock}: {what}")) }
}

fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Once in so many times.
fn seldom(rng: &mut ChaCha8Rng, times: u32) -> bool {
    rng.random_range(0..times) == 0
}
