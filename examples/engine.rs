//! The collision engine, driven from a host: which triangles of two meshes touch in some poses.
//!
//! `cargo run --release --example engine`. In place of hardware a stand-in answers, as the reference model does. A real host
//! copies `Objects::memory` to the memory of the engine (or sends `Objects::loads` where that is block RAM), sends the words of
//! `Job::packet` through its DMA, and gives what comes back to `Job::finish`.

use efsat::NotFinite;
use efsat::engine::driver::{Contacts, Objects, QueryOptions, StandIn};
use efsat::engine::params::EngineParams;
use efsat::scene::Scene;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for (frame, contacts) in contacts(&[0, 823, 824])? {
        let by = if contacts.software.is_some() { "software" } else { "engine" };
        println!("frame {frame}: {} pairs of triangles touch ({by})", contacts.touching().count());
    }
    Ok(())
}

/// The answers for some frames of the built-in scene, in which one headlight tumbles in front of another one.
pub fn contacts(frames: &[usize]) -> Result<Vec<(usize, Contacts)>, Box<dyn Error>> {
    let engine = EngineParams::default();
    let unit = engine.unit();
    let scene = Scene::default_scene();
    let (meshes, mesh_of) = scene.meshes();
    let objects = Objects::new(&engine, &unit, &meshes)?;
    let mut stand_in = StandIn::new(&objects)?;

    let job = |&frame: &usize| {
        // The pose of the second object as seen from the first.
        let poses = scene.frame(frame).poses;
        let seen = poses[0].seen(&poses[1])?;
        Ok(objects.query([mesh_of[0], mesh_of[1]], &seen, QueryOptions::default()))
    };
    let jobs = frames.iter().map(job).collect::<Result<_, NotFinite>>()?;
    let answers = objects.contacts(jobs, &mut stand_in)?;
    Ok(frames.iter().copied().zip(answers).collect())
}
