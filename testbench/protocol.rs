//! The protocol of the top, clock by clock: which pose a pair gets, what reset does, what back-pressure does.

use crate::extent::share;
use crate::tools::clocked::Clocked;
use efsat::artefact::Stimulus;
use efsat::artefact::vectors::{Word, answer_word, pair_word, pose_word};
use efsat::design::{Design, Probes};
use efsat::golden::Golden;
use efsat::host::sample;
use efsat::pair::{Input, Pair, Pose};
use efsat::params::{CLOCKS_PER_PAIR, Method, Params, Transform};
use rand::SeedableRng;

/// Units of all methods, at several rates.
fn units() -> Vec<Params> {
    let axes = [1, 3, 11].map(|axes_per_clock| Params { axes_per_clock, ..Params::default() });
    let determinants = CLOCKS_PER_PAIR.iter().map(|clocks| determinants(*clocks));
    let exact = [1, 6].map(|clocks_per_pair| Params {
        clocks_per_pair,
        transform: Transform::Translate,
        ..Params::of(Method::Exact)
    });
    let cascade = Params { exact_clocks: Some(16), transform: Transform::Translate, ..Params::of(Method::Exact) };
    axes.into_iter().chain(determinants).chain(exact).chain([cascade]).collect()
}

fn determinants(clocks_per_pair: u32) -> Params {
    Params { method: Method::Determinants, clocks_per_pair, ..Params::default() }
}

/// The top, driven one clock at a time.
pub struct Unit {
    pub design: Design,
    ports: Clocked,
}

impl Unit {
    pub fn new(params: &Params) -> Self {
        Self::of(Design::new(params, Probes::None).unwrap())
    }

    pub fn of(design: Design) -> Self {
        let ports = Clocked::new(&design.top);
        Self { design, ports }
    }

    pub fn set(&mut self, name: &str, value: i128) {
        self.ports.set(name, value);
    }

    fn put(&mut self, word: &Word) {
        for (name, value, _) in &word.fields {
            self.set(name, *value);
        }
    }

    pub fn clock(&mut self) {
        self.ports.clock();
    }

    /// An output in the clock just run.
    pub fn get(&self, name: &str) -> i128 {
        self.ports.get(name)
    }

    pub fn answer(&self) -> [i128; 3] {
        ["out_verdict", "out_separated", "out_overlapping"].map(|n| self.get(n))
    }

    /// Puts a pair and its tag on the ports.
    pub fn offer(&mut self, pair: &Pair, tag: i128) {
        self.put(&pair_word(&self.design.params, pair));
        self.set("in_tag", tag);
    }

    /// Offers a pair until it is accepted.
    fn send(&mut self, pair: &Pair, tag: i128) {
        self.offer(pair, tag);
        self.set("in_valid", 1);
        loop {
            self.clock();
            if self.get("in_ready") == 1 {
                break;
            }
        }
        self.set("in_valid", 0);
    }

    /// Waits for the next answer and takes it.
    fn take(&mut self) -> (i128, [i128; 3]) {
        self.set("out_ready", 1);
        for _ in 0..10_000 {
            self.clock();
            if self.get("out_valid") == 1 {
                let taken = (self.get("out_tag"), self.answer());
                self.set("out_ready", 0);
                return taken;
            }
        }
        panic!("no answer");
    }
}

pub fn expected(p: &Params, pose: &Pose, pair: &Pair) -> [i128; 3] {
    let word = answer_word(p, &Golden::new(p).outcome(pose, pair));
    [0, 1, 2].map(|i| word.fields[i].1)
}

/// Pairs that are answered differently without a pose and under each of two poses, and the poses. For an exact unit these
/// are a shift within its range and one that brings every pair out of it.
fn telling(p: &Params) -> (Pose, Pose, Vec<Pair>) {
    let mut rng = rand::rngs::ChaCha8Rng::seed_from_u64(4);
    let identity = Pose::identity(p);
    let [first, second] = [p.width - 6, p.width + 2].map(|bits| {
        if p.method == Method::Exact {
            let shift = [1 << bits, 0, 0].map(Input::exact);
            return Pose { t: shift, bypass: false, ..identity };
        }
        loop {
            let pose = sample::random_pose(&mut rng, p);
            if !pose.bypass {
                break pose;
            }
        }
    });
    let mut pairs = vec![];
    while pairs.len() < 6 {
        let pair = sample::random_pair_under(&mut rng, p, &identity);
        let answers = [identity, first, second].map(|pose| expected(p, &pose, &pair));
        if answers[0] != answers[1] && answers[1] != answers[2] && answers[0] != answers[2] {
            pairs.push(pair);
        }
    }
    (first, second, pairs)
}

