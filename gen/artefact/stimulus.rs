//! Seeded stimuli that reach every part of the unit.

use super::Stimulus;
use crate::golden::{sample, Pose};
use crate::params::{Params, Transform};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Pairs under one pose.
const SEGMENT: usize = 16;

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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_names_its_stimulus() {
        let params = Params::default();
        let [first, again, other] = [1, 1, 2].map(|seed| Stimulus::random(&params, 100, seed).segments);
        assert_eq!(first, again);
        assert_ne!(first, other);
        let sizes: Vec<usize> = first.iter().map(|segment| segment.1.len()).collect();
        assert_eq!(sizes, [16, 16, 16, 16, 16, 16, 4]);
    }
}
