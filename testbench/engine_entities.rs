//! The entities of the collision engine one by one in GHDL: each is driven clock by clock by a test that knows what it is for,
//! with random work and random stalls, and each test notices mistakes in the text.

mod answer;
mod cache;
mod children;
mod command;
mod control;
mod memory;
mod pairs;
mod player;
mod queries;
mod read_master;
mod stack;
mod traverse;
mod triangles;

use crate::extent::share;
use crate::tools::{ghdl, replaced};
use efsat::artefact::Prefix;
use efsat::engine::artefact::{EngineDesign, engine_files};
use efsat::engine::params::{EngineParams, Memory};
use efsat::params::Params;
use player::Entity;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// What a test found wrong.
type Outcome = Result<(), String>;

/// An engine whose queues are soon full.
fn small(memory: Memory) -> EngineDesign {
    let mut engine = EngineParams {
        memory,
        block_lines: 32,
        triangle_lines: 32,
        stack: 40,
        tree_height: 10,
        pair_queue: 16,
        ..EngineParams::default()
    };
    if memory == Memory::Axi {
        engine.watchdog = 300;
    }
    EngineDesign::new(&engine, &Params::default()).unwrap()
}

/// The text of an entity or package of a design.
fn text_of(design: &EngineDesign, name: &str) -> String {
    let files = engine_files(design, &Prefix::default(), "efsat generate --engine").unwrap();
    files.into_iter().find(|(file, _)| *file == format!("{name}.vhd")).unwrap().1
}

/// Tests an entity of a design; then with each of some changes of its text, which the test must notice.
fn tried(design: &EngineDesign, name: &str, changes: &[(&str, &str)], test: impl Fn(&mut Entity) -> Outcome) {
    tried_beside(design, name, "", changes, test);
}

/// The same of an entity that has others in it, of which one may be changed.
fn tried_with(
    design: &EngineDesign,
    name: &str,
    parts: &[&str],
    changes: &[(&str, &str)],
    test: impl Fn(&mut Entity) -> Outcome,
) {
    let parts: String = parts.iter().map(|part| text_of(design, part)).collect();
    tried_beside(design, name, &parts, changes, test);
}

/// The same where the text of what is in it is given. The package that all of them share is in front.
fn tried_beside(
    design: &EngineDesign,
    name: &str,
    parts: &str,
    changes: &[(&str, &str)],
    test: impl Fn(&mut Entity) -> Outcome,
) {
    let Some(ghdl) = ghdl() else { return };
    let (text, parts) = (text_of(design, name), text_of(design, "engine_layout") + parts);
    test(&mut Entity::new(ghdl, name, &text, &parts)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut missed = vec![];
    for (from, to) in share(8, changes) {
        // A place in both is as wrong as one that is twice in one of them.
        assert!(!(text.contains(from) && parts.contains(from)), "{from}");
        let (text, parts) = if text.contains(from) {
            (&replaced(&text, from, to), &parts)
        } else {
            (&text, &replaced(&parts, from, to))
        };
        if test(&mut Entity::new(ghdl, name, text, parts)).is_ok() {
            missed.push((from, to));
        }
    }
    assert!(missed.is_empty(), "{name}: not noticed: {missed:?}");
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