#[test]
fn a_pose_holds_for_pairs_accepted_in_a_later_clock() {
    for p in units() {
        let (first, second, pairs) = telling(&p);
        let mut unit = Unit::new(&p);
        // After reset: the bypass.
        unit.send(&pairs[0], 1);
        // A pose, then a pair in a later clock. A pose is taken at once, or when the one that waits is active.
        unit.put(&pose_word(&p, &first));
        unit.set("pose_valid", 1);
        let taken = (0..p.interval()).any(|_| {
            unit.clock();
            unit.get("pose_ready") == 1
        });
        assert!(taken, "no pose is pending");
        unit.set("pose_valid", 0);
        // What is not offered must not be read.
        unit.put(&pose_word(&p, &second));
        unit.send(&pairs[1], 2);
        // A pose and a pair offered at once, from every clock of the slot on: the pair has the new pose if that was accepted in
        // an earlier clock, and the old one if both are accepted in the same.
        for wait in 0..p.interval() {
            let mut both = Unit::new(&p);
            (0..wait).for_each(|_| both.clock());
            both.put(&pair_word(&p, &pairs[2]));
            both.set("in_tag", 3);
            both.set("in_valid", 1);
            both.put(&pose_word(&p, &second));
            both.set("pose_valid", 1);
            let mut accepted = [None; 2];
            for clock in 0..2 * p.interval() + 1 {
                both.clock();
                for (i, (ready, valid)) in
                    [("in_ready", "in_valid"), ("pose_ready", "pose_valid")].into_iter().enumerate()
                {
                    if accepted[i].is_none() && both.get(ready) == 1 {
                        accepted[i] = Some(clock);
                        both.put(&if i == 0 { pair_word(&p, &pairs[0]) } else { pose_word(&p, &first) });
                    }
                    both.set(valid, i128::from(accepted[i].is_none()));
                }
            }
            let [Some(pair), Some(pose)] = accepted else { panic!("pair and pose are accepted within two slots") };
            both.send(&pairs[3], 4);
            let in_force = if pose < pair { second } else { Pose::identity(&p) };
            assert_eq!(both.take(), (3, expected(&p, &in_force, &pairs[2])), "offered after {wait} clocks");
            assert_eq!(both.take(), (4, expected(&p, &second, &pairs[3])), "the next pair has the new pose");
        }

        assert_eq!(unit.take(), (1, expected(&p, &Pose::identity(&p), &pairs[0])));
        assert_eq!(unit.take(), (2, expected(&p, &first, &pairs[1])));
    }
}

/// How often an operand of a product changes while some pairs go through a unit, `pauses` times as long from pair to pair as a pair
/// takes, until the last one is decided; and whether all rest after that: while the ports do, or whatever they carry in a unit of a
/// pair per clock, whose pair is loaded where one is offered alone.
fn changes_of_operands(params: &Params, pauses: usize) -> (usize, bool) {
    let mut unit = Unit::new(params);
    let interval = unit.design.interval;
    let latency = unit.design.second.as_ref().map_or(unit.design.latency, |second| second.latency);
    let mut rng = rand::rngs::ChaCha8Rng::seed_from_u64(5);
    let mut pair = || sample::random_pair_under(&mut rng, params, &Pose::identity(params));
    let (mut before, mut changes) = (unit.ports.multiplied(), 0);
    let mut clock = |unit: &mut Unit| {
        unit.clock();
        let now = unit.ports.multiplied();
        let changed = before.iter().zip(&now).filter(|(before, now)| before != now).count();
        before = now;
        changes += changed;
        changed
    };
    unit.set("out_ready", 1);
    for tag in 0..12 {
        unit.offer(&pair(), tag);
        unit.set("in_valid", 1);
        while {
            clock(&mut unit);
            unit.get("in_ready") == 0
        } {}
        unit.set("in_valid", 0);
        for _ in 0..pauses * (latency + 4 * interval) {
            clock(&mut unit);
        }
    }
    // In a cascade all pairs may wait for the second stage.
    for _ in 0..latency + 12 * params.exact_clocks.map_or(interval, |clocks| clocks as usize) {
        clock(&mut unit);
    }
    let rests = (0..3 * interval).all(|_| {
        if interval == 1 {
            unit.offer(&pair(), 0);
        }
        clock(&mut unit) == 0
    });
    (changes, rests)
}

