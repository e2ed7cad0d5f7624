//! Pairs of triangles that the host names, for an engine that takes them by number.

use super::{EngineError, Objects};
use crate::host::{Refusal, TRIANGLES_AT};
use crate::model::ByNumber;
use crate::words::{EngineAnswer, EngineReport, QueryFlags, Reason};
use efsat_geometry::exact::Exact;
use efsat_geometry::scene::Pose;
use efsat_geometry::software::retest::retest_posed;
use efsat_unit::pair::{Pose as UnitPose, Verdict};
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// Pairs on their way through the engine.
#[derive(Clone, Debug)]
pub struct PairsJob<'o, 'a> {
    objects: &'o Objects<'a>,
    pair: [usize; 2],
    pose: Pose,
    faces: Vec<[u32; 2]>,
    number: u32,
    packet: Result<Vec<u64>, Refusal>,
}

impl<'a> Objects<'a> {
    /// The packets that fill the block RAM of an engine that takes pairs by number, which holds no blocks.
    pub fn triangle_loads(&self) -> impl Iterator<Item = &[u64]> {
        self.loads().iter().map(Vec::as_slice).filter(|load| load[1] >= u64::from(TRIANGLES_AT) << 6)
    }

    /// The job of deciding pairs of faces of two objects, with the second one in `pose` as seen from the first, taken as exact. The
    /// engine gets them in this order; pairs that are near each other in it have their triangles in the caches.
    ///
    /// # Panics
    /// If there is no such object or face.
    pub fn pairs(&self, objects: [usize; 2], pose: &Pose, faces: &[[u32; 2]], keep_caches: bool) -> PairsJob<'_, 'a> {
        let number = self.next_number();
        let packet = self.images.query(objects, pose, &self.layout.sides).map(|query| {
            let packet = ByNumber { number, keep_caches, ..ByNumber::of_query(&query, self.places(objects, faces)) };
            packet.words(self.numbers().format())
        });
        PairsJob { objects: self, pair: objects, pose: *pose, faces: faces.to_vec(), number, packet }
    }

    /// The same for pairs of faces of one object, as it lies: the unit takes both triangles as they are.
    ///
    /// # Panics
    /// If there is no such object or face.
    pub fn pairs_of_one(&self, object: usize, faces: &[[u32; 2]], keep_caches: bool) -> PairsJob<'_, 'a> {
        let number = self.next_number();
        let side = self.layout.sides[object];
        let packet = ByNumber {
            sides: [side; 2],
            all_pairs: false,
            keep_caches,
            number,
            pose: UnitPose { bypass: true, ..UnitPose::identity(&self.unit) },
            pairs: self.places([object; 2], faces),
        };
        let packet = Ok(packet.words(self.numbers().format()));
        PairsJob { objects: self, pair: [object; 2], pose: Pose::identity(), faces: faces.to_vec(), number, packet }
    }

    fn next_number(&self) -> u32 {
        self.next.fetch_add(1, Ordering::Relaxed) % QueryFlags::NUMBERS
    }

    /// Where the triangles of faces are in the images.
    fn places(&self, objects: [usize; 2], faces: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let places = objects.map(|object| self.places[object].get_or_init(|| self.images.all()[object].places()));
        faces.iter().map(|pair| [0, 1].map(|side| places[side][pair[side] as usize])).collect()
    }
}

impl PairsJob<'_, '_> {
    /// The words to send as one packet; none if the engine cannot answer it.
    pub fn packet(&self) -> Option<&[u64]> {
        self.packet.as_deref().ok()
    }

    /// The exact answer to each pair, from the words that came back: none if none were sent. Pairs that are possibly incorrect are
    /// retested by all threads of the current pool, and so are all if the engine has not answered all.
    ///
    /// # Errors
    /// What came back does not answer what was sent; then nothing is known of any pair.
    pub fn finish(self, words: &[u64]) -> Result<Vec<Exact>, EngineError> {
        let count = self.faces.len();
        let all = |verdict: Verdict| vec![verdict; count];
        let verdicts = match (&self.packet, words) {
            (Err(_), []) => all(Verdict::PossiblyIncorrect),
            (Err(_), _) => return Err(EngineError::NotSent),
            (Ok(_), words) => self.read(words)?.unwrap_or_else(|| all(Verdict::PossiblyIncorrect)),
        };
        let exact = |(faces, verdict): (&[u32; 2], Verdict)| match verdict {
            Verdict::Separate => Exact::Separate,
            Verdict::Intersect => Exact::Intersect,
            Verdict::PossiblyIncorrect => self.exact(*faces),
        };
        Ok(self.faces.par_iter().zip(verdicts).map(exact).collect())
    }

    /// The verdict of each pair; none, if not all were tested.
    fn read(&self, words: &[u64]) -> Result<Option<Vec<Verdict>>, EngineError> {
        let none = EngineError::NoReport { words: words.len() };
        let (answers, last) = words.split_last_chunk().ok_or(none.clone())?;
        let report = EngineReport::of(last).ok_or(none)?;
        if report.is_numbered() && report.number != self.number {
            return Err(EngineError::Number { found: report.number, expected: self.number });
        }
        if report.reason != Reason::Complete {
            return Ok(None);
        }
        let mut verdicts = vec![Verdict::Separate; self.faces.len()];
        let (mut next, mut found) = (0, [0u64; 2]);
        for (at, &word) in answers.iter().enumerate() {
            let wrong = EngineError::Word { at, word };
            let answer = EngineAnswer::of(word).ok_or(wrong.clone())?;
            let (verdict, kind) = match answer.verdict {
                code if code == Verdict::Intersect as u8 => (Verdict::Intersect, 0),
                code if code == Verdict::PossiblyIncorrect as u8 => (Verdict::PossiblyIncorrect, 1),
                _ => return Err(wrong),
            };
            // Answers come in the order of the pairs, and separate ones are left out.
            let place = self.faces[next..].iter().position(|faces| *faces == answer.triangles).ok_or(wrong)?;
            verdicts[next + place] = verdict;
            next += place + 1;
            found[kind] += 1;
        }
        let counts = [report.intersect, report.possibly_incorrect].map(u64::from);
        let tested = (self.faces.len() as u64, u64::from(report.leaf_pairs));
        match found.into_iter().zip(counts).chain([tested]).find(|(found, expected)| found != expected) {
            Some((found, expected)) => Err(EngineError::Count { found, expected }),
            None => Ok(Some(verdicts)),
        }
    }

    fn exact(&self, faces: [u32; 2]) -> Exact {
        let corners =
            |side: usize| self.objects.meshes[self.pair[side]].triangle(faces[side] as usize).map(<[f64; 3]>::from);
        let answer = retest_posed(&corners(0), &corners(1), &self.pose.rows(), &self.pose.translation().into());
        answer.expect("meshes and poses are finite")
    }
}
