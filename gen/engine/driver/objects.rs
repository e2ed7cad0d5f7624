//! Meshes as an engine and the software that stands in for it need them.

use super::{Contacts, Engine, EngineError, Job};
use crate::host::{BuildError, Images, Layout, Numbers};
use crate::model::Query;
use crate::params::EngineParams;
use crate::words::{Command, EngineReport, QueryFlags};
use efsat_geometry::collide::hierarchy::DopTree;
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::Pose;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, ParamError, Params};
use std::collections::HashMap;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Why meshes cannot be given to an engine.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ObjectsError {
    /// Parameters outside their ranges, or a memory that is too small for the meshes.
    #[error(transparent)]
    Parameter(#[from] ParamError),
    /// A mesh that is too large for an image.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// What a query asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueryOptions {
    /// Stop at the first pair that touches: whether the objects touch.
    pub first_contact: bool,
    /// The most expansions, 0 for as many as it takes; the software answers a query that needs more.
    pub limit: u32,
    /// Keep the caches of the query before, which saves reading the same again: right only if nothing that this query reads has been
    /// written to memory since the last query that did not keep them. A change of addresses empties the caches anyway.
    pub keep_caches: bool,
}

/// Meshes that meet in queries, made ready for one engine.
#[derive(Debug)]
pub struct Objects<'a> {
    pub(super) engine: EngineParams,
    pub(super) unit: Params,
    pub(super) meshes: Vec<&'a Mesh>,
    pub(super) images: Images,
    pub(super) layout: Layout,
    /// For the software; none before it is needed.
    trees: Vec<OnceLock<DopTree>>,
    /// Where the triangle of each face is in its image; none before a pair by number is asked for.
    pub(super) places: Vec<OnceLock<Vec<u32>>>,
    /// The number of the next query.
    pub(super) next: AtomicU32,
}

impl<'a> Objects<'a> {
    /// Builds the images of meshes for an engine and the unit in it.
    ///
    /// # Errors
    /// Parameters outside their ranges; a unit that answers for other points than those of the meshes; meshes that are too
    /// large.
    pub fn new(engine: &EngineParams, unit: &Params, meshes: &[&'a Mesh]) -> Result<Self, ObjectsError> {
        let numbers = Numbers::new(engine, unit)?;
        if unit.method == Method::Exact {
            let legal = "expected axes or determinants, whose definite answers hold for the meshes as they are given";
            let (found, legal) = (unit.method.name().to_owned(), legal.to_owned());
            return Err(ParamError { option: "method", found, legal }.into());
        }
        let images = Images::new(meshes, numbers)?;
        let layout = Layout::new(engine, images.numbers().format(), &images.all())?;
        let trees = meshes.iter().map(|_| OnceLock::new()).collect();
        let places = meshes.iter().map(|_| OnceLock::new()).collect();
        let (engine, unit, meshes) = (engine.clone(), unit.clone(), meshes.to_vec());
        Ok(Self { engine, unit, meshes, images, layout, trees, places, next: AtomicU32::new(0) })
    }

    /// What lies in the memory of an engine with an AXI4 read master, from address 0 on, as 64-bit words; empty for block RAM.
    pub fn memory(&self) -> &[u64] {
        &self.layout.memory
    }

    /// The packets that fill block RAM, to be sent before the first query; none for an AXI4 read master.
    pub fn loads(&self) -> &[Vec<u64>] {
        &self.layout.loads
    }

    /// The number formats of queries and images.
    pub fn numbers(&self) -> &Numbers {
        self.images.numbers()
    }

    /// The job of finding the triangles that touch of two objects by their numbers, with the second one in `pose` as seen from
    /// the first, taken as exact. Each query gets a number of its own.
    ///
    /// # Panics
    /// If there is no such object.
    pub fn query(&self, objects: [usize; 2], pose: &Pose, options: QueryOptions) -> Job<'_, 'a> {
        let number = self.next.fetch_add(1, Ordering::Relaxed) % QueryFlags::NUMBERS;
        let query = self.images.query(objects, pose, &self.layout.sides);
        let packet = query.map(|query| {
            let QueryOptions { first_contact, limit, keep_caches } = options;
            Query { first_contact, limit, keep_caches, number, ..query }.words(self.numbers().format())
        });
        Job { objects: self, pair: objects, pose: *pose, options, number, packet }
    }

    /// The only word of the packet that ends the query with a number, if it runs or waits. It has no answer of its own; the query's
    /// report says whether it was stopped.
    pub fn stop(&self, number: u32) -> u64 {
        self.numbers().format().order(Command::Stop, number)
    }

    /// The only word of the packet of a soft reset: it is answered by a report with reason [`Reset`](crate::words::Reason)
    /// and this number, and nothing that was sent before it has another answer.
    pub fn reset(&self, number: u32) -> u64 {
        self.numbers().format().order(Command::Reset, number)
    }

    /// Sends the packets of jobs to an engine and finishes them.
    ///
    /// # Errors
    /// Those of the engine, and answers that are none.
    pub fn contacts<E: Engine>(&self, jobs: Vec<Job<'_, '_>>, engine: &mut E) -> Result<Vec<Contacts>, E::Error> {
        let packets: Vec<&[u64]> = jobs.iter().filter_map(Job::packet).collect();
        let answers = engine.answer(&packets)?;
        if answers.len() != packets.len() {
            return Err(EngineError::Answers { found: answers.len(), expected: packets.len() }.into());
        }
        // Each is for the query with its number; those that have none are for what is left, in order.
        let number = |words: &Vec<u64>| EngineReport::of(words.last_chunk()?).filter(EngineReport::is_numbered);
        let mut sent: HashMap<u32, usize> = HashMap::new();
        for (place, job) in jobs.iter().filter(|job| job.packet().is_some()).enumerate() {
            sent.insert(job.number(), place);
        }
        let mut placed: Vec<Option<Vec<u64>>> = vec![None; packets.len()];
        let mut others = vec![];
        for words in answers {
            match number(&words).and_then(|report| sent.remove(&report.number)) {
                Some(place) => placed[place] = Some(words),
                None => others.push(words),
            }
        }
        let mut others = others.into_iter();
        let mut placed = placed.into_iter();
        let finished = jobs.into_iter().map(|job| match job.packet() {
            Some(_) => job.finish(&placed.next().flatten().or_else(|| others.next()).unwrap_or_default()),
            None => job.finish(&[]),
        });
        Ok(finished.collect::<Result<_, EngineError>>()?)
    }

    /// The tree of an object for the software.
    pub(super) fn tree(&self, object: usize) -> &DopTree {
        self.trees[object].get_or_init(|| DopTree::new(self.meshes[object], self.engine.directions))
    }
}
