//! The sequencer: phases, handshakes, and the places of the pairs in flight.
//!
//! The data path never stops. A pair is accepted only in the last phase of a slot and only if a place in the result queue
//! is free for it, so whatever back-pressure there is, every verdict finds its place. Three pointers walk the queue:
//! accepted, decided, taken.

use super::slots::Slots;
use efsat_hardware::graph::{Place, Step};
use efsat_hardware::netlist::lower::{HOLDS, PHASE};
use efsat_hardware::netlist::{Control, Module, Wire};
use efsat_hardware::op::{Concatenate, Equal, Type};
use std::rc::Rc;

/// Places in the result queue for a data path of that latency: enough for every pair in flight at full speed, and no fewer
/// than one distributed memory holds.
pub fn places(latency: i32, interval: usize) -> usize {
    let in_flight = (latency as usize + 6).div_ceil(interval) + 1;
    in_flight.next_power_of_two().max(16)
}

/// One of the outputs of an instance, by its name.
pub fn output<'m>(module: &Module, outputs: &[Wire<'m>], name: &str) -> Wire<'m> {
    outputs[module.outputs.iter().position(|(place, _)| place.to_string() == name).expect("an output")]
}

/// Some outputs of a data path side by side, the first in the lowest bits.
pub fn result_word<'m>(path: &Module, results: &[Wire<'m>], names: &[&str]) -> Wire<'m> {
    let of_path = |name: &&str| -> Vec<Wire<'m>> {
        let outputs = path.outputs.iter().zip(results);
        outputs.filter(|((place, _), _)| place.base == **name).map(|(_, wire)| *wire).collect()
    };
    let parts: Vec<Wire> = names.iter().flat_map(of_path).collect();
    parts[0].apply(Concatenate, &parts[1..]).named("result_word")
}

/// What a sequencer is for.
pub struct Sequencer {
    /// Name of the module.
    pub name: &'static str,
    /// Phases of a slot.
    pub interval: usize,
    /// The outputs of the data path are there so many clocks after phase 0 of its inputs.
    pub latency: i32,
    /// Places in the result queue.
    pub places: usize,
    /// Whether the data path reads a pose.
    pub pose: bool,
    /// Whether what is offered stays until it is accepted.
    pub stays: bool,
    /// Whether the oldest verdict is taken only with `head_ready` set.
    pub waits: bool,
}

