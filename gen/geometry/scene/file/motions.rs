//! What moves in a scene file.

use super::Fault;
use super::numbers::{finite, non_zero, number, pose, rotation, vector};
use super::tables::{KeyTable, SceneTable, TrackTable, TrajectoryTable, TumbleTable};
use crate::scene::Object;
use crate::scene::motion::{Motion, Tumble};
use crate::scene::trajectory::{Key, Track, Trajectory};
use nalgebra::Vector3;
use toml::Spanned;

/// The most frames that a scene may have.
const MOST_FRAMES: u64 = 1_000_000;

/// The motions of the file, in the order sweep, poses, trajectories; none if it has none.
pub(super) fn of(scene: &SceneTable, objects: &[Object]) -> Result<Vec<Motion>, Fault> {
    let mut motions = vec![];
    if let Some(table) = &scene.tumble {
        motions.push(tumble(table, objects)?);
    }
    for (number, table) in scene.pose.iter().enumerate() {
        let parts = table.get_ref();
        motions.push(Motion::Single {
            label: parts.label.clone().unwrap_or_else(|| format!("pose {number}")),
            object: moved(parts.object.as_ref(), objects)?,
            pose: pose(&parts.parts(), table)?,
        });
    }
    for (number, table) in scene.trajectory.iter().enumerate() {
        motions.push(Motion::Trajectory(trajectory(table, number, objects)?));
        let frames: u64 = motions.iter().map(|motion| motion.frames() as u64).sum();
        if frames > MOST_FRAMES {
            let message = format!("{frames} frames in all: expected {MOST_FRAMES} or fewer");
            return Err(Fault::at(&table.get_ref().frames, message));
        }
    }
    Ok(motions)
}

/// The number of the object that is named, or of the last one.
fn moved(name: Option<&Spanned<String>>, objects: &[Object]) -> Result<usize, Fault> {
    name.map_or(Ok(objects.len() - 1), |name| index(name, objects))
}

fn index(name: &Spanned<String>, objects: &[Object]) -> Result<usize, Fault> {
    objects.iter().position(|object| object.name == *name.get_ref()).ok_or_else(|| {
        let legal: Vec<&str> = objects.iter().map(|object| object.name.as_str()).take(20).collect();
        Fault::at(name, format!("object '{}': expected one of {}", name.get_ref(), legal.join(", ")))
    })
}

fn tumble(table: &TumbleTable, objects: &[Object]) -> Result<Motion, Fault> {
    let (steps, distances) = (*table.steps.get_ref(), finite(&table.distances, "distances")?);
    if distances.is_empty() {
        return Err(Fault::at(&table.distances, "distances is empty: expected at least one"));
    }
    let most = MOST_FRAMES / distances.len() as u64;
    if steps == 0 || u64::from(steps) > most {
        let message = format!("steps {steps}: expected 1 to {most} at this number of distances");
        return Err(Fault::at(&table.steps, message));
    }
    let direction = match &table.direction {
        Some(given) => non_zero(given, "direction")?,
        None => Vector3::z(),
    };
    let object = moved(table.object.as_ref(), objects)?;
    let fixed = table.around.as_ref().map_or(Ok(0), |name| index(name, objects))?;
    if object == fixed {
        // One of the two was given: the defaults differ.
        let message = format!("'{}' around itself: expected two objects", objects[fixed].name);
        return Err(match table.object.as_ref().or(table.around.as_ref()) {
            Some(name) => Fault::at(name, message),
            None => Fault::whole(message),
        });
    }
    let turn = Tumble::about(&objects[fixed], &objects[object], object, steps, distances.clone(), direction);
    Ok(Motion::Tumble(turn))
}

fn trajectory(table: &Spanned<TrajectoryTable>, number: usize, objects: &[Object]) -> Result<Trajectory, Fault> {
    let TrajectoryTable { label, frames, track } = table.get_ref();
    let tracks = track.iter().map(|track| self::track(track, objects)).collect::<Result<Vec<Track>, Fault>>()?;
    if tracks.is_empty() {
        return Err(Fault::at(table, "a trajectory without a track: expected one or more [[trajectory.track]]"));
    }
    for (place, later) in tracks.iter().enumerate().skip(1) {
        if tracks[..place].iter().any(|earlier| earlier.object == later.object) {
            let name = &objects[later.object].name;
            return Err(Fault::at(&track[place], format!("a second track of '{name}': expected one of each object")));
        }
    }
    if !(2..=MOST_FRAMES).contains(&u64::from(*frames.get_ref())) {
        return Err(Fault::at(frames, format!("frames {}: expected 2 to {MOST_FRAMES}", frames.get_ref())));
    }
    let label = label.clone().unwrap_or_else(|| format!("trajectory {number} frame"));
    Ok(Trajectory { label, frames: *frames.get_ref(), tracks })
}

fn track(table: &Spanned<TrackTable>, objects: &[Object]) -> Result<Track, Fault> {
    let TrackTable { object, key } = table.get_ref();
    let keys = key.iter().map(self::key).collect::<Result<Vec<Key>, Fault>>()?;
    if keys.is_empty() {
        return Err(Fault::at(table, "a track without a key: expected one or more [[trajectory.track.key]]"));
    }
    if let Some(late) = keys.windows(2).position(|pair| pair[0].time >= pair[1].time) {
        let time = &key[late + 1].get_ref().time;
        return Err(Fault::at(time, format!("time {}: expected times in ascending order", time.get_ref())));
    }
    Ok(Track { object: moved(object.as_ref(), objects)?, keys })
}

fn key(table: &Spanned<KeyTable>) -> Result<Key, Fault> {
    let parts = table.get_ref().parts();
    Ok(Key {
        time: number(&table.get_ref().time, "time")?,
        rotation: rotation(&parts, table, "axis with angle_degrees, and quaternion")?,
        about: vector(parts.about, "about")?,
        translation: vector(parts.translation, "translation")?,
    })
}
