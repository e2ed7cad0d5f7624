//! Which engine for a scene and a part: every one of a few hundred, by counts of the reference model and predicted cells.

use efsat_engine::artefact::EngineDesign;
use efsat_engine::host::{BuildError, Images, Numbers, memory};
use efsat_engine::model::{Model, Query};
use efsat_engine::params::{EXPANSION_CLOCKS, EngineParams};
use efsat_geometry::directions::Directions;
use efsat_geometry::scene::Scene;
use efsat_hardware::device::{Device, Resources};
use efsat_hardware::estimate;
use efsat_unit::design::top::DesignError;
use efsat_unit::params::{CLOCKS_PER_PAIR, Method, Params};
use rayon::prelude::*;
use std::collections::HashSet;

/// Sizes of both caches that are tried, the second of triangles.
const CACHES: [[u32; 2]; 4] = [[512, 256], [1024, 1024], [2048, 1024], [4096, 4096]];
/// Widths of memory that are tried.
const WIDTHS: [u32; 4] = [64, 128, 256, 512];
/// Share of a part's look-up tables and flip-flops that is used at most: a fuller one cannot be routed.
const FULL: f64 = 0.8;
/// Clocks of a query that no unit works in, about: docs/engine-speed.md.
const ENDS: f64 = 40.0;

/// What cannot be planned.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// Parameters out of range.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A mesh that no engine takes.
    #[error(transparent)]
    Mesh(#[from] BuildError),
    /// Nothing that an engine answers.
    #[error("expected two objects whose boxes overlap in a frame")]
    Empty,
}

/// What the queries of a scene come to, for one set of directions.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// Queries.
    pub queries: u64,
    /// Pairs of nodes that are opened.
    pub expansions: u64,
    /// Pairs of triangles that are tested.
    pub leaf_pairs: u64,
    /// Blocks and triangles that are read, with each of [`CACHES`].
    reads: [[u64; 2]; CACHES.len()],
}

/// What limits an engine, or how many of them there are on a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    VolumeUnit,
    TriangleUnit,
    Memory,
    Multipliers,
    Luts,
    FlipFlops,
    BlockRams,
}

impl Limit {
    /// Its name in a sentence.
    pub fn name(self) -> &'static str {
        match self {
            Self::VolumeUnit => "the volume unit",
            Self::TriangleUnit => "the triangle unit",
            Self::Memory => "the memory port",
            Self::Multipliers => "multipliers",
            Self::Luts => "look-up tables",
            Self::FlipFlops => "flip-flops",
            Self::BlockRams => "block RAMs",
        }
    }
}

/// An engine, with what it costs and how fast it is.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Parameters of the engine.
    pub engine: EngineParams,
    /// Parameters of the unit in it.
    pub unit: Params,
    /// Cells of one engine and its share of what several have between them.
    pub cells: Resources,
    /// Block RAMs of 18 kbit.
    pub block_rams: u64,
    /// Clocks per query, about.
    pub clocks: f64,
    /// What most of them are for.
    pub limit: Limit,
    /// Words of memory per query.
    pub words: f64,
    /// Engines on the part that share one memory port, and what there is too little of for another one.
    pub engines: u64,
    /// That.
    pub full: Limit,
}

impl Candidate {
    /// Clocks per query of all engines together.
    pub fn pace(&self) -> f64 {
        self.clocks / self.engines as f64
    }

    /// Bytes that a query reads from memory.
    pub fn bytes(&self) -> f64 {
        self.words * f64::from(self.engine.memory_width / 8)
    }

    /// The options that generate it, where they are not the defaults.
    pub fn options(&self) -> String {
        let usual = EngineParams::default();
        let mut all = self.engine.options();
        all.retain(|option| !usual.options().contains(option));
        all.extend(self.unit.differences(&self.engine.unit()));
        all.iter().map(|(name, value)| format!(" --{name} {value}")).collect()
    }
}

/// A cache of lines with one place for each, as the engine has one for each tree and each mesh.
struct Cache {
    lines: Vec<Option<u32>>,
    reads: u64,
}

impl Cache {
    fn new(lines: u32) -> Self {
        Self { lines: vec![None; lines as usize / 2], reads: 0 }
    }

    fn ask(&mut self, line: u32) {
        let count = self.lines.len();
        let place = &mut self.lines[line as usize % count];
        if place.replace(line) != Some(line) {
            self.reads += 1;
        }
    }
}

/// Directions with the longest codes that a block of 64 bytes holds.
fn formats() -> impl Iterator<Item = EngineParams> {
    let usual = EngineParams::default();
    Directions::ALL.iter().map(move |&directions| {
        let offset_bits = if directions == Directions::TwentySix { 6 } else { usual.offset_bits };
        EngineParams { directions, offset_bits, ..usual.clone() }
    })
}