/// The sequencer of a data path.
pub fn module(sequencer: &Sequencer) -> Rc<Module> {
    let Sequencer { name, interval, latency, places, pose, stays, waits } = *sequencer;
    let address = places.trailing_zeros();
    let doc = [
        "Phases of the slot, handshakes and FIFO pointers. A pair is accepted in the last phase of a slot if a place",
        "in the result FIFO is free; the data path itself never stops.",
    ];
    let m = Control::new(name, doc.map(str::to_owned).to_vec());
    let [reset, in_valid] = ["reset", "in_valid"].map(|name| m.input(name, Type::FLAG));
    let pose_valid = pose.then(|| m.input("pose_valid", Type::FLAG));
    let out_ready = m.input("out_ready", Type::FLAG);
    let head_ready = waits.then(|| m.input("head_ready", Type::FLAG));
    let slots = Slots::new(&m, reset, interval);
    // Where a slot has several clocks nothing is accepted before its last phase.
    let running = (interval == 1).then(|| {
        let running = m.register("running", Type::FLAG);
        running.loads(m.constant(1, Type::FLAG), None, Some((reset, 0)));
        running.comment("clear in reset and in the first clock after: nothing is accepted")
    });
    if let Some(phase) = slots.phase {
        phase.output(PHASE);
    }

    // Queue pointers, one bit longer than the address to tell full from empty.
    let ty = Type::unsigned(address + 1);
    let accepted = if running.is_some() { Pointer::ahead } else { Pointer::new }(&m, "accepted", ty);
    let taken = Pointer::ahead(&m, "taken", ty);
    let decided = Pointer::new(&m, "decided", ty);
    // The accepted count at which every place is promised.
    let turned = taken.count.plus(1 << address).named("taken_turned");
    let last_next = slots.phase.map(|phase| phase.is(interval as i128 - 2));
    let in_ready = match last_next {
        // Nothing is accepted in the clock before the last phase, so what is full there is full in the last phase.
        Some(last_next) => {
            let full = accepted.count.apply(Equal, &[turned]).named("full");
            let ready = m.register("accepts", Type::FLAG);
            ready.loads(last_next & !full, None, Some((reset, 0)));
            ready.comment("the last phase, and a place is free")
        }
        None => {
            let full = accepted.meets("full", turned, (reset, 0));
            (running.expect("a slot of one clock") & !full).named("accepts")
        }
    };
    // A pair that waits for a place is loaded again in each slot: so what enables its registers, of which some are far from the
    // others, is not the end of the logic that accepts, but a register. An offer that stays is looked at a clock before the last
    // phase; else they load whether a pair is offered or not, and what is no pair goes into no answer. Where a slot has one clock
    // the offer itself enables them.
    let (offered, load) = match (slots.last, last_next) {
        (Some(_), Some(last_next)) if stays => {
            let offered = m.register("offered_in_time", Type::FLAG);
            offered.loads(in_valid & last_next, None, Some((reset, 0)));
            (offered, offered)
        }
        // Tools would make one register of this one and `last_phase` if both were the same in reset, and far from both.
        (Some(_), Some(last_next)) => {
            let phase = m.register("load_phase", Type::FLAG);
            phase.comment(
                "the last phase, in which hundreds of registers load; set in reset and in the first clock after, where nothing is accepted",
            );
            phase.loads(last_next, None, Some((reset, 1)));
            (in_valid, phase)
        }
        _ => (in_valid, in_valid),
    };
    load.output("load_pair");
    let accept = (offered & in_ready).named("accept_pair");
    accepted.advance(accept, reset);

    let holds = slots.holds(accept, latency as usize);
    if slots.phase.is_some() {
        holds.iter().enumerate().for_each(|(age, flag)| flag.output(Place::at(HOLDS, &[Step::Index(age)])));
    }
    let decide = slots.leaves(&holds, "decide_phase", latency as usize).named("decide_pair");
    decided.advance(decide, reset);

    // The output register: filled from the queue when it is empty or just being taken.
    let empty = taken.meets("empty", decided.count, (reset, 1));
    let offered = m.register("offered", Type::FLAG);
    let free = (!offered | out_ready).named("output_free");
    let take = !empty & free;
    let take = head_ready.map_or(take, |ready| take & ready).named("take_pair");
    offered.loads(take | !free, None, Some((reset, 0)));
    taken.advance(take, reset);

    in_ready.output("in_ready");
    accept.output("accept");
    decide.output("decide");
    offered.output("out_valid");
    take.output("take");
    accepted.count.low(address).named("accept_place").output("accept_address");
    decided.count.low(address).named("decide_place").output("decide_address");
    taken.count.low(address).named("take_place").output("take_address");
    if let Some(pose_valid) = pose_valid {
        pending_pose(&m, reset, pose_valid, last_next);
    }
    m.finish()
}

