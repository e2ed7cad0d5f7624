//! The cascade: open pairs in their queue, the order of the answers, the rates, and stalls (docs/cascade.md).

use crate::extent::share;
use crate::protocol::{Unit, expected};
use efsat::artefact::Stimulus;
use efsat::design::{Design, Probes};
use efsat::golden::Golden;
use efsat::netlist::{Driver, Module};
use efsat::op::{Constant, Type};
use efsat::pair::{Pair, Pose};
use efsat::params::{Method, Params};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::rc::Rc;

fn params(clocks_per_pair: u32, exact_clocks: u32) -> Params {
    let p = Params {
        width: 10,
        transform_width: 12,
        clocks_per_pair,
        exact_clocks: Some(exact_clocks),
        ..Params::of(Method::Exact)
    };
    p.validate().unwrap();
    p
}

/// Pairs of a parameter set by whether the first stage leaves them open.
struct Pairs {
    decided: Vec<Pair>,
    open: Vec<Pair>,
}

impl Pairs {
    fn new(p: &Params) -> Self {
        let golden = Golden::new(p);
        let all = Stimulus::random(p, 4000, 5).segments.into_iter().flat_map(|segment| segment.1);
        let (open, decided): (Vec<Pair>, Vec<Pair>) = all.partition(|pair| golden.is_open(&Pose::identity(p), pair));
        assert!(open.len() > 300 && decided.len() > 1000, "{} open, {} decided", open.len(), decided.len());
        Self { decided, open }
    }

    /// So many pairs, of which a share in 256 is open.
    fn mixed(&self, rng: &mut ChaCha8Rng, count: usize, share: u32) -> Vec<Pair> {
        let one = |_| {
            let from = if rng.random_range(0..256) < share { &self.open } else { &self.decided };
            from[rng.random_range(0..from.len())]
        };
        (0..count).map(one).collect()
    }
}

/// An answer: the clock in which it was taken, its tag, what it says.
type Answer = (usize, i128, [i128; 3]);

/// What came of some pairs: when each was accepted, and the answers.
#[derive(Default)]
struct Run {
    accepted: Vec<usize>,
    answers: Vec<Answer>,
}

impl Run {
    /// Offers all pairs, each when `offers` says so, and takes answers when `takes` says so.
    fn new(unit: &mut Unit, pairs: &[Pair], mut offers: impl FnMut() -> bool, mut takes: impl FnMut() -> bool) -> Self {
        let mut run = Self::default();
        let (mut offered, mut clock, mut last) = (false, 0, 0);
        while run.answers.len() < pairs.len() && clock < last + 10_000 {
            let next = run.accepted.len();
            offered = next < pairs.len() && (offered || offers());
            if offered {
                unit.offer(&pairs[next], next as i128);
            }
            let ready = takes();
            unit.set("in_valid", i128::from(offered));
            unit.set("out_ready", i128::from(ready));
            unit.clock();
            if offered && unit.get("in_ready") == 1 {
                run.accepted.push(clock);
                offered = false;
            }
            if ready && unit.get("out_valid") == 1 {
                run.answers.push((clock, unit.get("out_tag"), unit.answer()));
                last = clock;
            }
            clock += 1;
        }
        unit.set("in_valid", 0);
        unit.set("out_ready", 0);
        run
    }

    /// Every pair has the answer of the reference model, in the order of the pairs.
    fn is_right(&self, p: &Params, pairs: &[Pair]) -> bool {
        let all = pairs.iter().enumerate().map(|(i, pair)| (i as i128, expected(p, &Pose::identity(p), pair)));
        let found = self.answers.iter().map(|(_, tag, answer)| (*tag, *answer));
        found.eq(all)
    }
}

/// Rates at which a stage is quick or slow.
const RATES: [(u32, u32); 4] = [(1, 16), (1, 11), (2, 32), (11, 15)];

#[test]
fn with_gaps_and_stalls_every_pair_is_answered_once_and_in_order() {
    for (clocks_per_pair, exact_clocks) in share(2, RATES) {
        let p = params(clocks_per_pair, exact_clocks);
        let (mut unit, pairs) = (Unit::new(&p), Pairs::new(&p));
        let mut rng = ChaCha8Rng::seed_from_u64(exact_clocks.into());
        for (share, offers, takes) in [(16, 256, 256), (64, 100, 256), (128, 256, 30), (200, 256, 8), (256, 200, 200)] {
            let given = pairs.mixed(&mut rng, 250, share);
            let [mut a, mut b] = [1, 2].map(|_| ChaCha8Rng::from_rng(&mut rng));
            let by = |rng: &mut ChaCha8Rng, share: u32| rng.random_range(0..256) < share;
            let run = Run::new(&mut unit, &given, || by(&mut a, offers), || by(&mut b, takes));
            assert!(run.is_right(&p, &given), "{p:?}: {share} of 256 open, {} answers", run.answers.len());
        }
    }
}