/// Slots without a pair cost no power in multipliers: nothing is captured, what selects rests, and when delay lines have run
/// empty nothing moves, however long it takes until the next pair.
#[test]
fn products_rest_in_slots_without_a_pair() {
    for params in share(2, units()) {
        let found = [0, 1, 2].map(|pauses| changes_of_operands(&params, pauses));
        assert!(found.iter().all(|(_, rests)| *rests), "{params:?}");
        let [dense, apart, farther] = found.map(|(changes, _)| changes);
        assert_eq!(apart, farther, "{params:?}");
        assert!(0 < dense, "{params:?}");
    }
}

#[test]
fn reset_empties_the_unit_and_restores_the_bypass() {
    for p in [Params::default(), determinants(1), determinants(2)] {
        let (first, _, pairs) = telling(&p);
        let mut unit = Unit::new(&p);
        unit.put(&pose_word(&p, &first));
        unit.set("pose_valid", 1);
        unit.clock();
        unit.set("pose_valid", 0);
        unit.send(&pairs[0], 1);
        unit.send(&pairs[1], 2);
        unit.set("reset", 1);
        unit.clock();
        unit.set("reset", 0);
        // In the first clock after it nothing is accepted.
        unit.set("pose_valid", 1);
        unit.clock();
        assert_eq!(["in_ready", "pose_ready"].map(|name| unit.get(name)), [0; 2], "{p:?}");
        unit.set("pose_valid", 0);
        unit.send(&pairs[2], 3);
        assert_eq!(unit.take(), (3, expected(&p, &Pose::identity(&p), &pairs[2])), "nothing from before the reset");
    }
}

#[test]
fn one_clock_of_reset_forgets_verdicts_that_wait() {
    for p in units() {
        for waiting in share(2, [1, 3, 1000]) {
            let (_, _, pairs) = telling(&p);
            let mut unit = Unit::new(&p);
            // As many pairs as asked for, or as fit; nobody takes the verdicts.
            unit.put(&pair_word(&p, &pairs[0]));
            let (mut accepted, mut clocks) = (0, 0);
            while clocks < 400 {
                unit.set("in_valid", i128::from(accepted < waiting));
                unit.clock();
                accepted += i32::from(unit.get("in_ready") == 1 && accepted < waiting);
                clocks += 1;
            }
            unit.set("in_valid", 0);
            assert_eq!(unit.get("out_valid"), 1, "verdicts wait");
            unit.set("reset", 1);
            unit.clock();
            unit.set("reset", 0);
            unit.set("out_ready", 1);
            for _ in 0..250 {
                unit.clock();
                assert_eq!(unit.get("out_valid"), 0, "a verdict from before the reset");
            }
            unit.set("out_ready", 0);
            unit.send(&pairs[1], 7);
            assert_eq!(unit.take(), (7, expected(&p, &Pose::identity(&p), &pairs[1])));
        }
    }
}

#[test]
fn a_full_unit_refuses_pairs_and_loses_none() {
    for p in units() {
        let mut unit = Unit::new(&p);
        let stimulus = Stimulus::random(&p, 400, 9);
        let pairs: Vec<Pair> = stimulus.segments.iter().flat_map(|s| s.1.clone()).collect();
        let mut accepted = 0;
        let mut refused = 0;
        while refused < 200 {
            unit.put(&pair_word(&p, &pairs[accepted]));
            unit.set("in_tag", accepted as i128);
            unit.set("in_valid", 1);
            unit.clock();
            if unit.get("in_ready") == 1 {
                accepted += 1;
                refused = 0;
            } else {
                refused += 1;
            }
        }
        unit.set("in_valid", 0);
        assert!(accepted >= unit.design.places, "{accepted} pairs before the unit was full");
        for (i, pair) in pairs.iter().enumerate().take(accepted) {
            assert_eq!(unit.take(), (i as i128, expected(&p, &Pose::identity(&p), pair)));
        }
    }
}
