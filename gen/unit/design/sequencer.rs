//! The sequencer: phases, handshakes, and the places of the pairs in flight.
//!
//! The data path never stops. A pair is accepted only in the last phase of a slot and only if a place in the result
//! queue is free for it, so whatever back-pressure there is, every verdict finds its place. Three pointers walk the
//! queue: accepted, decided, taken.

use efsat_hardware::graph::lower::phase_bits;
use efsat_hardware::graph::netlist::{Module, ModuleBuilder, SignalId};
use efsat_hardware::graph::{Op, Type};
use std::rc::Rc;

/// Places in the result queue for a data path of that latency: enough for every pair in flight at full speed, and no
/// fewer than one distributed memory holds.
pub fn places(latency: i32, interval: usize) -> usize {
    let in_flight = (latency as usize + 6).div_ceil(interval) + 1;
    in_flight.next_power_of_two().max(16)
}

/// The sequencer of a data path whose outputs are there `latency` clocks after phase 0 of the inputs.
pub fn module(interval: usize, latency: i32) -> Rc<Module> {
    let depth = places(latency, interval);
    let address = depth.trailing_zeros();
    let mut m = ModuleBuilder::new(
        "sequencer",
        [
            "Phases of the slot, handshakes and queue pointers. A pair is accepted in the last phase of a slot if a place",
            "in the result queue is free; the data path itself never stops.",
        ]
        .map(str::to_owned)
        .to_vec(),
    );
    let reset = m.input("reset", Type::FLAG);
    let in_valid = m.input("in_valid", Type::FLAG);
    let pose_valid = m.input("pose_valid", Type::FLAG);
    let out_ready = m.input("out_ready", Type::FLAG);

    let one = m.constant("set", 1, Type::FLAG);
    let running = m.register("running", Type::FLAG);
    m.drive(running, one, None, Some((reset, 0)));
    m.comment(running, "clear in reset and in the first clock after: nothing is accepted");

    // Phase of the slot.
    let (phase, last, last_next) = if interval == 1 {
        (None, one, one)
    } else {
        let ty = Type::unsigned(phase_bits(interval));
        let phase = m.register("phase_count", ty);
        // Read all over the design, so it comes from a register.
        let last = m.register("last", Type::FLAG);
        let last_but_one = m.constant("last_but_one", interval as i128 - 2, ty);
        let last_next = m.op("last_next", Op::Equal, &[phase, last_but_one]);
        m.drive(last, last_next, None, Some((reset, 0)));
        m.comment(last, "last phase: a new slot begins in the next clock");
        let table = (0..interval as i128).map(|s| (s + 1) % interval as i128).collect();
        let next = m.op("phase_next", Op::Lookup(table, ty), &[phase]);
        m.drive(phase, next, None, Some((reset, 0)));
        m.output("phase", phase);
        (Some(phase), last, last_next)
    };

    // Queue pointers, one bit longer than the address to tell full from empty. Comparisons are registered; what
    // happened meanwhile is known, so each is made for both cases, with the pointer and with its successor.
    let ty = Type::unsigned(address + 1);
    let accepted = Pointer::new(&mut m, "accepted", ty);
    let taken = Pointer::new(&mut m, "taken", ty);
    let decided = m.register("decided_count", ty);
    let accept_place = m.op("accept_place", Op::LowBits(address), &[accepted.count]);
    let decide_place = m.op("decide_place", Op::LowBits(address), &[decided]);
    let take_place = m.op("take_place", Op::LowBits(address), &[taken.count]);
    let turn = m.constant("full_turn", 1 << address, ty);
    let beyond = m.op("taken_turned_sum", Op::Add, &[taken.count, turn]);
    let beyond = m.op("taken_turned", Op::LowBits(address + 1), &[beyond]);
    m.comment(beyond, "the accepted count at which every place is promised");
    let full = accepted.meets(&mut m, "full", beyond, (reset, 0));
    let room = m.op("room", Op::Not, &[full]);
    let open = m.op("slot_open", Op::And, &[running, last]);
    let in_ready = m.op("accepts", Op::And, &[open, room]);
    let accept = m.op("accept_pair", Op::And, &[in_valid, in_ready]);

    // Which slots in flight hold a pair: one flag a slot, shifted as slots begin.
    let ages = latency as usize / interval + 1;
    let mut held = accept;
    for age in 0..ages {
        let flag = m.register(&format!("slot_{age}_holds"), Type::FLAG);
        m.drive(flag, held, (interval > 1).then_some(last), Some((reset, 0)));
        held = flag;
    }
    m.comment(held, "the slot whose verdict is about to come holds a pair");
    let decide = if let Some(phase) = phase {
        let ty = m.ty(phase);
        let at = m.constant("decide_phase", i128::from(latency) % interval as i128, ty);
        let now = m.op("decide_now", Op::Equal, &[phase, at]);
        m.op("decide_pair", Op::And, &[held, now])
    } else {
        held
    };
    let empty = taken.meets(&mut m, "empty", decided, (reset, 1));
    let waiting = m.op("waiting", Op::Not, &[empty]);
    // The output register: filled from the queue when it is empty or just being taken.
    let offered = m.register("offered", Type::FLAG);
    let vacant = m.op("vacant", Op::Not, &[offered]);
    let free = m.op("output_free", Op::Or, &[vacant, out_ready]);
    let take = m.op("take_pair", Op::And, &[waiting, free]);
    let busy = m.op("output_busy", Op::Not, &[free]);
    let offered_next = m.op("offered_next", Op::Or, &[take, busy]);
    m.drive(offered, offered_next, None, Some((reset, 0)));
    accepted.advance(&mut m, accept, reset);
    taken.advance(&mut m, take, reset);
    let decided_next = successor(&mut m, "decided", decided);
    m.drive(decided, decided_next, Some(decide), Some((reset, 0)));

    // A pose waits until the running slot is over, then takes effect for the next pair.
    let pending = m.register("pose_pending", Type::FLAG);
    let not_pending = m.op("pose_free", Op::Not, &[pending]);
    let pose_ready = m.op("pose_accepts", Op::And, &[running, not_pending]);
    let pose_accept = m.op("accept_pose", Op::And, &[pose_valid, pose_ready]);
    let pose_load = m.register("load_pose", Type::FLAG);
    let kept = m.op("pose_unloaded", Op::Not, &[pose_load]);
    let stays = m.op("pose_stays", Op::And, &[pending, kept]);
    let next = m.op("pose_pending_next", Op::Or, &[stays, pose_accept]);
    m.drive(pending, next, None, Some((reset, 0)));
    let load_next = m.op("load_pose_next", Op::And, &[next, last_next]);
    m.drive(pose_load, load_next, None, Some((reset, 0)));
    m.comment(
        pose_load,
        "last phase, and a pose is pending; it enables hundreds of flip-flops, so it comes from a register",
    );

    m.output("begin_slot", last);
    m.output("in_ready", in_ready);
    m.output("accept", accept);
    m.output("decide", decide);
    m.output("pose_ready", pose_ready);
    m.output("pose_accept", pose_accept);
    m.output("pose_load", pose_load);
    m.output("out_valid", offered);
    m.output("take", take);
    m.output("accept_address", accept_place);
    m.output("decide_address", decide_place);
    m.output("take_address", take_place);
    m.finish()
}