#[test]
fn if_all_pairs_are_open_the_second_stage_sets_the_pace() {
    for (clocks_per_pair, exact_clocks) in share(2, RATES) {
        let p = params(clocks_per_pair, exact_clocks);
        let (mut unit, pairs) = (Unit::new(&p), Pairs::new(&p));
        let given = pairs.mixed(&mut ChaCha8Rng::seed_from_u64(1), 300, 256);
        let run = Run::new(&mut unit, &given, || true, || true);
        assert!(run.is_right(&p, &given), "{p:?}");
        // From the second answer on one comes in each slot of the second stage, and nothing else passes.
        assert!(run.answers.windows(2).all(|two| two[1].0 - two[0].0 == exact_clocks as usize), "{p:?}");
        // Meanwhile the first stage goes on until every place is promised.
        let places = unit.design.places;
        let early = run.accepted.windows(places).position(|all| all[places - 1] - all[0] < 2 * places * p.interval());
        assert_eq!(early, Some(0), "{p:?}");
        let in_flight = |clock: usize| {
            let until = |clocks: &mut dyn Iterator<Item = usize>| clocks.filter(|c| *c <= clock).count();
            until(&mut run.accepted.iter().copied()) - until(&mut run.answers.iter().map(|answer| answer.0))
        };
        let most = run.accepted.iter().map(|clock| in_flight(*clock)).max().unwrap();
        assert!((places..=places + 1).contains(&most), "{most} in flight, {places} places");
    }
}

#[test]
fn few_open_pairs_do_not_slow_the_unit_down() {
    let p = params(1, 16);
    let (mut unit, pairs) = (Unit::new(&p), Pairs::new(&p));
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut given = pairs.mixed(&mut rng, 1500, 0);
    for i in (100..1500).step_by(250) {
        given[i] = pairs.open[i % pairs.open.len()];
    }
    let run = Run::new(&mut unit, &given, || true, || true);
    assert!(run.is_right(&p, &given));
    assert_eq!(run.accepted.last().unwrap() - run.accepted[0], 1499, "one pair per clock");
}

#[test]
fn latencies_are_as_declared() {
    for (clocks_per_pair, exact_clocks) in share(2, RATES) {
        let p = params(clocks_per_pair, exact_clocks);
        let pairs = Pairs::new(&p);
        let mut unit = Unit::new(&p);
        let mut rng = ChaCha8Rng::seed_from_u64(6);
        let mut clocks = |pair: &Pair| {
            let run = Run::new(&mut unit, &[*pair], || rng.random_range(0..8) == 0, || true);
            run.answers[0].0 - run.accepted[0]
        };
        assert_eq!(clocks(&pairs.decided[0]), Design::new(&p, Probes::None).unwrap().latency);
        // From every phase of the slot of the second stage.
        let open: Vec<usize> = pairs.open.iter().take(200).map(&mut clocks).collect();
        let most = unit.design.second.as_ref().unwrap().latency;
        // Where the slots of both stages have a common factor, pairs do not meet every phase of the second.
        let met = *open.iter().max().unwrap();
        assert!((most + 1 - p.interval()..=most).contains(&met), "{p:?}: {met} of {most}");
        assert!(open.iter().all(|clocks| clocks + exact_clocks as usize > most), "{p:?}: {open:?}");
    }
}

#[test]
fn a_full_queue_of_open_pairs_loses_none() {
    let p = params(1, 16);
    let (mut unit, pairs) = (Unit::new(&p), Pairs::new(&p));
    let given = pairs.mixed(&mut ChaCha8Rng::seed_from_u64(3), 400, 256);
    // Nobody takes an answer for longer than the unit needs to be full.
    let mut clock = 0;
    let waits = || {
        clock += 1;
        clock > 4000
    };
    let run = Run::new(&mut unit, &given, || true, waits);
    let before = run.accepted.iter().filter(|clock| **clock < 4000).count();
    assert_eq!(before, unit.design.places + 1, "the places and the output register");
    assert!(run.is_right(&p, &given));
}

/// The design with another driver of a flag of the top.
fn with_constant(p: &Params, name: &str, value: i128) -> Design {
    let mut design = Design::new(p, Probes::None).unwrap();
    let mut top = Module::clone(&design.top);
    let signal = top.signals.iter_mut().find(|signal| signal.name() == name).unwrap();
    signal.driver = Driver::Combinational { op: Constant(value, Type::FLAG).into(), args: vec![] };
    design.top = Rc::new(top);
    design
}

#[test]
#[ignore = "mistakes in the queue, each simulated: scripts/test full"]
fn wrong_queue_logic_is_caught() {
    let p = params(1, 16);
    let pairs = Pairs::new(&p);
    let given = pairs.mixed(&mut ChaCha8Rng::seed_from_u64(4), 200, 64);
    // Answers taken at once, then now and then.
    let right = |design: &dyn Fn() -> Design| {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        Run::new(&mut Unit::of(design()), &given, || true, || true).is_right(&p, &given)
            && Run::new(&mut Unit::of(design()), &given, || true, || rng.random_range(0..16) == 0).is_right(&p, &given)
    };
    assert!(right(&|| Design::new(&p, Probes::None).unwrap()));
    // The oldest pair does not wait for its answer; every pair is pushed, or none; answers of the second stage are never
    // taken, or with any pair.
    for (name, value) in [("head_ready", 1), ("push_open", 1), ("push_open", 0), ("take_exact", 0), ("take_exact", 1)] {
        assert!(!right(&|| with_constant(&p, name, value)), "{name} always {value}");
    }
}
