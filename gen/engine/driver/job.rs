//! A query: what is sent, and what its answer means.

use super::{EngineError, Objects, QueryOptions};
use crate::host::Refusal;
use crate::words::{EngineAnswer, EngineReport, Reason};
use efsat_geometry::collide::hierarchy::{Scratch, contacts, first_hit};
use efsat_geometry::exact::Exact;
use efsat_geometry::scene::Pose;
use efsat_geometry::software::retest::retest_posed;
use efsat_unit::pair::Verdict;
use rayon::prelude::*;

/// Why a query was answered in software.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// It was not sent: the engine cannot answer it.
    Refused(Refusal),
    /// The engine has ended it before everything was traversed.
    Incomplete(Reason),
}

/// A pair of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact {
    /// The faces of the two meshes.
    pub triangles: [u32; 2],
    /// What the engine says; none if the software has found the pair.
    pub verdict: Option<Verdict>,
    /// The exact answer.
    pub exact: Exact,
}

/// The answer to a query.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts {
    /// All pairs that touch, and those that the engine left open though they are separate, in ascending order. For the first
    /// contact: one pair that touches, or none.
    pub pairs: Vec<Contact>,
    /// What the engine reports, if the query was sent.
    pub report: Option<EngineReport>,
    /// Why the software has answered, if it has.
    pub software: Option<Cause>,
}

impl Contacts {
    /// The pairs that touch.
    pub fn touching(&self) -> impl Iterator<Item = [u32; 2]> {
        self.pairs.iter().filter(|pair| pair.exact != Exact::Separate).map(|pair| pair.triangles)
    }
}

/// A query on its way through the engine.
#[derive(Clone, Debug)]
pub struct Job<'o, 'a> {
    pub(super) objects: &'o Objects<'a>,
    pub(super) pair: [usize; 2],
    pub(super) pose: Pose,
    pub(super) options: QueryOptions,
    pub(super) number: u32,
    pub(super) packet: Result<Vec<u64>, Refusal>,
}

impl Job<'_, '_> {
    /// The words to send as one packet; none if the engine cannot answer the query.
    pub fn packet(&self) -> Option<&[u64]> {
        self.packet.as_deref().ok()
    }