/// Counts the work of all frames of a scene, and what caches have to read, query after query.
///
/// # Errors
/// See [`PlanError`].
pub fn count(scene: &Scene, engine: &EngineParams, done: impl Fn() + Sync) -> Result<Counts, PlanError> {
    let unit = engine.unit();
    let numbers = Numbers::new(engine, &unit).map_err(DesignError::from)?;
    let model = Model::new(engine, &unit).map_err(DesignError::from)?;
    let images = Images::new(&scene.meshes().0, numbers)?;
    let (words, sides) = memory(&images.all());
    let near = scene.near();
    let visited = |frame: usize| {
        done();
        let queries = near.meetings(frame).into_iter().filter_map(|meeting| {
            let query = images.query(meeting.meshes, &meeting.pose, &sides).ok()?;
            let query = Query { leaf_pairs: true, ..query };
            Some((query.sides, model.visits(&words, &query.words(model.format())).1))
        });
        queries.collect::<Vec<_>>()
    };
    let all: Vec<_> = (0..scene.frames()).into_par_iter().flat_map_iter(visited).collect();
    let mut counts = Counts { queries: all.len() as u64, ..Counts::default() };
    for (_, visits) in &all {
        counts.expansions += visits.nodes.len() as u64;
        counts.leaf_pairs += visits.numbers.len() as u64;
    }
    for (reads, lines) in counts.reads.iter_mut().zip(CACHES) {
        let mut before = None;
        let empty = || lines.map(|lines| [0, 1].map(|_| Cache::new(lines)));
        let mut caches = empty();
        let mut flushed = [0; 2];
        let sum = |caches: &[[Cache; 2]; 2]| caches.each_ref().map(|[a, b]| a.reads + b.reads);
        for (sides, visits) in &all {
            if before.replace(sides) != Some(sides) {
                let so_far = sum(&caches);
                flushed = [0, 1].map(|i| flushed[i] + so_far[i]);
                caches = empty();
            }
            for (kind, numbers) in [&visits.nodes, &visits.numbers].into_iter().enumerate() {
                for pair in numbers {
                    for side in 0..2 {
                        let base = if kind == 0 { sides[side].blocks_at } else { sides[side].triangles_at };
                        caches[kind][side].ask(base + pair[side]);
                    }
                }
            }
        }
        let last = sum(&caches);
        *reads = [0, 1].map(|i| flushed[i] + last[i]);
    }
    if all.is_empty() { Err(PlanError::Empty) } else { Ok(counts) }
}

/// Which engines there are for a scene and a part, at most so many, the fastest first; of equally fast ones the smallest, with the
/// least traffic of memory. `done` is called after each frame, for each set of directions.
///
/// # Errors
/// See [`PlanError`].
pub fn plan(scene: &Scene, device: &Device, most: u64, done: impl Fn() + Sync) -> Result<Vec<Candidate>, PlanError> {
    let mut found = vec![];
    let paced = |clocks_per_pair: u32| {
        let unit = Params { clocks_per_pair, device: device.name.to_owned(), ..Params::of(Method::Determinants) };
        let engine = EngineDesign::new(&EngineParams::default(), &unit)?;
        Ok((unit, estimate::whole(&engine.unit.top, device)))
    };
    let units = CLOCKS_PER_PAIR.par_iter().map(|clocks| paced(*clocks)).collect::<Result<Vec<_>, DesignError>>()?;
    for format in formats() {
        let counts = count(scene, &format, &done)?;
        for &expansion_clocks in EXPANSION_CLOCKS {
            // A younger query has room for four leaf pairs of each of its pairs in flight, and for what waits.
            let pair_queue =
                if expansion_clocks == format.expansion_clocks { format.pair_queue } else { 1024 / expansion_clocks };
            let engine =
                EngineParams { expansion_clocks, in_flight: 64 / expansion_clocks, pair_queue, ..format.clone() };
            // Each of several has a queue of its own for its answers.
            let engine = EngineParams { engines: most.clamp(1, 2) as u32, ..engine };
            let mut design = EngineDesign::new(&engine, &units[0].0)?;
            let volume = estimate::whole(&design.volume.stage, device);
            for (lines, reads) in CACHES.into_iter().zip(counts.reads) {
                for memory_width in WIDTHS {
                    [design.params.block_lines, design.params.triangle_lines] = lines;
                    design.params.memory_width = memory_width;
                    let of = |(unit, cells): &(Params, Resources)| {
                        candidate(&counts, reads, &design, unit, *cells + volume, most)
                    };
                    found.extend(units.iter().filter_map(of));
                }
            }
        }
    }
    found.sort_by(|x, y| {
        let cells = |one: &Candidate| one.cells.multipliers * one.engines;
        let memory = |one: &Candidate| (one.bytes().ceil() as u64, one.engine.memory_width, one.block_rams);
        let smaller = || (cells(x), memory(x)).cmp(&(cells(y), memory(y)));
        x.pace().total_cmp(&y.pace()).then_with(smaller)
    });
    // Those that differ in their memory alone are one.
    let mut known = HashSet::new();
    found.retain(|one| known.insert((one.engine.directions, one.engine.expansion_clocks, one.unit.clocks_per_pair)));
    Ok(found)
}

