//! The cascade: rounded determinants decide most pairs, one per clock, and an exact unit that is folded over many clocks
//! decides what they leave open (docs/cascade.md).
//!
//! Each stage is a data path of its own. Between them is a queue of open pairs, and the verdicts of the second stage wait
//! until they are the oldest: [`stage`] is all that is behind the first data path.

use super::super::determinants;
use super::super::determinants::{Points, differences};
use super::super::guard::Guards;
use super::super::pipeline::Inputs;
use super::super::sequencer::{self, Sequencer};
use super::{decided, fitted};
use crate::params::{BELOW_GRID, Params};
use efsat_hardware::graph::{Block, Library, Place, Sig, Signals, Vec3};
use efsat_hardware::netlist::{Control, Module, Wire};
use efsat_hardware::op::Type;
use std::rc::Rc;

/// What the names of the units of the second data path begin with.
pub const SECOND_STAGE: &str = "exact_";

/// Base of the names of the differences that are handed over.
pub const HANDED_OVER: &str = "fitted";

/// The first data path. Its outputs are those of the exact unit's, whether the pair is left open, and its differences.
pub fn first(p: &Params, first: &Params) -> Rc<Block> {
    let doc = [
        "The data path of one pair in the first stage: differences from V0, rounded to 18 bits behind the highest of them that",
        "is set, moments, fifteen determinants with bounds on their errors, verdict. Units are shared over the phases of the",
        "slot; a bound at a port covers all uses of the unit. A value captured for the pair is named after what it is; later",
        "copies end in _h<clocks>, or are elements of x_held.",
    ];
    Library::default().block("pair_pipeline", &doc, p.interval(), |u| {
        let inputs = Inputs::new(u, p);
        let guards = Guards::new(u, p);
        let doc = ["The points relative to V0, B's in A's frame, and whether they fit."];
        let (points, outside) = u.section("pair_differences", &doc, || {
            let differences = differences::points(u, p, &guards, &inputs);
            fitted(p, &differences, &guards)
        });
        let scaled = points.all().map(|point| point.map(|x| x.floor(-(BELOW_GRID as i32)))).named("scaled");
        let ((verdict, _), flags) = determinants::decided(u, first, &Points::of(scaled), Some(outside), true);
        let open = (verdict.floor(1) & !outside).named("left_open").comment("the second stage decides");
        (((verdict, outside), flags), (open, points.all()))
    })
}

/// The second data path, of differences that fit.
pub fn second(p: &Params, clocks: u32) -> Rc<Block> {
    let doc = [
        "The data path of one pair in the second stage: moments, fifteen determinants, the rule for pairs in one plane, verdict;",
        "nothing is rounded. Units are shared over the phases of the slot; a bound at a port covers all uses of the unit. A",
        "value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements of x_held.",
    ];
    Library::with_prefix(SECOND_STAGE).block("pipeline", &doc, clocks as usize, |u| {
        let most = (1i128 << (p.width - 1)) - 1;
        let ty = Type { signed: true, bits: p.width, fraction: None };
        let points: [Vec3<Sig>; 5] = std::array::from_fn(|_| Vec3::each(|_| u.input(ty, (-most, most))));
        let points = Points::of(points.named(HANDED_OVER));
        let ((verdict, _), flags) = decided(u, &points, None);
        (verdict, flags)
    })
}

/// All that is behind the first data path: the queue of open pairs, the second data path, and its verdicts until they are
/// taken.
///
/// No pair is lost: the unit accepts one only with a place in its result queue, which the pair keeps until its answer is
/// taken, and there are as many places here. There is no deadlock: both stages keep the order of their pairs, so if the oldest
/// pair in the unit is open, it is the oldest one here. Nothing else is needed for its answer, which comes and frees a place.
pub fn stage(path: &Rc<Module>, latency: i32, clocks: u32, places: usize) -> Rc<Module> {
    let doc = [
        "The second stage: open pairs wait in a queue with a place for every pair that the unit can accept, then the exact data",
        "path decides them one after the other. Its verdicts are taken in the order in which the pairs were pushed.",
    ];
    let m = Control::new("exact_stage", doc.map(str::to_owned).to_vec());
    let [reset, push] = ["reset", "push"].map(|name| m.input(name, Type::FLAG));
    let points: Vec<(&Place, Wire)> = path
        .inputs
        .iter()
        .map(|id| path.signal(*id))
        .filter(|signal| signal.place.base == HANDED_OVER)
        .map(|signal| (&signal.place, m.input(signal.place.clone(), signal.ty)))
        .collect();
    let take = m.input("take", Type::FLAG);
    let pop = m.later(Type::FLAG);
    let pointers = sequencer::pointers("open_pointers", places);
    let queue = m.instance("queue", &pointers, &[reset, push, pop]);
    let queue = |name: &str| sequencer::output(&pointers, &queue, name);
    let interval = clocks as usize;
    let sequencer = Sequencer {
        name: "exact_sequencer",
        interval,
        latency,
        places: sequencer::places(latency, interval),
        pose: false,
        // In the queue; so it is looked at a clock before the last phase.
        stays: true,
        waits: false,
    };
    let control = sequencer::module(&sequencer);
    let signals = m.instance("control", &control, &[reset, queue("valid"), take]);
    let of = |name: &str| sequencer::output(&control, &signals, name);
    pop.stands_for(of("accept"));
    let held = |(place, point): &(&Place, Wire<'_>)| {
        let waiting =
            m.memory(format!("open_{place}").as_str(), push, queue("push_address"), *point, queue("pop_address"));
        let register = |base: &str| m.register(Place { base: base.to_owned(), ..(*place).clone() }, waiting.ty());
        // A block memory takes half a clock period to give a word, so there is a register for its own output. It is in time:
        // the pointers tell of a word two clocks after it is pushed, and the next one is not taken in the clock after a pop.
        let [oldest, held] = ["oldest", "pair"].map(register);
        oldest.loads(waiting, None, None);
        held.loads(oldest, Some(of("load_pair")), None);
        ((*place).clone(), held)
    };
    let held: Vec<(Place, Wire)> = points.iter().map(held).collect();
    let given = |id: &_| {
        let place = &path.signal(*id).place;
        held.iter().find(|(held, _)| held == place).map_or_else(|| of(&place.to_string()), |(_, wire)| *wire)
    };
    let results = m.instance("path", path, &path.inputs.iter().map(given).collect::<Vec<_>>());
    let word = sequencer::result_word(path, &results, &["verdict", "separated", "overlapping"]);
    let decided = m.memory("result_queue", of("decide"), of("decide_address"), word, of("take_address"));
    let offered = m.register("offered_word", decided.ty());
    decided.comment("verdict and flags of the pairs decided and not yet taken");
    offered.loads(decided, Some(of("take")), None);
    of("out_valid").output("out_valid");
    offered.output("out_word");
    m.finish()
}