    /// The number of the query, which its report returns: no two of the last 2^24 queries of the same objects have the same.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// The exact answer, from the words that came back: none if none were sent. Pairs that are possibly incorrect are retested
    /// by all threads of the current pool; so are those that the software finds, if it has to answer.
    ///
    /// # Errors
    /// What came back does not answer what was sent; then nothing is known of any pair.
    pub fn finish(self, words: &[u64]) -> Result<Contacts, EngineError> {
        if let Err(refusal) = &self.packet {
            return match words {
                [] => Ok(self.in_software(None, Cause::Refused(refusal.clone()))),
                _ => Err(EngineError::NotSent),
            };
        }
        let (answers, report) = self.parts(words)?;
        let first = self.options.first_contact;
        match report.reason {
            Reason::Complete => {}
            Reason::Contact if first => {}
            // Pairs may be missing.
            reason => return Ok(self.in_software(Some(report), Cause::Incomplete(reason))),
        }
        let mut answers = self.read(answers, &report)?;
        answers.sort_unstable_by_key(|(triangles, _)| *triangles);
        if let Some(pair) = answers.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(EngineError::Twice { triangles: pair[0].0 });
        }
        let contact = |&(triangles, verdict): &([u32; 2], Verdict)| {
            // Whatever the test, the relative interiors of two triangles meet if it says *intersect*.
            let exact = if verdict == Verdict::Intersect { Exact::Intersect } else { self.exact(triangles) };
            Contact { triangles, verdict: Some(verdict), exact }
        };
        let pairs = match first {
            false => answers.par_iter().map(contact).collect(),
            true => {
                let certain = answers.iter().find(|(_, verdict)| *verdict == Verdict::Intersect);
                let touches = |contact: &Contact| contact.exact != Exact::Separate;
                certain.map(contact).or_else(|| answers.iter().map(contact).find(touches)).into_iter().collect()
            }
        };
        Ok(Contacts { pairs, report: Some(report), software: None })
    }

    /// The words before the report, and the report.
    fn parts<'w>(&self, words: &'w [u64]) -> Result<(&'w [u64], EngineReport), EngineError> {
        let none = EngineError::NoReport { words: words.len() };
        let (answers, last) = words.split_last_chunk().ok_or(none.clone())?;
        let report = EngineReport::of(last).ok_or(none)?;
        match self.number {
            expected if report.is_numbered() && report.number != expected => {
                Err(EngineError::Number { found: report.number, expected })
            }
            _ => Ok((answers, report)),
        }
    }

    /// The pairs of an answer, as many as the report counts.
    fn read(&self, words: &[u64], report: &EngineReport) -> Result<Vec<([u32; 2], Verdict)>, EngineError> {
        let faces = self.pair.map(|object| self.objects.meshes[object].faces().len());
        let pair = |(at, &word): (usize, &u64)| {
            let answer = EngineAnswer::of(word).filter(|answer| {
                answer.triangles.iter().zip(faces).all(|(&triangle, count)| (triangle as usize) < count)
            });
            let verdict = answer.and_then(|answer| match answer.verdict {
                code if code == Verdict::Intersect as u8 => Some(Verdict::Intersect),
                code if code == Verdict::PossiblyIncorrect as u8 => Some(Verdict::PossiblyIncorrect),
                _ => None,
            });
            answer.zip(verdict).map(|(a, verdict)| (a.triangles, verdict)).ok_or(EngineError::Word { at, word })
        };
        let pairs: Vec<_> = words.iter().enumerate().map(pair).collect::<Result<_, _>>()?;
        let count = |of: Verdict| pairs.iter().filter(|(_, verdict)| *verdict == of).count() as u64;
        let found = [Verdict::Intersect, Verdict::PossiblyIncorrect].map(count);
        let expected = [report.intersect, report.possibly_incorrect].map(u64::from);
        // Each by itself: a certain contact that a report does not count would not be retested.
        match found.into_iter().zip(expected).find(|(found, expected)| found != expected) {
            Some((found, expected)) => Err(EngineError::Count { found, expected }),
            None if report.reason == Reason::Contact && found[0] == 0 => {
                Err(EngineError::Count { found: 0, expected: 1 })
            }
            None => Ok(pairs),
        }
    }

    /// The exact answer for two triangles.
    fn exact(&self, triangles: [u32; 2]) -> Exact {
        let corners =
            |side: usize| self.objects.meshes[self.pair[side]].triangle(triangles[side] as usize).map(<[f64; 3]>::from);
        let answer = retest_posed(&corners(0), &corners(1), &self.pose.rows(), &self.pose.translation().into());
        answer.expect("meshes and poses are finite")
    }

    /// The answer of the software.
    fn in_software(&self, report: Option<EngineReport>, cause: Cause) -> Contacts {
        let [a, b] = self.pair.map(|object| self.objects.tree(object));
        let contact = |((p, q), exact): ((u32, u32), Exact)| Contact { triangles: [p, q], verdict: None, exact };
        let mut scratch = Scratch::default();
        let pairs = if self.options.first_contact {
            let mut exact = Exact::Separate;
            let hits = |(p, q): (u32, u32)| {
                exact = self.exact([p, q]);
                exact != Exact::Separate
            };
            let (hit, _) = first_hit(a, b, &self.pose, &mut scratch, hits);
            hit.map(|pair| contact((pair, exact))).into_iter().collect()
        } else {
            let meshes = self.pair.map(|object| self.objects.meshes[object]);
            let (found, _) = contacts(meshes, [a, b], &self.pose, &mut scratch);
            found.into_iter().map(|(pair, kind)| contact((pair, kind.into()))).collect()
        };
        Contacts { pairs, report, software: Some(cause) }
    }
}