/// An engine on a part, if at least one fits.
fn candidate(
    counts: &Counts,
    reads: [u64; 2],
    design: &EngineDesign,
    unit: &Params,
    units: Resources,
    most: u64,
) -> Option<Candidate> {
    let (mut engine, device) = (design.params.clone(), design.unit.device);
    let per_query = |count: u64| count as f64 / counts.queries as f64;
    let beats = |bits: u32| u64::from(bits.div_ceil(engine.memory_width));
    let words = per_query(reads[0] * beats(512) + reads[1] * beats(320));
    let busy = [
        (Limit::VolumeUnit, per_query(counts.expansions) * f64::from(engine.expansion_clocks)),
        (Limit::TriangleUnit, per_query(counts.leaf_pairs) * f64::from(unit.clocks_per_pair)),
        (Limit::Memory, words),
    ];
    let (limit, busiest) = busy.into_iter().max_by(|x, y| x.1.total_cmp(&y.1)).expect("there are three");
    let clocks = busiest + ENDS;
    let count = u64::from(engine.engines);
    let all = design.cells_around(units, device);
    let Resources { multipliers, luts, memory_luts, flip_flops, carry } = all.resources;
    let [multipliers, luts, memory_luts, flip_flops, carry, block_rams] =
        [multipliers, luts, memory_luts, flip_flops, carry, all.block_rams].map(|all| all.div_ceil(count));
    let share = |there: u64| (FULL * there as f64) as u64;
    let fits = [
        (Limit::Multipliers, device.multipliers.into(), multipliers),
        (Limit::Luts, share(device.capacity.luts), luts + memory_luts),
        (Limit::FlipFlops, share(device.capacity.flip_flops), flip_flops),
        (Limit::BlockRams, device.block_rams.into(), block_rams),
        (Limit::Memory, clocks as u64, words.ceil() as u64),
    ];
    let fits = fits.into_iter().map(|(kind, there, one): (Limit, u64, u64)| (kind, there / one.max(1)));
    let (full, engines) = fits.min_by_key(|(_, engines)| *engines).expect("there are five");
    let engines = engines.min(most);
    engine.engines = engines as u32;
    let unit = unit.clone();
    let cells = Resources { multipliers, luts, memory_luts, flip_flops, carry };
    let one = Candidate { engine, unit, cells, block_rams, clocks, limit, words, engines, full };
    (engines > 0).then_some(one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cache_reads_what_it_does_not_hold() {
        let mut cache = Cache::new(8);
        // Lines 1 and 5 have one place.
        for (line, reads) in [(1, 1), (1, 1), (2, 2), (5, 3), (1, 4), (2, 4)] {
            cache.ask(line);
            assert_eq!(cache.reads, reads, "{line}");
        }
    }

    #[test]
    fn the_busiest_is_the_limit() {
        let engine = EngineParams::default();
        let design = EngineDesign::new(&engine, &engine.unit()).unwrap();
        let counts = Counts { queries: 2, expansions: 200, leaf_pairs: 220, ..Counts::default() };
        let units = Resources { multipliers: 77, ..Resources::default() };
        let with = |clocks_per_pair, reads, most| {
            let unit = Params { clocks_per_pair, ..engine.unit() };
            candidate(&counts, reads, &design, &unit, units, most).unwrap()
        };
        // A block takes eight words of 64 bits, a triangle five.
        for (clocks_per_pair, reads, limit, clocks) in [
            (3, [2, 2], Limit::VolumeUnit, 400.0),
            (6, [2, 2], Limit::TriangleUnit, 660.0),
            (3, [200, 20], Limit::Memory, 850.0),
        ] {
            let one = with(clocks_per_pair, reads, 8);
            assert_eq!((one.limit, one.clocks), (limit, clocks + ENDS));
        }
        let one = with(3, [2, 2], 8);
        assert_eq!((one.engines, one.full), (1, Limit::Multipliers));
        assert!(with(3, [200, 20], 8).engines == 1 && one.words == 13.0 && one.bytes() == 104.0);
        let large = Resources { multipliers: 145, ..units };
        assert!(candidate(&counts, [2, 2], &design, &engine.unit(), large, 8).is_none());
    }
}
