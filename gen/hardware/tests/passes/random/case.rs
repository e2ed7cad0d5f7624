//! A random design as a list of steps, each with a few numbers: whatever they are, there is a legal design of them.

use super::build;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::fmt::{self, Display, Formatter};

/// Something that is made of the values there are.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub kind: &'static str,
    pub numbers: [usize; 4],
}

/// A design, and the values that it is run on.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    pub device: usize,
    pub megahertz: u32,
    pub interval: usize,
    /// Bits of the widest numbers.
    pub widest: u32,
    /// Of the values at the inputs.
    pub seed: u64,
    pub steps: Vec<Step>,
}

impl Case {
    /// The case of a number.
    pub fn random(number: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(number);
        let kinds: Vec<&str> = build::kinds().collect();
        let mut chosen: Vec<&str> =
            (0..random.random_range(3..25)).map(|_| kinds[random.random_range(0..kinds.len())]).collect();
        if random.random_range(0..3) == 0 {
            // Values of one stream in another order are rarely so many by chance that a delay line takes their place.
            chosen.extend(["wide_mux", "recall"]);
        }
        let steps = chosen.into_iter().map(|kind| Step {
            kind,
            // Mostly what was made last.
            numbers: [(); 4].map(|()| {
                let bits = random.random_range(1..11);
                random.random_range(0..1 << bits)
            }),
        });
        let steps = steps.collect();
        Self {
            device: random.random_range(0..4),
            megahertz: [40, 100, 150, 250][random.random_range(0..4)],
            interval: [1, 2, 3, 4, 5, 11][random.random_range(0..6)],
            widest: [16, 24, 24, 75][random.random_range(0..4)],
            seed: number,
            steps,
        }
    }

    /// The case of a text.
    pub fn parse(text: &str) -> Self {
        let mut lines = text.lines().map(|line| line.split(' ').collect::<Vec<_>>());
        let numbers =
            |words: &[&str]| -> Vec<usize> { words.iter().map(|word| word.parse().expect("a number")).collect() };
        let first = numbers(&lines.next().expect("a first line")[1..]);
        let step = |words: Vec<&str>| Step {
            kind: build::kinds().find(|kind| *kind == words[0]).expect("a known kind"),
            numbers: numbers(&words[1..]).try_into().expect("four numbers"),
        };
        Self {
            device: first[0],
            megahertz: first[1] as u32,
            interval: first[2],
            widest: first[3] as u32,
            seed: first[4] as u64,
            steps: lines.map(step).collect(),
        }
    }

    /// The smallest case found that fails too, and why it does.
    pub fn shrunk(&self, fails: impl Fn(&Self) -> Option<String>) -> (Self, String) {
        let mut best = self.clone();
        let mut why = fails(&best).expect("a case that fails");
        while let Some((smaller, reason)) =
            best.smaller().into_iter().find_map(|case| fails(&case).map(|why| (case, why)))
        {
            (best, why) = (smaller, reason);
        }
        (best, why)
    }

    /// Cases that are a little smaller.
    fn smaller(&self) -> Vec<Self> {
        let mut all = vec![];
        let mut length = self.steps.len();
        while length > 0 {
            for from in (0..self.steps.len()).step_by(length) {
                let mut case = self.clone();
                case.steps.drain(from..(from + length).min(self.steps.len()));
                all.push(case);
            }
            length /= 2;
        }
        let mut change = |f: &dyn Fn(&mut Self)| {
            let mut case = self.clone();
            f(&mut case);
            if case != *self {
                all.push(case);
            }
        };
        change(&|case| case.interval = 1.max(case.interval / 2));
        change(&|case| case.interval = 1.max(case.interval - 1));
        change(&|case| case.widest = 16);
        change(&|case| case.device = 0);
        change(&|case| case.megahertz = 100);
        for i in 0..self.steps.len() {
            for k in 0..4 {
                change(&|case| case.steps[i].numbers[k] = 0);
                change(&|case| case.steps[i].numbers[k] /= 2);
                change(&|case| case.steps[i].numbers[k] = case.steps[i].numbers[k].saturating_sub(1));
            }
        }
        all
    }
}

impl Display for Case {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { device, megahertz, interval, widest, seed, steps } = self;
        writeln!(f, "case {device} {megahertz} {interval} {widest} {seed}")?;
        for Step { kind, numbers: [a, b, c, d] } in steps {
            writeln!(f, "{kind} {a} {b} {c} {d}")?;
        }
        Ok(())
    }
}