/// A queue pointer with its successor, and whether it moved in the last clock.
struct Pointer {
    name: &'static str,
    count: SignalId,
    ahead: SignalId,
    moved: SignalId,
}

impl Pointer {
    fn new(m: &mut ModuleBuilder, name: &'static str, ty: Type) -> Self {
        Self {
            name,
            count: m.register(&format!("{name}_count"), ty),
            ahead: m.register(&format!("{name}_ahead"), ty),
            moved: m.register(&format!("{name}_moved"), Type::FLAG),
        }
    }

    /// Whether the pointer equals `other` as it was in the last clock.
    /// `at_reset` is what it is with all pointers at zero.
    fn meets(&self, m: &mut ModuleBuilder, name: &str, other: SignalId, at_reset: (SignalId, i128)) -> SignalId {
        let mut registered = |case: &str, pointer| {
            let equal = m.op(&format!("{name}_if_{case}_now"), Op::Equal, &[pointer, other]);
            let q = m.register(&format!("{name}_if_{case}"), Type::FLAG);
            m.drive(q, equal, None, Some(at_reset));
            q
        };
        let (still, moved) = (registered("still", self.count), registered("moved", self.ahead));
        m.op(name, Op::Select, &[self.moved, still, moved])
    }

    /// Connects the registers: the pointer moves on where `when` is set.
    fn advance(&self, m: &mut ModuleBuilder, when: SignalId, reset: SignalId) {
        let next = successor(m, self.name, self.ahead);
        m.drive(self.count, self.ahead, Some(when), Some((reset, 0)));
        m.drive(self.ahead, next, Some(when), Some((reset, 1)));
        m.drive(self.moved, when, None, Some((reset, 0)));
    }
}

/// The pointer after `pointer`, all around.
fn successor(m: &mut ModuleBuilder, name: &str, pointer: SignalId) -> SignalId {
    let ty = m.ty(pointer);
    let step = m.constant(&format!("{name}_step"), 1, ty);
    let sum = m.op(&format!("{name}_sum"), Op::Add, &[pointer, step]);
    m.op(&format!("{name}_next"), Op::LowBits(ty.bits), &[sum])
}
