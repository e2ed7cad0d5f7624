//! Seeded stimuli that reach every part of the unit.

use super::Stimulus;
use crate::host::sample::{self, Outside};
use crate::pair::Pose;
use crate::params::{Params, Transform};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Pairs under one pose.
const SEGMENT: usize = 16;

/// Seed of the words outside the declared ranges.
const WORDS: u64 = 5;

impl Stimulus {
    /// `count` pairs as the unit reads them, in segments of 16 under random poses (with `--transform off`: none). About
    /// a quarter of the pairs, and of the poses, are at the corners of the declared ranges, the rest is near contact
    /// under the pose. A seed names its stimulus on every machine.
    pub fn random(params: &Params, count: usize, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut segments = vec![];
        for start in (0..count).step_by(SEGMENT) {
            let pose = match params.transform {
                Transform::Off => Pose::identity(params),
                _ if rng.random_range(0..4) == 0 => sample::corner_pose(&mut rng, params),
                _ => sample::random_pose(&mut rng, params),
            };
            let pairs = (start..count.min(start + SEGMENT)).map(|_| match rng.random_range(0..4) {
                0 => sample::corner_pair(&mut rng, params),
                _ => sample::random_pair_under(&mut rng, params, &pose),
            });
            segments.push((pose, pairs.collect()));
        }
        Self { segments }
    }

    /// Words for a guard, none for a unit without one: every number of pair and pose outside its declared range once, the
    /// ways of [`Outside`] in turn and the others inside, with pairs inside in between, and some poses that are outside but
    /// bypassed. No host sends any of them.
    pub fn outside(params: &Params) -> Self {
        let mut segments = vec![];
        if !params.guarded() {
            return Self { segments };
        }
        let mut rng = ChaCha8Rng::seed_from_u64(WORDS);
        let way = |number: usize| Outside::ALL[number % Outside::ALL.len()];
        let mut pose = Pose::identity(params);
        for vertex in 0..6 {
            if params.transform != Transform::Off {
                pose = sample::random_pose(&mut rng, params);
            }
            let mut pairs = vec![];
            for number in 3 * vertex..3 * vertex + 3 {
                let pair = sample::random_pair_under(&mut rng, params, &pose);
                pairs.push(sample::pair_outside(&mut rng, params, pair, number, way(number)));
            }
            pairs.push(sample::random_pair_under(&mut rng, params, &pose));
            segments.push((pose, pairs));
        }
        let numbers = 0..sample::pose_size(params);
        let bypassed = numbers.clone().step_by(4).map(|number| (number, true));
        for (number, bypass) in numbers.map(|number| (number, false)).chain(bypassed) {
            let pose = sample::corner_pose(&mut rng, params);
            let pose = Pose { bypass, ..sample::pose_outside(&mut rng, params, pose, number, way(number)) };
            segments.push((pose, vec![sample::random_pair(&mut rng, params)]));
        }
        Self { segments }
    }

    /// All of this and then all of that.
    pub fn followed_by(mut self, other: Self) -> Self {
        self.segments.extend(other.segments);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Guard, Upper};

    #[test]
    fn a_seed_names_its_stimulus() {
        let params = Params::default();
        let [first, again, other] = [1, 1, 2].map(|seed| Stimulus::random(&params, 100, seed).segments);
        assert_eq!(first, again);
        assert_ne!(first, other);
        let sizes: Vec<usize> = first.iter().map(|segment| segment.1.len()).collect();
        assert_eq!(sizes, [16, 16, 16, 16, 16, 16, 4]);
    }

    #[test]
    fn a_guard_sees_every_number_outside() {
        let golden = |params: &Params| crate::golden::Golden::new(params);
        for (transform, renormalise, due) in
            [(Transform::On, false, 18 + 12), (Transform::Translate, true, 18 + 3), (Transform::Off, true, 18)]
        {
            for upper in [Upper::Implied, Upper::Sticky] {
                let params = Params { transform, renormalise, upper, ..Params::default() };
                let stimulus = Stimulus::outside(&params);
                let all = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
                let outside = all.filter(|(pose, pair)| golden(&params).outcome(pose, pair).outside).count();
                assert_eq!(outside, due, "{params:?}");
            }
        }
        assert!(
            Stimulus::outside(&Params { guard: Guard::LeftOut, ..Params::default() }).segments.is_empty(),
            "no guard"
        );
    }
}