/// A pose waits until the running slot is over, then takes effect for the next pair. `last_next` tells that the last phase
/// follows; without it every phase is the last.
fn pending_pose<'m>(m: &'m Control, reset: Wire<'m>, pose_valid: Wire<'m>, last_next: Option<Wire<'m>>) {
    let load = m.register("load_pose", Type::FLAG);
    // Straight from a register: where a slot has several clocks it enables the registers of the next pose in every clock in
    // which none waits, and they keep the one that is taken.
    let ready = m.register("takes_pose", Type::FLAG);
    let taken = (pose_valid & ready).named("accept_pose");
    let (waits_next, load_next) = match last_next {
        None => (taken, taken),
        Some(last) => {
            let pending = m.register("pose_pending", Type::FLAG);
            let waits = (pending & !load).named("pose_waits");
            let next = (waits | taken).named("pose_pending_next");
            pending.loads(next, None, Some((reset, 0)));
            (next, next & last)
        }
    };
    ready.comment("no pose waits; clear in reset and in the first clock after").loads(
        !waits_next,
        None,
        Some((reset, 0)),
    );
    load.comment("a pose waits, and the next pair reads it").loads(load_next, None, Some((reset, 0)));
    load.output("pose_load");
    ready.output("pose_ready");
}

/// The pointers of a queue that never overflows: its writer makes sure of a place.
pub fn pointers(name: &str, depth: usize) -> Rc<Module> {
    let address = depth.trailing_zeros();
    let m = Control::new(name, vec!["The pointers of a queue that is never full when something is pushed.".to_owned()]);
    let [reset, push, pop] = ["reset", "push", "pop"].map(|name| m.input(name, Type::FLAG));
    let ty = Type::unsigned(address + 1);
    let pushed = Pointer::new(&m, "pushed", ty);
    pushed.advance(push, reset);
    let popped = Pointer::ahead(&m, "popped", ty);
    let empty = popped.meets("empty", pushed.count, (reset, 1));
    popped.advance(pop, reset);
    (!empty).named("holds_some").output("valid");
    pushed.count.low(address).named("push_place").output("push_address");
    popped.count.low(address).named("pop_place").output("pop_address");
    m.finish()
}

/// A pointer of a queue.
struct Pointer<'m> {
    m: &'m Control,
    count: Wire<'m>,
    ahead: Option<Ahead<'m>>,
}

/// Of a pointer that is compared as it is now: its successor, and whether it moved in the last clock.
struct Ahead<'m> {
    count: Wire<'m>,
    moved: Wire<'m>,
}

impl<'m> Pointer<'m> {
    fn new(m: &'m Control, name: &str, ty: Type) -> Self {
        Self { m, count: m.register(name, ty), ahead: None }
    }

    fn ahead(m: &'m Control, name: &str, ty: Type) -> Self {
        let register = |part: &str, ty| m.register(format!("{name}{part}").as_str(), ty);
        let pointer = Self::new(m, name, ty);
        Self { ahead: Some(Ahead { count: register("_ahead", ty), moved: register("_moved", Type::FLAG) }), ..pointer }
    }

    /// Whether the pointer equals `other` as it was in the last clock. The comparison is registered; what happened meanwhile
    /// is known, so it is made for both cases, with the pointer and with its successor. `at_reset` is what it is with all
    /// pointers at zero.
    fn meets(&self, name: &str, other: Wire<'m>, at_reset: (Wire<'m>, i128)) -> Wire<'m> {
        let ahead = self.ahead.as_ref().expect("a pointer with its successor");
        let registered = |case: &str, pointer: Wire<'m>| {
            let flag = self.m.register(format!("{name}_if_{case}").as_str(), Type::FLAG);
            flag.loads(pointer.apply(Equal, &[other]), None, Some(at_reset));
            flag
        };
        ahead.moved.choose(registered("moved", ahead.count), registered("still", self.count)).named(name)
    }

    /// Connects the registers: the pointer moves on where `when` is set.
    fn advance(&self, when: Wire<'m>, reset: Wire<'m>) {
        let next = self.ahead.as_ref().map_or_else(|| self.count.plus(1), |ahead| ahead.count);
        self.count.loads(next, Some(when), Some((reset, 0)));
        if let Some(ahead) = &self.ahead {
            ahead.count.loads(ahead.count.plus(1), Some(when), Some((reset, 1)));
            ahead.moved.loads(when, None, Some((reset, 0)));
        }
    }
}
